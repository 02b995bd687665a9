//! A made-up city to try with.

use std::fmt::Write as _;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::plane::Plane;

/// City file for the footprints of [`example_city`] in `city.geojson`.
pub const EXAMPLE_FILE: &str = include_str!("../assets/city.toml");

/// In the middle of the Atlantic, so that nobody takes it for a place.
const ORIGIN: [f64; 2] = [-30.0, 40.0];

/// A city of about `buildings` footprints as GeoJSON, the same text for the same number and seed.
///
/// It has the statistics of a dense real one: half of the buildings have a neighbour within 0.5 m; of the blocks of
/// neighbours nine in ten have no more than 6 buildings, 99 in 100 no more than 12. Types, years and storeys are drawn.
#[must_use]
pub fn example_city(buildings: usize, seed: u64) -> String {
    let mut dice = Dice(ChaCha8Rng::seed_from_u64(seed));
    let plane = Plane::Degrees { origin: ORIGIN };
    let mut text = String::from("{\"type\":\"FeatureCollection\",\"features\":[");
    let mut made = 0;
    // Streets of a grid: lots side by side on both sides of each.
    let length = 25.0 * (buildings as f64).sqrt().max(4.0);
    let (mut x, mut y) = (0.0, 0.0);
    let mut side = 0;
    while made < buildings {
        if x > length {
            x = 0.0;
            side += 1;
            // Back yards between the sides of two streets, a street between the two sides of one.
            y += if side % 2 == 0 { 40.0 } else { 36.0 };
        }
        let run = if dice.unit() < 0.785 {
            1
        } else {
            2 + (libm::log(1.0 - dice.unit()) / libm::log(0.63)) as usize
        };
        let old = dice.unit();
        for at in 0..run.min(buildings - made) {
            if at > 0 {
                // Maps are quantised: many neighbours touch on them.
                x += if dice.unit() < 0.5 {
                    0.0
                } else {
                    0.4 * dice.unit()
                };
            }
            let width = 6.0 + 9.0 * dice.unit() + if dice.unit() < 0.1 { 15.0 } else { 0.0 };
            let depth = 12.0 + 10.0 * dice.unit();
            let front = 1.5 * dice.unit();
            let storeys = 1 + (7.0 * dice.unit() * dice.unit()) as usize;
            let year = (1895.0 + 120.0 * (0.6 * old + 0.4 * dice.unit())) as i32;
            let kind = match (dice.unit(), storeys) {
                (u, 1..=2) if u < 0.6 => "W1",
                (u, ..=4) if u < 0.4 => "W2",
                (u, ..=4) if u < 0.6 && year < 1935 => "URM",
                (u, _) if u < 0.65 => "C1",
                (u, _) if u < 0.8 => "C2",
                (u, _) if u < 0.9 => "S1",
                _ => "RM1",
            };
            let height = storeys as f64 * (2.9 + 0.8 * dice.unit());
            let corners = [
                [x, y + front],
                [x + width, y + front],
                [x + width, y + front + depth],
                [x, y + front + depth],
                [x, y + front],
            ];
            let ring: Vec<String> = corners
                .iter()
                .map(|[x, y]| {
                    let at = plane.original(geo::Coord { x: *x, y: *y });
                    format!("[{:.8},{:.8}]", at.x, at.y)
                })
                .collect();
            let comma = if made == 0 { "\n" } else { ",\n" };
            let _ = write!(
                text,
                "{comma}{{\"type\":\"Feature\",\"id\":\"{}\",\"properties\":{{\"storeys\":{storeys},\"height\":{height:.1},\
                 \"year\":{year},\"type\":\"{kind}\"}},\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[[{}]]}}}}",
                made + 1,
                ring.join(",")
            );
            made += 1;
            x += width;
        }
        x += 1.2 + 4.0 * dice.unit();
    }
    text.push_str("\n]}\n");
    text
}

struct Dice(ChaCha8Rng);

impl Dice {
    /// Between 0 and 1.
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }
}
