//! One case as a row of the table.

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// To the end of the motion.
    Completed,
    /// A building collapsed.
    Collapsed,
    /// It could not be computed.
    Failed,
}

impl Status {
    /// As in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Completed => "completed",
            Self::Collapsed => "collapsed",
            Self::Failed => "failed",
        }
    }

    fn code(self) -> u8 {
        match self {
            Self::Completed => 0,
            Self::Collapsed => 1,
            Self::Failed => 2,
        }
    }
}

/// One case: its inputs and what came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Number of the case, from 0.
    pub case: u64,
    /// How it ended.
    pub status: Status,
    /// Why it did not complete, or what should be known about it.
    pub reason: String,
    /// Numbers in the order of the columns; a whole number is kept as one here too.
    pub numbers: Vec<Option<f64>>,
    /// Texts in the order of the columns.
    pub texts: Vec<String>,
}

impl Row {
    /// The row as bytes.
    pub(crate) fn encode(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(64 + 9 * self.numbers.len());
        bytes.extend(self.case.to_le_bytes());
        bytes.push(self.status.code());
        bytes.extend((self.numbers.len() as u32).to_le_bytes());
        for number in &self.numbers {
            bytes.push(u8::from(number.is_some()));
            bytes.extend(number.unwrap_or(0.0).to_bits().to_le_bytes());
        }
        bytes.extend((self.texts.len() as u32 + 1).to_le_bytes());
        for text in self.texts.iter().chain(std::iter::once(&self.reason)) {
            bytes.extend((text.len() as u32).to_le_bytes());
            bytes.extend(text.as_bytes());
        }
        bytes
    }

    /// The row from its bytes; `None` if they are not a row.
    pub(crate) fn decode(bytes: &[u8]) -> Option<Self> {
        let mut rest = bytes;
        let mut take = |count: usize| -> Option<&[u8]> {
            let (taken, left) = rest.split_at_checked(count)?;
            rest = left;
            Some(taken)
        };
        let case = u64::from_le_bytes(take(8)?.try_into().ok()?);
        let status = match take(1)?[0] {
            0 => Status::Completed,
            1 => Status::Collapsed,
            2 => Status::Failed,
            _ => return None,
        };
        let count = u32::from_le_bytes(take(4)?.try_into().ok()?);
        let mut numbers = Vec::new();
        for _ in 0..count {
            let present = take(1)?[0] == 1;
            let bits = u64::from_le_bytes(take(8)?.try_into().ok()?);
            numbers.push(present.then_some(f64::from_bits(bits)));
        }
        let count = u32::from_le_bytes(take(4)?.try_into().ok()?);
        let mut texts = Vec::new();
        for _ in 0..count {
            let length = u32::from_le_bytes(take(4)?.try_into().ok()?);
            texts.push(String::from_utf8(take(length as usize)?.to_vec()).ok()?);
        }
        let reason = texts.pop()?;
        rest.is_empty().then_some(Self {
            case,
            status,
            reason,
            numbers,
            texts,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back_bit_for_bit_and_damage_is_noticed() {
        let row = Row {
            case: 77,
            status: Status::Collapsed,
            reason: "stürzt ein".into(),
            numbers: vec![Some(0.1), None, Some(-0.0), Some(f64::MIN_POSITIVE)],
            texts: vec!["el-centro".into(), String::new()],
        };
        let bytes = row.encode();
        assert_eq!(Row::decode(&bytes), Some(row));
        for length in 0..bytes.len() {
            assert_eq!(Row::decode(&bytes[..length]), None, "{length} bytes");
        }
    }
}
