//! Bending capacity as a function of the axial force.

use crate::fibre::{Fibres, Resultants};
use crate::section::Section;

/// Greatest moments of a section under every axial force that it can carry.
///
/// Plane sections with the laws of the fibre analysis, without ties and without concrete in tension. Strains are limited to
/// that of crushing in the outermost concrete and to 0.01 in the outermost bars (GB 50010-2010, 6.2.1 and 6.2.5); the
/// greatest moment of all such states counts, as at the peak of a moment–curvature curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Interaction {
    /// Compression (tension negative), rising, and the greatest moment about mid-depth that stretches the bottom, ≥ 0
    /// \[N, N·m\].
    pub points: Vec<[f64; 2]>,
}

/// Greatest strain of a bar in tension \[–\].
pub(super) const MOST_STRETCH: f64 = 0.01;
/// Strains of the top, and positions of the neutral axis for each.
const STRAINS: usize = 24;
const AXES: usize = 120;
/// Axial forces of the curve.
const LOADS: usize = 65;
/// Fibres over the depth.
pub(super) const FIBRES: usize = 40;

impl Interaction {
    /// Moments that stretch the bottom of a section; those of the other sign belong to [`Section::flipped`].
    #[must_use]
    pub fn new(section: &Section) -> Self {
        let mut plain = section.clone();
        plain.ties = None;
        plain.concrete.tensile_strength = 0.0;
        let fibres = Fibres::new(&plain, FIBRES);
        let curves = curves(&fibres);
        let all = || curves.iter().flatten();
        let least = all().fold(f64::INFINITY, |least, state| state.axial.min(least));
        let most = all().fold(f64::NEG_INFINITY, |most, state| state.axial.max(most));
        let mut points: Vec<[f64; 2]> = (0..LOADS)
            .map(|index| {
                [
                    least + (most - least) * index as f64 / (LOADS - 1) as f64,
                    0.0,
                ]
            })
            .collect();
        for curve in &curves {
            for pair in curve.windows(2) {
                let [low, high] = if pair[0].axial <= pair[1].axial {
                    [pair[0], pair[1]]
                } else {
                    [pair[1], pair[0]]
                };
                let span = high.axial - low.axial;
                let first = points.partition_point(|[load, _]| *load < low.axial);
                for [load, moment] in &mut points[first..] {
                    if *load > high.axial {
                        break;
                    }
                    let share = if span > 0.0 {
                        (*load - low.axial) / span
                    } else {
                        0.0
                    };
                    *moment = moment.max(low.moment + share * (high.moment - low.moment));
                }
            }
        }
        Self { points }
    }

    /// Moments that stretch the bottom, and those that stretch the top.
    #[must_use]
    pub fn of_both_signs(section: &Section) -> [Self; 2] {
        let positive = Self::new(section);
        let negative = if section.is_symmetric() {
            positive.clone()
        } else {
            Self::new(&section.flipped())
        };
        [positive, negative]
    }

    /// Moment capacity under an axial compression; 0 beyond the ends \[N·m\].
    #[must_use]
    pub fn moment(&self, compression: f64) -> f64 {
        let after = self.points.partition_point(|[load, _]| *load < compression);
        match (
            after.checked_sub(1).map(|index| self.points[index]),
            self.points.get(after),
        ) {
            (Some([a, m]), Some(&[b, n])) => m + (n - m) * (compression - a) / (b - a),
            (None, Some(&[load, moment])) if load == compression => moment,
            _ => 0.0,
        }
    }

    /// Corners of a convex polygon on the curve, as axial force, positive in tension and in ascending order, and moment \[N, N·m\]. Of the
    /// convex hull of the curve, `most` ≥ 3 corners are kept; those are left out that change its area least.
    ///
    /// With 12 corners, the polygon of a rectangle with bars around it lies up to 2 % of the greatest moment below the curve, and up to
    /// 0.6 % above it where the curve is not convex.
    #[must_use]
    pub fn corners(&self, most: usize) -> Vec<[f64; 2]> {
        let twice_area = |[a, b, c]: [[f64; 2]; 3]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let mut corners: Vec<[f64; 2]> = Vec::new();
        for &[load, moment] in self.points.iter().rev() {
            let next = [-load, moment];
            while let [.., a, b] = corners[..] {
                if twice_area([a, b, next]) < 0.0 {
                    break;
                }
                corners.pop();
            }
            corners.push(next);
        }
        while corners.len() > most.max(3) {
            let areas = corners.windows(3).map(|w| -twice_area([w[0], w[1], w[2]]));
            let least = areas.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            let Some((before, _)) = least else { break };
            corners.remove(before + 1);
        }
        corners
    }

    /// Greatest tension (negative) and greatest compression \[N\].
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let ends = [self.points.first(), self.points.last()];
        ends.map(|end| end.map_or(0.0, |[load, _]| *load))
    }
}

/// States of equal strain at the top under a falling neutral axis, and states of bars at their limit.
fn curves(fibres: &Fibres) -> Vec<Vec<Resultants>> {
    let section = fibres.section();
    let deepest = section.bars.iter().fold(0.0_f64, |d, bar| d.max(bar.depth));
    let whole = section.depth;
    limit_states(
        fibres.plain().crushing_strain,
        [STRAINS, AXES],
        |top, bar| {
            let curvature = (top - bar) / deepest;
            fibres.resultants(top - 0.5 * whole * curvature, curvature)
        },
    )
}

/// The same of states by the strain of the outermost concrete and that of the outermost bar, both positive in compression, which
/// `state` returns. `counts`: strains of the concrete, and positions of the neutral axis for each.
pub(super) fn limit_states<T>(
    crushing: f64,
    [strains, axes]: [usize; 2],
    state: impl Fn(f64, f64) -> T,
) -> Vec<Vec<T>> {
    let mut curves: Vec<Vec<T>> = (1..=strains)
        .map(|step| {
            let top = crushing * step as f64 / strains as f64;
            // From the limit of the bars to uniform compression.
            (0..=axes)
                .map(|axis| {
                    let share = axis as f64 / axes as f64;
                    // Denser where bars yield.
                    let bar = top - (top + MOST_STRETCH) * (1.0 - share) * (1.0 - share);
                    state(top, bar)
                })
                .collect()
        })
        .collect();
    curves.push(
        (0..=axes)
            .map(|step| {
                let share = step as f64 / axes as f64;
                let top = -MOST_STRETCH + (crushing + MOST_STRETCH) * share;
                state(top, -MOST_STRETCH)
            })
            .collect(),
    );
    curves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula;
    use crate::{Concrete, MomentCurvature, Options, Reinforcement, Steel, StrengthLevel};

    fn section(bars: &str, width: f64, depth: f64) -> Section {
        let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
        let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
        let bars = Reinforcement::parse(bars).expect("understood");
        let mut section =
            Section::new(width, depth, concrete, steel, &bars, 0.03, None).expect("sound");
        // Then the limit of bar strains does not matter.
        section.steel.hardening = 0.0;
        section
    }

    #[test]
    fn moments_are_the_peaks_of_moment_curvature() {
        // Another way to the same: bend under a constant force and take the greatest moment. The curve has concrete in
        // tension, which matters for neither section after yield.
        let section = section("12 d20", 0.5, 0.5);
        let interaction = Interaction::new(&section);
        for load in [0.0, 5e5, 1e6, 2e6, 3e6] {
            let curve = MomentCurvature::new(&section, load, Options::default()).expect("a curve");
            let within: Vec<_> = curve.points.iter().map(|point| point.force).collect();
            let due = within.iter().copied().fold(0.0, f64::max);
            let found = interaction.moment(load);
            assert!(
                (found / due - 1.0).abs() < 0.012,
                "{found} for {due} at {load}"
            );
        }
    }

    /// The polygon lies within the convex hull of the curve, close to the curve, and has all its range.
    #[test]
    fn corners_are_close_to_the_curve() {
        for (bars, width, depth) in [
            ("12 d20", 0.5, 0.5),
            ("8 d25", 0.4, 0.6),
            ("4 d16", 0.3, 0.3),
        ] {
            let interaction = Interaction::new(&section(bars, width, depth));
            let corners = interaction.corners(12);
            assert_eq!(corners.len(), 12);
            let greatest = corners
                .iter()
                .fold(0.0_f64, |most, corner| most.max(corner[1]));
            let hull = interaction.corners(usize::MAX);
            let on_hull = |force: f64| {
                let within = |pair: &&[[f64; 2]]| force <= pair[1][0];
                let pair = hull.windows(2).find(within).expect("within its range");
                let share = (force - pair[0][0]) / (pair[1][0] - pair[0][0]);
                pair[0][1] + share * (pair[1][1] - pair[0][1])
            };
            let (mut low, mut high) = (0.0_f64, 0.0_f64);
            for pair in corners.windows(2) {
                for part in 0..=20 {
                    let share = f64::from(part) / 20.0;
                    let [force, moment] =
                        [0, 1].map(|i| pair[0][i] + share * (pair[1][i] - pair[0][i]));
                    assert!(moment <= on_hull(force.min(corners[11][0])) + 1e-9 * greatest);
                    let apart = (interaction.moment(-force) - moment) / greatest;
                    (low, high) = (low.min(apart), high.max(apart));
                }
            }
            // The curve is not quite convex: its hull, and the polygon, span what is not.
            assert!(low > -0.006 && high < 0.02, "{bars}: {low} {high}");
            let [tension, compression] = interaction.range();
            assert_eq!([corners[0][0], corners[11][0]], [-compression, -tension]);
        }
    }

    /// Forces of 400 slices and all bars about mid-depth; the strain is `top` at the top and zero at the depth `axis`.
    fn sums(section: &Section, top: f64, axis: f64) -> [f64; 2] {
        let law = crate::ConcreteLaw::unconfined(&section.concrete);
        let strain = |depth: f64| top * (1.0 - depth / axis);
        let (mut force, mut moment) = (0.0, 0.0);
        let mut add = |value: f64, depth: f64| {
            force += value;
            moment += value * (0.5 * section.depth - depth);
        };
        let slices = 400;
        for slice in 0..slices {
            let part = section.depth / f64::from(slices);
            let depth = (f64::from(slice) + 0.5) * part;
            add(
                law.stress(strain(depth)).max(0.0) * section.width * part,
                depth,
            );
        }
        for bar in &section.bars {
            let strain = strain(bar.depth);
            let fy = section.steel.yield_strength;
            let steel = (section.steel.modulus * strain).clamp(-fy, fy);
            add(
                (steel - law.stress(strain).max(0.0)) * bar.area(),
                bar.depth,
            );
        }
        [force, moment]
    }

    /// Greatest moment in equilibrium with a compression: for every strain of the top the neutral axis by bisection.
    fn by_equilibrium(section: &Section, compression: f64) -> f64 {
        let deepest = section.bars.iter().fold(0.0_f64, |d, bar| d.max(bar.depth));
        let crushing = crate::ConcreteLaw::unconfined(&section.concrete).crushing_strain;
        let mut greatest = 0.0_f64;
        for step in 1..=100 {
            let top = crushing * f64::from(step) / 100.0;
            // The deeper the axis, the greater the compression; not so deep that the bars tear, nor without tension.
            let (mut low, mut high) = (deepest * top / (top + MOST_STRETCH), 1e3);
            if sums(section, top, low)[0] > compression || sums(section, top, high)[0] < compression
            {
                continue;
            }
            for _ in 0..45 {
                let middle = 0.5 * (low + high);
                if sums(section, top, middle)[0] > compression {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            greatest = greatest.max(sums(section, top, low)[1]);
        }
        greatest
    }

    #[test]
    fn the_surface_is_that_of_direct_equilibrium() {
        for (bars, width, depth) in [("12 d20", 0.5, 0.5), ("2 d20 top, 6 d20 bottom", 0.3, 0.6)] {
            let section = section(bars, width, depth);
            for section in [section.flipped(), section] {
                let interaction = Interaction::new(&section);
                let [_, most] = interaction.range();
                let greatest = interaction
                    .points
                    .iter()
                    .fold(0.0_f64, |m, [_, point]| m.max(*point));
                for share in [0.0, 0.07, 0.19, 0.33, 0.42, 0.58, 0.77] {
                    let (found, due) = (
                        interaction.moment(share * most),
                        by_equilibrium(&section, share * most),
                    );
                    assert!(
                        (found - due).abs() < 4e-3 * greatest,
                        "{bars}, {share}: {found} instead of {due}"
                    );
                }
            }
        }
    }

    #[test]
    fn ends_are_the_closed_forms() {
        let section = section("12 d20", 0.5, 0.5);
        let interaction = Interaction::new(&section);
        let [least, most] = interaction.range();
        let bars = section.steel_area();
        assert!((least / (-400e6 * bars) - 1.0).abs() < 1e-9, "{least}");
        // Uniform compression, at the strain at which concrete and bars carry most.
        let law = crate::ConcreteLaw::unconfined(&section.concrete);
        let due = (0..3300)
            .map(|step| {
                let strain = 1e-6 * f64::from(step);
                let steel = (200e9 * strain).min(400e6);
                law.stress(strain) * (section.area() - bars) + steel * bars
            })
            .fold(0.0, f64::max);
        assert!((most / due - 1.0).abs() < 2e-3, "{most} for {due}");
        assert!(interaction.moment(most + 1.0) == 0.0 && interaction.moment(least - 1.0) == 0.0);
    }

    #[test]
    fn a_beam_is_near_its_stress_block() {
        // GB 50010, 6.2.10: As fy (h₀ − a′) where the block is shallower than 2 a′.
        let section = section("2 d20 top, 4 d20 bottom", 0.3, 0.6);
        let due = formula::ultimate_gb(&section, 0.0);
        let found = Interaction::new(&section).moment(0.0);
        assert!((found / due - 1.0).abs() < 0.04, "{found} for {due}");
        // Two bars at the top instead of four.
        let other = Interaction::new(&section.flipped()).moment(0.0);
        assert!((0.48..0.56).contains(&(other / found)), "{}", other / found);
    }
}
