//! What cannot be imported names the file, the object, and what would help; damaged files never panic.

use std::io::{Cursor, Write};

use jostle_import::{Direction, ImportOptions, Program, SourceFile, Way, import};
use jostle_testkit::scan::{Dice, scanned};

use crate::book::{Layout, Sheet, book, row, tried};
use crate::frames::{e2k, log, out, s2k};
use crate::tables::{definitions, masses};

/// Imports that must be refused, with words of the message.
#[track_caller]
fn refused(program: Program, files: &[(&str, &[u8])], options: &ImportOptions, words: &[&str]) {
    let error = tried(program, files, options).expect_err("this should be refused");
    for word in words {
        assert!(error.contains(word), "no \"{word}\" in\n{error}");
    }
}

fn text_model(replace: [&str; 2]) -> String {
    let text = e2k();
    assert!(text.contains(replace[0]), "{}", replace[0]);
    text.replacen(replace[0], replace[1], 1)
}

/// What not even matrices can be made of.
#[test]
fn members_without_stiffness_are_refused_with_what_helps() {
    let rectangle = "SHAPE \"Concrete Rectangular\"  D 500 B 500";
    let cases: [([&str; 2], &[&str]); 9] = [
        (
            [rectangle, "SHAPE \"CoreBRB_1.5_BoltedLug\""],
            &["column \"L0\"", "CoreBRB_1.5_BoltedLug", "unit loads"],
        ),
        (
            [rectangle, "SHAPE \"Auto Select List\""],
            &["auto-select", "assign the chosen sections"],
        ),
        (
            ["MATERIAL \"M30\"  SHAPE", "MATERIAL \"M99\"  SHAPE"],
            &["M99", "modulus"],
        ),
        (["DIAPH  \"D1\"", "DIAPH  \"D9\""], &["D9", "semi-rigid"]),
        (
            ["FLOOR  4", "PANEL  4"],
            &["wall \"F1\"", "no upright rectangle", "unit loads"],
        ),
        (
            ["RESTRAINT \"UX UY UZ RX RY RZ\"", "SPRINGPROP \"S1\""],
            &["point \"1-1\" of storey \"Base\"", "springs"],
        ),
        (
            ["CARDINALPT 5", "RELEASE \"TJ M9I\"CARDINALPT 5"],
            &["column \"L0\"", "M9I", "M3I"],
        ),
        (
            [
                "CARDINALPT 5",
                "LENGTHOFFI 2000 LENGTHOFFJ 2000 RIGIDZONE 1 CARDINALPT 5",
            ],
            &["column \"L0\"", "nothing between them", "shorten"],
        ),
        (
            [
                "LINE  \"L1\"  BEAM  \"1-1\"  \"2-1\"",
                "LINE  \"L1\"  BEAM  \"1-1\"  \"1-1\"",
            ],
            &["beam \"L1\"", "no length"],
        ),
    ];
    for (replace, words) in cases {
        let (text, out, log) = (text_model(replace), out(), log());
        let files = [
            ("A.e2k", text.as_bytes()),
            ("A.OUT", out.as_bytes()),
            ("A.LOG", log.as_bytes()),
        ];
        let options = ImportOptions {
            way: Some(Way::Members),
            ..ImportOptions::default()
        };
        refused(Program::Etabs, &files, &options, words);
    }
    // All feet pinned, and all columns of the lower storey hinged at their heads: they fall over.
    let text = e2k()
        .replace("\"UX UY UZ RX RY RZ\"", "\"UX UY UZ\"")
        .replace(
            "\"1\"  SECTION \"C",
            "\"1\"  RELEASE \"M2J M3J\" SECTION \"C",
        );
    let (out, log) = (out(), log());
    let files = [
        ("A.e2k", text.as_bytes()),
        ("A.OUT", out.as_bytes()),
        ("A.LOG", log.as_bytes()),
    ];
    refused(
        Program::Etabs,
        &files,
        &ImportOptions::default(),
        &["can move without resistance", "mechanism"],
    );
}

#[test]
fn text_models_that_are_not_regular_are_refused_with_what_helps() {
    let options = ImportOptions {
        way: Some(Way::Frame),
        ..ImportOptions::default()
    };
    let cases: [([&str; 2], &[&str]); 12] = [
        (
            ["CARDINALPT 5", "RELEASE \"TJ M2I\"CARDINALPT 5"],
            &["releases", "column \"L0\"", "unit force"],
        ),
        (
            [
                "SHAPE \"Concrete Rectangular\"  D 500 B 500",
                "SHAPE \"W14X500\"",
            ],
            &["W14X500", "catalogue", "unit force"],
        ),
        (
            [
                "SHAPE \"Concrete Rectangular\"  D 500 B 500",
                "SHAPE \"Auto Select List\"",
            ],
            &["auto-select", "assign the chosen sections"],
        ),
        (["DIAPH  \"D1\"", "DIAPH  \"D9\""], &["D9", "semi-rigid"]),
        (["FLOOR  4", "PANEL  4"], &["wall \"F1\"", "unit force"]),
        (
            ["\"UX UY UZ RX RY RZ\"", "\"UX UY UZ\""],
            &["point \"1-1\"", "not fixed"],
        ),
        (
            [
                "LINE  \"L0\"  COLUMN  \"1-1\"  \"1-1\"",
                "LINE  \"L0\"  COLUMN  \"1-1\"  \"2-2\"",
            ],
            &["neither vertical", "column \"L0\""],
        ),
        (
            [
                "LINE  \"L1\"  BEAM  \"1-1\"  \"2-1\"",
                "LINE  \"L1\"  BEAM  \"landing\"  \"landing\"",
            ],
            &["beam \"L1\"", "ends between storeys"],
        ),
        (
            ["UNITS  \"N\"  \"MM\"", "UNITS  \"KN\"  \"M\""],
            &["differ from those above"],
        ),
        (
            ["I2MOD 0.7 I3MOD 0.7", "I2MOD 0.7 I3MOD 0.6"],
            &["C1", "factors"],
        ),
        (
            [
                "SIMILARTO \"Roof slab\"  ",
                "\r\n  STORY \"Base 2\"  ELEV 3",
            ],
            &["second base", "several towers"],
        ),
        (
            ["POINT \"1-1\"", "POINT \"one\""],
            &["line", "does not have"],
        ),
    ];
    for (replace, words) in cases {
        let text = text_model(replace);
        let (out, log) = (out(), log());
        refused(
            Program::Etabs,
            &[
                ("A.e2k", text.as_bytes()),
                ("A.OUT", out.as_bytes()),
                ("A.LOG", log.as_bytes()),
            ],
            &options,
            words,
        );
    }
    let text = e2k();
    refused(
        Program::Etabs,
        &[("A.e2k", text.as_bytes())],
        &options,
        &["no floor masses", "Mass Summary by Diaphragm", ".OUT"],
    );
    refused(
        Program::Sap2000,
        &[("A.e2k", text.as_bytes())],
        &options,
        &["import etabs"],
    );
    refused(
        Program::Etabs,
        &[("A.EDB", b"")],
        &options,
        &["binary", ".e2k"],
    );
    refused(
        Program::Sap2000,
        &[("A.s2k", b"")],
        &options,
        &["PROGRAM CONTROL", "CurrUnits"],
    );
    // A storey of 3 m in a file in cm that names mm.
    let wrong = s2k().replace("Kgf, cm, C", "Kgf, mm, C");
    refused(
        Program::Sap2000,
        &[("A.s2k", wrong.as_bytes())],
        &options,
        &["has a height of 0.", " mm in the file", "check the units"],
    );
    let (out, log) = (out(), log());
    let alone = [
        ("A.OUT", out.as_bytes()),
        (
            "A.xlsx",
            &book(&[definitions(2)], Layout::Titled, false)[..],
        ),
    ];
    refused(
        Program::Etabs,
        &alone,
        &options,
        &["does not say its units", ".LOG"],
    );
    refused(
        Program::Etabs,
        &[("A.OUT", out.as_bytes()), ("A.LOG", log.as_bytes())],
        &options,
        &["no model by itself"],
    );
}

#[test]
fn workbooks_that_lack_something_are_refused_with_the_table_that_helps() {
    let x = ImportOptions {
        direction: Some(Direction::X),
        ..ImportOptions::default()
    };
    let tables = |sheets: &[Sheet]| book(sheets, Layout::Titled, false);
    let check = |sheets: &[Sheet], options: &ImportOptions, words: &[&str]| {
        refused(
            Program::Etabs,
            &[("A.xlsx", &tables(sheets))],
            options,
            words,
        );
    };
    check(
        &[definitions(3)],
        &x,
        &["A.xlsx", "no floor masses", "Mass Summary by Diaphragm"],
    );
    check(
        &[masses(3)],
        &x,
        &["no storey heights", "Story Definitions"],
    );
    check(
        &[definitions(3), masses(3)],
        &x,
        &[
            "no stiffness",
            "Diaphragm Center Of Mass Displacements",
            "Story Stiffness",
        ],
    );
    check(
        &[definitions(3), masses(3)],
        &ImportOptions::default(),
        &["in space is not possible", "--direction x"],
    );
    check(
        &[definitions(2), masses(3)],
        &x,
        &["\"Story3\"", "none of the storeys"],
    );
    let mut towers = definitions(3);
    towers.rows[0][0] = "T2".into();
    check(&[towers, masses(3)], &x, &["several towers", "T2"]);
    let mut parts = masses(3);
    parts
        .rows
        .push(row(&["Story1", "D2"], &[1.0, 1.0, 1.0, 0.0, 0.0]));
    check(
        &[definitions(3), parts.clone()],
        &x,
        &["D1 and D2", "--diaphragm"],
    );
    check(
        &[definitions(3), parts],
        &ImportOptions {
            diaphragm: Some("d1".into()),
            ..x.clone()
        },
        &["no stiffness"],
    );
    let mut unit = masses(3);
    unit.columns[2].1 = "parsec";
    check(
        &[definitions(3), unit],
        &x,
        &["Mass Summary by Diaphragm, column \"massx\"", "parsec"],
    );
    let mut word = masses(3);
    word.rows[1][2] = "many".into();
    check(&[definitions(3), word], &x, &["row 5", "many"]);
    // Flexibilities that are not symmetric, and without digits.
    let displacements = |by: [f64; 4], case: &str| {
        let rows = (0..4)
            .map(|at| {
                row(
                    &[
                        ["Story1", "Story2"][at / 2],
                        "D1",
                        &format!("{case} {}", ["Story1", "Story2"][at % 2]),
                    ],
                    &[by[at], 0.0, 0.0],
                )
            })
            .collect();
        Sheet::new(
            "Diaphragm Center Of Mass Displacements",
            &[
                ("Story", ""),
                ("Diaphragm", ""),
                ("Load Case/Combo", ""),
                ("UX", "mm"),
                ("UY", "mm"),
                ("RZ", "rad"),
            ],
            rows,
        )
    };
    let unit = ImportOptions {
        unit_force: Some(1e6),
        ..x.clone()
    };
    check(
        &[
            definitions(2),
            masses(2),
            displacements([1.0, 1.0, 2.0, 3.0], "FX"),
        ],
        &unit,
        &["not symmetric"],
    );
    check(
        &[
            definitions(2),
            masses(2),
            displacements([1.0, 1.0, 1.0, 1.0], "FX"),
        ],
        &unit,
        &["not positive definite", "mm"],
    );
    check(
        &[
            definitions(2),
            masses(2),
            displacements([1.0, 1.0, 1.0, 2.0], "FX"),
        ],
        &x,
        &["--unit-force"],
    );
    refused(
        Program::Etabs,
        &[(
            "A.xlsx",
            &book(&[definitions(2), masses(2)], Layout::Bare, false),
        )],
        &x,
        &["has no unit", "--units"],
    );
    refused(
        Program::Etabs,
        &[("A.xlsx", b"PK")],
        &x,
        &["A.xlsx", "no Excel workbook"],
    );
    refused(
        Program::Etabs,
        &[("A.xlsx", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1")],
        &x,
        &["Excel 97"],
    );
}

/// Half a gigabyte of zeros in half a megabyte.
#[test]
fn archives_that_inflate_without_end_are_refused() {
    let mut bomb = Cursor::new(Vec::new());
    let mut archive = rawzip::ZipArchiveWriter::new(&mut bomb);
    let (mut entry, config) = archive
        .new_file("xl/sharedStrings.xml")
        .compression_method(rawzip::CompressionMethod::DEFLATE)
        .start()
        .expect("starts");
    let encoder = flate2::write::DeflateEncoder::new(&mut entry, flate2::Compression::best());
    let mut writer = config.wrap(encoder);
    let zeros = vec![0; 1 << 20];
    for _ in 0..300 {
        writer.write_all(&zeros).expect("writes");
    }
    let (encoder, output) = writer.finish().expect("finishes");
    encoder.finish().expect("finishes");
    entry.finish(output).expect("finishes");
    archive.finish().expect("finishes");
    let bytes = bomb.into_inner();
    assert!(bytes.len() < 1 << 20);
    refused(
        Program::Etabs,
        &[("A.xlsx", &bytes)],
        &ImportOptions::default(),
        &["inflates to more than"],
    );
}

/// Mutated files give a model or a message.
#[test]
fn damaged_files_never_panic() {
    let mut dice = Dice::new(52);
    let (model, sap, out, log) = (e2k(), s2k(), out(), log());
    let mut sheets = vec![definitions(3), masses(3)];
    sheets.push(Sheet::new(
        "Story Stiffness",
        &[
            ("Story", ""),
            ("Output Case", ""),
            ("Stiff X", "kN/m"),
            ("Stiff Y", "kN/m"),
        ],
        (0..3)
            .map(|index| row(&[&format!("Story{}", index + 1), "EX"], &[1e5, 1e5]))
            .collect(),
    ));
    let workbook = book(&sheets, Layout::Titled, false);
    let options = ImportOptions {
        direction: Some(Direction::X),
        ..ImportOptions::default()
    };
    for _ in 0..scanned(300) {
        let [model, out, log] = [&model, &out, &log].map(|text| {
            if dice.below(2) == 0 {
                dice.damage(text.as_bytes())
            } else {
                text.clone().into_bytes()
            }
        });
        let files = [("A.e2k", &model), ("A.OUT", &out), ("A.LOG", &log)]
            .map(|(name, bytes)| SourceFile { name, bytes });
        let _ = import(Program::Etabs, &files, &ImportOptions::default());
        let sap = dice.damage(sap.as_bytes());
        let _ = import(
            Program::Sap2000,
            &[SourceFile {
                name: "A.s2k",
                bytes: &sap,
            }],
            &ImportOptions::default(),
        );
        // Once the archive, once the cells of its tables.
        let bytes = dice.damage(&workbook);
        let _ = import(
            Program::Etabs,
            &[SourceFile {
                name: "A.xlsx",
                bytes: &bytes,
            }],
            &options,
        );
        let mut damaged = sheets.clone();
        let sheet = dice.below(damaged.len());
        let at = dice.below(damaged[sheet].rows.len());
        let column = dice.below(damaged[sheet].rows[at].len());
        let cell = &mut damaged[sheet].rows[at][column];
        *cell = String::from_utf8_lossy(&dice.damage(cell.as_bytes()))
            .chars()
            .filter(|c| !c.is_control())
            .take(1000)
            .collect();
        let bytes = book(&damaged, Layout::Titled, dice.below(2) == 0);
        let _ = import(
            Program::Etabs,
            &[SourceFile {
                name: "A.xlsx",
                bytes: &bytes,
            }],
            &options,
        );
    }
}
