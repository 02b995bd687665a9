//! `floor_spectra` of `[output]`: which response spectra of floors are computed.

use jostle::model::Building;
use jostle_motion::spaced_periods;

use crate::keys::Section;
use crate::nearest::nearest;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader};
use crate::tree::Value;

/// Which response spectra of floors a run computes.
#[derive(Clone, Debug, PartialEq)]
pub struct FloorSpectraRequest {
    /// Index of the building and floor, from 1; in the order of buildings, from the ground up.
    pub floors: Vec<(usize, usize)>,
    /// Damping ratios of the oscillators, in `0..1` \[–\].
    pub dampings: Vec<f64>,
    /// Their periods, ≥ 0, rising \[s\].
    pub periods: Vec<f64>,
    /// Corner of the low-pass of the filtered peak, > 0 \[Hz\].
    pub low_pass: f64,
    /// Order of this filter: 2, 4, 6 or 8.
    pub order: usize,
}

/// Usual periods: first, last and number.
const PERIODS: (f64, f64, usize) = (0.02, 4.0, 100);
/// Usual damping ratio.
const DAMPING: f64 = 0.05;
/// Usual corner \[Hz\].
const LOW_PASS: f64 = 25.0;
/// Usual order of the filter.
const ORDER: usize = 4;
/// Most oscillators of a floor.
const MOST: usize = 20_000;
/// Shortest period besides zero \[s\], longest period \[s\].
const SHORTEST: f64 = 0.002;
const LONGEST: f64 = 1e3;

impl FloorSpectraRequest {
    /// Every floor, with 5 % damping, at a hundred periods from 0.02 s to 4 s.
    #[must_use]
    pub fn of_all_floors(buildings: &[Building]) -> Self {
        Self {
            floors: all_floors(buildings),
            dampings: vec![DAMPING],
            periods: spaced_periods(PERIODS.0, PERIODS.1, PERIODS.2),
            low_pass: LOW_PASS,
            order: ORDER,
        }
    }
}

fn all_floors(buildings: &[Building]) -> Vec<(usize, usize)> {
    let buildings = buildings.iter().enumerate();
    buildings
        .flat_map(|(index, building)| (1..=building.floors()).map(move |floor| (index, floor)))
        .collect()
}

/// Reads the request; `None` if nothing is asked for. Without buildings, faults of the rest are still found.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: Option<&[Building]>,
) -> Option<FloorSpectraRequest> {
    let buildings = buildings.unwrap_or_default();
    let mut request = FloorSpectraRequest::of_all_floors(buildings);
    match &field.node.value {
        Value::Flag(false) => return None,
        Value::Flag(true) => {}
        Value::List(_) => {
            request.floors = read_floors(reader, field, buildings);
        }
        Value::Table(_) => {
            let view = reader.open(field, &[Section::FloorSpectra])?;
            if let Some(field) = reader.get(&view, "floors") {
                request.floors = read_floors(reader, &field, buildings);
            }
            if let Some(field) = reader.get(&view, "damping") {
                request.dampings = read_dampings(reader, &field);
            }
            if let Some(field) = reader.get(&view, "periods") {
                request.periods = read_periods(reader, &field);
            }
            if let Some(field) = reader.get(&view, "low_pass")
                && let Some(corner) = reader.positive(&field, Dimension::Frequency)
            {
                if !(0.1..=500.0).contains(&corner) {
                    reader.bad(
                        &field,
                        format!("must lie between 0.1 Hz and 500 Hz, found {corner} Hz"),
                    );
                }
                request.low_pass = corner;
            }
            if let Some(field) = reader.get(&view, "order")
                && let Some(order) = reader.count(&field)
            {
                if !matches!(order, 2 | 4 | 6 | 8) {
                    reader.bad(&field, format!("must be 2, 4, 6 or 8, found {order}"));
                }
                request.order = order;
            }
            let most = request.periods.len() * request.dampings.len();
            if most > MOST {
                reader.bad(
                    field,
                    format!("periods times damping ratios must be at most {MOST}, found {most}"),
                );
            }
        }
        _ => {
            let found = field.node.describe();
            reader.bad(
                field,
                format!(
                    "expected true, false, a list of floors such as [\"J1.floor.5\"], or a table; found {found}"
                ),
            );
        }
    }
    Some(request)
}

/// Floors by name, each once, in the order of the buildings.
fn read_floors(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: &[Building],
) -> Vec<(usize, usize)> {
    let entries = match field.entries() {
        Some(entries) if entries.is_empty() => {
            *reader.bad(field, "is an empty list") =
                Some("name a floor, such as \"J1.floor.5\", or leave the key out".into());
            return Vec::new();
        }
        Some(entries) => entries,
        None => vec![field.clone()],
    };
    let mut floors = Vec::new();
    for entry in entries {
        let Some(name) = reader.text(&entry) else {
            continue;
        };
        // Without buildings their own faults are enough.
        if buildings.is_empty() {
            continue;
        }
        match find(&name, buildings) {
            Ok(found) => floors.extend(found),
            Err((problem, remedy)) => *reader.bad(&entry, problem) = remedy,
        }
    }
    floors.sort_unstable();
    floors.dedup();
    floors
}

/// Problem and remedy of a name.
type WrongName = (String, Option<String>);

/// The floors of a name.
fn find(name: &str, buildings: &[Building]) -> Result<Vec<(usize, usize)>, WrongName> {
    let index = |name: &str| buildings.iter().position(|building| building.name == name);
    if let Some(building) = index(name) {
        let floors = 1..=buildings[building].floors();
        return Ok(floors.map(|floor| (building, floor)).collect());
    }
    let parts = name.rsplit_once(".floor.");
    let Some((owner, number)) = parts else {
        let names = buildings.iter().map(|building| &building.name[..]);
        let near = nearest(name, names).map(|near| format!("did you mean \"{near}\"?"));
        let usual = || Some(format!("write \"{}.floor.1\"", buildings[0].name));
        return Err((
            format!("\"{name}\" is neither a building nor a floor such as \"J1.floor.5\""),
            near.or_else(usual),
        ));
    };
    let Some(building) = index(owner) else {
        let names: Vec<&str> = buildings.iter().map(|b| &b.name[..]).collect();
        return Err((
            format!(
                "there is no building \"{owner}\"; there are {}",
                names.join(", ")
            ),
            None,
        ));
    };
    let count = buildings[building].floors();
    match number.parse::<usize>() {
        Ok(floor) if (1..=count).contains(&floor) => Ok(vec![(building, floor)]),
        _ => Err((
            format!("\"{owner}\" has floors 1 to {count}, found \"{number}\""),
            None,
        )),
    }
}

fn read_dampings(reader: &mut Reader<'_>, field: &Field<'_>) -> Vec<f64> {
    let values = read_list(reader, field, Dimension::Dimensionless, |damping| {
        (!(0.0..1.0).contains(&damping))
            .then(|| format!("must lie from 0 to below 1, found {damping}"))
    });
    if values.is_empty() {
        vec![DAMPING]
    } else {
        values
    }
}

/// Periods in rising order, each once.
fn read_periods(reader: &mut Reader<'_>, field: &Field<'_>) -> Vec<f64> {
    let mut periods = read_list(reader, field, Dimension::Time, |period| {
        (period != 0.0 && !(SHORTEST..=LONGEST).contains(&period)).then(|| {
            format!("must be 0 or lie between {SHORTEST} s and {LONGEST} s, found {period} s")
        })
    });
    periods.sort_by(f64::total_cmp);
    periods.dedup();
    if periods.is_empty() {
        vec![PERIODS.0]
    } else {
        periods
    }
}

fn read_list(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    dimension: Dimension,
    problem: impl Fn(f64) -> Option<String>,
) -> Vec<f64> {
    let entries = match field.entries() {
        Some(entries) if entries.is_empty() => {
            reader.bad(field, "is an empty list");
            return Vec::new();
        }
        Some(entries) => entries,
        None => vec![field.clone()],
    };
    let mut values = Vec::new();
    for entry in entries {
        let Some(value) = reader.quantity(&entry, dimension) else {
            continue;
        };
        match problem(value) {
            Some(problem) => {
                reader.bad(&entry, problem);
            }
            None => values.push(value),
        }
    }
    values
}
