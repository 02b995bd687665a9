//! Every check has a model or a result that trips it and one just inside; ordinary models are left in peace.

use std::ops::ControlFlow;
use std::path::Path;

use jostle::contact::{SlabMaterial, advised_range};
use jostle::judgement::{CHECKS, FROM_MODEL, JUDGEMENT, Known, Stated, StatedBuilding, judge};
use jostle::results::contact_sensitivity::{ContactSensitivity, GapSpread};
use jostle::results::summary::{
    AcceptanceSummary, Finding, Grade, ImpactPlace, ImpactSummary, IsolationSummary, LevelSummary,
    MemberSummary, RatioPlace, RatioSummary, SectionSummary, StruckSummary,
};
use jostle::separation::{Code, CodeInputs};
use jostle::{GroundMotion, Settings, Summary};
use jostle_io::{Input, MotionSource, MotionSpec, TEMPLATE_NAMES};
use jostle_run::{Opened, Prepared};
use jostle_testkit::files::{refusal, sound};

fn opened(input: Input) -> Opened {
    Opened::new(input, "model").unwrap_or_else(|error| panic!("{error}"))
}

fn is_found(found: &[Finding], name: &str) -> bool {
    found.iter().any(|finding| finding.name == name)
}

/// Findings of a model without a motion.
fn of_model(text: &str) -> Vec<Finding> {
    opened(sound(text)).findings(None)
}

/// One storey or more on springs.
fn towers(keys: &str) -> String {
    format!("[[building]]\nname = \"A\"\nkind = \"shear\"\n{keys}")
}

/// A frame of one storey without mass of its columns.
fn frame(keys: &str) -> String {
    format!(
        "[[building]]\nname = \"A\"\nstorey_height = \"3 m\"\nconcrete = \"C30\"\ndensity = \"0 kg/m3\"\n{keys}"
    )
}

const SECTIONS: &str = "column = { width = \"400 mm\", depth = \"400 mm\" }\nbeam = { width = \"300 mm\", depth = \"600 mm\" }\n";

/// Two shear buildings with a gap.
fn pair(gap: &str) -> String {
    let tower = |name: &str, mass: u32, stiffness: u32| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"shear\"\nstoreys = 2\nstorey_height = \"3 m\"\nmass = \"{mass} t\"\nstiffness = \"{stiffness} MN/m\"\n"
        )
    };
    format!(
        "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\n{gap}\n",
        tower("A", 40, 60),
        tower("B", 60, 70)
    )
}

/// A column that is struck, with so much of its capacity in shear at its foot, or in bending where it is struck.
fn struck(shear: f64, bending: f64) -> MemberSummary {
    let place = |at| RatioPlace {
        at,
        height_m: 0.0,
        at_s: 1.0,
        demand: 1e5,
        demand_across: None,
        capacity: 1e5,
        compression_n: 0.0,
        exceeded_s: None,
        impact: Some(ImpactPlace {
            between: ["A".into(), "B".into()],
            floors: [None, Some(1)],
            height_m: 2.0,
            start_s: 0.9,
            on_member: Some(true),
        }),
    };
    let section = SectionSummary::default();
    MemberSummary {
        name: "A.column.1.1".into(),
        struck: vec![StruckSummary {
            height_m: 2.0,
            impact_count: 1,
            peak_force_n: 1e5,
            below: section,
            above: section,
        }],
        ratio: Some(RatioSummary {
            rule: "rule",
            shear: Some(shear),
            bending,
            shear_at: Some(place("foot")),
            bending_at: place("above"),
        }),
        ..MemberSummary::default()
    }
}

/// Models just inside and just outside.
fn models() -> Vec<(&'static str, String, String)> {
    let tall = |stiffness: f64| {
        towers(&format!(
            "storeys = 4\nstorey_height = \"3 m\"\nmass = \"100 t\"\nstiffness = \"{stiffness} MN/m\"\n"
        ))
    };
    let carrying = |mass: u32, spans: &str| {
        frame(&format!(
            "storeys = 1\nspans = [{spans}]\n{SECTIONS}beam_mass = \"{mass} kg/m\"\nbeam_segments = 1\n"
        ))
    };
    let on_plan = |mass: u32| {
        towers(&format!(
            "storeys = 1\nstorey_height = \"3 m\"\nplan = [\"20 m\", \"10 m\"]\nmass = \"{mass} t\"\nstiffness = \"60 MN/m\"\n"
        ))
    };
    let damped = |ratio: f64| {
        towers(&format!(
            "storeys = 1\nstorey_height = \"3 m\"\nmass = \"40 t\"\nstiffness = \"60 MN/m\"\ndamping = {{ ratio = {ratio}, modes = [1] }}\n"
        ))
    };
    let rigid = |storeys: usize, height: f64| {
        format!(
            "[[building]]\nname = \"A\"\nconcrete = \"C30\"\nstoreys = {storeys}\nstorey_height = \"{height} m\"\nspans = [\"5 m\"]\n{SECTIONS}beam_mass = \"5 t/m\"\naxial = \"rigid\"\n"
        )
    };
    let yields_with = |ratio: f64| {
        towers(&format!(
            "storeys = 3\nstorey_height = \"3 m\"\nmass = \"40 t\"\nstiffness = \"60 MN/m\"\nhinges = {{ rule = \"bilinear\", yield = \"20 mm\", post_yield = 0.05 }}\ndamping = {{ ratio = {ratio} }}\n"
        ))
    };
    let isolated = |bounds: &str| {
        towers(&format!(
            "storeys = 1\nstorey_height = \"3 m\"\nmass = \"40 t\"\nstiffness = \"60 MN/m\"\nisolation = {{ kind = \"linear\", mat_mass = \"50 t\", stiffness = \"2 MN/m\"{bounds} }}\n"
        ))
    };
    let struck = |axial: &str| {
        let building = |name: &str| {
            format!(
                "[[building]]\nname = \"{name}\"\nconcrete = \"C30\"\nstoreys = 1\nstorey_height = \"3 m\"\nspans = [\"6 m\", \"6 m\"]\n{SECTIONS}beam_mass = \"5 t/m\"\naxial = {axial}\n"
            )
        };
        format!(
            "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"50 mm\"\n",
            building("A"),
            building("B")
        )
    };
    let stiff = |value: &str, law: &str| {
        pair(&format!(
            "width = \"50 mm\"\nlaw = \"{law}\"\nstiffness = \"{value}\"\nrestitution = 0.9\n"
        ))
    };
    let rebound = |restitution: f64| {
        pair(&format!(
            "width = \"50 mm\"\nlaw = \"hertz-damp\"\nrestitution = {restitution}\n"
        ))
    };
    let yields = |p_delta: &str| {
        towers(&format!(
            "storeys = 1\nstorey_height = \"3 m\"\nmass = \"40 t\"\nstiffness = \"60 MN/m\"\nhinges = {{ rule = \"bilinear\", yield = \"20 mm\", post_yield = 0.05 }}\n{p_delta}"
        ))
    };
    let cracks = |factor: f64| {
        frame(&format!(
            "storeys = 1\nspans = [\"6 m\"]\n{SECTIONS}beam_mass = \"5 t/m\"\nstiffness_factor = {factor}\nhinges = {{ rule = \"takeda\", beam = {{ cracking = \"80 kN.m\", yield = \"260 kN.m\", post_cracking = 0.3, post_yield = 0.02 }} }}\n"
        ))
    };
    // Storeys of 3 m: a link at floor 1 stands for soil from 1.5 m above the foundation.
    let embedded = |depth: f64, floor: usize| {
        let building = towers(&format!(
            "storeys = 2\nstorey_height = \"3 m\"\nelevation = \"-3 m\"\nmass = \"80 t\"\nstiffness = \"90 MN/m\"\nfoundation = {{ length = \"12 m\", width = \"10 m\", mass = \"120 t\", embedment = \"{depth} m\" }}\n"
        ));
        format!(
            "[soil]\nshear_wave_velocity = \"180 m/s\"\ndensity = \"1800 kg/m3\"\npoisson_ratio = 0.33\n{building}[[link]]\nbetween = [\"wall\", \"A\"]\nfloors = [[\"wall\", {floor}]]\nstiffness = \"200 MN/m\"\n"
        )
    };
    let storeys = |stiffness: &str| {
        let count = stiffness.split(',').count();
        towers(&format!(
            "storeys = {count}\nstorey_height = \"3 m\"\nmass = \"40 t\"\nstiffness = [{stiffness}]\n"
        ))
    };
    // Equal storeys along x.
    let across = |lowest: f64| {
        let element = |x: u32| {
            let storey = |y: f64| format!("{{ x = \"100 MN/m\", y = \"{y} MN/m\" }}");
            format!(
                "{{ at = [\"{x} m\", \"5 m\"], stiffness = [{}, {}] }}",
                storey(lowest),
                storey(100.0)
            )
        };
        towers(&format!(
            "storeys = 2\nstorey_height = \"3 m\"\nmass = \"200 t\"\nplan = [\"20 m\", \"10 m\"]\nelement = [{}, {}]\n",
            element(0),
            element(20)
        ))
    };
    let wide = |width: f64| pair(&format!("width = \"{width} mm\"\nrestitution = 0.9\n"));
    vec![
        // T = 2π/(2 √(k/m) sin(π/18)), H = 12 m: twice 0.548 s, and half of 0.3146 s.
        ("first-period", tall(28.0), tall(27.0)),
        ("first-period", tall(1300.0), tall(1340.0)),
        // 0.3 · 0.6 · 2500 = 450 kg/m.
        (
            "beam-mass",
            carrying(680, "\"6 m\""),
            carrying(670, "\"6 m\""),
        ),
        // N = g · 3 m · mass = ν · 0.16 m² · 20.1 MPa.
        (
            "column-compression",
            carrying(70_000, "\"6 m\""),
            carrying(72_000, "\"6 m\""),
        ),
        ("floor-mass", on_plan(81), on_plan(79)),
        ("floor-mass", on_plan(399), on_plan(401)),
        (
            "floor-mass-per-length",
            carrying(1210, "\"6 m\""),
            carrying(1190, "\"6 m\""),
        ),
        (
            "floor-mass-per-length",
            carrying(15_900, "\"6 m\""),
            carrying(16_100, "\"6 m\""),
        ),
        ("modal-damping", damped(0.0101), damped(0.0099)),
        ("modal-damping", damped(0.099), damped(0.101)),
        (
            "damping-with-hinges",
            yields_with(0.0349),
            yields_with(0.0351),
        ),
        ("rigid-columns", rigid(5, 2.99), rigid(5, 3.01)),
        ("rigid-columns", rigid(10, 1.4), rigid(11, 1.3)),
        (
            "bearing-bounds",
            isolated(", bounds = { lower = 0.85, upper = 1.3 }"),
            isolated(""),
        ),
        ("soil-twice", embedded(1.49, 1), embedded(1.51, 1)),
        ("soil-twice", embedded(4.49, 2), embedded(1.51, 1)),
        (
            "struck-mass",
            struck("\"flexible\""),
            struck("{ columns = \"flexible\", beams = \"flexible\" }"),
        ),
        // 40 t against 60 t: 1.9030e10 by spheres, 2e9 in studies; a tenth is allowed.
        (
            "contact-stiffness",
            stiff("2.08e10 N/m^1.5", "hertz-damp"),
            stiff("2.1e10 N/m^1.5", "hertz-damp"),
        ),
        (
            "contact-stiffness",
            stiff("1.81e9 N/m^1.5", "hertz-damp"),
            stiff("1.79e9 N/m^1.5", "hertz-damp"),
        ),
        // E t = 4.5 GN/m.
        (
            "contact-stiffness",
            stiff("4.9 GN/m", "kelvin"),
            stiff("5.0 GN/m", "kelvin"),
        ),
        ("restitution", rebound(0.8), rebound(0.65)),
        (
            "yielding-without-p-delta",
            yields(""),
            yields("p_delta = false\n"),
        ),
        ("cracking-twice", cracks(1.0), cracks(0.99)),
        (
            "soft-storey",
            storeys("\"71 MN/m\", \"100 MN/m\""),
            storeys("\"69 MN/m\", \"100 MN/m\""),
        ),
        // 85 and 79 % of the mean of the next three, and more than 70 % of the next.
        (
            "soft-storey",
            storeys("\"85 MN/m\", \"120 MN/m\", \"100 MN/m\", \"80 MN/m\""),
            storeys("\"79 MN/m\", \"110 MN/m\", \"105 MN/m\", \"85 MN/m\""),
        ),
        ("soft-storey", across(71.0), across(69.0)),
        ("gap-tolerance", wide(25.1), wide(24.9)),
        ("gap-tolerance", wide(0.0), wide(24.9)),
    ]
}

#[test]
fn models_trip_their_checks_and_others_just_do_not() {
    for (name, inside, outside) in models() {
        let found = of_model(&inside);
        assert!(!is_found(&found, name), "{name} inside: {found:?}");
        let found = of_model(&outside);
        assert!(is_found(&found, name), "{name} outside: {found:?}");
    }
}

/// A record of ones, so that the Arias intensity grows with time.
fn ones(points: usize) -> GroundMotion {
    GroundMotion::sampled("ones", 0.01, vec![1.0; points])
}

#[test]
fn records_trip_their_checks() {
    let opened = opened(sound(&pair("width = \"50 mm\"")));
    let with = |motion: &GroundMotion, records: usize| {
        let stated = Stated {
            records,
            ..Stated::default()
        };
        judge(&Known {
            model: &opened.input.model,
            system: &opened.system,
            motion: Some(motion),
            stated: &stated,
            results: None,
        })
    };
    let whole = ones(1001);
    assert!(is_found(&with(&whole, 2), "records"));
    assert!(!is_found(&with(&whole, 3), "records"));
    let cut = |points: f64| GroundMotion {
        duration: 0.01 * points,
        ..ones(1001)
    };
    assert!(!is_found(&with(&cut(955.0), 3), "cut-record"));
    assert!(is_found(&with(&cut(945.0), 3), "cut-record"));
    let half = with(&cut(495.0), 3);
    let half = half.iter().find(|half| half.name == "cut-record");
    assert_eq!(half.map(|own| own.grade), Some(Grade::Warning));
    let scaled = |scale: f64| GroundMotion {
        scale,
        ..ones(1001)
    };
    for (scale, trips) in [(0.26, false), (0.24, true), (-3.9, false), (-4.1, true)] {
        assert_eq!(
            is_found(&with(&scaled(scale), 3), "record-scale"),
            trips,
            "{scale}"
        );
    }
}

/// The strong part of a record, moderately scaled.
fn short() -> GroundMotion {
    let whole = MotionSpec::record("el-centro-1940-ns").resolve();
    let whole = whole.unwrap_or_else(|error| panic!("{error}"));
    let value = |i: u32| 0.4 * whole.acceleration(0.02 * f64::from(i));
    GroundMotion::sampled("short", 0.02, (0..=300).map(value).collect())
}

fn run(mut input: Input, compares: bool) -> (Prepared, Summary) {
    input.replace_motion(MotionSpec {
        source: MotionSource::Given(short()),
        ..MotionSpec::record("short")
    });
    run_own(input, compares)
}

/// The same with the motion of the model.
fn run_own(input: Input, compares: bool) -> (Prepared, Summary) {
    let prepared = opened(input)
        .prepare()
        .unwrap_or_else(|error| panic!("{error}"));
    let mut ran = prepared.run(
        Settings {
            record_interval: None,
            ..Settings::default()
        },
        &mut |_, _| ControlFlow::Continue(()),
    );
    if compares {
        ran.run_without_contact(
            Settings {
                record_interval: None,
                ..Settings::default()
            },
            &mut |_, _| ControlFlow::Continue(()),
        );
    }
    let summary = ran.summary();
    (ran.prepared, summary)
}

/// What results are changed to, below and above the limit.
type Change = fn(&mut Summary, f64);

/// Checks of results: how a number of the summary is set, and values just inside and just outside.
fn results() -> Vec<(&'static str, Change, f64, f64)> {
    fn impact(summary: &mut Summary, change: impl Fn(&mut ImpactSummary)) {
        let mut one = summary
            .gaps
            .iter()
            .flat_map(|gap| gap.contacts.iter().flat_map(|contact| &contact.impacts))
            .copied()
            .next()
            .expect("an impact");
        change(&mut one);
        summary.gaps[0].contacts[0].impacts = vec![one];
        for contact in &mut summary.gaps[0].contacts[1..] {
            contact.impacts.clear();
        }
    }
    vec![
        (
            "p-delta-left-out",
            |s, x| s.buildings[1].floors[0].response.stability_coefficient = Some(x),
            0.099,
            0.101,
        ),
        (
            "stability",
            |s, x| s.buildings[0].floors[0].response.stability_coefficient = Some(x),
            0.199,
            0.201,
        ),
        (
            "drift",
            |s, x| s.buildings[0].floors[0].response.storey_drift_peak = x,
            0.0199,
            0.0201,
        ),
        (
            "ductility",
            |s, x| s.buildings[0].response.ductility = Some(x),
            5.9,
            6.1,
        ),
        (
            "rotation",
            |s, x| {
                s.buildings[0].members = vec![MemberSummary {
                    name: "A.column.1.1".into(),
                    acceptance: vec![AcceptanceSummary {
                        rule: "rule",
                        measure: "chord",
                        rotation_rad: x,
                        at: "bottom",
                        limits: vec![LevelSummary {
                            level: "last",
                            rotation_rad: 0.02,
                        }],
                        level: None,
                    }],
                    ..MemberSummary::default()
                }];
            },
            0.0199,
            0.0201,
        ),
        (
            "struck-column",
            |s, x| s.buildings[0].members = vec![struck(x, 0.5)],
            0.99,
            1.01,
        ),
        (
            "struck-bending",
            |s, x| s.buildings[0].members = vec![struck(0.5, x)],
            0.99,
            1.01,
        ),
        (
            "struck-unrated",
            |s, x| {
                let contact = &mut s.gaps[0].contacts[0];
                contact.floors = [None, Some(1)];
                contact.impact_count = x as usize;
            },
            0.0,
            1.0,
        ),
        (
            "elastic-drift",
            |s, x| s.buildings[1].response.drift_peak = x,
            0.0099,
            0.0101,
        ),
        (
            "elastic-shear",
            |s, x| {
                s.buildings[1].response.base_shear_peak_n = x * 9.806_65 * s.buildings[1].mass_kg;
            },
            0.399,
            0.401,
        ),
        (
            "column-tension",
            |s, x| {
                let end = SectionSummary {
                    axial_max_n: 1e6 * x,
                    axial_min_n: -1e6,
                    ..SectionSummary::default()
                };
                s.buildings[0].members = vec![MemberSummary {
                    name: "A.column.1.1".into(),
                    ends: vec![end],
                    ..MemberSummary::default()
                }];
            },
            0.0099,
            0.0101,
        ),
        // A f_ck = 0.16 m² · 20.1 MPa; the hinges were made for 1000 kN.
        (
            "hinge-axial-force",
            |s, x| {
                let end = SectionSummary {
                    axial_max_n: -1e6 + x * 0.16 * 20.1e6,
                    axial_min_n: -1.1e6,
                    ..SectionSummary::default()
                };
                s.buildings[0].members = vec![MemberSummary {
                    name: "A.column.2.1".into(),
                    ends: vec![end],
                    ..MemberSummary::default()
                }];
            },
            0.099,
            0.101,
        ),
        // The narrower slab: 5 t/m and 1/4 of the half storey of two columns over 6 m, at 1 t/m² and 150 mm thick.
        (
            "pressure",
            |s, x| {
                let width = (30e3 + 2.0 * 400.0 * 3.0 / 8.0) / (1e3 * 6.0);
                s.gaps[0].contacts[0].peak_force_n = x * 20.1e6 * 0.15 * width;
            },
            0.99,
            1.01,
        ),
        (
            "indentation",
            |s, x| impact(s, |own| own.peak_indentation_m = x),
            0.0099,
            0.0101,
        ),
        // The frame is 6 m long.
        (
            "indentation-share",
            |s, x| impact(s, |own| own.peak_indentation_m = 6.0 * x),
            0.0099,
            0.0101,
        ),
        // 2 · 6 m at √(30 GPa/2500 kg/m³) = 3464.1 m/s.
        (
            "impact-duration",
            |s, x| {
                impact(s, |own| {
                    (own.start_s, own.end_s, own.finished) = (1.0, 1.0 + x * 12.0 / 3464.1, true);
                });
            },
            2.01,
            1.99,
        ),
        (
            "residual-drift",
            |s, x| s.buildings[0].floors[0].response.residual_drift = -x,
            0.0049,
            0.0051,
        ),
        (
            "force-spread",
            |s, x| {
                s.gaps[0].peak_force_n = 1e6;
                s.contact_sensitivity = Some(ContactSensitivity {
                    variants: Vec::new(),
                    gaps: vec![GapSpread {
                        between: s.gaps[0].between.clone(),
                        peak_force_min_n: 0.8e6,
                        peak_force_max_n: 0.8e6 + 1e6 * x,
                        impact_count_min: 1,
                        impact_count_max: 2,
                    }],
                    buildings: Vec::new(),
                });
            },
            0.49,
            0.51,
        ),
        (
            "near-miss",
            |s, x| {
                let gap = &mut s.gaps[0];
                gap.impact_count = 0;
                for contact in &mut gap.contacts {
                    contact.closing_peak_m = x * contact.width_m;
                }
            },
            0.949,
            0.951,
        ),
        (
            "bearing-stroke",
            |s, x| {
                s.buildings[0].isolation = Some(IsolationSummary {
                    displacement_max_m: 0.2 * x,
                    limit_m: Some(0.2),
                    ..IsolationSummary::default()
                });
            },
            0.99,
            1.01,
        ),
        // 1 MN over 6 m: the weight leaves the middle third at 1 MN·m.
        (
            "bearing-uplift",
            |s, x| {
                s.buildings[0].isolation = Some(IsolationSummary {
                    weight_n: 1e6,
                    ..IsolationSummary::default()
                });
                s.buildings[0].floors[0]
                    .response
                    .overturning_moment_peak_n_m = 1e6 * x;
            },
            0.99,
            1.01,
        ),
        // EN 1998-1 wants the root of the sum of squares of the displacements, here 50 mm.
        (
            "code-gap",
            |s, x| {
                s.gaps[0].closing_without_contact_m = Some(0.05 * x);
                for building in &mut s.buildings {
                    for floor in &mut building.floors {
                        let peaks = floor.without_contact.as_mut().expect("that run was made");
                        (peaks.displacement_max_m, peaks.displacement_min_m) =
                            (0.05 / 2.0_f64.sqrt(), 0.0);
                    }
                }
            },
            0.69,
            1.01,
        ),
    ]
}

/// A yielding frame beside elastic storeys, close enough to touch.
const TOUCHING: &str = r#"
[[building]]
name = "A"
concrete = "C30"
storeys = 1
storey_height = "3 m"
spans = ["6 m"]
column = { width = "400 mm", depth = "400 mm" }
beam = { width = "300 mm", depth = "600 mm" }
beam_mass = "5 t/m"
gravity = true
hinges = { rule = "bilinear", column = { yield = "400 kN.m", post_yield = 0.02 }, beam = { yield = "300 kN.m", post_yield = 0.02 } }
[[building]]
name = "B"
kind = "shear"
storeys = 1
storey_height = "3 m"
mass = "60 t"
stiffness = "20 MN/m"
[[gap]]
between = ["A", "B"]
width = "1 mm"
stiffness = "1.5e10 N/m^1.5"
restitution = 0.9
"#;

#[test]
fn results_trip_their_checks_and_others_just_do_not() {
    let (prepared, summary) = run(sound(TOUCHING), true);
    assert!(summary.gaps[0].impact_count > 0);
    let codes = CodeInputs {
        shown: vec![Code::En1998],
        ..prepared.input.codes.clone()
    };
    let stated = Stated {
        buildings: vec![StatedBuilding {
            hinge_compression: vec![vec![1e6; 2]],
            ..prepared.input.stated.buildings[0].clone()
        }],
        ..Stated::default()
    };
    assert_eq!(stated.buildings[0].strength, Some(20.1e6));
    let found = |summary: &Summary| {
        judge(&Known {
            model: &prepared.input.model,
            system: &prepared.system,
            motion: Some(&prepared.motion),
            stated: &stated,
            results: Some((summary, &codes)),
        })
    };
    let all = results();
    for (name, change, inside, outside) in &all {
        let changed = |value: f64| {
            let mut summary = summary.clone();
            change(&mut summary, value);
            found(&summary)
        };
        assert!(
            !is_found(&changed(*inside), name),
            "{name} inside: {:?}",
            changed(*inside)
        );
        assert!(
            is_found(&changed(*outside), name),
            "{name} outside: {:?}",
            changed(*outside)
        );
    }
    let tested: Vec<&str> = models().iter().map(|(name, ..)| *name).collect();
    for check in CHECKS {
        let is_tested = tested.contains(&check.name)
            || all.iter().any(|(name, ..)| *name == check.name)
            || ["records", "cut-record", "record-scale", "bumper"].contains(&check.name);
        assert!(is_tested, "{} has no model that trips it", check.name);
        assert!(!check.remedy.is_empty() && !check.limits.is_empty());
        let of_the_authors = |source: &&&str| source.ends_with(JUDGEMENT);
        let published = check
            .sources
            .iter()
            .filter(|source| !of_the_authors(source));
        let agreed =
            published.clone().count() >= 2 && published.clone().all(|source| *source != FROM_MODEL);
        let alone = [&[JUDGEMENT][..], &[FROM_MODEL]].contains(&check.sources);
        assert!(agreed || alone, "{}: {:?}", check.name, check.sources);
    }
}

/// A bumper that stops the buildings where 0.8 of its thickness is used up, and one thick enough.
#[test]
fn bumpers_that_are_too_thin_are_named() {
    let with = |thickness: u32| {
        let text = TOUCHING.replace(
            "stiffness = \"1.5e10 N/m^1.5\"",
            &format!("law = \"rubber\"\nthickness = \"{thickness} mm\"\nstiffness = \"2 MN/m\""),
        );
        let (_, summary) = run(sound(&text), false);
        let impacts = summary.gaps[0]
            .contacts
            .iter()
            .flat_map(|contact| &contact.impacts);
        let depth = impacts
            .map(|impact| impact.peak_indentation_m)
            .fold(0.0, f64::max);
        (depth, is_found(&summary.checks, "bumper"))
    };
    for thickness in [10, 400] {
        let (depth, found) = with(thickness);
        assert!(depth > 0.001, "{depth}");
        assert_eq!(
            found,
            depth > 0.8e-3 * f64::from(thickness),
            "{thickness} mm by {depth} m"
        );
    }
    assert!(with(10).1 && !with(400).1);
}

/// Next to no shaking changes no axial force, whether forces contain self weight or not.
#[test]
fn hinges_of_a_quiet_frame_keep_their_axial_force() {
    for gravity in [
        "",
        "gravity = true",
        "p_delta = true",
        "gravity = true\np_delta = true",
    ] {
        let text = format!(
            "[[building]]\nname = \"A\"\nstoreys = 3\nstorey_height = \"3 m\"\nspans = [\"5 m\"]\nconcrete = \"C20\"\nbeam_mass = \"6 t/m\"\ndamping = {{ ratio = 0.05 }}\nhinges = {{ rule = \"takeda\", from = \"section\" }}\ncolumn = {{ width = \"400 mm\", depth = \"400 mm\", steel = \"400 MPa\", bars = \"8 d20\" }}\nbeam = {{ width = \"250 mm\", depth = \"500 mm\", steel = \"400 MPa\", bars = \"6 d20\" }}\n{gravity}\n[output]\nmembers = true\n"
        );
        let (prepared, summary) = run(sound(&text), false);
        let quiet = |scale: f64| {
            let mut summary = summary.clone();
            for end in summary.buildings[0]
                .members
                .iter_mut()
                .flat_map(|member| &mut member.ends)
            {
                // The force of weight is the middle of this run.
                let middle = 0.5 * (end.axial_max_n + end.axial_min_n);
                end.axial_max_n = middle + scale * (end.axial_max_n - middle);
                end.axial_min_n = middle + scale * (end.axial_min_n - middle);
            }
            summary
        };
        let codes = CodeInputs {
            shown: vec![Code::En1998],
            ..prepared.input.codes.clone()
        };
        let found = |summary: &Summary| {
            let found = judge(&Known {
                model: &prepared.input.model,
                system: &prepared.system,
                motion: Some(&prepared.motion),
                stated: &prepared.input.stated,
                results: Some((summary, &codes)),
            });
            is_found(&found, "hinge-axial-force")
        };
        assert!(found(&quiet(30.0)), "{gravity}: large changes");
        assert!(!found(&quiet(0.01)), "{gravity}: next to none");
    }
}

#[test]
fn findings_are_sorted_and_can_be_silenced() {
    let text = |silence: &str| format!("{TOUCHING}[report]\nsilence = {silence}\n");
    let (_, summary) = run(sound(TOUCHING), false);
    let grades: Vec<Grade> = summary.checks.iter().map(|check| check.grade).collect();
    assert!(grades.is_sorted_by(|a, b| a >= b), "{grades:?}");
    assert!(is_found(&summary.checks, "records"), "{:?}", summary.checks);
    for silence in ["[\"A12\"]", "\"records\"", "[\"a12\", \"near-miss\"]"] {
        let (_, quiet) = run(sound(&text(silence)), false);
        assert!(!is_found(&quiet.checks, "records"));
        assert!(quiet.silenced_checks.contains(&"records".to_owned()));
        assert_eq!(quiet.checks.len() + 1, summary.checks.len());
    }
    let unknown = refusal(&text("[\"record\"]"));
    assert!(unknown.contains("did you mean \"records\"?"), "{unknown}");
    assert!(refusal(&text("[\"whatever\"]")).contains("docs/checks.md"));
}

/// Notes and warnings that a terminal would show, without near misses: any model has them at some intensity.
fn shown(summary: &Summary) -> Vec<&Finding> {
    let checks = summary.checks.iter();
    checks
        .filter(|check| check.grade >= Grade::Note && check.name != "near-miss")
        .collect()
}

/// What a model raises if that is more than one note.
fn too_much(name: &str, input: Input) -> Option<String> {
    let (_, summary) = run(input, false);
    let found = shown(&summary)
        .into_iter()
        .filter(|finding| !is_meant(name, finding))
        .map(|finding| format!("{} {}", finding.id, finding.text));
    let found: Vec<String> = found.collect();
    (found.len() > 1).then(|| format!("{name}:\n  {}", found.join("\n  ")))
}

/// The same of a model with its own motion, before it runs.
fn too_much_at_rest(name: &str, input: &Input) -> Option<String> {
    let opened = opened(input.clone());
    let without_records = input.records().is_empty() && input.motion.is_some();
    let motion = without_records.then(|| opened.plan().unwrap_or_else(|error| panic!("{error}")).0);
    let found = opened.findings(motion.as_ref());
    let found: Vec<String> = found
        .into_iter()
        .filter(|candidate| candidate.grade >= Grade::Note && !is_meant(name, candidate))
        .map(|finding| format!("{} {}", finding.id, finding.text))
        .collect();
    (found.len() > 1).then(|| format!("{name}, at rest:\n  {}", found.join("\n  ")))
}

/// Templates and examples of which one storey is soft on purpose.
const SOFT: [&str; 2] = ["soft-storey", "braced_and_infilled_frames.toml"];

/// Whether a finding is what a template or an example shows on purpose.
fn is_meant(name: &str, found: &Finding) -> bool {
    found.name == "soft-storey" && SOFT.contains(&name)
}

/// Templates of typical pairs.
const PAIRS: [&str; 8] = [
    "soft-storey",
    "wall-frame",
    "podium",
    "masonry-infill",
    "heritage",
    "braced-steel",
    "bridge-decks",
    "isolated-moat",
];

/// In the first seconds, which are the strongest; at their end buildings still move.
#[test]
fn pairs_pound_and_raise_at_most_one_note() {
    let mut loud = Vec::new();
    for name in PAIRS {
        let text = jostle_io::template(name, "title").expect("it is there");
        let brief = text.replacen("[motion]\n", "[motion]\nduration = \"5.5 s\"\n", 1);
        let input = sound(&format!(
            "{brief}\n[report]\nsilence = [\"cut-record\", \"residual-drift\"]\n"
        ));
        let (_, summary) = run_own(input, false);
        for gap in &summary.gaps {
            assert!(gap.impact_count > 0, "{name}: {:?}", gap.between);
        }
        assert_eq!(summary.warnings, Vec::<String>::new(), "{name}");
        let soft = is_found(&summary.checks, "soft-storey");
        assert_eq!(soft, SOFT.contains(&name), "{name}");
        let found = shown(&summary)
            .into_iter()
            .filter(|finding| !is_meant(name, finding))
            .map(|finding| finding.text.clone());
        let found: Vec<String> = found.collect();
        if found.len() > 1 {
            loud.push(format!("{name}:\n  {}", found.join("\n  ")));
        }
    }
    assert!(loud.is_empty(), "{}", loud.join("\n"));
}

#[test]
fn templates_and_examples_raise_at_most_one_note() {
    let mut loud = Vec::new();
    for name in TEMPLATE_NAMES {
        let text = jostle_io::template(name, "title").expect("it is there");
        loud.extend(too_much_at_rest(name, &sound(&text)));
        if !PAIRS.contains(&name) {
            loud.extend(too_much(name, sound(&text)));
        }
    }
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples"));
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("the folder") {
        let path = entry.expect("an entry").path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let is_model = name.ends_with(".toml") && !name.starts_with("study_");
        if is_model {
            let input = jostle_io::read_model_file(&path).unwrap_or_else(|error| panic!("{error}"));
            loud.extend(too_much_at_rest(&name, &input));
            loud.extend(too_much(&name, input));
            count += 1;
        }
    }
    assert!(count > 15, "{count}");
    assert!(loud.is_empty(), "{}", loud.join("\n"));
}

/// Numbers between 0 and 1, the same every time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// A building as offices and flats are: periods of 0.07 to 0.12 s a storey, or usual sections.
fn sensible(random: &mut Random, name: &str, height: f64) -> String {
    let storeys = random.between(2.0, 9.99).floor();
    let mut text = format!(
        "[[building]]\nname = \"{name}\"\nstoreys = {storeys}\nstorey_height = {height:.2}\n"
    );
    if random.next() < 0.5 {
        let mass = random.between(80.0, 250.0);
        let period = random.between(0.07, 0.12) * storeys;
        let rate = std::f64::consts::PI / period;
        let sine = (0.5 * std::f64::consts::PI / (2.0 * storeys + 1.0)).sin();
        let stiffness = 1e3 * mass * (rate / sine).powi(2);
        text += &format!("kind = \"shear\"\nmass = \"{mass:.1} t\"\nstiffness = {stiffness:.4e}\n");
        if random.next() < 0.3 {
            text += "hinges = { rule = \"takeda\", cracking = \"6 mm\", yield = \"25 mm\", post_cracking = 0.5, post_yield = 0.03 }\ndamping = { ratio = 0.03 }\n";
        }
    } else {
        let (wide, side) = (random.between(4.0, 7.0), 0.35 + 0.03 * storeys);
        let depth = wide / random.between(10.0, 12.0);
        text += &format!(
            "spans = [{wide:.1}, {wide:.1}, {wide:.1}]\nconcrete = \"C30\"\nstiffness_factor = 0.5\ncolumn = {{ width = {side:.2}, depth = {side:.2} }}\nbeam = {{ width = 0.3, depth = {depth:.2} }}\nbeam_mass = \"{:.0} kg/m\"\n",
            random.between(2500.0, 5500.0)
        );
    }
    text
}

#[test]
fn two_hundred_sensible_models_raise_at_most_one_note() {
    let mut random = Random(42);
    let mut loud = Vec::new();
    for number in 0..200 {
        let gap = random.between(40.0, 150.0);
        let stiffness = [
            "2e9 N/m^1.5",
            "2.75e9 N/m^1.5",
            "1e10 N/m^1.5",
            "1.8e10 N/m^1.5",
        ];
        let stiffness = stiffness[number % stiffness.len()];
        let height = random.between(2.9, 3.6);
        let text = format!(
            "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"{gap:.0} mm\"\nstiffness = \"{stiffness}\"\n",
            sensible(&mut random, "A", height),
            sensible(&mut random, "B", height)
        );
        loud.extend(too_much(&text, sound(&text)));
    }
    assert!(
        loud.is_empty(),
        "{} of 200:\n{}",
        loud.len(),
        loud.join("\n")
    );
}

#[test]
fn templates_take_the_stiffness_of_the_advice() {
    let with_hertz = PAIRS.into_iter().filter(|name| *name != "heritage");
    for name in ["frames", "towers", "row", "space-frames"]
        .into_iter()
        .chain(with_hertz)
    {
        let text = jostle_io::template(name, "title").expect("it is there");
        let opened = opened(sound(&text));
        let gaps = &opened.input.model.gaps;
        assert!(!gaps.is_empty());
        for (index, gap) in gaps.iter().enumerate() {
            let contacts = opened.system.contacts.iter().filter(|c| c.gap == index);
            let heaviest =
                contacts.max_by(|a, b| a.effective_mass().total_cmp(&b.effective_mass()));
            let masses = heaviest.expect("they touch").struck_masses();
            // With the concrete of both buildings.
            let buildings = opened.input.model.buildings_beside(gap.between);
            let moduli = buildings.map(|side| opened.input.stated.buildings.get(side?)?.modulus);
            let materials = [0, 1].map(|side| SlabMaterial {
                modulus: moduli[side].or(moduli[1 - side]).unwrap_or(30e9),
                ..SlabMaterial::default()
            });
            let range = advised_range(gap.law.kind, materials, masses);
            let ratio = gap.law.stiffness / range.expect("a range").value;
            assert!((0.95..1.05).contains(&ratio), "{name}: {ratio}");
        }
    }
}

/// θ of an elastic storey is P/(k h), whatever it has been through.
#[test]
fn stability_coefficients_of_elastic_storeys_follow_from_weight_and_stiffness() {
    let text = "[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = [\"40 t\", \"30 t\", \"20 t\"]\nstiffness = [\"60 MN/m\", \"50 MN/m\", \"40 MN/m\"]\nstorey_height = [\"4 m\", \"3 m\", \"3 m\"]\n";
    let (_, summary) = run(sound(text), false);
    let g = 9.806_65;
    let due = [
        90e3 * g / (60e6 * 4.0),
        50e3 * g / (50e6 * 3.0),
        20e3 * g / (40e6 * 3.0),
    ];
    for (floor, due) in summary.buildings[0].floors.iter().zip(due) {
        let found = floor
            .response
            .stability_coefficient
            .expect("it was sheared");
        assert!((found / due - 1.0).abs() < 1e-9, "{found} {due}");
    }
}

/// Storeys that yield under 1.5 g: the first page of the report says why nobody may sign it.
#[test]
fn the_first_page_says_that_a_collapse_is_outside_the_model() {
    let text = r#"
[motion]
record = "el-centro-1940-ns"
pga = "1.5 g"
[[building]]
name = "A"
kind = "shear"
storeys = 5
storey_height = "3 m"
mass = "100 t"
stiffness = "80 MN/m"
p_delta = false
hinges = { rule = "takeda", cracking = "3 mm", yield = "12 mm", post_cracking = 0.4, post_yield = 0.02 }
[[building]]
name = "B"
kind = "shear"
storeys = 8
storey_height = "3 m"
mass = "100 t"
stiffness = "90 MN/m"
[[gap]]
between = ["A", "B"]
width = "50 mm"
"#;
    let prepared = opened(sound(text))
        .prepare()
        .unwrap_or_else(|error| panic!("{error}"));
    let ran = prepared.run(Settings::default(), &mut |_, _| ControlFlow::Continue(()));
    let summary = ran.summary();
    assert!(
        summary
            .ended_early
            .as_deref()
            .is_some_and(|why| why.contains("collapses"))
    );
    let report = ran.results(&summary).report().expect("histories");
    let first = report.split("id=\"impacts\"").next().expect("a page");
    let checks = first.split("id=\"checks\"").nth(1).expect("the section");
    for word in [
        "Assumptions and limits",
        "outside the model",
        "P-Delta is not included",
        "ductility",
        "one record",
    ] {
        assert!(checks.contains(word), "{word}");
    }
    // Nothing remains at the end of a run that has none.
    assert!(!is_found(&summary.checks, "residual-drift"));
    let terminal = jostle_run::summary_text(&summary, &ran.prepared.input);
    let lines = |word: &str| {
        terminal
            .lines()
            .filter(|line| line.starts_with(word))
            .count()
    };
    assert_eq!(lines("warning:") + lines("note:"), 3, "{terminal}");
    assert!(terminal.contains("more in"), "{terminal}");
}
