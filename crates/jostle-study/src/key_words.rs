//! Keys of a model file in words, as headings, axes and tiles have them.

use jostle_report::message;

/// Path without its owner, words, and whether these need no owner.
type Words = (&'static str, fn() -> &'static str, bool);

/// What a key says, of those whose own words mean less.
const WORDS: [Words; 21] = [
    ("pga", message::peak_ground_acceleration_axis, true),
    ("reverse", message::key_signs_changed, true),
    ("motion.pga", message::peak_ground_acceleration_axis, true),
    ("motion.scale", message::key_factor_on_the_record, true),
    ("motion.reverse", message::key_signs_changed, true),
    ("motion.angle", message::key_angle_of_incidence, true),
    ("motion.angle_rad", message::key_angle_of_incidence, true),
    ("angle", message::key_angle_of_incidence, true),
    ("angle_rad", message::key_angle_of_incidence, true),
    (
        "motion.match.value",
        message::key_intensity_of_the_target_spectrum,
        true,
    ),
    ("motion.record", message::key_record, true),
    ("gap.width", message::key_gap_width, true),
    ("gap.stiffness", message::key_contact_stiffness, true),
    ("gap.restitution", message::key_restitution, true),
    ("gap.law", message::key_contact_law, true),
    ("gap.friction", message::key_friction, true),
    ("link.stiffness", message::key_link_stiffness, true),
    ("link.damping", message::key_link_damping, true),
    ("impact_count", message::key_number_of_impacts, true),
    ("damping.ratio", message::key_damping_ratio, false),
    ("damping", message::key_damping_ratio, false),
];
/// Lists of a model file, one entry of which is meant.
const OWNERS: [&str; 5] = ["building", "gap", "link", "wall", "record"];

/// A key or a column in words, without its unit: `gap[0].width` is "gap width", `building.Left.stiffness` "stiffness of Left",
/// `building[*].damping.ratio` "damping ratio of all buildings". Names that users give have spaces for underlines.
pub(crate) fn key_in_words(path: &str) -> String {
    let path = path.trim_start_matches("input.");
    let mut parts = path.split('.');
    let first = parts.next().unwrap_or_default();
    let mut rest: Vec<&str> = parts.collect();
    let Some((owner, number)) = OWNERS.iter().find_map(|owner| {
        let number = first.strip_prefix(owner)?;
        let number = number.trim_start_matches('[').trim_end_matches(']');
        (number.is_empty() || number == "*" || number.parse::<usize>().is_ok())
            .then_some((*owner, number))
    }) else {
        let known = WORDS.iter().find(|(key, ..)| *key == path);
        return known.map_or_else(|| spaced(path), |(_, words, _)| words().to_owned());
    };
    // A name in the place of a number.
    let name = if number.is_empty() && rest.len() > 1 && *owner == *"building" {
        Some(rest.remove(0).to_owned())
    } else {
        None
    };
    if rest.is_empty() {
        return spaced(path);
    }
    let key = rest.join(".");
    let of_owner = format!("{owner}.{key}");
    let known = WORDS
        .iter()
        .find(|(known, ..)| *known == of_owner || *known == key);
    let what = known.map_or_else(|| spaced(&key), |(_, words, _)| words().to_owned());
    let alone = known.is_some_and(|(.., alone)| *alone);
    match (name, number) {
        (Some(name), _) => message::key_of_owner(what, spaced(&name)),
        (None, "*") if alone => what,
        (None, "*") => message::key_of_all(what, owner),
        (None, "" | "0") if alone => what,
        (None, "") => format!("{owner} {what}"),
        (None, number) => {
            let number = number.parse::<usize>().map_or(1, |number| number + 1);
            message::key_of_owner(what, format!("{owner} {number}"))
        }
    }
}

/// The label of a value in words: yes and no for switches.
pub(crate) fn label_in_words(label: &str) -> &str {
    match label {
        "true" => message::yes(),
        "false" => message::no(),
        other => other,
    }
}

fn spaced(text: &str) -> String {
    text.replace(['_', '.'], " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_read_as_words() {
        for (key, words) in [
            ("gap[0].width", "gap width"),
            ("input.gap0.width", "gap width"),
            ("gap.width", "gap width"),
            ("gap[*].stiffness", "contact stiffness"),
            ("gap[1].width", "gap width of gap 2"),
            ("building.Left.stiffness", "stiffness of Left"),
            (
                "building[1].stiffness_factor",
                "stiffness factor of building 2",
            ),
            (
                "building[*].damping.ratio",
                "damping ratio of all buildings",
            ),
            ("motion.reverse", "signs changed"),
            ("motion.pga", "peak ground acceleration"),
            ("angle_rad", "angle of incidence"),
            ("link.damping", "link damping"),
            ("my_factor", "my factor"),
            ("gap", "gap"),
        ] {
            assert_eq!(key_in_words(key), words, "{key}");
        }
        assert_eq!(["true", "20 mm"].map(label_in_words), ["yes", "20 mm"]);
    }
}
