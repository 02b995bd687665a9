//! Draws the rules of `docs/hysteresis.md`: `cargo run -p jostle --example hysteresis_figures`.

use jostle::hysteresis::{
    Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule, Pinching, Side,
};

const WIDTH: f64 = 360.0;
const HEIGHT: f64 = 260.0;
const REACH: f64 = 9.2;
const FORCE: f64 = 250.0;

fn main() -> std::io::Result<()> {
    let corners = Corners {
        cracking: 1.0,
        yielding: 4.0,
        post_cracking: 1.0 / 3.0,
        post_yield: 0.05,
    };
    let bilinear = Corners::bilinear(2.0, 0.05);
    let rules = [
        (HysteresisRule::Bilinear, bilinear),
        (HysteresisRule::Normal, corners),
        (HysteresisRule::PeakOriented, corners),
        (HysteresisRule::Takeda { exponent: 0.4 }, corners),
        (HysteresisRule::DegradingTrilinear, corners),
        (HysteresisRule::Pinched(Pinching::USUAL), corners),
    ];
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/figures");
    for (rule, corners) in rules {
        let spring = Backbone::from_deformations(100.0, corners, corners)
            .and_then(|backbone| Hysteresis::new(rule, backbone));
        let Ok(spring) = spring else { continue };
        let path = folder.join(format!("hysteresis-{}.svg", rule.name()));
        std::fs::write(path, draw(&spring))?;
    }
    Ok(())
}

fn place(deformation: f64, force: f64) -> String {
    format!(
        "{:.1},{:.1}",
        WIDTH * (0.5 + 0.5 * deformation / REACH),
        HEIGHT * (0.5 - 0.5 * force / FORCE)
    )
}

/// The points of a history, corner by corner.
fn points(spring: &Hysteresis, history: &[f64]) -> Vec<String> {
    let mut memory = HysteresisMemory::default();
    let mut points = vec![place(0.0, 0.0)];
    for &target in history {
        while memory.deformation() != target {
            let towards = Side::from_change(target - memory.deformation());
            let corner = spring.next_corner(&memory, towards);
            let end = if towards.sign() * (corner - target) < 0.0 {
                corner
            } else {
                target
            };
            memory = spring.respond(&memory, end).memory;
            points.push(place(end, memory.force()));
        }
    }
    points
}

fn draw(spring: &Hysteresis) -> String {
    let backbone = spring.backbone();
    let curve = backbone.side(Side::Positive);
    let [c, y] = [curve.cracking, curve.yielding].map(|corner| corner.deformation);
    let first = [-8.8, -y, -c, c, y, 8.8].map(|d| place(d, backbone.force_at(d)));
    let path = points(spring, &[2.5, -2.5, 6.0, -6.0, 3.0, -1.0, 8.0, -8.0, 0.0]);
    let middle = (0.5 * WIDTH, 0.5 * HEIGHT);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" role=\"img\" aria-label=\"Force against deformation under the rule {name}\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#fff\"/>\n\
         <path d=\"M0,{y} H{WIDTH} M{x},0 V{HEIGHT}\" stroke=\"#999\" stroke-width=\"1\" fill=\"none\"/>\n\
         <path d=\"M{first}\" stroke=\"#d55e00\" stroke-width=\"1.3\" stroke-dasharray=\"5 4\" fill=\"none\"/>\n\
         <path d=\"M{path}\" stroke=\"#0072b2\" stroke-width=\"1.6\" stroke-linejoin=\"round\" fill=\"none\"/>\n\
         <text x=\"{label}\" y=\"{below}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#555\" text-anchor=\"end\">deformation</text>\n\
         <text x=\"{beside}\" y=\"14\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#555\">force</text>\n\
         <text x=\"10\" y=\"18\" font-family=\"sans-serif\" font-size=\"14\" font-weight=\"bold\" fill=\"#222\">{name}</text>\n\
         </svg>\n",
        name = spring.rule().name(),
        x = middle.0,
        y = middle.1,
        first = first.join(" L"),
        path = path.join(" L"),
        label = WIDTH - 6.0,
        below = middle.1 + 16.0,
        beside = middle.0 + 6.0,
    )
}
