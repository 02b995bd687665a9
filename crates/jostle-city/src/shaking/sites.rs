//! Points with longitude and latitude, and which of them is next to a block.

use std::path::Path;

use geo::{Centroid, Coord};
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::blocks::Block;
use crate::fault::CityError;
use crate::inventory::Inventory;

/// Where a block stands in the plane \[m\]: the mean of the centres of its buildings.
pub(super) fn place(inventory: &Inventory, block: &Block) -> Coord {
    let centres = block.buildings.iter();
    let centres = centres.filter_map(|at| inventory.buildings[*at].outline.centroid());
    let (mut sum, mut count) = (Coord { x: 0.0, y: 0.0 }, 0.0);
    for centre in centres {
        sum = sum + centre.0;
        count += 1.0;
    }
    sum / f64::max(count, 1.0)
}

/// Of every block the nearest point.
#[derive(Debug)]
pub(super) struct Nearest {
    /// Points that are next to a block, in their order.
    pub(super) used: Vec<usize>,
    /// Of every block the place of its point among those.
    pub(super) of_block: Vec<usize>,
    /// Greatest distance \[m\].
    pub(super) farthest: f64,
}

impl Nearest {
    /// Finds them; `path` names the file of the points in messages.
    ///
    /// # Errors
    /// When there is no point, or a block is farther than `reach` \[m\] from every one.
    pub(super) fn of(
        path: &Path,
        points: &[[f64; 2]],
        reach: f64,
        inventory: &Inventory,
        blocks: &[Block],
    ) -> Result<Self, CityError> {
        let placed = points.iter().enumerate().map(|(at, [x, y])| {
            let metres = inventory.plane.metres(Coord { x: *x, y: *y });
            GeomWithData::new([metres.x, metres.y], at)
        });
        let tree = RTree::bulk_load(placed.collect());
        let mut nearest = Vec::with_capacity(blocks.len());
        let (mut farthest, mut beyond, mut first) = (0.0_f64, 0, None);
        for block in blocks {
            let here = place(inventory, block);
            let here = [here.x, here.y];
            let found = tree.nearest_neighbor(&here);
            let found = found.ok_or_else(|| CityError::of(path, "lists no point"))?;
            let [x, y] = found.geom();
            let distance = libm::hypot(x - here[0], y - here[1]);
            farthest = farthest.max(distance);
            if distance > reach {
                beyond += block.buildings.len();
                first = first.or(Some((block.buildings[0], distance)));
            }
            nearest.push(found.data);
        }
        if let Some((building, distance)) = first {
            return Err(CityError::of(
                path,
                format!(
                    "{beyond} buildings are farther than {:.1} km from every point, such as {} ({:.1} km): give a grid that covers \
                     the city, or a greater motion.site_reach",
                    1e-3 * reach,
                    inventory.buildings[building].id,
                    1e-3 * distance
                ),
            ));
        }
        let mut used = nearest.clone();
        used.sort_unstable();
        used.dedup();
        let of_block = nearest
            .iter()
            .map(|nearest| used.binary_search(nearest).unwrap_or_default())
            .collect();
        Ok(Self {
            used,
            of_block,
            farthest,
        })
    }

    /// Gives every building the place of its block.
    pub(super) fn spread(&self, blocks: &[Block], place_of: &mut [u32]) {
        spread(blocks, &self.of_block, place_of);
    }
}

/// Gives every building the place of its block.
pub(super) fn spread(blocks: &[Block], of_block: &[usize], place_of: &mut [u32]) {
    for (block, place) in blocks.iter().zip(of_block) {
        for building in &block.buildings {
            place_of[*building] = *place as u32;
        }
    }
}

/// Takes a row: its line, the fields of the named columns, and all of it.
pub(super) type Take<'t, const N: usize> =
    dyn FnMut(usize, [&str; N], &csv::StringRecord) -> Result<(), CityError> + 't;

/// Rows of a table of text by the names of columns; `names` are spellings of each column that is needed, `more` sees all names.
///
/// # Errors
/// When the file cannot be read or lacks a column.
pub(super) fn rows<const N: usize>(
    path: &Path,
    names: [&[&str]; N],
    more: &mut dyn FnMut(&[String]) -> Result<(), CityError>,
    take: &mut Take<'_, N>,
) -> Result<(), CityError> {
    let file = jostle_io::open_file(path).map_err(|error| CityError::of(path, error))?;
    let mut table = csv::ReaderBuilder::new()
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(file);
    let fault = |error: csv::Error| CityError::of(path, error);
    let header: Vec<String> = table
        .headers()
        .map_err(fault)?
        .iter()
        .map(|header| header.trim_start_matches('\u{feff}').to_owned())
        .collect();
    let mut columns = [0; N];
    for (column, spellings) in columns.iter_mut().zip(names) {
        let found = header.iter().position(|header| {
            spellings
                .iter()
                .any(|name| header.eq_ignore_ascii_case(name))
        });
        *column = found.ok_or_else(|| {
            CityError::of(
                path,
                format!(
                    "has no column {}; its columns are {}",
                    spellings[0],
                    header.join(", ")
                ),
            )
        })?;
    }
    more(&header)?;
    for row in table.records() {
        let row = row.map_err(fault)?;
        let line = row
            .position()
            .map_or(0, |position| position.line() as usize);
        let fields = columns.map(|at| row.get(at).unwrap_or(""));
        take(line, fields, &row)?;
    }
    Ok(())
}

/// A number of a table, which must be finite.
pub(super) fn number(path: &Path, line: usize, name: &str, text: &str) -> Result<f64, CityError> {
    let value = text.parse::<f64>().ok().filter(|number| number.is_finite());
    value.ok_or_else(|| {
        CityError::of(
            path,
            format!("line {line}: {name}: expected a number, found \"{text}\""),
        )
    })
}

/// A longitude or latitude of a table \[°\].
pub(super) fn degrees(path: &Path, line: usize, name: &str, text: &str) -> Result<f64, CityError> {
    let value = number(path, line, name, text)?;
    let most = if name.to_ascii_lowercase().starts_with("lat") {
        90.0
    } else {
        360.0
    };
    if value.abs() <= most {
        return Ok(value);
    }
    Err(CityError::of(
        path,
        format!("line {line}: {name}: must lie between -{most} and {most} degrees, found {value}"),
    ))
}
