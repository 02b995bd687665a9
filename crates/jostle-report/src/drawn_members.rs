//! Braces, panels and walls of plane frames, and members of space frames, as the pictures of a report draw them.

use jostle::model::Tiers;
use jostle::{Diagonal, DiagonalKind, FrameWall, PlanAxis, SpaceFrame, SpaceMember, SpacePlace};
use serde::Serialize;

/// A brace, or a strut of an infill panel.
#[derive(Serialize)]
pub(crate) struct DiagonalData {
    pub(crate) storey: usize,
    /// Floor of its upper end, if that is not the one above its storey.
    #[serde(skip_serializing_if = "Option::is_none")]
    top: Option<usize>,
    /// Column lines of its lower and its upper end, from 0; lines that cross its own in a space frame.
    lines: [usize; 2],
    /// Whether it is part of a panel.
    pub(crate) infill: bool,
    /// Of a strut of a panel with a curve: 1 if it cracked in the run, 2 if it reached its strength.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) stage: Option<u8>,
    /// Its lower and its upper end on the site, in a space frame \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) ends: Option<[[f64; 2]; 2]>,
    /// When its panel falls out \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    until: Option<f64>,
}

/// A wall of a frame.
#[derive(Serialize)]
pub(crate) struct WallData {
    /// Column line of its axis, from 0.
    line: usize,
    /// First and last storey, from 1.
    storeys: [usize; 2],
    /// Length \[m\].
    length: f64,
}

/// A column or a beam of a space frame.
#[derive(Serialize)]
pub(crate) struct MemberData {
    /// Both ends on the site \[m\].
    pub(crate) ends: [[f64; 2]; 2],
    /// Floors, from 0, with which they move; `null` is the ground.
    pub(crate) floors: [Option<usize>; 2],
    /// Half the length of a wall along its own direction, whose axis it is \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) wall: Option<[f64; 2]>,
}

impl DiagonalData {
    pub(crate) fn of(diagonal: &Diagonal) -> Self {
        Self {
            storey: diagonal.place.storey,
            top: Some(diagonal.place.floors()[1]).filter(|top| *top != diagonal.place.storey),
            lines: diagonal.place.lines(),
            infill: diagonal.place.kind == DiagonalKind::Infill,
            stage: None,
            ends: None,
            until: None,
        }
    }

    /// Floors of its lower and its upper end; 0 is the ground.
    pub(crate) fn floors(&self) -> [usize; 2] {
        [self.storey - 1, self.top.unwrap_or(self.storey)]
    }

    /// The same until its panel falls out, if it does.
    pub(crate) fn until(self, fallen: Option<f64>) -> Self {
        Self {
            until: fallen,
            ..self
        }
    }

    pub(crate) fn in_space(frame: &SpaceFrame, diagonal: &Diagonal) -> Self {
        let crossings = diagonal.place.crossings();
        let ends = crossings.map(|both| both.map(|crossing| frame.point(crossing)));
        Self {
            ends,
            ..Self::of(diagonal)
        }
    }
}

/// A building in plan as it is seen across the row.
pub(crate) struct SeenAcross {
    /// Column lines, and edges of floors, from the left edge of the widest floor to its right one \[m\].
    pub(crate) lines: Vec<f64>,
    /// Storeys from 1 that have a column there or end there, by line.
    pub(crate) storeys: Vec<Vec<usize>>,
}

impl SeenAcross {
    pub(crate) fn new(tiers: &Tiers) -> Self {
        /// Closer lines are drawn as one \[m\].
        const ONE: f64 = 0.05;
        let left = tiers.extent_along()[0];
        let columns = tiers
            .space_frame
            .iter()
            .flat_map(MemberData::all_of)
            .filter(|member| member.floors[0] != member.floors[1])
            .filter_map(|member| Some((member.floors[1]? + 1, member.ends[0][0] - left)));
        let edges = tiers.floors.iter().enumerate().flat_map(|(floor, tier)| {
            let across = tier.plan.iter().map(|corner| corner[0] - left);
            let least = across.clone().fold(f64::INFINITY, f64::min);
            let most = across.fold(f64::NEG_INFINITY, f64::max);
            [(floor + 1, least), (floor + 1, most)]
        });
        let mut places: Vec<(usize, f64)> = columns.chain(edges).collect();
        places.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let (mut lines, mut storeys): (Vec<f64>, Vec<Vec<usize>>) = (Vec::new(), Vec::new());
        for (storey, place) in places {
            match (lines.last(), storeys.last_mut()) {
                (Some(line), Some(own)) if place - line < ONE => own.push(storey),
                _ => {
                    lines.push(place);
                    storeys.push(vec![storey]);
                }
            }
        }
        for own in &mut storeys {
            own.sort_unstable();
            own.dedup();
        }
        Self { lines, storeys }
    }

    /// Whether every line has a column in every storey.
    pub(crate) fn is_regular(&self, storeys: usize) -> bool {
        self.storeys.iter().all(|own| own.len() == storeys)
    }

    /// The first and the last line of every storey.
    pub(crate) fn outer(&self, storeys: usize) -> Vec<[usize; 2]> {
        let outer = |storey: usize| {
            let has = |own: &Vec<usize>| own.contains(&storey);
            let first = self.storeys.iter().position(has);
            let last = self.storeys.iter().rposition(has);
            [first.unwrap_or_default(), last.unwrap_or_default()]
        };
        (1..=storeys).map(outer).collect()
    }
}

impl WallData {
    pub(crate) fn of(wall: &FrameWall) -> Self {
        Self {
            line: wall.line - 1,
            storeys: wall.storeys,
            length: wall.length,
        }
    }
}

impl MemberData {
    pub(crate) fn all_of(frame: &SpaceFrame) -> Vec<Self> {
        let member = |member: &SpaceMember| {
            let level = member.place.storey();
            let lower = match member.place {
                SpacePlace::Column { .. } => level.checked_sub(1),
                SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => Some(level),
            };
            let wall = frame.walls.iter().find(|wall| wall.has(member.place));
            let half = wall.map(|wall| {
                let [c, s] = frame.direction.map(|part| 0.5 * wall.length * part);
                match wall.along {
                    PlanAxis::X => [c, s],
                    PlanAxis::Y => [-s, c],
                }
            });
            Self {
                wall: half,
                ends: member
                    .place
                    .crossings()
                    .map(|crossing| frame.point(crossing)),
                floors: [lower, Some(level)],
            }
        };
        frame.members.iter().map(member).collect()
    }
}
