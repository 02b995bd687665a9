//! How much work the built-in example takes. Times depend on the machine, these numbers do not: when one of them rises,
//! something has become dearer, and CHANGELOG should say why under "Numbers".

use crate::common::{complained, folder, jostle, printed};

/// Options, then steps, steps in contact, factorisations, solutions and iterations.
const WORK: [(&[&str], [u64; 5]); 4] = [
    (&["--solver", "riccati"], [25_157, 322, 14, 50_328, 719]),
    (&[], [1_659, 97, 24, 1_843, 198]),
    (
        &["--pga", "70cm/s2", "--gap", "10mm", "--solver", "riccati"],
        [25_716, 1_833, 134, 51_650, 4_280],
    ),
    (
        &["--pga", "70cm/s2", "--gap", "10mm", "--solver", "modal"],
        [2_363, 800, 83, 2_587, 1_645],
    ),
];

#[test]
fn the_example_takes_no_more_work_than_it_did() {
    let folder = folder();
    for (options, expected) in WORK {
        let arguments = [&["run", "paper", "--json", "--no-report"], options].concat();
        let output = jostle(folder.path(), &arguments);
        assert!(output.status.success(), "{}", complained(&output));
        let summary: serde_json::Value =
            serde_json::from_str(&printed(&output)).expect("a summary");
        let counts = [
            "steps",
            "contact_steps",
            "factorizations",
            "solves",
            "iterations",
        ];
        let found = counts.map(|name| summary["work"][name].as_u64().expect(name));
        assert_eq!(found, expected, "{counts:?} of {options:?}");
    }
}

/// Several contacts at once whose forces can only be found to the last digits but one: rounds must not go on for ever.
#[test]
fn forces_that_circle_in_their_last_digits_have_settled() {
    let folder = folder();
    for acceleration in ["2.3000000000000003", "3.3000000000000003"] {
        let pga = format!("{acceleration} m/s2");
        let arguments = [
            "run",
            "paper",
            "--json",
            "--no-report",
            "--solver",
            "modal",
            "--gap",
            "4 mm",
            "--pga",
            &pga,
        ];
        let output = jostle(folder.path(), &arguments);
        assert!(output.status.success(), "{}", complained(&output));
        let summary: serde_json::Value =
            serde_json::from_str(&printed(&output)).expect("a summary");
        assert!(summary["work"]["contact_steps"].as_u64() > Some(1_500));
    }
}
