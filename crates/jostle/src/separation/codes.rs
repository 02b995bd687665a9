//! Widths of seismic joints by national codes, from displacements, heights and factors.
//!
//! `docs/how-to/required-gap.md` lists the sources that confirm every formula.

use super::{EN1998_ALIGNED_FLOORS, absolute_sum, srss};

/// EN 1998-1 §4.4.2.7: between buildings of one property, the square root of the sum of squares of the displacements
/// d_s of the seismic design situation; 0.7 of it if all floors lie at equal height (3) \[m\].
///
/// d_s = q_d d_e (§4.3.4) for forces divided by the behaviour factor.
#[must_use]
pub fn en1998_joint(displacements: [f64; 2], floors_are_level: bool) -> f64 {
    let [left, right] = displacements;
    let reduction = if floors_are_level {
        EN1998_ALIGNED_FLOORS
    } else {
        1.0
    };
    reduction * srss(left, right)
}

/// ASCE 7-16 Eq. (12.12-1): greatest inelastic displacement δ_M = C_d δ_max / I_e, where δ_max belongs to forces divided
/// by R / I_e \[m\].
///
/// `amplification` C_d and `importance` I_e > 0 \[–\]. Between structures of one property Eq. (12.12-2) requires the
/// square root of the sum of squares of both; at a property line each structure keeps its own δ_M.
#[must_use]
pub fn asce7_displacement(elastic: f64, amplification: f64, importance: f64) -> f64 {
    amplification * elastic / importance
}

/// TBDY 2018 §4.9.3.2: least width of a joint \[m\]: 30 mm up to a height of 6 m, and 10 mm more for every further 3 m
/// or part of it.
///
/// `height` of the place above the base \[m\].
#[must_use]
pub fn tbdy2018_least_joint(height: f64) -> f64 {
    // Heights are sums of storeys: their rounding must not start another 3 m.
    0.03 + 0.01 * ((height - 6.0) / 3.0 - 1e-9).ceil().max(0.0)
}

/// TBDY 2018 §4.9.3.1: α √(u₁² + u₂²) with reduced displacements u and α = 0.25 R/I if all floors lie at equal height,
/// otherwise 0.5 R/I; at least [`tbdy2018_least_joint`] \[m\].
///
/// `unreduced` displacements are u R/I of either building, so that each has its own factors \[m\]; `height` as there.
#[must_use]
pub fn tbdy2018_joint(unreduced: [f64; 2], floors_are_level: bool, height: f64) -> f64 {
    let [left, right] = unreduced;
    let share = if floors_are_level { 0.25 } else { 0.5 };
    (share * srss(left, right)).max(tbdy2018_least_joint(height))
}

/// NTC 2018 §7.2.1: sum of the greatest displacements at the life-safety limit state, at least h/100 times 2 a_g S/g,
/// which is taken as at most 1 \[m\].
///
/// `height` of the place above the foundation \[m\]; `ground_acceleration` a_g S over g \[–\].
#[must_use]
pub fn ntc2018_joint(displacements: [f64; 2], height: f64, ground_acceleration: f64) -> f64 {
    let [left, right] = displacements;
    let least = 0.01 * height * (2.0 * ground_acceleration).min(1.0);
    absolute_sum(left, right).max(least)
}

/// IS 1893 (Part 1): 2016 §7.11.3: R₁ Δ₁ + R₂ Δ₂ with the displacements Δ under the design forces \[m\].
///
/// `unreduced` displacements are R Δ of either building \[m\].
#[must_use]
pub fn is1893_joint(unreduced: [f64; 2]) -> f64 {
    let [left, right] = unreduced;
    absolute_sum(left, right)
}

/// E.030-2018 Art. 33.2: two thirds of the sum of the greatest displacements, at least 0.006 h and 30 mm \[m\].
///
/// `height` of the place above the ground \[m\].
#[must_use]
pub fn e030_2018_joint(displacements: [f64; 2], height: f64) -> f64 {
    let [left, right] = displacements;
    (2.0 / 3.0 * absolute_sum(left, right))
        .max(0.006 * height)
        .max(0.03)
}

/// E.030-2026 Art. 52.2: as [`e030_2018_joint`], with 0.02 Z S h instead of 0.006 h \[m\].
///
/// `zone` factor Z and `soil` factor S > 0 \[–\].
#[must_use]
pub fn e030_2026_joint(displacements: [f64; 2], height: f64, zone: f64, soil: f64) -> f64 {
    let [left, right] = displacements;
    (2.0 / 3.0 * absolute_sum(left, right))
        .max(0.02 * zone * soil * height)
        .max(0.03)
}

/// Displacements of E.030 over those of forces divided by R, over R: 0.75 of regular structures, 0.85 of irregular ones
/// (E.030-2018 Art. 31.1, E.030-2026 Art. 50) \[–\].
#[must_use]
pub fn e030_share(is_regular: bool) -> f64 {
    if is_regular { 0.75 } else { 0.85 }
}

/// The neighbour of a new building, NSR-10 table A.6.5-1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nsr10Neighbour {
    /// It stands on the line, and its slabs lie at the heights of the new ones.
    LevelSlabs,
    /// It stands on the line, and its slabs lie at other heights.
    OtherSlabs,
    /// There is none, or it keeps its own distance from the line.
    None,
}

/// NSR-10 §A.6.5.2.3 and table A.6.5-1: distance of a new building from the line of its lot \[m\].
///
/// Share of the `height` of the new building: up to two storeys nothing; three storeys 1 % beside slabs at other
/// heights; more storeys 2 % beside level slabs, 3 % beside others, 1 % without a neighbour. Zones of low hazard require
/// none (A.6.5.2.1).
#[must_use]
pub fn nsr10_setback(height: f64, storeys: usize, neighbour: Nsr10Neighbour) -> f64 {
    use Nsr10Neighbour as N;
    let share = match (storeys, neighbour) {
        (0..=2, _) | (3, N::LevelSlabs | N::None) => 0.0,
        (3, N::OtherSlabs) | (_, N::None) => 0.01,
        (_, N::LevelSlabs) => 0.02,
        (_, N::OtherSlabs) => 0.03,
    };
    share * height
}

/// Most storeys for which Iranian Standard 2800 accepts a share of the height.
pub const IRAN2800_MOST_STOREYS: usize = 8;

/// Iranian Standard 2800, 4th edition, §1-4-1: distance of a floor from the line of its lot \[m\].
///
/// 0.005 of its `height` above the base for buildings of up to eight storeys; for higher ones the inelastic `displacement` of
/// the design earthquake. Buildings of high and very high importance keep that displacement too, and here never less than
/// an ordinary building of as many storeys.
#[must_use]
pub fn iran2800_setback(height: f64, storeys: usize, is_important: bool, displacement: f64) -> f64 {
    let of_height = 0.005 * height;
    match (storeys <= IRAN2800_MOST_STOREYS, is_important) {
        (true, false) => of_height,
        (true, true) => displacement.abs().max(of_height),
        (false, _) => displacement.abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// To a hundredth of a millimetre.
    fn is(found: f64, millimetres: f64) {
        assert!(
            (1e3 * found - millimetres).abs() < 0.01,
            "{} mm instead of {millimetres} mm",
            1e3 * found
        );
    }

    /// §4.4.2.7(2)b: √(60² + 80²) = 100; (3): 0.7 · 100 = 70. √(50² + 120²) = 130; 0.7 · 130 = 91.
    #[test]
    fn en1998_takes_seven_tenths_between_level_floors() {
        is(en1998_joint([0.06, 0.08], false), 100.0);
        is(en1998_joint([0.06, 0.08], true), 70.0);
        is(en1998_joint([0.05, -0.12], false), 130.0);
        is(en1998_joint([0.05, -0.12], true), 91.0);
    }

    /// (12.12-1): 5.5 · 20 / 1.0 = 110 and 4 · 15 / 1.25 = 48; (12.12-2): √(110² + 48²) = √14 404 = 120.017.
    /// Two of 5 · 12 / 1.5 = 40: √(2 · 40²) = 56.569.
    #[test]
    fn asce7_amplifies_elastic_displacements() {
        let [left, right] = [
            asce7_displacement(0.020, 5.5, 1.0),
            asce7_displacement(0.015, 4.0, 1.25),
        ];
        is(left, 110.0);
        is(right, 48.0);
        is(srss(left, right), 120.017);
        let twin = asce7_displacement(0.012, 5.0, 1.5);
        is(srss(twin, twin), 56.569);
    }

    /// Worked example of a guide to the clause: u = 18 and 24 mm, R/I = 8, 12 m: α = 0.25 · 8 = 2, √(18² + 24²) = 30,
    /// so 60 mm; least width 30 + 2 · 10 = 50 mm; 120 mm with floors at different heights.
    /// Second: u = 3 and 4 mm, R/I = 4, 25 m: 1 · 5 = 5 mm; least width: 19 m above 6 m are 7 times 3 m, begun,
    /// 30 + 70 = 100 mm.
    #[test]
    fn tbdy2018_is_reduced_displacement_or_a_least_width() {
        let unreduced = [8.0 * 0.018, 8.0 * 0.024];
        is(tbdy2018_joint(unreduced, true, 12.0), 60.0);
        is(tbdy2018_joint(unreduced, false, 12.0), 120.0);
        is(tbdy2018_least_joint(12.0), 50.0);
        is(
            tbdy2018_joint([4.0 * 0.003, 4.0 * 0.004], true, 25.0),
            100.0,
        );
        is(tbdy2018_least_joint(6.0), 30.0);
        is(tbdy2018_least_joint(3.0), 30.0);
    }

    /// 45 + 60 = 105 mm, and at 16 m with a_g S = 0.25 g at least 16 000/100 · 0.5 = 80 mm. With a_g S = 0.6 g the factor
    /// 1.2 counts as 1: 16 000/100 = 160 mm.
    #[test]
    fn ntc2018_is_the_sum_or_a_hundredth_of_the_height() {
        is(ntc2018_joint([0.045, 0.060], 16.0, 0.25), 105.0);
        is(ntc2018_joint([0.020, 0.030], 16.0, 0.25), 80.0);
        is(ntc2018_joint([0.045, 0.060], 16.0, 0.6), 160.0);
    }

    /// R = 5 and 3, Δ = 12 and 20 mm: 60 + 60 = 120 mm. R = 5, Δ = 8 and 9 mm: 5 · 17 = 85 mm.
    #[test]
    fn is1893_adds_what_both_do_without_reduction() {
        is(is1893_joint([5.0 * 0.012, 3.0 * -0.020]), 120.0);
        is(is1893_joint([5.0 * 0.008, 5.0 * 0.009]), 85.0);
    }

    /// 2/3 (60 + 90) = 100 mm; 0.006 · 21 m = 126 mm counts instead. At 4 m: 2/3 (10 + 20) = 20 and 24 mm, so 30 mm.
    /// E.030-2026 with Z = 0.45 and S = 1.05 (a published example): 0.02 · 0.45 · 1.05 · 20 m = 189 mm; with Z = 0.1,
    /// S = 1.0: 0.02 · 0.1 · 12 m = 24 mm, so 2/3 (60 + 90) = 100 mm.
    #[test]
    fn e030_is_two_thirds_of_the_sum_or_a_share_of_the_height() {
        is(e030_2018_joint([0.06, 0.09], 10.0), 100.0);
        is(e030_2018_joint([0.06, 0.09], 21.0), 126.0);
        is(e030_2018_joint([0.01, 0.02], 4.0), 30.0);
        is(e030_2026_joint([0.06, 0.09], 20.0, 0.45, 1.05), 189.0);
        is(e030_2026_joint([0.06, 0.09], 12.0, 0.10, 1.0), 100.0);
    }

    /// Table A.6.5-1: five storeys, 15 m: 2 % are 300 mm, 3 % are 450 mm, 1 % is 150 mm. Three storeys, 9 m: nothing,
    /// 1 % is 90 mm, nothing. Two storeys: nothing.
    #[test]
    fn nsr10_takes_shares_of_the_height() {
        use Nsr10Neighbour as N;
        let all = [N::LevelSlabs, N::OtherSlabs, N::None];
        for (height, storeys, due) in [
            (15.0, 5, [300.0, 450.0, 150.0]),
            (9.0, 3, [0.0, 90.0, 0.0]),
            (6.0, 2, [0.0, 0.0, 0.0]),
        ] {
            for (neighbour, due) in all.into_iter().zip(due) {
                is(nsr10_setback(height, storeys, neighbour), due);
            }
        }
    }

    /// 0.005 · 24 m = 120 mm for eight storeys; nine storeys, or a hospital, by displacement.
    #[test]
    fn iran2800_takes_a_share_of_the_height_up_to_eight_storeys() {
        is(iran2800_setback(24.0, 8, false, 0.2), 120.0);
        is(iran2800_setback(27.0, 9, false, 0.2), 200.0);
        is(iran2800_setback(12.0, 4, true, -0.07), 70.0);
    }
}
