//! Capacity of steel columns and beams by AISC 360-16, chapters E to H.

use std::f64::consts::PI;
use std::sync::Arc;

use jostle::model::{AcrossCapacity, CapacityLine, MomentSurface, RuleCapacity, ShearCapacity};

use super::AISC_360;
use crate::formula::Member;
use crate::profile::{Axis, Profile};

/// A column or beam of a steel profile.
///
/// Strengths are nominal: of the yield strength as given, without resistance factors. A column buckles over its storey about its weaker
/// axis (effective length factor 1). Moments are taken of opposite sign at both ends, and beams to be held by their slabs, so that
/// lateral-torsional buckling does not govern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteelMember {
    /// The profile.
    pub profile: Profile,
    /// Axis of bending in the first plane.
    pub axis: Axis,
    /// Yield strength F_y, > 0 \[Pa\].
    pub yield_strength: f64,
    /// Modulus of elasticity E, > 0 \[Pa\].
    pub modulus: f64,
}

/// Equal walls of a profile, such as both flanges.
struct Wall {
    /// Width over thickness \[–\].
    slenderness: f64,
    /// Slenderness times √(F_y/E) from which they buckle before they yield (table B4.1a) \[–\].
    limit: f64,
    /// c₁ and c₂ of table E7.1 \[–\].
    factors: [f64; 2],
    /// Area of all of them, in full width \[m²\].
    area: f64,
}

impl SteelMember {
    /// Capacity of a member between joints at a distance \[m\]; `bends_across`: of a column of a space frame.
    #[must_use]
    pub fn capacity(&self, member: Member, length: f64, bends_across: bool) -> RuleCapacity {
        let axes = self.axes();
        let axial = match member {
            Member::Column => Some([self.tension(), self.compression(length)]),
            Member::Beam => None,
        };
        let line = |axis: Axis| interaction(axial, self.moment(axis));
        let lines = axes.map(line);
        let shear = |axis: Axis| ShearCapacity {
            steady: CapacityLine::new(vec![[0.0, self.shear(axis)]]),
            degrading: CapacityLine::default(),
            by_ductility: CapacityLine::default(),
            limit: f64::INFINITY,
        };
        let [first, second] = &lines;
        // Shares of both moments add up (H1-1): straight between the planes, in which the section is as strong on either side.
        let stretch = first.at(0.0) / second.at(0.0);
        let turned = |line: &CapacityLine| {
            let points = line.points().iter();
            CapacityLine::new(points.map(|[n, moment]| [*n, stretch * moment]).collect())
        };
        let both = [first.clone(), turned(second)];
        let around: Arc<[CapacityLine]> = both.iter().chain(&both).cloned().collect();
        RuleCapacity {
            rule: AISC_360,
            shear: Some(shear(axes[0])),
            bending: [first.clone(), first.clone()],
            across: bends_across.then(|| AcrossCapacity {
                shear: Some(shear(axes[1])),
                bending: MomentSurface::new(around, stretch),
            }),
        }
    }

    /// Moment of a plastic hinge about an axis under an axial force \[N·m, N\]: 1.18 Z F_y (1 − P/(A F_y)), at most Z F_y (FEMA 356,
    /// (5-4)), or less where a flange or wall buckles before (F3, F6, F7, F8). `None` where the axial force alone yields the section.
    #[must_use]
    pub fn hinge_moment(&self, axis: Axis, axial: f64) -> Option<f64> {
        let left = 1.0 - axial.abs() / self.tension();
        let plastic = self.yield_strength * self.profile.plastic_modulus(axis);
        (left > 0.0).then(|| (1.18 * left * plastic).min(self.moment(axis)))
    }

    /// Both axes of the profile, that of bending in the first plane first.
    #[must_use]
    pub fn axes(&self) -> [Axis; 2] {
        match self.axis {
            Axis::Strong => [Axis::Strong, Axis::Weak],
            Axis::Weak => [Axis::Weak, Axis::Strong],
        }
    }

    /// √(E/F_y) \[–\].
    fn root(&self) -> f64 {
        (self.modulus / self.yield_strength).sqrt()
    }

    /// In tension (D2-1) \[N\].
    fn tension(&self) -> f64 {
        self.yield_strength * self.profile.area()
    }

    /// In compression over a length, with local buckling (E3, E7) \[N\].
    fn compression(&self, length: f64) -> f64 {
        let inertias = [Axis::Strong, Axis::Weak].map(|axis| self.profile.inertia(axis));
        let least = inertias[0].min(inertias[1]);
        let area = self.profile.area();
        let elastic = PI * PI * self.modulus * least / (area * length * length);
        let ratio = self.yield_strength / elastic;
        let critical = if ratio <= 2.25 {
            libm::pow(0.658, ratio) * self.yield_strength
        } else {
            0.877 * elastic
        };
        critical * self.effective_area(critical)
    }

    /// Area less the slender parts of walls at a critical stress (E7) \[m²\].
    fn effective_area(&self, critical: f64) -> f64 {
        let area = self.profile.area();
        let walls: Vec<Wall> = match self.profile {
            Profile::I(profile) => vec![
                Wall {
                    slenderness: 0.5 * profile.width / profile.flange,
                    limit: 0.56,
                    factors: [0.22, 1.49],
                    area: 2.0 * profile.width * profile.flange,
                },
                Wall {
                    slenderness: profile.flat() / profile.web,
                    limit: 1.49,
                    factors: [0.18, 1.31],
                    area: profile.flat() * profile.web,
                },
            ],
            Profile::Tube(tube) => tube
                .flats()
                .map(|flat| Wall {
                    slenderness: flat / tube.wall,
                    limit: 1.40,
                    factors: [0.20, 1.38],
                    area: 2.0 * flat * tube.wall,
                })
                .into(),
            Profile::Pipe(pipe) => {
                let slenderness = pipe.diameter / pipe.wall * self.yield_strength / self.modulus;
                let share = if slenderness <= 0.11 {
                    1.0
                } else {
                    0.038 / slenderness + 2.0 / 3.0
                };
                return share * area;
            }
        };
        let lost = walls.iter().map(|wall| {
            let limit = wall.limit * self.root();
            let [first, second] = wall.factors;
            if wall.slenderness <= limit * (self.yield_strength / critical).sqrt() {
                return 0.0;
            }
            let local = (second * limit / wall.slenderness).powi(2) * self.yield_strength;
            let root = (local / critical).sqrt();
            wall.area * (1.0 - ((1.0 - first * root) * root).min(1.0))
        });
        area - lost.sum::<f64>()
    }

    /// Moment about an axis, with local buckling of flanges (F2, F3, F6, F7, F8) \[N·m\].
    fn moment(&self, axis: Axis) -> f64 {
        let plastic = self.yield_strength * self.profile.plastic_modulus(axis);
        let section = 2.0 * self.profile.inertia(axis) / self.profile.depth(axis);
        let elastic = self.yield_strength * section;
        let root = self.root();
        match self.profile {
            Profile::I(profile) => {
                let slenderness = 0.5 * profile.width / profile.flange;
                let [compact, slender] = [0.38 * root, root];
                // Weak bending is bounded by 1.6 of first yield (F6-1).
                let plastic = match axis {
                    Axis::Strong => plastic,
                    Axis::Weak => plastic.min(1.6 * elastic),
                };
                if slenderness > slender {
                    // The flange buckles while it is elastic.
                    let factor = match axis {
                        Axis::Strong => {
                            let web = 4.0 / (profile.flat() / profile.web).sqrt();
                            0.9 * web.clamp(0.35, 0.76)
                        }
                        Axis::Weak => 0.69,
                    };
                    return factor * self.modulus * section / (slenderness * slenderness);
                }
                let beyond = ((slenderness - compact) / (slender - compact)).max(0.0);
                plastic - (plastic - 0.7 * elastic) * beyond
            }
            Profile::Tube(tube) => {
                let [deep, wide] = tube.flats();
                let flange = match axis {
                    Axis::Strong => wide,
                    Axis::Weak => deep,
                };
                let slenderness = flange / tube.wall / root;
                if slenderness <= 1.4 {
                    let beyond = (3.57 * slenderness - 4.0).max(0.0);
                    return plastic - (plastic - elastic) * beyond;
                }
                // A slender flange counts with its effective width (F7-4); the one in tension is taken to lose as much.
                let width = 1.92 / slenderness * (1.0 - 0.38 / slenderness);
                let depth = self.profile.depth(axis);
                let arm = 0.5 * (depth - tube.wall);
                let lost = 2.0 * (1.0 - width.min(1.0)) * flange * tube.wall * arm * arm;
                elastic - self.yield_strength * 2.0 * lost / depth
            }
            Profile::Pipe(pipe) => {
                let slenderness = pipe.diameter / pipe.wall * self.yield_strength / self.modulus;
                if slenderness <= 0.07 {
                    plastic
                } else {
                    ((0.021 / slenderness + 1.0) * elastic).min(plastic)
                }
            }
        }
    }

    /// Shear in the plane of bending about an axis (G2, G4, G5, G6); walls of tubes and flanges do not buckle \[N\].
    fn shear(&self, axis: Axis) -> f64 {
        let area = match (self.profile, axis) {
            (Profile::I(profile), Axis::Strong) => {
                // A slender web buckles (G2-4), held by its flanges alone.
                let limit = 1.1 * 5.34_f64.sqrt() * self.root();
                profile.depth * profile.web * (limit * profile.web / profile.flat()).min(1.0)
            }
            (Profile::I(profile), Axis::Weak) => 2.0 * profile.width * profile.flange,
            (Profile::Tube(tube), axis) => {
                let [deep, wide] = tube.flats();
                2.0 * tube.wall
                    * match axis {
                        Axis::Strong => deep,
                        Axis::Weak => wide,
                    }
            }
            (Profile::Pipe(_), _) => 0.5 * self.profile.area(),
        };
        0.6 * self.yield_strength * area
    }
}

/// Moments against the compression where a tension and a compression of these sizes can be carried (H1-1); one point without them
/// \[N·m, N\].
fn interaction(axial: Option<[f64; 2]>, moment: f64) -> CapacityLine {
    let Some([tension, compression]) = axial else {
        return CapacityLine::new(vec![[0.0, moment]]);
    };
    CapacityLine::new(vec![
        [-tension, 0.0],
        [-0.2 * tension, 0.9 * moment],
        [0.0, moment],
        [0.2 * compression, 0.9 * moment],
        [compression, 0.0],
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AISC_STEEL_MODULUS;

    const KIP: f64 = 4_448.221_615;
    const KSI: f64 = 6.894_757_293e6;
    const FOOT: f64 = 0.3048;

    fn american(name: &str, strength: f64) -> SteelMember {
        SteelMember {
            profile: Profile::named(name).expect("known"),
            axis: Axis::Strong,
            yield_strength: strength * KSI,
            modulus: AISC_STEEL_MODULUS,
        }
    }

    /// AISC, Companion to the Steel Construction Manual, Design Examples (version 15.0), with resistance factors of 0.9. E.1A:
    /// 893 kips. H.1B: 1130 kips, 642 and 311 kip ft. The 642 kip ft include lateral-torsional buckling over 14 ft; without it they are
    /// 646.
    #[test]
    fn strengths_are_those_of_published_examples() {
        let tall = american("W14X132", 50.0);
        let found = 0.9 * tall.compression(30.0 * FOOT) / KIP;
        // Sizes in the tables of profiles have three digits.
        assert!((found / 893.0 - 1.0).abs() < 5e-3, "{found}");
        let column = american("W14X99", 50.0);
        let found = [
            column.compression(14.0 * FOOT) / KIP,
            column.moment(Axis::Strong) / (KIP * FOOT),
            column.moment(Axis::Weak) / (KIP * FOOT),
        ];
        for (found, due) in found.into_iter().zip([1130.0, 646.0, 311.0]) {
            // Properties from sizes agree with the tables within 1 %.
            assert!((0.9 * found / due - 1.0).abs() < 1e-2, "{found} for {due}");
        }
        // G.1A: W24X62, V_n = 306 kips.
        let beam = american("W24X62", 50.0);
        assert!((beam.shear(Axis::Strong) / KIP / 306.0 - 1.0).abs() < 2e-3);
    }

    /// The interaction of example H.1B: 400 kips, 250 and 80 kip ft use 0.928 to 0.930 of the column. Demands that are so much
    /// greater are what it carries.
    #[test]
    fn both_moments_add_up_with_the_axial_force() {
        let column = american("W14X99", 50.0);
        let capacity = column.capacity(Member::Column, 14.0 * FOOT, true);
        let factor = 1.0 / (0.9 * 0.928);
        let compression = factor * 400.0 * KIP;
        let moments = [250.0, 80.0].map(|moment| factor * moment * KIP * FOOT);
        let [ratio, along] = [moments, [moments[0], 0.0]]
            .map(|moments| capacity.bending_ratio(compression, moments));
        assert!((ratio - 1.0).abs() < 1e-2, "{ratio}");
        // Along one axis it is the same in space as in a plane.
        let plane = column.capacity(Member::Column, 14.0 * FOOT, false);
        let due = plane.bending_ratio(compression, [moments[0], 0.0]);
        assert!((along / due - 1.0).abs() < 1e-12);
        // Shares of both moments add up at the same axial force.
        let across = capacity.bending_ratio(compression, [0.0, moments[1]]);
        assert!((ratio / (along + across) - 1.0).abs() < 5e-3);
    }

    /// Z of the tables: HEB 300 1868.7 cm³ and 870.1 cm³ (ArcelorMittal), W24X94 254 in³ (AISC). Half of the squash load leaves 0.59 of
    /// Z F_y, and a flange that is not compact less: W6X15, λ = 11.5 between 0.38 and 1.0 √(E/F_y) = 9.15 and 24.1.
    #[test]
    fn hinges_form_at_the_plastic_moment() {
        let heb = SteelMember {
            profile: Profile::named("HEB300").expect("known"),
            axis: Axis::Weak,
            yield_strength: 355e6,
            modulus: crate::STEEL_MODULUS,
        };
        assert_eq!(heb.axes(), [Axis::Weak, Axis::Strong]);
        let moment = |axis, axial| heb.hinge_moment(axis, axial).expect("more than nothing");
        for (axis, modulus) in [(Axis::Strong, 1868.7e-6), (Axis::Weak, 870.1e-6)] {
            let due = 355e6 * modulus;
            assert!((moment(axis, 0.0) / due - 1.0).abs() < 1e-3);
            // 149.08 cm²: 5292 kN.
            let half = moment(axis, 0.5 * 5292.3e3);
            assert!((half / (0.59 * due) - 1.0).abs() < 2e-3, "{half}");
            assert_eq!(moment(axis, 700e3), moment(axis, -700e3));
            // Up to 1 − 1/1.18 of the squash load nothing is lost.
            assert_eq!(moment(axis, 800e3), moment(axis, 0.0));
        }
        assert_eq!(heb.hinge_moment(Axis::Strong, 5.3e6), None);
        let beam = american("W24X94", 50.0).hinge_moment(Axis::Strong, 0.0);
        let found = beam.expect("more than nothing") / (254.0 * 0.0254_f64.powi(3) * 50.0 * KSI);
        assert!((found - 1.0).abs() < 1e-2, "{found}");
        // Z 10.8 in³, S 9.72 in³ (AISC): 540 − (540 − 0.7 · 486) (11.5 − 9.152)/(24.083 − 9.152) = 508.6 kip in.
        let slender = american("W6X15", 50.0).hinge_moment(Axis::Strong, 0.0);
        let found = 12.0 * slender.expect("more than nothing") / (KIP * FOOT);
        assert!((found / 508.6 - 1.0).abs() < 1e-2, "{found}");
    }

    #[test]
    fn slender_walls_weaken_without_a_jump() {
        for name in ["HSS20X12X5/16", "HSS8X8X1/8", "HSS16X0.250"] {
            let strong = american(name, 46.0);
            let short = strong.compression(0.01 * FOOT);
            assert!(short <= strong.tension() * (1.0 + 1e-12), "{name}");
            for axis in [Axis::Strong, Axis::Weak] {
                let plastic = strong.yield_strength * strong.profile.plastic_modulus(axis);
                let moment = strong.moment(axis);
                assert!(0.3 * plastic < moment && moment <= plastic, "{name}");
            }
        }
        // Over the yield strength at which a wall becomes slender.
        let root =
            |slenderness: f64, limit: f64| AISC_STEEL_MODULUS * (limit / slenderness).powi(2) / KSI;
        let Some(Profile::Tube(tube)) = Profile::named("HSS8X8X1/8") else {
            panic!("known");
        };
        let slenderness = tube.flats()[0] / tube.wall;
        for limit in [1.12, 1.4] {
            let at = root(slenderness, limit);
            let moments = [at * (1.0 - 1e-9), at * (1.0 + 1e-9)]
                .map(|strength| american("HSS8X8X1/8", strength).moment(Axis::Strong));
            assert!(
                (moments[1] / moments[0] - 1.0).abs() < 0.05,
                "{limit}: {moments:?}"
            );
        }
    }
}
