//! Scripts for OpenSeesPy: the same nodes, elements, ties, damping, hinges, contacts and record, and a driver that
//! runs them in two ways.
//!
//! F. McKenna, M. H. Scott, G. L. Fenves (2010), J. Comput. Civ. Eng. 24, 95–107; M. Zhu, F. McKenna, M. H. Scott
//! (2018), SoftwareX 7, 6–11. docs/export.md describes the behaviour of the program.

mod arms;
mod building;
mod contacts;
mod fibres;
mod foundation;
mod grounds;
mod materials;
mod motion;
mod panels;
mod plan;
mod plan_base;
mod plan_frames;
mod remarks;
mod script;
mod soil;
mod space_frame;
mod tables;
mod ties;

use jostle::hysteresis::HysteresisRule;
use jostle::structure::FibreSection;
use jostle::{
    Building, FrameHinges, Hinges, Isolation, Isolator, ModelFault, ShearSpring, SpaceFrame,
    SpacePlace, Structure,
};

use crate::{Export, Exported};
use script::Script;

/// The part of every script that is the same: it builds the model from the tables above it, and runs it.
const DRIVER: [&str; 4] = [
    include_str!("driver/model.py"),
    include_str!("driver/ground.py"),
    include_str!("driver/contacts.py"),
    include_str!("driver/run.py"),
];

/// Writes the script.
///
/// # Errors
/// Everything of the model that OpenSees cannot do, by field, never empty.
pub fn export(export: &Export<'_>) -> Result<Exported, Vec<ModelFault>> {
    let faults = refusals(export);
    if !faults.is_empty() {
        return Err(faults);
    }
    let script = Script::new(export)?;
    let remarks = script.remarks().to_vec();
    Ok(Exported {
        text: script.text(&DRIVER),
        remarks,
    })
}

/// Whether the ductility of hinges lowers the shear strength of columns.
fn is_weakened_by_ductility(building: &Building) -> bool {
    let weakens = |column: &ShearSpring| !column.by_ductility.points().is_empty();
    let in_frame = |hinges: &FrameHinges| {
        !hinges.columns.is_empty() && hinges.shear.iter().flatten().any(weakens)
    };
    let of_plan = match &building.structure {
        Structure::Tiers(tiers) => Some(tiers),
        _ => None,
    };
    let in_space = of_plan.and_then(|tiers| tiers.space_frame.as_ref());
    let yields = |frame: &SpaceFrame, place: &SpacePlace| {
        let mut members = frame.members.iter();
        members.any(|member| member.place == *place && member.may_yield())
    };
    matches!(&building.hinges, Some(Hinges::Frame(hinges)) if in_frame(hinges))
        || of_plan.is_some_and(|tiers| tiers.frames.iter().any(|frame| in_frame(&frame.hinges)))
        || in_space.is_some_and(|frame| {
            let mut shear = frame.shear.iter();
            shear.any(|((place, _), column)| weakens(column) && yields(frame, place))
        })
}

/// Fields whose values OpenSees does not support, as far as the model alone shows.
fn refusals(export: &Export<'_>) -> Vec<ModelFault> {
    let mut faults = Vec::new();
    let model = export.model;
    let mut refuse = |path: String, problem: String| faults.push(ModelFault { path, problem });
    if model.analysis.integrator != jostle::Integrator::default() {
        refuse(
            "analysis.integrator".into(),
            "cannot be exported: the script steps by average acceleration; remove it to compare"
                .into(),
        );
    }
    if export.motion.has_own_grounds() && export.system.is_in_space() {
        refuse(
            "motion".into(),
            "different motion under each building with a plan is not exported: their ties need the constraint handler Transformation, which does not let the script move supports; leave out arrival, position, apparent_velocity and [building.motion], or compare buildings in one plane".into(),
        );
    }
    for (index, building) in model.buildings.iter().enumerate() {
        if let Some(Isolation {
            isolator: Isolator::Pendulum { friction, .. },
            ..
        }) = &building.base.isolation
            && !friction.is_constant()
        {
            refuse(
                format!("building[{index}].isolation.friction"),
                "rises with the speed, which the exported springs cannot do; give one coefficient, such as friction = 0.05".into(),
            );
        }
        let several = building.base.isolation.map(|isolation| isolation.isolator);
        let several = several.filter(|several| {
            matches!(
                several,
                Isolator::DoublePendulum { .. } | Isolator::TriplePendulum { .. }
            )
        });
        let in_plan = matches!(building.structure, Structure::Tiers(_));
        if let Some(isolator) = several.filter(|_| in_plan) {
            refuse(
                format!("building[{index}].isolation.kind"),
                format!(
                    "\"{}\" under a building with a plan has rims that are rings, which OpenSees' springs are not; take \"friction-pendulum\" with one surface, or a building in one plane, to compare",
                    isolator.name()
                ),
            );
        }
        let stop = building
            .base
            .isolation
            .and_then(|isolation| isolation.stops[0]);
        if in_plan && stop.is_some() {
            refuse(
                format!("building[{index}].isolation.stop"),
                "is a ring, which OpenSees does not have; take moat walls ([[wall]] with from and to), or leave it out to compare".into(),
            );
        }
        let structure = export.system.structures().get(index);
        if structure.is_some_and(|structure| structure.modal_damping.is_some()) {
            refuse(
                format!("building[{index}].damping.modes"),
                "\"all\" cannot be exported: OpenSees has one list of modal ratios for all buildings together; give two modes, such as modes = [1, 2], to compare".into(),
            );
        }
        let sections = structure.map(|structure| &structure.structure.discretization.sections);
        if sections.is_some_and(|sections| sections.iter().any(FibreSection::is_surface)) {
            refuse(
                format!("building[{index}].hinges.rule"),
                "\"surface\" cannot be exported: OpenSees has no hinge whose axial force and moments are bounded by a polygon; take rule = \"fibre\", or hinges with moments, to compare"
                    .into(),
            );
        }
        let in_space = match &building.structure {
            Structure::Tiers(tiers) => tiers.space_frame.as_ref(),
            _ => None,
        };
        let mut diagonals: Vec<&jostle::Diagonal> = Vec::new();
        match &building.structure {
            Structure::Frame(frame) => diagonals.extend(&frame.diagonals),
            Structure::Tiers(tiers) => {
                diagonals.extend(in_space.iter().flat_map(|frame| &frame.diagonals));
                let frames = tiers.frames.iter();
                diagonals.extend(frames.flat_map(|plan_frame| &plan_frame.frame.diagonals));
            }
            _ => {}
        }
        let crushed = |diagonal: &jostle::Diagonal| {
            let law = diagonal.hysteresis.as_ref();
            law.is_some_and(|law| law.backbone().open_side().is_some())
        };
        if diagonals.iter().copied().any(crushed) {
            refuse(
                format!("building[{index}].infill"),
                "has compression-only struts with a hinge, which OpenSees' Hysteretic cannot do; leave out hinge to compare with elastic struts".into(),
            );
        }
        // In one plane arms are exported, but not beside the levers of a foundation.
        let (walls, ends) = match &building.structure {
            Structure::Frame(frame) if building.base.foundation.is_some() => {
                (!frame.walls.is_empty(), !frame.rigid_zones.is_empty())
            }
            _ => (false, false),
        };
        if walls {
            refuse(
                format!("building[{index}].wall"),
                "has rigid arms that turn with it, which are exported only in plane frames without a foundation on soil; make it a column with its EI, EA and GA to compare frames without arms".into(),
            );
        }
        // Arms of walls are rigid zones as well.
        if ends && !walls {
            refuse(
                format!("building[{index}].rigid_ends"),
                "are rigid arms that turn with joints, which are exported only in plane frames without a foundation on soil; leave them out to compare frames between axes".into(),
            );
        }
        if in_space.is_some_and(space_frame::has_hinges_on_arms) {
            refuse(
                format!("building[{index}].hinges"),
                "stand at faces of walls or at rigid_ends, on rigid arms that turn with joints, which are exported only in plane frames; leave rigid_ends out, and keep members that meet walls elastic, to compare".into(),
            );
        }
        if is_weakened_by_ductility(building) {
            refuse(
                format!("building[{index}].shear_failure"),
                "lowers the strength of columns with the ductility of their hinges, which OpenSees' LimitState cannot do; give strength and slope instead of the rule, or rule = \"aci318\" or \"gb50010\"".into(),
            );
        }
        let of_members = match &building.hinges {
            None => None,
            Some(Hinges::Frame(hinges)) => {
                hinges.columns.iter().chain(&hinges.beams).flatten().next()
            }
            Some(Hinges::Storeys(springs)) => springs.first(),
        };
        let springs = [
            ("hinges", of_members),
            (
                "base.rotational_hinge",
                building.base.rotational_hinge.as_ref(),
            ),
            (
                "base.horizontal_hinge",
                building.base.horizontal_hinge.as_ref(),
            ),
        ];
        for (field, hysteresis) in springs {
            let rule = hysteresis.map(jostle::hysteresis::Hysteresis::rule);
            if let Some(
                rule @ (HysteresisRule::Takeda { .. } | HysteresisRule::DegradingTrilinear),
            ) = rule
            {
                refuse(
                    format!("building[{index}].{field}.rule"),
                    format!(
                        "OpenSees has no rule \"{}\"; normal, bilinear, peak-oriented and pinched can be exported",
                        rule.name()
                    ),
                );
            }
        }
    }
    faults
}
