//! The checksum of miniSEED 3: CRC-32C (Castagnoli), bit by bit reflected.

use std::ops::Range;

/// Checksum of bytes; a range is taken as zero, because the record contains its own checksum.
pub(crate) fn crc32c(bytes: &[u8], hole: Range<usize>) -> u32 {
    let mut remainder = u32::MAX;
    for (at, byte) in bytes.iter().enumerate() {
        let byte = if hole.contains(&at) { 0 } else { *byte };
        remainder = remainder >> 8 ^ TABLE[usize::from(remainder as u8 ^ byte)];
    }
    !remainder
}

const TABLE: [u32; 256] = table();

const fn table() -> [u32; 256] {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut value = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            value = if value & 1 == 1 {
                value >> 1 ^ 0x82F6_3B78
            } else {
                value >> 1
            };
            bit += 1;
        }
        table[byte] = value;
        byte += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::crc32c;

    #[test]
    fn published_check_values() {
        // RFC 3720, appendix B.4, and the usual check of CRC catalogues.
        assert_eq!(crc32c(b"123456789", 0..0), 0xE306_9283);
        assert_eq!(crc32c(&[0; 32], 0..0), 0x8A91_36AA);
        assert_eq!(crc32c(&[0xFF; 32], 0..0), 0x62A8_AB43);
        assert_eq!(crc32c(&[0xFF; 32], 0..32), 0x8A91_36AA);
    }
}
