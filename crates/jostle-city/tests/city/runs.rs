//! Runs of a small made-up city.

use std::path::Path;

use jostle_city::{City, CityError, RunOptions, example_city};
use jostle_io::{CityFile, Format, read_model_text};
use jostle_testkit::runs::run_and_summary;

/// A city of some buildings in a folder.
fn city(folder: &Path, buildings: usize, extra: &str) -> City {
    std::fs::write(
        folder.join("footprints.geojson"),
        example_city(buildings, 7),
    )
    .unwrap();
    let text = format!(
        "[inventory]\nfile = \"footprints.geojson\"\n[motion]\nrecord = \"el-centro-1940-ns\"\nduration = \"8 s\"\n{extra}"
    );
    City::new(CityFile::parse("city.toml", &text, Format::Toml, folder).unwrap()).unwrap()
}

fn run(
    city: &City,
    out: &Path,
    shard: Option<(usize, usize)>,
) -> Result<jostle_city::Done, CityError> {
    city.run(out, RunOptions { shard }, &|| false, &mut |_| {})
}

fn bytes_of(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all: Vec<_> = std::fs::read_dir(folder.join("runs"))
        .unwrap()
        .map(|dir| dir.unwrap().path())
        .map(|path| {
            (
                path.file_name().unwrap().to_string_lossy().into_owned(),
                std::fs::read(&path).unwrap(),
            )
        })
        .collect();
    all.sort();
    all
}

#[test]
fn a_run_is_the_same_for_any_threads_and_shards_and_goes_on_where_it_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[run]\ndraws = 8\nsample = 0\n[gap]\nmedian = \"12 mm\"\n";
    let parts = city(folder.path(), 150, text).in_parts_of(50);
    let of = |name: &str| folder.path().join(name);
    let done = run(&parts, &of("whole"), None).unwrap();
    assert_eq!((done.cases, done.missing), (parts.cases(), 0));
    let whole = bytes_of(&of("whole"));
    assert!(whole.len() > 1, "{} parts", whole.len());
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let first = one
        .install(|| run(&parts, &of("shards"), Some((1, 2))))
        .unwrap();
    assert!(first.missing > 0);
    assert!(parts.answers(&of("shards")).is_err());
    run(&parts, &of("shards"), Some((2, 2))).unwrap();
    assert!(bytes_of(&of("shards")) == whole);
    // Stopped after the first part; the next run makes the others only.
    let seen = std::cell::Cell::new(0);
    let stopped = parts.run(
        &of("stopped"),
        RunOptions::default(),
        &|| seen.get() > parts.cases() / 2,
        &mut |done| seen.set(done.cases),
    );
    assert!(matches!(stopped, Err(CityError::Stopped)));
    let kept = bytes_of(&of("stopped"));
    assert!(!kept.is_empty() && kept.len() < whole.len());
    run(&parts, &of("stopped"), None).unwrap();
    assert!(bytes_of(&of("stopped")) == whole);
    // Another city does not go into the same folder.
    let other = city(folder.path(), 150, "[run]\ndraws = 3\n");
    let error = run(&other, &of("whole"), None)
        .expect_err("another city")
        .to_string();
    assert!(error.contains("another city file"), "{error}");
}

#[test]
fn neighbours_hit_exactly_where_the_free_ones_come_nearer_than_the_gap() {
    let folder = tempfile::tempdir().unwrap();
    let city = city(
        folder.path(),
        200,
        "[run]\ndraws = 20\nsample = 12\ntolerance = 0.001\n[gap]\nmedian = \"8 mm\"\n",
    );
    let out = folder.path().join("out");
    run(&city, &out, None).unwrap();
    let cases = city.cases_for_tests(&out).unwrap();
    let (mut struck, mut expected, mut alone) = (0, 0.0, 0);
    let gaps = jostle_city::GapWidths {
        median: 0.008,
        scatter: 0.8,
        party_wall: 0.0,
    };
    for case in &cases {
        let [closing, gap, row, impacts] = [case[0], case[1], case[2], case[3]];
        if row == 2.0 {
            assert_eq!(closing > gap, impacts > 0.0, "closing {closing}, gap {gap}");
            struck += usize::from(impacts > 0.0);
            let distance = city.neighbours.pairs[case[4] as usize].distance;
            expected += gaps.probability_below(closing, distance);
            alone += 1;
        }
        if impacts == 0.0 && row == 2.0 {
            assert_eq!(case[5], case[6]);
        }
    }
    assert!(alone > 200 && struck > 50, "{alone} {struck}");
    // The closing curve counts what drawn gaps only sample: three standard deviations of a count.
    let deviation = (expected * (1.0 - expected / f64::from(alone))).sqrt();
    assert!(
        (struck as f64 - expected).abs() < 3.0 * deviation,
        "{struck} {expected}"
    );
    let answers = city.answers(&out).unwrap();
    assert!(answers.sampled.rows >= 12);
    let (within, worst) = answers.sampled.within(1e-3).unwrap();
    assert!(within >= 0.99 && worst < 5e-3, "{within} {worst}");
    for building in answers.buildings.iter().flatten() {
        assert!(
            building
                .struck
                .windows(2)
                .all(|building| building[0] >= building[1]),
            "{:?}",
            building.struck
        );
        for states in building.states {
            assert!((states.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn motions_with_directions_act_along_the_rows() {
    let folder = tempfile::tempdir().unwrap();
    // Rows run east: a motion to the north does not move them.
    let city = city(
        folder.path(),
        30,
        "angle = \"90 deg\"\n[run]\ndraws = 2\nsample = 0\n[gap]\nmedian = \"2 mm\"\n",
    );
    let out = folder.path().join("out");
    run(&city, &out, None).unwrap();
    let cases = city.cases_for_tests(&out).unwrap();
    assert!(!cases.is_empty());
    assert!(
        cases.iter().all(|city| city[3] == 0.0 && city[0] < 1e-6),
        "{:?}",
        cases[0]
    );
}

#[test]
fn the_sides_of_a_pair_are_those_of_the_inventory_whatever_the_order_of_its_row() {
    let folder = tempfile::tempdir().unwrap();
    // From left to right stand b, a and c: a is the first of both its pairs, and the right one of the first.
    let square = |x: f64| {
        format!(
            "\"POLYGON(({x} 0,{} 0,{} 10,{x} 10,{x} 0))\"",
            x + 10.0,
            x + 10.0
        )
    };
    let table = format!(
        "id,storeys,type,wkt\na,3,C1,{}\nb,1,W1,{}\nc,5,URM,{}\n",
        square(10.1),
        square(0.0),
        square(20.2)
    );
    std::fs::write(folder.path().join("a.csv"), table).unwrap();
    let text = "[inventory]\nfile = \"a.csv\"\nmetres = true\n[motion]\nrecord = \"el-centro-1940-ns\"\nduration = \"4 s\"\n\
                [run]\ndraws = 3\nsample = 0\n";
    let file = CityFile::parse("city.toml", text, Format::Toml, folder.path()).unwrap();
    let city = City::new(file).unwrap();
    let out = folder.path().join("out");
    run(&city, &out, None).unwrap();
    let cases = city.cases_for_tests(&out).unwrap();
    let alone = |pair: f64| {
        cases
            .iter()
            .filter(move |case| case[4] == pair)
            .map(|case| case[5])
    };
    assert_eq!(cases.len(), 6);
    assert!(alone(0.0).eq(alone(1.0)), "{cases:?}");
}

#[test]
fn types_damage_and_levels_may_be_a_user_s_own() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let run_of = |name: &str, extra: &str| {
        let text = format!("[run]\ndraws = 3\nsample = 0\n[gap]\nmedian = \"12 mm\"\n{extra}");
        let city = city(folder.path(), 60, &text);
        let out = folder.path().join(name);
        run(&city, &out, None).unwrap();
        let damaged: f64 = city
            .answers(&out)
            .unwrap()
            .buildings
            .iter()
            .flatten()
            .map(|building| building.states[0][1..].iter().sum::<f64>())
            .sum();
        (city.cases_for_tests(&out).unwrap(), damaged)
    };
    let usual = run_of("usual", "");
    assert!(usual.1 > 0.0);
    // The table of HAZUS as a file, and the levels of California as a table: the same bits.
    write("types.csv", jostle_classes::Types::text());
    let table = "[buildings]\ntable = \"types.csv\"\n";
    let same = format!("{table}level = {{ moderate = 1941, high = 1976 }}\n");
    assert!(run_of("same", &same) == usual);
    // Heavier floors on a period that stays: equal drifts, so the same damage where nothing collides; other forces.
    let heavy = run_of("heavy", &format!("{table}area_mass = \"14 kN/m2\"\n"));
    assert!(heavy.0 != usual.0);
    // Damage that begins at a drift which nobody reaches.
    write("damage.csv", &damage_of_all([0.6, 0.7, 0.8, 0.9]));
    let none = run_of("none", "[damage]\ntable = \"damage.csv\"\n");
    assert!(none.0 == usual.0, "drifts do not hang on damage");
    assert_eq!(none.1, 0.0);
    // Nobody has a code.
    let weak = run_of("weak", "[buildings]\nlevel = { high = 3000 }\n");
    let named = run_of("named", "[buildings]\nlevel = \"pre\"\n");
    assert!(weak.0 != usual.0);
    // Buildings without a year are moderate, unless all are pre.
    assert!(
        weak.1 > usual.1 && named.1 >= weak.1,
        "{} {} {}",
        usual.1,
        weak.1,
        named.1
    );
}

/// A table of damage that has every type of HAZUS.
fn damage_of_all([slight, moderate, extensive, complete]: [f64; 4]) -> String {
    let mut text = String::from("type,slight,moderate,extensive,complete\n");
    let names: std::collections::BTreeSet<String> = jostle_classes::Types::hazus()
        .classes()
        .map(|class| class.name.to_string())
        .collect();
    for name in names {
        text += &format!("{name},{slight},{moderate},{extensive},{complete}\n");
    }
    text
}

#[test]
fn a_wrong_table_of_types_ends_before_anything_is_run() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("footprints.geojson"),
        example_city(20, 7),
    )
    .unwrap();
    std::fs::write(folder.path().join("types.csv"), "type,dy\nA,3\n").unwrap();
    let text = "[inventory]\nfile = \"footprints.geojson\"\n[buildings]\ntable = \"types.csv\"\n[motion]\nrecord = \"el-centro-1940-ns\"\n";
    let file = CityFile::parse("city.toml", text, Format::Toml, folder.path()).unwrap();
    let told = City::new(file)
        .expect_err("a table without units")
        .to_string();
    assert!(
        told.contains("types.csv") && told.contains("dy_mm"),
        "{told}"
    );
    let text = text.replace(
        "table = \"types.csv\"",
        "level = { high = 1950, low = 1960 }",
    );
    let told = CityFile::parse("city.toml", &text, Format::Toml, folder.path())
        .expect_err("years that fall");
    assert!(told.to_string().contains("rise from low to high"), "{told}");
}

/// A model of a pair holds the row in which the city ran it, so that both find the same drifts.
#[test]
fn models_of_pairs_repeat_what_the_city_ran() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[run]\ndraws = 12\nsample = 0\ntolerance = 0.001\n[gap]\nmedian = \"8 mm\"\n";
    let city = city(folder.path(), 200, text);
    let out = folder.path().join("out");
    run(&city, &out, None).unwrap();
    let cases = city.cases_for_tests(&out).unwrap();
    let mut compared = 0;
    let (mut draw, mut before) = (0, f64::NAN);
    for [_, _, row, impacts, pair, _, left_drift] in cases {
        draw = if pair == before { draw + 1 } else { 0 };
        before = pair;
        if row < 3.0 || impacts == 0.0 || compared == 12 {
            continue;
        }
        let text = city.model(pair as usize, draw, 0).unwrap();
        // A model strikes the nearest floors instead.
        if text.contains("strike columns") {
            continue;
        }
        let model = read_model_text("pair", &text, Format::Toml, folder.path());
        let input = model.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(input.model.buildings.len(), row as usize);
        let (_, said) = text.split_once("The pair is B").expect("which of the row");
        let (number, _) = said.split_once(' ').unwrap();
        let number: usize = number.parse().unwrap();
        let motion = input.motion.as_ref().unwrap().resolve().unwrap();
        let (_, _, summary) = run_and_summary(&input.model, &motion);
        let sides = [number - 1, number].map(|at| summary.buildings[at].response.drift_peak);
        let nearest = sides.map(|drift| (drift / left_drift - 1.0).abs());
        assert!(
            nearest[0].min(nearest[1]) < 5e-3,
            "pair {pair}, draw {draw}: {sides:?} and {left_drift}"
        );
        compared += 1;
    }
    assert!(compared > 4, "{compared}");
}

/// Of two buildings of 14 m one has four storeys and the other no number of them: floors of both stand at 3.5 m.
#[test]
fn floors_stand_by_the_height_with_or_without_storeys() {
    let folder = tempfile::tempdir().unwrap();
    let square = |from: f64| {
        let to = from + 10.0;
        format!("\"POLYGON(({from} 0,{to} 0,{to} 10,{from} 10,{from} 0))\"")
    };
    let text = format!(
        "id,storeys,height,wkt\na,4,14,{}\nb,,14,{}\n",
        square(0.0),
        square(10.1)
    );
    std::fs::write(folder.path().join("two.csv"), text).unwrap();
    let text = "[inventory]\nfile = \"two.csv\"\nmetres = true\n[buildings]\ntype = \"C1\"\n[motion]\nrecord = \"el-centro-1940-ns\"\n";
    let file = CityFile::parse("city.toml", text, Format::Toml, folder.path()).unwrap();
    let model = City::new(file).unwrap().model(0, 0, 0).unwrap();
    let heights: Vec<&str> = (model.lines())
        .filter(|line| line.starts_with("storey_height"))
        .collect();
    assert_eq!(
        heights,
        vec!["storey_height = [\"3.5 m\", \"3.5 m\", \"3.5 m\", \"3.5 m\"]"; 2]
    );
}

/// Taxonomy strings of GEM say the level of the code, the storeys and the year; what the inventory says itself holds before their storeys and
/// year.
#[test]
fn taxonomy_strings_give_level_storeys_and_year() {
    let folder = tempfile::tempdir().unwrap();
    let square = |from: f64| {
        let to = from + 10.0;
        format!("\"POLYGON(({from} 0,{to} 0,{to} 10,{from} 10,{from} 0))\"")
    };
    let rows = [
        "a,,1990,CR/LFINF+CDN/HEX:3",
        "b,2,1990,CR/LFM+CDL/HBET:4-6",
        "c,,,CR/LFM/H:4/YEX:1935",
        "d,,1990,CR/LFM/H:2",
    ];
    let rows = rows
        .iter()
        .zip(0..)
        .map(|(row, n)| format!("{row},{}\n", square(10.1 * f64::from(n))));
    let text = format!("id,storeys,year,taxonomy,wkt\n{}", rows.collect::<String>());
    std::fs::write(folder.path().join("gem.csv"), text).unwrap();
    let text = "[inventory]\nfile = \"gem.csv\"\nmetres = true\n[motion]\nrecord = \"el-centro-1940-ns\"\n";
    let file = CityFile::parse("city.toml", text, Format::Toml, folder.path()).unwrap();
    let model = City::new(file).unwrap().model(0, 0, 0).unwrap();
    for told in [
        "is a: C3L, pre code, 3 storeys",
        "is b: C1L, low code, 2 storeys",
        "is c: C1M, pre code, 4 storeys",
        "is d: C1L, high code, 2 storeys",
    ] {
        assert!(model.contains(told), "{told}: {model}");
    }
}
