//! Tables of structural types that a city file or a classes file names.

use std::path::{Path, PathBuf};

use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Reader, View};

/// Tables of structural types and their damage, and what holds for all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct TypesTables {
    /// A table of types in place of that of HAZUS.
    pub types: Option<PathBuf>,
    /// A table of the drifts at which damage begins, in place of those of the types.
    pub damage: Option<PathBuf>,
    /// Mass of a floor per area of the building, where the table of types has none \[kg/m²\].
    pub area_mass: f64,
}

impl Default for TypesTables {
    fn default() -> Self {
        Self {
            types: None,
            damage: None,
            area_mass: 1000.0,
        }
    }
}

/// `[buildings]`, opened before, and `[damage]` of a file.
pub(crate) fn read(
    reader: &mut Reader<'_>,
    root: &View<'_>,
    buildings: Option<&View<'_>>,
    folder: &Path,
) -> Option<TypesTables> {
    let damage = reader.table(root, "damage", &[Section::TypesDamage]);
    let mut path = |view: Option<&View<'_>>| -> Option<Option<PathBuf>> {
        let Some(field) = view.and_then(|view| reader.get(view, "table")) else {
            return Some(None);
        };
        Some(Some(folder.join(reader.text(&field)?)))
    };
    let (types, damage) = (path(buildings), path(damage.as_ref()));
    let mass = buildings.and_then(|view| reader.get(view, "area_mass"));
    let area_mass = match mass {
        Some(field) => reader.positive(&field, Dimension::AreaMass)?,
        None => TypesTables::default().area_mass,
    };
    Some(TypesTables {
        types: types?,
        damage: damage?,
        area_mass,
    })
}
