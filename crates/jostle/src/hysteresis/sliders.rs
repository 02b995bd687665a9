//! Kinematic hardening as springs in parallel: two of them end in sliders, one goes on for ever (Iwan, 1966).
//!
//! The first slider has stiffness k₁ − k₂ and gives way at the cracking deformation of either side, the second
//! k₂ − k₃ and the yield deformation; the last spring has k₃. After a reversal each takes twice its deformation
//! to give way again, which is Masing's rule. A slider is kept as the deformation at which it has no force: that
//! only changes while it slides.

use super::backbone::{Backbone, Side};
use super::memory::{HysteresisMemory, Response};

/// A spring behind a slider.
struct Slider {
    stiffness: f64,
    /// Deformation of the spring at which the slider moves, towards either side.
    reach: [f64; 2],
}

fn sliders(backbone: &Backbone) -> [Slider; 2] {
    let [positive, negative] = Side::BOTH.map(|side| backbone.side(side));
    // A bilinear curve has no second slope of its own: the first slider is then without stiffness.
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

#[inline]
pub(super) fn respond(
    backbone: &Backbone,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let last = backbone.side(Side::Positive).post_yield;
    let (from, side) = (
        memory.deformation,
        Side::of(deformation - memory.deformation),
    );
    let mut response = Response {
        force: last * deformation,
        tangent: last,
        work: 0.5 * last * (deformation + from) * (deformation - from),
        memory: *memory,
    };
    for (slider, offset) in sliders(backbone).iter().zip(&mut response.memory.offsets) {
        let Slider { stiffness, reach } = slider;
        let limit = side.sign() * reach[side.index()];
        let before = (from - *offset).clamp(-reach[1], reach[0]);
        let stretch = deformation - *offset;
        let slides = side.sign() * (stretch - limit) >= 0.0;
        let after = if slides { limit } else { stretch };
        let slid = if slides { stretch - limit } else { 0.0 };
        response.force += stiffness * after;
        response.work += stiffness * (0.5 * (after + before) * (after - before) + after * slid);
        if slides {
            *offset = deformation - limit;
        } else {
            response.tangent += stiffness;
        }
    }
    response
}

pub(super) fn next_corner(backbone: &Backbone, memory: &HysteresisMemory, towards: Side) -> f64 {
    let sign = towards.sign();
    sliders(backbone)
        .iter()
        .zip(memory.offsets)
        .filter(|(slider, _)| slider.stiffness > 0.0)
        .map(|(slider, offset)| offset + sign * slider.reach[towards.index()])
        // What slides already has its corner here, within rounding.
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
