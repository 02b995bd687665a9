//! `jostle city` from footprints to a map and a model.

use std::path::Path;

use crate::common::{complained, folder, jostle, printed};

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = jostle(folder, arguments);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        complained(&output)
    );
    printed(&output)
}

#[test]
fn a_city_goes_from_footprints_to_a_map_and_a_pair_to_a_model() {
    let folder = folder();
    let path = folder.path();
    done(path, &["city", "example", "demo", "--buildings", "120"]);
    let text = done(
        path,
        &["city", "check", "demo/city.geojson", "--reach", "0.3 m"],
    );
    assert!(text.contains("120 buildings of 120 rows"), "{text}");
    assert!(text.contains("within 0.3 m"), "{text}");
    done(
        path,
        &["city", "pairs", "demo/city.geojson", "--out", "tables"],
    );
    let text = done(
        path,
        &[
            "city",
            "run",
            "demo/city.toml",
            "--out",
            "out",
            "--draws",
            "2",
        ],
    );
    assert!(text.contains("struck by a neighbour"), "{text}");
    for name in [
        "index.html",
        "worst-pairs.csv",
        "buildings.parquet",
        "buildings.geojson",
        "pairs.parquet",
        "mended.csv",
    ] {
        assert!(path.join("out").join(name).exists(), "{name}");
    }
    // The map's own table of buildings is an inventory again.
    let text = done(path, &["city", "check", "out/buildings.parquet"]);
    assert!(text.contains("120 buildings of 120 rows"), "{text}");
    let first = std::fs::read(path.join("out/index.html")).expect("a page");
    done(path, &["city", "report", "out"]);
    assert!(std::fs::read(path.join("out/index.html")).expect("a page") == first);
    // A folder moved with its city file elsewhere is the same city.
    let model = done(
        path,
        &["city", "model", "out", "--pair", "0", "--draw", "1"],
    );
    std::fs::write(path.join("pair.toml"), model).expect("a model");
    done(path, &["check", "pair.toml"]);
}

#[test]
fn what_a_city_lacks_is_told_with_a_remedy() {
    let folder = folder();
    let path = folder.path();
    done(path, &["city", "example", "demo", "--buildings", "60"]);
    let file = std::fs::read_to_string(path.join("demo/city.toml")).expect("a city file");
    let changed = |name: &str, from: &str, to: &str| {
        assert!(file.contains(from), "{from}");
        std::fs::write(path.join("demo").join(name), file.replace(from, to)).expect("a city file");
    };
    changed("gap.toml", "median = \"25 mm\"", "median = \"25 kg\"");
    changed("key.toml", "draws = 5", "draw = 5");
    changed("type.toml", "type = \"C1\"", "type = \"C9\"");
    changed("none.toml", "city.geojson", "none.geojson");
    std::fs::write(path.join("points.csv"), "id,lat,lon,storeys\n1,2,3,4\n").expect("points");
    let square = "id,storeys,type,footprint\na,3,C1,\"POLYGON((0 0,9 0,9 9,0 9,0 0))\"\nb,3,C9,\"POLYGON((10 0,19 0,19 9,10 9,10 0))\"\n";
    std::fs::write(path.join("c9.csv"), square).expect("footprints");
    for (arguments, wanted) in [
        (&["city", "run", "demo/gap.toml"][..], "gap.toml:"),
        (&["city", "run", "demo/key.toml"], "draws"),
        (&["city", "run", "demo/none.toml"], "none.geojson"),
        (&["city", "run", "demo/type.toml"], "buildings.type"),
        (&["city", "check", "points.csv"], "only points"),
        (&["city", "check", "c9.csv", "--metres"], "\"C9\""),
        (
            &["city", "check", "c9.csv", "--metres", "--table", "no.csv"],
            "no.csv",
        ),
        (
            &["city", "check", "demo/city.geojson", "--column", "floors=X"],
            "storeys",
        ),
        (
            &["city", "check", "demo/city.geojson", "--reach", "5 kg"],
            "--reach",
        ),
        (&["city", "report", "demo"], "jostle city run"),
        (
            &["city", "run", "demo/city.toml", "--tolerance", "1"],
            "--tolerance",
        ),
        (&["city", "example", "demo"], "--force"),
    ] {
        let output = jostle(path, arguments);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{arguments:?}: {}",
            complained(&output)
        );
        assert!(
            complained(&output).contains(wanted),
            "{arguments:?}: {}",
            complained(&output)
        );
    }
}
