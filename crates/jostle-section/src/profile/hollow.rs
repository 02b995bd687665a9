//! Rectangular and round tubes, from their sizes.

use std::f64::consts::PI;

use super::Axis;

/// A rectangular tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// Depth, > 2 walls \[m\].
    pub depth: f64,
    /// Width, > 2 walls \[m\].
    pub width: f64,
    /// Thickness of the wall, > 0 \[m\].
    pub wall: f64,
    /// Radius of the corners outside; inside it is less by a wall. At least a wall \[m\].
    pub radius: f64,
}

/// A round tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pipe {
    /// Diameter outside, > 2 walls \[m\].
    pub diameter: f64,
    /// Thickness of the wall, > 0 \[m\].
    pub wall: f64,
}

/// A filled rectangle with round corners.
struct Rounded {
    depth: f64,
    width: f64,
    radius: f64,
}

impl Rounded {
    /// What a corner lacks: a square less a quarter of a circle, and how far its centroid lies from the corner.
    fn corner(&self) -> [f64; 2] {
        let lacking = (1.0 - PI / 4.0) * self.radius * self.radius;
        [lacking, (10.0 - 3.0 * PI) / (12.0 - 3.0 * PI) * self.radius]
    }

    fn area(&self) -> f64 {
        self.depth * self.width - 4.0 * self.corner()[0]
    }

    fn inertia(&self) -> f64 {
        let [lacking, centroid] = self.corner();
        let about_centroid =
            (1.0 - 5.0 * PI / 16.0) * self.radius.powi(4) - lacking * centroid * centroid;
        let arm = 0.5 * self.depth - centroid;
        let filled = self.width * self.depth * self.depth * self.depth / 12.0;
        filled - 4.0 * (about_centroid + lacking * arm * arm)
    }

    fn plastic_modulus(&self) -> f64 {
        let [lacking, centroid] = self.corner();
        let filled = 0.25 * self.width * self.depth * self.depth;
        filled - 4.0 * lacking * (0.5 * self.depth - centroid)
    }
}

impl Tube {
    /// What it fills with its hole, and its hole, as they bend about an axis.
    fn outside_and_hole(&self, axis: Axis) -> [Rounded; 2] {
        let (depth, width) = match axis {
            Axis::Strong => (self.depth, self.width),
            Axis::Weak => (self.width, self.depth),
        };
        [0.0, self.wall].map(|inwards| Rounded {
            depth: depth - 2.0 * inwards,
            width: width - 2.0 * inwards,
            radius: (self.radius - inwards).max(0.0),
        })
    }

    /// Widths of its walls over its depth and its width between corners, of one and a half walls each (AISC 360, B4.1b) \[m\].
    pub(crate) fn flats(&self) -> [f64; 2] {
        [self.depth, self.width].map(|side| side - 3.0 * self.wall)
    }

    fn difference(&self, axis: Axis, of: fn(&Rounded) -> f64) -> f64 {
        let [outside, hole] = self.outside_and_hole(axis);
        of(&outside) - of(&hole)
    }

    pub(super) fn area(&self) -> f64 {
        self.difference(Axis::Strong, Rounded::area)
    }

    pub(super) fn inertia(&self, axis: Axis) -> f64 {
        self.difference(axis, Rounded::inertia)
    }

    pub(super) fn plastic_modulus(&self, axis: Axis) -> f64 {
        self.difference(axis, Rounded::plastic_modulus)
    }

    pub(super) fn torsion_constant(&self) -> f64 {
        let (wall, radius) = (self.wall, (self.radius - 0.5 * self.wall).max(0.0));
        let [depth, width] = [self.depth - wall, self.width - wall];
        // Along the middle of the wall.
        let around = 2.0 * (depth + width) - 2.0 * radius * (4.0 - PI);
        let inside = depth * width - radius * radius * (4.0 - PI);
        wall.powi(3) * around / 3.0 + 4.0 * inside * inside * wall / around
    }

    pub(super) fn shear_area(&self, axis: Axis) -> f64 {
        let depth = match axis {
            Axis::Strong => self.depth,
            Axis::Weak => self.width,
        };
        2.0 * (depth - self.wall) * self.wall
    }
}

impl Pipe {
    fn hole(&self) -> f64 {
        self.diameter - 2.0 * self.wall
    }

    pub(super) fn area(&self) -> f64 {
        PI * self.wall * (self.diameter - self.wall)
    }

    pub(super) fn inertia(&self) -> f64 {
        PI / 64.0 * (self.diameter.powi(4) - self.hole().powi(4))
    }

    pub(super) fn plastic_modulus(&self) -> f64 {
        (self.diameter.powi(3) - self.hole().powi(3)) / 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// I_T of EN 10210-2, table B.2 and B.3.
    #[test]
    fn torsion_constants_are_those_of_tables() {
        for ([depth, width, wall], due) in [([0.1, 0.1, 5e-3], 439.0), ([0.2, 0.1, 8e-3], 1804.0)] {
            let radius = 1.5 * wall;
            let tube = Tube {
                depth,
                width,
                wall,
                radius,
            };
            let torsion = 1e8 * tube.torsion_constant();
            assert!((torsion / due - 1.0).abs() < 1e-2, "{torsion}, not {due}");
        }
    }
}
