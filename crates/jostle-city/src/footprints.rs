//! Footprints with their neighbours: what `city check` tells and `city pairs` writes.

use std::path::Path;

use crate::blocks::{Block, blocks};
use crate::fault::CityError;
use crate::inventory::{Inventory, ReadOptions};
use crate::neighbours::Neighbours;
use crate::tables::{refuse_overlaps, write_tables};

/// Footprints, the pairs within reach, and the blocks of these.
#[derive(Debug)]
pub struct Footprints {
    /// Buildings.
    pub inventory: Inventory,
    /// Pairs within reach.
    pub neighbours: Neighbours,
    /// Blocks of them.
    pub blocks: Vec<Block>,
    /// Buildings no farther apart are neighbours \[m\].
    pub reach: f64,
}

impl Footprints {
    /// Reads GeoJSON, GeoParquet or CSV, mends outlines and finds neighbours within `reach` \[m\].
    ///
    /// # Errors
    /// When the file cannot be used, or holds the same buildings twice.
    pub fn read(path: &Path, options: &ReadOptions, reach: f64) -> Result<Self, CityError> {
        let inventory = Inventory::read(path, options)?;
        let neighbours = Neighbours::within(&inventory.buildings, reach);
        refuse_overlaps(path, &inventory, &neighbours)?;
        let blocks = blocks(&neighbours.pairs, inventory.buildings.len());
        Ok(Self {
            inventory,
            neighbours,
            blocks,
            reach,
        })
    }

    /// Buildings that have a neighbour.
    #[must_use]
    pub fn with_neighbours(&self) -> usize {
        self.blocks.iter().map(|block| block.buildings.len()).sum()
    }

    /// Writes `buildings.parquet`, `pairs.parquet`, `blocks.parquet` and `mended.csv`.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), CityError> {
        write_tables(folder, &self.inventory, &self.neighbours, &self.blocks)
    }
}
