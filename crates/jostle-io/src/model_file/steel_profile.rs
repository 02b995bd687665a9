//! Columns and beams of rolled or welded steel: `profile`.

use jostle::{Section, SpaceSection};
use jostle_section::capacity;
use jostle_section::{Axis, ISection, Profile, STEEL_DENSITY, STEEL_MODULUS};

use super::section::Material;
use crate::keys::{AXES, Section as KeySection};
use crate::nearest::nearest;
use crate::quantity::{Dimension, shorten};
use crate::reader::{Field, Reader, View};

/// A member of steel.
#[derive(Clone, Copy)]
pub(super) struct SteelMember {
    pub(super) profile: Profile,
    /// The axis about which it bends or buckles.
    pub(super) axis: Axis,
    /// Modulus of elasticity of its steel \[Pa\].
    pub(super) modulus: f64,
}

/// A steel profile by its name or its sizes. Its modulus is that of steel unless the building states one in numbers.
pub(super) fn read(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    field: &Field<'_>,
    material: Material,
) -> Option<Section> {
    let axis = axis_of(reader, view)?.unwrap_or(Axis::Strong);
    let (profile, modulus) = named_or_sized(reader, field)?;
    let modulus = material
        .modulus
        .filter(|_| material.modulus_is_stated)
        .unwrap_or(modulus);
    let shears = material.shears;
    Some(Section {
        flexural_rigidity: modulus * profile.inertia(axis),
        axial_rigidity: Some(modulus * profile.area()),
        shear_rigidity: shears
            .then(|| profile.shear_area(axis) * modulus / (2.0 * (1.0 + STEEL_POISSON))),
        line_mass: STEEL_DENSITY * profile.area(),
    })
}

/// A steel profile of a space frame. `modulus`: that which the file states in numbers, else it is that of steel. The axis is that about
/// which a column bends along x, and a beam in its vertical plane. `is_column`: which of its sizes is the first.
pub(super) fn read_in_space(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    field: &Field<'_>,
    modulus: Option<f64>,
    shears: bool,
    is_column: bool,
) -> Option<SpaceSection> {
    let axis = axis_of(reader, view)?.unwrap_or(Axis::Strong);
    let axes = match axis {
        Axis::Strong => [Axis::Strong, Axis::Weak],
        Axis::Weak => [Axis::Weak, Axis::Strong],
    };
    let (profile, of_steel) = named_or_sized(reader, field)?;
    let modulus = modulus.unwrap_or(of_steel);
    let shear_modulus = modulus / (2.0 * (1.0 + STEEL_POISSON));
    let [first, second] = axes.map(|axis| profile.depth(axis));
    Some(SpaceSection {
        size: if is_column {
            [first, second]
        } else {
            [second, first]
        },
        flexural_rigidity: axes.map(|axis| modulus * profile.inertia(axis)),
        torsional_rigidity: shear_modulus * profile.torsion_constant(),
        axial_rigidity: Some(modulus * profile.area()),
        shear_rigidity: shears.then(|| axes.map(|axis| shear_modulus * profile.shear_area(axis))),
        line_mass: STEEL_DENSITY * profile.area(),
    })
}

/// Size of a profile in the direction of bending \[m\].
pub(super) fn depth(reader: &mut Reader<'_>, view: &View<'_>, field: &Field<'_>) -> Option<f64> {
    let (profile, _) = named_or_sized(reader, field)?;
    Some(profile.depth(axis_of(reader, view)?.unwrap_or(Axis::Strong)))
}

/// The profile of a brace, with the axis about which it buckles.
pub(super) fn of_brace(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    field: &Field<'_>,
) -> Option<SteelMember> {
    let axis = axis_of(reader, view)?.unwrap_or(Axis::Weak);
    let (profile, modulus) = named_or_sized(reader, field)?;
    Some(SteelMember {
        profile,
        axis,
        modulus,
    })
}

/// Profile and yield strength of a column or beam; `None` without a strength. Faults of other keys are noted where the section is read.
pub(super) fn strength_of(
    reader: &mut Reader<'_>,
    view: &View<'_>,
) -> Option<capacity::SteelMember> {
    let field = reader.get(view, "yield_strength")?;
    let Some(profile) = reader.get(view, "profile") else {
        *reader.bad(&field, "is for a profile") =
            Some("add profile = \"HEB300\", or leave it out; steel is the steel of bars".into());
        return None;
    };
    let yield_strength = reader.positive(&field, Dimension::Stress)?;
    reader.quietly(|reader| {
        let axis = axis_of(reader, view)?.unwrap_or(Axis::Strong);
        let (profile, modulus) = named_or_sized(reader, &profile)?;
        Some(capacity::SteelMember {
            profile,
            axis,
            yield_strength,
            modulus,
        })
    })
}

/// The axis, if one is given; `None` after a fault.
fn axis_of(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Option<Axis>> {
    Some(match reader.get(view, "axis") {
        Some(field) => match reader.choice(&field, AXES, &[])? {
            "weak" => Some(Axis::Weak),
            _ => Some(Axis::Strong),
        },
        None => None,
    })
}

/// The profile, and the modulus of its steel.
fn named_or_sized(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<(Profile, f64)> {
    if let Some(name) = field.as_text() {
        let Some(profile) = Profile::named(name) else {
            let plain = name.to_uppercase().replace(' ', "");
            let remedy = nearest(&plain, Profile::names())
                .map_or_else(|| "give its sizes: profile = { depth = \"310 mm\", width = \"205 mm\", web = \"9.4 mm\", flange = \"16.3 mm\" }".to_owned(), |name| format!("did you mean \"{name}\"? Others by sizes: profile = {{ depth = \"310 mm\", width = \"205 mm\", web = \"9.4 mm\", flange = \"16.3 mm\" }}"));
            let problem = format!(
                "\"{}\" is not known; available: IPE80 to IPE600, HEA100 to HEA1000, HEB100 to HEB1000, W shapes such as W14X90, tubes such as HSS8X6X3/8 and HSS6.625X0.280",
                shorten(name)
            );
            *reader.bad(field, problem) = Some(remedy);
            return None;
        };
        Some((profile, Profile::modulus_of(name)))
    } else {
        let sizes = reader.open(field, &[KeySection::Profile])?;
        let mut size = |key: &'static str, example: &str| match reader.get(&sizes, key) {
            Some(field) => reader.positive(&field, Dimension::Length),
            None => {
                reader.missing(&sizes, key, format!("add {key} = {example}"));
                None
            }
        };
        let [depth, width] = [size("depth", "\"310 mm\""), size("width", "\"205 mm\"")];
        let [web, flange] = [size("web", "\"9.4 mm\""), size("flange", "\"16.3 mm\"")];
        let radius = match reader.get(&sizes, "radius") {
            Some(field) => reader.positive(&field, Dimension::Length)?,
            None => 0.0,
        };
        let section = ISection {
            depth: depth?,
            width: width?,
            web: web?,
            flange: flange?,
            radius,
        };
        if let Some(fault) = section.fault() {
            *reader.bad(field, fault) = Some("check the sizes and their units".into());
            return None;
        }
        Some((Profile::I(section), STEEL_MODULUS))
    }
}

/// ν of steel (EN 1993-1-1, 3.2.6) \[–\].
const STEEL_POISSON: f64 = 0.3;
