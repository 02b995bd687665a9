//! A pair of a city as an ordinary model file.

use jostle_classes::model;
use jostle_io::{MotionSource, RecordOptions};

use crate::fault::CityError;
use crate::run::City;

/// Tolerance of the model file.
const TOLERANCE: f64 = 1e-4;

impl City {
    /// The text of a model file of a pair as it was drawn, under a motion, each counted from 0. The pair stands alone in
    /// it, also where the run had it in a longer row.
    ///
    /// # Errors
    ///
    /// When there is no such pair, draw or motion, or the two share a wall in this draw.
    pub fn model(&self, pair: usize, draw: usize, motion: usize) -> Result<String, CityError> {
        let motions = self.motions();
        for (name, value, of) in [
            ("pair", pair, self.neighbours.pairs.len()),
            ("draw", draw, self.file.draws),
            ("motion", motion, motions.len()),
        ] {
            if value >= of {
                return Err(CityError::Input(format!(
                    "--{name} {value}: there are {of}, counted from 0"
                )));
            }
        }
        if self.width(pair, draw).is_none() {
            return Err(CityError::Input(format!(
                "pair {pair} shares a wall in draw {draw} and cannot hit; choose another draw"
            )));
        }
        let (row, _) = self.pair_row(pair, draw, motion);
        let [left, right] = self.neighbours.pairs[pair].buildings;
        let told = |at: usize| {
            let structure = &self.structures[at];
            format!(
                "{}: {}, {} code, {} storey{}, {:.0} m²",
                self.inventory.buildings[at].id,
                structure.class.name,
                structure.class.level.name(),
                structure.storeys,
                if structure.storeys == 1 { "" } else { "s" },
                structure.area
            )
        };
        let heading = format!(
            "# Pair {pair}, draw {draw}: what the inventory does not say was drawn. No building's fate.\n# B1 is {}\n# B2 is {}\n",
            told(left),
            told(right)
        );
        Ok(heading + &model(&row, &self.motion_table(motion), TOLERANCE))
    }

    /// The table `[motion]` of a motion, without its heading.
    fn motion_table(&self, motion: usize) -> String {
        let resolved = &self.resolved()[motion];
        let spec = &self.file.motion;
        let mut text = match &spec.source {
            MotionSource::Record {
                name,
                files,
                options,
            } => record(name, files, options),
            MotionSource::Records {
                names,
                files,
                options,
            } => record(&names[motion], files, options),
            MotionSource::Sine { amplitude, period } => {
                format!(
                    "kind = \"sine\"\namplitude = \"{amplitude} m/s2\"\nperiod = \"{period} s\"\n"
                )
            }
            MotionSource::Ricker {
                amplitude,
                period,
                centre,
            } => format!(
                "kind = \"ricker\"\namplitude = \"{amplitude} m/s2\"\nperiod = \"{period} s\"\ncentre = \"{centre} s\"\n"
            ),
            MotionSource::Given(own) => {
                format!("# The motion \"{}\" was given by a program.\n", own.name)
            }
        };
        text += &format!("scale = {}\n", resolved.scale.abs());
        if resolved.scale < 0.0 {
            text += "reverse = true\n";
        }
        text += &format!("duration = \"{} s\"", resolved.duration);
        if resolved.bearing.is_some() {
            text += "\n# In the city this motion has a direction in plan, and the pair is shaken by its part along the row.";
        }
        text
    }
}

fn record(name: &str, files: &jostle_io::Files, options: &RecordOptions) -> String {
    let built_in = jostle_io::builtin_record(name).is_some();
    let shown = if built_in {
        name.to_owned()
    } else {
        files.shown(name).display().to_string()
    };
    let remark = if *options == RecordOptions::default() {
        ""
    } else {
        "# Add how the record is read (unit, step, column, …) from the city file.\n"
    };
    format!("{remark}record = {}\n", serde_json::Value::String(shown))
}
