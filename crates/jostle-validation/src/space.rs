//! Buildings that turn and are shaken from two sides: independent integrations in high accuracy.

use std::ops::ControlFlow;

use jostle::contact::ForceLaw;
use jostle::{
    Analysis, Bearing, Building, ContactLaw, Damping, Gap, GroundMotion, LawKind, Model, Outcome,
    Plan, PlanArea, PlanContact, PlanPoint, RestitutionIs, Settings, Solver, Structure, System,
    Tier, TierStorey, Tiers, Wave, simulate,
};
use jostle_io::builtin_record;
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::row::Row;

/// Cases with contacts, and the tolerance of the program with that of the comparison: the reference is good to 1e-6.
const RUNS: [(f64, f64); 2] = [(1e-3, 1e-3), (1e-6, 2e-6)];
/// The same for direct steps.
const DIRECT_RUNS: [(f64, f64); 2] = [(1e-3, 1e-3), (1e-5, 1e-5)];
/// What the tolerance of direct steps does not hold for, as the notes of a run say: a gentle impact begins later by the error of the
/// closing over its speed, and meanwhile the slip has changed its speed.
const SLIP_SPEED: &str = "slip speed of impacts [m/s]";
/// The reference reads sums of forces at the ends of its own steps, which miss the top by up to 9e-6; forces of points,
/// whose tops it locates, agree to 1e-8.
const SUMS: f64 = 1e-5;
/// Numbers below this are rounding: in the plane limit nothing turns and nothing moves across.
const NOTHING: f64 = 1e-6;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = polygons();
    for (name, text) in [
        (
            "space/S0_plane_limit",
            include_str!("../data/space/S0_plane_limit.json"),
        ),
        (
            "space/S1a_one_storey_asymmetric_two_sines",
            include_str!("../data/space/S1a_one_storey_asymmetric_two_sines.json"),
        ),
        (
            "space/S4a_two_asymmetric_el_centro_no_friction",
            include_str!("../data/space/S4a_two_asymmetric_el_centro_no_friction.json"),
        ),
        (
            "space/S4b_two_asymmetric_el_centro_friction",
            include_str!("../data/space/S4b_two_asymmetric_el_centro_friction.json"),
        ),
        (
            "space/S5a_five_beside_three_storeys_30deg",
            include_str!("../data/space/S5a_five_beside_three_storeys_30deg.json"),
        ),
        (
            "space/S6a_three_around_a_corner",
            include_str!("../data/space/S6a_three_around_a_corner.json"),
        ),
        (
            "space/S7a_corners_miss",
            include_str!("../data/space/S7a_corners_miss.json"),
        ),
        (
            "space/S7b_corner_hits_in_x",
            include_str!("../data/space/S7b_corner_hits_in_x.json"),
        ),
        (
            "space/S7c_corner_slides_off",
            include_str!("../data/space/S7c_corner_slides_off.json"),
        ),
    ] {
        let case = document(text);
        for (tolerance, limit) in RUNS {
            rows.extend(compare(name, &case, tolerance, limit, None));
        }
        for (tolerance, limit) in DIRECT_RUNS {
            let solver = Some(Solver::Riccati);
            rows.extend(compare(name, &case, tolerance, limit, solver));
        }
    }
    rows
}

pub(crate) fn point(value: &Value) -> PlanPoint {
    let values = numbers(value, "");
    [values[0], values[1]]
}

pub(crate) fn points(value: &Value) -> Vec<PlanPoint> {
    value
        .as_array()
        .expect("a list")
        .iter()
        .map(point)
        .collect()
}

fn building(stored: &Value) -> Building {
    let floors = list(stored, "/floors").iter().map(|floor| Tier {
        mass: number(floor, "/mass_kg"),
        polar_mass: number(floor, "/polar_mass_kg_m2"),
        centre: point(at(floor, "/centre_of_mass_m")),
        plan: points(at(floor, "/corners_m")),
    });
    let storeys = list(stored, "/storeys").iter().map(|storey| TierStorey {
        stiffness: ["x_n_m", "y_n_m", "torsion_n_m_rad"]
            .map(|key| number(storey, &format!("/stiffness_{key}"))),
        centre: point(at(storey, "/centre_of_stiffness_m")),
    });
    let mut below = 0.0;
    let heights = list(stored, "/floors").iter().map(|floor| {
        let height = number(floor, "/height_m");
        height - std::mem::replace(&mut below, height)
    });
    Building {
        name: at(stored, "/name").as_str().expect("a name").to_owned(),
        structure: Structure::Tiers(Tiers {
            floors: floors.collect(),
            storeys: storeys.collect(),
            storey_heights: heights.collect(),
            ..Tiers::default()
        }),
        damping: Damping::Rayleigh {
            alpha: number(stored, "/alpha_1_s"),
            beta: number(stored, "/beta_s"),
        },
        ..Building::default()
    }
}

/// Gaps between buildings that touch, each as wide as its narrowest point.
fn model(inputs: &Value, tolerance: f64) -> Model {
    let buildings: Vec<Building> = list(inputs, "/buildings").iter().map(building).collect();
    let index = |name: &Value| {
        let found = buildings
            .iter()
            .position(|building| Some(&building.name[..]) == name.as_str());
        found.expect("a building of that name")
    };
    let mut gaps: Vec<Gap> = Vec::new();
    let contacts = list(inputs, "/contacts");
    for contact in contacts {
        let between = list(contact, "/between");
        let between = [Some(index(&between[0])), Some(index(&between[1]))];
        if gaps.iter().any(|gap| gap.between == between) {
            continue;
        }
        let same_pair = |other: &&Value| at(other, "/between") == at(contact, "/between");
        let of_pair = || contacts.iter().filter(same_pair);
        let same_floors = of_pair().filter(|other| {
            at(other, "/floors") == at(contact, "/floors")
                && at(other, "/normal") == at(contact, "/normal")
        });
        let law = ContactLaw {
            kind: match at(contact, "/law").as_str() {
                Some("linear") => LawKind::Linear,
                _ => LawKind::HertzDamp,
            },
            stiffness: number(contact, "/stiffness") / number(contact, "/share"),
            restitution: 0.65,
            restitution_is: RestitutionIs::Input,
        };
        let width = of_pair().map(|other| number(other, "/gap_m"));
        let mut gap = Gap::between(between, width.fold(f64::INFINITY, f64::min), law);
        gap.in_plan = PlanContact {
            // A corner has one point, whatever is asked of faces.
            points: same_floors.count().max(2),
            friction: contact["friction"].as_f64().unwrap_or(0.0),
            tangential_stiffness: contact["tangential_stiffness_n_m"]
                .as_f64()
                .map(|stiffness| stiffness / number(contact, "/share")),
            ..PlanContact::default()
        };
        gaps.push(gap);
    }
    Model {
        title: "space".to_owned(),
        buildings,
        gaps,
        analysis: Analysis {
            tolerance,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

/// The motions of a case as one with a bearing.
fn motion(inputs: &Value) -> GroundMotion {
    let duration = number(inputs, "/duration_s");
    let one = |stored: &Value| {
        let kind = at(stored, "/kind").as_str().expect("a kind");
        if kind == "record" {
            let mut record = builtin_record("el-centro-1940-ns").expect("it is built in");
            record.duration = duration;
            record
        } else {
            GroundMotion {
                name: kind.to_owned(),
                scale: 1.0,
                duration,
                wave: Wave::Sine {
                    amplitude: number(stored, "/amplitude_m_s2"),
                    period: number(stored, "/period_s"),
                },
                bearing: None,
                grounds: None,
            }
        }
    };
    let motions = list(inputs, "/motion");
    let factors = |stored: &Value| [number(stored, "/factor_x"), number(stored, "/factor_y")];
    let mut first = one(&motions[0]);
    let [x, y] = factors(&motions[0]);
    if x != 0.0 && y != 0.0 && motions.len() > 1 {
        let across = sum_across(
            &motions
                .iter()
                .map(|motion| (one(motion), factors(motion)[1]))
                .collect::<Vec<_>>(),
        );
        first.scale *= x;
        first.bearing = Some(Box::new(Bearing {
            angle: 0.0,
            across: Some(across),
        }));
        return first;
    }
    first.scale *= x.hypot(y);
    let across = motions.get(1).map(|stored| {
        let [x, y] = factors(stored);
        assert_eq!(x, 0.0, "the second motion is across");
        let mut second = one(stored);
        second.scale *= y;
        second
    });
    first.bearing = Some(Box::new(Bearing {
        angle: y.atan2(x),
        across,
    }));
    first
}

/// Motions with factors as one, straight between points close enough that a sine misses 2e-7 of its amplitude.
fn sum_across(motions: &[(GroundMotion, f64)]) -> GroundMotion {
    const STEP: f64 = 1e-4;
    let duration = motions[0].0.duration;
    let value = |i: usize| {
        let all = motions.iter();
        all.map(|(motion, factor)| factor * motion.acceleration(STEP * i as f64))
            .sum()
    };
    GroundMotion {
        name: "across".to_owned(),
        scale: 1.0,
        duration,
        wave: Wave::Sampled {
            step: STEP,
            acceleration: (0..=(duration / STEP).round() as usize)
                .map(value)
                .collect(),
        },
        bearing: None,
        grounds: None,
    }
}

fn run(system: &System, model: &Model, motion: &GroundMotion) -> Outcome {
    let plan = Plan::choose(system, motion, &model.analysis).expect("modal stepping");
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    simulate(system, motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    })
}

/// Everything stored of a case; peaks relative to the greatest of their kind.
fn compare(
    source: &str,
    case: &Value,
    tolerance: f64,
    limit: f64,
    solver: Option<Solver>,
) -> Vec<Row> {
    let (inputs, expected) = (at(case, "/inputs"), at(case, "/expected"));
    let mut model = model(inputs, tolerance);
    model.analysis.solver = solver;
    let steps = if solver.is_some() {
        "direct steps, "
    } else {
        ""
    };
    let system = System::assemble(&model).expect("a sound model");
    let motion = motion(inputs);
    let outcome = run(&system, &model, &motion);
    let mut rows = Vec::new();
    let mut kind = |what: &str, pairs: Vec<(f64, f64)>| {
        let greatest = pairs
            .iter()
            .fold(0.0, |most: f64, pair| most.max(pair.0.abs()));
        if greatest < NOTHING * if what.contains("[N") { 1.0 } else { 1e-6 } {
            return;
        }
        let apart = |pair: &(f64, f64)| (pair.1 - pair.0).abs() / greatest;
        let worst = pairs.iter().max_by(|a, b| apart(a).total_cmp(&apart(b)));
        let worst = worst.copied().unwrap_or_default();
        rows.push(Row::relative(
            source,
            format!(
                "{steps}tolerance {tolerance:.0e}, {what}, worst of {}",
                pairs.len()
            ),
            greatest,
            greatest + (worst.1 - worst.0),
            if what.contains("of faces") {
                limit.max(SUMS)
            } else if solver.is_some() && what == SLIP_SPEED {
                2.0 * limit
            } else {
                limit
            },
        ));
    };
    let index = |name: &Value| {
        let found = system
            .buildings
            .iter()
            .position(|building| Some(&building.name[..]) == name.as_str());
        found.expect("a building of that name")
    };
    let floors = list(expected, "/floors");
    let of_floors = |key: &str, got: &dyn Fn(usize, usize) -> f64| -> Vec<(f64, f64)> {
        let one = |floor: &Value| {
            let place = (
                index(at(floor, "/building")),
                number(floor, "/floor") as usize - 1,
            );
            (number(floor, &format!("/{key}")), got(place.0, place.1))
        };
        floors.iter().map(one).collect()
    };
    let along = |b: usize, f: usize| outcome.peaks.floor(b, f + 1);
    let mut displacements = of_floors("displacement_x_max_m", &|b, f| {
        along(b, f).displacement_max().value
    });
    displacements.extend(of_floors("displacement_x_min_m", &|b, f| {
        along(b, f).displacement_min().value
    }));
    kind("displacements along x [m]", displacements);
    let mut across = of_floors("displacement_y_max_m", &|b, f| {
        along(b, f).across().displacement_max().value
    });
    across.extend(of_floors("displacement_y_min_m", &|b, f| {
        along(b, f).across().displacement_min().value
    }));
    kind("displacements across [m]", across);
    let mut turns = of_floors("rotation_max_rad", &|b, f| {
        along(b, f).turning().displacement_max().value
    });
    turns.extend(of_floors("rotation_min_rad", &|b, f| {
        along(b, f).turning().displacement_min().value
    }));
    kind("rotations [rad]", turns);
    let bases = list(expected, "/bases");
    let of_bases = |key: &str, got: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        let one = |base: &Value| (number(base, key), got(index(at(base, "/building"))));
        bases.iter().map(one).collect()
    };
    kind(
        "base shear along x [N]",
        of_bases("/shear_x_peak_n", &|b| outcome.peaks.base_shear(b)),
    );
    kind(
        "base shear across [N]",
        of_bases("/shear_y_peak_n", &|b| along(b, 0).across().storey_shear()),
    );
    kind(
        "base torque [N·m]",
        of_bases("/torque_peak_n_m", &|b| {
            along(b, 0).turning().storey_shear()
        }),
    );
    let contacts = list(inputs, "/contacts");
    // Contacts of both, matched by their places.
    let matched: Vec<usize> = contacts
        .iter()
        .map(|stored| {
            let (place, normal) = (point(at(stored, "/point_m")), point(at(stored, "/normal")));
            let floor = list(stored, "/floors")[0].as_u64();
            let found = system.contacts.iter().position(|contact| {
                contact.plan.is_some_and(|plan| {
                    let near = |a: PlanPoint, b: PlanPoint| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9;
                    near(plan.at, place) && near(plan.normal, normal)
                }) && contact.ports.floors()[0].map(|f| f as u64) == floor
            });
            found.expect("every point of the reference is found from the plans")
        })
        .collect();
    assert_eq!(matched.len(), system.contacts.len(), "no further points");
    let of_contacts = |key: &str, got: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        let stored = list(expected, "/contacts").iter();
        let one = |(stored, index): (&Value, &usize)| (number(stored, key), got(*index));
        stored.zip(&matched).map(one).collect()
    };
    let impacts = |index: usize| {
        outcome
            .impacts
            .iter()
            .filter(move |impact| impact.contact == index)
    };
    let given = |key: &str, got: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        let stored = contacts.iter().zip(&matched);
        stored
            .map(|(stored, index)| (number(stored, key), got(*index)))
            .collect()
    };
    kind(
        "gaps of points [m]",
        given("/gap_m", &|index| system.contacts[index].width),
    );
    kind(
        "stiffness of points",
        given("/stiffness", &|index| match system.contacts[index].law {
            ForceLaw::Hertz { stiffness, .. } | ForceLaw::Kelvin { stiffness, .. } => stiffness,
            _ => f64::NAN,
        }),
    );
    if contacts
        .iter()
        .all(|contact| !contact["hertz_damp_d"].is_null())
    {
        kind(
            "damping of points, ζ of the law",
            given("/hertz_damp_d", &|index| match system.contacts[index].law {
                ForceLaw::Hertz { damping, .. } => damping,
                _ => f64::NAN,
            }),
        );
    }
    kind(
        "greatest closing of points [m]",
        of_contacts("/closing_peak_m", &|index| {
            outcome.peaks.closing(index).value
        }),
    );
    kind(
        "peak force of points [N]",
        of_contacts("/peak_force_n", &|index| {
            impacts(index).map(|i| i.peak_force).fold(0.0, f64::max)
        }),
    );
    kind(
        "impulse of points [N·s]",
        of_contacts("/impulse_n_s", &|index| {
            impacts(index).map(|i| i.impulse).sum()
        }),
    );
    for (stored, position) in list(expected, "/contacts").iter().zip(&matched) {
        if stored["ended"].is_null() {
            continue;
        }
        let starts: fn(&jostle::Impact) -> f64 = |impact| impact.start;
        let peaks: fn(&jostle::Impact) -> f64 = |impact| impact.peak_force;
        for (what, key, got) in [
            ("instants of impacts [s]", "/starts_s", starts),
            ("peak forces of impacts [N]", "/peak_forces_n", peaks),
        ] {
            let stored = numbers(stored, key).into_iter();
            kind(what, stored.zip(impacts(*position).map(got)).collect());
        }
    }
    if let Some(stored) = expected["friction_j"].as_f64() {
        let each = |key: &str, got: fn(&jostle::Impact) -> f64| -> Vec<(f64, f64)> {
            let points = list(expected, "/contacts").iter().zip(&matched);
            let one = |(stored, index): (&Value, &usize)| -> Vec<(f64, f64)> {
                let stored = numbers(stored, key).into_iter();
                stored.zip(impacts(*index).map(got)).collect()
            };
            points.flat_map(one).collect()
        };
        kind(
            "greatest friction of impacts [N]",
            each("/tangential_peaks_n", |impact| impact.sliding.peak_force),
        );
        kind(
            "impulse of friction of points [N·s]",
            of_contacts("/tangential_impulse_n_s", &|index| {
                impacts(index).map(|impact| impact.sliding.impulse).sum()
            }),
        );
        kind(
            "work of friction of points [J]",
            of_contacts("/friction_work_j", &|index| {
                impacts(index).map(|impact| impact.sliding.friction).sum()
            }),
        );
        kind(
            SLIP_SPEED,
            each("/slip_speeds_m_s", |impact| impact.sliding.slip_speed),
        );
        kind(
            "friction of all [J]",
            vec![(stored, outcome.energy.friction)],
        );
    }
    let faces = list(expected, "/faces").iter().map(|stored| {
        let first = list(stored, "/points")[0].as_u64().expect("a contact") as usize;
        let place = system.contacts[matched[first]].plan.expect("in plan");
        let face_impacts = outcome
            .face_impacts
            .iter()
            .filter(|impact| impact.face == place.face);
        let greatest = face_impacts
            .map(|impact| impact.peak_force.value)
            .fold(0.0, f64::max);
        (number(stored, "/peak_force_n"), greatest)
    });
    kind("peak force of faces [N]", faces.collect());
    for (stored, position) in list(expected, "/contacts").iter().zip(&matched) {
        rows.push(Row::absolute(
            source,
            format!("tolerance {tolerance:.0e}, impacts of point {position} [–]"),
            number(stored, "/impact_count"),
            impacts(*position).count() as f64,
            0.0,
        ));
        if let Some(ended) = stored["ended"].as_array() {
            let name = |impact: &jostle::Impact| match impact.sliding.slid_off {
                true => "off",
                false => "open",
            };
            let pairs = ended.iter().zip(impacts(*position).map(name));
            let alike = pairs.filter(|(stored, candidate)| stored.as_str() == Some(*candidate));
            rows.push(Row::absolute(
                source,
                format!("tolerance {tolerance:.0e}, impacts of point {position} that end alike, open or slid off [–]"),
                ended.len() as f64,
                alike.count() as f64,
                0.0,
            ));
        }
    }
    rows.push(Row::absolute(
        source,
        format!("{steps}tolerance {tolerance:.0e}, energy imbalance [–]"),
        0.0,
        outcome.energy.worst_imbalance,
        match solver {
            None => 1e-10,
            // Rounding of equilibrium adds up over contact steps, in one plane alike: with steps of 100, 20, 5 and 1 µs it is 2e-10,
            // 1e-8, 6e-8 and 4e-7, whatever the length of the others.
            Some(_) if tolerance < 1e-4 => 1e-6,
            Some(_) => 1e-9,
        },
    ));
    for stored in list(expected, "/modes") {
        let modes = &system.buildings[index(at(stored, "/building"))].modes;
        let got: Vec<f64> = modes.iter().map(|mode| mode.circular_frequency).collect();
        rows.push(Row::worst_of(
            source,
            "ω of all modes [rad/s]",
            &numbers(stored, "/omega_rad_s"),
            &got,
            1e-9,
        ));
        let of = |ratio: fn(&jostle::eigen::Mode) -> f64| -> f64 { modes.iter().map(ratio).sum() };
        for (key, got) in [
            ("x", of(|mode| mode.effective_mass_ratio_x)),
            ("y", of(|mode| mode.effective_mass_ratio_across)),
        ] {
            let stored = numbers(stored, &format!("/effective_mass_ratio_{key}"));
            rows.push(Row::relative(
                source,
                format!("effective mass along {key}, all modes [–]"),
                stored.iter().sum(),
                got,
                1e-9,
            ));
        }
    }
    rows
}

/// Areas, moments and faces of polygons against triangulated ones and a count by hand.
fn polygons() -> Vec<Row> {
    const SOURCE: &str = "space/S9_polygons";
    let case = document(include_str!("../data/space/S9_polygons.json"));
    let mut rows = Vec::new();
    for plan in list(&case, "/plans") {
        let corners = points(at(plan, "/corners_m"));
        let area = PlanArea::new(&corners);
        let name = at(plan, "/name").as_str().expect("a name");
        let stiffness = [
            number(plan, "/default_torsion/kx"),
            number(plan, "/default_torsion/ky"),
        ];
        for (key, got) in [
            ("/area_m2", area.area),
            ("/centroid_m/0", area.centroid[0]),
            ("/centroid_m/1", area.centroid[1]),
            ("/I_xx_m4", area.second_moments[0]),
            ("/I_yy_m4", area.second_moments[1]),
            ("/polar_radius_squared_m2", area.gyration()),
            (
                "/default_torsion/k_theta",
                TierStorey::torsion_of_even(stiffness, &area),
            ),
        ] {
            rows.push(Row::relative(
                SOURCE,
                format!("{name}{key}"),
                number(plan, key),
                got,
                1e-12,
            ));
        }
    }
    for pair in list(&case, "/pairs") {
        let names: Vec<&str> = list(pair, "/between")
            .iter()
            .filter_map(Value::as_str)
            .collect();
        let plan = |name: &str| {
            let stored = list(&case, "/plans")
                .iter()
                .find(|plan| at(plan, "/name") == name);
            points(at(stored.expect("a plan of that name"), "/corners_m"))
        };
        let faces = list(pair, "/faces");
        let tower = |name: &str| {
            let tier = Tier::uniform(1e5, plan(name)).expect("an area");
            let area = PlanArea::new(&tier.plan);
            Building {
                name: name.to_owned(),
                structure: Structure::Tiers(Tiers {
                    storeys: vec![TierStorey {
                        stiffness: [1e7, 1e7, TierStorey::torsion_of_even([1e7; 2], &area)],
                        centre: tier.centre,
                    }],
                    floors: vec![tier],
                    storey_heights: vec![3.0],
                    ..Tiers::default()
                }),
                damping: Damping::ratio(0.05, []),
                ..Building::default()
            }
        };
        let law = ContactLaw {
            kind: LawKind::Hertz,
            stiffness: 1e9,
            restitution: 1.0,
            restitution_is: RestitutionIs::Input,
        };
        let gaps = faces.iter().flat_map(|face| numbers(face, "/gap_m"));
        let mut gap = Gap::between([Some(0), Some(1)], gaps.fold(f64::INFINITY, f64::min), law);
        gap.in_plan = PlanContact {
            points: number(pair, "/points") as usize,
            reach: number(pair, "/reach_m"),
            per_length: false,
            ..PlanContact::default()
        };
        let model = Model {
            title: names.join(" and "),
            buildings: names.iter().map(|name| tower(name)).collect(),
            gaps: vec![gap],
            ..Model::default()
        };
        let found = System::assemble(&model)
            .map(|system| system.contacts)
            .unwrap_or_default();
        let places: Vec<PlanPoint> = found.iter().filter_map(|c| Some(c.plan?.at)).collect();
        let stored: Vec<PlanPoint> = faces
            .iter()
            .flat_map(|face| points(at(face, "/point_m")))
            .collect();
        rows.push(Row::absolute(
            SOURCE,
            format!("{}, number of points", names.join(" and ")),
            stored.len() as f64,
            places.len() as f64,
            0.0,
        ));
        let off = stored.iter().map(|p| {
            let away = places
                .iter()
                .map(|place| (place[0] - p[0]).hypot(place[1] - p[1]));
            away.fold(f64::INFINITY, f64::min)
        });
        rows.push(Row::absolute(
            SOURCE,
            format!("{}, points [m]", names.join(" and ")),
            0.0,
            off.fold(0.0, f64::max),
            1e-9,
        ));
    }
    rows
}
