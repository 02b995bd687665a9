//! Motions that differ from place to place, against runs of one motion everywhere.

use std::path::Path;

use geo::Centroid;
use jostle::Wave;
use jostle_city::{City, CityError, RunOptions, example_city};
use jostle_io::{CityFile, Format, MotionSpec};

/// Longitude and latitude in the middle of the made-up city, roughly \[°\].
const MIDDLE: [f64; 2] = [-30.0, 40.0];

fn city(folder: &Path, motion: &str) -> Result<City, CityError> {
    std::fs::write(folder.join("footprints.geojson"), example_city(60, 7)).unwrap();
    let text = format!(
        "[inventory]\nfile = \"footprints.geojson\"\n[gap]\nmedian = \"8 mm\"\n[run]\ndraws = 2\nsample = 0\n[motion]\n{motion}"
    );
    let file = CityFile::parse("city.toml", &text, Format::Toml, folder);
    City::new(file.map_err(|error| CityError::Input(error.to_string()))?)
}

/// Closing, gap, buildings of the row, impacts, pair, drift alone and in the row of every case.
fn cases(folder: &Path, motion: &str) -> (City, Vec<[f64; 7]>) {
    let city = city(folder, motion).unwrap_or_else(|error| panic!("{motion}: {error}"));
    let out = tempfile::tempdir().unwrap();
    city.run(out.path(), RunOptions::default(), &|| false, &mut |_| {})
        .unwrap();
    let cases = city.cases_for_tests(out.path()).unwrap();
    assert!(cases.len() > 20, "{} cases", cases.len());
    (city, cases)
}

fn near(one: &[[f64; 7]], other: &[[f64; 7]]) {
    assert_eq!(one.len(), other.len());
    for (a, b) in one.iter().zip(other) {
        for at in [0, 5, 6] {
            assert!((a[at] - b[at]).abs() <= 2e-4 * b[at].abs(), "{a:?} {b:?}");
        }
    }
}

/// El Centro, 8 s of it, as JSON in m/s².
fn record(components: &[(&str, f64)]) -> String {
    let motion = MotionSpec::record("el-centro-1940-ns").resolve().unwrap();
    let Wave::Sampled { step, acceleration } = motion.wave else {
        panic!("a record has samples")
    };
    let lists = components.iter().map(|(name, factor)| {
        let values: Vec<String> = acceleration[..=400]
            .iter()
            .map(|acceleration| format!("{:e}", factor * acceleration))
            .collect();
        format!("\"data_{name}\": [{}]", values.join(","))
    });
    let lists: Vec<String> = lists.collect();
    format!("{{\"dT\": {step}, {}}}", lists.join(", "))
}

#[test]
fn every_row_takes_the_motions_of_the_nearest_point_with_their_factors() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let ends = [MIDDLE[0], MIDDLE[0] + 0.0018];
    write(
        "EventGrid.csv",
        &format!(
            "GP_file,Longitude,Latitude\nwest.csv,{},{}\neast.csv,{},{}\n",
            ends[0], MIDDLE[1], ends[1], MIDDLE[1]
        ),
    );
    write("west.csv", "TH_file,factor\nRSN1,1\n");
    write("east.csv", "TH_file, factor\nRSN1.json, 0.5\n");
    write("RSN1.json", &record(&[("x", 1.0)]));
    let (city, found) = cases(folder.path(), "grid = \"EventGrid.csv\"\nunit = \"m/s2\"");
    assert!(
        city.told()[0].contains("2 of 2 points"),
        "{:?}",
        city.told()
    );
    let common = |scale: &str| {
        let text = format!("record = \"el-centro-1940-ns\"\nduration = \"8 s\"\nscale = {scale}");
        cases(folder.path(), &text).1
    };
    let both = [common("1"), common("0.5")];
    let points = ends.map(|x| city.inventory.plane.metres(geo::Coord { x, y: MIDDLE[1] }));
    let mut seen = [0, 0];
    for block in &city.blocks {
        let centres: Vec<_> = block
            .buildings
            .iter()
            .map(|at| city.inventory.buildings[*at].outline.centroid().unwrap().0)
            .collect();
        let mean = |of: &dyn Fn(&geo::Coord) -> f64| {
            centres.iter().map(of).sum::<f64>() / centres.len() as f64
        };
        let [x, y] = [mean(&|point| point.x), mean(&|point| point.y)];
        let distance = points.map(|point| (point.x - x).hypot(point.y - y));
        let nearest = usize::from(distance[1] < distance[0]);
        for pair in &block.pairs {
            let of = |all: &[[f64; 7]]| -> Vec<[f64; 7]> {
                let rows = all.iter().filter(|candidate| candidate[4] == *pair as f64);
                rows.copied().collect()
            };
            assert_eq!(of(&found), of(&both[nearest]), "pair {pair}");
            seen[nearest] += 1;
        }
    }
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?}");
    // The model of a pair has the record and the factor of its place.
    let text = city.model(0, 0, 0).unwrap();
    let wanted = ["RSN1.json", "component = \"x\"", "unit = \"m/s2\""];
    for wanted in wanted {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    // Rows run east: a motion to the north does not move them.
    write("RSN1.json", &record(&[("x", 0.0), ("y", 1.0)]));
    let (_, north) = cases(folder.path(), "grid = \"EventGrid.csv\"\nunit = \"m/s2\"");
    assert!(north.iter().all(|row| row[3] == 0.0 && row[0] < 1e-6));
}

#[test]
fn records_are_scaled_to_a_map_and_to_the_events_of_fields() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let common = |pga: &str| {
        let text = format!("record = \"el-centro-1940-ns\"\nduration = \"8 s\"\npga = \"{pga}\"");
        cases(folder.path(), &text).1
    };
    let [west, south] = MIDDLE.map(|coordinate| coordinate - 0.1);
    let mut data = String::new();
    for y in [south + 0.2, south] {
        for x in [west, west + 0.2] {
            data += &format!("{x} {y} 40\n");
        }
    }
    write(
        "grid.xml",
        &format!(
            "<?xml version=\"1.0\"?>\n<shakemap_grid xmlns=\"http://earthquake.usgs.gov/eqcenter/shakemap\">\n\
             <grid_specification lon_min=\"{west}\" lat_min=\"{south}\" lon_max=\"{}\" lat_max=\"{}\" nlon=\"2\" nlat=\"2\"/>\n\
             <grid_field index=\"1\" name=\"LON\" units=\"dd\"/><grid_field index=\"2\" name=\"LAT\" units=\"dd\"/>\n\
             <grid_field index=\"3\" name=\"PGA\" units=\"%g\"/>\n<grid_data>\n{data}</grid_data></shakemap_grid>",
            west + 0.2,
            south + 0.2
        ),
    );
    let records = "record = \"el-centro-1940-ns\"\nduration = \"8 s\"\n";
    let (_, found) = cases(folder.path(), &format!("{records}shakemap = \"grid.xml\""));
    near(&found, &common("0.4 g"));
    // Event 3 comes before event 10; at sites that are not listed the ground stands still.
    write(
        "sites.csv",
        &format!(
            "#,,\"written by a calculation\"\nsite_id,lon,lat\n7,{},{}\n8,{},{}\n",
            MIDDLE[0],
            MIDDLE[1],
            MIDDLE[0] + 0.09,
            MIDDLE[1]
        ),
    );
    write(
        "gmf.csv",
        "#,,\"written by a calculation\"\nevent_id,gmv_PGV,gmv_PGA,site_id\n10,1,0.9,8\n3,20,0.2,7\n",
    );
    let (city, found) = cases(
        folder.path(),
        &format!("{records}gmf = \"gmf.csv\"\nsites = \"sites.csv\""),
    );
    assert_eq!(city.motions(), ["event 3", "event 10"]);
    let by_event = |event: usize| -> Vec<[f64; 7]> {
        // Cases of a draw follow each other by motions.
        let rows = found.iter().enumerate();
        let rows = rows.filter(|(at, _)| at % 2 == event);
        rows.map(|(_, row)| *row).collect()
    };
    near(&by_event(0), &common("0.2 g"));
    assert!(by_event(1).iter().all(|row| row[0] == 0.0 && row[5] == 0.0));
}

#[test]
fn maps_that_do_not_fit_are_refused_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("far.csv", "GP_file,Longitude,Latitude\na.csv,10,40\n");
    write("here.csv", "GP_file,Longitude,Latitude\na.csv,-30,40\n");
    write("swapped.csv", "GP_file,Longitude,Latitude\na.csv,40,-130\n");
    write("a.csv", "TH_file,factor\nabsent,1\n");
    write("columns.csv", "file,x,y\na.csv,1,2\n");
    write("sites.csv", "site_id,lon,lat\n1,-30,40\n");
    write("other.csv", "event_id,site_id,gmv_PGA\n1,2,0.1\n");
    write("pgv.csv", "event_id,site_id,gmv_PGV\n1,1,0.1\n");
    write("strong.csv", "event_id,site_id,gmv_PGA\n1,1,30\n");
    write(
        "twice.csv",
        "event_id,site_id,gmv_PGA\n7,1,0.1\n8,1,0.1\n7,1,0.3\n",
    );
    write("word.csv", "event_id,site_id,gmv_PGA\n1,1,x\n");
    let record = "record = \"el-centro-1940-ns\"\n";
    for (motion, wanted) in [
        (
            "grid = \"far.csv\"\nunit = \"g\"".to_owned(),
            "farther than 10.0 km from every point",
        ),
        (
            "grid = \"here.csv\"\nunit = \"g\"".to_owned(),
            "there is no file",
        ),
        ("grid = \"here.csv\"".to_owned(), "unit = \"g\""),
        (
            "grid = \"here.csv\"\nunit = \"g\"\npga = \"1 g\"".to_owned(),
            "does not go with grid",
        ),
        (
            "grid = \"swapped.csv\"\nunit = \"g\"".to_owned(),
            "must lie between -90 and 90",
        ),
        (
            "grid = \"columns.csv\"\nunit = \"g\"".to_owned(),
            "has no column GP_file; its columns are file, x, y",
        ),
        (
            format!("{record}gmf = \"other.csv\""),
            "sites = \"sites.csv\"",
        ),
        (
            format!("{record}gmf = \"other.csv\"\nsites = \"sites.csv\""),
            "site 2 is not among",
        ),
        (
            format!("{record}gmf = \"pgv.csv\"\nsites = \"sites.csv\""),
            "neither gmv_PGA nor gmv_SA(T)",
        ),
        (
            format!("{record}gmf = \"word.csv\"\nsites = \"sites.csv\""),
            "line 2: PGA: expected a number",
        ),
        (
            format!("{record}gmf = \"twice.csv\"\nsites = \"sites.csv\""),
            "line 4: event 7 has a second row for site 1",
        ),
        (
            format!("{record}gmf = \"strong.csv\"\nsites = \"sites.csv\""),
            "line 2: PGA is 30: it must lie between 0 and 10 g",
        ),
        (
            format!("{record}gmf = \"other.csv\"\nsites = \"sites.csv\"\npga = \"1 g\""),
            "which scale the records",
        ),
        (format!("{record}choose = 2"), "needs intensities of places"),
        (format!("{record}shakemap = \"absent.xml\""), "absent.xml"),
    ] {
        let error = match city(folder.path(), &motion) {
            Ok(_) => panic!("{motion} was taken"),
            Err(error) => error.to_string(),
        };
        assert!(error.contains(wanted), "{wanted}: {error}");
    }
}
