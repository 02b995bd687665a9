//! Braces and infill panels of frames.

use jostle::hysteresis::Side;
use jostle::{DiagonalKind, Reach, Rise, Structure};
use jostle_testkit::files::{refusal, sound};

const FRAME: &str = r#"
motion = { record = "el-centro-1940-ns" }
[[building]]
name = "A"
storeys = 3
storey_height = 3
spans = [4, 4]
concrete = "C30"
beam_mass = 3000
column = { width = 0.4, depth = 0.4 }
beam = { width = 0.3, depth = 0.5 }
"#;

fn diagonals(more: &str) -> Vec<jostle::Diagonal> {
    let input = sound(&format!("{FRAME}{more}"));
    match &input.model.buildings[0].structure {
        Structure::Frame(frame) => frame.diagonals.clone(),
        other => panic!("{other:?}"),
    }
}

/// Without storeys and bay a table is for all; EA is over the length of the diagonal.
#[test]
fn a_table_stands_for_the_bays_and_storeys_that_it_names() {
    let all = diagonals("[[building.brace]]\nEA = \"500 MN\"\ndirection = \"both\"\n");
    assert_eq!(all.len(), 12);
    assert!((all[0].stiffness / (500e6 / 5.0) - 1.0).abs() < 1e-12);
    let some = diagonals(
        "[[building.brace]]\nstoreys = [2, 3]\nbay = 2\nstiffness = \"80 MN/m\"\ndirection = \"down\"\nhinge = { rule = \"bilinear\", yield = \"200 kN\", post_yield = 0.02 }\n",
    );
    let places: Vec<_> = some
        .iter()
        .map(|diagonal| {
            (
                diagonal.place.storey,
                diagonal.place.bay,
                diagonal.place.rise,
            )
        })
        .collect();
    assert_eq!(places, [(2, 2, Rise::Left), (3, 2, Rise::Left)]);
    assert!(some.iter().all(|own| {
        own.hysteresis
            .is_some_and(|own| own.backbone().yield_force() == 200e3)
    }));
}

/// A profile, its steel and a curve give all of a brace that buckles; the numbers themselves give the same.
#[test]
fn a_profile_buckles_by_its_length() {
    // HEB160 as catalogues print it: A = 54.25 cm², Iz = 889.2 cm⁴, Wpl,z = 170.0 cm³; diagonals of 5 m.
    let (area, inertia, plastic) = (54.25e-4, 889.2e-8, 170.0e-6);
    let braces = diagonals(
        "[[building.brace]]\nprofile = \"HEB160\"\nbay = 1\nhinge = { rule = \"buckling\", curve = \"c\", yield_strength = \"275 MPa\", effective_length = 0.9, later = 0.6, post_yield = 0.01 }\n",
    );
    let law = braces[0].hysteresis.expect("it buckles");
    let stiffness = 210e9 * area / 5.0;
    assert!((braces[0].stiffness / stiffness - 1.0).abs() < 2e-3);
    let yields = area * 275e6;
    assert!((law.backbone().yield_force() / yields - 1.0).abs() < 2e-3);
    let euler = std::f64::consts::PI.powi(2) * 210e9 * inertia / (0.9_f64 * 5.0).powi(2);
    let slenderness = (yields / euler).sqrt();
    let half = 0.5 * (1.0 + 0.49 * (slenderness - 0.2) + yields / euler);
    let buckles = yields / (half + (half * half - yields / euler).sqrt());
    let found = law.backbone().side(Side::Negative).yielding.force;
    assert!((found / buckles - 1.0).abs() < 2e-3, "{found} {buckles}");
    let arm = law.backbone().yield_force().recip() * 275e6 * plastic;
    let by_numbers = diagonals(&format!(
        "[[building.brace]]\nEA = {}\nbay = 1\nhinge = {{ rule = \"buckling\", buckling = {found}, yield = {}, slenderness = {slenderness}, lever_arm = {arm}, effective_length = 0.9, later = 0.6, post_yield = 0.01 }}\n",
        braces[0].stiffness * 5.0,
        law.backbone().yield_force(),
    ));
    let other = by_numbers[0].hysteresis.expect("it buckles");
    for shortened in [0.004, 0.01, 0.03, 0.08] {
        let [a, b] = [law, other].map(|law| law.respond(&Default::default(), -shortened).force);
        assert!((a / b - 1.0).abs() < 3e-3, "{a} {b}");
    }
}

/// A panel is two struts of E w t / d that bear compression alone.
#[test]
fn a_panel_is_two_struts_without_tension() {
    let struts = diagonals(
        "[[building.infill]]\nstoreys = 3\nbay = 1\nmodulus = \"4 GPa\"\nthickness = \"200 mm\"\nwidth = \"1.25 m\"\n",
    );
    assert_eq!(struts.len(), 2);
    for strut in struts {
        assert_eq!(strut.place.kind, DiagonalKind::Infill);
        let stiffness = 4e9 * 0.2 * 1.25 / 5.0;
        assert!((strut.stiffness / stiffness - 1.0).abs() < 1e-12);
        let law = strut.hysteresis.expect("it lifts off");
        let force = |deformation| law.respond(&Default::default(), deformation).force;
        assert_eq!(force(1e-3), 0.0);
        assert!((force(-1e-3) / (-1e-3 * stiffness) - 1.0).abs() < 1e-12);
    }
}

/// Every mistake names its key and a remedy.
#[test]
fn mistakes_are_explained() {
    for (text, expected) in [
        ("[[building.brace]]\nbay = 1\n", "building[0].brace[0].EA"),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nstiffness = \"80 MN/m\"\n",
            "and stiffness are both given",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nbay = 3\n",
            "must be within 1 to 2, found 3",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nstoreys = [3, 4]\n",
            "must be ascending, within 1 to 3, found 3 to 4",
        ),
        (
            "[[building.brace]]\nEA = \"-1 GN\"\n",
            "building[0].brace[0].EA",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\n[[building.brace]]\nEA = \"2 GN\"\nstoreys = 1\n",
            "gives brace.1.1.up a second time",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\ndirection = \"left\"\n",
            "available: up, down, both",
        ),
        (
            "[[building.brace]]\nprofile = \"HEB160\"\nhinge = { rule = \"buckling\", yield_strength = \"275 MPa\" }\n",
            "add curve = \"c\"",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nhinge = { rule = \"buckling\", curve = \"c\", yield_strength = \"275 MPa\" }\n",
            "has no meaning without a profile",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nhinge = { rule = \"buckling\", curve = \"c\", yield = \"1 MN\", slenderness = 1.2 }\n",
            "add lever_arm",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nhinge = { rule = \"buckling\", buckling = \"800 kN\", yield = \"1 MN\", slenderness = 1.2, lever_arm = \"5 cm\" }\n",
            "at most Euler's force",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nhinge = { rule = \"buckling\", buckling = \"400 kN\", curve = \"c\", yield = \"1 MN\", slenderness = 1.2, lever_arm = \"5 cm\" }\n",
            "and buckling are both given",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nhinge = { rule = \"bilinear\", curve = \"c\", yield = \"1 MN\", post_yield = 0.1 }\n",
            "has no meaning with the rule bilinear",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\naxis = \"weak\"\n",
            "has no meaning without a profile",
        ),
        (
            "[[building.damper]]\nfloors = [0, 1]\nlaw = \"yielding\"\nstiffness = \"80 MN/m\"\nhinge = { rule = \"buckling\", yield = \"1 MN\" }\n",
            "is a rule of braces alone",
        ),
        (
            "brace = \"X\"\n",
            "write [[building.brace]] with double brackets",
        ),
        (
            "[[building.infill]]\nmodulus = \"4 GPa\"\nthickness = \"200 mm\"\n",
            "building[0].infill[0].width",
        ),
        (
            "[[building.infill]]\nstiffness = \"80 MN/m\"\nwidth = \"1 m\"\n",
            "and stiffness are both given",
        ),
        (
            "[[building.infill]]\nstiffness = \"80 MN/m\"\nhinge = { rule = \"bilinear\", yield = \"100 kN\", post_yield = 0.1 }\n",
            "bilinear has no form that bears compression alone; take pinched",
        ),
        (
            "[[building.brace]]\nEA = \"1 GN\"\nhinge = { rule = \"bilinear\", yield = \"100 kN\", post_yield = -0.1, residual = 0.2 }\n",
            "only springs with the rule pinched lose force",
        ),
        (
            &pinched("post_yield = -0.1"),
            "must lie between 0 and 1, a ratio to the initial stiffness; found -0.1",
        ),
        (
            &pinched("post_yield = 0.1\nresidual = 0.2"),
            "must lie between -1 and 0, found 0.1; leave residual out for a line that rises",
        ),
        (
            &pinched("post_yield = -0.1\nresidual = 1.2"),
            "must be greater than 0 and less than 1, a share of the yield force; found 1.2",
        ),
        (
            &masonry("width = \"mainstonne\""),
            "did you mean \"mainstone\"?",
        ),
        (
            &masonry("width = \"holmes\"\nopening = 0.7"),
            "leave the panel out where openings take two thirds of its length or more",
        ),
        (
            &masonry("width = \"holmes\"\nopening = 1.5"),
            "must be a share, at least 0 and less than 1; found 1.5",
        ),
        (
            &masonry("width = \"holmes\"\nbackbone = \"bertoldi\""),
            "backbone: needs a strength",
        ),
        (
            &masonry("width = \"holmes\"\nstrength = { rule = \"bertoldi\" }"),
            "add compression = \"4 MPa\"",
        ),
        (
            &masonry("width = \"holmes\"\nforce = \"200 kN\"\nbackbone = \"panagiotakos-fardis\""),
            "write backbone = { rule = \"panagiotakos-fardis\", softening = 0.05, residual = 0.1 }",
        ),
        (
            &masonry(
                "width = \"3 m\"\nforce = \"200 kN\"\nbackbone = { rule = \"panagiotakos-fardis\", shear_modulus = \"0.1 GPa\", softening = 0.05, residual = 0.1 }",
            ),
            "gives no curve that rises to the strength",
        ),
        (
            &masonry(
                "width = \"holmes\"\nforce = \"200 kN\"\nhinge = { rule = \"pinched\", cracking = \"100 kN\", yield = \"160 kN\", post_cracking = 0.12, post_yield = 0.01, pinching = {} }",
            ),
            "hinge states all corners, strength finds them",
        ),
        (
            "[[building.infill]]\nstiffness = \"80 MN/m\"\nforce = \"200 kN\"\n",
            "give modulus, thickness and width instead of stiffness",
        ),
    ] {
        let shown = refusal(&format!("{FRAME}{text}"));
        assert!(shown.contains(expected), "{text}\n{shown}");
    }
}

/// A panel of masonry of a size, with some more keys.
fn masonry(more: &str) -> String {
    format!("[[building.infill]]\nmodulus = \"4 GPa\"\nthickness = \"200 mm\"\n{more}\n")
}

/// Width and strength of the rules for each bay, with what an opening leaves; the first slope is four times the secant.
#[test]
fn rules_give_a_panel_its_strut() {
    let panel = |more: &str| {
        let text = format!(
            "[[building.infill]]\nstoreys = 1\nbay = 1\nmodulus = \"4 GPa\"\nthickness = \"200 mm\"\n{more}\n"
        );
        diagonals(&text).remove(0)
    };
    let rigidity = 30e9 * 0.4_f64.powi(4) / 12.0;
    // sin 2θ = 2 · 0.6 · 0.8.
    let relative = 3.0 * (4e9 * 0.2 * 0.96 / (4.0 * rigidity * 3.0)).powf(0.25);
    let due = |share: f64| 4e9 * 0.2 * share;
    for (width, share) in [
        ("mainstone", 0.175 * relative.powf(-0.4)),
        ("bertoldi", 1.3 / relative - 0.178),
        ("paulay-priestley", 0.25),
        ("holmes", 1.0 / 3.0),
    ] {
        let strut = panel(&format!("width = \"{width}\""));
        assert!(
            (strut.stiffness / due(share) - 1.0).abs() < 1e-12,
            "{width}"
        );
        let opened = panel(&format!("width = \"{width}\"\nopening = 0.2"));
        assert!((opened.stiffness / due(0.7 * share) - 1.0).abs() < 1e-12);
    }
    let by_area = panel("width = \"holmes\"\nopening = { length = 0.2, area = 0.1 }");
    let left = 0.55 * (-0.35_f64).exp() + 0.44 * (-0.5_f64).exp();
    assert!((by_area.stiffness / due(left / 3.0) - 1.0).abs() < 1e-12);
    let cracked = panel("width = \"1 m\"\nforce = \"200 kN\"\nopening = 0.2");
    let secant = 0.7 * due(1.0 / 5.0);
    assert!((cracked.stiffness / (4.0 * secant) - 1.0).abs() < 1e-12);
    let curve = |diagonal: &jostle::Diagonal| {
        *diagonal
            .hysteresis
            .expect("it cracks")
            .backbone()
            .side(Side::Negative)
    };
    let yielding = curve(&cracked).yielding;
    assert!((yielding.force - 140e3).abs() < 1e-6);
    assert!((yielding.deformation - 140e3 / secant).abs() < 1e-12);
    let slides = panel(
        "width = \"1 m\"\nstrength = { rule = \"sliding\", sliding = \"0.2 MPa\", vertical_stress = \"0.1 MPa\" }\nbackbone = { rule = \"panagiotakos-fardis\", softening = 0.05, residual = 0.1 }",
    );
    let strength = 0.24e6 * 4.0 * 0.2 / 0.8;
    assert!((curve(&slides).cracking.force / strength - 1.0).abs() < 1e-12);
    assert!((curve(&slides).yielding.force / (1.3 * strength) - 1.0).abs() < 1e-12);
    let first = 0.4 * 4e9 * 4.0 * 0.2 / 3.0 / 0.64;
    assert!((slides.stiffness / first - 1.0).abs() < 1e-12);
    let least = panel(
        "width = \"mainstone\"\nstrength = { rule = \"bertoldi\", compression = \"5 MPa\", shear = \"0.3 MPa\", sliding = \"0.9 MPa\" }",
    );
    let cracking = 0.6 * 0.3e6 * 5.0 * 0.2;
    assert!((curve(&least).yielding.force / cracking - 1.0).abs() < 1e-12);
}

/// A panel whose struts crack, with some more keys.
fn pinched(more: &str) -> String {
    format!(
        "[[building.infill]]\nstiffness = \"80 MN/m\"\n[building.infill.hinge]\nrule = \"pinched\"\ncracking = \"100 kN\"\nyield = \"160 kN\"\npost_cracking = 0.12\npinching = {{ deformation = 0.8, force = 0.1 }}\n{more}\n"
    )
}

/// Struts that crack bear compression alone, and their force falls to a residual.
#[test]
fn panels_crack_in_compression() {
    let text = pinched("post_yield = -0.05\nresidual = 0.25");
    for diagonal in diagonals(&text) {
        let law = diagonal.hysteresis.expect("it cracks");
        let [tension, compression] = Side::BOTH.map(|side| *law.backbone().side(side));
        assert_eq!(tension.force_at(0.1), 0.0);
        assert!((compression.force_at(1.0) - 40e3).abs() < 1e-6);
        assert_eq!(compression.yielding.force, 160e3);
    }
}

/// Arching by hand: 0.7 × 3 MPa × 0.047 / 12.5, and 3 MPa / 12.5², on 280 kg/m².
#[test]
fn panels_bear_pressure_across_their_plane() {
    let panel = |more: &str| {
        format!(
            "[[building.infill]]\nbay = 1\nmodulus = \"4 GPa\"\nthickness = \"200 mm\"\nwidth = \"1.2 m\"\n{more}\n"
        )
    };
    for (more, strength) in [
        (
            "out_of_plane = { rule = \"asce41\", compression = \"3 MPa\", density = \"1400 kg/m3\", height = \"2.5 m\" }",
            0.7 * 3e6 * 0.047 / 12.5,
        ),
        (
            "out_of_plane = { rule = \"en1996\", density = \"1400 kg/m3\", height = \"2.5 m\" }\nstrength = { rule = \"bertoldi\", compression = \"3 MPa\", shear = \"0.3 MPa\", sliding = \"0.2 MPa\" }",
            3e6 / 156.25,
        ),
        // Storeys of 3 m.
        (
            "out_of_plane = { rule = \"en1996\", compression = \"3 MPa\", density = \"1400 kg/m3\" }",
            3e6 / 225.0,
        ),
        (
            "out_of_plane = { strength = \"4 kPa\", density = \"1400 kg/m3\" }\nopening = 0.2",
            4e3,
        ),
    ] {
        let all = diagonals(&panel(more));
        let falling = diagonals(&panel(&more.replace("density", "remove = true, density")));
        for (diagonal, falling) in all.iter().zip(&falling) {
            let across = diagonal.across.expect("it is compared");
            let falls = falling.across.expect("it is compared");
            assert!(falls.falls && !across.falls);
            assert!(
                (across.strength / strength - 1.0).abs() < 1e-12,
                "{more}: {across:?}"
            );
            assert!((across.surface_mass - 280.0).abs() < 1e-9);
        }
    }
    for (more, part) in [
        (
            "out_of_plane = { rule = \"asce41\", density = 1400 }",
            "add compression",
        ),
        (
            "out_of_plane = { rule = \"asce41\", compression = \"3 MPa\", density = 1400 }\nopening = 0.2",
            "cannot arch around an opening",
        ),
        (
            "out_of_plane = { rule = \"asce41\", compression = \"3 MPa\", density = 1400, height = 6 }",
            "30.0 times as high as thick",
        ),
        ("out_of_plane = { density = 1400 }", "add rule"),
        (
            "out_of_plane = { rule = \"asce41\", strength = 3e3, compression = \"3 MPa\", density = 1400 }",
            "and rule are both given",
        ),
    ] {
        let text = refusal(&format!("{FRAME}{}", panel(more)));
        assert!(text.contains(part), "{more}: {text}");
    }
}

const PANEL: &str = "[[building.infill]]\nbay = 1\nstoreys = 2\nmodulus = \"4 GPa\"\nthickness = \"200 mm\"\nwidth = \"1 m\"\nforce = \"150 kN\"\n";

/// Three struts together have the stiffness and the strength of one, and stand where they are said to.
#[test]
fn panels_have_struts_off_the_joints() {
    let one = diagonals(PANEL);
    let off = diagonals(&format!("{PANEL}offset = \"300 mm\"\n"));
    assert_eq!((one.len(), off.len()), (2, 2));
    for (one, off) in one.iter().zip(&off) {
        assert_eq!((one.offsets, off.offsets), ([0.0; 2], [0.3; 2]));
        assert_eq!(
            (one.stiffness, one.hysteresis),
            (off.stiffness, off.hysteresis)
        );
    }
    let three = diagonals(&format!(
        "{PANEL}struts = 3\ncentral_share = 0.5\noffset = \"300 mm\"\n"
    ));
    let offsets: Vec<_> = three.iter().map(|three| three.offsets).collect();
    let each = [[0.0, 0.0], [0.3, 0.0], [0.0, 0.3]];
    assert_eq!(offsets, [each, each].concat());
    let shares = [0.5, 0.25, 0.25];
    for (three, share) in three.iter().zip(shares.iter().cycle()) {
        let [law, whole] = [three, &one[0]].map(|strut| strut.hysteresis.expect("it cracks"));
        assert!((three.stiffness / one[0].stiffness - share).abs() < 1e-12);
        for shortening in [1e-4, 2e-3, 3e-2] {
            let [part, all] = [law, whole].map(|law| law.backbone().force_at(-shortening));
            assert!((part / all - share).abs() < 1e-12, "{part} {all}");
        }
    }
    let names: Vec<_> = three.iter().map(|three| three.place.to_string()).collect();
    assert_eq!(
        names[..3],
        ["infill.2.1.up", "infill.2.1.up.foot", "infill.2.1.up.head"]
    );
}

/// The drift of a bay of 4 by 3 m is the shortening of its diagonal of 5 m times 5/12.
#[test]
fn panels_are_damaged_by_drift() {
    let usual = diagonals(PANEL)[0].damage.expect("judged");
    assert_eq!(usual.drifts, [0.0018, 0.0046, 0.0105, 0.0188]);
    assert!((usual.drift_per_shortening - 5.0 / 12.0).abs() < 1e-15);
    let diagonals = diagonals(&format!(
        "{PANEL}damage_drifts = [0.001, 0.002, 0.003, 0.004]\n"
    ));
    assert_eq!(
        diagonals[1].damage.expect("judged").drifts,
        [0.001, 0.002, 0.003, 0.004]
    );
    for (more, wanted) in [
        (
            "damage_drifts = [0.002, 0.001, 0.003, 0.004]",
            "must be four drifts that rise",
        ),
        (
            "damage_drifts = [0.001, 0.002]",
            "must be four drifts that rise",
        ),
        (
            "offset = \"0.8 m\"",
            "offset: infill.2.1.up meets column 1 0.8 m from the joint; give 0 to a quarter of the storey, 0.75 m",
        ),
        ("offset = \"-0.1 m\"", "offset: must not be negative"),
        ("struts = 2", "struts: must be 1 or 3"),
        ("struts = 3\noffset = 0.3", "central_share: is missing"),
        ("struts = 3\ncentral_share = 0.5", "offset: is missing"),
        (
            "central_share = 0.5",
            "central_share: has no meaning for one strut",
        ),
        (
            "struts = 3\noffset = 0.3\ncentral_share = 1",
            "must be greater than 0 and less than 1",
        ),
    ] {
        let text = refusal(&format!("{FRAME}{PANEL}{more}\n"));
        assert!(text.contains(wanted), "{wanted} in {text}");
    }
}

/// Half of every panel on the floor above, half on that below, and none without the key.
#[test]
fn panels_have_mass_where_it_is_asked() {
    let masses = |more: &str| {
        let panel = "[[building.infill]]\nstoreys = [1, 2]\nbay = 1\nmodulus = \"4 GPa\"\nthickness = 0.2\nwidth = \"1 m\"\n";
        let input = sound(&format!("{FRAME}{panel}{more}"));
        match &input.model.buildings[0].structure {
            Structure::Frame(frame) => frame.floor_mass.clone(),
            other => panic!("{other:?}"),
        }
    };
    let close = |found: Vec<f64>, due: [f64; 3]| {
        let same = found
            .iter()
            .zip(due)
            .all(|(found, due)| (found - due).abs() < 1e-9);
        assert!(same && found.len() == 3, "{found:?}, not {due:?}");
    };
    close(masses(""), [0.0; 3]);
    // 1400 kg/m³, 200 mm, 4 m, 3 m: 3360 kg.
    close(masses("density = 1400\n"), [3360.0, 1680.0, 0.0]);
    close(
        masses("density = 1400\nopening = 0.2\n"),
        [3360.0, 1680.0, 0.0],
    );
    close(
        masses(
            "density = 1400\nopening = { length = 0.2, area = 0.1 }\nstruts = 3\ncentral_share = 0.5\noffset = 0.3\n",
        ),
        [3024.0, 1512.0, 0.0],
    );
    close(masses("mass = \"2 t\"\n"), [2000.0, 1000.0, 0.0]);
    for (more, problem) in [
        (
            "density = 1400\nmass = 2000\nstiffness = 8e7\n",
            "density: and mass are both given",
        ),
        (
            "density = 1400\nstiffness = 8e7\n",
            "needs the thickness of the panel",
        ),
        (
            "mass = 0\nstiffness = 8e7\n",
            "mass: must be greater than zero",
        ),
    ] {
        let said = refusal(&format!("{FRAME}[[building.infill]]\n{more}"));
        assert!(said.contains(problem), "{problem}: {said}");
    }
}

/// Between any two joints: from below, whichever is named first, with EA over the length between them.
#[test]
fn a_brace_joins_two_joints_by_name() {
    let found = |ends: &str| diagonals(&format!("[[building.brace]]\n{ends}EA = \"500 MN\"\n"))[0];
    for (ends, floors, lines, rise, length, name) in [
        (
            "from = \"0.1\"\nto = \"3.3\"\n",
            [0, 3],
            [0, 2],
            Rise::Right,
            8.0_f64.hypot(9.0),
            "brace.0.1.to.3.3",
        ),
        (
            "from = \"3.1\"\nto = \"1.3\"\n",
            [1, 3],
            [2, 0],
            Rise::Left,
            8.0_f64.hypot(6.0),
            "brace.1.3.to.3.1",
        ),
        (
            "from = \"1.2\"\nto = \"0.1\"\n",
            [0, 1],
            [0, 1],
            Rise::Right,
            5.0,
            "brace.1.1.up",
        ),
    ] {
        let brace = found(ends);
        assert_eq!((brace.place.floors(), brace.place.lines()), (floors, lines));
        assert_eq!(
            (brace.place.rise, brace.place.to_string().as_str()),
            (rise, name)
        );
        assert!((brace.stiffness / (500e6 / length) - 1.0).abs() < 1e-12);
    }
    assert_eq!(
        found("from = \"1.2\"\nto = \"0.1\"\n").place.reach,
        Reach::BAY
    );
    let tables = |more: &str| {
        refusal(&format!(
            "{FRAME}[[building.brace]]\nEA = \"500 MN\"\n{more}"
        ))
    };
    for (more, problem) in [
        (
            "from = \"0.1\"\nto = \"0.1\"\n",
            "to: is the joint at which it begins",
        ),
        (
            "from = \"2.1\"\nto = \"2.3\"\n",
            "to: is at floor 2 as well",
        ),
        ("from = \"0.1\"\n", "to: is missing"),
        (
            "from = \"0.1\"\nto = \"4.1\"\n",
            "\"4.1\" is no joint of the frame",
        ),
        ("from = \"0.1\"\nto = \"1.0\"\n", "column lines from 1 to 3"),
        ("from = \"0.1\"\nto = \"roof\"\n", "write FLOOR.LINE"),
        (
            "from = \"0.1\"\nto = \"2.2\"\nbay = 1\n",
            "bay: cannot be combined with from and to",
        ),
        (
            "from = \"0.1\"\nto = \"2.2\"\n[[building.brace]]\nfrom = \"2.2\"\nto = \"0.1\"\nEA = \"9 MN\"\n",
            "gives brace.0.1.to.2.2 a second time",
        ),
    ] {
        let said = tables(more);
        assert!(said.contains(problem), "{problem}: {said}");
    }
    let rigid = FRAME.replace("spans = ", "axial = \"rigid\"\nspans = ");
    let said = refusal(&format!(
        "{rigid}[[building.brace]]\nEA = \"500 MN\"\nfrom = \"0.1\"\nto = \"2.1\"\n"
    ));
    assert!(said.contains("next to axially rigid columns"), "{said}");
    // A line that ends below: the nearest joint is named.
    let set_back = format!(
        "{}[[building.column]]\nwidth = 0.4\ndepth = 0.4\n[[building.column]]\nline = 3\nstoreys = [2, 3]\nomit = true\n[[building.brace]]\nfrom = \"0.1\"\nto = \"3.3\"\nEA = \"500 MN\"\n",
        FRAME.replace("column = { width = 0.4, depth = 0.4 }\n", "")
    );
    let said = refusal(&set_back);
    assert!(said.contains("the nearest joint is \"3.2\""), "{said}");
}
