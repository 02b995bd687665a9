//! The page `docs/validation.md`, and one page for each family in `docs/validation/`.

use std::fmt::Write;

use crate::row::{Row, Tolerance};
use crate::{Extent, Family, misses};

const ILL_CONDITIONED: &str = "\
## What to know before reading the tables

- **Impact sequences are sensitive.** A small change in timing can alter all later impacts, and can add or remove a grazing impact. The tables
  therefore compare early impacts, peaks, impulses and energies. The number of impacts must be equal, or differ by at most one where grazing
  impacts occur.
- **Many frequencies of a frame lie close together.** Frequencies are therefore compared, but single mode shapes are not.
- **Some closed forms are compared with time-stepping results.** Two groups of rows show the error of the time step, not of a formula; each
  row states the step.
- **Rows marked *known* do not agree within their tolerance.** The reason is given below the table. All of them concern the same grazing impact
  of 10 kN, in a run with impacts of 190 kN.
- **Below some step size accuracy stops improving.** In double precision the step equations have a relative error of about 10⁻¹⁵/(ωh)². For
  slow structures and steps below about 10 µs, rounding therefore exceeds the error of the method.
- **Some results are not compared**: those of contact laws that OpenSees lacks or defines differently, and the other tables of Zhang et al. (2019),
  because not all of their inputs are published.
- **None of the reference values is a measured impact.** Closed forms and other programs show that the equations are solved correctly, but not
  that they describe a real impact. Measured data are available from the following experiments, which have not been compared yet:
    - the moat-wall tests of report MCEER-13-0003 (DesignSafe, project NEES-2008-0571), in a layout that `jostle compare` reads;
    - the pounding tests of Khatami et al. (2019) and of Rashid and Abbas (2025);
    - the frame with bumper of Los Alamos National Laboratory.

    To compare a model with such a table, describe its columns in a [map](how-to/shake-table.md) and run
    `jostle compare model.toml test.asc --map map.toml --out compared`.
";

/// The page that lists the families.
#[must_use]
pub fn page(families: &[Family], extent: Extent) -> String {
    let rows = families
        .iter()
        .map(|family| family.rows.len())
        .sum::<usize>();
    let missed = misses(families).count();
    let known = families
        .iter()
        .flat_map(|family| &family.rows)
        .filter(|row| row.is_known_gap())
        .count();
    let option = if extent == Extent::Full {
        " -- --full"
    } else {
        ""
    };
    let agreeing = rows - missed - known;
    let others = match (missed, known) {
        (0, 0) => String::new(),
        (0, known) => format!("; the other {known} do not, for a known reason"),
        (missed, known) => format!("; {missed} do not, and {known} do not for a known reason"),
    };
    let mut page = format!(
        "# Validation\n\n\
         Results of jostle {version} are compared with closed forms, independent programs and the literature. {agreeing} of {rows} \
         numbers agree within their tolerance{others}. Each page below lists the numbers \
         of one family with their sources, errors and tolerances.\n\n\
         ## Families\n\n| family | numbers | outside the tolerance | known reason |\n|---|---:|---:|---:|\n",
        version = env!("CARGO_PKG_VERSION"),
    );
    for family in families {
        let miss = family.rows.iter().filter(|row| row.misses()).count();
        let known = family.rows.iter().filter(|row| row.is_known_gap()).count();
        put(
            &mut page,
            format_args!(
                "| [{}](validation/{}) | {} | {miss} | {known} |\n",
                family.title,
                file_name(family),
                family.rows.len()
            ),
        );
    }
    put(&mut page, format_args!("\n{ILL_CONDITIONED}"));
    page += "\n## Random models\n\n\
        The peaks of random models, run with every solver at several tolerances, are compared with an independent reference. The \
        figure shows the share of peaks whose error exceeds a given multiple of the tolerance. The tables are in [Accuracy on random \
        models](certify.md).\n\n\
        ![Share of peaks whose error exceeds a multiple of the tolerance](figures/certify.svg)\n";
    put(
        &mut page,
        format_args!(
            "\n## How these pages are made\n\nThe validation program writes them:\n\n\
             ```sh\ncargo run --release -p jostle-validation{option}\n```\n\n\
             `cargo test -p jostle-validation` checks every number. The expected numbers, their sources and their tolerances are in \
             `crates/jostle-validation/data`.\n"
        ),
    );
    page
}

/// The page of one family: every number with its source, error and tolerance.
#[must_use]
pub fn family_page(family: &Family) -> String {
    let mut page = format!(
        "# {}\n\n{}\n\nSee [Validation](../validation.md) for what to know before reading the table.\n\n",
        family.title, family.about
    );
    page += "| source | quantity | expected | got | error | tolerance | pass |\n|---|---|---:|---:|---:|---:|---|\n";
    for row in &family.rows {
        page += &line(row);
    }
    for row in family.rows.iter().filter(|row| row.is_known_gap()) {
        put(
            &mut page,
            format_args!("\n*{}*: {}.\n", row.quantity, row.known.unwrap_or_default()),
        );
    }
    page
}

/// File name of the page of a family: its title in lower case, with hyphens for all that is no letter or digit.
#[must_use]
pub fn file_name(family: &Family) -> String {
    let title = family.title.to_lowercase();
    let words = title.split(|letter: char| !letter.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    words.join("-") + ".md"
}

fn put(page: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = page.write_fmt(text);
}

fn line(row: &Row) -> String {
    let verdict = match (row.passed(), row.known) {
        (true, _) => "yes",
        (false, Some(_)) => "known",
        (false, None) => "**no**",
    };
    let unit = match row.tolerance {
        Tolerance::Relative(_) => "",
        Tolerance::Absolute(_) => " abs.",
    };
    format!(
        "| {} | {} | {} | {} | {}{unit} | {}{unit} | {verdict} |\n",
        row.source,
        row.quantity,
        readable(row.expected),
        readable(row.got),
        short(row.error),
        short(row.tolerance.limit()),
    )
}

/// Eight digits, plain where that is readable.
fn readable(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".to_owned();
    }
    if value.fract() == 0.0 && size < 1e7 {
        return format!("{value:.0}");
    }
    if !(1e-3..1e7).contains(&size) {
        return format!("{value:.7e}");
    }
    let before = size.log10().floor() as i32 + 1;
    let text = format!("{value:.*}", (8 - before).max(1) as usize);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Two digits.
fn short(value: f64) -> String {
    if value == 0.0 {
        "0".to_owned()
    } else {
        format!("{value:.1e}").replace(".0e", "e")
    }
}

/// One missed row as a line of text.
#[must_use]
pub fn missed_line(family: &Family, row: &Row) -> String {
    format!(
        "{}: {}: {}: expected {}, got {}, error {} > {}",
        family.title,
        row.source,
        row.quantity,
        readable(row.expected),
        readable(row.got),
        short(row.error),
        short(row.tolerance.limit()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_of_families_have_names_of_files() {
        let family = Family {
            title: "Frames, braces: and \"infills\" et al.",
            about: "",
            rows: Vec::new(),
        };
        assert_eq!(file_name(&family), "frames-braces-and-infills-et-al.md");
    }

    #[test]
    fn numbers_are_readable() {
        let cases = [
            (0.0, "0"),
            (23.0, "23"),
            (-0.001_234_567_89, "-0.0012345679"),
            (1_282_850.0, "1282850"),
            (67_524_545.485, "6.7524545e7"),
            (0.5, "0.5"),
            (1.5e-7, "1.5000000e-7"),
        ];
        for (value, text) in cases {
            assert_eq!(readable(value), text);
        }
        assert_eq!(short(1e-3), "1e-3");
        assert_eq!(short(3.14e-5), "3.1e-5");
    }
}
