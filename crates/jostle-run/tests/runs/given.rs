//! Buildings given by modes with the flexibility where they are hit, and by flexibilities, against the same as storeys.

use std::f64::consts::TAU;
use std::fmt::Write;

use jostle::Summary;
use jostle_run::Opened;
use jostle_testkit::files::{refusal, sound};

use crate::support::ran;

const FLOORS: usize = 10;
/// Of the building \[N/m\].
const STIFFNESS: [f64; FLOORS] = [14e7, 14e7, 13e7, 12e7, 12e7, 11e7, 10e7, 9e7, 8e7, 6e7];
const MASS: f64 = 8e4;

fn as_storeys() -> String {
    format!(
        "kind = \"shear\"\nstorey_height = \"3 m\"\nstoreys = {FLOORS}\nmass = {MASS}\nstiffness = {STIFFNESS:?}"
    )
}

/// A pair: five storeys, and these keys of the building of ten.
fn pair(keys: &str) -> String {
    format!(
        r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.3 g"
duration = "8 s"
[[building]]
name = "low"
kind = "shear"
storeys = 5
mass = "60 t"
stiffness = "160 MN/m"
storey_height = "3 m"
damping = {{ ratio = 0.05, modes = [1, 3] }}
[[building]]
name = "high"
damping = {{ ratio = 0.05, modes = [1, 3] }}
{keys}
[[gap]]
between = ["low", "high"]
width = "30 mm"
law = "kelvin"
stiffness = "500 MN/m"
restitution = 0.65
[analysis]
tolerance = 1e-5
"#
    )
}

fn run(keys: &str) -> Summary {
    ran(&pair(keys)).summary()
}

fn force(summary: &Summary) -> f64 {
    summary.gaps[0].peak_force_n
}

/// Displacement of floor i under a unit force at floor j, both from 0: that of the storeys below both \[m/N\].
fn flexibility(i: usize, j: usize) -> f64 {
    STIFFNESS[..=i.min(j)].iter().map(|k| 1.0 / k).sum()
}

/// By its first modes.
fn by_modes(count: usize) -> String {
    let opened = Opened::new(sound(&pair(&as_storeys())), "model").expect("it is sound");
    let modes: Vec<_> = opened.system.buildings[1]
        .lateral_modes()
        .take(count)
        .collect();
    let periods: Vec<f64> = modes
        .iter()
        .map(|mode| TAU / mode.circular_frequency)
        .collect();
    let shapes: Vec<_> = modes.iter().map(|mode| mode.shape.clone()).collect();
    format!(
        "kind = \"given\"\nstorey_height = \"3 m\"\nmass = {:?}\nperiods = {periods:?}\nshapes = {shapes:?}\n",
        [MASS; FLOORS]
    )
}

/// The force of an impact hangs on how the floor gives way that is hit. With its flexibility from one static load a few modes find
/// it as all of them do; the highest floor that the neighbour reaches is the one that counts.
#[test]
fn the_flexibility_where_it_is_hit_makes_up_for_modes_left_out() {
    let whole = force(&run(&as_storeys()));
    let hit = flexibility(4, 4);
    for (modes, allowed) in [(5, 0.012), (7, 0.005)] {
        let text = by_modes(modes) + &format!("contact_flexibility = \"{hit:e} m/N\"\n");
        let short = force(&run(&text));
        let off = short / whole - 1.0;
        assert!(off.abs() < allowed, "{modes} modes: {off:.2e}");
        let stated = force(&run(&(text + "contact_floor = 5\n")));
        assert_eq!(short.to_bits(), stated.to_bits());
    }
    // Its own flexibility is what it says.
    let text = by_modes(5) + &format!("contact_flexibility = {hit:e}\ncontact_floor = 7\n");
    let text = refusal(&pair(&text));
    assert!(
        text.contains("floor 7 moves") && text.contains("contact_floor"),
        "{text}"
    );
}

/// Flexibilities of all floors are the building; four digits of them nearly so.
#[test]
fn flexibilities_are_the_building() {
    let by_flexibility = |digits: usize| {
        let mut rows = String::new();
        for i in 0..FLOORS {
            let row = (0..FLOORS).map(|j| format!("{:.*e}", digits - 1, flexibility(i, j)));
            let row: Vec<String> = row.collect();
            let _ = write!(rows, "[{}], ", row.join(", "));
        }
        let ports = (1..=FLOORS).map(|n| format!("\"{n}\" = {{ dof = {n}, height = {} }}", 3 * n));
        let ports: Vec<String> = ports.collect();
        run(&format!(
            "kind = \"given\"\nmatrices = {{ flexibility = [{rows}], mass = {:?} }}\nports = {{ {} }}",
            [MASS; FLOORS],
            ports.join(", ")
        ))
    };
    let (storeys, exact, rounded) = (run(&as_storeys()), by_flexibility(16), by_flexibility(4));
    let peaks = |summary: &Summary| {
        let floors = summary.buildings[1].floors.iter();
        let mut peaks: Vec<f64> = floors
            .map(|floor| floor.response.displacement_max_m)
            .collect();
        peaks.push(force(summary));
        peaks
    };
    let expected = peaks(&storeys);
    for (found, allowed) in [(peaks(&exact), 2e-5), (peaks(&rounded), 5e-3)] {
        for (a, b) in found.iter().zip(&expected) {
            assert!((a / b - 1.0).abs() < allowed, "{a} and {b}");
        }
    }
}
