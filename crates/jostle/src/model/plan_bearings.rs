//! Where the bearings of an isolated building in plan stand.

use std::collections::BTreeMap;

use super::{Base, LumpedFloor, PlanArea, PlanColumn, PlanPoint, Tier, Tiers};

/// Radii of gyration of a plan closer than this share of each other have no principal axes of their own \[–\].
const ALIKE: f64 = 1e-9;

impl LumpedFloor {
    /// A floor without masses of frames.
    #[must_use]
    pub fn rigid(tier: &Tier) -> Self {
        Self {
            tier: tier.clone(),
            one_way: [0.0; 2],
        }
    }
}

impl Tiers {
    /// A mat of this mass \[kg\] under the building: spread evenly over the plan of the lowest floor. The feet of plane frames add
    /// their masses.
    #[must_use]
    pub fn mat(&self, mass: f64) -> LumpedFloor {
        self.plate(mass, self.lowest_plan(), &BTreeMap::new())
    }

    /// What carries the building and moves against the ground: a mat or a footing, spread evenly over the plan of the lowest floor, or
    /// a rectangular foundation about the centroid of that plan; `None` if it stands on the ground.
    #[must_use]
    pub fn carrier(&self, base: &Base) -> Option<LumpedFloor> {
        self.carrier_with(base, &BTreeMap::new())
    }

    /// The same with points of columns that neighbours push, at these heights above the joints at their feet.
    pub(crate) fn carrier_with(
        &self,
        base: &Base,
        struck: &BTreeMap<PlanColumn, Vec<f64>>,
    ) -> Option<LumpedFloor> {
        let plan = self.lowest_plan();
        let plan = match base.foundation {
            Some(foundation) => foundation.corners(PlanArea::new(&plan).centroid),
            None => plan,
        };
        Some(self.plate(base.carrying_mass()?, plan, struck))
    }

    fn lowest_plan(&self) -> Vec<PlanPoint> {
        let plan = self.floors.first().map(|floor| floor.plan.clone());
        plan.unwrap_or_default()
    }

    fn plate(
        &self,
        mass: f64,
        plan: Vec<PlanPoint>,
        struck: &BTreeMap<PlanColumn, Vec<f64>>,
    ) -> LumpedFloor {
        let area = PlanArea::new(&plan);
        let tier = Tier {
            mass,
            polar_mass: mass * area.gyration(),
            centre: area.centroid,
            plan,
        };
        self.with_feet(&tier, struck)
    }

    /// Places of the bearings: those given, otherwise four at c ± r₁e₁ ± r₂e₂, c, e and r being centroid, principal axes and radii of
    /// gyration of the plan of the lowest floor. Four bearings there turn against the same stiffness as bearings spread evenly over
    /// the plan \[m\].
    #[must_use]
    pub fn bearing_points(&self) -> Vec<PlanPoint> {
        if !self.bearings.is_empty() {
            return self.bearings.clone();
        }
        let Some(floor) = self.floors.first() else {
            return Vec::new();
        };
        let area = PlanArea::new(&floor.plan);
        let [x, y] = area.centroid;
        let [r1, r2] = principal_arms(&floor.plan, &area);
        let at = |a: f64, b: f64| [x + a * r1[0] + b * r2[0], y + a * r1[1] + b * r2[1]];
        vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]
    }
}

/// Principal axes of a plan, as long as its radii of gyration along them \[m\].
fn principal_arms(plan: &[PlanPoint], area: &PlanArea) -> [PlanPoint; 2] {
    let points: Vec<PlanPoint> = plan
        .iter()
        .map(|p| [p[0] - area.centroid[0], p[1] - area.centroid[1]])
        .collect();
    let next = points.iter().cycle().skip(1);
    let product: f64 = points
        .iter()
        .zip(next)
        .map(|(a, b)| {
            let w = a[0] * b[1] - b[0] * a[1];
            w * (a[0] * b[1] + 2.0 * (a[0] * a[1] + b[0] * b[1]) + b[0] * a[1]) / 24.0
        })
        .sum();
    let [across, along] = area.second_moments.map(|moment| moment / area.area);
    let both = product / area.area;
    let (mean, half) = (0.5 * (along + across), 0.5 * (along - across));
    let apart = libm::hypot(half, both);
    let direction = if apart > ALIKE * mean {
        let angle = 0.5 * libm::atan2(both, half);
        [libm::cos(angle), libm::sin(angle)]
    } else {
        // A square, or another plan that is the same about every axis: along its first edge.
        let [a, b] = [points[0], points[1 % points.len()]];
        let edge = [b[0] - a[0], b[1] - a[1]];
        let length = libm::hypot(edge[0], edge[1]);
        edge.map(|value| value / length)
    };
    let [first, second] = [mean + apart, mean - apart].map(|square| square.max(0.0).sqrt());
    [
        direction.map(|share| first * share),
        [-second * direction[1], second * direction[0]],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tiers(plan: Vec<PlanPoint>) -> Tiers {
        Tiers {
            floors: vec![Tier::uniform(1e5, plan).expect("a plan")],
            storey_heights: vec![3.0],
            ..Tiers::default()
        }
    }

    /// Their moments of second order are those of the plan: the same K_xx, K_xy, K_yy and torsion as an even spread.
    #[test]
    fn four_bearings_have_the_second_moments_of_the_plan() {
        // An L, by its two rectangles.
        let plan = vec![
            [0.0, 0.0],
            [12.0, 0.0],
            [12.0, 4.0],
            [5.0, 4.0],
            [5.0, 9.0],
            [0.0, 9.0],
        ];
        let tiers = tiers(plan);
        let parts = [
            (48.0, [6.0, 2.0], [12.0, 4.0]),
            (25.0, [2.5, 6.5], [5.0, 5.0]),
        ];
        let area: f64 = parts.iter().map(|(area, ..)| area).sum();
        let centre = [0, 1].map(|axis| {
            let moment: f64 = parts.iter().map(|(area, at, _)| area * at[axis]).sum();
            moment / area
        });
        let expected = |i: usize, j: usize| {
            let of = |(area, at, size): &(f64, PlanPoint, PlanPoint)| {
                let about = if i == j {
                    size[i] * size[i] / 12.0
                } else {
                    0.0
                };
                area * (about + (at[i] - centre[i]) * (at[j] - centre[j]))
            };
            parts.iter().map(of).sum::<f64>() / area
        };
        let points = tiers.bearing_points();
        for (i, j) in [(0, 0), (0, 1), (1, 1)] {
            let of = |at: &PlanPoint| 0.25 * (at[i] - centre[i]) * (at[j] - centre[j]);
            let found: f64 = points.iter().map(of).sum();
            assert!((found - expected(i, j)).abs() < 1e-12, "{i} {j}: {found}");
        }
        let mat = tiers.mat(2e5).tier;
        let polar = 2e5 * (expected(0, 0) + expected(1, 1));
        assert!((mat.polar_mass / polar - 1.0).abs() < 1e-12);
        assert!((mat.centre[0] - centre[0]).abs() < 1e-12);
    }

    /// Those of a square stand along its edges, however it is turned.
    #[test]
    fn bearings_of_a_square_turn_with_it() {
        let (sin, cos) = 0.6_f64.sin_cos();
        let corners = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]];
        let turned = |p: &PlanPoint| [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]];
        let straight = tiers(corners.to_vec()).bearing_points();
        let skew = tiers(corners.iter().map(turned).collect()).bearing_points();
        for (one, other) in straight.iter().map(turned).zip(&skew) {
            assert!((one[0] - other[0]).abs() < 1e-12 && (one[1] - other[1]).abs() < 1e-12);
        }
    }
}
