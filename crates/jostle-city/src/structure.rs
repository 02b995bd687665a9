//! The structure that stands for a building of the inventory.

use jostle_batch::Building as Shear;
use jostle_classes::{Class, Level, Types, lognormal};
use jostle_io::{CityFile, CityLevel};

use crate::draw::number_of;
use crate::fault::CityError;
use crate::inventory::Inventory;
use crate::mend::Mend;

/// Most storeys of a building that batches step.
const MOST_STOREYS: usize = 16;

/// A class, storeys and area.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    pub(crate) class: Class,
    pub(crate) storeys: usize,
    pub(crate) area: f64,
    /// Height of a storey \[m\].
    pub(crate) storey_height: f64,
    /// Number of its name.
    pub(crate) id: u64,
}

impl Structure {
    /// The building of a draw: stiffness, strength and damping scatter by the standard deviations of their logarithms.
    pub(crate) fn drawn(&self, draw: u64, scatter: [f64; 3]) -> Shear {
        let factor = |what: &str, sigma: f64| {
            if sigma > 0.0 {
                lognormal(self.id, draw, what, sigma)
            } else {
                1.0
            }
        };
        let [stiffness, strength, damping] = [
            factor("stiffness", scatter[0]),
            factor("strength", scatter[1]),
            factor("damping", scatter[2]),
        ];
        let mut building = self.class.building(self.storeys, self.area);
        for storey in &mut building.storeys {
            storey.height = self.storey_height;
            storey.stiffness *= stiffness;
            storey.first_corner *= strength / stiffness;
            storey.second_corner *= strength / stiffness;
        }
        // The same ratio of damping at the changed frequencies, but for its own scatter.
        building.alpha *= damping * stiffness.sqrt();
        building.beta *= damping / stiffness.sqrt();
        building
    }

    /// Damage state of a drift ratio: 0 none, 1 slight, 2 moderate, 3 extensive, 4 complete.
    pub(crate) fn state(&self, ratio: f64) -> usize {
        self.class
            .drifts
            .iter()
            .filter(|drift| ratio >= **drift)
            .count()
    }
}

/// The structures of all buildings; what had to be assumed is told.
pub(crate) fn structures(
    inventory: &Inventory,
    file: &CityFile,
    types: &Types,
) -> Result<(Vec<Structure>, Vec<Mend>), CityError> {
    let fault = |problem: String| CityError::of(&file.inventory, problem);
    let fixed = match &file.level {
        CityLevel::ByYear(_) => None,
        CityLevel::Of(name) => Some(
            name.parse::<Level>()
                .map_err(|problem| CityError::Input(format!("buildings.level: {problem}")))?,
        ),
    };
    // Also where every building has a type of its own.
    types
        .of(&file.kind, 1, fixed.unwrap_or(Level::Moderate))
        .map_err(|problem| CityError::Input(format!("buildings.type: {problem}")))?;
    let since = match &file.level {
        CityLevel::ByYear(Some(years)) => {
            let levels = [Level::Low, Level::Moderate, Level::High];
            let pairs = levels.into_iter().zip(years);
            pairs
                .filter_map(|(level, year)| Some((level, (*year)?)))
                .collect()
        }
        _ => Level::CALIFORNIA.to_vec(),
    };
    let mut mends = Vec::new();
    let mut all = Vec::with_capacity(inventory.buildings.len());
    for building in &inventory.buildings {
        let mut assumed = |detail: String| {
            mends.push(Mend {
                id: building.id.clone(),
                row: building.row,
                what: "assumed",
                detail,
            });
        };
        let known = building.likely_storeys();
        let storeys = known.min(MOST_STOREYS);
        if storeys < known {
            assumed(format!(
                "{MOST_STOREYS} storeys of {known}: taller ones are not stepped in batches"
            ));
        }
        let by_year = || {
            building
                .year
                .map_or(Level::Moderate, |year| Level::in_year(year, &since))
        };
        let level = building.level.or(fixed).unwrap_or_else(by_year);
        let kind = building.kind.as_deref().unwrap_or(&file.kind);
        let class = types
            .of(kind, storeys, level)
            .map_err(|problem| fault(format!("row {}: {problem}", building.row)))?;
        if !class.storeys.contains(&storeys) {
            assumed(format!(
                "{} for {storeys} storeys: the type is meant for {} to {}",
                class.name,
                class.storeys.start(),
                class.storeys.end()
            ));
        }
        // Floors stand where the inventory says, if that is a storey; else where the class has them.
        let storey_height = building.storey_height().unwrap_or(class.storey_height);
        if let (Some(height), None) = (building.height, building.storey_height()) {
            assumed(format!(
                "storeys of {storey_height:.2} m: {height} m is no height of {known} storeys"
            ));
        }
        all.push(Structure {
            class,
            storeys,
            area: building.area,
            storey_height,
            id: number_of(&building.id),
        });
    }
    Ok((all, mends))
}
