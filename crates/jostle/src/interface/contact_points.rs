//! Pairs of points of two neighbours that can touch: floors, and columns between floors.

use crate::linear::sort_by;
use crate::model::{Building, FloorPairs, Gap, LEVEL_TOLERANCE, Level, Model, Structure};

/// Heights of the left and of the right point above the common datum; `None` on a wall \[m\].
pub(crate) type PointPair = [Option<f64>; 2];

/// Smallest distance between a point of a column and a floor or another point \[m\].
const NEAREST: f64 = 0.02;

/// An error in a list of points: the entry, and the problem.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Misfit {
    pub(crate) entry: Option<usize>,
    pub(crate) problem: String,
}

impl Misfit {
    fn all(problem: impl Into<String>) -> Self {
        Self {
            entry: None,
            problem: problem.into(),
        }
    }

    fn at(entry: usize, problem: impl Into<String>) -> Self {
        Self {
            entry: Some(entry),
            problem: problem.into(),
        }
    }
}

/// One side of a gap or a link.
struct Side<'a> {
    building: &'a Building,
    floors: Vec<f64>,
}

impl Side<'_> {
    fn new(building: &Building) -> Side<'_> {
        Side {
            floors: building.floor_levels(),
            building,
        }
    }

    fn roof(&self) -> f64 {
        self.floors.last().copied().unwrap_or(0.0)
    }

    /// Height of its base.
    fn foot(&self) -> f64 {
        self.building.base.elevation
    }

    /// Whether a height lies beside it.
    fn is_beside(&self, height: f64) -> bool {
        height <= self.roof() && height > self.foot()
    }

    /// The floor nearest to a height, if it is within reach.
    fn floor_near(&self, height: f64, tolerance: f64) -> Option<f64> {
        let away = |floor: &f64| (floor - height).abs();
        let nearest = self.floors.iter().copied();
        nearest
            .min_by(|a, b| away(a).total_cmp(&away(b)))
            .filter(|floor| level(*floor, height, tolerance))
    }

    /// Whether its lowest point is a mat that moves.
    fn has_mat(&self) -> bool {
        self.building.base.isolation.is_some()
    }

    /// Whether neighbours can hit columns of it between floors.
    fn has_columns(&self) -> bool {
        self.building.has_columns_to_hit()
    }

    fn is_in_space(&self) -> bool {
        matches!(self.building.structure, Structure::Tiers(_))
    }

    /// The contact point at a height: a floor within the tolerance, or the column.
    fn point(&self, height: f64, tolerance: f64) -> Result<f64, String> {
        if let Some(floor) = self.floor_near(height, tolerance) {
            return Ok(floor);
        }
        let name = &self.building.name;
        let at = format!("\"{name}\" has no floor at {height:.3} m");
        let nearest = self.floor_near(height, f64::INFINITY).unwrap_or(0.0);
        let hint = format!("(nearest: {nearest:.3} m)");
        if !self.has_columns() {
            let frame = match self.is_in_space() {
                true => "space frame",
                false => "frame",
            };
            return Err(format!(
                "{at} {hint}, and no columns that can be hit between floors; move the point to a floor, raise level_tolerance, or describe \"{name}\" as a {frame}"
            ));
        }
        if height > self.roof() {
            return Err(format!("{at} {hint}: that is above its roof"));
        }
        if height < self.foot() {
            return Err(format!("{at} {hint}: that is below its base"));
        }
        let from_ends = (height - nearest).abs().min(height - self.foot());
        if !from_ends.is_finite() || from_ends < NEAREST {
            return Err(format!(
                "{at} {hint}, and a column cannot be hit nearer than {:.0} mm to its ends; raise level_tolerance so that the floor is hit, or move the point",
                NEAREST * 1e3
            ));
        }
        Ok(height)
    }

    fn level(&self, level: Level) -> Result<f64, String> {
        match level {
            Level::Floor(0) if self.has_mat() => Ok(self.foot()),
            Level::Floor(0) => Err(format!(
                "floor 0 is the mat of an isolated building, and \"{}\" has no isolation; its floors count from 1",
                self.building.name
            )),
            Level::Floor(floor) => {
                let found = floor
                    .checked_sub(1)
                    .and_then(|index| self.floors.get(index));
                found.copied().ok_or_else(|| {
                    format!(
                        "floor {floor} does not exist: \"{}\" has floors 1 to {}",
                        self.building.name,
                        self.floors.len()
                    )
                })
            }
            Level::Height(height)
                if self.has_mat() && (height - self.foot()).abs() <= LEVEL_TOLERANCE =>
            {
                Ok(self.foot())
            }
            Level::Height(height) => self.point(height, LEVEL_TOLERANCE),
            Level::Wall => Err(format!(
                "names the wall where \"{}\" stands",
                self.building.name
            )),
        }
    }

    fn describe(&self, level: Level, height: f64) -> String {
        let name = &self.building.name;
        match level {
            Level::Floor(floor) => format!("floor {floor} of \"{name}\" is at {height:.3} m"),
            _ => format!("the point of \"{name}\" is at {height:.3} m"),
        }
    }
}

/// The pairs of points given by `floors`: listed ones in their order, others from the lowest up.
///
/// # Errors
/// All points that do not exist on the buildings; `None` is a wall.
pub(crate) fn point_pairs(
    floors: &FloorPairs,
    between: [Option<&Building>; 2],
    tolerance: f64,
) -> Result<Vec<PointPair>, Vec<Misfit>> {
    let sides = between.map(|building| building.map(Side::new));
    let [left, right] = [&sides[0], &sides[1]];
    let pairs = match floors {
        FloorPairs::Common => common(left, right, tolerance).map_err(|misfit| vec![misfit])?,
        FloorPairs::All => all(left, right, tolerance).map_err(|misfit| vec![misfit])?,
        FloorPairs::Listed(pairs) => listed(pairs, left, right, tolerance)?,
        FloorPairs::Heights(heights) => at_heights(heights, left, right, tolerance)?,
    };
    check_room(&pairs)?;
    Ok(pairs)
}

fn common(
    left: &Option<Side<'_>>,
    right: &Option<Side<'_>>,
    tolerance: f64,
) -> Result<Vec<PointPair>, Misfit> {
    let (left, right) = match (left, right) {
        (Some(left), Some(right)) => (left, right),
        (Some(side), None) => return Ok(side.floors.iter().map(|h| [Some(*h), None]).collect()),
        (None, Some(side)) => return Ok(side.floors.iter().map(|h| [None, Some(*h)]).collect()),
        (None, None) => return Err(Misfit::all("needs a building on at least one side")),
    };
    let pairs: Vec<PointPair> = left
        .floors
        .iter()
        .filter_map(|&height| {
            let other = right.floor_near(height, tolerance)?;
            // Each is the nearest of the other, so no floor has two partners.
            (left.floor_near(other, tolerance) == Some(height))
                .then_some([Some(height), Some(other)])
        })
        .collect();
    if pairs.is_empty() {
        return Err(Misfit::all(format!(
            "no floors of \"{}\" and \"{}\" lie at equal height; {}",
            left.building.name,
            right.building.name,
            remedy(left, right)
        )));
    }
    Ok(pairs)
}

/// Remedy for neighbours without equal floors.
fn remedy(left: &Side<'_>, right: &Side<'_>) -> String {
    let slabs = "raise level_tolerance if slabs overlap";
    let name = |side: &Side<'_>| format!("\"{}\"", side.building.name);
    match [left, right].map(Side::has_columns) {
        [true, true] => {
            let listed = example([left, right], 0).or_else(|| example([left, right], 1));
            format!(
                "write floors = \"all\" for floors against columns, list the pairs that can touch{}, or {slabs}",
                listed.unwrap_or_default()
            )
        }
        [false, false] if left.is_in_space() => format!(
            "of buildings with a plan only frames have columns that can be hit between floors: {slabs}, describe {} and {} by frames at lines or as space frames, or leave the gap out",
            name(left),
            name(right)
        ),
        [false, false] => format!(
            "shear buildings and given ones have no columns to hit: {slabs}, or describe {} and {} as frames",
            name(left),
            name(right)
        ),
        [left_has, _] => {
            let (shear, frame) = if left_has {
                (right, left)
            } else {
                (left, right)
            };
            let kind = match shear.is_in_space() {
                true => "space frame",
                false => "frame",
            };
            format!(
                "floors of {} can hit columns of {}: list the pairs{}; or describe {} as a {kind}, or {slabs}",
                name(shear),
                name(frame),
                example([left, right], usize::from(left_has)).unwrap_or_default(),
                name(shear)
            )
        }
    }
}

/// The lowest floor of one side that can touch a column of the other, in the syntax of a list.
fn example(sides: [&Side<'_>; 2], side: usize) -> Option<String> {
    let other = sides[1 - side];
    let can_hit = |height: f64| {
        let floor = other.floor_near(height, LEVEL_TOLERANCE);
        floor.is_none() && other.point(height, LEVEL_TOLERANCE).is_ok()
    };
    let mut floors = sides[side].floors.iter().copied().enumerate();
    let (floor, height) = floors.find(|(_, height)| can_hit(*height))?;
    Some(format!(
        ", as floors = {}",
        floor_and_height(side, floor + 1, height)
    ))
}

/// Entry of a model file for a floor of the left (0) or right (1) building against a column of the other.
///
/// ```
/// assert_eq!(jostle::floor_and_height(0, 1, 3.3), r#"[[1, "3.300 m"], …]"#);
/// assert_eq!(jostle::floor_and_height(1, 2, 6.8), r#"[["6.800 m", 2], …]"#);
/// ```
#[must_use]
pub fn floor_and_height(side: usize, floor: usize, height: f64) -> String {
    if side == 0 {
        format!("[[{floor}, \"{height:.3} m\"], …]")
    } else {
        format!("[[\"{height:.3} m\", {floor}], …]")
    }
}

fn all(
    left: &Option<Side<'_>>,
    right: &Option<Side<'_>>,
    tolerance: f64,
) -> Result<Vec<PointPair>, Misfit> {
    let (Some(a), Some(b)) = (left, right) else {
        return common(left, right, tolerance);
    };
    let mut pairs = common(left, right, tolerance).unwrap_or_default();
    for (side, one, other) in [(0, a, b), (1, b, a)] {
        let met: Vec<f64> = pairs.iter().filter_map(|pair| pair[side]).collect();
        let alone = one.floors.iter().filter(|height| !met.contains(height));
        for &height in alone.filter(|height| other.is_beside(**height)) {
            let column = other.point(height, LEVEL_TOLERANCE).map_err(|problem| {
                if other.has_columns() {
                    return Misfit::all(problem);
                }
                Misfit::all(format!(
                    "\"all\" needs columns that can be hit, and \"{}\" has none at {height:.3} m, where \"{}\" has a floor; {}",
                    other.building.name,
                    one.building.name,
                    remedy(a, b)
                ))
            })?;
            let mut pair = [Some(height), Some(column)];
            if side == 1 {
                pair.reverse();
            }
            pairs.push(pair);
        }
    }
    if pairs.is_empty() {
        return Err(Misfit::all(format!(
            "no floor of \"{}\" or \"{}\" has the other beside it",
            a.building.name, b.building.name
        )));
    }
    sort_by(&mut pairs, |p, q| mean(p).total_cmp(&mean(q)));
    Ok(pairs)
}

fn listed(
    pairs: &[[Level; 2]],
    left: &Option<Side<'_>>,
    right: &Option<Side<'_>>,
    tolerance: f64,
) -> Result<Vec<PointPair>, Vec<Misfit>> {
    if pairs.is_empty() {
        return Err(vec![Misfit::all(
            "is empty; list the pairs that can touch, as [[5, 5], [4, 4]]",
        )]);
    }
    let (mut found, mut misfits) = (Vec::new(), Vec::new());
    for (entry, levels) in pairs.iter().enumerate() {
        let before = misfits.len();
        let mut pair: PointPair = [None; 2];
        for (side, which) in [left, right].into_iter().enumerate() {
            match (which, levels[side]) {
                (Some(which), level) => match which.level(level) {
                    Ok(height) => pair[side] = Some(height),
                    Err(problem) => misfits.push(Misfit::at(entry, problem)),
                },
                (None, Level::Wall) => {}
                (None, _) => misfits.push(Misfit::at(
                    entry,
                    "there is a wall on this side; write \"wall\" in its place",
                )),
            }
        }
        if let ([Some(a), Some(b)], [Some(left), Some(right)]) = (pair, [left, right])
            && !level(a, b, tolerance)
        {
            let [one, other] = [left.describe(levels[0], a), right.describe(levels[1], b)];
            let both_floors = levels.iter().all(|level| matches!(level, Level::Floor(_)));
            let remedy = if both_floors {
                ", or give a height at the column of one of them"
            } else {
                ""
            };
            misfits.push(Misfit::at(
                entry,
                format!(
                    "{one} and {other}; both must be at equal height: raise level_tolerance{remedy}"
                ),
            ));
        }
        if pairs[..entry].contains(levels) {
            let name = |level: Level| match level {
                Level::Floor(floor) => floor.to_string(),
                Level::Height(height) => format!("{height} m"),
                Level::Wall => "wall".to_owned(),
            };
            let [a, b] = levels.map(name);
            misfits.push(Misfit::at(
                entry,
                format!("the pair [{a}, {b}] is listed twice"),
            ));
        }
        if misfits.len() == before {
            found.push(pair);
        }
    }
    if misfits.is_empty() {
        Ok(found)
    } else {
        Err(misfits)
    }
}

fn at_heights(
    heights: &[f64],
    left: &Option<Side<'_>>,
    right: &Option<Side<'_>>,
    tolerance: f64,
) -> Result<Vec<PointPair>, Vec<Misfit>> {
    if heights.is_empty() {
        return Err(vec![Misfit::all(
            "is empty; list the heights where the buildings can touch",
        )]);
    }
    let (mut found, mut misfits) = (Vec::new(), Vec::new());
    for (entry, height) in heights.iter().enumerate() {
        let mut pair: PointPair = [None; 2];
        let before = misfits.len();
        for (side, which) in [left, right].into_iter().enumerate() {
            match which.as_ref().map(|side| side.point(*height, tolerance)) {
                Some(Ok(point)) => pair[side] = Some(point),
                Some(Err(problem)) => misfits.push(Misfit::at(entry, problem)),
                None => {}
            }
        }
        if heights[..entry].contains(height) {
            misfits.push(Misfit::at(entry, format!("{height} m is listed twice")));
        }
        if misfits.len() == before {
            found.push(pair);
        }
    }
    if misfits.is_empty() {
        Ok(found)
    } else {
        Err(misfits)
    }
}

/// Floors of two neighbours within the height of the other that have no contact, because `floors = "common"` pairs
/// only floors at equal height.
///
/// ```
/// use jostle::Structure;
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # use towers::pair;
///
/// let mut model = pair(0.02);
/// assert!(model.unmatched_floors().is_empty());
/// if let Structure::Shear(tower) = &mut model.buildings[1].structure {
///     tower.storey_heights = vec![3.2, 2.8, 3.2];
/// }
/// let unmatched = model.unmatched_floors();
/// assert_eq!(unmatched[0].between, [0, 1]);
/// assert!(!unmatched[0].floors[1].is_empty());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct UnmatchedFloors {
    /// The first gap of these neighbours with common floors, by its index in [`Model::gaps`].
    pub gap: usize,
    /// Left and right building, by their indices in [`Model::buildings`].
    pub between: [usize; 2],
    /// Floors of the left and of the right building without contact, counted from 1.
    pub floors: [Vec<usize>; 2],
    /// Number of contacts of the two, in all their gaps.
    pub contacts: usize,
}

impl Model {
    /// Floors beside the neighbour that `floors = "common"` omits, pair by pair, except floors with a contact in
    /// any gap of the pair. The model must pass [`Model::check`].
    #[must_use]
    pub fn unmatched_floors(&self) -> Vec<UnmatchedFloors> {
        let mut found: Vec<UnmatchedFloors> = Vec::new();
        for (index, gap) in self.gaps.iter().enumerate() {
            let ([Some(left), Some(right)], FloorPairs::Common) = (gap.between, &gap.floors) else {
                continue;
            };
            if found.iter().any(|known| known.between == [left, right]) {
                continue;
            }
            let gaps = self
                .gaps
                .iter()
                .filter(|other| other.between == gap.between);
            let pairs: Vec<PointPair> = gaps
                .filter_map(|gap| {
                    let sides = self.neighbours(gap.between);
                    point_pairs(&gap.floors, sides, gap.level_tolerance).ok()
                })
                .flatten()
                .collect();
            let (Some(a), Some(b)) = (self.buildings.get(left), self.buildings.get(right)) else {
                continue;
            };
            let heights = [a.floor_levels(), b.floor_levels()];
            let feet = [a, b].map(|building| building.base.elevation);
            let floors = [0, 1].map(|side| {
                let roof = heights[1 - side].last().copied().unwrap_or(0.0);
                let within = |height: f64| {
                    let below = height <= roof || level(height, roof, gap.level_tolerance);
                    below && height > feet[1 - side]
                };
                let met = |height: f64| {
                    let mut points = pairs.iter().filter_map(|pair| pair[side]);
                    points.any(|point| (point - height).abs() <= SAME)
                };
                let alone = heights[side].iter().enumerate();
                alone
                    .filter(|(_, height)| within(**height) && !met(**height))
                    .map(|(floor, _)| floor + 1)
                    .collect::<Vec<_>>()
            });
            if floors.iter().any(|side| !side.is_empty()) {
                found.push(UnmatchedFloors {
                    gap: index,
                    between: [left, right],
                    floors,
                    contacts: pairs.len(),
                });
            }
        }
        found
    }
}

/// Points of one side must coincide or have a minimum distance.
fn check_room(pairs: &[PointPair]) -> Result<(), Vec<Misfit>> {
    for side in 0..2 {
        for (entry, pair) in pairs.iter().enumerate() {
            let others = pairs[..entry].iter().filter_map(|other| other[side]);
            if let Some(problem) = pair[side].and_then(|pair| crowded(pair, others)) {
                return Err(vec![Misfit::at(entry, problem)]);
            }
        }
    }
    Ok(())
}

/// The error of a point too close to another point of its side without coinciding with it.
pub(crate) fn crowded(height: f64, others: impl Iterator<Item = f64>) -> Option<String> {
    let apart = others.map(|other| (other - height).abs());
    let apart = apart.filter(|apart| *apart > SAME && *apart < NEAREST);
    Some(format!(
        "is only {:.1} mm from another point of the same face, at {height:.3} m; leave {:.0} mm, or give both the same height",
        apart.min_by(f64::total_cmp)? * 1e3,
        NEAREST * 1e3
    ))
}

/// Points closer than this coincide \[m\].
pub(crate) const SAME: f64 = 1e-6;

/// Whether two heights differ by no more than a tolerance, up to the rounding of sums of storey heights \[m\].
fn level(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance + 1e-9 * a.abs().max(b.abs())
}

/// By how much the faces at two points stand farther apart than the edges of their buildings, between which a single width of the gap
/// lies; widths of every contact are those of its faces \[m\].
pub(crate) fn set_back(gap: &Gap, between: [Option<&Building>; 2], pair: &PointPair) -> f64 {
    if gap.widths.len() > 1 {
        return 0.0;
    }
    let of_side = |side: usize| {
        let (building, point) = (between[side]?, pair[side]?);
        let floors = building.floor_levels();
        let floor = floors.iter().position(|floor| *floor >= point - SAME)?;
        // The left building is struck on its right.
        Some(building.set_back(floor + 1)[1 - side])
    };
    [0, 1].into_iter().filter_map(of_side).sum()
}

pub(crate) fn mean(pair: &PointPair) -> f64 {
    match *pair {
        [Some(a), Some(b)] => 0.5 * (a + b),
        [a, b] => a.or(b).unwrap_or(0.0),
    }
}
