//! Forces in plan that are the same in every direction: a slider, and a ring that stops.
//!
//! A slider has an elastic stiffness k and a strength Q, which bounds the length of its force vector: ḟ = k u̇ while |f| < Q or the
//! force falls, else ḟ = k (u̇ − (f̂·u̇) f̂). Along a straight path from the circle |f| = Q the angle φ from the path to the force
//! follows tan φ/2 = tan φ₀/2 · e^(−k s/Q), s being the length of the path (R. D. Krieg and D. B. Krieg, 1977, J. Pressure Vessel
//! Technol. 99, 510–515). A straight path gives the same force for any division, and a curved one an error of second
//! order. Returning the trial force to the circle along its radius would have an error of first order (theory, Eq. B1p).
//!
//! Friction whose strength Q depends on the speed keeps its direction by the same equation with Q of the instant,
//! tan φ/2 = tan φ₀/2 · e^(−k ∫ds/Q). A step takes the mean of the strengths at its start and at its end there, and the strength at its
//! end as the length of the force. Where the motion turns back within a step that slips, or whose force would exceed the strength at the
//! turn, the step is divided there, as along a line (theory, Eq. B3).
//!
//! In the list of springs that yield such a force has three rows: its displacement along x, across, and the difference of both, whose
//! only force is what the tangent [a b; b c] has off its diagonal: springs a + b, c + b and −b.

use super::backbone::{Backbone, Corners, Quantity, Side, SpringFault};
use super::friction::{Rates, Strength};
use super::memory::{HysteresisMemory, Response};
use super::pendulums::SlidingStage;
use super::rule::{Hysteresis, HysteresisRule};
use super::stages_in_plan;

/// Forces within this of the strength slip \[–\].
const SLIPS: f64 = 1e-9;

/// Which row of a force in plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceRow {
    /// Along x.
    X,
    /// Across.
    Y,
    /// The displacement along x less that across; without force.
    Between,
}

impl ForceRow {
    /// All rows, in the order in which they stand in a list of springs.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Between];

    /// `x`, `y` or `x-y`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Between => "x-y",
        }
    }
}

/// Law of a force in plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CircularLaw {
    /// Elastic up to the strength, then sliding.
    Slider,
    /// The same with a strength that rises with the speed from `slow` at rest to the strength of the slider.
    Friction {
        /// Strength at rest \[N\].
        slow: f64,
        /// Rate of the rise \[s/m\].
        rate: f64,
    },
    /// Stages in series that slide in every direction, each up its bowl to its rim.
    Pendulums([SlidingStage; 3]),
    /// An elastic ring: without force up to a distance, then k (|u| − at) along the radius.
    Ring,
}

/// A law with its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CircularForce {
    pub(super) law: CircularLaw,
    /// k, > 0 \[N/m\].
    pub(super) stiffness: f64,
    /// Strength of a slider \[N\], distance of a ring \[m\], > 0.
    pub(super) limit: f64,
}

/// A force in plan and its tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlanAnswer {
    /// Along x and across \[N\].
    pub(crate) force: [f64; 2],
    /// Springs of the three rows: a + b, c + b, −b \[N/m\].
    pub(crate) tangents: [f64; 3],
}

impl PlanAnswer {
    /// With the symmetric tangent \[a b; b c\].
    pub(super) fn new(force: [f64; 2], [a, b, c]: [f64; 3]) -> Self {
        Self {
            force,
            tangents: [a + b, c + b, -b],
        }
    }
}

impl CircularForce {
    /// Force and tangent at a displacement \[m\], reached on a straight path from the state of the rows along x and across. `rates`:
    /// their motion over the step, on which friction that changes with speed depends.
    ///
    /// The tangent of a slider is the symmetric part of the derivative: off the radius it is not quite symmetric.
    pub(crate) fn answer(
        &self,
        from: [&HysteresisMemory; 2],
        to: [f64; 2],
        rates: &[Rates; 2],
    ) -> PlanAnswer {
        let before = from.map(|memory| memory.force);
        let path = [0, 1].map(|axis| to[axis] - from[axis].deformation);
        match self.law {
            CircularLaw::Slider => self.slide(before, path, self.limit),
            CircularLaw::Friction { slow, rate } => {
                let strength = Strength {
                    slow,
                    fast: self.limit,
                    rate,
                };
                self.rub(before, path, rates, strength)
            }
            CircularLaw::Pendulums(stages) => {
                stages_in_plan::answer(self.stiffness, &stages, from, to)
            }
            CircularLaw::Ring => self.stop(to),
        }
    }

    /// Moves the stages of a pendulum to where they stand under the force of an accepted step. The row between keeps how far each went.
    pub(crate) fn slide_stages(&self, rows: &mut [HysteresisMemory], force: [f64; 2]) {
        let (CircularLaw::Pendulums(stages), [x, y, between]) = (&self.law, rows) else {
            return;
        };
        let places = stages_in_plan::places(stages, [x, y], force);
        for (index, [along, across]) in places.into_iter().enumerate() {
            (x.offsets[index], y.offsets[index]) = (along, across);
            let furthest = &mut between.offsets[index];
            *furthest = furthest.max(libm::hypot(along, across));
        }
    }

    /// Friction that changes with speed.
    fn rub(
        &self,
        before: [f64; 2],
        path: [f64; 2],
        rates: &[Rates; 2],
        strength: Strength,
    ) -> PlanAnswer {
        let k = self.stiffness;
        let [first, last] = [rates.map(|rate| rate.before), rates.map(|rate| rate.after)];
        let per_deformation = rates[0].per_deformation;
        let held = libm::hypot(before[0], before[1]);
        let start = strength.at(libm::hypot(first[0], first[1]))[0];
        let slipped = held >= (1.0 - SLIPS) * start && dot(before, first) > 0.0;
        let turns = dot(before, first) > 0.0 && dot(before, last) < 0.0;
        let mut divided = None;
        if turns {
            let share = dot(before, first) / (dot(before, first) - dot(before, last));
            let step = rates[0].step;
            let until = [0, 1].map(|axis| {
                share * step * (first[axis] + 0.5 * share * (last[axis] - first[axis]))
            });
            let speed = [0, 1].map(|axis| first[axis] + share * (last[axis] - first[axis]));
            let there = strength.at(libm::hypot(speed[0], speed[1]))[0];
            let elastic = [0, 1].map(|axis| before[axis] + k * until[axis]);
            let reached = libm::hypot(elastic[0], elastic[1]);
            let force = if slipped {
                Some(self.turn(before, until, [start, there]))
            } else {
                // The circle comes inwards to a force that held.
                (reached > there).then(|| elastic.map(|force| force * there / reached))
            };
            let rest = [0, 1].map(|axis| path[axis] - until[axis]);
            let slope = 1.0 - 0.5 * step * per_deformation * share * share;
            divided = force.map(|force| (force, rest, there, k * slope.max(0.0)));
        }
        let turned = divided.is_some();
        let (before, path, start, stiffness) = divided.unwrap_or((before, path, start, k));
        let speed = libm::hypot(last[0], last[1]);
        let [end, by_speed] = strength.at(speed);
        let trial = [0, 1].map(|axis| before[axis] + k * path[axis]);
        if libm::hypot(trial[0], trial[1]) <= end {
            return PlanAnswer::new(trial, [stiffness, 0.0, stiffness]);
        }
        let goes_on = slipped && !turned && dot(before, path) >= 0.0;
        let mut answer = if goes_on {
            // From the circle of the start to that of the end.
            let scaled = before.map(|force| force * end / held);
            let mut slide = self.slide(scaled, path, end);
            slide.force = self.turn(before, path, [start, end]);
            slide
        } else {
            let held = libm::hypot(before[0], before[1]);
            if held > end && dot(before, path) < 0.0 {
                // The circle came inwards faster than the force: it follows along the radius.
                return self.pulled_in(trial, end);
            }
            let inside = before.map(|force| force * (end / held).min(1.0));
            self.slide(inside, path, end)
        };
        let along = dot(answer.force, last) / (end * speed).max(f64::MIN_POSITIVE);
        if along > 0.0 {
            let rise = per_deformation * by_speed * along;
            let [x, y] = answer.force.map(|force| force / end);
            let more = [rise * x * x, rise * x * y, rise * y * y];
            let sums = [more[0] + more[1], more[2] + more[1], -more[1]];
            for (tangent, more) in answer.tangents.iter_mut().zip(sums) {
                *tangent += more;
            }
        }
        answer
    }

    /// A force returned along the radius to a circle inside of it.
    fn pulled_in(&self, trial: [f64; 2], strength: f64) -> PlanAnswer {
        let length = libm::hypot(trial[0], trial[1]);
        let radius = trial.map(|force| force / length);
        let tangent = [0.0, 0.0, self.stiffness * strength / length];
        PlanAnswer::new(
            radius.map(|share| strength * share),
            turned_back(tangent, radius),
        )
    }

    /// A force that slides along a straight path, from one strength to another.
    fn turn(&self, before: [f64; 2], path: [f64; 2], [start, end]: [f64; 2]) -> [f64; 2] {
        let length = libm::hypot(path[0], path[1]);
        let held = libm::hypot(before[0], before[1]);
        if length == 0.0 || held == 0.0 {
            return before.map(|force| force * end / held.max(f64::MIN_POSITIVE));
        }
        let along = path.map(|value| value / length);
        let forward = dot(before, along);
        let aside = along[0] * before[1] - along[1] * before[0];
        let faded = libm::exp(-self.stiffness * length / (0.5 * (start + end)));
        let half = aside / (held + forward).max(f64::MIN_POSITIVE) * faded;
        let scale = end / (1.0 + half * half);
        let (p, q) = ((1.0 - half * half) * scale, 2.0 * half * scale);
        [p * along[0] - q * along[1], p * along[1] + q * along[0]]
    }

    pub(super) fn slide(&self, before: [f64; 2], path: [f64; 2], strength: f64) -> PlanAnswer {
        let k = self.stiffness;
        let trial = [0, 1].map(|axis| before[axis] + k * path[axis]);
        let length = libm::hypot(path[0], path[1]);
        if libm::hypot(trial[0], trial[1]) <= strength || length == 0.0 {
            return PlanAnswer::new(trial, [k, 0.0, k]);
        }
        // Components of the force along the path and at its left.
        let along = path.map(|value| value / length);
        let forward = before[0] * along[0] + before[1] * along[1];
        let aside = along[0] * before[1] - along[1] * before[0];
        // Rounding may leave the circle by a little.
        let aside = aside.clamp(-strength, strength);
        let reached = ((strength - aside) * (strength + aside)).sqrt();
        // Elastic up to the circle, then along it.
        let elastic = (reached - forward).max(0.0);
        let faded = libm::exp(-(k * length - elastic).max(0.0) / strength);
        let half = aside / (strength + reached) * faded;
        let scale = 1.0 / (1.0 + half * half);
        let (cos, sin) = ((1.0 - half * half) * scale, 2.0 * half * scale);
        let (p, q) = (strength * cos, strength * sin);
        let force = [p * along[0] - q * along[1], p * along[1] + q * along[0]];
        // dφ/dα of a path that is turned by α: by the angle at which it meets the circle, and by the length that is left there.
        let ratio = if reached > 0.0 {
            (forward / reached).clamp(-1.0, 1.0)
        } else {
            1.0
        };
        let sin_by_aside = 2.0 * faded * scale / (strength + reached);
        let lag = sin_by_aside * (ratio * strength + aside * aside * (1.0 - ratio) / strength);
        let turns = (1.0 - lag).max(0.0) / length;
        let tangent = [
            k * sin * sin,
            -0.5 * sin * (k * cos + strength * turns),
            p * turns,
        ];
        PlanAnswer::new(force, turned_back(tangent, along))
    }

    fn stop(&self, to: [f64; 2]) -> PlanAnswer {
        let Self {
            stiffness: k,
            limit: at,
            ..
        } = *self;
        let distance = libm::hypot(to[0], to[1]);
        let into = distance - at;
        if into <= 0.0 {
            return PlanAnswer::new([0.0; 2], [0.0; 3]);
        }
        let radius = to.map(|value| value / distance);
        let tangent = [k, 0.0, k * into / distance];
        PlanAnswer::new(
            radius.map(|share| k * into * share),
            turned_back(tangent, radius),
        )
    }
}

impl Hysteresis {
    /// The rows along x, across and between both of a force in plan: stiffness \[N/m\], and the strength of a slider \[N\] or the
    /// distance of a ring \[m\].
    ///
    /// # Errors
    /// Numbers that are not positive.
    pub fn in_plan(
        law: CircularLaw,
        stiffness: f64,
        limit: f64,
    ) -> Result<[Self; 3], Vec<SpringFault>> {
        if let CircularLaw::Friction { slow, rate } = law
            && !(slow > 0.0 && slow <= limit && rate.is_finite() && rate >= 0.0)
        {
            return Err(vec![SpringFault {
                quantity: Quantity::Rule,
                side: None,
                problem: format!(
                    "needs 0 < strength at rest <= strength at high speed and a rate of at least zero, found {slow} N, {limit} N and {rate} s/m"
                ),
            }]);
        }
        let backbone = match law {
            CircularLaw::Slider | CircularLaw::Friction { .. } | CircularLaw::Pendulums(_) => {
                let corners = Corners::bilinear(limit, 0.0);
                Backbone::from_forces(stiffness, corners, corners)?
            }
            CircularLaw::Ring => {
                let corners = Corners::bilinear(limit, 1.0);
                Backbone::from_deformations(stiffness, corners, corners)?
            }
        };
        Ok(ForceRow::ALL.map(|row| Self {
            rule: HysteresisRule::InPlan { law, row },
            backbone,
        }))
    }

    /// The force in plan of which this is a row.
    pub(crate) fn circular(&self) -> Option<CircularForce> {
        let HysteresisRule::InPlan { law, .. } = self.rule else {
            return None;
        };
        Some(CircularForce {
            law,
            stiffness: self.backbone.initial(),
            limit: match law {
                CircularLaw::Slider | CircularLaw::Friction { .. } | CircularLaw::Pendulums(_) => {
                    self.backbone.yield_force()
                }
                CircularLaw::Ring => self.backbone.side(Side::Positive).yielding.deformation,
            },
        })
    }

    /// Whether it is the first row of stages in series.
    pub(crate) fn slides_in_stages(&self) -> bool {
        matches!(
            self.rule,
            HysteresisRule::InPlan {
                law: CircularLaw::Pendulums(_),
                row: ForceRow::X
            }
        )
    }

    /// How far each stage of a bearing in plan went, beside its travel, by the state of the row between \[m\]; empty for other springs.
    #[must_use]
    pub fn travels_in_plan(&self, between: &HysteresisMemory) -> Vec<[f64; 2]> {
        let HysteresisRule::InPlan {
            law: CircularLaw::Pendulums(stages),
            row: ForceRow::Between,
        } = &self.rule
        else {
            return Vec::new();
        };
        let all = stages.iter().zip(between.offsets);
        let there = all.filter(|(stage, _)| **stage != SlidingStage::STILL);
        there.map(|(stage, went)| [went, stage.travel]).collect()
    }

    /// A row of a force in plan whose other row stays at rest.
    pub(super) fn on_a_line(
        &self,
        row: ForceRow,
        memory: &HysteresisMemory,
        deformation: f64,
    ) -> Response {
        let still = HysteresisMemory::default();
        let mut moved = *memory;
        let (force, tangent) = match self.circular().filter(|_| row != ForceRow::Between) {
            Some(circular) => {
                let at_rest = [Rates::default(); 2];
                let answer = circular.answer([memory, &still], [deformation, 0.0], &at_rest);
                let mut rows = [*memory, still, still];
                circular.slide_stages(&mut rows, answer.force);
                moved = rows[0];
                (answer.force[0], answer.tangents[0] + answer.tangents[2])
            }
            None => (0.0, 0.0),
        };
        Response {
            force,
            tangent,
            work: 0.5 * (memory.force + force) * (deformation - memory.deformation),
            memory: moved,
        }
    }
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// A symmetric tangent \[a b; b c\] along a direction and at its left, in x and across.
fn turned_back([a, b, c]: [f64; 3], [x, y]: [f64; 2]) -> [f64; 3] {
    [
        a * x * x - 2.0 * b * x * y + c * y * y,
        (a - c) * x * y + b * (x * x - y * y),
        a * y * y + 2.0 * b * x * y + c * x * x,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hysteresis::Side;

    const SLIDER: CircularForce = CircularForce {
        law: CircularLaw::Slider,
        stiffness: 3e7,
        limit: 1.2e5,
    };

    const STILL: [Rates; 2] = [Rates {
        before: 0.0,
        after: 0.0,
        per_deformation: 0.0,
        step: 0.0,
    }; 2];

    fn at(deformation: f64, force: f64) -> HysteresisMemory {
        let mut memory = HysteresisMemory::default();
        memory.stand_at(deformation, force, Side::Positive);
        memory
    }

    fn follow(law: &CircularForce, path: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
        let mut rows = [HysteresisMemory::default(); 2];
        for to in path {
            let force = law.answer([&rows[0], &rows[1]], to, &STILL).force;
            rows = [0, 1].map(|axis| at(to[axis], force[axis]));
        }
        rows.map(|row| row.force())
    }

    /// The rate equation, by the classical method of Runge and Kutta on the circle: ḟ = k (u̇ − (f̂·u̇) f̂).
    fn by_rates(path: impl Fn(f64) -> [f64; 2], start: [f64; 2], steps: usize) -> [f64; 2] {
        let CircularForce {
            stiffness: k,
            limit: strength,
            ..
        } = SLIDER;
        let h = 1.0 / steps as f64;
        let rate = |t: f64, f: [f64; 2]| {
            let by = 1e-5;
            let (a, b) = (path(t - by), path(t + by));
            let v = [0, 1].map(|axis| (b[axis] - a[axis]) / (2.0 * by));
            let along = (f[0] * v[0] + f[1] * v[1]) / (strength * strength);
            assert!(along > 0.0, "it slides all the way");
            [0, 1].map(|axis| k * (v[axis] - along * f[axis]))
        };
        let mut f = start;
        for step in 0..steps {
            let t = h * step as f64;
            let moved = |rate: [f64; 2], by: f64| [0, 1].map(|axis| f[axis] + by * rate[axis]);
            let a = rate(t, f);
            let b = rate(t + 0.5 * h, moved(a, 0.5 * h));
            let c = rate(t + 0.5 * h, moved(b, 0.5 * h));
            let d = rate(t + h, moved(c, h));
            f = [0, 1]
                .map(|axis| f[axis] + h / 6.0 * (a[axis] + 2.0 * (b[axis] + c[axis]) + d[axis]));
        }
        f
    }

    /// On a curved path the error falls with the square of the division.
    #[test]
    fn a_curved_path_has_the_force_of_the_rate_equation() {
        let path = |t: f64| [0.02 * (1.3 * t).sin(), 0.03 * (1.0 - (1.1 * t).cos())];
        let start = [SLIDER.limit, 0.0];
        let exact = by_rates(path, start, 20_000);
        let error = |steps: u32| {
            let mut rows = [at(0.0, start[0]), at(0.0, start[1])];
            for step in 1..=steps {
                let to = path(f64::from(step) / f64::from(steps));
                let force = SLIDER.answer([&rows[0], &rows[1]], to, &STILL).force;
                rows = [0, 1].map(|axis| at(to[axis], force[axis]));
            }
            let [x, y] = [0, 1].map(|axis| rows[axis].force() - exact[axis]);
            x.hypot(y) / SLIDER.limit
        };
        let errors = [400, 800, 1600].map(error);
        println!("{errors:?}");
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1] - 4.0).abs() < 0.3, "{errors:?}");
        }
        assert!(errors[2] < 1e-6, "{errors:?}");
    }

    /// A straight path has the same force for any division, also where it starts inside of the circle and passes through it.
    #[test]
    fn a_straight_path_may_be_divided_anyhow() {
        let before = [-0.7 * SLIDER.limit, 0.4 * SLIDER.limit];
        let path = |t: f64| [0.011 * t, 0.004 * t];
        let divided = |steps: u32| {
            let mut rows = before.map(|force| at(0.0, force));
            for step in 1..=steps {
                let to = path(f64::from(step) / f64::from(steps));
                let force = SLIDER.answer([&rows[0], &rows[1]], to, &STILL).force;
                rows = [0, 1].map(|axis| at(to[axis], force[axis]));
            }
            rows.map(|row| row.force())
        };
        let once = divided(1);
        assert!((once[0].hypot(once[1]) / SLIDER.limit - 1.0).abs() < 1e-14);
        for steps in [2, 7, 100] {
            let [x, y] = divided(steps);
            let apart = (x - once[0]).hypot(y - once[1]) / SLIDER.limit;
            assert!(apart < 1e-12, "{steps}: {apart:e}");
        }
    }

    /// On a circle of radius R the force has the constant length Q and lags behind the direction of motion by φ, sin φ = Q/(kR).
    #[test]
    fn on_a_circle_the_force_lags_by_a_constant_angle() {
        let radius = 0.013;
        let lag = (SLIDER.limit / (SLIDER.stiffness * radius)).asin();
        let error = |steps: u32| {
            let angle = |step: u32| f64::from(step) * std::f64::consts::TAU / f64::from(steps);
            let on = |step: u32| [radius * angle(step).cos(), radius * angle(step).sin()];
            let [x, y] = follow(&SLIDER, (0..=3 * steps).map(on));
            assert!((x.hypot(y) / SLIDER.limit - 1.0).abs() < 1e-14);
            // At the end the motion is along y.
            (x.atan2(y) - lag).abs()
        };
        let errors = [800, 1600, 3200].map(error);
        println!("{lag} {errors:?}");
        for pair in errors.windows(2) {
            assert!((pair[0] / pair[1] - 4.0).abs() < 0.1, "{errors:?}");
        }
        assert!(errors[2] < 1e-5 * lag, "{errors:?}");
    }

    /// The tangents are the symmetric part of central differences.
    #[test]
    fn tangents_are_differences_of_forces() {
        let ring = CircularForce {
            law: CircularLaw::Ring,
            stiffness: 6e7,
            limit: 0.05,
        };
        for (law, before, to) in [
            (SLIDER, [0.0; 2], [0.02, -0.01]),
            (SLIDER, [-0.7, 0.4], [0.011, 0.004]),
            (SLIDER, [0.6, 0.8], [-0.001, 0.007]),
            (SLIDER, [0.6, 0.8], [0.0011, -0.0006]),
            (SLIDER, [0.0, 1.0], [0.001, 0.004]),
            (SLIDER, [0.1, 0.2], [0.0001, 0.0002]),
            (ring, [0.0; 2], [0.03, 0.07]),
            (ring, [0.0; 2], [0.03, 0.01]),
        ] {
            let rows = before.map(|share| at(0.0, share * SLIDER.limit));
            let answer = |to: [f64; 2]| law.answer([&rows[0], &rows[1]], to, &STILL);
            let by = 1e-8;
            let column = |axis: usize| {
                let [less, more] = [-by, by].map(|by| {
                    let mut to = to;
                    to[axis] += by;
                    answer(to).force
                });
                [0, 1].map(|row| (more[row] - less[row]) / (2.0 * by))
            };
            let [x, y] = [column(0), column(1)];
            let off = 0.5 * (x[1] + y[0]);
            let expected = [x[0] + off, y[1] + off, -off];
            let found = answer(to).tangents;
            for (found, expected) in found.iter().zip(expected) {
                let apart = (found - expected).abs() / law.stiffness;
                assert!(
                    apart < 1e-6,
                    "{law:?} {before:?} {to:?}: {found:e} {expected:e}"
                );
            }
        }
    }
}
