//! Chains of displacements taken abreast: the insides of members, which meet nothing but the joints at their ends.

use super::shelves::Place;
use crate::small_keys::in_order;

/// Chains taken at once.
const LANES: usize = 8;
/// Fewest chains that are worth it.
const FEWEST: usize = 2;

/// One value for each of the chains of a group.
pub(super) type Lanes = [f64; LANES];

/// How far links of a chain couple, and how many of its ends meet links from the beginning: loops are compiled for each of
/// these, so that what they need stays in registers. Bending couples two displacements of a node and of its neighbour; change of
/// length, and members with a single mass, fewer.
const REACHES: [Reach; 4] = [
    Reach::new(1, 2),
    Reach::new(1, 4),
    Reach::new(3, 1),
    Reach::new(3, 2),
];

#[derive(Clone, Copy, Debug, PartialEq)]
struct Reach {
    band: usize,
    near: usize,
}

impl Reach {
    const fn new(band: usize, near: usize) -> Self {
        Self { band, near }
    }

    /// Registers laid out for a link: its inverse pivot, couplings to the links behind it and to the near ends.
    fn block(self) -> usize {
        1 + self.band + self.near
    }
}

/// The first columns of a factor. Chains next to each other that are alike are a group: both passes walk along a group
/// with a lane for every chain. Ends that only the last links meet are further links; what is passed on to the near ones is
/// summed up on the way.
#[derive(Clone, Debug, Default)]
pub(super) struct Abreast {
    groups: Vec<Group>,
    /// First of the columns that a group has at every link, group by group.
    firsts: Vec<u32>,
    /// Rows beyond the chains: the far ends of a group, then the near ones; the first again where chains are missing.
    ends: Vec<[u32; LANES]>,
    places: Vec<Place>,
    columns: usize,
    least_length: usize,
}

/// Chains of so many columns and far ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Group {
    reach: Reach,
    columns: usize,
    far: usize,
    chains: usize,
}

/// A chain alone.
struct Chain {
    reach: Reach,
    columns: Vec<u32>,
    far: Vec<u32>,
    near: Vec<u32>,
    places: Vec<Place>,
}

impl Abreast {
    /// Of a pattern: starts of its columns, rows of its entries, the row that each column is eliminated into.
    pub(super) fn of(starts: &[usize], rows: &[u32], parent: &[u32]) -> Self {
        // Where paths meet there is a joint.
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
            all.take_in(group);
            rest = after;
        }
        let last = all.firsts.iter().max();
        all.least_length = last.map_or(0, |first| *first as usize + LANES);
        all
    }

    fn take_in(&mut self, chains: &[Chain]) {
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
                Place::Zero | Place::Coupling(_) => Place::Zero,
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

    /// Columns that are taken here; all others come behind them.
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    /// Links of all groups, for each of which the passes keep a register.
    pub(super) fn links(&self) -> usize {
        self.groups.iter().map(Group::links).sum()
    }

    /// Bands and near ends of the groups.
    #[cfg(test)]
    pub(super) fn reaches(&self) -> impl Iterator<Item = (usize, usize)> {
        let reaches = self.groups.iter().map(|group| group.reach);
        reaches.map(|reach| (reach.band, reach.near))
    }

    /// What a vector must have, if only behind its own values, to be taken a register at a time.
    pub(super) fn least_length(&self) -> usize {
        self.least_length
    }

    /// What the passes take, a register for every link of a group.
    pub(super) fn places(&self) -> &[Place] {
        &self.places
    }

    /// Every column passes its load on, the ends theirs to the joints. What columns then hold, divided by their pivots,
    /// is left in `held`.
    #[inline(always)]
    pub(super) fn pass_on(&self, laid: &[f64], load: &mut [f64], held: &mut [Lanes]) {
        let mut rest = self.parts(laid, held);
        for group in &self.groups {
            let own = rest.take(group);
            match (group.reach.band, group.reach.near) {
                (1, 2) => own.pass_on::<1, 2>(load),
                (1, 4) => own.pass_on::<1, 4>(load),
                (3, 1) => own.pass_on::<3, 1>(load),
                _ => own.pass_on::<3, 2>(load),
            }
        }
    }

    /// Every column, last first, gathers from what is ahead of it.
    #[inline(always)]
    pub(super) fn gather(&self, laid: &[f64], load: &mut [f64], held: &mut [Lanes]) {
        let mut rest = self.parts(laid, held);
        for group in &self.groups {
            let own = rest.take(group);
            match (group.reach.band, group.reach.near) {
                (1, 2) => own.gather::<1, 2>(load),
                (1, 4) => own.gather::<1, 4>(load),
                (3, 1) => own.gather::<3, 1>(load),
                _ => own.gather::<3, 2>(load),
            }
        }
    }

    fn parts<'a>(&'a self, laid: &'a [f64], held: &'a mut [Lanes]) -> Parts<'a> {
        Parts {
            firsts: &self.firsts,
            ends: &self.ends,
            laid: laid.as_chunks().0,
            held,
        }
    }
}

impl Group {
    /// Columns and far ends.
    fn links(&self) -> usize {
        self.columns + self.far
    }
}

/// What belongs to the groups not yet taken.
struct Parts<'a> {
    firsts: &'a [u32],
    ends: &'a [[u32; LANES]],
    laid: &'a [Lanes],
    held: &'a mut [Lanes],
}

impl<'a> Parts<'a> {
    #[inline(always)]
    fn take(&mut self, group: &Group) -> Walk<'a> {
        let links = group.links();
        let (far, near, firsts, laid, held);
        (firsts, self.firsts) = self.firsts.split_at(group.columns);
        (far, self.ends) = self.ends.split_at(group.far);
        (near, self.ends) = self.ends.split_at(group.reach.near);
        (laid, self.laid) = self.laid.split_at(links * group.reach.block());
        (held, self.held) = std::mem::take(&mut self.held).split_at_mut(links);
        Walk {
            chains: group.chains,
            firsts,
            far,
            near,
            laid,
            held,
        }
    }
}

/// One group in a pass.
struct Walk<'a> {
    chains: usize,
    firsts: &'a [u32],
    far: &'a [[u32; LANES]],
    near: &'a [[u32; LANES]],
    laid: &'a [Lanes],
    held: &'a mut [Lanes],
}

impl Walk<'_> {
    #[inline(always)]
    fn pass_on<const BAND: usize, const NEAR: usize>(self, load: &mut [f64]) {
        let mut passing = Passing::<BAND, NEAR>::default();
        let mut blocks = self.laid.chunks_exact(1 + BAND + NEAR);
        let (columns, ends) = self.held.split_at_mut(self.firsts.len());
        for ((held, first), block) in columns.iter_mut().zip(self.firsts).zip(&mut blocks) {
            *held = passing.link(block, at(load, *first));
        }
        for ((held, rows), block) in ends.iter_mut().zip(self.far).zip(blocks) {
            *held = passing.link(block, [0.0; LANES]);
            add(load, rows, held, self.chains);
        }
        for (sum, rows) in passing.near.iter().zip(self.near) {
            add(load, rows, sum, self.chains);
        }
    }

    #[inline(always)]
    fn gather<const BAND: usize, const NEAR: usize>(self, load: &mut [f64]) {
        let mut gathering = Gathering::<BAND, NEAR>::default();
        for (values, rows) in gathering.near.iter_mut().zip(self.near) {
            *values = rows.map(|row| load[row as usize]);
        }
        let columns = self.firsts.len() * (1 + BAND + NEAR);
        let (columns, ends) = self.laid.split_at(columns);
        let ends = ends.chunks_exact(1 + BAND + NEAR);
        for (rows, block) in self.far.iter().zip(ends).rev() {
            gathering.link(block, rows.map(|row| load[row as usize]));
        }
        let blocks = columns.chunks_exact(1 + BAND + NEAR);
        for ((held, first), block) in self.held.iter().zip(self.firsts).zip(blocks).rev() {
            let found = gathering.link(block, *held);
            put(load, *first, &found, self.chains);
        }
    }
}

/// On the way forward.
struct Passing<const BAND: usize, const NEAR: usize> {
    /// The links just passed, nearest last.
    behind: [Lanes; BAND],
    /// What near ends have been given so far.
    near: [Lanes; NEAR],
}

impl<const BAND: usize, const NEAR: usize> Default for Passing<BAND, NEAR> {
    fn default() -> Self {
        Self {
            behind: [[0.0; LANES]; BAND],
            near: [[0.0; LANES]; NEAR],
        }
    }
}

impl<const BAND: usize, const NEAR: usize> Passing<BAND, NEAR> {
    /// Takes the load of the next link and returns what it holds, divided by its pivot.
    #[inline(always)]
    fn link(&mut self, block: &[Lanes], load: Lanes) -> Lanes {
        let mut sum = load;
        for k in 0..BAND {
            subtract(&mut sum, &block[1 + k], &self.behind[k]);
        }
        for end in 0..NEAR {
            subtract(&mut self.near[end], &block[1 + BAND + end], &sum);
        }
        for k in 1..BAND {
            self.behind[k - 1] = self.behind[k];
        }
        self.behind[BAND - 1] = sum;
        for lane in 0..LANES {
            sum[lane] *= block[0][lane];
        }
        sum
    }
}

/// On the way back.
struct Gathering<const BAND: usize, const NEAR: usize> {
    /// What the links behind have been given so far, nearest last.
    behind: [Lanes; BAND],
    near: [Lanes; NEAR],
}

impl<const BAND: usize, const NEAR: usize> Default for Gathering<BAND, NEAR> {
    fn default() -> Self {
        Self {
            behind: [[0.0; LANES]; BAND],
            near: [[0.0; LANES]; NEAR],
        }
    }
}

impl<const BAND: usize, const NEAR: usize> Gathering<BAND, NEAR> {
    /// Takes what the next link holds and returns what is found there.
    #[inline(always)]
    fn link(&mut self, block: &[Lanes], held: Lanes) -> Lanes {
        let mut sum = held;
        for end in 0..NEAR {
            subtract(&mut sum, &block[1 + BAND + end], &self.near[end]);
        }
        for lane in 0..LANES {
            sum[lane] += self.behind[BAND - 1][lane];
        }
        for k in (1..BAND).rev() {
            self.behind[k] = self.behind[k - 1];
            subtract(&mut self.behind[k], &block[1 + k], &sum);
        }
        self.behind[0] = [0.0; LANES];
        subtract(&mut self.behind[0], &block[1], &sum);
        sum
    }
}

impl Chain {
    /// All chains of the columns of a pattern, in the order of their last columns; none where one reaches too far.
    fn all(starts: &[usize], rows: &[u32], parent: &[u32]) -> Option<Vec<Self>> {
        let columns = starts.len() - 1;
        // A chain is known by its last column.
        let mut last: Vec<usize> = (0..columns).collect();
        for column in (0..columns).rev() {
            let next = parent[column] as usize;
            if next < columns && next != column {
                last[column] = last[next];
            }
        }
        let listed: Vec<(usize, u32)> = last.into_iter().zip(0..).collect();
        let by_chain = in_order(&listed, columns, |entry| entry.0);
        // Which link of its chain a column is.
        let mut link = vec![0; columns];
        let chains = by_chain.chunk_by(|a, b| a.0 == b.0).map(|own| {
            for (place, (_, column)) in own.iter().enumerate() {
                link[*column as usize] = place;
            }
            let columns: Vec<u32> = own.iter().map(|(_, column)| *column).collect();
            let mut met = Vec::new();
            for (from, column) in columns.iter().enumerate() {
                let column = *column as usize;
                for place in starts[column]..starts[column + 1] {
                    let to = link.get(rows[place] as usize).copied();
                    met.push(Met {
                        from,
                        to: to.ok_or(rows[place]),
                        place: place as u32,
                    });
                }
            }
            let fitting = REACHES.into_iter();
            fitting
                .filter_map(|reach| Self::within(reach, &columns, &met))
                .min_by_key(|chain| chain.places.len())
        });
        chains.collect()
    }

    /// A chain of columns with such couplings, if it reaches no farther.
    fn within(reach: Reach, columns: &[u32], met: &[Met]) -> Option<Self> {
        // Those met first are near as long as there is room.
        let (mut far, mut near) = (Vec::new(), Vec::new());
        for Met { from, to, .. } in met {
            let Err(row) = *to else { continue };
            if far.contains(&row) || near.contains(&row) {
                continue;
            }
            if near.len() < reach.near {
                near.push(row);
            } else if columns.len() + far.len() - from <= reach.band {
                far.push(row);
            } else {
                return None;
            }
        }
        let links = columns.len() + far.len();
        let mut places = vec![Place::Zero; links * reach.block()];
        for link in 0..links {
            let column = columns.get(link);
            places[link * reach.block()] = column.map_or(Place::One, |c| Place::InversePivot(*c));
        }
        for Met { from, to, place } in met {
            let to = to.or_else(|row| {
                let end = far.iter().position(|end| *end == row);
                end.map(|end| columns.len() + end).ok_or(row)
            });
            let own = match to {
                Ok(link) => {
                    let back = reach.band.checked_sub(link - from)?;
                    link * reach.block() + 1 + back
                }
                Err(row) => {
                    let end = near.iter().position(|end| *end == row)?;
                    from * reach.block() + 1 + reach.band + end
                }
            };
            places[own] = Place::Coupling(*place);
        }
        // Near ends that are missing are given nothing, and read what is never used.
        let spare = near.first().or(far.first()).or(columns.last());
        let spare = spare.copied().unwrap_or(0);
        near.resize(reach.near, spare);
        Some(Self {
            reach,
            columns: columns.to_vec(),
            far,
            near,
            places,
        })
    }

    /// Whether all its columns stand so many places behind those of another that is like it.
    fn is_beside(&self, other: &Self, places: usize) -> bool {
        let alike = self.reach == other.reach
            && self.columns.len() == other.columns.len()
            && self.far.len() == other.far.len();
        let mut pairs = self.columns.iter().zip(&other.columns);
        alike && pairs.all(|(own, its)| *own == its + places as u32)
    }
}

/// A coupling of a link: to another link, or to a row beyond the chains.
struct Met {
    from: usize,
    to: Result<usize, u32>,
    place: u32,
}

/// A register of a list from a place on.
#[inline(always)]
fn at(list: &[f64], first: u32) -> Lanes {
    let mut values = [0.0; LANES];
    let first = first as usize;
    values.copy_from_slice(&list[first..first + LANES]);
    values
}

/// Puts as many values as there are chains into a list, from a place on.
#[inline(always)]
fn put(list: &mut [f64], first: u32, values: &Lanes, chains: usize) {
    let first = first as usize;
    let own = &mut list[first..first + LANES];
    if chains == LANES {
        own.copy_from_slice(values);
    } else {
        for lane in 0..LANES {
            own[lane] = if lane < chains {
                values[lane]
            } else {
                own[lane]
            };
        }
    }
}

/// Adds as many values as there are chains to a list.
#[inline(always)]
fn add(list: &mut [f64], rows: &[u32; LANES], values: &Lanes, chains: usize) {
    for (row, value) in rows.iter().zip(values).take(chains) {
        list[*row as usize] += value;
    }
}

#[inline(always)]
fn subtract(from: &mut Lanes, a: &Lanes, b: &Lanes) {
    for lane in 0..LANES {
        from[lane] -= a[lane] * b[lane];
    }
}
