//! Isolated buildings in plan: the plane as their limit, an eccentric block against an integration of its own, the site that may be
//! turned, moat walls, and what is refused.

use std::f64::consts::TAU;

use jostle::history::{Kind, Owner};
use jostle::model::STANDARD_GRAVITY;
use jostle::{
    Analysis, Base, Bearing, Building, Column, Damping, FloorPairs, Gap, GroundMotion, Isolation,
    Isolator, IsolatorDamping, Level, Model, Outcome, PlanArea, PlanPoint, SlidingSurface, Solver,
    SpeedFriction, Stop, Structure, System, Tier, TierStorey, Tiers, Wall,
};
use jostle_testkit::models::{CONCRETE, UNDAMPED, equal_storeys, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

use crate::verification::support::{column, difference, largest, spring_forces};

pub(crate) fn shaking(name: &str, rate: f64, scale: f64) -> GroundMotion {
    fading(name, rate, [scale, 2.5], 300)
}

pub(crate) fn from(
    mut motion: GroundMotion,
    angle: f64,
    across: Option<GroundMotion>,
) -> GroundMotion {
    motion.bearing = Some(Box::new(Bearing { angle, across }));
    motion
}

fn turned(point: PlanPoint, angle: f64) -> PlanPoint {
    let (sin, cos) = angle.sin_cos();
    [
        cos * point[0] - sin * point[1],
        sin * point[0] + cos * point[1],
    ]
}

/// The bearing that goes furthest, and how far \[m\].
fn stroke(outcome: &Outcome) -> (usize, f64) {
    let strokes = outcome.peaks.sizes(|column| column.kind == Kind::Stroke);
    let all = strokes.into_iter().enumerate();
    all.max_by(|a, b| a.1.total_cmp(&b.1)).expect("bearings")
}

/// Floors on even storeys, with a centre of stiffness that may lie elsewhere.
fn tiers(
    storeys: usize,
    [mass, stiffness]: [f64; 2],
    plan: &[PlanPoint],
    eccentricity: PlanPoint,
) -> Tiers {
    let tier = Tier::uniform(mass, plan.to_vec()).expect("an area");
    let torsion = TierStorey::torsion_of_even([stiffness; 2], &PlanArea::new(plan));
    let centre = [0, 1].map(|axis| tier.centre[axis] + eccentricity[axis]);
    Tiers {
        floors: vec![tier; storeys],
        storeys: vec![
            TierStorey {
                stiffness: [stiffness, stiffness, torsion],
                centre,
            };
            storeys
        ],
        storey_heights: vec![3.0; storeys],
        ..Tiers::default()
    }
}

fn building(structure: Structure, damping: Damping, isolation: Isolation) -> Building {
    Building {
        name: "block".to_owned(),
        structure,
        damping,
        base: Base {
            isolation: Some(isolation),
            ..Base::default()
        },
        ..Building::default()
    }
}

fn model(building: Building, step: f64) -> Model {
    Model {
        title: "isolated in plan".to_owned(),
        buildings: vec![building],
        analysis: Analysis {
            step: Some(step),
            solver: Some(Solver::Riccati),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

pub(crate) fn run(model: &Model, motion: &GroundMotion) -> (System, Outcome) {
    let (system, outcome) = runs::run(model, motion, Some(0.0));
    let worst = outcome.energy.worst_imbalance;
    // Rounding grows as 1/h in the short steps of contacts, with bearings and without.
    let most = if model.gaps.is_empty() { 1e-9 } else { 1e-8 };
    assert!(worst < most, "{worst:e}");
    (system, outcome)
}

pub(crate) fn lead_rubber() -> Isolator {
    Isolator::LeadRubber {
        stiffness: 3e7,
        yield_force: 1.2e5,
        post_yield: 0.1,
    }
}

pub(crate) fn pendulum() -> Isolator {
    Isolator::Pendulum {
        radius: 1.5,
        friction: SpeedFriction::constant(0.05),
        slip_displacement: 1e-3,
    }
}

/// Friction that doubles with the speed.
pub(crate) fn fast_pendulum() -> Isolator {
    Isolator::Pendulum {
        radius: 1.5,
        friction: SpeedFriction {
            slow: 0.03,
            fast: 0.06,
            rate: 15.0,
        },
        slip_displacement: 1e-3,
    }
}

fn surface(radius: f64, friction: f64, capacity: f64) -> SlidingSurface {
    SlidingSurface {
        radius,
        friction,
        capacity,
    }
}

fn double_pendulum() -> Isolator {
    Isolator::DoublePendulum {
        surfaces: [surface(0.9, 0.02, 0.3), surface(1.4, 0.05, 0.3)],
        slip_displacement: 1e-3,
    }
}

/// Its inner surfaces reach their rims.
fn triple_pendulum() -> Isolator {
    let inner = surface(0.25, 0.01, 0.006);
    Isolator::TriplePendulum {
        surfaces: [
            surface(1.5, 0.03, 0.3),
            inner,
            inner,
            surface(1.5, 0.06, 0.3),
        ],
        slip_displacement: 1e-3,
    }
}

/// Bearings of all kinds, one with a dashpot and a stop.
fn bearings() -> [Isolation; 7] {
    let mut linear = Isolation::new(Isolator::Linear { stiffness: 4e6 }, 9e4);
    linear.damping = IsolatorDamping::Ratio(0.12);
    let mut stopped = Isolation::new(lead_rubber(), 9e4);
    stopped.damping = IsolatorDamping::Coefficient(2e5);
    stopped.stops = [Some(Stop {
        at: 0.035,
        stiffness: 6e7,
    }); 2];
    [
        linear,
        stopped,
        Isolation::new(lead_rubber(), 9e4),
        Isolation::new(pendulum(), 9e4),
        Isolation::new(fast_pendulum(), 9e4),
        Isolation::new(double_pendulum(), 9e4),
        Isolation::new(triple_pendulum(), 9e4),
    ]
}

/// Of the mat and of all floors, along a direction.
fn along(outcome: &Outcome, floors: usize, angle: f64) -> Vec<f64> {
    let (sin, cos) = angle.sin_cos();
    let of = |floor| {
        let x = column(outcome, Column::displacement(0, floor));
        let y = column(outcome, Column::displacement(0, floor).across());
        x.into_iter().zip(y).map(move |(x, y)| cos * x + sin * y)
    };
    (0..=floors).flat_map(of).collect()
}

/// Shaken along one line, a symmetric building moves as in one plane, also with the site turned. Damping has a part of both kinds, and
/// acts on motion relative to the mat.
#[test]
fn on_a_line_bearings_are_those_of_one_plane() {
    let (storeys, properties) = (3, [1.5e5, 1.2e8]);
    let damping = Damping::ratio(0.05, [1, 2]);
    for bearing in bearings() {
        let shear = equal_storeys(storeys, properties);
        let plane = model(
            building(Structure::Shear(shear), damping.clone(), bearing),
            2e-3,
        );
        let motion = shaking("line", 4.0, 1.0);
        let (_, flat) = run(&plane, &motion);
        let expected: Vec<f64> = (0..=storeys)
            .flat_map(|floor| column(&flat, Column::displacement(0, floor)))
            .collect();
        let kind = bearing.isolator.name();
        for angle in [0.0, 37.0 * TAU / 360.0, 2.0] {
            let plan: Vec<PlanPoint> = rectangle(0.0, 0.0, 14.0, 9.0)
                .into_iter()
                .map(|corner| turned(corner, angle))
                .collect();
            let tiers = tiers(storeys, properties, &plan, [0.0; 2]);
            let deep = model(
                building(Structure::Tiers(tiers), damping.clone(), bearing),
                2e-3,
            );
            let (system, deep) = run(&deep, &from(motion.clone(), angle, None));
            let apart = difference(&along(&deep, storeys, angle), &expected);
            println!("{kind} {angle:.2}: {apart:e}");
            assert!(apart < 1e-9, "{kind} {angle}: {apart:e}");
            let aside = largest(&along(&deep, storeys, angle + 0.25 * TAU));
            assert!(aside < 1e-9 * largest(&expected), "{kind}: {aside:e}");
            // One bilinear spring stores what a spring beside a slider stores, K₂u²/2 + f²/2k.
            let [a, b] = [&flat, &deep].map(|run| {
                let energy = run.energy;
                [
                    energy.hysteretic,
                    energy.strain,
                    energy.damped,
                    energy.input,
                ]
            });
            for (a, b) in a.into_iter().zip(b) {
                assert!((a - b).abs() < 1e-9 * a.max(1e4), "{kind}: {a} and {b}");
            }
            // What the bearings dissipate is the same too, and their stroke is the displacement of the mat.
            let [a, b] = [&flat, &deep].map(|run| run.peaks.floor(0, 0));
            let [damped, other] = [&flat, &deep].map(|run| run.peaks.work(Owner::Support(0)));
            assert!((damped - other).abs() < 1e-9 * damped.max(1e4));
            let peaks = &deep.peaks;
            let of_mat = |owner, kind| peaks.owned_by(owner).across().of(kind).size();
            let most = a.displacement_max().value.max(-a.displacement_min().value);
            assert!((stroke(&deep).1 / most - 1.0).abs() < 1e-9, "{kind}");
            if bearing.stops[0].is_some() {
                let stop = largest(&spring_forces(&flat)[1..]);
                let ring = Column::along(Owner::Support(0), Kind::RingForce);
                let ring = peaks.of(ring).size();
                assert!(stop > 1e4 && (ring / stop - 1.0).abs() < 1e-8);
            }
            if angle == 0.0 {
                let force = |run: &Outcome| column(run, Column::support_force(0));
                assert!(difference(&force(&deep), &force(&flat)) < 1e-9, "{kind}");
                let shear = [&flat, &deep].map(|run| run.peaks.base_shear(0));
                assert!((shear[1] / shear[0] - 1.0).abs() < 1e-9, "{kind}");
            } else {
                // Base shear across: that of the line, as far as it goes across.
                let shear = flat.peaks.base_shear(0) * angle.sin().abs();
                let across = of_mat(Owner::Building(0), Kind::Shear);
                assert!((across / shear - 1.0).abs() < 1e-8, "{kind}");
                // So are the force of the bearings and the total acceleration of the mat.
                for (across, line) in [
                    (
                        of_mat(Owner::Support(0), Kind::Force),
                        flat.peaks.of(Column::support_force(0)).size(),
                    ),
                    (
                        deep.peaks.floor(0, 1).across().storey_drift(),
                        flat.peaks.floor(0, 1).storey_drift(),
                    ),
                    (b.across().total_acceleration(), a.total_acceleration()),
                ] {
                    let expected = line * angle.sin().abs();
                    assert!((across / expected - 1.0).abs() < 1e-8, "{kind}: {across}");
                }
            }
            let rows = system.buildings[0].equations.springs.len();
            println!("{rows} rows");
        }
    }
}

/// The four bearings of the eccentric block, on the site.
pub(crate) const PLACES: [PlanPoint; 4] = [[1.0, 1.0], [11.0, 0.5], [10.0, 8.0], [0.5, 7.0]];

/// One floor with a mass centre beside the middle, on a mat with four bearings.
pub(crate) fn eccentric_block(isolator: Isolator, step: f64) -> Model {
    let plan = rectangle(0.0, 0.0, 12.0, 9.0);
    let mut tiers = tiers(1, [2.5e5, 1.5e8], &plan, [1.2, -0.7]);
    tiers.floors[0].centre = [7.0, 4.0];
    tiers.bearings = PLACES.to_vec();
    let mut isolation = Isolation::new(isolator, 1e5);
    isolation.damping = IsolatorDamping::Coefficient(1e5);
    let damping = Damping::Rayleigh {
        alpha: 0.3,
        beta: 1e-3,
    };
    let mut model = model(building(Structure::Tiers(tiers), damping, isolation), step);
    model.analysis.solver = Some(Solver::Stiffness);
    model
}

/// Motion of the eccentric block at its end and its greatest values, from its own matrices by the classical method of Runge and
/// Kutta, with the rate equation of the sliders: ḟ = k u̇ within the circle, ḟ = k (u̇ − (f̂·u̇) f̂) + Q̇ f̂ on it, Q being the strength at
/// the speed |u̇|.
pub(crate) struct ByRates {
    mass: [f64; 6],
    stiffness: [[f64; 6]; 6],
    damping: [[f64; 6]; 6],
    /// Stiffness of the slider of a bearing, its strengths at rest and at high speed, and the rate between them.
    slider: [f64; 4],
}

type Motion6 = [f64; 6];

impl ByRates {
    pub(crate) fn new(model: &Model) -> Self {
        let Structure::Tiers(tiers) = &model.buildings[0].structure else {
            panic!("it has a plan");
        };
        let isolation = model.buildings[0].base.isolation.expect("isolated");
        let floor = &tiers.floors[0];
        // Of the rectangle, by hand.
        let mat = [
            isolation.mat_mass,
            isolation.mat_mass * (144.0 + 81.0) / 12.0,
        ];
        let middle = [6.0, 4.5];
        let mass = [
            mat[0],
            mat[0],
            mat[1],
            floor.mass,
            floor.mass,
            floor.polar_mass,
        ];
        let weight = STANDARD_GRAVITY * (mat[0] + floor.mass);
        let [strength, second, yielding] = isolation.isolator.yielding(weight).expect("it slides");
        let IsolatorDamping::Coefficient(dashpot) = isolation.damping else {
            panic!("a coefficient");
        };
        let [slow, rate] = match isolation.isolator {
            Isolator::Pendulum { friction, .. } => {
                [strength * friction.slow / friction.fast, friction.rate]
            }
            _ => [strength, 0.0],
        };
        let slider = [
            0.25 * strength / yielding,
            0.25 * slow,
            0.25 * strength,
            rate,
        ];
        let row = |at: PlanPoint, centre: PlanPoint, axis: usize, first: usize, sign: f64| {
            let mut row = [0.0; 6];
            row[first + axis] = sign;
            row[first + 2] = sign * [centre[1] - at[1], at[0] - centre[0]][axis];
            row
        };
        let (mut stiffness, mut damping) = ([[0.0; 6]; 6], [[0.0; 6]; 6]);
        let add = |matrix: &mut [[f64; 6]; 6], row: &Motion6, value: f64| {
            for i in 0..6 {
                for j in 0..6 {
                    matrix[i][j] += value * row[i] * row[j];
                }
            }
        };
        for at in PLACES {
            for axis in 0..2 {
                let row = row(at, middle, axis, 0, 1.0);
                add(&mut stiffness, &row, 0.25 * second);
                add(&mut damping, &row, 0.25 * dashpot);
            }
        }
        let storey = &tiers.storeys[0];
        let Damping::Rayleigh { alpha, beta } = model.buildings[0].damping else {
            panic!("two coefficients");
        };
        let relative = |at: PlanPoint, axis: usize| {
            let [upper, lower] = [
                row(at, floor.centre, axis, 3, 1.0),
                row(at, middle, axis, 0, -1.0),
            ];
            std::array::from_fn(|i| upper[i] + lower[i])
        };
        let turning = [0.0, 0.0, -1.0, 0.0, 0.0, 1.0];
        for axis in 0..2 {
            let motion6: Motion6 = relative(storey.centre, axis);
            add(&mut stiffness, &motion6, storey.stiffness[axis]);
            add(&mut damping, &motion6, beta * storey.stiffness[axis]);
            let relative: Motion6 = relative(floor.centre, axis);
            add(&mut damping, &relative, alpha * floor.mass);
        }
        add(&mut stiffness, &turning, storey.stiffness[2]);
        add(
            &mut damping,
            &turning,
            beta * storey.stiffness[2] + alpha * floor.polar_mass,
        );
        Self {
            mass,
            stiffness,
            damping,
            slider,
        }
    }

    pub(crate) fn bearing(at: PlanPoint, motion: &[f64]) -> PlanPoint {
        [
            motion[0] - (at[1] - 4.5) * motion[2],
            motion[1] + (at[0] - 6.0) * motion[2],
        ]
    }

    /// Rates of displacements, velocities and forces, and the power that slides away.
    fn rates(&self, state: &[f64; 21], ground: [f64; 3]) -> [f64; 21] {
        let (u, v) = (&state[..6], &state[6..12]);
        let mut rates = [0.0; 21];
        rates[..6].copy_from_slice(v);
        let mut load = [0.0; 6];
        for i in 0..6 {
            for j in 0..6 {
                load[i] -= self.stiffness[i][j] * u[j] + self.damping[i][j] * v[j];
            }
        }
        for (index, at) in PLACES.into_iter().enumerate() {
            let f = [state[12 + 2 * index], state[13 + 2 * index]];
            load[0] -= f[0];
            load[1] -= f[1];
            load[2] -= (at[0] - 6.0) * f[1] - (at[1] - 4.5) * f[0];
        }
        for i in 0..6 {
            let shaken = if i % 3 == 2 { 0.0 } else { ground[i % 3] };
            rates[6 + i] = load[i] / self.mass[i] - shaken;
        }
        for (index, at) in PLACES.into_iter().enumerate() {
            let f = [state[12 + 2 * index], state[13 + 2 * index]];
            let moved = Self::bearing(at, v);
            let quickened = Self::bearing(at, &rates[6..9]);
            let [strength, by_speed] = self.strength(moved);
            let k = self.slider[0];
            let held = f[0].hypot(f[1]);
            let outwards = f[0] * moved[0] + f[1] * moved[1];
            let speed = moved[0].hypot(moved[1]).max(1e-300);
            let faster = (moved[0] * quickened[0] + moved[1] * quickened[1]) / speed;
            // A circle that widens faster than the elastic force grows holds it; a force on it may have been rounded into it.
            let slip = outwards / held - by_speed * faster / k;
            let slides = held >= (1.0 - 1e-7) * strength && outwards > 0.0 && slip > 0.0;
            let share = if slides { slip / held } else { 0.0 };
            for axis in 0..2 {
                rates[12 + 2 * index + axis] = k * (moved[axis] - share * f[axis]);
                rates[20] += f[axis] * share * f[axis];
            }
        }
        rates
    }

    /// Strength of a slider at a velocity, and its derivative by the speed.
    fn strength(&self, moved: PlanPoint) -> [f64; 2] {
        let [_, slow, fast, rate] = self.slider;
        let missing = (fast - slow) * (-rate * moved[0].hypot(moved[1])).exp();
        [fast - missing, rate * missing]
    }

    /// Energy stored in storeys, rubber or pendulums, and in the stiffness of sliders.
    pub(crate) fn stored(&self, state: &[f64; 21]) -> f64 {
        let u = &state[..6];
        let pairs = (0..6).flat_map(|i| (0..6).map(move |j| (i, j)));
        let elastic: f64 = pairs.map(|(i, j)| u[i] * self.stiffness[i][j] * u[j]).sum();
        let sliders: f64 = state[12..20].iter().map(|force| force * force).sum();
        0.5 * elastic + 0.5 * sliders / self.slider[0]
    }

    /// State at the end with the energy dissipated by sliding, and greatest stroke of a bearing.
    pub(crate) fn run(&self, motion: &GroundMotion, duration: f64, step: f64) -> ([f64; 21], f64) {
        let mut state = [0.0; 21];
        let steps = (duration / step).round() as usize;
        let mut stroke = 0.0_f64;
        let moved = |state: &[f64; 21], rates: &[f64; 21], by: f64| -> [f64; 21] {
            std::array::from_fn(|i| state[i] + by * rates[i])
        };
        for count in 0..steps {
            let t = step * count as f64;
            let [before, middle, after] =
                [t, t + 0.5 * step, t + step].map(|t| motion.components(t));
            let a = self.rates(&state, before);
            let b = self.rates(&moved(&state, &a, 0.5 * step), middle);
            let c = self.rates(&moved(&state, &b, 0.5 * step), middle);
            let d = self.rates(&moved(&state, &c, step), after);
            state = std::array::from_fn(|i| {
                state[i] + step / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i])
            });
            for (index, at) in PLACES.into_iter().enumerate() {
                // Steps that reach the circle end a little outside of it, those on it beside it.
                let f = [state[12 + 2 * index], state[13 + 2 * index]];
                let moved = Self::bearing(at, &state[6..12]);
                let over = f[0].hypot(f[1]) / self.strength(moved)[0];
                // A strength that changes leaves it by the error of the step alone.
                let constant = self.slider[3] == 0.0;
                let slides =
                    constant && over > 1.0 - 1e-6 && f[0] * moved[0] + f[1] * moved[1] > 0.0;
                if over > 1.0 || slides {
                    state[12 + 2 * index] /= over;
                    state[13 + 2 * index] /= over;
                }
                let [x, y] = Self::bearing(at, &state[..6]);
                stroke = stroke.max(x.hypot(y));
            }
        }
        (state, stroke)
    }
}

/// Both integrators have the same matrices only in their numbers: these are assembled here. The error of the steps is of second order.
#[test]
fn an_eccentric_block_moves_by_the_rate_equation() {
    for (kind, isolator) in [
        ("lead-rubber", lead_rubber()),
        ("pendulum", pendulum()),
        ("pendulum, rising friction", fast_pendulum()),
    ] {
        let motion = from(
            shaking("first", 4.0, 0.5),
            0.4,
            Some(shaking("across", 5.3, 0.4)),
        );
        let duration = motion.duration;
        let rates = ByRates::new(&eccentric_block(isolator, 1e-3));
        let [(rough, _), (exact, stroke)] =
            [1e-5, 2.5e-6].map(|step| rates.run(&motion, duration, step));
        let scale = largest(&exact[..6]);
        // Of first order, where a force reaches the circle within a step.
        let own_error = difference(&rough[..6], &exact[..6]) / 3.0;
        let error = |step: f64| {
            let model = eccentric_block(isolator, step);
            let (system, outcome) = run(&model, &motion);
            let mat = system.buildings[0].mat_in_plan.as_ref().expect("isolated");
            let u = &outcome.state.displacement;
            let floor = [0, 1, 2].map(|c| u[system.buildings[0].tracks[c].dof]);
            let found: Vec<f64> = mat.dofs.iter().map(|dof| u[*dof]).chain(floor).collect();
            let apart = found.iter().zip(&exact).map(|(a, b)| (a - b).abs());
            let peak = (self::stroke(&outcome).1 / stroke - 1.0).abs();
            [apart.fold(0.0, f64::max) / scale, peak]
        };
        let errors = [2e-3, 1e-3, 5e-4].map(error);
        println!("{kind}: {errors:?}, {own_error:e}, {stroke}");
        assert!(own_error < 3e-5, "{own_error:e}");
        for axis in 0..2 {
            let [coarse, middle, fine] = errors.map(|error| error[axis]);
            assert!(fine < 6e-5, "{kind}: {errors:?}");
            assert!(coarse > 8.0 * fine || fine < 1e-5, "{kind}: {errors:?}");
            assert!(middle < 0.5 * coarse || middle < 1e-5, "{kind}: {errors:?}");
        }
    }
}

/// The worst bearing and its stroke are those of the histories of the mat.
#[test]
fn the_worst_bearing_is_that_of_the_histories() {
    let motion = two_components(0.4);
    let (_, outcome) = run(&eccentric_block(lead_rubber(), 1e-3), &motion);
    let (building, floor) = (0, 0);
    let [u, v, turn] = [
        Column::displacement(building, floor),
        Column::displacement(building, floor).across(),
        Column::displacement(building, floor).turning(),
    ]
    .map(|quantity| column(&outcome, quantity));
    let rows = u.iter().zip(&v).zip(&turn);
    let greatest = |at: &PlanPoint| {
        let moved = rows
            .clone()
            .map(|((u, v), turn)| ByRates::bearing(*at, &[*u, *v, *turn]));
        moved.map(|[x, y]| x.hypot(y)).fold(0.0, f64::max)
    };
    // The lowest storey twists by the floor less the mat; its height is 3 m.
    let above = column(&outcome, Column::displacement(building, 1).turning());
    let twists = above.iter().zip(&turn).map(|(a, b)| (a - b).abs() / 3.0);
    let twist = outcome.peaks.floor(0, 1).turning().storey_drift();
    assert!((twists.fold(0.0, f64::max) / twist - 1.0).abs() < 1e-3);
    let strokes = PLACES.each_ref().map(greatest);
    let worst = (0..4).max_by(|a, b| strokes[*a].total_cmp(&strokes[*b]));
    let (bearing, stroke) = stroke(&outcome);
    assert_eq!(worst, Some(bearing));
    assert!(
        bearing > 0,
        "the first one would prove nothing: {strokes:?}"
    );
    assert!(
        (strokes[bearing] / stroke - 1.0).abs() < 1e-4,
        "{strokes:?} {stroke}"
    );
}

/// The block and two moat walls, before its right side and before its upper side, all turned.
fn before_walls(isolation: Isolation, angle: f64) -> Model {
    let corner = |x: f64, y: f64| turned([x, y], angle);
    let plan: Vec<PlanPoint> = rectangle(0.0, 0.0, 12.0, 9.0)
        .into_iter()
        .map(|[x, y]| corner(x, y))
        .collect();
    let mut tiers = tiers(2, [2e5, 1.5e8], &plan, turned([0.8, -0.5], angle));
    tiers.bearings = PLACES.iter().map(|[x, y]| corner(*x, *y)).collect();
    let damping = Damping::ratio(0.03, [1, 2]);
    let mut model = model(building(Structure::Tiers(tiers), damping, isolation), 1e-3);
    model.analysis.contact_step = Some(2e-4);
    let wall = |name: &str, from: PlanPoint, to: PlanPoint| Wall {
        name: name.to_owned(),
        stiffness: None,
        damping: 0.0,
        mass: 0.0,
        line: Some([from, to]),
    };
    model.walls = vec![
        wall("right", corner(12.03, -0.5), corner(12.03, 9.5)),
        wall("back", corner(12.5, 9.02), corner(-0.5, 9.02)),
    ];
    model.gaps = [(1, 0.03), (2, 0.02)]
        .map(|(side, width)| {
            let mut gap = Gap::between([Some(0), Some(side)], width, CONCRETE);
            gap.floors = FloorPairs::Listed(vec![[Level::Floor(0), Level::Wall]]);
            gap
        })
        .to_vec();
    model
}

pub(crate) fn two_components(angle: f64) -> GroundMotion {
    let across = shaking("across", 5.3, 1.0);
    from(shaking("first", 4.0, 1.3), angle, Some(across))
}

/// The mat hits moat walls on two sides.
#[test]
fn a_mat_hits_moat_walls_on_two_sides() {
    for bearing in bearings() {
        let (system, outcome) = run(&before_walls(bearing, 0.0), &two_components(0.3));
        let kind = bearing.isolator.name();
        println!("{kind}: {} impacts", outcome.face_impacts.len());
        for face in 0..2 {
            let face_impacts = outcome
                .face_impacts
                .iter()
                .filter(|face_impact| face_impact.face == face);
            let impacts: Vec<_> = face_impacts.collect();
            assert!(!impacts.is_empty(), "{kind}: face {face}");
            let contact = system.contacts.iter();
            let mut contact =
                contact.filter(|contact| contact.plan.is_some_and(|p| p.face == face));
            let first = contact.next().expect("points");
            assert_eq!(system.floors_of(&first.ports), [Some(0), None]);
        }
    }
}

/// A turned site has the same response in its own directions: contacts, rings, friction and bearings at given places.
#[test]
fn the_site_may_be_turned() {
    let angle = 37.0 * TAU / 360.0;
    for bearing in bearings() {
        let kind = bearing.isolator.name();
        let run_at =
            |angle: f64| run(&before_walls(bearing, angle), &two_components(0.3 + angle)).1;
        let [straight, skew] = [0.0, angle].map(run_at);
        let of = |outcome: &Outcome, angle: f64| {
            let mut all = along(outcome, 2, angle);
            all.extend(along(outcome, 2, angle + 0.25 * TAU));
            all
        };
        let apart = difference(&of(&skew, angle), &of(&straight, 0.0));
        println!("{kind}: {apart:e}");
        assert!(apart < 1e-8, "{kind}: {apart:e}");
        let [a, b] = [&straight, &skew].map(|run| stroke(run).1);
        assert!((a - b).abs() < 1e-8 * a);
        let torque = Column::along(Owner::Building(0), Kind::Shear).turning();
        let [a, b] = [&straight, &skew].map(|run| run.peaks.of(torque).size());
        assert!((a - b).abs() < 1e-7 * a);
        assert_eq!(straight.face_impacts.len(), skew.face_impacts.len());
    }
}

/// A mat that meets a wall with its whole side has the impacts of one plane.
#[test]
fn a_mat_before_a_wall_hits_it_as_in_one_plane() {
    let (storeys, properties) = (2, [1.5e5, 1.2e8]);
    let damping = Damping::ratio(0.05, [1]);
    let isolation = Isolation::new(lead_rubber(), 9e4);
    let shear = equal_storeys(storeys, properties);
    let plan = rectangle(0.0, 0.0, 10.0, 8.0);
    let tiers = tiers(storeys, properties, &plan, [0.0; 2]);
    let mut models = [Structure::Shear(shear), Structure::Tiers(tiers)]
        .map(|structure| model(building(structure, damping.clone(), isolation), 1e-3));
    for model in &mut models {
        model.analysis.contact_step = Some(5e-5);
    }
    let mut gap = Gap::between([Some(0), None], 0.02, CONCRETE);
    gap.floors = FloorPairs::Listed(vec![[Level::Floor(0), Level::Wall]]);
    models[1].walls = vec![Wall {
        name: "right".to_owned(),
        stiffness: None,
        damping: 0.0,
        mass: 0.0,
        line: Some([[10.02, 0.0], [10.02, 8.0]]),
    }];
    models[0].gaps = vec![gap.clone()];
    gap.between = [Some(0), Some(1)];
    models[1].gaps = vec![gap];
    let motion = shaking("line", 4.0, 1.0);
    let [flat, deep] = models.each_ref().map(|model| run(model, &motion).1);
    assert!(flat.impacts.len() > 2, "{}", flat.impacts.len());
    assert_eq!(flat.impacts.len(), deep.face_impacts.len());
    for (a, b) in flat.impacts.iter().zip(&deep.face_impacts) {
        let apart = (b.peak_force.value / a.peak_force - 1.0).abs();
        assert!(apart < 1e-6, "{apart:e}");
    }
    let of = |run: &Outcome| column(run, Column::displacement(0, 0));
    let apart = difference(&of(&deep), &of(&flat));
    println!("{} impacts, {apart:e}", flat.impacts.len());
    assert!(apart < 1e-7, "{apart:e}");
}

/// A rigid block on linear bearings spread evenly has three equal periods, 2π√(m/k): sway both ways and torsion.
#[test]
fn periods_of_an_isolated_block_are_those_of_its_bearings() {
    let isolation = Isolation::new(Isolator::Linear { stiffness: 5e6 }, 1e5);
    let plan = rectangle(0.0, 0.0, 12.0, 9.0);
    let tiers = tiers(1, [4e5, 1e13], &plan, [0.0; 2]);
    let model = model(building(Structure::Tiers(tiers), UNDAMPED, isolation), 1e-2);
    let system = runs::assembled(&model);
    let expected = TAU * (5e5_f64 / 5e6).sqrt();
    for mode in &system.buildings[0].modes[..3] {
        assert!(
            (mode.period() / expected - 1.0).abs() < 1e-6,
            "{}",
            mode.period()
        );
    }
}

fn faults(change: impl Fn(&mut Building)) -> String {
    let mut model = eccentric_block(lead_rubber(), 1e-3);
    change(&mut model.buildings[0]);
    let faults = System::assemble(&model).expect_err("it is refused");
    let lines = faults
        .iter()
        .map(|fault| format!("{}: {}\n", fault.path, fault.problem));
    lines.collect()
}

fn own_tiers(building: &mut Building) -> &mut Tiers {
    match &mut building.structure {
        Structure::Tiers(tiers) => tiers,
        _ => panic!("it has a plan"),
    }
}

fn own_isolation(building: &mut Building) -> &mut Isolation {
    building.base.isolation.as_mut().expect("isolated")
}

#[test]
fn what_bearings_in_plan_cannot_do_is_refused() {
    let side = faults(|building| {
        own_isolation(building).stops[1] = Some(Stop {
            at: 0.1,
            stiffness: 6e7,
        });
    });
    assert!(
        side.contains("building[0].isolation.stop: is a ring under a building with a plan"),
        "{side}"
    );
    let outside = faults(|building| own_tiers(building).bearings[2] = [12.5, 3.0]);
    assert!(
        outside.contains("building[0].isolation.bearings[2]: lies outside the plan"),
        "{outside}"
    );
    let one = faults(|building| own_tiers(building).bearings = vec![[3.0, 3.0]; 3]);
    assert!(
        one.contains("building[0].isolation.bearings: must be at two different points"),
        "{one}"
    );
    let nowhere = faults(|building| building.base.isolation = None);
    assert!(
        nowhere.contains("building[0].isolation.bearings: are those of an isolated building"),
        "{nowhere}"
    );
    let unknown = faults(|building| own_tiers(building).bearings[0][1] = f64::NAN);
    assert!(
        unknown.contains("building[0].isolation.bearings"),
        "{unknown}"
    );
}
