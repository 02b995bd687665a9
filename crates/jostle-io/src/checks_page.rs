//! All checks: as a page of Markdown and as JSON, made from their list.

use std::fmt::Write;

use jostle::judgement::{Bound, CHECKS, Check, Limit};
use serde_json::{Value, json};

const HEAD: &str = "# Checks that always run

Written by `jostle schema --checks --markdown`; `jostle schema --checks` prints the same as JSON.

Every model and every result is compared with the limits below. A passed check prints nothing. Findings appear in
`jostle check` (the model), in `jostle run` (at most three lines, worst first), on the first page of the report as *Assumptions and
limits of this result*, in `summary.json` as `checks`, and in Python as `run.checks`. The column `result_checks` of a study counts the
checks B1 to B12 of a case that gave a note or a warning.

A *warning* means that the result is not valid without changes. A *note* should be read before the result is used. A *remark* is an
assumption to be aware of; `jostle check` prints it, `jostle run` does not.

To hide a check, name it in the model file; the report then lists it. An identifier hides all parts of a check:

```toml
[report]
silence = [\"A12\", \"residual-drift\"]
```

Sources: at least two publications agree on a limit; otherwise the source is \"judgement\", that of the authors. \"The model file\" means that
the file states the limit, or names the rule that gives it. Limits show where to look, not what is allowed.
";

/// All checks as a page of Markdown.
#[must_use]
pub fn check_reference() -> String {
    let mut page = HEAD.to_owned();
    for (title, of_model) in [
        ("Checks of the model", true),
        ("Checks of the results", false),
    ] {
        // Writing to a string cannot fail.
        let _ = write!(
            page,
            "\n## {title}\n\n| check | name | compared | limits | source | remedy |\n|---|---|---|---|---|---|\n"
        );
        for check in CHECKS
            .iter()
            .filter(|candidate| candidate.is_of_model() == of_model)
        {
            let _ = writeln!(
                page,
                "| {} | `{}` | {} | {} | {} | {} |",
                check.id,
                check.name,
                check.quantity,
                limits(check),
                check.source(),
                check.remedy
            );
        }
    }
    page
}

fn limits(check: &Check) -> String {
    let one = |limit: &Limit| {
        let side = match limit.bound {
            Bound::Above => "above",
            Bound::Below => "below",
        };
        let unit = match check.unit {
            "–" => String::new(),
            unit => format!(" {unit}"),
        };
        format!("{} {side} {}{unit}", limit.grade.word(), limit.value)
    };
    check.limits.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// All checks as JSON.
#[must_use]
pub fn check_list() -> String {
    let one = |check: &Check| {
        let limits = check.limits.iter().map(|limit| {
            let key = match limit.bound {
                Bound::Above => "above",
                Bound::Below => "below",
            };
            json!({ key: limit.value, "grade": limit.grade })
        });
        json!({
            "id": check.id,
            "name": check.name,
            "of": if check.is_of_model() { "model" } else { "results" },
            "quantity": check.quantity,
            "unit": check.unit,
            "limits": limits.collect::<Vec<Value>>(),
            "sources": check.sources,
            "remedy": check.remedy,
        })
    };
    let list: Vec<Value> = CHECKS.iter().map(one).collect();
    serde_json::to_string_pretty(&list).unwrap_or_default() + "\n"
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_page_of_checks_is_up_to_date() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/checks.md");
        let page = std::fs::read_to_string(path).unwrap_or_default();
        assert!(
            page == super::check_reference(),
            "docs/checks.md is out of date: cargo run -- schema --checks --markdown > docs/checks.md"
        );
    }
}
