//! Every quantity of the results: as a page of Markdown and as JSON, made from the lists of the results.

use std::fmt::Write;

use jostle::results::registry::{Entry, Owner, owners};
use jostle::{Column, EnergyTerm};

const HEAD: &str = "# Quantities of results

Written by `jostle schema --results --markdown`; `jostle schema --results` prints the same as JSON. [Result files](results.md)
explains the files. Names end with the unit. *Summary*: a key of `summary.json`. *Table*: a column of the Parquet file of the same
name. *Study*: a column in the table of a study.

*Compared*: tables also contain the same quantity of the run without contact, such as `storey_drift_peak_without_contact`, and the
ratio of the two absolute values, such as `storey_drift_peak_amplification` (absent if the value without contact is zero). In `summary.json` these are in
`without_contact` and `amplification`. In studies they are columns with `without_contact = true`.

Studies have one more column of every building, `J1.sa_t1_m_s2`: the pseudo-acceleration of the record at its first period with 5 %
damping.
";

/// All quantities as a page of Markdown.
#[must_use]
pub fn quantity_reference() -> String {
    let mut page = HEAD.to_owned();
    for owner in owners() {
        // Writing to a string cannot fail.
        let _ = write_owner(&mut page, &owner);
    }
    let _ = write_histories(&mut page);
    page
}

/// All quantities as JSON.
#[must_use]
pub fn quantity_list() -> String {
    serde_json::to_string_pretty(&owners()).unwrap_or_default() + "\n"
}

fn write_owner(page: &mut String, owner: &Owner) -> std::fmt::Result {
    let mut places = Vec::new();
    if !owner.key.is_empty() {
        let (file, key) = owner
            .key
            .split_once(": ")
            .unwrap_or(("summary.json", owner.key));
        places.push(format!("`{key}` in `{file}`"));
    }
    if let Some(table) = owner.table {
        places.push(match owner.key {
            "buildings[].hinges.list[]" => format!(
                "`{table}` has all hinges, and `summary.json` those that cracked or yielded"
            ),
            _ => format!("one row each in `{table}`"),
        });
    }
    let in_study = owner.entries.iter().any(|entry| entry.places.study);
    if in_study && !owner.study.is_empty() {
        places.push(format!("columns of studies begin with `{}`", owner.study));
    }
    writeln!(page, "\n## {}\n", owner.title)?;
    if !places.is_empty() {
        let places = places.join("; ");
        let mut letters = places.chars();
        let first = letters.next().map(|first| first.to_uppercase().to_string());
        writeln!(page, "{}{}.\n", first.unwrap_or_default(), letters.as_str())?;
    }
    let with_table = owner.table.is_some();
    let table = if with_table { " table |" } else { "" };
    writeln!(
        page,
        "| name | unit | meaning | summary |{table} study | compared |"
    )?;
    let table = if with_table { "---|" } else { "" };
    writeln!(page, "|---|---|---|---|{table}---|---|")?;
    for entry in &owner.entries {
        let Entry {
            name,
            unit,
            meaning,
            places,
        } = entry;
        let mark = |there: bool| if there { "yes" } else { "" };
        let table = if with_table {
            format!(" {} |", mark(places.table))
        } else {
            String::new()
        };
        let study = match (places.study, places.yielding) {
            (false, _) => "",
            (true, false) => "yes",
            (true, true) => "if it can yield",
        };
        writeln!(
            page,
            "| `{name}` | {unit} | {meaning} | {} |{table} {study} | {} |",
            mark(places.summary),
            mark(places.compared)
        )?;
    }
    Ok(())
}

/// The columns of `history.parquet`.
fn write_histories(page: &mut String) -> std::fmt::Result {
    let (building, floor) = (0, 3);
    let columns = [
        Column::TIME,
        Column::GROUND_ACCELERATION,
        Column::displacement(building, floor),
        Column::velocity(building, floor),
        Column::total_acceleration(building, floor),
        Column::GROUND_ACCELERATION.across(),
        Column::displacement(building, floor).across(),
        Column::velocity(building, floor).across(),
        Column::total_acceleration(building, floor).across(),
        Column::displacement(building, floor).turning(),
        Column::velocity(building, floor).turning(),
        Column::total_acceleration(building, floor).turning(),
        Column::contact_force(0),
        Column::closing(0),
        Column::link_force(0),
        Column::link_stroke(0),
        Column::link_speed(0),
        Column::support_force(0),
    ];
    let energies = EnergyTerm::ALL.into_iter().map(Column::energy);
    let friction = Column::energy(EnergyTerm::Friction);
    let of_grounds = [
        Column::energy(EnergyTerm::Ground),
        Column::ground_displacement(0),
        Column::ground_displacement(0).across(),
    ];
    writeln!(
        page,
        "\n## Histories\n\nColumns of `history.parquet`, one row for each recorded instant.\n"
    )?;
    writeln!(page, "| column | unit | meaning |\n|---|---|---|")?;
    for recorded in columns
        .into_iter()
        .chain(energies)
        .chain([friction])
        .chain(of_grounds)
        .map(Column::recorded)
    {
        let place = match recorded.owner {
            "contact" if recorded.name == "closing" => "J1-J2.at3200mm.",
            "floor" => "J1.floor3.",
            "contact" => "J1-J2.floor5-5.",
            "link" => "J1-J2.link5-5.",
            "isolation" => "J1.isolation.",
            "energy" => "energy_",
            "ground" => "J1.",
            _ => "",
        };
        let (name, unit) = (recorded.name, recorded.unit);
        writeln!(
            page,
            "| `{place}{name}{}` | {} | {} |",
            unit.suffix, unit.symbol, recorded.meaning
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_in_the_documentation_is_this_one() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/quantities.md");
        let kept = std::fs::read_to_string(path).unwrap_or_default();
        assert!(
            kept == quantity_reference(),
            "docs/quantities.md is out of date: cargo run -- schema --results --markdown > docs/quantities.md"
        );
    }
}
