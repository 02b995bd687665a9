//! Runs of one model that differ in the widths of its gaps only.

use std::ops::ControlFlow;

use jostle::stepping::{Progress, modal};
use jostle::{
    GroundMotion, Model, Outcome, Plan, Pounding, RunEnd, Settings, Summary, System, simulate,
};
use serde::Serialize;

use crate::shapes::SharedShapes;

/// Why a search failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GapError {
    /// The model has no gap.
    #[error("the model has no gap")]
    NoGap,
    /// The neighbours have no common heights.
    #[error("{0} have no place where they could touch")]
    NoContact(String),
    /// The model or its steps are wrong.
    #[error("{0}")]
    Model(String),
    /// A run failed.
    #[error("{0}")]
    Run(String),
    /// Asked to stop.
    #[error("stopped")]
    Stopped,
}

/// What a width of a gap leads to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GapPoint {
    /// Width \[m\].
    pub width_m: f64,
    /// Impacts in the gap.
    pub impact_count: usize,
    /// Greatest contact force in the gap \[N\].
    pub peak_force_n: f64,
    /// First impact \[s\].
    pub first_impact_s: Option<f64>,
    /// Whether the run met its tolerance; `None` if it has no estimate.
    pub met: Option<bool>,
}

impl GapPoint {
    /// A width that the buildings do not close.
    pub(crate) fn without_impact(width: f64) -> Self {
        Self {
            width_m: width,
            impact_count: 0,
            peak_force_n: 0.0,
            first_impact_s: None,
            met: Some(true),
        }
    }

    /// The point of a gap, from its run.
    pub(crate) fn new(width: f64, gap: usize, tried: &Tried) -> Self {
        let found = &tried.summary.gaps[gap];
        Self {
            width_m: width,
            impact_count: found.impact_count,
            peak_force_n: found.peak_force_n,
            first_impact_s: found.first_impact_s,
            met: tried.summary.promise.met,
        }
    }
}

/// A run and what it belongs to.
pub(crate) struct Tried {
    pub(crate) system: System,
    pub(crate) outcome: Outcome,
    pub(crate) summary: Summary,
}

/// A model, and what all its runs share.
pub(crate) struct GapRuns<'a> {
    model: &'a Model,
    motion: &'a GroundMotion,
    system: System,
    shapes: SharedShapes,
    stop: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> GapRuns<'a> {
    /// Assembles the model.
    pub(crate) fn new(
        model: &'a Model,
        motion: &'a GroundMotion,
        stop: &'a (dyn Fn() -> bool + Sync),
    ) -> Result<Self, GapError> {
        Ok(Self {
            model,
            motion,
            system: System::assemble(model).map_err(wrong)?,
            shapes: SharedShapes::default(),
            stop,
        })
    }

    /// Runs the model with these widths.
    pub(crate) fn run(
        &self,
        widths: &[f64],
        pounding: Pounding,
        watch: &mut dyn FnMut(Progress),
    ) -> Result<Tried, GapError> {
        let mut model = self.model.clone();
        for (gap, width) in model.gaps.iter_mut().zip(widths) {
            gap.set_width(*width);
        }
        let system = self.system.with_gaps_of(&model).map_err(wrong)?;
        let plan = Plan::choose(&system, self.motion, &model.analysis).map_err(wrong)?;
        let settings = Settings {
            pounding,
            record_interval: None,
            ..Settings::default()
        };
        let observer = |reached| {
            watch(reached);
            if (self.stop)() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let motion = self.motion;
        let outcome = match self.shapes.find(&system, &plan) {
            Some(shapes) => modal::simulate(&system, motion, &plan, settings, &shapes, observer),
            None => simulate(&system, motion, &plan, settings, observer),
        };
        match outcome.end_of_all() {
            RunEnd::Completed => {}
            RunEnd::Stopped => return Err(GapError::Stopped),
            RunEnd::Failed(error) => return Err(GapError::Run(error.to_string())),
        }
        let summary = Summary::new(&jostle::Run {
            model: &model,
            system: &system,
            motion,
            plan: &plan,
            outcome: &outcome,
            without_contact: None,
            wall: 0.0,
        });
        Ok(Tried {
            system,
            outcome,
            summary,
        })
    }
}

fn wrong(faults: Vec<jostle::ModelFault>) -> GapError {
    let faults: Vec<String> = faults.iter().map(ToString::to_string).collect();
    GapError::Model(faults.join("; "))
}
