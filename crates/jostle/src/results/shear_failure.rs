//! Columns that failed in shear, as numbers to report.

use super::capacity::impact_at;
use super::parts::name_of;
use super::summarise::{Run, springs_of};
use super::summary::{ShearFailure, ShearFailureSummary};
use crate::history::SpringEvent;
use crate::hysteresis::Side;
use crate::linear::sort_by;
use crate::model::PlanAxis;
use crate::structure::{MemberEnd, SpringPlace};

/// Columns of a building that failed; `None` if none can fail.
pub(super) fn shear_failures(building: usize, run: &Run) -> Option<ShearFailureSummary> {
    let system_building = &run.system.buildings[building];
    let places = &system_building.discretization.spring_places;
    if !places.iter().any(SpringPlace::is_shear) {
        return None;
    }
    let (mut list, mut columns, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    let mut dissipated_j = 0.0;
    for spring in springs_of(system_building, run.outcome) {
        let Some(&SpringPlace::Shear {
            frame,
            member,
            axis,
            end,
        }) = places.get(spring.index)
        else {
            continue;
        };
        dissipated_j += spring.dissipated_j;
        if !columns.contains(&(frame, member)) {
            columns.push((frame, member));
        }
        let Some(failed_s) = spring.yielded_s else {
            continue;
        };
        if !failed.contains(&(frame, member)) {
            failed.push((frame, member));
        }
        let global = system_building.spring_offset + spring.index;
        let memory = &run.outcome.state.springs[global];
        let rule = &system_building.equations.springs[spring.index].hysteresis;
        let Some([failure, _]) = rule.failure_corners(memory) else {
            continue;
        };
        // Known where the forces of members are followed.
        let mut followed = system_building.members.members.iter();
        let frame_index = frame.map(|frame| frame - 1);
        let sections = followed.find(|own| own.place == member && own.frame == frame_index);
        list.push(ShearFailure {
            column: name_of(system_building, frame_index, &member.to_string()),
            along: axis.map(PlanAxis::name),
            at: match end {
                MemberEnd::First => "foot",
                MemberEnd::Last => "head",
            },
            failed_s,
            strength_n: failure.force,
            slip_peak_m: Side::BOTH
                .map(|side| memory.greatest(side))
                .into_iter()
                .fold(0.0, f64::max),
            strength_left: rule.strength_left(memory) / failure.force,
            dissipated_j: spring.dissipated_j,
            impact: failing_event(global, run)
                .and_then(|event| impact_at(building, sections, event.time, run)),
        });
    }
    sort_by(&mut list, |a, b| a.failed_s.total_cmp(&b.failed_s));
    Some(ShearFailureSummary {
        total: columns.len(),
        failed: failed.len(),
        first_s: list.first().map(|first| first.failed_s),
        dissipated_j,
        list,
    })
}

fn failing_event<'a>(spring: usize, run: &'a Run) -> Option<&'a SpringEvent> {
    let mut events = run.outcome.spring_events.iter();
    events.find(|event| event.spring == spring)
}
