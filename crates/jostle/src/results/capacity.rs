//! Demand over capacity of columns and beams, as numbers to report.

use super::members::{member_name, section_name};
use super::summarise::{Run, names};
use super::summary::{
    AcceptanceSummary, AxialFailureSummary, CapacitySummary, ExceededSummary, ImpactPlace,
    JointRatio, JointSummary, LevelSummary, MemberSummary, RatioPlace, RatioSummary,
};
use crate::history::{Impact, RatioPeak, SectionRatio};
use crate::interface::Contact;
use crate::model::{RotationMeasure, RuleCapacity};
use crate::structure::{MemberPlace, MemberSections, SectionAt};
use crate::system::{MemberRating, RatedPart};

/// The rating of a member, and its entries among the ratios of the run: section by section, each by every rule.
fn rated<'a>(
    building: usize,
    member: usize,
    run: &'a Run,
) -> Option<(&'a MemberRating, &'a [SectionRatio])> {
    let mut all = ratings(run);
    all.find(|(rating, _)| rating.building == building && rating.part == RatedPart::Member(member))
}

/// All ratings, and their entries among the ratios of the run.
fn ratings<'a>(run: &'a Run) -> impl Iterator<Item = (&'a MemberRating, &'a [SectionRatio])> {
    let mut first = 0;
    run.system.ratings.iter().filter_map(move |rating| {
        let start = first;
        first += rating.sections.len() * rating.capacity.rules.len();
        let entries = run.outcome.member_ratios.get(start..first)?;
        Some((rating, entries))
    })
}

/// Shear of the joints of a building that are rated.
pub(super) fn joints_of(building: usize, run: &Run) -> Vec<JointSummary> {
    let system_building = &run.system.buildings[building];
    let joints = ratings(run).filter_map(|(rating, entries)| match rating.part {
        RatedPart::Joint(joint) if rating.building == building => {
            Some((&system_building.members.joints[joint], rating, entries))
        }
        _ => None,
    });
    let summary = joints.map(|(joint, rating, entries)| {
        let [greatest, least] = run.outcome.members[building][joint.section.forms[1]];
        let rules = rating.capacity.rules.iter().zip(entries);
        let mut ratios = rules.map(|(rule, entry)| JointRatio {
            rule: rule.rule,
            shear: entry.shear.ratio,
            shear_at: place_of(
                building,
                rule,
                ("core", joint.section.height),
                &entry.shear,
                entry.shear.exceeded_at,
                None,
                run,
            ),
        });
        // The first rule for members governs; it may have none for joints.
        let governing = governing_rule(run);
        let mut ratios: Vec<JointRatio> = ratios.by_ref().collect();
        let ratio = match ratios.first() {
            Some(first) if Some(first.rule) == governing => Some(ratios.remove(0)),
            _ => None,
        };
        JointSummary {
            name: rating.capacity.member.clone(),
            shear_peak_n: greatest.max(-least),
            ratio,
            other_ratios: ratios,
        }
    });
    summary.collect()
}

/// Name of the rule that governs, by the first member.
fn governing_rule(run: &Run) -> Option<&'static str> {
    let mut ratings = run.system.ratings.iter();
    let member = ratings.find(|rating| matches!(rating.part, RatedPart::Member(_)))?;
    Some(member.capacity.rules.first()?.rule)
}

fn place_of(
    building: usize,
    rule: &RuleCapacity,
    (at, height): (&'static str, f64),
    peak: &RatioPeak,
    exceeded: Option<f64>,
    member: Option<&MemberSections>,
    run: &Run,
) -> RatioPlace {
    let [demand, across] = peak.demand;
    let demand_across = rule.across.as_ref().map(|_| across);
    RatioPlace {
        at,
        height_m: height,
        at_s: peak.at,
        demand,
        demand_across,
        capacity: if peak.ratio > 0.0 {
            demand_across.map_or(demand.abs(), |across| libm::hypot(demand, across)) / peak.ratio
        } else {
            0.0
        },
        compression_n: peak.compression,
        exceeded_s: exceeded,
        impact: impact_at(building, member, peak.at, run),
    }
}

/// Greatest ratios of a member, rule by rule; none where its capacity is unknown.
pub(super) fn ratios_of(building: usize, member: usize, run: &Run) -> Vec<RatioSummary> {
    let Some((rating, entries)) = rated(building, member, run) else {
        return Vec::new();
    };
    let sections = &run.system.buildings[building].members.members[member];
    let rules = &rating.capacity.rules;
    let by_rule = rules.iter().enumerate().map(|(index, rule)| {
        let section_ratios = || entries.iter().skip(index).step_by(rules.len()).enumerate();
        let greatest = |of: fn(&SectionRatio) -> &RatioPeak| {
            let peaks = section_ratios().map(|(section, entry)| (section, of(entry)));
            let exceeded = peaks.clone().filter_map(|(_, peak)| peak.exceeded_at);
            let exceeded_s = exceeded.min_by(f64::total_cmp);
            let (section, peak) = peaks.reduce(|best, other| {
                if other.1.ratio > best.1.ratio {
                    other
                } else {
                    best
                }
            })?;
            let section = sections.sections[section];
            let at = section_name(sections.place, section.at);
            let place = (at, section.height);
            let place = place_of(building, rule, place, peak, exceeded_s, Some(sections), run);
            Some((peak.ratio, place))
        };
        let shear = rule
            .shear
            .as_ref()
            .and_then(|_| greatest(|entry| &entry.shear));
        let (bending, bending_at) = greatest(|entry| &entry.bending)?;
        let (shear, shear_at) = shear.unzip();
        Some(RatioSummary {
            rule: rule.rule,
            shear,
            bending,
            shear_at,
            bending_at,
        })
    });
    by_rule.flatten().collect()
}

/// Drift at axial failure of a column, where it is known.
pub(super) fn axial_failure(
    building: usize,
    member: usize,
    run: &Run,
) -> Option<AxialFailureSummary> {
    let (rating, _) = rated(building, member, run)?;
    let line = &rating.capacity.axial_failure_drift;
    let member = &run.system.buildings[building].members.members[member];
    let storey = match member.place {
        MemberPlace::Column { storey, .. } => storey,
        MemberPlace::InSpace(place) if member.place.is_column() => place.storey() + 1,
        _ => return None,
    };
    if line.points().is_empty() {
        return None;
    }
    let extremes = &run.outcome.members[building];
    let least = member
        .sections
        .iter()
        .map(|section| extremes[section.forms[0]][1]);
    let compression_n = rating.compression(least.fold(f64::INFINITY, f64::min));
    let drift = line.at(compression_n);
    let peak = run.outcome.peaks.floor(building, storey).storey_drift();
    Some(AxialFailureSummary {
        drift,
        compression_n,
        ratio: peak / drift,
    })
}

/// Rotations of the hinges of a member against the limits of rules.
pub(super) fn acceptance(building: usize, member: usize, run: &Run) -> Vec<AcceptanceSummary> {
    let Some((rating, _)) = rated(building, member, run) else {
        return Vec::new();
    };
    let building = &run.system.buildings[building];
    let place = building.members.members[member].place;
    let springs = &run.outcome.state.springs[building.spring_range()];
    let limits = rating.capacity.rotations.iter();
    let against = limits.filter_map(|limits| {
        let of = |(at, [plastic, chord]): (SectionAt, [f64; 2])| match limits.measure {
            RotationMeasure::Plastic => (at, plastic),
            RotationMeasure::Chord => (at, chord),
        };
        let rotations = rating.rotations(building, springs).map(of);
        let (at, rotation_rad) =
            rotations.reduce(|best, other| if other.1 > best.1 { other } else { best })?;
        let kept = limits
            .limits
            .iter()
            .find(|(_, limit)| rotation_rad <= *limit);
        Some(AcceptanceSummary {
            rule: limits.rule,
            measure: match limits.measure {
                RotationMeasure::Plastic => "plastic",
                RotationMeasure::Chord => "chord",
            },
            rotation_rad,
            at: section_name(place, at),
            limits: limits
                .limits
                .iter()
                .map(|&(level, rotation_rad)| LevelSummary {
                    level,
                    rotation_rad,
                })
                .collect(),
            level: kept.map(|(level, _)| *level),
        })
    });
    against.collect()
}

/// The strongest impact on a building in progress at an instant: of those that strike a member between its ends, if one does.
pub(super) fn impact_at(
    building: usize,
    member: Option<&MemberSections>,
    time: f64,
    run: &Run,
) -> Option<ImpactPlace> {
    let impacts = run.outcome.impacts.iter().filter(|impact| {
        let buildings = run.system.contacts[impact.contact].ports.buildings();
        buildings.contains(&Some(building)) && (impact.start..=impact.end).contains(&time)
    });
    let strikes = |impact: &Impact| {
        let contact = &run.system.contacts[impact.contact];
        member.is_some_and(|member| is_struck(building, member, contact, run))
    };
    let impact = impacts.max_by(|a, b| {
        let by_force = a.peak_force.total_cmp(&b.peak_force);
        strikes(a).cmp(&strikes(b)).then(by_force)
    })?;
    let contact = &run.system.contacts[impact.contact];
    Some(ImpactPlace {
        on_member: member.map(|_| strikes(impact)),
        between: names(run.model.gaps[contact.gap].between, run.system),
        floors: run.system.floors_of(&contact.ports),
        height_m: contact.height,
        start_s: impact.start,
    })
}

/// Whether a contact lies on a member between its ends.
fn is_struck(building: usize, member: &MemberSections, contact: &Contact, run: &Run) -> bool {
    let offset = run.system.buildings[building].offset;
    let sections = member.sections.iter();
    let between = sections.filter(|section| section.at == SectionAt::Below);
    let mut dofs = between.flat_map(|section| section.dofs).flatten();
    dofs.any(|dof| {
        let mut ports = contact.ports.0.iter().flatten();
        ports.any(|port| port.building == building && port.is_at(offset + dof))
    })
}

/// Members of a building beyond their capacity; `None` where no capacity is known.
pub(super) fn of_building(
    building: usize,
    members: &[MemberSummary],
    joints: &[JointSummary],
    run: &Run,
) -> Option<CapacitySummary> {
    let rated = || {
        members
            .iter()
            .filter_map(|member| Some((member, member.ratio.as_ref()?)))
    };
    let kinds = rated().flat_map(|(member, ratio)| {
        let shear = ratio.shear.zip(ratio.shear_at.as_ref());
        let shear = shear.map(|(value, place)| ("shear", value, place));
        let bending = ("bending", ratio.bending, &ratio.bending_at);
        let all = shear.into_iter().chain([bending]);
        all.map(move |(kind, value, place)| (member, kind, value, place))
    });
    let (worst_member, kind, value, place) = kinds
        .clone()
        .reduce(|best, other| if other.2 > best.2 { other } else { best })?;
    let worst = ExceededSummary {
        member: worst_member.name.clone(),
        kind,
        at: place.at,
        at_s: place.at_s,
        ratio: value,
        impact: place.impact.clone(),
    };
    let in_shear = |ratio: &RatioSummary| ratio.shear.is_some_and(|shear| shear > 1.0);
    let exceeded = rated().filter(|(_, ratio)| ratio.bending > 1.0 || in_shear(ratio));
    Some(CapacitySummary {
        rule: rated().next()?.1.rule,
        rated: rated().count(),
        exceeded: exceeded.count(),
        exceeded_in_shear: rated().filter(|(_, ratio)| in_shear(ratio)).count(),
        first: first_of(building, run),
        worst,
        joints_rated: joints
            .iter()
            .filter_map(|joint| joint.ratio.as_ref())
            .count(),
        joints_exceeded: joints.iter().filter(|joint| exceeds(joint)).count(),
        first_joint: first_joint(joints, building, run),
    })
}

fn exceeds(joint: &JointSummary) -> bool {
    joint.ratio.as_ref().is_some_and(|ratio| ratio.shear > 1.0)
}

/// The first joint beyond its capacity by the governing rule.
fn first_joint(joints: &[JointSummary], building: usize, run: &Run) -> Option<ExceededSummary> {
    let exceeded = joints.iter().filter_map(|joint| {
        let ratio = joint.ratio.as_ref()?;
        Some((joint, ratio, ratio.shear_at.exceeded_s?))
    });
    let (joint, ratio, at_s) = exceeded.min_by(|a, b| a.2.total_cmp(&b.2))?;
    Some(ExceededSummary {
        member: joint.name.clone(),
        kind: "shear",
        at: ratio.shear_at.at,
        at_s,
        ratio: ratio.shear,
        impact: impact_at(building, None, at_s, run),
    })
}

/// The first member beyond its capacity by the governing rule.
fn first_of(building: usize, run: &Run) -> Option<ExceededSummary> {
    let system_building = &run.system.buildings[building];
    let mut first: Option<(f64, ExceededSummary)> = None;
    for (index, member) in system_building.members.members.iter().enumerate() {
        let Some((rating, entries)) = rated(building, index, run) else {
            continue;
        };
        let governing = entries.iter().step_by(rating.capacity.rules.len().max(1));
        for (section, entry) in member.sections.iter().zip(governing) {
            for (kind, peak) in [("shear", &entry.shear), ("bending", &entry.bending)] {
                let Some(time) = peak.exceeded_at else {
                    continue;
                };
                if first.as_ref().is_none_or(|(known, _)| time < *known) {
                    let found = ExceededSummary {
                        member: member_name(system_building, member),
                        kind,
                        at: section_name(member.place, section.at),
                        at_s: time,
                        ratio: peak.ratio,
                        impact: impact_at(building, Some(member), time, run),
                    };
                    first = Some((time, found));
                }
            }
        }
    }
    first.map(|(_, found)| found)
}
