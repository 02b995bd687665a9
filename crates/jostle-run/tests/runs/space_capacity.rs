//! Demands over capacities of members of space frames, and of frames at lines of a plan: against plane frames, against histories,
//! and by hand.

use jostle::Settings;
use jostle::results::summary::{MemberSummary, RatioSummary};
use jostle_run::{Ran, summary_text};
use jostle_section::capacity::{Interaction, ObliqueInteraction};
use jostle_section::{Concrete, Reinforcement, Section, Steel, StrengthLevel};
use jostle_testkit::files::{refusal, sound};

use crate::support::{ran, ran_with};

/// Of a column of 400 × 500 mm that bends in the direction of its greater side, and of the same column turned by a quarter.
const COLUMN_BARS: [&str; 2] = [
    "3 d20 top, 3 d20 bottom, 4 d20 sides",
    "4 d20 top, 4 d20 bottom, 2 d20 sides",
];
const BEAM: &str = "width = 0.3, depth = 0.6, steel = \"HRB400\", bars = \"4 d25 top, 3 d25 bottom\", ties = \"d8 @ 150 mm\"";

/// A run of one building without contact, by equal steps.
fn shaken(motion: &str, solver: &str, building: &str) -> Ran {
    let members = match building.contains("space-frame") {
        true => followed(),
        false => "true".to_owned(),
    };
    // A row for every step.
    let settings = Settings {
        record_interval: Some(0.0),
        ..Settings::default()
    };
    let text = format!(
        "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.3 g\"\nduration = \"6 s\"\n{motion}\n[analysis]\n{solver}\n[output]\nmembers = {members}\n[[building]]\nname = \"A\"\nstorey_height = [4.0, 3.2]\ndamping = {{ alpha = 0.3, beta = 0.002 }}\n{building}"
    );
    ran_with(&text, settings)
}

/// Names of all members of two storeys on four crossings.
fn followed() -> String {
    let mut names = Vec::new();
    for storey in 1..=2 {
        for side in 1..=2 {
            let columns = (1..=2).map(|x| format!("\"A.column.{x}.{side}.{storey}\""));
            names.extend(columns);
            names.push(format!("\"A.beam_x.{storey}.1.{side}\""));
            names.push(format!("\"A.beam_y.{storey}.{side}.1\""));
        }
    }
    format!("[{}]", names.join(", "))
}

const EQUAL_STEPS: &str = "solver = \"riccati\"\nstep = \"2 ms\"";

fn column(turned: bool, sizes: &str) -> String {
    let bars = COLUMN_BARS[usize::from(turned)];
    format!(
        "column = {{ {sizes}, steel = \"HRB400\", bars = \"{bars}\", ties = \"d10 @ 150 mm\" }}\n"
    )
}

/// One of two equal frames of one span, whose columns bear equal shares of the weight.
fn plane(axial: &str) -> Ran {
    let column = column(false, "width = 0.4, depth = 0.5");
    let building = format!(
        "kind = \"frame\"\nconcrete = \"C30\"\nspans = [6]\naxial = \"{axial}\"\ncolumn_segments = 1\nbeam_segments = 1\ndensity = 0\nfloor_mass = \"30 t\"\nbeam = {{ {BEAM} }}\n{column}"
    );
    shaken("", EQUAL_STEPS, &building)
}

/// Both at lines of a plan, beside springs across that hardly resist along them.
fn at_lines(axial: &str) -> Ran {
    let column = column(false, "width = 0.4, depth = 0.5");
    let building = format!(
        "kind = \"frame\"\nplan = [6, 7]\nmass = \"60 t\"\n[[building.element]]\nat = [3, 3.5]\nstiffness = {{ x = 0.01, y = 60e6 }}\n[[building.frame]]\nname = \"F\"\nat = [[0, 0], [0, 7]]\nspans = [6]\nconcrete = \"C30\"\naxial = \"{axial}\"\nbeam = {{ {BEAM} }}\n{column}"
    );
    let steps = format!("{EQUAL_STEPS}\naccept_unusual = true");
    shaken("", &steps, &building)
}

/// Both, tied together by rigid floors: along x or, turned by a quarter, across.
fn in_space(motion: &str, solver: &str, turned: bool, axial: &str) -> Ran {
    let (lines, sizes) = match turned {
        false => ("lines_x = [0, 6]\nlines_y = [0, 7]", "size = [0.5, 0.4]"),
        true => ("lines_x = [0, 7]\nlines_y = [0, 6]", "size = [0.4, 0.5]"),
    };
    let column = column(turned, sizes);
    let building = format!(
        "kind = \"space-frame\"\nconcrete = \"C30\"\n{lines}\nmass = \"60 t\"\naxial = \"{axial}\"\nbeam_x = {{ {BEAM} }}\nbeam_y = {{ {BEAM} }}\n{column}"
    );
    shaken(motion, solver, &building)
}

/// Of two columns that are hit at one height, the one without bars is named, although the other is compared with its capacity.
#[test]
fn every_struck_column_is_rated_or_named() {
    let with_bars = column(false, "size = [0.5, 0.4]").replace("column = ", "");
    let with_bars = with_bars.trim();
    let building = |name: &str, at: f64, heights: &str, columns: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"space-frame\"\nat = [{at}, 0]\nstorey_height = {heights}\nlines_x = [0, 6]\nlines_y = [0, 5]\nmass = \"60 t\"\nconcrete = \"C30\"\ncolumn = {columns}\nbeam_x = {{ {BEAM} }}\nbeam_y = {{ {BEAM} }}\n"
        )
    };
    let text = |last: &str| {
        format!(
            "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.4 g\"\nduration = \"4 s\"\n[output]\nmembers = true\n{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nfloors = \"all\"\nlaw = \"hertz-damp\"\nstiffness = 2e9\nrestitution = 0.65\n",
            building("A", 0.0, "[4.0, 3.2]", &format!("[{with_bars}, {last}]")),
            building("B", 6.01, "[2.8, 3.2]", with_bars)
        )
    };
    let named = |last: &str| {
        let summary = ran(&text(last)).summary();
        let unrated = summary
            .checks
            .iter()
            .filter(|check| check.name == "struck-unrated");
        unrated.map(|check| check.text.clone()).collect::<Vec<_>>()
    };
    let found = named("{ x = 2, y = 2, size = [0.5, 0.4] }");
    assert!(
        found.len() == 1
            && found[0].contains("A.column.2.2.")
            && found[0].contains("is hit between floors"),
        "{found:?}"
    );
    let with_all = with_bars.replace("{ size", "{ x = 2, y = 2, size");
    assert_eq!(named(&with_all), Vec::<String>::new());
}

fn members(ran: &Ran) -> Vec<MemberSummary> {
    let buildings = ran.summary().buildings.into_iter();
    buildings.flat_map(|building| building.members).collect()
}

fn named<'a>(members: &'a [MemberSummary], name: &str) -> &'a MemberSummary {
    let found = members.iter().find(|member| member.name == name);
    found.unwrap_or_else(|| panic!("no {name}"))
}

fn all_ratios(member: &MemberSummary) -> Vec<&RatioSummary> {
    member.ratio.iter().chain(&member.other_ratios).collect()
}

/// Every ratio of two members, and its instant.
#[track_caller]
fn same(one: &MemberSummary, other: &MemberSummary, tolerance: f64) {
    let (one_rated, other_rated) = (all_ratios(one), all_ratios(other));
    assert_eq!(one_rated.len(), 5, "{}", one.name);
    for (a, b) in one_rated.into_iter().zip(other_rated) {
        assert_eq!(a.rule, b.rule);
        let close = |a: f64, b: f64, what: &str| {
            assert!(
                a > 0.0 && (a / b - 1.0).abs() < tolerance,
                "{} {}: {what} {a} and {b}",
                one.name,
                other.name
            );
        };
        close(a.bending, b.bending, "bending");
        close(a.bending_at.at_s, b.bending_at.at_s, "instant");
        assert_eq!(a.bending_at.at, b.bending_at.at);
        if let (Some(shear), Some(due)) = (a.shear, b.shear) {
            close(shear, due, "shear");
        } else {
            assert_eq!(a.shear, b.shear);
        }
    }
}

#[test]
fn a_space_frame_of_two_equal_frames_has_the_ratios_of_one() {
    let plane = members(&plane("rigid"));
    for (motion, turned) in [("", false), ("angle = \"90 deg\"", true)] {
        let space = members(&in_space(motion, EQUAL_STEPS, turned, "rigid"));
        for storey in 1..=2 {
            for line in 1..=2 {
                let member = named(&plane, &format!("A.column.{line}.{storey}"));
                for frame in 1..=2 {
                    let name = match turned {
                        false => format!("A.column.{line}.{frame}.{storey}"),
                        true => format!("A.column.{frame}.{line}.{storey}"),
                    };
                    same(named(&space, &name), member, 1e-9);
                }
            }
            let member = named(&plane, &format!("A.beam.{storey}.1"));
            for frame in 1..=2 {
                let name = match turned {
                    false => format!("A.beam_x.{storey}.1.{frame}"),
                    true => format!("A.beam_y.{storey}.{frame}.1"),
                };
                same(named(&space, &name), member, 1e-9);
            }
        }
    }
}

#[test]
fn frames_at_lines_of_a_plan_have_the_ratios_of_plane_frames() {
    let plane = members(&plane("rigid"));
    let found = members(&at_lines("rigid"));
    for plane in &plane {
        let place = plane.name.strip_prefix("A.").expect("its building");
        for frame in ["F.1", "F.2"] {
            same(named(&found, &format!("A.{frame}.{place}")), plane, 1e-8);
        }
    }
}

/// Columns that change their length: neither masses of joints nor beams across move in either building.
#[test]
fn columns_that_shorten_have_the_ratios_of_frames_at_lines() {
    let frames = members(&at_lines("flexible"));
    let space = members(&in_space("", EQUAL_STEPS, false, "flexible"));
    for storey in 1..=2 {
        for line in 1..=2 {
            let member = named(&frames, &format!("A.F.1.column.{line}.{storey}"));
            same(
                named(&space, &format!("A.column.{line}.1.{storey}")),
                member,
                1e-8,
            );
        }
    }
}

/// The greatest ratios are those of all recorded instants, by both moments, both shears and the axial force of each.
#[test]
fn oblique_ratios_are_those_of_the_histories() {
    for (solver, above) in [(EQUAL_STEPS, 1e-9), ("solver = \"modal\"", 0.15)] {
        let ran = in_space("angle = \"40 deg\"", solver, false, "flexible");
        let members = members(&ran);
        let system = &ran.prepared.system;
        let building = &system.buildings[0];
        let history = ran.outcome.member_history.as_ref();
        let Some(history) = history else {
            panic!("recorded")
        };
        let mut oblique = 0;
        for rating in &system.ratings {
            let rated_member = named(&members, &rating.capacity.member);
            // Histories stand in the order of the request.
            let sections =
                |[_, member]: &[usize; 2]| building.members.members[*member].sections.len();
            let place = history.members().iter().position(|[_, member]| {
                let local_name = building.members.members[*member].local_name(&[]);
                format!("A.{local_name}") == rating.capacity.member
            });
            let place = place.expect("followed");
            let first: usize = history.members()[..place].iter().map(sections).sum();
            for (rule, found) in rating.capacity.rules.iter().zip(all_ratios(rated_member)) {
                let mut due = [0.0_f64; 2];
                for forces in history.rows() {
                    for [axial, shear, moment, shear_across, moment_across, _] in
                        &forces[first..first + 2]
                    {
                        let follows = rating.capacity.follows_axial;
                        let compression = rating.capacity.compression_at_rest
                            - if follows { *axial } else { 0.0 };
                        let moments = [*moment, *moment_across];
                        due[0] = due[0].max(rule.bending_ratio(compression, moments));
                        let part = |capacity: Option<&jostle::model::ShearCapacity>, shear: f64| {
                            capacity
                                .map_or(0.0, |capacity| shear.abs() / capacity.at(compression, 1.0))
                        };
                        let across = rule.across.as_ref().and_then(|plane| plane.shear.as_ref());
                        let both =
                            part(rule.shear.as_ref(), *shear).hypot(part(across, *shear_across));
                        due[1] = due[1].max(both);
                    }
                }
                let shear = found.shear.unwrap_or_default();
                for (found, due) in [(found.bending, due[0]), (shear, due[1])] {
                    let within = (due * (1.0 - 1e-9)..=due * (1.0 + above)).contains(&found);
                    assert!(
                        within,
                        "{} {}: {found} for {due}",
                        rated_member.name, rule.rule
                    );
                }
                let at = &found.bending_at;
                if let Some(across) = at.demand_across {
                    let both = at.demand.hypot(across);
                    assert!((both / at.capacity / found.bending - 1.0).abs() < 1e-9);
                    let share = (across / at.demand).abs();
                    oblique += usize::from((0.2..5.0).contains(&share));
                }
            }
        }
        assert!(oblique > 20, "{oblique} oblique moments");
    }
}

/// Shaken towards the other side of y, columns at the other side of the plan bear the same.
#[test]
fn a_mirrored_motion_has_mirrored_ratios() {
    let [one, other] = ["angle = \"40 deg\"", "angle = \"-40 deg\""]
        .map(|motion| members(&in_space(motion, EQUAL_STEPS, false, "flexible")));
    for storey in 1..=2 {
        for line in 1..=2 {
            let [near, far] = [1, 2].map(|y| format!("A.column.{line}.{y}.{storey}"));
            same(named(&one, &near), named(&other, &far), 1e-9);
            same(named(&one, &far), named(&other, &near), 1e-9);
        }
    }
}

/// A single storey on four square columns between stiff beams, moved so slowly along a diagonal of its plan that its floor bears m a at
/// every instant. Each column bears V = m a/4 along the diagonal, and M = V h/2 at foot and head. The column at the corner ahead bears m g/4
/// besides. The couple m a h − 4 M presses on it too, with a quarter of itself per span along either axis.
#[test]
fn a_slow_motion_along_a_diagonal_by_hand() {
    let [mass, height, span, amplitude] = [100e3, 3.5, 6.0, 3.0_f64];
    let beam = "width = 0.6, depth = 2.0, elastic_modulus = \"1000 GPa\"";
    let ran = ran(&format!(
        "[motion]\nkind = \"sine\"\namplitude = {amplitude}\nperiod = 40\nduration = 31\nangle = \"45 deg\"\n[output]\nmembers = true\n[[building]]\nname = \"A\"\nkind = \"space-frame\"\nstorey_height = {height}\nlines_x = [0, {span}]\nlines_y = [0, {span}]\nmass = {mass}\nconcrete = \"C30\"\ndamping = {{ ratio = 0.1 }}\nbeam_x = {{ {beam} }}\nbeam_y = {{ {beam} }}\ncolumn = {{ size = [0.5, 0.5], steel = \"HRB400\", bars = \"12 d20\", ties = \"d10 @ 150 mm\" }}\n"
    ));
    let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
    let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
    let bars = Reinforcement::parse("12 d20").expect("understood");
    let section = Section::new(0.5, 0.5, concrete, steel, &bars, 0.035, None).expect("sound");
    let planes = [&section, &section.turned()].map(Interaction::of_both_signs);
    let surface = ObliqueInteraction::new(&section, &planes).surface(|_| 1.0);
    let shear = mass * amplitude / 4.0;
    let moment = 0.5 * shear * height;
    // Along an axis: of 1/√2 of the motion.
    let couple = (4.0 * shear * height - 4.0 * moment) / 2.0_f64.sqrt();
    let pressed = 2.0 * couple / (2.0 * span);
    let along = moment / 2.0_f64.sqrt();
    let ratio = |compression: f64| surface.ratio(compression, [along, along]);
    let weight = 9.80665 * mass / 4.0;
    let due = [weight - pressed, weight, weight + pressed].map(ratio);
    let members = members(&ran);
    for (name, due) in [
        ("A.column.1.1.1", due[0].max(due[2])),
        ("A.column.2.2.1", due[0].max(due[2])),
        ("A.column.1.2.1", due[1]),
        ("A.column.2.1.1", due[1]),
    ] {
        let ratio = named(&members, name).ratio.as_ref().expect("rated");
        assert!(
            (ratio.bending / due - 1.0).abs() < 5e-3,
            "{name}: {} for {due}",
            ratio.bending
        );
    }
    // The same shear in both directions as one of their vector.
    let corner = named(&members, "A.column.1.2.1")
        .ratio
        .as_ref()
        .expect("rated");
    let at = corner.shear_at.as_ref().expect("ties");
    let across = at.demand_across.expect("two planes");
    assert!((at.demand.hypot(across) / shear - 1.0).abs() < 5e-3);
    assert!((at.demand / across).abs() - 1.0 < 1e-6);
    // Said in the results.
    let text = summary_text(&ran.summary(), &ran.prepared.input);
    assert!(
        text.contains("capacity (gb50010)") && text.contains("A.column."),
        "{text}"
    );
}

/// What would not be used is refused; what is known is used.
#[test]
fn ties_need_bars_and_beams_have_them() {
    let model = |column: &str| {
        format!(
            "[output]\ncapacity = \"aci318\"\n[[building]]\nname = \"A\"\nkind = \"space-frame\"\nstoreys = 1\nlines_x = [0, 6]\nlines_y = [0, 7]\nmass = \"60 t\"\nconcrete = \"C30\"\nbeam_x = {{ {BEAM} }}\nbeam_y = {{ width = 0.3, depth = 0.6 }}\ncolumn = {{ size = [0.5, 0.4]{column} }}\n"
        )
    };
    for key in [
        "ties = \"d10 @ 150 mm\"",
        "steel = \"HRB400\"",
        "cover = \"30 mm\"",
    ] {
        let said = refusal(&model(&format!(", {key}")));
        assert!(said.contains("needs bars"), "{said}");
    }
    let input = sound(&model(""));
    let names: Vec<&str> = (input.model.analysis.members.capacities.iter())
        .map(|capacity| &capacity.member[..])
        .collect();
    assert_eq!(names, ["A.beam_x.1.1.1", "A.beam_x.1.1.2"]);
    // Half the width of a column at either end.
    for beam in &input.members.reinforced {
        assert!(
            (beam.clear_length - 5.5).abs() < 1e-12,
            "{}",
            beam.clear_length
        );
    }
}
