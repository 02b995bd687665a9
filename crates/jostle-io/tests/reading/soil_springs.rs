//! Soil beside floors below ground.

use jostle::hysteresis::{HysteresisRule, Side};
use jostle::{FloorPairs, Link, LinkLaw};
use jostle_testkit::files::{refusal, sound};

fn tower(more: &str) -> String {
    format!(
        r#"
motion = {{ record = "el-centro-1940-ns" }}
[[building]]
name = "A"
kind = "shear"
mass = ["60 t", "60 t", "60 t"]
stiffness = "90 MN/m"
storey_height = "3 m"
{more}
"#
    )
}

fn links(more: &str) -> Vec<Link> {
    let text = tower(&format!("[[building.soil_spring]]\n{more}"));
    sound(&text).model.links
}

#[test]
fn soil_is_links_between_floors_and_the_base() {
    let linear = links("floors = [1, 2]\nstiffness = \"200 MN/m\"\ndashpot = \"2 MN.s/m\"\n");
    assert_eq!(linear.len(), 1);
    let linear = &linear[0];
    assert_eq!(
        (linear.stiffness, linear.damping, linear.law),
        (2e8, 2e6, LinkLaw::Linear)
    );
    assert_eq!(linear.between, [Some(0); 2]);
    assert_eq!(linear.floors, FloorPairs::listed(&[(0, 1), (0, 2)]));

    let yields = links(
        "floors = 1\nstiffness = \"200 MN/m\"\nstrength = \"400 kN\"\npost_yield = 0.1\ndashpot = \"2 MN.s/m\"\n",
    );
    let LinkLaw::Yielding(law) = yields[0].law else {
        panic!("{yields:?}");
    };
    assert_eq!(law.rule(), HysteresisRule::Bilinear);
    assert_eq!(
        (law.backbone().yield_force(), law.backbone().initial()),
        (4e5, 2e8)
    );
    assert_eq!(
        (yields.len(), yields[1].stiffness, yields[1].damping),
        (2, 0.0, 2e6)
    );
}

/// Either side bears one way, and each counts with half its stiffness at rest.
#[test]
fn gaps_have_a_spring_on_either_side() {
    let strong = "strength = \"400 kN\"\n";
    let corners = "hinge = { rule = \"pinched\", pinching = { deformation = 1, force = 1 }, cracking = \"100 kN\", yield = \"400 kN\", post_cracking = 0.3, post_yield = 0.01 }\n";
    for more in ["", strong, corners] {
        let sides = links(&format!(
            "floors = 2\nstiffness = \"200 MN/m\"\ngapping = true\n{more}"
        ));
        let laws = sides.iter().map(|side| match side.law {
            LinkLaw::Yielding(law) => law,
            other => panic!("{other:?}"),
        });
        let laws: Vec<_> = laws.collect();
        assert_eq!(laws.len(), 2);
        assert_eq!(
            laws.iter().map(|own| own.initial_tangent()).sum::<f64>(),
            2e8
        );
        let still = jostle::hysteresis::HysteresisMemory::default();
        for (law, bears) in laws.iter().zip([Side::Negative, Side::Positive]) {
            for side in Side::BOTH {
                let force = law.respond(&still, side.sign() * 1e-4).force;
                assert_eq!(force != 0.0, side == bears, "{more} {side:?}");
            }
        }
    }
}

#[test]
fn faults_say_what_is_missing() {
    for (more, wanted) in [
        ("stiffness = 2e8", "soil_spring[0].floors: is missing"),
        ("floors = 1", "soil_spring[0].stiffness: is missing"),
        (
            "floors = [2, 1]\nstiffness = 2e8",
            "soil_spring[0].floors: must be ascending",
        ),
        (
            "floors = 5\nstiffness = 2e8",
            "soil_spring[0].floors: floor 5 does not exist",
        ),
        (
            "floors = 1\nstiffness = 2e8\npost_yield = 0.1",
            "post_yield: has no meaning without strength",
        ),
        (
            "floors = 1\nstiffness = 2e8\nstrength = 1e5\npost_yield = 1",
            "post_yield: must be at least 0",
        ),
        (
            "floors = 1\nstiffness = 2e8\nstrength = 1e5\nhinge = { rule = \"bilinear\", yield = 1e5, post_yield = 0 }",
            "strength: and hinge are both given",
        ),
        (
            "floors = 1\nstiffness = 2e8\ngapping = true\nhinge = { rule = \"bilinear\", yield = 1e5, post_yield = 0 }",
            "hinge: bilinear has no form that bears compression alone",
        ),
    ] {
        let text = refusal(&tower(&format!("[[building.soil_spring]]\n{more}\n")));
        assert!(text.contains(wanted), "{wanted} in {text}");
    }
    let based = "base = { horizontal_stiffness = \"1 GN/m\" }\n[[building.soil_spring]]\nfloors = 1\nstiffness = 2e8\n";
    let text = refusal(&tower(based));
    assert!(
        text.contains("soil_spring: is not possible under a building whose base moves"),
        "{text}"
    );
}
