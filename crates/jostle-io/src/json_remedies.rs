//! Remedies, which are written for TOML, in the syntax of JSON.

/// A remedy such as "add width = \"100 mm\" to the [[gap]]" as "add \"width\": \"100 mm\" to the \"gap\": [{ … }]". What stands in
/// quotation marks stays.
pub(crate) fn in_json(remedy: &str) -> String {
    // Some remedies say both.
    if let Some((_, json)) = remedy.split_once("in JSON ") {
        return format!("write {json}");
    }
    let parts = remedy.split('"').enumerate().map(|(index, part)| {
        if index % 2 == 1 {
            return part.to_owned();
        }
        let words = part.split(' ').collect::<Vec<_>>();
        let mut written = String::new();
        for (index, word) in words.iter().enumerate() {
            let is_value = index > 0 && *word == "=" && is_key(words[index - 1]);
            if index > 0 && !is_value {
                written.push(' ');
            }
            let is_named = words.get(index + 1) == Some(&"=") && is_key(word);
            written += &match word {
                _ if is_value => ":".to_owned(),
                _ if is_named => format!("\"{word}\""),
                _ => table(word),
            };
        }
        written
    });
    parts.collect::<Vec<_>>().join("\"")
}

fn is_key(word: &str) -> bool {
    !word.is_empty()
        && word
            .bytes()
            .all(|byte| byte.is_ascii_lowercase() || byte == b'_')
}

/// `[[gap]]` and `[motion]` as keys.
fn table(word: &str) -> String {
    let close = word.rfind(']').map_or(0, |at| at + 1);
    let (name, after) = word.split_at(close);
    let list = name
        .strip_prefix("[[")
        .and_then(|name| name.strip_suffix("]]"));
    let single = name
        .strip_prefix('[')
        .and_then(|name| name.strip_suffix(']'));
    match (list, single) {
        (Some(name), _) if is_key(name) => format!("\"{name}\": [{{ … }}]{after}"),
        (None, Some(name)) if is_key(name) => format!("\"{name}\"{after}"),
        _ => word.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::in_json;

    #[test]
    fn remedies_follow_the_syntax_of_the_file() {
        for (toml, json) in [
            (
                "add a [[building]]; \"jostle new\" writes a commented example",
                "add a \"building\": [{ … }]; \"jostle new\" writes a commented example",
            ),
            ("add width = \"100 mm\"", "add \"width\": \"100 mm\""),
            (
                "accept_unusual = true under [analysis], or",
                "\"accept_unusual\": true under \"analysis\", or",
            ),
            (
                "write [[gap]] with double brackets; in JSON \"gap\": [{ … }]",
                "write \"gap\": [{ … }]",
            ),
            (
                "write \"f'c = 4 ksi\", or a [1, 3]",
                "write \"f'c = 4 ksi\", or a [1, 3]",
            ),
        ] {
            assert_eq!(in_json(toml), json);
        }
    }
}
