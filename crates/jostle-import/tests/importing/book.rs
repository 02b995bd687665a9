//! Workbooks and texts of the grammar of ETABS and SAP2000.

use jostle::System;
use jostle::eigen;
use jostle_import::{ImportOptions, Imported, Program, SourceFile, import};
use jostle_io::{Format, Input, read_model_text};
use rust_xlsxwriter::Workbook;

/// How a table begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Layout {
    /// `TABLE:  Story Definitions`, names, units.
    Titled,
    /// `TABLE:  "STORY DEFINITIONS"`, names, units.
    Quoted,
    /// Names, and no units.
    Bare,
}

/// A table: sheet, title, columns with units, rows.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    pub(crate) title: String,
    pub(crate) columns: Vec<(&'static str, &'static str)>,
    pub(crate) rows: Vec<Vec<String>>,
}

impl Sheet {
    pub(crate) fn new(
        title: &str,
        columns: &[(&'static str, &'static str)],
        rows: Vec<Vec<String>>,
    ) -> Self {
        Self {
            title: title.into(),
            columns: columns.to_vec(),
            rows,
        }
    }
}

/// A workbook of these tables. With commas, numbers are texts with decimal commas.
pub(crate) fn book(sheets: &[Sheet], layout: Layout, commas: bool) -> Vec<u8> {
    let mut book = Workbook::new();
    for sheet in sheets {
        let page = book.add_worksheet();
        let name: String = sheet.title.chars().take(31).collect();
        let _ = page.set_name(&name);
        let mut row = 0;
        let mut line = |cells: Vec<String>, numbers: bool| {
            for (column, cell) in cells.into_iter().enumerate() {
                let column = u16::try_from(column).expect("few columns");
                match cell.parse::<f64>() {
                    Ok(value) if numbers && !commas && value.is_finite() => {
                        page.write(row, column, value)
                    }
                    Ok(_) if numbers && commas => page.write(row, column, cell.replace('.', ",")),
                    _ => page.write(row, column, cell),
                }
                .expect("a cell");
            }
            row += 1;
        };
        match layout {
            Layout::Titled => line(vec![format!("TABLE:  {}", sheet.title)], false),
            Layout::Quoted => line(
                vec![format!("TABLE:  \"{}\"", sheet.title.to_uppercase())],
                false,
            ),
            Layout::Bare => {}
        }
        line(
            sheet
                .columns
                .iter()
                .map(|column| column.0.to_owned())
                .collect(),
            false,
        );
        if layout != Layout::Bare {
            line(
                sheet
                    .columns
                    .iter()
                    .map(|column| column.1.to_owned())
                    .collect(),
                false,
            );
        }
        for row in &sheet.rows {
            line(row.clone(), true);
        }
    }
    book.save_to_buffer().expect("a workbook")
}

/// Cells of a row.
pub(crate) fn row(texts: &[&str], numbers: &[f64]) -> Vec<String> {
    let texts = texts.iter().map(|text| (*text).to_owned());
    texts
        .chain(numbers.iter().map(|number| format!("{number}")))
        .collect()
}

/// Imports and checks that nothing is refused.
#[track_caller]
pub(crate) fn imported(
    program: Program,
    files: &[(&str, &[u8])],
    options: &ImportOptions,
) -> Imported {
    tried(program, files, options).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn tried(
    program: Program,
    files: &[(&str, &[u8])],
    options: &ImportOptions,
) -> Result<Imported, String> {
    let files: Vec<SourceFile<'_>> = files
        .iter()
        .map(|(name, bytes)| SourceFile { name, bytes })
        .collect();
    import(program, &files, options).map_err(|error| error.to_string())
}

/// Reads the written model.
#[track_caller]
pub(crate) fn model(imported: &Imported) -> Input {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in &imported.files {
        std::fs::write(folder.path().join(name), bytes).expect("a file");
    }
    read_model_text("model.toml", &imported.toml, Format::Toml, folder.path())
        .unwrap_or_else(|error| panic!("{error}\nin\n{}", imported.toml))
}

/// Periods of the first building \[s\].
#[track_caller]
pub(crate) fn periods(input: &Input, count: usize) -> Vec<f64> {
    let system = System::assemble(&input.model).expect("sound");
    let modes = eigen::modes(system.buildings[0].alone(), count).expect("modes");
    modes.iter().map(eigen::Mode::period).collect()
}

/// The greatest relative difference of two lists of one length.
#[track_caller]
pub(crate) fn difference(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    found
        .iter()
        .zip(expected)
        .map(|(a, b)| (a / b - 1.0).abs())
        .fold(0.0, f64::max)
}
