//! What the page promises, read from its text.

use std::time::Instant;

use crate::fixture::{Run, alone, isolated, row_of_three, two_frames, walled, yielding};
use jostle::Structure;
use jostle::results::contact_sensitivity::{
    BuildingChange, ContactSensitivity, ContactVariant, GapSpread, RangeEnd, VariantResult,
};
use jostle::results::response::FloorResponse;
use jostle_report::render;

fn pages() -> Vec<(&'static str, Run)> {
    vec![
        ("two-frames", two_frames(0.1)),
        ("wide-gap", two_frames(0.4)),
        ("alone", alone()),
        ("row-of-three", row_of_three()),
        ("yielding", yielding()),
        ("walled", walled()),
        ("isolated", isolated()),
    ]
}

#[test]
fn page_of_the_example_stays_below_one_megabyte() {
    for (name, run) in pages() {
        let started = Instant::now();
        let text = render(&run.page());
        println!(
            "{name}: {} rows, {} impacts, {} bytes, {:.1} ms",
            run.history.len(),
            run.summary
                .gaps
                .iter()
                .map(|g| g.impact_count)
                .sum::<usize>(),
            text.len(),
            started.elapsed().as_secs_f64() * 1e3
        );
        assert!(text.len() < 1_000_000, "{name} has {} bytes", text.len());
    }
}

#[test]
fn page_loads_nothing_from_outside() {
    for (name, run) in pages() {
        let text = render(&run.page()).to_lowercase();
        let namespace = "http://www.w3.org/2000/svg";
        let text = text.replace(namespace, "");
        for outside in [
            "http://",
            "https://",
            "url(http",
            "@import",
            "src=",
            "fetch(",
            "href=\"//",
        ] {
            assert!(!text.contains(outside), "{name} contains {outside}");
        }
        assert_eq!(
            text.matches("href=").count(),
            1,
            "only the empty icon has an address"
        );
    }
}

#[test]
fn names_with_markup_are_escaped() {
    let text = render(&row_of_three().page());
    assert!(!text.contains("North <b>"), "a name became markup");
    assert!(
        text.contains("North &lt;b&gt;&amp;"),
        "the name is not shown"
    );
    assert!(!text.contains("\"</script>"), "a name ended a script");
    assert_eq!(
        text.matches("</script>").count(),
        4,
        "one each for the data, the texts, the units and the code"
    );
}

#[test]
fn no_number_reads_nan() {
    for (name, run) in pages() {
        let text = render(&run.page());
        let shown = text.split("<script").next().unwrap();
        let outside_style = shown.split("</style>").nth(1).unwrap();
        for word in ["NaN", "inf ", "null"] {
            assert!(!outside_style.contains(word), "{name} shows {word}");
        }
    }
}

#[test]
fn missing_numbers_are_dashes() {
    let mut run = two_frames(0.1);
    run.summary.energy.worst_imbalance = f64::NAN;
    run.summary.buildings[0].floors[4]
        .response
        .displacement_max_m = f64::NAN;
    for contact in &mut run.summary.gaps[0].contacts {
        for impact in &mut contact.impacts {
            impact.realised_restitution = f64::INFINITY;
        }
    }
    let text = render(&run.page());
    let shown = text.split("<script").next().unwrap();
    assert!(
        !shown.contains("NaN") && !shown.contains("inf<"),
        "not a number is shown"
    );
}

#[test]
fn verdict_says_what_happened() {
    let verdict = |run: &Run| {
        let text = render(&run.page());
        let from = text
            .split("<p class=\"verdict\">")
            .nth(1)
            .unwrap()
            .to_owned();
        from.split("</p>").next().unwrap().replace('\u{a0}', " ")
    };
    let quiet = verdict(&two_frames(0.4));
    assert!(
        quiet.starts_with("No contact: the smallest distance between J1 and J2 is"),
        "{quiet}"
    );
    let mut run = two_frames(0.1);
    let contact = run.summary.gaps[0].contacts.last_mut().unwrap();
    contact.impacts.truncate(1);
    contact.impacts[0].start_s = 6.148;
    contact.impacts[0].peak_force_n = 1_282_850.0;
    for other in &mut run.summary.gaps[0].contacts[..4] {
        other.impacts.clear();
    }
    run.summary.gaps[0].impact_count = 1;
    assert_eq!(
        verdict(&run),
        "J1 and J2: one impact, floor 5, at 6.148 s, 1283 kN."
    );
    assert!(
        verdict(&alone()).starts_with("Solo has a peak roof displacement of"),
        "{}",
        verdict(&alone())
    );
}

#[test]
fn warnings_come_first() {
    let mut run = alone();
    run.summary.ended_early = Some("the step at t = 3.2 s did not converge".into());
    let text = render(&run.page());
    let warning = text.find("did not converge").unwrap();
    assert!(
        warning < text.find("<h1>").unwrap(),
        "the warning hides below the title"
    );
}

/// Past check B2 results are grey, and words above them say why.
#[test]
fn results_outside_the_model_are_grey_and_said_to_be_so() {
    let mut run = two_frames(0.1);
    run.summary.buildings[1].response.drift_peak = 0.0449;
    let text = render(&run.page());
    assert!(!text.contains("Outside the model") && !text.contains("tiles muted"));
    run.summary.buildings[1].response.drift_peak = 0.0613;
    let text = render(&run.page());
    let said = text.find("Outside the model: no basis for design.");
    assert!(said.expect("it is said") < text.find("class=\"verdict muted\"").expect("a verdict"));
    assert!(text.contains("J2: drift 6.1\u{a0}%") || text.contains("J2: drift 6.1 %"));
    assert!(
        text.contains("tiles muted") && text.contains("<section class=\"muted\" id=\"impacts\"")
    );
    // The tables of the other building are not.
    assert_eq!(text.matches("peaks muted").count(), 1);
}

#[test]
fn peaks_of_every_floor_are_in_numbers_with_and_without_contact() {
    let mut run = two_frames(0.1);
    let roof = run.summary.buildings[0].floors.last_mut().unwrap();
    roof.response.displacement_min_m = -0.1234;
    roof.response.displacement_max_m = 0.1;
    roof.response.storey_drift_peak = 0.0567;
    roof.response.storey_shear_peak_n = 891_200.0;
    roof.response.overturning_moment_peak_n_m = 3_456_000.0;
    roof.response.total_acceleration_peak_m_s2 = 7.89;
    roof.without_contact = Some(FloorResponse {
        displacement_max_m: 0.2345,
        displacement_max_at_s: 1.0,
        displacement_min_m: -0.2,
        displacement_min_at_s: 2.0,
        total_acceleration_peak_m_s2: 4.56,
        storey_drift_peak: 0.0123,
        storey_shear_peak_n: 765_400.0,
        overturning_moment_peak_n_m: 2_345_000.0,
        ..FloorResponse::default()
    });
    let text = render(&run.page());
    let tables: Vec<&str> = text.split("<details class=\"peaks\">").collect();
    assert_eq!(tables.len() - 1, run.summary.buildings.len());
    for (table, building) in tables[1..].iter().zip(&run.summary.buildings) {
        let body = table.split("<tbody>").nth(1).unwrap();
        let body = body.split("</tbody>").next().unwrap();
        assert_eq!(body.matches("<tr").count(), building.floors.len());
    }
    let first = tables[1].split("<tbody>").nth(1).unwrap();
    let first = first.split("</tr>").next().unwrap();
    let cells: Vec<&str> = first
        .split("<td class=\"number\">")
        .skip(2)
        .map(|cell| cell.split('<').next().unwrap())
        .collect();
    assert_eq!(
        cells,
        [
            "123.4", "234.5", "7.89", "4.56", "5.67", "1.23", "891.2", "765.4", "3456", "2345"
        ]
    );
    let alone = render(&alone().page());
    assert!(alone.contains("Solo: table of peaks") && !alone.contains(">without<"));
}

#[test]
fn accuracy_stands_on_the_page() {
    let mut run = two_frames(0.1);
    run.summary.promise.residual = Some(4.2e-4);
    run.summary.promise.met = Some(true);
    let text = render(&run.page());
    let line = text.split("id=\"accuracy\"").nth(1).unwrap();
    assert!(line.split("</p>").next().unwrap().contains("0.042 %"));
}

#[test]
fn rules_that_are_not_shown_are_not_explained() {
    let combined = "SRSS and ABS combine";
    let mut run = two_frames(0.1);
    assert!(render(&run.page()).contains(combined));
    // Between floors as well.
    for contact in &mut run.summary.gaps[0].contacts {
        contact.floors[1] = None;
    }
    let text = render(&run.page());
    assert!(text.contains("GB 50011-2010") && text.contains(combined));
    // Where nothing touches, only rules of heights are left.
    run.summary.gaps[0].contacts.clear();
    let text = render(&run.page());
    assert!(text.contains("GB 50011-2010") && !text.contains(combined));
}

#[test]
fn what_yields_is_told_in_order() {
    let run = yielding();
    let text = render(&run.page()).replace('\u{a0}', " ");
    let [frame, storeys] = [0, 1].map(|index| &run.summary.buildings[index].hinges);
    assert!(
        frame.yielded > 0 && storeys.yielded > 0 && frame.yielded < frame.total,
        "the run must yield here and there: {} and {}",
        frame.yielded,
        storeys.yielded
    );
    let said = format!("J1: {} of {} hinges yielded", frame.yielded, frame.total);
    assert!(text.contains(&said), "{said}");
    let table = text.split("id=\"hinge-table\"").nth(1).unwrap();
    let table = table.split("</table>").next().unwrap();
    assert_eq!(
        table.matches("<tr").count() - 1,
        frame.list.len() + storeys.list.len()
    );
    let first = [frame, storeys]
        .iter()
        .filter_map(|hinges| hinges.first_yield_s)
        .fold(f64::INFINITY, f64::min);
    let row = table.split("<tr").nth(2).unwrap();
    assert!(
        row.contains(&format!("{first:.3}")),
        "the first row is the first to yield, at {first}: {row}"
    );
    assert!(text.contains("Drift at the end"), "drift is left");
    assert!(text.contains("Hinges of columns") && text.contains("Storeys"));
    assert!(text.contains("P-Delta of every column") && text.contains("footing mass"));
    assert!(!render(&two_frames(0.1).page()).contains("Drift at the end"));
}

#[test]
fn six_loops_fit_and_keep_their_peaks() {
    let run = yielding();
    let text = render(&run.page());
    let data = text.split("type=\"application/json\">").nth(1).unwrap();
    let data = data.split("</script>").next().unwrap();
    let data: serde_json::Value = serde_json::from_str(data).unwrap();
    let loops = data["loops"].as_array().unwrap();
    assert_eq!(loops.len(), 6);
    let size: usize = loops.iter().map(|l| l.to_string().len()).sum();
    assert!(size < 110_000, "{size} bytes of loops");
    let worst = run
        .summary
        .buildings
        .iter()
        .map(|building| building.hinges.ductility)
        .fold(0.0, f64::max);
    // serde_json reads numbers to the last digit but one.
    let told = loops[0]["ductility"].as_f64().expect("a number");
    assert!((told / worst - 1.0).abs() < 1e-14, "{told} and {worst}");
    let hinges = data["hinges"].as_array().unwrap();
    assert_eq!(hinges.len(), 9 * 2 + 6 * 2 + 4);
    let yielded = hinges.iter().filter(|hinge| !hinge[6].is_null()).count();
    let told: usize = run.summary.buildings.iter().map(|b| b.hinges.yielded).sum();
    assert_eq!(yielded, told);
}

/// Numbers of a packed list of the page.
fn unpacked(packed: &serde_json::Value) -> Vec<f64> {
    use base64::Engine as _;
    let number = |key: &str| packed[key].as_f64().unwrap();
    let bytes = base64::engine::general_purpose::STANDARD
        .decode(packed["data"].as_str().unwrap())
        .unwrap();
    let integers: Vec<f64> = match packed["kind"].as_str().unwrap() {
        "u32" => bytes
            .chunks(4)
            .map(|b| f64::from(u32::from_le_bytes(b.try_into().unwrap())))
            .collect(),
        _ => bytes
            .chunks(2)
            .map(|b| f64::from(i16::from_le_bytes(b.try_into().unwrap())))
            .collect(),
    };
    let (offset, scale) = (number("offset"), number("scale"));
    integers.iter().map(|i| offset + scale * i).collect()
}

fn data_of(text: &str) -> serde_json::Value {
    let data = text.split("type=\"application/json\">").nth(1).unwrap();
    serde_json::from_str(data.split("</script>").next().unwrap()).unwrap()
}

/// The area of a loop of force over indentation is the energy that the impact dissipates, and its top the peak force.
#[test]
fn loops_of_impacts_enclose_the_energy_that_they_dissipate() {
    let run = yielding();
    let data = data_of(&render(&run.page()));
    let contacts: Vec<_> = run.summary.gaps.iter().flat_map(|g| &g.contacts).collect();
    let mut compared = 0;
    for (contact, force) in contacts.iter().zip(data["forces"].as_array().unwrap()) {
        let [time, values, depths] =
            ["time", "values", "indentation"].map(|name| match &force[name] {
                serde_json::Value::Null => Vec::new(),
                packed => unpacked(packed),
            });
        for impact in contact.impacts.iter().filter(|i| i.peak_force_n > 1e5) {
            let within =
                |k: &usize| (impact.start_s - 1e-6..=impact.end_s + 1e-6).contains(&time[*k]);
            let rows: Vec<usize> = (0..time.len()).filter(within).collect();
            let area: f64 = rows
                .windows(2)
                .map(|pair| {
                    let [a, b] = [pair[0], pair[1]];
                    0.5 * (values[a] + values[b]) * (depths[b] - depths[a])
                })
                .sum();
            let peak = rows.iter().map(|k| values[*k]).fold(0.0, f64::max);
            let depth = rows.iter().map(|k| depths[*k]).fold(0.0, f64::max);
            // Sums of trapezoids over the steps of an impact; values have 32,767 levels.
            assert!(
                (area / impact.dissipated_j - 1.0).abs() < 0.02,
                "{area} J in the loop, {} J dissipated",
                impact.dissipated_j
            );
            assert!((peak / impact.peak_force_n - 1.0).abs() < 5e-3);
            assert!((depth / impact.peak_indentation_m - 1.0).abs() < 5e-3);
            compared += 1;
        }
    }
    assert!(compared > 2, "{compared} impacts");
}

#[test]
fn contacts_between_floors_have_no_loop() {
    let mut run = two_frames(0.1);
    for contact in &mut run.summary.gaps[0].contacts {
        contact.floors[1] = None;
    }
    let data = data_of(&render(&run.page()));
    for force in data["forces"].as_array().unwrap() {
        assert!(force["indentation"].is_null(), "whose motion is that?");
    }
}

#[test]
fn the_spread_over_contacts_stands_beside_its_results() {
    let mut run = two_frames(0.1);
    assert!(!render(&run.page()).contains("Spread over contacts"));
    let forces = [880e3, 1640e3, 1285e3, 1295e3];
    let results = ContactVariant::USUAL.into_iter().zip(forces);
    run.summary.contact_sensitivity = Some(ContactSensitivity {
        variants: results
            .map(|(contact, peak_force_n)| VariantResult {
                contact,
                stiffness_factor: match contact.stiffness {
                    Some(RangeEnd::Low) => 0.5,
                    Some(RangeEnd::High) => 2.0,
                    None => 1.0,
                },
                stiffnesses: vec![2e9],
                peak_force_n,
                impact_count: 7,
            })
            .collect(),
        gaps: vec![GapSpread {
            between: ["J1".into(), "J2".into()],
            peak_force_min_n: 880e3,
            peak_force_max_n: 1640e3,
            impact_count_min: 5,
            impact_count_max: 7,
        }],
        buildings: vec![BuildingChange {
            name: "J1".into(),
            displacement: 0.0123,
            storey_drift: 0.02,
            total_acceleration: 0.456,
            storey_shear: 0.1,
            overturning_moment: 0.05,
            total_acceleration_min_m_s2: 38.0,
            total_acceleration_max_m_s2: 116.0,
        }],
    });
    run.summary.gaps[0].peak_force_n = 1283e3;
    let text = render(&run.page());
    let box_ = text.split("id=\"spread\"").nth(1).unwrap();
    let box_ = box_.split("</section>").next().unwrap();
    let cells = |name: &str| -> Vec<String> {
        let row = box_.split(&format!("scope=\"row\">{name}</th>")).nth(1);
        let row = row.unwrap_or_else(|| panic!("no {name}"));
        let row = row.split("</tr>").next().unwrap();
        row.split("<td class=\"number\">")
            .skip(1)
            .map(|cell| cell.split('<').next().unwrap().replace('\u{202f}', ""))
            .collect()
    };
    assert_eq!(cells("peak force [kN]"), ["1283", "880.0", "1640"]);
    assert_eq!(cells("impacts")[1..], ["5", "7"]);
    assert_eq!(cells("J1, total acceleration [m/s²]")[1..], ["38.0", "116"]);
    assert_eq!(cells("stiffness × 0.5"), ["880.0", "7"]);
    assert_eq!(cells("restitution − 0.15"), ["1285", "7"]);
    assert_eq!(cells("restitution + 0.15"), ["1295", "7"]);
    assert_eq!(cells("J1"), ["1.2", "2.0", "45.6", "10.0", "5.0"]);
    // The bar runs from 880 to 1640, the mark at 1283, of 1640 kN.
    assert!(box_.contains("left:53.7%;width:46.3%") && box_.contains("left:78.2%"));
}

#[test]
fn thousands_of_impacts_fit() {
    let mut run = two_frames(0.1);
    let contact = run.summary.gaps[0].contacts.last_mut().unwrap();
    let one = contact.impacts[0];
    contact.impacts = (0..5000)
        .map(|i| {
            let mut impact = one;
            impact.start_s = 0.006 * f64::from(i);
            impact.peak_force_n = f64::from(i % 977) * 1e3;
            impact
        })
        .collect();
    run.summary.gaps[0].impact_count = 5000;
    let text = render(&run.page());
    assert!(text.len() < 1_300_000, "{} bytes", text.len());
    assert!(
        text.contains("Show all 1000 impacts"),
        "long tables are folded"
    );
}

#[test]
fn a_run_without_histories_still_reports() {
    let mut run = two_frames(0.1);
    run.history = jostle::History::new(Vec::new());
    run.without_contact = None;
    let text = render(&run.page());
    assert!(
        text.contains("No time histories were recorded") && !text.contains("<script"),
        "{}",
        text.len()
    );
}

/// Writes the pages into a folder, to be looked at.
#[test]
fn pages_are_written() {
    for (name, run) in pages() {
        let path = format!("{}/{name}.html", env!("CARGO_TARGET_TMPDIR"));
        std::fs::write(&path, render(&run.page())).unwrap();
        println!("{path}");
    }
}

#[test]
fn bearings_links_and_walls_have_loops_and_a_table() {
    let run = isolated();
    let text = render(&run.page());
    assert!(text.contains("Bearings, links and dampers, walls"));
    assert!(text.contains("moat &lt;b&gt;") && !text.contains("moat <b>"));
    let section = text.split("id=\"devices\"").nth(1).unwrap();
    let section = section.split("</section>").next().unwrap();
    assert_eq!(
        section.matches("<tr").count(),
        1 + 4,
        "bearings, wall and two links"
    );
    let payload = text.split("id=\"page-data\"").nth(1).unwrap();
    let payload = payload.split_once('>').unwrap().1;
    let payload = payload.split("</script").next().unwrap();
    let data: serde_json::Value = serde_json::from_str(payload).expect("JSON");
    let devices = data["devices"].as_array().expect("a list");
    let over_time: Vec<bool> = devices
        .iter()
        .map(|device| device["over_time"].as_bool().expect("a flag"))
        .collect();
    assert_eq!(over_time, [false, false, true], "bearings, damper, cable");
    assert_eq!(data["walls"][0]["beside"], serde_json::json!([null, 0]));
    assert_eq!(data["gaps"][1]["walls"], serde_json::json!([0, null]));
    let columns = data["run"]["columns"].as_array().expect("a list");
    for name in ["u:0:0", "u:2:0"] {
        assert!(columns.iter().any(|column| column[0] == name), "{name}");
    }
}

/// The scene and the drawing to scale have the members that stand, at the elevation of their building.
#[test]
fn fewer_bays_above_and_elevations_reach_the_pictures() {
    let mut run = two_frames(0.1);
    let plain = render(&run.page());
    assert!(!plain.contains("\"standing\":") && !plain.contains("\"elevation\":"));
    let building = &mut run.model.buildings[1];
    building.base.elevation = -1.5;
    let Structure::Frame(frame) = &mut building.structure else {
        panic!("a frame");
    };
    for storey in 6..10 {
        frame.own_columns.insert([storey, 0], None);
        frame.own_beams.insert([storey, 0], None);
    }
    let page = render(&run.page());
    let all = |top: usize| {
        (1..=top)
            .map(|storey| storey.to_string())
            .collect::<Vec<_>>()
            .join(",")
    };
    let [low, high] = [6, 10].map(all);
    assert!(page.contains(&format!(
        "\"standing\":[[{low}],[{high}],[{high}],[{high}]]"
    )));
    assert!(page.contains("\"elevation\":-1.5"));
    assert!(page.contains("elevation of the base") && page.contains("7–10: –"));
}

/// The tiles answer first what gap is needed and where the greatest drift is.
#[test]
fn the_head_says_how_much_gap_and_where_the_drift() {
    let mut run = two_frames(0.1);
    for building in &mut run.summary.buildings {
        for floor in &mut *building.floors {
            floor.response.storey_drift_peak = 0.001;
        }
    }
    run.summary.buildings[1].floors[2]
        .response
        .storey_drift_peak = 0.01234;
    run.summary.gaps[0].closing_without_contact_m = Some(0.1605);
    let text = render(&run.page());
    let tiles = text.find("class=\"tiles").expect("tiles");
    let end = text.find("How they move").expect("a section");
    let head = text[tiles..end].replace(['\u{a0}', '\u{202f}'], " ");
    for due in [
        "Gap needed",
        "160.5 mm",
        "gap 100 mm, 60.5 mm too narrow",
        "1.23 %",
        "J2, storey 3",
        "Peak closing",
    ] {
        assert!(head.contains(due), "{due} in {head}");
    }
    run.summary.gaps[0].closing_without_contact_m = Some(0.09);
    let text = render(&run.page()).replace(['\u{a0}', '\u{202f}'], " ");
    assert!(text.contains("gap 100 mm, 10 mm left"));
}
