//! `grid.xml` of a ShakeMap (USGS): PGA and spectral accelerations in %g on a regular grid of longitudes and latitudes.

use std::path::Path;

use jostle::statics::STANDARD_GRAVITY;
use jostle_io::read_text_file;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::intensities::{GREATEST, Intensities, measure_name};
use super::sites::{place, spread};
use crate::blocks::Block;
use crate::fault::CityError;
use crate::inventory::Inventory;

/// Largest file \[bytes\].
const LARGEST: usize = 1 << 30;

/// A column of the grid: its index from 0, its period \[s\] and the size of its unit \[m/s²\].
#[derive(Clone, Debug, PartialEq)]
struct Field {
    column: usize,
    period: f64,
    unit: f64,
}

/// A regular grid of intensities.
#[derive(Debug)]
struct Grid {
    event: String,
    columns: usize,
    longitude: usize,
    latitude: usize,
    fields: Vec<Field>,
    /// First longitude and latitude \[°\].
    first: [f64; 2],
    /// Spacing \[°\].
    spacing: [f64; 2],
    counts: [usize; 2],
    /// Of every point, longitude by longitude within a latitude, the intensities of all fields \[m/s²\].
    values: Vec<f64>,
}

pub(super) fn read(
    path: &Path,
    inventory: &Inventory,
    blocks: &[Block],
    place_of: &mut [u32],
) -> Result<Intensities, CityError> {
    let fault = |problem: String| CityError::of(path, problem);
    let text = read_text_file(path, LARGEST).map_err(|error| CityError::of(path, error))?;
    let grid = Grid::parse(&text).map_err(fault)?;
    let (mut outside, mut first) = (0, None);
    let mut places = Vec::with_capacity(blocks.len());
    for block in blocks {
        let at = inventory.plane.original(place(inventory, block));
        match grid.at([at.x, at.y]) {
            Some(intensities) => places.push(vec![intensities]),
            None => {
                outside += block.buildings.len();
                first = first.or(Some(block.buildings[0]));
            }
        }
    }
    if let Some(building) = first {
        let end =
            |axis: usize| grid.first[axis] + grid.spacing[axis] * (grid.counts[axis] - 1) as f64;
        return Err(fault(format!(
            "{outside} buildings lie outside the map, such as {}: it covers longitudes {} to {} and latitudes {} to {}",
            inventory.buildings[building].id,
            grid.first[0],
            end(0),
            grid.first[1],
            end(1)
        )));
    }
    spread(blocks, &(0..blocks.len()).collect::<Vec<_>>(), place_of);
    let ends = |field: &Field, at: usize| {
        let all = places.iter().map(|events: &Vec<Vec<f64>>| events[0][at]);
        let [least, most] = all.fold([f64::INFINITY, 0.0], |[least, most], event| {
            [f64::min(least, event), f64::max(most, event)]
        });
        format!(
            "{} {:.3} to {:.3} g",
            measure_name(field.period),
            least / STANDARD_GRAVITY,
            most / STANDARD_GRAVITY
        )
    };
    let fields = grid.fields.iter().enumerate();
    let shown: Vec<String> = fields.map(|(at, field)| ends(field, at)).collect();
    Ok(Intensities {
        periods: grid.fields.iter().map(|field| field.period).collect(),
        events: vec![grid.event.clone()],
        told: format!(
            "{}, {} × {} points: at the blocks {}",
            grid.event,
            grid.counts[0],
            grid.counts[1],
            shown.join(", ")
        ),
        places,
    })
}

impl Grid {
    fn parse(text: &str) -> Result<Self, String> {
        let mut reader = Reader::from_str(text);
        let mut event = "ShakeMap".to_owned();
        let mut names: Vec<(usize, String, String)> = Vec::new();
        let mut specification = None;
        let mut data: Option<String> = None;
        let mut inside = false;
        loop {
            let found = reader
                .read_event()
                .map_err(|error| format!("is no XML: {error}"))?;
            match found {
                Event::Start(element) | Event::Empty(element) => {
                    match element.local_name().as_ref() {
                        "event" => {
                            if let Some(name) = attribute(&element, "event_description")
                                .or_else(|| attribute(&element, "event_id"))
                            {
                                event = name;
                            }
                        }
                        "grid_specification" => specification = Some(corners(&element)?),
                        "grid_field" => {
                            let index = attribute(&element, "index")
                                .and_then(|attribute| attribute.parse().ok());
                            let index = index
                                .filter(|index| (1..=1000).contains(index))
                                .ok_or("a grid_field has no index from 1")?;
                            let name =
                                attribute(&element, "name").ok_or("a grid_field has no name")?;
                            names.push((
                                index,
                                name,
                                attribute(&element, "units").unwrap_or_default(),
                            ));
                        }
                        "grid_data" => inside = true,
                        _ => {}
                    }
                }
                Event::Text(event) if inside => {
                    data.get_or_insert_with(String::new).push_str(&event);
                }
                Event::End(end) if end.local_name().as_ref() == "grid_data" => inside = false,
                Event::Eof => break,
                _ => {}
            }
        }
        let (first, spacing, counts) =
            specification.ok_or("has no grid_specification: give the grid.xml of a ShakeMap")?;
        let data = data.ok_or("has no grid_data")?;
        let column = |wanted: &str| {
            let found = names
                .iter()
                .find(|name| name.1.eq_ignore_ascii_case(wanted));
            found
                .map(|name| name.0 - 1)
                .ok_or_else(|| format!("has no grid_field {wanted}"))
        };
        let [longitude, latitude] = [column("LON")?, column("LAT")?];
        let mut fields = Vec::new();
        for (index, name, units) in &names {
            let Some(period) = period(name) else { continue };
            let unit = match units.trim() {
                "%g" | "pctg" | "%(g)" => 0.01 * STANDARD_GRAVITY,
                "g" => STANDARD_GRAVITY,
                other => {
                    return Err(format!(
                        "the units of {name} are \"{other}\": %g or g is needed"
                    ));
                }
            };
            fields.push(Field {
                column: index - 1,
                period,
                unit,
            });
        }
        if fields.is_empty() {
            return Err("has neither PGA nor spectral accelerations (PSA03, PSA10, PSA30)".into());
        }
        let mut grid = Self {
            event,
            columns: names.iter().map(|name| name.0).max().unwrap_or(0),
            longitude,
            latitude,
            fields,
            first,
            spacing,
            counts,
            values: Vec::new(),
        };
        grid.fill(&data)?;
        Ok(grid)
    }

    /// Takes the rows of the grid, in any order.
    fn fill(&mut self, data: &str) -> Result<(), String> {
        let points = self.counts[0] * self.counts[1];
        self.values = vec![f64::NAN; points * self.fields.len()];
        let mut row = Vec::with_capacity(self.columns);
        let mut numbers = data.split_ascii_whitespace();
        for at in 1..=points {
            row.clear();
            for text in numbers.by_ref().take(self.columns) {
                let number = text.parse::<f64>();
                row.push(
                    number
                        .map_err(|_| format!("grid_data: \"{text}\" of point {at} is no number"))?,
                );
            }
            if row.len() < self.columns {
                return Err(format!("grid_data ends at point {at} of {points}"));
            }
            let mut place = [0; 2];
            for (axis, column) in [self.longitude, self.latitude].into_iter().enumerate() {
                let steps = (row[column] - self.first[axis]) / self.spacing[axis];
                let nearest = steps.round();
                if !((steps - nearest).abs() < 0.1
                    && nearest >= 0.0
                    && nearest < self.counts[axis] as f64)
                {
                    return Err(format!(
                        "point {at} at {} {} does not lie on the grid of grid_specification",
                        row[self.longitude], row[self.latitude]
                    ));
                }
                place[axis] = nearest as usize;
            }
            let start = (place[1] * self.counts[0] + place[0]) * self.fields.len();
            for (value, field) in self.values[start..].iter_mut().zip(&self.fields) {
                let row = row[field.column];
                // Where nothing is known, no shaking would be a guess.
                let of_g = row * field.unit / STANDARD_GRAVITY;
                if !(0.0..=GREATEST).contains(&of_g) {
                    return Err(format!(
                        "{} of point {at} is {row}: it must lie between 0 and {GREATEST} g",
                        measure_name(field.period)
                    ));
                }
                *value = row * field.unit;
            }
        }
        if numbers.next().is_some() {
            return Err(format!("grid_data has more than {points} points"));
        }
        if self.values.iter().any(|intensity| intensity.is_nan()) {
            return Err("grid_data has some points twice and others never".to_owned());
        }
        Ok(())
    }

    /// Intensities at a longitude and latitude, linear between points; `None` outside.
    fn at(&self, place: [f64; 2]) -> Option<Vec<f64>> {
        let mut cell = [0; 2];
        let mut share = [0.0; 2];
        for axis in 0..2 {
            let steps = (place[axis] - self.first[axis]) / self.spacing[axis];
            let most = (self.counts[axis] - 1) as f64;
            if !(0.0..=most).contains(&steps) {
                return None;
            }
            cell[axis] = (steps as usize).min(self.counts[axis] - 2);
            share[axis] = steps - cell[axis] as f64;
        }
        let count = self.fields.len();
        let mut intensities = vec![0.0; count];
        for (east, north) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let weigh = |side: usize, share: f64| if side == 1 { share } else { 1.0 - share };
            let weight = weigh(east, share[0]) * weigh(north, share[1]);
            let start = ((cell[1] + north) * self.counts[0] + cell[0] + east) * count;
            for (intensity, value) in intensities.iter_mut().zip(&self.values[start..]) {
                *intensity += weight * value;
            }
        }
        Some(intensities)
    }
}

/// The period of `PGA`, `PSA03`, `PSA0p3` or `SA(0.3)` \[s\]; `None` for other fields.
fn period(name: &str) -> Option<f64> {
    let upper = name.trim().to_ascii_uppercase();
    if upper == "PGA" {
        return Some(0.0);
    }
    let rest = upper
        .strip_prefix("PSA")
        .or_else(|| upper.strip_prefix("SA"))?;
    let rest = rest
        .trim_start_matches('(')
        .trim_end_matches(')')
        .replace('P', ".");
    let value: f64 = rest.parse().ok()?;
    let plain = rest.len() == 2 && !rest.contains('.');
    let value = if plain { value / 10.0 } else { value };
    (value > 0.0 && value <= 20.0).then_some(value)
}

/// First corner, spacing and counts of a grid.
type Corners = ([f64; 2], [f64; 2], [usize; 2]);

fn corners(element: &BytesStart<'_>) -> Result<Corners, String> {
    let number = |name: &str| {
        let text = attribute(element, name);
        let value = text.and_then(|attribute| attribute.parse::<f64>().ok());
        value
            .filter(|number| number.is_finite())
            .ok_or_else(|| format!("grid_specification has no number {name}"))
    };
    let first = [number("lon_min")?, number("lat_min")?];
    let last = [number("lon_max")?, number("lat_max")?];
    let counts = [number("nlon")?, number("nlat")?];
    if counts
        .iter()
        .any(|candidate| !(2.0..=1e5).contains(candidate) || candidate.fract() != 0.0)
    {
        return Err("grid_specification: nlon and nlat must lie between 2 and 100000".to_owned());
    }
    if counts[0] * counts[1] > 1e8 || last[0] <= first[0] || last[1] <= first[1] {
        return Err("grid_specification: there must be at most 1e8 points, from lon_min and lat_min to greater lon_max and lat_max".to_owned());
    }
    let spacing = [0, 1].map(|axis| (last[axis] - first[axis]) / (counts[axis] - 1.0));
    Ok((first, spacing, counts.map(|count| count as usize)))
}

fn attribute(element: &BytesStart<'_>, name: &str) -> Option<String> {
    let found = element.try_get_attribute(name).ok()??;
    let value = found.normalized_value(XmlVersion::Implicit1_0).ok()?;
    Some(value.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(data: &str) -> String {
        format!(
            "<shakemap_grid><event event_description=\"Somewhere\"/>\
             <grid_specification lon_min=\"10\" lat_min=\"40\" lon_max=\"10.2\" lat_max=\"40.1\" nlon=\"3\" nlat=\"2\"/>\
             <grid_field index=\"1\" name=\"LON\" units=\"dd\"/><grid_field index=\"2\" name=\"LAT\" units=\"dd\"/>\
             <grid_field index=\"3\" name=\"PGA\" units=\"%g\"/><grid_field index=\"4\" name=\"PGV\" units=\"cms\"/>\
             <grid_field index=\"5\" name=\"PSA03\" units=\"%g\"/><grid_data>{data}</grid_data></shakemap_grid>"
        )
    }

    const DATA: &str = "10 40.1 10 1 20\n10.1 40.1 20 1 40\n10.2 40.1 30 1 60\n10 40 50 1 1\n10.1 40 60 1 2\n10.2 40 70 1 3\n";

    #[test]
    fn a_plane_of_intensities_is_met_between_its_points() {
        let grid = Grid::parse(&map(DATA)).expect("a grid");
        assert_eq!(grid.event, "Somewhere");
        let periods: Vec<f64> = grid.fields.iter().map(|field| field.period).collect();
        assert_eq!(periods, [0.0, 0.3]);
        // PGA rises by 100 %g in a degree east and falls by 400 in a degree north.
        for [x, y] in [[10.0, 40.0], [10.13, 40.02], [10.2, 40.1]] {
            let found = grid.at([x, y]).expect("inside")[0];
            let wanted = 0.01 * STANDARD_GRAVITY * (50.0 + 100.0 * (x - 10.0) - 400.0 * (y - 40.0));
            assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
        }
        assert_eq!(grid.at([9.99, 40.0]), None);
        assert_eq!(grid.at([10.0, 40.11]), None);
    }

    #[test]
    fn damaged_maps_are_refused() {
        for (text, wanted) in [
            ("{}".to_owned(), "has no grid_specification"),
            (map("10 40.1 10 1 20"), "ends at point 2 of 6"),
            (map(&DATA.replace("60 1", "x 1")), "\"x\" of point 5"),
            (map(&format!("{DATA} 1")), "more than 6"),
            (map(&DATA.replace("10.1 40 60", "10.2 40 60")), "twice"),
            (
                map(&DATA.replace("10.1 40 60", "10.14 40 60")),
                "does not lie on",
            ),
            (map(&DATA.replace("50 1", "nan 1")), "PGA of point 4 is NaN"),
            (
                map(&DATA.replace("50 1", "5000 1")),
                "PGA of point 4 is 5000: it must lie",
            ),
            (map(DATA).replace("\"%g\"", "\"ln(g)\""), "units of PGA"),
            (
                map(DATA).replace("nlon=\"3\"", "nlon=\"1e9\""),
                "nlon and nlat",
            ),
        ] {
            let error = Grid::parse(&text).expect_err(wanted);
            assert!(error.contains(wanted), "{wanted}: {error}");
        }
    }

    #[test]
    fn periods_have_several_spellings() {
        for (name, wanted) in [
            ("PGA", Some(0.0)),
            ("PSA03", Some(0.3)),
            ("PSA10", Some(1.0)),
            ("PSA0p3", Some(0.3)),
            ("SA(1.0)", Some(1.0)),
            ("MMI", None),
            ("PGV", None),
            ("SVEL", None),
        ] {
            assert_eq!(period(name), wanted, "{name}");
        }
    }
}
