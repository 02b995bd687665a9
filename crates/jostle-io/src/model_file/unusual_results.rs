//! What is unusual about an assembled model, its motion and its results.

use jostle::results::overdamped_contacts;
use jostle::results::summary::Summary;
use jostle::statics::STANDARD_GRAVITY;
use jostle::{Building, GroundMotion, LawKind, Model, Structure, System, Wave};

use super::Input;
use crate::motion_spec::Scaling;
use crate::quantity::Dimension;
use crate::tree::Value;
use crate::unusual::{FIRST_PERIOD, IMPACT_SPEED, PEAK_ACCELERATION, Verdict, Written};

impl Input {
    /// Adds to the warnings what is unusual about the assembled model: periods, and contacts softer than a storey.
    pub fn note_system(&mut self, system: &System) {
        let found = of_system(&self.model, system);
        for (path, text) in found {
            self.warn(&path, &text);
        }
    }

    /// The warning of a ground motion whose peak is unusual as scaled.
    #[must_use]
    pub fn unusual_motion(&self, motion: &GroundMotion) -> Option<String> {
        self.unusual_peak(motion.peak())
            .or_else(|| self.weak_record(motion))
    }

    /// The warning of a peak without unit that is a small part of the record's, as if it were one in g.
    fn weak_record(&self, motion: &GroundMotion) -> Option<String> {
        const PATH: &str = "motion.pga";
        let &Scaling::Pga(pga) = &self.motion.as_ref()?.scaling else {
            return None;
        };
        let written = match self.origin.at(PATH)? {
            Value::Number(number) => *number,
            Value::Text(text) => text.trim().parse().ok()?,
            _ => return None,
        };
        let meant =
            written == pga && pga < 1.0 && motion.scale.abs() <= WEAK && !self.accepts(PATH);
        let is_record = matches!(motion.wave, Wave::Sampled { .. });
        (meant && is_record).then(|| {
            format!(
                "{PATH}: {pga} m/s² is {} of the peak of the record; is it {pga} g?",
                three_digits(motion.scale.abs())
            )
        })
    }

    /// That a motion across takes the factor of the motion, where their peaks are far apart: right for two components of one record alone.
    #[must_use]
    pub fn scaled_across(&self, motion: &GroundMotion) -> Option<String> {
        /// Ratio of the peaks of both components of a record that is still usual \[–\].
        const USUAL: f64 = 2.0;
        let spec = self.motion.as_ref()?.bearing.as_ref()?.across.as_ref()?;
        let across = motion.across()?;
        let takes_the_factor = motion.scale != 1.0
            && spec.scaling == Scaling::AsRecorded
            && !spec.source.states_its_size();
        let [along, peak] = [motion.peak(), across.peak()];
        let is_usual = peak <= USUAL * along && along <= USUAL * peak;
        (takes_the_factor && !is_usual).then(|| {
            format!(
                "{} across takes the factor of {}, {}, as if both were components of one record: its peak is {} g beside {} g; give its own, across = {{ record = …, pga = … }}",
                across.name,
                motion.name,
                three_digits(motion.scale.abs()),
                three_digits(peak / STANDARD_GRAVITY),
                three_digits(along / STANDARD_GRAVITY)
            )
        })
    }

    fn unusual_peak(&self, peak: f64) -> Option<String> {
        const PATH: &str = "motion";
        // A field with its own unit is checked where it is read.
        let judged = self.warnings.iter().any(|known| known.starts_with(PATH));
        if judged || self.accepts(PATH) || self.accepts("motion.pga") {
            return None;
        }
        match PEAK_ACCELERATION.judge(peak, Dimension::Acceleration, Written::bare(peak)) {
            Verdict::Usual => None,
            Verdict::Unusual(text) | Verdict::Refused(text, _) => Some(format!("{PATH}: {text}")),
        }
    }

    /// Adds to the notes of a summary what the model was warned of.
    pub fn add_notes(&self, summary: &mut Summary) {
        let motion = self.unusual_peak(summary.motion.pga_m_s2);
        let notes = self.warnings.iter().cloned().chain(motion);
        let notes = notes.chain(self.unrated());
        for note in notes {
            if !summary.notes.contains(&note) {
                summary.notes.push(note);
            }
        }
    }
}

/// Part of the peak of a record below which a peak without unit is asked about \[–\].
const WEAK: f64 = 0.2;

/// Unusual properties of an assembled model, by field.
fn of_system(model: &Model, system: &System) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let [shortest, longest] = FIRST_PERIOD;
    let first_period = |building: usize| {
        let modes = system.buildings.get(building)?.modes.first()?;
        Some(modes.period())
    };
    for (index, building) in system.structures().iter().enumerate() {
        let Some(period) = first_period(index) else {
            continue;
        };
        if !(shortest..=longest).contains(&period) {
            found.push((
                format!("building[{index}]"),
                format!(
                    "the first period of \"{}\" is {} s, outside {shortest} s to {longest} s; check the units of its stiffness and mass",
                    building.name,
                    three_digits(period)
                ),
            ));
        }
    }
    for (index, building) in model.buildings.iter().enumerate() {
        let Some(system_building) = system
            .buildings
            .get(index)
            .filter(|_| has_damping_matrix(building))
        else {
            continue;
        };
        let Some(ratio) = system_building
            .modes
            .first()
            .map(|mode| system_building.damping_ratio(mode))
        else {
            continue;
        };
        let [least, most] = DAMPING_RATIO;
        if !(least..=most).contains(&ratio) {
            found.push((
                format!("building[{index}].matrices.damping"),
                format!(
                    "the first mode of \"{}\" is damped by {} %, outside {} % to {} %; check the units of its damping matrix",
                    building.name,
                    three_digits(100.0 * ratio),
                    100.0 * least,
                    100.0 * most
                ),
            ));
        }
    }
    for (index, gap) in model.gaps.iter().enumerate() {
        let storey = gap.between.iter().flatten().filter_map(|&building| {
            let floors = model.buildings.get(building)?.floors();
            Some(storey_period(first_period(building)?, floors))
        });
        let storey = storey.fold(0.0, f64::max);
        let durations = system
            .contacts
            .iter()
            .filter(|contact| contact.gap == index);
        let duration = durations
            .map(|contact| {
                contact
                    .law
                    .elastic_duration(contact.effective_mass(), IMPACT_SPEED)
            })
            .fold(0.0, f64::max);
        let bumper = matches!(gap.law.kind, LawKind::Rubber(_));
        // Half a swing of a storey, twice as long because the storey is only an estimate.
        if storey > 0.0 && duration > storey && !bumper {
            found.push((
                format!("gap[{index}].stiffness"),
                format!(
                    "the contact is softer than a storey: an elastic impact at {IMPACT_SPEED} m/s lasts {} s, a storey swings back in {} s; check the unit of the contact stiffness",
                    three_digits(duration),
                    three_digits(0.5 * storey)
                ),
            ));
        }
    }
    let overdamped = overdamped_contacts(model, system);
    found.extend(
        overdamped
            .into_iter()
            .map(|(gap, text)| (format!("gap[{gap}].damping"), text)),
    );
    found
}

/// Usual damping of the first mode of a building with a damping matrix, that of bearings and dampers included \[–\].
const DAMPING_RATIO: [f64; 2] = [1e-4, 0.7];

/// Whether a damping matrix is given that is not zero.
fn has_damping_matrix(building: &Building) -> bool {
    match &building.structure {
        Structure::Given(given) => given.damping.iter().any(|entry| entry.2 != 0.0),
        Structure::Tiers(tiers) => {
            let matrices = tiers.matrices.as_ref();
            matrices
                .is_some_and(|matrix| matrix.damping.iter().flatten().any(|value| *value != 0.0))
        }
        _ => false,
    }
}

/// Period of a single floor on a single storey of a uniform shear building with this first period \[s\].
fn storey_period(first: f64, floors: usize) -> f64 {
    let angle = 0.5 * std::f64::consts::PI / (2.0 * floors as f64 + 1.0);
    2.0 * libm::sin(angle) * first
}

/// A number with three significant digits, for messages.
fn three_digits(value: f64) -> String {
    if (1e-3..1e4).contains(&value) {
        let digits = (2.0 - libm::log10(value).floor()).clamp(0.0, 5.0) as usize;
        format!("{value:.digits$}")
    } else {
        format!("{value:.2e}")
    }
}
