//! Springs and histories to try.

use jostle::hysteresis::{
    Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule, Pinching, Side,
};
use proptest::prelude::*;

/// Rules whose parameters are not the usual ones.
const OTHER_PARAMETERS: [HysteresisRule; 6] = [
    HysteresisRule::Takeda { exponent: 0.0 },
    HysteresisRule::Takeda { exponent: 1.0 },
    pinched(0.5, 0.4, 0.5, 0.0, 0.0),
    pinched(1.0, 0.0, 1.0, 0.0, 0.0),
    pinched(0.0, 1.0, 0.3, 0.0, 0.0),
    pinched(0.3, 0.3, 0.4, 0.02, 0.02),
];

const fn pinched(
    deformation: f64,
    force: f64,
    unloading_exponent: f64,
    ductility_damage: f64,
    energy_damage: f64,
) -> HysteresisRule {
    HysteresisRule::Pinched(Pinching {
        deformation,
        force,
        unloading_exponent,
        ductility_damage,
        energy_damage,
    })
}

/// A spring and deformations to lead it through, in units of its greater yield deformation.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) spring: Hysteresis,
    pub(crate) path: Vec<f64>,
}

impl Case {
    /// Largest force the case can see.
    pub(crate) fn force_scale(&self) -> f64 {
        let furthest = self.path.iter().fold(0.0_f64, |a, d| a.max(d.abs()));
        let backbone = self.spring.backbone();
        Side::BOTH
            .iter()
            .map(|side| {
                let curve = backbone.side(*side);
                curve.force_at(furthest).max(curve.yielding.force)
            })
            .fold(0.0, f64::max)
    }
}

/// The memory after a path.
pub(crate) fn walk(spring: &Hysteresis, path: &[f64]) -> HysteresisMemory {
    path.iter()
        .fold(HysteresisMemory::default(), |memory, deformation| {
            spring.respond(&memory, *deformation).memory
        })
}

fn corners() -> impl Strategy<Value = Corners> {
    (-4.0..-1.0_f64, 0.0..1.3_f64, 0.05..0.95_f64, 0.0..0.9_f64).prop_map(
        |(cracking, yielding, post_cracking, share)| Corners {
            cracking: 10f64.powf(cracking),
            yielding: 10f64.powf(cracking + yielding + 0.02),
            post_cracking,
            post_yield: (share - 0.1).max(0.0) * post_cracking,
        },
    )
}

fn spring(symmetric: bool) -> impl Strategy<Value = Hysteresis> {
    let rules = [&HysteresisRule::ALL[..], &OTHER_PARAMETERS].concat();
    let rule = prop::sample::select(rules);
    (rule, 2.0..9.0_f64, corners(), corners()).prop_map(move |(rule, initial, a, mut b)| {
        // Sides of one member differ, but not by decades.
        let ratio = a.cracking / b.cracking * (0.3 + 3.0 * b.post_cracking);
        b.cracking *= ratio;
        b.yielding *= ratio;
        if matches!(
            rule,
            HysteresisRule::Normal | HysteresisRule::DegradingTrilinear
        ) {
            b.post_cracking = a.post_cracking;
            b.post_yield = a.post_yield;
        }
        if symmetric {
            b = a;
        }
        let [a, b] = match rule {
            HysteresisRule::Bilinear => {
                [a, b].map(|side| Corners::bilinear(side.yielding, a.post_yield))
            }
            _ => [a, b],
        };
        let backbone = Backbone::from_deformations(10f64.powf(initial), a, b).expect("sound");
        Hysteresis::new(rule, backbone).expect("the rule fits")
    })
}

/// Random springs of every rule with histories of large and small swings.
pub(crate) fn cases(symmetric: bool) -> impl Strategy<Value = Case> {
    let swing = prop_oneof![4 => -4.0..4.0_f64, 2 => -1.0..1.0_f64, 1 => -0.1..0.1_f64];
    (spring(symmetric), prop::collection::vec(swing, 1..30)).prop_map(|(spring, swings)| {
        let unit = Side::BOTH
            .iter()
            .map(|side| spring.backbone().side(*side).yielding.deformation)
            .fold(0.0, f64::max);
        let path = swings.into_iter().map(|swing| swing * unit).collect();
        Case { spring, path }
    })
}
