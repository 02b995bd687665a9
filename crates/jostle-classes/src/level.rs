//! Design levels.

use std::str::FromStr;

/// How well a building was designed for earthquakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Before any code.
    Pre,
    /// Low code.
    Low,
    /// Moderate code.
    Moderate,
    /// High code.
    High,
}

impl Level {
    /// All, from the worst to the best.
    pub const ALL: [Self; 4] = [Self::Pre, Self::Low, Self::Moderate, Self::High];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pre => "pre",
            Self::Low => "low",
            Self::Moderate => "moderate",
            Self::High => "high",
        }
    }

    /// First years of the levels in California: no code before 1941, a moderate one to 1975, a high one from 1976 on,
    /// as the regional workflow of SimCenter takes it.
    pub const CALIFORNIA: [(Self, i32); 2] = [(Self::Moderate, 1941), (Self::High, 1976)];

    /// The level of a year of construction, from the first years of levels; before all of them there is no code.
    #[must_use]
    pub fn in_year(year: i32, since: &[(Self, i32)]) -> Self {
        let begun = since.iter().filter(|(_, first)| *first <= year);
        begun
            .max_by_key(|(_, first)| *first)
            .map_or(Self::Pre, |(level, _)| *level)
    }
}

impl FromStr for Level {
    type Err = String;

    /// `high`, `HC`, `High-Code`, `high_code`, …
    fn from_str(text: &str) -> Result<Self, String> {
        let plain: String = text
            .to_lowercase()
            .chars()
            .filter(char::is_ascii_alphabetic)
            .collect();
        let short = plain.strip_suffix("code").unwrap_or(&plain);
        match short {
            "pre" | "pc" => Ok(Self::Pre),
            "low" | "lc" => Ok(Self::Low),
            "moderate" | "mc" => Ok(Self::Moderate),
            "high" | "hc" => Ok(Self::High),
            _ => Err(format!(
                "\"{text}\" is no design level: high, moderate, low or pre"
            )),
        }
    }
}
