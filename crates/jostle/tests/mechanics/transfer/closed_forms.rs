//! What transfer matrices give by hand, without any solver, and static frames by their product.

use std::f64::consts::PI;

use jostle::RiccatiSweep;
use jostle::transfer::{
    BeamSegment, ElementwiseRiccati, Heading, LumpedMass, PlanarHinge, ProductEquations,
    StateVector, Transfer, one_in_two_out, two_in_one_out,
};
use jostle_testkit::compare::near;

use crate::transfer::support::{COLUMN, Variant, difference, frame, solution};

/// Roots of three affine functions of three unknowns, by Cramer's rule.
fn three_unknowns(left_over: impl Fn([f64; 3]) -> [f64; 3]) -> [f64; 3] {
    let constant = left_over([0.0; 3]);
    let column = |k: usize| -> [f64; 3] {
        let value = left_over(std::array::from_fn(|i| f64::from(u8::from(i == k))));
        std::array::from_fn(|i| value[i] - constant[i])
    };
    let columns = [column(0), column(1), column(2)];
    let determinant = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1])
            + c[0] * (a[1] * b[2] - a[2] * b[1])
    };
    let whole = determinant(columns);
    std::array::from_fn(|k| {
        let mut changed = columns;
        changed[k] = constant.map(|value| -value);
        determinant(changed) / whole
    })
}

#[test]
fn a_cantilever_deflects_as_in_any_textbook() {
    let (rigidity, length, force) = (1.5625e8, 3.2, 1e5);
    for segments in [1, 4, 16] {
        let segment = BeamSegment::bending(length / f64::from(segments), rigidity);
        for (heading, turn) in [(Heading::Up, 1.0), (Heading::Down, -1.0)] {
            let line = (0..segments).fold(Transfer::identity(), |line, _| {
                line.then(&segment.transfer(heading))
            });
            // The force at the tip enters as the load of a massless point.
            let line = line.then(&LumpedMass::default().transfer(0.0, [force, 0.0, 0.0]));
            let base = three_unknowns(|base| line.apply(StateVector::at_base(base)).forces());
            near(base[0], turn * 3.2e5, 1e-12, "base moment");
            near(base[1], -1e5, 1e-12, "base shear");
            let tip = line.apply(StateVector::at_base(base));
            near(tip.x, 6.990506666666668e-3, 1e-12, "tip displacement");
            near(tip.theta, turn * -3.2768e-3, 1e-12, "tip rotation");
        }
    }
}

#[test]
fn beams_sag_alike_from_either_end() {
    // F l³/(3EI) + F l/(GA_s) and N l/(EA) at the tip.
    let (l, ei, ea, ga, f, n) = (4.0_f64, 3e7, 5e9, 6e8, 2e4, 7e5);
    let beam = BeamSegment {
        axial_rigidity: Some(ea),
        shear_rigidity: Some(ga),
        ..BeamSegment::bending(l / 4.0, ei)
    };
    for (heading, turn) in [(Heading::Right, 1.0), (Heading::Left, -1.0)] {
        let line = (0..4).fold(Transfer::identity(), |line, _| {
            line.then(&beam.transfer(heading))
        });
        let line = line.then(&LumpedMass::default().transfer(0.0, [n, -f, 0.0]));
        let base = three_unknowns(|base| line.apply(StateVector::at_base(base)).forces());
        let tip = line.apply(StateVector::at_base(base));
        near(
            tip.y,
            -f * l.powi(3) / (3.0 * ei) - f * l / ga,
            1e-12,
            "sag",
        );
        near(tip.x, n * l / ea, 1e-12, "stretch");
        near(tip.theta, -turn * f * l * l / (2.0 * ei), 1e-12, "slope");
    }
}

#[test]
fn a_hinge_at_the_foot_adds_its_rotation() {
    let (rigidity, length, force, stiffness) = (1.5625e8, 3.2, 1e5, 4e7);
    let hinge = PlanarHinge {
        rotational_stiffness: Some(stiffness),
        ..PlanarHinge::default()
    };
    let line = hinge
        .transfer()
        .then(&BeamSegment::bending(length, rigidity).transfer(Heading::Up));
    let tip = line.apply(StateVector::at_base([force * length, -force, 0.0]));
    let expected = force * length.powi(3) / (3.0 * rigidity) + force * length * length / stiffness;
    near(tip.x, expected, 1e-12, "tip displacement");
    // The same hinge about a point of its line.
    let secant = hinge.incremental(stiffness, 1e5, 1e5 / stiffness);
    assert!(secant.load[2].abs() < 1e-18 && secant.matrix == hinge.transfer().matrix);
}

#[test]
fn a_damped_member_is_a_stiffer_one_with_shifted_ends() {
    // Forces κ K (u + s D): the state of displacements u passes as that of u + s D through κ times the member.
    let beam = BeamSegment {
        axial_rigidity: Some(5e9),
        shear_rigidity: Some(6e8),
        ..BeamSegment::bending(1.3, 3e7)
    };
    let shift = [[1e-3, -2e-3, 5e-4], [3e-3, 1e-3, -7e-4]];
    let input = [2e-3, 1e-3, -4e-4, 3e4, -2e4, 5e4];
    for heading in [Heading::Up, Heading::Down, Heading::Right, Heading::Left] {
        let shifted: [f64; 6] =
            std::array::from_fn(|k| input[k] + shift[0].get(k).copied().unwrap_or(0.0));
        let through = beam
            .stiffened(1.4)
            .transfer(heading)
            .apply(StateVector::from_array(shifted));
        let expected: [f64; 6] = std::array::from_fn(|k| {
            through.to_array()[k] - shift[1].get(k).copied().unwrap_or(0.0)
        });
        let got = beam
            .damped(heading, 1.4, shift)
            .apply(StateVector::from_array(input));
        assert!(
            difference(&got.to_array(), &expected) < 1e-12,
            "{heading:?}: {got:?}"
        );
        // A rigid direction keeps its displacement whatever the shifts.
        let rigid = BeamSegment {
            axial_rigidity: None,
            ..beam
        };
        let kept = rigid
            .damped(heading, 1.4, shift)
            .apply(StateVector::from_array(input));
        let along = usize::from(matches!(heading, Heading::Up | Heading::Down));
        assert_eq!(kept.to_array()[along], input[along], "{heading:?}");
    }
}

#[test]
fn a_two_span_beam_shares_a_load_as_in_any_textbook() {
    // P in the middle of the first of two equal spans: reactions 13P/32, 22P/32, −3P/32.
    let (span, load) = (6.0, 8e4);
    let half = BeamSegment::bending(span / 2.0, 2e7).transfer(Heading::Right);
    let point = |up: f64| LumpedMass::default().transfer(0.0, [0.0, up, 0.0]);
    let walk = |[theta, left, middle]: [f64; 3]| {
        let start = StateVector {
            theta,
            qy: left,
            ..StateVector::default()
        };
        let loaded = half.then(&point(-load)).then(&half);
        let support = loaded.apply(start);
        let end = half.then(&half).apply(point(middle).apply(support));
        (support, end)
    };
    let left_over = |unknown: [f64; 3]| {
        let (support, end) = walk(unknown);
        [support.y, end.y, end.m]
    };
    let [theta, left, middle] = three_unknowns(left_over);
    near(left, 13.0 / 32.0 * load, 1e-9, "left reaction");
    near(middle, 22.0 / 32.0 * load, 1e-9, "middle reaction");
    let (support, end) = walk([theta, left, middle]);
    near(-end.qy, -3.0 / 32.0 * load, 1e-9, "right reaction");
    // What the span on the left exerts over the support; it hogs.
    near(
        support.m.abs(),
        3.0 / 32.0 * load * span,
        1e-9,
        "moment over the support",
    );
}

#[test]
fn a_portal_resists_as_in_any_textbook() {
    // One column line up, along the beam, down the other; bases fixed, the joints by the branching rules.
    let (ei_column, ei_beam, height, span, push) = (1.5625e8, 1.62e8, 3.2, 6.0, 1e5);
    let column = BeamSegment::bending(height, ei_column);
    let beam = BeamSegment::bending(span, ei_beam).transfer(Heading::Right);
    let pushed = LumpedMass::default().transfer(0.0, [push, 0.0, 0.0]);
    let joint = LumpedMass::default().transfer(0.0, [0.0; 3]);
    let walk = |base: [f64; 3]| {
        let below = column
            .transfer(Heading::Up)
            .apply(StateVector::at_base(base));
        // Nothing goes on above the left joint: all forces enter the beam.
        let beam_start = pushed.apply(below);
        assert_eq!(
            one_in_two_out(&pushed, below, beam_start).forces(),
            [0.0; 3],
            "a head without a column above"
        );
        let arriving = beam.apply(beam_start);
        // Nor does anything come from above the right joint.
        let from_above = StateVector {
            m: 0.0,
            qx: 0.0,
            qy: 0.0,
            ..arriving
        };
        let down = two_in_one_out(&joint, from_above, arriving);
        (below, column.transfer(Heading::Down).apply(down))
    };
    let base = three_unknowns(|base| walk(base).1.displacements());
    let r = (ei_beam / span) / (ei_column / height);
    let stiffness = 24.0 * ei_column / height.powi(3) * (6.0 * r + 1.0) / (6.0 * r + 4.0);
    near(push / walk(base).0.x, stiffness, 1e-11, "lateral stiffness");
    near(stiffness, 67524545.48505962, 1e-14, "the formula itself");
}

#[test]
fn a_compressed_cantilever_buckles_near_euler_s_load() {
    let (length, rigidity) = (3.2, 1.5625e8);
    let euler = PI * PI * rigidity / (4.0 * length * length);
    // Moment left at the tip per moment at the base: zero when a bent state needs no force.
    let left = |segments: u32, compression: f64| {
        let segment = BeamSegment {
            compression,
            ..BeamSegment::bending(length / f64::from(segments), rigidity)
        };
        let line = (0..segments).fold(Transfer::identity(), |line, _| {
            line.then(&segment.transfer(Heading::Up))
        });
        line.apply(StateVector::at_base([1.0, 0.0, 0.0])).m
    };
    for (segments, ratio) in [
        (1, 1.2159),
        (2, 1.0524),
        (4, 1.0129),
        (8, 1.0032),
        (16, 1.0008),
    ] {
        let (mut low, mut high) = (0.5 * euler, 1.5 * euler);
        assert!(
            left(segments, low) > 0.0 && left(segments, high) < 0.0,
            "{segments} segments"
        );
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if left(segments, middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        assert!(
            (low / euler - ratio).abs() < 6e-5,
            "{segments} segments: {}",
            low / euler
        );
    }
}

#[test]
fn extended_matrices_carry_the_loads() {
    let point = LumpedMass {
        mass: 500.0,
        rotary_inertia: 20.0,
    };
    let line = BeamSegment::bending(2.0, 1e7)
        .transfer(Heading::Up)
        .then(&point.transfer(1e4, [3.0, 4.0, 5.0]));
    let z = [1e-3, 2e-3, 3e-3, 4e3, 5e3, 6e3];
    let applied = line.apply(StateVector::from_array(z)).to_array();
    let extended = line.extended();
    for row in 0..6 {
        let product: f64 = (0..6).map(|k| extended[row][k] * z[k]).sum();
        near(
            product + extended[row][6],
            applied[row],
            1e-13,
            "row of the extended form",
        );
    }
    assert_eq!(extended[6], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
}

/// Floors \[m\] under 100 kN at the roof of the first column line, by an independent finite-element program.
const PUSHED: [(Variant, [f64; 5]); 4] = [
    (
        Variant::AxiallyRigid,
        [
            0.001168854542893228,
            0.0030031072818667544,
            0.0049235846507135325,
            0.006817766373173488,
            0.008441345312260325,
        ],
    ),
    (
        Variant::FlexibleMembers,
        [
            0.0011970810806278963,
            0.0031082060378805976,
            0.0051448654336722875,
            0.0071818271725756925,
            0.009002643955989471,
        ],
    ),
    (
        Variant::PDelta,
        [
            0.0011909437855124442,
            0.0030618393126995835,
            0.005013667878054773,
            0.006928937932309578,
            0.008562882791435885,
        ],
    ),
    (
        Variant::Timoshenko,
        [
            0.0012618574679586266,
            0.0032681609087158205,
            0.005406676701891819,
            0.00754361453742165,
            0.00945343676814562,
        ],
    ),
];

#[test]
fn static_frames_agree_with_an_independent_program() {
    for (variant, expected) in PUSHED {
        let building = frame(variant, &[4.0, 6.0], 5, COLUMN);
        let mut load = vec![0.0; building.equations.len()];
        load[building.floors[4].dof] = 1e5;
        let floors = |solution: Vec<f64>| -> Vec<f64> {
            building
                .floors
                .iter()
                .map(|floor| solution[floor.dof])
                .collect()
        };
        // g = 0: no inertia.
        for got in [
            solution::<ProductEquations>(&building, (1.0, 0.0), &load),
            solution::<ElementwiseRiccati>(&building, (1.0, 0.0), &load),
            solution::<RiccatiSweep>(&building, (1.0, 0.0), &load),
        ] {
            let apart = difference(&floors(got), &expected);
            assert!(apart < 1e-9, "{variant:?}: {apart:e}");
        }
    }
}
