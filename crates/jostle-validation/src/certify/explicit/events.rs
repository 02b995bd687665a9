//! Where a force comes to another smooth piece.

use jostle::hysteresis::{Hysteresis, HysteresisMemory, HysteresisRule, Side};

use super::super::laws::{Closed, Next};
use super::Run;
use super::bodies::{Answer, Row, SpringLaw, along};
use super::course::{Course, first_below};
use super::forces::{LinkPhase, SpringPhase};

/// What happens.
pub(super) enum What {
    /// Nothing but that a step ends here.
    Corner,
    Touch(usize),
    Contact(usize, Next),
    Spring(usize),
    Link(usize),
    StopperTouches(usize),
    Stopper(usize, Next),
}

/// An event at a share of a step.
pub(super) struct Event {
    pub(super) share: f64,
    pub(super) what: What,
}

/// Corners nearer than this to where a step begins have been passed, as a share of the yield deformation.
const PASSED: f64 = 1e-8;

impl Run<'_> {
    fn course(&self, row: &Row, rest: f64, h: f64) -> Course {
        let (a, b) = (&self.state, &self.after);
        Course::new(
            [
                along(row, &a.u) - rest,
                along(row, &a.v),
                along(row, &self.forces.acceleration),
            ],
            [
                along(row, &b.u) - rest,
                along(row, &b.v),
                along(row, &self.after_forces.acceleration),
            ],
            h,
        )
    }

    /// The first event of the step just tried.
    pub(super) fn first_event(&self, h: f64) -> Option<Event> {
        let mut first: Option<Event> = None;
        let mut take = |share: Option<f64>, what: What| {
            if let Some(share) = share
                && first.as_ref().is_none_or(|first| share < first.share)
            {
                first = Some(Event { share, what });
            }
        };
        for (index, (contact, closed)) in self
            .bodies
            .contacts
            .iter()
            .zip(&self.phases.contacts)
            .enumerate()
        {
            let course = self.course(&contact.row, contact.width, h);
            match closed {
                None => {
                    let ends: Vec<Course> = contact
                        .ends
                        .iter()
                        .map(|(row, inside)| self.course(row, -inside, h))
                        .collect();
                    // A corner behind an edge that it has not touched does not touch it as it comes back.
                    let share = first_below(ends.is_empty(), |s| -course.value(s));
                    let share =
                        share.filter(|share| ends.iter().all(|end| end.value(*share) > 0.0));
                    take(share, What::Touch(index));
                }
                Some(closed) => {
                    let found = conditions(closed, &course);
                    if let Some((share, next)) = found {
                        take(Some(share), What::Contact(index, next));
                    }
                    for (row, inside) in &contact.ends {
                        let end = self.course(row, -inside, h);
                        let share = first_below(true, |s| end.value(s));
                        take(share, What::Contact(index, Next::Release));
                    }
                }
            }
        }
        for (index, (spring, phase)) in self
            .bodies
            .springs
            .iter()
            .zip(&self.phases.springs)
            .enumerate()
        {
            let course = self.course(&spring.row, 0.0, h);
            match (&spring.law, phase) {
                (SpringLaw::Rule(rule), SpringPhase::Rule(memory)) => {
                    take(corner(rule, memory, &course), What::Corner);
                }
                (SpringLaw::Slider(slider), SpringPhase::Slider(mode)) => {
                    for which in [0, 1] {
                        let share = first_below(true, |s| {
                            let (x, v, w) = (course.value(s), course.rate(s), course.turn(s));
                            slider.conditions(*mode, x, v, w)[which]
                        });
                        take(share, What::Spring(index));
                    }
                }
                _ => {}
            }
        }
        for (index, (link, phase)) in self.bodies.links.iter().zip(&self.phases.links).enumerate() {
            if matches!(link.answer, Answer::Linear { .. }) {
                continue;
            }
            let course = self.course(&link.row, link.rest, h);
            match (&link.answer, phase) {
                (Answer::Rule(rule), LinkPhase::Rule(memory)) => {
                    take(corner(rule, memory, &course), What::Corner);
                }
                (Answer::Slider(slider), LinkPhase::Slider(mode)) => {
                    for which in [0, 1] {
                        let share = first_below(true, |s| {
                            let (x, v, w) = (course.value(s), course.rate(s), course.turn(s));
                            slider.conditions(*mode, x, v, w)[which]
                        });
                        take(share, What::Link(index));
                    }
                }
                (Answer::Viscous { exponent, .. }, _) if *exponent != 1.0 => {
                    take(crossing(|s| course.rate(s)), What::Corner);
                }
                (
                    Answer::Series {
                        exponent, unknown, ..
                    },
                    _,
                ) if *exponent != 1.0 => {
                    let force = Course::new(
                        [self.state.z[*unknown], self.forces.rates[*unknown], 0.0],
                        [
                            self.after.z[*unknown],
                            self.after_forces.rates[*unknown],
                            0.0,
                        ],
                        h,
                    );
                    take(crossing(|s| force.value(s)), What::Corner);
                }
                (Answer::Cable { slack, .. }, _) => {
                    take(crossing(|s| -course.value(s) - slack), What::Corner);
                }
                (Answer::Stopper { gap, .. }, LinkPhase::Stopper(closed)) => {
                    let course = self.course(&link.row, link.rest + gap, h);
                    match closed {
                        None => {
                            let share = first_below(true, |s| -course.value(s));
                            take(share, What::StopperTouches(index));
                        }
                        Some(closed) => {
                            if let Some((share, next)) = conditions(closed, &course) {
                                take(Some(share), What::Stopper(index, next));
                            }
                        }
                    }
                }
                _ => {}
            }
        }
        first
    }

    /// Lets it happen at the present instant.
    pub(super) fn apply(&mut self, what: &What) {
        let (u, v) = (&self.state.u, &self.state.v);
        match *what {
            What::Corner => {}
            What::Touch(index) => {
                let contact = &self.bodies.contacts[index];
                let rate = along(&contact.row, v).max(0.0);
                self.phases.contacts[index] = Some(Closed::touch(contact.law, rate));
                self.touches += 1;
            }
            What::Contact(index, next) => {
                let contact = &self.bodies.contacts[index];
                let (x, rate) = (
                    along(&contact.row, u) - contact.width,
                    along(&contact.row, v),
                );
                follow(&mut self.phases.contacts[index], next, x, rate);
            }
            What::Spring(index) => {
                let spring = &self.bodies.springs[index];
                if let (SpringLaw::Slider(slider), SpringPhase::Slider(mode)) =
                    (&spring.law, &mut self.phases.springs[index])
                {
                    *mode = slider.next(*mode, along(&spring.row, u), along(&spring.row, v));
                }
            }
            What::Link(index) => {
                let link = &self.bodies.links[index];
                if let (Answer::Slider(slider), LinkPhase::Slider(mode)) =
                    (&link.answer, &mut self.phases.links[index])
                {
                    let x = along(&link.row, u) - link.rest;
                    *mode = slider.next(*mode, x, along(&link.row, v));
                }
            }
            What::StopperTouches(index) => {
                let link = &self.bodies.links[index];
                if let Answer::Stopper { law, .. } = link.answer {
                    let rate = along(&link.row, v).max(0.0);
                    self.phases.links[index] = LinkPhase::Stopper(Some(Closed::touch(law, rate)));
                }
            }
            What::Stopper(index, next) => {
                let link = &self.bodies.links[index];
                if let (Answer::Stopper { gap, .. }, LinkPhase::Stopper(closed)) =
                    (&link.answer, &mut self.phases.links[index])
                {
                    let x = along(&link.row, u) - link.rest - gap;
                    follow(closed, next, x, along(&link.row, v));
                }
            }
        }
    }

    /// Finds the lines on which springs with dashpots of their present stiffness go on from here.
    pub(super) fn find_tangents(&mut self) {
        /// What a spring that turns has gained in speed \[s\].
        const SOON: f64 = 1e-7;
        let springs = self.bodies.springs.iter().enumerate();
        for (index, spring) in springs.filter(|(_, spring)| spring.delay > 0.0) {
            let (SpringLaw::Rule(rule), SpringPhase::Rule(memory)) =
                (&spring.law, &self.phases.springs[index])
            else {
                continue;
            };
            let turns = match self.forces.acceleration.is_empty() {
                true => 0.0,
                false => along(&spring.row, &self.forces.acceleration),
            };
            let rate = along(&spring.row, &self.state.v) + SOON * turns;
            let side = Side::from_change(rate);
            // Corners nearer than this have been passed.
            let ahead = PASSED * rule.backbone().side(side).yielding.deformation;
            let place = memory.deformation() + side.sign() * ahead;
            self.phases.tangents[index] = rule.respond(memory, place).tangent;
        }
    }

    /// Commits the memories of what was deformed.
    pub(super) fn remember(&mut self) {
        for (spring, phase) in self.bodies.springs.iter().zip(&mut self.phases.springs) {
            if let (SpringLaw::Rule(rule), SpringPhase::Rule(memory)) = (&spring.law, phase) {
                commit(rule, memory, along(&spring.row, &self.state.u));
            }
        }
        for (link, phase) in self.bodies.links.iter().zip(&mut self.phases.links) {
            if let (Answer::Rule(rule), LinkPhase::Rule(memory)) = (&link.answer, phase) {
                commit(rule, memory, along(&link.row, &self.state.u) - link.rest);
            }
        }
    }
}

fn commit(rule: &Hysteresis, memory: &mut HysteresisMemory, x: f64) {
    *memory = rule.respond(memory, x).memory;
}

fn follow(closed: &mut Option<Closed>, next: Next, x: f64, rate: f64) {
    match (next, closed.as_mut()) {
        (Next::Piece(piece), Some(closed)) => closed.become_piece(piece, x, rate),
        _ => *closed = None,
    }
}

/// The first condition of a contact that fails.
fn conditions(closed: &Closed, course: &Course) -> Option<(f64, Next)> {
    let at = |s: f64| closed.conditions(course.value(s), course.rate(s), course.turn(s));
    let mut first: Option<(f64, Next)> = None;
    for which in 0..3 {
        if let Some(share) = first_below(true, |s| at(s)[which].0)
            && first.is_none_or(|(before, _)| share < before)
        {
            first = Some((share, at(share)[which].1));
        }
    }
    first
}

/// Where a number changes its sign; not where it leaves zero.
fn crossing(function: impl Fn(f64) -> f64) -> Option<f64> {
    let sign = 1.0_f64.copysign(function(0.125));
    let share = if sign * function(0.0) < 0.0 {
        // It changed before the first sample.
        first_below(false, |s| -sign * function(s))
    } else {
        first_below(false, |s| sign * function(s))
    };
    share.filter(|share| *share > 1e-6)
}

/// Where a spring reverses or comes to another line.
fn corner(rule: &Hysteresis, memory: &HysteresisMemory, course: &Course) -> Option<f64> {
    if matches!(rule.rule(), HysteresisRule::Elastic) {
        return None;
    }
    let turn = crossing(|s| course.rate(s));
    let side = Side::from_change(course.rate(0.125));
    let place = rule.next_corner(memory, side);
    let size = rule.backbone().side(side).yielding.deformation;
    let sign = side.sign();
    let ahead = sign * (place - course.value(0.0));
    let reached = (place.is_finite() && ahead > PASSED * size)
        .then(|| first_below(false, |s| sign * (place - course.value(s))))
        .flatten();
    match (turn, reached) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (one, other) => one.or(other),
    }
}
