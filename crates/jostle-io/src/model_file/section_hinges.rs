//! `hinges` with `from = "section"`: moments from the bars or the profiles of members.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Side, SpringFault};
use jostle::{Frame, FrameHinges};
use jostle_section::formula::Member;
use jostle_section::{EndCurve, FORMULA_POST_YIELD, Options};

use super::frame_members::filled;
use super::hinge_stiffness::Initial;
use super::reinforced::{KnownMembers, ProfiledMember, ReinforcedMember};
use crate::reader::{Field, Reader};

/// Which hinges follow from sections, and how.
pub(super) struct Wanted<'a> {
    /// Columns, beams or both, with the words for them.
    pub(super) kinds: &'a [(Member, &'a str)],
    /// Rule of all.
    pub(super) rule: HysteresisRule,
    /// Stiffness before they crack.
    pub(super) initial: Initial,
    /// `formula` or `fibre`.
    pub(super) method: &'a str,
}

/// Hinges from the reinforcement or the profiles of the members.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    frame: &Frame,
    wanted: &Wanted<'_>,
    members: &KnownMembers,
) -> Option<FrameHinges> {
    let Wanted {
        kinds,
        rule,
        initial,
        method,
    } = *wanted;
    let storeys = frame.storey_heights.len();
    let mut hinges = FrameHinges::default();
    let mut sound = true;
    for &(kind, word) in kinds {
        let (per_storey, count) = match kind {
            Member::Column => (frame.lines(), frame.bare_members()[0]),
            Member::Beam => (frame.spans.len(), frame.bare_members()[1]),
        };
        let with_bars = members.reinforced.iter();
        let with_bars: Vec<_> = with_bars.filter(|member| member.member == kind).collect();
        let profiled = members.profiled.iter();
        let profiled: Vec<_> = profiled.filter(|member| member.member == kind).collect();
        if with_bars.len() + profiled.len() != count {
            let some = if with_bars.is_empty() && profiled.is_empty() {
                "no"
            } else {
                "not every"
            };
            *reader.bad(
                field,
                format!("takes its moments from the sections, but {some} {word} has bars or yield_strength"),
            ) = Some(format!(
                "add {}; or yield_strength = \"355 MPa\" to a profile",
                match kind {
                    Member::Column =>
                        "steel = \"HRB400\", bars = \"12 d20\", cover = \"35 mm\" to column",
                    Member::Beam =>
                        "steel = \"HRB400\", bars = \"4 d25 top, 4 d25 bottom\", cover = \"35 mm\" to beam",
                }
            ));
            sound = false;
            continue;
        }
        let mut said: Vec<String> = Vec::new();
        let mut rows: Vec<Vec<Option<Hysteresis>>> = vec![vec![None; per_storey]; storeys];
        let mut known: Vec<(&ReinforcedMember, Hysteresis)> = Vec::new();
        let mut springs: Vec<([usize; 2], Result<Hysteresis, String>)> = Vec::new();
        for member in with_bars {
            let alike = known.iter().find(|(other, _)| {
                let same_load = other.compression == member.compression;
                same_load
                    && other.length == member.length
                    && other.rigidity == member.rigidity
                    && other.section == member.section
            });
            let spring = match alike {
                Some((_, spring)) => Ok(*spring),
                None => spring_of(member, rule, initial, method),
            };
            if let (None, Ok(spring)) = (alike, &spring) {
                known.push((member, *spring));
            }
            springs.push(([member.floor, member.place], spring));
        }
        let profiled = profiled.into_iter();
        springs.extend(profiled.map(|member| (member.place, of_profile(member, rule, initial))));
        for ([floor, place], spring) in springs {
            match spring {
                Ok(spring) => rows[floor - 1][place - 1] = Some(spring),
                Err(problem) => {
                    let problem = format!("{word} {place} of storey {floor}: {problem}");
                    sound = false;
                    if said.is_empty() {
                        reader.bad(field, problem.clone());
                    }
                    said.push(problem);
                }
            }
        }
        let rows = filled(rows);
        match kind {
            Member::Column => hinges.columns = rows,
            Member::Beam => hinges.beams = rows,
        }
    }
    sound.then_some(hinges)
}

/// The hinge of a member of steel: bilinear, with the slope after yield of reinforced ones by formula.
fn of_profile(
    member: &ProfiledMember,
    rule: HysteresisRule,
    initial: Initial,
) -> Result<Hysteresis, String> {
    let stiffness = initial.stiffness(member.rigidity, member.length);
    let after = FORMULA_POST_YIELD / (1.0 - FORMULA_POST_YIELD);
    let ratio = 6.0 * member.rigidity / member.length * after / stiffness;
    let corners = Corners::bilinear(member.yield_moment()?, ratio);
    Backbone::from_forces(stiffness, corners, corners)
        .and_then(|backbone| Hysteresis::new(rule, backbone))
        .map_err(first_of)
}

/// The first of some faults, in words.
fn first_of(faults: Vec<SpringFault>) -> String {
    faults.first().map_or_else(String::new, |fault| {
        format!("{}: {}", fault.quantity, fault.problem)
    })
}

/// The hinge of a reinforced member.
fn spring_of(
    member: &ReinforcedMember,
    rule: HysteresisRule,
    initial: Initial,
    method: &str,
) -> Result<Hysteresis, String> {
    let curve = match method {
        "fibre" => EndCurve::by_analysis(
            &member.section,
            member.compression,
            member.length,
            Options::default(),
        )
        .map_err(|error| error.to_string())?,
        _ => EndCurve::by_formula(
            &member.section,
            member.compression,
            member.length,
            member.member,
        ),
    };
    let stiffness = initial.stiffness(member.rigidity, member.length);
    let backbone = curve
        .hinge(6.0 * member.rigidity / member.length, stiffness)
        .map_err(first_of)?;
    let backbone = if rule == HysteresisRule::Bilinear {
        // Without a cracking point.
        let corners = Side::BOTH.map(|side| {
            let given = backbone.side(side);
            Corners::bilinear(given.yielding.force, given.post_yield / stiffness)
        });
        Backbone::from_forces(stiffness, corners[0], corners[1]).map_err(first_of)?
    } else {
        backbone
    };
    Hysteresis::new(rule, backbone).map_err(first_of)
}
