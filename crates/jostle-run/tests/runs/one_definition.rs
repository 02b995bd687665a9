//! What several kinds of buildings report has one definition, and forces that are known are not refused.

use jostle::results::summary::BuildingSummary;
use jostle::statics::STANDARD_GRAVITY;
use jostle::{Solver, System};
use jostle_section::formula::Member;
use jostle_testkit::compare::{close, near};
use jostle_testkit::motions::fading;
use jostle_testkit::{files, runs};

const MOTION: &str = "[motion]\nrecord = \"el-centro-1940-ns\"\nduration = \"2 s\"\n";

/// The only building of a text, in fixed direct steps.
fn shaken(text: &str) -> BuildingSummary {
    shaken_by(text, 4.0)
}

/// The same under a motion of this scale, of either sign \[m/s²\].
fn shaken_by(text: &str, scale: f64) -> BuildingSummary {
    let mut model = files::sound(text).model;
    model.analysis.step = Some(2e-3);
    model.analysis.solver = Some(Solver::Riccati);
    model.analysis.members.envelopes = text.contains("spans");
    let motion = fading("two", 6.0, [scale, 1.6], 200);
    let (_, _, summary) = runs::run_and_summary(&model, &motion);
    summary.buildings.into_iter().next().expect("a building")
}

/// Compressions at rest and clear lengths of columns \[N, m\].
fn columns(text: &str) -> Vec<[f64; 2]> {
    let input = files::sound(text);
    let columns = input.members.reinforced.iter();
    let columns = columns.filter(|member| member.member == Member::Column);
    columns
        .map(|column| [column.compression, column.clear_length])
        .collect()
}

const BARS: &str = "column = { width = \"500 mm\", depth = \"500 mm\", concrete = \"C30\", steel = \"HRB400\", bars = \"12 d20\", ties = \"d10 @ 100 mm\" }\n";

/// Beams of 4 t/m on 10 m without bars, on three columns.
fn members(storeys: usize) -> String {
    format!(
        "spans = [\"6 m\", \"4 m\"]\nelastic_modulus = \"30 GPa\"\n{BARS}beam = {{ width = \"300 mm\", depth = \"500 mm\" }}\ndensity = 0\nbeam_mass = \"4000 kg/m\"\ncolumn_segments = 1\nbeam_segments = 4\naxial = {{ columns = \"rigid\" }}\n# {storeys} storeys\n"
    )
}

fn plane(storeys: usize, keys: &str) -> String {
    format!(
        "{MOTION}[[building]]\nname = \"A\"\nkind = \"frame\"\nstoreys = {storeys}\nstorey_height = \"3 m\"\nfloor_mass = \"5 t\"\np_delta = false\n{}{keys}",
        members(storeys)
    )
}

/// Two such frames at lines of a plan.
fn in_plan(storeys: usize, keys: &str) -> String {
    format!(
        "{MOTION}[[building]]\nname = \"A\"\nkind = \"frame\"\nstoreys = {storeys}\nstorey_height = \"3 m\"\nplan = [\"10 m\", \"8 m\"]\nmass = \"10 t\"\np_delta = false\nstiffness = {{ x = \"0 N/m\", y = \"80 MN/m\", torsion = \"5 GN.m/rad\" }}\n[[building.frame]]\nname = \"f\"\nat = [[\"0 m\", \"1 m\"], [\"0 m\", \"7 m\"]]\n{}{keys}",
        members(storeys)
    )
}

/// Springs of joints let beams turn, whether they can yield or not, and whether the run has weight or not.
#[test]
fn springs_that_can_yield_share_the_weight_as_elastic_ones() {
    let joint = "rotational_stiffness = \"30 MN.m/rad\"";
    let hinge = "hinge = { rule = \"bilinear\", yield = \"5 MN.m\", post_yield = 0.02 }";
    let elastic = format!("joint = {{ {joint} }}\n");
    let yields = format!("joint = {{ {joint}, {hinge} }}\n");
    let [rigid, expected] = ["", &elastic].map(|keys| columns(&plane(1, keys)));
    // What the springs change: some 4 % of the load of the middle column.
    assert!((rigid[1][0] / expected[1][0] - 1.0).abs() > 0.03);
    let weight = STANDARD_GRAVITY * (5e3 + 4e3 * 10.0);
    let all: f64 = expected.iter().map(|column| column[0]).sum();
    near(all, weight, 1e-9, "weight of the frame");
    for text in [plane(1, &yields), in_plan(1, &elastic), in_plan(1, &yields)] {
        let found = columns(&text);
        for (place, (found, expected)) in found.iter().zip(expected.iter().cycle()).enumerate() {
            near(
                found[0],
                expected[0],
                1e-9,
                &format!("column {place} of {text}"),
            );
        }
    }
    // Hinges of the members likewise: those of the run at rest.
    let yields = "hinges = { rule = \"bilinear\", initial = 5, column = { yield = \"9 MN.m\", post_yield = 0.02 }, beam = { yield = \"9 MN.m\", post_yield = 0.02 } }\n";
    let at_rest = shaken_by(&plane(1, &format!("gravity = true\n{yields}")), 1e-9);
    let found = columns(&plane(1, yields));
    for (place, found) in found.iter().enumerate() {
        let name = format!("A.column.{}.1", place + 1);
        let member = at_rest.members.iter().find(|member| member.name == name);
        let end = member.expect("a column").ends[0];
        let mean = -0.5 * (end.axial_max_n + end.axial_min_n);
        near(found[0], mean, 1e-6, &name);
        assert!((rigid[place][0] / found[0] - 1.0).abs() > 0.01, "{name}");
    }
}

/// Storeys less the depths of beams, which have no bars.
#[test]
fn clear_heights_end_at_beams_of_whatever_kind() {
    let space = format!(
        "{MOTION}[[building]]\nname = \"A\"\nkind = \"space-frame\"\nstoreys = 2\nstorey_height = \"3 m\"\nlines_x = [\"0 m\", \"6 m\", \"10 m\"]\nlines_y = [\"0 m\", \"8 m\"]\nmass = \"60 t\"\nelastic_modulus = \"30 GPa\"\n{}beam_x = {{ width = \"300 mm\", depth = \"500 mm\" }}\nbeam_y = {{ width = \"300 mm\", depth = \"400 mm\" }}\n",
        BARS.replace(
            "width = \"500 mm\", depth = \"500 mm\"",
            "size = [\"500 mm\", \"500 mm\"]"
        )
    );
    for text in [plane(2, ""), in_plan(2, ""), space] {
        let found = columns(&text);
        let lowest = found
            .iter()
            .filter(|column| (column[1] - 2.75).abs() < 1e-9);
        let others = found.iter().filter(|column| (column[1] - 2.5).abs() < 1e-9);
        let counts = [lowest.count(), others.count()];
        assert_eq!(counts, [found.len() / 2; 2], "{found:?}\n{text}");
    }
    // Faces of walls end beams.
    let wall = "wall = [{ line = 3, length = \"1.6 m\", thickness = \"250 mm\" }]\nbeam = { width = \"300 mm\", depth = \"500 mm\", concrete = \"C30\", steel = \"HRB400\", bars = \"4 d20 top, 4 d20 bottom\" }\n";
    let text =
        plane(1, wall).replacen("beam = { width = \"300 mm\", depth = \"500 mm\" }\n", "", 1);
    let input = files::sound(&text);
    let beams = input.members.reinforced.iter();
    let beams = beams.filter(|member| member.member == Member::Beam);
    let lengths: Vec<f64> = beams.map(|beam| beam.clear_length).collect();
    assert_eq!(lengths, [6.0 - 0.5, 4.0 - 0.25 - 0.8]);
}

/// Modes across are those of a building that can do nothing else: turned by a right angle, it is damped alike.
#[test]
fn the_twist_of_a_base_does_not_change_damping_across() {
    let alpha = |along: &str, swap: bool| {
        let pair = |x: &str, y: &str| match swap {
            true => format!("x = \"{y} MN/m\", y = \"{x} MN/m\""),
            false => format!("x = \"{x} MN/m\", y = \"{y} MN/m\""),
        };
        let at = |x: &str, y: &str| match swap {
            true => format!("[\"{y} m\", \"{x} m\"]"),
            false => format!("[\"{x} m\", \"{y} m\"]"),
        };
        let elements = [
            ("1", "1", "50", "40"),
            ("11", "6", "40", "60"),
            ("6", "7", "60", "30"),
        ];
        let elements = elements.map(|(x, y, along, across)| {
            format!(
                "{{ at = {}, stiffness = {{ {} }} }}",
                at(x, y),
                pair(along, across)
            )
        });
        let text = format!(
            "{MOTION}[[building]]\nname = \"A\"\nkind = \"shear\"\nstoreys = 2\nstorey_height = \"3 m\"\nplan = {}\nmass = \"100 t\"\nelement = [{}]\ndamping = {{ ratio = 0.05, along = \"{along}\" }}\nbase = {{ horizontal_stiffness = \"900 MN/m\", torsional_stiffness = \"20 GN.m/rad\", mass = \"80 t\" }}\n",
            at("12", "8"),
            elements.join(", ")
        );
        let system = System::assemble(&files::sound(&text).model);
        let system = system.unwrap_or_else(|faults| panic!("{faults:?}"));
        system.buildings[0].equations.alpha
    };
    for swap in [false, true] {
        let [along, across] = [("x", swap), ("y", !swap)].map(|(along, swap)| alpha(along, swap));
        near(across, along, 1e-9, "alpha");
        let both = [alpha("both", swap), alpha("both", !swap)];
        near(both[1], both[0], 1e-9, "alpha of both directions");
    }
}

/// What a foundation that lifts off weighs in the mass that moves does not depend on the kind of the building.
#[test]
fn foundations_that_rise_are_part_of_the_mass_that_moves() {
    let foundation = "gravity = true\nfoundation = { length = \"8 m\", width = \"9 m\", mass = \"80 t\", uplift = true, springs = 5, vertical_stiffness = \"4 GN/m\" ACROSS}\n";
    let storeys = "kind = \"shear\"\nstoreys = 2\nstorey_height = \"3 m\"\nmass = \"130 t\"\n";
    let plane = format!(
        "{MOTION}[[building]]\nname = \"A\"\n{storeys}stiffness = \"200 MN/m\"\n{}",
        foundation.replace("ACROSS", "")
    );
    let plan = format!(
        "{MOTION}[[building]]\nname = \"A\"\n{storeys}plan = [\"8 m\", \"9 m\"]\nstiffness = {{ x = \"200 MN/m\", y = \"200 MN/m\", torsion = \"5 GN.m/rad\" }}\n{}",
        foundation.replace("ACROSS", ", springs_across = 3 ")
    );
    for text in [plane, plan] {
        near(shaken(&text).mass_kg, 340e3, 1e-9, &text);
    }
}

/// Feet that only turn leave the ground where it is.
#[test]
fn dampers_stand_on_the_ground_beside_feet_that_turn() {
    let text = |base: &str| {
        plane(
            1,
            &format!("damper = [{{ floors = [0, 1], damping = \"300 kN.s/m\" }}]\n{base}"),
        )
    };
    let fixed = shaken(&text(""));
    let turns = shaken(&text(
        "base = { rotational_stiffness = \"1e9 MN.m/rad\" }\n",
    ));
    let roof = |building: &BuildingSummary| building.floors[0].response.displacement_max_m;
    near(roof(&turns), roof(&fixed), 1e-6, "displacement of the roof");
}

const COUPLED: &str = "wall = [{ line = 1, length = \"2 m\", thickness = \"250 mm\" }, { line = 2, length = \"1.5 m\", thickness = \"250 mm\" }]\ncoupling_beam = [{ bay = 1, width = \"250 mm\", depth = \"600 mm\" }]\ngravity = true\n";

/// Forces of parts that shorten follow from their deformations, those of rigid ones from masses alone.
#[test]
fn vertical_shaking_is_refused_only_where_forces_lack_it() {
    let vertical = |keys: &str, motion: &str| {
        let text = plane(1, keys).replacen("[[building]]", &format!("{motion}[[building]]"), 1);
        let text = text.replacen("axial = { columns = \"rigid\" }\n", "", 1);
        let input = files::sound(&text);
        let opened = jostle_run::Opened::new(input, "model").unwrap_or_else(|e| panic!("{e}"));
        opened
            .prepare()
            .map(|_| ())
            .map_err(|error| error.to_string())
    };
    let shaking = "vertical = { scale = 0.6 }\n";
    for (rest, asked) in [("", false), ("[output]\nmembers = true\n", true)] {
        let of = |axial: &str| format!("{COUPLED}axial = {{ columns = \"{axial}\" }}\n{rest}");
        assert_eq!(vertical(&of("flexible"), shaking), Ok(()), "{rest}");
        let refused = vertical(&of("rigid"), shaking).expect_err("walls that keep their length");
        let place = if asked {
            "output.members"
        } else {
            "motion.vertical"
        };
        let remedy = "axial = { columns = \"flexible\" }";
        assert!(
            refused.contains(place) && refused.contains(remedy),
            "{refused}"
        );
        assert_eq!(vertical(&of("rigid"), ""), Ok(()), "{rest}");
    }
}

/// The mirror image of a frame moves as the mirror image of the frame: its coupling beam slides at its middle.
#[test]
fn coupling_beams_that_slide_do_not_know_left_from_right() {
    let keys = |lines: [usize; 2]| {
        let coupled = COUPLED
            .replace("line = 1,", &format!("line = {},", lines[0]))
            .replace("line = 2,", &format!("line = {},", lines[1]));
        let bay = lines[0].min(lines[1]);
        let coupled = coupled.replace("bay = 1,", &format!("bay = {bay},"));
        let hinge = "depth = \"600 mm\", hinge = { rule = \"bilinear\", yield = \"60 kN\", post_yield = 0.02 }";
        coupled.replace("depth = \"600 mm\"", hinge)
    };
    for segments in [1, 2, 3, 4] {
        let set = |text: String| {
            text.replace("beam_segments = 4", &format!("beam_segments = {segments}"))
        };
        let ahead = set(plane(2, &keys([1, 2])));
        let mirrored = set(plane(2, &keys([3, 2])));
        let mirrored = mirrored.replace("[\"6 m\", \"4 m\"]", "[\"4 m\", \"6 m\"]");
        let [ahead, back] =
            [(ahead, 4.0), (mirrored, -4.0)].map(|(text, scale)| shaken_by(&text, scale));
        let scale = ahead.floors[1].response.displacement_peak_m();
        for (one, other) in ahead.floors.iter().zip(&back.floors) {
            let (one, other) = (&one.response, &other.response);
            for (one, other) in [
                (one.displacement_max_m, -other.displacement_min_m),
                (one.displacement_min_m, -other.displacement_max_m),
            ] {
                close(other, one, scale, 1e-8, &format!("{segments} segments"));
            }
        }
        let part = |building: &BuildingSummary| {
            let mut parts = building.parts.iter();
            let part = parts
                .find(|part| part.kind == "coupling-beam")
                .expect("there");
            [part.force_max_n, part.force_min_n]
        };
        let [one, other] = [part(&ahead), part(&back)];
        assert!(one[0].max(-one[1]) > 60e3, "it slides: {one:?}");
        for (one, other) in [(one[0], -other[1]), (one[1], -other[0])] {
            close(
                other,
                one,
                60e3,
                1e-7,
                &format!("shear, {segments} segments"),
            );
        }
    }
}

/// Frames that lean towards each other under their weight keep the gap that is given: elastic ones collide as without weight.
#[test]
fn gaps_are_measured_on_buildings_that_bear_their_weight() {
    let leaning = |name: &str, stiff_line: usize, mass: u32, gravity: bool| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = 1\nstorey_height = \"3 m\"\nspans = [\"6 m\"]\ncolumn = [{{ width = \"0.4 m\", depth = \"0.5 m\" }}, {{ width = \"0.4 m\", depth = \"0.8 m\", line = {stiff_line} }}]\nbeam = {{ width = \"0.3 m\", depth = \"0.6 m\" }}\nelastic_modulus = \"30 GPa\"\nbeam_mass = \"{mass} t/m\"\ncolumn_segments = 1\nbeam_segments = 2\np_delta = false\ngravity = {gravity}\n"
        )
    };
    let pair = |gravity: bool| {
        let gap = "[[gap]]\nbetween = [\"P\", \"Q\"]\nwidth = \"0.2 mm\"\nlaw = \"linear\"\nstiffness = \"100 MN/m\"\n";
        let sides = [("P", 1, 12), ("Q", 2, 30)];
        let [left, right] = sides.map(|(name, line, mass)| leaning(name, line, mass, gravity));
        let mut model = files::sound(&format!("{MOTION}{left}{right}{gap}")).model;
        model.analysis.step = Some(1e-3);
        model.analysis.solver = Some(Solver::Riccati);
        let motion = fading("one", 8.0, [4.0, 1.6], 200);
        let (system, _, summary) = runs::run_and_summary(&model, &motion);
        (system.contacts[0].closing_at_rest, summary.gaps[0].clone())
    };
    let (leans, heavy) = pair(true);
    let (straight, light) = pair(false);
    assert!(leans > 5e-4 && straight == 0.0, "{leans} {straight}");
    assert!(light.impact_count > 0);
    assert_eq!(heavy.impact_count, light.impact_count);
    close(
        heavy.peak_force_n,
        light.peak_force_n,
        light.peak_force_n,
        1e-6,
        "force",
    );
    near(heavy.clearance_m, light.clearance_m, 1e-6, "clearance");
    let [heavy, light] = [&heavy, &light].map(|gap| &gap.contacts[0]);
    near(heavy.width_m, 2e-4, 1e-12, "width");
    near(heavy.closing_peak_m, light.closing_peak_m, 1e-6, "closing");
}
