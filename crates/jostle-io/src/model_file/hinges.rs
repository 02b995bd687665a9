//! `hinges`: where a building cracks and yields.

use std::collections::BTreeMap;

use jostle::hysteresis::{
    Backbone, Corners, DEFAULT_TAKEDA_EXPONENT, GREATEST_DAMAGE, Hysteresis, HysteresisRule,
    Pinching, Quantity, Side, SpringFault,
};
use jostle::{ColumnFibres, Frame, FrameHinges, FramePlace, Hinges, Shear};
use jostle_section::formula::Member;

use super::building::{has_length, per_storey};
use super::fibre_hinges;
use super::frame_members::filled;
use super::hinge_stiffness::{Initial, read_initial};
use super::reinforced::{KnownMembers, ProfiledMember, Reinforced};
use super::rigid_ends;
use super::section_hinges::{self, Wanted};
use super::surface_hinges;
use crate::keys::{HINGE_METHODS, HINGE_SOURCES, RULES, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View, join};

/// Reads the rule; `None` after a fault.
pub(super) fn read_rule(reader: &mut Reader<'_>, view: &View<'_>) -> Option<HysteresisRule> {
    read_rule_at(reader, view, "rule")
}

/// The same from another key.
pub(super) fn read_rule_at(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
) -> Option<HysteresisRule> {
    let name = match reader.get(view, key) {
        Some(field) if field.as_text() == Some("buckling") => {
            *reader.bad(&field, "is a rule of braces alone") =
                Some(format!("set {key} to one of {}", RULES.join(", ")));
            None
        }
        Some(field) if field.as_text() == Some("surface") => {
            *reader.bad(&field, "is a rule of columns alone") =
                Some(format!("set {key} to one of {}", RULES.join(", ")));
            None
        }
        Some(field) => reader.choice(&field, RULES, &[]),
        None => {
            reader.missing(view, key, format!("add {key} = \"peak-oriented\""));
            None
        }
    };
    let gamma = reader.get(view, "gamma");
    if let (Some(field), Some(name)) = (&gamma, name)
        && name != "takeda"
    {
        *reader.bad(field, format!("has no meaning with the rule {name}")) =
            Some("remove gamma, or set rule = \"takeda\"".into());
    }
    let exponent = match gamma {
        Some(field) => {
            let exponent = reader.quantity(&field, Dimension::Dimensionless)?;
            if !(0.0..=1.0).contains(&exponent) {
                reader.bad(
                    &field,
                    format!("must lie between 0 and 1, found {exponent}"),
                );
                return None;
            }
            exponent
        }
        None => DEFAULT_TAKEDA_EXPONENT,
    };
    let pinching = read_pinching(reader, view, name);
    Some(match HysteresisRule::from_name(name?)? {
        HysteresisRule::Takeda { .. } => HysteresisRule::Takeda { exponent },
        HysteresisRule::Pinched(_) => HysteresisRule::Pinched(pinching?),
        rule @ (HysteresisRule::Elastic
        | HysteresisRule::Bilinear
        | HysteresisRule::Normal
        | HysteresisRule::PeakOriented
        | HysteresisRule::DegradingTrilinear) => rule,
        // Those of bearings, stops and shear failure have no name among the rules.
        _ => return None,
    })
}

/// Keys of the rule `pinched`, which have no meaning with another; `None` after a fault.
fn read_pinching(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    name: Option<&'static str>,
) -> Option<Pinching> {
    for key in ["pinching", "unloading_exponent", "damage"] {
        if let (Some(field), Some(name)) = (reader.get(view, key), name)
            && name != "pinched"
        {
            *reader.bad(&field, format!("has no meaning with the rule {name}")) =
                Some(format!("remove {key}, or set rule = \"pinched\""));
        }
    }
    let exponent = match reader.get(view, "unloading_exponent") {
        Some(field) => within(reader, &field, 1.0),
        None => Some(0.0),
    };
    let table = reader.get(view, "pinching");
    let table = table.and_then(|field| reader.open(&field, &[Section::Pinching]));
    let pinching = table.map(|pinching| {
        ["deformation", "force"].map(|key| match reader.get(&pinching, key) {
            Some(field) => within(reader, &field, 1.0),
            None => {
                reader.missing(&pinching, key, format!("add {key} = {}", example(key)));
                None
            }
        })
    });
    let table = reader.get(view, "damage");
    let table = table.and_then(|field| reader.open(&field, &[Section::Damage]));
    let damage = table.map_or([Some(0.0); 2], |damage| {
        ["ductility", "energy"].map(|key| match reader.get(&damage, key) {
            Some(field) => within(reader, &field, GREATEST_DAMAGE),
            None => Some(0.0),
        })
    });
    if name != Some("pinched") {
        return None;
    }
    if pinching.is_none() && !view.has("pinching") {
        reader.missing(
            view,
            "pinching",
            "add pinching = { deformation = 0.8, force = 0.2 }",
        );
    }
    let [deformation, force] = pinching?;
    Some(Pinching {
        deformation: deformation?,
        force: force?,
        unloading_exponent: exponent?,
        ductility_damage: damage[0]?,
        energy_damage: damage[1]?,
    })
}

fn example(key: &str) -> &'static str {
    if key == "deformation" { "0.8" } else { "0.2" }
}

/// A number from 0 to a limit.
fn within(reader: &mut Reader<'_>, field: &Field<'_>, limit: f64) -> Option<f64> {
    let value = reader.quantity(field, Dimension::Dimensionless)?;
    if (0.0..=limit).contains(&value) {
        return Some(value);
    }
    reader.bad(
        field,
        format!("must lie between 0 and {limit}, found {value}"),
    );
    None
}

/// Hinges of a frame. `members` are those of known strength; `None` after faults elsewhere.
pub(super) fn read_frame(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    frame: &Frame,
    laid: &Reinforced,
    members: Option<&KnownMembers>,
) -> Option<Hinges> {
    let view = reader.open(field, &[Section::Hinges])?;
    let on_surface = surface_hinges::asked(reader, &view);
    if !on_surface {
        surface_hinges::refuse(reader, &view, false);
    }
    let with_bars = members.map(|members| &members.reinforced[..]);
    let fibres = if on_surface {
        Some(surface_hinges::read(reader, field, &view, frame, with_bars))
    } else if fibre_hinges::asked(reader, &view) {
        Some(fibre_hinges::read(reader, field, &view, frame, with_bars))
    } else {
        fibre_hinges::refuse(reader, &view);
        None
    };
    let rule = match &fibres {
        Some(_) if view.has("beam_rule") => read_rule_at(reader, &view, "beam_rule"),
        Some(_) => Some(HysteresisRule::PeakOriented),
        None => read_rule(reader, &view),
    };
    let initial = read_initial(reader, &view);
    let source = reader
        .get(&view, "from")
        .map(|field| reader.choice(&field, HINGE_SOURCES, &[]));
    let method = match reader.get(&view, "method") {
        Some(field) => {
            if source.is_none() {
                *reader.bad(&field, "has no meaning without from = \"section\"") =
                    Some("add from = \"section\", or remove method".into());
            }
            reader.choice(&field, HINGE_METHODS, &[])
        }
        None => Some("formula"),
    };
    if source.is_some() {
        for key in ["column", "beam"] {
            if let Some(field) = reader.get(&view, key) {
                *reader.bad(&field, "cannot be combined with from = \"section\"") = Some(
                    "keep either the moments here, or from with bars in column and beam".into(),
                );
            }
        }
        let kinds = match fibres {
            Some(_) => &[(Member::Beam, "beam")][..],
            None => &[(Member::Column, "column"), (Member::Beam, "beam")],
        };
        let wanted = Wanted {
            kinds,
            rule: rule?,
            initial: initial?,
            method: method?,
        };
        let hinges = section_hinges::read(reader, field, frame, &wanted, members?)?;
        return with_fibres(hinges, fibres);
    }
    if let (Some(_), Some(field)) = (&fibres, reader.get(&view, "column")) {
        let rule = if on_surface { "surface" } else { "fibre" };
        fibre_hinges::say_either(reader, &field, rule);
    }
    let [columns, beams] = [(Member::Column, "column"), (Member::Beam, "beam")].map(|kind| {
        let of = OfKind {
            kind,
            frame,
            has_profile: laid.has_profile(kind.0),
            profiled: members.map(|members| &members.profiled[..]),
        };
        of.read(reader, &view, rule, initial)
    });
    if fibres.is_none() && !view.has("column") && !view.has("beam") {
        *reader.bad(field, "has no moments") = Some("add column or beam = { cracking = \"120 kN.m\", yield = \"400 kN.m\", post_cracking = 0.3, post_yield = 0.02 }, or from = \"section\"".into());
    }
    let hinges = FrameHinges {
        columns: columns?,
        beams: beams?,
        ..FrameHinges::default()
    };
    with_fibres(hinges, fibres)
}

/// Hinges beside the fibres that were asked for; `None` after faults in these.
fn with_fibres(
    hinges: FrameHinges,
    fibres: Option<Option<BTreeMap<FramePlace, ColumnFibres>>>,
) -> Option<Hinges> {
    let fibres = match fibres {
        Some(fibres) => fibres?,
        None => BTreeMap::new(),
    };
    Some(Hinges::Frame(FrameHinges { fibres, ..hinges }))
}

/// Corners of both sides of a hinge as a table states them.
#[derive(Clone, Copy)]
pub(super) struct Stated {
    sides: [Corners; 2],
    /// Sides without a yield moment, which is that of the profile of the member.
    of_profile: [bool; 2],
}

impl Stated {
    pub(super) fn needs_profile(&self) -> bool {
        self.of_profile.contains(&true)
    }

    /// The hinge. `moment`: that at which the profile yields, where it is needed.
    pub(super) fn spring(
        &self,
        rule: HysteresisRule,
        initial: Initial,
        stiffness: f64,
        moment: Option<f64>,
    ) -> Result<Hysteresis, Vec<SpringFault>> {
        let mut sides = self.sides;
        if rule != HysteresisRule::Elastic {
            sides = sides.map(|side| initial.ratios(side));
        }
        for (side, of_profile) in sides.iter_mut().zip(self.of_profile) {
            if let (true, Some(moment)) = (of_profile, moment) {
                *side = match rule {
                    HysteresisRule::Bilinear => Corners::bilinear(moment, side.post_yield),
                    _ => Corners {
                        yielding: moment,
                        ..*side
                    },
                };
            }
        }
        let [a, b] = sides;
        Backbone::from_forces(stiffness, a, b).and_then(|backbone| Hysteresis::new(rule, backbone))
    }
}

/// What a hinge without a yield moment needs.
pub(super) const YIELDS_WHERE: &str = "add yield = \"400 kN.m\"; or yield_strength = \"355 MPa\" beside profile, which then yields at its plastic moment";

/// Columns or beams of a frame.
struct OfKind<'a> {
    kind: (Member, &'static str),
    frame: &'a Frame,
    /// Whether any is of a profile whose strength is known.
    has_profile: bool,
    /// All members of such profiles; `None` after faults elsewhere.
    profiled: Option<&'a [ProfiledMember]>,
}

impl OfKind<'_> {
    /// Their hinges; empty if there are none, `None` after a fault.
    fn read(
        &self,
        reader: &mut Reader<'_>,
        view: &View<'_>,
        rule: Option<HysteresisRule>,
        initial: Option<Initial>,
    ) -> Option<Vec<Vec<Hysteresis>>> {
        let (frame, (member, key)) = (self.frame, self.kind);
        let storeys = frame.storey_heights.len();
        let Some(field) = reader.get(view, key) else {
            return Some(Vec::new());
        };
        let entries = field.entries();
        if let Some(entries) = &entries {
            has_length(reader, &field, entries.len(), Some(storeys))?;
        }
        let single = std::slice::from_ref(&field);
        let tables = entries.as_deref().unwrap_or(single);
        let read: Vec<_> = tables
            .iter()
            .map(|table| {
                let view = reader.open(table, &[Section::Hinge])?;
                let asked = Asked {
                    rule,
                    rigid: initial == Some(Initial::Rigid),
                    has_profile: self.has_profile,
                };
                read_moments(reader, table, &view, None, asked)
            })
            .collect();
        let (rule, initial) = (rule?, initial?);
        let mut rows = Vec::new();
        for storey in 0..storeys {
            let at = if entries.is_some() { storey } else { 0 };
            let stated = read[at]?;
            let lengths = rigid_ends::bending_lengths(frame, key, storey);
            let mut row = Vec::new();
            for (place, length) in lengths.into_iter().enumerate() {
                let (own, exists) = match member {
                    Member::Column => (
                        frame.column(storey, place).or(frame.columns.get(storey)),
                        frame.bare_column(storey, place).is_some(),
                    ),
                    Member::Beam => (
                        frame.beam(storey, place).or(frame.beams.get(storey)),
                        frame.bare_beam(storey, place).is_some(),
                    ),
                };
                let moment = match stated.needs_profile() {
                    true if exists => {
                        Some(self.yield_moment(reader, &tables[at], [storey + 1, place + 1])?)
                    }
                    // Where there is no member, its hinge has no part.
                    true => {
                        row.push(None);
                        continue;
                    }
                    false => None,
                };
                let stiffness = initial.stiffness(own?.flexural_rigidity, length);
                match stated.spring(rule, initial, stiffness, moment) {
                    Ok(spring) => row.push(Some(spring)),
                    Err(faults) => {
                        note(reader, &tables[at], faults);
                        return None;
                    }
                }
            }
            rows.push(row);
        }
        Some(filled(rows))
    }

    /// Yield moment of the profile at a place \[N·m\]; `None` after a fault.
    fn yield_moment(
        &self,
        reader: &mut Reader<'_>,
        table: &Field<'_>,
        place: [usize; 2],
    ) -> Option<f64> {
        let (kind, word) = self.kind;
        let mut members = self.profiled?.iter();
        let found = members.find(|member| member.member == kind && member.place == place);
        let whose = format!("{word} {} of storey {}", place[1], place[0]);
        let Some(member) = found else {
            *reader.bad(
                table,
                format!("has no yield, and {whose} no yield_strength"),
            ) = Some(YIELDS_WHERE.into());
            return None;
        };
        match member.yield_moment() {
            Ok(moment) => Some(moment),
            Err(problem) => {
                reader.bad(table, format!("{whose}: {problem}"));
                None
            }
        }
    }
}

/// Keys of a hinge, with possible values.
const NUMBERS: [(&str, Dimension, &str); 4] = [
    ("cracking", Dimension::Moment, "\"120 kN.m\""),
    ("yield", Dimension::Moment, "\"400 kN.m\""),
    ("post_cracking", Dimension::Dimensionless, "0.3"),
    ("post_yield", Dimension::Dimensionless, "0.02"),
];

/// The numbers of a table: absent, or read, or read with a fault.
fn read_numbers(reader: &mut Reader<'_>, view: &View<'_>) -> [Option<Option<f64>>; 4] {
    NUMBERS.map(|(key, dimension, _)| {
        let field = reader.get(view, key)?;
        // Also where both sides have numbers of their own, so that a wrong sign is never silent.
        Some(match dimension {
            Dimension::Moment => reader.positive(&field, dimension),
            _ => reader.quantity(&field, dimension),
        })
    })
}

/// What is known of hinges before their moments.
#[derive(Clone, Copy)]
pub(super) struct Asked {
    /// `None` after a fault.
    pub(super) rule: Option<HysteresisRule>,
    /// Whether ratios are those of hinge and member together.
    pub(super) rigid: bool,
    /// Whether a profile may say where it yields.
    pub(super) has_profile: bool,
}

/// Moments and ratios of both sides; `None` after a fault. `view`: the table of `field`. What it lacks is that of `beside`.
pub(super) fn read_moments(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    view: &View<'_>,
    beside: Option<&View<'_>>,
    asked: Asked,
) -> Option<Stated> {
    let Asked {
        rule,
        rigid,
        has_profile,
    } = asked;
    let mut common = read_numbers(reader, view);
    if let Some(beside) = beside {
        let others = read_numbers(reader, beside);
        for (common, other) in common.iter_mut().zip(others) {
            *common = common.or(other);
        }
    }
    let subs = [Side::Positive, Side::Negative].map(|side| {
        let field = reader.get(view, name_of(side))?;
        let sub = reader.open(&field, &[Section::HingeSide])?;
        let numbers = read_numbers(reader, &sub);
        Some((sub, numbers))
    });
    let rule = rule?;
    if rule == HysteresisRule::Elastic {
        return Some(Stated {
            sides: [Corners::bilinear(1.0, 1.0); 2],
            of_profile: [false; 2],
        });
    }
    let bilinear = rule == HysteresisRule::Bilinear;
    if bilinear {
        for key in ["cracking", "post_cracking"] {
            let stated = reader.get(view, key);
            let beside = beside.and_then(|beside| reader.get(beside, key));
            if let Some(field) = stated.or(beside) {
                *reader.bad(&field, "does not apply to a bilinear curve") =
                    Some(format!("remove {key}, or set rule = \"normal\""));
            }
        }
    }
    let one_for_both = subs.iter().all(Option::is_none);
    let mut of_profile = [false; 2];
    let sides = [0, 1].map(|side| {
        let sub = subs[side].as_ref();
        let mut values = [f64::NAN; 4];
        let mut complete = true;
        for (index, (key, _, example)) in NUMBERS.into_iter().enumerate() {
            if bilinear && key.contains("cracking") {
                continue;
            }
            match sub
                .and_then(|(_, numbers)| numbers[index])
                .or(common[index])
            {
                Some(Some(value)) => values[index] = value,
                Some(None) => complete = false,
                None if has_profile && key == "yield" => of_profile[side] = true,
                None => {
                    complete = false;
                    if side == 0 || !one_for_both {
                        let place = sub.map_or(view, |(sub, _)| sub);
                        let remedy = match key {
                            "yield" => YIELDS_WHERE.to_owned(),
                            _ => format!("add {key} = {example}"),
                        };
                        reader.missing(place, key, remedy);
                    }
                }
            }
        }
        let [cracking, yielding, post_cracking, post_yield] = values;
        complete.then_some(if bilinear {
            Corners::bilinear(yielding, post_yield)
        } else {
            Corners {
                cracking,
                yielding,
                post_cracking,
                post_yield,
            }
        })
    });
    let sides = [sides[0]?, sides[1]?];
    let too_stiff =
        |side: &Corners| side.post_yield >= 1.0 || (side.post_cracking >= 1.0 && !bilinear);
    if rigid && sides.iter().any(too_stiff) {
        *reader.bad(field, "has ratios of 1 or more with initial = \"rigid\", where they are those of hinge and member together") =
            Some("give ratios below 1, such as post_cracking = 0.3".into());
        return None;
    }
    Some(Stated { sides, of_profile })
}

/// Notes the faults of a spring where its numbers stand.
pub(super) fn note(reader: &mut Reader<'_>, field: &Field<'_>, faults: Vec<SpringFault>) {
    let Some(view) = reader.reopen(field, &[Section::Hinge]) else {
        return;
    };
    let mut said = Vec::new();
    for fault in faults {
        let key = key_of(fault.quantity);
        let sub = fault.side.and_then(|side| {
            let field = reader.get(&view, name_of(side))?;
            reader.reopen(&field, &[Section::HingeSide])
        });
        let stated = key.and_then(|key| sub.as_ref().and_then(|sub| reader.get(sub, key)));
        let stated = stated.or_else(|| key.and_then(|key| reader.get(&view, key)));
        let place = stated.as_ref().unwrap_or(field);
        if !said.contains(&(place.path.clone(), fault.problem.clone())) {
            said.push((place.path.clone(), fault.problem.clone()));
            reader.bad(place, fault.problem);
        }
    }
}

fn name_of(side: Side) -> &'static str {
    match side {
        Side::Positive => "positive",
        Side::Negative => "negative",
    }
}

fn key_of(quantity: Quantity) -> Option<&'static str> {
    match quantity {
        Quantity::Cracking => Some("cracking"),
        Quantity::Yielding => Some("yield"),
        Quantity::PostCracking => Some("post_cracking"),
        Quantity::PostYield => Some("post_yield"),
        Quantity::Residual => Some("residual"),
        Quantity::Initial | Quantity::Rule => None,
    }
}

/// Corners of a rule, of which bilinear ones have no cracking point and elastic ones none at all; `None` where a number that it needs is
/// missing. `numbers`: cracking, yielding, and the slopes after both relative to the initial one.
fn corners_of(rule: HysteresisRule, numbers: [Option<f64>; 4]) -> Option<Corners> {
    let [cracking, yielding, post_cracking, post_yield] = numbers;
    Some(match rule {
        HysteresisRule::Elastic => Corners::bilinear(1.0, 1.0),
        HysteresisRule::Bilinear => Corners::bilinear(yielding?, post_yield?),
        HysteresisRule::Normal
        | HysteresisRule::PeakOriented
        | HysteresisRule::Takeda { .. }
        | HysteresisRule::DegradingTrilinear
        | HysteresisRule::Pinched(_)
        | HysteresisRule::Sliding { .. }
        | HysteresisRule::Stop { .. }
        | HysteresisRule::Ground
        | HysteresisRule::Failing(_)
        | HysteresisRule::Buckling(_)
        | HysteresisRule::Concrete(_)
        | HysteresisRule::MenegottoPinto(_)
        | HysteresisRule::Pendulums(_)
        | HysteresisRule::Surface { .. }
        | HysteresisRule::SpaceSurface { .. }
        | HysteresisRule::InPlan { .. } => Corners {
            cracking: cracking?,
            yielding: yielding?,
            post_cracking: post_cracking?,
            post_yield: post_yield?,
        },
    })
}

/// Yielding of a base spring, equal on both sides; `keys` are those of the table and of its initial stiffness.
pub(super) fn read_base(
    reader: &mut Reader<'_>,
    base: &View<'_>,
    keys: [&'static str; 2],
    stiffness: Option<f64>,
    force: Dimension,
) -> Option<Hysteresis> {
    let field = reader.get(base, keys[0])?;
    let sections: &'static [Section] = match force {
        Dimension::Moment => &[Section::BaseRocking],
        _ => &[Section::BaseSliding],
    };
    if !base.has(keys[1]) {
        *reader.bad(&field, "yields nowhere on a rigid base") =
            Some(format!("add {}, or remove {}", keys[1], keys[0]));
    }
    read_spring(reader, &field, sections, stiffness, force)
}

/// A rule on a curve that is equal on both sides; `None` after faults here or in the initial stiffness.
pub(super) fn read_spring(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    sections: &'static [Section],
    stiffness: Option<f64>,
    force: Dimension,
) -> Option<Hysteresis> {
    let view = reader.open(field, sections)?;
    let rule = read_rule(reader, &view);
    let bilinear = rule == Some(HysteresisRule::Bilinear);
    let elastic = rule == Some(HysteresisRule::Elastic);
    let mut number = |key: &'static str, dimension, example: &str| {
        let needless = elastic || (bilinear && key.contains("cracking"));
        match reader.get(&view, key) {
            Some(field) if bilinear && key.contains("cracking") => {
                *reader.bad(&field, "does not apply to a bilinear curve") =
                    Some(format!("remove {key}, or set rule = \"normal\""));
                None
            }
            Some(field) => reader.quantity(&field, dimension),
            None => {
                if !needless {
                    reader.missing(&view, key, format!("add {key} = {example}"));
                }
                needless.then_some(f64::NAN)
            }
        }
    };
    let examples = match force {
        Dimension::Moment => ["\"120 kN.m\"", "\"400 kN.m\""],
        _ => ["\"300 kN\"", "\"900 kN\""],
    };
    let cracking = number("cracking", force, examples[0]);
    let yielding = number("yield", force, examples[1]);
    let post_cracking = number("post_cracking", Dimension::Dimensionless, "0.3");
    let post_yield = number("post_yield", Dimension::Dimensionless, "0.02");
    // Only tables of links and braces have it.
    let residual = match view.has("residual").then(|| reader.get(&view, "residual")) {
        Some(Some(field)) => Some(reader.quantity(&field, Dimension::Dimensionless)?),
        _ => None,
    };
    let rule = rule?;
    let corners = corners_of(rule, [cracking, yielding, post_cracking, post_yield])?;
    // A stiffness that is not positive is a separate fault.
    let stiffness = stiffness.filter(|stiffness| *stiffness > 0.0)?;
    let backbone = match residual {
        Some(residual) => {
            Backbone::falling(stiffness, corners, corners, corners.post_yield, residual)
        }
        None => Backbone::from_forces(stiffness, corners, corners),
    };
    match backbone.and_then(|backbone| Hysteresis::new(rule, backbone)) {
        Ok(spring) => Some(spring),
        Err(faults) => {
            let of_one_side = |fault: &SpringFault| fault.side != Some(Side::Negative);
            for fault in faults.into_iter().filter(of_one_side) {
                let given = key_of(fault.quantity).and_then(|key| reader.get(&view, key));
                reader.bad(given.as_ref().unwrap_or(field), fault.problem);
            }
            None
        }
    }
}

/// Springs of a shear building.
pub(super) fn read_storeys(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    shear: &Shear,
) -> Option<Hinges> {
    let view = reader.open(field, &[Section::StoreyHinges])?;
    for key in AXES {
        if let Some(field) = reader.get(&view, key) {
            *reader.bad(
                &field,
                "needs a plan: in one plane storeys have one direction",
            ) = Some(format!(
                "give yield and the others without {key}, or add plan"
            ));
        }
    }
    let rule = read_rule(reader, &view);
    storey_springs(reader, field, rule, &[&view], &shear.stiffness).map(Hinges::Storeys)
}

/// Directions in plan.
const AXES: [&str; 2] = ["x", "y"];

/// Springs of storeys or of elements in plan, along x and across; an empty list stays elastic. `stiffness`: of every storey along x
/// and across \[N/m\].
///
/// A direction yields if it has a table of its own, or if neither has one; what its table lacks stands beside it.
pub(super) fn read_in_plan(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    stiffness: [&[f64]; 2],
) -> Option<[Vec<Hysteresis>; 2]> {
    let view = reader.open(field, &[Section::StoreyHinges])?;
    let rule = read_rule(reader, &view);
    let both = !AXES.iter().any(|key| view.has(key));
    let mut found = [Some(Vec::new()), Some(Vec::new())];
    for ((key, stiffness), found) in AXES.into_iter().zip(stiffness).zip(&mut found) {
        let is_held = stiffness.iter().any(|value| *value > 0.0);
        let Some(axis) = reader.get(&view, key) else {
            if both && is_held {
                *found = storey_springs(reader, field, rule, &[&view], stiffness);
            }
            continue;
        };
        if !is_held {
            *reader.bad(&axis, format!("yields without stiffness along {key}")) =
                Some(format!("add {key} to stiffness, or remove {key} here"));
            *found = None;
            continue;
        }
        let axis_view = reader.open(&axis, &[Section::StoreyHingesOfAxis]);
        *found = axis_view.and_then(|axis_view| {
            storey_springs(reader, &axis, rule, &[&axis_view, &view], stiffness)
        });
    }
    let [x, y] = found;
    Some([x?, y?])
}

/// One spring per storey. Every number is that of the first view that has it.
fn storey_springs(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    rule: Option<HysteresisRule>,
    views: &[&View<'_>],
    stiffness: &[f64],
) -> Option<Vec<Hysteresis>> {
    let storeys = stiffness.len();
    let bilinear = rule == Some(HysteresisRule::Bilinear);
    let elastic = rule == Some(HysteresisRule::Elastic);
    let place = |reader: &mut Reader<'_>, key: &'static str| {
        views.iter().find_map(|view| reader.get(view, key))
    };
    let mut list = |key: &'static str, dimension, example: &str| {
        let Some(field) = place(reader, key) else {
            let needless = elastic || (bilinear && key.contains("cracking"));
            if let (false, Some(view)) = (needless, views.first()) {
                reader.missing(
                    view,
                    key,
                    format!("add {key} = {example}, or a list from the ground up"),
                );
            }
            return needless.then(|| vec![f64::NAN; storeys]);
        };
        if bilinear && key.contains("cracking") {
            *reader.bad(&field, "does not apply to a bilinear curve") =
                Some(format!("remove {key}, or set rule = \"normal\""));
        }
        per_storey(reader, &field, dimension, Some(storeys))
    };
    let cracking = list("cracking", Dimension::Length, "\"5 mm\"");
    let yielding = list("yield", Dimension::Length, "\"20 mm\"");
    let post_cracking = list("post_cracking", Dimension::Dimensionless, "0.3");
    let post_yield = list("post_yield", Dimension::Dimensionless, "0.05");
    let (rule, cracking, yielding) = (rule?, cracking?, yielding?);
    let (post_cracking, post_yield) = (post_cracking?, post_yield?);
    let mut springs = Vec::new();
    let mut said: Vec<String> = Vec::new();
    for storey in 0..storeys {
        let lists = [&cracking, &yielding, &post_cracking, &post_yield];
        let corners = corners_of(rule, lists.map(|list| list.get(storey).copied()))?;
        let spring = Backbone::from_deformations(stiffness[storey], corners, corners)
            .and_then(|backbone| Hysteresis::new(rule, backbone));
        match spring {
            Ok(spring) => springs.push(spring),
            // Both sides have the same fault.
            Err(faults) => {
                for fault in faults
                    .into_iter()
                    .filter(|fault| fault.side != Some(Side::Negative))
                {
                    let given = key_of(fault.quantity).and_then(|key| place(reader, key));
                    let given = given.map(|field| match field.entries() {
                        Some(entries) => entries.into_iter().nth(storey).unwrap_or(field),
                        None => field,
                    });
                    let place = given.as_ref().unwrap_or(field);
                    let whole = join(&place.path, &fault.problem);
                    if !said.contains(&whole) {
                        said.push(whole);
                        reader.bad(place, fault.problem);
                    }
                }
            }
        }
    }
    (springs.len() == storeys).then_some(springs)
}
