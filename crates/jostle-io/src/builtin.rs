//! Ground motions that come with the program.

use jostle::GroundMotion;

use crate::record::{RecordOptions, parse_record};

/// A ground motion that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltinRecord {
    /// Name in model files.
    pub name: &'static str,
    /// Other names understood.
    pub aliases: &'static [&'static str],
    /// Description, one line.
    pub description: &'static str,
    /// The file.
    text: &'static str,
}

/// The ground motions that come with the program.
pub const BUILTIN_RECORDS: &[BuiltinRecord] = &[BuiltinRecord {
    name: "el-centro-1940-ns",
    aliases: &["el-centro"],
    description: "El Centro, Imperial Valley 1940, north-south, digitisation of Peknold; 0.319 g, 31.18 s",
    text: include_str!("../data/el-centro-1940-ns.csv"),
}];

/// A built-in ground motion by name, unscaled; `None` if the name is unknown.
#[must_use]
pub fn builtin_record(name: &str) -> Option<GroundMotion> {
    let name = name.trim().to_ascii_lowercase();
    let known = BUILTIN_RECORDS
        .iter()
        .find(|known| known.name == name || known.aliases.contains(&name.as_str()));
    let Some(known) = known else {
        return artificial(&name);
    };
    let record = parse_record(known.text.as_bytes(), &RecordOptions::default()).ok()?;
    Some(GroundMotion::sampled(
        known.name,
        record.step,
        record.acceleration,
    ))
}

/// A named artificial motion, generated from its seed.
fn artificial(name: &str) -> Option<GroundMotion> {
    let recipe = jostle_motion::recipe(name)?;
    let motion = recipe.make().ok()?.motion;
    let step = motion.step();
    Some(GroundMotion::sampled(
        recipe.name,
        step,
        motion.into_acceleration(),
    ))
}

/// Names and descriptions of the built-in ground motions, recorded and artificial.
#[must_use]
pub fn builtin_motions() -> Vec<(&'static str, &'static str)> {
    let recorded = BUILTIN_RECORDS
        .iter()
        .map(|record| (record.name, record.description));
    let artificial = jostle_motion::RECIPES
        .iter()
        .map(|recipe| (recipe.name, recipe.description));
    recorded.chain(artificial).collect()
}

/// Names of the built-in ground motions, for messages.
pub(crate) fn record_names() -> String {
    let names: Vec<_> = builtin_motions()
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    names.join(", ")
}
