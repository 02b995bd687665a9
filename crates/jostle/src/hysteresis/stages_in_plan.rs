//! Sliding surfaces in series that slide in every direction of the plan: double and triple friction pendulums.
//!
//! Every stage has the force vector of the bearing. Friction opposes its sliding, up the bowl and as far as the rim:
//!
//! ```text
//! u = F/kₑ + Σ sᵢ,   q = F − kᵢ sᵢ,   |q| ≤ fᵢ,   ṡᵢ ∥ q,   |sᵢ| ≤ dᵢ
//! ```
//!
//! A stage that slides has q̇ = Ḟ − k ṡ: q is the force of a slider of stiffness k and strength f that is moved by F/k, so that a straight
//! path of F has the closed form of Krieg and Krieg. A step takes that path as straight: exact along a line, an error of second order on
//! a curved one. At the rim the bowl holds s on its circle, and q keeps no more of F than friction allows.

use super::circular::{CircularForce, CircularLaw, PlanAnswer, dot};
use super::memory::HysteresisMemory;
use super::pendulums::SlidingStage;

/// Most steps of Newton's method for the force of a displacement, and of the search along one of them.
const MOST_STEPS: usize = 60;
const MOST_HALVINGS: usize = 40;
/// What a displacement may be missed by, over all lengths that enter it \[–\].
const SAME: f64 = 1e-15;

/// A place of a stage, and the symmetric part \[a b; b c\] of its flexibility ds/dF there.
#[derive(Clone, Copy)]
struct Slid {
    place: [f64; 2],
    flexibility: [f64; 3],
}

impl SlidingStage {
    /// Where it stands under a force that changed along a straight path.
    fn slid(&self, from: [f64; 2], before: [f64; 2], force: [f64; 2]) -> Slid {
        if self.friction == f64::INFINITY {
            return Slid {
                place: from,
                flexibility: [0.0; 3],
            };
        }
        let k = self.stiffness;
        let slider = CircularForce {
            law: CircularLaw::Slider,
            stiffness: k,
            limit: self.friction,
        };
        let path = [0, 1].map(|axis| (force[axis] - before[axis]) / k);
        let held = slider.slide(self.held(from, before), path, self.friction);
        let [x, y, between] = held.tangents;
        let compliance = [x + between, -between, y + between].map(|tangent| tangent / (k * k));
        let mut flexibility = [
            1.0 / k - compliance[0],
            -compliance[1],
            1.0 / k - compliance[2],
        ];
        let mut place = [0, 1].map(|axis| (force[axis] - held.force[axis]) / k);
        let reached = libm::hypot(place[0], place[1]);
        if reached > self.travel {
            let share = self.travel / reached;
            let [c, s] = place.map(|place| place / reached);
            place = [c, s].map(|value| value * self.travel);
            // What goes outwards is held: only what moves it along the rim is left of ds/dF.
            let [a, b, d] = flexibility;
            let along = share * (s * s * a - 2.0 * s * c * b + c * c * d);
            flexibility = [along * s * s, -along * s * c, along * c * c];
        }
        Slid { place, flexibility }
    }

    /// Friction under a force: at the rim, whose reaction is along the radius, what it can bear.
    fn held(&self, place: [f64; 2], force: [f64; 2]) -> [f64; 2] {
        let rest = [0, 1].map(|axis| force[axis] - self.stiffness * place[axis]);
        let held = libm::hypot(rest[0], rest[1]);
        let away = libm::hypot(place[0], place[1]);
        if held <= self.friction || away == 0.0 {
            return rest;
        }
        let [c, s] = place.map(|place| place / away);
        let aside = (c * rest[1] - s * rest[0]).clamp(-self.friction, self.friction);
        let outwards = ((self.friction - aside) * (self.friction + aside)).sqrt();
        let outwards = outwards.min(c * rest[0] + s * rest[1]);
        [c * outwards - s * aside, s * outwards + c * aside]
    }
}

/// A bearing on its way from a state.
struct Way<'a> {
    elastic: f64,
    stages: &'a [SlidingStage; 3],
    from: [&'a HysteresisMemory; 2],
    to: [f64; 2],
}

/// What a force misses the displacement by \[m\], the flexibility \[a b; b c\] there \[m/N\], and the lengths that enter \[m\].
struct Missed {
    by: [f64; 2],
    flexibility: [f64; 3],
    scale: f64,
}

impl Way<'_> {
    fn missed(&self, force: [f64; 2]) -> Missed {
        let before = self.from.map(|memory| memory.force);
        let stretched = force.map(|force| force / self.elastic);
        let mut by = [0, 1].map(|axis| self.to[axis] - stretched[axis]);
        let mut flexibility = [1.0 / self.elastic, 0.0, 1.0 / self.elastic];
        let mut scale = size(self.to) + size(stretched);
        for (index, stage) in self.stages.iter().enumerate() {
            let place = self.from.map(|memory| memory.offsets[index]);
            let slid = stage.slid(place, before, force);
            by = [0, 1].map(|axis| by[axis] - slid.place[axis]);
            scale += size(slid.place);
            for (sum, flexibility) in flexibility.iter_mut().zip(slid.flexibility) {
                *sum += flexibility;
            }
        }
        Missed {
            by,
            flexibility,
            scale,
        }
    }

    /// How far to go along a change of the force, 0 to 1: all of it, unless it goes too far past a corner. Along it the displacement only
    /// grows, by `first` ahead of the start.
    fn share(&self, force: [f64; 2], change: [f64; 2], first: f64) -> f64 {
        let ahead = |share: f64| {
            let at = [0, 1].map(|axis| force[axis] + share * change[axis]);
            dot(self.missed(at).by, change)
        };
        let (mut low, mut high) = ([0.0, first], [1.0, ahead(1.0)]);
        if high[1] >= -0.5 * first {
            return 1.0;
        }
        for _ in 0..MOST_HALVINGS {
            let secant = low[0] + (high[0] - low[0]) * low[1] / (low[1] - high[1]);
            let middle = [secant, ahead(secant)];
            if middle[1].abs() <= 0.1 * first {
                return secant;
            }
            // The end that stays counts half (Illinois).
            if middle[1] > 0.0 {
                (low, high) = (middle, [high[0], 0.5 * high[1]]);
            } else {
                (low, high) = ([low[0], 0.5 * low[1]], middle);
            }
        }
        low[0]
    }
}

/// Force and tangent at a displacement reached on a straight path from the state of the rows along x and across.
pub(super) fn answer(
    elastic: f64,
    stages: &[SlidingStage; 3],
    from: [&HysteresisMemory; 2],
    to: [f64; 2],
) -> PlanAnswer {
    let way = Way {
        elastic,
        stages,
        from,
        to,
    };
    let mut force = from.map(|memory| memory.force);
    let mut missed = way.missed(force);
    for _ in 0..MOST_STEPS {
        if size(missed.by) <= SAME * missed.scale {
            break;
        }
        let [a, b, c] = stiffness_of(missed.flexibility);
        let [x, y] = missed.by;
        let change = [a * x + b * y, b * x + c * y];
        let share = way.share(force, change, dot(missed.by, change));
        force = [0, 1].map(|axis| force[axis] + share * change[axis]);
        missed = way.missed(force);
    }
    PlanAnswer::new(force, stiffness_of(missed.flexibility))
}

fn size([x, y]: [f64; 2]) -> f64 {
    libm::hypot(x, y)
}

/// Places of all stages under a force, from the state of both rows.
pub(super) fn places(
    stages: &[SlidingStage; 3],
    from: [&HysteresisMemory; 2],
    force: [f64; 2],
) -> [[f64; 2]; 3] {
    let before = from.map(|memory| memory.force);
    [0, 1, 2].map(|index| {
        let place = from.map(|memory| memory.offsets[index]);
        stages[index].slid(place, before, force).place
    })
}

fn stiffness_of([a, b, c]: [f64; 3]) -> [f64; 3] {
    let determinant = a * c - b * b;
    [c, -b, a].map(|value| value / determinant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hysteresis::{Hysteresis, Side};

    const ELASTIC: f64 = 15e6;
    const STAGES: [SlidingStage; 3] = [
        SlidingStage {
            friction: 15e3,
            stiffness: 1e6 / 0.6,
            travel: 0.06,
        },
        SlidingStage {
            friction: 40e3,
            stiffness: 1e6 / 1.8,
            travel: 0.2571,
        },
        SlidingStage {
            friction: 80e3,
            stiffness: 1e6 / 1.8,
            travel: 0.2571,
        },
    ];

    fn follow(rows: &mut [HysteresisMemory; 2], stages: &[SlidingStage; 3], to: [f64; 2]) {
        let [x, y] = &*rows;
        let force = answer(ELASTIC, stages, [x, y], to).force;
        let places = places(stages, [x, y], force);
        for (axis, row) in rows.iter_mut().enumerate() {
            row.stand_at(to[axis], force[axis], Side::Positive);
            row.offsets = places.map(|place| place[axis]);
        }
    }

    /// Along any line the force is that of stages on one line, also at the rims and on the way back.
    #[test]
    fn along_a_line_it_is_the_bearing_of_one_plane() {
        let plane = Hysteresis::pendulums(ELASTIC, STAGES).expect("sound");
        for direction in [[1.0, 0.0], [0.0, -1.0], [0.6, 0.8]] {
            let mut rows = [HysteresisMemory::default(); 2];
            let mut memory = HysteresisMemory::default();
            let mut furthest = 0.0_f64;
            for i in 0..1500 {
                let x = f64::from(i);
                let to = 4.4e-4 * x * (0.03 * x).sin() + 0.01 * (0.37 * x).sin();
                memory = plane.respond(&memory, to).memory;
                follow(
                    &mut rows,
                    &STAGES,
                    direction.map(|direction| direction * to),
                );
                for axis in [0, 1] {
                    let due = direction[axis] * memory.force();
                    let apart = (rows[axis].force() - due).abs();
                    assert!(apart < 1e-9 * ELASTIC * 0.01, "{i}: {apart}");
                }
                furthest = furthest.max(memory.force().abs());
            }
            assert!(furthest > 5e5, "never at the rims: {furthest}");
        }
    }

    /// On a circle every stage slides on a circle: F = (k + iω̂ f/|s|) s turned by 90°, so that friction has a constant size and is
    /// opposite to the velocity of its stage. With one stage, u = F/kₑ + s.
    #[test]
    fn on_a_circle_friction_is_opposite_to_the_velocity() {
        let mut stages = STAGES;
        stages[1..].fill(SlidingStage::STILL);
        stages[0].travel = 1.0;
        let SlidingStage {
            friction: f,
            stiffness: k,
            ..
        } = stages[0];
        // F = k s + f t with t ahead of s by 90°: lengths by Pythagoras, (1 + k/kₑ)² s² + (f/kₑ)² = R².
        let radius: f64 = 0.2;
        let slid = (radius * radius - (f / ELASTIC).powi(2)).sqrt() / (1.0 + k / ELASTIC);
        let error = |steps: u32| {
            let mut rows = [HysteresisMemory::default(); 2];
            for step in 0..=3 * steps {
                let angle = f64::from(step) * std::f64::consts::TAU / f64::from(steps);
                follow(
                    &mut rows,
                    &stages,
                    [radius * angle.cos(), radius * angle.sin()],
                );
            }
            let [s, force] = [rows.map(|row| row.offsets[0]), rows.map(|row| row.force())];
            let q = [0, 1].map(|axis| force[axis] - k * s[axis]);
            assert!((q[0].hypot(q[1]) / f - 1.0).abs() < 1e-9);
            // Its velocity is at a right angle to s.
            let along = (q[0] * s[0] + q[1] * s[1]) / (f * slid);
            ((s[0].hypot(s[1]) / slid - 1.0).abs()).max(along.abs())
        };
        let errors = [400, 800, 1600].map(error);
        println!("{errors:?}");
        assert!(
            errors[2] < 1e-4 && errors[0] / errors[2] > 12.0,
            "{errors:?}"
        );
    }

    /// Three stages on a circle: each slides on a circle of its own, with the phase of its friction.
    #[test]
    fn three_stages_on_a_circle_have_the_closed_form() {
        let stages = STAGES.map(|stage| SlidingStage {
            travel: 5.0,
            ..stage
        });
        // For a force of length F turning steadily, stage i has |s| = √(F² − f²)/k and lags by asin(f/F).
        let force = 2.0e5_f64;
        let mut sum = [force / ELASTIC, 0.0];
        for stage in &stages {
            let size = (force * force - stage.friction * stage.friction).sqrt() / stage.stiffness;
            let lag = (stage.friction / force).asin();
            sum[0] += size * lag.cos();
            sum[1] -= size * lag.sin();
        }
        let radius = sum[0].hypot(sum[1]);
        let error = |steps: u32| {
            let mut rows = [HysteresisMemory::default(); 2];
            for step in 0..=4 * steps {
                let angle = f64::from(step) * std::f64::consts::TAU / f64::from(steps);
                follow(
                    &mut rows,
                    &stages,
                    [radius * angle.cos(), radius * angle.sin()],
                );
            }
            let found = rows.map(|row| row.force());
            let ahead = found[1].atan2(found[0]);
            let due = -sum[1].atan2(sum[0]);
            (found[0].hypot(found[1]) / force - 1.0)
                .abs()
                .max((ahead - due).abs())
        };
        let errors = [400, 800, 1600].map(error);
        println!("{errors:?}");
        assert!(
            errors[2] < 1e-4 && errors[0] / errors[2] > 12.0,
            "{errors:?}"
        );
    }

    /// The tangent is the symmetric part of central differences, between corners.
    #[test]
    fn tangents_are_differences_of_forces() {
        let mut rows = [HysteresisMemory::default(); 2];
        for step in 0..60 {
            let x = f64::from(step);
            follow(&mut rows, &STAGES, [4e-3 * x, 0.05 * (0.1 * x).sin()]);
        }
        let to = [0.238, 0.031];
        let of = |to: [f64; 2]| answer(ELASTIC, &STAGES, [&rows[0], &rows[1]], to);
        let by = 1e-7;
        let column = |axis: usize| {
            let [less, more] = [-by, by].map(|by| {
                let mut to = to;
                to[axis] += by;
                of(to).force
            });
            [0, 1].map(|row| (more[row] - less[row]) / (2.0 * by))
        };
        let [x, y] = [column(0), column(1)];
        let off = 0.5 * (x[1] + y[0]);
        for (found, due) in of(to).tangents.iter().zip([x[0] + off, y[1] + off, -off]) {
            assert!((found - due).abs() < 0.02 * x[0].max(y[1]), "{found} {due}");
        }
    }
}
