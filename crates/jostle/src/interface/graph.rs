//! Which contacts and links act on the same building, and an order in which few others stand between them.

use super::PortPair;
use crate::linear::sort_by_key;

/// Contacts and links as the edges of a graph whose vertices are buildings.
///
/// Forces of two of them affect each other if they act on one building. In the order of [`InterfaceGraph::order`] the
/// matrix of these effects has a small envelope: buildings are numbered from one end of every connected part to the
/// other (E. Cuthill, J. McKee, 1969, Proc. 24th Nat. Conf. ACM, 157–172). A row of buildings keeps its order.
#[derive(Clone, Debug, Default)]
pub(crate) struct InterfaceGraph {
    /// Indices of contacts and links in the order of elimination.
    pub(crate) order: Vec<usize>,
    /// For every place in that order the first place that acts on one of the same buildings.
    first_partner: Vec<usize>,
}

impl InterfaceGraph {
    /// Of interfaces between buildings; `group` gives the first of those that always move together with a building.
    pub(crate) fn new<'a>(
        interfaces: impl Iterator<Item = &'a PortPair>,
        buildings: usize,
        group: impl Fn(usize) -> usize,
    ) -> Self {
        let ends: Vec<[usize; 2]> = interfaces
            .map(|ports| {
                let [left, right] = ports.buildings();
                let only = left.or(right).unwrap_or(0);
                [left.unwrap_or(only), right.unwrap_or(only)].map(&group)
            })
            .collect();
        let rank = ranks(buildings, &ends);
        let mut order: Vec<usize> = (0..ends.len()).collect();
        sort_by_key(&mut order, |&index| {
            let [a, b] = ends[index].map(|building| rank[building]);
            (a + b, index)
        });
        let mut first_at = vec![usize::MAX; buildings.max(1)];
        let first_partner = order.iter().enumerate().map(|(place, &index)| {
            let firsts = ends[index].map(|building| {
                first_at[building] = first_at[building].min(place);
                first_at[building]
            });
            firsts[0].min(firsts[1])
        });
        Self {
            first_partner: first_partner.collect(),
            order,
        }
    }

    /// First coupled row of every row of a selection, given by its places in the order from the first to the last.
    pub(crate) fn first_coupled(&self, places: &[usize]) -> impl Iterator<Item = usize> {
        places.iter().enumerate().map(|(row, &place)| {
            let partner = self.first_partner[place];
            places[..row].partition_point(|&other| other < partner)
        })
    }
}

/// Numbers of buildings in the order of Cuthill and McKee. Every connected part begins with the building that has the
/// fewest neighbours; where there are several, with that named first.
fn ranks(buildings: usize, ends: &[[usize; 2]]) -> Vec<usize> {
    let mut neighbours = vec![Vec::new(); buildings.max(1)];
    for &[a, b] in ends {
        if a != b {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
    }
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    let count = neighbours.len();
    let mut rank = vec![usize::MAX; count];
    let mut visited = Vec::with_capacity(count);
    for seed in 0..count {
        if rank[seed] != usize::MAX {
            continue;
        }
        let start = part_of(seed, &neighbours)
            .into_iter()
            .min_by_key(|&building| (neighbours[building].len(), building))
            .unwrap_or(seed);
        let mut next = visited.len();
        rank[start] = visited.len();
        visited.push(start);
        while next < visited.len() {
            let mut found: Vec<usize> = neighbours[visited[next]]
                .iter()
                .copied()
                .filter(|&building| rank[building] == usize::MAX)
                .collect();
            sort_by_key(&mut found, |&building| {
                (neighbours[building].len(), building)
            });
            for building in found {
                rank[building] = visited.len();
                visited.push(building);
            }
            next += 1;
        }
    }
    rank
}

/// Buildings that contacts and links connect with one, itself included.
fn part_of(seed: usize, neighbours: &[Vec<usize>]) -> Vec<usize> {
    let mut part = vec![seed];
    let mut next = 0;
    while next < part.len() {
        for &building in &neighbours[part[next]] {
            if !part.contains(&building) {
                part.push(building);
            }
        }
        next += 1;
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::Port;
    use crate::linear::Row;

    fn between(left: Option<usize>, right: Option<usize>) -> PortPair {
        PortPair([left, right].map(|side| {
            Some(Port {
                building: side?,
                row: Row::single(0),
                mass: 1.0,
                floor: None,
                height: 0.0,
                level: 0.0,
            })
        }))
    }

    fn graph(pairs: &[(usize, usize)], buildings: usize) -> InterfaceGraph {
        let ports: Vec<PortPair> = pairs
            .iter()
            .map(|&(a, b)| between(Some(a), Some(b)))
            .collect();
        InterfaceGraph::new(ports.iter(), buildings, |building| building)
    }

    fn firsts(graph: &InterfaceGraph, places: &[usize]) -> Vec<usize> {
        graph.first_coupled(places).collect()
    }

    #[test]
    fn a_row_keeps_its_order_and_couples_neighbours_only() {
        let row = graph(&[(0, 1), (0, 1), (1, 2), (2, 3)], 4);
        assert_eq!(row.order, [0, 1, 2, 3]);
        assert_eq!(firsts(&row, &[0, 1, 2, 3]), [0, 0, 0, 2]);
        // The contact between the second and the third is open.
        assert_eq!(firsts(&row, &[0, 1, 3]), [0, 0, 2]);
    }

    #[test]
    fn walls_stand_at_the_ends_of_a_row() {
        let ports = [
            between(Some(1), None),
            between(None, Some(0)),
            between(Some(0), Some(1)),
        ];
        let graph = InterfaceGraph::new(ports.iter(), 2, |building| building);
        assert_eq!(graph.order, [1, 2, 0]);
        assert_eq!(firsts(&graph, &[0, 1, 2]), [0, 0, 1]);
    }

    /// Buildings in five rows and five columns, numbered at random: every row begins with the first that shares a building,
    /// and the envelope leaves out more than a third of the lower half.
    #[test]
    fn a_block_of_buildings_has_a_small_envelope() {
        let name = |at: usize| (7 * at + 3) % 25;
        let mut pairs = Vec::new();
        for row in 0..5 {
            for column in 0..5 {
                let building = name(5 * row + column);
                if column < 4 {
                    pairs.push((building, name(5 * row + column + 1)));
                }
                if row < 4 {
                    pairs.push((building, name(5 * row + column + 5)));
                }
            }
        }
        let block = graph(&pairs, 25);
        let places: Vec<usize> = (0..pairs.len()).collect();
        let firsts = firsts(&block, &places);
        for (place, first) in firsts.iter().enumerate() {
            let pair = pairs[block.order[place]];
            let shares = |other: &usize| {
                let other = pairs[block.order[*other]];
                [other.0, other.1]
                    .iter()
                    .any(|b| [pair.0, pair.1].contains(b))
            };
            assert_eq!(places.iter().find(|other| shares(other)), Some(first));
        }
        let stored: usize = firsts
            .iter()
            .enumerate()
            .map(|(i, first)| i - first + 1)
            .sum();
        assert!(3 * 2 * stored < 2 * pairs.len() * pairs.len(), "{stored}");
    }

    #[test]
    fn parts_that_do_not_touch_follow_each_other() {
        let two = graph(&[(2, 3), (0, 1)], 4);
        assert_eq!(two.order, [1, 0]);
        assert_eq!(firsts(&two, &[0, 1]), [0, 1]);
        // Linked buildings count as one.
        let ports = [between(Some(0), Some(1)), between(Some(2), Some(3))];
        let linked = InterfaceGraph::new(ports.iter(), 4, |b| if b == 2 { 1 } else { b });
        assert_eq!(firsts(&linked, &[0, 1]), [0, 0]);
    }
}
