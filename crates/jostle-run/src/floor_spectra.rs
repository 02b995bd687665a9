//! Response spectra of floors, from the histories of a run.

use jostle::history::{Kind, Owner, Peak, Peaks};
use jostle::results::floor_spectra::{
    FilterSummary, FloorCurve, FloorResponse, FloorSpectra, FloorSpectrum,
};
use jostle::{Column, History, LawKind, Outcome, Settings, Summary};
use jostle_io::FloorSpectraRequest;
use jostle_motion::{Butterworth, MotionFault, UnevenMotion, butterworth, uneven_spectrum};

use crate::prepared::Prepared;

/// Rows of the floor motion in the shortest period of the spectra, and in a period of the corner of the filter. With the
/// velocities known, the peak response to a sine of this period is then off by less than 0.1 %.
const ROWS_PER_PERIOD: f64 = 16.0;
/// The same where velocities jump: a jump is spread over the interval in which it falls, which reduces the response of an
/// oscillator by (ωh)²/8, here 0.2 %.
const ROWS_WITH_JUMPS: f64 = 48.0;
/// Longest and shortest distance of rows \[s\].
const ROWS: [f64; 2] = [0.005, 1e-4];
/// Values per period of the corner of the filter. Means over a fiftieth of a period reduce a sine at the corner by 0.07 %.
const FILTERED_VALUES: f64 = 50.0;
/// Estimated error of the spectra above which the run warns \[–\].
const COARSE: f64 = 0.02;
/// Parts of the greatest value of a curve below which its errors are not looked at \[–\].
const SMALL: f64 = 0.05;

/// Spectra of the floors of one run, in the order of the request.
#[derive(Clone, Debug, PartialEq)]
pub struct RunFloorSpectra {
    floors: Vec<FloorResponse>,
    /// Estimated error \[–\].
    resolution: f64,
    /// Time between rows in free vibration \[s\].
    row_interval: f64,
}

/// Time between rows in free vibration that the spectra need \[s\].
fn row_interval(request: &FloorSpectraRequest, jumps: bool) -> f64 {
    let shortest = request.periods.iter().copied().find(|period| *period > 0.0);
    let shortest = shortest
        .unwrap_or(f64::INFINITY)
        .min(1.0 / request.low_pass);
    let rows = if jumps {
        ROWS_WITH_JUMPS
    } else {
        ROWS_PER_PERIOD
    };
    (shortest / rows).clamp(ROWS[1], ROWS[0])
}

impl Prepared {
    /// Whether a contact law changes velocities suddenly.
    fn jumps(&self) -> bool {
        let gaps = self.input.model.gaps.iter();
        gaps.map(|gap| gap.law.kind)
            .any(|kind| kind == LawKind::Restitution)
    }

    /// Settings whose histories are close enough for spectra of floors, if these are asked for.
    pub(crate) fn with_rows_for_spectra(&self, settings: Settings) -> Settings {
        let Some(request) = &self.input.floor_spectra else {
            return settings;
        };
        let needed = row_interval(request, self.jumps());
        Settings {
            record_interval: Some(
                settings
                    .record_interval
                    .map_or(needed, |record_interval| record_interval.min(needed)),
            ),
            ..settings
        }
    }

    /// Spectra of the floors of a run with the settings of [`Self::with_rows_for_spectra`], or why they cannot be had.
    pub(crate) fn floor_spectra(
        &self,
        outcome: &Outcome,
    ) -> Option<Result<RunFloorSpectra, String>> {
        let request = self.input.floor_spectra.as_ref()?;
        let history = outcome.history.as_ref()?;
        let interval = row_interval(request, self.jumps());
        let computed = compute(request, history, &outcome.peaks, interval);
        Some(computed.map_err(|fault| fault.to_string()))
    }
}

/// Corner of the filter of floor accelerations where spectra do not state one \[Hz\].
const USUAL_CORNER: f64 = 25.0;
/// Its order.
const USUAL_ORDER: usize = 4;

/// Notes the greatest total acceleration of every floor after the filter of floor spectra in the peaks of a run; without histories there is
/// none. Rows 5 ms apart keep it to about 1 %.
pub(crate) fn filter_floors(request: Option<&FloorSpectraRequest>, outcome: &mut Outcome) {
    let Some(history) = &outcome.history else {
        return;
    };
    let low_pass = low_pass(request);
    let order = request.map_or(USUAL_ORDER, |request| request.order);
    let column = |column| history.column(column).unwrap_or_default();
    let (time, ground) = (column(Column::TIME), column(Column::GROUND_ACCELERATION));
    let mut filtered = Vec::new();
    let one = |building: usize, floor: usize| -> Result<f64, MotionFault> {
        let total = column(Column::total_acceleration(building, floor));
        let velocity = column(Column::velocity(building, floor));
        let motion = UnevenMotion::with_velocity(time.clone(), total, &velocity, &ground)?;
        filtered_peak(&motion, low_pass, order)
    };
    for (building, floors) in outcome.peaks.buildings().enumerate() {
        for floor in 1..=floors.len() {
            let owner = Owner::Floor { building, floor };
            let column = Column::along(owner, Kind::FilteredAcceleration);
            filtered.extend(one(building, floor).map(|peak| (column, Peak::of_size(peak))));
        }
    }
    outcome.peaks.extend(filtered);
}

/// Corner of the filter of filtered accelerations \[Hz\].
pub(crate) fn low_pass(request: Option<&FloorSpectraRequest>) -> f64 {
    request.map_or(USUAL_CORNER, |request| request.low_pass)
}

/// Peak of a floor acceleration after the filter \[m/s²\].
fn filtered_peak(motion: &UnevenMotion, low_pass: f64, order: usize) -> Result<f64, MotionFault> {
    let step = 1.0 / (FILTERED_VALUES * low_pass);
    let filter = Butterworth {
        low: None,
        high: Some(low_pass),
        order,
    };
    Ok(butterworth(&motion.averaged(step)?, &filter)?.peak())
}

/// Spectra of a run and, if there is one, of the run without contact, with the names of the summary; and the warning, if
/// their resolution is coarse.
pub(crate) fn combine(
    request: &FloorSpectraRequest,
    summary: &Summary,
    found: &RunFloorSpectra,
    without: Option<&RunFloorSpectra>,
) -> (FloorSpectra, Option<String>) {
    let floors = request.floors.iter().zip(&found.floors).enumerate();
    let floors = floors.map(|(index, (&(building, floor), response))| {
        let building = &summary.buildings[building];
        FloorSpectrum {
            building: building.name.clone(),
            floor,
            height_m: building.floors[floor - 1].height_m,
            response: response.clone(),
            without_contact: without.map(|run| run.floors[index].clone()),
        }
    });
    let apart = without.map_or(0.0, |run| run.resolution);
    let resolution = found.resolution.max(apart);
    let warning = (resolution > COARSE).then(|| {
        format!(
            "the floor spectra may be off by {:.0} %, because the steps of the run are too far apart for their shortest periods; give [analysis] a smaller step, or leave these periods out",
            100.0 * resolution
        )
    });
    let spectra = FloorSpectra {
        periods_s: request.periods.clone(),
        filter: FilterSummary {
            name: "zero-phase Butterworth low-pass",
            order: request.order,
            corner_hz: request.low_pass,
        },
        row_interval_s: found.row_interval,
        resolution,
        floors: floors.collect(),
    };
    (spectra, warning)
}

fn compute(
    request: &FloorSpectraRequest,
    history: &History,
    peaks: &Peaks,
    row_interval: f64,
) -> Result<RunFloorSpectra, MotionFault> {
    let column = |column| history.column(column).unwrap_or_default();
    let (time, ground) = (column(Column::TIME), column(Column::GROUND_ACCELERATION));
    let mut resolution = 0.0_f64;
    let mut floors = Vec::with_capacity(request.floors.len());
    for &(building, floor) in &request.floors {
        let total = column(Column::total_acceleration(building, floor));
        let velocity = column(Column::velocity(building, floor));
        let motion = UnevenMotion::with_velocity(time.clone(), total, &velocity, &ground)?;
        let spectra = spectra(request, &motion)?;
        let coarse = self::spectra(request, &motion.every_second())?;
        resolution = resolution.max(difference(&spectra, &coarse) / 3.0);
        floors.push(FloorResponse {
            peak_acceleration_m_s2: peaks.floor(building, floor).total_acceleration(),
            filtered_peak_acceleration_m_s2: filtered_peak(
                &motion,
                request.low_pass,
                request.order,
            )?,
            spectra,
        });
    }
    Ok(RunFloorSpectra {
        floors,
        resolution,
        row_interval,
    })
}

fn spectra(
    request: &FloorSpectraRequest,
    motion: &UnevenMotion,
) -> Result<Vec<FloorCurve>, MotionFault> {
    let found = uneven_spectrum(motion, &request.periods, &request.dampings)?;
    let curves = found.curves.into_iter().map(|curve| FloorCurve {
        damping: curve.damping,
        displacement_m: curve.displacement,
        pseudo_acceleration_m_s2: curve.pseudo_acceleration,
        total_acceleration_m_s2: curve.total_acceleration,
    });
    Ok(curves.collect())
}

/// Greatest relative difference of pseudo-accelerations that matter.
fn difference(fine: &[FloorCurve], coarse: &[FloorCurve]) -> f64 {
    let mut greatest = 0.0_f64;
    for (fine, coarse) in fine.iter().zip(coarse) {
        let (fine, coarse) = (
            &fine.pseudo_acceleration_m_s2,
            &coarse.pseudo_acceleration_m_s2,
        );
        let least = SMALL * fine.iter().copied().fold(0.0, f64::max);
        for (a, b) in fine.iter().zip(coarse).filter(|(a, _)| **a > least) {
            greatest = greatest.max((a - b).abs() / a);
        }
    }
    greatest
}
