//! Joints of a text model: points that lie together, and where they lie on lines.

use std::collections::BTreeMap;

/// Points nearer than this are one joint \[m\].
pub(crate) const ONE_JOINT: f64 = 0.002;

/// Joints by cells a little larger than what is one joint.
#[derive(Default)]
pub(crate) struct Joints {
    pub(crate) at: Vec<[f64; 3]>,
    cells: BTreeMap<[i64; 3], Vec<usize>>,
}

impl Joints {
    fn cell(at: [f64; 3]) -> [i64; 3] {
        at.map(|coordinate| (coordinate / (2.0 * ONE_JOINT)).floor() as i64)
    }

    pub(crate) fn find(&self, at: [f64; 3]) -> Option<usize> {
        let [x, y, z] = Self::cell(at);
        let beside = |index: i64| index.saturating_sub(1)..=index.saturating_add(1);
        let cells =
            beside(x).flat_map(|x| beside(y).flat_map(move |y| beside(z).map(move |z| [x, y, z])));
        let near = |joint: &&usize| distance(self.at[**joint], at) < ONE_JOINT;
        cells
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .find(near)
            .copied()
    }

    pub(crate) fn add(&mut self, at: [f64; 3]) -> usize {
        self.find(at).unwrap_or_else(|| {
            self.at.push(at);
            let joint = self.at.len() - 1;
            self.cells.entry(Self::cell(at)).or_default().push(joint);
            joint
        })
    }

    /// Where a joint lies inside a line from `a` to `b`, as a share of its length.
    pub(crate) fn share(&self, joint: usize, [a, b]: [[f64; 3]; 2]) -> Option<f64> {
        let at = self.at[joint];
        let line = [0, 1, 2].map(|axis| b[axis] - a[axis]);
        let square: f64 = line.iter().map(|line| line * line).sum();
        let along: f64 = (0..3).map(|axis| (at[axis] - a[axis]) * line[axis]).sum();
        let share = along / square;
        let foot = [0, 1, 2].map(|axis| a[axis] + share * line[axis]);
        let ends = [a, b].iter().any(|end| distance(at, *end) < ONE_JOINT);
        let inside = share > 0.0 && share < 1.0 && !ends;
        (inside && distance(at, foot) < ONE_JOINT).then_some(share)
    }

    /// Where the first of the joints inside a line between two of them lies.
    pub(crate) fn inside(&self, [a, b]: [usize; 2]) -> Option<f64> {
        let line = [self.at[a], self.at[b]];
        let shares = (0..self.at.len()).filter_map(|joint| self.share(joint, line));
        shares.min_by(f64::total_cmp)
    }

    /// The joint at a share of a line between two joints.
    pub(crate) fn between(&mut self, [a, b]: [usize; 2], share: f64) -> usize {
        let [a, b] = [self.at[a], self.at[b]];
        self.add([0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis])))
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3)
        .map(|axis| (a[axis] - b[axis]).powi(2))
        .sum::<f64>()
        .sqrt()
}
