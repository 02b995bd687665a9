//! `[output] capacity`: which members are compared with their capacity, and by which rules.

use jostle::model::{CapacityLine, MemberCapacity, RotationLimits, RuleCapacity};
use jostle::{Building, MemberRequest, Model, Structure};
use jostle_section::Section;
use jostle_section::capacity::{
    CapacityRule, Interaction, ObliqueInteraction, RatedMember, ShearRule,
};
use jostle_section::formula::Member;

use super::reinforced::{KnownMembers, ProfiledMember, ReinforcedMember};
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Rules for demands over capacities, as written.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum CapacityRequest {
    /// Nothing written: all rules, if forces of members are asked for and their strength is known.
    #[default]
    WhereKnown,
    /// None.
    Off,
    /// These, the first governs; forces of members are then asked for as well.
    Rules(Vec<CapacityRule>),
}

impl CapacityRequest {
    /// The rules for reinforced members, that of the country of the steel first where all are asked for.
    fn rules(&self, members: &[ReinforcedMember]) -> Vec<ShearRule> {
        match self {
            Self::Off => Vec::new(),
            Self::Rules(rules) if rules[..] != CapacityRule::ALL => {
                let rules = rules.iter();
                rules.filter_map(|rule| rule.reinforced()).collect()
            }
            Self::WhereKnown | Self::Rules(_) => {
                let home = members.iter().find_map(|member| member.home_rule);
                // ASCE 41 has no rule for joints: that of its country follows.
                let of_joints = home.filter(|rule| *rule == ShearRule::Asce41);
                let of_joints = of_joints.map(|_| ShearRule::Aci318);
                let others = ShearRule::ALL.into_iter();
                let others = others.filter(|rule| Some(*rule) != home && Some(*rule) != of_joints);
                home.into_iter().chain(of_joints).chain(others).collect()
            }
        }
    }

    /// Whether steel profiles are rated.
    fn rates_profiles(&self) -> bool {
        match self {
            Self::Off => false,
            Self::WhereKnown => true,
            Self::Rules(rules) => rules.contains(&CapacityRule::Aisc360),
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
        CapacityRule::from_name(name)
    };
    match (&field.node.value, field.entries()) {
        (Value::Flag(true), _) => CapacityRequest::Rules(CapacityRule::ALL.to_vec()),
        (Value::Flag(false), _) => CapacityRequest::Off,
        (_, Some(entries)) => {
            let mut rules: Vec<CapacityRule> = Vec::new();
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

/// Notes rules for members of unknown strength; `None` for members after faults elsewhere.
pub(super) fn check(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    request: &CapacityRequest,
    members: Option<&KnownMembers>,
) {
    let (
        CapacityRequest::Rules(_),
        Some(KnownMembers {
            reinforced: members,
            profiled,
        }),
    ) = (request, members)
    else {
        return;
    };
    let are_profiles_rated = request.rates_profiles() && !profiled.is_empty();
    if !are_profiles_rated && members.iter().all(|member| member.section.ties.is_none()) {
        let missing = if members.is_empty() {
            "bars and ties"
        } else {
            "ties"
        };
        *reader.bad(
            field,
            format!("needs members with {missing}: their capacity is unknown"),
        ) = Some(
            "add steel = \"HRB400\", bars = \"12 d20\", ties = \"d10 @ 100 mm\" to column, and likewise to beam; or yield_strength = \"355 MPa\" to a profile"
                .into(),
        );
    }
}

/// Fills in the capacities of members if forces of members are asked for.
pub(crate) fn fill(model: &mut Model, request: &CapacityRequest, members: &KnownMembers) {
    if let CapacityRequest::Rules(rules) = request {
        model.analysis.members.envelopes |= !rules.is_empty();
    }
    let KnownMembers {
        reinforced: members,
        profiled,
    } = members;
    let mut capacities = capacities(model, request, members);
    let joints = if capacities.is_empty() {
        Vec::new()
    } else {
        super::joint_capacity::joints(model, &request.rules(members), members)
    };
    if request.rates_profiles() {
        capacities.extend(profiled.iter().map(|member| of_profile(model, member)));
    }
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
    let mut sections = KnownSections::default();
    for (index, member) in members.iter().enumerate() {
        let building = &model.buildings[member.building];
        let weighs = building.weight_is_in_axial_forces();
        let alike = members[..index].iter().position(|known| {
            known.member == member.member
                && known.clear_length == member.clear_length
                && known.clear_length_across == member.clear_length_across
                && known.level == member.level
                && known.section == member.section
        });
        let rated = rated(member);
        let (axial_failure_drift, rules) = match alike {
            Some(known) => {
                let known = &capacities[known];
                (known.axial_failure_drift.clone(), known.rules.clone())
            }
            None => (
                rated.axial_failure_drift(),
                sections.capacities(member, rules),
            ),
        };
        let rotations = if yields(building) {
            match alike.filter(|&known| members[known].compression == member.compression) {
                Some(known) => capacities[known].rotations.clone(),
                None => rotation_limits(member),
            }
        } else {
            Vec::new()
        };
        capacities.push(MemberCapacity {
            member: format!("{}.{}", building.name, member.name),
            compression_at_rest: if weighs { 0.0 } else { member.compression },
            follows_axial: member.member == Member::Column,
            axial_failure_drift,
            rotations,
            rules,
        });
    }
    capacities
}

/// Capacity of a member of steel.
fn of_profile(model: &Model, member: &ProfiledMember) -> MemberCapacity {
    let building = &model.buildings[member.building];
    let is_column = member.member == Member::Column;
    let (length, bends_across) = (member.length, member.bends_across);
    MemberCapacity {
        member: format!("{}.{}", building.name, member.name),
        compression_at_rest: match building.weight_is_in_axial_forces() {
            true => 0.0,
            false => member.compression,
        },
        follows_axial: is_column,
        axial_failure_drift: CapacityLine::default(),
        rotations: Vec::new(),
        rules: vec![member.steel.capacity(member.member, length, bends_across)],
    }
}

fn rated(member: &ReinforcedMember) -> RatedMember<'_> {
    RatedMember {
        section: &member.section,
        member: member.member,
        clear_length: member.clear_length,
        level: member.level,
    }
}

/// Whether ends of its columns or beams may yield.
fn yields(building: &Building) -> bool {
    let in_plan = matches!(&building.structure, Structure::Tiers(tiers) if tiers.may_yield());
    building.hinges.is_some() || in_plan
}

/// Rotations that rules accept at the ends of a member; of a column that bends in two planes the smaller ones.
fn rotation_limits(member: &ReinforcedMember) -> Vec<RotationLimits> {
    let mut limits = rated(member).rotation_limits(member.compression);
    let Some(clear_length) = member.clear_length_across else {
        return limits;
    };
    let across = RatedMember {
        section: &member.section.turned(),
        clear_length,
        ..rated(member)
    };
    let across = across.rotation_limits(member.compression);
    for limit in &mut limits {
        let same =
            |other: &&RotationLimits| (other.rule, other.measure) == (limit.rule, limit.measure);
        let Some(other) = across.iter().find(same) else {
            continue;
        };
        for ((_, one), (_, other)) in limit.limits.iter_mut().zip(&other.limits) {
            *one = one.min(*other);
        }
    }
    limits
}

/// What sections bear, as far as it was computed.
#[derive(Default)]
struct KnownSections<'a> {
    in_plane: Vec<(&'a Section, [Interaction; 2])>,
    oblique: Vec<(&'a Section, ObliqueInteraction)>,
}

impl<'a> KnownSections<'a> {
    /// Capacities of a member by some rules.
    fn capacities(
        &mut self,
        member: &'a ReinforcedMember,
        rules: &[ShearRule],
    ) -> Vec<RuleCapacity> {
        let section = &member.section;
        let in_plane = position(&mut self.in_plane, section, || {
            Interaction::of_both_signs(section)
        });
        let (_, in_plane) = &self.in_plane[in_plane];
        let rated = rated(member);
        let Some(clear_length) = member.clear_length_across else {
            return rated.capacities_with(rules, in_plane);
        };
        let turned = section.turned();
        let oblique = position(&mut self.oblique, section, || {
            let across = Interaction::of_both_signs(&turned);
            ObliqueInteraction::new(section, &[in_plane.clone(), across])
        });
        let across = RatedMember {
            section: &turned,
            clear_length,
            ..rated.clone()
        };
        let (_, oblique) = &self.oblique[oblique];
        rated.capacities_in_space(&across, rules, in_plane, oblique)
    }
}

/// Where a section stands in a list, to which `new` adds it if it is not there.
fn position<'a, T>(
    known: &mut Vec<(&'a Section, T)>,
    section: &'a Section,
    new: impl FnOnce() -> T,
) -> usize {
    let found = known.iter().position(|(other, _)| *other == section);
    found.unwrap_or_else(|| {
        known.push((section, new()));
        known.len() - 1
    })
}
