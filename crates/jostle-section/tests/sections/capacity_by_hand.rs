//! Moment capacity under axial force, against equilibrium of sections written out here: their own numbers for materials, layers
//! of bars, strains and sums, in tension as in compression.

use jostle_section::capacity::{Interaction, RatedMember, ShearRule};
use jostle_section::formula::Member;
use jostle_section::{Concrete, Reinforcement, Section, Steel, StrengthLevel};

use crate::support::close;

/// C30 and HRB400 of GB 50010-2010, characteristic: fck, Ec, fyk, Es \[Pa\].
const CONCRETE: f64 = 20.1e6;
const CONCRETE_MODULUS: f64 = 30e9;
const STEEL: f64 = 400e6;
const STEEL_MODULUS: f64 = 200e9;
/// Strains at crushing of concrete and at the limit of bars \[–\].
const CRUSHED: f64 = 0.0033;
const STRETCHED: f64 = 0.01;

/// A section: width, depth, depth and area of every layer of bars, and the modulus of the bars after yield over that before
/// \[m, m², –\].
struct ByHand {
    width: f64,
    depth: f64,
    layers: Vec<[f64; 2]>,
    hardening: f64,
}

/// Area of some bars \[m², mm\].
fn bars(count: usize, diameter: f64) -> f64 {
    count as f64 * std::f64::consts::PI * (0.5e-3 * diameter).powi(2)
}

/// 500 × 500 mm, 12 d20, cover 30 mm: four bars in the outer layers, two in each inner one, 140 mm apart.
fn column() -> ByHand {
    ByHand {
        width: 0.5,
        depth: 0.5,
        layers: vec![
            [0.04, bars(4, 20.0)],
            [0.18, bars(2, 20.0)],
            [0.32, bars(2, 20.0)],
            [0.46, bars(4, 20.0)],
        ],
        hardening: 0.0,
    }
}

/// 400 × 600 mm, cover 30 mm: 3 d16 at the top, 4 d25 at the bottom, 4 d12 at the sides at thirds of 528 mm.
fn uneven() -> ByHand {
    ByHand {
        width: 0.4,
        depth: 0.6,
        layers: vec![
            [0.038, bars(3, 16.0)],
            [0.212, bars(2, 12.0)],
            [0.388, bars(2, 12.0)],
            [0.5575, bars(4, 25.0)],
        ],
        hardening: 0.0,
    }
}

/// The same sections as a model describes them.
fn described(level: StrengthLevel) -> [Section; 2] {
    let concrete = Concrete::grade("C30", level).expect("known");
    let steel = Steel::grade("HRB400", level).expect("known");
    [
        (0.5, 0.5, "12 d20"),
        (0.4, 0.6, "3 d16 top, 4 d25 bottom, 4 d12 sides"),
    ]
    .map(|(width, depth, bars)| {
        let bars = Reinforcement::parse(bars).expect("understood");
        let mut section =
            Section::new(width, depth, concrete, steel, &bars, 0.03, None).expect("sound");
        section.steel.hardening = 0.0;
        section
    })
}

/// GB 50010-2010, C.2.4, in compression: Popovics up to the strain εc = (700 + 172 √fc) 10⁻⁶, beyond it
/// fc x/(αc (x − 1)² + x) with αc = 0.157 fc^0.785 − 0.905; none in tension \[Pa\].
fn concrete(strain: f64) -> f64 {
    if strain <= 0.0 {
        return 0.0;
    }
    let megapascals = 1e-6 * CONCRETE;
    let peak = 1e-6 * (700.0 + 172.0 * megapascals.sqrt());
    let x = strain / peak;
    if x > 1.0 {
        let falls = 0.157 * megapascals.powf(0.785) - 0.905;
        return CONCRETE * x / (falls * (x - 1.0).powi(2) + x);
    }
    let n = CONCRETE_MODULUS * peak / (CONCRETE_MODULUS * peak - CONCRETE);
    CONCRETE * n * x / (n - 1.0 + x.powf(n))
}

fn steel(strain: f64, hardening: f64) -> f64 {
    let elastic = (STEEL_MODULUS * strain).clamp(-STEEL, STEEL);
    elastic + hardening * (STEEL_MODULUS * strain - elastic)
}

impl ByHand {
    /// Compression and moment about mid-depth, positive where it stretches the bottom, for strains at the top and in the lowest
    /// layer, positive in compression.
    fn forces(&self, top: f64, lowest: f64) -> [f64; 2] {
        let reach = self.layers.last().expect("bars")[0];
        let strain = |depth: f64| top + (lowest - top) * depth / reach;
        let (mut force, mut moment) = (0.0, 0.0);
        let slices = 600;
        let part = self.depth / f64::from(slices);
        for slice in 0..slices {
            let depth = (f64::from(slice) + 0.5) * part;
            let slice_force = concrete(strain(depth)) * self.width * part;
            force += slice_force;
            moment += slice_force * (0.5 * self.depth - depth);
        }
        for [depth, area] in &self.layers {
            let layer_force =
                (steel(strain(*depth), self.hardening) - concrete(strain(*depth))) * area;
            force += layer_force;
            moment += layer_force * (0.5 * self.depth - depth);
        }
        [force, moment]
    }

    /// Greatest moment under a compression: for every strain of the top, that of the lowest layer by bisection; and with the
    /// lowest layer at its limit, that of the top.
    fn greatest(&self, compression: f64) -> f64 {
        let between = |state: &dyn Fn(f64) -> [f64; 2], mut low: f64, mut high: f64| {
            if state(low)[0] > compression || state(high)[0] < compression {
                return f64::NEG_INFINITY;
            }
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if state(middle)[0] > compression {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            state(low)[1]
        };
        let steps = 400;
        let tops = (0..=steps)
            .map(|step| -STRETCHED + (CRUSHED + STRETCHED) * f64::from(step) / f64::from(steps));
        let all = tops.map(|top| between(&|lowest| self.forces(top, lowest), -STRETCHED, top));
        let limit = between(&|top| self.forces(top, -STRETCHED), -STRETCHED, CRUSHED);
        all.fold(limit, f64::max)
    }

    /// Greatest compression of all states that press the top most: not that of one strain everywhere where bars are uneven,
    /// because they yield at more strain than gives concrete its strength.
    fn squash(&self) -> f64 {
        let strains = |most: f64| (1..=60).map(move |step| most * f64::from(step) / 60.0);
        let states = strains(CRUSHED).flat_map(|top| strains(top).map(move |low| (top, low)));
        let forces = states.map(|(top, low)| self.forces(top, low)[0]);
        forces.fold(0.0, f64::max)
    }

    fn steel_area(&self) -> f64 {
        self.layers.iter().map(|[_, area]| area).sum()
    }

    fn upside_down(&self) -> Self {
        let layers = self.layers.iter().rev();
        Self {
            layers: layers
                .map(|[depth, area]| [self.depth - depth, *area])
                .collect(),
            ..*self
        }
    }
}

#[test]
fn moments_are_in_equilibrium_in_tension_and_in_compression() {
    for (section, by_hand) in described(StrengthLevel::Characteristic)
        .iter()
        .zip([column(), uneven()])
    {
        let [positive, negative] = Interaction::of_both_signs(section);
        let tension = STEEL * by_hand.steel_area();
        for (curve, by_hand) in [(positive, &by_hand), (negative, &by_hand.upside_down())] {
            let most = curve
                .points
                .iter()
                .fold(0.0_f64, |most, [_, point]| most.max(*point));
            // From nearly the tension of all bars to three quarters of the compression of the whole section.
            let squash = CONCRETE * by_hand.width * by_hand.depth + tension;
            let loads = [-0.7, -0.4, -0.15].map(|share| share * tension);
            for load in loads
                .into_iter()
                .chain([0.0, 0.1, 0.25, 0.4, 0.6, 0.75].map(|share| share * squash))
            {
                let (found, due) = (curve.moment(load), by_hand.greatest(load).max(0.0));
                // The surface has 24 strains of the top and 65 forces, straight lines between them: it stays below, by 0.41 % at
                // most where bars yield as the top is crushed. With four and eight times as many strains and axes it is 0.02 %.
                let off = (found - due) / most;
                assert!(
                    -5e-3 < off && off < 5e-4,
                    "{found} instead of {due} at {load}: {off}"
                );
            }
        }
    }
}

/// Bars that harden need the limit of their strain: 0.01 in the outermost layer, not at the face.
#[test]
fn bars_that_harden_are_stretched_to_their_limit() {
    let hardening = 0.05;
    let [_, mut section] = described(StrengthLevel::Characteristic);
    section.steel.hardening = hardening;
    let hand = ByHand {
        hardening,
        ..uneven()
    };
    let [positive, negative] = Interaction::of_both_signs(&section);
    for (curve, by_hand) in [(positive, &hand), (negative, &hand.upside_down())] {
        let most = curve
            .points
            .iter()
            .fold(0.0_f64, |most, point| most.max(point[1]));
        let all = by_hand.steel_area() * -steel(-STRETCHED, hardening);
        close(curve.range()[0], -all, 1e-9, "all bars at their limit");
        for load in [-0.8 * all, -0.5 * all, -0.2 * all, 0.0] {
            let (found, due) = (curve.moment(load), by_hand.greatest(load).max(0.0));
            assert!(
                (found - due).abs() < 1e-3 * most,
                "{found} instead of {due} at {load}"
            );
        }
    }
}

/// Neither ties nor the tensile strength of the concrete count.
#[test]
fn ties_and_concrete_in_tension_are_left_out() {
    let [_, section] = described(StrengthLevel::Characteristic);
    let mut other = section.clone();
    other.ties = jostle_section::Ties::parse("d10 @ 100 mm").ok();
    assert!(other.ties.is_some() && section.concrete.tensile_strength > 0.0);
    other.concrete.tensile_strength = 0.0;
    assert_eq!(Interaction::new(&section), Interaction::new(&other));
}

/// The lowest layer just yields as the top is crushed: all stresses of bars follow from the straight line of strains, and the
/// resultant of the concrete from its law over the compressed depth.
#[test]
fn the_balanced_state_lies_on_the_surface() {
    let column = column();
    let [section, _] = described(StrengthLevel::Characteristic);
    // Neutral axis: 0.46 · 0.0033/(0.0033 + 0.002) = 0.28642 m. Strains of the layers: 0.0028391 and 0.0012261 in compression,
    // 0.0003870 and 0.002 in tension; stresses 400, 245.2, −77.4 and −400 MPa.
    let axis = 0.46 * CRUSHED / (CRUSHED + STEEL / STEEL_MODULUS);
    let [mut force, mut moment] = [0.0; 2];
    for ([depth, area], stress) in column
        .layers
        .iter()
        .zip([400e6, 245.22e6, -77.39e6, -400e6])
    {
        let strain = CRUSHED * (1.0 - depth / axis);
        let net = (stress - concrete(strain)) * area;
        force += net;
        moment += net * (0.25 - depth);
    }
    // Simpson's rule over the compressed depth, in a hundred parts up to the peak and beyond it.
    let peak = 1e-6 * (700.0 + 172.0 * 20.1_f64.sqrt());
    let corner = axis * (1.0 - peak / CRUSHED);
    for [from, to] in [[0.0, corner], [corner, axis]] {
        for part in 0..100 {
            let at = |share: f64| from + (to - from) * (f64::from(part) + share) / 100.0;
            for (share, weight) in [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)] {
                let stress = concrete(CRUSHED * (1.0 - at(share) / axis));
                let push = stress * 0.5 * (to - from) / 100.0 * weight / 6.0;
                force += push;
                moment += push * (0.25 - at(share));
            }
        }
    }
    let curve = Interaction::new(&section);
    // The greatest moment of all states under this force is hardly more.
    let found = curve.moment(force);
    assert!(
        found > 0.998 * moment && found < 1.02 * moment,
        "{found} for {moment} at {force}"
    );
}

/// All bars yield in tension: the force is their sum, the moment that of their eccentricity; beyond it nothing is carried, nor
/// beyond the compression that crushes the whole.
#[test]
fn ends_of_the_surface_are_those_of_bars_and_of_the_whole_section() {
    for (section, by_hand) in described(StrengthLevel::Characteristic)
        .iter()
        .zip([column(), uneven()])
    {
        let [positive, negative] = Interaction::of_both_signs(section);
        let tension = STEEL * by_hand.steel_area();
        let eccentric: f64 = by_hand
            .layers
            .iter()
            .map(|[depth, area]| STEEL * area * (depth - 0.5 * by_hand.depth))
            .sum();
        for (curve, by_hand, moment) in [
            (&positive, &by_hand, eccentric),
            (&negative, &by_hand.upside_down(), -eccentric),
        ] {
            let [least, most] = curve.range();
            close(least, -tension, 1e-9, "all bars in tension");
            close(most, by_hand.squash(), 2e-3, "the whole in compression");
            let end = curve.moment(least);
            assert!(
                (end - moment.max(0.0)).abs() < 1e-9 * tension * by_hand.depth,
                "{end} instead of {moment}"
            );
            assert_eq!(curve.moment(1.001 * most), 0.0);
            assert_eq!(curve.moment(1.001 * least), 0.0);
        }
    }
}

/// What members of a run are compared with: moments over the compression as the surface has them, the first of the bottom in
/// tension, divided by γRE of GB 50010, table 11.1.6, with design strengths and by that rule only.
#[test]
fn members_get_the_moments_of_their_section_by_rule() {
    for level in [StrengthLevel::Characteristic, StrengthLevel::Design] {
        let [_, section] = described(level);
        let surface = [&section, &section.flipped()].map(Interaction::new);
        let rated = |member| RatedMember {
            section: &section,
            member,
            clear_length: 2.7,
            level,
        };
        let rules = [ShearRule::Gb50010, ShearRule::En1998];
        let crushing = section.concrete.strength * 0.4 * 0.6;
        for (member, loads) in [
            (
                Member::Column,
                &[-2e5, 1e5, 0.3 * crushing, 0.7 * crushing][..],
            ),
            (Member::Beam, &[-2e5, 0.0, 5e5][..]),
        ] {
            let found = rated(member).capacities(&rules);
            for &load in loads {
                // Beams are taken without axial force.
                let counts = if member == Member::Beam { 0.0 } else { load };
                let reduction = match level {
                    StrengthLevel::Design if counts > 0.15 * crushing => 0.8,
                    StrengthLevel::Design => 0.75,
                    _ => 1.0,
                };
                for (curve, moment) in surface.iter().zip([1.0, -1.0]) {
                    let due = curve.moment(counts);
                    for (rule, reduction) in found.iter().zip([reduction, 1.0]) {
                        let capacity = rule.bending_at(load, moment);
                        close(capacity, due / reduction, 1e-9, rule.rule);
                    }
                }
            }
        }
        // The bottom has more than three times the steel of the top.
        let [bottom, top] = surface.map(|curve| curve.moment(0.0));
        assert!(bottom > 2.0 * top, "{bottom} and {top}");
    }
}

/// Beyond the compression that crushes the whole section, or the tension of all bars, no moment is small enough: the ratio is at
/// least that of the axial forces, also where the section carries a moment at that end because its bars are uneven.
#[test]
fn beyond_the_axial_strength_every_moment_is_too_much() {
    for section in described(StrengthLevel::Characteristic) {
        let rated = RatedMember {
            section: &section,
            member: Member::Column,
            clear_length: 2.7,
            level: StrengthLevel::Characteristic,
        };
        let capacities = rated.capacities(&[ShearRule::En1998]);
        let surfaces = Interaction::of_both_signs(&section);
        for (surface, sign) in surfaces.iter().zip([1.0, -1.0]) {
            for end in surface.range() {
                for beyond in [1.001, 1.3, 4.0] {
                    for moment in [1e-6, 1e3, 5e4, 4e5] {
                        let found = capacities[0].bending_ratio(beyond * end, [sign * moment, 0.0]);
                        assert!(
                            found >= beyond * (1.0 - 1e-9) && found.is_finite(),
                            "{found} under {beyond} · {end} N and {moment} N·m"
                        );
                    }
                }
            }
        }
    }
}
