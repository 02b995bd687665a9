//! Stiffness of the sections of a text model: from the numbers of the file, from sizes, or from a catalogue.

use std::f64::consts::PI;

use jostle_section::{Axis, Profile};

use crate::member::{Member, SectionFacts, TextModel};

/// EA, GA along 2 and 3, GJ, EI about 2 and 3 \[N, N·m²\].
pub(crate) type Rigidity = [f64; 6];

/// Why a section has no stiffness, and what helps.
pub(crate) type Lack = (String, &'static str);

/// Remedy for what the file does not say in numbers.
const BY_NUMBERS: &str = "export the model with numbers for this section, or take the stiffness from results: unit loads on every diaphragm, as the how-to on ETABS has it";

/// Rigidities of a member.
///
/// # Errors
/// A section or material without numbers.
pub(crate) fn rigidity(member: &Member, model: &TextModel) -> Result<Rigidity, Lack> {
    let name = &member.section;
    let Some(section) = model.sections.get(name).filter(|_| !name.is_empty()) else {
        return Err((
            format!("has the section \"{name}\", which the file does not define"),
            "assign a section and export the whole model again",
        ));
    };
    let Some([modulus, poisson]) = model
        .materials
        .get(&section.material)
        .copied()
        .filter(|material| material[0] > 0.0)
    else {
        return Err((
            format!(
                "has the material \"{}\", which has no modulus of elasticity",
                section.material
            ),
            "export the whole model again, with its materials",
        ));
    };
    let numbers = numbers(name, section)?;
    let shear = modulus / (2.0 * (1.0 + poisson));
    let moduli = [modulus, shear, shear, shear, modulus, modulus];
    Ok([0, 1, 2, 3, 4, 5].map(|index| moduli[index] * section.factors[index] * numbers[index]))
}

/// The six numbers of a section.
fn numbers(name: &str, section: &SectionFacts) -> Result<[f64; 6], Lack> {
    let shape = section.shape.as_str();
    let by_shape = by_size(section).or_else(|| Profile::named(shape).as_ref().map(of_profile));
    let by_shape = by_shape.or_else(|| Profile::named(name).as_ref().map(of_profile));
    let mut found = [0.0; 6];
    for (index, value) in found.iter_mut().enumerate() {
        let number = section.stated[index].or_else(|| by_shape.map(|numbers| numbers[index]));
        // No shear area: no deformation by shear.
        let number = number.or((index == 1 || index == 2).then_some(0.0));
        *value = number.filter(|number| *number >= 0.0).ok_or_else(|| match shape {
            _ if shape.contains("Auto Select") => (
                format!("has the auto-select list \"{name}\": its section is chosen in design"),
                "assign the chosen sections in the source and export again",
            ),
            _ => (
                format!("has the section \"{name}\" of shape \"{shape}\", of which the file has neither sizes nor area, and which is no profile that jostle knows"),
                BY_NUMBERS,
            ),
        })?;
    }
    if found[0] == 0.0 {
        return Err((
            format!("has the section \"{name}\" without area"),
            BY_NUMBERS,
        ));
    }
    Ok(found)
}

/// By the sizes of a known shape.
fn by_size(section: &SectionFacts) -> Option<[f64; 6]> {
    let [depth, width] = section.size;
    let [flange, web] = section.plates;
    let depth = depth?;
    let shape = section.shape.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| shape.contains(word));
    if has(&["rectangular"]) {
        return Some(rectangle(depth, width?));
    }
    if has(&["circle"]) {
        let (area, inertia) = (PI * depth * depth / 4.0, PI * depth.powi(4) / 64.0);
        return Some([
            area,
            0.9 * area,
            0.9 * area,
            2.0 * inertia,
            inertia,
            inertia,
        ]);
    }
    if has(&["pipe"]) {
        let inside = depth - 2.0 * web?;
        let area = PI * (depth * depth - inside * inside) / 4.0;
        let inertia = PI * (depth.powi(4) - inside.powi(4)) / 64.0;
        return Some([
            area,
            0.5 * area,
            0.5 * area,
            2.0 * inertia,
            inertia,
            inertia,
        ]);
    }
    let (width, flange, web) = (width?, flange?, web?);
    if has(&["box", "tube"]) {
        let clear = [depth - 2.0 * flange, width - 2.0 * web];
        let inertia = |a: f64, b: f64, [c, d]: [f64; 2]| (b * a.powi(3) - d * c.powi(3)) / 12.0;
        let middle = [depth - flange, width - web];
        // Bredt: the area that the middle line encloses, over its length by thickness.
        let torsion = 4.0 * (middle[0] * middle[1]).powi(2)
            / (2.0 * middle[0] / web + 2.0 * middle[1] / flange);
        return Some([
            depth * width - clear[0] * clear[1],
            2.0 * depth * web,
            2.0 * width * flange,
            torsion,
            inertia(width, depth, [clear[1], clear[0]]),
            inertia(depth, width, clear),
        ]);
    }
    has(&["i/wide flange"]).then(|| i_shape([depth, width], [flange, web]))
}

/// Numbers of a filled rectangle; torsion by Roark's formula.
fn rectangle(depth: f64, width: f64) -> [f64; 6] {
    let area = depth * width;
    let (long, short) = (depth.max(width), depth.min(width));
    let ratio = short / long;
    let torsion = long * short.powi(3) * (1.0 / 3.0 - 0.21 * ratio * (1.0 - ratio.powi(4) / 12.0));
    [
        area,
        5.0 / 6.0 * area,
        5.0 / 6.0 * area,
        torsion,
        depth * width.powi(3) / 12.0,
        width * depth.powi(3) / 12.0,
    ]
}

/// Numbers of two equal flanges and a web.
fn i_shape([depth, width]: [f64; 2], [flange, web]: [f64; 2]) -> [f64; 6] {
    let clear = depth - 2.0 * flange;
    [
        2.0 * width * flange + clear * web,
        depth * web,
        5.0 / 3.0 * width * flange,
        (2.0 * width * flange.powi(3) + clear * web.powi(3)) / 3.0,
        (2.0 * flange * width.powi(3) + clear * web.powi(3)) / 12.0,
        (width * depth.powi(3) - (width - web) * clear.powi(3)) / 12.0,
    ]
}

/// Numbers of a profile of the catalogue.
fn of_profile(profile: &Profile) -> [f64; 6] {
    let [strong, weak] = [Axis::Strong, Axis::Weak].map(|axis| profile.inertia(axis));
    [
        profile.area(),
        profile.shear_area(Axis::Strong),
        profile.shear_area(Axis::Weak),
        profile.torsion_constant(),
        weak,
        strong,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(shape: &str, size: [f64; 2], plates: [f64; 2]) -> SectionFacts {
        SectionFacts {
            shape: shape.into(),
            size: size.map(Some),
            plates: plates.map(Some),
            ..SectionFacts::default()
        }
    }

    /// Thin plates, and the profiles of the catalogue without their fillets.
    #[test]
    fn shapes_against_profiles_and_thin_walls() {
        let profile = section("Steel I/Wide Flange", [0.3, 0.15], [0.0107, 0.0071]);
        let numbers = numbers("anything", &profile).unwrap();
        let ipe300 = numbers_of("IPE300");
        // IPE 300: 53.8 cm², 8356 and 604 cm⁴ with fillets.
        for (index, table) in [(0, 53.8e-4), (5, 8356e-8), (4, 604e-8)] {
            assert!((ipe300[index] / table - 1.0).abs() < 0.005, "{index}");
            assert!(
                (numbers[index] / ipe300[index] - 1.0).abs() < 0.05,
                "{index}"
            );
        }
        // A square tube of thin walls: 4 a t, 2/3 a³ t, torsion a³ t, with a between middles.
        let (a, t) = (0.2, 1e-5);
        let tube = by_size(&section("Steel Tube", [a + t, a + t], [t, t])).unwrap();
        for (index, value) in [
            (0, 4.0 * a * t),
            (3, a.powi(3) * t),
            (4, 2.0 / 3.0 * a.powi(3) * t),
        ] {
            assert!(
                (tube[index] / value - 1.0).abs() < 1e-3,
                "{index}: {}",
                tube[index]
            );
        }
        let pipe = by_size(&section("Steel Pipe", [0.2, 0.0], [0.0, 0.1])).unwrap();
        let circle = by_size(&section("Concrete Circle", [0.2, 0.0], [0.0, 0.0])).unwrap();
        assert_eq!(
            [pipe[0], pipe[3], pipe[5]],
            [circle[0], circle[3], circle[5]]
        );
        // A square: torsion 0.1406 a⁴ (Timoshenko).
        let square = by_size(&section("Concrete Rectangular", [0.5, 0.5], [0.0, 0.0])).unwrap();
        assert!((square[3] / 0.5_f64.powi(4) - 0.1406).abs() < 5e-4);
    }

    fn numbers_of(name: &str) -> [f64; 6] {
        numbers(
            name,
            &SectionFacts {
                shape: "unknown".into(),
                ..SectionFacts::default()
            },
        )
        .unwrap()
    }

    /// The numbers of the file count more than those of its shape.
    #[test]
    fn stated_numbers_hold() {
        let mut section = section("General", [0.3, 0.3], [0.0, 0.0]);
        assert!(numbers("G", &section).is_err());
        section.stated = [Some(0.01), None, None, Some(1e-6), Some(2e-6), Some(3e-6)];
        assert_eq!(
            numbers("G", &section).unwrap(),
            [0.01, 0.0, 0.0, 1e-6, 2e-6, 3e-6]
        );
        let w14 = numbers_of("W14X90");
        // 26.5 in², 999 in⁴.
        assert!((w14[0] / 0.0254_f64.powi(2) - 26.5).abs() < 0.1);
        assert!((w14[5] / 0.0254_f64.powi(4) - 999.0).abs() < 5.0);
    }
}
