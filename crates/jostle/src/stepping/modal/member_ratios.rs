//! Demand over capacity of columns and beams in modal coordinates.

use pulp::{Arch, NullaryFnOnce};

use super::least_capacities::LeastCapacities;
use super::member_reach::{BlockWatch, PARTS as STEP_PARTS, PartRows, Reach, norms_in_blocks};
use super::members::{Instant, MemberRows};
use super::mode_kernels::ROWS;
use super::reduced::Reduced;
use crate::history::SectionRatio;
use crate::simd;
use crate::stepping::events::Cubic;
use crate::stepping::member_ratios::{self, MemberRatios, RatedForces};
use crate::system::{MemberRating, RatedPart, System};

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
    /// Whether displacements determine it, except for the part that the shapes miss.
    pub(super) is_bounded: bool,
}

/// A section of a rated member.
struct RatedSection {
    rating: usize,
    /// Its first entry among the ratios.
    first: usize,
    /// Its member's among the least capacities.
    least: usize,
    /// Axial force, shear and moment, then shear and moment across of a column of a space frame.
    forms: Vec<FormRow>,
    /// Most that they change per ‖ω Δq‖.
    norms: PartRows,
    /// Whether modes alone determine them.
    is_bounded: bool,
    watch: BlockWatch,
}

/// A modal state of one building.
#[derive(Clone, Default)]
struct KeptState {
    /// Displacements, velocities and accelerations.
    modal: [Vec<f64>; 3],
    ground: f64,
    /// Forces of all contacts.
    pushes: Vec<f64>,
}

/// Follows demand over capacity. A section is looked at only once modes have moved so far that a ratio could have come near
/// its greatest value, and a capacity only if the least of it nearby does not settle the matter.
pub(super) struct ModalRatios {
    /// Building by building.
    sections: Vec<Vec<RatedSection>>,
    least: Vec<LeastCapacities>,
    /// All forces of every building with rated members.
    forms: Vec<Vec<FormRow>>,
    /// The state of every building when its governing ratio was greatest.
    worst: Vec<KeptState>,
    ratios: MemberRatios,
}

/// Most forces of a section.
const MOST_FORMS: usize = 5;
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
    pub(super) step: f64,
}

impl ModalRatios {
    /// `None` where nothing is rated.
    pub(super) fn new(system: &System, reduced: &Reduced) -> Option<Self> {
        if system.ratings.is_empty() {
            return None;
        }
        let mut sections: Vec<Vec<RatedSection>> = Vec::new();
        sections.resize_with(system.buildings.len(), Vec::new);
        let (mut least, mut first) = (Vec::new(), 0);
        // The latest member with capacities of its own.
        let mut latest: Option<&MemberRating> = None;
        for (index, rating) in system.ratings.iter().enumerate() {
            let building = &system.buildings[rating.building];
            let rows = &reduced.buildings[rating.building].members;
            let stiffness = &reduced.stiffness[rows.modes()];
            let rules = &rating.capacity.rules;
            if latest.is_none_or(|latest| latest.capacity.rules != *rules) {
                latest = Some(rating);
                least.push(LeastCapacities::new(&rating.capacity));
            }
            for section in &rating.sections {
                let [axial, shear, moment] = section.forms;
                let row = |form: usize| rows.form_row(building, form);
                let axial = if rating.capacity.follows_axial {
                    row(axial)
                } else {
                    FormRow::default()
                };
                let mut forms = vec![axial, row(shear), row(moment)];
                if rules.iter().any(|rule| rule.across.is_some()) {
                    let across = section.across.into_iter();
                    forms.extend(across.flat_map(|[shear, moment, _]| [row(shear), row(moment)]));
                }
                let lists = forms.iter().map(|form| &form.shares[0]);
                let norms = norms_in_blocks(lists, stiffness);
                sections[rating.building].push(RatedSection {
                    rating: index,
                    first,
                    least: least.len() - 1,
                    is_bounded: forms.iter().all(|form| form.is_bounded),
                    norms: norms.first().copied().unwrap_or([[0.0; ROWS]; STEP_PARTS]),
                    forms,
                    watch: BlockWatch::DUE,
                });
                first += rules.len();
            }
        }
        let forms = system.buildings.iter().zip(&reduced.buildings).enumerate();
        let forms = forms.map(|(index, (building, reduced_building))| {
            let count = if sections[index].is_empty() {
                0
            } else {
                building.members.forms.len()
            };
            let row = |form| reduced_building.members.form_row(building, form);
            (0..count).map(row).collect()
        });
        let worst = sections
            .iter()
            .zip(&reduced.buildings)
            .map(|(sections, building)| {
                if sections.is_empty() {
                    return KeptState::default();
                }
                KeptState {
                    modal: [(); 3].map(|()| vec![0.0; building.members.modes().len()]),
                    ground: 0.0,
                    pushes: vec![0.0; system.contacts.len()],
                }
            });
        Some(Self {
            forms: forms.collect(),
            worst: worst.collect(),
            sections,
            least,
            ratios: MemberRatios::new(system),
        })
    }

    /// Takes in a step of one building.
    pub(super) fn follow(
        &mut self,
        arch: Arch,
        (system, building, reach): (&System, usize, &Reach),
        ends: &StepEnds<'_>,
        instant: Instant<'_>,
    ) {
        let greatest = arch.dispatch(FollowSections {
            sections: &mut self.sections[building],
            least: &self.least,
            entries: &mut self.ratios.greatest,
            reach,
            system,
            ends,
            instant,
        });
        let worst = &mut self.ratios.worst[building];
        if greatest > worst.ratio {
            (worst.ratio, worst.time) = (greatest, instant.time);
            let kept = &mut self.worst[building];
            for (to, list) in kept.modal.iter_mut().zip(ends.now) {
                to.copy_from_slice(list);
            }
            kept.ground = ends.ground[1];
            for (to, phase) in kept.pushes.iter_mut().zip(instant.phases) {
                *to = phase.force();
            }
        }
    }

    /// The greatest ratios, and all forces at the worst instants.
    pub(super) fn finish(self) -> MemberRatios {
        let mut ratios = self.ratios;
        let buildings = self.worst.iter().zip(&self.forms);
        for (worst, (kept, forms)) in ratios.worst.iter_mut().zip(buildings) {
            if worst.ratio > 0.0 {
                for (force, form) in worst.forces.iter_mut().zip(forms) {
                    *force = form.at(
                        kept.modal.each_ref().map(|list| &list[..]),
                        kept.ground,
                        |contact| kept.pushes[contact],
                    );
                }
            }
        }
        ratios
    }
}

/// A step of the rated sections of one building; gives the greatest governing ratio of members that were looked at.
struct FollowSections<'a> {
    sections: &'a mut [RatedSection],
    least: &'a [LeastCapacities],
    entries: &'a mut [SectionRatio],
    reach: &'a Reach,
    system: &'a System,
    ends: &'a StepEnds<'a>,
    instant: Instant<'a>,
}

impl NullaryFnOnce for FollowSections<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self {
            system,
            ends,
            instant,
            ..
        } = self;
        let mut greatest = 0.0_f64;
        for section in self.sections {
            if !section.watch.is_due(self.reach, 0.0) {
                continue;
            }
            let rating = &system.ratings[section.rating];
            let least = &self.least[section.least];
            let count = rating.capacity.rules.len();
            let entries = &mut self.entries[section.first..section.first + count];
            let forces = section.forces(|form| {
                form.at(ends.now, ends.ground[1], |contact| {
                    instant.phases[contact].force()
                })
            });
            section.watch = BlockWatch::DUE;
            if section.is_bounded
                && section.is_far(rating, least, entries, self.reach, forces, ends.now[0])
            {
                continue;
            }
            let mut take = |time: f64, forces: RatedForces| {
                take_exceeding(entries, rating, least, time, forces);
            };
            let pushed = section.forms.iter().any(|form| !form.contacts.is_empty());
            if instant.smooth && ends.step > 0.0 && !pushed {
                let curves = section.each(|form| Some(form.curve(ends)));
                for part in 1..PARTS {
                    let share = part as f64 / PARTS as f64;
                    let time = instant.time - (1.0 - share) * ends.step;
                    let value =
                        |curve: &Option<Cubic>| curve.as_ref().map(|curve| curve.value(share));
                    let values = curves
                        .each_ref()
                        .map(|curve| value(curve).unwrap_or_default());
                    take(time, in_order(values));
                }
            }
            take(instant.time, forces);
            if matches!(rating.part, RatedPart::Member(_)) {
                greatest = greatest.max(entries.first().map_or(0.0, SectionRatio::greatest));
            }
        }
        greatest
    }
}

/// Takes in the forces at an instant by the rules whose greatest ratios they may exceed.
#[inline(always)]
fn take_exceeding(
    entries: &mut [SectionRatio],
    rating: &MemberRating,
    least: &LeastCapacities,
    time: f64,
    forces: RatedForces,
) {
    let compression = rating.compression(forces.axial);
    let [shear, moment] = least.sizes(&forces);
    let rules = rating.capacity.rules.iter().zip(least.within(compression));
    for (entry, (rule, [by_shear, by_bending])) in entries.iter_mut().zip(rules) {
        // Buildings in modal stepping are elastic.
        if shear >= entry.shear.ratio * by_shear {
            member_ratios::take_shear(entry, rule, time, forces.shears, compression, 1.0);
        }
        if moment >= entry.bending.ratio * by_bending {
            member_ratios::take_bending(entry, rule, time, forces.moments, compression);
        }
    }
}

/// Forces in the order of [`RatedSection::forms`].
#[inline(always)]
fn in_order([axial, shear, moment, shear_across, moment_across]: [f64; MOST_FORMS]) -> RatedForces {
    RatedForces {
        axial,
        shears: [shear, shear_across],
        moments: [moment, moment_across],
    }
}

impl RatedSection {
    /// A value of each of its forces, the default of those that it lacks.
    #[inline(always)]
    fn each<T: Default>(&self, value: impl Fn(&FormRow) -> T) -> [T; MOST_FORMS] {
        std::array::from_fn(|index| self.forms.get(index).map_or_else(T::default, &value))
    }

    #[inline(always)]
    fn forces(&self, value: impl Fn(&FormRow) -> f64) -> RatedForces {
        in_order(self.each(value))
    }

    /// Whether no ratio is near its greatest value; if so, it sets when the section has to be looked at again: forces of low
    /// modes change by no more than their ways, all others stay below the size of the rest, and capacities change by no more
    /// than the compression, within a range and those beside it.
    #[inline(always)]
    fn is_far(
        &mut self,
        rating: &MemberRating,
        least: &LeastCapacities,
        entries: &[SectionRatio],
        reach: &Reach,
        forces: RatedForces,
        modal: &[f64],
    ) -> bool {
        let compression = rating.compression(forces.axial);
        let most = least.near(entries, compression, NEAR);
        let [shear, moment] = least.sizes(&forces);
        if shear >= most[0] || moment >= most[1] {
            return false;
        }
        let low = self.forces(|form| form.of_low(reach.low, modal));
        let [shear, moment] = least.sizes(&low);
        let mut slack = [0.0; ROWS];
        slack[0] = least.reach - (forces.axial - low.axial).abs();
        let of_both = [most[0] - shear, most[1] - moment];
        [slack[1], slack[2]] = of_both;
        if self.forms.len() == MOST_FORMS {
            [[slack[1], slack[3]], [slack[2], slack[4]]] = least.shares(of_both);
        }
        self.watch.set(reach, &self.norms, &slack);
        true
    }
}

impl FormRow {
    /// The force by the displacements of low modes.
    #[inline(always)]
    fn of_low(&self, low: usize, modal: &[f64]) -> f64 {
        let shares = self.shares[0].get(..low).unwrap_or_default();
        self.constant + simd::dot(shares, &modal[..shares.len()])
    }

    /// The force; `contact` returns that of a contact \[N\].
    #[inline(always)]
    fn at(&self, modal: [&[f64]; 3], ground: f64, contact: impl Fn(usize) -> f64) -> f64 {
        let pushes = self.contacts.iter().map(|index| contact(*index));
        self.value(modal, ground) - pushes.sum::<f64>()
    }

    /// Without forces of contacts.
    #[inline(always)]
    fn value(&self, modal: [&[f64]; 3], ground: f64) -> f64 {
        let shares = self.shares.iter().zip(modal);
        let sums = shares.filter(|(shares, _)| !shares.is_empty());
        let by_modes: f64 = sums.map(|(shares, modal)| simd::dot(shares, modal)).sum();
        self.constant + self.ground[0] * ground + by_modes
    }

    /// Its course over a step in which accelerations follow a cubic.
    #[inline(always)]
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
    fn form_row(&self, building: &crate::system::BuildingSystem, form: usize) -> FormRow {
        let constant = building.members.forms[form].constant;
        let own_row = self.own_row(form);
        let (shares, ground, contacts, is_own) = match own_row {
            Some([shapes, missed]) => ([shapes, Vec::new(), missed], [0.0; 2], Vec::new(), true),
            None => {
                let (shares, ground, contacts) = self.passed_row(form);
                (shares, ground, contacts, false)
            }
        };
        FormRow {
            shares,
            ground,
            constant,
            contacts,
            is_bounded: is_own,
        }
    }
}
