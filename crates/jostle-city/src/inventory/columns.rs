//! Which columns of an inventory mean what.

use std::collections::BTreeMap;
use std::str::FromStr;

/// What a column says of a building.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Attribute {
    /// Its name.
    Id,
    /// Its outline.
    Footprint,
    /// Storeys above the ground.
    Storeys,
    /// Height above the ground \[m\].
    Height,
    /// Year of construction.
    Year,
    /// Structural type.
    Type,
}

/// All of them with their names and the usual names of their columns in lower case: of R2D, OpenStreetMap, Overture and
/// common cadastres.
const USUAL: [(Attribute, &str, &[&str]); 6] = [
    (
        Attribute::Id,
        "id",
        &[
            "id",
            "building_id",
            "buildingid",
            "osm_id",
            "@id",
            "osmid",
            "fid",
            "gml_id",
        ],
    ),
    (
        Attribute::Footprint,
        "footprint",
        &[
            "footprint",
            "geometry",
            "wkt",
            "geom",
            "the_geom",
            "polygon",
            "wkb_geometry",
        ],
    ),
    (
        Attribute::Storeys,
        "storeys",
        &[
            "storeys",
            "stories",
            "storey",
            "story",
            "numberofstories",
            "number_of_stories",
            "num_floors",
            "levels",
            "building:levels",
            "building_levels",
            "floors",
            "n_storeys",
            "nstories",
        ],
    ),
    (
        Attribute::Height,
        "height",
        &[
            "height",
            "height_m",
            "building:height",
            "roof_height",
            "maxheight",
        ],
    ),
    (
        Attribute::Year,
        "year",
        &[
            "year",
            "year_built",
            "yearbuilt",
            "construction_year",
            "start_date",
            "built",
        ],
    ),
    (
        Attribute::Type,
        "type",
        &[
            "type",
            "structuretype",
            "structure_type",
            "structural_type",
            "taxonomy",
            "class",
            "hazus",
        ],
    ),
];

impl Attribute {
    /// Its name in messages and city files.
    #[must_use]
    pub fn name(self) -> &'static str {
        USUAL
            .iter()
            .find(|candidate| candidate.0 == self)
            .map_or("", |entry| entry.1)
    }
}

impl FromStr for Attribute {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        USUAL
            .iter()
            .find(|candidate| candidate.1 == name)
            .map(|entry| entry.0)
            .ok_or_else(|| {
                let known: Vec<&str> = USUAL.iter().map(|entry| entry.1).collect();
                format!("\"{name}\" is none of {}", known.join(", "))
            })
    }
}

/// Names of columns that differ from the usual ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns(pub BTreeMap<Attribute, String>);

impl Columns {
    /// What a column says, by its name in any case, and its place among the usual ones.
    pub(crate) fn attribute(&self, column: &str) -> Option<(Attribute, usize)> {
        if let Some((attribute, _)) = self.0.iter().find(|(_, name)| name.as_str() == column) {
            return Some((*attribute, 0));
        }
        let lower = column.trim().to_lowercase();
        let mut usual = USUAL.iter();
        usual.find_map(|(attribute, _, names)| {
            let rank = names.iter().position(|name| *name == lower)?;
            (!self.0.contains_key(attribute)).then_some((*attribute, rank))
        })
    }

    /// Names that stand for an attribute.
    pub(crate) fn names(&self, attribute: Attribute) -> Vec<String> {
        if let Some(column) = self.0.get(&attribute) {
            return vec![column.clone()];
        }
        let usual = USUAL.iter().find(|candidate| candidate.0 == attribute);
        usual.map_or_else(Vec::new, |usual| {
            usual.2.iter().map(|name| (*name).to_owned()).collect()
        })
    }
}
