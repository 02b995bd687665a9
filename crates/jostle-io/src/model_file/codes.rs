//! `[codes]`: inputs of the separation rules of codes, and those of single buildings.

use jostle::separation::{BuildingCodes, Code, CodeInputs, HazardZone, JointSystem, MotionLevel};

use crate::keys::{FLOOR_LEVELS, HAZARD_ZONES, JOINT_CODES, JOINT_SYSTEMS, MOTION_LEVELS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Reads the table of the file; `buildings` are the values of single buildings.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: Option<&Field<'_>>,
    buildings: Vec<BuildingCodes>,
) -> CodeInputs {
    let mut codes = CodeInputs {
        buildings,
        ..CodeInputs::default()
    };
    let Some(view) = field.and_then(|field| reader.open(field, &[Section::Codes])) else {
        return codes;
    };
    codes.shown = shown(reader, &view);
    let word = |reader: &mut Reader<'_>, key, words: &[&'static str]| {
        let field = reader.get(&view, key)?;
        let word = reader.choice(&field, words, &[])?;
        words.iter().position(|known| *known == word)
    };
    if let Some(index) = word(reader, "motion", MOTION_LEVELS) {
        codes.motion = MotionLevel::ALL[index];
    }
    if let Some(index) = word(reader, "system", JOINT_SYSTEMS) {
        codes.system = Some(JointSystem::ALL[index]);
    }
    if let Some(index) = word(reader, "hazard", HAZARD_ZONES) {
        codes.hazard = HazardZone::ALL[index];
    }
    codes.intensity = intensity(reader, &view);
    codes.floors_are_level = match word(reader, "floor_levels", FLOOR_LEVELS) {
        Some(1) => Some(true),
        Some(2) => Some(false),
        _ => None,
    };
    let mut positive = |key, dimension| {
        let field = reader.get(&view, key)?;
        reader.positive(&field, dimension)
    };
    codes.ground_acceleration = positive("ground_acceleration", Dimension::Acceleration);
    codes.zone_factor = positive("zone_factor", Dimension::Dimensionless);
    codes.soil_factor = positive("soil_factor", Dimension::Dimensionless);
    let of_all = factors(reader, &view);
    for building in &mut codes.buildings {
        *building = building.or(of_all);
    }
    codes
}

/// Reads the table of one building.
pub(super) fn read_building(reader: &mut Reader<'_>, field: &Field<'_>) -> BuildingCodes {
    match reader.open(field, &[Section::BuildingCodes]) {
        Some(view) => factors(reader, &view),
        None => BuildingCodes::default(),
    }
}

fn shown(reader: &mut Reader<'_>, view: &View<'_>) -> Vec<Code> {
    let Some(field) = reader.get(view, "show") else {
        return Vec::new();
    };
    let entries = field.entries().unwrap_or_else(|| vec![field]);
    let named = entries.iter().filter_map(|entry| {
        let name = reader.choice(entry, JOINT_CODES, &[])?;
        Code::named(name)
    });
    named.collect()
}

fn factors(reader: &mut Reader<'_>, view: &View<'_>) -> BuildingCodes {
    let mut factor = |key: &'static str, least: f64| {
        let field = reader.get(view, key)?;
        let value = reader.positive(&field, Dimension::Dimensionless)?;
        if value < least {
            reader.bad(&field, format!("must be at least {least}, found {value}"));
            return None;
        }
        Some(value)
    };
    let importance = factor("importance", 0.0);
    let behaviour_factor = factor("behaviour_factor", 1.0);
    let response_modification = factor("response_modification", 1.0);
    let deflection_amplification = factor("deflection_amplification", 0.0);
    let is_regular = reader
        .get(view, "regular")
        .and_then(|field| reader.flag(&field));
    BuildingCodes {
        importance,
        behaviour_factor,
        response_modification,
        deflection_amplification,
        is_regular,
    }
}

/// The only intensity of GB 50011 that is listed.
fn intensity(reader: &mut Reader<'_>, view: &View<'_>) -> Option<u32> {
    let field = reader.get(view, "intensity")?;
    let count = reader.count(&field)?;
    match count {
        6..=9 => Some(count as u32),
        _ => {
            reader.bad(&field, format!("must be 6, 7, 8 or 9, found {count}"));
            None
        }
    }
}
