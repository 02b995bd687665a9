//! `hinges` of a space frame, and `hinge` of some of its columns and beams.

use jostle::hysteresis::{Hysteresis, HysteresisRule};
use jostle::{PlanAxis, SpaceMember};
use jostle_section::capacity::SteelMember;

use super::building::has_length;
use super::fibre_hinges::{self, AskedFibres};
use super::hinge_stiffness::{Initial, read_initial};
use super::hinges::{Asked, Stated, YIELDS_WHERE, note, read_moments, read_rule, read_rule_at};
use super::reinforced;
use super::surface_hinges::{self, AskedSurfaces};
use crate::keys::Section;
use crate::reader::{Field, Reader, View};

/// Moments of the hinges of a member: by plane of bending, with the table that has them; `None` stays elastic.
pub(super) type Moments<'n> = [Option<(Stated, Field<'n>)>; 2];

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
            let is_column = key == "column";
            let asked = Asked {
                rule,
                rigid: initial == Some(Initial::Rigid),
                has_profile: has_profile(reader, building, is_column),
            };
            let read = tables
                .iter()
                .map(|table| moments(reader, table, is_column, asked));
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

    /// Reads `hinge` of some members, whose table is this.
    pub(super) fn of_entry(
        &self,
        reader: &mut Reader<'_>,
        entry: &View<'_>,
        field: &Field<'n>,
        is_column: bool,
    ) -> Option<Moments<'n>> {
        if is_column && self.follows_axial_force() {
            fibre_hinges::say_either(reader, field, name_of(self.fibres.is_some()));
            return None;
        }
        let asked = Asked {
            rule: Some(self.rule),
            rigid: self.initial == Initial::Rigid,
            has_profile: entry.has("yield_strength"),
        };
        moments(reader, field, is_column, asked)
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

    /// The hinges of a member. `steel`: its profile, if its strength is known, and the axial compression \[N\].
    ///
    /// # Errors
    /// Noted at the table of the moments.
    pub(super) fn springs(
        &self,
        reader: &mut Reader<'_>,
        moments: &Moments<'n>,
        member: &SpaceMember,
        length: f64,
        steel: Option<(&SteelMember, f64)>,
    ) -> Result<[Option<Hysteresis>; 2], ()> {
        let mut found = [None; 2];
        for (plane, moments) in moments.iter().enumerate() {
            let Some((stated, field)) = moments else {
                continue;
            };
            let place = member.place;
            let moment = match (stated.needs_profile(), steel) {
                (false, _) => None,
                (true, Some((steel, compression))) => {
                    let axis = steel.axes()[plane];
                    match reinforced::yield_moment(steel, axis, compression) {
                        Ok(moment) => Some(moment),
                        Err(problem) => {
                            reader.bad(field, format!("{place}: {problem}"));
                            return Err(());
                        }
                    }
                }
                (true, None) => {
                    *reader.bad(
                        field,
                        format!("has no yield, and {place} no yield_strength"),
                    ) = Some(YIELDS_WHERE.into());
                    return Err(());
                }
            };
            let rigidity = member.section.flexural_rigidity[plane];
            let stiffness = self.initial.stiffness(rigidity, length);
            match stated.spring(self.rule, self.initial, stiffness, moment) {
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

/// Whether a column, or a beam, of a building has a profile whose strength is given.
fn has_profile(reader: &mut Reader<'_>, building: &View<'_>, is_column: bool) -> bool {
    let (keys, sections): (&[&'static str], &'static [Section]) = match is_column {
        true => (&["column"], &[Section::SpaceColumn]),
        false => (&["beam_x", "beam_y"], &[Section::SpaceBeam]),
    };
    keys.iter().any(|key| {
        let field = reader.get(building, key);
        let tables = field.map(|field| field.entries().unwrap_or_else(|| vec![field]));
        tables.into_iter().flatten().any(|table| {
            let view = reader.quietly(|reader| reader.reopen(&table, sections));
            view.is_some_and(|view| view.has("yield_strength"))
        })
    })
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
    asked: Asked,
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
        let sides = read_moments(reader, field, &view, None, asked)?;
        return Some([Some((sides, field.clone())), None]);
    }
    if axes.iter().all(Option::is_none) {
        let sides = read_moments(reader, field, &view, None, asked)?;
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
        let sides = axis_view
            .and_then(|axis_view| read_moments(reader, &axis, &axis_view, Some(&view), asked));
        sound &= sides.is_some();
        *found = sides.map(|sides| (sides, axis));
    }
    sound.then_some(found)
}
