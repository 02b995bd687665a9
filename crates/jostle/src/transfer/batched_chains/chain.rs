//! A chain of columns: its entries of L, and the rows outside the chains that it couples to.

use crate::linear::counting_sort::in_order;
use crate::transfer::packed_factor::Place;

/// Coupling distance of links of a chain, and number of ends that couple to links from the beginning. Loops are
/// compiled for each case, so that their data stay in registers. Bending couples two displacements of a node and of
/// its neighbour; axial deformation, and members with a single mass, fewer.
const REACHES: [Reach; 4] = [
    Reach::new(1, 2),
    Reach::new(1, 4),
    Reach::new(3, 1),
    Reach::new(3, 2),
];

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    pub(super) band: usize,
    pub(super) near: usize,
}

impl Reach {
    const fn new(band: usize, near: usize) -> Self {
        Self { band, near }
    }

    /// Registers of a link: its inverse pivot, entries of L to the links behind it and to the near ends.
    pub(super) fn block(self) -> usize {
        1 + self.band + self.near
    }
}

/// A single chain.
pub(super) struct Chain {
    pub(super) reach: Reach,
    /// Its columns, ascending.
    pub(super) columns: Vec<u32>,
    /// Rows outside the chains that couple only to its last columns.
    pub(super) far: Vec<u32>,
    /// Rows that couple to earlier columns, up to the number for which loops are compiled.
    pub(super) near: Vec<u32>,
    /// Positions of factor entries in the order of the substitutions, link by link.
    pub(super) places: Vec<Place>,
}

impl Chain {
    /// All chains of a pattern, in the order of their last columns; none if couplings reach too far.
    pub(super) fn all(starts: &[usize], rows: &[u32], parent: &[u32]) -> Option<Vec<Self>> {
        let columns = starts.len() - 1;
        // A chain is known by its last column.
        let mut last: Vec<usize> = (0..columns).collect();
        for column in (0..columns).rev() {
            let next = parent[column] as usize;
            if next < columns && next != column {
                last[column] = last[next];
            }
        }
        let listed: Vec<(usize, u32)> = last.into_iter().zip(0..).collect();
        let by_chain = in_order(&listed, columns, |entry| entry.0);
        // Index of a column in its chain.
        let mut link = vec![0; columns];
        let chains = by_chain.chunk_by(|a, b| a.0 == b.0).map(|chunk| {
            for (place, (_, column)) in chunk.iter().enumerate() {
                link[*column as usize] = place;
            }
            let columns: Vec<u32> = chunk.iter().map(|(_, column)| *column).collect();
            let mut met = Vec::new();
            for (from, column) in columns.iter().enumerate() {
                let column = *column as usize;
                for place in starts[column]..starts[column + 1] {
                    let to = link.get(rows[place] as usize).copied();
                    met.push(Met {
                        from,
                        to: to.ok_or(rows[place]),
                        place: place as u32,
                    });
                }
            }
            let fitting = REACHES.into_iter();
            fitting
                .filter_map(|reach| Self::within(reach, &columns, &met))
                .min_by_key(|chain| chain.places.len())
        });
        chains.collect()
    }

    /// A chain with this coupling distance, if it couples no farther.
    fn within(reach: Reach, columns: &[u32], met: &[Met]) -> Option<Self> {
        // The first ones are near ends up to the available number.
        let (mut far, mut near) = (Vec::new(), Vec::new());
        for Met { from, to, .. } in met {
            let Err(row) = *to else { continue };
            if far.contains(&row) || near.contains(&row) {
                continue;
            }
            if near.len() < reach.near {
                near.push(row);
            } else if columns.len() + far.len() - from <= reach.band {
                far.push(row);
            } else {
                return None;
            }
        }
        let links = columns.len() + far.len();
        let mut places = vec![Place::Zero; links * reach.block()];
        for link in 0..links {
            let column = columns.get(link);
            places[link * reach.block()] = column.map_or(Place::One, |c| Place::InversePivot(*c));
        }
        for Met { from, to, place } in met {
            let to = to.or_else(|row| {
                let end = far.iter().position(|end| *end == row);
                end.map(|end| columns.len() + end).ok_or(row)
            });
            let slot = match to {
                Ok(link) => {
                    let back = reach.band.checked_sub(link - from)?;
                    link * reach.block() + 1 + back
                }
                Err(row) => {
                    let end = near.iter().position(|end| *end == row)?;
                    from * reach.block() + 1 + reach.band + end
                }
            };
            places[slot] = Place::Lower(*place);
        }
        // Missing near ends receive zeros, and their values are not used.
        let spare = near.first().or(far.first()).or(columns.last());
        let spare = spare.copied().unwrap_or(0);
        near.resize(reach.near, spare);
        Some(Self {
            reach,
            columns: columns.to_vec(),
            far,
            near,
            places,
        })
    }

    /// Whether all its columns have a constant offset to those of an equal chain.
    pub(super) fn is_beside(&self, other: &Self, places: usize) -> bool {
        let alike = self.reach == other.reach
            && self.columns.len() == other.columns.len()
            && self.far.len() == other.far.len();
        let mut pairs = self.columns.iter().zip(&other.columns);
        alike && pairs.all(|(candidate, its)| *candidate == its + places as u32)
    }
}

/// A coupling of a link to another link, or to a row outside the chains.
struct Met {
    from: usize,
    to: Result<usize, u32>,
    place: u32,
}
