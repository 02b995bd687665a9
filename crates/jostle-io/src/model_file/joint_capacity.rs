//! Which beam–column joints are compared with their capacity.

use jostle::model::{CapacityLine, JointRequest, MemberCapacity, RuleCapacity};
use jostle::{Model, Structure};
use jostle_section::Section;
use jostle_section::capacity::{RatedJoint, ShearRule};
use jostle_section::formula::Member;

use super::reinforced::ReinforcedMember;

/// What decides the capacity of a joint.
type Known<'a> = (
    &'a Section,
    [Option<&'a Section>; 2],
    jostle_section::StrengthLevel,
);

/// Joints whose column below has ties and whose beams all have bars, with their capacities by these rules.
pub(super) fn joints(
    model: &Model,
    rules: &[ShearRule],
    members: &[ReinforcedMember],
) -> Vec<JointRequest> {
    let mut known: Vec<(Known<'_>, Vec<RuleCapacity>)> = Vec::new();
    let columns = members
        .iter()
        .filter(|member| member.member == Member::Column);
    let joints = columns.filter_map(|column| {
        let building = &model.buildings[column.building];
        let Structure::Frame(frame) = &building.structure else {
            return None;
        };
        let (line, floor) = (column.place, column.floor);
        let other = |kind, floor, place| {
            let mut all = members.iter();
            all.find(|other| {
                other.building == column.building
                    && other.member == kind
                    && other.floor == floor
                    && other.place == place
            })
        };
        let spans = [line - 1, line];
        let exists = spans.map(|span| (1..=frame.spans.len()).contains(&span));
        let beams = spans.map(|span| Some(&other(Member::Beam, floor, span)?.section));
        if exists != beams.map(|beam| beam.is_some()) {
            return None;
        }
        let is = (&column.section, beams, column.level);
        let found = known.iter().position(|(other, _)| *other == is);
        let found = found.unwrap_or_else(|| {
            let joint = RatedJoint {
                column: &column.section,
                beams,
                level: column.level,
            };
            known.push((is, joint.capacities(rules)));
            known.len() - 1
        });
        let rules = &known[found].1;
        if rules.is_empty() {
            return None;
        }
        let weighs = building.weight_is_in_axial_forces();
        let above = other(Member::Column, floor + 1, line);
        let at_rest = above.map_or(0.0, |above| above.compression);
        Some(JointRequest {
            building: column.building,
            line,
            floor,
            half_depth: (0.5 * column.section.depth - frame.rigid_zone([floor - 1, line - 1])[0])
                .max(0.0),
            levers: beams.map(|beam| beam.map(RatedJoint::lever)),
            capacity: MemberCapacity {
                member: format!("{}.joint.{line}.{floor}", building.name),
                compression_at_rest: if weighs { 0.0 } else { at_rest },
                follows_axial: true,
                axial_failure_drift: CapacityLine::default(),
                rotations: Vec::new(),
                rules: rules.clone(),
            },
        })
    });
    joints.collect()
}
