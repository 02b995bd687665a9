//! Number formats.

/// A whole number with thin spaces between thousands.
#[must_use]
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// Metres as millimetres with one decimal.
#[must_use]
pub fn mm(metres: f64) -> String {
    format!("{:.1}", metres * 1e3)
}

/// Newtons as kilonewtons with one decimal.
#[must_use]
pub fn kn(newtons: f64) -> String {
    format!("{:.1}", newtons * 1e-3)
}

/// One thing or several.
#[must_use]
pub fn counted(count: usize, thing: &str) -> String {
    if count == 1 {
        format!("1 {thing}")
    } else {
        format!("{count} {thing}s")
    }
}

/// The same for large counts.
#[must_use]
pub fn counted_grouped(count: u64, thing: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{} {thing}{plural}", grouped(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_set_apart() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(1234), "1\u{202f}234");
        assert_eq!(grouped(1_000_000), "1\u{202f}000\u{202f}000");
        assert_eq!(
            counted(1, "impact") + &counted(0, "impact"),
            "1 impact0 impacts"
        );
    }
}
