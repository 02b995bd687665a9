//! Facts as names and values, and lists of values in words.

use crate::message;

/// Names and values of a description list.
pub(crate) type Facts = Vec<(&'static str, String)>;

/// Values from the ground up, with equal neighbours merged: "3.2", "1–3: 60, 4: 40".
pub(crate) fn grouped(values: &[f64], text: impl Fn(f64) -> String) -> String {
    let mut groups: Vec<(usize, usize, f64)> = Vec::new();
    for (i, value) in values.iter().enumerate() {
        match groups.last_mut() {
            Some((_, last, same)) if same == value => *last = i + 1,
            _ => groups.push((i + 1, i + 1, *value)),
        }
    }
    match &groups[..] {
        [(_, _, value)] => text(*value),
        groups if groups.len() > 8 => {
            let low = values.iter().copied().fold(f64::INFINITY, f64::min);
            let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            message::low_to_high(text(low), text(high))
        }
        groups => {
            let texts: Vec<String> = groups
                .iter()
                .map(|(first, last, value)| match first == last {
                    true => format!("{first}: {}", text(*value)),
                    false => format!("{first}–{last}: {}", text(*value)),
                })
                .collect();
            texts.join(", ")
        }
    }
}

/// Values of members, storey by storey from the ground up and from left to right: "60 | 95 | –" where those of a storey differ.
pub(crate) fn by_place(
    storeys: usize,
    of_storey: impl Fn(usize) -> Vec<Option<f64>>,
    text: impl Fn(f64) -> String,
) -> String {
    let rows: Vec<Vec<Option<f64>>> = (0..storeys).map(of_storey).collect();
    let is_plain = |row: &Vec<Option<f64>>| {
        row.iter()
            .all(|candidate| candidate.is_some() && *candidate == row[0])
    };
    if rows.iter().all(is_plain) {
        let values: Vec<f64> = rows.iter().filter_map(|row| *row.first()?).collect();
        return grouped(&values, text);
    }
    let mut groups: Vec<(usize, usize, &Vec<Option<f64>>)> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        match groups.last_mut() {
            Some((_, last, same)) if *same == row => *last = i + 1,
            _ => groups.push((i + 1, i + 1, row)),
        }
    }
    let texts = groups.iter().map(|(first, last, row)| {
        let cells = row
            .iter()
            .map(|row| row.map_or_else(|| "–".to_owned(), &text));
        let cells: Vec<String> = cells.collect();
        match first == last {
            true => format!("{first}: {}", cells.join(" | ")),
            false => format!("{first}–{last}: {}", cells.join(" | ")),
        }
    });
    texts.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format;

    #[test]
    fn equal_storeys_are_said_once() {
        let text = |values: &[f64]| grouped(values, |v| format::plain(v, 2));
        assert_eq!(text(&[3.2, 3.2]), "3.2");
        assert_eq!(text(&[60.0, 60.0, 40.0]), "1–2: 60, 3: 40");
    }

    #[test]
    fn members_of_a_storey_stand_side_by_side_where_they_differ() {
        let text = |rows: &[[Option<f64>; 3]]| {
            by_place(
                rows.len(),
                |storey| rows[storey].to_vec(),
                |v| format::plain(v, 2),
            )
        };
        let [all, some] = [[Some(60.0); 3], [None, Some(60.0), Some(95.0)]];
        assert_eq!(text(&[all, all]), "60");
        assert_eq!(
            text(&[all, some, some]),
            "1: 60 | 60 | 60, 2–3: – | 60 | 95"
        );
    }
}
