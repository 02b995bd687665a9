//! Time of one answer of a hysteretic spring, half of them on a path through corners.

use divan::{Bencher, black_box};
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule};

fn main() {
    divan::main();
}

#[divan::bench(args = ["normal", "peak-oriented", "takeda", "d-tri"])]
fn a_thousand_answers(bencher: Bencher<'_, '_>, name: &str) {
    let corners = Corners {
        cracking: 0.001,
        yielding: 0.006,
        post_cracking: 0.3,
        post_yield: 0.02,
    };
    let backbone = Backbone::from_deformations(1e5, corners, corners).expect("sound");
    let rule = match name {
        "normal" => HysteresisRule::Normal,
        "peak-oriented" => HysteresisRule::PeakOriented,
        "takeda" => HysteresisRule::Takeda { exponent: 0.4 },
        _ => HysteresisRule::DegradingTrilinear,
    };
    let spring = Hysteresis::new(rule, backbone).expect("the rule fits");
    let path: Vec<f64> = (0..1000)
        .map(|n| 0.012 * (0.031 * f64::from(n)).sin() * (0.0013 * f64::from(n)).cos())
        .collect();
    bencher.bench_local(|| {
        path.iter()
            .fold(HysteresisMemory::default(), |memory, deformation| {
                spring.respond(black_box(&memory), *deformation).memory
            })
    });
}
