//! Peaks between the ends of steps.

use crate::certify::C64;

use super::polynomial::{hermite_top, horner, slope};
use super::{Pushes, Run};

/// Error of a cubic in the middle of a step from which on the step is halved, relative to the peak.
const ROUGH: f64 = 1e-6;

impl Run<'_> {
    /// Goes on to a share of the step, and takes the peaks on the way.
    pub(super) fn accept(&mut self, reach: f64, after: Vec<Vec<C64>>, pushes: &Pushes) {
        let h = reach * pushes.step;
        if h > 0.0 {
            for (contact, poly) in &pushes.forces {
                let mut impulse = 0.0;
                let mut power = reach;
                for (k, c) in poly.iter().enumerate() {
                    impulse += c * power / (k + 1) as f64;
                    power *= reach;
                }
                if let Some(closed) = &mut self.closed[*contact] {
                    closed.impulse += impulse * pushes.step;
                }
                let greatest = (0..=32)
                    .map(|k| k as f64 / 32.0 * reach)
                    .map(|s| (s, horner(poly, s)))
                    .max_by(|a, b| a.1.total_cmp(&b.1))
                    .map_or(0.0, |(s, value)| {
                        // A parabola through three points.
                        let d = reach / 32.0;
                        if s <= 0.0 || s >= reach {
                            return value;
                        }
                        let (a, b) = (horner(poly, s - d), horner(poly, s + d));
                        let curve = a - 2.0 * value + b;
                        if curve < 0.0 {
                            value - (b - a) * (b - a) / (8.0 * curve)
                        } else {
                            value
                        }
                    });
                let peak = &mut self.peaks.force[*contact];
                *peak = peak.max(greatest);
                let gap = self.contact_states[*contact].gap;
                self.gap_force[gap] = self.gap_force[gap].max(greatest);
            }
        }
        let before_signals: Vec<Vec<(f64, f64)>> = (0..self.components.len())
            .map(|component| self.with_forces(component, 0.0, pushes))
            .collect();
        let old = std::mem::replace(&mut self.q, after);
        let mut after_signals = Vec::with_capacity(before_signals.len());
        for (component, before) in before_signals.iter().enumerate() {
            self.read_signals(component);
            let signals = self.with_forces(component, reach, pushes);
            self.take(component, before);
            self.take(component, &signals);
            after_signals.push(signals);
        }
        if h > 0.0 {
            let now = std::mem::replace(&mut self.q, old);
            for (component, ends) in before_signals.iter().zip(&after_signals).enumerate() {
                self.explore(component, [0.0, reach], [ends.0, ends.1], pushes, 0);
            }
            for contact in 0..self.contact_states.len() {
                self.take_closing(contact, reach, pushes, &now);
            }
            self.q = now;
        }
    }

    /// Reads how far contacts are from touching now.
    pub(super) fn read_closings(&mut self) {
        for contact in 0..self.contact_states.len() {
            self.closings[contact] = self.closing(contact, &self.q);
        }
    }

    /// Takes the greatest closing of a contact on the way to a share of the step.
    fn take_closing(&mut self, contact: usize, reach: f64, pushes: &Pushes, after: &[Vec<C64>]) {
        let h = reach * pushes.step;
        let width = self.contact_states[contact].width;
        let (x0, v0) = self.closings[contact];
        let (x1, v1) = self.closing(contact, after);
        let mut most = (self.peaks.closing[contact] - width).max(x0).max(x1);
        // It turns on the way, and may do so beyond the greatest so far.
        if v0 > 0.0 && v1 < 0.0 && x0.max(x1) + 0.3 * h * (v0 - v1) > most {
            let (mut low, mut high) = ((0.0, v0), (reach, v1));
            for _ in 0..60 {
                let share = (low.1 / (low.1 - high.1)).clamp(0.01, 0.99);
                let s = low.0 + share * (high.0 - low.0);
                let (x, v) = self.closing_at(contact, s, pushes);
                most = most.max(x);
                if v.abs() < 1e-7 * (v0 - v1) {
                    break;
                }
                if v > 0.0 {
                    low = (s, v);
                } else {
                    high = (s, v);
                }
            }
        }
        self.peaks.closing[contact] = most + width;
        self.closings[contact] = (x1, v1);
    }

    /// Takes peaks inside a part of a step: parts are halved until a cubic meets the exact motion in the middle.
    fn explore(
        &mut self,
        component: usize,
        [from, to]: [f64; 2],
        ends: [&[(f64, f64)]; 2],
        pushes: &Pushes,
        depth: u32,
    ) {
        const DEEPEST: u32 = 10;
        let h = (to - from) * pushes.step;
        let near = self.near(component, ends, h);
        if near.is_empty() {
            return;
        }
        let share = 0.5 * (from + to);
        let middle = self.exact(component, share, pushes);
        self.take(component, &middle);
        let rough = near.iter().any(|&(place, peak)| {
            let ((x0, v0), (x1, v1)) = (ends[0][place], ends[1][place]);
            let cubic = 0.5 * (x0 + x1) + 0.125 * h * (v0 - v1);
            (cubic - middle[place].0).abs() > ROUGH * peak
        });
        let halves = [
            ([from, share], [ends[0], &middle]),
            ([share, to], [&middle, ends[1]]),
        ];
        for (span, ends) in halves {
            if rough && depth < DEEPEST {
                self.explore(component, span, ends, pushes, depth + 1);
                continue;
            }
            for (place, peak) in self.near(component, ends, 0.5 * h) {
                let ((x0, v0), (x1, v1)) = (ends[0][place], ends[1][place]);
                let tops = [
                    hermite_top(x0, v0, x1, v1, 0.5 * h),
                    hermite_top(-x0, -v0, -x1, -v1, 0.5 * h),
                ];
                for (part, value) in tops.into_iter().flatten() {
                    if value > (1.0 - 1e-3) * peak {
                        let share = span[0] + part * (span[1] - span[0]);
                        let exact = self.exact(component, share, pushes);
                        self.take(component, &exact);
                    }
                }
            }
        }
    }

    /// Signals at a share of the step.
    fn exact(&self, component: usize, share: f64, pushes: &Pushes) -> Vec<(f64, f64)> {
        let mut q = Vec::new();
        self.at(component, share, pushes, &mut q);
        let bare = self.watch[component].values(&q);
        self.with_pushes(component, bare, share, pushes)
    }

    pub(super) fn read_signals(&mut self, component: usize) {
        self.signals[component] = self.watch[component].values(&self.q[component]);
    }

    /// Signals of the modes of now with what ground and contacts do at a share of the step.
    fn with_forces(&self, component: usize, s: f64, pushes: &Pushes) -> Vec<(f64, f64)> {
        self.with_pushes(component, self.signals[component].clone(), s, pushes)
    }

    fn with_pushes(
        &self,
        component: usize,
        mut signals: Vec<(f64, f64)>,
        s: f64,
        pushes: &Pushes,
    ) -> Vec<(f64, f64)> {
        let watch = &self.watch[component];
        watch.add_ground(&mut signals, horner(&pushes.ground, s));
        for (contact, poly) in &pushes.forces {
            let (force, rise) = (horner(poly, s), slope(poly, s) / pushes.step);
            for side in self.contact_states[*contact]
                .sides
                .iter()
                .filter(|side| side.component == component)
            {
                for floor in 0..watch.floors {
                    let signal = &mut signals[watch.acceleration(floor)];
                    signal.0 += side.accelerates[floor] * force;
                    signal.1 += side.jerks[floor] * force + side.accelerates[floor] * rise;
                }
                for (link, pull) in side.pulls.iter().enumerate() {
                    signals[watch.link(link)].1 += pull * force;
                }
            }
        }
        signals
    }

    /// Takes values into the peaks.
    fn take(&mut self, component: usize, signals: &[(f64, f64)]) {
        let watch = &self.watch[component];
        for watched in &watch.buildings {
            let peaks = &mut self.peaks.buildings[watched.building];
            for floor in 0..watched.heights.len() {
                let global = watched.first_floor + floor;
                let u = signals[global].0;
                peaks.most[floor] = peaks.most[floor].max(u);
                peaks.least[floor] = peaks.least[floor].min(u);
                let drift = signals[watch.drift(global)].0.abs();
                peaks.drift[floor] = peaks.drift[floor].max(drift);
                let acceleration = signals[watch.acceleration(global)].0.abs();
                peaks.acceleration[floor] = peaks.acceleration[floor].max(acceleration);
                let shear = signals[watch.storey_shear(global)].0.abs();
                peaks.storey_shear[floor] = peaks.storey_shear[floor].max(shear);
                let moment = signals[watch.moment(global)].0.abs();
                peaks.moment[floor] = peaks.moment[floor].max(moment);
            }
            let place = watch.shear(watched.building);
            peaks.shear = peaks.shear.max(signals[place].0.abs());
        }
        for (index, link) in watch.links.iter().enumerate() {
            let peak = &mut self.peaks.link[link.link];
            *peak = peak.max(signals[watch.link(index)].0.abs());
        }
    }

    /// Signals that may be greater between two instants than ever before, each with the lesser of its own peaks up and
    /// down.
    fn near(&self, component: usize, ends: [&[(f64, f64)]; 2], h: f64) -> Vec<(usize, f64)> {
        let watch = &self.watch[component];
        let mut near = Vec::new();
        let mut look = |place: usize, most: f64, least: f64| {
            let ((x0, v0), (x1, v1)) = (ends[0][place], ends[1][place]);
            let reach = 0.3 * h * (v0.abs() + v1.abs());
            if x0.max(x1) + reach > most {
                near.push((place, most));
            } else if x0.min(x1) - reach < least {
                near.push((place, -least));
            }
        };
        for watched in &watch.buildings {
            let peaks = &self.peaks.buildings[watched.building];
            for floor in 0..watched.heights.len() {
                let global = watched.first_floor + floor;
                look(global, peaks.most[floor], peaks.least[floor]);
                look(watch.drift(global), peaks.drift[floor], -peaks.drift[floor]);
                let a = peaks.acceleration[floor];
                look(watch.acceleration(global), a, -a);
                let shear = peaks.storey_shear[floor];
                look(watch.storey_shear(global), shear, -shear);
                look(
                    watch.moment(global),
                    peaks.moment[floor],
                    -peaks.moment[floor],
                );
            }
            look(watch.shear(watched.building), peaks.shear, -peaks.shear);
        }
        for (index, link) in watch.links.iter().enumerate() {
            let peak = self.peaks.link[link.link];
            look(watch.link(index), peak, -peak);
        }
        near
    }
}
