//! What every rule must keep, on random springs through random histories.

use jostle::hysteresis::{HysteresisMemory, HysteresisRule, Side, Stage};
use proptest::prelude::*;

use crate::hysteresis::support::{Case, cases, walk};

fn damaged(case: &Case) -> bool {
    matches!(case.spring.rule(), HysteresisRule::Pinched(pinching) if pinching.ductility_damage > 0.0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Points on the way leave the same bits behind and do the same work.
    #[test]
    fn substeps_change_nothing(case in cases(false), cuts in prop::collection::vec(0.0..1.0_f64, 1..6)) {
        let mut cuts = cuts;
        cuts.sort_by(f64::total_cmp);
        let (mut memory, mut here) = (HysteresisMemory::default(), 0.0);
        for &target in &case.path {
            let straight = case.spring.respond(&memory, target);
            let (mut divided, mut work) = (memory, 0.0);
            for cut in &cuts {
                let response = case.spring.respond(&divided, here + cut * (target - here));
                work += response.work;
                divided = response.memory;
            }
            let last = case.spring.respond(&divided, target);
            prop_assert_eq!(last.memory, straight.memory);
            prop_assert_eq!(last.force, straight.force);
            if last.work != 0.0 {
                prop_assert_eq!(last.tangent, straight.tangent);
            }
            work += last.work;
            let scale = case.force_scale() * (target - here).abs();
            // At every stop the slip is a difference of positions, each rounded.
            let stops = (cuts.len() + 1) as f64;
            let rounding = 2.0 * stops * f64::EPSILON * case.force_scale() * target.abs().max(here.abs());
            prop_assert!((work - straight.work).abs() <= 1e-12 * scale + rounding, "{work} and {}", straight.work);
            (memory, here) = (straight.memory, target);
        }
    }

    /// From corner to corner the force is straight, without jumps, and the tangent is its slope; the work is the
    /// area below.
    #[test]
    fn straight_lines_join_at_the_corners(case in cases(false)) {
        let mut memory = HysteresisMemory::default();
        let scale = case.force_scale();
        let steepest = case.spring.backbone().initial() * (1.0 + 1e-9);
        for &target in &case.path {
            let towards = Side::from_change(target - memory.deformation());
            let whole = case.spring.respond(&memory, target);
            let (mut work, mut pieces) = (0.0, 0);
            let mut at = memory;
            loop {
                let corner = case.spring.next_corner(&at, towards);
                prop_assert!(towards.sign() * (corner - at.deformation()) > 0.0);
                let end = if towards.sign() * (corner - target) < 0.0 { corner } else { target };
                let (from, span) = (at.deformation(), end - at.deformation());
                let response = case.spring.respond(&at, end);
                let rise = response.force - at.force();
                if span.abs() * case.spring.backbone().initial() > 1e-6 * scale {
                    for share in [0.02, 0.5, 0.98] {
                        let inner = case.spring.respond(&at, from + share * span);
                        let line = at.force() + share * rise;
                        prop_assert!((inner.force - line).abs() <= 1e-11 * scale, "{} off the line {line}", inner.force);
                        prop_assert!((inner.tangent * span - rise).abs() <= 1e-10 * scale, "slope {} but {}", inner.tangent, rise / span);
                    }
                }
                prop_assert!(rise * towards.sign() >= -1e-12 * scale, "force falls ahead");
                prop_assert!(rise.abs() <= steepest * span.abs() + 1e-12 * scale, "a jump of {rise} over {span}");
                work += 0.5 * (response.force + at.force()) * span;
                at = response.memory;
                pieces += 1;
                prop_assert!(pieces < 20, "too many corners on one way");
                if end == target { break; }
            }
            prop_assert!((at.force() - whole.force).abs() <= 1e-12 * scale);
            prop_assert!((work - whole.work).abs() <= 1e-11 * scale * (target - memory.deformation()).abs().max(target.abs()));
            memory = whole.memory;
        }
    }

    /// Turning back and forth without reaching a corner leaves no trace, however often.
    #[test]
    fn small_reversals_leave_no_trace(case in cases(false), share in 0.01..0.9_f64) {
        let mut memory = HysteresisMemory::default();
        for &target in &case.path {
            let response = case.spring.respond(&memory, target);
            let towards = Side::from_change(target - memory.deformation());
            let plain = response.memory;
            let corner = case.spring.next_corner(&plain, towards.opposite());
            let back = if corner.is_finite() { target + share * (corner - target) } else { 0.0 };
            let mut shaken = plain;
            for _ in 0..50 {
                shaken = case.spring.respond(&shaken, back).memory;
                shaken = case.spring.respond(&shaken, target).memory;
            }
            // One rounding of the deformation, however many reversals.
            let rounding = 2.0 * f64::EPSILON * case.spring.backbone().initial() * target.abs();
            prop_assert!((shaken.force() - plain.force()).abs() <= rounding + 1e-15 * case.force_scale());
            for probe in [1.5, 0.7, -0.3, -2.0] {
                let to = probe * target;
                let (a, b) = (case.spring.respond(&shaken, to), case.spring.respond(&plain, to));
                prop_assert!((a.force - b.force).abs() <= rounding + 1e-13 * case.force_scale(), "{} and {}", a.force, b.force);
            }
            memory = plain;
        }
    }

    /// No spring ever gives back more than it was given, a cycle that repeats itself takes energy, and energy is dissipated for good.
    #[test]
    fn energy_is_never_made(case in cases(false)) {
        let mut memory = HysteresisMemory::default();
        let (mut total, mut throughput, mut dissipated) = (0.0, 0.0, 0.0);
        let hardens = matches!(case.spring.rule(), HysteresisRule::Bilinear | HysteresisRule::Normal);
        for &target in &case.path {
            let response = case.spring.respond(&memory, target);
            total += response.work;
            throughput += response.work.abs();
            memory = response.memory;
            prop_assert!(total >= -1e-12 * throughput, "{total} J after {throughput} J");
            let left = total - case.spring.recoverable_energy(&memory);
            prop_assert!(left >= -1e-12 * throughput, "{left} J dissipated after {throughput} J");
            // What sliders dissipate is never got back.
            prop_assert!(!hardens || left >= dissipated - 1e-12 * throughput, "{left} J after {dissipated} J");
            dissipated = left;
        }
        if damaged(&case) {
            // A cycle with damage never closes.
            return Ok(());
        }
        for _ in 0..60 {
            total = 0.0;
            for &target in &case.path {
                let response = case.spring.respond(&memory, target);
                total += response.work;
                throughput += response.work.abs();
                memory = response.memory;
            }
        }
        prop_assert!(total >= -1e-12 * throughput, "a closed cycle gives {total} J");
    }

    /// With equal sides the answer to the opposite history is the opposite answer.
    #[test]
    fn equal_sides_answer_alike(case in cases(true)) {
        let (mut memory, mut mirrored) = (HysteresisMemory::default(), HysteresisMemory::default());
        for &target in &case.path {
            let a = case.spring.respond(&memory, target);
            let b = case.spring.respond(&mirrored, -target);
            prop_assert_eq!(a.force, -b.force);
            prop_assert_eq!(a.tangent, b.tangent);
            prop_assert_eq!(a.work, b.work);
            (memory, mirrored) = (a.memory, b.memory);
        }
    }

    /// Exchanging the sides mirrors the answer.
    #[test]
    fn exchanged_sides_mirror_the_answer(case in cases(false)) {
        let other = case.spring.mirrored();
        let (mut memory, mut mirrored) = (HysteresisMemory::default(), HysteresisMemory::default());
        for &target in &case.path {
            let (a, b) = (case.spring.respond(&memory, target), other.respond(&mirrored, -target));
            prop_assert!((a.force + b.force).abs() <= 1e-13 * case.force_scale());
            (memory, mirrored) = (a.memory, b.memory);
        }
    }

    /// The force stays below what the backbone allows.
    #[test]
    fn forces_stay_below_the_backbone(case in cases(false)) {
        let (mut memory, backbone) = (HysteresisMemory::default(), case.spring.backbone());
        for &target in &case.path {
            let response = case.spring.respond(&memory, target);
            memory = response.memory;
            prop_assert!(response.force.is_finite() && response.tangent >= 0.0);
            for side in Side::BOTH {
                let curve = backbone.side(side);
                let limit = match case.spring.rule() {
                    HysteresisRule::Elastic => f64::INFINITY,
                    // The last branch moves with the deformation.
                    HysteresisRule::Normal | HysteresisRule::Bilinear => {
                        curve.yielding.force + curve.post_yield * (side.sign() * target - curve.yielding.deformation)
                    }
                    // Damage moves the peak beyond the greatest deformation, and its force with it.
                    HysteresisRule::Pinched(_) if damaged(&case) => f64::INFINITY,
                    _ => curve.force_at(memory.greatest(side).max(curve.yielding.deformation)),
                };
                prop_assert!(side.sign() * response.force <= limit + 1e-12 * case.force_scale());
            }
        }
    }

    /// First loading follows the backbone, whatever the rule.
    #[test]
    fn first_loading_follows_the_backbone(case in cases(false), share in 0.0..5.0_f64) {
        let to = share * case.path[0];
        let response = case.spring.respond(&HysteresisMemory::default(), to);
        if case.spring.rule() != HysteresisRule::Elastic {
            prop_assert!((response.force - case.spring.backbone().force_at(to)).abs() <= 1e-12 * case.force_scale().max(response.force.abs()));
        }
        let side = Side::from_change(to);
        let ductility = case.spring.ductility(&response.memory, side);
        if case.spring.rule() != HysteresisRule::Elastic {
            prop_assert_eq!(case.spring.stage(&response.memory) == Stage::Yielded, ductility > 1.0);
        }
    }

    /// The parallel model advanced by increments of force, as it is usually written, gives the same.
    #[test]
    fn sliders_agree_with_increments_of_force(case in cases(true)) {
        let rule = case.spring.rule();
        if !matches!(rule, HysteresisRule::Normal | HysteresisRule::Bilinear) {
            return Ok(());
        }
        let (k1, curve) = (case.spring.backbone().initial(), case.spring.backbone().side(Side::Positive));
        let k2 = if rule == HysteresisRule::Normal { curve.post_cracking } else { k1 };
        let k3 = curve.post_yield;
        let parts = [(k1 - k2, curve.cracking.deformation), (k2 - k3, curve.yielding.deformation)];
        let (mut forces, mut here) = ([0.0; 2], 0.0);
        for (count, &target) in case.path.iter().enumerate() {
            let memory = walk(&case.spring, &case.path[..=count]);
            let mut total = k3 * target;
            for (force, (stiffness, reach)) in forces.iter_mut().zip(parts) {
                *force = (*force + stiffness * (target - here)).clamp(-stiffness * reach, stiffness * reach);
                total += *force;
            }
            here = target;
            prop_assert!((total - memory.force()).abs() <= 1e-12 * case.force_scale());
        }
    }
}
