//! NumPy archives: a zip file of `.npy` arrays (NumPy Enhancement Proposal 1, "A simple file format for NumPy arrays").

use std::io::{Read, Write};

use flate2::bufread::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive, ZipArchiveWriter};

use super::{ARRAYS, Matrices, Matrix};

/// First bytes of every array.
const MAGIC: &[u8] = b"\x93NUMPY";
/// Most numbers of an array.
const MOST_NUMBERS: usize = 64 << 20;

/// Parses an archive as `numpy.savez` and `numpy.savez_compressed` write it.
///
/// # Errors
/// The problem in words, with the array.
pub(super) fn parse(bytes: &[u8]) -> Result<Matrices, String> {
    let no_archive = |error: &dyn std::fmt::Display| {
        format!("is no NumPy archive ({error}); write it with numpy.savez(\"model.npz\", K=…, M=…)")
    };
    let archive = ZipArchive::from_slice(bytes).map_err(|e| no_archive(&e))?;
    let mut found = Matrices::default();
    let mut others = Vec::new();
    let mut entries = archive.entries();
    while let Some(entry) = entries.next_entry().map_err(|e| no_archive(&e))? {
        let path = String::from_utf8_lossy(entry.file_path().as_ref()).into_owned();
        let name = path.trim_end_matches(".npy").to_owned();
        let Some(place) = ARRAYS
            .iter()
            .position(|names| names.contains(&name.as_str()))
        else {
            others.push(name);
            continue;
        };
        let local = archive
            .get_entry(entry.wayfinder())
            .map_err(|e| no_archive(&e))?;
        let most = 8 * MOST_NUMBERS as u64 + 4096;
        let mut content = Vec::new();
        let read = match entry.compression_method() {
            CompressionMethod::STORE => local
                .verifying_reader(local.data())
                .take(most + 1)
                .read_to_end(&mut content),
            CompressionMethod::DEFLATE => local
                .verifying_reader(DeflateDecoder::new(local.data()))
                .take(most + 1)
                .read_to_end(&mut content),
            _ => {
                return Err(format!(
                    "array {name} is compressed in a way that NumPy does not use"
                ));
            }
        };
        read.map_err(|error| format!("array {name} cannot be read: {error}"))?;
        if content.len() as u64 > most {
            return Err(format!(
                "array {name} is too large; condense the model at fewer displacements"
            ));
        }
        let matrix = array(&content).map_err(|problem| format!("array {name} {problem}"))?;
        let known = &mut found.places()[place];
        if known.replace(matrix).is_some() {
            let [one, other] = ARRAYS[place];
            return Err(format!("has both {one} and {other}; keep one of them"));
        }
    }
    if found.stiffness.is_none() && !others.is_empty() {
        return Err(format!(
            "has no stiffness matrix K, only {}; name the arrays K, M and, where wanted, C, r and h",
            others.join(", ")
        ));
    }
    Ok(found)
}

/// An `.npy` array of one or two dimensions.
fn array(bytes: &[u8]) -> Result<Matrix, String> {
    let broken = || "is no NumPy array".to_owned();
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(broken)?;
    let (start, length) = match rest.first() {
        Some(1) => {
            let length = rest.get(2..4).ok_or_else(broken)?;
            (4, usize::from(u16::from_le_bytes([length[0], length[1]])))
        }
        Some(2 | 3) => {
            let length = rest.get(2..6).ok_or_else(broken)?;
            let length: [u8; 4] = length.try_into().map_err(|_| broken())?;
            (6, u32::from_le_bytes(length) as usize)
        }
        _ => return Err("is of an unknown version of the format".into()),
    };
    let end = start + length;
    let header = rest.get(start..end).ok_or_else(broken)?;
    let header = std::str::from_utf8(header).map_err(|_| broken())?;
    let kind = after(header, "'descr':").ok_or_else(broken)?;
    let kind = kind.split('\'').nth(1).unwrap_or("an object").to_owned();
    let by_columns =
        after(header, "'fortran_order':").is_some_and(|text| text.trim_start().starts_with("True"));
    let shape = after(header, "'shape':").ok_or_else(broken)?;
    let shape = shape.split(['(', ')']).nth(1).unwrap_or("");
    let sizes: Result<Vec<usize>, _> = shape
        .split(',')
        .map(str::trim)
        .filter(|size| !size.is_empty())
        .map(str::parse)
        .collect();
    let (rows, columns) = match sizes.map_err(|_| broken())?[..] {
        [count] => (1, count),
        [rows, columns] => (rows, columns),
        ref other => {
            return Err(format!(
                "has {} dimensions; one or two are possible",
                other.len()
            ));
        }
    };
    let count = rows
        .checked_mul(columns)
        .filter(|count| *count <= MOST_NUMBERS);
    let count = count.ok_or("is too large; condense the model at fewer displacements")?;
    let data = &rest[end..];
    let values = numbers(&kind, data, count)?;
    let mut matrix = Matrix::new(rows, columns);
    for (at, value) in values.into_iter().enumerate() {
        let (row, column) = if by_columns {
            (at % rows, at / rows)
        } else {
            (at / columns, at % columns)
        };
        matrix.add(row, column, value);
    }
    Ok(matrix)
}

fn after<'a>(text: &'a str, mark: &str) -> Option<&'a str> {
    text.find(mark).map(|at| &text[at + mark.len()..])
}

/// Numbers of a type such as `<f8`.
fn numbers(kind: &str, data: &[u8], count: usize) -> Result<Vec<f64>, String> {
    fn all<const N: usize>(data: &[u8], of: impl Fn([u8; N]) -> f64) -> Vec<f64> {
        data.as_chunks().0.iter().map(|bytes| of(*bytes)).collect()
    }
    let size: usize = kind
        .get(2..)
        .and_then(|size| size.parse().ok())
        .unwrap_or(1);
    let Some(data) = data.get(..count * size) else {
        return Err(format!("ends before its {count} numbers"));
    };
    Ok(match kind {
        "<f8" => all(data, f64::from_le_bytes),
        ">f8" => all(data, f64::from_be_bytes),
        "<f4" => all(data, |b| f64::from(f32::from_le_bytes(b))),
        ">f4" => all(data, |b| f64::from(f32::from_be_bytes(b))),
        "<i8" => all(data, |b| i64::from_le_bytes(b) as f64),
        "<i4" => all(data, |b| f64::from(i32::from_le_bytes(b))),
        "|b1" | "|u1" | "|i1" => all(data, |b: [u8; 1]| f64::from(b[0])),
        other => {
            return Err(format!(
                "holds \"{other}\", not real numbers; write K.astype(float), and dense arrays (K.toarray() of a sparse matrix)"
            ));
        }
    })
}

/// An archive of arrays that `numpy.load` opens: name, sizes, and numbers row by row.
///
/// # Errors
/// None that writing to memory can have.
pub(super) fn write(arrays: &[(&str, &[usize], Vec<f64>)]) -> Result<Vec<u8>, rawzip::Error> {
    let mut bytes = Vec::new();
    let mut archive = ZipArchiveWriter::new(&mut bytes);
    for (name, sizes, values) in arrays {
        let sizes: Vec<String> = sizes.iter().map(|size| format!("{size},")).collect();
        let mut header = format!(
            "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}",
            sizes.join(" ")
        );
        // The numbers begin at a multiple of 64 bytes.
        while !(MAGIC.len() + 4 + header.len() + 1).is_multiple_of(64) {
            header.push(' ');
        }
        header.push('\n');
        let file_name = format!("{name}.npy");
        let (mut entry, config) = archive
            .new_file(&file_name)
            .compression_method(CompressionMethod::DEFLATE)
            .start()?;
        let encoder =
            flate2::write::DeflateEncoder::new(&mut entry, flate2::Compression::default());
        let mut writer = config.wrap(encoder);
        writer.write_all(MAGIC)?;
        writer.write_all(&[1, 0])?;
        writer.write_all(&(header.len() as u16).to_le_bytes())?;
        writer.write_all(header.as_bytes())?;
        for value in values {
            writer.write_all(&value.to_le_bytes())?;
        }
        let (encoder, descriptor) = writer.finish()?;
        encoder.finish()?;
        entry.finish(descriptor)?;
    }
    archive.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_come_back() {
        let arrays: [(&str, &[usize], Vec<f64>); 3] = [
            ("K", &[2, 2], vec![2.0, -1.0, -1.0, 1.5]),
            ("M", &[2], vec![3.0, 4.0]),
            ("other", &[1], vec![0.0]),
        ];
        let found = parse(&write(&arrays).expect("memory")).expect("an archive");
        let stiffness = found.stiffness.expect("K");
        let expected = [(0, 0, 2.0), (1, 0, -1.0), (1, 1, 1.5)];
        assert_eq!(stiffness.lower_triangle(2).expect("symmetric"), expected);
        assert_eq!(
            found.mass.expect("M").diagonal(2).expect("a list"),
            [3.0, 4.0]
        );
        assert!(found.damping.is_none());
    }

    #[test]
    fn what_is_no_archive_says_so() {
        assert!(parse(b"PK").expect_err("two bytes").contains("numpy.savez"));
        let none = write(&[("A", &[1], vec![1.0])]).expect("memory");
        assert!(
            parse(&none)
                .expect_err("no K")
                .contains("no stiffness matrix K, only A")
        );
        let mut cut = write(&[("K", &[1, 1], vec![1.0])]).expect("memory");
        let middle = cut.len() / 3;
        cut[middle] ^= 0xff;
        assert!(parse(&cut).is_err());
        assert!(array(b"\x93NUMPY\x01\0\xff\xff{}").is_err());
        assert!(
            numbers("<c16", &[0; 16], 1)
                .expect_err("complex")
                .contains("real numbers")
        );
    }
}
