//! Stable sorting in little machine code: the sort of the standard library is compiled anew, in eight kilobytes, for every
//! type and every comparison. Here one instance sorts indices.

use std::cmp::Ordering;

/// Sorts as [`slice::sort_by`] does. For lists that are sorted seldom: it allocates a list of indices.
pub fn sort_by<T>(list: &mut [T], mut compare: impl FnMut(&T, &T) -> Ordering) {
    let mut from = order(list.len(), &mut |a, b| compare(&list[a], &list[b]));
    for start in 0..list.len() {
        let mut place = start;
        loop {
            let source = std::mem::replace(&mut from[place], place);
            if source == start {
                break;
            }
            list.swap(place, source);
            place = source;
        }
    }
}

/// Sorts as [`slice::sort_by_key`] does, at the same cost as [`sort_by`].
pub fn sort_by_key<T, K: Ord>(list: &mut [T], mut key: impl FnMut(&T) -> K) {
    sort_by(list, |a, b| key(a).cmp(&key(b)));
}

/// Indices in ascending order; equal ones in that of the list.
fn order(length: usize, compare: &mut dyn FnMut(usize, usize) -> Ordering) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..length).collect();
    indices.sort_by(|a, b| compare(*a, *b));
    indices
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn as_the_standard_library(keys in proptest::collection::vec(0..40_u32, 0..200)) {
            let list: Vec<(u32, usize)> = keys.into_iter().enumerate().map(|(i, key)| (key, i)).collect();
            let (mut ours, mut theirs) = (list.clone(), list.clone());
            sort_by_key(&mut ours, |entry| entry.0);
            theirs.sort_by_key(|entry| entry.0);
            prop_assert_eq!(ours, theirs);
            let (mut ours, mut theirs) = (list.clone(), list);
            sort_by(&mut ours, |a, b| b.0.cmp(&a.0));
            theirs.sort_by_key(|own| std::cmp::Reverse(own.0));
            prop_assert_eq!(ours, theirs);
        }
    }
}
