//! The same path by another way: small steps, Newton's method, a general sparse solver.

use jostle::hysteresis::{HysteresisMemory, HysteresisRule};
use jostle::linear::StepMatrix;
use jostle::pushover::{LoadPattern, PushDirection};
use jostle::statics::STANDARD_GRAVITY;
use jostle::stiffness::{DirectFactor, DirectStiffness};
use jostle::structure::StepEquations;
use jostle::system::BuildingSystem;

use crate::statics::support::{assembled, frame, hinged, pushed, shear_at, trilinear, under};

/// Displacements, memories and load of a building that is pushed in small steps.
struct Newton<'a> {
    building: &'a BuildingSystem,
    equations: DirectStiffness,
    factor: DirectFactor,
    displacement: Vec<f64>,
    memories: Vec<HysteresisMemory>,
    weight: f64,
    load: f64,
    forces: Vec<f64>,
}

impl<'a> Newton<'a> {
    fn new(building: &'a BuildingSystem, forces: Vec<f64>) -> Self {
        let equations = &building.equations;
        Self {
            building,
            equations: DirectStiffness::new(building),
            factor: DirectFactor::default(),
            displacement: vec![0.0; equations.len()],
            memories: vec![HysteresisMemory::default(); equations.springs.len()],
            weight: 0.0,
            load: 0.0,
            forces,
        }
    }

    /// What the springs would answer, and the load that is not carried.
    fn missing(&self, displacement: &[f64]) -> (Vec<f64>, Vec<f64>, Vec<HysteresisMemory>) {
        let equations = &self.building.equations;
        let mut carried = vec![0.0; equations.len()];
        equations.stiffness.multiply_add(displacement, &mut carried);
        equations.undamped.multiply_add(displacement, &mut carried);
        let (mut tangents, mut memories) = (Vec::new(), Vec::new());
        for (spring, memory) in equations.springs.iter().zip(&self.memories) {
            let answer = spring
                .hysteresis
                .respond(memory, spring.deformation(displacement));
            spring.row.push(answer.force, &mut carried);
            tangents.push(answer.tangent);
            memories.push(answer.memory);
        }
        let weights = equations
            .vertical_mass
            .iter()
            .map(|m| -self.weight * STANDARD_GRAVITY * m);
        let missing = weights
            .zip(&self.forces)
            .zip(&carried)
            .map(|((weight, force), carried)| weight + self.load * force - carried);
        (missing.collect(), tangents, memories)
    }

    /// Equilibrium with the present weight; the roof moves by `rise` if that is given, else the load stays.
    fn step(&mut self, roof: usize, rise: Option<f64>) {
        let mut displacement = self.displacement.clone();
        let mut to_go = rise.unwrap_or(0.0);
        for _ in 0..60 {
            let (mut change, tangents, memories) = self.missing(&displacement);
            let off = change.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
            if off < 1e-7 && to_go == 0.0 {
                self.displacement = displacement;
                self.memories = memories;
                return;
            }
            self.equations
                .factorize(&StepMatrix::STATIC, &tangents, &mut self.factor)
                .expect("it stands");
            self.equations
                .solve(&self.factor, &mut change, &mut Default::default());
            if rise.is_some() {
                let mut more = self.forces.clone();
                self.equations
                    .solve(&self.factor, &mut more, &mut Default::default());
                let load = (to_go - change[roof]) / more[roof];
                self.load += load;
                for (change, more) in change.iter_mut().zip(&more) {
                    *change += load * more;
                }
            }
            to_go = 0.0;
            for (u, change) in displacement.iter_mut().zip(&change) {
                *u += change;
            }
        }
        panic!("no equilibrium");
    }
}

#[test]
fn newton_in_small_steps_meets_the_same_curve() {
    for rule in [
        HysteresisRule::PeakOriented,
        HysteresisRule::Takeda { exponent: 0.4 },
        HysteresisRule::Normal,
        HysteresisRule::DegradingTrilinear,
    ] {
        let plain = hinged(
            frame(4, &[2.4, 6.0], 8000.0),
            Some(trilinear(rule, 4e8, 350e3)),
            Some(trilinear(rule, 3e8, 220e3)),
        );
        let building = assembled(&under(plain, true, true));
        let curve = pushed(
            &building,
            LoadPattern::FirstMode,
            PushDirection::Right,
            0.015,
        );
        let forces = LoadPattern::FirstMode.forces(&building).expect("a mode");
        let roof = building.floors[3].dof;
        let mut newton = Newton::new(&building, forces);
        for step in 1..=200 {
            newton.weight = f64::from(step) / 200.0;
            newton.step(roof, None);
        }
        for (u, rest) in newton.displacement.iter().zip(&building.rest.displacement) {
            assert!((u - rest).abs() < 1e-9, "{u} and {rest} at rest");
        }
        let (end, steps) = (0.015 * curve.height, 800);
        let mut worst = 0.0_f64;
        for step in 1..=steps {
            newton.step(roof, Some(end / f64::from(steps)));
            let expected = shear_at(
                &curve,
                end * f64::from(step) / f64::from(steps) * (1.0 - 1e-15),
            );
            worst = worst.max((newton.load - expected).abs() / curve.peak().base_shear);
        }
        assert!(worst < 1e-5, "{rule:?}: {worst:e}");
        println!("{rule:?}: {worst:e}");
    }
}
