//! Ends of columns made of fibres in space: an integration of its own, the plane as a limit, turned buildings, other solvers.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

use jostle::history::{Kind, Owner, PeaksOf};
use jostle::hysteresis::{
    Backbone, ConcreteFall, Corners, Hysteresis, HysteresisMemory, HysteresisRule, Stage,
};
use jostle::statics::STANDARD_GRAVITY;
use jostle::system::Direction;
use jostle::{
    Axial, Bearing, Building, Column, ColumnFibres, Damping, Fibre, FibreMaterial, Frame,
    FrameHinges, Gravity, GroundMotion, Hinges, Model, Outcome, Plan, PlanPoint, Section, Solver,
    SpaceFrame, SpaceMember, SpacePlace, SpaceSection, Structure, System, Tier, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::motions::fading;

use crate::verification::support::{assembled, column, difference, largest, run, steps};

const LENGTH: f64 = 0.35;
const SIZE: PlanPoint = [0.5, 0.4];

/// Parts of concrete, then bars along all four faces; more of them at one corner if it leans.
fn fibres(counts: [usize; 2], leans: bool) -> ColumnFibres {
    let area = SIZE[0] * SIZE[1] / (counts[0] * counts[1]) as f64;
    let fall = ConcreteFall {
        residual: 0.2,
        ultimate: 3.0,
    };
    let concrete = Hysteresis::concrete(25e6 * area, 0.002 * LENGTH, fall).expect("sound");
    let middle = |axis: usize, number: usize| {
        ((number as f64 + 0.5) / counts[axis] as f64 - 0.5) * SIZE[axis]
    };
    let mut fibres = Vec::new();
    for x in 0..counts[0] {
        for y in 0..counts[1] {
            fibres.push(Fibre {
                at: [middle(0, x), middle(1, y)],
                spring: concrete,
                material: FibreMaterial::Cover,
            });
        }
    }
    for x in [-0.2, 0.0, 0.2] {
        for y in [-0.15, 0.15] {
            let thicker = leans && x > 0.1 && y > 0.1;
            let area = if thicker { 8e-4 } else { 5e-4 };
            let corners = Corners::bilinear(420e6 * area, 0.01);
            let backbone = Backbone::from_forces(200e9 * area / LENGTH, corners, corners);
            let spring = Hysteresis::new(HysteresisRule::Bilinear, backbone.expect("sound"));
            fibres.push(Fibre {
                at: [x, y],
                spring: spring.expect("sound"),
                material: FibreMaterial::Bar,
            });
        }
    }
    ColumnFibres {
        length: LENGTH,
        at_ends: [true, false],
        fibres: fibres.into(),
        limits: BTreeMap::new(),
    }
}

/// Columns at all crossings, and beams between them if asked for.
fn frame(lines: [&[f64]; 2], storeys: usize, beams: bool, fibres: &ColumnFibres) -> SpaceFrame {
    let column = SpaceSection::rectangle(SIZE, 30e9, 0.2, false).expect("a section");
    let beam = SpaceSection::beam([0.3, 0.5], 30e9, 0.2, false).expect("a section");
    let mut frame = SpaceFrame {
        lines_x: lines[0].to_vec(),
        lines_y: lines[1].to_vec(),
        ..SpaceFrame::default()
    };
    for storey in 0..storeys {
        for y in 0..lines[1].len() {
            for x in 0..lines[0].len() {
                let place = SpacePlace::Column {
                    line: [x, y],
                    storey,
                };
                frame.members.push(SpaceMember::elastic(place, column));
                frame.fibres.insert(place, fibres.clone());
                if beams && x + 1 < lines[0].len() {
                    let place = SpacePlace::BeamX {
                        span: x,
                        line: y,
                        floor: storey,
                    };
                    frame.members.push(SpaceMember::elastic(place, beam));
                }
                if beams && y + 1 < lines[1].len() {
                    let place = SpacePlace::BeamY {
                        line: x,
                        span: y,
                        floor: storey,
                    };
                    frame.members.push(SpaceMember::elastic(place, beam));
                }
            }
        }
    }
    frame
}

const HEIGHT: f64 = 3.0;

/// Floors about the middle of the lines, on these columns, under their weight.
fn building(frame: SpaceFrame, storeys: usize, mass: f64, beta: f64) -> Building {
    let [x, y] = [&frame.lines_x, &frame.lines_y].map(|lines| lines[lines.len() - 1]);
    let plan = [
        [-1.0, -2.0],
        [x + 1.0, -2.0],
        [x + 1.0, y + 2.0],
        [-1.0, y + 2.0],
    ];
    let plan = plan.map(|corner| frame.on_site(corner)).to_vec();
    let tier = Tier::uniform(mass, plan).expect("an area");
    Building {
        name: "A".to_owned(),
        structure: Structure::Tiers(Tiers {
            floors: vec![tier; storeys],
            storey_heights: vec![HEIGHT; storeys],
            space_frame: Some(frame),
            ..Tiers::default()
        }),
        damping: Damping::Rayleigh { alpha: 0.5, beta },
        gravity: Gravity {
            preload: true,
            p_delta: false,
        },
        ..Building::default()
    }
}

fn shaken(building: Building, motion: &GroundMotion, solver: Solver) -> (System, Outcome) {
    let model = Model {
        buildings: vec![building],
        ..Model::default()
    };
    let system = assembled(&model);
    let plan = Plan {
        solver,
        ..steps(1e-3, 1)
    };
    let outcome = run(&system, motion, &plan);
    let imbalance = outcome.energy.worst_imbalance;
    assert!(imbalance < 1e-4, "{imbalance:e}");
    (system, outcome)
}

/// Two components, along x of a site turned by an angle.
fn motion(scale: PlanPoint, angle: f64) -> GroundMotion {
    let across = fading("across", 7.0, [scale[1], 2.5], 150);
    GroundMotion {
        bearing: Some(Box::new(Bearing {
            angle,
            across: Some(across),
        })),
        ..fading("along", 9.0, [scale[0], 3.0], 150)
    }
}

/// Fibres that passed their strength and bars that yielded.
fn reached((system, outcome): &(System, Outcome)) -> [usize; 2] {
    let springs = &system.buildings[0].equations.springs;
    let mut counts = [0; 2];
    for (spring, memory) in springs.iter().zip(&outcome.state.springs) {
        let is_bar = spring.hysteresis.rule() == HysteresisRule::Bilinear;
        let beyond = spring.hysteresis.stage(memory) == Stage::Yielded;
        counts[usize::from(is_bar)] += usize::from(beyond);
    }
    counts
}

/// Greatest and least axial force, moment along, and moment across of every section.
fn forces((system, outcome): &(System, Outcome)) -> Vec<Vec<[f64; 2]>> {
    let sections = system.buildings[0].members.sections.iter();
    let of = |forms: &Vec<usize>| -> Vec<[f64; 2]> {
        let forms = forms.iter();
        forms.map(|form| outcome.members[0][*form]).collect()
    };
    sections.map(of).collect()
}

/// Greatest and least elongation, rotation along, and rotation across of every section.
fn moved((system, outcome): &(System, Outcome)) -> Vec<Vec<[f64; 2]>> {
    let sections = &system.buildings[0].structure.discretization.sections;
    let of = |section: usize, axes: usize| {
        let owner = Owner::Section {
            building: 0,
            section,
        };
        let all = [Direction::Up, Direction::Turning, Direction::Across];
        let all = all.into_iter().take(1 + axes);
        all.map(|direction| {
            let peak = outcome.peaks.owned_by(owner).to(direction);
            let peak = peak.of(Kind::Displacement);
            [peak.greatest.value, peak.least.value]
        })
        .collect()
    };
    let sections = sections.iter().enumerate();
    sections
        .map(|(section, fibre_section)| of(section, fibre_section.rotations.len()))
        .collect()
}

/// Both extremes of a floor.
fn extremes(floor: &PeaksOf<'_>) -> [f64; 2] {
    [
        floor.displacement_max().value,
        floor.displacement_min().value,
    ]
}

/// Compares two extremes by the greater of them.
fn agree(got: &[f64; 2], expected: &[f64; 2], tolerance: f64, what: &str) {
    for (got, wanted) in got.iter().zip(expected) {
        close(*got, *wanted, largest(expected), tolerance, what);
    }
}

/// A cantilever on fibres, with a mass at its top that moves along, across and upwards. Six equations, of the top and of elongation and
/// both rotations of the section, are solved together by Newton's method.
struct Cantilever {
    fibres: Vec<Fibre>,
    memories: Vec<HysteresisMemory>,
    /// EA/h, 3 EI/h² along and across.
    stiff: [f64; 3],
    /// Top: upwards, along, across; section: elongation, rotations along and across.
    moved: [f64; 6],
    /// N and both moments of the section.
    forces: [f64; 3],
}

impl Cantilever {
    fn new(fibres: &ColumnFibres) -> Self {
        let section = SpaceSection::rectangle(SIZE, 30e9, 0.2, false).expect("a section");
        let [x, y] = section.flexural_rigidity;
        let axial = section.axial_rigidity.expect("it stretches");
        Self {
            fibres: fibres.fibres.to_vec(),
            memories: vec![HysteresisMemory::default(); fibres.fibres.len()],
            stiff: [
                axial / HEIGHT,
                3.0 * x / HEIGHT.powi(2),
                3.0 * y / HEIGHT.powi(2),
            ],
            moved: [0.0; 6],
            forces: [0.0; 3],
        }
    }

    fn stretch(&self, fibre: &Fibre) -> f64 {
        let [elongation, along, across] = [3, 4, 5].map(|k| self.moved[k]);
        elongation + fibre.at[0] * along + fibre.at[1] * across
    }

    /// Finds where stiffness times displacement of the top, and the forces of the column, are in balance with loads.
    fn solve(&mut self, held: [f64; 3], load: [f64; 3]) {
        // N = EA/h (v − e), M = −(u + ρ h) 3 EI/h².
        let levers = [-1.0, HEIGHT, HEIGHT];
        for _ in 0..100 {
            let mut matrix = [[0.0; 7]; 6];
            let mut forces = [0.0; 3];
            for (fibre, memory) in self.fibres.iter().zip(&self.memories) {
                let response = fibre.spring.respond(memory, self.stretch(fibre));
                // Where it does not move, its slope is that of the crack that is still closed.
                let slope = if response.force == 0.0 && memory.deformation() == 0.0 {
                    fibre.spring.initial_tangent()
                } else {
                    response.tangent
                };
                let arms = [1.0, fibre.at[0], fibre.at[1]];
                for (row, arm) in arms.into_iter().enumerate() {
                    forces[row] += arm * response.force;
                    for (column, other) in arms.into_iter().enumerate() {
                        matrix[3 + row][3 + column] += arm * other * slope;
                    }
                }
            }
            for k in 0..3 {
                let unit = if k == 0 {
                    self.stiff[k]
                } else {
                    self.stiff[k] / HEIGHT
                };
                let strain = self.moved[k] + levers[k] * self.moved[3 + k];
                matrix[k][k] += unit + held[k];
                matrix[k][3 + k] += unit * levers[k];
                matrix[3 + k][k] += unit * levers[k];
                matrix[3 + k][3 + k] += unit * levers[k] * levers[k];
                matrix[k][6] = load[k] - held[k] * self.moved[k] - unit * strain;
                matrix[3 + k][6] = -forces[k] - unit * levers[k] * strain;
            }
            self.forces = forces;
            let step = solved(matrix);
            for (displacement, step) in self.moved.iter_mut().zip(step) {
                *displacement += step;
            }
            if largest(&step) < 1e-14 {
                return;
            }
        }
        panic!("no balance at {:?}", self.moved);
    }

    fn accept(&mut self) {
        let stretches: Vec<f64> = self
            .fibres
            .iter()
            .map(|fibre| self.stretch(fibre))
            .collect();
        let fibres = self.fibres.iter().zip(&mut self.memories);
        for ((fibre, memory), stretch) in fibres.zip(stretches) {
            *memory = fibre.spring.respond(memory, stretch).memory;
        }
    }
}

/// Gauss's elimination of six equations with their right side.
fn solved(mut matrix: [[f64; 7]; 6]) -> [f64; 6] {
    for pivot in 0..6 {
        let size = |row: &usize| matrix[*row][pivot].abs();
        let best = (pivot..6).max_by(|a, b| size(a).total_cmp(&size(b)));
        matrix.swap(pivot, best.expect("rows are left"));
        let leading = matrix[pivot];
        for (row, matrix) in matrix.iter_mut().enumerate() {
            if row != pivot {
                let factor = matrix[pivot] / leading[pivot];
                matrix
                    .iter_mut()
                    .zip(leading)
                    .for_each(|(a, b)| *a -= factor * b);
            }
        }
    }
    std::array::from_fn(|row| matrix[row][6] / matrix[row][row])
}

/// Two cantilevers under one floor, shaken from two sides, are one of half the mass that steps by the rule of average acceleration.
#[test]
fn a_cantilever_is_what_newtons_method_finds_over_its_fibres() {
    let column_fibres = fibres([16, 12], true);
    let (mass, load, step) = (60e3, 150e3, 1e-3);
    let mut pair = frame([&[0.0, 6.0], &[0.0]], 1, false, &column_fibres);
    pair.floor_load = vec![2.0 * load];
    let motion = motion([0.8, 0.6], 0.0);
    let ran = shaken(building(pair, 1, 2.0 * mass, 0.0), &motion, Solver::Riccati);
    let [crushed, yielded] = reached(&ran);
    assert!(crushed > 20 && yielded > 5, "{crushed} and {yielded}");

    let mut alone = Cantilever::new(&column_fibres);
    let weight = [-mass * STANDARD_GRAVITY - load, 0.0, 0.0];
    alone.solve([0.0; 3], weight);
    alone.accept();
    let (mut rate, alpha) = ([0.0; 3], 0.5);
    let across = motion.bearing.as_ref().expect("two sides").across.as_ref();
    let ground = |t: f64| {
        let across = across.expect("two sides").acceleration(t);
        [0.0, motion.acceleration(t), across]
    };
    let mut acceleration = ground(0.0).map(|ground| -ground);
    let count = (motion.duration / step).round() as usize;
    let now = |cantilever: &Cantilever| -> Vec<f64> {
        let moved = cantilever.moved[3..].iter().copied();
        cantilever.forces.into_iter().chain(moved).collect()
    };
    let mut extremes: Vec<[f64; 2]> = now(&alone).into_iter().map(|value| [value; 2]).collect();
    let mut tops = vec![alone.moved];
    for number in 1..=count {
        let pushed = ground(number as f64 * step);
        let before = alone.moved;
        let inert = mass * (4.0 / step.powi(2) + 2.0 * alpha / step);
        let carried = |k: usize| {
            let moving = 4.0 / step.powi(2) * before[k] + 4.0 / step * rate[k] + acceleration[k];
            mass * (moving + alpha * (2.0 / step * before[k] + rate[k]) - pushed[k]) + weight[k]
        };
        alone.solve([inert; 3], [0, 1, 2].map(carried));
        alone.accept();
        for k in 0..3 {
            let moved = alone.moved[k] - before[k];
            let faster = 4.0 / step.powi(2) * moved - 4.0 / step * rate[k] - acceleration[k];
            rate[k] = 2.0 / step * moved - rate[k];
            acceleration[k] = faster;
        }
        tops.push(alone.moved);
        for (extreme, value) in extremes.iter_mut().zip(now(&alone)) {
            *extreme = [extreme[0].max(value), extreme[1].min(value)];
        }
    }
    let directions = [
        Column::displacement(0, 1),
        Column::displacement(0, 1).across(),
    ];
    for (axis, place) in directions.into_iter().enumerate() {
        let got = column(&ran.1, place);
        let expected: Vec<f64> = tops.iter().map(|top| top[1 + axis]).collect();
        assert_eq!(got.len(), expected.len());
        let apart = difference(&got, &expected);
        assert!(apart < 1e-8, "{apart:e} along {axis}");
    }
    let (forces, moved) = (forces(&ran), moved(&ran));
    let discretization = &ran.0.buildings[0].structure.discretization;
    for (index, section) in discretization.sections.iter().enumerate() {
        for (got, expected) in forces[index].iter().zip(&extremes) {
            agree(got, expected, 1e-8, "forces");
        }
        // Peaks are found between steps as well.
        for (got, expected) in moved[index].iter().zip(&extremes[3..]) {
            agree(got, expected, 1e-3, "peaks of the section");
        }
        let memories = &ran.1.state.springs[discretization.springs_of_section(section)];
        let got: Vec<f64> = memories.iter().map(HysteresisMemory::deformation).collect();
        let fibres = alone.fibres.iter();
        let expected: Vec<f64> = fibres.map(|fibre| alone.stretch(fibre)).collect();
        let apart = difference(&got, &expected);
        assert!(apart < 1e-8, "{apart:e}");
    }
}

/// Shaken along x, a symmetric frame is a plane one whose rows of fibres are as far from the axis: its layers and rows of bars.
#[test]
fn in_one_plane_it_is_a_plane_frame_of_layers() {
    let both_ends = |fibres: ColumnFibres| ColumnFibres {
        at_ends: [true, true],
        ..fibres
    };
    let ends = both_ends(fibres([12, 4], false));
    let motion = fading("along", 9.0, [0.8, 3.0], 150);
    let space = frame([&[0.0, 6.0, 10.5], &[0.0]], 2, true, &ends);
    let column = space.members[0].section;
    let beam = space.members[1].section;
    let of_plane = |section: &SpaceSection| Section {
        flexural_rigidity: section.flexural_rigidity[0],
        axial_rigidity: section.axial_rigidity,
        shear_rigidity: None,
        line_mass: 0.0,
    };
    // One spring for all fibres of a row.
    let mut rows: Vec<Fibre> = Vec::new();
    for fibre in ends.fibres.iter() {
        let curve = fibre
            .spring
            .backbone()
            .side(jostle::hysteresis::Side::Negative);
        let count = ends.fibres.iter().filter(|other| {
            other.at[0] == fibre.at[0] && other.spring.rule() == fibre.spring.rule()
        });
        let count = count.count() as f64;
        let top = curve.yielding;
        let spring = match fibre.spring.rule() {
            HysteresisRule::Concrete(fall) => {
                Hysteresis::concrete(count * top.force, top.deformation, fall)
            }
            rule => {
                let corners = Corners::bilinear(count * top.force, 0.01);
                let initial = count * fibre.spring.backbone().initial();
                let backbone = Backbone::from_forces(initial, corners, corners);
                Hysteresis::new(rule, backbone.expect("sound"))
            }
        };
        let row = Fibre {
            at: [fibre.at[0], 0.0],
            spring: spring.expect("sound"),
            material: fibre.material,
        };
        if rows
            .iter()
            .all(|known| known.at != row.at || known.spring.rule() != row.spring.rule())
        {
            rows.push(row);
        }
    }
    assert_eq!(rows.len(), 12 + 3);
    let layers = both_ends(ColumnFibres {
        fibres: rows.into(),
        ..ends.clone()
    });
    let mass = 90e3;
    let plane = Frame {
        storey_heights: vec![HEIGHT; 2],
        spans: vec![6.0, 4.5],
        columns: vec![of_plane(&column); 2],
        beams: vec![of_plane(&beam); 2],
        beam_mass: vec![0.0; 2],
        floor_mass: vec![mass; 2],
        column_segments: 1,
        beam_segments: vec![1; 2],
        axial: Axial {
            columns_flexible: true,
            beams_flexible: false,
        },
        ..Frame::default()
    };
    let places = plane.all_columns().map(|(place, _)| place);
    let hinges = FrameHinges {
        fibres: places.map(|place| (place, layers.clone())).collect(),
        ..FrameHinges::default()
    };
    let plane = Building {
        structure: Structure::Frame(plane),
        hinges: Some(Hinges::Frame(hinges)),
        ..building(space.clone(), 2, mass, 1e-3)
    };
    let space = shaken(building(space, 2, mass, 1e-3), &motion, Solver::Riccati);
    let plane = shaken(plane, &motion, Solver::Riccati);
    let [crushed, yielded] = reached(&plane);
    assert!(crushed > 5 && yielded > 5, "{crushed} and {yielded}");
    for (floor, other) in space.1.peaks.floors(0).iter().zip(plane.1.peaks.floors(0)) {
        agree(&extremes(floor), &extremes(&other), 1e-9, "floors");
        for still in [floor.across(), floor.turning()] {
            assert!(largest(&extremes(&still)) < 1e-11);
        }
    }
    let [a, b] = [&space, &plane].map(|ran| (forces(ran), moved(ran)));
    assert_eq!(a.0.len(), b.0.len());
    for section in 0..a.0.len() {
        for (one, other) in [(&a.0, &b.0), (&a.1, &b.1)] {
            for (got, expected) in one[section].iter().zip(&other[section]) {
                agree(got, expected, 1e-9, "section");
            }
        }
        assert!(largest(&a.0[section][2]) < 1e-3 && largest(&a.1[section][2]) < 1e-11);
    }
}

/// Two storeys with beams, of columns that lean.
fn two_storeys(fibres: &ColumnFibres) -> SpaceFrame {
    let fibres = ColumnFibres {
        at_ends: [true, true],
        ..fibres.clone()
    };
    frame([&[0.0, 5.0], &[0.0, 4.0]], 2, true, &fibres)
}

/// Riccati's recursion and the stiffness matrix share nothing but the elements.
#[test]
fn both_solvers_agree_while_bars_yield_and_concrete_crushes() {
    let two_storeys = two_storeys(&fibres([6, 5], true));
    let motion = motion([0.9, 0.7], 0.4);
    let [a, b] = [Solver::Riccati, Solver::Stiffness].map(|solver| {
        shaken(
            building(two_storeys.clone(), 2, 160e3, 1e-3),
            &motion,
            solver,
        )
    });
    let [crushed, yielded] = reached(&a);
    assert!(crushed > 20 && yielded > 20, "{crushed} and {yielded}");
    for (floor, other) in a.1.peaks.floors(0).iter().zip(b.1.peaks.floors(0)) {
        agree(&extremes(floor), &extremes(&other), 1e-6, "floors");
        agree(
            &extremes(&floor.across()),
            &extremes(&other.across()),
            1e-6,
            "across",
        );
    }
    for (concat, other) in forces(&a).concat().iter().zip(forces(&b).concat()) {
        close(concat[0], other[0], largest(&other), 1e-6, "forces");
        close(concat[1], other[1], largest(&other), 1e-6, "forces");
    }
}

/// A site that is turned about a vertical axis with all that stands on it, and with the motion, changes nothing.
#[test]
fn a_turned_site_gives_equal_numbers() {
    let two_storeys = two_storeys(&fibres([6, 5], true));
    let straight = shaken(
        building(two_storeys.clone(), 2, 160e3, 1e-3),
        &motion([0.9, 0.7], 0.0),
        Solver::Riccati,
    );
    for angle in [PI / 6.0, FRAC_PI_2] {
        let turned = SpaceFrame {
            direction: [angle.cos(), angle.sin()],
            ..two_storeys.clone()
        };
        let turned = shaken(
            building(turned, 2, 160e3, 1e-3),
            &motion([0.9, 0.7], angle),
            Solver::Riccati,
        );
        for (a, b) in [
            (forces(&turned), forces(&straight)),
            (moved(&turned), moved(&straight)),
        ] {
            for (got, expected) in a.concat().iter().zip(b.concat()) {
                agree(got, &expected, 1e-7, "section");
            }
        }
    }
}

/// Exchanging x and y of lines, sections, fibres and motion by a quarter turn counter-clockwise gives the same numbers in the other plane.
#[test]
fn a_quarter_turn_exchanges_both_planes() {
    let upright = fibres([6, 5], true);
    let two_storeys = two_storeys(&upright);
    // (x, y) becomes (−y, x); a line at y stands at 4 − y so that lines rise.
    let lying = ColumnFibres {
        fibres: upright
            .fibres
            .iter()
            .map(|fibre| Fibre {
                at: [-fibre.at[1], fibre.at[0]],
                ..*fibre
            })
            .collect(),
        at_ends: [true, true],
        ..upright
    };
    let mut turned = frame([&[0.0, 4.0], &[0.0, 5.0]], 2, true, &lying);
    for member in &mut turned.members {
        if let SpacePlace::Column { .. } = member.place {
            member.section =
                SpaceSection::rectangle([SIZE[1], SIZE[0]], 30e9, 0.2, false).expect("a section");
        }
    }
    let straight = shaken(
        building(two_storeys, 2, 160e3, 1e-3),
        &motion([0.9, 0.7], 0.0),
        Solver::Riccati,
    );
    let mut of_turned = building(turned, 2, 160e3, 1e-3);
    let Structure::Tiers(tiers) = &mut of_turned.structure else {
        unreachable!("a building in plan");
    };
    for tier in &mut tiers.floors {
        *tier = Tier::uniform(
            160e3,
            vec![[-2.0, -1.0], [6.0, -1.0], [6.0, 6.0], [-2.0, 6.0]],
        )
        .expect("an area");
    }
    let turned = shaken(of_turned, &motion([0.9, 0.7], FRAC_PI_2), Solver::Riccati);
    let names = |ran: &(System, Outcome)| -> Vec<String> {
        let sections = &ran.0.buildings[0].structure.discretization.sections;
        sections.iter().map(ToString::to_string).collect()
    };
    let (before, after) = (names(&straight), names(&turned));
    let [a, b] = [&straight, &turned].map(|ran| (forces(ran), moved(ran)));
    for (index, name) in before.iter().enumerate() {
        // column.X.Y.STOREY becomes column.(3 − Y).X.STOREY.
        let parts: Vec<&str> = name.split('.').collect();
        let line = if parts[2] == "1" { "2" } else { "1" };
        let other = format!("column.{line}.{}.{}.{}", parts[1], parts[3], parts[4]);
        let place = after
            .iter()
            .position(|candidate| *candidate == other)
            .expect("it stands there");
        for (original, image) in [(&a.0[index], &b.0[place]), (&a.1[index], &b.1[place])] {
            agree(&image[0], &original[0], 1e-7, "axial");
            // Along x before is along y now; along y before is against x now.
            agree(&image[2], &original[1], 1e-7, "across");
            agree(&[-image[1][1], -image[1][0]], &original[2], 1e-7, "along");
        }
    }
}

/// Fibres where they cannot be are refused.
#[test]
fn fibres_that_cannot_be_say_why() {
    let says = |change: &dyn Fn(&mut SpaceFrame), gravity: bool, words: &str| {
        let mut two_storeys = two_storeys(&fibres([4, 4], false));
        change(&mut two_storeys);
        let mut building = building(two_storeys, 2, 160e3, 0.0);
        building.gravity.preload = gravity;
        let model = Model {
            buildings: vec![building],
            ..Model::default()
        };
        let faults = model.check().expect_err("it cannot be");
        let found = faults.iter().any(|fault| fault.problem.contains(words));
        assert!(found && faults.len() == 1, "{words}: {faults:?}");
    };
    says(&|_| {}, false, "add gravity = true");
    let rigid = |frame: &mut SpaceFrame| {
        frame.members[0].section.axial_rigidity = None;
    };
    says(&rigid, true, "take axial = \"flexible\"");
    let place = SpacePlace::Column {
        line: [0, 0],
        storey: 0,
    };
    let on_a_line = |frame: &mut SpaceFrame| {
        let column = frame.fibres.get_mut(&place).expect("it has fibres");
        column.fibres = column
            .fibres
            .iter()
            .map(|fibre| Fibre {
                at: [fibre.at[0], 0.1],
                ..*fibre
            })
            .collect();
    };
    says(&on_a_line, true, "stand on one line");
    let nowhere = |frame: &mut SpaceFrame| {
        let column = frame.fibres[&place].clone();
        frame.fibres.insert(
            SpacePlace::BeamX {
                span: 0,
                line: 0,
                floor: 0,
            },
            column,
        );
    };
    says(&nowhere, true, "no column");
    let hinged = |frame: &mut SpaceFrame| {
        frame.members[0].hinges[0] = Some(Hysteresis::elastic(1e8).expect("sound"));
    };
    says(&hinged, true, "both hinges and fibres");
    let loaded = |frame: &mut SpaceFrame| frame.floor_load = vec![0.0];
    says(&loaded, true, "1 entries for 2 storeys");
}
