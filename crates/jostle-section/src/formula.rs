//! Cracking and yield by published formulas.
//!
//! GB 50010: code for the design of concrete structures, 2010. AIJ: standard for structural calculation of
//! reinforced concrete structures, Architectural Institute of Japan, 1999. Sugano: S. Sugano, *Experimental study
//! on restoring force characteristics of reinforced concrete members*, University of Tokyo, 1970.

use crate::bars::Bar;
use crate::section::Section;

/// Which member a formula is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Member {
    /// Without axial load.
    Beam,
    /// With axial load.
    Column,
}

/// Bars of the row in tension: those within a diameter of the deepest.
fn tension_row(section: &Section) -> impl Iterator<Item = &Bar> {
    let deepest = section.bars.iter().fold(0.0_f64, |d, bar| d.max(bar.depth));
    let thickest = section
        .bars
        .iter()
        .fold(0.0_f64, |d, bar| d.max(bar.diameter));
    section
        .bars
        .iter()
        .filter(move |bar| bar.depth >= deepest - thickest)
}

/// Area of the row of bars in tension \[m²\].
#[must_use]
pub fn tension_steel(section: &Section) -> f64 {
    tension_row(section).map(Bar::area).sum()
}

/// Effective depth: of the centroid of that row \[m\].
#[must_use]
pub fn effective_depth(section: &Section) -> f64 {
    let moment: f64 = tension_row(section).map(|bar| bar.area() * bar.depth).sum();
    moment / tension_steel(section)
}

/// Modulus of the transformed section for the tension face \[m³\].
#[must_use]
pub fn section_modulus(section: &Section) -> f64 {
    let transformed = section.transformed();
    transformed.inertia / (section.depth - transformed.centroid)
}

/// Cracking moment of GB 50010-2010, 7.2.3: (N/A₀ + γ ft) W₀ with γ = (0.7 + 120 mm/h) 1.55, h between 400 and
/// 1600 mm \[N·m\].
#[must_use]
pub fn cracking_gb(section: &Section, compression: f64) -> f64 {
    let millimetres = (1e3 * section.depth).clamp(400.0, 1600.0);
    let plasticity = (0.7 + 120.0 / millimetres) * 1.55;
    let stress = compression / section.transformed().area;
    (stress + plasticity * section.concrete.tensile_strength) * section_modulus(section)
}

/// Cracking moment of AIJ: 0.56 √σB Ze + N D/6, σB in MPa \[N·m\].
#[must_use]
pub fn cracking_aij(section: &Section, compression: f64) -> f64 {
    let strength = 1e-6 * section.concrete.strength;
    0.56e6 * strength.sqrt() * section_modulus(section) + compression * section.depth / 6.0
}

/// State of a cracked elastic section whose tension row just yields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticYield {
    /// Depth of the neutral axis \[m\].
    pub neutral_axis: f64,
    /// Curvature \[1/m\].
    pub curvature: f64,
    /// Moment about mid-depth \[N·m\].
    pub moment: f64,
    /// Stress of the outermost concrete, by Hooke's law even where it exceeds the strength \[Pa\].
    pub concrete_stress: f64,
}

/// Moment at which the tension row yields: plane section, Hooke's law for concrete and bars, no concrete in
/// tension. `None` when the section yields nowhere with a neutral axis above the tension row.
#[must_use]
pub fn yield_plane_section(section: &Section, compression: f64) -> Option<ElasticYield> {
    let depth = effective_depth(section);
    let strain = section.steel.yield_strain();
    let moduli = (section.concrete.modulus, section.steel.modulus);
    let curvature = |axis: f64| strain / (depth - axis);
    let forces = |axis: f64| {
        let curvature = curvature(axis);
        let compressed = axis.min(section.depth);
        let edge = moduli.0 * curvature * axis;
        let below = moduli.0 * curvature * (axis - compressed);
        let half = 0.5 * section.depth;
        let mut axial = 0.5 * (edge + below) * section.width * compressed;
        // Trapezium of stress: moment about mid-depth.
        let mut moment = section.width
            * compressed
            * (0.5 * (edge + below) * (half - 0.5 * compressed)
                + (edge - below) * compressed / 12.0);
        for bar in &section.bars {
            let force = moduli.1 * curvature * (axis - bar.depth) * bar.area();
            axial += force;
            moment += force * (half - bar.depth);
        }
        (axial, moment, edge)
    };
    let (mut low, mut high) = (0.0, depth * (1.0 - 1e-9));
    if forces(low).0 > compression || forces(high).0 < compression {
        return None;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if forces(middle).0 < compression {
            low = middle;
        } else {
            high = middle;
        }
    }
    let neutral_axis = 0.5 * (low + high);
    let (_, moment, concrete_stress) = forces(neutral_axis);
    Some(ElasticYield {
        neutral_axis,
        curvature: curvature(neutral_axis),
        moment,
        concrete_stress,
    })
}

/// Yield moment of AIJ. Beams: 0.9 at σy d. Columns under N ≤ 0.4 b D Fc: 0.8 at σy D + 0.5 N D (1 − N / (b D Fc));
/// for more the standard's line down to the axial strength \[N·m\].
#[must_use]
pub fn yield_aij(section: &Section, compression: f64, member: Member) -> f64 {
    let tension = tension_steel(section) * section.steel.yield_strength;
    if member == Member::Beam {
        return 0.9 * tension * effective_depth(section);
    }
    let crushing = section.area() * section.concrete.strength;
    let all_bars = section.steel_area() * section.steel.yield_strength;
    let steel = 0.8 * tension * section.depth;
    let bent = |load: f64| steel + 0.5 * load * section.depth * (1.0 - load / crushing);
    let (balanced, greatest) = (0.4 * crushing, crushing + all_bars);
    if compression < 0.0 {
        return (steel + 0.4 * compression * section.depth).max(0.0);
    }
    if compression <= balanced {
        return bent(compression);
    }
    (bent(balanced) * (greatest - compression) / (greatest - balanced)).max(0.0)
}

/// Ultimate moment about mid-depth of a section with equal bars in both faces or none in compression, by the
/// stress block of GB 50010-2010, 6.2: α₁ fc over the depth x; where x < 2 a′, the bars in tension about those in
/// compression \[N·m\]. Bars between the faces are left out.
#[must_use]
pub fn ultimate_gb(section: &Section, compression: f64) -> f64 {
    let cube = 1e-6 * section.concrete.strength / 0.67;
    let block = (1.0 - 0.002 * (cube - 50.0).max(0.0)).clamp(0.94, 1.0) * section.concrete.strength;
    let flipped = section.flipped();
    let (tension, opposite) = (tension_steel(section), tension_steel(&flipped));
    let depth = effective_depth(section);
    let inset = section.depth - effective_depth(&flipped);
    let strength = section.steel.yield_strength;
    let x = (compression + strength * (tension - opposite)) / (block * section.width);
    if x < 2.0 * inset && compression == 0.0 {
        return strength * tension * (depth - inset);
    }
    let half = 0.5 * section.depth;
    block * section.width * x * (half - 0.5 * x)
        + strength * (tension * (depth - half) + opposite * (half - inset))
}

/// Sugano's ratio of the secant stiffness at yield to the initial one,
/// (0.043 + 1.64 n pt + 0.043 a/D + 0.33 η₀)(d/D)² with n = Es/Ec, pt = at/(b D), η₀ = N/(b D Fc) \[–\].
///
/// From tests with pt 0.4…2.8 %, a/D 2…5, η₀ 0…0.55. `shear_span` a > 0 \[m\].
#[must_use]
pub fn sugano(section: &Section, compression: f64, shear_span: f64) -> f64 {
    let ratio = tension_steel(section) / section.area();
    let effective = effective_depth(section) / section.depth;
    let sum = 0.043
        + 1.64 * section.modular_ratio() * ratio
        + 0.043 * shear_span / section.depth
        + 0.33 * section.axial_ratio(compression).max(0.0);
    (sum * effective * effective).min(1.0)
}
