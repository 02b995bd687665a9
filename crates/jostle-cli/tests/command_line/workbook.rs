//! `jostle run --xlsx`.

#![allow(
    clippy::unwrap_used,
    reason = "a test stops at the first surprise, helpers included"
)]

use jostle_io::archive_text;

use crate::common::{complained, folder, jostle, printed};

const MOST: u64 = 1 << 24;

#[test]
fn numbers_of_a_run_become_a_workbook() {
    let folder = folder();
    let arguments = [
        "run",
        "paper",
        "--json",
        "--xlsx",
        "numbers.xlsx",
        "--pga",
        "70cm/s2",
        "--gap",
        "10mm",
    ];
    let done = jostle(folder.path(), &arguments);
    assert!(done.status.success(), "{}", complained(&done));
    let summary: serde_json::Value = serde_json::from_str(&printed(&done)).unwrap();
    let path = folder.path().join("numbers.xlsx");
    let bytes = std::fs::read(&path).unwrap();
    let book = archive_text(&bytes, "xl/workbook.xml", MOST).unwrap();
    for (index, name) in [
        "Summary",
        "Buildings",
        "Floors",
        "Contacts",
        "Impacts",
        "Quantities",
    ]
    .iter()
    .enumerate()
    {
        assert!(
            book.contains(&format!("name=\"{name}\" sheetId=\"{}\"", index + 1)),
            "{book}"
        );
    }
    // Numbers are numbers, with all their digits.
    let force = summary["gaps"][0]["contacts"][4]["peak_force_n"]
        .as_f64()
        .unwrap();
    let contacts = archive_text(&bytes, "xl/worksheets/sheet4.xml", MOST).unwrap();
    assert!(
        contacts.contains(&format!("<v>{force}</v>")),
        "{force}: {contacts}"
    );
    let impacts = archive_text(&bytes, "xl/worksheets/sheet5.xml", MOST).unwrap();
    let count = summary["gaps"][0]["impact_count"].as_u64().unwrap();
    assert_eq!(impacts.matches("<row ").count() as u64, count + 2);
    // The same run writes the same bytes, in place of its own file.
    let again = jostle(folder.path(), &arguments);
    assert!(
        complained(&again).contains("replaced: numbers.xlsx"),
        "{}",
        complained(&again)
    );
    assert!(std::fs::read(&path).unwrap() == bytes);
}

#[test]
fn other_files_stay() {
    let folder = folder();
    let path = folder.path().join("mine.xlsx");
    // A workbook of somebody else is a zip file as well.
    let other = jostle_io::numpy_archive(&[("x", &[1], vec![1.0])]).unwrap();
    for content in [&b"my numbers"[..], &other] {
        std::fs::write(&path, content).unwrap();
        let refused = jostle(
            folder.path(),
            &[
                "run",
                "paper",
                "--no-report",
                "--json",
                "--xlsx",
                "mine.xlsx",
            ],
        );
        assert_eq!(refused.status.code(), Some(2));
        assert!(
            complained(&refused).contains("is no workbook of jostle"),
            "{}",
            complained(&refused)
        );
        assert_eq!(std::fs::read(&path).unwrap(), content);
    }
    let forced = jostle(
        folder.path(),
        &[
            "run",
            "paper",
            "--no-report",
            "--json",
            "--force",
            "--xlsx",
            "mine.xlsx",
        ],
    );
    assert!(forced.status.success(), "{}", complained(&forced));
    let nowhere = jostle(
        folder.path(),
        &[
            "run",
            "paper",
            "--no-report",
            "--json",
            "--xlsx",
            "absent/mine.xlsx",
        ],
    );
    assert_eq!(nowhere.status.code(), Some(1));
}
