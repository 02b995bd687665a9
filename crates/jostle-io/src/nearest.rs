//! The word that was meant.

/// The known key spelt most like a wrong one, if any is close.
pub fn nearest<'a>(wrong: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wrong: String = wrong.chars().take(64).collect::<String>().to_lowercase();
    let allowed = 1 + wrong.chars().count() / 4;
    let known: Vec<&str> = known.collect();
    let near = known
        .iter()
        .map(|name| {
            (
                strsim::damerau_levenshtein(&wrong, &name.to_lowercase()),
                *name,
            )
        })
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name);
    // importance_factor: importance.
    let longer = |name: &&str| {
        let rest = wrong.strip_prefix(&name.to_lowercase()[..]);
        rest.is_some_and(|rest| rest.starts_with('_'))
    };
    near.or_else(|| {
        known
            .iter()
            .copied()
            .filter(longer)
            .max_by_key(|name| name.len())
    })
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn names_with_a_word_more_are_known() {
        let keys = || ["importance", "intensity", "drift", "drift_factor"].into_iter();
        for (wrong, right) in [
            ("importance_factor", Some("importance")),
            ("importence", Some("importance")),
            ("drift_factor_of_r", Some("drift_factor")),
            ("important_building", None),
        ] {
            assert_eq!(nearest(wrong, keys()), right, "{wrong}");
        }
    }
}
