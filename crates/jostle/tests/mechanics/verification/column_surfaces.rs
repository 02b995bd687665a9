//! Ends of columns that yield on a surface of axial force and moment: elastic ones, other solvers, mirrored models, a column that is pushed,
//! and frames in a plan.

use std::collections::BTreeMap;

use jostle::hysteresis::{Hysteresis, HysteresisRule, Side};
use jostle::pushover::{PushDirection, PushSettings, pushover};
use jostle::statics::STANDARD_GRAVITY;
use jostle::{
    Building, ColumnFibres, Damping, Fibre, FibreMaterial, Frame, FrameHinges, FrameWall, Gravity,
    Model, Outcome, PlanFrame, Solver, Structure, System, Tier, TierStorey, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::rectangle;

use super::column_fibres::{agree, answers, fibres, model, shaken, two_storeys};
use crate::verification::support::{assembled, frame, largest};

const LENGTH: f64 = 0.35;
/// EA and EI of the column over the length.
const STIFFNESS: [f64; 2] = [7.5e9 / LENGTH, 156.25e6 / LENGTH];

/// Axial forces and moments of a section of concrete and bars of [`fibres`], all of them plastic on either side of every neutral axis.
fn plastic(column_fibres: &ColumnFibres) -> Vec<[f64; 2]> {
    let bears = |fibre: &Fibre, side: Side| {
        let strength = fibre.spring.backbone().side(side).yielding.force;
        match (fibre.spring.rule(), side) {
            (HysteresisRule::Concrete(_), Side::Positive) => 0.0,
            _ => side.sign() * strength,
        }
    };
    let mut places: Vec<f64> = column_fibres.fibres.iter().map(|f| f.at[0]).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    let axes = places.iter().map(|at| at + 1e-6);
    let sums = [places[0] - 1.0].into_iter().chain(axes).map(|axis| {
        // What lies left of the axis is compressed.
        let mut sum = [0.0; 2];
        for fibre in column_fibres.fibres.iter() {
            let side = match fibre.at[0] < axis {
                true => Side::Negative,
                false => Side::Positive,
            };
            let force = bears(fibre, side);
            sum = [sum[0] + force, sum[1] + force * fibre.at[0]];
        }
        sum
    });
    let mut corners: Vec<[f64; 2]> = sums.collect();
    corners.reverse();
    // Of 16 at most 12: those that change its area least go.
    while corners.len() > 12 {
        let area = |w: &[[f64; 2]]| {
            (w[1][1] - w[0][1]) * (w[2][0] - w[0][0]) - (w[1][0] - w[0][0]) * (w[2][1] - w[0][1])
        };
        let least = (1..corners.len() - 1)
            .min_by(|a, b| area(&corners[a - 1..=a + 1]).total_cmp(&area(&corners[b - 1..=b + 1])));
        corners.remove(least.expect("a corner"));
    }
    for end in [0, corners.len() - 1] {
        corners[end][1] = corners[end][1].max(0.0);
    }
    corners
}

fn surface(post_yield: f64) -> ColumnFibres {
    let corners = plastic(&fibres(false));
    ColumnFibres::on_surface(LENGTH, [true, true], STIFFNESS, &corners, post_yield)
        .expect("a sound surface")
}

fn yielded(system: &System, outcome: &Outcome) -> usize {
    let springs = system.buildings[0].equations.springs.iter();
    let on_surface = springs
        .zip(&outcome.state.springs)
        .filter(|(spring, _)| spring.hysteresis.is_on_surface());
    let flowed = on_surface.filter(|(spring, memory)| {
        spring.hysteresis.stage(memory) == jostle::hysteresis::Stage::Yielded
    });
    flowed.count() / 2
}

/// Riccati's recursion and the stiffness matrix share nothing but the elements.
#[test]
fn both_solvers_agree_while_columns_yield() {
    for post_yield in [0.0, 0.02] {
        let [a, b] = [Solver::Riccati, Solver::Stiffness].map(|solver| {
            let mut model = model(two_storeys(), &surface(post_yield));
            model.analysis.solver = Some(solver);
            shaken(&model, 1.0)
        });
        assert!(yielded(&a.0, &a.1) >= 5, "{}", yielded(&a.0, &a.1));
        for (what, (a, b)) in ["floors", "axial forces", "moments"]
            .into_iter()
            .zip(answers(&a).into_iter().zip(answers(&b)))
        {
            agree(&a, &b, 1e-6, what);
        }
    }
}

/// The mirror image of a building answers the mirror image of a motion alike.
#[test]
fn a_mirrored_frame_mirrors_its_answer() {
    let original = shaken(&model(two_storeys(), &surface(0.01)), 1.0);
    let mut image = two_storeys();
    image.spans.reverse();
    image.beam_segments.reverse();
    let image = shaken(&model(image, &surface(0.01)), -1.0);
    let ([floors, axial, _], [a, b, _]) = (answers(&original), answers(&image));
    let exchanged = |all: &[[f64; 2]]| -> Vec<[f64; 2]> {
        all.iter().map(|[most, least]| [-least, -most]).collect()
    };
    agree(&floors, &exchanged(&a), 1e-6, "floors");
    let reversed = |all: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let columns = all.chunks(6).map(|storey| storey.chunks(2).rev().flatten());
        columns.flatten().copied().collect()
    };
    agree(&axial, &reversed(&b), 1e-6, "axial forces");
}

/// Within its surface an end is two elastic fibres at its radius.
#[test]
fn within_the_surface_ends_are_elastic_fibres() {
    let corners = [[-4e9, 0.0], [-1e9, 4e8], [4e9, 0.0]];
    let wide = ColumnFibres::on_surface(LENGTH, [true, true], STIFFNESS, &corners, 0.0);
    let radius = (STIFFNESS[1] / STIFFNESS[0]).sqrt();
    let spring = Hysteresis::elastic(0.5 * STIFFNESS[0]).expect("sound");
    let elastic = ColumnFibres {
        length: LENGTH,
        at_ends: [true, true],
        fibres: [radius, -radius]
            .map(|at| Fibre {
                at: [at, 0.0],
                spring,
                material: FibreMaterial::Bar,
            })
            .into(),
        limits: BTreeMap::new(),
    };
    let [a, b] = [wide.expect("sound"), elastic]
        .map(|ends| answers(&shaken(&model(two_storeys(), &ends), 1.0)));
    for (a, b) in a.iter().zip(&b) {
        agree(a, b, 1e-9, "elastic");
    }
}

/// A cantilever that is pushed bears the moment of the surface under its weight, and no more.
#[test]
fn a_column_that_is_pushed_bears_the_moment_of_its_surface() {
    let corners = [[-3e6, 0.0], [-1.2e6, 3.6e5], [8e5, 0.0]];
    for load in [2e5, 9e5, 2.2e6] {
        let mut stick = frame(1, &[]);
        stick.columns[0].line_mass = 0.0;
        stick.column_segments = 1;
        stick.floor_mass = vec![20e3];
        stick.floor_load = vec![load];
        let foot = ColumnFibres::on_surface(LENGTH, [true, false], STIFFNESS, &corners, 0.0);
        let mut model = model(stick, &foot.expect("sound"));
        model.buildings[0].gravity.p_delta = false;
        let system = assembled(&model);
        let building = &system.buildings[0];
        let weight = load + 20e3 * STANDARD_GRAVITY;
        let borne: f64 = building.rest.springs[..2]
            .iter()
            .map(|row| row.force())
            .sum();
        close(borne, -weight, weight, 1e-9, "axial force");
        let pair = corners.windows(2).find(|pair| pair[1][0] > -weight);
        let [a, b] = pair.map_or([corners[0]; 2], |pair| [pair[0], pair[1]]);
        let capacity = a[1] + (b[1] - a[1]) * (-weight - a[0]) / (b[0] - a[0]);
        for direction in [PushDirection::Right, PushDirection::Left] {
            let settings = PushSettings {
                direction,
                drift: 0.03,
                ..PushSettings::default()
            };
            let pushed = pushover(building, settings).expect("it can be pushed");
            let last = pushed.points.last().expect("points");
            close(3.2 * last.base_shear, capacity, capacity, 1e-9, "moment");
            assert!(last.roof > 0.9 * 0.03 * 3.2, "{}", last.roof);
            let events = pushed.points.iter().flat_map(|point| &point.events);
            assert!(events.count() >= 1);
        }
    }
}

/// Two equal frames along x that share the floors with springs across: half of it is a plane frame with half of the mass.
#[test]
fn equal_frames_in_a_plan_are_a_plane_frame() {
    let slab = 120e3;
    let light = |mut frame: Frame| {
        frame
            .columns
            .iter_mut()
            .for_each(|column| column.line_mass = 0.0);
        frame.beam_mass = vec![0.0; 2];
        frame.column_segments = 1;
        frame.beam_segments = vec![1; 2];
        frame.axial.columns_flexible = true;
        frame
    };
    let bare = light(frame(2, &[6.0, 6.0]));
    let wall = |fibres: ColumnFibres| FrameWall {
        line: 2,
        storeys: [1, 2],
        length: 1.5,
        hinges: Vec::new(),
        fibres: [(1, fibres)].into(),
        shear: None,
        stiffness_factors: [1.0; 2],
    };
    let foot = ColumnFibres {
        at_ends: [true, false],
        ..fibres(true)
    };
    let in_columns = |ends: &ColumnFibres| FrameHinges {
        fibres: bare
            .all_columns()
            .map(|(place, _)| (place, ends.clone()))
            .collect(),
        ..FrameHinges::default()
    };
    let mut walled = bare.clone();
    walled.walls = vec![wall(foot)];
    let cases = [
        (bare.clone(), in_columns(&fibres(true))),
        (bare.clone(), in_columns(&surface(0.01))),
        (walled, FrameHinges::default()),
    ];
    for (own, hinges) in cases {
        let standing = |name: &str, y: f64| PlanFrame {
            name: name.to_owned(),
            at: [0.0, y],
            direction: [1.0, 0.0],
            lines: Vec::new(),
            base: Default::default(),
            hinges: hinges.clone(),
            frame: own.clone(),
        };
        let plan = rectangle(0.0, 0.0, 12.0, 8.0);
        let tiers = Tiers {
            floors: vec![Tier::uniform(slab, plan.to_vec()).expect("an area"); 2],
            storey_heights: vec![3.2; 2],
            storeys: vec![
                TierStorey {
                    stiffness: [1.0, 4e8, 1e10],
                    centre: [6.0, 4.0],
                };
                2
            ],
            frames: vec![standing("1", 0.0), standing("2", 8.0)],
            ..Tiers::default()
        };
        let mut half = own.clone();
        half.floor_mass = vec![0.5 * slab; 2];
        let flat = Building {
            hinges: Some(jostle::Hinges::Frame(hinges.clone())),
            ..plain(Structure::Frame(half))
        };
        let [in_plan, flat] = [plain(Structure::Tiers(tiers)), flat].map(|building| {
            let model = Model {
                buildings: vec![building],
                ..Model::default()
            };
            shaken(&model, 1.2)
        });
        let (a, b) = (answers(&in_plan), answers(&flat));
        agree(&a[0], &b[0], 1e-6, "floors");
        let sections = b[1].len();
        assert!(sections > 0 && a[1].len() == 2 * sections);
        for kind in [1, 2] {
            for part in a[kind].chunks(sections) {
                agree(part, &b[kind], 1e-6, "forces of sections");
            }
        }
        let dissipated = |outcome: &Outcome| outcome.energy.hysteretic;
        let (a, b) = (dissipated(&in_plan.1), dissipated(&flat.1));
        assert!(b > 1e3, "{b}");
        close(a, 2.0 * b, largest(&[a]), 1e-6, "dissipated");
        let places = &in_plan.0.buildings[0].discretization.spring_places;
        assert_eq!(places.len(), in_plan.0.buildings[0].equations.springs.len());
        let named = places[0].named(&[], &["1".to_owned(), "2".to_owned()]);
        assert!(named.starts_with("frame 1, column"), "{named}");
    }
}

fn plain(structure: Structure) -> Building {
    Building {
        name: "A".to_owned(),
        structure,
        gravity: Gravity {
            preload: true,
            p_delta: false,
        },
        damping: Damping::Rayleigh {
            alpha: 0.4,
            beta: 0.0,
        },
        ..Building::default()
    }
}
