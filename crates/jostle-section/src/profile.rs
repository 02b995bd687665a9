//! Rolled steel profiles of I shape.

use std::f64::consts::PI;

/// Modulus of elasticity of structural steel (EN 1993-1-1, 3.2.6) \[Pa\].
pub const STEEL_MODULUS: f64 = 210e9;

/// Density of structural steel (EN 1991-1-1, table A.4) \[kg/m³\].
pub const STEEL_DENSITY: f64 = 7850.0;

/// A profile of I shape with two equal flanges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
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

/// Which axis a profile bends about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Flanges pull and push: the usual way.
    Strong,
    /// Flanges bend.
    Weak,
}

impl Profile {
    /// A European profile by its name, such as `HEB 300`, `IPE400` or `hea-200`; `None` if it is not known.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let plain: String = name
            .chars()
            .filter(|c| !c.is_whitespace() && *c != '-')
            .map(|c| c.to_ascii_uppercase())
            .collect();
        let (_, sizes) = PROFILES.iter().find(|(known, _)| *known == plain)?;
        let [depth, width, web, flange, radius] = sizes.map(|millimetres| 1e-3 * millimetres);
        Some(Self {
            depth,
            width,
            web,
            flange,
            radius,
        })
    }

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

    fn clear(&self) -> f64 {
        self.depth - 2.0 * self.flange
    }

    /// Area \[m²\].
    #[must_use]
    pub fn area(&self) -> f64 {
        let fillets = (4.0 - PI) * self.radius * self.radius;
        2.0 * self.width * self.flange + self.clear() * self.web + fillets
    }

    /// Second moment of area \[m⁴\].
    #[must_use]
    pub fn inertia(&self, axis: Axis) -> f64 {
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
    #[must_use]
    pub fn plastic_modulus(&self, axis: Axis) -> f64 {
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

    /// Area that resists shear: the web between the middles of the flanges, or about the weak axis 5/6 of both flanges \[m²\].
    #[must_use]
    pub fn shear_area(&self, axis: Axis) -> f64 {
        match axis {
            Axis::Strong => (self.depth - self.flange) * self.web,
            Axis::Weak => 5.0 / 6.0 * 2.0 * self.width * self.flange,
        }
    }

    /// Names of all that are known.
    pub fn names() -> impl Iterator<Item = &'static str> {
        PROFILES.iter().map(|(name, _)| *name)
    }
}

/// Depth, width, web, flange and radius of European profiles (EN 10365) \[mm\].
#[rustfmt::skip]
const PROFILES: &[(&str, [f64; 5])] = &[
    ("IPE80", [80.0, 46.0, 3.8, 5.2, 5.0]),
    ("IPE100", [100.0, 55.0, 4.1, 5.7, 7.0]),
    ("IPE120", [120.0, 64.0, 4.4, 6.3, 7.0]),
    ("IPE140", [140.0, 73.0, 4.7, 6.9, 7.0]),
    ("IPE160", [160.0, 82.0, 5.0, 7.4, 9.0]),
    ("IPE180", [180.0, 91.0, 5.3, 8.0, 9.0]),
    ("IPE200", [200.0, 100.0, 5.6, 8.5, 12.0]),
    ("IPE220", [220.0, 110.0, 5.9, 9.2, 12.0]),
    ("IPE240", [240.0, 120.0, 6.2, 9.8, 15.0]),
    ("IPE270", [270.0, 135.0, 6.6, 10.2, 15.0]),
    ("IPE300", [300.0, 150.0, 7.1, 10.7, 15.0]),
    ("IPE330", [330.0, 160.0, 7.5, 11.5, 18.0]),
    ("IPE360", [360.0, 170.0, 8.0, 12.7, 18.0]),
    ("IPE400", [400.0, 180.0, 8.6, 13.5, 21.0]),
    ("IPE450", [450.0, 190.0, 9.4, 14.6, 21.0]),
    ("IPE500", [500.0, 200.0, 10.2, 16.0, 21.0]),
    ("IPE550", [550.0, 210.0, 11.1, 17.2, 24.0]),
    ("IPE600", [600.0, 220.0, 12.0, 19.0, 24.0]),
    ("HEA100", [96.0, 100.0, 5.0, 8.0, 12.0]),
    ("HEA120", [114.0, 120.0, 5.0, 8.0, 12.0]),
    ("HEA140", [133.0, 140.0, 5.5, 8.5, 12.0]),
    ("HEA160", [152.0, 160.0, 6.0, 9.0, 15.0]),
    ("HEA180", [171.0, 180.0, 6.0, 9.5, 15.0]),
    ("HEA200", [190.0, 200.0, 6.5, 10.0, 18.0]),
    ("HEA220", [210.0, 220.0, 7.0, 11.0, 18.0]),
    ("HEA240", [230.0, 240.0, 7.5, 12.0, 21.0]),
    ("HEA260", [250.0, 260.0, 7.5, 12.5, 24.0]),
    ("HEA280", [270.0, 280.0, 8.0, 13.0, 24.0]),
    ("HEA300", [290.0, 300.0, 8.5, 14.0, 27.0]),
    ("HEA320", [310.0, 300.0, 9.0, 15.5, 27.0]),
    ("HEA340", [330.0, 300.0, 9.5, 16.5, 27.0]),
    ("HEA360", [350.0, 300.0, 10.0, 17.5, 27.0]),
    ("HEA400", [390.0, 300.0, 11.0, 19.0, 27.0]),
    ("HEA450", [440.0, 300.0, 11.5, 21.0, 27.0]),
    ("HEA500", [490.0, 300.0, 12.0, 23.0, 27.0]),
    ("HEA550", [540.0, 300.0, 12.5, 24.0, 27.0]),
    ("HEA600", [590.0, 300.0, 13.0, 25.0, 27.0]),
    ("HEA650", [640.0, 300.0, 13.5, 26.0, 27.0]),
    ("HEA700", [690.0, 300.0, 14.5, 27.0, 27.0]),
    ("HEA800", [790.0, 300.0, 15.0, 28.0, 30.0]),
    ("HEA900", [890.0, 300.0, 16.0, 30.0, 30.0]),
    ("HEA1000", [990.0, 300.0, 16.5, 31.0, 30.0]),
    ("HEB100", [100.0, 100.0, 6.0, 10.0, 12.0]),
    ("HEB120", [120.0, 120.0, 6.5, 11.0, 12.0]),
    ("HEB140", [140.0, 140.0, 7.0, 12.0, 12.0]),
    ("HEB160", [160.0, 160.0, 8.0, 13.0, 15.0]),
    ("HEB180", [180.0, 180.0, 8.5, 14.0, 15.0]),
    ("HEB200", [200.0, 200.0, 9.0, 15.0, 18.0]),
    ("HEB220", [220.0, 220.0, 9.5, 16.0, 18.0]),
    ("HEB240", [240.0, 240.0, 10.0, 17.0, 21.0]),
    ("HEB260", [260.0, 260.0, 10.0, 17.5, 24.0]),
    ("HEB280", [280.0, 280.0, 10.5, 18.0, 24.0]),
    ("HEB300", [300.0, 300.0, 11.0, 19.0, 27.0]),
    ("HEB320", [320.0, 300.0, 11.5, 20.5, 27.0]),
    ("HEB340", [340.0, 300.0, 12.0, 21.5, 27.0]),
    ("HEB360", [360.0, 300.0, 12.5, 22.5, 27.0]),
    ("HEB400", [400.0, 300.0, 13.5, 24.0, 27.0]),
    ("HEB450", [450.0, 300.0, 14.0, 26.0, 27.0]),
    ("HEB500", [500.0, 300.0, 14.5, 28.0, 27.0]),
    ("HEB550", [550.0, 300.0, 15.0, 29.0, 27.0]),
    ("HEB600", [600.0, 300.0, 15.5, 30.0, 27.0]),
    ("HEB650", [650.0, 300.0, 16.0, 31.0, 27.0]),
    ("HEB700", [700.0, 300.0, 17.0, 32.0, 27.0]),
    ("HEB800", [800.0, 300.0, 17.5, 33.0, 30.0]),
    ("HEB900", [900.0, 300.0, 18.5, 35.0, 30.0]),
    ("HEB1000", [1000.0, 300.0, 19.0, 36.0, 30.0]),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Area \[cm²\] and second moment \[cm⁴\] about the strong axis as catalogues print them.
    #[rustfmt::skip]
    const CATALOGUE: &[(&str, f64, f64)] = &[
        ("IPE80", 7.64, 80.14),
        ("IPE100", 10.3, 171.0),
        ("IPE120", 13.2, 317.8),
        ("IPE140", 16.4, 541.2),
        ("IPE160", 20.1, 869.3),
        ("IPE180", 23.9, 1317.0),
        ("IPE200", 28.5, 1943.0),
        ("IPE220", 33.4, 2772.0),
        ("IPE240", 39.1, 3892.0),
        ("IPE270", 45.9, 5790.0),
        ("IPE300", 53.8, 8356.0),
        ("IPE330", 62.6, 11770.0),
        ("IPE360", 72.7, 16270.0),
        ("IPE400", 84.5, 23130.0),
        ("IPE450", 98.8, 33740.0),
        ("IPE500", 115.5, 48200.0),
        ("IPE550", 134.4, 67120.0),
        ("IPE600", 156.0, 92080.0),
        ("HEA100", 21.2, 349.2),
        ("HEA120", 25.3, 606.2),
        ("HEA140", 31.4, 1033.0),
        ("HEA160", 38.8, 1673.0),
        ("HEA180", 45.3, 2510.0),
        ("HEA200", 53.8, 3692.0),
        ("HEA220", 64.3, 5410.0),
        ("HEA240", 76.8, 7763.0),
        ("HEA260", 86.8, 10450.0),
        ("HEA280", 97.3, 13670.0),
        ("HEA300", 112.5, 18260.0),
        ("HEA320", 124.4, 22930.0),
        ("HEA340", 133.5, 27690.0),
        ("HEA360", 142.8, 33090.0),
        ("HEA400", 159.0, 45070.0),
        ("HEA450", 178.0, 63720.0),
        ("HEA500", 197.5, 86970.0),
        ("HEA550", 211.8, 111900.0),
        ("HEA600", 226.5, 141200.0),
        ("HEA650", 241.6, 175200.0),
        ("HEA700", 260.5, 215300.0),
        ("HEA800", 285.8, 303400.0),
        ("HEA900", 320.5, 422100.0),
        ("HEA1000", 346.8, 553800.0),
        ("HEB100", 26.0, 449.5),
        ("HEB120", 34.0, 864.4),
        ("HEB140", 43.0, 1509.0),
        ("HEB160", 54.3, 2492.0),
        ("HEB180", 65.3, 3831.0),
        ("HEB200", 78.1, 5696.0),
        ("HEB220", 91.0, 8091.0),
        ("HEB240", 106.0, 11260.0),
        ("HEB260", 118.4, 14920.0),
        ("HEB280", 131.4, 19270.0),
        ("HEB300", 149.1, 25170.0),
        ("HEB320", 161.3, 30820.0),
        ("HEB340", 170.9, 36660.0),
        ("HEB360", 180.6, 43190.0),
        ("HEB400", 197.8, 57680.0),
        ("HEB450", 218.0, 79890.0),
        ("HEB500", 238.6, 107200.0),
        ("HEB550", 254.1, 136700.0),
        ("HEB600", 270.0, 171000.0),
        ("HEB650", 286.3, 210600.0),
        ("HEB700", 306.4, 256900.0),
        ("HEB800", 334.2, 359100.0),
        ("HEB900", 371.3, 494100.0),
        ("HEB1000", 400.0, 644700.0),
    ];

    #[test]
    fn areas_and_second_moments_are_those_of_catalogues() {
        assert_eq!(CATALOGUE.len(), PROFILES.len());
        for &(name, area, inertia) in CATALOGUE {
            let own = Profile::named(name).expect(name);
            assert_eq!(own.fault(), None, "{name}");
            let found = [1e4 * own.area(), 1e8 * own.inertia(Axis::Strong)];
            assert!((found[0] / area - 1.0).abs() < 4e-3, "{name}: {found:?}");
            assert!((found[1] / inertia - 1.0).abs() < 1e-3, "{name}: {found:?}");
        }
    }

    /// I about the weak axis of three of them as catalogues print it \[cm⁴\].
    #[test]
    fn second_moments_about_the_weak_axis_are_those_of_catalogues() {
        for (name, inertia) in [("IPE 300", 603.8), ("heb-200", 2003.0), ("HEA300", 6310.0)] {
            let own = Profile::named(name).expect(name);
            let found = 1e8 * own.inertia(Axis::Weak);
            assert!((found / inertia - 1.0).abs() < 1e-3, "{name}: {found}");
        }
    }

    /// Plastic moduli about both axes of four of them as catalogues print them \[cm³\].
    #[test]
    fn plastic_moduli_are_those_of_catalogues() {
        for (name, strong, weak) in [
            ("IPE300", 628.4, 125.2),
            ("HEA200", 429.5, 203.8),
            ("HEB200", 642.5, 305.8),
            ("HEB300", 1869.0, 870.1),
        ] {
            let own = Profile::named(name).expect(name);
            let found = [Axis::Strong, Axis::Weak].map(|axis| 1e6 * own.plastic_modulus(axis));
            assert!((found[0] / strong - 1.0).abs() < 1e-3, "{name}: {found:?}");
            assert!((found[1] / weak - 1.0).abs() < 1e-3, "{name}: {found:?}");
        }
    }

    #[test]
    fn sizes_that_do_not_fit_are_told() {
        let sound = Profile::named("IPE200").expect("known");
        let flat = Profile {
            flange: 0.1,
            ..sound
        };
        let narrow = Profile {
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
