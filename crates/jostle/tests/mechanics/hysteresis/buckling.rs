//! Braces that buckle, against the equations of a hinged strut and fibre analyses by OpenSees.

use jostle::hysteresis::{BucklingBrace, Hysteresis, HysteresisMemory, Side, Stage};
use proptest::prelude::*;

/// A square tube of S275 by its side, wall and length, curve a: λ, χ and e₀ from its sizes.
fn of_sizes([side, wall, length]: [f64; 3], later: f64) -> BucklingBrace {
    let (modulus, strength) = (210e9, 275e6);
    let inner = side - 2.0 * wall;
    let area = side * side - inner * inner;
    let inertia = (side.powi(4) - inner.powi(4)) / 12.0;
    let arm = 0.25 * (side.powi(3) - inner.powi(3)) / area;
    let slenderness =
        length / (inertia / area).sqrt() / std::f64::consts::PI * f64::sqrt(strength / modulus);
    let half = 0.5 * (1.0 + 0.21 * (slenderness - 0.2) + slenderness * slenderness);
    let share = 1.0 / (half + (half * half - slenderness * slenderness).sqrt());
    BucklingBrace {
        stiffness: modulus * area / length,
        yield_force: area * strength,
        post_yield: 0.01,
        buckling_force: share * area * strength,
        later,
        slenderness,
        shortening: 2.0 * arm * arm / length,
    }
}

fn tube(later: f64) -> BucklingBrace {
    of_sizes([0.16, 0.008, 5.0], later)
}

fn spring(brace: BucklingBrace) -> Hysteresis {
    Hysteresis::buckling(brace).expect("sound")
}

/// Bow over Mp/Ny of a strut whose hinge bears (1 − n²), and by how much its kink is smaller or greater.
fn bow(n: f64) -> f64 {
    (1.0 - n * n) / n
}

/// Elastic to buckling, then a polygon whose corners lie on the curve of the hinged strut: shortening n dy + e₀ y² and the flow of the hinge;
/// at zero force the kink stays, and under tension the strut follows the mirrored curve to yield.
#[test]
fn every_branch_has_its_closed_form() {
    let strut = tube(1.0);
    let law = spring(strut);
    let (k, strength) = (strut.stiffness, strut.yield_force);
    let soft = std::f64::consts::PI.powi(2) / 12.0 * strut.slenderness.powi(2);
    let kink = |n: f64| bow(n) * (1.0 - soft * n);
    let mut memory = HysteresisMemory::default();
    let first = law.next_corner(&memory, Side::Negative);
    let buckles = strut.buckling_force / k;
    assert!((first + buckles).abs() < 1e-15);
    let just = law.respond(&memory, -0.999 * buckles);
    assert!((just.force + 0.999 * strut.buckling_force).abs() < 1e-9 * strength);
    assert_eq!(law.stage(&just.memory), Stage::Uncracked);
    // Along compression every corner obeys the equations; the flow is a sum of trapezoids.
    memory = just.memory;
    let (mut n0, mut x0, mut flow) = (strut.buckling_force / strength, 0.0, 0.0);
    let mut corners = Vec::new();
    memory = law.respond(&memory, -buckles).memory;
    for number in 0..12 {
        let corner = law.next_corner(&memory, Side::Negative);
        assert!(corner < memory.deformation());
        let response = law.respond(&memory, corner);
        let n = -response.force / strength;
        let x = kink(n);
        flow += 2.0 * strut.shortening * (n + n0) * (x - x0);
        let due = n * strength / k + strut.shortening * bow(n) * bow(n) + flow;
        assert!(
            (corner + due).abs() < 1e-12,
            "corner {number}: {corner} {due}"
        );
        assert_eq!(law.stage(&response.memory), Stage::Buckled);
        corners.push((n, x, flow));
        (n0, x0) = (n, x);
        memory = response.memory;
    }
    assert!(corners[11].0 < 0.1 && corners[0].0 < strut.buckling_force / strength);
    // The eighth corner: unloading to the kink alone, then to the mirrored curve.
    memory = HysteresisMemory::default();
    for _ in 0..9 {
        let to = law.next_corner(&memory, Side::Negative);
        memory = law.respond(&memory, to).memory;
    }
    let (n, x, flow) = corners[7];
    assert!((memory.force() + n * strength).abs() < 1e-9 * strength);
    let zero = law.next_corner(&memory, Side::Positive);
    let due = -flow - strut.shortening * x * x;
    assert!((zero - due).abs() < 1e-12, "{zero} {due}");
    let response = law.respond(&memory, zero);
    assert!(response.force.abs() < 1e-9 * strength);
    let back = 0.5 * (n * strength) * (zero - memory.deformation());
    assert!((law.recoverable_energy(&memory) / back - 1.0).abs() < 1e-9);
    memory = response.memory;
    // Under tension n obeys (1 − n²)(1 + c n) = n x at every corner, and the strut grows as its hinge turns back.
    let mut place = 7;
    let mut grown = -flow;
    let mut last: Option<(f64, f64)> = None;
    while place > 0 {
        let corner = law.next_corner(&memory, Side::Positive);
        let response = law.respond(&memory, corner);
        let n = response.force / strength;
        let x = corners[place].1;
        let residual = (1.0 - n * n) * (1.0 + soft * n) - n * x;
        assert!(residual.abs() < 1e-9, "{place}: {residual}");
        if let Some((n0, x0)) = last {
            grown += 2.0 * strut.shortening * (n + n0) * (x0 - x);
        }
        let due = grown + n * strength / k - strut.shortening * bow(n) * bow(n);
        assert!((corner - due).abs() < 1e-12, "{place}: {corner} {due}");
        last = Some((n, x));
        memory = response.memory;
        place -= 1;
    }
    let (n0, x0) = last.expect("corners");
    let corner = law.next_corner(&memory, Side::Positive);
    let response = law.respond(&memory, corner);
    // corners[0] is the last kink before the strut is straight.
    let (n1, x1) = (response.force / strength, corners[0].1);
    grown += 2.0 * strut.shortening * (n0 + n1) * (x0 - x1);
    memory = response.memory;
    let straight = law.next_corner(&memory, Side::Positive);
    grown += 2.0 * strut.shortening * (n1 + 1.0) * x1;
    assert!((straight - grown - strength / k).abs() < 1e-12);
    let response = law.respond(&memory, straight + 0.004);
    assert!((response.force - strength - 0.004 * 0.01 * k).abs() < 1e-9 * strength);
    assert!(grown > 0.0, "a straightened brace has grown: {grown}");
    // It buckles again where it is straight, at the buckling force or the share that is left.
    let again = law.respond(&response.memory, response.memory.deformation() - 1.0);
    assert!(again.force < 0.0);
    let elastic = response.memory.deformation() - response.force / k;
    let at = elastic - buckles;
    assert!((law.respond(&response.memory, at).force / strut.buckling_force + 1.0).abs() < 1e-9);
    let weak = spring(tube(0.6));
    let mut memory = HysteresisMemory::default();
    for to in [-0.03, straight + 0.004] {
        memory = weak.respond(&memory, to).memory;
    }
    let elastic = memory.deformation() - memory.force() / k;
    let at = |share: f64| {
        let to = elastic - share * strut.buckling_force / k;
        weak.respond(&memory, to).force / strut.buckling_force
    };
    assert!(
        (at(0.599) + 0.599).abs() < 1e-9 && at(0.8) > -0.6001,
        "{}",
        at(0.8)
    );
}

/// Fibre analyses with initial camber: buckling forces by curve a, forces after buckling, later buckling and energy of cycles from stocky to slender
/// tubes. The hinge is a model of yielding that spreads, and Steel02 rounds its corners: the differences are those of theory.
#[test]
fn fibre_braces_buckle_alike() {
    let stored: serde_json::Value =
        serde_json::from_str(include_str!("data/buckling_tubes.json")).expect("sound");
    let mut worst = [0.0_f64; 4];
    for case in stored["cases"].as_array().expect("cases") {
        let number = |value: &serde_json::Value, key: &str| value[key].as_f64().expect("a number");
        let sizes = ["side", "wall", "length"].map(|key| number(case, key));
        let brace = BucklingBrace {
            post_yield: 0.003,
            ..of_sizes(sizes, 0.65)
        };
        let law = spring(brace);
        let mut memory = HysteresisMemory::default();
        let (mut done, mut due) = (0.0, 0.0);
        for (leg, stored) in case["legs"].as_array().expect("legs").iter().enumerate() {
            let to = number(stored, "to");
            let (from, mut peak) = (memory.deformation(), 0.0_f64);
            for step in 1..=4000 {
                let response = law.respond(&memory, from + f64::from(step) / 4000.0 * (to - from));
                memory = response.memory;
                done += response.work;
                let side = f64::signum(to - from);
                peak = side * (side * peak).max(side * response.force);
            }
            due += number(stored, "work");
            let ratio = |found: f64, key: &str| found / number(stored, key) - 1.0;
            let [peak, end] = [ratio(peak, "peak"), ratio(memory.force(), "end")];
            let kind = match leg {
                0 => 0,
                _ => 1 + leg % 2,
            };
            worst[kind] = worst[kind].max(peak.abs());
            if leg % 2 == 0 {
                worst[3] = worst[3].max(end.abs());
            }
        }
        assert!((done / due - 1.0).abs() < 0.16, "energy {done} for {due}");
    }
    // First buckling, later buckling, tension, force at the greatest shortening.
    for (worst, limit) in worst.into_iter().zip([0.06, 0.2, 0.045, 0.125]) {
        assert!(worst < limit, "{worst} for {limit}");
    }
}

/// Struts from stocky to slender, deformations in units of the yield deformation.
fn cases() -> impl Strategy<Value = (Hysteresis, Vec<f64>, f64)> {
    let brace = (
        0.3..2.5_f64,
        0.02..1.0_f64,
        0.3..1.0_f64,
        0.0..0.05_f64,
        0.3..0.99_f64,
    );
    let swing = prop_oneof![4 => -8.0..4.0_f64, 2 => -1.0..1.0_f64, 1 => -0.1..0.1_f64];
    (brace, prop::collection::vec(swing, 1..30)).prop_map(|(numbers, swings)| {
        let (slenderness, scale, later, post_yield, share) = numbers;
        let (stiffness, yield_force) = (1e8, 7e5);
        let unit = yield_force / stiffness;
        let brace = BucklingBrace {
            stiffness,
            yield_force,
            post_yield,
            buckling_force: share * yield_force * f64::min(1.0, slenderness.powi(-2)),
            later,
            slenderness,
            shortening: scale * unit,
        };
        let path = swings.into_iter().map(|swing| swing * unit).collect();
        (spring(brace), path, yield_force)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Points on the way leave the same bits behind and do the same work.
    #[test]
    fn substeps_change_nothing((law, path, scale) in cases(), cuts in prop::collection::vec(0.0..1.0_f64, 1..6)) {
        let mut cuts = cuts;
        cuts.sort_by(f64::total_cmp);
        let (mut memory, mut here) = (HysteresisMemory::default(), 0.0);
        for to in path {
            let straight = law.respond(&memory, to);
            let (mut divided, mut work) = (memory, 0.0);
            for cut in &cuts {
                let response = law.respond(&divided, here + cut * (to - here));
                work += response.work;
                divided = response.memory;
            }
            let last = law.respond(&divided, to);
            work += last.work;
            prop_assert_eq!(last.memory, straight.memory);
            prop_assert!((work - straight.work).abs() <= 1e-11 * scale * f64::abs(to - here).max(to.abs()));
            (memory, here) = (straight.memory, to);
        }
    }

    /// The force has no jumps, its tangent is the slope of the line, and no line is steeper than the elastic brace, rising or falling.
    #[test]
    fn straight_lines_join_at_the_corners((law, path, scale) in cases()) {
        let mut memory = HysteresisMemory::default();
        let stiffness = law.backbone().initial() * (1.0 + 1e-9);
        for to in path {
            let towards = Side::from_change(to - memory.deformation());
            let whole = law.respond(&memory, to);
            let (mut at, mut work, mut pieces) = (memory, 0.0, 0);
            while at.deformation() != to {
                let corner = law.next_corner(&at, towards);
                prop_assert!(towards.sign() * (corner - at.deformation()) > 0.0);
                let end = if towards.sign() * (corner - to) < 0.0 { corner } else { to };
                let span = end - at.deformation();
                let response = law.respond(&at, end);
                let rise = response.force - at.force();
                for share in [0.02, 0.5, 0.98] {
                    let inner = law.respond(&at, at.deformation() + share * span);
                    prop_assert!((inner.force - at.force() - share * rise).abs() <= 1e-9 * scale);
                    prop_assert!((inner.tangent * span - rise).abs() <= 1e-9 * scale);
                }
                prop_assert!(rise.abs() <= stiffness * span.abs() + 1e-9 * scale, "{rise} over {span}");
                work += 0.5 * (response.force + at.force()) * span;
                at = response.memory;
                pieces += 1;
                prop_assert!(pieces < 60);
            }
            prop_assert!((at.force() - whole.force).abs() <= 1e-9 * scale);
            prop_assert!((work - whole.work).abs() <= 1e-9 * scale * f64::abs(to - memory.deformation()).max(to.abs()));
            prop_assert!(whole.force <= law.strength_left(&memory).max(whole.memory.force()) && whole.force.is_finite());
            memory = whole.memory;
        }
    }

    /// Turning back and forth without reaching a corner leaves no trace; no brace gives back more than it was given.
    #[test]
    fn energy_is_never_made_and_small_reversals_leave_no_trace((law, path, scale) in cases(), share in 0.01..0.9_f64) {
        let mut memory = HysteresisMemory::default();
        let (mut total, mut throughput) = (0.0, 0.0);
        for _ in 0..3 {
            for &to in path.iter() {
                if to == memory.deformation() {
                    continue;
                }
                let response = law.respond(&memory, to);
                total += response.work;
                throughput += response.work.abs();
                let left = total - law.recoverable_energy(&response.memory);
                prop_assert!(left >= -1e-9 * throughput, "{left} J dissipated after {throughput} J");
                let towards = Side::from_change(to - memory.deformation());
                memory = response.memory;
                let corner = law.next_corner(&memory, towards.opposite());
                let mut shaken = memory;
                for _ in 0..5 {
                    shaken = law.respond(&shaken, to + share * (corner - to)).memory;
                    shaken = law.respond(&shaken, to).memory;
                }
                for probe in [1.5, 0.7, -0.3, -2.0] {
                    let [a, b] = [shaken, memory].map(|memory| law.respond(&memory, probe * to).force);
                    prop_assert!((a - b).abs() <= 1e-8 * scale, "{a} and {b}");
                }
            }
        }
    }
}
