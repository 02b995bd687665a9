//! Forces and accelerations of one instant.

use jostle::GroundMotion;
use jostle::hysteresis::HysteresisMemory;

use super::super::laws::Closed;
use super::bodies::{Answer, Bodies, SpringLaw, along, push};
use super::slider::Mode;

/// What a spring remembers.
#[derive(Clone, Copy)]
pub(super) enum SpringPhase {
    Rule(HysteresisMemory),
    Slider(Mode),
}

/// What a link remembers.
#[derive(Clone, Copy)]
pub(super) enum LinkPhase {
    None,
    Rule(HysteresisMemory),
    Slider(Mode),
    Stopper(Option<Closed>),
}

/// On which smooth piece everything is.
#[derive(Clone)]
pub(super) struct Phases {
    pub(super) springs: Vec<SpringPhase>,
    /// Slope of the line that every spring is on until the step ends.
    pub(super) tangents: Vec<f64>,
    pub(super) links: Vec<LinkPhase>,
    pub(super) contacts: Vec<Option<Closed>>,
}

impl Phases {
    pub(super) fn at_rest(bodies: &Bodies) -> Self {
        let springs = bodies.springs.iter().map(|spring| match spring.law {
            SpringLaw::Rule(_) => SpringPhase::Rule(HysteresisMemory::default()),
            SpringLaw::Slider(_) => SpringPhase::Slider(Mode::REST),
        });
        // What they bear under self weight.
        let springs = springs.zip(&bodies.rest.1);
        let springs = springs.map(|(phase, memory)| match phase {
            SpringPhase::Rule(_) => SpringPhase::Rule(*memory),
            other => other,
        });
        let links = bodies.links.iter().map(|link| match link.answer {
            Answer::Rule(_) => LinkPhase::Rule(HysteresisMemory::default()),
            Answer::Slider(_) => LinkPhase::Slider(Mode::REST),
            Answer::Stopper { .. } => LinkPhase::Stopper(None),
            _ => LinkPhase::None,
        });
        Self {
            springs: springs.collect(),
            tangents: vec![0.0; bodies.springs.len()],
            links: links.collect(),
            contacts: vec![None; bodies.contacts.len()],
        }
    }
}

/// Displacements, velocities, and forces of springs in series with dashpots.
#[derive(Clone, Default)]
pub(super) struct Motion {
    pub(super) u: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) z: Vec<f64>,
}

/// Forces and what they do.
#[derive(Clone, Default)]
pub(super) struct Forces {
    pub(super) springs: Vec<f64>,
    pub(super) links: Vec<f64>,
    pub(super) contacts: Vec<f64>,
    /// Restoring forces of springs and of links inside of buildings.
    pub(super) restoring: Vec<f64>,
    pub(super) acceleration: Vec<f64>,
    /// Rates of the forces of springs in series with dashpots.
    pub(super) rates: Vec<f64>,
    pub(super) ground: [f64; 3],
}

impl Bodies {
    /// Forces and accelerations at an instant. Displacements without mass are moved to where they are in equilibrium.
    pub(super) fn forces(
        &self,
        motion: &GroundMotion,
        t: f64,
        state: &mut Motion,
        phases: &Phases,
        out: &mut Forces,
    ) {
        let n = self.len();
        if !self.massless.settle(self, phases, state) {
            state.u.fill(f64::NAN);
        }
        if !self.massless.dofs.is_empty() {
            let mut rates = state.v.clone();
            self.massless.follow(self, phases, state, &mut rates);
            state.v = rates;
        }
        let Motion { u, v, z } = &*state;
        out.ground = motion.components(t.min(motion.duration));
        out.restoring.clear();
        out.restoring.resize(n, 0.0);
        self.stiffness.multiply_add(u, &mut out.restoring);
        let load = &mut out.acceleration;
        load.clear();
        load.resize(n, 0.0);
        self.damping.multiply_add(v, load);
        for (k, value) in load.iter_mut().enumerate() {
            *value = -*value
                - self.alpha[k] * self.mass[k] * v[k]
                - self.driven[0][k] * out.ground[0]
                - self.driven[1][k] * out.ground[1]
                - self.weight[k];
        }
        out.springs.clear();
        for (index, (spring, phase)) in self.springs.iter().zip(&phases.springs).enumerate() {
            let x = along(&spring.row, u);
            let force = match (&spring.law, phase) {
                (SpringLaw::Rule(rule), SpringPhase::Rule(memory)) => {
                    if spring.delay > 0.0 {
                        let dashpot = spring.delay * phases.tangents[index].max(0.0);
                        push(&spring.row, -dashpot * along(&spring.row, v), load);
                    }
                    rule.respond(memory, x).force
                }
                (SpringLaw::Slider(slider), SpringPhase::Slider(mode)) => {
                    slider.force(*mode, x, along(&spring.row, v))
                }
                _ => f64::NAN,
            };
            push(&spring.row, force, &mut out.restoring);
            out.springs.push(force);
        }
        out.links.clear();
        out.rates.clear();
        out.rates.resize(self.unknowns, 0.0);
        for (link, phase) in self.links.iter().zip(&phases.links) {
            let x = along(&link.row, u) - link.rest;
            let rate = along(&link.row, v);
            let force = match (&link.answer, phase) {
                (Answer::Linear { k, c }, _) => k * x + c * rate,
                (Answer::Viscous { c, exponent }, _) => c * power(rate, *exponent),
                (
                    Answer::Series {
                        k,
                        c,
                        exponent,
                        unknown,
                    },
                    _,
                ) => {
                    let force = z[*unknown];
                    out.rates[*unknown] = k * (rate - power(force / c, exponent.recip()));
                    force
                }
                (Answer::Slider(slider), LinkPhase::Slider(mode)) => slider.force(*mode, x, rate),
                (Answer::Rule(rule), LinkPhase::Rule(memory)) => rule.respond(memory, x).force,
                (Answer::Cable { k, slack }, _) => -k * (-x - slack).max(0.0),
                (Answer::Stopper { gap, .. }, LinkPhase::Stopper(Some(closed))) => {
                    closed.force(x - gap, rate)
                }
                (Answer::Stopper { .. }, _) => 0.0,
                _ => f64::NAN,
            };
            if link.inside {
                push(&link.row, force, &mut out.restoring);
            } else {
                push(&link.row, -force, load);
            }
            out.links.push(force);
        }
        out.contacts.clear();
        for (contact, closed) in self.contacts.iter().zip(&phases.contacts) {
            let force = closed.map_or(0.0, |closed| {
                let x = along(&contact.row, u) - contact.width;
                closed.force(x, along(&contact.row, v))
            });
            if force != 0.0 {
                push(&contact.row, -force, load);
            }
            out.contacts.push(force);
        }
        for (k, value) in load.iter_mut().enumerate() {
            *value = match self.mass[k] > 0.0 {
                true => (*value - out.restoring[k]) / self.mass[k],
                false => 0.0,
            };
        }
        self.massless.follow(self, phases, state, load);
    }
}

/// sgn x |x|^power.
fn power(x: f64, power: f64) -> f64 {
    if power == 1.0 {
        x
    } else {
        x.abs().powf(power).copysign(x)
    }
}
