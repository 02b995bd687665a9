//! The entries of a factor in the order of the substitutions.

/// Content of a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// An entry of L, by its index.
    Coupling(u32),
    /// The inverse pivot of a column.
    InversePivot(u32),
    Zero,
    One,
}

/// Position of every entry of a factor. Elimination stores each entry there when it is computed; after a hinge has
/// changed, only changed entries are written.
#[derive(Clone, Debug)]
pub(super) struct Shelves {
    couplings: Vec<u32>,
    inverse_pivots: Vec<u32>,
    /// All positions before elimination.
    blank: Vec<f64>,
}

impl Shelves {
    /// Builds the map for a given number of entries of L and columns; unmapped entries go to one spare slot.
    pub(super) fn of(
        places: impl Iterator<Item = Place>,
        couplings: usize,
        columns: usize,
    ) -> Self {
        let mut shelves = Self {
            couplings: vec![u32::MAX; couplings],
            inverse_pivots: vec![u32::MAX; columns],
            blank: Vec::new(),
        };
        for (index, place) in places.enumerate() {
            shelves.blank.push(f64::from(u8::from(place == Place::One)));
            match place {
                Place::Coupling(number) => shelves.couplings[number as usize] = index as u32,
                Place::InversePivot(column) => {
                    shelves.inverse_pivots[column as usize] = index as u32;
                }
                Place::Zero | Place::One => {}
            }
        }
        let behind = shelves.blank.len() as u32;
        shelves.blank.push(0.0);
        for place in shelves
            .couplings
            .iter_mut()
            .chain(&mut shelves.inverse_pivots)
        {
            *place = behind.min(*place);
        }
        shelves
    }

    pub(super) fn blank(&self) -> &[f64] {
        &self.blank
    }

    #[inline]
    pub(super) fn put_coupling(&self, laid: &mut [f64], number: usize, value: f64) {
        laid[self.couplings[number] as usize] = value;
    }

    #[inline]
    pub(super) fn put_inverse_pivot(&self, laid: &mut [f64], column: usize, value: f64) {
        laid[self.inverse_pivots[column] as usize] = value;
    }
}
