//! Chains of displacements processed in parallel lanes: the interiors of members, which couple only to the joints
//! at their ends.

mod chain;
mod chain_substitution;

use self::chain::{Chain, Reach};
use self::chain_substitution::ChainSubstitution;
use super::packed_factor::Place;

/// Chains processed at once.
const LANES: usize = 8;
/// Smallest number of chains for which this pays.
const FEWEST: usize = 2;

/// One value for each of the chains of a group.
pub(super) type Lanes = [f64; LANES];

/// The first columns of a factor. Equal adjacent chains form a group: both substitutions process a group with a
/// lane per chain. Ends that couple only to the last links are additional links; contributions to the near ends are
/// summed in registers.
#[derive(Clone, Debug, Default)]
pub(super) struct BatchedChains {
    groups: Vec<Group>,
    /// First column of a group at every link, group by group.
    firsts: Vec<u32>,
    /// Rows outside the chains: the far ends of a group, then the near ones; the first is repeated if chains are
    /// missing.
    ends: Vec<[u32; LANES]>,
    places: Vec<Place>,
    columns: usize,
    least_length: usize,
}

/// Chains with a given number of columns and far ends, processed together.
#[derive(Clone, Copy, Debug)]
struct Group {
    reach: Reach,
    columns: usize,
    far: usize,
    chains: usize,
}

impl BatchedChains {
    /// Builds the chains of a pattern: starts of its columns, rows of its entries, the row that each column is eliminated into.
    pub(super) fn new(starts: &[usize], rows: &[u32], parent: &[u32]) -> Self {
        // Paths meet at joints.
        let mut met = vec![0; parent.len()];
        for (column, next) in parent.iter().enumerate() {
            met[*next as usize] += usize::from(*next as usize != column);
        }
        let columns = met.iter().take_while(|paths| **paths < 2).count();
        let chains = Chain::all(&starts[..=columns], rows, parent);
        let Some(chains) = chains.filter(|chains| chains.len() >= FEWEST) else {
            return Self::default();
        };
        let mut all = Self {
            columns,
            ..Self::default()
        };
        let mut rest = &chains[..];
        while let Some((first, others)) = rest.split_first() {
            let alike = |(step, chain): &(usize, &Chain)| chain.is_beside(first, step + 1);
            let others = others.iter().enumerate().take(LANES - 1);
            let (group, after) = rest.split_at(1 + others.take_while(alike).count());
            all.add_group(group);
            rest = after;
        }
        let last = all.firsts.iter().max();
        all.least_length = last.map_or(0, |first| *first as usize + LANES);
        all
    }

    fn add_group(&mut self, chains: &[Chain]) {
        let first = &chains[0];
        self.groups.push(Group {
            reach: first.reach,
            columns: first.columns.len(),
            far: first.far.len(),
            chains: chains.len(),
        });
        self.firsts.extend(&first.columns);
        for (entry, missing) in first.places.iter().enumerate() {
            let missing = match missing {
                Place::One | Place::InversePivot(_) => Place::One,
                Place::Zero | Place::Lower(_) => Place::Zero,
            };
            let place = |lane: usize| {
                chains
                    .get(lane)
                    .map_or(missing, |chain| chain.places[entry])
            };
            self.places.extend((0..LANES).map(place));
        }
        let known = |lane: usize| chains.get(lane).unwrap_or(first);
        for end in 0..first.far.len() {
            self.ends
                .push(std::array::from_fn(|lane| known(lane).far[end]));
        }
        for end in 0..first.near.len() {
            self.ends
                .push(std::array::from_fn(|lane| known(lane).near[end]));
        }
    }

    /// Number of columns in chains; all others follow them.
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    /// Number of links of all groups; the substitutions use one register for each.
    pub(super) fn links(&self) -> usize {
        self.groups.iter().map(Group::links).sum()
    }

    /// Bands and near ends of the groups.
    #[cfg(test)]
    pub(super) fn reaches(&self) -> impl Iterator<Item = (usize, usize)> {
        let reaches = self.groups.iter().map(|group| group.reach);
        reaches.map(|reach| (reach.band, reach.near))
    }

    /// Minimum length of a vector, padding included, for register-wide access.
    pub(super) fn least_length(&self) -> usize {
        self.least_length
    }

    /// Positions of factor entries in the order of the substitutions, a register per link of a group.
    pub(super) fn places(&self) -> &[Place] {
        &self.places
    }

    /// Forward substitution. The results of the columns, divided by their pivots, remain in `scratch`.
    #[inline(always)]
    pub(super) fn forward(&self, entries: &[f64], load: &mut [f64], scratch: &mut [Lanes]) {
        self.substitute::<true>(entries, load, scratch);
    }

    /// Back substitution.
    #[inline(always)]
    pub(super) fn back(&self, entries: &[f64], load: &mut [f64], scratch: &mut [Lanes]) {
        self.substitute::<false>(entries, load, scratch);
    }

    #[inline(always)]
    fn substitute<const FORWARD: bool>(
        &self,
        entries: &[f64],
        load: &mut [f64],
        scratch: &mut [Lanes],
    ) {
        let mut rest = Parts {
            firsts: &self.firsts,
            ends: &self.ends,
            entries: entries.as_chunks().0,
            scratch,
        };
        for group in &self.groups {
            let parts = rest.take(group);
            // One for each coupling distance.
            match (group.reach.band, group.reach.near) {
                (1, 2) => parts.substitute::<1, 2, FORWARD>(load),
                (1, 4) => parts.substitute::<1, 4, FORWARD>(load),
                (3, 1) => parts.substitute::<3, 1, FORWARD>(load),
                _ => parts.substitute::<3, 2, FORWARD>(load),
            }
        }
    }
}

impl Group {
    /// Columns and far ends.
    fn links(&self) -> usize {
        self.columns + self.far
    }
}

/// Remaining data of the groups not yet processed.
struct Parts<'a> {
    firsts: &'a [u32],
    ends: &'a [[u32; LANES]],
    entries: &'a [Lanes],
    scratch: &'a mut [Lanes],
}

impl<'a> Parts<'a> {
    #[inline(always)]
    fn take(&mut self, group: &Group) -> ChainSubstitution<'a> {
        let links = group.links();
        let (far, near, firsts, entries, scratch);
        (firsts, self.firsts) = self.firsts.split_at(group.columns);
        (far, self.ends) = self.ends.split_at(group.far);
        (near, self.ends) = self.ends.split_at(group.reach.near);
        (entries, self.entries) = self.entries.split_at(links * group.reach.block());
        (scratch, self.scratch) = std::mem::take(&mut self.scratch).split_at_mut(links);
        ChainSubstitution {
            chains: group.chains,
            firsts,
            far,
            near,
            entries,
            scratch,
        }
    }
}
