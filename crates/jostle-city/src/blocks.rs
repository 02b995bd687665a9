//! Blocks of neighbours, and the rows that they are cut into.

use std::f64::consts::PI;

use crate::neighbours::{Pair, Position, opposite};

/// Most buildings of a row.
const LONGEST: usize = 32;

/// Buildings that are linked by neighbours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Its buildings, in order.
    pub buildings: Vec<usize>,
    /// Its pairs, in order.
    pub pairs: Vec<usize>,
}

impl Block {
    /// Whether no building can be reached on two ways.
    #[must_use]
    pub fn is_tree(&self) -> bool {
        self.pairs.len() + 1 == self.buildings.len()
    }
}

/// Buildings in a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// From left to right.
    pub buildings: Vec<usize>,
    /// The pairs between them.
    pub pairs: Vec<usize>,
}

/// Blocks of two or more buildings, in the order of their first buildings.
#[must_use]
pub fn blocks(pairs: &[Pair], buildings: usize) -> Vec<Block> {
    let mut above: Vec<usize> = (0..buildings).collect();
    for pair in pairs {
        let [a, b] = pair.buildings.map(|at| root(&mut above, at));
        above[a.max(b)] = a.min(b);
    }
    let mut number = vec![usize::MAX; buildings];
    let mut found: Vec<Block> = Vec::new();
    for (at, pair) in pairs.iter().enumerate() {
        let first = root(&mut above, pair.buildings[0]);
        if number[first] == usize::MAX {
            number[first] = found.len();
            found.push(Block {
                buildings: Vec::new(),
                pairs: Vec::new(),
            });
        }
        let block = &mut found[number[first]];
        block.pairs.push(at);
        block.buildings.extend(pair.buildings);
    }
    for block in &mut found {
        block.buildings.sort_unstable();
        block.buildings.dedup();
    }
    found.sort_by_key(|block| block.buildings[0]);
    found
}

/// The representative of a building, with shorter ways for the next time.
fn root(above: &mut [usize], mut at: usize) -> usize {
    while above[at] != at {
        above[at] = above[above[at]];
        at = above[at];
    }
    at
}

/// Cuts a block into rows of at most 32 buildings in a line; pairs that fit into none are rows of their own.
///
/// `rank` orders the pairs: the first stay together, the last are cut. A building has one neighbour at most on each of
/// two opposite sides of its row; corners are no neighbours of a row.
#[must_use]
pub fn rows(block: &Block, pairs: &[Pair], rank: impl Fn(usize) -> f64) -> Vec<Line> {
    let at = |building: usize| block.buildings.binary_search(&building).unwrap_or_default();
    let count = block.buildings.len();
    let mut order = block.pairs.clone();
    order.sort_by(|a, b| rank(*a).total_cmp(&rank(*b)).then(a.cmp(b)));
    let mut above: Vec<usize> = (0..count).collect();
    let mut size = vec![1; count];
    // Direction to the neighbour and the pair, of either side.
    let mut sides: Vec<Vec<(f64, usize)>> = vec![Vec::new(); count];
    let mut alone = Vec::new();
    for pair in order {
        let neighbours = &pairs[pair];
        let [a, b] = neighbours.buildings.map(at);
        let directions = [neighbours.normal, neighbours.normal + PI];
        let fits = |side: &[(f64, usize)], direction: f64| match side {
            [] => true,
            [(other, _)] => opposite(*other, direction),
            _ => false,
        };
        let [top_a, top_b] = [a, b].map(|at| root(&mut above, at));
        let joined = neighbours.position != Position::Corner
            && fits(&sides[a], directions[0])
            && fits(&sides[b], directions[1])
            && top_a != top_b
            && size[top_a] + size[top_b] <= LONGEST;
        if !joined {
            alone.push(Line {
                buildings: neighbours.buildings.to_vec(),
                pairs: vec![pair],
            });
            continue;
        }
        sides[a].push((directions[0], pair));
        sides[b].push((directions[1], pair));
        let (low, high) = (top_a.min(top_b), top_a.max(top_b));
        above[high] = low;
        size[low] += size[high];
    }
    // Every chain from the end with the lower number.
    let mut lines = Vec::new();
    let mut seen = vec![false; count];
    for start in 0..count {
        if seen[start] || sides[start].len() != 1 {
            continue;
        }
        let mut line = Line {
            buildings: vec![block.buildings[start]],
            pairs: Vec::new(),
        };
        let mut here = start;
        seen[here] = true;
        while let Some((_, pair)) = sides[here]
            .iter()
            .find(|side| !line.pairs.contains(&side.1))
        {
            line.pairs.push(*pair);
            let [a, b] = pairs[*pair].buildings.map(at);
            here = if a == here { b } else { a };
            seen[here] = true;
            line.buildings.push(block.buildings[here]);
        }
        lines.push(line);
    }
    lines.extend(alone);
    lines
}
