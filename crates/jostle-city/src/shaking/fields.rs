//! Ground motion fields of OpenQuake: a table of intensities in g of every event at every site, and a table of the sites.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::Path;

use jostle::statics::STANDARD_GRAVITY;

use super::intensities::{GREATEST, Intensities, measure_name};
use super::sites::{Nearest, degrees, number, rows};
use crate::blocks::Block;
use crate::fault::CityError;
use crate::inventory::Inventory;

/// Names of the column of sites.
const SITE: &[&str] = &["site_id", "sid", "custom_site_id"];

pub(super) fn read(
    path: &Path,
    sites: &Path,
    reach: f64,
    inventory: &Inventory,
    blocks: &[Block],
    place_of: &mut [u32],
) -> Result<Intensities, CityError> {
    let (mut names, mut points) = (Vec::new(), Vec::new());
    rows(
        sites,
        [SITE, &["lon", "longitude"], &["lat", "latitude"]],
        &mut |_| Ok(()),
        &mut |line, [site, longitude, latitude], _| {
            names.push(site.to_owned());
            points.push([
                degrees(sites, line, "lon", longitude)?,
                degrees(sites, line, "lat", latitude)?,
            ]);
            Ok(())
        },
    )?;
    let nearest = Nearest::of(sites, &points, reach, inventory, blocks)?;
    nearest.spread(blocks, place_of);
    let known: HashMap<&str, usize> = names.iter().map(String::as_str).zip(0..).collect();
    let place: HashMap<usize, usize> = nearest.used.iter().copied().zip(0..).collect();

    let mut periods: Vec<f64> = Vec::new();
    let mut columns: Vec<usize> = Vec::new();
    let mut events: BTreeMap<Event, usize> = BTreeMap::new();
    let mut values: Vec<(usize, usize, Vec<f64>)> = Vec::new();
    let mut seen: HashSet<(usize, usize)> = HashSet::new();
    let both = std::cell::RefCell::new((&mut periods, &mut columns));
    rows(
        path,
        [&["event_id", "eid"], SITE],
        &mut |header| {
            let (periods, columns) = &mut *both.borrow_mut();
            for (at, name) in header.iter().enumerate() {
                if let Some(period) = name.strip_prefix("gmv_").and_then(period) {
                    periods.push(period);
                    columns.push(at);
                }
            }
            if columns.is_empty() {
                return Err(CityError::of(
                    path,
                    format!(
                        "has neither gmv_PGA nor gmv_SA(T); its columns are {}",
                        header.join(", ")
                    ),
                ));
            }
            Ok(())
        },
        &mut |line, [event, site], row| {
            let named = [event, site];
            let Some(site) = known.get(site) else {
                return Err(CityError::of(
                    path,
                    format!(
                        "line {line}: site {site} is not among those of {}",
                        sites.display()
                    ),
                ));
            };
            let next = events.len();
            let event = *events.entry(Event::of(event)).or_insert(next);
            let Some(place) = place.get(site) else {
                return Ok(());
            };
            if !seen.insert((*place, event)) {
                return Err(CityError::of(
                    path,
                    format!(
                        "line {line}: event {} has a second row for site {}",
                        named[0], named[1]
                    ),
                ));
            }
            let (periods, columns) = &*both.borrow();
            let mut intensities = Vec::with_capacity(columns.len());
            for (at, period) in columns.iter().zip(periods.iter()) {
                let text = row.get(*at).unwrap_or("");
                let value = number(path, line, &measure_name(*period), text)?;
                if !(0.0..=GREATEST).contains(&value) {
                    return Err(CityError::of(
                        path,
                        format!(
                            "line {line}: {} is {value}: it must lie between 0 and {GREATEST} g",
                            measure_name(*period)
                        ),
                    ));
                }
                intensities.push(value * STANDARD_GRAVITY);
            }
            values.push((*place, event, intensities));
            Ok(())
        },
    )?;
    if events.is_empty() {
        return Err(CityError::of(path, "lists no event"));
    }
    // Events in the order of their numbers.
    let mut order = vec![0; events.len()];
    for (place, met) in events.values().enumerate() {
        order[*met] = place;
    }
    // What a calculation leaves out is too weak to matter: no shaking.
    let still = vec![0.0; periods.len()];
    let mut places = vec![vec![still; events.len()]; nearest.used.len()];
    let given = values.len();
    for (place, event, intensities) in values {
        places[place][order[event]] = intensities;
    }
    let greatest = places.iter().flatten().filter_map(|place| place.first());
    let greatest = greatest.copied().fold(0.0, f64::max);
    let all = places.len() * events.len();
    Ok(Intensities {
        told: format!(
            "{}: {} of {} sites stand next to a block, the farthest {:.1} km away; {} up to {:.3} g; {} are not listed and count as \
             no shaking",
            path.display(),
            nearest.used.len(),
            points.len(),
            1e-3 * nearest.farthest,
            measure_name(periods[0]),
            greatest / STANDARD_GRAVITY,
            all.saturating_sub(given)
        ),
        events: events.keys().map(Event::name).collect(),
        periods,
        places,
    })
}

/// The name of an event; numbers come first, in their order.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Event(Option<u64>, String);

impl Event {
    fn of(text: &str) -> Self {
        let number = text.parse().ok();
        Self(number.or(Some(u64::MAX)), text.to_owned())
    }

    fn name(&self) -> String {
        format!("event {}", self.1)
    }
}

/// The period of `PGA` or `SA(0.3)` \[s\]; `None` for other intensities.
fn period(name: &str) -> Option<f64> {
    if name == "PGA" {
        return Some(0.0);
    }
    let inside = name.strip_prefix("SA(")?.strip_suffix(')')?;
    let value: f64 = inside.parse().ok()?;
    (value > 0.0 && value <= 20.0).then_some(value)
}
