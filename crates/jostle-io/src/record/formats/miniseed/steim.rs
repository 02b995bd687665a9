//! Steim-1 and Steim-2: differences of whole numbers packed into frames of sixteen words.
//!
//! Source: SEED reference manual 2.4 (FDSN, IRIS, USGS, 2012), appendix B.

/// Words of a frame; the first one describes the others.
const WORDS: usize = 16;
const FRAME: usize = 4 * WORDS;

/// How a word is cut into differences: their number and width in bits.
fn layout(code: u32, word: u32, second: bool) -> Option<(u32, u32)> {
    Some(match (code, second, word >> 30) {
        (1, ..) => (4, 8),
        (2, false, _) => (2, 16),
        (3, false, _) => (1, 32),
        (2, true, 1) => (1, 30),
        (2, true, 2) => (2, 15),
        (2, true, 3) => (3, 10),
        (3, true, 0) => (5, 6),
        (3, true, 1) => (6, 5),
        (3, true, 2) => (7, 4),
        _ => return None,
    })
}

/// Decodes `count` whole numbers and appends them. Says what is wrong.
///
/// The first difference leads from the record before; the first value is stated, and so is the last one, which
/// is how damage shows.
pub(crate) fn decode(
    data: &[u8],
    count: usize,
    big_endian: bool,
    second: bool,
    values: &mut Vec<f64>,
) -> Result<(), &'static str> {
    // Byte order is that of the differences: bytes stay in the order of the file, halves of a word too.
    let read = |at: usize, size: usize| -> Option<u32> {
        let mut bytes: [u8; 4] = data.get(at..at + 4)?.try_into().ok()?;
        if !big_endian {
            bytes.chunks_mut(size).for_each(<[u8]>::reverse);
        }
        Some(u32::from_be_bytes(bytes))
    };
    let stated = |word: usize| read(4 * word, 4).ok_or("there is no frame of data");
    let (first, last) = (stated(1)?.cast_signed(), stated(2)?.cast_signed());
    let mut value = first;
    let mut found = 0;
    'frames: for frame in (0..data.len() / FRAME * FRAME).step_by(FRAME) {
        let codes = read(frame, 4).unwrap_or(0);
        for word in 1..WORDS {
            let code = codes >> (30 - 2 * word) & 3;
            if code == 0 || frame == 0 && word <= 2 {
                continue;
            }
            let size = match (code, second) {
                (1, _) => 1,
                (2, false) => 2,
                _ => 4,
            };
            let packed = read(frame + 4 * word, size).unwrap_or(0);
            let (parts, bits) =
                layout(code, packed, second).ok_or("a frame has an unknown code")?;
            for part in (0..parts).rev() {
                let lifted = packed << (32 - bits * (part + 1));
                let difference = lifted.cast_signed() >> (32 - bits);
                // The first difference belongs to the value before the first.
                if found > 0 {
                    value = value
                        .checked_add(difference)
                        .ok_or("a value leaves 32 bits")?;
                }
                values.push(f64::from(value));
                found += 1;
                if found == count {
                    break 'frames;
                }
            }
        }
    }
    if found < count {
        return Err("the frames hold fewer values than the header announces");
    }
    if value != last {
        return Err("the last value is not the one that the first frame states");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::decode;

    /// Differences of every width.
    const VALUES: [i32; 30] = [
        7,
        8,
        6,
        5,
        5,
        4,
        -3,
        -30,
        90,
        60,
        75,
        -700,
        900,
        901,
        880,
        25_000,
        -31_000,
        -31_001,
        -30_000,
        -29_000,
        -29_010,
        -29_005,
        900_000,
        -40_000_000,
        -40_000_001,
        -40_000_100,
        -40_000_003,
        -39_999_990,
        -39_999_000,
        -39_999_500,
    ];

    /// The same values written by libmseed (by way of ObsPy 1.5.1): whether Steim-2, whether big-endian, and the
    /// frames without the zeros at their end.
    const WRITTEN: [(bool, bool, &str); 4] = [
        (
            false,
            true,
            "016abafd00000007fd9da7f40001feff00fff9e50078ffe2000ffcf906400001ffeb5e38ffff2540ffff03e903e8fff600000005000e2cedfd8fea60ff9d610d2000000003defe0c",
        ),
        (
            false,
            false,
            "fdba6a0107000000f4a79dfd0001feff00fff9e57800e2ff0f00f9fc40060100ebff385e4025ffffffffe903e803f6ff05000000ed2c0e0060ea8ffdff9d610d00000020de030cfe",
        ),
        (
            true,
            true,
            "036aaaa600000007fd9da7f4801ef0f9e578e20fbe7c86408000ffeb40005e387fff2540bfff83e981f47ff640000005400e2ced7d8fea60ff9d610d81ef7e0c",
        ),
        (
            true,
            false,
            "a6aa6a0307000000f4a79dfdf9f01e80e578e20f40867cbeebff0080385e00404025ff7fe983ffbff67ff48105000040ed2c0e4060ea8f7dff9d610d0c7eef81",
        ),
    ];

    fn frames(hex: &str) -> Vec<u8> {
        let byte = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).unwrap_or_default();
        let mut data: Vec<u8> = (0..hex.len()).step_by(2).map(byte).collect();
        data.resize(data.len().next_multiple_of(64), 0);
        data
    }

    #[test]
    fn frames_of_another_program_are_decoded() {
        for (second, big_endian, hex) in WRITTEN {
            let mut values = Vec::new();
            let read = decode(&frames(hex), VALUES.len(), big_endian, second, &mut values);
            assert_eq!(read, Ok(()), "second {second}, big-endian {big_endian}");
            assert_eq!(
                values,
                VALUES.map(f64::from),
                "second {second}, big-endian {big_endian}"
            );
        }
    }

    #[test]
    fn counts_and_last_value_must_fit() {
        let data = frames(WRITTEN[2].2);
        let decode = |count| decode(&data, count, true, true, &mut Vec::new());
        assert!(
            decode(VALUES.len() - 1).is_err(),
            "one value less than the last"
        );
        assert!(
            decode(VALUES.len() + 1).is_err(),
            "one value more than there are"
        );
        assert!(
            super::decode(&[], 1, true, true, &mut Vec::new()).is_err(),
            "no frame"
        );
    }
}
