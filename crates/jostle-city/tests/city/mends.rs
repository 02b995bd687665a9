//! What is wrong with footprints is mended or refused, and told.

use std::path::PathBuf;

use jostle_city::{Inventory, Neighbours, ReadOptions};

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

/// A ring of 40 m about a court of 30 m, in which a building of 29 m stands half a metre from all walls.
#[test]
fn courts_are_no_part_of_a_building() {
    let ring = "POLYGON((0 0, 40 0, 40 40, 0 40, 0 0),(5 5, 35 5, 35 35, 5 35, 5 5))";
    let inner = "POLYGON((5.5 5.5, 34.5 5.5, 34.5 34.5, 5.5 34.5, 5.5 5.5))";
    let text = format!("id,storeys,wkt\nring,4,\"{ring}\"\ninner,4,\"{inner}\"\n");
    let inventory = read("court.csv", &text).unwrap();
    assert!(inventory.mends.is_empty(), "{:?}", inventory.mends);
    let [ring, inner] = &inventory.buildings[..] else {
        panic!("two buildings");
    };
    assert!((ring.area - (1600.0 - 900.0)).abs() < 1e-9, "{}", ring.area);
    assert!((inner.area - 841.0).abs() < 1e-9, "{}", inner.area);
    let found = Neighbours::within(&inventory.buildings, 1.0);
    assert!(found.overlaps.is_empty());
    let [pair] = &found.pairs[..] else {
        panic!("one pair: {:?}", found.pairs);
    };
    assert!((pair.distance - 0.5).abs() < 1e-9, "{pair:?}");
    assert!((pair.face - 4.0 * 29.0).abs() < 1e-9, "{pair:?}");
}

/// Names of systems of coordinates in a file decide what its coordinates are.
#[test]
fn systems_of_coordinates_are_not_guessed() {
    let tried = |system: &str, metres: bool, first: bool| {
        let crs = format!("\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"{system}\"}}}}");
        // A square of 10 m, or of 1e-4 degrees.
        let side = if metres { 10.0 } else { 1e-4 };
        let [x, y] = [10.0 + side, 40.0 + side];
        let features = format!(
            "\"features\":[{{\"type\":\"Feature\",\"properties\":{{\"storeys\":2}},\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[[[10,40],[{x},40],[{x},{y}],[10,{y}],[10,40]]]}}}}]"
        );
        let members = match (system, first) {
            ("", _) => features,
            (_, true) => format!("{crs},{features}"),
            (_, false) => format!("{features}, {crs}"),
        };
        let text = format!("{{\"type\":\"FeatureCollection\",{members}}}");
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("crs.geojson");
        std::fs::write(&path, text).unwrap();
        let options = ReadOptions {
            metres,
            ..ReadOptions::default()
        };
        Inventory::read(&path, &options).map_err(|error| error.to_string())
    };
    for (system, metres) in [
        ("", false),
        ("", true),
        ("urn:ogc:def:crs:OGC:1.3:CRS84", false),
        ("EPSG:4326", false),
        ("urn:ogc:def:crs:EPSG::32610", true),
        ("urn:ogc:def:crs:EPSG::2154", true),
    ] {
        for first in [true, false] {
            assert!(tried(system, metres, first).is_ok(), "{system} {metres}");
        }
    }
    for (system, metres, wanted) in [
        ("urn:ogc:def:crs:EPSG::2227", true, "is in feet"),
        ("EPSG:3857", true, "at the equator alone"),
        (
            "http://www.opengis.net/def/crs/EPSG/0/3857",
            true,
            "at the equator alone",
        ),
        ("urn:ogc:def:crs:OGC:1.3:CRS84", true, "leave out metres"),
        ("urn:ogc:def:crs:EPSG::32610", false, "--metres"),
    ] {
        for first in [true, false] {
            let error = tried(system, metres, first).expect_err(system);
            assert!(error.contains(wanted) && error.contains(system), "{error}");
        }
    }
    // A house of 10 by 10 degrees.
    let text = "id,storeys,wkt\n1,2,\"POLYGON((0 0,10 0,10 10,0 10,0 0))\"\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("small.csv");
    std::fs::write(&path, text).unwrap();
    let error =
        Inventory::read(&path, &ReadOptions::default()).expect_err("a house as large as a land");
    let error = error.to_string();
    assert!(
        error.contains("row 1") && error.contains("km²") && error.contains("--metres"),
        "{error}"
    );
}

/// Columns that share an attribute, names that occur twice, dates, and what strings of GEM say.
#[test]
fn rows_say_what_they_can() {
    let square = |x: usize| format!("\"POLYGON(({x} 0,{0} 0,{0} 10,{x} 10,{x} 0))\"", x + 10);
    let text = format!(
        "id,levels,storeys,year,type,wkt\na,4,,12/05/1975,CR/LFINF+CDN/HEX:3,{}\nb,,3,c. 1900,CR/LFM+CDH/HEX:5/YEX:1990,{}\na,,,75,S/LFBR+CDL/HBET:4-8,{}\nc,2,5,1931-05,C1M,{}\n",
        square(0),
        square(100),
        square(200),
        square(300)
    );
    let found = read("rows.csv", &text).unwrap();
    let of = |row: usize| &found.buildings[row];
    let storeys: Vec<_> = found.buildings.iter().map(|own| own.storeys).collect();
    assert_eq!(storeys, [Some(4), Some(3), Some(6), Some(2)]);
    let years: Vec<_> = found.buildings.iter().map(|own| own.year).collect();
    assert_eq!(years, [Some(1975), Some(1900), None, Some(1931)]);
    let levels: Vec<_> = found
        .buildings
        .iter()
        .map(|own| own.level.map(|level| level.name()))
        .collect();
    assert_eq!(levels, [Some("pre"), Some("high"), Some("low"), None]);
    assert_eq!([&of(0).id, &of(2).id], ["a", "a (row 3)"]);
    let said: Vec<&str> = found
        .mends
        .iter()
        .map(|mend| mend.detail.as_str())
        .collect();
    assert!(
        said.iter()
            .any(|said| said.contains("row 1 has the name a too")),
        "{said:?}"
    );
    assert!(
        said.iter()
            .any(|said| said.contains("the year \"75\" is not read")),
        "{said:?}"
    );
}

/// Four storeys of 3.5 m whether the storeys are given or follow from the height; heights in feet are no storeys.
#[test]
fn heights_of_floors_are_those_of_the_inventory() {
    let text = "id,storeys,height,wkt\nboth,4,14,\"POLYGON((0 0,10 0,10 10,0 10,0 0))\"\nheight,,14,\"POLYGON((20 0,30 0,30 10,20 10,20 0))\"\nfeet,3,33,\"POLYGON((40 0,50 0,50 10,40 10,40 0))\"\n";
    let found = read("heights.csv", text).unwrap();
    let of = |row: usize| {
        let own: &jostle_city::Building = &found.buildings[row];
        (
            own.likely_storeys(),
            own.storey_height(),
            own.likely_height(),
        )
    };
    assert_eq!(of(0), (4, Some(3.5), 14.0));
    assert_eq!(of(1), (4, Some(3.5), 14.0));
    let (storeys, storey, height) = of(2);
    assert_eq!((storeys, storey), (3, None));
    assert!((height - 9.6).abs() < 1e-12);
}
