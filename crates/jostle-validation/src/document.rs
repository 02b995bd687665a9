//! The page `docs/validation.md`, and one page for each family in `docs/validation/`.

use std::fmt::Write;

use crate::row::{Row, Tolerance};
use crate::{Extent, Family, misses};

const ILL_CONDITIONED: &str = "\
## What to know before reading the tables

- **Impact sequences are sensitive.** A small change in timing can alter all later impacts, and a grazing impact may or may not happen.
  Early impacts, peaks, impulses and energies are compared; the number of impacts must be equal, and
  may differ by one where grazing impacts occur.
- **Many frequencies of a frame lie close together**. Frequencies are therefore compared, single mode shapes are not.
- **Two closed forms are compared with time steps.** Their rows show the error of the step, not of the formula; each row
  states the step.
- **A row marked *known*** does not agree within its tolerance; the reason is given below its table. All of them are the
  same grazing impact of 10 kN, beside impacts of 190 kN.
- **Below some step size accuracy stops improving.** In double precision the step equations have a relative error of about
  10⁻¹⁵/(ωh)². Below about 10 µs rounding therefore exceeds the error of the method for slow structures.
- **Not compared**: contact laws that OpenSees lacks or defines differently; the tables of Zhang et al. (2019), whose
  inputs are not available.
- **None of these numbers is a measured impact.** Mathematics and other programs show that the equations are solved right, not that
  they are the right equations. Public experiments that would serve: the moat-wall tests of report MCEER-13-0003 (DesignSafe,
  project NEES-2008-0571), in the layout that `jostle compare` reads; the pounding tests of Khatami et al. (2019) and of Rashid and
  Abbas (2025); the frame with bumper of Los Alamos National Laboratory. With such a table and a [map of its
  columns](how-to/shake-table.md): `jostle compare model.toml test.asc --map map.toml --out compared`.
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
    let mut page = format!(
        "# Validation\n\n\
         jostle {version} compared with closed forms, independent programs and the literature: {rows} numbers, of which {} agree \
         within their tolerance, {missed} miss and {known} differ for a known reason.\n\n\
         ## Families\n\n| family | numbers | miss | known |\n|---|---:|---:|---:|\n",
        rows - missed - known,
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
        Every peak of random models that the tolerance covers, and the closings and forces of links, are compared with an \
        independent reference. The figure shows \
        the share of peaks whose error exceeds a multiple of the tolerance; the tables are in [Accuracy on random models](certify.md).\n\n\
        ![Share of peaks whose error exceeds a multiple of the tolerance](figures/certify.svg)\n";
    put(
        &mut page,
        format_args!(
            "\n## How these pages are made\n\nThey are written by\n\n\
             ```sh\ncargo run --release -p jostle-validation{option}\n```\n\n\
             and checked by `cargo test -p jostle-validation`. The expected numbers, their sources and their tolerances are in \
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
