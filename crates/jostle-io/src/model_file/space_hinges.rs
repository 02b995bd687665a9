//! `hinges` of a space frame, and `hinge` of some of its columns and beams.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::{PlanAxis, SpaceSection};

use super::building::has_length;
use super::fibre_hinges::{self, AskedFibres};
use super::hinges::{Initial, note, read_initial, read_moments, read_rule, read_rule_at};
use super::surface_hinges::{self, AskedSurfaces};
use crate::keys::Section;
use crate::reader::{Field, Reader, View};

/// Moments of the hinges of a member: by plane of bending, with the table that has them; `None` stays elastic.
pub(super) type Moments<'n> = [Option<([Corners; 2], Field<'n>)>; 2];

/// `hinges` of a building.
pub(super) struct SpaceHinges<'n> {
    rule: HysteresisRule,
    initial: Initial,
    /// One for all storeys, or one per storey; none stay elastic.
    columns: Vec<Moments<'n>>,
    beams: Vec<Moments<'n>>,
    /// How columns are cut into fibres, if they are.
    pub(super) fibres: Option<AskedFibres>,
    /// How columns yield on surfaces, if they do.
    pub(super) surfaces: Option<AskedSurfaces>,
}

/// Keys that hinges of frames in one plane have, and those of a space frame have not.
const OF_SECTIONS: [&str; 2] = ["from", "method"];

impl<'n> SpaceHinges<'n> {
    /// Reads `hinges` of a building with this number of storeys; `None` without the table, or after a fault.
    pub(super) fn read(
        reader: &mut Reader<'_>,
        building: &View<'n>,
        storeys: usize,
    ) -> Option<Self> {
        let field = reader.get(building, "hinges")?;
        let view = reader.open(&field, &[Section::SpaceHinges, Section::Hinges])?;
        for key in OF_SECTIONS {
            if let Some(field) = reader.get(&view, key) {
                *reader.bad(&field, "is not possible for space frames yet") = Some(
                    "give the moments of column and beam; \"jostle section\" computes them from bars"
                        .into(),
                );
                return None;
            }
        }
        let of_fibres = fibre_hinges::asked(reader, &view);
        let of_surfaces = surface_hinges::asked(reader, &view);
        if !of_surfaces {
            surface_hinges::refuse(reader, &view, true);
        }
        let rule = if of_fibres || of_surfaces {
            if let Some(field) = reader.get(&view, "column") {
                fibre_hinges::say_either(reader, &field, name_of(of_fibres));
            }
            match view.has("beam_rule") {
                true => read_rule_at(reader, &view, "beam_rule"),
                false => Some(HysteresisRule::PeakOriented),
            }
        } else {
            fibre_hinges::refuse(reader, &view);
            read_rule(reader, &view)
        };
        let fibres = match of_fibres {
            true => Some(AskedFibres::read(reader, &view, true)?),
            false => None,
        };
        let surfaces = match of_surfaces {
            true => Some(AskedSurfaces::read(reader, &view)?),
            false => None,
        };
        let initial = read_initial(reader, &view);
        let [columns, beams] = ["column", "beam"].map(|key| {
            let Some(field) = reader.get(&view, key) else {
                return Some(Vec::new());
            };
            let entries = field.entries();
            if let Some(entries) = &entries {
                has_length(reader, &field, entries.len(), Some(storeys))?;
            }
            let tables = entries.unwrap_or_else(|| vec![field.clone()]);
            let read = tables.iter().map(|table| {
                let rigid = initial == Some(Initial::Rigid);
                moments(reader, table, key == "column", rule, rigid)
            });
            let read: Vec<_> = read.collect();
            read.into_iter().collect()
        });
        Some(Self {
            rule: rule?,
            initial: initial?,
            columns: columns?,
            beams: beams?,
            fibres,
            surfaces,
        })
    }

    /// Whether ends of columns follow their axial force.
    pub(super) fn follows_axial_force(&self) -> bool {
        self.fibres.is_some() || self.surfaces.is_some()
    }

    /// Whether no member has moments here.
    pub(super) fn is_empty(&self) -> bool {
        self.columns.is_empty() && self.beams.is_empty()
    }

    /// Reads `hinge` of some members.
    pub(super) fn of_entry(
        &self,
        reader: &mut Reader<'_>,
        field: &Field<'n>,
        is_column: bool,
    ) -> Option<Moments<'n>> {
        if is_column && self.follows_axial_force() {
            fibre_hinges::say_either(reader, field, name_of(self.fibres.is_some()));
            return None;
        }
        let rigid = self.initial == Initial::Rigid;
        moments(reader, field, is_column, Some(self.rule), rigid)
    }

    /// Moments of a column or a beam of a storey without a `hinge` of its own.
    pub(super) fn usual(&self, is_column: bool, storey: usize) -> Option<&Moments<'n>> {
        let list = if is_column {
            &self.columns
        } else {
            &self.beams
        };
        list.get(if list.len() > 1 { storey } else { 0 })
    }

    /// The hinges of a member.
    ///
    /// # Errors
    /// Noted at the table of the moments.
    pub(super) fn springs(
        &self,
        reader: &mut Reader<'_>,
        moments: &Moments<'n>,
        section: &SpaceSection,
        length: f64,
    ) -> Result<[Option<Hysteresis>; 2], ()> {
        let mut found = [None; 2];
        for (plane, moments) in moments.iter().enumerate() {
            let Some((sides, field)) = moments else {
                continue;
            };
            let stiffness = self
                .initial
                .stiffness(section.flexural_rigidity[plane], length);
            let [a, b] = sides.map(|side| {
                if self.rule == HysteresisRule::Elastic {
                    side
                } else {
                    self.initial.ratios(side)
                }
            });
            let spring = Backbone::from_forces(stiffness, a, b)
                .and_then(|backbone| Hysteresis::new(self.rule, backbone));
            match spring {
                Ok(spring) => found[plane] = Some(spring),
                Err(faults) => {
                    note(reader, field, faults);
                    return Err(());
                }
            }
        }
        Ok(found)
    }
}

/// The rule of columns that follow their axial force.
fn name_of(of_fibres: bool) -> &'static str {
    match of_fibres {
        true => "fibre",
        false => "surface",
    }
}

/// Moments of a table: of a beam in its plane; of a column in both planes alike, or in those of `x` and `y`.
fn moments<'n>(
    reader: &mut Reader<'_>,
    field: &Field<'n>,
    is_column: bool,
    rule: Option<HysteresisRule>,
    rigid: bool,
) -> Option<Moments<'n>> {
    let sections: &'static [Section] = if is_column {
        &[Section::ColumnHinge]
    } else {
        &[Section::Hinge, Section::ColumnHinge]
    };
    let view = reader.open(field, sections)?;
    let axes = PlanAxis::BOTH.map(|axis| reader.get(&view, axis.name()));
    if !is_column {
        if let Some(axis) = axes.iter().flatten().next() {
            *reader.bad(
                axis,
                "has no meaning for a beam: rigid floors let it bend in its vertical plane only",
            ) = Some("give yield and the others without x and y".into());
            return None;
        }
        let sides = read_moments(reader, field, &view, None, rule, rigid)?;
        return Some([Some((sides, field.clone())), None]);
    }
    if axes.iter().all(Option::is_none) {
        let sides = read_moments(reader, field, &view, None, rule, rigid)?;
        return Some([0, 1].map(|_| Some((sides, field.clone()))));
    }
    for key in ["positive", "negative"] {
        if let Some(side) = reader.get(&view, key) {
            *reader.bad(&side, "is given together with x or y") =
                Some(format!("move {key} into x and y"));
            return None;
        }
    }
    let mut found = [None, None];
    let mut sound = true;
    for (axis, found) in axes.into_iter().zip(&mut found) {
        let Some(axis) = axis else { continue };
        let axis_view = reader.open(&axis, &[Section::Hinge]);
        let sides = axis_view.and_then(|axis_view| {
            read_moments(reader, &axis, &axis_view, Some(&view), rule, rigid)
        });
        sound &= sides.is_some();
        *found = sides.map(|sides| (sides, axis));
    }
    sound.then_some(found)
}
