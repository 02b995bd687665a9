//! `hinges` with `rule = "fibre"`: ends of columns that follow their axial force.

use std::collections::BTreeMap;

use jostle::hysteresis::MenegottoPinto;
use jostle::{ColumnFibres, FibreLimit, Frame, FramePlace};
use jostle_section::formula::Member;
use jostle_section::{FibreOptions, Section};

use super::reinforced::ReinforcedMember;
use crate::keys::{FIBRE_ENDS, FIBRE_STEELS, Section as KeySection};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Most layers of concrete that a section may be cut into.
const MOST_LAYERS: usize = 400;

/// Most parts over a side of a section in space.
const MOST_IN_SPACE: usize = 100;

/// Parts over the greater side of a section in space where nothing is said.
const USUAL_IN_SPACE: usize = 12;

/// Keys of the table of a frame that belong to fibres alone, beside those of their laws.
const OF_FRAME: [&str; 3] = ["length", "ends", "beam_rule"];

/// Keys of the laws of fibres.
const LAWS: [&str; 7] = [
    "fibres",
    "peak_strain",
    "residual",
    "ultimate_strain",
    "hardening",
    "steel",
    "limits",
];

/// Whether a table asks for fibres.
pub(super) fn asked(reader: &mut Reader<'_>, view: &View<'_>) -> bool {
    has_rule(reader, view, "fibre")
}

/// Whether a table asks for a rule of this name.
pub(super) fn has_rule(reader: &mut Reader<'_>, view: &View<'_>, name: &str) -> bool {
    let rule = reader.get(view, "rule");
    rule.is_some_and(|field| field.as_text() == Some(name))
}

/// Notes keys of the table of a frame that have no meaning without fibres.
pub(super) fn refuse(reader: &mut Reader<'_>, view: &View<'_>) {
    refuse_keys(reader, view, &OF_FRAME);
    refuse_laws(reader, view);
}

/// The same of the laws of fibres alone.
pub(super) fn refuse_laws(reader: &mut Reader<'_>, view: &View<'_>) {
    refuse_keys(reader, view, &LAWS);
}

fn refuse_keys(reader: &mut Reader<'_>, view: &View<'_>, keys: &'static [&'static str]) {
    for key in keys {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "has no meaning without fibres") =
                Some(format!("remove {key}, or set rule = \"fibre\""));
        }
    }
}

/// How ends of columns are cut into fibres.
pub(super) struct AskedFibres {
    laws: FibreLaws,
    only_base: bool,
}

/// How a section is cut into fibres, and the laws of these.
pub(super) struct FibreLaws {
    /// `None`: that of Paulay and Priestley.
    length: Option<f64>,
    /// Parts over the depth, and in space over the width; `None`: as many as usual.
    parts: Option<Parts>,
    peak_strain: Option<f64>,
    residual: Option<f64>,
    ultimate_strain: Option<f64>,
    hardening: Option<f64>,
    loops: Option<MenegottoPinto>,
    /// Strains that replace those of the section.
    limits: BTreeMap<FibreLimit, f64>,
}

/// Into how many parts a section is cut.
#[derive(Clone, Copy)]
enum Parts {
    /// Over its greater side.
    Greater(usize),
    /// Over its depth and its width.
    Each([usize; 2]),
}

impl FibreLaws {
    /// Reads how a table asks for fibres; `None` after faults. `usual`: what its length may follow from.
    pub(super) fn read(
        reader: &mut Reader<'_>,
        view: &View<'_>,
        usual: &str,
        in_space: bool,
    ) -> Option<Self> {
        let parts = match reader.get(view, "fibres") {
            Some(field) => Some(read_parts(reader, &field, in_space)?),
            None => None,
        };
        let length = match reader.get(view, "length") {
            Some(field) if field.as_text() == Some("paulay-priestley") => None,
            Some(field) => Some(reader.positive(&field, Dimension::Length)?),
            None => {
                reader.missing(
                    view,
                    "length",
                    format!(
                        "add length = \"paulay-priestley\" ({usual}), or a length such as \"0.4 m\""
                    ),
                );
                return None;
            }
        };
        let mut number =
            |key: &'static str, needs: fn(f64) -> bool, range: &str| match reader.get(view, key) {
                Some(field) => {
                    let value = reader.quantity(&field, Dimension::Dimensionless)?;
                    if needs(value) {
                        return Some(Some(value));
                    }
                    reader.bad(&field, format!("must {range}, found {value}"));
                    None
                }
                None => Some(None),
            };
        let below_one = |value: f64| (0.0..1.0).contains(&value);
        let peak_strain = number("peak_strain", |v| v > 0.0, "be greater than 0");
        let residual = number("residual", below_one, "be at least 0 and less than 1");
        let ultimate_strain = number("ultimate_strain", |v| v > 0.0, "be greater than 0");
        let hardening = number("hardening", below_one, "be at least 0 and less than 1");
        let limits = match reader.get(view, "limits") {
            Some(field) => read_limits(reader, &field),
            None => Some(BTreeMap::new()),
        };
        let loops = match reader.get(view, "steel") {
            Some(field) => read_loops(reader, &field),
            None => Some(None),
        };
        Some(Self {
            length,
            parts,
            peak_strain: peak_strain?,
            residual: residual?,
            ultimate_strain: ultimate_strain?,
            hardening: hardening?,
            loops: loops?,
            limits: limits?,
        })
    }

    /// In one plane, with this length \[m\] where none is stated, and this number of layers.
    pub(super) fn options(&self, usual_length: f64, usual_layers: usize) -> FibreOptions {
        let options = FibreOptions::over(self.length.unwrap_or(usual_length));
        FibreOptions {
            layers: match self.parts {
                Some(Parts::Greater(layers) | Parts::Each([layers, _])) => layers,
                None => usual_layers,
            },
            peak_strain: self.peak_strain,
            residual: self.residual.unwrap_or(options.residual),
            ultimate_strain: self.ultimate_strain,
            hardening: self.hardening,
            loops: self.loops,
            ..options
        }
    }

    /// Parts over the width where two are stated, or as many as usual.
    pub(super) fn across(&self, usual: usize) -> usize {
        match self.parts {
            Some(Parts::Each([_, across])) => across,
            Some(Parts::Greater(_)) | None => usual,
        }
    }

    /// Strains at which materials fail that replace those of a section.
    pub(super) fn limits(&self) -> &BTreeMap<FibreLimit, f64> {
        &self.limits
    }
}

impl AskedFibres {
    /// Reads how the table of a frame asks for fibres; `None` after faults.
    pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>, in_space: bool) -> Option<Self> {
        let laws = FibreLaws::read(reader, view, "0.08 L + 0.022 d f", in_space);
        let only_base = match reader.get(view, "ends") {
            Some(field) => reader.choice(&field, FIBRE_ENDS, &[])? == "base",
            None => false,
        };
        Some(Self {
            laws: laws?,
            only_base,
        })
    }

    /// Whether a column of a storey, counted from 0, has fibres.
    pub(super) fn stand_in(&self, storey: usize) -> bool {
        !self.only_base || storey == 0
    }

    /// Fibres of a column between the axes of its joints.
    ///
    /// # Errors
    /// The first fault of the numbers, in words.
    pub(super) fn of_column(
        &self,
        section: &Section,
        height: f64,
        in_space: bool,
    ) -> Result<ColumnFibres, String> {
        let laws = &self.laws;
        let usual = FibreOptions::hinge_length(0.5 * height, section);
        let options = laws.options(usual, FibreOptions::over(usual).layers);
        let (layers, across) = match (laws.parts, in_space) {
            (None | Some(Parts::Greater(_)), false) => (options.layers, None),
            (Some(Parts::Each([layers, across])), _) => (layers, Some(across)),
            (parts, true) => {
                let count = match parts {
                    Some(Parts::Greater(count)) => count,
                    _ => USUAL_IN_SPACE,
                };
                let greater = section.depth.max(section.width);
                let parts = |side: f64| ((count as f64 * side / greater).round() as usize).max(2);
                (parts(section.depth), Some(parts(section.width)))
            }
        };
        let options = FibreOptions {
            layers,
            across,
            ..options
        };
        let fibres = section.fibres(&options).map_err(|faults| {
            let first = faults.into_iter().next();
            first.map_or_else(String::new, |fault| fault.problem)
        })?;
        let mut limits = section.strain_limits();
        limits.extend(laws.limits());
        Ok(ColumnFibres {
            length: options.length,
            at_ends: [true, !self.only_base],
            fibres,
            limits,
        })
    }
}

/// Strains that are judged; `None` after a fault.
fn read_limits(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<BTreeMap<FibreLimit, f64>> {
    let view = reader.open(field, &[KeySection::FibreLimits])?;
    let mut limits = BTreeMap::new();
    for limit in FibreLimit::ALL {
        if let Some(field) = reader.get(&view, limit.name()) {
            limits.insert(limit, reader.positive(&field, Dimension::Dimensionless)?);
        }
    }
    Some(limits)
}

/// How the loops of bars bend: a word, or a table with its numbers; `None` after a fault.
fn read_loops(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Option<MenegottoPinto>> {
    let usual = MenegottoPinto::USUAL;
    if field.as_text().is_some() {
        let word = reader.choice(field, FIBRE_STEELS, &[])?;
        return Some((word == "menegotto-pinto").then_some(usual));
    }
    let view = reader.open(field, &[KeySection::FibreSteel])?;
    let word = match reader.get(&view, "rule") {
        Some(field) => reader.choice(&field, FIBRE_STEELS, &[]),
        None => {
            reader.missing(&view, "rule", "add rule = \"menegotto-pinto\"");
            None
        }
    };
    let [sharpness, loss, half] = [
        ("R0", usual.sharpness),
        ("cR1", usual.loss),
        ("cR2", usual.half),
    ]
    .map(|(key, usual)| match reader.get(&view, key) {
        Some(field) if word == Some("bilinear") => {
            *reader.bad(&field, "has no meaning with straight lines") =
                Some(format!("remove {key}, or set rule = \"menegotto-pinto\""));
            None
        }
        Some(field) => reader.quantity(&field, Dimension::Dimensionless),
        None => Some(usual),
    });
    let law = MenegottoPinto {
        sharpness: sharpness?,
        loss: loss?,
        half: half?,
    };
    Some((word? == "menegotto-pinto").then_some(law))
}

fn read_parts(reader: &mut Reader<'_>, field: &Field<'_>, in_space: bool) -> Option<Parts> {
    let most = if in_space { MOST_IN_SPACE } else { MOST_LAYERS };
    let mut count = |field: &Field<'_>| {
        let count = reader.count(field)?;
        if !(2..=most).contains(&count) {
            reader.bad(
                field,
                format!("must lie between 2 and {most}, found {count}"),
            );
            return None;
        }
        Some(count)
    };
    match field.entries().filter(|_| in_space) {
        None => count(field).map(Parts::Greater),
        Some(entries) => match &entries[..] {
            [along, across] => Some(Parts::Each([count(along)?, count(across)?])),
            _ => {
                *reader.bad(field, "expected a number, or two: along x and across") =
                    Some("write fibres = 12, or fibres = [20, 10]".into());
                None
            }
        },
    }
}

/// Fibres of all columns; `None` after faults. `members`: the reinforced members, `None` after faults elsewhere.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    view: &View<'_>,
    frame: &Frame,
    members: Option<&[ReinforcedMember]>,
) -> Option<BTreeMap<FramePlace, ColumnFibres>> {
    let all = read_all(reader, field, view, frame, members);
    // Each of several faults is said.
    all.filter(|_| frame.axial.columns_flexible)
}

fn read_all(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    view: &View<'_>,
    frame: &Frame,
    members: Option<&[ReinforcedMember]>,
) -> Option<BTreeMap<FramePlace, ColumnFibres>> {
    needs_flexible_columns(reader, field, frame);
    let asked = AskedFibres::read(reader, view, false)?;
    let columns: Vec<_> = members?
        .iter()
        .filter(|member| member.member == Member::Column)
        .collect();
    if columns.len() != frame.bare_members()[0] {
        say_without_bars(reader, field, columns.is_empty());
        return None;
    }
    let mut all = BTreeMap::new();
    for member in columns {
        if !asked.stand_in(member.floor - 1) {
            continue;
        }
        match asked.of_column(&member.section, member.length, false) {
            Ok(column) => {
                all.insert([member.floor - 1, member.place - 1], column);
            }
            Err(problem) => {
                reader.bad(
                    field,
                    format!(
                        "column {} of storey {}: {problem}",
                        member.place, member.floor
                    ),
                );
                return None;
            }
        }
    }
    Some(all)
}

/// Notes columns that keep their length.
pub(super) fn needs_flexible_columns(reader: &mut Reader<'_>, field: &Field<'_>, frame: &Frame) {
    if !frame.axial.columns_flexible {
        *reader.bad(
            field,
            "needs columns that change their length: without it their axial force is not known",
        ) = Some("add axial = \"flexible\" to the building".into());
    }
}

/// Notes columns without bars.
pub(super) fn say_without_bars(reader: &mut Reader<'_>, field: &Field<'_>, none_has: bool) {
    let some = if none_has { "no" } else { "not every" };
    *reader.bad(field, format!("takes fibres from the sections, but {some} column has bars")) = Some(
        "add concrete = \"C30\", steel = \"HRB400\", bars = \"12 d20\", cover = \"35 mm\" to column".into(),
    );
}

/// Notes moments of columns beside fibres, or a surface.
pub(super) fn say_either(reader: &mut Reader<'_>, field: &Field<'_>, rule: &str) {
    let instead = match rule {
        "surface" => "give surface, or bars in column, for what columns bear",
        _ => "fibres follow from the bars of the columns",
    };
    *reader.bad(field, format!("cannot be combined with rule = \"{rule}\"")) =
        Some(format!("remove it: {instead}"));
}
