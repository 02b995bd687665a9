//! Damage that knows what records look like: bits, numbers, lines, headers, pieces of other formats.

/// Reproducible random numbers (splitmix64).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound.max(1) as u64) as usize
    }
}

/// Numbers that readers stumble over.
const NUMBERS: &[&str] = &[
    "0",
    "-1",
    "1",
    "100",
    "99999999",
    "4294967295",
    "18446744073709551616",
    "-999",
    "-12345",
    "nan",
    "inf",
    "-inf",
    "1e999",
    "1e-999",
    "1.7E+38",
    ".",
    "-",
    "",
    "****",
    "1.5D-3",
    "0,5",
    "1_0",
    "٣",
    "é",
    "(8F10.3)",
    "(999F1.0)",
    "(0I0)",
    "(1P8E10.3)",
    "100Hz",
    "3920(gal)/0",
    "1/0",
    "#",
    "/&",
    "|",
];

/// Bytes that mean something in binary headers.
const BYTES: &[u8] = &[0, 1, 6, 7, 10, 11, 28, 31, 32, 48, 64, 127, 128, 255];

/// A damaged copy of a file; pieces of another one may come in.
pub(crate) fn mutate(bytes: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + random.below(4) {
        if bytes.is_empty() {
            return bytes;
        }
        // Headers are short beside the values: hit them as often.
        let reach = if random.below(2) == 0 {
            bytes.len()
        } else {
            bytes.len().min(1500)
        };
        let at = random.below(reach);
        match random.below(12) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = BYTES[random.below(BYTES.len())],
            2 => bytes[at] = (random.next() & 0xFF) as u8,
            3 => bytes.truncate(at),
            4 => replace_word(
                &mut bytes,
                at,
                NUMBERS[random.below(NUMBERS.len())].as_bytes(),
            ),
            5 => replace_digit(&mut bytes, at, random),
            6 => {
                let (from, to) = line_at(&bytes, at);
                bytes.drain(from..to);
            }
            7 => {
                let (from, to) = line_at(&bytes, at);
                let line = bytes[from..to].to_vec();
                bytes.splice(from..from, line);
            }
            8 => {
                let (from, to) = line_at(&bytes, at);
                let line = bytes[from..to].to_vec();
                let target = random.below(bytes.len() + 1);
                bytes.splice(target..target, line);
            }
            9 => {
                let start = random.below(other.len());
                let end = (start + random.below(200)).min(other.len());
                let until = (at + random.below(200)).min(bytes.len());
                bytes.splice(at..until, other[start..end].iter().copied());
            }
            10 => bytes.truncate(bytes.len() - random.below(bytes.len().min(64))),
            _ => {
                let value = (random.next() as u32).to_be_bytes();
                for (offset, byte) in value.into_iter().enumerate() {
                    if let Some(place) = bytes.get_mut(at + offset) {
                        *place = byte;
                    }
                }
            }
        }
    }
    bytes
}

fn is_gap(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == b',' || byte == b';'
}

fn replace_word(bytes: &mut Vec<u8>, at: usize, word: &[u8]) {
    let from = bytes[..at]
        .iter()
        .rposition(|b| is_gap(*b))
        .map_or(0, |p| p + 1);
    let to = bytes[at..]
        .iter()
        .position(|b| is_gap(*b))
        .map_or(bytes.len(), |p| at + p);
    if from > to || to - from > 100 {
        return;
    }
    // Half of the time the columns stay where they are.
    let mut word = word.to_vec();
    if word.len() < to - from && at.is_multiple_of(2) {
        let mut padded = vec![b' '; to - from - word.len()];
        padded.append(&mut word);
        word = padded;
    }
    bytes.splice(from..to, word);
}

fn replace_digit(bytes: &mut [u8], at: usize, random: &mut Random) {
    let found = bytes[at..].iter().position(u8::is_ascii_digit);
    if let Some(offset) = found {
        bytes[at + offset] = b'0' + random.below(10) as u8;
    }
}

fn line_at(bytes: &[u8], at: usize) -> (usize, usize) {
    let from = bytes[..at]
        .iter()
        .rposition(|b| *b == b'\n')
        .map_or(0, |p| p + 1);
    let to = bytes[at..]
        .iter()
        .position(|b| *b == b'\n')
        .map_or(bytes.len(), |p| at + p + 1);
    (from, to.max(from))
}
