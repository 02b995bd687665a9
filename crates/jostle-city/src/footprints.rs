//! Footprints with their neighbours: what `city check` tells and `city pairs` writes.

use std::path::Path;

use jostle_classes::{Level, Types};
use jostle_io::TypesTables;

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

    /// Refuses types that a run would not know. `path` names the inventory, `table` the user's own table of types.
    ///
    /// # Errors
    /// When the table cannot be used, or a building has a type that it lacks.
    pub fn check_types(&self, path: &Path, table: Option<&Path>) -> Result<(), CityError> {
        let tables = TypesTables {
            types: table.map(Path::to_owned),
            ..TypesTables::default()
        };
        let types = Types::read(&tables).map_err(CityError::Input)?;
        for building in &self.inventory.buildings {
            let Some(kind) = &building.kind else {
                continue;
            };
            // The city file chooses the level.
            let of_level = |level| types.of(kind, building.likely_storeys(), level).err();
            let problems: Option<Vec<String>> = Level::ALL.into_iter().map(of_level).collect();
            if let Some(problem) = problems.and_then(|all| all.into_iter().next()) {
                let row = building.row;
                return Err(CityError::of(path, format!("row {row}: {problem}")));
            }
        }
        Ok(())
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
