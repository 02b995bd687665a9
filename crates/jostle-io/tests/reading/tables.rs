//! Result tables can be read back, with the names and numbers that were written.

use std::path::PathBuf;

use jostle::results::in_plan::ImpactSliding;
use jostle::results::summary::{
    ContactSummary, EnergySummary, GapSummary, ImpactSummary, LinkFloorSummary, LinkSummary,
    MotionSummary, WorkSummary,
};
use jostle::{Column, EnergyTerm, History, Model, Summary};
use jostle_io::{
    Format, read_model_text, write_atomically, write_history_parquet, write_impacts_parquet,
    write_summary_json,
};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

fn model() -> Model {
    let text = r#"
title = "Two, with an odd name"
[[building]]
name = "A, west"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = "90 MN/m"
storey_height = "3 m"
[[gap]]
between = ["A, west", "B"]
width = "10 mm"
"#;
    match read_model_text("m", text, Format::Toml, "".as_ref()) {
        Ok(input) => input.model,
        Err(error) => panic!("{error}"),
    }
}

fn impact(start: f64) -> ImpactSummary {
    ImpactSummary {
        sliding: None,
        centre_m: None,
        ended: None,
        start_s: start,
        end_s: start + 0.25,
        peak_force_n: 1e6,
        peak_force_at_s: start + 0.1,
        peak_indentation_m: 1e-3,
        impact_speed_m_s: 0.5,
        separation_speed_m_s: 0.3,
        realised_restitution: 0.6,
        impulse_n_s: 1e4,
        dissipated_j: 2e3,
        finished: true,
        touches: 1,
        simultaneous: 1,
    }
}

fn contact(
    floors: [Option<usize>; 2],
    height_m: f64,
    impacts: Vec<ImpactSummary>,
) -> ContactSummary {
    ContactSummary {
        in_plan: None,
        struck_column: None,
        floors,
        height_m,
        width_m: 0.01,
        closing_peak_m: 0.011,
        closing_peak_at_s: 1.0,
        crushed_depth_m: None,
        equivalent_restitution: None,
        closing_peak_ground_m: None,
        impact_count: impacts.len(),
        peak_force_n: 1e6,
        peak_force_at_s: None,
        impulse_n_s: 1e4,
        impacts,
    }
}

fn summary() -> Summary {
    Summary {
        title: "Two".into(),
        jostle: "0.1.0".into(),
        build: None,
        motion: MotionSummary {
            name: "m".into(),
            points: 0,
            step_s: 0.0,
            pga_m_s2: 1.0,
            across: None,
            pga_across_m_s2: None,
            scale: 1.0,
            duration_s: 1.0,
        },
        buildings: Vec::new(),
        gaps: vec![GapSummary {
            between: ["A, west".into(), "B".into()],
            width_m: 0.01,
            clearance_m: -1e-3,
            law: "hertz".into(),
            free_restitution: Some(1.0),
            contacts: vec![
                contact([Some(1), Some(1)], 3.0, vec![impact(1.0), impact(2.0)]),
                contact([None, Some(2)], 4.5, vec![impact(1.5)]),
            ],
            impact_count: 3,
            peak_force_n: 1e6,
            total_force_peak_n: 1.5e6,
            total_force_peak_at_s: Some(1.02),
            first_impact_s: Some(1.0),
            minimum_separation_s: 0.0,
            pounding_count: 1,
            multiple_pounding_count: 0,
            most_at_once: 1,
            closing_without_contact_m: None,
        }],
        links: vec![LinkSummary {
            law: "linear".to_owned(),
            exponent: 1.0,
            force_peak_n: 0.0,
            stroke_peak_m: 0.0,
            speed_peak_m_s: 0.0,
            between: ["A, west".into(), "B".into()],
            stiffness_n_m: 1e6,
            damping_n_s_m: 1e5,
            peak_force_n: 2e5,
            dissipated_j: 1e3,
            floors: vec![LinkFloorSummary {
                peak_speed_m_s: 0.0,
                floors: [Some(2), Some(2)],
                height_m: 6.0,
                peak_force_n: -2e5,
                peak_force_at_s: 1.2,
                peak_stroke_m: 0.02,
                dissipated_j: 1e3,
            }],
        }],
        walls: Vec::new(),
        energy: EnergySummary::default(),
        promise: Default::default(),
        work: WorkSummary::default(),
        contact_sensitivity: None,
        gradients: Vec::new(),
        isolation_bounds: None,
        floor_spectra: None,
        checks: Vec::new(),
        silenced_checks: Vec::new(),
        ended_early: None,
        warnings: Vec::new(),
        notes: Vec::new(),
    }
}

/// A folder of our own below the temporary one.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("jostle-io-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Rows of names and values.
fn read(path: &PathBuf) -> Vec<Vec<(String, Field)>> {
    let file = std::fs::File::open(path).expect("the file was written");
    let reader = SerializedFileReader::new(file).expect("the file is Parquet");
    let rows = reader.get_row_iter(None).expect("rows can be read");
    rows.map(|row| row.expect("a row").into_columns()).collect()
}

#[test]
fn histories_have_named_columns() {
    let columns = vec![
        Column::TIME,
        Column::GROUND_ACCELERATION,
        Column::displacement(0, 2),
        Column::velocity(1, 1),
        Column::total_acceleration(1, 2),
        Column::contact_force(0),
        Column::contact_force(1),
        Column::closing(1),
        Column::link_force(0),
        Column::link_stroke(0),
        Column::link_speed(0),
        Column::energy(EnergyTerm::Input),
    ];
    let values: Vec<f64> = (0..24).map(f64::from).collect();
    let history = History::from_rows(columns, values);
    let folder = folder("history");
    let path = folder.join("history.parquet");
    write_history_parquet(&path, &model(), &summary(), &history).expect("written");
    let rows = read(&path);
    let names: Vec<&str> = rows[0].iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        [
            "time_s",
            "ground_acceleration_m_s2",
            "A__west.floor2.displacement_m",
            "B.floor1.velocity_m_s",
            "B.floor2.total_acceleration_m_s2",
            "A__west-B.floor1-1.force_n",
            "A__west-B.at4500mm.force_n",
            "A__west-B.at4500mm.closing_m",
            "A__west-B.link2-2.force_n",
            "A__west-B.link2-2.stroke_m",
            "A__west-B.link2-2.speed_m_s",
            "energy_input_j",
        ]
    );
    let second: Vec<Field> = rows[1].iter().map(|(_, value)| value.clone()).collect();
    let wanted: Vec<Field> = (12..24)
        .map(|value| Field::Double(f64::from(value)))
        .collect();
    assert_eq!(second, wanted);
    std::fs::remove_dir_all(folder).expect("the folder is ours");
}

#[test]
fn impacts_have_one_row_each() {
    let folder = folder("impacts");
    let path = folder.join("impacts.parquet");
    write_impacts_parquet(&path, &summary()).expect("written");
    let rows = read(&path);
    let column = |name: &str| -> Vec<Field> {
        let values = rows
            .iter()
            .flat_map(|row| row.iter().filter(|(n, _)| n == name));
        values.map(|(_, value)| value.clone()).collect()
    };
    assert_eq!(column("gap"), vec![Field::Str("A, west-B".into()); 3]);
    assert_eq!(
        column("left_floor"),
        [Field::Int(1), Field::Null, Field::Int(1)]
    );
    assert_eq!(
        column("right_floor"),
        [Field::Int(1), Field::Int(2), Field::Int(1)]
    );
    // In the order of time, whichever contact they are at.
    assert_eq!(column("start_s"), [1.0, 1.5, 2.0].map(Field::Double));
    assert_eq!(column("duration_s"), [0.25; 3].map(Field::Double));

    // A run without impacts still has a table, with the same columns.
    let mut quiet = summary();
    quiet.gaps.clear();
    write_impacts_parquet(&path, &quiet).expect("written over the old one");
    assert!(read(&path).is_empty(), "no rows");
    std::fs::remove_dir_all(folder).expect("the folder is ours");
}

/// Impacts of gaps with friction have two columns more; those of other gaps of the model leave them empty.
#[test]
fn impacts_with_friction_have_its_columns() {
    let folder = folder("friction");
    let path = folder.join("impacts.parquet");
    let mut rough = summary();
    rough.gaps[0].contacts[1].impacts[0].sliding = Some(ImpactSliding {
        slip_speed_m_s: -0.2,
        tangential_impulse_n_s: 3e3,
    });
    write_impacts_parquet(&path, &rough).expect("written");
    let rows = read(&path);
    for (name, value) in [("slip_speed_m_s", -0.2), ("tangential_impulse_n_s", 3e3)] {
        let row = rows
            .iter()
            .flat_map(|row| row.iter().filter(|(n, _)| n == name));
        let values: Vec<Field> = row.map(|(_, value)| value.clone()).collect();
        assert_eq!(
            values,
            [Field::Null, Field::Double(value), Field::Null],
            "{name}"
        );
    }
    std::fs::remove_dir_all(folder).expect("the folder is ours");
}

#[test]
fn files_are_replaced_whole_and_errors_name_the_path() {
    let folder = folder("atomic");
    let path = folder.join("summary.json");
    write_atomically(&path, b"old").expect("written");
    write_summary_json(&path, &summary()).expect("written over the old one");
    let text = std::fs::read_to_string(&path).expect("readable");
    assert!(text.starts_with("{\n  \"title\": \"Two\""), "{text}");
    assert_eq!(
        std::fs::read_dir(&folder).expect("readable").count(),
        1,
        "no part file is left"
    );

    let missing = folder.join("no such folder").join("x.json");
    let error = write_atomically(&missing, b"x")
        .expect_err("there is no such folder")
        .to_string();
    assert!(
        error.contains("no such folder/x.json: cannot be written: "),
        "{error}"
    );
    std::fs::remove_dir_all(folder).expect("the folder is ours");
}
