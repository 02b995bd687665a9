//! `[output] capacity`: which members are compared with their capacity, and by which rules.

use jostle::model::MemberCapacity;
use jostle::{MemberRequest, Model};
use jostle_section::Section;
use jostle_section::capacity::{Interaction, RatedMember, ShearRule};
use jostle_section::formula::Member;

use super::reinforced::ReinforcedMember;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Rules for demands over capacities, as written.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum CapacityRequest {
    /// Nothing written: all rules, if forces of members are asked for and their bars and ties are known.
    #[default]
    WhereKnown,
    /// None.
    Off,
    /// These, the first governs; forces of members are then asked for as well.
    Rules(Vec<ShearRule>),
}

impl CapacityRequest {
    /// The rules, that of the country of the steel first where all are asked for.
    fn rules(&self, members: &[ReinforcedMember]) -> Vec<ShearRule> {
        match self {
            Self::Off => Vec::new(),
            Self::Rules(rules) if rules[..] != ShearRule::ALL => rules.clone(),
            Self::WhereKnown | Self::Rules(_) => {
                let home = members.iter().find_map(|member| member.home_rule);
                let others = ShearRule::ALL.into_iter();
                let others = others.filter(|rule| Some(*rule) != home);
                home.into_iter().chain(others).collect()
            }
        }
    }
}

/// Reads the rules.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>) -> CapacityRequest {
    let Some(field) = reader.get(view, "capacity") else {
        return CapacityRequest::default();
    };
    let mut rule = |field: &Field<'_>| {
        let name = reader.choice(field, crate::keys::CAPACITY_RULES, &[])?;
        ShearRule::from_name(name)
    };
    match (&field.node.value, field.entries()) {
        (Value::Flag(true), _) => CapacityRequest::Rules(ShearRule::ALL.to_vec()),
        (Value::Flag(false), _) => CapacityRequest::Off,
        (_, Some(entries)) => {
            let mut rules: Vec<ShearRule> = Vec::new();
            for found in entries.iter().filter_map(&mut rule) {
                if !rules.contains(&found) {
                    rules.push(found);
                }
            }
            if entries.is_empty() {
                *reader.bad(&field, "names no rule") =
                    Some("name one, such as \"gb50010\", or set it to false".into());
            }
            CapacityRequest::Rules(rules)
        }
        _ if field.as_text().is_some() => {
            CapacityRequest::Rules(rule(&field).into_iter().collect())
        }
        _ => {
            let found = field.node.describe();
            reader.bad(
                &field,
                format!("expected true, false, a rule such as \"gb50010\", or a list of rules, found {found}"),
            );
            CapacityRequest::default()
        }
    }
}

/// Notes rules for members without bars or ties; `None` for members after faults elsewhere.
pub(super) fn check(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    request: &CapacityRequest,
    members: Option<&[ReinforcedMember]>,
) {
    let (CapacityRequest::Rules(_), Some(members)) = (request, members) else {
        return;
    };
    if members.iter().all(|member| member.section.ties.is_none()) {
        let missing = if members.is_empty() {
            "bars and ties"
        } else {
            "ties"
        };
        *reader.bad(
            field,
            format!("needs members with {missing}: their capacity is unknown"),
        ) = Some(
            "add steel = \"HRB400\", bars = \"12 d20\", ties = \"d10 @ 100 mm\" to column, and likewise to beam"
                .into(),
        );
    }
}

/// Fills in the capacities of members if forces of members are asked for.
pub(crate) fn fill(model: &mut Model, request: &CapacityRequest, members: &[ReinforcedMember]) {
    if let CapacityRequest::Rules(rules) = request {
        model.analysis.members.envelopes |= !rules.is_empty();
    }
    let capacities = capacities(model, request, members);
    let joints = if capacities.is_empty() {
        Vec::new()
    } else {
        super::joint_capacity::joints(model, &request.rules(members), members)
    };
    let asked: &mut MemberRequest = &mut model.analysis.members;
    asked.joints = joints;
    asked.capacities = if asked.envelopes {
        capacities
    } else {
        Vec::new()
    };
}

fn capacities(
    model: &Model,
    request: &CapacityRequest,
    members: &[ReinforcedMember],
) -> Vec<MemberCapacity> {
    let rules = &request.rules(members)[..];
    let known = members.iter().any(|member| member.section.ties.is_some());
    if rules.is_empty() || !known || !model.analysis.members.envelopes {
        return Vec::new();
    }
    let mut capacities: Vec<MemberCapacity> = Vec::with_capacity(members.len());
    let mut interactions: Vec<(&Section, [Interaction; 2])> = Vec::new();
    for (index, member) in members.iter().enumerate() {
        let building = &model.buildings[member.building];
        let name = match member.member {
            Member::Column => format!("{}.column.{}.{}", building.name, member.place, member.floor),
            Member::Beam => format!("{}.beam.{}.{}", building.name, member.floor, member.place),
        };
        let weighs = building.weight_is_in_axial_forces();
        let alike = members[..index].iter().position(|known| {
            known.member == member.member
                && known.clear_length == member.clear_length
                && known.level == member.level
                && known.section == member.section
        });
        let rated = RatedMember {
            section: &member.section,
            member: member.member,
            clear_length: member.clear_length,
            level: member.level,
        };
        let (axial_failure_drift, rules) = match alike {
            Some(known) => {
                let known = &capacities[known];
                (known.axial_failure_drift.clone(), known.rules.clone())
            }
            None => {
                let mut known = interactions.iter();
                let known = known.position(|(section, _)| **section == member.section);
                let known = known.unwrap_or_else(|| {
                    let both = Interaction::of_both_signs(&member.section);
                    interactions.push((&member.section, both));
                    interactions.len() - 1
                });
                let both = &interactions[known].1;
                (
                    rated.axial_failure_drift(),
                    rated.capacities_with(rules, both),
                )
            }
        };
        let rotations = if building.hinges.is_some() {
            match alike.filter(|&known| members[known].compression == member.compression) {
                Some(known) => capacities[known].rotations.clone(),
                None => rated.rotation_limits(member.compression),
            }
        } else {
            Vec::new()
        };
        capacities.push(MemberCapacity {
            member: name,
            compression_at_rest: if weighs { 0.0 } else { member.compression },
            follows_axial: member.member == Member::Column,
            axial_failure_drift,
            rotations,
            rules,
        });
    }
    capacities
}
