//! Random damage of inputs, the same for the same seed, and how much of it a test does.

/// Inputs that a scan tries: `JOSTLE_SCAN`, or a usual number.
#[must_use]
pub fn scanned(usual: usize) -> usize {
    number("JOSTLE_SCAN").unwrap_or(usual)
}

/// A sequence of random numbers (xorshift; G. Marsaglia, 2003, J. Stat. Softw. 8, 14). `JOSTLE_SEED` begins another one.
#[derive(Clone, Debug)]
pub struct Dice(u64);

impl Dice {
    /// A sequence of its own for a test.
    #[must_use]
    pub fn new(sequence: u64) -> Self {
        let seed = number("JOSTLE_SEED").unwrap_or(1) as u64;
        let mut dice = Self(0x9E37_79B9_7F4A_7C15 ^ (seed << 20) ^ sequence);
        for _ in 0..20 {
            dice.below(2);
        }
        dice
    }

    /// A number below a limit.
    pub fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }

    /// One of several.
    ///
    /// # Panics
    /// If there are none.
    pub fn one<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }

    /// A text with up to four of: a bit flipped, a piece cut, a piece repeated, words exchanged, a word in place of another, of a list
    /// of values that often break readers.
    pub fn damage(&mut self, bytes: &[u8]) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        for _ in 0..=self.below(4) {
            if bytes.is_empty() {
                break;
            }
            let at = self.below(bytes.len());
            let end = (at + 1 + self.below(20)).min(bytes.len());
            match self.below(6) {
                0 => bytes[at] ^= 1 << self.below(8),
                1 => drop(bytes.drain(at..end)),
                2 => {
                    let piece = bytes[at..end].to_vec();
                    let times = *self.one(&[1, 2, 100]);
                    bytes.splice(at..at, piece.repeat(times));
                }
                3 => bytes.truncate(at),
                _ => {
                    // A number or a word.
                    let ends = |byte: &u8| !byte.is_ascii_alphanumeric() && !b".-+".contains(byte);
                    let start = bytes[..at].iter().rposition(ends).map_or(0, |p| p + 1);
                    let stop = bytes[at..]
                        .iter()
                        .position(ends)
                        .map_or(bytes.len(), |p| at + p);
                    if start < stop {
                        let value = *self.one(&STRANGE);
                        bytes.splice(start..stop, value.bytes());
                    }
                }
            }
        }
        bytes
    }
}

/// Values that often break readers.
const STRANGE: [&str; 24] = [
    "0",
    "-1",
    "1e300",
    "-1e300",
    "1e-300",
    "1e400",
    "nan",
    "inf",
    "true",
    "\"\"",
    "[]",
    "{}",
    "[[]]",
    "9223372036854775808",
    "2147483648",
    "../../etc/passwd",
    "/dev/zero",
    "\u{feff}",
    "é",
    "[*]",
    "a.b.c",
    "1979-05-27",
    "'",
    "1_000",
];

fn number(name: &str) -> Option<usize> {
    std::env::var(name).ok()?.parse().ok()
}
