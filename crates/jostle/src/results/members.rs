//! Greatest forces of columns and beams, as numbers to report.

use super::capacity;
use super::summarise::{Run, counted_impacts};
use super::summary::{
    AcrossSummary, ForcesSummary, MemberComparison, MemberSummary, SectionSummary, StruckSummary,
};
use crate::stepping::Outcome;
use crate::structure::{MemberPlace, MemberSection, MemberSections, SectionAt};
use crate::system::BuildingSystem;

/// Name of a section of a member: `foot`, `head`, `left`, `right`, `below` or `above`. The left end of a beam across is that at the
/// smaller y.
#[must_use]
pub fn section_name(place: MemberPlace, at: SectionAt) -> &'static str {
    match (place.is_column(), at) {
        (true, SectionAt::First) => "foot",
        (true, SectionAt::Last) => "head",
        (false, SectionAt::First) => "left",
        (false, SectionAt::Last) => "right",
        (_, SectionAt::Below) => "below",
        (_, SectionAt::Above) => "above",
        (_, SectionAt::Core) => "core",
    }
}

/// Full name of a member, such as `J1.column.2.3`, or `Tower.frame 1.column.2.3` where frames stand in a plan.
#[must_use]
pub fn member_name(building: &BuildingSystem, member: &MemberSections) -> String {
    let local_name = member.local_name(&building.discretization.frames);
    format!("{}.{local_name}", building.name)
}

pub(super) fn members_of(index: usize, run: &Run) -> Vec<MemberSummary> {
    let building = &run.system.buildings[index];
    let extremes = &run.outcome.members[index];
    let section = |member: &MemberSections, section: &MemberSection| {
        let [axial, shear, moment] = section.forms.map(|form| extremes[form]);
        let size = |[greatest, least]: [f64; 2]| greatest.max(-least);
        SectionSummary {
            at: section_name(member.place, section.at),
            axial_max_n: axial[0],
            axial_min_n: axial[1],
            shear_peak_n: size(shear),
            moment_peak_n_m: size(moment),
            across: section.across.map(|forms| {
                let [shear, moment, torque] = forms.map(|form| size(extremes[form]));
                AcrossSummary {
                    shear_across_peak_n: shear,
                    moment_across_peak_n_m: moment,
                    torque_peak_n_m: torque,
                }
            }),
        }
    };
    let members = building.members.members.iter().enumerate();
    members
        .map(|(place, member)| {
            let ratios = capacity::ratios_of(index, place, run);
            let (ends, struck) = member.sections.split_at(2);
            MemberSummary {
                name: member_name(building, member),
                place: Some(member.place),
                frame: member.frame,
                shared_column: member.shared.clone(),
                ends: ends.iter().map(|end| section(member, end)).collect(),
                struck: struck
                    .chunks_exact(2)
                    .map(|pair| {
                        let (impact_count, peak_force_n) = impacts_at(index, &pair[0], run);
                        StruckSummary {
                            height_m: pair[0].height,
                            impact_count,
                            peak_force_n,
                            below: section(member, &pair[0]),
                            above: section(member, &pair[1]),
                        }
                    })
                    .collect(),
                compared: compared(index, member, run),
                at_worst: at_worst(index, member, run),
                acceptance: capacity::acceptance(index, place, run),
                axial_failure: capacity::axial_failure(index, place, run),
                ratio: ratios.first().cloned(),
                other_ratios: ratios.into_iter().skip(1).collect(),
            }
        })
        .collect()
}

/// Greatest forces of a member with contact and without.
fn compared(building: usize, member: &MemberSections, run: &Run) -> Option<MemberComparison> {
    let peaks = |outcome: &Outcome| {
        let extremes = outcome.members.get(building)?;
        let mut peaks = [0.0_f64; 3];
        for section in &member.sections {
            let [axial, shear, moment] = section.forms.map(|form| extremes[form]);
            peaks[0] = peaks[0].max(-axial[1]);
            let across = section.across.map(|forms| forms.map(|form| extremes[form]));
            let across = across
                .into_iter()
                .flat_map(|[shear, moment, _]| [shear, moment]);
            let both = [shear, moment].into_iter().chain(across);
            for (kind, [greatest, least]) in both.enumerate() {
                let peak = &mut peaks[1 + kind % 2];
                *peak = peak.max(greatest).max(-least);
            }
        }
        Some(peaks)
    };
    let with = peaks(run.outcome)?;
    let without = peaks(run.without_contact?)?;
    let ratio = |kind: usize| (without[kind] > 0.0).then(|| with[kind] / without[kind]);
    Some(MemberComparison {
        compression_peak_n: with[0],
        shear_peak_n: with[1],
        moment_peak_n_m: with[2],
        compression_peak_without_contact_n: without[0],
        shear_peak_without_contact_n: without[1],
        moment_peak_without_contact_n_m: without[2],
        shear_amplification: ratio(1),
        moment_amplification: ratio(2),
    })
}

/// Forces of a member when its building had the greatest ratio of demand to capacity.
fn at_worst(building: usize, member: &MemberSections, run: &Run) -> Vec<ForcesSummary> {
    let Some(worst) = run.outcome.worst_instants.get(building) else {
        return Vec::new();
    };
    if worst.forces.is_empty() || worst.ratio == 0.0 {
        return Vec::new();
    }
    let sections = member.sections.iter();
    sections
        .map(|section| {
            let [axial_n, shear_n, moment_n_m] = section.forms.map(|form| worst.forces[form]);
            let across = section
                .across
                .map(|[shear, moment, _]| [shear, moment].map(|form| worst.forces[form]));
            let (shear_across_n, moment_across_n_m) = across.map(|[v, m]| (v, m)).unzip();
            ForcesSummary {
                at: section_name(member.place, section.at),
                height_m: section.height,
                axial_n,
                shear_n,
                moment_n_m,
                shear_across_n,
                moment_across_n_m,
            }
        })
        .collect()
}

/// Number of impacts on a point of a building, and their greatest force \[N\].
fn impacts_at(building: usize, section: &MemberSection, run: &Run) -> (usize, f64) {
    let offset = run.system.buildings[building].offset;
    let (mut count, mut force) = (0, 0.0_f64);
    for (index, contact) in run.system.contacts.iter().enumerate() {
        let mut ports = contact.ports.0.iter().flatten();
        let here = ports.any(|port| {
            let mut dofs = section.dofs.into_iter().flatten();
            port.building == building && dofs.any(|dof| port.is_at(offset + dof))
        });
        if here {
            let gap = &run.model.gaps[contact.gap];
            // All points of a face before it have impacts together.
            let reported = contact.plan.map_or(index, |place| place.face);
            let impacts = counted_impacts(reported, gap, run);
            count += impacts.len();
            force = impacts
                .iter()
                .fold(force, |most, impact| most.max(impact.impact.peak_force));
        }
    }
    (count, force)
}
