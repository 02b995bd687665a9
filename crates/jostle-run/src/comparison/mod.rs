//! A model on the recorded motion of a shake table, compared with what was measured there.

mod files;
mod impacts;
mod table_motion;
mod text;

use std::sync::Arc;

use jostle::results::comparison::{HistoryScore, ImpactScore};
use jostle::{Column, History, RunEnd, Settings, Summary};
use jostle_io::{
    ComparedColumn, ComparisonMap, Dimension, MeasuredTable, MotionSource, MotionSpec, NamedColumn,
    Scaling, history_names,
};

use crate::error::RunError;
use crate::history_file::STORAGE;
use crate::observer::Observer;
use crate::opened::Opened;
use crate::prepared::Prepared;

pub use files::earlier_comparison;

/// Least time between rows of the computed histories, in time steps of the data \[–\].
const ROWS: f64 = 0.25;
/// Names in a message that lists what there is.
const MOST_NAMED: usize = 60;

/// Measurements, the map, and the names of their files for messages.
#[derive(Clone, Copy)]
pub struct Measurements<'a> {
    /// The table of measurements.
    pub table: &'a MeasuredTable,
    /// Name of its file.
    pub name: &'a str,
    /// What is compared with what.
    pub map: &'a ComparisonMap,
    /// Name of its file.
    pub map_name: &'a str,
}

/// A model compared with measurements.
pub struct Comparison {
    /// Title of the model.
    pub title: String,
    /// File of the data, the title in it, and the file of the map.
    pub files: [String; 3],
    /// Column of the table motion.
    pub table_column: String,
    /// Numbers of the run.
    pub summary: Summary,
    /// Instant of the data at which the run begins \[s\].
    pub start: f64,
    /// Time step of the data \[s\].
    pub step: f64,
    /// Instants of the run, as measured \[s\].
    pub time: Vec<f64>,
    /// Histories.
    pub columns: Vec<HistoryComparison>,
    /// Impacts.
    pub impacts: Vec<ImpactComparison>,
    /// What the user should know.
    pub notes: Vec<String>,
}

/// A measured history and the computed one at the same instants.
pub struct HistoryComparison {
    /// Column of the data.
    pub measured_name: String,
    /// Column of the results.
    pub computed_name: String,
    /// Symbol of the unit of both.
    pub unit: &'static str,
    /// Measured values.
    pub measured: Vec<f64>,
    /// Computed values.
    pub computed: Vec<f64>,
    /// How they agree.
    pub score: HistoryScore,
}

/// Instants of measured impacts beside computed ones.
pub struct ImpactComparison {
    /// How impacts show, in words.
    pub sign: String,
    /// Contacts they are compared with.
    pub contacts: Vec<String>,
    /// Greatest distance of a pair \[s\].
    pub window: f64,
    /// Signs closer than this are one impact \[s\].
    pub separation: f64,
    /// Measured instants \[s\].
    pub measured: Vec<f64>,
    /// Computed instants \[s\].
    pub computed: Vec<f64>,
    /// Matched pairs of their indices.
    pub pairs: Vec<[usize; 2]>,
    /// How they agree.
    pub score: ImpactScore,
}

/// A comparison whose run has not been made.
pub struct PreparedComparison<'a> {
    data: Measurements<'a>,
    prepared: Prepared,
    /// First row of the data, and the rows that are used.
    rows: std::ops::Range<usize>,
    notes: Vec<String>,
}

/// Reads the table motion from measurements and prepares the model for it; checks every name of the map.
///
/// # Errors
/// [`RunError::Input`] with the line of the map, or of the model.
pub fn prepare_comparison<'a>(
    opened: &Opened,
    data: Measurements<'a>,
) -> Result<PreparedComparison<'a>, RunError> {
    let rows = table_motion::rows(data)?;
    let (motion, mut notes) = table_motion::table_motion(data, rows.clone())?;
    let mut input = (*opened.input).clone();
    let mut bearing = input
        .motion
        .as_ref()
        .and_then(|motion| motion.bearing.clone());
    if let Some(bearing) = &mut bearing
        && bearing.across.take().is_some()
    {
        let problem = "a table that moves in one direction has no motion across; remove motion.across for this comparison";
        return Err(input.fault("motion.across", problem).into());
    }
    input.motion = Some(MotionSpec {
        source: MotionSource::Given(motion),
        scaling: Scaling::AsRecorded,
        reverse: false,
        duration: None,
        bearing,
        grounds: None,
    });
    let prepared = opened.with_input(input).prepare()?;
    prepared.check_digits(None)?;
    if opened.input.motion.is_some() {
        notes.push("the motion of the model file is replaced by that of the table".into());
    }
    let comparison = PreparedComparison {
        data,
        prepared,
        rows,
        notes,
    };
    comparison.check_names()?;
    Ok(comparison)
}

impl PreparedComparison<'_> {
    /// The model with the motion of the table.
    #[must_use]
    pub fn prepared(&self) -> &Prepared {
        &self.prepared
    }

    /// Every name and unit of the map, before the run is made: a run of no length has all results.
    fn check_names(&self) -> Result<(), RunError> {
        let mut motion = self.prepared.motion.clone();
        motion.duration = 0.0;
        let still = Prepared {
            input: Arc::clone(&self.prepared.input),
            system: Arc::clone(&self.prepared.system),
            motion,
            plan: self.prepared.plan,
            shapes: self.prepared.shapes.clone(),
        };
        let outcome = still.step(self.settings(), |_| std::ops::ControlFlow::Continue(()));
        let summary = still.summary(&outcome, None, 0.0);
        let columns = outcome.history.as_ref().map_or(&[][..], History::columns);
        let names = history_names(&self.prepared.input.model, &summary, columns);
        for column in &self.data.map.columns {
            let computed = self.computed(&names, columns, &column.computed)?;
            self.measured(column, computed)?;
        }
        for wanted in &self.data.map.impacts {
            impacts::measured_instants(self.data, &self.rows, wanted, &summary)?;
            impacts::contacts(self.data.map, wanted, &summary)?;
        }
        Ok(())
    }

    fn settings(&self) -> Settings {
        let usual = Settings::default().record_interval.unwrap_or(0.005);
        Settings {
            record_interval: Some(usual.min(ROWS * self.data.table.step)),
            storage: STORAGE,
            ..Settings::default()
        }
    }

    /// The result of a name.
    fn computed(
        &self,
        names: &[String],
        columns: &[Column],
        wanted: &NamedColumn,
    ) -> Result<Column, RunError> {
        let found = names.iter().position(|name| *name == wanted.name);
        if let Some(column) = found.and_then(|at| columns.get(at)) {
            return Ok(*column);
        }
        let near = jostle_io::nearest_name(&wanted.name, names.iter().map(String::as_str));
        let near = near.map_or_else(
            || ".".to_owned(),
            |name| format!("; did you mean \"{name}\"?"),
        );
        let shown: Vec<&str> = names.iter().take(MOST_NAMED).map(String::as_str).collect();
        let more = names.len().saturating_sub(MOST_NAMED);
        let more = if more > 0 {
            format!(", and {more} more")
        } else {
            String::new()
        };
        let problem = format!(
            "the model has no result \"{}\"{near} Results: {}{more}",
            wanted.name,
            shown.join(", ")
        );
        Err(self.data.map.fault(wanted, problem).into())
    }

    /// Measured values in SI, as they are compared, at the rows of the run.
    fn measured(&self, wanted: &ComparedColumn, computed: Column) -> Result<Vec<f64>, RunError> {
        let unit = computed.recorded().unit.symbol;
        let Some(dimension) = dimension_of(unit) else {
            let problem = format!("results in {unit} cannot be compared with measurements");
            return Err(self.data.map.fault(&wanted.computed, problem).into());
        };
        let all = 0..self.data.table.points();
        let mut values = self.data.values(&wanted.measured, dimension, &all)?;
        if let Some(reference) = &wanted.relative_to {
            let subtracted = self.data.values(reference, dimension, &all)?;
            values
                .iter_mut()
                .zip(subtracted)
                .for_each(|(value, s)| *value -= s);
        }
        self.data.zero(&mut values, wanted.zero);
        let mut values = values.get(self.rows.clone()).unwrap_or_default().to_vec();
        if wanted.reverse {
            values.iter_mut().for_each(|value| *value = -*value);
        }
        Ok(values)
    }

    /// Runs the model and compares. `None` if the observer stopped the run.
    ///
    /// # Errors
    /// [`RunError::Analysis`] if the run failed.
    pub fn run(mut self, observer: &mut Observer<'_>) -> Result<Option<Comparison>, RunError> {
        let settings = self.settings();
        let (map, table) = (self.data.map, self.data.table);
        let step = self.prepared.motion.duration / (self.rows.len() - 1) as f64;
        let time: Vec<f64> = (0..self.rows.len()).map(|k| k as f64 * step).collect();
        let outcome = self.prepared.step(settings, |progress| {
            observer(crate::Stage::Pounding, progress)
        });
        match outcome.end_of_all() {
            RunEnd::Completed => {}
            RunEnd::Stopped => return Ok(None),
            RunEnd::Failed(error) => return Err(RunError::Analysis(error.to_string())),
        }
        let summary = self.prepared.summary(&outcome, None, 0.0);
        let Some(history) = &outcome.history else {
            return Err(RunError::Analysis("the run recorded no histories".into()));
        };
        let names = history_names(&self.prepared.input.model, &summary, history.columns());
        let instants = history.column(Column::TIME).unwrap_or_default();
        let mut columns = Vec::new();
        for wanted in &map.columns {
            let column = self.computed(&names, history.columns(), &wanted.computed)?;
            let measured = self.measured(wanted, column)?;
            let values = history.column(column).unwrap_or_default();
            let computed = interpolated(&instants, &values, &time);
            let reference = wanted.relative_to.as_ref();
            columns.push(HistoryComparison {
                measured_name: match reference {
                    Some(reference) => format!("{} − {}", wanted.measured.name, reference.name),
                    None => wanted.measured.name.clone(),
                },
                computed_name: wanted.computed.name.clone(),
                unit: column.recorded().unit.symbol,
                score: HistoryScore::new(&time, &measured, &computed),
                measured,
                computed,
            });
        }
        let mut impacts = Vec::new();
        for wanted in &map.impacts {
            impacts.push(impacts::compared(self.data, &self.rows, wanted, &summary)?);
        }
        self.notes.extend(summary.notes.iter().cloned());
        let table_column = match &map.table {
            jostle_io::TableMotion::Acceleration(column) => column.name.clone(),
            jostle_io::TableMotion::Displacement(column) => {
                format!("{}, differentiated twice", column.name)
            }
        };
        Ok(Some(Comparison {
            title: self.prepared.input.model.title.clone(),
            files: [
                self.data.name.to_owned(),
                table.title.clone(),
                self.data.map_name.to_owned(),
            ],
            table_column,
            start: table.start + self.rows.start as f64 * table.step,
            step,
            time,
            columns,
            impacts,
            notes: self.notes,
            summary,
        }))
    }
}

impl Measurements<'_> {
    /// The values of a column in SI at some rows.
    fn values(
        &self,
        wanted: &NamedColumn,
        dimension: Dimension,
        rows: &std::ops::Range<usize>,
    ) -> Result<Vec<f64>, RunError> {
        let column = self.column(wanted)?;
        let size = match column.size {
            Some((found, size)) if found == dimension => size,
            Some((found, _)) => {
                let problem = format!(
                    "column {} of {} is {} [{}]; {} is needed here",
                    column.name,
                    self.name,
                    found.noun(),
                    column.unit,
                    dimension.noun()
                );
                return Err(self.map.fault(wanted, problem).into());
            }
            None => {
                let problem = format!(
                    "column {} has the unit \"{}\" in line {} of {}, which is not known; {} is needed here, such as {}: correct the row of units",
                    column.name,
                    column.unit,
                    self.table.unit_row,
                    self.name,
                    dimension.noun(),
                    dimension.si_unit()
                );
                return Err(self.map.fault(wanted, problem).into());
            }
        };
        let values = column.values.get(rows.clone()).unwrap_or_default();
        Ok(values.iter().map(|value| value * size).collect())
    }

    /// A column by its name.
    fn column(&self, wanted: &NamedColumn) -> Result<&jostle_io::MeasuredColumn, RunError> {
        let found = self.table.column(&wanted.name);
        found.map_err(|problem| self.map.fault(wanted, problem).into())
    }

    /// Subtracts the mean over the first part of the values of all rows.
    fn zero(&self, values: &mut [f64], time: Option<f64>) {
        let Some(time) = time else { return };
        let count = (time / self.table.step + 1e-6).floor() as usize + 1;
        let first = &values[..count.min(values.len())];
        let mean = first.iter().sum::<f64>() / first.len() as f64;
        values.iter_mut().for_each(|value| *value -= mean);
    }
}

/// The dimension of results by the symbol of their unit.
fn dimension_of(symbol: &str) -> Option<Dimension> {
    match symbol {
        "m" => Some(Dimension::Length),
        "m/s" => Some(Dimension::Speed),
        "m/s²" => Some(Dimension::Acceleration),
        "N" => Some(Dimension::Force),
        "rad" | "–" => Some(Dimension::Dimensionless),
        _ => None,
    }
}

/// Values at other instants, on straight lines between those that there are. Both lists of instants rise; of several equal ones
/// the last counts from then on.
fn interpolated(instants: &[f64], values: &[f64], wanted: &[f64]) -> Vec<f64> {
    let mut at = 0;
    let at_instant = |t: &f64| {
        while at + 1 < instants.len() && instants[at + 1] <= *t {
            at += 1;
        }
        let (Some(t0), Some(v0)) = (instants.get(at), values.get(at)) else {
            return 0.0;
        };
        match (instants.get(at + 1), values.get(at + 1)) {
            (Some(t1), Some(v1)) if t1 > t0 => {
                v0 + (v1 - v0) * ((t - t0) / (t1 - t0)).clamp(0.0, 1.0)
            }
            _ => *v0,
        }
    };
    wanted.iter().map(at_instant).collect()
}

#[cfg(test)]
mod tests {
    use super::interpolated;

    #[test]
    fn values_lie_on_straight_lines() {
        let found = interpolated(
            &[0.0, 1.0, 1.0, 3.0],
            &[0.0, 2.0, 4.0, 8.0],
            &[0.0, 0.5, 1.0, 2.0, 3.0, 4.0],
        );
        assert_eq!(found, [0.0, 1.0, 4.0, 6.0, 8.0, 8.0]);
    }
}
