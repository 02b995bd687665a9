//! Ground that differs under the buildings, and vertical shaking.

use super::{Bearing, Ground, GroundMotion, Wave};

/// The ground under every building of a model, then under every wall, and what shakes it (theory, Eqs. B13 and B14).
///
/// ```
/// use jostle::{GroundMotion, Grounds, OwnGround};
///
/// let mut motion = GroundMotion::sampled("three values", 0.02, vec![0.0, 1.0, -0.5]);
/// let late = OwnGround { arrival: 0.03, ..OwnGround::default() };
/// motion.grounds = Some(Box::new(Grounds { own: vec![OwnGround::default(), late] }));
/// assert!((motion.under(1).at(0.04).acceleration[0] - 0.5).abs() < 1e-12); // 0.01 s after it arrived
/// assert_eq!(motion.corner_step(), Some(0.01)); // steps of 10 ms end at the corners of both
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Grounds {
    /// In the order of the buildings, then of the walls; whatever is not listed stands on the common ground.
    pub own: Vec<OwnGround>,
}

/// The ground under one building.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OwnGround {
    /// When the motion arrives, ≥ 0; before, the ground rests \[s\].
    pub arrival: f64,
    /// Its motion; `None` is the common one. Without a bearing of its own it has that of the common motion, the component across
    /// included.
    pub motion: Option<GroundMotion>,
    /// Vertical acceleration, positive upwards; `None` is none.
    pub vertical: Option<GroundMotion>,
}

/// Acceleration, velocity and displacement of a ground from rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GroundPoint {
    /// Along the row, across it, and upwards \[m/s²\].
    pub acceleration: Ground,
    /// Along the row and across it \[m/s\].
    pub velocity: [f64; 2],
    /// Along the row and across it \[m\].
    pub displacement: [f64; 2],
}

/// On which side of a jump of the acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Before,
    After,
}

/// Instants closer than this share of a step of a record, or of a second, are one \[–\].
const SAME_INSTANT: f64 = 1e-9;

/// Most parts of the step of a record in which a common grid of all corners is looked for.
const FINEST_GRID: u32 = 40;

impl GroundMotion {
    /// The ground under a building or a wall, in the order of [`Grounds::own`].
    #[must_use]
    pub fn under(&self, index: usize) -> GroundPath<'_> {
        let ground = self.grounds.as_ref().and_then(|all| all.own.get(index));
        let motion = ground
            .and_then(|ground| ground.motion.as_ref())
            .unwrap_or(self);
        let bearing = motion.bearing.as_deref().or(self.bearing.as_deref());
        let across = bearing.and_then(|bearing| bearing.across.as_ref());
        GroundPath {
            arrival: ground.map_or(0.0, |ground| ground.arrival),
            turned: bearing.map_or((0.0, 1.0), |Bearing { angle, .. }| libm::sincos(*angle)),
            along: Integrals::new(motion),
            across: across.map(Integrals::new),
            vertical: ground.and_then(|ground| ground.vertical.as_ref()),
        }
    }

    /// Whether two grounds move alike.
    #[must_use]
    pub fn moves_alike(&self, one: usize, other: usize) -> bool {
        let common = OwnGround::default();
        let Some(grounds) = &self.grounds else {
            return true;
        };
        let own_of = |index: usize| grounds.own.get(index).unwrap_or(&common);
        let (one, other) = (own_of(one), own_of(other));
        one.arrival == other.arrival && one.motion == other.motion
    }

    /// Whether any building has a ground of its own, or is shaken vertically.
    #[must_use]
    pub fn has_own_grounds(&self) -> bool {
        self.grounds.is_some()
    }

    /// Whether the ground moves vertically under any building.
    #[must_use]
    pub fn is_vertical(&self) -> bool {
        let grounds = self.grounds.iter().flat_map(|grounds| &grounds.own);
        grounds.into_iter().any(|ground| ground.vertical.is_some())
    }

    /// All motions: the common one, and those of single grounds, each with its arrival.
    fn parts(&self) -> impl Iterator<Item = (&Self, f64)> {
        let grounds = self.grounds.iter().flat_map(|grounds| &grounds.own);
        let motions = grounds.flat_map(|ground| {
            let along = ground.motion.as_ref().unwrap_or(self);
            let vertical = ground.vertical.as_ref();
            [Some(along), vertical]
                .into_iter()
                .flatten()
                .map(|motion| (motion, ground.arrival))
        });
        std::iter::once((self, 0.0)).chain(motions)
    }

    /// Steps of this and every other record with their arrivals \[s\].
    fn sampled_parts(&self) -> impl Iterator<Item = (f64, f64)> {
        let own_step = |motion: &Self| match motion.wave {
            Wave::Sampled { step, .. } => Some(step),
            Wave::Sine { .. } | Wave::Ricker { .. } => None,
        };
        self.parts().flat_map(move |(motion, arrival)| {
            let across = motion.across().or_else(|| self.across());
            let across = across.and_then(own_step);
            let steps = [own_step(motion), across].into_iter().flatten();
            steps.map(move |step| (step, arrival))
        })
    }

    /// Length of which all corners of all records are multiples, if there is one no shorter than a fortieth of the finest
    /// step; otherwise the finest step. `None` for analytic waves \[s\].
    #[must_use]
    pub fn corner_step(&self) -> Option<f64> {
        let finest = self.sampled_parts().map(|(step, _)| step);
        let finest = finest.fold(f64::INFINITY, f64::min);
        if !finest.is_finite() {
            return None;
        }
        let fits = |grid: f64| {
            let is_multiple = |value: f64| {
                let parts = value / grid;
                (parts - parts.round()).abs() <= SAME_INSTANT * parts.max(1.0)
            };
            let mut parts = self.sampled_parts();
            parts.all(|(step, arrival)| is_multiple(step) && is_multiple(arrival))
        };
        let grids = (1..=FINEST_GRID).map(|parts| finest / f64::from(parts));
        Some(grids.into_iter().find(|grid| fits(*grid)).unwrap_or(finest))
    }
}

impl GroundMotion {
    /// Whether corners of any record are not multiples of a step \[s\].
    pub(crate) fn has_corners_off(&self, step: f64) -> bool {
        let off = |value: f64| {
            let parts = value / step;
            (parts - parts.round()).abs() > SAME_INSTANT * parts.max(1.0)
        };
        let mut parts = self.sampled_parts();
        parts.any(|(step, arrival)| off(step) || off(arrival))
    }
}

/// The motion of one ground from rest: the exact integrals of the very acceleration that shakes.
#[derive(Clone, Debug)]
pub struct GroundPath<'a> {
    arrival: f64,
    /// Sine and cosine of the angle of the motion in plan.
    turned: (f64, f64),
    along: Integrals<'a>,
    across: Option<Integrals<'a>>,
    vertical: Option<&'a GroundMotion>,
}

impl GroundPath<'_> {
    /// When the motion arrives \[s\].
    #[must_use]
    pub fn arrival(&self) -> f64 {
        self.arrival
    }

    /// Where the ground is at an instant; where the acceleration jumps, that after the jump \[s\].
    #[must_use]
    pub fn at(&self, t: f64) -> GroundPoint {
        self.on_side(t, Side::After)
    }

    pub(crate) fn on_side(&self, t: f64, side: Side) -> GroundPoint {
        let elapsed = t - self.arrival;
        let along = self.along.at(elapsed, side);
        let across = self.across.as_ref();
        let across = across.map_or([0.0; 3], |motion| motion.at(elapsed, side));
        let (sin, cos) = self.turned;
        let turned = |order: usize| {
            let (first, second) = (along[order], across[order]);
            [first * cos - second * sin, first * sin + second * cos]
        };
        let [x, y] = turned(0);
        let vertical = self.vertical;
        let up = vertical.map_or(0.0, |motion| side.acceleration(motion, elapsed));
        GroundPoint {
            acceleration: [x, y, up],
            velocity: turned(1),
            displacement: turned(2),
        }
    }

    /// The first instant after `t` at which the acceleration may jump, or its slope if `corners` are asked for \[s\].
    pub(crate) fn next_corner(&self, t: f64, corners: bool) -> Option<f64> {
        let elapsed = t - self.arrival;
        let across = self.across.as_ref().map(|across| across.motion);
        let motions = [Some(self.along.motion), across, self.vertical];
        let next = motions.into_iter().flatten().filter_map(|motion| {
            let end = end_of(motion);
            let close = SAME_INSTANT * motion.step().unwrap_or(1.0);
            if elapsed < -close {
                return Some(0.0);
            }
            match &motion.wave {
                Wave::Sampled { step, .. } if corners && elapsed < end - close => {
                    Some((((elapsed + close) / step).floor() + 1.0) * step)
                }
                Wave::Sampled { .. } | Wave::Sine { .. } | Wave::Ricker { .. } => {
                    (elapsed < end - close).then_some(end)
                }
            }
        });
        let first = next.fold(f64::INFINITY, f64::min);
        first.is_finite().then_some(first + self.arrival)
    }
}

/// When a motion ends \[s\].
fn end_of(motion: &GroundMotion) -> f64 {
    match &motion.wave {
        Wave::Sampled { step, acceleration } => {
            let last = step * acceleration.len().saturating_sub(1) as f64;
            last.min(motion.duration)
        }
        Wave::Sine { .. } | Wave::Ricker { .. } => motion.duration,
    }
}

impl Side {
    /// Acceleration of a motion, which may jump where it begins and ends \[m/s²\].
    fn acceleration(self, motion: &GroundMotion, t: f64) -> f64 {
        let close = SAME_INSTANT * motion.step().unwrap_or(1.0);
        let end = end_of(motion);
        let outside = match self {
            Self::Before => t <= close || t > end + close,
            Self::After => t < -close || t >= end - close,
        };
        if outside {
            0.0
        } else {
            motion.acceleration(t.clamp(0.0, end))
        }
    }
}

/// First and second integral of a motion along its own direction, from rest.
#[derive(Clone, Debug)]
struct Integrals<'a> {
    motion: &'a GroundMotion,
    /// Velocity and displacement at the points of a record, unscaled \[m/s, m\].
    points: Vec<[f64; 2]>,
}

impl<'a> Integrals<'a> {
    fn new(motion: &'a GroundMotion) -> Self {
        let points = match &motion.wave {
            Wave::Sampled { step, acceleration } => {
                let mut at = [0.0; 2];
                let mut points = Vec::with_capacity(acceleration.len());
                points.push(at);
                for pair in acceleration.windows(2) {
                    at = over_line(at, [pair[0], pair[1]], *step, 1.0);
                    points.push(at);
                }
                points
            }
            Wave::Sine { .. } | Wave::Ricker { .. } => Vec::new(),
        };
        Self { motion, points }
    }

    /// Acceleration, velocity and displacement `t` after the start \[m/s², m/s, m\].
    fn at(&self, t: f64, side: Side) -> [f64; 3] {
        let motion = self.motion;
        if t <= 0.0 {
            return [side.acceleration(motion, t), 0.0, 0.0];
        }
        let end = end_of(motion);
        let [v, d] = self.moved(t.min(end)).map(|value| motion.scale * value);
        [side.acceleration(motion, t), v, d + v * (t - end).max(0.0)]
    }

    /// Velocity and displacement within the motion, unscaled.
    fn moved(&self, t: f64) -> [f64; 2] {
        match &self.motion.wave {
            Wave::Sampled { step, acceleration } => {
                let last = acceleration.len().saturating_sub(1);
                let index = ((t / step).floor() as usize).min(last);
                let (Some(point), Some(first)) = (self.points.get(index), acceleration.get(index))
                else {
                    return [0.0; 2];
                };
                let next = acceleration.get(index + 1).unwrap_or(first);
                over_line(*point, [*first, *next], *step, t / step - index as f64)
            }
            Wave::Sine { amplitude, period } => {
                let omega = 2.0 * std::f64::consts::PI / period;
                let (sin, cos) = libm::sincos(omega * t);
                let speed = amplitude / omega;
                [speed * (1.0 - cos), speed * (t - sin / omega)]
            }
            Wave::Ricker {
                amplitude,
                period,
                centre,
            } => {
                let bell = |t: f64| {
                    let tau = std::f64::consts::PI * (t - centre) / period;
                    libm::exp(-tau * tau)
                };
                let (now, first) = (bell(t), bell(0.0));
                let width = 0.5 * (period / std::f64::consts::PI).powi(2);
                [
                    amplitude * ((t - centre) * now + centre * first),
                    amplitude * (width * (first - now) + centre * first * t),
                ]
            }
        }
    }
}

/// Velocity and displacement after a share of a step in which the acceleration is a straight line.
fn over_line([v, d]: [f64; 2], [first, last]: [f64; 2], step: f64, share: f64) -> [f64; 2] {
    let t = share * step;
    let rise = share * (last - first);
    [
        v + t * (first + 0.5 * rise),
        d + t * (v + t * (0.5 * first + rise / 6.0)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pulse(wave: Wave) -> GroundMotion {
        GroundMotion {
            name: "wave".into(),
            scale: -1.5,
            duration: 3.0,
            wave,
            bearing: None,
            grounds: None,
        }
    }

    /// Simpson's rule on fine steps gives the same displacements.
    #[test]
    fn displacements_are_double_integrals() {
        let record = (0..=30).map(|i| (0.7 * f64::from(i)).sin() + 0.2).collect();
        let waves = [
            Wave::Sampled {
                step: 0.1,
                acceleration: record,
            },
            Wave::Sine {
                amplitude: 2.0,
                period: 0.7,
            },
            Wave::Ricker {
                amplitude: 3.0,
                period: 0.6,
                centre: 0.9,
            },
        ];
        for wave in waves {
            let motion = pulse(wave);
            let path = motion.under(0);
            let (mut v, mut d, h) = (0.0, 0.0, 1e-4);
            for i in 0..30_000 {
                let t = f64::from(i) * h;
                let [a, b, c] = [0.0, 0.5, 1.0].map(|share| motion.acceleration(t + share * h));
                d += h * v + h * h / 6.0 * (a + 2.0 * b);
                v += h / 6.0 * (a + 4.0 * b + c);
                if i % 5_000 == 4_999 {
                    let point = path.on_side(t + h, Side::Before);
                    assert!((point.velocity[0] - v).abs() < 1e-9, "{point:?}, {v}");
                    assert!((point.displacement[0] - d).abs() < 1e-9, "{point:?}, {d}");
                }
            }
            // Afterwards the ground goes on as it went.
            let (end, later) = (path.at(3.0), path.at(3.5));
            assert_eq!(later.acceleration, [0.0; 3]);
            let drifted = end.displacement[0] + 0.5 * end.velocity[0];
            assert!((later.displacement[0] - drifted).abs() < 1e-12);
        }
    }

    #[test]
    fn a_delayed_motion_rests_before_and_jumps_where_it_begins() {
        let mut motion = GroundMotion::sampled("r", 0.5, vec![1.0, 2.0, -4.0]);
        let late = OwnGround {
            arrival: 0.25,
            ..OwnGround::default()
        };
        motion.grounds = Some(Box::new(Grounds {
            own: vec![OwnGround::default(), late],
        }));
        let path = motion.under(1);
        assert_eq!(path.on_side(0.25, Side::Before), GroundPoint::default());
        assert_eq!(path.at(0.25).acceleration[0], 1.0);
        assert!((path.at(0.5).acceleration[0] - 1.5).abs() < 1e-12);
        assert_eq!(path.on_side(1.25, Side::Before).acceleration[0], -4.0);
        assert_eq!(path.at(1.25).acceleration[0], 0.0);
        assert_eq!(path.next_corner(0.0, true), Some(0.25));
        assert_eq!(path.next_corner(0.25, true), Some(0.75));
        assert_eq!(path.next_corner(0.25, false), Some(1.25));
        assert_eq!(path.next_corner(1.25, true), None);
        assert_eq!(motion.corner_step(), Some(0.25));
        assert!(!motion.moves_alike(0, 1) && motion.moves_alike(0, 5));
    }
}
