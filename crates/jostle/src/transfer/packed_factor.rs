//! The entries of a factor in the order of the substitutions.

/// Content of a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// An entry of L, by its number.
    Lower(u32),
    /// The inverse pivot of a column.
    InversePivot(u32),
    Zero,
    One,
}

/// Position of every entry of a factor. Elimination stores each entry there when it is computed; after a hinge has
/// changed, only changed entries are written.
#[derive(Clone, Debug)]
pub(super) struct PackedFactor {
    lower: Vec<u32>,
    inverse_pivots: Vec<u32>,
    /// All positions before elimination.
    empty: Vec<f64>,
}

impl PackedFactor {
    /// Builds the map from places, for a factor of this many entries of L and columns. Unmapped entries go to one spare slot.
    pub(super) fn new(places: impl Iterator<Item = Place>, lower: usize, columns: usize) -> Self {
        let mut packed = Self {
            lower: vec![u32::MAX; lower],
            inverse_pivots: vec![u32::MAX; columns],
            empty: Vec::new(),
        };
        for (index, place) in places.enumerate() {
            packed.empty.push(f64::from(u8::from(place == Place::One)));
            match place {
                Place::Lower(number) => packed.lower[number as usize] = index as u32,
                Place::InversePivot(column) => {
                    packed.inverse_pivots[column as usize] = index as u32;
                }
                Place::Zero | Place::One => {}
            }
        }
        let spare = packed.empty.len() as u32;
        packed.empty.push(0.0);
        for place in packed.lower.iter_mut().chain(&mut packed.inverse_pivots) {
            *place = spare.min(*place);
        }
        packed
    }

    pub(super) fn empty(&self) -> &[f64] {
        &self.empty
    }

    #[inline]
    pub(super) fn set_lower(&self, entries: &mut [f64], number: usize, value: f64) {
        entries[self.lower[number] as usize] = value;
    }

    #[inline]
    pub(super) fn set_inverse_pivot(&self, entries: &mut [f64], column: usize, value: f64) {
        entries[self.inverse_pivots[column] as usize] = value;
    }
}
