//! Times of day, as loggers write them: `12:30:05.25`, `2024-02-29T23:59:59.995`.

use super::lines::last_digit;

/// A time of day, with its date if it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock {
    /// Days since 1 January 1970.
    pub(crate) day: Option<i64>,
    /// Since midnight, or since the full hour of a time without hours \[s\].
    pub(crate) seconds: f64,
    /// Unit of the last printed digit \[s\].
    pub(crate) digit: f64,
}

impl Clock {
    /// Reads `hh:mm:ss.fff` or `mm:ss.fff`, with a date before it or without; a zone behind it is ignored.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let (date, time) = match text.split_once(['T', ' ', '_']) {
            Some((date, time)) => (Some(date), time.trim()),
            None => (None, text),
        };
        let day = match date {
            Some(date) => Some(day(date)?),
            None => None,
        };
        let time = time.trim_end_matches('Z');
        let time = match time.rfind(['+', '-']) {
            // A zone such as +03:00.
            Some(at) if day.is_some() => &time[..at],
            _ => time,
        };
        let whole = |text: &str, most: u32| {
            let digits = (1..=2).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
            let value = text.parse::<u32>().ok().filter(|_| digits)?;
            (value < most).then_some(f64::from(value))
        };
        let parts: Vec<&str> = time.split(':').collect();
        let (hours, minutes, seconds) = match parts[..] {
            [hours, minutes, seconds] => (whole(hours, 24)?, whole(minutes, 60)?, seconds),
            [minutes, seconds] => (0.0, whole(minutes, 60)?, seconds),
            _ => return None,
        };
        let (before, after) = seconds.split_once(['.', ',']).unwrap_or((seconds, "0"));
        whole(before, 60)?;
        if after.is_empty() || !after.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let value: f64 = seconds.replace(',', ".").parse().ok()?;
        Some(Self {
            day,
            seconds: 3600.0 * hours + 60.0 * minutes + value,
            digit: last_digit(seconds),
        })
    }
}

/// Days from 1 January 1970 to a date such as `2024-02-29` or `2024/02/29`.
pub(crate) fn day(text: &str) -> Option<i64> {
    let parts: Vec<&str> = text.split(['-', '/']).collect();
    let [year, month, day] = parts[..] else {
        return None;
    };
    let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    if year.len() != 4 || ![year, month, day].into_iter().all(digits) {
        return None;
    }
    let (year, month, day): (i64, i64, i64) =
        (year.parse().ok()?, month.parse().ok()?, day.parse().ok()?);
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    // Years begin in March, so that the day of a leap year is the last.
    let year = if month <= 2 { year - 1 } else { year };
    let month = (month + 9) % 12;
    let leaps = year / 4 - year / 100 + year / 400;
    Some(365 * year + leaps + (153 * month + 2) / 5 + day - 1 - 719_468)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_of_day_are_read() {
        for (text, day, seconds, digit) in [
            ("00:00:00.000", None, 0.0, 1e-3),
            ("12:30:05.25", None, 45_005.25, 1e-2),
            ("59:59.5", None, 3599.5, 0.1),
            ("1970-01-02T00:00:01Z", Some(1), 1.0, 1.0),
            ("2000/03/01 23:59:59,5", Some(11_017), 86_399.5, 0.1),
            ("2024-02-29T10:00:00.5+03:00", Some(19_782), 36_000.5, 0.1),
        ] {
            let found = Clock::parse(text).unwrap_or_else(|| panic!("{text}"));
            assert_eq!((found.day, found.seconds), (day, seconds), "{text}");
            assert!((found.digit - digit).abs() < 1e-12, "{text}");
        }
        for text in [
            "",
            "12",
            "25:00:00",
            "10:60:00",
            "10:00:60",
            "10:00:1.",
            "a:b:c",
            "2024-13-01T00:00:00",
            "0.1",
            "é:00",
        ] {
            assert_eq!(Clock::parse(text), None, "{text}");
        }
    }
}
