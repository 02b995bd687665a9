//! Text models of ETABS and SAP2000 against the same frame as a model file.

use std::fmt::Write;

use jostle_import::{ImportOptions, Program};
use jostle_testkit::files::sound;

use crate::book::{difference, imported, model, periods};
use crate::tables::MOTION;

const LINES: [&[f64]; 2] = [&[0.0, 6.0, 11.0], &[0.0, 5.0, 9.0]];
const LEVELS: [f64; 2] = [4.0, 7.2];
/// Mass \[t\], inertia \[t·m²\], centre \[m\].
const MASSES: [[f64; 4]; 2] = [[95.0, 1300.0, 5.2, 4.3], [80.0, 1100.0, 5.1, 4.4]];

/// The frame: a corner is missing, a column is deeper across, and beams across the first line are another concrete.
pub(crate) const EXPECTED: &str = r#"
[[building]]
name = "A"
kind = "space-frame"
lines_x = ["0 m", "6 m", "11 m"]
lines_y = ["0 m", "5 m", "9 m"]
storey_height = ["4 m", "3.2 m"]
mass = ["95 t", "80 t"]
polar_mass = ["1.3e6 kg.m2", "1.1e6 kg.m2"]
mass_centre = [["5.2 m", "4.3 m"], ["5.1 m", "4.4 m"]]
elastic_modulus = "30 GPa"
poisson_ratio = 0.2
stiffness_factor = { column = 0.7, beam = 0.35 }
torsion_factor = 0.1
shear = "flexible"
[[building.column]]
size = ["0.5 m", "0.5 m"]
[[building.column]]
x = 1
y = 2
size = ["0.4 m", "0.8 m"]
[[building.column]]
x = 3
y = 3
omit = true
[[building.beam_x]]
width = "0.3 m"
depth = "0.6 m"
[[building.beam_x]]
x = 2
y = 3
omit = true
[[building.beam_y]]
width = "0.3 m"
depth = "0.6 m"
[[building.beam_y]]
x = 1
elastic_modulus = "25 GPa"
width = "0.3 m"
depth = "0.6 m"
[[building.beam_y]]
x = 3
y = 2
omit = true
"#;

/// Columns, beams along x and across: ends as line numbers, and the section.
fn members() -> Vec<([usize; 2], [usize; 2], &'static str)> {
    let there = |[x, y]: [usize; 2]| !(x == 2 && y == 2);
    let mut found = Vec::new();
    for x in 0..3 {
        for y in 0..3 {
            let at = [x, y];
            let pieces = [
                (at, if x == 0 && y == 1 { "C 400*700" } else { "C1" }),
                ([x + 1, y], "B1"),
                ([x, y + 1], if x == 0 { "B2" } else { "B1" }),
            ];
            found.extend(
                pieces
                    .into_iter()
                    .filter(|(end, _)| end[0] < 3 && end[1] < 3 && there(at) && there(*end))
                    .map(|(end, section)| (at, end, section)),
            );
        }
    }
    found
}

fn point(at: [usize; 2]) -> String {
    // Not numbers alone.
    format!("{}-{}", at[0] + 1, at[1] + 1)
}

/// As ETABS writes it in N and mm, with Windows-1252 in a title, UNITS twice, and a comment.
pub(crate) fn e2k() -> String {
    let mut text = String::from(
        "$ File C:\\model.EDB saved 7.6.2026\r\n\r\n$ PROGRAM INFORMATION\r\n  PROGRAM  \"ETABS\"  VERSION \"22.5.0\"\r\n\r\n$ CONTROLS\r\n  UNITS  \"N\"  \"MM\"  \"C\"  \r\n  UNITS  \"N\"  \"MM\"  \"C\"  \r\n  TITLE1  \"A \u{96} B\"  \r\n  PREFERENCE  MERGETOL 0,00254\r\n\r\n$ STORIES - IN SEQUENCE FROM TOP\r\n  STORY \"Roof slab\"  HEIGHT 3200 MASTERSTORY \"Yes\"  \r\n  STORY \"1\"  HEIGHT 4000 SIMILARTO \"Roof slab\"  \r\n  STORY \"Base\"  ELEV -1500 \r\n\r\n$ DIAPHRAGM NAMES\r\n  DIAPHRAGM \"D1\"    TYPE RIGID\r\n  DIAPHRAGM \"D9\"    TYPE SEMIRIGID\r\n\r\n$ MATERIAL PROPERTIES\r\n  MATERIAL  \"M30\"    TYPE \"Concrete\"    WEIGHTPERVOLUME 2.5E-05\r\n  MATERIAL  \"M30\"    SYMTYPE \"Isotropic\"  E 30000  U 0.2  A 1E-05\r\n  MATERIAL  \"M25\"    SYMTYPE \"Isotropic\"  E 25000  U 0.2  A 1E-05\r\n\r\n$ FRAME SECTIONS\r\n",
    );
    // The name of a section lies.
    for (name, material, depth, width, factor) in [
        ("C1", "M30", 500, 500, 0.7),
        ("C 400*700", "M30", 800, 400, 0.7),
        ("B1", "M30", 600, 300, 0.35),
        ("B2", "M25", 600, 300, 0.35),
    ] {
        let _ = write!(
            text,
            "  FRAMESECTION  \"{name}\"  MATERIAL \"{material}\"  SHAPE \"Concrete Rectangular\"  D {depth} B {width} \r\n  FRAMESECTION  \"{name}\"  JMOD 0.1 I2MOD {factor} I3MOD {factor} \r\n"
        );
    }
    text += "\r\n$ POINT COORDINATES\r\n";
    for x in 0..3 {
        for y in 0..3 {
            // Coordinates of one line differ a little.
            let off = if y == 1 { 0.3 } else { 0.0 };
            let _ = write!(
                text,
                "  POINT \"{}\"  {} {} \r\n",
                point([x, y]),
                LINES[0][x] * 1e3 + off,
                LINES[1][y] * 1e3
            );
        }
    }
    // A beam of the lower floor, drawn from the upper storey: the third number is the depth below it.
    text += "  POINT \"landing\"  6000 5000 1500 \r\n  POINT \"low 1\"  0 0 3200 \r\n  POINT \"low 2\"  6000 0 3200 \r\n\r\n$ LINE CONNECTIVITIES\r\n  LINE  \"LOW\"  BEAM  \"low 1\"  \"low 2\"  0\r\n";
    for (index, (a, b, _)) in members().iter().enumerate() {
        let (kind, below) = if a == b { ("COLUMN", 1) } else { ("BEAM", 0) };
        let _ = write!(
            text,
            "  LINE  \"L{index}\"  {kind}  \"{}\"  \"{}\"  {below}\r\n",
            point(*a),
            point(*b)
        );
    }
    text += "\r\n$ AREA CONNECTIVITIES\r\n  AREA \"F1\"  FLOOR  4  \"1-1\"  \"3-1\"  \"3-2\"  \"1-2\"  0  0  0  0  \r\n\r\n$ POINT ASSIGNS\r\n";
    for x in 0..3 {
        for y in 0..3 {
            let _ = write!(
                text,
                "  POINTASSIGN  \"{}\"  \"Base\"  RESTRAINT \"UX UY UZ RX RY RZ\"  \r\n",
                point([x, y])
            );
        }
    }
    text += "\r\n$ LINE ASSIGNS\r\n";
    for story in ["1", "Roof slab"] {
        for (index, (_, _, section)) in members().iter().enumerate() {
            if story == "1" && index == 1 {
                continue;
            }
            let turned = if *section == "C 400*700" {
                "ANG  90 "
            } else {
                ""
            };
            let _ = write!(
                text,
                "  LINEASSIGN  \"L{index}\"  \"{story}\"  SECTION \"{section}\"CARDINALPT 5  {turned}MINNUMSTA 3 AUTOMESH \"YES\"  \r\n"
            );
        }
    }
    text += "  LINEASSIGN  \"LOW\"  \"Roof slab\"  SECTION \"B1\"  \r\n";
    text += "\r\n$ AREA ASSIGNS\r\n  AREAASSIGN  \"F1\"  \"Roof slab\"  SECTION \"Slab\"  DIAPH  \"D1\"  \r\n\r\n$ SLAB PROPERTIES\r\n  SHELLPROP  \"Slab\"  PROPTYPE  \"Slab\"  MATERIAL \"M25\"  MODELINGTYPE \"ShellThin\"  SLABTHICKNESS 150 \r\n\r\n$ LOAD PATTERNS\r\n  LOADPATTERN \"Dead\"  TYPE  \"Dead\"  SELFWEIGHT  1\r\n\r\n$ LOG\r\n  STARTCOMMENTS\r\n$ STORIES\r\nanything\r\n  ENDCOMMENTS\r\n\r\n$ END OF MODEL FILE\r\n";
    text
}

/// As Windows stores it.
fn cp1252(text: &str) -> Vec<u8> {
    text.chars()
        .map(|c| u8::try_from(u32::from(c)).expect("one byte"))
        .collect()
}

/// The listing of an analysis in kN and m, with heights above the datum of the model.
pub(crate) fn out() -> String {
    out_in(1.0)
}

/// The same where a metre has so many units of length, and a tonne one unit of mass, as in kN and m or N and mm.
fn out_in(metre: f64) -> String {
    let mut text = String::from(" ETABS\n File: model\n\n");
    for (index, ([mass, inertia, x, y], z)) in MASSES.iter().zip(LEVELS).enumerate().rev() {
        let [inertia, x, y] = [inertia * metre * metre, x * metre, y * metre];
        let z = (z - 1.5) * metre;
        let _ = write!(
            text,
            " {index}, CONSTR = RIGID, DOF = U1 U2 R3\n\n                     TRANSLATIONAL MASS AND MASS MOMENTS OF INERTIA\n                  U1          U2          U3          R1          R2          R3\n           {mass:.6}   {mass:.6}     .000000     .000000     .000000   {inertia:.6}\n\n                     CENTER OF MASS\n  GLOBAL          U1          U2          U3\n     X      {x:.6}    {x:.6}    {x:.6}\n     Y      {y:.6}    {y:.6}    {y:.6}\n     Z     {z:.6}   {z:.6}   {z:.6}\n\n"
        );
    }
    text
}

pub(crate) fn log() -> String {
    " UNITS (FORCE, LENGTH, TEMPERATURE, TIME)  = kN, m, C, sec\n CASE: MODAL\n Found mode      1 of     2:  EV= 2.3661128E+02, f=    2.448149, T=    0.408472\n Found mode      2 of     2:  EV= 2.8478797E+02, f=    2.685845, T=    0.372322\n".into()
}

fn expected() -> Vec<f64> {
    periods(&sound(&format!("{MOTION}{EXPECTED}")), 6)
}

#[test]
fn a_regular_text_model_of_etabs_is_a_space_frame() {
    let model_text = cp1252(&e2k());
    let commas = cp1252(
        &e2k()
            .replace("6000 ", "6000,0 ")
            .replace("E 30000 ", "E 30000,00 "),
    );
    for (bytes, metre, words) in [(model_text, 1.0, "kN, m"), (commas, 1e3, "N, mm")] {
        let (out, log) = (out_in(metre), log().replace("kN, m", words));
        let files: [(&str, &[u8]); 3] = [
            ("A.$et", &bytes),
            ("A.OUT", out.as_bytes()),
            ("A.LOG", log.as_bytes()),
        ];
        let found = imported(Program::Etabs, &files, &ImportOptions::default());
        let off = difference(&periods(&model(&found), 6), &expected());
        assert!(off < 1e-6, "{off:.1e}\n{}", found.toml);
        assert_eq!(found.periods[0].periods, [0.408472, 0.372322]);
        assert!(
            found
                .left_out
                .iter()
                .any(|line| line.contains("slab \"Slab\""))
        );
        assert!(found.toml.contains("elevation = \"-1.5 m\""));
        assert!(
            found
                .left_out
                .iter()
                .any(|line| line.contains("sections LOAD PATTERNS")),
            "{:?}",
            found.left_out
        );
    }
}

/// The same in Kgf and cm with continued rows; masses on joints whose sum is that of the floor.
pub(crate) fn s2k() -> String {
    let mut text = String::from(
        "File C:\\model.x was saved on m/d/yy at h:mm:ss\n \nTABLE:  \"PROGRAM CONTROL\"\n   ProgramName=SAP2000   Version=23.3.1   CurrUnits=\"Kgf, cm, C\"   SteelCode=AISC-LRFD93\n \n",
    );
    let joint = |at: [usize; 2], level: usize| 10 * (3 * at[0] + at[1]) + level;
    text += "TABLE:  \"JOINT COORDINATES\"\n";
    for x in 0..3 {
        for y in 0..3 {
            for level in 0..3 {
                let z = if level == 0 { 0.0 } else { LEVELS[level - 1] };
                let _ = writeln!(
                    text,
                    "   Joint={}   CoordSys=GLOBAL   CoordType=Cartesian   XorR={}   Y={}   Z={}   SpecialJt=No",
                    joint([x, y], level),
                    LINES[0][x] * 1e2,
                    LINES[1][y] * 1e2,
                    z * 1e2
                );
            }
        }
    }
    // Masses at the centres.
    for (level, [_, _, x, y]) in MASSES.iter().enumerate() {
        let _ = writeln!(
            text,
            "   Joint={}   CoordType=Cartesian   XorR={}   Y={}   Z={}",
            900 + level,
            x * 1e2,
            y * 1e2,
            LEVELS[level] * 1e2
        );
    }
    text += " \nTABLE:  \"JOINT RESTRAINT ASSIGNMENTS\"\n";
    for x in 0..3 {
        for y in 0..3 {
            let _ = writeln!(
                text,
                "   Joint={}   U1=Yes   U2=Yes   U3=Yes   R1=Yes   R2=Yes   R3=Yes",
                joint([x, y], 0)
            );
        }
    }
    text += " \nTABLE:  \"CONSTRAINT DEFINITIONS - DIAPHRAGM\"\n   Name=D1   CoordSys=GLOBAL   Axis=Z   MultiLevel=No\n   Name=D2   CoordSys=GLOBAL   Axis=Z   MultiLevel=No\n \nTABLE:  \"JOINT CONSTRAINT ASSIGNMENTS\"\n";
    for level in 1..3 {
        let columns = (0..9).map(|column| joint([column / 3, column % 3], level));
        for joint in columns.chain([899 + level]) {
            let _ = writeln!(
                text,
                "   Joint={joint}   Constraint=D{level}   Type=Diaphragm"
            );
        }
    }
    text += " \nTABLE:  \"MASS SOURCE\"\n   MassSource=MSSSRC1   Elements=No   Masses=Yes   Loads=No   IsDefault=Yes\n \nTABLE:  \"JOINT ADDED MASS ASSIGNMENTS\"\n";
    // Kgf·s²/cm.
    for (level, [mass, inertia, ..]) in MASSES.iter().enumerate() {
        let _ = writeln!(
            text,
            "   Joint={}   CoordSys=GLOBAL   Mass1={:.10}   Mass2={:.10}   Mass3=0   MMI1=0   MMI2=0   MMI3={:.8}",
            900 + level,
            mass * 1e3 / 980.665,
            mass * 1e3 / 980.665,
            inertia * 1e7 / 980.665
        );
    }
    text += " \nTABLE:  \"MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES\"\n";
    for (name, modulus) in [("M30", 30e9), ("M25", 25e9)] {
        let _ = writeln!(
            text,
            "   Material={name}   UnitWeight=0   E1={:.9}   U12=0.2",
            modulus / 98_066.5
        );
    }
    text += " \nTABLE:  \"FRAME SECTION PROPERTIES 01 - GENERAL\"\n";
    for (name, material, depth, width, factor) in [
        ("C1", "M30", 50, 50, 0.7),
        ("\"C 400*700\"", "M30", 80, 40, 0.7),
        ("B1", "M30", 60, 30, 0.35),
        ("B2", "M25", 60, 30, 0.35),
    ] {
        let _ = write!(
            text,
            "   SectionName={name}   Material={material}   Shape=Rectangular   t3={depth}   t2={width}   Area=1   Color=Blue _\n        AMod=1   A2Mod=1   A3Mod=1   JMod=0.1   I2Mod={factor}   I3Mod={factor}   MMod=1\n"
        );
    }
    let (mut frames, mut sections, mut axes) = (String::new(), String::new(), String::new());
    let mut number = 0;
    for level in 1..3 {
        for (a, b, section) in members() {
            number += 1;
            let lower = if a == b { level - 1 } else { level };
            let _ = writeln!(
                frames,
                "   Frame={number}   JointI={}   JointJ={}   IsCurved=No",
                joint(a, lower),
                joint(b, level)
            );
            let quoted = if section.contains(' ') {
                format!("\"{section}\"")
            } else {
                section.to_owned()
            };
            let _ = writeln!(
                sections,
                "   Frame={number}   AutoSelect=N.A.   AnalSect={quoted}   MatProp=Default"
            );
            if section.contains(' ') {
                let _ = writeln!(axes, "   Frame={number}   Angle=90   AdvanceAxes=No");
            }
        }
    }
    let _ = write!(
        text,
        " \nTABLE:  \"CONNECTIVITY - FRAME\"\n{frames} \nTABLE:  \"FRAME SECTION ASSIGNMENTS\"\n{sections} \nTABLE:  \"FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL\"\n{axes} \nTABLE:  \"FRAME LOADS - DISTRIBUTED\"\n   Frame=1   LoadPat=DEAD\n \nEND TABLE DATA\n"
    );
    text
}

#[test]
fn a_regular_text_model_of_sap2000_is_the_same_space_frame() {
    for line_end in ["\n", "\r\n"] {
        let text = s2k().replace('\n', line_end);
        let found = imported(
            Program::Sap2000,
            &[("A.s2k", text.as_bytes())],
            &ImportOptions::default(),
        );
        let off = difference(&periods(&model(&found), 6), &expected());
        assert!(off < 1e-6, "{off:.1e}\n{}", found.toml);
        assert!(
            found
                .left_out
                .iter()
                .any(|line| line.contains("FRAME LOADS - DISTRIBUTED")),
            "{:?}",
            found.left_out
        );
    }
}
