//! Matrix Market files (R. F. Boisvert, R. Pozo, K. Remington, 1996, The Matrix Market exchange formats, NISTIR 5935).

use super::Matrix;

/// Parses coordinate and array files of real or integer numbers, general or symmetric.
///
/// # Errors
/// The problem in words, with its line.
pub(super) fn parse(text: &str) -> Result<Matrix, String> {
    let mut lines = text.lines().enumerate();
    let header = lines.next().map_or("", |(_, line)| line);
    let words: Vec<String> = header
        .split_whitespace()
        .map(str::to_ascii_lowercase)
        .collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let ["%%matrixmarket", "matrix", format, field, symmetry] = words[..] else {
        return Err(
            "is no Matrix Market file: its first line is not \"%%MatrixMarket matrix …\"".into(),
        );
    };
    let by_coordinates = match format {
        "coordinate" => true,
        "array" => false,
        other => {
            return Err(format!(
                "line 1: \"{other}\" is not known; coordinate and array are"
            ));
        }
    };
    if !["real", "integer", "double"].contains(&field) {
        return Err(format!(
            "line 1: entries are \"{field}\"; they must be real"
        ));
    }
    let symmetric = match symmetry {
        "general" => false,
        "symmetric" => true,
        other => {
            return Err(format!(
                "line 1: \"{other}\" is not possible; general and symmetric are"
            ));
        }
    };
    let mut lines = lines.filter(|(_, line)| {
        let line = line.trim();
        !line.is_empty() && !line.starts_with('%')
    });
    let (at, sizes) = lines.next().ok_or("ends before its sizes")?;
    let sizes: Vec<usize> = numbers(at, sizes)?;
    if let [rows, columns, ..] = sizes[..] {
        let possible = Matrix::possible(rows, columns);
        possible.map_err(|problem| format!("line {}: {problem}", at + 1))?;
    }
    let (rows, columns, count) = match (by_coordinates, &sizes[..]) {
        (true, [rows, columns, count]) => (*rows, *columns, *count),
        (false, [rows, columns]) if symmetric => (*rows, *columns, rows * (rows + 1) / 2),
        (false, [rows, columns]) => (*rows, *columns, rows * columns),
        _ => {
            return Err(format!(
                "line {}: expected the number of rows, columns and entries",
                at + 1
            ));
        }
    };
    let mut matrix = Matrix::new(rows, columns);
    let mut place = (0, 0);
    let mut found = 0;
    for (at, line) in lines {
        let (row, column, value) = if by_coordinates {
            let parts: Vec<f64> = numbers(at, line)?;
            let [row, column, value] = parts[..] else {
                return Err(format!("line {}: expected row, column and value", at + 1));
            };
            let inside = |place: f64, most: usize| {
                place >= 1.0 && place <= most as f64 && place.fract() == 0.0
            };
            if !inside(row, rows) || !inside(column, columns) {
                return Err(format!(
                    "line {}: there is no row {row}, column {column}",
                    at + 1
                ));
            }
            (row as usize - 1, column as usize - 1, value)
        } else {
            let parts: Vec<f64> = numbers(at, line)?;
            let ([value], true) = (&parts[..], place.1 < columns) else {
                return Err(format!("line {}: expected one of {count} values", at + 1));
            };
            let entry = (place.0, place.1, *value);
            place.0 += 1;
            if place.0 == rows {
                place.1 += 1;
                place.0 = if symmetric { place.1 } else { 0 };
            }
            entry
        };
        found += 1;
        let mut add = |row: usize, column: usize| {
            let added = matrix.add(row, column, value);
            added.map_err(|problem| format!("line {}: {problem}", at + 1))
        };
        add(row, column)?;
        if symmetric && row != column {
            add(column, row)?;
        }
    }
    if found == count {
        Ok(matrix)
    } else {
        Err(format!("states {count} entries and has {found}"))
    }
}

fn numbers<T: std::str::FromStr>(at: usize, line: &str) -> Result<Vec<T>, String> {
    let words = line.split_whitespace();
    words
        .map(|word| {
            word.parse()
                .map_err(|_| format!("line {}: \"{word}\" is no number", at + 1))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_gives_the_same_matrix() {
        let coordinates = "%%MatrixMarket matrix coordinate real symmetric\n% by hand\n2 2 3\n1 1 2\n2 1 -1\n2 2 1e0\n";
        let general =
            "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 2\n2 1 -1\n1 2 -1\n2 2 1\n";
        let array = "%%MatrixMarket matrix array real general\n2 2\n2\n-1\n-1\n1\n";
        let lower = "%%MatrixMarket matrix array integer symmetric\n2 2\n2\n-1\n1\n";
        let matrices =
            [coordinates, general, array, lower].map(|text| parse(text).expect("a matrix"));
        let expected = [(0, 0, 2.0), (1, 0, -1.0), (1, 1, 1.0)];
        for matrix in matrices {
            assert_eq!(matrix.lower_triangle(2).expect("symmetric"), expected);
        }
    }

    #[test]
    fn faults_name_their_line() {
        for (text, expected) in [
            ("1 2 3", "first line"),
            (
                "%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 1 0\n",
                "must be real",
            ),
            (
                "%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 1\n",
                "line 3: there is no row 3",
            ),
            (
                "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 1\n",
                "states 2 entries and has 1",
            ),
            (
                "%%MatrixMarket matrix array real general\n1 1\nx\n",
                "line 3: \"x\" is no number",
            ),
            (
                "%%MatrixMarket matrix array real general\n1 1\n1\n2\n",
                "line 4: expected one of 1 values",
            ),
            (
                "%%MatrixMarket matrix coordinate real general\n0 2 0\n",
                "of each are possible",
            ),
        ] {
            let problem = parse(text).expect_err("a fault");
            assert!(problem.contains(expected), "{problem}");
        }
    }
}
