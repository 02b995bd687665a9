//! `[soil]` and `[building.foundation]`: rigid foundations on springs and dashpots of the soil.

use jostle::{BearingStrength, Foundation, GroundSprings, HalfSpace, Soil, SoilCoupling, Uplift};

use super::building::or_rigid;
use crate::keys::{SOIL_COUPLINGS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Most rows of a matrix of foundations.
const MOST_ROWS: usize = 200;

/// Reads the foundation of a building; `None` after a fault, or if it has none.
pub(super) fn read_foundation(reader: &mut Reader<'_>, building: &View<'_>) -> Option<Foundation> {
    let field = reader.get(building, "foundation")?;
    for (key, remedy) in [
        ("base", "the soil is the base; leave out base"),
        (
            "isolation",
            "bearings on a foundation that sways and rocks are not possible yet; leave out one of them",
        ),
    ] {
        if let Some(other) = reader.get(building, key) {
            *reader.bad(&other, "cannot be combined with foundation") = Some(remedy.into());
        }
    }
    let view = reader.open(&field, &[Section::Foundation])?;
    let length = reader.needed_quantity(&view, "length", Dimension::Length, "\"12 m\"");
    let width = reader.needed_quantity(&view, "width", Dimension::Length, "\"12 m\"");
    let mass = reader.needed_quantity(&view, "mass", Dimension::Mass, "\"120 t\"");
    let embedment = reader.quantity_at(&view, "embedment", Dimension::Length);
    let rotary_inertia = reader.quantity_at(&view, "rotary_inertia", Dimension::PolarMass);
    let uplift = read_uplift(reader, &view)?;
    let torsion = reader.quantity_at(&view, "torsional_stiffness", Dimension::RotationalStiffness);
    let torsional_damping =
        reader.quantity_at(&view, "torsional_damping", Dimension::RotationalDamping);
    let plate = Foundation::rectangle(length?, width?, mass?);
    Some(Foundation {
        uplift,
        torsional_stiffness: torsion,
        torsional_damping,
        embedment: embedment.unwrap_or(0.0),
        rotary_inertia: rotary_inertia.unwrap_or(plate.rotary_inertia),
        ..plate
    })
}

/// Keys of foundations that lift off, each with one without which it has no effect.
const OF_UPLIFT: [(&str, Option<&str>); 9] = [
    ("springs", None),
    ("springs_across", None),
    ("ends", None),
    ("vertical_stiffness", None),
    ("bearing_strength", None),
    ("vertical_damping", Some("vertical_stiffness")),
    ("sway_stiffness", Some("vertical_stiffness")),
    ("sway_damping", Some("sway_stiffness")),
    ("bearing_hardening", Some("bearing_strength")),
];

/// Reads how a foundation lifts off, if it does; `None` after a fault.
fn read_uplift(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Option<Uplift>> {
    let field = reader.get(view, "uplift");
    let lifts = field.is_some_and(|field| reader.flag(&field).unwrap_or(false));
    for (key, with) in OF_UPLIFT {
        let missing = match with {
            _ if !lifts => Some("uplift = true"),
            Some(with) if !view.has(with) => Some(with),
            _ => None,
        };
        if let (Some(missing), Some(field)) = (missing, reader.get(view, key)) {
            *reader.bad(&field, format!("has no effect without {missing}")) =
                Some(format!("add {missing}, or leave {key} out"));
            return None;
        }
    }
    if !lifts {
        return Some(None);
    }
    let springs = match reader.get(view, "springs") {
        Some(field) => reader.count(&field)?,
        None => {
            let remedy = "add springs = 11, along its length; 2 is the fewest";
            reader.missing(view, "springs", remedy);
            return None;
        }
    };
    let springs_across = match reader.get(view, "springs_across") {
        Some(field) => Some(reader.count(&field)?),
        None => None,
    };
    let number = |reader: &mut Reader<'_>, key, dimension| reader.quantity_at(view, key, dimension);
    let vertical = number(reader, "vertical_stiffness", Dimension::Stiffness);
    let sway = or_rigid(reader, view, "sway_stiffness", Dimension::Stiffness);
    let damping = ["vertical_damping", "sway_damping"]
        .map(|key| number(reader, key, Dimension::Damping).unwrap_or(0.0));
    let strength = number(reader, "bearing_strength", Dimension::Stress);
    let hardening = number(reader, "bearing_hardening", Dimension::Dimensionless);
    Some(Some(Uplift {
        springs,
        springs_across,
        ends: number(reader, "ends", Dimension::Dimensionless),
        ground: vertical.map(|vertical_stiffness| GroundSprings {
            vertical_stiffness,
            vertical_damping: damping[0],
            sway: sway.map(|stiffness| [stiffness, damping[1]]),
        }),
        bearing: strength.map(|strength| BearingStrength {
            strength,
            hardening: hardening.unwrap_or(0.0),
        }),
    }))
}

/// Reads the soil; `None` after a fault.
pub(super) fn read(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Soil> {
    let view = reader.open(field, &[Section::Soil])?;
    let coupling = match reader.get(&view, "coupling") {
        Some(field) => coupling(reader, &field),
        None => Some(SoilCoupling::None),
    };
    // Matrices need no half-space; what describes one has no effect beside them.
    if matches!(coupling, Some(SoilCoupling::Given { .. })) {
        for key in ["shear_wave_velocity", "density", "poisson_ratio"] {
            if let Some(field) = reader.get(&view, key) {
                *reader.bad(&field, "has no effect where coupling gives matrices") = Some(
                    "leave out shear_wave_velocity, density and poisson_ratio, or coupling".into(),
                );
                break;
            }
        }
        if let Some(field) = reader.get(&view, "damping") {
            *reader.bad(&field, "has no effect where coupling gives matrices") =
                Some("put it into the matrix damping; leave it out here".into());
        }
        return Some(Soil {
            half_space: None,
            coupling: coupling?,
        });
    }
    let velocity = reader.needed_quantity(
        &view,
        "shear_wave_velocity",
        Dimension::Speed,
        "\"200 m/s\"",
    );
    let density = reader.needed_quantity(&view, "density", Dimension::Density, "\"1800 kg/m3\"");
    let ratio = reader.needed_quantity(&view, "poisson_ratio", Dimension::Dimensionless, "0.33");
    let damping = reader.quantity_at(&view, "damping", Dimension::Dimensionless);
    Some(Soil {
        half_space: Some(HalfSpace {
            shear_wave_velocity: velocity?,
            density: density?,
            poisson_ratio: ratio?,
            damping: damping.unwrap_or(0.0),
        }),
        coupling: coupling?,
    })
}

fn coupling(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<SoilCoupling> {
    if !matches!(field.node.value, Value::Table(_)) {
        let word = reader.choice(field, SOIL_COUPLINGS, &[])?;
        return Some(match word {
            "static" => SoilCoupling::Static,
            _ => SoilCoupling::None,
        });
    }
    let view = reader.open(field, &[Section::SoilCoupling])?;
    let stiffness = matrix(reader, &view, "stiffness");
    let damping = matrix(reader, &view, "damping");
    Some(SoilCoupling::Given {
        stiffness: stiffness?,
        damping: damping?,
    })
}

/// A list of rows of numbers.
fn matrix(reader: &mut Reader<'_>, view: &View<'_>, key: &'static str) -> Option<Vec<Vec<f64>>> {
    let Some(field) = reader.get(view, key) else {
        reader.missing(
            view,
            key,
            format!("add {key} = [[…], […]], one row for u and one for theta of every foundation"),
        );
        return None;
    };
    let rows = field.entries().filter(|rows| rows.len() <= MOST_ROWS);
    let Some(rows) = rows else {
        *reader.bad(&field, "expected a list of rows of numbers") = Some(format!(
            "write [[1e9, 0], [0, 5e10]], with at most {MOST_ROWS} rows"
        ));
        return None;
    };
    let mut matrix = Vec::with_capacity(rows.len());
    for row in rows {
        let Some(entries) = row.entries().filter(|row| row.len() <= MOST_ROWS) else {
            *reader.bad(&row, "expected a row of numbers") = Some("write [1e9, 0]".into());
            return None;
        };
        let values: Vec<Option<f64>> = entries
            .iter()
            .map(|entry| reader.quantity(entry, Dimension::Dimensionless))
            .collect();
        matrix.push(values.into_iter().collect::<Option<Vec<f64>>>()?);
    }
    Some(matrix)
}
