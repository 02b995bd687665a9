//! NumPy archives: a zip file of `.npy` arrays (NumPy Enhancement Proposal 1, "A simple file format for NumPy arrays").

use std::io::{self, Read, Write};

use flate2::bufread::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive, ZipArchiveWriter};

use super::{ARRAYS, Matrices, Matrix};

/// First bytes of every array.
const MAGIC: &[u8] = b"\x93NUMPY";
/// Most bytes of the header of an array.
const LONGEST_HEADER: usize = 64 << 10;

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
        let matrix = match entry.compression_method() {
            CompressionMethod::STORE => array(&mut local.verifying_reader(local.data())),
            CompressionMethod::DEFLATE => {
                array(&mut local.verifying_reader(DeflateDecoder::new(local.data())))
            }
            _ => Err("is compressed in a way that NumPy does not use".to_owned()),
        };
        let matrix = matrix.map_err(|problem| format!("array {name} {problem}"))?;
        let known = &mut found.places()[place];
        if known.replace(matrix).is_some() {
            let [one, other] = ARRAYS[place];
            return Err(format!("has both {one} and {other}; keep one of them"));
        }
    }
    if found.stiffness.is_none() && found.flexibility.is_none() && !others.is_empty() {
        return Err(format!(
            "has no stiffness matrix K, only {}; name the arrays K, M and, where wanted, C, r and h",
            others.join(", ")
        ));
    }
    Ok(found)
}

/// An `.npy` array of one or two dimensions. Its header says how much is read.
fn array(content: &mut dyn Read) -> Result<Matrix, String> {
    let header = Header::read(content)?;
    let (rows, columns) = (header.rows, header.columns);
    let count = Matrix::possible(rows, columns)?;
    let (size, decode) = decoder(&header.kind)?;
    let mut data = vec![0; count * size];
    content
        .read_exact(&mut data)
        .map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => format!("ends before its {count} numbers"),
            _ => unreadable(&error),
        })?;
    // The end is where the checksum is compared.
    match content.read(&mut [0]) {
        Ok(0) => {}
        Ok(_) => return Err(format!("has more numbers than the {count} of its header")),
        Err(error) => return Err(unreadable(&error)),
    }
    let mut matrix = Matrix::new(rows, columns);
    for (at, value) in data.chunks_exact(size).map(decode).enumerate() {
        let (row, column) = if header.by_columns {
            (at % rows, at / rows)
        } else {
            (at / columns, at % columns)
        };
        matrix.add(row, column, value)?;
    }
    Ok(matrix)
}

fn unreadable(error: &io::Error) -> String {
    format!("cannot be read: {error}")
}

/// What stands before the numbers.
struct Header {
    /// Type of a number, such as `<f8`.
    kind: String,
    by_columns: bool,
    rows: usize,
    columns: usize,
}

impl Header {
    fn read(content: &mut dyn Read) -> Result<Self, String> {
        let broken = || "is no NumPy array".to_owned();
        let mut part = |length: usize| -> Result<Vec<u8>, String> {
            let mut bytes = vec![0; length];
            let read = content.read_exact(&mut bytes);
            read.map_err(|_| broken()).map(|()| bytes)
        };
        if part(MAGIC.len())? != MAGIC {
            return Err(broken());
        }
        let length = match part(2)?[0] {
            1 => {
                let length = part(2)?;
                usize::from(u16::from_le_bytes([length[0], length[1]]))
            }
            2 | 3 => {
                let length: [u8; 4] = part(4)?.try_into().map_err(|_| broken())?;
                u32::from_le_bytes(length) as usize
            }
            _ => return Err("is of an unknown version of the format".into()),
        };
        if length > LONGEST_HEADER {
            return Err(broken());
        }
        let header = String::from_utf8(part(length)?).map_err(|_| broken())?;
        let kind = after(&header, "'descr':").ok_or_else(broken)?;
        let kind = kind.split('\'').nth(1).unwrap_or("an object").to_owned();
        let by_columns = after(&header, "'fortran_order':")
            .is_some_and(|text| text.trim_start().starts_with("True"));
        let shape = after(&header, "'shape':").ok_or_else(broken)?;
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
        Ok(Self {
            kind,
            by_columns,
            rows,
            columns,
        })
    }
}

fn after<'a>(text: &'a str, mark: &str) -> Option<&'a str> {
    text.find(mark).map(|at| &text[at + mark.len()..])
}

/// The number in some bytes.
type Decode = fn(&[u8]) -> f64;

/// Size of a number of a type such as `<f8` \[bytes\], and its value.
fn decoder(kind: &str) -> Result<(usize, Decode), String> {
    fn exact<const N: usize>(bytes: &[u8]) -> [u8; N] {
        bytes.try_into().unwrap_or([0; N])
    }
    Ok(match kind {
        "<f8" => (8, |b| f64::from_le_bytes(exact(b))),
        ">f8" => (8, |b| f64::from_be_bytes(exact(b))),
        "<f4" => (4, |b| f64::from(f32::from_le_bytes(exact(b)))),
        ">f4" => (4, |b| f64::from(f32::from_be_bytes(exact(b)))),
        "<i8" => (8, |b| i64::from_le_bytes(exact(b)) as f64),
        "<i4" => (4, |b| f64::from(i32::from_le_bytes(exact(b)))),
        "|b1" | "|u1" => (1, |b| f64::from(b[0])),
        "|i1" => (1, |b| f64::from(i8::from_le_bytes(exact(b)))),
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
        // F stands for K, whatever else there is.
        let arrays: [(&str, &[usize], Vec<f64>); 2] =
            [("F", &[1, 1], vec![2.0]), ("other", &[1], vec![0.0])];
        let found = parse(&write(&arrays).expect("memory")).expect("an archive");
        assert!(found.flexibility.is_some() && found.stiffness.is_none());
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
        assert!(array(&mut &b"\x93NUMPY\x01\0\xff\xff{}"[..]).is_err());
        let complex = decoder("<c16").map(|(size, _)| size);
        assert!(complex.expect_err("complex").contains("real numbers"));
    }
}
