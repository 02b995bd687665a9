//! Whether the records of a study are suitable for time-history analysis, by the code of their spectrum.

use jostle::{GroundMotion, System, Wave};
use jostle_io::shown::GROUND_ACCELERATION;
use jostle_io::{
    FactorValues, MatchTo, MotionSource, MotionSpec, Scaling, SelectionScaling, SelectionWanted,
    Values, selection_json, write_atomically,
};
use jostle_motion::{
    Accelerogram, Candidate, MainPeriod, MotionFault, Origin, SelectionCode, check_selection,
    recipe,
};
use jostle_report::message;
use jostle_report::{CheckedStructure, Section, selection_sections};
use serde_json::json;

use super::Results;
use crate::study::{Study, StudyError};

/// Share of the mass that the main modes of a building move together (clause 5.2.2) \[–\].
const MASS_OF_MAIN_MODES: f64 = 0.9;

/// A record of the study.
struct Named {
    /// As the study or its model names it.
    label: String,
    spec: MotionSpec,
}

impl Study {
    /// The code check of the records: that of the file, or else the spectrum to which the model matches several
    /// records.
    fn selection(&self) -> Option<SelectionWanted> {
        if let Some(wanted) = &self.file.selection {
            return Some(wanted.clone());
        }
        let spec = self.file.base.input().ok()?.motion?;
        let Scaling::Match(matched) = spec.scaling else {
            return None;
        };
        let MatchTo::Spectrum(target) = matched.to else {
            return None;
        };
        let several = self.records().len() > 1;
        several.then_some(SelectionWanted {
            target,
            damping: matched.damping,
            artificial: Vec::new(),
            periods: Vec::new(),
            scaling: SelectionScaling::Code,
        })
    }

    /// The records that the cases take, each once; empty if they take none.
    fn records(&self) -> Vec<Named> {
        let usual = self.usual_choices();
        let factors = self.file.factors.iter().enumerate();
        let varied = factors
            .filter_map(|(index, factor)| match &factor.values {
                FactorValues::Listed(levels) if factor.paths == ["motion.record"] => {
                    Some((index, levels.len()))
                }
                _ => None,
            })
            .next();
        let choices = match varied {
            Some((index, count)) => (0..count)
                .map(|entry| {
                    let mut choices = usual.clone();
                    choices[index] = crate::design::Choice::Listed(entry);
                    choices
                })
                .collect(),
            None => vec![usual],
        };
        let named = choices.iter().filter_map(|choices| {
            let spec = self.tree(choices).ok()?.input().ok()?.motion?;
            let MotionSource::Record { name, .. } = &spec.source else {
                return None;
            };
            let label = name.clone();
            Some(Named { label, spec })
        });
        let mut records: Vec<Named> = Vec::new();
        for (position, mut one) in named.enumerate() {
            if let Some((index, _)) = varied
                && let FactorValues::Listed(levels) = &self.file.factors[index].values
            {
                // Files beside the study are in the tree with their whole path.
                one.label.clone_from(&levels[position].label);
            }
            if !records.iter().any(|known| known.label == one.label) {
                records.push(one);
            }
        }
        records
    }

    /// Names under `artificial` that are not records of the study.
    pub(crate) fn check_selection(&self) -> Result<(), StudyError> {
        let Some(wanted) = &self.file.selection else {
            return Ok(());
        };
        let records = self.records();
        if records.is_empty() {
            return Err(StudyError::Column(format!(
                "{}: selection: the cases take no records that could be checked",
                self.file.name()
            )));
        }
        let known: Vec<&str> = records.iter().map(|record| &record.label[..]).collect();
        match wanted
            .artificial
            .iter()
            .find(|name| !known.contains(&&name[..]))
        {
            None => Ok(()),
            Some(name) => Err(StudyError::Column(format!(
                "{}: selection.artificial: the study has no record \"{name}\"; it has {}",
                self.file.name(),
                known.join(", ")
            ))),
        }
    }
}

impl Results<'_> {
    /// The sections about the selection of records, if a code is known, and their tables.
    pub(super) fn selection(&mut self) -> Result<Vec<Section>, StudyError> {
        let Some(wanted) = self.study.selection() else {
            return Ok(Vec::new());
        };
        match self.checked(&wanted) {
            Ok((set, structures, sections)) => {
                self.write_selection(&wanted, &set, &structures)?;
                let failed: Vec<&str> = structures
                    .iter()
                    .filter(|structure| !structure.check.passes())
                    .map(|structure| &structure.name[..])
                    .collect();
                let clause = SelectionCode::from_target(&wanted.target).clause();
                self.said.push(match &failed[..] {
                    [] => message::records_meet_clause(clause),
                    [""] => message::records_miss_clause(clause),
                    names => message::records_miss_clause_for(clause, names.join(", ")),
                });
                Ok(sections)
            }
            Err(reason) => Ok(vec![Section {
                title: message::selection_of_motions().into(),
                remark: message::records_cannot_be_checked(reason),
                ..Section::default()
            }]),
        }
    }

    fn checked(&self, wanted: &SelectionWanted) -> Result<Checked, String> {
        let fault = |fault: MotionFault| fault.to_string();
        let records = self.study.records();
        let (peak, said) = scaling(wanted, &records);
        let mut set = Vec::new();
        for record in &records {
            let made = wanted.artificial.contains(&record.label) || recipe(&record.label).is_some();
            set.push(Candidate {
                name: record.label.clone(),
                motion: motion(&record.spec, peak)?,
                origin: if made {
                    Origin::Artificial
                } else {
                    Origin::Natural
                },
            });
        }
        let mut structures = Vec::new();
        for (name, periods) in structures_of(self.study, wanted)? {
            let check = check_selection(&set, &wanted.target, &periods, wanted.damping);
            structures.push(CheckedStructure {
                name,
                periods,
                check: check.map_err(fault)?,
            });
        }
        let sections = selection_sections(&wanted.target, wanted.damping, &set, &structures, &said);
        Ok((set, structures, sections.map_err(fault)?))
    }

    /// `selection.json` as the command prints it for every structure, and the same in rows.
    fn write_selection(
        &mut self,
        wanted: &SelectionWanted,
        set: &[Candidate],
        structures: &[CheckedStructure],
    ) -> Result<(), StudyError> {
        let each: Vec<_> = structures
            .iter()
            .map(|structure| {
                let mut value = selection_json(set, &structure.check, &structure.periods);
                value["structure"] = json!(structure.name);
                value
            })
            .collect();
        let value = json!({
            "target": wanted.target.name(),
            "damping": wanted.damping,
            "passes": structures.iter().all(|structure| structure.check.passes()),
            "structures": each,
        });
        let path = self.folder.join("selection.json");
        write_atomically(&path, format!("{value:#}\n").as_bytes())?;
        let what = message::choice_of_records_file();
        self.files.push(("selection.json".into(), what.into()));

        let mut texts: [Vec<String>; 3] = Default::default();
        let mut numbers: [Vec<f64>; 7] = Default::default();
        for structure in structures {
            let check = &structure.check;
            for (i, candidate) in set.iter().enumerate() {
                for (k, main) in structure.periods.iter().enumerate() {
                    let origin = match candidate.origin {
                        Origin::Natural => "recorded",
                        Origin::Artificial => "artificial",
                    };
                    let words = [&structure.name[..], &candidate.name, origin];
                    for (column, word) in texts.iter_mut().zip(words) {
                        column.push(word.to_owned());
                    }
                    let values = [
                        candidate.motion.peak(),
                        main.period,
                        main.mass_ratio,
                        check.mean[k][0],
                        check.ratios[i][k],
                        check.base_shear[i],
                        check.effective_duration[i],
                    ];
                    for (column, value) in numbers.iter_mut().zip(values) {
                        column.push(value);
                    }
                }
            }
        }
        let text_names = ["structure", "motion", "origin"].into_iter();
        let number_names = [
            "pga_m_s2",
            "period_s",
            "mass_ratio",
            "code_m_s2",
            "ratio",
            "base_shear_ratio",
            "effective_duration_s",
        ];
        let texts = text_names.zip(texts.map(Values::Text));
        let numbers = number_names.into_iter().zip(numbers.map(Values::Real));
        let columns = texts.chain(numbers);
        let columns = columns.map(|(name, values)| (name.to_owned(), values));
        self.write(
            "selection",
            message::response_over_code_file(),
            columns.collect(),
        )
    }
}

/// The set, the structures it was checked for, and what the page shows.
type Checked = (Vec<Candidate>, Vec<CheckedStructure>, Vec<Section>);

/// Scaling of a record before the code check.
#[derive(Clone, Copy)]
enum Peak {
    To(f64),
    AsRecorded,
    AsModel,
}

/// The scaling, and the same in words.
fn scaling(wanted: &SelectionWanted, records: &[Named]) -> (Peak, String) {
    let matched = records
        .iter()
        .any(|record| matches!(record.spec.scaling, Scaling::Match(_)));
    let to = |peak: f64, whose: &str| {
        (
            Peak::To(peak),
            message::motions_scaled_to(GROUND_ACCELERATION.number(peak, 1), whose),
        )
    };
    match wanted.scaling {
        SelectionScaling::Peak(peak) => to(peak, message::as_the_study_asks()),
        SelectionScaling::Code if matched => {
            (Peak::AsModel, message::motions_scaled_as_matched().into())
        }
        SelectionScaling::Code => match wanted.target.peak_ground_acceleration() {
            Some(peak) => to(peak, message::peak_of_the_code()),
            None => (Peak::AsRecorded, message::motions_as_recorded().into()),
        },
        SelectionScaling::AsRecorded => (Peak::AsRecorded, message::motions_as_recorded().into()),
    }
}

/// A record as it will be used, cut to the length of the analysis.
fn motion(spec: &MotionSpec, peak: Peak) -> Result<Accelerogram, String> {
    let spec = MotionSpec {
        scaling: match peak {
            Peak::To(peak) => Scaling::Pga(peak),
            Peak::AsRecorded => Scaling::AsRecorded,
            Peak::AsModel => spec.scaling.clone(),
        },
        ..spec.clone()
    };
    let GroundMotion {
        name,
        scale,
        duration,
        wave,
        bearing: _,
        grounds: _,
    } = spec.resolve().map_err(|error| error.to_string())?;
    let Wave::Sampled {
        step,
        mut acceleration,
    } = wave
    else {
        return Err(format!("{name} is no record"));
    };
    let kept = (duration / step + 1e-9) as usize + 1;
    acceleration.truncate(kept.max(2));
    acceleration.iter_mut().for_each(|a| *a *= scale);
    Accelerogram::new(step, acceleration).map_err(|fault| format!("{name}: {fault}"))
}

/// Main periods as they are given, or those of every building of the base model: the lateral modes that together move
/// 90 % of the mass.
fn structures_of(
    study: &Study,
    wanted: &SelectionWanted,
) -> Result<Vec<(String, Vec<MainPeriod>)>, String> {
    if !wanted.periods.is_empty() {
        return Ok(vec![(String::new(), wanted.periods.clone())]);
    }
    let usual = || study.tree(&study.usual_choices()).ok()?.input().ok();
    // Keys missing in the model are set only by the values of the study.
    let input = study.file.base.input().ok().or_else(usual);
    let input = input.ok_or_else(message::base_model_cannot_be_read)?;
    let system = System::assemble(&input.model).map_err(|f| input.faults(f).to_string())?;
    let of = |building: &jostle::system::BuildingSystem| {
        let mut moved = 0.0;
        let main = building.lateral_modes().take_while(|mode| {
            let more = moved < MASS_OF_MAIN_MODES;
            moved += mode.effective_mass_ratio_x;
            more
        });
        let periods = main.map(|mode| MainPeriod {
            period: mode.period(),
            mass_ratio: mode.effective_mass_ratio_x,
        });
        (building.name.clone(), periods.collect())
    };
    Ok(system.structures().iter().map(of).collect())
}
