//! Beams with a slab as flange: effective width, area and second moment of area.

/// Where a beam stands among the spans of its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Length between the axes of its columns, > 0 \[m\].
    pub length: f64,
    /// How many of its ends are the outer ends of the frame: 0, 1 or 2.
    pub outer_ends: usize,
}

/// How wide a slab acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FlangeWidth {
    /// As stated, web included \[m\].
    Stated(f64),
    /// EN 1992-1-1, 5.3.2.1: on each side 0.2 b + 0.1 l₀, at most 0.2 l₀ and *b*, half of the clear distance to the next beam; l₀ is 0.85
    /// of the length of an end span, 0.7 of that of an inner one, and the whole length of a single span.
    En1992 {
        /// Clear distance to the next beam, > 0 \[m\].
        clear: f64,
    },
    /// ACI 318-19, 6.3.2.1: on each side the least of 8 h, half of the clear distance to the next beam, and l/8; of a slab on one side
    /// alone 6 h, that half, and l/12.
    Aci318 {
        /// Clear distance to the next beam, > 0 \[m\].
        clear: f64,
    },
}

/// A slab on one or both sides of the top of a rectangular beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Thickness *h*, > 0 and less than the depth of the beam \[m\].
    pub depth: f64,
    /// 1 or 2.
    pub sides: usize,
    /// How wide it acts.
    pub width: FlangeWidth,
}

/// Area and second moment of area of a beam with a slab.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tee {
    /// Area \[m²\].
    pub area: f64,
    /// Second moment of area about the axis through the centroid \[m⁴\].
    pub inertia: f64,
}

impl Slab {
    /// Effective width with a web of a width in a span, web included \[m\].
    #[must_use]
    pub fn effective_width(&self, web: f64, span: Span) -> f64 {
        let sides = self.sides as f64;
        match self.width {
            FlangeWidth::Stated(width) => width,
            FlangeWidth::En1992 { clear } => {
                let zero = [0.7, 0.85, 1.0][span.outer_ends.min(2)] * span.length;
                let half = 0.5 * clear;
                web + sides * (0.2 * half + 0.1 * zero).min(0.2 * zero).min(half)
            }
            FlangeWidth::Aci318 { clear } => {
                let [thick, long] = match self.sides {
                    1 => [6.0, 12.0],
                    _ => [8.0, 8.0],
                };
                let overhang = (thick * self.depth)
                    .min(0.5 * clear)
                    .min(span.length / long);
                web + sides * overhang
            }
        }
    }

    /// Of a beam of a width and a depth, slab included, in a span \[m\].
    #[must_use]
    pub fn tee(&self, web: f64, depth: f64, span: Span) -> Tee {
        // Web below the whole depth, and what overhangs it.
        let overhang = self.effective_width(web, span) - web;
        let parts = [(web, depth), (overhang, self.depth)];
        let area: f64 = parts.iter().map(|(b, h)| b * h).sum();
        // Distances from the top.
        let moment: f64 = parts.iter().map(|(b, h)| 0.5 * b * h * h).sum();
        let centroid = moment / area;
        let inertia = parts.iter().map(|(b, h)| {
            let arm = 0.5 * h - centroid;
            b * h * (h * h / 12.0 + arm * arm)
        });
        Tee {
            area,
            inertia: inertia.sum(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPAN: Span = Span {
        length: 6.0,
        outer_ends: 1,
    };

    fn slab(sides: usize, width: FlangeWidth) -> Slab {
        Slab {
            depth: 0.15,
            sides,
            width,
        }
    }

    /// Each of the limits governs once, with numbers by hand.
    #[test]
    fn effective_widths_are_those_of_the_codes() {
        let en = |clear, span, sides| {
            slab(sides, FlangeWidth::En1992 { clear }).effective_width(0.3, span)
        };
        let aci = |clear, span, sides| {
            slab(sides, FlangeWidth::Aci318 { clear }).effective_width(0.3, span)
        };
        let inner = Span {
            outer_ends: 0,
            ..SPAN
        };
        let close = |got: f64, due: f64| assert!((got - due).abs() < 1e-12, "{got} and {due}");
        // 0.2 · 2 + 0.1 · 5.1 = 0.91 on each side; l₀ is 5.1 of this end span and 4.2 of an inner one.
        close(en(4.0, SPAN, 2), 0.3 + 2.0 * 0.91);
        close(en(4.0, inner, 2), 0.3 + 2.0 * 0.82);
        close(en(8.0, inner, 1), 0.3 + 0.84);
        close(en(0.4, inner, 2), 0.3 + 2.0 * 0.2);
        // 6/8 = 0.75, 8 · 0.15 = 1.2 and 2.
        close(aci(4.0, SPAN, 2), 0.3 + 2.0 * 0.75);
        close(aci(1.0, SPAN, 2), 0.3 + 2.0 * 0.5);
        let long = Span {
            length: 20.0,
            ..SPAN
        };
        close(aci(4.0, long, 2), 0.3 + 2.0 * 1.2);
        close(aci(4.0, SPAN, 1), 0.3 + 0.5);
        close(aci(4.0, long, 1), 0.3 + 0.9);
    }

    /// Strips of a hundredth of a millimetre instead of the theorem of parallel axes.
    #[test]
    fn the_second_moment_is_that_of_strips() {
        let (web, depth) = (0.3, 0.6);
        let slab = slab(2, FlangeWidth::Stated(1.4));
        let tee = slab.tee(web, depth, SPAN);
        let strips = 60_000;
        let (mut area, mut first, mut second) = (0.0, 0.0, 0.0);
        for strip in 0..strips {
            let y = (f64::from(strip) + 0.5) * depth / f64::from(strips);
            let strip_area = depth / f64::from(strips) * if y < slab.depth { 1.4 } else { web };
            area += strip_area;
            first += strip_area * y;
            second += strip_area * y * y;
        }
        let inertia = second - first * first / area;
        assert!((tee.area / area - 1.0).abs() < 1e-9);
        assert!((tee.inertia / inertia - 1.0).abs() < 1e-8);
        // No overhang leaves the rectangle.
        let bare = Slab {
            width: FlangeWidth::Stated(web),
            ..slab
        };
        let due = web * depth.powi(3) / 12.0;
        assert!((bare.tee(web, depth, SPAN).inertia / due - 1.0).abs() < 1e-12);
    }
}
