//! Damage of pinched storeys by power series and by direct steps.

use crate::support::ran;

/// One storey whose reloading lines are as steep as its unloading lines: its spring passes zero force on them many times, and damage
/// moves its peaks each time.
const MODEL: &str = r#"
[[building]]
name = "A"
kind = "shear"
mass = 76e3
stiffness = 25e6
storey_height = "3 m"
p_delta = false
damping = { ratio = 0.03 }
[building.hinges]
rule = "pinched"
cracking = "7.04 mm"
yield = "17.3 mm"
post_cracking = 0.245
post_yield = 0.057
pinching = { deformation = 0.2775, force = 0.7884 }
damage = { ductility = 0.0236 }
[motion]
record = "el-centro-1940-ns"
pga = 3.0
duration = "13 s"
"#;

#[test]
fn damage_is_done_at_every_passage_of_zero_force() {
    for (pga, energy) in [("3.0", "0"), ("2.6", "0.02"), ("3.6", "0")] {
        let text = MODEL.replace("pga = 3.0", &format!("pga = {pga}"));
        let text = text.replace("{ ductility", &format!("{{ energy = {energy}, ductility"));
        let [series, direct] = ["series", "riccati"].map(|solver| {
            let ran = ran(&format!(
                "analysis = {{ solver = \"{solver}\", tolerance = 1e-4 }}\n{text}"
            ));
            ran.summary().buildings[0].floors[0]
                .response
                .storey_drift_peak
        });
        let apart = (series / direct - 1.0).abs();
        assert!(apart < 2e-4, "at {pga} m/s²: {series} and {direct}");
    }
}
