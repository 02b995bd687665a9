//! The faces of a gap between two buildings with plans.

use std::collections::BTreeMap;

use super::contact_points::{PointPair, SAME, point_pairs};
use super::plan_contacts::{
    FacePoint, PlanContactKind, PlanFace, PlanPart, cross, dot, plan_faces,
};
use crate::linear::sort_by_key;
use crate::model::{
    Building, ColumnLine, FloorPairs, Gap, Model, PlanColumn, PlanContact, PlanFrame, PlanPoint,
    SpaceFrame, SpacePlace, Structure, Tiers,
};

/// Cosine of the angle between normals of contacts on one side of a column \[–\].
const SAME_SIDE: f64 = 0.9;

/// Cosine of the angle to a frame beyond which contacts no longer strike its columns: about 6° \[–\].
const ALONG: f64 = 0.995;

/// What a face touches on one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Touched {
    /// A floor, from 1; 0 for a mat and for a wall.
    Floor(usize),
    /// A column, so far above the joint at its foot \[m\].
    Column(PlanColumn, f64),
}

impl Touched {
    /// From the ground up: floors have even ranks, columns odd ones.
    fn rank(self) -> usize {
        match self {
            Self::Floor(floor) => 2 * floor,
            Self::Column(column, _) => 2 * column.storey + 1,
        }
    }
}

/// Plans on one side of a gap, from the ground up, with the heights of the floors above the common datum; that of a wall stands for every height.
struct Side<'a> {
    /// Number of the first plan: 0 for a mat and for a wall, 1 for a floor.
    first: usize,
    plans: Vec<Vec<PlanPoint>>,
    heights: Vec<f64>,
    /// The building whose columns can be struck between floors, and the height of its base.
    columns: Option<(&'a Tiers, f64)>,
}

/// A column that can be struck.
struct Standing<'a> {
    column: PlanColumn,
    at: PlanPoint,
    kind: StandingIn<'a>,
}

/// What a column is part of.
enum StandingIn<'a> {
    /// A space frame, in which it has these sizes along both directions of lines.
    Grid(&'a SpaceFrame, [f64; 2]),
    /// A frame at a line, in which it has this depth; the first and the last of a storey can be struck there.
    Line(&'a PlanFrame, f64, [bool; 2]),
}

impl Standing<'_> {
    /// Its sizes along a normal out of the building and across it, if what moves against that normal strikes it \[m\].
    fn size(&self, outward: PlanPoint) -> Option<[f64; 2]> {
        match &self.kind {
            StandingIn::Grid(frame, size) => Some(sizes_along(frame.direction, *size, outward)),
            // A frame bends in its own plane, and its outer columns stand before the others.
            StandingIn::Line(frame, depth, ends) => {
                let along = dot(frame.direction, outward);
                let is_before = (along < -ALONG && ends[0]) || (along > ALONG && ends[1]);
                is_before.then_some([*depth, 0.0])
            }
        }
    }
}

/// Columns of a storey, from 0.
fn columns_of(tiers: &Tiers, storey: usize) -> Vec<Standing<'_>> {
    let in_grid = tiers.space_frame.iter().flat_map(|frame| {
        let members = frame.members.iter();
        members.filter_map(move |member| {
            let SpacePlace::Column { line, storey: own } = member.place else {
                return None;
            };
            // Lines that do not exist are a fault of the building.
            let [x, y] = line;
            let is_inside = x < frame.lines_x.len() && y < frame.lines_y.len();
            (own == storey && is_inside).then(|| Standing {
                column: PlanColumn {
                    line: ColumnLine::Crossing(line),
                    storey,
                },
                at: frame.point(line),
                kind: StandingIn::Grid(frame, member.section.size),
            })
        })
    });
    let in_frames = tiers.frames.iter().enumerate().flat_map(|(index, frame)| {
        let lines = (0..frame.column_lines())
            .filter(|line| frame.frame.column(storey, *line).is_some())
            .collect::<Vec<_>>();
        let ends = [lines.first(), lines.last()].map(|end| end.copied());
        lines.into_iter().map(move |line| Standing {
            column: PlanColumn {
                line: ColumnLine::OfFrame([index, line]),
                storey,
            },
            at: frame.line_at(line),
            kind: StandingIn::Line(
                frame,
                frame.frame.depth_of_column([storey, line]),
                ends.map(|end| end == Some(line)),
            ),
        })
    });
    in_grid.chain(in_frames).collect()
}

impl<'a> Side<'a> {
    fn new(model: &'a Model, side: Option<usize>) -> Option<Self> {
        if let Some(wall) = model.wall(side) {
            return Some(Self {
                first: 0,
                plans: vec![wall.plan()?],
                heights: Vec::new(),
                columns: None,
            });
        }
        let building = model.buildings.get(side?)?;
        match &building.structure {
            Structure::Tiers(tiers) => {
                let floors = tiers.floors.iter().map(|floor| floor.plan.clone());
                // The mat has the plan of the lowest floor.
                let isolated = building.base.isolation.is_some();
                let lowest = tiers.floors.first().map(|floor| floor.plan.clone());
                let mat = isolated.then_some(lowest).flatten();
                let heights = mat.as_ref().map(|_| building.base.elevation).into_iter();
                Some(Self {
                    first: usize::from(mat.is_none()),
                    heights: heights.chain(building.floor_levels()).collect(),
                    plans: mat.into_iter().chain(floors).collect(),
                    columns: building
                        .has_columns_to_hit()
                        .then_some((tiers, building.base.elevation)),
                })
            }
            _ => None,
        }
    }

    /// Index of the floor at a height; 0 for a wall, which has none.
    fn floor(&self, height: Option<f64>) -> Option<usize> {
        match height {
            Some(_) => self
                .heights
                .iter()
                .position(|candidate| Some(*candidate) == height),
            None => self.heights.is_empty().then_some(0),
        }
    }
}

impl Side<'_> {
    /// Storey of a height between floors, from 0, and how far above its lower floor it is \[m\].
    fn storey(&self, height: f64) -> Option<(usize, f64)> {
        let (tiers, base) = self.columns?;
        let mut foot = base;
        tiers
            .storey_heights
            .iter()
            .enumerate()
            .find_map(|(storey, own)| {
                let above = height - foot;
                foot += own;
                (above > 0.0 && above < *own).then_some((storey, above))
            })
    }

    /// What a face at a height touches, a floor or columns of a storey, and the plan that bounds it there: that of the floor above.
    fn level(&self, height: Option<f64>) -> Option<(Level, &[PlanPoint])> {
        if let Some(index) = self.floor(height) {
            let touched = Touched::Floor(self.first + index);
            return Some((Level::Floor(touched), self.plans.get(index)?));
        }
        let (storey, above) = self.storey(height?)?;
        let plan = self.plans.get(storey + 1 - self.first)?;
        Some((Level::Columns { storey, above }, plan))
    }
}

/// What one side of a gap has at a height.
#[derive(Clone, Copy)]
enum Level {
    Floor(Touched),
    /// Storey, from 0, and height above its lower floor \[m\].
    Columns {
        storey: usize,
        above: f64,
    },
}

/// Faces of a gap with what they touch, from the lowest up; `None` where its buildings or floors do not fit.
pub(crate) fn faces_of_gap(model: &Model, gap: &Gap) -> Option<Vec<([Touched; 2], PlanFace)>> {
    let [a, b] = gap.between;
    let sides = [Side::new(model, a)?, Side::new(model, b)?];
    let neighbours = model.neighbours(gap.between);
    let pairs = point_pairs(&gap.floors, neighbours, gap.level_tolerance).ok()?;
    let pairs = pairs.iter();
    let mut found: Vec<_> = pairs
        .flat_map(|pair| faces_of_pair(&sides, pair, &gap.in_plan))
        .collect();
    sort_by_key(&mut found, |(touched, _)| touched.map(Touched::rank));
    Some(found)
}

/// What touches at one pair of heights.
fn faces_of_pair(
    sides: &[Side<'_>; 2],
    pair: &PointPair,
    contact: &PlanContact,
) -> Vec<([Touched; 2], PlanFace)> {
    let [Some((one, first)), Some((other, second))] =
        [0, 1].map(|side: usize| sides[side].level(pair[side]))
    else {
        return Vec::new();
    };
    let faces = plan_faces(first, second, contact);
    match (one, other) {
        (Level::Floor(one), Level::Floor(other)) => {
            let faces = faces.into_iter();
            faces.map(|face| ([one, other], face)).collect()
        }
        (Level::Floor(slab), Level::Columns { storey, above }) => {
            let columns = sides[1].struck_by(&faces, 1, storey, contact).into_iter();
            let touched = |column| [slab, Touched::Column(column, above)];
            columns
                .map(|(column, face)| (touched(column), face))
                .collect()
        }
        (Level::Columns { storey, above }, Level::Floor(slab)) => {
            let columns = sides[0].struck_by(&faces, 0, storey, contact).into_iter();
            let touched = |column| [Touched::Column(column, above), slab];
            columns
                .map(|(column, face)| (touched(column), face))
                .collect()
        }
        // Columns do not reach each other before slabs do.
        (Level::Columns { .. }, Level::Columns { .. }) => Vec::new(),
    }
}

/// Entries of the listed points of a gap that lie on columns, but at which nothing touches, and whether both sides are columns.
pub(crate) fn columns_not_met(model: &Model, gap: &Gap) -> Vec<(usize, bool)> {
    let [a, b] = gap.between;
    let is_listed = matches!(gap.floors, FloorPairs::Listed(_) | FloorPairs::Heights(_));
    let (Some(one), Some(other), true) = (Side::new(model, a), Side::new(model, b), is_listed)
    else {
        return Vec::new();
    };
    let sides = [one, other];
    let neighbours = model.neighbours(gap.between);
    let pairs = point_pairs(&gap.floors, neighbours, gap.level_tolerance).unwrap_or_default();
    let pairs = pairs.iter().enumerate();
    let missed = pairs.filter_map(|(entry, pair)| {
        let on_columns = [0, 1].map(|side: usize| {
            let level = sides[side].level(pair[side]);
            matches!(level, Some((Level::Columns { .. }, _)))
        });
        let touches = !faces_of_pair(&sides, pair, &gap.in_plan).is_empty();
        (on_columns != [false; 2] && !touches).then_some((entry, on_columns == [true; 2]))
    });
    missed.collect()
}

/// Slabs beside a building with columns between its floors that `floors = "all"` leaves without a contact, because they meet none of
/// its columns.
#[derive(Clone, Debug, PartialEq)]
pub struct UnmetColumns {
    /// The gap, by its index in [`Model::gaps`].
    pub gap: usize,
    /// Building of the slabs, and that of the columns, by their indices in [`Model::buildings`].
    pub between: [usize; 2],
    /// The floors, counted from 1; 0 for a mat.
    pub floors: Vec<usize>,
    /// Their heights above the common datum \[m\].
    pub heights: Vec<f64>,
    /// Whether columns stand within the common width, but too far behind the edge of their plan.
    pub behind: bool,
}

impl Model {
    /// Slabs that meet no column where `floors = "all"` looks for one, gap by gap. The model must pass [`Model::check`].
    #[must_use]
    pub fn unmet_columns(&self) -> Vec<UnmetColumns> {
        let mut found: Vec<UnmetColumns> = Vec::new();
        for (index, gap) in self.gaps.iter().enumerate() {
            let [Some(a), Some(b)] = gap.between else {
                continue;
            };
            let sides = [Side::new(self, Some(a)), Side::new(self, Some(b))];
            let ([Some(one), Some(other)], FloorPairs::All) = (sides, &gap.floors) else {
                continue;
            };
            let sides = [one, other];
            let neighbours = self.neighbours(gap.between);
            let pairs = point_pairs(&gap.floors, neighbours, gap.level_tolerance);
            for pair in pairs.unwrap_or_default() {
                let Some((slab, floor, behind)) = unmet(&sides, &pair, &gap.in_plan) else {
                    continue;
                };
                let between = [[a, b][slab], [a, b][1 - slab]];
                let height = pair[slab].unwrap_or_default();
                let known = found.iter_mut().find(|known| {
                    (known.gap, known.between, known.behind) == (index, between, behind)
                });
                match known {
                    Some(known) => {
                        known.floors.push(floor);
                        known.heights.push(height);
                    }
                    None => found.push(UnmetColumns {
                        gap: index,
                        between,
                        floors: vec![floor],
                        heights: vec![height],
                        behind,
                    }),
                }
            }
        }
        found
    }
}

/// Side and number of a slab whose edge lies before that of the plan above columns, but that meets none of these, and whether some stand
/// behind that edge.
fn unmet(
    sides: &[Side<'_>; 2],
    pair: &PointPair,
    contact: &PlanContact,
) -> Option<(usize, usize, bool)> {
    let [(one, first), (other, second)] = [sides[0].level(pair[0])?, sides[1].level(pair[1])?];
    let (slab, floor, storey) = match (one, other) {
        (Level::Floor(Touched::Floor(floor)), Level::Columns { storey, .. }) => (0, floor, storey),
        (Level::Columns { storey, .. }, Level::Floor(Touched::Floor(floor))) => (1, floor, storey),
        _ => return None,
    };
    let faces = plan_faces(first, second, contact);
    let columns = 1 - slab;
    let meets = |contact: &PlanContact| {
        !sides[columns]
            .struck_by(&faces, columns, storey, contact)
            .is_empty()
    };
    let faces_it = faces.iter().any(|face| face.kind == PlanContactKind::Face);
    if !faces_it || meets(contact) {
        return None;
    }
    let anywhere = PlanContact {
        reach: f64::INFINITY,
        ..*contact
    };
    Some((slab, floor, meets(&anywhere)))
}

impl Side<'_> {
    /// Columns of a storey that a slab strikes over the common width of both buildings, each with its own contact. `faces`: those of the slab
    /// and the plan above the columns, which are on this `side` of them.
    fn struck_by(
        &self,
        faces: &[PlanFace],
        side: usize,
        storey: usize,
        contact: &PlanContact,
    ) -> Vec<(PlanColumn, PlanFace)> {
        let mut found: Vec<(PlanColumn, PlanFace)> = Vec::new();
        let columns = self.columns.iter();
        for standing in columns.flat_map(|(tiers, _)| columns_of(tiers, storey)) {
            for face in faces {
                // Out of the building of the columns.
                let outward = face
                    .normal
                    .map(|value| if side == 0 { value } else { -value });
                let size = standing.size(outward);
                let Some(size) = size.filter(|_| face.kind == PlanContactKind::Face) else {
                    continue;
                };
                let Some(face) = face.at_column(side, standing.at, size, standing.column.line)
                else {
                    continue;
                };
                let is_near = face.points.iter().all(|point| point.gap <= contact.reach);
                // Where two edges of one side meet, a column stands before both.
                let is_new = found.iter().all(|(column, known)| {
                    *column != standing.column || dot(known.normal, face.normal) < SAME_SIDE
                });
                if is_near && is_new {
                    found.push((standing.column, face));
                }
            }
        }
        found
    }
}

/// Sizes of a rectangle, with sides in the directions of lines, along a normal and across it \[m\].
fn sizes_along(direction: PlanPoint, [a, b]: [f64; 2], normal: PlanPoint) -> [f64; 2] {
    let [along, across] = [dot(direction, normal).abs(), cross(direction, normal).abs()];
    [along * a + across * b, across * a + along * b]
}

impl PlanFace {
    /// The contact of a slab with one column of a side of this face, if the column stands within its length: the face of the column, or the
    /// edge of the plan where that lies further in, is struck by all the stiffness of the law. `size`: of the column along the normal and
    /// across it.
    fn at_column(
        &self,
        side: usize,
        column: PlanPoint,
        size: [f64; 2],
        line: ColumnLine,
    ) -> Option<Self> {
        let along = [-self.normal[1], self.normal[0]];
        let (first, last) = (self.points.first()?, self.points.last()?);
        let place = dot(column, along);
        let ends = [first, last].map(|end| dot(end.at, along));
        if place < ends[0] - SAME || place > ends[1] + SAME {
            return None;
        }
        let share = ((place - ends[0]) / (ends[1] - ends[0])).clamp(0.0, 1.0);
        let between = |from: f64, to: f64| from + share * (to - from);
        let gap = between(first.gap, last.gap);
        let midway = [0, 1].map(|axis| between(first.at[axis], last.at[axis]));
        // Out of the struck building.
        let outward = self
            .normal
            .map(|value| if side == 0 { value } else { -value });
        let depth = dot(midway, outward) - 0.5 * gap - dot(column, outward);
        let set_back = (depth - 0.5 * size[0]).max(0.0);
        let at = [0, 1].map(|axis| midway[axis] - 0.5 * set_back * outward[axis]);
        let mut parts = self.parts;
        parts[side] = PlanPart::Column(line);
        Some(Self {
            kind: PlanContactKind::Column,
            parts,
            normal: self.normal,
            overlap: size[1],
            middle: at,
            points: vec![FacePoint {
                at,
                gap: gap + set_back,
                share: 1.0,
            }],
            ends: Vec::new(),
        })
    }
}

/// Columns of a building that others can strike, and how far above the joint at their foot, by all gaps of a model \[m\].
pub(crate) fn struck_columns(model: &Model, building: usize) -> BTreeMap<PlanColumn, Vec<f64>> {
    let mut found: BTreeMap<PlanColumn, Vec<f64>> = BTreeMap::new();
    let structure = model.buildings.get(building);
    let in_plan = |building: &&Building| matches!(building.structure, Structure::Tiers(_));
    if !structure
        .filter(in_plan)
        .is_some_and(Building::has_columns_to_hit)
    {
        return found;
    }
    for gap in &model.gaps {
        for side in [0, 1]
            .into_iter()
            .filter(|side| gap.between[*side] == Some(building))
        {
            for (touched, _) in faces_of_gap(model, gap).unwrap_or_default() {
                if let Touched::Column(column, above) = touched[side] {
                    let heights = found.entry(column).or_default();
                    if !heights.iter().any(|known| (known - above).abs() <= SAME) {
                        heights.push(above);
                    }
                }
            }
        }
    }
    found
}

/// Least distance of the plans at the contact points of a gap \[m\]; `None` if it has none.
#[must_use]
pub fn narrowest_gap(model: &Model, gap: usize) -> Option<f64> {
    narrowest(&faces_of_gap(model, model.gaps.get(gap)?)?)
}

/// Least distance of faces and corners \[m\]. Of two corners that pass each other one may already be behind the other; then
/// the distance along the other normal counts.
pub(crate) fn narrowest(faces: &[([Touched; 2], PlanFace)]) -> Option<f64> {
    let of_face = |face: &PlanFace| {
        let is_behind = face.ends.iter().any(|end| end.is_indentation);
        let points = face.points.iter().map(|point| point.gap);
        points
            .filter(|gap| !is_behind || *gap >= 0.0)
            .min_by(f64::total_cmp)
    };
    let gaps = faces.iter().filter_map(|(_, face)| of_face(face));
    gaps.min_by(f64::total_cmp)
}
