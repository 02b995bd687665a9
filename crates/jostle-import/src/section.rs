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

/// Rigidities of a member about its principal axes, and the turn of these from its local axes \[degrees\].
///
/// # Errors
/// A section or material without numbers.
pub(crate) fn rigidity(member: &Member, model: &TextModel) -> Result<(Rigidity, f64), Lack> {
    let name = &member.section;
    let Some(section) = model.sections.get(name).filter(|_| !name.is_empty()) else {
        return Err((
            format!("has the section \"{name}\", which the file does not define"),
            "assign a section and export the whole model again",
        ));
    };
    let moduli = moduli(member.material(section), model)?;
    let numbers = numbers(name, section)?;
    let mut rigidity: Rigidity = std::array::from_fn(|index| moduli[index] * numbers[index]);
    if let Some((fill, inside)) = filled(name, section)? {
        let moduli = self::moduli(fill, model)?;
        for (index, value) in rigidity.iter_mut().enumerate() {
            *value += moduli[index] * inside[index];
        }
    }
    let factors = member.factors_with(section);
    for (value, factor) in rigidity.iter_mut().zip(factors) {
        *value *= factor;
    }
    if section.product == 0.0 {
        return Ok((rigidity, 0.0));
    }
    if factors[4] != factors[5] {
        return Err((
            format!(
                "has the section \"{name}\" with a product of inertia I23 and different factors on I22 and I33"
            ),
            BY_NUMBERS,
        ));
    }
    Ok(principal(
        rigidity,
        factors[4] * moduli[4] * section.product,
    ))
}

/// Rigidities about principal axes, by the product of inertia times the modulus, and the turn of these axes \[degrees\].
///
/// Displacements v along 2 and w along 3 bend by [EI33 EI23; EI23 EI22] over (v'', w''), which is diagonal in axes that are turned by
/// half the angle of tan = 2 I23/(I33 − I22).
fn principal(mut rigidity: Rigidity, product: f64) -> (Rigidity, f64) {
    let [_, shear_2, shear_3, _, weak, strong] = rigidity;
    let (mean, half) = (0.5 * (strong + weak), 0.5 * (strong - weak));
    let radius = half.hypot(product);
    let turn = 0.5 * product.atan2(half);
    let (sin, cos) = turn.sin_cos();
    rigidity[4] = mean - radius;
    rigidity[5] = mean + radius;
    // Without shear areas there is no deformation by shear.
    if shear_2 > 0.0 && shear_3 > 0.0 {
        rigidity[1] = cos * cos * shear_2 + sin * sin * shear_3;
        rigidity[2] = sin * sin * shear_2 + cos * cos * shear_3;
    }
    (rigidity, turn.to_degrees())
}

/// Moduli that belong to the six numbers of a section \[Pa\].
fn moduli(name: &str, model: &TextModel) -> Result<[f64; 6], Lack> {
    let material = model.materials.get(name).copied();
    let Some([modulus, poisson]) = material.filter(|material| material[0] > 0.0) else {
        return Err((
            format!("has the material \"{name}\", which has no modulus of elasticity"),
            "export the whole model again, with its materials",
        ));
    };
    let shear = modulus / (2.0 * (1.0 + poisson));
    Ok([modulus, shear, shear, shear, modulus, modulus])
}

/// Material and numbers of what fills a steel tube or pipe; steel and filling turn and sway together.
fn filled<'a>(name: &str, section: &'a SectionFacts) -> Result<Option<(&'a str, [f64; 6])>, Lack> {
    let shape = Shape::named(&section.shape);
    if !matches!(shape, Some(Shape::Tube | Shape::Pipe)) || !is_filled(&section.shape) {
        return Ok(None);
    }
    let inside = match (shape, section.size, section.plates) {
        (Some(Shape::Pipe), [Some(depth), _], [_, Some(wall)]) => Some(circle(depth - 2.0 * wall)),
        (Some(Shape::Tube), [Some(depth), Some(width)], [Some(flange), Some(web)]) => {
            Some(rectangle(depth - 2.0 * flange, width - 2.0 * web))
        }
        _ => None,
    };
    match (section.fill.as_deref(), inside) {
        (Some(fill), Some(inside)) => Ok(Some((fill, inside))),
        _ => Err((
            format!(
                "has the section \"{name}\" of shape \"{}\" without its sizes or FILLMATERIAL",
                section.shape
            ),
            BY_NUMBERS,
        )),
    }
}

fn is_filled(shape: &str) -> bool {
    shape.to_lowercase().starts_with("filled")
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
            _ if shape.contains("Encasement") => (
                format!("has the section \"{name}\" of shape \"{shape}\": a profile in concrete, whose concrete jostle does not add to its steel"),
                BY_NUMBERS,
            ),
            _ if section.size[0].is_some() && Shape::named(shape).is_none() => (
                format!("has the section \"{name}\" of shape \"{shape}\", which jostle cannot compute from its sizes"),
                BY_NUMBERS,
            ),
            _ if section.size[0].is_some() => (
                format!("has the section \"{name}\" of shape \"{shape}\", of which the file does not have all sizes"),
                BY_NUMBERS,
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

/// Shapes whose numbers follow from their sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    Rectangle,
    Circle,
    Pipe,
    Tube,
    I,
}

impl Shape {
    /// By the whole name: shapes with similar names, such as encased profiles, are other shapes.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name.to_lowercase().as_str() {
            "concrete rectangular" | "rectangular" => Self::Rectangle,
            "concrete circle" | "circle" => Self::Circle,
            "steel pipe" | "concrete pipe" | "pipe" | "filled steel pipe" => Self::Pipe,
            "steel tube" | "concrete tube" | "box/tube" | "tube" | "filled steel tube" => {
                Self::Tube
            }
            "steel i/wide flange" | "i/wide flange" => Self::I,
            _ => return None,
        })
    }
}

/// By the sizes of a known shape.
fn by_size(section: &SectionFacts) -> Option<[f64; 6]> {
    let [depth, width] = section.size;
    let [flange, web] = section.plates;
    let depth = depth?;
    let shape = Shape::named(&section.shape)?;
    match shape {
        Shape::Rectangle => return Some(rectangle(depth, width?)),
        Shape::Circle => return Some(circle(depth)),
        Shape::Pipe => {
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
        Shape::Tube | Shape::I => {}
    }
    let (width, flange, web) = (width?, flange?, web?);
    if shape == Shape::I {
        let bottom = [
            section.bottom[0].unwrap_or(width),
            section.bottom[1].unwrap_or(flange),
        ];
        return Some(i_shape(depth, [width, flange], bottom, web));
    }
    let clear = [depth - 2.0 * flange, width - 2.0 * web];
    let inertia = |a: f64, b: f64, [c, d]: [f64; 2]| (b * a.powi(3) - d * c.powi(3)) / 12.0;
    let middle = [depth - flange, width - web];
    // Bredt: the area that the middle line encloses, over its length by thickness.
    let torsion =
        4.0 * (middle[0] * middle[1]).powi(2) / (2.0 * middle[0] / web + 2.0 * middle[1] / flange);
    Some([
        depth * width - clear[0] * clear[1],
        2.0 * depth * web,
        2.0 * width * flange,
        torsion,
        inertia(width, depth, [clear[1], clear[0]]),
        inertia(depth, width, clear),
    ])
}

/// Numbers of a filled circle.
fn circle(diameter: f64) -> [f64; 6] {
    let area = PI * diameter * diameter / 4.0;
    let inertia = PI * diameter.powi(4) / 64.0;
    [
        area,
        0.9 * area,
        0.9 * area,
        2.0 * inertia,
        inertia,
        inertia,
    ]
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

/// Numbers of two flanges, each of a width and a thickness, and a web.
fn i_shape(depth: f64, top: [f64; 2], bottom: [f64; 2], web: f64) -> [f64; 6] {
    let clear = depth - top[1] - bottom[1];
    // Width along axis 3, height, and height of the middle above the lower edge.
    let parts = [
        [top[0], top[1], depth - 0.5 * top[1]],
        [bottom[0], bottom[1], 0.5 * bottom[1]],
        [web, clear, bottom[1] + 0.5 * clear],
    ];
    let sum = |of: &dyn Fn(&[f64; 3]) -> f64| parts.iter().map(of).sum::<f64>();
    let area = sum(&|[width, height, _]| width * height);
    let centre = sum(&|[width, height, at]| width * height * at) / area;
    [
        area,
        depth * web,
        5.0 / 6.0 * (top[0] * top[1] + bottom[0] * bottom[1]),
        (top[0] * top[1].powi(3) + bottom[0] * bottom[1].powi(3) + clear * web.powi(3)) / 3.0,
        sum(&|[width, height, _]| height * width.powi(3) / 12.0),
        sum(&|[width, height, at]| {
            width * height.powi(3) / 12.0 + width * height * (at - centre).powi(2)
        }),
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
        // An unequal I by its three rectangles (second moments about the lower edge, less A y²).
        let mut unequal = section("Steel I/Wide Flange", [0.4, 0.3], [0.02, 0.012]);
        unequal.bottom = [Some(0.15), Some(0.03)];
        let found = by_size(&unequal).unwrap();
        let area: f64 = 0.3 * 0.02 + 0.15 * 0.03 + 0.012 * 0.35;
        let first = 0.3 * (0.4_f64.powi(2) - 0.38_f64.powi(2)) / 2.0
            + 0.15 * 0.03_f64.powi(2) / 2.0
            + 0.012 * (0.38_f64.powi(2) - 0.03_f64.powi(2)) / 2.0;
        let second = (0.3 * (0.4_f64.powi(3) - 0.38_f64.powi(3))
            + 0.15 * 0.03_f64.powi(3)
            + 0.012 * (0.38_f64.powi(3) - 0.03_f64.powi(3)))
            / 3.0;
        assert!((found[0] / area - 1.0).abs() < 1e-12);
        assert!((found[5] / (second - first * first / area) - 1.0).abs() < 1e-12);
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

    /// A filled tube as a solid bar of its filling and what steel has more than it: (E_s − E_c) of the tube + E_c of the solid.
    #[test]
    fn filled_sections_and_what_is_none_of_them() {
        let mut model = TextModel::default();
        model.materials.insert("S".into(), [200e9, 0.3]);
        model.materials.insert("C".into(), [30e9, 0.3]);
        let mut rigidities = |shape: &str, fill: Option<&str>| {
            let mut found = section(shape, [0.5, 0.4], [0.02, 0.02]);
            found.material = "S".into();
            found.fill = fill.map(str::to_owned);
            model.sections.insert("X".into(), found);
            let mut member = Member::new("a column".into(), [[0.0; 3], [0.0, 0.0, 4.0]]);
            member.section = "X".into();
            rigidity(&member, &model).map(|found| found.0)
        };
        let (steel, concrete) = (200e9, 30e9);
        let found = rigidities("Filled Steel Tube", Some("C")).unwrap();
        let solid = [
            0.5 * 0.4,
            0.5 * 0.4_f64.powi(3) / 12.0,
            0.4 * 0.5_f64.powi(3) / 12.0,
        ];
        let inside = [
            0.46 * 0.36,
            0.46 * 0.36_f64.powi(3) / 12.0,
            0.36 * 0.46_f64.powi(3) / 12.0,
        ];
        for (index, place) in [0, 4, 5].into_iter().enumerate() {
            let expected = steel * solid[index] - (steel - concrete) * inside[index];
            assert!((found[place] / expected - 1.0).abs() < 1e-12, "{place}");
        }
        let found = rigidities("Filled Steel Pipe", Some("C")).unwrap();
        let [outer, inner] = [0.5_f64, 0.46].map(|diameter| PI * diameter.powi(4) / 64.0);
        let expected = steel * outer - (steel - concrete) * inner;
        assert!((found[5] / expected - 1.0).abs() < 1e-12);
        assert!(
            rigidities("Filled Steel Tube", None)
                .unwrap_err()
                .0
                .contains("FILLMATERIAL")
        );
        for shape in [
            "Concrete Encasement Circle",
            "Concrete Encasement Rectangle",
        ] {
            assert!(
                rigidities(shape, None)
                    .unwrap_err()
                    .0
                    .contains("profile in concrete")
            );
        }
    }

    /// An equal angle: principal axes at 45°, and second moments by thin legs of its own axes, I ± I23.
    #[test]
    fn principal_axes() {
        let (stiffness, turn) = principal([1.0, 0.5, 0.5, 1.0, 4.0, 4.0], -2.5);
        assert!((turn + 45.0).abs() < 1e-12, "{turn}");
        assert_eq!(stiffness, [1.0, 0.5, 0.5, 1.0, 1.5, 6.5]);
        // A rectangle of 2 by 1 that stands turned by 30°.
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        let [strong, weak] = [8.0 / 12.0, 2.0 / 12.0];
        let i33 = strong * cos * cos + weak * sin * sin;
        let i22 = strong * sin * sin + weak * cos * cos;
        let (stiffness, turn) =
            principal([1.0, 0.0, 0.0, 1.0, i22, i33], (strong - weak) * sin * cos);
        assert!((turn - 30.0).abs() < 1e-12, "{turn}");
        assert!((stiffness[4] - weak).abs() < 1e-15 && (stiffness[5] - strong).abs() < 1e-15);
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
