//! Scripts of buildings on soil, read back as tables. That OpenSees gives the same answers is shown in docs/validation.md.

use std::collections::BTreeMap;

use crate::script::{export, model, number, quadratic, table};
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::system::BuildingSystem;
use jostle::{Hinges, System};

/// Two shear buildings with P-Delta on matrices of the soil with every entry, and a damper.
const GIVEN: &str = r#"
title = "two on soil"
motion = { kind = "sine", amplitude = 1.0, period = 0.5, duration = 2.0 }

[soil.coupling]
stiffness = [[1.2e9, -8e8, -3e8, 4e8], [-8e8, 5e10, -2e8, -6e9], [-3e8, -2e8, 1.0e9, 7e8], [4e8, -6e9, 7e8, 4e10]]
damping = [[5e7, -2e7, -1e7, 1e7], [-2e7, 6e8, 0.0, -5e7], [-1e7, 0.0, 4e7, 2e7], [1e7, -5e7, 2e7, 4e8]]

[[building]]
name = "A"
kind = "shear"
mass = ["80 t", "70 t", "60 t"]
stiffness = ["90 MN/m", "80 MN/m", "70 MN/m"]
storey_height = ["3.3 m", "3.2 m", "3.1 m"]
damping = { ratio = 0.05, modes = [1, 2] }
p_delta = true
foundation = { length = "9 m", width = "12 m", mass = "90 t" }

[[building]]
name = "B"
kind = "shear"
mass = "50 t"
stiffness = ["60 MN/m", "40 MN/m"]
storey_height = "3.3 m"
damping = { ratio = 0.03, modes = [1, 2] }
foundation = { length = "9 m", width = "12 m", mass = "70 t" }

[[gap]]
between = ["A", "B"]
width = "3 m"
law = "linear"
stiffness = "200 MN/m"
"#;

/// Ground under a foundation that lifts off, and under feet: it presses upwards only, and its sums are those of the model.
#[test]
fn contact_springs_press_upwards_alone() {
    const MODEL: &str = include_str!("../../../jostle-validation/data/opensees/uplift.toml");
    let text = export(&model(MODEL)).expect("it can be exported").text;
    let materials = table(&text, "MATERIALS");
    let ground = |tag: &str| {
        let material = materials
            .iter()
            .find(|row| row[1] == tag)
            .expect("a material");
        (material[0] == "\"ElasticPPGap\"").then(|| [2, 3].map(|at| number(&material[at])))
    };
    let nodes = table(&text, "NODES");
    let x = |tag: &str| {
        let node = nodes.iter().find(|row| row[0] == tag).expect("a node");
        number(&node[1])
    };
    let mut sums = [0.0; 2];
    for row in table(&text, "LEVERED") {
        let Some([stiffness, strength]) = ground(&row[3]) else {
            continue;
        };
        // A lever deforms by the rise of its first end to the left, and by the opposite to the right.
        let arm = x(&row[2]) - x(&row[1]);
        assert_eq!(strength > 0.0, arm > 0.0);
        sums[usize::from(row[1].starts_with('2'))] += stiffness;
    }
    for row in table(&text, "SPRINGS") {
        // Contact springs alone resist rocking.
        if row[3] == "6" {
            let material = materials.iter().find(|other| other[1] == row[4]);
            assert_eq!(material.expect("a material")[2], "0.0");
        }
        if let Some([stiffness, strength]) = ground(&row[4]) {
            assert_eq!((&row[3][..], strength < 0.0), ("2", true));
            sums[usize::from(row[2].starts_with('2'))] += stiffness;
        }
    }
    assert!((sums[0] / 900e6 - 1.0).abs() < 1e-12 && (sums[1] / 400e6 - 1.0).abs() < 1e-12);
    let feet = include_str!("../../../jostle-validation/data/opensees/uplift_feet.toml");
    let text = export(&model(feet)).expect("it can be exported").text;
    assert!(
        text.contains("\"footings\": [(1002, 0.0, 0.0), (1004, 0.0, 0.0)]"),
        "{text}"
    );
}

/// Damping relative to the ground stays that of the masses.
#[test]
fn masses_on_a_foundation_may_be_damped_relative_to_the_ground() {
    let text = GIVEN.replacen(
        "damping = { ratio = 0.05, modes = [1, 2] }",
        "damping = { alpha = 0.4, beta = 0.002, relative_to = \"ground\" }",
        1,
    );
    let text = export(&model(&text)).expect("it can be exported").text;
    let alphas: Vec<&str> = text
        .lines()
        .filter(|line| line.contains("\"alpha\":"))
        .collect();
    assert!(
        alphas[0].contains("\"alpha\": 0.4,") && alphas[1].contains("\"alpha\": 0.0,"),
        "{alphas:?}"
    );
}

/// Displacements of nodes, by tag and direction, through ties and supports.
struct Moved {
    own: BTreeMap<(String, usize), f64>,
    ties: Vec<Vec<String>>,
    supports: Vec<Vec<String>>,
}

fn some_motion(system: &System, seed: u32) -> Vec<f64> {
    (0..system.len())
        .map(|dof| (1.7 * f64::from(seed) + 2.3 * dof as f64).sin())
        .collect()
}

/// Twice the rate at which dashpots and damping of masses take energy.
fn power(building: &BuildingSystem, x: &[f64]) -> f64 {
    let equations = &building.equations;
    let values = &x[building.offset..building.offset + equations.len()];
    let masses = equations.mass.iter().zip(values);
    let of_masses: f64 = masses.map(|(mass, value)| mass * value * value).sum();
    equations.alpha * of_masses + quadratic(&equations.dashpots, values)
}

impl Moved {
    fn new(text: &str, system: &System, x: &[f64]) -> Self {
        let mut displacements = BTreeMap::new();
        for (index, building) in system.buildings.iter().enumerate() {
            let sticks = &building.discretization.stick_model;
            let base = sticks.foundation.as_ref().expect("on soil");
            let equations = &building.equations;
            let value = |dof: usize| x[building.offset + dof];
            let turned = equations.rotation(base.node).map_or(0.0, value);
            for node in 0..sticks.nodes.len() {
                let tag = ((index + 1) * 1000 + node + 1).to_string();
                let lever = sticks.lever(node);
                let rise = equations.vertical(node).map(value);
                for (direction, moved) in [
                    (1, equations.horizontal(node).map(value)),
                    (2, rise.or(lever.map(|lever| lever * turned))),
                    (3, equations.rotation(node).map(value)),
                ] {
                    if let Some(moved) = moved {
                        displacements.insert((tag.clone(), direction), moved);
                    }
                }
            }
        }
        Self {
            own: displacements,
            ties: table(text, "TIES"),
            supports: table(text, "SUPPORTS"),
        }
    }

    fn at(&self, tag: &str, direction: usize) -> f64 {
        let mut supports = self.supports.iter();
        if supports.any(|row| row[0] == tag && row[direction] == "1") {
            return 0.0;
        }
        let name = direction.to_string();
        let mut ties = self.ties.iter();
        if let Some(row) = ties.find(|row| row[1] == tag && row[2..].contains(&name)) {
            return self.at(&row[0], direction);
        }
        self.own[&(tag.to_owned(), direction)]
    }
}

/// Stiffness and dashpot of a material.
fn material(text: &str, tag: &str) -> [f64; 2] {
    let materials = table(text, "MATERIALS");
    let row = materials
        .iter()
        .find(|row| row[1] == tag)
        .expect("a material");
    assert_eq!(row[0], "\"Elastic\"");
    [
        number(&row[2]),
        row.get(3).map_or(0.0, |value| number(value)),
    ]
}

/// Twice the energy of all springs, the part of those with Rayleigh damping, and the power of all dashpots.
fn energies(text: &str, moved: &Moved) -> [f64; 3] {
    let mut sums = [0.0; 3];
    let mut add = |tag: &str, strain: f64, damped: &str| {
        let [stiffness, dashpot] = material(text, tag);
        sums[0] += stiffness * strain * strain;
        sums[1] += if damped == "\"initial\"" {
            stiffness * strain * strain
        } else {
            0.0
        };
        sums[2] += dashpot * strain * strain;
    };
    for row in table(text, "SPRINGS") {
        let pairs: Vec<&String> = row[3..row.len() - 1]
            .iter()
            .filter(|w| !w.is_empty())
            .collect();
        for pair in pairs.chunks(2) {
            let direction = if pair[0] == "6" {
                3
            } else {
                number(pair[0]) as usize
            };
            let strain = moved.at(&row[2], direction) - moved.at(&row[1], direction);
            add(pair[1], strain, &row[row.len() - 1]);
        }
    }
    for row in table(text, "LEANING") {
        add(&row[3], moved.at(&row[2], 1) - moved.at(&row[1], 1), "None");
    }
    let nodes = table(text, "NODES");
    let place = |tag: &str| {
        let row = nodes.iter().find(|row| row[0] == tag).expect("a node");
        [number(&row[1]), number(&row[2])]
    };
    for row in table(text, "LEVERED") {
        // As twoNodeLink has it: y is a quarter turn from the line of the nodes, counter-clockwise.
        let ([x, y], [to_x, to_y]) = (place(&row[1]), place(&row[2]));
        let (length, upright) = ((to_x - x).hypot(to_y - y), to_y > y);
        let across = |tag: &String| match upright {
            true => -moved.at(tag, 1),
            false => (to_x - x).signum() * moved.at(tag, 2),
        };
        assert!(upright && (to_x - x).abs() < 1e-9 || to_y == y, "{row:?}");
        let share = number(&row[4]);
        let mut turned = share * moved.at(&row[1], 3);
        if share < 1.0 {
            turned += (1.0 - share) * moved.at(&row[2], 3);
        }
        let strain = across(&row[2]) - across(&row[1]) - length * turned;
        add(&row[3], strain, &row[5]);
    }
    sums
}

/// Springs, levers and dashpots of a script have the energy and the power of the core's matrices, those between foundations included.
#[test]
fn springs_and_levers_have_the_energy_of_the_matrices() {
    let input = model(GIVEN);
    let text = export(&input).expect("it can be exported").text;
    let system = System::assemble(&input.model).expect("sound");
    // Damping of masses is that of dashpots.
    assert_eq!(text.matches("\"alpha\": 0.0, ").count(), 2);
    for seed in 0..4 {
        let x = some_motion(&system, seed);
        let moved = Moved::new(&text, &system, &x);
        let mut expected = [0.0; 3];
        for building in &system.buildings {
            let equations = &building.equations;
            let values = &x[building.offset..building.offset + equations.len()];
            let elastic = quadratic(&equations.stiffness, values);
            expected[0] += elastic + quadratic(&equations.undamped, values);
            expected[1] += elastic;
            expected[2] += power(building, &x);
        }
        for link in &system.links[system.model_links().len()..] {
            let closing = link.ports.closing(&x);
            expected[0] += link.stiffness * closing * closing;
            expected[2] += link.damping * closing * closing;
        }
        let got = energies(&text, &moved);
        for (got, expected) in got.into_iter().zip(expected) {
            assert!(
                (got / expected - 1.0).abs() < 1e-9,
                "{got} against {expected}"
            );
        }
    }
}

/// Dashpots of a frame damp its motion relative to the foundation, in both directions, and the soil that of the foundation.
#[test]
fn dashpots_of_a_frame_have_the_power_of_the_matrix() {
    let elastic = FRAME.lines().filter(|line| !line.starts_with("hinges"));
    let input = model(&elastic.collect::<Vec<_>>().join("\n"));
    let text = export(&input).expect("it can be exported").text;
    let system = System::assemble(&input.model).expect("sound");
    for seed in 0..4 {
        let x = some_motion(&system, seed);
        let buildings = system.buildings.iter();
        let expected: f64 = buildings.map(|building| power(building, &x)).sum();
        let [.., got] = energies(&text, &Moved::new(&text, &system, &x));
        assert!(
            (got / expected - 1.0).abs() < 1e-9,
            "{got} against {expected}"
        );
    }
}

const LINKS: &str = include_str!("../../../jostle-validation/data/opensees/soil_links.toml");

/// Links inside a building join points at the heights of their floors, which turn with the foundation; a cable acts where the distance
/// grows, whichever floor comes first.
#[test]
fn links_inside_turn_with_the_foundation() {
    let input = model(LINKS);
    let text = export(&input).expect("it can be exported").text;
    let system = System::assemble(&input.model).expect("sound");
    let x = some_motion(&system, 1);
    let moved = Moved::new(&text, &system, &x);
    let (links, nodes) = (table(&text, "LINKS"), table(&text, "NODES"));
    let materials = table(&text, "MATERIALS");
    let height = |tag: &String| {
        let mut rows = nodes.iter();
        number(&rows.find(|row| row[0] == *tag).expect("a node")[2])
    };
    assert_eq!(links.len(), system.model_links().len());
    let mut cables = Vec::new();
    for (row, link) in links.iter().zip(system.model_links()) {
        assert_eq!(row[row.len() - 1], "True");
        let mut ends = [&row[1], &row[2]];
        ends.sort_by(|a, b| height(a).total_cmp(&height(b)));
        let [lower, upper] = ends;
        // As twoNodeLink has it, half of its length turned by either end.
        let turned = 0.5 * (moved.at(lower, 3) + moved.at(upper, 3));
        let strain =
            moved.at(lower, 1) - moved.at(upper, 1) - (height(upper) - height(lower)) * turned;
        let shortening = link.ports.closing(&x);
        let sign = if lower == &row[1] { 1.0 } else { -1.0 };
        assert!((strain - sign * shortening).abs() < 1e-12, "{row:?}");
        let mut all = materials.iter();
        let material = all
            .find(|material| material[1] == row[3])
            .expect("a material");
        if material[0] == "\"ElasticPPGap\"" {
            cables.push((sign, number(&material[4])));
        }
    }
    // Shortening is negative where a cable pulls.
    assert_eq!(cables, [(-1.0, 3e-3), (1.0, -4e-3)]);
}

const FRAME: &str = include_str!("../../../jostle-validation/data/opensees/soil.toml");

/// Feet follow the sway and the rotation of the foundation, and stand on springs at their distance from its middle; columns rise with
/// their feet.
#[test]
fn feet_of_columns_stand_on_the_foundation() {
    let input = model(FRAME);
    let text = export(&input).expect("it can be exported").text;
    let system = System::assemble(&input.model).expect("sound");
    let sticks = &system.buildings[1].discretization.stick_model;
    let base = sticks.foundation.as_ref().expect("on soil");
    let (nodes, levered) = (table(&text, "NODES"), table(&text, "LEVERED"));
    let (ties, supports) = (table(&text, "TIES"), table(&text, "SUPPORTS"));
    let tag = |node: usize| (2000 + node + 1).to_string();
    let node = |tag: &str| nodes.iter().find(|row| row[0] == tag).expect("a node");
    let own_base = node(&tag(base.node));
    assert_eq!(
        [number(&own_base[3]), number(&own_base[4])],
        [90e3, 90e3 * 81.0 / 12.0]
    );
    assert!(
        supports
            .iter()
            .any(|row| row[..] == [tag(base.node), "0".into(), "1".into(), "0".into()])
    );
    assert_eq!(base.feet.len(), 3);
    for &foot in &base.feet {
        let lever = sticks.nodes[foot].x - sticks.nodes[base.node].x;
        let row = levered
            .iter()
            .find(|row| row[1] == tag(base.node) && row[2] == tag(foot))
            .expect("held");
        let [stiffness, _] = material(&text, &row[3]);
        assert!((stiffness * lever * lever / (1e7 * base.stiffness[2]) - 1.0).abs() < 1e-12);
    }
    // Every displacement of jostle, and one for the rise of every foot.
    let fixed: usize = supports
        .iter()
        .map(|row| row[1..].iter().filter(|held| **held == "1").count())
        .sum();
    let tied: usize = ties.iter().map(|row| row.len() - 2).sum();
    let equations = 3 * nodes.len() - fixed - table(&text, "HELD").len() - tied;
    assert_eq!(equations, system.len() + base.feet.len());
    // Constraints hold every displacement once, and none that another one follows.
    let mut following = Vec::new();
    for row in &ties {
        following.extend(
            row[2..]
                .iter()
                .map(|component| (row[1].clone(), component.clone())),
        );
    }
    let count = following.len();
    for row in &ties {
        for component in &row[2..] {
            assert!(
                !following.contains(&(row[0].clone(), component.clone())),
                "{row:?}"
            );
        }
    }
    following.sort();
    following.dedup();
    assert_eq!(following.len(), count);
}

/// Deformation of a lever counts from right to left: springs that are weaker on one side are turned round.
#[test]
fn storeys_that_differ_by_side_are_mirrored() {
    let corners = |yielding: f64| Corners {
        cracking: 3e-3,
        yielding,
        post_cracking: 0.5,
        post_yield: 0.05,
    };
    let springs = [90e6, 80e6, 70e6, 60e6].map(|stiffness| {
        let backbone = Backbone::from_deformations(stiffness, corners(9e-3), corners(6e-3));
        let hinge = Hysteresis::new(HysteresisRule::Normal, backbone.expect("a backbone"));
        hinge.expect("a spring")
    });
    let mut input = model(FRAME);
    input.model.buildings[0].hinges = Some(Hinges::Storeys(springs.to_vec()));
    let text = export(&input).expect("it can be exported").text;
    let levered = table(&text, "LEVERED");
    let materials = table(&text, "MATERIALS");
    let row = |tag: &String| {
        let mut rows = materials.iter();
        rows.find(|row| row[1] == *tag).expect("a material")
    };
    let parallel = row(&levered[0][3]);
    assert_eq!(parallel[0], "\"Parallel\"");
    let second = row(&parallel[3]);
    let strains = [&second[3], &second[4]].map(|strain| number(strain));
    assert!((strains[0] - 6e-3).abs() < 1e-12, "{strains:?}");
    assert!((strains[1] + 9e-3).abs() < 1e-12, "{strains:?}");
}
