//! Results as an Excel workbook: one table a sheet, names and units in its first two rows.

use std::collections::BTreeMap;

use jostle::results::registry::owners;
use jostle::results::summary::{ContactSummary, GapSummary, MotionSummary};
use jostle::{Quantity, Summary};
use jostle_io::{
    Values, building_columns, capacity_columns, contact_names, floor_columns, impact_columns,
    member_columns,
};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, Worksheet, XlsxError};

/// Title of the properties of every workbook, by which jostle knows its own.
pub(crate) const MARK: &str = "Results of jostle";
/// Widest column, in characters.
const WIDEST: f64 = 60.0;

/// The numbers of a run as the bytes of an Excel workbook (`.xlsx`): sheets `Summary`, `Buildings`, `Floors`, `Contacts` and
/// `Impacts`, where asked for `Members` and `Capacity`, and `Quantities` with the meaning of every column. Numbers are in SI. Absent
/// values are empty cells.
///
/// # Errors
/// Why the workbook cannot be made, such as more rows than Excel has.
pub fn workbook(summary: &Summary) -> Result<Vec<u8>, String> {
    write(summary).map_err(|error| error.to_string())
}

/// Columns of a table by name.
type Columns = Vec<(String, Values)>;

/// Columns that say where, which are no quantities.
const PLACES: [(&str, [&str; 2]); 3] = [
    ("left_floor", ["–", "floor of the left building"]),
    ("right_floor", ["–", "floor of the right building"]),
    (
        "struck_height_m",
        ["m", "height of the struck point; empty at ends"],
    ),
];

/// Unit and meaning of a quantity.
type Known = BTreeMap<&'static str, [&'static str; 2]>;

fn write(summary: &Summary) -> Result<Vec<u8>, XlsxError> {
    let mut book = Workbook::new();
    // The same run gives the same bytes.
    let date = ExcelDateTime::from_ymd(2000, 1, 1)?;
    let properties = DocProperties::new()
        .set_title(MARK)
        .set_subject(&summary.title)
        .set_creation_datetime(&date);
    book.set_properties(&properties);
    write_summary(book.add_worksheet().set_name("Summary")?, summary)?;
    let named = |columns: Vec<(&'static str, Values)>| {
        let columns = columns.into_iter();
        columns
            .map(|(name, values)| (name.to_owned(), values))
            .collect()
    };
    // Name of the sheet, key of its rows in summary.json, columns.
    let sheets: [(&str, &str, Columns); 6] = [
        ("Buildings", "buildings[]", building_columns(summary)),
        ("Floors", "buildings[].floors[]", floor_columns(summary)),
        ("Contacts", "gaps[].contacts[]", contact_columns(summary)),
        (
            "Impacts",
            "gaps[].contacts[].impacts[]",
            named(impact_columns(summary)),
        ),
        (
            "Members",
            "buildings[].members[].ends[]",
            named(member_columns(summary, None)),
        ),
        (
            "Capacity",
            "buildings[].members[].ratio",
            named(capacity_columns(summary, None)),
        ),
    ];
    let mut meanings: Vec<(&str, String, [&str; 2])> = Vec::new();
    for (name, key, columns) in sheets {
        let asked = !matches!(name, "Members" | "Capacity");
        if !asked && columns.first().is_none_or(|(_, values)| values.is_empty()) {
            continue;
        }
        let known = known(key);
        let described: Vec<[&'static str; 2]> = columns
            .iter()
            .map(|(column, values)| described(&known, column, values))
            .collect();
        write_table(book.add_worksheet().set_name(name)?, &columns, &described)?;
        for ((column, _), described) in columns.iter().zip(described) {
            meanings.push((name, column.clone(), described));
        }
    }
    write_meanings(book.add_worksheet().set_name("Quantities")?, &meanings)?;
    book.save_to_buffer()
}

/// Units and meanings of the quantities of this owner, and of others whose columns stand among its own.
fn known(key: &str) -> Known {
    let owners = owners();
    let (matching, others): (Vec<_>, Vec<_>) = owners.iter().partition(|owner| owner.key == key);
    let entries = others.into_iter().chain(matching);
    let entries = entries.flat_map(|owner| &owner.entries);
    entries
        .map(|entry| (entry.name, [entry.unit, entry.meaning]))
        .chain(PLACES)
        .collect()
}

/// Unit and meaning of a column: of a quantity, of the same without contact, or of their ratio.
fn described(known: &Known, column: &str, values: &Values) -> [&'static str; 2] {
    if matches!(values, Values::Text(_)) {
        return ["", ""];
    }
    if column.ends_with("_amplification") {
        return ["–", "with contact ÷ without contact, absolute values"];
    }
    let name = column.replace("_without_contact", "");
    let found = known.get(column).or_else(|| known.get(&name[..]));
    found.copied().unwrap_or(["–", ""])
}

/// One row for each contact, in the order of the gaps.
fn contact_columns(summary: &Summary) -> Columns {
    let contacts: Vec<(&GapSummary, &ContactSummary)> = summary
        .gaps
        .iter()
        .flat_map(|gap| gap.contacts.iter().map(move |contact| (gap, contact)))
        .collect();
    let floor = |side: usize| {
        let floors = contacts.iter().map(|(_, contact)| contact.floors[side]);
        Values::Whole(floors.map(|floor| i32::try_from(floor?).ok()).collect())
    };
    let mut columns = vec![
        ("contact".to_owned(), Values::Text(contact_names(summary))),
        ("left_floor".to_owned(), floor(0)),
        ("right_floor".to_owned(), floor(1)),
    ];
    for quantity in ContactSummary::QUANTITIES {
        let values = contacts.iter().map(|(_, contact)| quantity.value(contact));
        columns.push((quantity.name.to_owned(), Values::Instant(values.collect())));
    }
    columns
}

fn head() -> Format {
    Format::new().set_bold()
}

/// A table: names, units, and one row for each entry.
fn write_table(
    sheet: &mut Worksheet,
    columns: &[(String, Values)],
    described: &[[&'static str; 2]],
) -> Result<(), XlsxError> {
    for (column, ((name, values), [unit, _])) in (0..).zip(columns.iter().zip(described)) {
        sheet.write_string_with_format(0, column, name, &head())?;
        sheet.write_string(1, column, *unit)?;
        for row in 0..values.len() {
            let at = u32::try_from(row + 2).unwrap_or(u32::MAX);
            let number = match values {
                Values::Text(texts) => {
                    sheet.write_string(at, column, &texts[row])?;
                    continue;
                }
                // No sheet has bytes.
                Values::Bytes(_) => None,
                Values::Real(numbers) => Some(numbers[row]),
                Values::Instant(numbers) => numbers[row],
                Values::Whole(numbers) => numbers[row].map(f64::from),
            };
            if let Some(number) = number.filter(|number| number.is_finite()) {
                sheet.write_number(at, column, number)?;
            }
        }
        let widest = match values {
            Values::Text(texts) => texts.iter().map(|text| text.chars().count()).max(),
            _ => None,
        };
        let width = widest.unwrap_or(10).max(name.len()) as f64 + 2.0;
        sheet.set_column_width(column, width.min(WIDEST))?;
    }
    sheet.set_freeze_panes(2, 1)?;
    Ok(())
}

/// Name, value, unit and meaning of the numbers of the whole run, of the motion, the gaps and the energies.
fn write_summary(sheet: &mut Worksheet, summary: &Summary) -> Result<(), XlsxError> {
    let mut row = 0;
    for (name, text) in [
        ("title", &summary.title),
        ("jostle", &summary.jostle),
        ("motion", &summary.motion.name),
    ] {
        sheet.write_string_with_format(row, 0, name, &head())?;
        sheet.write_string(row, 1, text)?;
        row += 1;
    }
    row += 1;
    for (column, name) in (0..).zip(["quantity", "value", "unit", "meaning"]) {
        sheet.write_string_with_format(row, column, name, &head())?;
    }
    row += 1;
    write_quantities(sheet, &mut row, "", Summary::POUNDING, summary)?;
    write_quantities(sheet, &mut row, "", Summary::CHECKS, summary)?;
    write_quantities(
        sheet,
        &mut row,
        "motion.",
        MotionSummary::QUANTITIES,
        &summary.motion,
    )?;
    for gap in &summary.gaps {
        let name = format!("{}.", gap.between.join("-"));
        write_quantities(sheet, &mut row, &name, GapSummary::QUANTITIES, gap)?;
        write_quantities(sheet, &mut row, &name, GapSummary::WITHOUT_CONTACT, gap)?;
    }
    let energies = jostle::results::summary::EnergySummary::QUANTITIES;
    write_quantities(sheet, &mut row, "energy.", energies, &summary.energy)?;
    let promise = jostle::results::summary::PromiseSummary::QUANTITIES;
    write_quantities(sheet, &mut row, "promise.", promise, &summary.promise)?;
    for (name, texts) in [("warning", &summary.warnings), ("note", &summary.notes)] {
        for text in texts {
            row += 1;
            sheet.write_string_with_format(row, 0, name, &head())?;
            sheet.write_string(row, 1, text)?;
        }
    }
    for finding in &summary.checks {
        row += 1;
        sheet.write_string_with_format(row, 0, format!("check {}", finding.id), &head())?;
        sheet.write_string(row, 1, &finding.text)?;
    }
    for (column, width) in (0..).zip([44.0, 18.0, 10.0, WIDEST]) {
        sheet.set_column_width(column, width)?;
    }
    Ok(())
}

fn write_quantities<T>(
    sheet: &mut Worksheet,
    row: &mut u32,
    owner: &str,
    quantities: &[Quantity<T>],
    of: &T,
) -> Result<(), XlsxError> {
    for quantity in quantities {
        let Some(value) = quantity.value(of).filter(|value| value.is_finite()) else {
            continue;
        };
        sheet.write_string(*row, 0, format!("{owner}{}", quantity.name))?;
        sheet.write_number(*row, 1, value)?;
        sheet.write_string(*row, 2, quantity.unit.symbol)?;
        sheet.write_string(*row, 3, quantity.meaning)?;
        *row += 1;
    }
    Ok(())
}

/// What every column means.
fn write_meanings(
    sheet: &mut Worksheet,
    meanings: &[(&str, String, [&str; 2])],
) -> Result<(), XlsxError> {
    for (column, name) in (0..).zip(["sheet", "quantity", "unit", "meaning"]) {
        sheet.write_string_with_format(0, column, name, &head())?;
    }
    for (row, (table, name, [unit, meaning])) in (1..).zip(meanings) {
        for (column, text) in (0..).zip([*table, name, *unit, *meaning]) {
            sheet.write_string(row, column, text)?;
        }
    }
    for (column, width) in (0..).zip([12.0, 44.0, 10.0, WIDEST]) {
        sheet.set_column_width(column, width)?;
    }
    sheet.set_freeze_panes(1, 0)?;
    Ok(())
}
