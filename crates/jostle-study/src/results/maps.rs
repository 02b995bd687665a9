//! Heat maps over two factors.

use jostle_report::message;
use jostle_report::{Cell, HeatMap};

use super::{Results, words};

/// Quantities of heat maps, and the meaning of a cell without a value.
const SHOWN: [(&str, &str); 3] = [
    ("peak_force_n", "no result"),
    ("impact_count", "no result"),
    ("first_impact_s", "no impact"),
];
/// Groups of maps at most.
const MOST_GROUPS: usize = 12;
/// Cells of a map at most.
const MOST_CELLS: usize = 20_000;

impl Results<'_> {
    pub(super) fn maps(&self) -> Vec<(String, Vec<HeatMap>)> {
        let Some((right, up)) = self.plane() else {
            return Vec::new();
        };
        let (columns, rows) = (self.numbers(right), self.numbers(up));
        if columns.len() * rows.len() > MOST_CELLS {
            return Vec::new();
        }
        let (xs, ys) = (self.input(right), self.input(up));
        let groups = self.grouped(&self.others(&[right, up]));
        let one = |cases: &[usize], shown: &str, nothing: &str| {
            let values = self.table.column(shown);
            if values.is_empty() {
                return None;
            }
            let mut inside: Vec<Vec<usize>> = vec![Vec::new(); columns.len() * rows.len()];
            for &case in cases {
                let at = |values: &[Option<f64>], places: &[f64]| {
                    let value = values.get(case).copied().flatten()?;
                    places.iter().position(|place| *place == value)
                };
                if let (Some(column), Some(row)) = (at(&xs, &columns), at(&ys, &rows)) {
                    inside[row * columns.len() + column].push(case);
                }
            }
            let (mut value, size) = words::axis(shown);
            if inside.iter().any(|cases| cases.len() > 1) {
                value.name = message::mean_of_name(&value.name);
            }
            let (x, x_size) = self.input_axis(right);
            let (y, y_size) = self.input_axis(up);
            let cell = |cases: &Vec<usize>| {
                let present: Vec<f64> = cases.iter().filter_map(|case| values[*case]).collect();
                let mean = present.iter().sum::<f64>() / present.len() as f64;
                Cell {
                    value: (!present.is_empty()).then_some(size * mean),
                    cases: match &cases[..] {
                        [row] => message::case_of_number(self.sample.case(*row)),
                        all => message::mean_of_cases(all.len()),
                    },
                    link: cases
                        .iter()
                        .find_map(|case| self.link(self.sample.case(*case))),
                }
            };
            Some(HeatMap {
                value,
                x,
                y,
                columns: columns.iter().map(|value| x_size * value).collect(),
                rows: rows.iter().map(|value| y_size * value).collect(),
                cells: inside.iter().map(cell).collect(),
                nothing: nothing.to_owned(),
            })
        };
        groups
            .into_iter()
            .take(MOST_GROUPS)
            .map(|(name, cases)| {
                let maps = SHOWN
                    .iter()
                    .filter_map(|(shown, nothing)| one(&cases, shown, nothing));
                (name, maps.collect())
            })
            .collect()
    }
}
