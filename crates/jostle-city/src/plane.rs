//! From degrees to metres and back.

use std::sync::LazyLock;

use geo::{Coord, MapCoords, Polygon};
use geographiclib_rs::{DirectGeodesic, Geodesic, InverseGeodesic};

static EARTH: LazyLock<Geodesic> = LazyLock::new(Geodesic::wgs84);

/// A plane in metres, east and north of its origin.
///
/// Distances from the origin and directions there are true (azimuthal equidistant projection on the ellipsoid).
/// Between two points at a distance r from the origin, lengths are wrong by at most r²/6R²: 1e-5 at 50 km.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plane {
    /// Coordinates are metres already.
    Metres,
    /// Coordinates are degrees of longitude and latitude (WGS 84).
    Degrees {
        /// Longitude and latitude of the origin \[°\].
        origin: [f64; 2],
    },
}

impl Plane {
    /// Metres of a point.
    #[must_use]
    pub fn metres(&self, at: Coord) -> Coord {
        match self {
            Self::Metres => at,
            Self::Degrees { origin } => {
                let [longitude, latitude] = *origin;
                let (distance, azimuth, _): (f64, f64, f64) = {
                    let (s12, azi1, azi2, _): (f64, f64, f64, f64) =
                        EARTH.inverse(latitude, longitude, at.y, at.x);
                    (s12, azi1, azi2)
                };
                let azimuth = azimuth.to_radians();
                Coord {
                    x: distance * libm::sin(azimuth),
                    y: distance * libm::cos(azimuth),
                }
            }
        }
    }

    /// The point of metres, in the coordinates of the inventory.
    #[must_use]
    pub fn original(&self, at: Coord) -> Coord {
        match self {
            Self::Metres => at,
            Self::Degrees { origin } => {
                let azimuth = libm::atan2(at.x, at.y).to_degrees();
                let (y, x): (f64, f64) =
                    EARTH.direct(origin[1], origin[0], azimuth, libm::hypot(at.x, at.y));
                Coord { x, y }
            }
        }
    }

    /// An outline in the coordinates of the inventory.
    pub(crate) fn outline(&self, polygon: &Polygon) -> Polygon {
        polygon.map_coords(|at| self.original(at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metres_and_degrees_agree_both_ways() {
        let plane = Plane::Degrees {
            origin: [-122.42, 37.77],
        };
        for [x, y] in [[-122.42, 37.77], [-122.3, 37.8], [-122.52, 37.7]] {
            let back = plane.original(plane.metres(Coord { x, y }));
            assert!(
                (back.x - x).abs() < 1e-12 && (back.y - y).abs() < 1e-12,
                "{back:?}"
            );
        }
        // A tenth of a second of latitude is 3.083 m there: M = a (1 − e²)/(1 − e² sin²φ)^1.5.
        let [here, there] =
            [37.7, 37.7 + 0.1 / 3600.0].map(|y| plane.metres(Coord { x: -122.3, y }));
        let (e2, sine) = (0.006_694_379_990_14, 37.7_f64.to_radians().sin());
        let radius = 6_378_137.0 * (1.0 - e2) / (1.0 - e2 * sine * sine).powf(1.5);
        let length = (there.x - here.x).hypot(there.y - here.y);
        let expected = radius * (0.1_f64 / 3600.0).to_radians();
        assert!(
            (length / expected - 1.0).abs() < 1e-5,
            "{length} {expected}"
        );
    }
}
