//! The factors of ready-made studies, from the values or the defaults of a model.

use jostle::linear::sort_by_key;
use jostle::statics::STANDARD_GRAVITY;
use jostle::{Gap, Structure};
use jostle_io::{Input, ModelTree, Scaling, TreeValue};

/// Buildings beyond which all of them vary together.
const MOST_BUILDINGS: usize = 4;
/// Restitution varies by this fraction of its value, unless that would exceed 1 \[–\].
const RESTITUTION_SPREAD: f64 = 0.2;
/// Smallest range of a factor \[–\].
const LEAST_SPREAD: f64 = 0.02;
/// Default damping ratio \[–\].
const USUAL_DAMPING: f64 = 0.05;

/// A `[[vary]]` of a study file.
pub(super) struct Block {
    pub(super) name: String,
    paths: Vec<String>,
    multiplies: bool,
    /// The line with its values.
    values: String,
}

/// How a value spreads around the model's own; the middle is that value.
#[derive(Clone, Copy)]
pub(super) enum Spread {
    /// Uniform, this share less to this share more.
    Uniform(f64),
    /// Lognormal with this dispersion, cut off beyond this many times the own value either way.
    LogNormal(f64, Option<f64>),
    /// Normal with this coefficient of variation.
    Normal(f64),
}

/// The default value and its unit; `None` if the file has a value to multiply.
type Usual = Option<(f64, &'static str)>;

/// Where a value goes.
struct Place {
    path: String,
    usual: Usual,
}

impl Block {
    pub(super) fn plain(name: &str, path: &str, values: &str) -> Self {
        Self {
            name: name.to_owned(),
            paths: vec![path.to_owned()],
            multiplies: false,
            values: values.to_owned(),
        }
    }

    /// As in a study file.
    pub(super) fn text(&self) -> String {
        let paths: Vec<String> = self.paths.iter().map(|path| quoted(path)).collect();
        let paths = match &paths[..] {
            [only] => only.clone(),
            several => format!("[{}]", several.join(", ")),
        };
        let multiply = if self.multiplies {
            "multiply = true\n"
        } else {
            ""
        };
        format!(
            "\n[[vary]]\nname = {}\npath = {paths}\n{multiply}{}\n",
            quoted(&self.name),
            self.values
        )
    }
}

/// A text in TOML, which takes the escapes of JSON.
pub(super) fn quoted(text: &str) -> String {
    serde_json::to_string(text).unwrap_or_default()
}

/// A number with its unit in TOML.
fn measured(number: f64, unit: &str) -> String {
    if unit.is_empty() {
        format!("{number:?}")
    } else {
        quoted(&format!("{number} {unit}"))
    }
}

impl Spread {
    /// Around 1, or around a value in its unit.
    fn distribution(self, (value, unit): (f64, &str)) -> String {
        let at = |share: f64| measured(rounded(value * share), unit);
        match self {
            Self::Uniform(share) => format!(
                "distribution = {{ kind = \"uniform\", from = {}, to = {} }}",
                at(1.0 - share),
                at(1.0 + share)
            ),
            Self::LogNormal(dispersion, limit) => {
                let limits = limit.map_or(String::new(), |limit| {
                    format!(", low = {}, high = {}", at(1.0 / limit), at(limit))
                });
                format!(
                    "distribution = {{ kind = \"lognormal\", median = {}, dispersion = {dispersion}{limits} }}",
                    at(1.0)
                )
            }
            Self::Normal(cov) => format!(
                "distribution = {{ kind = \"normal\", mean = {}, cov = {cov} }}",
                at(1.0)
            ),
        }
    }
}

/// A list of multiples of a value; the value itself stays as it is.
fn values_around(value: f64, multiples: &[f64], unit: &str) -> String {
    let times = |k: &f64| if *k == 1.0 { value } else { rounded(value * k) };
    let numbers = multiples.iter().map(|k| measured(times(k), unit));
    format!("values = [{}]", numbers.collect::<Vec<_>>().join(", "))
}

/// Without digits that come from arithmetic.
fn rounded(number: f64) -> f64 {
    format!("{number:.12e}").parse().unwrap_or(number)
}

/// One block for the places with a value, and one for each default value of the others.
fn around(name: &str, places: Vec<Place>, spread: Spread) -> Vec<Block> {
    let mut groups: Vec<(Usual, Vec<String>)> = Vec::new();
    for place in places {
        match groups.iter_mut().find(|group| group.0 == place.usual) {
            Some((_, paths)) => paths.push(place.path),
            None => groups.push((place.usual, vec![place.path])),
        }
    }
    let several = groups.len() > 1;
    let block = |(number, (usual, paths)): (usize, (Usual, Vec<String>))| {
        let name = match usual {
            // Names are unique in a study.
            Some(_) if several && number > 1 => format!("{name} by default {number}"),
            Some(_) if several => format!("{name} by default"),
            _ => name.to_owned(),
        };
        Block {
            name,
            paths,
            multiplies: usual.is_none(),
            values: spread.distribution(usual.unwrap_or((1.0, ""))),
        }
    };
    // Places with a value come first.
    sort_by_key(&mut groups, |group| group.0.is_some());
    groups.into_iter().enumerate().map(block).collect()
}

/// `gap[*].width` in place of the paths of all gaps.
fn for_all(paths: Vec<String>, list: &str, key: &str, count: usize) -> Vec<String> {
    let all: Vec<String> = (0..count).map(|i| format!("{list}[{i}].{key}")).collect();
    if paths == all {
        vec![format!("{list}[*].{key}")]
    } else {
        paths
    }
}

fn stands(tree: &ModelTree, path: &str) -> bool {
    !tree.values(path).is_empty()
}

/// Gaps that have a width to multiply; the others are named in a note.
fn open_gaps(input: &Input, notes: &mut Vec<String>) -> Vec<usize> {
    let gaps = input.model.gaps.iter().enumerate();
    let (open, closed): (Vec<_>, Vec<_>) =
        gaps.partition(|(_, gap)| gap.widths.iter().any(|width| *width > 0.0));
    for (index, _) in closed {
        notes.push(format!(
            "gap[{index}].width is 0 and stays 0: there is nothing to multiply"
        ));
    }
    open.into_iter().map(|(index, _)| index).collect()
}

/// Widths of all gaps, multiplied.
pub(super) fn gap_widths(input: &Input, spread: Spread, notes: &mut Vec<String>) -> Vec<Block> {
    let place = |index: usize| Place {
        path: format!("gap[{index}].width"),
        usual: None,
    };
    let mut blocks = around(
        "gap",
        open_gaps(input, notes).into_iter().map(place).collect(),
        spread,
    );
    for block in &mut blocks {
        let paths = std::mem::take(&mut block.paths);
        block.paths = for_all(paths, "gap", "width", input.model.gaps.len());
    }
    blocks
}

/// A list of widths around the model's own: widths if all gaps have one and the same, otherwise multiples.
pub(super) fn widths(input: &Input, multiples: &[f64], notes: &mut Vec<String>) -> Option<Block> {
    let gaps = &input.model.gaps;
    let open = open_gaps(input, notes);
    let first = gaps.first()?.width();
    let same = |gap: &Gap| gap.widths.len() == 1 && gap.width() == first;
    let list = |unit: &str, value: f64| values_around(value, multiples, unit);
    if open.is_empty() {
        return None;
    }
    if first > 0.0 && gaps.iter().all(same) {
        let values = list("mm", rounded(1e3 * first));
        return Some(Block::plain("gap", "gap[*].width", &values));
    }
    let paths = open.iter().map(|index| format!("gap[{index}].width"));
    Some(Block {
        name: "gap".to_owned(),
        paths: for_all(paths.collect(), "gap", "width", gaps.len()),
        multiplies: true,
        values: list("", 1.0),
    })
}

/// A list of strengths of the motion around the model's own, by the key that scales it in the model.
pub(super) fn shaking(
    tree: &ModelTree,
    input: &Input,
    multiples: &[f64],
    notes: &mut Vec<String>,
) -> Option<Block> {
    let list = |unit: &str, value: f64| values_around(value, multiples, unit);
    // In g where the model states its peak in g.
    let in_g = tree.values("motion.pga").iter().any(|tree| {
        let TreeValue::Text(text) = tree else {
            return false;
        };
        text.trim_end()
            .strip_suffix('g')
            .is_some_and(|strip_suffix| strip_suffix.trim_end().parse::<f64>().is_ok())
    });
    let by_peak = |value: f64| match in_g {
        true => Block::plain("pga", "motion.pga", &list("g", value / STANDARD_GRAVITY)),
        false => Block::plain("pga", "motion.pga", &list("m/s2", value)),
    };
    let scaling = input.motion.as_ref().map(|motion| &motion.scaling)?;
    let several = input.records().len() > 1;
    match scaling {
        Scaling::Pga(pga) => return Some(by_peak(*pga)),
        Scaling::Match(_) if stands(tree, "motion.match.value") => {
            return Some(Block {
                name: "match".to_owned(),
                paths: vec!["motion.match.value".to_owned()],
                multiplies: true,
                values: list("", 1.0),
            });
        }
        Scaling::Factor(factor) if !several => {
            return Some(Block::plain("scale", "motion.scale", &list("", *factor)));
        }
        Scaling::AsRecorded if !several => {
            return Some(Block::plain("scale", "motion.scale", &list("", 1.0)));
        }
        _ => {}
    }
    let mut peaks: Vec<f64> = Vec::new();
    for one in input.each_record() {
        // A record that cannot be read is a fault of the study as a whole.
        peaks.push(one.ground_motion().ok()?.peak());
    }
    peaks.sort_by(f64::total_cmp);
    let middle = rounded(*peaks.get(peaks.len() / 2)?);
    notes.push(format!(
        "motions are scaled to common peaks around {middle:.4} m/s2, the middle of their own, in place of the scaling of the model"
    ));
    Some(by_peak(middle))
}

/// Stiffness and restitution of the contacts.
pub(super) fn contacts(tree: &ModelTree, input: &Input, notes: &mut Vec<String>) -> Vec<Block> {
    let gaps = &input.model.gaps;
    let place = |index: usize, key: &str, usual: (f64, &'static str)| {
        let path = format!("gap[{index}].{key}");
        Place {
            usual: (!stands(tree, &path)).then_some(usual),
            path,
        }
    };
    let stiff = gaps.iter().enumerate().map(|(index, gap)| {
        let unit = if gap.law.kind.is_hertzian() {
            "N/m^1.5"
        } else {
            "N/m"
        };
        place(index, "stiffness", (gap.law.stiffness, unit))
    });
    let mut blocks = around(
        "contact stiffness",
        stiff.collect(),
        Spread::LogNormal(0.5, None),
    );
    let lossy = |gap: &Gap| gap.law.kind.uses_restitution() && gap.law.restitution > 0.0;
    let rebounds = gaps.iter().enumerate().filter(|(_, gap)| lossy(gap));
    let greatest = rebounds
        .clone()
        .map(|(_, gap)| gap.law.restitution)
        .fold(0.0, f64::max);
    // Whole per cents, so that the greatest product stays below 1.
    let spread = RESTITUTION_SPREAD.min((100.0 * (1.0 / greatest - 1.0)).floor() / 100.0);
    if greatest > 0.0 && spread < LEAST_SPREAD {
        notes.push(format!(
            "restitution is not varied: {greatest} leaves no room below 1"
        ));
    } else {
        let places =
            rebounds.map(|(index, gap)| place(index, "restitution", (gap.law.restitution, "")));
        let places = places.collect();
        blocks.extend(around("restitution", places, Spread::Uniform(spread)));
    }
    for block in &mut blocks {
        let key = if block.name.starts_with("contact") {
            "stiffness"
        } else {
            "restitution"
        };
        let paths = std::mem::take(&mut block.paths);
        block.paths = for_all(paths, "gap", key, gaps.len());
    }
    blocks
}

/// One factor for every building, or one for all if there are many.
fn by_building(
    input: &Input,
    what: &str,
    spread: Spread,
    mut places: impl FnMut(usize) -> Vec<Place>,
) -> Vec<Block> {
    let buildings = &input.model.buildings;
    if buildings.len() > MOST_BUILDINGS {
        let all = (0..buildings.len()).flat_map(places).collect();
        return around(&format!("{what} of all buildings"), all, spread);
    }
    let mut blocks = Vec::new();
    for (index, building) in buildings.iter().enumerate() {
        let name = format!("{what} of {}", building.name);
        blocks.extend(around(&name, places(index), spread));
    }
    blocks
}

/// Stiffness of the buildings: of storeys, or the factor on every EI of a frame.
pub(super) fn stiffness(tree: &ModelTree, input: &Input, notes: &mut Vec<String>) -> Vec<Block> {
    let buildings = &input.model.buildings;
    // Coefficient of variation 0.2.
    let spread = Spread::LogNormal(0.2, None);
    by_building(input, "stiffness", spread, |index| {
        let place = |key: &str| Place {
            path: format!("building[{index}].{key}"),
            usual: None,
        };
        if matches!(buildings[index].structure, Structure::Shear(_)) {
            return vec![place("stiffness")];
        }
        let factor = place("stiffness_factor");
        match tree.values(&factor.path).first() {
            None => vec![Place {
                usual: Some((1.0, "")),
                ..factor
            }],
            Some(TreeValue::Table(parts)) if parts.len() == 1 => {
                if stands(tree, &place("elastic_modulus").path) {
                    return vec![place("elastic_modulus")];
                }
                notes.push(format!(
                    "of {} only {} is varied: the other factor does not stand in the model",
                    factor.path, parts[0].0
                ));
                vec![place(&format!("stiffness_factor.{}", parts[0].0))]
            }
            Some(TreeValue::Table(parts)) => {
                let parts = parts.iter();
                parts
                    .map(|(key, _)| place(&format!("stiffness_factor.{key}")))
                    .collect()
            }
            Some(_) => vec![factor],
        }
    })
}

/// Masses of the buildings.
pub(super) fn masses(tree: &ModelTree, input: &Input) -> Vec<Block> {
    by_building(input, "mass", Spread::Normal(0.1), |index| {
        let keys = ["mass", "beam_mass", "floor_mass"].into_iter();
        keys.map(|key| format!("building[{index}].{key}"))
            .filter(|path| stands(tree, path))
            .map(|path| Place { path, usual: None })
            .collect()
    })
}

/// Damping of all buildings together.
pub(super) fn damping(tree: &ModelTree, input: &Input) -> Vec<Block> {
    let count = input.model.buildings.len();
    let place = |index: usize| -> Vec<Place> {
        let path = |key: &str| format!("building[{index}].damping.{key}");
        let there: Vec<String> = ["ratio", "alpha", "beta"]
            .into_iter()
            .map(path)
            .filter(|path| stands(tree, path))
            .collect();
        if there.is_empty() {
            return vec![Place {
                path: path("ratio"),
                usual: Some((USUAL_DAMPING, "")),
            }];
        }
        let there = there.into_iter();
        there.map(|path| Place { path, usual: None }).collect()
    };
    let places = (0..count).flat_map(place).collect();
    let mut blocks = around("damping", places, Spread::LogNormal(0.3, Some(2.5)));
    let several = blocks.len() > 1;
    for block in &mut blocks {
        // A factor of one building is named by it.
        let is_of = |index: &usize| {
            let own = format!("building[{index}].");
            block.paths.iter().all(|path| path.starts_with(&own))
        };
        if let Some(index) = (0..count).find(is_of).filter(|_| several) {
            block.name = format!("damping of {}", input.model.buildings[index].name);
        }
        let paths = std::mem::take(&mut block.paths);
        block.paths = for_all(paths, "building", "damping.ratio", count);
    }
    blocks
}
