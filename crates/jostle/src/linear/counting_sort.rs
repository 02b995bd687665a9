//! Counting sort by small integers, in linear time.

/// The entries in ascending order of a key below `keys`; stable.
pub(crate) fn in_order<T: Copy>(entries: &[T], keys: usize, key: impl Fn(&T) -> usize) -> Vec<T> {
    let mut next = vec![0; keys + 1];
    for entry in entries {
        next[key(entry) + 1] += 1;
    }
    for key in 0..keys {
        next[key + 1] += next[key];
    }
    let mut ordered = entries.to_vec();
    for entry in entries {
        let place = &mut next[key(entry)];
        ordered[*place] = *entry;
        *place += 1;
    }
    ordered
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_a_stable_sort() {
        let entries: Vec<(usize, usize)> = (0..500).map(|i| ((i * 7919) % 23, i)).collect();
        let mut sorted = entries.clone();
        sorted.sort_by_key(|entry| entry.0);
        assert_eq!(in_order(&entries, 23, |entry| entry.0), sorted);
        assert!(in_order(&entries[..0], 0, |entry| entry.0).is_empty());
    }
}
