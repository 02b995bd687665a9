//! What texts and reports say of fibres and infill panels that are judged.

use jostle::results::summary::{FibreSummary, PartSummary};
use jostle_run::summary_text;

use crate::support::ran;

/// Columns of one storey whose feet are fibres within ties.
const COLUMNS: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "1 g", duration = "4 s" }
[[building]]
name = "F"
storeys = 1
storey_height = "3 m"
spans = ["4 m"]
column = { width = "400 mm", depth = "400 mm", concrete = "C30", steel = "HRB400", bars = "8 d20", ties = "d8 @ 100 mm" }
beam = { EI = "100 MN.m2" }
floor_mass = "60 t"
axial = "flexible"
elastic_modulus = "30 GPa"
gravity = true
hinges = { rule = "fibre", length = "0.3 m", fibres = 8, ends = "base", limits = { spalling = 0.002 } }
"#;

#[test]
fn strains_of_fibres_are_said_and_drawn() {
    let ran = ran(COLUMNS);
    let summary = ran.summary();
    let ends: &[FibreSummary] = &summary.buildings[0].sections;
    let spalled: Vec<&FibreSummary> = ends
        .iter()
        .filter(|end| end.limits[0].passed_s.is_some())
        .collect();
    assert!(!spalled.is_empty());
    let text = summary_text(&summary, &ran.prepared.input);
    let counted = format!("cover spalls at {} of 2 ends, first at ", spalled.len());
    for part in [
        &counted[..],
        "core is crushed at ",
        "bars break at none of 2 ends",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(!text.contains("buckle"), "{text}");
    let report = ran.results(&summary).report().expect("histories");
    let section = report.split("id=\"fibres\"").nth(1).expect("a section");
    let section = section.split("</section>").next().expect("an end");
    assert_eq!(section.matches("<svg").count(), 2);
    assert_eq!(section.matches("<title>capacity</title>").count(), 2);
    assert!(section.contains("spalling of the cover at "), "{section}");
}

/// One panel in a soft frame.
const PANEL: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "4 s" }
[[building]]
name = "P"
storeys = 2
storey_height = "3 m"
spans = ["4 m", "4 m"]
column = { width = "300 mm", depth = "300 mm" }
beam = { width = "250 mm", depth = "400 mm" }
concrete = "C25"
floor_mass = "80 t"
[[building.infill]]
storeys = 1
modulus = "2 GPa"
thickness = "120 mm"
width = "0.6 m"
force = "80 kN"
offset = "400 mm"
struts = 3
central_share = 0.5
"#;

#[test]
fn panels_are_counted_by_their_damage() {
    let ran = ran(PANEL);
    let summary = ran.summary();
    let building = &summary.buildings[0];
    let panels = building.damaged_panels();
    let names: Vec<&str> = panels.iter().map(|panel| &panel.name[..]).collect();
    assert_eq!(names, ["P.infill.1.1", "P.infill.1.2"]);
    assert_eq!(building.parts.len(), 12);
    for panel in &panels {
        let struts = building.parts.iter();
        let struts: Vec<&PartSummary> = struts
            .filter(|strut| strut.name.starts_with(&panel.name))
            .collect();
        let drifts = struts.iter().filter_map(|strut| strut.drift);
        assert_eq!(drifts.fold(0.0, f64::max), panel.drift);
        // Columns hardly stretch: the drift of the bay is that of the storey.
        let storey = building.floors[0].response.storey_drift_peak;
        assert!(
            (panel.drift / storey - 1.0).abs() < 1e-3,
            "{} {storey}",
            panel.drift
        );
    }
    assert!(panels[0].state > 0);
    let text = summary_text(&summary, &ran.prepared.input);
    let said = format!(
        "Infill damage by drift, P: 2 of 2 panels in state {}",
        panels[0].state
    );
    assert!(text.contains(&said), "{said} in {text}");
    let report = ran.results(&summary).report().expect("histories");
    let section = report.split("id=\"panels\"").nth(1).expect("a section");
    let said = format!("state {} in 2 of 2 panels", panels[0].state);
    assert!(section.contains(&said), "{said}");
}
