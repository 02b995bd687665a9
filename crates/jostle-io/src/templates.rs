//! Commented starter files.

/// Names of the templates; the first is the default.
pub const TEMPLATE_NAMES: [&str; 4] = ["frames", "towers", "single", "row"];

/// Text of a template with a title put in; `None` if there is none of that name.
#[must_use]
pub fn template(name: &str, title: &str) -> Option<String> {
    let text = match name {
        "frames" => include_str!("../data/frames.toml"),
        "towers" => include_str!("../data/towers.toml"),
        "single" => include_str!("../data/single.toml"),
        "row" => include_str!("../data/row.toml"),
        _ => return None,
    };
    // Quotes, backslashes and control characters would end or change the TOML string.
    let title: String = title
        .chars()
        .filter(|c| !c.is_control() && !matches!(c, '"' | '\\'))
        .collect();
    Some(text.replace("TITLE", title.trim()))
}
