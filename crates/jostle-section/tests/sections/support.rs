//! Sections to try.

use jostle_section::{Bar, Concrete, Reinforcement, Section, Steel, StrengthLevel};

pub(crate) fn section(width: f64, depth: f64, bars: &str) -> Section {
    let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
    let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
    let reinforcement = Reinforcement::parse(bars).expect("understood");
    Section::new(width, depth, concrete, steel, &reinforcement, 0.03, None).expect("sound")
}

/// 500 × 500 mm, bars of 20 mm with their axes 40 mm from the faces.
pub(crate) fn column() -> Section {
    section(0.5, 0.5, "12 d20")
}

/// 300 × 600 mm, more bars at the bottom.
pub(crate) fn beam() -> Section {
    section(0.3, 0.6, "2 d20 top, 4 d20 bottom")
}

/// A column whose inner bars lie at mid-depth, as the stored values have it.
pub(crate) fn column_in_three_rows() -> Section {
    let mut section = column();
    for bar in &mut section.bars {
        if (bar.depth - 0.25).abs() < 0.2 {
            *bar = Bar {
                depth: 0.25,
                ..*bar
            };
        }
    }
    section
}

#[track_caller]
pub(crate) fn close(value: f64, due: f64, tolerance: f64, what: &str) {
    assert!(
        (value / due - 1.0).abs() <= tolerance,
        "{what}: {value} for {due}"
    );
}
