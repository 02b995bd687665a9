//! What symmetry keeps at rest is rounding: it has no error of its own, and asks for no finer steps.

use super::support::ran;

fn symmetric_frame(angle: f64) -> String {
    format!(
        r#"
        [motion]
        record = "el-centro-1940-ns"
        pga = "0.3 g"
        angle = "{angle} deg"
        duration = "3 s"
        [[building]]
        name = "A"
        kind = "space-frame"
        storeys = 1
        storey_height = "3 m"
        lines_x = ["0 m", "6 m"]
        lines_y = ["0 m", "5 m"]
        at = ["0 m", "0 m"]
        mass = "90 t"
        elastic_modulus = "30 GPa"
        column = {{ size = ["500 mm", "400 mm"] }}
        beam_x = {{ width = "300 mm", depth = "600 mm" }}
        beam_y = {{ width = "300 mm", depth = "500 mm" }}
        hinges = {{ rule = "peak-oriented", column = {{ cracking = "90 kN.m", yield = "240 kN.m", post_cracking = 0.3, post_yield = 0.02 }} }}
        "#
    )
}

#[test]
fn shaking_along_an_axis_of_symmetry_takes_the_steps_of_shaking_askew() {
    let [askew, along, across] = [30.0, 0.0, 90.0].map(|angle| ran(&symmetric_frame(angle)));
    let steps = |ran: &jostle_run::Ran| ran.outcome.work.steps;
    for (angle, run) in [(0, &along), (90, &across)] {
        let summary = run.summary();
        assert_eq!(summary.promise.met, Some(true), "{angle} deg");
        assert_eq!(run.outcome.work.repeated_runs, 0, "{angle} deg");
        assert_eq!(steps(run), steps(&askew), "{angle} deg");
    }
}
