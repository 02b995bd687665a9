//! Places of the springs of a building that yield.

use super::diagonals::FrameDiagonal;
use super::member_forces::MemberPlace;
use crate::hysteresis::{ForceRow, Side};
use crate::model::{DiagonalKind, DiagonalPlace, PlanAxis, Reach, Rise, SpacePlace, StrutLine};

/// Which end of a member a hinge is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemberEnd {
    /// The lower end of a column, the left end of a beam.
    First,
    /// The upper end of a column, the right end of a beam.
    Last,
}

impl MemberEnd {
    /// In words at a column.
    #[must_use]
    pub fn of_column(self) -> &'static str {
        match self {
            Self::First => "foot",
            Self::Last => "head",
        }
    }

    /// In words at a beam.
    #[must_use]
    pub fn of_beam(self) -> &'static str {
        match self {
            Self::First => "left",
            Self::Last => "right",
        }
    }

    /// In words at a member of a space frame: foot and head of a column, left and right of a beam along x, first and last of a beam
    /// across.
    #[must_use]
    pub fn in_space(self, place: SpacePlace) -> &'static str {
        match (place, self) {
            (SpacePlace::Column { .. }, Self::First) => "foot",
            (SpacePlace::Column { .. }, Self::Last) => "head",
            (SpacePlace::BeamX { .. }, Self::First) => "left",
            (SpacePlace::BeamX { .. }, Self::Last) => "right",
            (SpacePlace::BeamY { .. }, Self::First) => "first",
            (SpacePlace::BeamY { .. }, Self::Last) => "last",
        }
    }
}

/// Where a spring that yields sits; floors, storeys, column lines and bays count from 1, from the ground up and from
/// the left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpringPlace {
    /// At an end of a column.
    Column {
        /// Storey.
        storey: usize,
        /// Column line.
        line: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// Between the floors of a column, where a neighbour or a link pushes it.
    Struck {
        /// Its frame, where several stand in a plan.
        frame: Option<usize>,
        /// Its column.
        member: MemberPlace,
        /// Along which lines it bends, in a space frame.
        axis: Option<PlanAxis>,
        /// Its number among the points of the column that move by themselves, from 1, from below.
        point: usize,
    },
    /// At an end of a beam.
    Beam {
        /// Floor.
        floor: usize,
        /// Bay.
        bay: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// Shear of a column, at its end.
    Shear {
        /// Its frame, where several stand in a plan.
        frame: Option<usize>,
        /// Its column.
        member: MemberPlace,
        /// Along which lines it slides, in a space frame.
        axis: Option<PlanAxis>,
        /// Which end.
        end: MemberEnd,
    },
    /// At an end of a column of a frame in plan.
    ColumnInPlan {
        /// Its frame.
        frame: usize,
        /// Storey.
        storey: usize,
        /// Column line.
        line: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// At an end of a beam of a frame in plan.
    BeamInPlan {
        /// Its frame.
        frame: usize,
        /// Floor.
        floor: usize,
        /// Bay.
        bay: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// At an end of a member of a space frame, in one plane of bending.
    InSpace {
        /// The member; its place counts from 0.
        place: SpacePlace,
        /// Which end.
        end: MemberEnd,
        /// Along which lines it bends.
        axis: PlanAxis,
    },
    /// In a section of fibres at an end of a column.
    Fibre {
        /// Its frame, where several stand in a plan, from 1.
        frame: Option<usize>,
        /// Its column.
        member: MemberPlace,
        /// Which end.
        end: MemberEnd,
        /// Instead of an end, the point between floors where it is struck, from 1 at the lowest one.
        point: Option<usize>,
        /// Its number in the section.
        fibre: usize,
    },
    /// A row of an end of a column that yields on a surface.
    Surface {
        /// Its frame, where several stand in a plan, from 1.
        frame: Option<usize>,
        /// Its column.
        member: MemberPlace,
        /// Which end.
        end: MemberEnd,
        /// Instead of an end, the point between floors where it is struck, from 1 at the lowest one.
        point: Option<usize>,
        /// Which row, from 1.
        row: usize,
    },
    /// Shear of a wall or a coupling beam of a frame, which is its sliding.
    Sliding {
        /// Its frame, where several stand in a plan.
        frame: Option<usize>,
        /// Its column in the lowest storey, or its beam; counted from 1.
        member: MemberPlace,
    },
    /// A brace or a strut of a frame.
    Diagonal {
        /// Its frame, where several stand in a plan.
        frame: Option<usize>,
        /// Its place there.
        place: DiagonalPlace,
    },
    /// A whole storey of a shear building.
    Storey {
        /// Storey.
        storey: usize,
    },
    /// Between a column, or a whole shear building, and the ground.
    Base {
        /// Column line; 1 for a shear building.
        line: usize,
        /// Which way it gives.
        motion: BaseMotion,
    },
    /// Ground under a foundation that can lift off, or under the foot of a column.
    Footing {
        /// Column line; `None` for the foundation of the whole building.
        line: Option<usize>,
        /// Contact spring, from 1, from the left.
        spring: usize,
    },
    /// A whole storey of a building in plan, in one direction.
    PlanStorey {
        /// Storey.
        storey: usize,
        /// Its direction.
        axis: PlanAxis,
    },
    /// A column or wall at a point of a plan, in one direction.
    Element {
        /// Its number in the order of the model.
        element: usize,
        /// Storey.
        storey: usize,
        /// Its direction.
        axis: PlanAxis,
    },
    /// The bearings of an isolated building, all together.
    Bearings,
    /// A bearing of an isolated building in plan, in one direction; the row between both directions has no force.
    BearingInPlan {
        /// Its number in the order of the model, or of the four that stand for all.
        bearing: usize,
        /// Its direction.
        row: ForceRow,
    },
    /// The ring that stops the mat of an isolated building in plan, in one direction.
    Ring {
        /// The direction.
        row: ForceRow,
    },
    /// A stop of its mat.
    Stop {
        /// The direction of motion in which it is reached: right is positive.
        side: Side,
    },
}

impl SpringPlace {
    /// In words; a column or wall in plan by its name, if the list of [`Tiers::element_names`](crate::Tiers::element_names) has
    /// one, and a frame in plan by its name in a list of those of all frames.
    #[must_use]
    pub fn named(&self, elements: &[Option<String>], frames: &[String]) -> String {
        let of_frame = |frame: usize| frames.get(frame.wrapping_sub(1));
        match *self {
            Self::Element {
                element,
                storey,
                axis,
            } => match elements.get(element.wrapping_sub(1)) {
                Some(Some(name)) => format!("{name}, storey {storey}, {}", axis.name()),
                _ => self.to_string(),
            },
            Self::ColumnInPlan {
                frame,
                storey,
                line,
                end,
            } => match of_frame(frame) {
                Some(name) => format!("frame {name}, {}", Self::Column { storey, line, end }),
                None => self.to_string(),
            },
            Self::BeamInPlan {
                frame,
                floor,
                bay,
                end,
            } => match of_frame(frame) {
                Some(name) => format!("frame {name}, {}", Self::Beam { floor, bay, end }),
                None => self.to_string(),
            },
            Self::Fibre { frame, .. } | Self::Surface { frame, .. } => {
                match frame.and_then(of_frame) {
                    Some(name) => format!("frame {name}, {}", self.without_frame()),
                    None => self.to_string(),
                }
            }
            Self::Shear { frame, .. } | Self::Struck { frame, .. } => {
                match frame.and_then(of_frame) {
                    Some(name) => format!("frame {name}, {self}"),
                    None => self.to_string(),
                }
            }
            Self::Sliding { frame, member } => match frame.and_then(of_frame) {
                Some(name) => format!("frame {name}, {}", sliding_in_words(member)),
                None => self.to_string(),
            },
            Self::Diagonal { frame, place } => match frame.and_then(of_frame) {
                Some(name) => format!("frame {name}, {}", in_words(place)),
                None => self.to_string(),
            },
            _ => self.to_string(),
        }
    }

    /// An end of a column without its frame.
    fn without_frame(mut self) -> Self {
        if let Self::Fibre { frame, .. } | Self::Surface { frame, .. } = &mut self {
            *frame = None;
        }
        self
    }

    /// Places of hinges at an end of a member, in every plane in which it may bend.
    pub(crate) fn of_hinges(member: MemberPlace, end: MemberEnd) -> Vec<Self> {
        match member {
            MemberPlace::Column { line, storey } => vec![Self::Column { storey, line, end }],
            MemberPlace::Beam { floor, span } => vec![Self::Beam {
                floor,
                bay: span,
                end,
            }],
            MemberPlace::InSpace(place) => {
                let axes = PlanAxis::BOTH.into_iter();
                axes.map(|axis| Self::InSpace { place, end, axis })
                    .collect()
            }
        }
    }

    /// The place of a hinge of a plane frame, as one of a frame in plan; `None` for other places.
    pub(crate) fn in_frame(self, frame: usize) -> Option<Self> {
        match self {
            Self::Column { storey, line, end } => Some(Self::ColumnInPlan {
                frame,
                storey,
                line,
                end,
            }),
            Self::Beam { floor, bay, end } => Some(Self::BeamInPlan {
                frame,
                floor,
                bay,
                end,
            }),
            Self::Diagonal { place, .. } => Some(Self::Diagonal {
                frame: Some(frame),
                place,
            }),
            Self::Sliding { member, .. } => Some(Self::Sliding {
                frame: Some(frame),
                member,
            }),
            Self::Fibre {
                member,
                end,
                point,
                fibre,
                ..
            } => Some(Self::Fibre {
                frame: Some(frame),
                member,
                end,
                point,
                fibre,
            }),
            Self::Struck {
                member,
                axis,
                point,
                ..
            } => Some(Self::Struck {
                frame: Some(frame),
                member,
                axis,
                point,
            }),
            Self::Shear {
                member, axis, end, ..
            } => Some(Self::Shear {
                frame: Some(frame),
                member,
                axis,
                end,
            }),
            _ => None,
        }
    }

    /// Whether it is part of the structure above the base that stiffness-proportional damping may act on: a storey, a column or
    /// wall at a point of a plan, or a hinge of a member, but not the shear of a column, which is rigid until it fails, nor a
    /// strut of an infill panel.
    #[must_use]
    pub fn is_damped_with_structure(&self) -> bool {
        match self {
            Self::Base { .. }
            | Self::Footing { .. }
            | Self::Shear { .. }
            | Self::Fibre { .. }
            | Self::Surface { .. } => false,
            Self::Diagonal { place, .. } => place.kind == DiagonalKind::Brace,
            place => !place.is_isolation(),
        }
    }

    /// Whether it belongs to the isolation of a building rather than to its structure.
    #[must_use]
    pub fn is_isolation(&self) -> bool {
        matches!(
            self,
            Self::Bearings | Self::BearingInPlan { .. } | Self::Ring { .. } | Self::Stop { .. }
        )
    }

    /// Whether it is the row between two directions of a force in plan, which has no force.
    #[must_use]
    pub fn has_no_force(&self) -> bool {
        matches!(
            self,
            Self::BearingInPlan {
                row: ForceRow::Between,
                ..
            } | Self::Ring {
                row: ForceRow::Between
            }
        )
    }

    /// That of a brace or a strut, if it yields.
    #[must_use]
    pub fn of_diagonal(diagonal: &FrameDiagonal) -> Self {
        Self::Diagonal {
            frame: diagonal.frame.map(|frame| frame + 1),
            place: diagonal.place,
        }
    }

    /// Whether it counts among the hinges of a building: what cracks and yields, without isolation, columns that fail in shear,
    /// struts and foundations that lift off, and fibres and surfaces, which are several springs in one section.
    #[must_use]
    pub fn is_hinge(&self) -> bool {
        let strut =
            matches!(self, Self::Diagonal { place, .. } if place.kind == DiagonalKind::Infill);
        let other = matches!(
            self,
            Self::Fibre { .. } | Self::Surface { .. } | Self::Footing { .. }
        );
        !(self.is_isolation() || self.is_shear() || strut || other)
    }

    /// Whether it is a brace.
    #[must_use]
    pub fn is_brace(&self) -> bool {
        matches!(self, Self::Diagonal { place, .. } if place.kind == DiagonalKind::Brace)
    }

    /// Shear of a wall or a coupling beam of a building that is one frame.
    pub(crate) fn sliding(member: MemberPlace) -> Self {
        Self::Sliding {
            frame: None,
            member,
        }
    }

    /// Whether it is the shear of a column, which fails rather than yields.
    #[must_use]
    pub fn is_shear(&self) -> bool {
        matches!(self, Self::Shear { .. })
    }
}

/// Shear of a wall or a coupling beam in words.
fn sliding_in_words(member: MemberPlace) -> String {
    match member {
        MemberPlace::Column { line, storey } => format!("wall {line}, storey {storey}, shear"),
        MemberPlace::Beam { floor, span } => format!("coupling beam {span}, floor {floor}, shear"),
        MemberPlace::InSpace(place) => place.to_string(),
    }
}

/// A brace or a strut in words.
fn in_words(place: DiagonalPlace) -> String {
    let DiagonalPlace {
        kind, storey, bay, ..
    } = place;
    let kind = match kind {
        DiagonalKind::Brace => "brace",
        DiagonalKind::Infill => "infill strut",
    };
    let Some(line) = place.line else {
        if place.reach != Reach::BAY {
            let ([from, to], [low, high]) = (place.lines(), place.floors());
            let (from, to) = (from + 1, to + 1);
            return format!("{kind}, floor {low}, line {from} to floor {high}, line {to}");
        }
        let towards = match place.rise {
            Rise::Right => "right",
            Rise::Left => "left",
        };
        let off = match place.strut {
            StrutLine::Central => "",
            StrutLine::Foot => ", off the joint at its foot",
            StrutLine::Head => ", off the joint at its head",
        };
        return format!("{kind}, storey {storey}, bay {bay}, rising to the {towards}{off}");
    };
    if place.reach != Reach::BAY
        && let Some([from, to]) = place.crossings()
    {
        let [low, high] = place.floors();
        let ([x, y], [to_x, to_y]) = (from.map(|line| line + 1), to.map(|line| line + 1));
        return format!(
            "{kind}, floor {low}, x = {x}, y = {y} to floor {high}, x = {to_x}, y = {to_y}"
        );
    }
    let [x, y] = line.crossing(bay - 1).map(|crossing| crossing + 1);
    let along = line.along.name();
    let towards = match place.rise {
        Rise::Right => "greater",
        Rise::Left => "smaller",
    };
    format!(
        "{kind} along {along} from x = {x}, y = {y}, storey {storey}, rising to {towards} {along}"
    )
}

/// An end of a column, or a point where it is struck, in words, with its frame where several stand in a plan.
struct PlaceOfColumn(Option<usize>, MemberPlace, MemberEnd, Option<usize>);

impl std::fmt::Display for PlaceOfColumn {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(frame, member, end, point) = self;
        if let Some(frame) = frame {
            write!(formatter, "frame {frame}, ")?;
        }
        match member {
            MemberPlace::Column { line, storey } => {
                write!(formatter, "column {line}, storey {storey}, ")?;
            }
            other => write!(formatter, "{other}, ")?,
        }
        match point {
            Some(point) => write!(formatter, "struck point {point}"),
            None => formatter.write_str(end.of_column()),
        }
    }
}

/// Which way a base gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaseMotion {
    /// It turns.
    Rocking,
    /// It moves sideways.
    Sliding,
}

impl std::fmt::Display for SpringPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Self::Column { storey, line, end } => {
                let end = end.of_column();
                write!(formatter, "column {line}, storey {storey}, {end}")
            }
            Self::Struck {
                member,
                axis,
                point,
                ..
            } => {
                match member {
                    MemberPlace::Column { line, storey } => {
                        write!(formatter, "column {line}, storey {storey}")?;
                    }
                    MemberPlace::Beam { .. } | MemberPlace::InSpace(_) => {
                        write!(formatter, "{member}")?;
                    }
                }
                write!(formatter, ", struck point {point}")?;
                axis.map_or(Ok(()), |axis| write!(formatter, ", {}", axis.name()))
            }
            Self::Beam { floor, bay, end } => {
                let end = end.of_beam();
                write!(formatter, "beam {bay}, floor {floor}, {end}")
            }
            Self::Shear {
                member, axis, end, ..
            } => {
                match member {
                    MemberPlace::Column { line, storey } => {
                        write!(formatter, "column {line}, storey {storey}")?;
                    }
                    other => write!(formatter, "{other}")?,
                }
                write!(formatter, ", shear at the {}", end.of_column())?;
                axis.map_or(Ok(()), |axis| write!(formatter, ", {}", axis.name()))
            }
            Self::ColumnInPlan {
                frame,
                storey,
                line,
                end,
            } => {
                let column = Self::Column { storey, line, end };
                write!(formatter, "frame {frame}, {column}")
            }
            Self::BeamInPlan {
                frame,
                floor,
                bay,
                end,
            } => {
                let beam = Self::Beam { floor, bay, end };
                write!(formatter, "frame {frame}, {beam}")
            }
            Self::InSpace { place, end, axis } => {
                write!(formatter, "{place}, {}", end.in_space(place))?;
                // A beam bends along its own line only.
                match place {
                    SpacePlace::Column { .. } => write!(formatter, ", {}", axis.name()),
                    SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => Ok(()),
                }
            }
            Self::Fibre {
                frame,
                member,
                end,
                point,
                fibre,
            } => {
                let place = PlaceOfColumn(frame, member, end, point);
                write!(formatter, "{place}")?;
                write!(formatter, ", fibre {fibre}")
            }
            Self::Surface {
                frame,
                member,
                end,
                point,
                ..
            } => write!(formatter, "{}", PlaceOfColumn(frame, member, end, point)),
            Self::Sliding { member, .. } => formatter.write_str(&sliding_in_words(member)),
            Self::Diagonal { place, .. } => formatter.write_str(&in_words(place)),
            Self::Storey { storey } => write!(formatter, "storey {storey}"),
            Self::Base { line, motion } => {
                let motion = match motion {
                    BaseMotion::Rocking => "rocking",
                    BaseMotion::Sliding => "sliding",
                };
                write!(formatter, "base {line}, {motion}")
            }
            Self::Footing {
                line: Some(line), ..
            } => write!(formatter, "footing {line}"),
            Self::Footing { line: None, spring } => {
                write!(formatter, "footing, spring {spring}")
            }
            Self::PlanStorey { storey, axis } => {
                write!(formatter, "storey {storey}, {}", axis.name())
            }
            Self::Element {
                element,
                storey,
                axis,
            } => write!(
                formatter,
                "element {element}, storey {storey}, {}",
                axis.name()
            ),
            Self::Bearings => formatter.write_str("bearings"),
            Self::BearingInPlan { bearing, row } => {
                write!(formatter, "bearing {bearing}, {}", row.name())
            }
            Self::Ring { row } => write!(formatter, "ring, {}", row.name()),
            Self::Stop {
                side: Side::Positive,
            } => formatter.write_str("right stop"),
            Self::Stop {
                side: Side::Negative,
            } => formatter.write_str("left stop"),
        }
    }
}
