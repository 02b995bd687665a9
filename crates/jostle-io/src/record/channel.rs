//! The channels of a file, and how one of them is chosen.

use std::fmt;

use super::error::RecordError;
use super::formats::RecordFormat;
use crate::quantity::shorten;

/// Direction of a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// Horizontal, clockwise from north, 0 to 360 \[degrees\].
    Azimuth(f64),
    /// Horizontal, direction not stated.
    Horizontal,
    /// Vertical.
    Vertical,
    /// Not stated.
    Unknown,
}

impl Direction {
    /// Reads the many spellings of headers: `N-S`, `090`, `360 DEG`, `N28W`, `Up`, `HNE`.
    pub(crate) fn parse(text: &str) -> Self {
        let upper = text.trim().to_ascii_uppercase();
        let word = upper
            .strip_suffix("DEG")
            .or_else(|| upper.strip_suffix("DEGREES"))
            .unwrap_or(&upper)
            .trim();
        match word {
            "N-S" | "NS" | "N" | "NORTH" | "S-N" | "NORTH-SOUTH" => return Self::Azimuth(0.0),
            "E-W" | "EW" | "E" | "EAST" | "W-E" | "EAST-WEST" => return Self::Azimuth(90.0),
            "S" | "SOUTH" => return Self::Azimuth(180.0),
            "W" | "WEST" => return Self::Azimuth(270.0),
            "U-D" | "UD" | "UP" | "DOWN" | "U" | "D" | "Z" | "V" | "VERT" | "VERTICAL" | "DN"
            | "D-U" => {
                return Self::Vertical;
            }
            "H1" | "H2" | "HORIZONTAL" => return Self::Horizontal,
            _ => {}
        }
        if let Ok(azimuth) = word.parse::<f64>()
            && (0.0..=360.0).contains(&azimuth)
        {
            return Self::Azimuth(azimuth % 360.0);
        }
        quadrant(word).map_or(Self::Unknown, Self::Azimuth)
    }

    /// Reads the last letter of a SEED channel code: `HNE`, `HHZ`, `BN1`.
    pub(crate) fn of_channel_code(code: &str) -> Self {
        let code = code.trim();
        match code.chars().next_back().map(|c| c.to_ascii_uppercase()) {
            Some('N') => Self::Azimuth(0.0),
            Some('E') => Self::Azimuth(90.0),
            Some('Z') => Self::Vertical,
            Some('1' | '2') => Self::Horizontal,
            _ => Self::Unknown,
        }
    }
}

/// `N28W` as 332 degrees.
fn quadrant(word: &str) -> Option<f64> {
    let (from, rest) = (word.chars().next()?, word.get(1..)?);
    let (angle, towards) = (
        rest.get(..rest.len().checked_sub(1)?)?,
        rest.chars().next_back()?,
    );
    let angle: f64 = angle.trim().parse().ok()?;
    if !(0.0..=90.0).contains(&angle) {
        return None;
    }
    let azimuth = match (from, towards) {
        ('N', 'E') => angle,
        ('S', 'E') => 180.0 - angle,
        ('S', 'W') => 180.0 + angle,
        ('N', 'W') => 360.0 - angle,
        _ => return None,
    };
    Some(azimuth % 360.0)
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Azimuth(azimuth) => write!(f, "{azimuth:.0}°"),
            Self::Horizontal => f.write_str("horizontal"),
            Self::Vertical => f.write_str("vertical"),
            Self::Unknown => f.write_str("direction not stated"),
        }
    }
}

/// One channel of a record file, as the file describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Number, from 1, in the order of the file.
    pub number: usize,
    /// Name in the file, such as `360 Deg`, `N-S` or `HNE`; empty when there is none.
    pub name: String,
    /// Direction.
    pub direction: Direction,
    /// Unit of the numbers as in the file; `None` when it is stated nowhere.
    pub unit: Option<String>,
    /// Time step as in the file \[s\]; `None` when it is stated nowhere.
    pub step: Option<f64>,
    /// Values in the file.
    pub points: usize,
    /// Peak that the header states, in the unit of the file.
    pub stated_peak: Option<f64>,
    /// Greatest magnitude of the values, in the unit of the file.
    pub largest: f64,
}

impl Channel {
    fn is_horizontal(&self) -> bool {
        matches!(
            self.direction,
            Direction::Azimuth(_) | Direction::Horizontal
        )
    }

    /// Number, name and direction, as in `2: Up (vertical)`.
    #[must_use]
    pub fn label(&self) -> String {
        let number = self.number;
        let name = shorten(&self.name);
        match (name.is_empty(), self.direction) {
            (true, direction) => format!("{number}: {direction}"),
            (false, Direction::Unknown) => format!("{number}: {name}"),
            (false, direction) => format!("{number}: {name} ({direction})"),
        }
    }
}

/// Channels named in messages.
const MOST_LISTED: usize = 24;

pub(crate) fn list(channels: &[Channel]) -> String {
    let labels: Vec<_> = channels
        .iter()
        .take(MOST_LISTED)
        .map(Channel::label)
        .collect();
    let more = channels.len().saturating_sub(MOST_LISTED);
    match more {
        0 => labels.join(", "),
        _ => format!("{}, and {more} more", labels.join(", ")),
    }
}

/// Index of the requested channel; by default the only channel, or the only horizontal one.
pub(crate) fn choose(
    channels: &[Channel],
    wanted: Option<&str>,
    format: RecordFormat,
) -> Result<usize, RecordError> {
    if let Some(wanted) = wanted {
        return find(channels, wanted.trim(), format);
    }
    if channels.len() == 1 {
        return Ok(0);
    }
    let mut horizontal = (0..channels.len()).filter(|at| channels[*at].is_horizontal());
    let first = horizontal.next();
    let others_are_vertical = channels
        .iter()
        .all(|channel| channel.is_horizontal() || channel.direction == Direction::Vertical);
    if let (Some(only), None, true) = (first, horizontal.next(), others_are_vertical) {
        return Ok(only);
    }
    let example = match first {
        Some(_) => "H1".to_owned(),
        None => "1".to_owned(),
    };
    Err(RecordError::WhichComponent {
        format,
        example,
        channels: list(channels),
    })
}

/// A number, the name in the file, `H1`, `H2`, `up`, a compass direction or an azimuth.
fn find(channels: &[Channel], wanted: &str, format: RecordFormat) -> Result<usize, RecordError> {
    let all = 0..channels.len();
    let only = |found: Vec<usize>| match found.as_slice() {
        [one] => Some(Ok(*one)),
        [] => None,
        _ => Some(Err(RecordError::AmbiguousComponent {
            format,
            wanted: shorten(wanted),
            channels: list(channels),
        })),
    };
    let is_name = |at: &usize| channels[*at].name.trim().eq_ignore_ascii_case(wanted);
    let named: Vec<_> = all.clone().filter(is_name).collect();
    if let (false, Some(found)) = (wanted.is_empty(), only(named)) {
        return found;
    }
    let upper = wanted.to_ascii_uppercase();
    // A short number counts channels, one of three digits is an azimuth.
    if wanted.len() < 3
        && let Ok(number) = wanted.parse::<usize>()
        && let Some(at) = all.clone().find(|at| channels[*at].number == number)
    {
        return Ok(at);
    }
    let mut horizontal = all.clone().filter(|at| channels[*at].is_horizontal());
    match upper.as_str() {
        "H1" if channels.len() == 1 && channels[0].direction == Direction::Unknown => return Ok(0),
        "H1" => {
            if let Some(at) = horizontal.next() {
                return Ok(at);
            }
        }
        "H2" => {
            if let Some(at) = horizontal.nth(1) {
                return Ok(at);
            }
        }
        _ => {
            let direction = Direction::parse(wanted);
            // North-south names an axis; an angle or a quadrant names one of its two senses.
            let is_axis = matches!(upper.as_str(), "N-S" | "NS" | "E-W" | "EW");
            let fits = |at: &usize| match (channels[*at].direction, direction) {
                (Direction::Azimuth(a), Direction::Azimuth(b)) => {
                    let turn = (a - b).rem_euclid(if is_axis { 180.0 } else { 360.0 });
                    let full = if is_axis { 180.0 } else { 360.0 };
                    turn.min(full - turn) <= 0.5
                }
                (Direction::Vertical, Direction::Vertical) => true,
                _ => false,
            };
            if let Some(found) = only(all.filter(fits).collect()) {
                return found;
            }
        }
    }
    Err(RecordError::NoComponent {
        format,
        wanted: shorten(wanted),
        channels: list(channels),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_read_in_many_spellings() {
        for (text, wanted) in [
            ("N-S", Direction::Azimuth(0.0)),
            ("EW", Direction::Azimuth(90.0)),
            ("360 Deg", Direction::Azimuth(0.0)),
            ("090", Direction::Azimuth(90.0)),
            ("N28W", Direction::Azimuth(332.0)),
            ("S14E", Direction::Azimuth(166.0)),
            ("Up", Direction::Vertical),
            ("U-D", Direction::Vertical),
            ("roof", Direction::Unknown),
            ("999", Direction::Unknown),
            ("", Direction::Unknown),
            ("N", Direction::Azimuth(0.0)),
            ("é", Direction::Unknown),
        ] {
            assert_eq!(Direction::parse(text), wanted, "{text}");
        }
    }
}
