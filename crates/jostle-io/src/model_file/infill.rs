//! `[[building.infill]]`: panels of masonry in the bays of a frame, as two struts that bear compression alone.

use jostle::hysteresis::Hysteresis;
use jostle::{Diagonal, DiagonalKind, DiagonalPlace, Rise};
use jostle_section::masonry::{
    Masonry, Panel, PanelCurve, StrutWidth, left_by_area, left_by_length,
};

use super::brace::{Bays, add, places, tables};
use super::hinges::read_spring;
use super::out_of_plane;
use super::panel_struts::PanelStruts;
use crate::keys::{PANEL_CURVES, PANEL_STRENGTHS, STRUT_WIDTHS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// The bay of a panel, and its mass \[kg\].
pub(super) type PanelMass = (DiagonalPlace, f64);

/// Reads the panels of a frame: their struts, and the masses of those that have one.
pub(super) fn read_all(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    bays: Bays<'_>,
) -> (Vec<Diagonal>, Vec<PanelMass>) {
    let (mut struts, mut masses) = (Vec::new(), Vec::new());
    for entry in tables(reader, view, "infill") {
        let (found, own_masses) = read(reader, &entry, bays).unwrap_or_default();
        add(reader, &entry, found, &mut struts);
        masses.extend(own_masses);
    }
    (struts, masses)
}

/// What a table says of the masonry, the same in every bay that it names.
struct Wall {
    modulus: f64,
    thickness: f64,
    width: Width,
}

#[derive(Clone, Copy)]
enum Width {
    Stated(f64),
    Rule(StrutWidth),
}

/// Where the strength of a strut comes from.
enum Strength {
    Stated(f64),
    Bertoldi(Masonry),
    Sliding { sliding: f64, vertical_stress: f64 },
}

/// What a table says of the mass of every panel.
enum Mass {
    Each(f64),
    /// \[kg/m²\]
    Surface(f64),
}

/// Struts and masses of the panels of a table; `None` after a fault.
fn read(
    reader: &mut Reader<'_>,
    entry: &Field<'_>,
    bays: Bays<'_>,
) -> Option<(Vec<Diagonal>, Vec<PanelMass>)> {
    let view = reader.open(entry, bays.sections(DiagonalKind::Infill))?;
    let noted = reader.count_faults();
    let stiffness = reader
        .get(&view, "stiffness")
        .map(|field| reader.positive(&field, Dimension::Stiffness));
    let opening = opening(reader, &view);
    let mass = mass(reader, &view);
    let strength = strength(reader, &view);
    let wall = match stiffness {
        Some(_) => {
            refuse_beside_stiffness(reader, &view);
            None
        }
        None => Some(wall(reader, &view)),
    };
    let curve = strength.is_some().then(|| {
        let modulus = wall.as_ref().and_then(|wall| Some(wall.as_ref()?.modulus));
        curve(reader, &view, modulus)
    });
    refuse_without_strength(reader, &view, strength.is_some());
    let across = out_of_plane::read(reader, &view);
    let parallel = PanelStruts::read(reader, &view);
    let (mass, Opening { left, open }) = (mass?, opening?);
    let hinge = reader.get(&view, "hinge");
    let panel = |wall: &Wall, place: DiagonalPlace| {
        let rigidity = (bays.column_rigidity)(place);
        let stands = rigidity.iter().flatten().count().max(1) as f64;
        Panel {
            height: bays.heights[place.storey - 1],
            length: bays.width(place),
            thickness: wall.thickness,
            modulus: wall.modulus,
            column_rigidity: rigidity.iter().flatten().sum::<f64>() / stands,
            left,
        }
    };
    let width_in = |wall: &Wall, panel: &Panel| match wall.width {
        Width::Stated(width) => width,
        Width::Rule(rule) => panel.width(rule),
    };
    let stiffness_of = |place: DiagonalPlace, _| match (&wall, stiffness) {
        (Some(wall), _) => {
            let wall = wall.as_ref()?;
            let panel = panel(wall, place);
            Some(panel.stiffness(width_in(wall, &panel)))
        }
        (None, stiffness) => Some(left * stiffness??),
    };
    let (kind, parallel) = (DiagonalKind::Infill, parallel?);
    let mut struts = places(reader, &view, kind, &Rise::BOTH, bays, &stiffness_of)?;
    for strut in &mut struts {
        if let Some(across) = &across {
            let height = bays.heights[strut.place.storey - 1];
            strut.across = Some(across.as_ref()?.panel(reader, entry, height)?);
        }
        if let Some(field) = &hinge {
            strut.hysteresis = Some(by_hinge(reader, field, strut.stiffness)?);
        } else if let (Some(strength), Some(curve)) = (&strength, &curve) {
            let (Some(wall), strength, curve) =
                (wall.as_ref()?.as_ref(), strength.as_ref()?, (*curve)?)
            else {
                return None;
            };
            let panel = panel(wall, strut.place);
            let width = width_in(wall, &panel);
            let force = match strength {
                Strength::Stated(force) => left * force,
                Strength::Bertoldi(masonry) => panel.strength(width, masonry).0,
                Strength::Sliding {
                    sliding,
                    vertical_stress,
                } => panel.sliding_strength(*sliding, *vertical_stress),
            };
            match panel.strut(width, force, curve) {
                Ok(spring) => {
                    strut.stiffness = spring.backbone().initial();
                    strut.hysteresis = Some(spring);
                }
                Err(faults) => {
                    let problem = faults
                        .into_iter()
                        .next()
                        .map_or_else(String::new, |fault| fault.problem);
                    *reader.bad(entry, format!("gives no curve that rises to the strength: {problem}")) = Some(
                        "the first slope must be greater than the secant of the strut: give a narrower strut or a greater shear_modulus".into(),
                    );
                    return None;
                }
            }
        } else {
            strut.hysteresis = Hysteresis::without_tension(strut.stiffness).ok();
        }
    }
    let size = |place: DiagonalPlace| [bays.width(place), bays.heights[place.storey - 1]];
    // Two struts are one panel.
    let panels = struts.iter().map(|strut| strut.place);
    let panels = panels.filter(|place| place.rise == Rise::Right);
    let masses = mass.iter().flat_map(|mass| {
        let of_panel = |place: DiagonalPlace| match mass {
            Mass::Each(mass) => *mass,
            Mass::Surface(surface) => {
                let [width, height] = size(place);
                surface * width * height * (1.0 - open)
            }
        };
        panels.clone().map(move |place| (place, of_panel(place)))
    });
    let masses: Vec<PanelMass> = masses.collect();
    let struts = struts.into_iter();
    let struts = struts.flat_map(|strut| parallel.of_panel(strut, size(strut.place)));
    let struts = struts.collect();
    (reader.count_faults() == noted).then_some((struts, masses))
}

/// Mass of every panel; nothing inside without it, and `None` after a fault.
fn mass(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Option<Mass>> {
    match (reader.get(view, "mass"), reader.get(view, "density")) {
        (Some(_), Some(density)) => {
            *reader.bad(&density, "and mass are both given") = Some("leave out one of them".into());
            None
        }
        (Some(mass), None) => Some(Some(Mass::Each(reader.positive(&mass, Dimension::Mass)?))),
        (None, Some(density)) => {
            let own = reader.positive(&density, Dimension::Density);
            let Some(field) = reader.get(view, "thickness") else {
                *reader.bad(&density, "needs the thickness of the panel") = Some(
                    "add thickness = \"200 mm\" with modulus and width; or mass = \"3 t\", that of one panel, instead".into(),
                );
                return None;
            };
            // Its faults are noted where the strut is read.
            let thickness = reader.quietly(|reader| reader.positive(&field, Dimension::Length));
            Some(Some(Mass::Surface(own? * thickness?)))
        }
        (None, None) => Some(None),
    }
}

/// Yielding as a table of corners says.
fn by_hinge(reader: &mut Reader<'_>, field: &Field<'_>, stiffness: f64) -> Option<Hysteresis> {
    // A fault of one is that of all.
    let (sections, initial) = (&[Section::LinkHinge], Some(stiffness));
    let spring = read_spring(reader, field, sections, initial, Dimension::Force)?;
    match spring.in_compression() {
        Ok(compression) => Some(compression),
        Err(fault) => {
            *reader.bad(field, fault.problem) = Some(
                "set rule = \"pinched\" with pinching, or leave hinge out: struts then stay elastic"
                    .into(),
            );
            None
        }
    }
}

/// Modulus, thickness and width; all three are needed.
fn wall(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Wall> {
    let mut needed = |key, example: &str| {
        let Some(field) = reader.get(view, key) else {
            let remedy = format!("add {key} = {example}; or stiffness, that of one strut, instead");
            reader.missing(view, key, remedy);
            return None;
        };
        Some(field)
    };
    let fields = [
        needed("modulus", "\"4 GPa\""),
        needed("thickness", "\"200 mm\""),
        needed(
            "width",
            "\"mainstone\", or \"1.2 m\", that of the strut across its axis",
        ),
    ];
    let [modulus, thickness, width] = fields;
    let modulus = modulus.and_then(|field| reader.positive(&field, Dimension::Modulus));
    let thickness = thickness.and_then(|field| reader.positive(&field, Dimension::Length));
    let width = width.and_then(|field| {
        let is_word = field.as_text().is_some_and(|text| {
            !text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        });
        if !is_word {
            return reader
                .positive(&field, Dimension::Length)
                .map(Width::Stated);
        }
        let word = reader.choice(&field, STRUT_WIDTHS, &[])?;
        let named = StrutWidth::NAMED
            .into_iter()
            .find(|(name, _)| *name == word);
        named.map(|(_, rule)| Width::Rule(rule))
    });
    Some(Wall {
        modulus: modulus?,
        thickness: thickness?,
        width: width?,
    })
}

fn refuse_beside_stiffness(reader: &mut Reader<'_>, view: &View<'_>) {
    let remedy = "leave out stiffness, or modulus, thickness and width: it is their product over the diagonal of the bay";
    for key in ["modulus", "thickness", "width"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "and stiffness are both given") = Some(remedy.into());
            return;
        }
    }
    for key in ["strength", "force"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "needs the size of the panel, and stiffness is given") = Some(
                "give modulus, thickness and width instead of stiffness; or hinge with the corners of the strut".into(),
            );
            return;
        }
    }
}

/// Keys that mean nothing without a strength, or beside corners that are stated.
fn refuse_without_strength(reader: &mut Reader<'_>, view: &View<'_>, has_strength: bool) {
    let backbone = reader.get(view, "backbone");
    if let (Some(field), false) = (&backbone, has_strength) {
        *reader.bad(field, "needs a strength") = Some(
            "add strength = { rule = \"bertoldi\", compression = \"4 MPa\", shear = \"0.3 MPa\", sliding = \"0.2 MPa\" }, or force = \"200 kN\"".into(),
        );
    }
    if let (Some(field), true) = (reader.get(view, "hinge"), has_strength) {
        *reader.bad(&field, "and strength or force are both given") =
            Some("leave out one of them: hinge states all corners, strength finds them".into());
    }
}

/// Openings of a panel.
struct Opening {
    /// What they leave of stiffness and strength \[–\].
    left: f64,
    /// Their share of the area, as far as it is stated \[–\].
    open: f64,
}

fn opening(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Opening> {
    let Some(field) = reader.get(view, "opening") else {
        return Some(Opening {
            left: 1.0,
            open: 0.0,
        });
    };
    let (left, open) = if matches!(field.node.value, Value::Table(_)) {
        let opened = reader.open(&field, &[Section::InfillOpening])?;
        let [length, area] = ["length", "area"].map(|key| {
            let Some(field) = reader.get(&opened, key) else {
                reader.missing(
                    &opened,
                    key,
                    format!("add {key} = 0.2, a share of the panel"),
                );
                return None;
            };
            share_of(reader, &field)
        });
        (left_by_area(area?, length?), area?)
    } else {
        (left_by_length(share_of(reader, &field)?), 0.0)
    };
    if left > 0.0 {
        return Some(Opening { left, open });
    }
    *reader.bad(&field, "leaves no strut in the panel") =
        Some("leave the panel out where openings take two thirds of its length or more".into());
    None
}

/// Strengths of masonry, or that of one strut; `None` without either, and nothing inside after a fault.
fn strength(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Option<Strength>> {
    let (table, force) = (reader.get(view, "strength"), reader.get(view, "force"));
    match (table, force) {
        (None, None) => None,
        (Some(_), Some(force)) => {
            *reader.bad(&force, "and strength are both given") =
                Some("leave out one of them".into());
            Some(None)
        }
        (None, Some(force)) => {
            let force = reader.positive(&force, Dimension::Force);
            Some(force.map(Strength::Stated))
        }
        (Some(table), None) => Some(strength_of_masonry(reader, &table)),
    }
}

fn strength_of_masonry(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Strength> {
    let view = reader.open(field, &[Section::InfillStrength])?;
    let rule = match reader.get(&view, "rule") {
        Some(field) => reader.choice(&field, PANEL_STRENGTHS, &[]),
        None => {
            reader.missing(&view, "rule", "add rule = \"bertoldi\" or \"sliding\"");
            None
        }
    };
    let vertical_stress = match reader.get(&view, "vertical_stress") {
        Some(field) => match reader.quantity(&field, Dimension::Stress)? {
            stress if stress >= 0.0 => stress,
            _ => {
                reader.bad(&field, "must not be negative");
                return None;
            }
        },
        None => 0.0,
    };
    let mut needed = |key, example: &str| match reader.get(&view, key) {
        Some(field) => reader.positive(&field, Dimension::Stress),
        None => {
            reader.missing(&view, key, format!("add {key} = {example}"));
            None
        }
    };
    let sliding = needed("sliding", "\"0.2 MPa\"");
    if rule? == "sliding" {
        for key in ["compression", "shear"] {
            if let Some(field) = reader.get(&view, key) {
                *reader.bad(&field, "is for rule = \"bertoldi\"") = Some("leave it out".into());
            }
        }
        return Some(Strength::Sliding {
            sliding: sliding?,
            vertical_stress,
        });
    }
    let compression = needed("compression", "\"4 MPa\"");
    let shear = needed("shear", "\"0.3 MPa\"");
    Some(Strength::Bertoldi(Masonry {
        compression: compression?,
        shear: shear?,
        sliding: sliding?,
        vertical_stress,
    }))
}

/// The curve of first loading; the modulus of the masonry is that of the panel.
fn curve(reader: &mut Reader<'_>, view: &View<'_>, modulus: Option<f64>) -> Option<PanelCurve> {
    let Some(field) = reader.get(view, "backbone") else {
        return Some(PanelCurve::Bertoldi);
    };
    if field.as_text().is_some() {
        return match reader.choice(&field, PANEL_CURVES, &[])? {
            "bertoldi" => Some(PanelCurve::Bertoldi),
            _ => {
                *reader.bad(&field, "needs a softening and a residual of its own") = Some(
                    "write backbone = { rule = \"panagiotakos-fardis\", softening = 0.05, residual = 0.1 }".into(),
                );
                None
            }
        };
    }
    let view = reader.open(&field, &[Section::InfillBackbone])?;
    let rule = match reader.get(&view, "rule") {
        Some(field) => reader.choice(&field, PANEL_CURVES, &[]),
        None => {
            reader.missing(
                &view,
                "rule",
                "add rule = \"bertoldi\" or \"panagiotakos-fardis\"",
            );
            None
        }
    };
    let shear_modulus = reader
        .get(&view, "shear_modulus")
        .map(|field| reader.positive(&field, Dimension::Modulus));
    let [softening, residual] = ["softening", "residual"].map(|key| {
        let field = reader.get(&view, key)?;
        share_of(reader, &field)
    });
    match rule? {
        "bertoldi" => {
            for key in ["shear_modulus", "softening", "residual"] {
                if let Some(field) = reader.get(&view, key) {
                    *reader.bad(&field, "is for rule = \"panagiotakos-fardis\"") =
                        Some("leave it out".into());
                }
            }
            Some(PanelCurve::Bertoldi)
        }
        _ => {
            for (key, example) in [("softening", 0.05), ("residual", 0.1)] {
                if !view.has(key) {
                    reader.missing(&view, key, format!("add {key} = {example}"));
                }
            }
            Some(PanelCurve::PanagiotakosFardis {
                shear_modulus: match shear_modulus {
                    Some(stated) => stated?,
                    None => 0.4 * modulus?,
                },
                softening: softening?,
                residual: residual?,
            })
        }
    }
}

/// A number of at least 0 and less than 1.
fn share_of(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    let value = reader.quantity(field, Dimension::Dimensionless)?;
    if (0.0..1.0).contains(&value) {
        return Some(value);
    }
    reader.bad(
        field,
        format!("must be a share, at least 0 and less than 1; found {value}"),
    );
    None
}
