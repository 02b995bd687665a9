//! The collision of two free masses, integrated precisely and independent of the time step of a run.

use super::runge_kutta::{Point, integrate, land};
use super::{ForceLaw, Memory, effective_mass, momentum};

/// One instant of a collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollisionPoint {
    /// Time since first contact \[s\].
    pub time: f64,
    /// δ \[m\].
    pub indentation: f64,
    /// δ̇ \[m/s\].
    pub rate: f64,
    /// F \[N\].
    pub force: f64,
}

/// Results of the collision of two free masses.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeCollision {
    /// Closing speed at first contact \[m/s\].
    pub impact_speed: f64,
    /// Opening speed at the end \[m/s\].
    pub separation_speed: f64,
    /// Greatest force; `None` for the momentum law, which has none \[N\].
    pub peak_force: Option<f64>,
    /// Its time since first contact \[s\].
    pub peak_force_at: f64,
    /// Least force, negative in tension \[N\].
    pub least_force: f64,
    /// Greatest indentation \[m\].
    pub peak_indentation: f64,
    /// From first contact to the last instant of force \[s\].
    pub duration: f64,
    /// Time integral of the force \[N·s\].
    pub impulse: f64,
    /// Kinetic energy lost \[J\].
    pub dissipated: f64,
    /// History of the collision; empty for the momentum law.
    pub curve: Vec<CollisionPoint>,
}

/// Least number of points of a curve, if the duration is not zero.
const POINTS: usize = 300;

impl FreeCollision {
    /// Collides two free masses \[kg\], > 0, at a closing speed \[m/s\], > 0, under a law for these masses.
    ///
    /// Integrated in dimensionless form by an adaptive Runge–Kutta method of order five with errors of about 1e-14
    /// per step; steps end at the reversal of the motion, at corners of the law and at the end of the force.
    #[must_use]
    pub fn new(law: &ForceLaw, left_mass: f64, right_mass: f64, impact_speed: f64) -> Self {
        let mass = effective_mass(left_mass, right_mass);
        if let Some(e) = law.rebound(impact_speed) {
            return Self::at_once(e, mass, impact_speed);
        }
        let mut walk = Walk::new(law, mass, impact_speed);
        walk.load();
        walk.unload();
        walk.finish()
    }

    /// Separation ÷ impact speed \[–\].
    #[must_use]
    pub fn realised_restitution(&self) -> f64 {
        self.separation_speed / self.impact_speed
    }

    fn at_once(e: f64, mass: f64, speed: f64) -> Self {
        Self {
            impact_speed: speed,
            separation_speed: e * speed,
            peak_force: None,
            peak_force_at: 0.0,
            least_force: 0.0,
            peak_indentation: 0.0,
            duration: 0.0,
            impulse: momentum::impulse(e, mass, speed),
            dissipated: 0.5 * mass * speed * speed * (1.0 - e * e),
            curve: Vec::new(),
        }
    }
}

/// State of a collision. Unknowns are δ/(v₀T) and δ̇/v₀ over t/T, T the elastic duration.
struct Walk<'a> {
    law: &'a ForceLaw,
    mass: f64,
    speed: f64,
    scale: f64,
    memory: Memory,
    point: Point,
    peak: (f64, f64),
    deepest: f64,
    curve: Vec<CollisionPoint>,
}

impl<'a> Walk<'a> {
    fn new(law: &'a ForceLaw, mass: f64, speed: f64) -> Self {
        let onset = law.onset(speed);
        Self {
            law,
            mass,
            speed,
            scale: law.elastic_duration(mass, speed),
            memory: law.touch(speed),
            point: Point {
                time: 0.0,
                y: [0.0, 1.0],
            },
            peak: (onset, 0.0),
            deepest: 0.0,
            curve: vec![CollisionPoint {
                time: 0.0,
                indentation: 0.0,
                rate: speed,
                force: onset,
            }],
        }
    }

    fn indentation(&self, y: [f64; 2]) -> f64 {
        y[0] * self.speed * self.scale
    }

    fn respond(&self, y: [f64; 2]) -> super::ContactResponse {
        self.law
            .follow(self.indentation(y), y[1] * self.speed, &self.memory)
    }

    /// Time derivatives of the unknowns.
    fn slopes(&self, y: [f64; 2]) -> [f64; 2] {
        [
            y[1],
            -self.respond(y).force * self.scale / (self.mass * self.speed),
        ]
    }

    /// dF/dt, up to a positive factor.
    fn force_slope(&self, y: [f64; 2]) -> f64 {
        let response = self.respond(y);
        let acceleration = -response.force / self.mass;
        response.by_indentation * y[1] * self.speed + response.by_rate * acceleration
    }

    /// Up to the reversal. Over τ with t = τ⁴, so that δ^¼ is smooth at first contact.
    fn load(&mut self) {
        let kink = self.law.kink(true, &self.memory) / (self.speed * self.scale);
        for kink in [kink, f64::INFINITY] {
            if self.point.y[1] <= 0.0 || self.point.y[0] >= kink {
                continue;
            }
            let stretched = Point {
                time: libm::pow(self.point.time, 0.25),
                ..self.point
            };
            let mut steps = Vec::new();
            let slopes = |tau: f64, y| {
                let pace = 4.0 * tau * tau * tau;
                self.slopes(y).map(|slope| pace * slope)
            };
            let landed = integrate(
                stretched,
                1e-3,
                slopes,
                |p| p.y[1] <= 0.0 || p.y[0] >= kink,
                |a, b| steps.push((a, b)),
            );
            let peak = self.peak_of(&steps, &slopes, |tau| tau.powi(4));
            self.peak = peak;
            self.add_points(&steps, |tau| tau.powi(4));
            self.point = Point {
                time: landed.time.powi(4),
                ..landed
            };
        }
        self.deepest = self.indentation(self.point.y);
        self.law.remember(self.deepest, 0.0, &mut self.memory);
        // The reversal itself belongs to the restitution phase.
        self.point.y[1] = self.point.y[1].min(-0.0);
    }

    /// Up to the end of force.
    fn unload(&mut self) {
        let tension = self.law.jumps_at_release();
        let kink = self.law.kink(false, &self.memory) / (self.speed * self.scale);
        let kink = if kink < self.point.y[0] { kink } else { -1.0 };
        for kink in [kink, -1.0] {
            if self.point.y[0] <= kink {
                continue;
            }
            let mut steps = Vec::new();
            let slopes = |_: f64, y| self.slopes(y);
            let landed = integrate(
                self.point,
                1e-3,
                slopes,
                |p| {
                    let ended = p.y[0] <= 0.0 || (!tension && self.respond(p.y).force <= 0.0);
                    ended || p.y[0] <= kink
                },
                |a, b| steps.push((a, b)),
            );
            let peak = self.peak_of(&steps, &slopes, |t| t);
            self.peak = peak;
            self.add_points(&steps, |t| t);
            self.point = landed;
            if self.point.y[0] <= 0.0 {
                break;
            }
        }
    }

    /// The greatest force and its instant so far; within a step the force is followed to where its slope vanishes.
    fn peak_of(
        &self,
        steps: &[(Point, Point)],
        slopes: &impl Fn(f64, [f64; 2]) -> [f64; 2],
        time: impl Fn(f64) -> f64,
    ) -> (f64, f64) {
        let mut peak = self.peak;
        for (start, end) in steps {
            let mut at = *end;
            if self.force_slope(start.y) > 0.0 && self.force_slope(end.y) < 0.0 {
                let falling = |p: &Point| self.force_slope(p.y) <= 0.0;
                at = land(*start, end.time - start.time, slopes, &falling);
            }
            let force = self.respond(at.y).force;
            if force > peak.0 {
                peak = (force, time(at.time) * self.scale);
            }
        }
        peak
    }

    fn add_points(&mut self, steps: &[(Point, Point)], time: impl Fn(f64) -> f64) {
        for (_, end) in steps {
            self.curve.push(CollisionPoint {
                time: time(end.time) * self.scale,
                indentation: self.indentation(end.y),
                rate: end.y[1] * self.speed,
                force: self.respond(end.y).force,
            });
        }
    }

    fn finish(mut self) -> FreeCollision {
        let rate = self.point.y[1] * self.speed;
        // Points at a regular spacing, and the last.
        let stride = (self.curve.len() / POINTS).max(1);
        let last = self.curve.len() - 1;
        let mut index = 0;
        self.curve.retain(|_| {
            index += 1;
            (index - 1) % stride == 0 || index - 1 == last
        });
        FreeCollision {
            impact_speed: self.speed,
            separation_speed: -rate,
            peak_force: Some(self.peak.0),
            peak_force_at: self.peak.1,
            least_force: self
                .curve
                .iter()
                .fold(0.0, |least: f64, point| least.min(point.force)),
            peak_indentation: self.deepest,
            duration: self.point.time * self.scale,
            impulse: self.mass * (self.speed - rate),
            // Rounding errors count as zero: elastic laws dissipate no energy.
            dissipated: if (1.0 - rate * rate / (self.speed * self.speed)).abs() < 1e-11 {
                0.0
            } else {
                0.5 * self.mass * (self.speed * self.speed - rate * rate)
            },
            curve: self.curve,
        }
    }
}
