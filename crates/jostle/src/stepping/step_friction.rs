//! Friction along a closed contact over one step.

use crate::contact::ContactResponse;
use crate::history::Extreme;
use crate::interface::Coulomb;
use crate::stepping::events::{Cubic, bisect};

/// Parts of a step over which friction is predicted; even, for Simpson's rule.
pub(super) const FRICTION_PARTS: usize = 16;

/// Corners kept of a step.
const CORNERS: usize = 2;

/// Friction over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FrictionPath {
    /// At the start of the step \[N\].
    pub(super) start: f64,
    /// At the ends of its equal parts \[N\].
    pub(super) ends: [f64; FRICTION_PARTS],
    /// Where slipping turns into sticking or the other way round: share of the step, and force \[N\].
    corners: [Option<[f64; 2]>; CORNERS],
}

impl FrictionPath {
    /// Force at a share of the step, straight between the ends of parts and corners \[N\].
    fn at(&self, share: f64) -> f64 {
        let scaled = share * FRICTION_PARTS as f64;
        let part = (scaled as usize).min(FRICTION_PARTS - 1);
        let place = |end: usize| end as f64 / FRICTION_PARTS as f64;
        let mut before = [
            place(part),
            if part == 0 {
                self.start
            } else {
                self.ends[part - 1]
            },
        ];
        let mut after = [place(part + 1), self.ends[part]];
        for corner in self.corners.iter().flatten() {
            if corner[0] <= share && corner[0] > before[0] {
                before = *corner;
            } else if corner[0] >= share && corner[0] < after[0] {
                after = *corner;
            }
        }
        let within = after[0] - before[0];
        if within <= 0.0 {
            return after[1];
        }
        before[1] + (share - before[0]) / within * (after[1] - before[1])
    }

    /// Mean over the step by Simpson's rule \[N\].
    pub(super) fn mean(&self) -> f64 {
        let inside = |first: usize| {
            self.ends[first..FRICTION_PARTS - 1]
                .iter()
                .step_by(2)
                .sum::<f64>()
        };
        let end = self.ends[FRICTION_PARTS - 1];
        (self.start + 4.0 * inside(0) + 2.0 * inside(1) + end) / (3.0 * FRICTION_PARTS as f64)
    }

    /// Force at the end of the step \[N\].
    pub(super) fn end(&self) -> f64 {
        self.ends[FRICTION_PARTS - 1]
    }
}

/// Friction along a closed contact in the step to be solved; its indentation is the slip of the face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepFriction {
    /// The contact, and its place among the closed ones.
    pub(crate) contact: usize,
    pub(crate) normal: usize,
    pub(crate) law: Coulomb,
    /// Slip without force \[m\].
    pub(crate) origin: f64,
    /// Contact force that limits it \[N\].
    pub(crate) pressed: f64,
    /// Motion at the start, where only the end of the step is solved for.
    pub(crate) start: Option<StepStart>,
}

/// Motion at the start of a step, from which friction follows the slip within the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StepStart {
    /// Length of the step, > 0 \[s\].
    pub(crate) step: f64,
    /// Slip and its rate \[m, m/s\].
    pub(crate) slip: [f64; 2],
    /// Indentation of the contact and its rate \[m, m/s\].
    pub(crate) indentation: [f64; 2],
    /// Friction \[N\].
    pub(crate) force: f64,
    /// Slip without force \[m\].
    pub(crate) origin: f64,
}

impl StepFriction {
    /// Follows friction from the start of a step to slip and indentation at its end, each with its rate \[m, m/s\];
    /// `press`: contact force at an indentation and its rate \[N\]. See [`StepFriction::follow`].
    pub(super) fn follow_from(
        &mut self,
        start: &StepStart,
        slip: [f64; 2],
        indentation: [f64; 2],
        press: impl Fn(f64, f64) -> f64,
    ) -> FrictionPath {
        let step = start.step;
        let over = |[from, before]: [f64; 2], [to, after]: [f64; 2]| {
            Cubic::new(from, before, to, after, step)
        };
        let sliding = over(start.slip, slip);
        let pressing = over(start.indentation, indentation);
        self.origin = start.origin;
        self.follow(start.force, |share| {
            let rate = pressing.rise(share) / step;
            [sliding.value(share), press(pressing.value(share), rate)]
        })
    }

    /// The force at a slip under a contact force \[N\].
    pub(crate) fn respond(&self, slip: f64, pressed: f64) -> ContactResponse {
        let (force, sticks) = self.law.force(slip, self.origin, pressed);
        ContactResponse {
            force,
            by_indentation: if sticks { self.law.stiffness } else { 0.0 },
            by_rate: 0.0,
        }
    }

    /// Friction over a step that begins with `start`, from slips and contact forces at shares of the step; it may stick and slip
    /// by turns. Where it sticks at the end, `origin` becomes that of the last slip: from the start of the step, the slip
    /// in it would be missing.
    pub(super) fn follow(&mut self, start: f64, at: impl Fn(f64) -> [f64; 2]) -> FrictionPath {
        let mut path = FrictionPath {
            start,
            ..FrictionPath::default()
        };
        let mut corners = path.corners.iter_mut();
        let (mut origin, mut slid) = (self.origin, None);
        let mut before = 0.0;
        for (part, end) in path.ends.iter_mut().enumerate() {
            let share = (part + 1) as f64 / FRICTION_PARTS as f64;
            let [slip, pressed] = at(share);
            let (mut force, mut sticks) = self.law.force(slip, origin, pressed);
            let corner = match (slid, sticks) {
                (Some(sign), true) => {
                    let corner = self.turn(sign, [before, share], &at);
                    origin = self.law.origin(at(corner[0])[0], corner[1]);
                    (force, sticks) = self.law.force(slip, origin, pressed);
                    Some(corner)
                }
                (None, false) if pressed > 0.0 && part > 0 => {
                    Some(self.limit(origin, [before, share], &at))
                }
                _ => None,
            };
            if let (Some(corner), Some(place)) = (corner, corner.and_then(|_| corners.next())) {
                *place = Some(corner);
            }
            slid = (!sticks).then(|| force.signum());
            if !sticks {
                origin = self.law.origin(slip, force);
            }
            (*end, before) = (force, share);
        }
        if slid.is_none() {
            self.origin = origin;
        }
        path
    }

    /// Share of a step, and force, at which what slips to the side of `sign` begins to stick between two shares: there
    /// ± k s − μF is greatest, the vertex of a parabola through the ends and the middle.
    fn turn(&self, sign: f64, [from, to]: [f64; 2], at: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
        let Coulomb {
            coefficient,
            stiffness,
        } = self.law;
        let beyond = |share: f64| {
            let [slip, pressed] = at(share);
            sign * stiffness * slip - coefficient * pressed.max(0.0)
        };
        let middle = 0.5 * (from + to);
        let [first, half, last] = [from, middle, to].map(beyond);
        let bend = first - 2.0 * half + last;
        let offset = if bend < 0.0 {
            (0.25 * (first - last) / bend).clamp(-0.5, 0.5)
        } else {
            0.5_f64.copysign(last - first)
        };
        let share = middle + offset * (to - from);
        [share, sign * coefficient * at(share)[1].max(0.0)]
    }

    /// Share of a step, and force, at which what sticks begins to slip between two shares.
    fn limit(&self, origin: f64, [from, to]: [f64; 2], at: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
        let force = |share: f64| {
            let [slip, pressed] = at(from + share * (to - from));
            self.law.force(slip, origin, pressed)
        };
        let share = bisect(0.0, 1.0, |share| !force(share).1);
        [from + share * (to - from), force(share).0]
    }
}

impl Extreme {
    /// Takes over the greatest magnitude of the sum of forces over a step with its start and length \[s\], up to a limit, if it is
    /// greater.
    pub(super) fn widen(&mut self, paths: &[FrictionPath], limit: f64, [start, step]: [f64; 2]) {
        let ends = (1..=FRICTION_PARTS).map(|part| part as f64 / FRICTION_PARTS as f64);
        let corners = paths.iter().flat_map(|path| path.corners);
        for share in ends.chain(corners.flatten().map(|[share, _]| share)) {
            let sum: f64 = paths.iter().map(|path| path.at(share)).sum();
            let size = sum.abs().min(limit);
            if size > self.value {
                (self.value, self.at) = (size, start + share * step);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    fn friction(origin: f64) -> StepFriction {
        StepFriction {
            contact: 0,
            normal: 0,
            law: Coulomb {
                coefficient: 0.5,
                stiffness: 1e6,
            },
            origin,
            pressed: 0.0,
            start: None,
        }
    }

    /// A face that slips 0.5 mm further and comes back by 0.2 mm within a step sticks with 300 N, 200 N less than μF.
    #[test]
    fn a_slip_that_turns_within_a_step_is_kept() {
        let mut face = friction(0.0);
        // It turns at 0.53 of the step.
        let slip = |share: f64| 1e-3 - 0.2e-3 * ((share - 0.53) / 0.47).powi(2);
        let path = face.follow(500.0, |share| [slip(share), 1e3]);
        assert!((path.end() - 300.0).abs() < 1e-9, "{path:?}");
        assert!((face.respond(slip(1.0), 1e3).force - 300.0).abs() < 1e-9);
        // From the start of the step it would still slip.
        assert_eq!(friction(0.0).respond(slip(1.0), 1e3).force, 500.0);
    }

    /// The force rises with μF while it slips, and falls from where it sticks: μ Ḟ = k ṡ at a quarter and a bit of the step.
    #[test]
    fn the_greatest_force_is_at_the_corner() {
        let slip = |share: f64| 1e-3 + 1e-3 * (share - share * share);
        let pressed = |share: f64| 1e3 * (1.0 + 0.9 * share);
        // k (1 − 2τ) 1e-3 = μ 900.
        let corner = 0.5 * (1.0 - 0.45);
        let path = friction(0.5e-3).follow(500.0, |share| [slip(share), pressed(share)]);
        let mut greatest = Extreme::default();
        greatest.widen(&[path], 1e9, [3.0, 2.0]);
        let turned = 0.5 * pressed(corner) + 1e6 * (slip(0.5) - slip(corner));
        assert!((path.at(0.5) - turned).abs() < 1e-9, "{path:?}");
        assert!((path.at(corner) - 0.5 * pressed(corner)).abs() < 1e-9);
        let [share, force] = path.corners[0].expect("a corner");
        assert!((share - corner).abs() < 1e-12 && (force - 0.5 * pressed(corner)).abs() < 1e-9);
        assert!(greatest.value >= turned && greatest.value <= turned + 0.01);
    }

    /// What sticks at a growing slip reaches its limit as the contact force falls: a sharp top.
    #[test]
    fn a_sharp_top_is_found_between_parts() {
        let slip = |share: f64| 1e-3 * share;
        let pressed = |share: f64| 2e3 * (1.0 - 0.5 * share);
        // 1e3 τ = 1e3 (1 − τ/2).
        let path = friction(0.0).follow(0.0, |share| [slip(share), pressed(share)]);
        let mut greatest = Extreme::default();
        greatest.widen(&[path, path], 1e9, [0.0, 3.0]);
        assert!(
            (greatest.value - 2.0 * 1e3 * 2.0 / 3.0).abs() < 1e-8,
            "{greatest:?}"
        );
        assert!((greatest.at - 2.0).abs() < 1e-9);
    }

    #[test]
    fn the_mean_of_a_cubic_is_exact() {
        let force = |t: f64| 2.0 - t + 3.0 * t * t - 5.0 * t * t * t;
        let path = FrictionPath {
            start: force(0.0),
            ends: std::array::from_fn(|part| force((part + 1) as f64 / FRICTION_PARTS as f64)),
            ..FrictionPath::default()
        };
        let mean = 2.0 - 0.5 + 1.0 - 1.25;
        assert!((path.mean() - mean).abs() < 1e-15);
    }
}
