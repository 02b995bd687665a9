//! Commented starter files: templates, and the built-in models themselves.

use crate::builtin_model::model_text;
use crate::shown::Units;
use crate::us_template::in_us_units;

/// Names of the templates; the first is the default.
pub const TEMPLATE_NAMES: [&str; 15] = [
    "frames",
    "towers",
    "single",
    "row",
    "space-frames",
    "soft-storey",
    "wall-frame",
    "podium",
    "masonry-infill",
    "heritage",
    "braced-steel",
    "bridge-decks",
    "isolated-moat",
    "paper",
    "paper-inelastic",
];

/// Text of a template with a title inserted, or of a built-in model unchanged; `None` if the name is unknown.
#[must_use]
pub fn template(name: &str, title: &str) -> Option<String> {
    template_in(name, title, Units::Si)
}

/// The same in a system of units: in US customary units its quantities are converted and rounded. `None` also for built-in models in other
/// units than SI: they stay as they are published.
#[must_use]
pub fn template_in(name: &str, title: &str, units: Units) -> Option<String> {
    let text = match name {
        "frames" => include_str!("../data/frames.toml"),
        "towers" => include_str!("../data/towers.toml"),
        "single" => include_str!("../data/single.toml"),
        "row" => include_str!("../data/row.toml"),
        "space-frames" => include_str!("../data/space_frames.toml"),
        "soft-storey" => include_str!("../data/soft_storey.toml"),
        "wall-frame" => include_str!("../data/wall_frame.toml"),
        "podium" => include_str!("../data/podium.toml"),
        "masonry-infill" => include_str!("../data/masonry_infill.toml"),
        "heritage" => include_str!("../data/heritage.toml"),
        "braced-steel" => include_str!("../data/braced_steel.toml"),
        "bridge-decks" => include_str!("../data/bridge_decks.toml"),
        "isolated-moat" => include_str!("../data/isolated_moat.toml"),
        _ if units != Units::Si => return None,
        _ => return model_text(name).map(ToOwned::to_owned),
    };
    let text = match units {
        Units::Si => text.to_owned(),
        Units::Us => in_us_units(text),
    };
    // Quotes, backslashes and control characters would end or change the TOML string.
    let title: String = title
        .chars()
        .filter(|c| !c.is_control() && !matches!(c, '"' | '\\'))
        .collect();
    Some(text.replace("TITLE", title.trim()))
}
