//! Springs that fail, whose strength is lowered before.

use jostle::hysteresis::{FallingBranch, Hysteresis, HysteresisMemory};

/// 100 N at 0.1 mm, then 0.1 N/µm less, down to 10 N.
fn spring() -> Hysteresis {
    let falling = FallingBranch {
        slope: 1e5,
        residual: 10.0,
    };
    Hysteresis::failing(1e6, 100.0, falling).expect("sound")
}

/// Memory after a path that starts at rest, and the force at its end.
fn after(memory: &HysteresisMemory, deformation: f64) -> (HysteresisMemory, f64) {
    let response = spring().respond(memory, deformation);
    (response.memory, response.force)
}

#[track_caller]
fn close(found: f64, due: f64) {
    assert!((found - due).abs() < 1e-9, "{found} instead of {due}");
}

#[test]
fn it_fails_at_the_lower_strength() {
    let mut memory = HysteresisMemory::default();
    spring().weaken(&mut memory, 80.0);
    // Never higher again.
    spring().weaken(&mut memory, 150.0);
    close(after(&memory, 70e-6).1, 70.0);
    // 80 N at 80 µm, 20 µm further 2 N less.
    close(after(&memory, 100e-6).1, 78.0);
}

#[test]
fn below_the_force_it_bears_it_fails_from_there() {
    let (mut memory, _) = after(&HysteresisMemory::default(), 60e-6);
    spring().weaken(&mut memory, 40.0);
    close(after(&memory, 60e-6).1, 60.0);
    close(after(&memory, 70e-6).1, 59.0);
}

#[test]
fn after_failure_its_strength_stays() {
    let (mut memory, force) = after(&HysteresisMemory::default(), 200e-6);
    close(force, 90.0);
    spring().weaken(&mut memory, 50.0);
    close(after(&memory, 210e-6).1, 89.0);
}
