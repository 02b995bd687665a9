//! Demand over capacity of columns and beams in modal coordinates.

use super::members::{Instant, MemberRows};
use super::reduced::Reduced;
use crate::history::SectionRatio;
use crate::simd;
use crate::stepping::events::Cubic;
use crate::stepping::member_ratios::{self, MemberRatios};
use crate::system::{MemberRating, System};

/// A force as a sum over modal values of one building.
#[derive(Clone, Default)]
pub(super) struct FormRow {
    /// Shares of displacements, velocities and accelerations; an empty list is zero.
    pub(super) shares: [Vec<f64>; 3],
    /// Force per ground acceleration, and per rate of it while modes are free \[kg\].
    pub(super) ground: [f64; 2],
    /// What it has at rest \[N, N·m\].
    pub(super) constant: f64,
    /// Contacts whose forces are subtracted.
    pub(super) contacts: Vec<usize>,
    /// Most that it changes per change of Σ (ω q)², the square root of it; infinite where accelerations or contacts
    /// take part.
    pub(super) norm: f64,
}

/// A section of a rated member.
struct RatedSection {
    rating: usize,
    building: usize,
    /// Its first entry among the ratios.
    first: usize,
    /// Axial force, shear and moment.
    forms: [FormRow; 3],
    /// Greatest changes of shear and moment capacity with the axial force.
    steepest: [f64; 2],
    /// Way of the building after which it is looked at again.
    until: f64,
}

/// Follows demand over capacity. A section is looked at only once its building has moved so far that a ratio could have
/// come near its greatest value.
pub(super) struct ModalRatios {
    sections: Vec<RatedSection>,
    /// All forces of every building with rated members.
    forms: Vec<Vec<FormRow>>,
    pub(super) ratios: MemberRatios,
}

/// Parts of a step in which forces are looked at.
const PARTS: usize = 4;
/// Share of the greatest ratio from which a step is looked at.
const NEAR: f64 = 0.9;

/// An accepted step of one building: modal displacements, velocities and accelerations at its ends.
pub(super) struct StepEnds<'a> {
    pub(super) then: [&'a [f64]; 3],
    pub(super) now: [&'a [f64]; 3],
    /// Ground acceleration at both.
    pub(super) ground: [f64; 2],
    /// How far the building has moved so far.
    pub(super) moved: f64,
    pub(super) step: f64,
}

impl ModalRatios {
    /// `None` where nothing is rated.
    pub(super) fn new(system: &System, reduced: &Reduced) -> Option<Self> {
        if system.ratings.is_empty() {
            return None;
        }
        let (mut sections, mut first) = (Vec::new(), 0);
        for (index, rating) in system.ratings.iter().enumerate() {
            let building = &system.buildings[rating.building];
            let rows = &reduced.buildings[rating.building].members;
            let stiffness = &reduced.stiffness[rows.modes()];
            let rules = &rating.capacity.rules;
            let shear = rules.iter().filter_map(|rule| rule.shear.as_ref());
            let bending = rules.iter().flat_map(|rule| &rule.bending);
            let steepest = [
                shear.map(|line| line.steepest()).fold(0.0, f64::max),
                bending.map(|line| line.steepest()).fold(0.0, f64::max),
            ];
            for section in &building.members.members[rating.member].sections {
                let [axial, shear, moment] = section.forms;
                let row = |form: usize| rows.form_row(building, form, stiffness);
                let axial = if rating.capacity.follows_axial {
                    row(axial)
                } else {
                    FormRow::default()
                };
                sections.push(RatedSection {
                    rating: index,
                    building: rating.building,
                    first,
                    forms: [axial, row(shear), row(moment)],
                    steepest,
                    until: 0.0,
                });
                first += rules.len();
            }
        }
        let forms = system.buildings.iter().zip(&reduced.buildings).enumerate();
        let forms = forms.map(|(index, (building, own))| {
            let rated = system.ratings.iter().any(|rating| rating.building == index);
            let count = if rated {
                building.members.forms.len()
            } else {
                0
            };
            let stiffness = &reduced.stiffness[own.members.modes()];
            let row = |form| own.members.form_row(building, form, stiffness);
            (0..count).map(row).collect()
        });
        Some(Self {
            forms: forms.collect(),
            sections,
            ratios: MemberRatios::new(system),
        })
    }

    /// Takes in a step of one building.
    pub(super) fn follow(
        &mut self,
        system: &System,
        building: usize,
        ends: &StepEnds<'_>,
        instant: Instant<'_>,
    ) {
        let mut greatest = 0.0_f64;
        let own = self
            .sections
            .iter_mut()
            .filter(|own| own.building == building);
        for section in own {
            if ends.moved < section.until {
                continue;
            }
            let rating = &system.ratings[section.rating];
            let count = rating.capacity.rules.len();
            let entries = &mut self.ratios.greatest[section.first..section.first + count];
            let forces = section.forms.each_ref().map(|form| form.at(ends, instant));
            let slack = section.slack(rating, entries, forces);
            section.until = ends.moved + slack.max(0.0);
            if slack > 0.0 {
                continue;
            }
            let pushed = section.forms.iter().any(|form| !form.contacts.is_empty());
            if instant.smooth && ends.step > 0.0 && !pushed {
                let curves = section.forms.each_ref().map(|form| form.curve(ends));
                for part in 1..PARTS {
                    let at = ends.step * part as f64 / PARTS as f64;
                    let time = instant.time - ends.step + at;
                    let forces = curves.each_ref().map(|curve| curve.value(at));
                    take_all(entries, rating, time, forces);
                }
            }
            take_all(entries, rating, instant.time, forces);
            greatest = greatest.max(entries.first().map_or(0.0, SectionRatio::greatest));
        }
        let worst = &mut self.ratios.worst[building];
        if greatest > worst.ratio {
            (worst.ratio, worst.time) = (greatest, instant.time);
            for (force, form) in worst.forces.iter_mut().zip(&self.forms[building]) {
                *force = form.at(ends, instant);
            }
        }
    }
}

fn take_all(entries: &mut [SectionRatio], rating: &MemberRating, time: f64, forces: [f64; 3]) {
    for (entry, rule) in entries.iter_mut().zip(&rating.capacity.rules) {
        // Buildings in modal stepping are elastic.
        member_ratios::take(entry, rule, rating, time, forces, 1.0);
    }
}

impl RatedSection {
    /// How far the building may move before a ratio can exceed its greatest value so far: demands grow by no more than
    /// their norms, and capacities fall by no more than their slopes times the norm of the axial force.
    fn slack(
        &self,
        rating: &MemberRating,
        entries: &[SectionRatio],
        [axial, shear, moment]: [f64; 3],
    ) -> f64 {
        let compression = rating.compression(axial);
        let norms = self.forms.each_ref().map(|form| form.norm);
        let mut slack = f64::INFINITY;
        for (entry, rule) in entries.iter().zip(&rating.capacity.rules) {
            let mut room = |most: f64, capacity: f64, demand: f64, norm: f64, steepest: f64| {
                let grows = norm + most * steepest * norms[0];
                let room = (NEAR * most * capacity - demand.abs()) / grows.max(f64::MIN_POSITIVE);
                slack = slack.min(if grows.is_finite() { room } else { -1.0 });
            };
            if let Some(capacity) = &rule.shear {
                let capacity = capacity.at(compression, 1.0);
                room(
                    entry.shear.ratio,
                    capacity,
                    shear,
                    norms[1],
                    self.steepest[0],
                );
            }
            let both = [1.0, -1.0].map(|sign| rule.bending_at(compression, sign));
            let capacity = both[0].min(both[1]);
            room(
                entry.bending.ratio,
                capacity,
                moment,
                norms[2],
                self.steepest[1],
            );
        }
        slack
    }
}

impl FormRow {
    /// At the end of a step.
    fn at(&self, ends: &StepEnds<'_>, instant: Instant<'_>) -> f64 {
        let pushes = self.contacts.iter().map(|c| instant.phases[*c].force());
        self.value(ends.now, ends.ground[1]) - pushes.sum::<f64>()
    }

    /// Without forces of contacts.
    fn value(&self, modal: [&[f64]; 3], ground: f64) -> f64 {
        let shares = self.shares.iter().zip(modal);
        let sums = shares.filter(|(shares, _)| !shares.is_empty());
        let by_modes: f64 = sums.map(|(shares, modal)| simd::dot(shares, modal)).sum();
        self.constant + self.ground[0] * ground + by_modes
    }

    /// Its course over a step in which accelerations follow a cubic.
    fn curve(&self, ends: &StepEnds<'_>) -> Cubic {
        let slope = self.ground[1] * (ends.ground[1] - ends.ground[0]) / ends.step;
        let rate = |modal: [&[f64]; 3]| {
            let [by_displacement, by_velocity, _] = &self.shares;
            let lists = [(by_displacement, modal[1]), (by_velocity, modal[2])];
            let sums = lists.into_iter().filter(|(shares, _)| !shares.is_empty());
            slope
                + sums
                    .map(|(shares, modal)| simd::dot(shares, modal))
                    .sum::<f64>()
        };
        let [start, end] = [
            self.value(ends.then, ends.ground[0]),
            self.value(ends.now, ends.ground[1]),
        ];
        Cubic::new(start, rate(ends.then), end, rate(ends.now), ends.step)
    }
}

impl MemberRows {
    /// A force as a sum over modal values.
    fn form_row(
        &self,
        building: &crate::system::BuildingSystem,
        form: usize,
        stiffness: &[f64],
    ) -> FormRow {
        let constant = building.members.forms[form].constant;
        let own = self.own_row(form);
        let (shares, ground, contacts, is_own) = match own {
            Some([shapes, missed]) => ([shapes, Vec::new(), missed], [0.0; 2], Vec::new(), true),
            None => {
                let (shares, ground, contacts) = self.passed_row(form);
                (shares, ground, contacts, false)
            }
        };
        let squares = shares[0]
            .iter()
            .zip(stiffness)
            .map(|(share, k)| share * share / k);
        let norm = squares.sum::<f64>().sqrt();
        FormRow {
            shares,
            ground,
            constant,
            contacts,
            norm: if is_own { norm } else { f64::INFINITY },
        }
    }
}
