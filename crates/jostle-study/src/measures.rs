//! Engineering demand parameters of a run, by name: the results of a row of a study.

use jostle::quantity::Read;
use jostle::results::in_plan::{BuildingInPlan, FloorInPlan};
use jostle::results::response::{BuildingResponse, FloorResponse};
use jostle::results::summary::{
    BuildingSummary, CapacitySummary, ContactSummary, EnergySummary, GapSummary, IsolationInPlan,
    IsolationSummary, LinkSummary, MotionSummary, PanelsSummary, RotationLevelsSummary,
    ShearFailureSummary, StrainsSummary, WorkSummary,
};
use jostle::{GroundMotion, Quantity, Summary, Wave};
use jostle_motion::{Accelerogram, Reading, response_spectrum};

use crate::layout::{Kind, Named};

/// Damping ratio of the spectral accelerations.
const SPECTRUM_DAMPING: f64 = 0.05;

/// Collects named numbers.
struct List {
    named: Vec<Named>,
    /// Whether the study compares with runs without contact.
    compares: bool,
}

impl List {
    fn put(&mut self, name: String, kind: Kind, value: Option<f64>) {
        let value = value.filter(|value| value.is_finite());
        self.named.push(Named { name, kind, value });
    }

    /// The numbers of an owner; their names begin with `place`.
    fn add<T>(&mut self, place: &str, quantities: &'static [Quantity<T>], owner: &T) {
        for quantity in quantities.iter().filter(|quantity| quantity.places.study) {
            self.add_one(place, quantity, owner);
        }
    }

    /// The same without numbers that the owner does not have, which depends on the model alone.
    fn add_present<T>(&mut self, place: &str, quantities: &'static [Quantity<T>], owner: &T) {
        for quantity in quantities.iter().filter(|quantity| quantity.places.study) {
            if quantity.value(owner).is_some() {
                self.add_one(place, quantity, owner);
            }
        }
    }

    fn add_one<T>(&mut self, place: &str, quantity: &Quantity<T>, owner: &T) {
        let name = format!("{place}{}", quantity.name);
        self.put(name, kind(quantity), quantity.value(owner));
    }

    /// The same of a building or a floor, and what contact changes.
    fn add_response<T>(
        &mut self,
        place: &str,
        quantities: &'static [Quantity<T>],
        (response, without): (&T, Option<&T>),
        yields: bool,
    ) {
        for quantity in quantities {
            let places = quantity.places;
            if !places.study || places.yielding && !yields {
                continue;
            }
            self.add_one(place, quantity, response);
            if self.compares && places.compared {
                let (name, ratio) = (
                    quantity.name_without_contact(),
                    quantity.name_of_amplification(),
                );
                let value = without.and_then(|without| quantity.value(without));
                self.put(format!("{place}{name}"), kind(quantity), value);
                let value = without.and_then(|without| quantity.amplification(response, without));
                self.put(format!("{place}{ratio}"), Kind::Real, value);
            }
        }
    }
}

fn kind<T>(quantity: &Quantity<T>) -> Kind {
    match quantity.read {
        Read::Real(_) | Read::Optional(_) => Kind::Real,
        Read::Whole(_) => Kind::Whole,
    }
}

/// Every number of a run that the table has, in its order. `compares`: also those of the run without contact.
pub(crate) fn measures(summary: &Summary, motion: &GroundMotion, compares: bool) -> Vec<Named> {
    let mut list = List {
        named: Vec::new(),
        compares,
    };
    list.add("", MotionSummary::QUANTITIES, &summary.motion);
    if !summary.gaps.is_empty() {
        list.add("", Summary::POUNDING, summary);
    }
    list.add("", Summary::CHECKS, summary);
    for gap in &summary.gaps {
        let pair = gap.between.join("-");
        list.add(&format!("{pair}."), GapSummary::QUANTITIES, gap);
        if compares {
            list.add(&format!("{pair}."), GapSummary::WITHOUT_CONTACT, gap);
        }
        for (index, contact) in gap.contacts.iter().enumerate() {
            let same = |other: &&ContactSummary| other.floors == contact.floors;
            let place = match contact.floors {
                // Several faces and corners of the same two floors are numbered.
                [Some(left), Some(right)] if gap.contacts.iter().filter(same).count() > 1 => {
                    let before = gap.contacts[..index].iter().filter(same).count();
                    format!("{pair}.floor{left}-{right}.face{}.", before + 1)
                }
                [Some(left), Some(right)] => format!("{pair}.floor{left}-{right}."),
                _ => format!("{pair}.at{:.0}mm.", 1e3 * contact.height_m),
            };
            list.add(&place, ContactSummary::QUANTITIES, contact);
        }
    }
    for (index, link) in summary.links.iter().enumerate() {
        let pair = link.between.join("-");
        let same = |other: &&LinkSummary| other.between == link.between;
        // Several [[link]] between the same two are numbered in the order of the file.
        let place = match summary.links.iter().filter(same).count() {
            1 => format!("{pair}.link."),
            _ => {
                let before = summary.links[..index].iter().filter(same).count();
                format!("{pair}.link{}.", before + 1)
            }
        };
        list.add(&place, LinkSummary::QUANTITIES, link);
    }
    let spectra = spectral_accelerations(summary, motion);
    for (building, sa) in summary.buildings.iter().zip(spectra) {
        building_measures(&mut list, building, sa);
    }
    list.add("energy_", EnergySummary::QUANTITIES, &summary.energy);
    list.add("", WorkSummary::QUANTITIES, &summary.work);
    list.named
}

fn building_measures(list: &mut List, building: &BuildingSummary, sa: Option<f64>) {
    let place = format!("{}.", building.name);
    list.add(&place, BuildingSummary::QUANTITIES, building);
    list.put(format!("{place}sa_t1_m_s2"), Kind::Real, sa);
    let yields = building.hinges.total > 0;
    let response = (&building.response, building.without_contact.as_ref());
    list.add_response(&place, BuildingResponse::QUANTITIES, response, yields);
    if let Some(plan) = &building.in_plan {
        let response = (plan, building.without_contact_in_plan.as_ref());
        list.add_response(&place, BuildingInPlan::QUANTITIES, response, yields);
    }
    if let Some(capacity) = &building.capacity {
        let place = format!("{place}capacity_");
        list.add(&place, CapacitySummary::QUANTITIES, capacity);
    }
    if let Some(failures) = &building.shear_failures {
        let place = format!("{place}shear_failures_");
        list.add(&place, ShearFailureSummary::QUANTITIES, failures);
    }
    if let Some(levels) = &building.rotation_levels {
        let place = format!("{place}rotation_levels_");
        list.add(&place, RotationLevelsSummary::QUANTITIES, levels);
    }
    if let Some(panels) = &building.panels {
        let place = format!("{place}panels_");
        list.add(&place, PanelsSummary::QUANTITIES, panels);
    }
    if let Some(strains) = &building.strains {
        let place = format!("{place}strains_");
        list.add(&place, StrainsSummary::QUANTITIES, strains);
    }
    if let Some(isolation) = &building.isolation {
        let place = format!("{place}isolation_");
        list.add_present(&place, IsolationSummary::QUANTITIES, isolation);
        if let Some(plan) = &isolation.in_plan {
            list.add(&place, IsolationInPlan::QUANTITIES, plan);
        }
    }
    for floor in &building.floors {
        let place = format!("{place}floor{}.", floor.floor);
        let response = (&floor.response, floor.without_contact.as_ref());
        list.add_response(&place, FloorResponse::QUANTITIES, response, yields);
        if let Some(plan) = &floor.in_plan {
            list.add(&place, FloorInPlan::QUANTITIES, plan);
        }
    }
}

/// Pseudo-acceleration of the motion at the first period of every building, with 5 % damping; none for analytic waves.
fn spectral_accelerations(summary: &Summary, motion: &GroundMotion) -> Vec<Option<f64>> {
    let periods: Vec<Option<f64>> = summary
        .buildings
        .iter()
        .map(|building| building.periods_s.first().copied())
        .collect();
    let present: Vec<f64> = periods.iter().flatten().copied().collect();
    let Wave::Sampled { step, acceleration } = &motion.wave else {
        return vec![None; periods.len()];
    };
    let points = (motion.duration / step * (1.0 + 1e-12)).floor() as usize + 1;
    let used = acceleration.iter().take(points);
    let scaled: Vec<f64> = used.map(|a| motion.scale * a).collect();
    let spectrum = Accelerogram::new(*step, scaled).and_then(|motion| {
        response_spectrum(&motion, &present, &[SPECTRUM_DAMPING], Reading::Between)
    });
    let values = spectrum.ok().and_then(|spectrum| {
        let curve = spectrum.curves.into_iter().next()?;
        Some(curve.pseudo_acceleration)
    });
    let mut values = values.unwrap_or_default().into_iter();
    periods
        .iter()
        .map(|period| period.and_then(|_| values.next()))
        .collect()
}
