//! Studies that come with the program.

/// Names and texts; all of them have the built-in example as their base.
const STUDIES: [(&str, &str); 6] = [
    ("table2", include_str!("../data/table2.toml")),
    ("gap-sweep", include_str!("../data/gap-sweep.toml")),
    ("ida", include_str!("../data/ida.toml")),
    ("fragility", include_str!("../data/fragility.toml")),
    ("sensitivity", include_str!("../data/sensitivity.toml")),
    ("tornado", include_str!("../data/tornado.toml")),
];

/// The text of a ready-made study; `None` if there is none of that name.
#[must_use]
pub fn ready_made(name: &str) -> Option<&'static str> {
    let known = STUDIES.iter().find(|(known, _)| *known == name);
    known.map(|(_, text)| *text)
}

/// Names of the ready-made studies.
#[must_use]
pub fn ready_made_names() -> Vec<&'static str> {
    STUDIES.iter().map(|(name, _)| *name).collect()
}
