//! Engineering demand parameters of a run, by name: the results of a row of a study.

use jostle::results::summary::{BuildingSummary, GapSummary};
use jostle::{GroundMotion, Summary, System, Wave};
use jostle_motion::{Accelerogram, Reading, response_spectrum};

use crate::layout::{Kind, Named};

/// Damping ratio of the spectral accelerations.
const SPECTRUM_DAMPING: f64 = 0.05;

/// Collects named numbers.
struct List(Vec<Named>);

impl List {
    fn real(&mut self, name: String, value: impl Into<Option<f64>>) {
        let value = value.into().filter(|value| value.is_finite());
        self.0.push(Named {
            name,
            kind: Kind::Real,
            value,
        });
    }

    fn whole(&mut self, name: String, value: u64) {
        self.0.push(Named {
            name,
            kind: Kind::Whole,
            value: Some(value as f64),
        });
    }
}

/// Every number of a run that the table has, in its order.
pub(crate) fn measures(summary: &Summary, system: &System, motion: &GroundMotion) -> Vec<Named> {
    let mut list = List(Vec::new());
    list.real("pga_m_s2".into(), summary.motion.pga_m_s2);
    let gaps = &summary.gaps;
    if !gaps.is_empty() {
        let sum = |of: fn(&GapSummary) -> f64| gaps.iter().map(of).fold(0.0, |a, b| a + b);
        let most = |of: fn(&GapSummary) -> f64| gaps.iter().map(of).fold(0.0, f64::max);
        list.whole(
            "impact_count".into(),
            gaps.iter().map(|gap| gap.impact_count as u64).sum(),
        );
        list.real("peak_force_n".into(), most(|gap| gap.peak_force_n));
        let first = gaps.iter().filter_map(|gap| gap.first_impact_s);
        list.real("first_impact_s".into(), first.min_by(f64::total_cmp));
        list.real("impulse_n_s".into(), sum(impulse));
        list.real("closing_peak_m".into(), most(closing));
    }
    for gap in gaps {
        gap_measures(&mut list, gap);
    }
    let spectra = spectral_accelerations(summary, motion);
    for ((building, sa), assembled) in summary.buildings.iter().zip(spectra).zip(&system.buildings)
    {
        let elastic = assembled.equations.springs.is_empty();
        building_measures(&mut list, building, sa, elastic);
    }
    let energy = &summary.energy;
    for (name, value) in [
        ("energy_input_j", energy.input_j),
        ("energy_damped_j", energy.damped_j),
        ("energy_hysteretic_j", energy.hysteretic_j),
        ("energy_contact_j", energy.contact_j),
        ("energy_imbalance", energy.imbalance),
        ("energy_worst_imbalance", energy.worst_imbalance),
    ] {
        list.real(name.into(), value);
    }
    let work = &summary.work;
    for (name, value) in [
        ("steps", work.steps),
        ("contact_steps", work.contact_steps),
        ("factorizations", work.factorizations),
        ("solves", work.solves),
        ("iterations", work.iterations),
    ] {
        list.whole(name.into(), value);
    }
    list.0
}

fn impulse(gap: &GapSummary) -> f64 {
    let contacts = gap.contacts.iter().map(|contact| contact.impulse_n_s);
    contacts.fold(0.0, |a, b| a + b)
}

fn closing(gap: &GapSummary) -> f64 {
    let contacts = gap.contacts.iter().map(|contact| contact.closing_peak_m);
    contacts.fold(0.0, f64::max)
}

fn gap_measures(list: &mut List, gap: &GapSummary) {
    let pair = gap.between.join("-");
    list.real(format!("{pair}.width_m"), gap.width_m);
    list.whole(format!("{pair}.impact_count"), gap.impact_count as u64);
    list.whole(format!("{pair}.pounding_count"), gap.pounding_count as u64);
    list.whole(format!("{pair}.most_at_once"), gap.most_at_once as u64);
    list.real(format!("{pair}.peak_force_n"), gap.peak_force_n);
    list.real(format!("{pair}.first_impact_s"), gap.first_impact_s);
    list.real(format!("{pair}.impulse_n_s"), impulse(gap));
    list.real(format!("{pair}.closing_peak_m"), closing(gap));
    for contact in &gap.contacts {
        let place = match contact.floors {
            [Some(left), Some(right)] => format!("{pair}.floor{left}-{right}"),
            _ => format!("{pair}.at{:.0}mm", 1e3 * contact.height_m),
        };
        list.whole(format!("{place}.impact_count"), contact.impact_count as u64);
        list.real(format!("{place}.peak_force_n"), contact.peak_force_n);
        list.real(format!("{place}.impulse_n_s"), contact.impulse_n_s);
        list.real(format!("{place}.closing_peak_m"), contact.closing_peak_m);
    }
}

fn building_measures(list: &mut List, building: &BuildingSummary, sa: Option<f64>, elastic: bool) {
    let name = &building.name;
    let floors = &building.floors;
    list.real(
        format!("{name}.period_s"),
        building.periods_s.first().copied(),
    );
    list.real(format!("{name}.sa_t1_m_s2"), sa);
    let greatest = |of: fn(&jostle::results::summary::FloorSummary) -> f64| {
        floors.iter().map(of).fold(0.0, f64::max)
    };
    list.real(
        format!("{name}.drift_peak"),
        greatest(|f| f.storey_drift_peak),
    );
    list.real(
        format!("{name}.total_acceleration_peak_m_s2"),
        greatest(|f| f.total_acceleration_peak_m_s2),
    );
    list.real(
        format!("{name}.residual_drift_peak"),
        greatest(|f| f.residual_drift.abs()),
    );
    list.real(
        format!("{name}.base_shear_peak_n"),
        building.base_shear_peak_n,
    );
    list.real(
        format!("{name}.residual_roof_displacement_m"),
        building.residual_roof_displacement_m,
    );
    if !elastic {
        let hinges = &building.hinges;
        list.whole(format!("{name}.hinges_cracked"), hinges.cracked as u64);
        list.whole(format!("{name}.hinges_yielded"), hinges.yielded as u64);
        list.real(format!("{name}.ductility"), hinges.ductility);
    }
    for floor in floors {
        let place = format!("{name}.floor{}", floor.floor);
        list.real(
            format!("{place}.displacement_max_m"),
            floor.displacement_max_m,
        );
        list.real(
            format!("{place}.displacement_min_m"),
            floor.displacement_min_m,
        );
        list.real(
            format!("{place}.total_acceleration_peak_m_s2"),
            floor.total_acceleration_peak_m_s2,
        );
        list.real(
            format!("{place}.storey_drift_peak"),
            floor.storey_drift_peak,
        );
        list.real(format!("{place}.residual_drift"), floor.residual_drift);
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
