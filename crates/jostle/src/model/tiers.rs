//! A building in space: floors that move in both horizontal directions and turn about a vertical axis.

use super::plan_spring::PlanSpring;
use super::{FloorMatrices, LumpedFloor, PlanFrame, STANDARD_GRAVITY, SpaceFrame};

/// A point or a vector in plan: x along the row, y across it \[m\].
pub type PlanPoint = [f64; 2];

/// Rigid floors one above the other, joined by springs that act at points of the plan.
///
/// A floor moves by u_x, u_y and θ at its centre of mass, relative to the ground. Storey s deforms by
/// Δ = T_s(c) q_s − T_{s−1}(c) q_{s−1}, T(c) = \[1 0 −(c_y − o_y); 0 1 c_x − o_x; 0 0 1\], with c the centre of stiffness of
/// the storey and o the centre of mass of a floor (A. K. Chopra, Dynamics of Structures, section 9.6).
///
/// ```
/// use jostle::{Tier, TierStorey, Tiers};
///
/// // 20 m × 12 m, 250 t, stiffness centre 1 m right of the centre of mass.
/// let plan = vec![[0.0, 0.0], [20.0, 0.0], [20.0, 12.0], [0.0, 12.0]];
/// let tier = Tier::uniform(250e3, plan).expect("a plan with an area");
/// assert_eq!(tier.centre, [10.0, 6.0]);
/// assert!((tier.polar_mass / (250e3 * (400.0 + 144.0) / 12.0) - 1.0).abs() < 1e-14);
/// let storey = TierStorey { stiffness: [60e6, 85e6, 5.5e9], centre: [11.0, 6.0] };
/// let tiers = Tiers {
///     floors: vec![tier],
///     storeys: vec![storey],
///     storey_heights: vec![3.2],
///     ..Tiers::default()
/// };
/// assert_eq!(tiers.floors.len(), tiers.storeys.len());
/// ```
///
/// The default has neither floors nor anything that holds them, so that the check refuses it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tiers {
    /// Floors from the ground up.
    pub floors: Vec<Tier>,
    /// Storeys from the ground up, as many as floors; none where frames alone, plane ones or a space frame, or matrices hold the floors.
    pub storeys: Vec<TierStorey>,
    /// Storey heights from the ground up, > 0 \[m\].
    pub storey_heights: Vec<f64>,
    /// Plane frames at lines of the plan, which hold the floors beside the springs of the storeys.
    pub frames: Vec<PlanFrame>,
    /// Space frame that holds the floors, beside the springs of the storeys.
    pub space_frame: Option<SpaceFrame>,
    /// Stiffness and damping over the motions of all floors, as another program has them, beside all that holds the floors.
    pub matrices: Option<FloorMatrices>,
    /// Springs that yield, which hold the floors beside these.
    pub yielding: Vec<PlanSpring>,
    /// Names of the columns and walls to which such springs belong, as far as they have one.
    pub element_names: Vec<Option<String>>,
    /// Places of the bearings of an isolated building on the site, each with an equal share of all; empty takes four that stand for
    /// an even spread, [`Tiers::bearing_points`] \[m\].
    pub bearings: Vec<PlanPoint>,
}

/// A floor in plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Tier {
    /// Mass, > 0 \[kg\].
    pub mass: f64,
    /// Mass moment of inertia about the vertical axis through the centre of mass, > 0 \[kg·m²\].
    pub polar_mass: f64,
    /// Centre of mass on the site \[m\].
    pub centre: PlanPoint,
    /// Corners on the site, counter-clockwise, at least three \[m\].
    pub plan: Vec<PlanPoint>,
}

/// Springs of a storey.
///
/// Beside frames and springs that yield some of them may be 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TierStorey {
    /// Along x, across, and in torsion about the centre of stiffness, > 0 \[N/m, N/m, N·m/rad\].
    pub stiffness: [f64; 3],
    /// Centre of stiffness on the site \[m\].
    pub centre: PlanPoint,
}

/// Place of a column or a wall in plan \[m\], and its stiffness along x and across \[N/m\].
pub type PlanElement = (PlanPoint, [f64; 2]);

/// Area, centroid and second moments of area of a polygon.
///
/// A = ½Σw, c = Σ(p_i + p_{i+1}) w_i/(6A), I_xx = ∫y², I_yy = ∫x² about c, w_i = x_i y_{i+1} − x_{i+1} y_i (Green's theorem).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanArea {
    /// Area, positive if the corners run counter-clockwise \[m²\].
    pub area: f64,
    /// Centroid \[m\].
    pub centroid: PlanPoint,
    /// ∫y² and ∫x² about the centroid \[m⁴\].
    pub second_moments: [f64; 2],
}

impl PlanArea {
    /// Of a polygon given by its corners. Without area the centroid is not a number.
    #[must_use]
    pub fn new(corners: &[PlanPoint]) -> Self {
        // Relative to the first corner, so that distant sites lose no digits.
        let origin = corners.first().copied().unwrap_or_default();
        let points: Vec<PlanPoint> = corners
            .iter()
            .map(|p| [p[0] - origin[0], p[1] - origin[1]])
            .collect();
        let next = points.iter().cycle().skip(1);
        let (mut area, mut first, mut second) = (0.0, [0.0; 2], [0.0; 2]);
        for (a, b) in points.iter().zip(next) {
            let w = a[0] * b[1] - b[0] * a[1];
            area += 0.5 * w;
            for k in 0..2 {
                first[k] += (a[k] + b[k]) * w / 6.0;
                let across = 1 - k;
                second[k] +=
                    (a[across] * a[across] + a[across] * b[across] + b[across] * b[across]) * w
                        / 12.0;
            }
        }
        let centre = first.map(|moment| moment / area);
        Self {
            area,
            centroid: [centre[0] + origin[0], centre[1] + origin[1]],
            second_moments: [
                second[0] - area * centre[1] * centre[1],
                second[1] - area * centre[0] * centre[0],
            ],
        }
    }

    /// (I_xx + I_yy)/A: the squared polar radius of gyration \[m²\].
    #[must_use]
    pub fn gyration(&self) -> f64 {
        (self.second_moments[0] + self.second_moments[1]) / self.area
    }
}

impl Tiers {
    /// Moves it on the site \[m\].
    pub fn move_by(&mut self, by: PlanPoint) {
        let shift = |point: &mut PlanPoint| {
            for (value, by) in point.iter_mut().zip(by) {
                *value += by;
            }
        };
        for floor in &mut self.floors {
            shift(&mut floor.centre);
            floor.plan.iter_mut().for_each(shift);
        }
        self.storeys
            .iter_mut()
            .for_each(|storey| shift(&mut storey.centre));
        self.frames
            .iter_mut()
            .for_each(|frame| shift(&mut frame.at));
        if let Some(frame) = &mut self.space_frame {
            shift(&mut frame.at);
        }
        self.yielding
            .iter_mut()
            .for_each(|spring| shift(&mut spring.at));
        self.bearings.iter_mut().for_each(shift);
    }

    /// Whether springs or frames may crack or yield.
    #[must_use]
    pub fn may_yield(&self) -> bool {
        let in_space = self.space_frame.as_ref();
        !self.yielding.is_empty()
            || self.frames.iter().any(PlanFrame::may_yield)
            || in_space.is_some_and(SpaceFrame::may_yield)
    }

    /// The springs of a storey, counted from 0, before anything yields: those that stay elastic and those that yield together, about
    /// their common centre of stiffness; `None` where neither are.
    #[must_use]
    pub fn initial_storey(&self, storey: usize) -> Option<TierStorey> {
        let elastic = self.storeys.get(storey);
        let yielding = self
            .yielding
            .iter()
            .filter(|yielding| yielding.storey == storey);
        let mut elements: Vec<PlanElement> = yielding
            .map(|spring| {
                let mut stiffness = [0.0; 2];
                stiffness[spring.axis.index()] = spring.hysteresis.initial_tangent();
                (spring.at, stiffness)
            })
            .collect();
        if elements.is_empty() {
            return elastic.copied();
        }
        let mut torsion = 0.0;
        if let Some(storey) = elastic {
            let [x, y, turning] = storey.stiffness;
            elements.push((storey.centre, [x, y]));
            torsion = turning;
        }
        let mut together = TierStorey::of_elements(&elements);
        together.stiffness[2] += torsion;
        Some(together)
    }

    /// Weight of a floor, counted from 0, that the columns of its space frame carry beyond that of its mass \[N\].
    pub(crate) fn floor_load(&self, floor: usize) -> f64 {
        let loads = self
            .space_frame
            .as_ref()
            .map(|space_frame| &space_frame.floor_load);
        loads
            .and_then(|load| load.get(floor))
            .copied()
            .unwrap_or(0.0)
    }

    /// What the weight above a storey, counted from 0, takes from its stiffness where P-Delta is included: (P/h) diag(1, 1, ρ²) at
    /// the centroid of what it carries, ρ² = (I_xx + I_yy)/A of its upper floor. `lumped` are the floors with all that moves with
    /// them \[N/m, N/m, N·m/rad\].
    #[must_use]
    pub fn softening(&self, lumped: &[LumpedFloor], storey: usize) -> TierStorey {
        let above: Vec<(f64, PlanPoint)> = lumped[storey..]
            .iter()
            .enumerate()
            .map(|(floor, LumpedFloor { tier, .. })| {
                let load = self.floor_load(storey + floor) / STANDARD_GRAVITY;
                (tier.mass + load, tier.centre)
            })
            .collect();
        let mass: f64 = above.iter().map(|(mass, _)| mass).sum();
        let moment = |axis: usize| {
            let moments = above.iter().map(|(mass, centre)| mass * centre[axis]);
            moments.sum::<f64>()
        };
        let push = mass * STANDARD_GRAVITY / self.storey_heights[storey];
        let gyration = PlanArea::new(&self.floors[storey].plan).gyration();
        TierStorey {
            stiffness: [push, push, push * gyration],
            centre: match mass > 0.0 {
                true => [moment(0) / mass, moment(1) / mass],
                false => lumped[storey].tier.centre,
            },
        }
    }

    /// Least and greatest x of its corners \[m\].
    #[must_use]
    pub fn extent_along(&self) -> [f64; 2] {
        let corners = self.floors.iter().flat_map(|floor| &floor.plan);
        corners.fold(
            [f64::INFINITY, f64::NEG_INFINITY],
            |[least, most], corner| [least.min(corner[0]), most.max(corner[0])],
        )
    }
}

impl Tier {
    /// A floor whose mass is spread evenly over its plan; `None` if the plan has no area.
    #[must_use]
    pub fn uniform(mass: f64, plan: Vec<PlanPoint>) -> Option<Self> {
        let area = PlanArea::new(&plan);
        (area.area > 0.0).then(|| Self {
            mass,
            polar_mass: mass * area.gyration(),
            centre: area.centroid,
            plan,
        })
    }
}

impl TierStorey {
    /// Stiffness that is spread evenly over a plan: torsion follows as (k_x I_xx + k_y I_yy)/A.
    #[must_use]
    pub fn torsion_of_even(stiffness: PlanPoint, area: &PlanArea) -> f64 {
        let [ixx, iyy] = area.second_moments;
        (stiffness[0] * ixx + stiffness[1] * iyy) / area.area
    }

    /// Elements at points of the plan, each with its stiffness along x and across: c_y = Σk_x y/Σk_x, c_x = Σk_y x/Σk_y,
    /// k_θ = Σk_x (y − c_y)² + k_y (x − c_x)².
    #[must_use]
    pub fn of_elements(elements: &[PlanElement]) -> Self {
        let sum = |of: &dyn Fn(&PlanElement) -> f64| elements.iter().map(of).sum::<f64>();
        let [kx, ky] = [0, 1].map(|axis| sum(&|(_, k)| k[axis]));
        // What has no stiffness in a direction has no centre there either: any place serves.
        let mean = |moment: f64, whole: f64, axis: usize| match whole == 0.0 && moment == 0.0 {
            true => elements.first().map_or(0.0, |(at, _)| at[axis]),
            false => moment / whole,
        };
        let centre = [
            mean(sum(&|(at, k)| k[1] * at[0]), ky, 0),
            mean(sum(&|(at, k)| k[0] * at[1]), kx, 1),
        ];
        let torsion =
            sum(&|(at, k)| k[0] * (at[1] - centre[1]).powi(2) + k[1] * (at[0] - centre[0]).powi(2));
        Self {
            stiffness: [kx, ky, torsion],
            centre,
        }
    }
}
