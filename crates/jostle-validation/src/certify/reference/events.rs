//! First contacts, momentum impacts, corners and releases.

use crate::certify::C64;

use super::super::laws::{Closed, Next};
use super::polynomial::{Poly, hermite_top, horner, slope};
use super::{Pushes, Run};

impl Run<'_> {
    /// The first corner or release of a closed contact in a step, and what happens there.
    pub(super) fn corners(
        &self,
        courses: &[(usize, Poly, Poly)],
        most: f64,
    ) -> (f64, Vec<(usize, Next)>) {
        const PARTS: usize = 16;
        let mut first = most;
        let mut events = Vec::new();
        for (contact, x, v) in courses {
            let Some(closed) = &self.closed[*contact] else {
                continue;
            };
            let conditions = |s: f64| closed.conditions(horner(x, s), horner(v, s), slope(v, s));
            let mut before = conditions(0.0);
            'parts: for part in 1..=PARTS {
                let s = most * part as f64 / PARTS as f64;
                let now = conditions(s);
                let mut found: Option<(f64, Next)> = None;
                for k in 0..3 {
                    if now[k].0 >= 0.0 {
                        continue;
                    }
                    let (mut low, mut high) = (most * (part - 1) as f64 / PARTS as f64, s);
                    if before[k].0 < 0.0 {
                        // It failed from the start: at once.
                        high = low;
                    } else {
                        for _ in 0..70 {
                            let middle = 0.5 * (low + high);
                            if conditions(middle)[k].0 < 0.0 {
                                high = middle;
                            } else {
                                low = middle;
                            }
                        }
                    }
                    if found.is_none_or(|(at, _)| high < at) {
                        found = Some((high, now[k].1));
                    }
                }
                if let Some((at, next)) = found {
                    if at < first {
                        first = at;
                        events.clear();
                    }
                    if at <= first {
                        events.push((*contact, next));
                    }
                    break 'parts;
                }
                before = now;
            }
        }
        (first, events)
    }

    /// The first touch of an open contact within a share of the step.
    pub(super) fn touch_within(
        &self,
        reach: f64,
        after: &[Vec<C64>],
        pushes: &Pushes,
    ) -> Option<(f64, usize)> {
        let h = reach * pushes.step;
        let mut first: Option<(f64, usize)> = None;
        for contact in 0..self.contact_states.len() {
            if self.closed[contact].is_some() {
                continue;
            }
            let (x0, v0) = self.closings[contact];
            let (x1, v1) = self.closing(contact, after);
            let Some(s) = self.touch_of(contact, (x0, v0), (x1, v1), h, reach, pushes) else {
                continue;
            };
            if first.is_none_or(|(at, _)| s < at) {
                first = Some((s, contact));
            }
        }
        first
    }

    fn touch_of(
        &self,
        contact: usize,
        (x0, v0): (f64, f64),
        (x1, v1): (f64, f64),
        h: f64,
        reach: f64,
        pushes: &Pushes,
    ) -> Option<f64> {
        const NEAR: f64 = 1e-13;
        let touching = x0 > -NEAR;
        if touching && v0 > 1e-13 {
            return Some(0.0);
        }
        if h <= 0.0 {
            return None;
        }
        let top = hermite_top(x0, v0, x1, v1, h);
        if !touching
            && x1 <= 0.0
            && top.is_none_or(|(_, value)| value < -1e-8 - 1e-3 * (x1 - x0).abs())
        {
            return None;
        }
        let at = |share: f64| self.closing_at(contact, share * reach, pushes);
        let (mut low, mut high);
        if touching {
            if x1 <= 0.0 {
                return None;
            }
            if v0 > -1e-13 {
                return Some(0.0);
            }
            // It parts, and comes back: find where it is apart.
            (low, high) = (0.5, 1.0);
            let mut found = false;
            for _ in 0..40 {
                if at(low).0 < 0.0 {
                    found = true;
                    break;
                }
                high = low;
                low *= 0.5;
            }
            if !found {
                return Some(0.0);
            }
        } else {
            (low, high) = (0.0, 1.0);
            if x1 <= 0.0 {
                let (place, _) = top?;
                // The top of the exact course.
                let (mut a, mut b) = (0.0_f64.max(place - 0.3), 1.0_f64.min(place + 0.3));
                let mut place = place;
                let mut deepest = f64::NEG_INFINITY;
                for _ in 0..12 {
                    let (x, v) = at(place);
                    deepest = deepest.max(x);
                    if x > 0.0 {
                        break;
                    }
                    if v > 0.0 {
                        a = place;
                    } else {
                        b = place;
                    }
                    place = 0.5 * (a + b);
                    if deepest < -1e-7 && b - a < 0.1 {
                        break;
                    }
                }
                if at(place).0 <= 0.0 {
                    return None;
                }
                high = place;
            }
        }
        let mut s = 0.5 * (low + high);
        for _ in 0..80 {
            let (x, v) = at(s);
            if x > 0.0 {
                high = s;
            } else {
                low = s;
            }
            if x.abs() < 1e-15 || high - low < 1e-16 {
                break;
            }
            let newton = s - x / (v * h);
            s = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
        }
        Some(s * reach)
    }

    /// Closes the contact that touches, and all that touch with it.
    pub(super) fn apply_closings(&mut self, first: usize, level: &mut usize) {
        let mut jumps = 0;
        loop {
            let touching: Vec<usize> = (0..self.contact_states.len())
                .filter(|&contact| {
                    let (x, v) = self.closing(contact, &self.q);
                    self.closed[contact].is_none()
                        && (contact == first && jumps == 0 || x >= -1e-12 && v > 0.0)
                })
                .collect();
            let struck = touching.iter().find_map(|&contact| {
                let rate = self.closing(contact, &self.q).1;
                let restitution = self.contact_states[contact]
                    .restitution
                    .filter(|_| rate > 1e-3)?;
                Some((contact, restitution, rate))
            });
            if let Some((contact, restitution, rate)) = struck {
                jumps += 1;
                let impulse = (1.0 + restitution) * self.contact_states[contact].mass * rate;
                for side in &self.contact_states[contact].sides {
                    for (q, b) in self.q[side.component].iter_mut().zip(&side.push) {
                        *q += b * impulse;
                    }
                }
                self.peaks.impulse[contact] += impulse;
                self.peaks.touches += 1;
                let sides: Vec<usize> = self.contact_states[contact]
                    .sides
                    .iter()
                    .map(|side| side.component)
                    .collect();
                for component in sides {
                    self.read_signals(component);
                }
                if jumps < 10_000 {
                    continue;
                }
            }
            for contact in touching {
                let rate = self.closing(contact, &self.q).1.max(0.0);
                if self.contact_states[contact].restitution.is_some() && rate > 1e-3 {
                    continue;
                }
                if self.contact_states[contact].restitution.is_some() {
                    self.peaks.lasting += 1;
                }
                let law = self.contact_states[contact].law;
                self.closed[contact] = Some(Closed::touch(law, rate));
                self.peaks.touches += 1;
                let begin = if law.is_steep() {
                    2e-10
                } else {
                    self.contact_states[contact].duration / 20.0
                };
                let wanted = (self.levels[0].step / begin).log2().ceil().max(0.0) as usize;
                *level = (*level).max(wanted);
            }
            break;
        }
        self.read_closings();
    }

    /// A corner or the release of a contact.
    pub(super) fn apply_event(&mut self, contact: usize, next: Next) {
        let (x, v) = self.closing(contact, &self.q);
        let Some(closed) = &mut self.closed[contact] else {
            return;
        };
        match next {
            Next::Piece(piece) => closed.become_piece(piece, x, v),
            Next::Release => {
                self.peaks.impulse[contact] += closed.impulse;
                self.closed[contact] = None;
            }
        }
    }
}
