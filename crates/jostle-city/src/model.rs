//! A pair of a city as an ordinary model file.

use jostle::GroundMotion;
use jostle_classes::model;
use jostle_io::{Files, MotionSource, RecordOptions, builtin_record};

use crate::answers::Answers;
use crate::fault::CityError;
use crate::run::{City, Job};

/// Tolerance of the model file.
const TOLERANCE: f64 = 1e-4;

/// A pair of the list of a page as a model file.
#[derive(Clone, Debug, PartialEq)]
pub struct PairModel {
    /// Number of the pair.
    pub pair: usize,
    /// Draw and motion that it was taken from.
    pub sample: [usize; 2],
    /// Text of the model file.
    pub text: String,
}

/// Makes a page that runs models, and gives the address for each of them; none if no page can be made.
pub type Runner<'r> = dyn FnMut(&[PairModel]) -> Result<Vec<String>, CityError> + 'r;

impl City {
    /// Models of pairs, each in its most telling draw under its most telling motion; pairs that never hit have none.
    pub(crate) fn pair_models(
        &self,
        answers: &Answers,
        pairs: &[usize],
    ) -> Result<Vec<PairModel>, CityError> {
        let hit = pairs
            .iter()
            .filter_map(|pair| Some((*pair, answers.pairs[*pair].telling?)));
        let one = |(pair, sample): (usize, [usize; 2])| {
            let text = self.model(pair, sample[0], sample[1])?;
            Ok(PairModel { pair, sample, text })
        };
        hit.map(one).collect()
    }

    /// The text of a model file of a pair as it was drawn, under a motion, each counted from 0, with the other buildings of the row in
    /// which the city ran it.
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
        let line = self.line_of(pair, draw);
        let buildings = line.buildings.clone();
        let job = Job { line, draw, motion };
        let (row, _) = self.row_alone(job)?;
        let told = |(number, at): (usize, &usize)| {
            let structure = &self.structures[*at];
            format!(
                "# B{} is {}: {}, {} code, {} storey{}, {:.0} m²\n",
                number + 1,
                self.inventory.buildings[*at].id,
                structure.class.name,
                structure.class.level.name(),
                structure.storeys,
                if structure.storeys == 1 { "" } else { "s" },
                structure.area
            )
        };
        let pair_buildings = self.neighbours.pairs[pair].buildings;
        let in_row = match buildings.len() {
            2 => String::new(),
            count => {
                let places = pair_buildings.map(|building| {
                    let place = buildings.iter().position(|at| *at == building);
                    place.unwrap_or_default() + 1
                });
                let (first, second) = (places[0].min(places[1]), places[0].max(places[1]));
                format!(
                    " The pair is B{first} and B{second} of a row of {count} buildings, which the city ran together."
                )
            }
        };
        let [left, right] = pair_buildings.map(|at| plain(&self.inventory.buildings[at].id));
        let all: String = buildings.iter().enumerate().map(told).collect();
        let heading = format!(
            "# Pair {pair}, draw {draw}: what the inventory does not say was drawn; it is not the fate of a building.{in_row}\n{all}title = \"Pair {pair}: {left} and {right}\"\n\n",
        );
        let motion = self.motion_table(buildings[0], motion)?;
        Ok(heading + &model(&row, &motion, TOLERANCE))
    }

    /// The table `[motion]` of a motion at a building, without its heading.
    fn motion_table(&self, building: usize, motion: usize) -> Result<String, CityError> {
        let strength = self.shaking().at(building, motion);
        let resolved = self.shaking().motion(strength.motion)?;
        let spec = self.shaking().spec(strength.motion);
        let scale = resolved.scale * strength.factor;
        let mut text = match &spec.source {
            MotionSource::Record {
                name,
                files,
                options,
            } => record(name, files, options),
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
            MotionSource::Given(GroundMotion { name, .. }) => {
                format!("# The motion \"{name}\" was given by a program.\n")
            }
            // Lists were taken apart.
            MotionSource::Records { .. } => String::new(),
        };
        text += &format!("scale = {}\n", scale.abs());
        if scale < 0.0 {
            text += "reverse = true\n";
        }
        text += &format!("duration = \"{} s\"", resolved.duration);
        if resolved.bearing.is_some() {
            text += "\n# In the city this motion has a direction in plan, and the row is shaken by its part along it.";
        }
        Ok(text)
    }
}

/// A name that ends no text of TOML.
fn plain(name: &str) -> String {
    name.chars()
        .filter(|c| !c.is_control() && !matches!(c, '"' | '\\'))
        .collect()
}

/// A record, and how it is read.
fn record(name: &str, files: &Files, options: &RecordOptions) -> String {
    let text = |content: &str| serde_json::Value::String(content.to_owned()).to_string();
    let shown = if builtin_record(name).is_some() {
        name.to_owned()
    } else {
        files.shown(name).display().to_string()
    };
    let mut lines = String::new();
    let mut add = |key: &str, value: Option<String>| {
        if let Some(value) = value {
            lines += &format!("{key} = {value}\n");
        }
    };
    add("record", Some(text(&shown)));
    add("unit", options.unit.as_deref().map(text));
    add("step", options.step.map(|step| step.to_string()));
    add("column", options.column.map(|column| column.to_string()));
    add("component", options.component.as_deref().map(text));
    add("format", options.format.map(|format| text(format.key())));
    add("record_scale", options.scale.map(|scale| scale.to_string()));
    add(
        "remove_mean",
        options
            .remove_mean
            .map(|remove_mean| remove_mean.to_string()),
    );
    if !options.layout.is_empty() {
        lines = "# Add read = { … } from the city file.\n".to_owned() + &lines;
    }
    lines
}
