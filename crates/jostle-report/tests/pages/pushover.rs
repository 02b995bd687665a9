//! The page of capacity curves: what its text promises.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::pushover::{
    EquivalentOscillator, LoadPattern, PushDirection, PushSettings, PushedBuilding, Pushover,
    pushover,
};
use jostle::structure::Discretization;
use jostle::system::BuildingSystem;
use jostle::{Building, Frame, FrameHinges, Gravity, Hinges, Section, Structure};
use jostle_motion::Accelerogram;
use jostle_report::{Demand, render_pushover};
use jostle_testkit::models::{self, UNDAMPED, equal_storeys};

/// A frame of two storeys and two unequal bays, under its weight.
pub(crate) fn frame(name: &str) -> BuildingSystem {
    let section = Section {
        flexural_rigidity: 1.2e8,
        axial_rigidity: Some(8e9),
        line_mass: 500.0,
        shear_rigidity: None,
    };
    let corners = Corners {
        cracking: 80e3,
        yielding: 240e3,
        post_cracking: 0.3,
        post_yield: 0.01,
    };
    let backbone = Backbone::from_forces(3e8, corners, corners).unwrap();
    let hinge = Hysteresis::new(HysteresisRule::PeakOriented, backbone).unwrap();
    let building = Building {
        name: name.to_owned(),
        structure: Structure::Frame(Frame {
            beam_mass: vec![6000.0; 2],
            beam_segments: vec![4; 2],
            ..models::frame(2, &[3.0, 6.0], section, section)
        }),
        damping: UNDAMPED,
        hinges: Some(Hinges::Frame(FrameHinges {
            columns: vec![vec![hinge; 3]; 2],
            beams: vec![vec![hinge; 2]; 2],
            ..FrameHinges::default()
        })),
        ..Building::default()
    };
    let mut system = BuildingSystem::new(name, Discretization::new(&building));
    system
        .put_under_gravity(Gravity {
            preload: true,
            p_delta: true,
        })
        .unwrap();
    system
}

pub(crate) fn pushed(building: &BuildingSystem) -> PushedBuilding<'_> {
    let curve = |direction| -> Pushover {
        let settings = PushSettings {
            pattern: LoadPattern::FirstMode,
            direction,
            drift: 0.02,
        };
        pushover(building, settings).unwrap()
    };
    PushedBuilding {
        building,
        curves: [PushDirection::Right, PushDirection::Left]
            .map(curve)
            .to_vec(),
    }
}

#[test]
fn the_page_escapes_names_and_loads_nothing() {
    let building = frame("</script><b>J&1");
    let text = render_pushover("<i>title", &[pushed(&building)], None, &[]);
    assert!(!text.contains("<b>J&1") && !text.contains("<i>title"));
    assert_eq!(
        text.matches("</script>").count(),
        4,
        "data, texts, units and the script"
    );
    let text = text.replace("http://www.w3.org/2000/svg", "");
    for outside in ["http://", "https://", "@import", "src=", "fetch("] {
        assert!(!text.contains(outside), "{outside}");
    }
    assert!(!text.contains("NaN") && !text.contains("inf"));
}

/// Two equal storeys: φ₁ = (√5 − 1)/2, so that m* = 1.618 m and Γ = 1.618/1.382, in exact arithmetic.
#[test]
fn an_elastic_building_pushed_in_its_first_mode_is_an_oscillator_of_its_first_period() {
    let (mass, stiffness) = (4e4, 6e7);
    let building = Building {
        name: "S".into(),
        structure: Structure::Shear(equal_storeys(2, [mass, stiffness])),
        damping: UNDAMPED,
        ..Building::default()
    };
    let system = BuildingSystem::new("S", Discretization::new(&building));
    let push = |pattern| {
        let settings = PushSettings {
            pattern,
            direction: PushDirection::Right,
            drift: 0.01,
        };
        let curve = pushover(&system, settings).unwrap();
        let one = EquivalentOscillator::new(&system, &curve).unwrap();
        (curve, one)
    };
    let (curve, one) = push(LoadPattern::FirstMode);
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let participation = (1.0 + golden) / (1.0 + golden * golden);
    assert!((one.mass / (mass * (1.0 + golden)) - 1.0).abs() < 1e-9);
    assert!((one.participation / participation - 1.0).abs() < 1e-9);
    let last = curve.points.last().unwrap();
    let [displacement, acceleration] = one.spectral(last.roof, last.base_shear);
    let first = 4.0 * stiffness / mass * (std::f64::consts::PI / 10.0).sin().powi(2);
    assert!((acceleration / displacement / first - 1.0).abs() < 1e-9);
    // Loads that rise with the height: φ = ½, 1.
    let (_, one) = push(LoadPattern::Triangular);
    assert!((one.mass / (1.5 * mass) - 1.0).abs() < 1e-12);
    assert!((one.participation - 1.2).abs() < 1e-12);
    let (_, one) = push(LoadPattern::Uniform);
    assert!((one.mass / (2.0 * mass) - 1.0).abs() < 1e-12);
    assert!((one.participation - 1.0).abs() < 1e-12);
}

/// A slow pulse, so strong that the frame yields, and so weak that it does not.
#[test]
fn demand_stands_beside_capacity() {
    let building = frame("J1");
    let pushed = pushed(&building);
    let page = |peak: f64| {
        let wave = |i: u32| peak * (0.09 * f64::from(i)).sin() * (-0.004 * f64::from(i)).exp();
        let motion = Accelerogram::new(0.01, (0..1500).map(wave).collect()).unwrap();
        let demand = Demand {
            name: "a <wave>",
            motion: &motion,
            damping: 0.05,
        };
        render_pushover(
            "two storeys",
            std::slice::from_ref(&pushed),
            Some(&demand),
            &[],
        )
    };
    let weak = page(1e-3);
    assert!(weak.contains("Capacity and demand") && weak.contains("a &lt;wave&gt;"));
    assert_eq!(
        weak.matches("<circle class=\"reached\"").count(),
        2,
        "one for each direction"
    );
    assert!(!weak.contains("NaN") && !weak.contains("inf"));
    // An elastic response is proportional to the motion; its point lies on the demand, at the elastic ordinate.
    let ductility = |text: &str| -> f64 {
        let said = text.split("ductility ").nth(1).unwrap();
        said.split('.')
            .take(2)
            .collect::<Vec<_>>()
            .join(".")
            .split('<')
            .next()
            .unwrap()
            .trim_end_matches('.')
            .parse()
            .unwrap()
    };
    let (one, two) = (ductility(&weak), ductility(&page(2e-3)));
    assert!(one < 0.1 && (two / one - 2.0).abs() < 0.02, "{one}, {two}");
    assert!(ductility(&page(6.0)) > 1.0);
}
