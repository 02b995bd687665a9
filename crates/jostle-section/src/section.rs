//! Rectangular reinforced-concrete section.

use crate::bars::{Bar, Reinforcement, Ties};
use crate::concrete::Concrete;
use crate::steel::Steel;

/// Rectangle of concrete with its bars.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Width, across the direction of bending, > 0 \[m\].
    pub width: f64,
    /// Depth, in the direction of bending, > 0 \[m\].
    pub depth: f64,
    /// The concrete.
    pub concrete: Concrete,
    /// The steel of the bars and of the ties.
    pub steel: Steel,
    /// The bars.
    pub bars: Vec<Bar>,
    /// Concrete between the faces and the surfaces of the bars, ≥ 0 \[m\].
    pub cover: f64,
    /// Ties, if they are to confine the core.
    pub ties: Option<Ties>,
}

/// An error in a section.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field}: {problem}")]
pub struct SectionFault {
    /// The value concerned: `width`, `depth`, `cover`, `bars`, `concrete` or `steel`.
    pub field: &'static str,
    /// The problem and a valid alternative.
    pub problem: String,
}

/// The uncracked section with its steel turned into concrete.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transformed {
    /// Area \[m²\].
    pub area: f64,
    /// Depth of the centroid below the top face \[m\].
    pub centroid: f64,
    /// Second moment of area about it \[m⁴\].
    pub inertia: f64,
}

impl Section {
    /// Lays bars into a rectangle.
    ///
    /// # Errors
    /// Everything that is wrong, never empty.
    pub fn new(
        width: f64,
        depth: f64,
        concrete: Concrete,
        steel: Steel,
        reinforcement: &Reinforcement,
        cover: f64,
        ties: Option<Ties>,
    ) -> Result<Self, Vec<SectionFault>> {
        let mut faults = Vec::new();
        let mut require = |good: bool, field, problem: String| {
            if !good {
                faults.push(SectionFault { field, problem });
            }
        };
        for (field, value) in [("width", width), ("depth", depth)] {
            let usual = (0.05..=10.0).contains(&value);
            require(
                usual,
                field,
                format!("must lie between 0.05 m and 10 m, found {value} m"),
            );
        }
        let diameter = reinforcement.largest_diameter();
        let room = width.min(depth) - 2.0 * (cover + diameter);
        let positive = cover >= 0.0 && cover.is_finite();
        require(
            positive,
            "cover",
            format!("must not be negative, found {cover} m"),
        );
        require(
            !positive || room > 0.0,
            "cover",
            format!(
                "leaves no room for the bars: {cover} m on both sides and bars of {diameter} m in {} m",
                width.min(depth)
            ),
        );
        let strong = |value: f64| (1e6..=1e9).contains(&value);
        require(
            strong(concrete.strength)
                && strong(1e-2 * concrete.modulus)
                && (0.0..=concrete.strength).contains(&concrete.tensile_strength),
            "concrete",
            format!(
                "a strength of {} MPa is out of range",
                1e-6 * concrete.strength
            ),
        );
        require(
            (1e7..=5e9).contains(&steel.yield_strength) && (1e10..=1e12).contains(&steel.modulus),
            "steel",
            format!(
                "a yield strength of {} MPa is out of range",
                1e-6 * steel.yield_strength
            ),
        );
        if !faults.is_empty() {
            return Err(faults);
        }
        let section = Self {
            width,
            depth,
            concrete,
            steel,
            bars: reinforcement.lay(width, depth, cover),
            cover,
            ties,
        };
        let share = section.steel_area() / (width * depth);
        if share > 0.1 {
            return Err(vec![SectionFault {
                field: "bars",
                problem: format!(
                    "fill {:.0} % of the section; more than 10 % cannot be placed",
                    100.0 * share
                ),
            }]);
        }
        Ok(section)
    }

    /// The section seen upside down: negative moments become positive ones.
    #[must_use]
    pub fn flipped(&self) -> Self {
        let bars = self.bars.iter().map(|bar| Bar {
            depth: self.depth - bar.depth,
            ..*bar
        });
        Self {
            bars: bars.collect(),
            ..self.clone()
        }
    }

    /// The section turned by a quarter: its left face is on top, so that its width is the depth.
    #[must_use]
    pub fn turned(&self) -> Self {
        let bars = self.bars.iter().map(|bar| Bar {
            x: bar.depth,
            depth: bar.x,
            ..*bar
        });
        Self {
            width: self.depth,
            depth: self.width,
            bars: bars.collect(),
            ..self.clone()
        }
    }

    /// Whether the section is the same upside down.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        self.bars.iter().all(|bar| {
            self.bars.iter().any(|other| {
                let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * self.depth;
                near(other.x, bar.x)
                    && near(other.depth, self.depth - bar.depth)
                    && other.diameter == bar.diameter
            })
        })
    }

    /// Gross area of concrete \[m²\].
    #[must_use]
    pub fn area(&self) -> f64 {
        self.width * self.depth
    }

    /// E I of the gross section, without steel \[N·m²\].
    #[must_use]
    pub fn gross_rigidity(&self) -> f64 {
        self.concrete.modulus * self.area() * self.depth * self.depth / 12.0
    }

    /// Area of all bars \[m²\].
    #[must_use]
    pub fn steel_area(&self) -> f64 {
        self.bars.iter().map(Bar::area).sum()
    }

    /// Compression over the strength of the gross concrete, N / (b h fc) \[–\].
    #[must_use]
    pub fn axial_ratio(&self, compression: f64) -> f64 {
        compression / (self.area() * self.concrete.strength)
    }

    /// Es / Ec \[–\].
    #[must_use]
    pub fn modular_ratio(&self) -> f64 {
        self.steel.modulus / self.concrete.modulus
    }

    /// Area, centroid and inertia with every bar counted Es/Ec − 1 times.
    #[must_use]
    pub fn transformed(&self) -> Transformed {
        let extra = self.modular_ratio() - 1.0;
        let sum = |power: i32, about: f64| -> f64 {
            let bars = self.bars.iter();
            bars.map(|bar| extra * bar.area() * (bar.depth - about).powi(power))
                .sum()
        };
        let area = self.area() + sum(0, 0.0);
        let centroid = (self.area() * 0.5 * self.depth + sum(1, 0.0)) / area;
        let offset = 0.5 * self.depth - centroid;
        let gross_inertia = self.area() * (self.depth * self.depth / 12.0 + offset * offset);
        Transformed {
            area,
            centroid,
            inertia: gross_inertia + sum(2, centroid),
        }
    }
}
