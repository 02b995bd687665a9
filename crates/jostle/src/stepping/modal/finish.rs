//! The end of a run in modal coordinates: its results, and how accurate they are.

use super::estimate::Estimate;
use super::stepper::ModalStepper;
use crate::state::State;
use crate::stepping::member_ratios::MemberRatios;
use crate::stepping::outcome::{OnProgress, Outcome, RunEnd};
use crate::stepping::runner::{RunState, Runner};
use crate::stepping::totals::columns_of_links;

/// Share of the tolerance below which an error of shapes needs no further shapes.
const LEAST_SHARE: f64 = 0.3;

/// What a run says of its own accuracy.
pub(super) struct Verdict {
    pub(super) estimate: Estimate,
    /// Modes of every building that miss too much.
    pub(super) lacking: Vec<Vec<usize>>,
    /// First instant at which a contact was made or missed by less than the tolerance \[s\].
    pub(super) doubtful_from: Option<f64>,
}

/// Runs to the end of the motion; with how far peaks may be off.
pub(super) fn finish(
    mut runner: Runner<'_, ModalStepper<'_>>,
    observer: &mut OnProgress<'_>,
) -> (Outcome, Verdict) {
    let end = runner.run_to_end(observer);
    runner.stepper.peaks.complete(runner.stepper.reduced);
    let verdict = runner.stepper.verdict(&runner.run);
    runner.report_unfinished_impacts();
    let Runner { run, stepper } = runner;
    (stepper.into_outcome(run, end), verdict)
}

impl ModalStepper<'_> {
    fn verdict(&self, run: &RunState<'_>) -> Verdict {
        let tolerance = run.plan.tolerance();
        let struck = !run.impacts.is_empty();
        let (reduced, system) = (self.reduced, run.system);
        let mut estimate = Estimate::new(reduced, system, &self.reached, &self.peaks, struck);
        estimate.between = libm::hypot(estimate.between, self.links.error());
        let lacking = if estimate.both() > tolerance && estimate.shapes > LEAST_SHARE * tolerance {
            self.reached
                .lacking(reduced, system, &self.peaks, tolerance)
        } else {
            Vec::new()
        };
        Verdict {
            estimate,
            lacking,
            doubtful_from: self.near.doubtful_from,
        }
    }

    fn into_outcome(mut self, mut run: RunState<'_>, end: RunEnd) -> Outcome {
        run.work.coupling_operations =
            run.coupling.operations + self.equations.operations + self.plan_equations.operations;
        let energy = self.balance();
        let step_of = |division: u32| run.plan.step / f64::from(division);
        let contact_step = Some(run.finest_in_contact)
            .filter(|d| *d > 0)
            .map(|d| step_of(d.max(self.least_division)));
        let state = self.full_state(&run);
        let members = self.peaks.members.take();
        let (members, member_history, ratios) = members.map_or_else(
            || {
                (
                    vec![Vec::new(); run.system.buildings.len()],
                    None,
                    MemberRatios::default(),
                )
            },
            |members| members.finish(run.system, self.reduced),
        );
        let mut peaks = self.peaks.take(run.system);
        peaks.extend(columns_of_links(&self.links.totals));
        let free_step = Some(step_of(self.least_division));
        Outcome {
            members,
            member_history,
            member_ratios: ratios.greatest,
            worst_instants: ratios.worst,
            history: self.peaks.into_history(),
            energy,
            free_step,
            contact_step,
            state,
            ..run.into_outcome(peaks, end)
        }
    }

    /// Displacements, velocities and accelerations of everything.
    fn full_state(&mut self, run: &RunState<'_>) -> State {
        let mut state = State::at_rest(run.system, 0.0);
        state.time = run.time;
        self.reduced.expand(&self.q[0], &mut state.displacement);
        self.reduced.expand(&self.v[0], &mut state.velocity);
        self.accelerations();
        self.reduced.expand(&self.scratch, &mut state.acceleration);
        state.contacts.clone_from(&run.phases);
        state.crushed.clone_from(&run.crushed);
        state
    }
}
