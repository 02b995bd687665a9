//! What changes the periods of a source is in the building, is named with its consequence, or is refused.

use jostle_import::{ImportOptions, Imported, Program, Way};
use jostle_testkit::files::sound;

use crate::book::{difference, imported, model, periods, tried};
use crate::frames::{EXPECTED, e2k, log, out, s2k};
use crate::tables::MOTION;

fn etabs(text: &str, options: &ImportOptions) -> Result<Imported, String> {
    let (out, log) = (out(), log());
    let files = [
        ("A.e2k", text.as_bytes()),
        ("A.OUT", out.as_bytes()),
        ("A.LOG", log.as_bytes()),
    ];
    let bytes = files.map(|(name, bytes)| jostle_import::SourceFile { name, bytes });
    jostle_import::import(Program::Etabs, &bytes, options).map_err(|error| error.to_string())
}

fn sap2000(text: &str, options: &ImportOptions) -> Result<Imported, String> {
    tried(Program::Sap2000, &[("A.s2k", text.as_bytes())], options)
}

fn plain() -> ImportOptions {
    ImportOptions::default()
}

fn members() -> ImportOptions {
    ImportOptions {
        way: Some(Way::Members),
        ..plain()
    }
}

fn tower(name: &str) -> ImportOptions {
    ImportOptions {
        diaphragm: Some(name.into()),
        ..plain()
    }
}

#[track_caller]
fn is_the_frame(found: Result<Imported, String>) -> Imported {
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    let expected = periods(&sound(&format!("{MOTION}{EXPECTED}")), 6);
    let off = difference(&periods(&model(&found), 6), &expected);
    assert!(off < 1e-6, "{off:.1e}\n{}", found.toml);
    found
}

#[track_caller]
fn says(found: Result<Imported, String>, words: &[&str]) {
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    let all = found.left_out.join("\n");
    for word in words {
        assert!(all.contains(word), "no \"{word}\" in\n{all}");
    }
}

#[track_caller]
fn refused(found: Result<Imported, String>, words: &[&str]) {
    let error = found
        .map(|found| found.toml)
        .expect_err("this should be refused");
    for word in words {
        assert!(error.contains(word), "no \"{word}\" in\n{error}");
    }
}

/// Replaces all, of which there must be some.
#[track_caller]
fn replaced(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "no \"{from}\"");
    text.replace(from, to)
}

/// A row of a table of SAP2000, in a new table or before the others.
fn with_row(text: &str, table: &str, row: &str) -> String {
    let title = format!("TABLE:  \"{table}\"\n");
    match text.contains(&title) {
        true => text.replace(&title, &format!("{title}   {row}\n")),
        false => {
            let end = "END TABLE DATA";
            text.replace(end, &format!("{title}   {row}\n \n{end}"))
        }
    }
}

/// Factors of members in place of those of their sections, and a share in each.
#[test]
fn factors_of_members_are_those_of_sections() {
    for share in [1.0, 0.5] {
        let (mut text, mut tables) = (e2k(), s2k());
        // Torsion 0.1, bending 0.7 in columns and 0.35 in beams.
        for bend in [0.7, 0.35] {
            let [torsion, section] = [0.1, bend].map(|factor: f64| factor.powf(1.0 - share));
            text = replaced(
                &text,
                &format!("JMOD 0.1 I2MOD {bend} I3MOD {bend}"),
                &format!("JMOD {torsion} I2MOD {section} I3MOD {section}"),
            );
            tables = replaced(
                &tables,
                &format!("JMod=0.1   I2Mod={bend}   I3Mod={bend}"),
                &format!("JMod={torsion}   I2Mod={section}   I3Mod={section}"),
            );
        }
        let of_member = |is_column: bool| {
            let bend: f64 = if is_column { 0.7 } else { 0.35 };
            [0.1_f64.powf(share), bend.powf(share)]
        };
        for name in ["C1", "C 400*700", "B1", "B2"] {
            let [torsion, bend] = of_member(name.starts_with('C'));
            text = replaced(
                &text,
                &format!("SECTION \"{name}\""),
                &format!(
                    "PROPMODT {torsion} PROPMODI22 {bend} PROPMODI33 {bend} SECTION \"{name}\""
                ),
            );
        }
        let assigned = tables.lines().filter(|line| line.contains("AnalSect="));
        let rows: Vec<String> = assigned
            .map(|line| {
                let frame = line.split_whitespace().next().expect("a frame");
                let is_column = line.contains("AnalSect=C") || line.contains("AnalSect=\"C");
                let [torsion, bend] = of_member(is_column);
                format!("{frame}   AMod=1   AS2Mod=1   AS3Mod=1   JMod={torsion}   I22Mod={bend}   I33Mod={bend}   MassMod=1   WeightMod=1")
            })
            .collect();
        let tables = with_row(&tables, "FRAME PROPERTY MODIFIERS", &rows.join("\n   "));
        for found in [etabs(&text, &plain()), sap2000(&tables, &plain())] {
            let found = is_the_frame(found);
            assert!(found.toml.contains("space-frame"));
        }
    }
}

/// A material of members in place of that of their section.
#[test]
fn materials_of_members_are_those_of_sections() {
    let text = replaced(&e2k(), "MATERIAL \"M25\"  SHAPE", "MATERIAL \"M30\"  SHAPE");
    let text = replaced(&text, "\"B2\"CARD", "\"B2\" MATERIALOVERWRITE \"M25\"CARD");
    is_the_frame(etabs(&text, &plain()));
    let text = replaced(&s2k(), "Material=M25   Shape", "Material=M30   Shape");
    let text = replaced(&text, "=B2   MatProp=Default", "=B2   MatProp=M25");
    is_the_frame(sap2000(&text, &plain()));
}

/// Poisson's ratio by the modulus of shear, E = 2 G (1 + ν).
#[test]
fn a_modulus_of_shear_gives_the_ratio_of_poisson() {
    let mut text = s2k();
    for modulus in [30e9, 25e9] {
        let modulus = modulus / 98_066.5;
        let pair = format!("E1={modulus:.9}   U12=0.2");
        text = replaced(
            &text,
            &pair,
            &format!("E1={modulus:.9}   G12={}", modulus / 2.4),
        );
    }
    is_the_frame(sap2000(&text, &plain()));
}

/// The row of the last line of columns in a system with an origin of its own and a turn; rows that are continued with blanks behind.
#[test]
fn coordinate_systems_and_continued_rows() {
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let lines = s2k();
    let lines = lines.lines().map(|line| {
        if !(line.contains("CoordType=") && line.contains("XorR=1100 ")) {
            return format!("{line}\n");
        }
        let value = |name: &str| {
            let word = line.split_whitespace().find_map(|word| word.strip_prefix(name));
            word.expect(name).parse::<f64>().expect("a number")
        };
        let [x, y, z] = [value("XorR=") - 300.0, value("Y=") + 40.0, value("Z=") - 10.0];
        format!(
            "   Joint={}   CoordSys=CSYS1   CoordType=Cartesian   XorR={}   Y={}   Z={z}   SpecialJt=No\n",
            value("Joint="),
            cos * x + sin * y,
            cos * y - sin * x
        )
    });
    let text: String = lines.collect();
    refused(
        sap2000(&text, &plain()),
        &["joint 60", "CSYS1", "COORDINATE SYSTEMS"],
    );
    let system = |turn: &str| {
        let row = format!(
            "Name=CSYS1   Type=Cartesian   X=300   Y=-40   Z=10   AboutZ=30   AboutY=0   AboutX={turn}"
        );
        with_row(&text, "COORDINATE SYSTEMS", &row)
    };
    is_the_frame(sap2000(&system("0"), &plain()));
    refused(
        sap2000(&system("1"), &plain()),
        &["joint 60", "turn about Z alone"],
    );
    is_the_frame(sap2000(&replaced(&s2k(), " _\n", " _  \r\n"), &plain()));
}

/// The frame with areas of sections by their sizes.
fn by_sizes() -> String {
    replaced(&s2k(), "Area=1   ", "")
}

/// Two towers in one file: the frame, and the same 40 m beside it with diaphragms and joints of its own.
fn two_towers() -> String {
    let mut found = String::new();
    let mut table = String::new();
    for line in by_sizes().lines() {
        found += &format!("{line}\n");
        if let Some(name) = line.strip_prefix("TABLE:") {
            name.trim().clone_into(&mut table);
        }
        let doubled = ["JOINT", "FRAME", "CONSTRAINT"]
            .iter()
            .any(|word| table.contains(word))
            && !table.contains("PROPERTIES");
        if !doubled || !line.contains('=') {
            continue;
        }
        let words = line.split("   ").map(|word| {
            let (name, value) = word.split_once('=').unwrap_or((word, ""));
            let more = |by: f64| {
                value
                    .parse::<f64>()
                    .map(|value| format!("{name}={}", value + by))
            };
            match name {
                "Joint" | "JointI" | "JointJ" | "Frame" => more(5000.0).expect("a number"),
                "XorR" => more(4000.0).expect("a number"),
                "Name" | "Constraint" => word.replace("D2", "D4").replace("D1", "D3"),
                _ => word.to_owned(),
            }
        });
        found += &format!("{}\n", words.collect::<Vec<_>>().join("   "));
    }
    found
}

#[test]
fn towers_are_not_merged() {
    let text = two_towers();
    let several = &[
        "height 4.000 m",
        "D1 and D3",
        "several towers",
        "--diaphragm",
    ];
    refused(sap2000(&text, &plain()), several);
    for name in ["D1", "d2", "D3", "D4"] {
        let found = is_the_frame(sap2000(&text, &tower(name)));
        assert!(found.toml.contains("16 columns"), "{}", found.toml);
        says(Ok(found), &["36 members and walls that are not connected"]);
        is_the_frame(sap2000(
            &text,
            &ImportOptions {
                way: Some(Way::Members),
                ..tower(name)
            },
        ));
    }
    refused(
        sap2000(&text, &tower("D9")),
        &["D9", "none of its diaphragms, D1, D2, D3, D4"],
    );
    // A bridge between two joints of the towers.
    let bridge = with_row(
        &text,
        "CONNECTIVITY - FRAME",
        "Frame=9000   JointI=61   JointJ=5001",
    );
    refused(
        sap2000(&bridge, &tower("D1")),
        &["D1 and D3", "bridge", "a model of its own"],
    );
    // A tie at the feet, which the ground holds, is none.
    let tie = with_row(
        &text,
        "CONNECTIVITY - FRAME",
        "Frame=9000   JointI=60   JointJ=5000",
    );
    let tie = with_row(
        &tie,
        "FRAME SECTION ASSIGNMENTS",
        "Frame=9000   AnalSect=B1",
    );
    is_the_frame(sap2000(&tie, &tower("D3")));
}

/// The same in ETABS, where storeys hold both towers, and masses come from a listing with both.
#[test]
fn towers_of_etabs_are_not_merged() {
    let text = e2k();
    let mut doubled = String::new();
    let shifted = |line: &str| {
        // Names of points and lines in quotes: those of the second tower begin with T.
        let mut line = line.replace("\"L", "\"TL");
        for x in 1..=3 {
            for y in 1..=3 {
                line = line.replace(&format!("\"{x}-{y}\""), &format!("\"T{x}-{y}\""));
            }
        }
        for name in ["landing", "low 1", "low 2"] {
            line = line.replace(&format!("\"{name}\""), &format!("\"T{name}\""));
        }
        line
    };
    for line in text.lines() {
        doubled += &format!("{line}\r\n");
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.first() {
            Some(&"POINT") => {
                let (name, rest) = line.rsplit_once('"').expect("a name");
                let mut numbers: Vec<f64> = rest
                    .split_whitespace()
                    .map(|word| word.parse().expect("a number"))
                    .collect();
                numbers[1] += 30_000.0;
                let numbers: Vec<String> = numbers.iter().map(f64::to_string).collect();
                doubled += &format!(
                    "{}\"  {}\r\n",
                    shifted(&format!("{name}\"")).trim_end_matches('"'),
                    numbers.join(" ")
                );
            }
            Some(&("LINE" | "LINEASSIGN" | "POINTASSIGN")) => {
                doubled += &format!("{}\r\n", shifted(line));
            }
            _ => {}
        }
        if line.starts_with("$ POINT ASSIGNS") {
            for story in ["1", "Roof slab"] {
                for x in 1..=3 {
                    for y in 1..=3 {
                        for (tower, floor) in [("", "D1"), ("T", "D2")] {
                            doubled += &format!(
                                "  POINTASSIGN  \"{tower}{x}-{y}\"  \"{story}\"  DIAPH \"{floor}\"\r\n"
                            );
                        }
                    }
                }
            }
        }
    }
    let text = doubled.replace(
        "DIAPHRAGM \"D9\"",
        "DIAPHRAGM \"D2\" TYPE RIGID\r\n  DIAPHRAGM \"D9\"",
    );
    refused(
        etabs(&text, &plain()),
        &["height 2.500 m", "D1 and D2", "--diaphragm"],
    );
    // Floors of both, 30 m apart along Y.
    let second = out()
        .replace(
            "4.300000    4.300000    4.300000",
            "34.300000    34.300000    34.300000",
        )
        .replace(
            "4.400000    4.400000    4.400000",
            "34.400000    34.400000    34.400000",
        );
    let (both, log) = (out() + &second, log());
    for name in ["D1", "D2"] {
        let files = [
            ("A.e2k", text.as_bytes()),
            ("A.OUT", both.as_bytes()),
            ("A.LOG", log.as_bytes()),
        ];
        is_the_frame(Ok(imported(Program::Etabs, &files, &tower(name))));
    }
    refused(
        etabs(&e2k().replace("DIAPH  \"D1\"", ""), &tower("D1")),
        &["no point or area"],
    );
}

/// Joints that no rigid floor holds are free of it, in every way and in both programs. Periods by a direct-stiffness program in numpy
/// that shares no code with jostle: two storeys of 4 and 3.5 m on 6 columns, of which those at y = 5 m are not held at the floors.
#[test]
fn joints_without_a_diaphragm_are_free() {
    let solved = include_str!("free_joints.txt");
    let expected: Vec<f64> = solved
        .lines()
        .filter(|line| !line.starts_with('#'))
        .flat_map(|line| {
            line.split_whitespace()
                .map(|word| word.parse().expect("a number"))
        })
        .collect();
    for options in [plain(), members()] {
        let found = sap2000(include_str!("free_joints.s2k"), &options)
            .unwrap_or_else(|error| panic!("{error}"));
        let off = difference(&periods(&model(&found), 6), &expected);
        assert!(off < 1e-8, "{off:.1e}");
        assert!(
            options.way.is_some()
                || found
                    .remarks
                    .iter()
                    .any(|remark| remark.contains("does not move with the rigid floor")),
            "{:?}",
            found.remarks
        );
    }
    // In ETABS by assignment.
    let free = ["1-1", "1-2", "1-3"]
        .map(|point| {
            ["1", "Roof slab"]
                .map(|story| {
                    format!("  POINTASSIGN  \"{point}\"  \"{story}\"  DIAPH DISCONNECTED\r\n")
                })
                .concat()
        })
        .concat();
    let text = replaced(
        &e2k(),
        "$ POINT ASSIGNS\r\n",
        &format!("$ POINT ASSIGNS\r\n{free}"),
    );
    let free_in_sap: String = by_sizes()
        .lines()
        .filter(|line| {
            !(line.contains("Constraint=D")
                && [
                    "Joint=1 ",
                    "Joint=2 ",
                    "Joint=11 ",
                    "Joint=12 ",
                    "Joint=21 ",
                    "Joint=22 ",
                ]
                .iter()
                .any(|joint| line.contains(joint)))
        })
        .map(|line| format!("{line}\n"))
        .collect();
    let of = |found: Result<Imported, String>| {
        periods(&model(&found.unwrap_or_else(|error| panic!("{error}"))), 6)
    };
    let (auto, by_members, sap) = (
        of(etabs(&text, &plain())),
        of(etabs(&text, &members())),
        of(sap2000(&free_in_sap, &plain())),
    );
    assert!(difference(&auto, &by_members) < 1e-12);
    assert!(difference(&auto, &sap) < 1e-4, "{auto:?} {sap:?}");
}

/// Masses that floors do not hold, that differ, or that are elsewhere.
#[test]
fn masses_are_whole_or_refused() {
    let row = |table: &str, row: &str| with_row(&s2k(), table, row);
    let between = row(
        "JOINT COORDINATES",
        "Joint=990   CoordSys=GLOBAL   CoordType=Cartesian   XorR=100   Y=100   Z=200",
    );
    let between = with_row(
        &between,
        "JOINT ADDED MASS ASSIGNMENTS",
        "Joint=990   Mass1=10   Mass2=10",
    );
    // 10 kgf·s²/cm.
    refused(
        sap2000(&between, &plain()),
        &[
            "joint 990",
            "9.807 t beside 175.000 t",
            "no diaphragm holds",
        ],
    );
    // On a support they do not move.
    is_the_frame(sap2000(
        &row(
            "JOINT ADDED MASS ASSIGNMENTS",
            "Joint=10   Mass1=10   Mass2=10",
        ),
        &plain(),
    ));
    let across = replaced(&s2k(), "Mass2=", "Mass2=0   Mass3=");
    refused(
        sap2000(&across, &plain()),
        &["different masses along X and Y"],
    );
    for (table, text) in [
        ("FRAME ADDED MASS ASSIGNMENTS", "Frame=1   MassPerLen=2"),
        (
            "JOINT ADDED MASS BY WEIGHT ASSIGNMENTS",
            "Joint=1   Wt1=100",
        ),
        ("AREA ADDED MASS ASSIGNMENTS", "Area=1   MassPerArea=2"),
    ] {
        refused(
            sap2000(&row(table, text), &plain()),
            &["masses are on frames or areas, or by weight", ".OUT"],
        );
    }
    let older = |from: &str| {
        let text = s2k().replace("TABLE:  \"MASS SOURCE\"\n   MassSource=MSSSRC1   Elements=No   Masses=Yes   Loads=No   IsDefault=Yes", &format!("TABLE:  \"MASSES 1 - MASS SOURCE\"\n   MassFrom={from}"));
        sap2000(&text, &plain())
    };
    is_the_frame(older("Masses"));
    refused(older("Loads"), &["masses from elements or loads", ".OUT"]);
}

/// Floors, springs and members that cannot be what jostle has.
#[test]
fn what_would_be_meaningless_is_refused() {
    for (table, row, words) in [
        (
            "JOINT SPRING ASSIGNMENTS 2 - COUPLED",
            "Joint=1   U1=1000",
            ["joint 1", "springs"],
        ),
        (
            "FRAME SPRING ASSIGNMENTS",
            "Frame=1   Stiffness=1000",
            ["frame 1", "springs"],
        ),
        (
            "AREA SPRING ASSIGNMENTS",
            "Area=7   Stiffness=1000",
            ["area 7", "springs"],
        ),
        (
            "FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY",
            "Frame=3   M3I=1000",
            ["frame 3", "partly fixed"],
        ),
    ] {
        refused(sap2000(&with_row(&s2k(), table, row), &plain()), &words);
    }
    let upright = replaced(&s2k(), "Axis=Z", "Axis=X");
    refused(
        sap2000(&upright, &plain()),
        &["diaphragm \"D1\"", "upright"],
    );
    let one = replaced(&s2k(), "Constraint=D2", "Constraint=D1");
    refused(
        sap2000(&one, &plain()),
        &["diaphragm \"D1\"", "several heights"],
    );
    let sprung = replaced(&e2k(), "CARDINALPT 5", "SPRINGPROP \"LS\" CARDINALPT 5");
    refused(etabs(&sprung, &plain()), &["column \"L0\"", "springs"]);
}

/// A key that nobody knows, in every kind of row that is read, is named; so are sections and tables.
#[test]
fn keys_that_nobody_knows_are_named_in_every_kind_of_row() {
    let mut section = "";
    let mut seen = std::collections::BTreeSet::new();
    let text = e2k().replace(
        "$ SLAB PROPERTIES",
        "$ WALL PROPERTIES\r\n  SHELLPROP \"W\" PROPTYPE \"Wall\"\r\n\r\n$ SLAB PROPERTIES",
    );
    // Storeys, floors and all that is assigned; slabs do not bend, whatever they say.
    for line in text.lines().take_while(|line| *line != "$ LOG") {
        if let Some(name) = line.strip_prefix('$') {
            section = name.trim();
            continue;
        }
        let kind = line.split_whitespace().next().unwrap_or("");
        let unread = [
            "PROGRAM INFORMATION",
            "CONTROLS",
            "SLAB PROPERTIES",
            "LOAD PATTERNS",
        ];
        if unread.contains(&section) || kind.is_empty() || !seen.insert(kind.to_owned()) {
            continue;
        }
        let with = text.replacen(line, &format!("{} XQZ 1 ", line.trim_end()), 1);
        says(
            etabs(&with, &members()),
            &[&format!("XQZ of {kind} (once)"), "does not know"],
        );
    }
    assert_eq!(seen.len(), 11, "{seen:?}");
    says(
        etabs(
            &replaced(&text, "$ LOG", "$ XQZ THINGS\r\n  A 1\r\n\r\n$ LOG"),
            &plain(),
        ),
        &["XQZ THINGS", "not in the building"],
    );

    let mut text = s2k();
    for (table, row) in [
        (
            "CONNECTIVITY - AREA",
            "Area=1   NumJoints=3   Joint1=1   Joint2=11   Joint3=21",
        ),
        ("AREA SECTION ASSIGNMENTS", "Area=1   Section=S"),
        (
            "AREA SECTION PROPERTIES",
            "Section=S   Material=M30   Thickness=20",
        ),
        ("AREA STIFFNESS MODIFIERS", "Area=1   f11=1"),
        ("AREA THICKNESS OVERWRITES", "Area=1   Thickness1=20"),
        ("FRAME PROPERTY MODIFIERS", "Frame=1   AMod=1"),
        ("FRAME RELEASE ASSIGNMENTS 1 - GENERAL", "Frame=1   PI=No"),
        (
            "FRAME OFFSET ALONG LENGTH ASSIGNMENTS",
            "Frame=1   Type=\"User Defined\"   LengthI=0   LengthJ=0   RigidFactor=0",
        ),
        ("COORDINATE SYSTEMS", "Name=GLOBAL   Type=Cartesian   X=0"),
    ] {
        text = with_row(&text, table, row);
    }
    let unread = [
        "PROGRAM CONTROL",
        "MASS SOURCE",
        "FRAME LOADS - DISTRIBUTED",
    ];
    let mut count = 0;
    for title in text.lines().filter(|line| line.starts_with("TABLE:")) {
        let table = title.trim_start_matches("TABLE:").trim().trim_matches('"');
        if unread.contains(&table) {
            continue;
        }
        count += 1;
        let (before, after) = text.split_once(title).expect("a table");
        let (row, rest) = after
            .trim_start_matches('\n')
            .split_once('\n')
            .expect("a row");
        let with = format!("{before}{title}\n   XQZ=1{row}\n{rest}");
        says(
            sap2000(&with, &members()),
            &[&format!("XQZ of {table} (once)"), "does not know"],
        );
    }
    assert_eq!(count, 19);
    says(
        sap2000(&with_row(&s2k(), "XQZ THINGS", "A=1"), &plain()),
        &["XQZ THINGS", "not in the building"],
    );
}

/// Keys that are known and not used say what that means.
#[test]
fn what_is_not_carried_over_says_what_that_means() {
    for (key, words) in [
        (
            "RIGIDZONE 0.5",
            ["sizes of other members", "periods are longer"],
        ),
        (
            "LIMITCOMPRESSION 0",
            ["LIMITCOMPRESSION of LINEASSIGN", "too stiff"],
        ),
        ("TRANSFORMSTIFF \"YES\"", ["TRANSFORMSTIFF", "too soft"]),
    ] {
        let text = replaced(&e2k(), "CARDINALPT 5", &format!("{key} CARDINALPT 5"));
        says(etabs(&text, &plain()), &words);
    }
    let silent = replaced(
        &e2k(),
        "CARDINALPT 5",
        "TRANSFORMSTIFF \"NO\" RIGIDZONE 0 CARDINALPT 5",
    );
    let found = etabs(&silent, &plain()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(
        found.left_out,
        etabs(&e2k(), &plain()).expect("the frame").left_out
    );
    for (table, row, words) in [
        (
            "CONSTRAINT DEFINITIONS - BODY",
            "Name=B1",
            ["no diaphragms", "periods are longer"],
        ),
        (
            "FRAME INSERTION POINT ASSIGNMENTS",
            "Frame=1",
            ["aside of the lines", "too soft"],
        ),
        (
            "FRAME TENSION AND COMPRESSION LIMITS",
            "Frame=1",
            ["tension alone", "too stiff"],
        ),
        (
            "FRAME LOCAL AXES ASSIGNMENTS 2 - ADVANCED",
            "Frame=1",
            ["local axes by directions", "turned"],
        ),
        (
            "ACTIVE DEGREES OF FREEDOM",
            "UX=Yes   UY=No   UZ=Yes   RX=No   RY=Yes   RZ=No",
            ["UY of ACTIVE DEGREES OF FREEDOM (once)", "--direction"],
        ),
        (
            "JOINT CONSTRAINT ASSIGNMENTS",
            "Joint=1   Constraint=BODY1",
            ["BODY1", "periods are longer"],
        ),
    ] {
        says(sap2000(&with_row(&s2k(), table, row), &plain()), &words);
    }
    let curved = replaced(&s2k(), "IsCurved=No", "IsCurved=Yes");
    says(sap2000(&curved, &plain()), &["curved members", "IsCurved"]);
    let alone = with_row(
        &s2k(),
        "MATERIAL PROPERTIES 01 - GENERAL",
        "Material=M30   Type=Concrete",
    );
    let found = sap2000(&alone, &plain()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(
        found.left_out,
        sap2000(&s2k(), &plain()).expect("the frame").left_out
    );
}

/// Pinned members are those with the releases that ETABS wrote before; a pipe has its wall as T.
#[test]
fn keys_of_other_versions() {
    let released = |releases: &str| {
        let text = replaced(
            &e2k(),
            "SECTION \"B1\"CARD",
            &format!("RELEASE \"{releases}\" SECTION \"B1\"CARD"),
        );
        periods(
            &model(&etabs(&text, &plain()).unwrap_or_else(|error| panic!("{error}"))),
            6,
        )
    };
    assert_eq!(released("PINNED"), released("TI M2I M2J M3I M3J"));
    let pipe = |sizes: &str| {
        let text = replaced(
            &e2k(),
            "\"Concrete Rectangular\"  D 500 B 500",
            &format!("\"Steel Pipe\"  {sizes}"),
        );
        periods(
            &model(&etabs(&text, &plain()).unwrap_or_else(|error| panic!("{error}"))),
            6,
        )
    };
    assert_eq!(pipe("D 500 T 20"), pipe("D 500 TW 20"));
    refused(
        etabs(
            &replaced(
                &e2k(),
                "\"Concrete Rectangular\"  D 500 B 500",
                "\"Concrete Encasement Circle\"  D 500",
            ),
            &plain(),
        ),
        &["Encasement", "concrete"],
    );
    refused(
        etabs(
            &replaced(
                &e2k(),
                "\"Concrete Rectangular\"  D 500 B 500",
                "\"Concrete Tee\"  D 500 B 500",
            ),
            &plain(),
        ),
        &["cannot compute from its sizes"],
    );
}

/// A rectangle that is turned by 30°, and its second moments and product about axes that are not.
#[test]
fn sections_bend_about_their_principal_axes() {
    let of = |section: &str, angle: &str| {
        let text = replaced(
            &e2k(),
            "SHAPE \"Concrete Rectangular\"  D 500 B 500",
            section,
        );
        let text = replaced(
            &text,
            "SECTION \"C1\"CARD",
            &format!("SECTION \"C1\" {angle} CARD"),
        );
        let found = etabs(&text, &members()).unwrap_or_else(|error| panic!("{error}"));
        periods(&model(&found), 6)
    };
    let turned = of("SHAPE \"Concrete Rectangular\"  D 700 B 300", "ANG 30");
    let straight = of("SHAPE \"Concrete Rectangular\"  D 700 B 300", "");
    let (depth, width) = (700.0_f64, 300.0_f64);
    let [strong, weak] = [[depth, width], [width, depth]].map(|[d, b]| b * d.powi(3) / 12.0);
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let ratio = width / depth;
    // Roark: torsion of a rectangle.
    let torsion = depth * width.powi(3) * (1.0 / 3.0 - 0.21 * ratio * (1.0 - ratio.powi(4) / 12.0));
    let area = depth * width;
    let general = |sign: f64| {
        of(
            &format!(
                "SHAPE \"SD Section\" AREA {area} AS2 {shear} AS3 {shear} TORSION {torsion} I33 {} I22 {} I23 {}",
                strong * cos * cos + weak * sin * sin,
                strong * sin * sin + weak * cos * cos,
                sign * (strong - weak) * sin * cos,
                shear = 5.0 / 6.0 * area,
            ),
            "",
        )
    };
    let off = difference(&general(1.0), &turned);
    assert!(off < 1e-8, "{off:.1e}");
    // Neither the other sign nor none is the same.
    for other in [general(-1.0), general(0.0), straight] {
        assert!(difference(&other, &turned) > 1e-3);
    }
}

/// Every factor of a member acts on the number of its section that it names.
#[test]
fn factors_of_members_act_on_the_numbers_that_they_name() {
    let values = [0.9, 0.8, 0.7, 0.1, 0.5, 0.6];
    let pairs = |names: [&str; 6], equal: &str| {
        let pairs = names.iter().zip(values);
        let pairs = pairs.map(|(name, value)| format!("{name}{equal}{value}"));
        pairs.collect::<Vec<_>>().join("   ")
    };
    let of = |found: Result<Imported, String>| {
        periods(&model(&found.unwrap_or_else(|error| panic!("{error}"))), 6)
    };
    let sections = pairs(["AMOD", "A2MOD", "A3MOD", "JMOD", "I2MOD", "I3MOD"], " ");
    let own = pairs(
        [
            "PROPMODA",
            "PROPMODA2",
            "PROPMODA3",
            "PROPMODT",
            "PROPMODI22",
            "PROPMODI33",
        ],
        " ",
    );
    let (from, section) = ("JMOD 0.1 I2MOD 0.7 I3MOD 0.7", "SECTION \"C1\"");
    let by_sections = of(etabs(&e2k().replacen(from, &sections, 1), &members()));
    let bare = e2k().replacen(from, "", 1);
    let by_members = replaced(&bare, section, &format!("{own} {section}"));
    assert!(difference(&of(etabs(&by_members, &members())), &by_sections) < 1e-9);
    let columns = pairs(["AMod", "A2Mod", "A3Mod", "JMod", "I2Mod", "I3Mod"], "=");
    let own = pairs(
        ["AMod", "AS2Mod", "AS3Mod", "JMod", "I22Mod", "I33Mod"],
        "=",
    );
    let from = "AMod=1   A2Mod=1   A3Mod=1   JMod=0.1   I2Mod=0.7   I3Mod=0.7";
    let by_sections = of(sap2000(&by_sizes().replacen(from, &columns, 1), &members()));
    let bare = by_sizes().replacen(from, "AMod=1", 1);
    let frames = bare.lines().filter(|line| line.contains("AnalSect=C1 "));
    let rows: Vec<String> = frames
        .map(|line| {
            let frame = line.split_whitespace().next().expect("a frame");
            format!("{frame}   {own}")
        })
        .collect();
    let by_members = with_row(&bare, "FRAME PROPERTY MODIFIERS", &rows.join("\n   "));
    assert!(difference(&of(sap2000(&by_members, &members())), &by_sections) < 1e-9);
}
