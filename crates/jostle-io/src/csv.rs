//! Text fields of CSV files.

/// First characters that a spreadsheet interprets as a formula (OWASP, "CSV Injection").
const FORMULA: [char; 7] = ['=', '+', '-', '@', '\t', '\r', '\n'];

/// A text as a field of a CSV file: in quotes if RFC 4180 requires them, and after an apostrophe if a spreadsheet
/// would interpret it as a formula. Numbers need neither.
#[must_use]
pub fn csv_field(text: &str) -> String {
    let text = inert(text);
    if text.contains([',', ';', '"', '\n', '\r', '\t']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text
    }
}

/// A text for a line of remarks, whose parts between commas or semicolons a spreadsheet would read as fields.
pub(crate) fn csv_remark(text: &str) -> String {
    let pieces = text.split_inclusive([',', ';']);
    let inert_piece = |piece: &str| {
        let body = piece.trim_start();
        let spaces = &piece[..piece.len() - body.len()];
        format!("{spaces}{}", inert(body))
    };
    pieces.map(inert_piece).collect()
}

/// A text that no spreadsheet interprets as a formula.
fn inert(text: &str) -> String {
    if text.starts_with(FORMULA) {
        format!("'{text}")
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_texts() {
        for (text, field) in [
            ("J1", "J1"),
            ("a, b", "\"a, b\""),
            ("5\" pipe", "\"5\"\" pipe\""),
            ("=1+1", "'=1+1"),
            ("+1", "'+1"),
            ("-1", "'-1"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("\t=1", "\"'\t=1\""),
            ("\r=1", "\"'\r=1\""),
            (
                "=HYPERLINK(\"x\",\"y\")",
                "\"'=HYPERLINK(\"\"x\"\",\"\"y\"\")\"",
            ),
            ("a=b", "a=b"),
            ("", ""),
        ] {
            assert_eq!(csv_field(text), field, "{text:?}");
        }
    }

    #[test]
    fn remarks_hold_no_field_that_is_a_formula() {
        assert_eq!(csv_remark("Kobe, 1995; N-S"), "Kobe, 1995; N-S");
        assert_eq!(csv_remark("x, =1;@a,b"), "x, '=1;'@a,b");
    }
}
