//! Profiles of I shape, from their sizes.

use std::f64::consts::PI;

use super::Axis;

/// A profile of I shape with two equal flanges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ISection {
    /// Depth, > 2 flanges \[m\].
    pub depth: f64,
    /// Width of the flanges, > web \[m\].
    pub width: f64,
    /// Thickness of the web, > 0 \[m\].
    pub web: f64,
    /// Thickness of a flange, > 0 \[m\].
    pub flange: f64,
    /// Radius of the fillets between web and flanges, ≥ 0 \[m\].
    pub radius: f64,
}

impl ISection {
    /// What its sizes contradict; `None` if they fit.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        let clear = self.depth - 2.0 * self.flange;
        if clear <= 2.0 * self.radius {
            return Some(format!(
                "flanges of {} m and fillets of {} m leave no web in a depth of {} m",
                self.flange, self.radius, self.depth
            ));
        }
        (self.width <= self.web + 2.0 * self.radius).then(|| {
            format!(
                "a width of {} m leaves no flange beside a web of {} m with fillets of {} m",
                self.width, self.web, self.radius
            )
        })
    }

    /// Height of the web between the fillets \[m\].
    pub(crate) fn flat(&self) -> f64 {
        self.clear() - 2.0 * self.radius
    }

    fn clear(&self) -> f64 {
        self.depth - 2.0 * self.flange
    }

    /// Area \[m²\].
    pub(super) fn area(&self) -> f64 {
        let fillets = (4.0 - PI) * self.radius * self.radius;
        2.0 * self.width * self.flange + self.clear() * self.web + fillets
    }

    /// Second moment of area \[m⁴\].
    pub(super) fn inertia(&self, axis: Axis) -> f64 {
        let cubed = |side: f64| side * side * side;
        let (clear, radius) = (self.clear(), self.radius);
        // A fillet is a square less a quarter of a circle; its centroid lies so far from its corner.
        let fillet = (1.0 - PI / 4.0) * radius * radius;
        let centroid = (10.0 - 3.0 * PI) / (12.0 - 3.0 * PI) * radius;
        let about_centroid =
            (1.0 - 5.0 * PI / 16.0) * radius.powi(4) - fillet * centroid * centroid;
        let (plates, arm) = match axis {
            Axis::Strong => (
                (self.width * cubed(self.depth) - (self.width - self.web) * cubed(clear)) / 12.0,
                0.5 * clear - centroid,
            ),
            Axis::Weak => (
                (2.0 * self.flange * cubed(self.width) + clear * cubed(self.web)) / 12.0,
                0.5 * self.web + centroid,
            ),
        };
        plates + 4.0 * (about_centroid + fillet * arm * arm)
    }

    /// Plastic section modulus \[m³\].
    pub(super) fn plastic_modulus(&self, axis: Axis) -> f64 {
        let (clear, radius) = (self.clear(), self.radius);
        let fillets = (4.0 - PI) * radius * radius;
        let centroid = (10.0 - 3.0 * PI) / (12.0 - 3.0 * PI) * radius;
        match axis {
            Axis::Strong => {
                self.width * self.flange * (self.depth - self.flange)
                    + 0.25 * self.web * clear * clear
                    + fillets * (0.5 * clear - centroid)
            }
            Axis::Weak => {
                0.5 * self.flange * self.width * self.width
                    + 0.25 * clear * self.web * self.web
                    + fillets * (0.5 * self.web + centroid)
            }
        }
    }

    /// Torsion constant: flanges, web, and what their joints add \[m⁴\].
    pub(super) fn torsion_constant(&self) -> f64 {
        let Self {
            width,
            web,
            flange,
            radius,
            ..
        } = *self;
        let alpha = web / flange * (0.145 + 0.1 * radius / flange);
        // The greatest circle inside such a joint.
        let circle = ((radius + 0.5 * web).powi(2) + (radius + flange).powi(2) - radius * radius)
            / (2.0 * radius + flange);
        let plates = 2.0 / 3.0 * width * flange.powi(3) * (1.0 - 0.63 * flange / width)
            + self.clear() * web.powi(3) / 3.0;
        plates + 2.0 * alpha * circle.powi(4)
    }

    /// Area that resists shear: the web between the middles of the flanges, or about the weak axis 5/6 of both flanges \[m²\].
    pub(super) fn shear_area(&self, axis: Axis) -> f64 {
        match axis {
            Axis::Strong => (self.depth - self.flange) * self.web,
            Axis::Weak => 5.0 / 6.0 * 2.0 * self.width * self.flange,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Profile;

    /// It of the tables of ArcelorMittal, Sections and Merchant Bars.
    #[test]
    fn torsion_constants_are_those_of_tables() {
        let tables = [
            ("IPE200", 6.98),
            ("IPE300", 20.1),
            ("HEA200", 21.0),
            ("HEB200", 59.3),
            ("HEB300", 185.0),
        ];
        for (name, due) in tables {
            let torsion_constant = Profile::named(name).expect("known").torsion_constant();
            assert!(
                (1e8 * torsion_constant / due - 1.0).abs() < 5e-3,
                "{name}: {torsion_constant}"
            );
        }
    }

    #[test]
    fn sizes_that_do_not_fit_are_told() {
        let Some(Profile::I(sound)) = Profile::named("IPE200") else {
            panic!("known");
        };
        let flat = ISection {
            flange: 0.1,
            ..sound
        };
        let narrow = ISection {
            width: 0.02,
            ..sound
        };
        assert!(flat.fault().expect("no web").contains("leave no web"));
        assert!(
            narrow
                .fault()
                .expect("no flange")
                .contains("leaves no flange")
        );
    }
}
