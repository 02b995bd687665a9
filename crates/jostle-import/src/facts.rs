//! What the files of a building say, whatever their format, in SI.

use std::collections::{BTreeMap, BTreeSet};

use jostle_io::{Fault, InputError};

use crate::member::TextModel;

/// A point in plan \[m\].
pub(crate) type Point = [f64; 2];

/// A storey, and the height of its floor above the datum of the model \[m\].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Story {
    pub(crate) name: String,
    pub(crate) top: f64,
}

/// Mass of a rigid diaphragm.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FloorMass {
    /// Its storey; of an `.OUT` file its height instead.
    pub(crate) story: Result<String, f64>,
    pub(crate) diaphragm: String,
    /// Along X and Y \[kg\].
    pub(crate) mass: [f64; 2],
    /// \[kg·m²\]
    pub(crate) inertia: Option<f64>,
    pub(crate) centre: Option<Point>,
}

/// A mode of the source.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ModePeriod {
    pub(crate) case: String,
    pub(crate) mode: usize,
    /// \[s\]
    pub(crate) period: f64,
    /// Modal mass ratios along X and Y.
    pub(crate) shares: Option<[f64; 2]>,
}

/// Displacement of the centre of mass of a floor.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Displacement {
    pub(crate) story: String,
    pub(crate) diaphragm: String,
    pub(crate) case: String,
    /// Mode, or step of a case.
    pub(crate) step: Option<usize>,
    /// UX, UY \[m\] and RZ \[rad\].
    pub(crate) by: [f64; 3],
}

/// A case with one load: a force along X or Y \[N\], or a moment \[N·m\], on one diaphragm.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct UnitLoad {
    pub(crate) case: String,
    pub(crate) story: String,
    /// 0 F_x, 1 F_y, 2 M_z.
    pub(crate) component: usize,
    pub(crate) size: f64,
}

/// Stiffness of a storey under a load case \[N/m\].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StoryStiffness {
    pub(crate) story: String,
    pub(crate) case: String,
    pub(crate) stiffness: [f64; 2],
}

/// All that is known of a building.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facts {
    /// Name of the building.
    pub(crate) name: String,
    /// Names of its files.
    pub(crate) files: Vec<String>,
    /// What was read, one line each.
    pub(crate) read: Vec<String>,
    /// What is not carried over, one line each.
    pub(crate) left_out: Vec<String>,
    /// From the ground up.
    pub(crate) stories: Vec<Story>,
    /// Name and height of the base \[m\].
    pub(crate) base: Option<(String, f64)>,
    pub(crate) masses: Vec<FloorMass>,
    /// Masses of `.OUT` files, which have more digits.
    pub(crate) solver_masses: Vec<FloorMass>,
    pub(crate) periods: Vec<ModePeriod>,
    pub(crate) periods_from: String,
    /// Periods of a `.LOG` file by mode, which have more digits \[s\].
    pub(crate) solver_periods: BTreeMap<usize, f64>,
    pub(crate) displacements: Vec<Displacement>,
    pub(crate) unit_loads: Vec<UnitLoad>,
    pub(crate) stiffness: Vec<StoryStiffness>,
    /// Joints of every storey.
    pub(crate) points: BTreeMap<String, Vec<Point>>,
    /// Name and highest joint of every storey \[m\].
    pub(crate) joint_heights: BTreeMap<String, (String, f64)>,
    pub(crate) text: Option<TextModel>,
    /// Whether the model is one of SAP2000, which has other tables.
    pub(crate) sap2000: bool,
    /// Why the text model has no masses of its own.
    pub(crate) without_masses: Option<&'static str>,
    /// Units of the text model or the listing.
    pub(crate) units: Option<crate::units::Units>,
    /// Tables found, for messages.
    pub(crate) tables: Vec<String>,
}

/// Names are compared without case and outer blanks.
pub(crate) fn key(name: &str) -> String {
    name.trim().to_lowercase()
}

/// A fault of a file, with the object that has it and what helps.
pub(crate) fn fault(
    file: &str,
    object: impl Into<String>,
    problem: impl Into<String>,
    remedy: impl Into<String>,
) -> InputError {
    InputError {
        name: file.to_owned(),
        faults: vec![Fault {
            path: object.into(),
            place: None,
            problem: problem.into(),
            remedy: Some(remedy.into()),
        }],
        more: 0,
    }
}

/// Storeys that are neither mistaken units nor missing diaphragms \[m\].
const LEAST_STOREY: f64 = 1.0;
const MOST_STOREY: f64 = 100.0;

/// A floor of the building.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Floor {
    pub(crate) name: String,
    /// The diaphragm that has its mass.
    pub(crate) diaphragm: String,
    /// Above the base \[m\].
    pub(crate) height: f64,
    pub(crate) mass: [f64; 2],
    pub(crate) inertia: Option<f64>,
    pub(crate) centre: Option<Point>,
}

impl Facts {
    /// Names of all files, for messages.
    pub(crate) fn files(&self) -> String {
        self.files.join(", ")
    }

    pub(crate) fn fault(
        &self,
        object: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> InputError {
        fault(&self.files(), object, problem, remedy)
    }

    /// The height of a storey in words, in m and as the file has it.
    fn in_own_units(&self, storey: f64) -> String {
        let own = self
            .units
            .and_then(|units| Some((units.length, units.length_name()?)));
        let own = own.filter(|(length, _)| *length != 1.0);
        let own = own.map_or_else(String::new, |(length, name)| {
            format!(
                ", {} {name} in the file",
                (1e4 * storey / length).round() / 1e4
            )
        });
        format!("has a height of {storey:.3} m{own}")
    }

    /// Height of the base above the datum of the model \[m\].
    pub(crate) fn base_height(&self) -> f64 {
        self.base.as_ref().map_or(0.0, |base| base.1)
    }

    /// Storeys from the heights of joints, where no table has them.
    pub(crate) fn complete_stories(&mut self) {
        if !self.stories.is_empty() || self.joint_heights.len() < 2 {
            return;
        }
        let mut levels: Vec<(String, f64)> = self.joint_heights.values().cloned().collect();
        levels.sort_by(|a, b| a.1.total_cmp(&b.1));
        let base = levels.remove(0);
        self.read.push(
            "storey heights: from the heights of joints, as no table of storeys was found".into(),
        );
        self.base = Some(base);
        self.stories = levels
            .into_iter()
            .map(|(name, top)| Story { name, top })
            .collect();
    }

    /// Checks that storeys rise as their joints do: a table without elevations may be in another order.
    ///
    /// # Errors
    /// A storey that lies below another one whose joints are lower.
    pub(crate) fn check_order(&self) -> Result<(), InputError> {
        let joint = |story: &Story| Some(self.joint_heights.get(&key(&story.name))?.1);
        for pair in self.stories.windows(2) {
            if let (Some(lower), Some(upper)) = (joint(&pair[0]), joint(&pair[1]))
                && lower > upper
            {
                return Err(self.fault(
                    format!("storey \"{}\"", pair[1].name),
                    format!(
                        "stands above \"{}\" in the table of storeys, but its joints are lower",
                        pair[0].name
                    ),
                    "list storeys from the top down, as ETABS does, or export the column Elevation",
                ));
            }
        }
        Ok(())
    }

    /// Floors with mass, from the ground up. Storeys without mass are joined to those above, and listed.
    pub(crate) fn floors(&mut self) -> Result<Vec<Floor>, InputError> {
        if self.stories.is_empty() {
            let remedy = match self.sap2000 {
                false => {
                    "export the table Story Definitions as well, or name the .e2k or $et file of the model beside it"
                }
                true => {
                    "give joints of every floor a diaphragm constraint: its levels are the floors"
                }
            };
            return Err(self.fault("", "has no storey heights", remedy));
        }
        let masses = match self.solver_masses.is_empty() {
            false => &self.solver_masses,
            true => &self.masses,
        };
        if masses.is_empty() && self.sap2000 {
            let why = self.without_masses.unwrap_or(
                "no joint under a diaphragm has a mass (table JOINT ADDED MASS ASSIGNMENTS)",
            );
            return Err(self.fault("", format!("has no floor masses: {why}"), "name the .OUT and .LOG files of the analysis as well, or make a mass source of added masses alone"));
        }
        if masses.is_empty() {
            return Err(self.fault("", "has no floor masses", "export the table Mass Summary by Diaphragm as well, or name the .OUT and .LOG files of the analysis; masses are not taken from loads, which give 12 to 17 % too much"));
        }
        let (base_name, base) = match &self.base {
            Some((name, height)) => (key(name), *height),
            None => ("base".to_owned(), 0.0),
        };
        let mut of_story: Vec<Option<&FloorMass>> = vec![None; self.stories.len()];
        for mass in masses {
            let found = match &mass.story {
                Ok(name) if key(name) == base_name => continue,
                Ok(name) => self
                    .stories
                    .iter()
                    .position(|story| key(&story.name) == key(name)),
                Err(height) => self
                    .stories
                    .iter()
                    .position(|story| (story.top - height).abs() < 0.05),
            };
            let shown = match &mass.story {
                Ok(name) => format!("storey \"{name}\""),
                Err(height) => format!("the diaphragm at {height:.3} m"),
            };
            let Some(found) = found else {
                return Err(self.fault(
                    shown,
                    "has a mass, but is none of the storeys",
                    "give the tables, .OUT file and text model of one and the same analysis",
                ));
            };
            if mass.mass.iter().any(|mass| *mass < 0.0) {
                return Err(self.fault(
                    shown,
                    "has a negative mass",
                    "check Mass Summary by Diaphragm",
                ));
            }
            if mass.mass == [0.0; 2] {
                continue;
            }
            if let Some(other) = of_story[found].replace(mass) {
                return Err(self.fault(shown, format!("has several diaphragms, {} and {}: several towers, or floors in parts", other.diaphragm, mass.diaphragm), "name one with --diaphragm, if each tower has one name throughout; a floor in parts has no single displacement: give it one rigid diaphragm in ETABS"));
            }
        }
        let mut floors = Vec::new();
        let mut without = Vec::new();
        for (story, mass) in self.stories.iter().zip(&of_story) {
            match mass {
                Some(mass) => floors.push(Floor {
                    name: story.name.clone(),
                    diaphragm: mass.diaphragm.clone(),
                    height: story.top - base,
                    mass: mass.mass,
                    inertia: mass.inertia.filter(|inertia| *inertia > 0.0),
                    centre: mass.centre,
                }),
                None => without.push(story.name.clone()),
            }
        }
        for name in without {
            self.left_out.push(format!("warning: storey \"{name}\" has no diaphragm mass: it is no floor that a neighbour can strike, and its height is part of the storey above; check the table of masses"));
        }
        let rising = floors
            .windows(2)
            .all(|pair| pair[0].height < pair[1].height);
        let mut below = 0.0;
        for floor in &floors {
            let storey = floor.height - std::mem::replace(&mut below, floor.height);
            if !(LEAST_STOREY..MOST_STOREY).contains(&storey) && storey > 0.0 {
                return Err(self.fault(
                    format!("storey \"{}\"", floor.name),
                    self.in_own_units(storey),
                    "check the units: of a text model, the line UNITS; of tables, their row of units or --units",
                ));
            }
        }
        if floors.first().is_none_or(|floor| floor.height <= 0.0) || !rising {
            return Err(self.fault(
                "Story Definitions",
                "storeys do not rise from the base",
                "check heights, and give the tables of one tower",
            ));
        }
        Ok(floors)
    }

    /// Keeps the displacements of the diaphragms that have the masses, where storeys have displacements of several.
    ///
    /// # Errors
    /// A storey with displacements of several diaphragms, none of which has its mass.
    pub(crate) fn choose_displacements(&mut self, floors: &[Floor]) -> Result<(), InputError> {
        for floor in floors {
            let of_floor = |row: &&Displacement| key(&row.story) == key(&floor.name);
            let names: BTreeSet<String> = self
                .displacements
                .iter()
                .filter(of_floor)
                .map(|row| key(&row.diaphragm))
                .collect();
            if names.len() < 2 {
                continue;
            }
            let chosen = key(&floor.diaphragm);
            if !names.contains(&chosen) {
                let names: Vec<String> = names.into_iter().collect();
                return Err(self.fault(
                    format!("storey \"{}\"", floor.name),
                    format!(
                        "has displacements of several diaphragms, {}, and masses of none of them",
                        names.join(" and ")
                    ),
                    "name one with --diaphragm, and export Mass Summary by Diaphragm",
                ));
            }
            self.displacements
                .retain(|row| key(&row.story) != key(&floor.name) || key(&row.diaphragm) == chosen);
        }
        Ok(())
    }

    /// Convex outline of the joints of a storey, else of all joints.
    pub(crate) fn outline(&self, story: &str) -> Option<Vec<Point>> {
        let outline = self.points.get(&key(story)).map(|points| hull(points));
        outline.filter(|hull| hull.len() > 2).or_else(|| {
            let all: Vec<Point> = self.points.values().flatten().copied().collect();
            Some(hull(&all)).filter(|hull| hull.len() > 2)
        })
    }
}

/// Convex hull, counter-clockwise, without points on its sides (Andrew's monotone chain).
pub(crate) fn hull(points: &[Point]) -> Vec<Point> {
    let mut points = points.to_vec();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let turn = |a: Point, b: Point, c: Point| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..] {
                // Within a square millimetre: on one line.
                if turn(a, b, point) > 1e-6 {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut found = half(&mut points.iter().copied());
    found.extend(half(&mut points.iter().rev().copied()));
    found
}
