//! Kinematic hardening as springs in parallel: two of them are in series with sliders, one is elastic (Iwan, 1966).
//!
//! The first spring has stiffness k₁ − k₂ and slips at the cracking deformation of either side; the second has k₂ −
//! k₃ and slips at the yield deformation; the last has k₃. After a reversal each needs twice its deformation to
//! slip again, which is Masing's rule. A slider is stored as the deformation at which it has no force; this changes
//! only while it slips.

use super::backbone::{Backbone, Side};
use super::memory::{HysteresisMemory, Response};

/// A spring in series with a slider.
struct Slider {
    stiffness: f64,
    /// Deformation of the spring at which the slider slips, for either side.
    reach: [f64; 2],
}

fn sliders(backbone: &Backbone) -> [Slider; 2] {
    let [positive, negative] = Side::BOTH.map(|side| backbone.side(side));
    // A bilinear curve has no second slope: the first slider then has no stiffness.
    let second = if backbone.is_bilinear() {
        backbone.initial()
    } else {
        positive.post_cracking
    };
    [
        Slider {
            stiffness: backbone.initial() - second,
            reach: [positive.cracking.deformation, negative.cracking.deformation],
        },
        Slider {
            stiffness: second - positive.post_yield,
            reach: [positive.yielding.deformation, negative.yielding.deformation],
        },
    ]
}

/// Force \[N·m or N\] and tangent at a deformation, and the deformation at which each slider then has no force.
pub(super) struct Answer {
    pub(super) force: f64,
    pub(super) tangent: f64,
    pub(super) offsets: [f64; 3],
}

/// Largest deformation of a slider towards a side, with the sign of the side, and whether it slips there.
#[inline]
fn limit_of(slider: &Slider, stretch: f64, side: Side) -> (f64, bool) {
    let limit = side.sign() * slider.reach[side.index()];
    (limit, side.sign() * (stretch - limit) >= 0.0)
}

#[inline]
pub(super) fn answer(backbone: &Backbone, memory: &HysteresisMemory, deformation: f64) -> Answer {
    let last = backbone.side(Side::Positive).post_yield;
    let side = Side::from_change(deformation - memory.deformation);
    let mut answer = Answer {
        force: last * deformation,
        tangent: last,
        offsets: memory.offsets,
    };
    for (slider, offset) in sliders(backbone).iter().zip(&mut answer.offsets) {
        let stretch = deformation - *offset;
        let (limit, slides) = limit_of(slider, stretch, side);
        answer.force += slider.stiffness * if slides { limit } else { stretch };
        answer.tangent += if slides { 0.0 } else { slider.stiffness };
        *offset = if slides { deformation - limit } else { *offset };
    }
    answer
}

pub(super) fn respond(
    backbone: &Backbone,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let Answer {
        force,
        tangent,
        offsets,
    } = answer(backbone, memory, deformation);
    let last = backbone.side(Side::Positive).post_yield;
    let (from, side) = (
        memory.deformation,
        Side::from_change(deformation - memory.deformation),
    );
    let mut work = 0.5 * last * (deformation + from) * (deformation - from);
    for (slider, offset) in sliders(backbone).iter().zip(memory.offsets) {
        let Slider { stiffness, reach } = slider;
        let before = (from - offset).clamp(-reach[1], reach[0]);
        let stretch = deformation - offset;
        let (limit, slides) = limit_of(slider, stretch, side);
        let after = if slides { limit } else { stretch };
        let slid = if slides { stretch - limit } else { 0.0 };
        work += stiffness * (0.5 * (after + before) * (after - before) + after * slid);
    }
    Response {
        force,
        tangent,
        work,
        memory: HysteresisMemory { offsets, ..*memory },
    }
}

/// Energy of the springs, ≥ 0 \[J\]. The rest of the work was done by sliders that slip.
pub(super) fn stored_energy(backbone: &Backbone, memory: &HysteresisMemory) -> f64 {
    let last = backbone.side(Side::Positive).post_yield;
    let springs = sliders(backbone).into_iter().zip(memory.offsets);
    let springs = springs.map(|(slider, offset)| (slider.stiffness, offset));
    let energy =
        |(stiffness, offset): (f64, f64)| 0.5 * stiffness * (memory.deformation - offset).powi(2);
    springs.chain([(last, 0.0)]).map(energy).sum()
}

pub(super) fn next_corner(backbone: &Backbone, memory: &HysteresisMemory, towards: Side) -> f64 {
    let sign = towards.sign();
    sliders(backbone)
        .iter()
        .zip(memory.offsets)
        .filter(|(slider, _)| slider.stiffness > 0.0)
        .map(|(slider, offset)| offset + sign * slider.reach[towards.index()])
        // A slider that slips already is at its corner, within rounding.
        .filter(|corner| {
            let here = memory.deformation;
            sign * (corner - here) > 4.0 * f64::EPSILON * (here.abs() + corner.abs())
        })
        .fold(sign * f64::INFINITY, |nearest, corner| {
            if sign * corner < sign * nearest {
                corner
            } else {
                nearest
            }
        })
}
