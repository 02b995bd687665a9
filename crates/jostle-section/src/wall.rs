//! Sections of reinforced-concrete walls: one rectangle, or two edges with ties and a web between them.

use std::collections::BTreeMap;
use std::sync::Arc;

use jostle::hysteresis::SpringFault;
use jostle::{Fibre, FibreLimit};

use crate::bars::{Bar, BarsError, Group, Reinforcement, Ties, parse_groups};
use crate::column_fibres::FibreOptions;
use crate::concrete::Concrete;
use crate::section::{Section, SectionFault};
use crate::steel::Steel;

/// Greatest share of bars in a web \[–\].
const MOST_STEEL: f64 = 0.1;

/// Reinforcement of a wall as written.
///
/// ```
/// use jostle_section::WallReinforcement;
///
/// // Two edges of 600 mm with eight bars each, and ten bars in the web between them, half of them at either face.
/// let bars = WallReinforcement::with_edges("8 d20", 0.6, Some("10 d10")).expect("understood");
/// assert!(matches!(bars, WallReinforcement::Edges { .. }));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum WallReinforcement {
    /// As that of a column: top is the left end of the wall.
    Whole(Reinforcement),
    /// Edges and a web.
    Edges {
        /// Of each edge.
        edge: Reinforcement,
        /// Length of each edge \[m\].
        length: f64,
        /// Bars of the web, an even number of each diameter.
        web: WebBars,
    },
}

/// Bars of a web in two layers, evenly spaced.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WebBars(Vec<Group>);

impl WallReinforcement {
    /// Reads the bars of an edge, such as `"8 d20"`, and those of a web, such as `"10 d10"`.
    ///
    /// # Errors
    /// [`BarsError`] with the part that is not understood.
    pub fn with_edges(edge: &str, length: f64, web: Option<&str>) -> Result<Self, BarsError> {
        let web = web.map_or(Ok(Vec::new()), parse_groups)?;
        if web.iter().any(|group| !group.count.is_multiple_of(2)) {
            return Err(BarsError::new(
                "the bars of a web are an even number, half of them at either face",
            ));
        }
        Ok(Self::Edges {
            edge: Reinforcement::parse(edge)?,
            length,
            web: WebBars(web),
        })
    }
}

impl WebBars {
    /// In the middle of equal parts of the length, a pair in each.
    fn lay(&self, thickness: f64, length: f64, cover: f64) -> Vec<Bar> {
        let of_group = |group: &Group| {
            let (pairs, diameter) = (group.count / 2, group.diameter);
            let inset = cover + 0.5 * diameter;
            (0..pairs).flat_map(move |pair| {
                let depth = length * (pair as f64 + 0.5) / pairs as f64;
                [inset, thickness - inset].map(|x| Bar { x, depth, diameter })
            })
        };
        self.0.iter().flat_map(of_group).collect()
    }
}

/// Section of a wall that bends along its length.
#[derive(Clone, Debug, PartialEq)]
pub struct WallSection {
    /// Rectangles from left to right, each with the place of its middle from the axis \[m\].
    pub parts: Vec<(f64, Section)>,
}

impl WallSection {
    /// Lays bars into a wall. Ties confine the edges, or all of a wall without edges. A fault names `width` for the thickness and
    /// `depth` for the length.
    ///
    /// # Errors
    /// Everything that is wrong, never empty.
    pub fn new(
        thickness: f64,
        length: f64,
        concrete: Concrete,
        steel: Steel,
        reinforcement: &WallReinforcement,
        cover: f64,
        ties: Option<Ties>,
    ) -> Result<Self, Vec<SectionFault>> {
        let rectangle = |length: f64, bars: &Reinforcement| {
            Section::new(thickness, length, concrete, steel, bars, cover, ties)
        };
        let (edge, edge_length, web) = match reinforcement {
            WallReinforcement::Whole(bars) => {
                let whole = rectangle(length, bars)?;
                return Ok(Self {
                    parts: vec![(0.0, whole)],
                });
            }
            WallReinforcement::Edges { edge, length, web } => (edge, *length, web),
        };
        let between = length - 2.0 * edge_length;
        let fault = |field, problem: String| vec![SectionFault { field, problem }];
        if between <= 0.0 {
            return Err(fault(
                "bars",
                format!(
                    "have edges of {edge_length} m, which leave nothing of the {length} m between them; make them shorter"
                ),
            ));
        }
        let edge = rectangle(edge_length, edge)?;
        let web = Section {
            depth: between,
            bars: web.lay(thickness, between, cover),
            ties: None,
            ..edge.clone()
        };
        let diameter = web.bars.iter().map(|bar| bar.diameter).fold(0.0, f64::max);
        if 2.0 * (cover + diameter) >= thickness {
            return Err(fault(
                "cover",
                format!("leaves no room for the bars of the web in {thickness} m"),
            ));
        }
        let share = web.steel_area() / web.area();
        if share > MOST_STEEL {
            return Err(fault(
                "bars",
                format!(
                    "fill {:.0} % of the web; more than {:.0} % cannot be placed",
                    100.0 * share,
                    100.0 * MOST_STEEL
                ),
            ));
        }
        let at = 0.5 * (length - edge_length);
        Ok(Self {
            parts: vec![(-at, edge.clone()), (0.0, web), (at, edge)],
        })
    }

    /// Its fibres from left to right, as [`Section::fibres`] of every part; layers are shared by length, two at least in each part.
    ///
    /// # Errors
    /// Numbers of the options out of range.
    pub fn fibres(&self, options: &FibreOptions) -> Result<Arc<[Fibre]>, Vec<SpringFault>> {
        let length: f64 = self.parts.iter().map(|(_, part)| part.depth).sum();
        let mut all = Vec::new();
        for (middle, part) in &self.parts {
            let share = options.layers as f64 * part.depth / length;
            let own = FibreOptions {
                layers: (share.round() as usize).max(2),
                ..*options
            };
            all.extend(part.fibres(&own)?.iter().map(|fibre| Fibre {
                at: [middle + fibre.at[0], fibre.at[1]],
                ..*fibre
            }));
        }
        Ok(all.into())
    }

    /// Strains at which its own materials fail, as [`Section::strain_limits`].
    #[must_use]
    pub fn strain_limits(&self) -> BTreeMap<FibreLimit, f64> {
        let parts = self.parts.iter();
        parts.flat_map(|(_, part)| part.strain_limits()).collect()
    }
}
