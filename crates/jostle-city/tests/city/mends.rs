//! What is wrong with footprints is mended or refused, and told.

use std::path::PathBuf;

use jostle_city::{Inventory, ReadOptions};

fn read(name: &str, text: &str) -> Result<Inventory, String> {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    let options = ReadOptions {
        metres: true,
        ..ReadOptions::default()
    };
    Inventory::read(&path, &options).map_err(|error| error.to_string())
}

#[test]
fn rings_that_cross_or_touch_themselves_keep_their_largest_part() {
    // A bow tie of two triangles of 50 and 200 m²; a ring that touches itself at a point; a repeat; a shed.
    let text = "id,storeys,wkt\n\
        bow,2,\"POLYGON((0 0, 30 30, 30 10, 0 20, 0 0))\"\n\
        pinch,3,\"POLYGON((100 0, 110 0, 110 10, 105 10, 105 20, 115 20, 115 30, 100 30, 100 10, 105 10, 100 10, 100 0))\"\n\
        first,1,\"POLYGON((200 0, 210 0, 210 10, 200 10, 200 0))\"\n\
        twice,1,\"POLYGON((210 10, 200 10, 200 0, 210 0, 210 10))\"\n\
        shed,1,\"POLYGON((300 0, 303 0, 303 3, 300 3, 300 0))\"\n\
        gone,1,\n\
        two,1,\"MULTIPOLYGON(((400 0, 410 0, 410 10, 400 10, 400 0)),((420 0, 425 0, 425 5, 420 5, 420 0)))\"\n";
    let inventory = read("city.csv", text).unwrap();
    assert_eq!(inventory.rows, 7);
    let kept: Vec<(&str, f64)> = inventory
        .buildings
        .iter()
        .map(|building| (building.id.as_str(), building.area))
        .collect();
    let what: Vec<(&str, &str)> = inventory
        .mends
        .iter()
        .map(|mend| (mend.id.as_str(), mend.what))
        .collect();
    // The lines y = x and y = 20 − x/3 of the bow tie cross at x = 15: triangles of 150 m² each.
    let area = |name: &str| kept.iter().find(|candidate| candidate.0 == name).unwrap().1;
    assert!((area("bow") - 150.0).abs() < 1e-6, "{kept:?}");
    assert!((area("two") - 100.0).abs() < 1e-9);
    assert!(area("pinch") >= 100.0, "{kept:?}");
    for (name, word) in [
        ("bow", "mended"),
        ("twice", "repeat"),
        ("shed", "left out"),
        ("gone", "no outline"),
        ("two", "mended"),
    ] {
        assert!(what.contains(&(name, word)), "{what:?}");
    }
    assert_eq!(
        kept.len()
            + inventory
                .mends
                .iter()
                .filter(|own| own.what != "mended")
                .count(),
        7
    );
}

#[test]
fn footprints_of_r2d_are_read_from_a_column_of_json() {
    let outline = "{\"\"type\"\":\"\"Polygon\"\",\"\"coordinates\"\":[[[-122.26,37.85],[-122.2599,37.85],[-122.2599,37.8501],[-122.26,37.8501],[-122.26,37.85]]]}";
    let text = format!(
        "id,Latitude,Longitude,PlanArea,NumberOfStories,YearBuilt,StructureType,Footprint\n7,37.85,-122.26,1000,3,1927,URM,\"{outline}\"\n"
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r2d.csv");
    std::fs::write(&path, text).unwrap();
    let inventory = Inventory::read(&path, &ReadOptions::default()).unwrap();
    let building = &inventory.buildings[0];
    assert_eq!(
        (
            building.id.as_str(),
            building.storeys,
            building.year,
            building.kind.as_deref()
        ),
        ("7", Some(3), Some(1927), Some("URM"))
    );
    // 1e-4° of longitude and latitude there: 8.80 m and 11.10 m.
    assert!((building.area - 97.7).abs() < 0.2, "{}", building.area);
}

#[test]
fn what_cannot_be_used_is_refused_with_row_column_and_remedy() {
    for (name, text, wanted) in [
        (
            "points.csv",
            "id,Latitude,Longitude,storeys\n1,37,-122,3\n",
            "only points",
        ),
        ("none.csv", "id,storeys\n1,3\n", "--column footprint=NAME"),
        (
            "low.csv",
            "id,wkt\n1,\"POLYGON((0 0,10 0,10 10,0 10,0 0))\"\n",
            "how tall",
        ),
        (
            "word.csv",
            "id,storeys,wkt\n1,many,\"POLYGON((0 0,10 0,10 10,0 10,0 0))\"\n",
            "row 1: column \"storeys\"",
        ),
        ("empty.csv", "id,storeys,wkt\n", "no rows"),
        (
            "points.geojson",
            "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{\"storeys\":2},\"geometry\":{\"type\":\"Point\",\"coordinates\":[1,2]}}]}",
            "only points",
        ),
        (
            "broken.geojson",
            "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feat",
            "feature 1",
        ),
        ("city.shp", "", ".geojson"),
    ] {
        let error = read(name, text).expect_err(name);
        assert!(error.contains(wanted), "{name}: {error}");
        assert!(error.contains(name), "{name}: {error}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("metres.csv");
    std::fs::write(
        &path,
        "id,storeys,wkt\n1,2,\"POLYGON((500000 0,500010 0,500010 10,500000 10,500000 0))\"\n",
    )
    .unwrap();
    let error = Inventory::read(&path, &ReadOptions::default())
        .expect_err("metres")
        .to_string();
    assert!(error.contains("--metres"), "{error}");
}

#[test]
fn geometries_within_geometries_without_end_are_refused() {
    let deep = 100_000;
    let square = "POLYGON((0 0,10 0,10 10,0 10,0 0))";
    let nested = format!(
        "{}POINT(0 0){}",
        "GEOMETRYCOLLECTION(".repeat(deep),
        ")".repeat(deep)
    );
    let inventory = read(
        "deep.csv",
        &format!("id,storeys,wkt\n1,2,\"{nested}\"\n2,2,\"{square}\"\n"),
    )
    .unwrap();
    assert_eq!(inventory.buildings.len(), 1);
    assert_eq!(inventory.mends[0].what, "no outline");
    // WKB of a collection of a collection …; a square; and one that is cut short.
    let collection: Vec<u8> = [1, 7, 0, 0, 0, 1, 0, 0, 0].repeat(deep);
    let corners = [
        [0.0_f64, 0.0],
        [10.0, 0.0],
        [10.0, 10.0],
        [0.0, 10.0],
        [0.0, 0.0],
    ];
    let mut square: Vec<u8> =
        [[1, 3, 0, 0, 0, 1, 0, 0, 0].as_slice(), &5_u32.to_le_bytes()].concat();
    square.extend(
        corners
            .iter()
            .flatten()
            .flat_map(|corner| corner.to_le_bytes()),
    );
    let cut = square[..square.len() - 9].to_vec();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deep.parquet");
    let columns = vec![
        ("storeys".to_owned(), jostle_io::Values::Real(vec![2.0; 3])),
        (
            "geometry".to_owned(),
            jostle_io::Values::Bytes(vec![collection, square, cut]),
        ),
    ];
    jostle_io::write_values_parquet(&path, "deep", &[], columns).unwrap();
    let options = ReadOptions {
        metres: true,
        ..ReadOptions::default()
    };
    let inventory = Inventory::read(&path, &options).unwrap();
    assert_eq!(inventory.buildings.len(), 1);
    assert!((inventory.buildings[0].area - 100.0).abs() < 1e-9);
    assert_eq!(inventory.mends.len(), 2);
}

/// A ring of 40 m has a court of 30 m. One building stands in the court beside the western wall, one outside beside the eastern wall. A
/// court that crosses the edge of its building is subtracted.
#[test]
fn courts_are_no_area_and_their_walls_face_what_stands_inside() {
    let text = "id,storeys,wkt\n\
        ring,4,\"POLYGON((0 0, 40 0, 40 40, 0 40, 0 0),(5 5, 35 5, 35 35, 5 35, 5 5))\"\n\
        inside,4,\"POLYGON((5.1 10, 20 10, 20 30, 5.1 30, 5.1 10))\"\n\
        outside,4,\"POLYGON((40.2 0, 52 0, 52 30, 40.2 30, 40.2 0))\"\n\
        open,4,\"POLYGON((100 0, 120 0, 120 20, 100 20, 100 0),(110 5, 130 5, 130 15, 110 15, 110 5))\"\n";
    let inventory = read("courts.csv", text).unwrap();
    let areas: Vec<f64> = (inventory.buildings.iter())
        .map(|building| building.area)
        .collect();
    for (area, due) in areas.iter().zip([700.0, 298.0, 354.0, 300.0]) {
        assert!((area - due).abs() < 1e-9, "{areas:?}");
    }
    assert_eq!(inventory.mends.len(), 1, "{:?}", inventory.mends);
    let found = jostle_city::Neighbours::within(&inventory.buildings, 0.5);
    assert!(found.overlaps.is_empty());
    let pairs: Vec<_> = (found.pairs.iter())
        .map(|pair| (pair.buildings, pair.distance, pair.face, pair.normal))
        .collect();
    assert_eq!(pairs.len(), 2, "{pairs:?}");
    for ((buildings, distance, face, normal), due) in pairs
        .into_iter()
        .zip([([0, 1], 0.1, 20.0), ([0, 2], 0.2, 30.0)])
    {
        assert_eq!(buildings, due.0);
        assert!((distance - due.1).abs() < 1e-9 && (face - due.2).abs() < 1e-9);
        assert!(normal.abs() < 1e-9, "{normal}");
    }
}

/// Two houses of 10 m, 0.1 m apart, in Web Mercator at 37.77° north, as UTM, in feet, and as metres that nobody calls metres.
#[test]
fn reference_systems_are_followed_or_refused_by_name() {
    let write = |crs: &str, [x, y]: [f64; 2], scale: f64| {
        let house = |id: &str, from: f64| {
            let corners = [
                [0.0, 0.0],
                [10.0, 0.0],
                [10.0, 10.0],
                [0.0, 10.0],
                [0.0, 0.0],
            ];
            let corners =
                corners.map(|[a, b]| format!("[{},{}]", x + scale * (from + a), y + scale * b));
            format!(
                "{{\"type\":\"Feature\",\"properties\":{{\"id\":\"{id}\",\"storeys\":2}},\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[[{}]]}}}}",
                corners.join(",")
            )
        };
        let features = format!("[{},{}]", house("a", 0.0), house("b", 10.1));
        // Behind the features as well as before them.
        format!("{{\"type\":\"FeatureCollection\",\"features\":{features}{crs}}}")
    };
    let named = |name: &str| {
        format!(",\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"{name}\"}}}}")
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("city.geojson");
    let read = |text: String, metres: bool| {
        std::fs::write(&path, text).unwrap();
        let options = ReadOptions {
            metres,
            ..ReadOptions::default()
        };
        Inventory::read(&path, &options).map_err(|error| error.to_string())
    };
    // Longitude -122.42, latitude 37.7749, where lengths are 1.263 to 1.27 times as long. PROJ and its geodesic polygon give 99.5562 m².
    let mercator = [-13_627_732.06, 4_547_675.35];
    for metres in [false, true] {
        let text = write(&named("urn:ogc:def:crs:EPSG::3857"), mercator, 1.2634);
        let inventory = read(text, metres).unwrap();
        let area = inventory.buildings[0].area;
        assert!((area - 99.5562).abs() < 1e-4, "{area}");
    }
    let utm = named("urn:ogc:def:crs:EPSG::32633");
    let inventory = read(write(&utm, [50.0, 40.0], 1.0), true).unwrap();
    assert!((inventory.buildings[0].area - 100.0).abs() < 1e-9);
    let degrees = named("urn:ogc:def:crs:OGC:1.3:CRS84");
    assert!(read(write(&degrees, [20.0, 40.0], 1e-5), false).is_ok());
    for (crs, metres, wanted) in [
        (utm.clone(), false, "are metres: say so (--metres"),
        (degrees, true, "leave out --metres"),
        (named("urn:ogc:def:crs:EPSG::2227"), true, "EPSG::2227"),
        (",\"crs\":null".to_owned(), false, "no known system"),
        (String::new(), false, "--metres"),
    ] {
        let error = read(write(&crs, [0.0, 0.0], 1.0), metres).expect_err(wanted);
        assert!(error.contains(wanted), "{error}");
    }
    assert!(read(write(",\"crs\":null", [0.0, 0.0], 1.0), true).is_ok());
}

/// Rows of different origin name an attribute differently: each row has the first of the usual names that has a value there.
#[test]
fn columns_of_an_attribute_count_row_by_row() {
    let square = |x: usize| format!("\"POLYGON(({x} 0,{y} 0,{y} 10,{x} 10,{x} 0))\"", y = x + 10);
    let rows = [
        ("1", ",,4", 0),
        ("2", "3,12.5,", 20),
        ("3", ",,", 40),
        ("4", "3,,9", 60),
    ];
    let rows = rows.map(|(id, given, x)| format!("{id},{given},{}\n", square(x)));
    let text = format!(
        "id,storeys,roof_height,building:levels,wkt\n{}",
        rows.concat()
    );
    let inventory = read("mixed.csv", &text).unwrap();
    let storeys: Vec<_> = inventory.buildings.iter().map(|one| one.storeys).collect();
    assert_eq!(storeys, [Some(4), Some(3), None, Some(3)]);
    let named = &inventory.columns[&jostle_city::Attribute::Storeys];
    assert_eq!(*named, ["building:levels", "storeys"]);
}

/// Buildings with one id get names of their own, which no other building has.
#[test]
fn ids_given_more_than_once_are_told_apart() {
    let square = |x: usize| format!("\"POLYGON(({x} 0,{y} 0,{y} 10,{x} 10,{x} 0))\"", y = x + 10);
    let ids = ["a", "b", "a", "a#3", "a"];
    let rows = ids
        .iter()
        .zip(0..)
        .map(|(id, n)| format!("{id},2,{}\n", square(20 * n)));
    let text = format!("id,storeys,wkt\n{}", rows.collect::<String>());
    let inventory = read("ids.csv", &text).unwrap();
    let names: Vec<_> = inventory.buildings.iter().map(|one| &one.id[..]).collect();
    assert_eq!(names, ["a", "b", "a#3#", "a#3", "a#5"]);
    let told: Vec<_> = inventory
        .mends
        .iter()
        .map(|mend| (mend.row, mend.what))
        .collect();
    assert_eq!(told, [(3, "renamed"), (5, "renamed")]);
}

/// Years are read wherever they stand in a date; what has none is told.
#[test]
fn years_are_read_anywhere_in_a_date() {
    let square = |x: usize| format!("\"POLYGON(({x} 0,{y} 0,{y} 10,{x} 10,{x} 0))\"", y = x + 10);
    let given = [
        ("1975", Some(1975)),
        ("1975.0", Some(1975)),
        ("12/05/1975", Some(1975)),
        ("1931-05", Some(1931)),
        ("c. 1900", Some(1900)),
        ("1850s", Some(1850)),
        ("19750312", Some(1975)),
        ("2001-02-03T00:00:00Z", Some(2001)),
        ("75", None),
        ("12051975", None),
        ("9999", None),
        ("0", None),
        ("unknown", None),
    ];
    let rows = given
        .iter()
        .zip(0..)
        .map(|((year, _), n)| format!("{n},2,{year},{}\n", square(20 * n)));
    let text = format!(
        "id,storeys,year,wkt\n{}99,2,,{}\n",
        rows.collect::<String>(),
        square(2000)
    );
    let inventory = read("years.csv", &text).unwrap();
    for (building, (text, due)) in inventory.buildings.iter().zip(given) {
        assert_eq!(building.year, due, "{text}");
    }
    // A row without anything there has no year, and needs no word.
    let told = inventory.mends.iter().filter(|mend| mend.what == "no year");
    assert_eq!(told.count(), 5);
}

/// Heights that give no storey, such as 33 ft of three storeys, are left out with a word; pairs go by storeys then.
#[test]
fn heights_that_give_no_storey_are_left_out() {
    let square = |x: f64| {
        let y = x + 10.0;
        format!("\"POLYGON(({x} 0,{y} 0,{y} 10,{x} 10,{x} 0))\"")
    };
    let rows = [
        ("feet", "3,33"),
        ("metres", "3,9.6"),
        ("alone", ",14"),
        ("shed", ",1.5"),
    ];
    let rows = rows
        .iter()
        .zip(0..)
        .map(|((id, given), n)| format!("{id},{given},{}\n", square(10.1 * f64::from(n))));
    let text = format!("id,storeys,height,wkt\n{}", rows.collect::<String>());
    let inventory = read("heights.csv", &text).unwrap();
    let heights: Vec<_> = inventory.buildings.iter().map(|one| one.height).collect();
    assert_eq!(heights, [None, Some(9.6), Some(14.0), None]);
    let told: Vec<_> = inventory
        .mends
        .iter()
        .map(|mend| (mend.row, mend.what))
        .collect();
    assert_eq!(told, [(1, "no height"), (4, "no height")]);
    let found = jostle_city::Neighbours::within(&inventory.buildings, 0.5);
    assert!((found.pairs[0].height_ratio - 1.0).abs() < 1e-12);
    assert!(found.pairs[0].floor_offset.abs() < 1e-12);
}
