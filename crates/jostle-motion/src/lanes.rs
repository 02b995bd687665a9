//! Many oscillators advanced together.
//!
//! Each oscillator uses one lane, so that the compiler can use registers of any width. No operation is fused or
//! reordered, so the bits are the same in every register width.

use crate::Accelerogram;
use crate::oscillator::{Advance, Oscillator};

/// Oscillators that are advanced together.
const LANES: usize = 8;
/// Record steps in a block.
pub(crate) const BLOCK: usize = 32;
/// Oscillators so stiff that more parts of a step than this were needed are taken as rigid; their response exceeds
/// the ground acceleration by less than one part in 1500.
const MOST_PARTS: f64 = 10_000.0;

/// Advances all oscillators through the record with at least a given number of steps per period, and passes each,
/// by its index and lane. Oscillators as good as rigid are not shown.
pub(crate) fn advance_all(
    motion: &Accelerogram,
    oscillators: &[Oscillator],
    steps_per_period: f64,
    mut show: impl FnMut(usize, usize, &Lanes, &BlockPeaks),
) {
    let parts = |i: usize| {
        let parts = motion.step() * steps_per_period / oscillators[i].period;
        parts.ceil().max(1.0)
    };
    // Neighbours in this order need about the same number of parts.
    let mut order: Vec<usize> = (0..oscillators.len()).collect();
    order.retain(|&i| parts(i) <= MOST_PARTS);
    order.sort_by(|&i, &j| oscillators[j].period.total_cmp(&oscillators[i].period));
    let arch = pulp::Arch::new();
    let mut blocks = BlockPeaks::default();
    for group in order.chunks(LANES) {
        let most = parts(group[group.len() - 1]) as usize;
        let lanes = Lanes::new(oscillators, group, most, motion.step());
        arch.dispatch(Sweep {
            blocks: &mut blocks,
            lanes: &lanes,
            ground: motion.acceleration(),
        });
        for (lane, &i) in group.iter().enumerate() {
            show(i, lane, &lanes, &blocks);
        }
    }
}

/// Coefficients of several oscillators. `p` and `q` are divided by the phase of a part, to stand before the change
/// of acceleration in it.
pub(crate) struct Lanes {
    pub(crate) a: [f64; LANES],
    pub(crate) b: [f64; LANES],
    pub(crate) d: [f64; LANES],
    pub(crate) p: [f64; LANES],
    pub(crate) q: [f64; LANES],
    /// 2ζ.
    pub(crate) z2: [f64; LANES],
    /// Phase of a part \[rad\].
    pub(crate) theta: [f64; LANES],
    /// Equal parts of a step.
    pub(crate) parts: usize,
}

impl Lanes {
    /// Empty lanes repeat the last oscillator.
    fn new(oscillators: &[Oscillator], chosen: &[usize], parts: usize, step: f64) -> Self {
        let mut lanes = Self {
            a: [0.0; LANES],
            b: [0.0; LANES],
            d: [0.0; LANES],
            p: [0.0; LANES],
            q: [0.0; LANES],
            z2: [0.0; LANES],
            theta: [0.0; LANES],
            parts,
        };
        for lane in 0..LANES {
            let oscillator = oscillators[chosen[lane.min(chosen.len() - 1)]];
            let theta = oscillator.circular_frequency() * step / parts as f64;
            let advance = Advance::over(theta, oscillator.damping);
            lanes.a[lane] = advance.a;
            lanes.b[lane] = advance.b;
            lanes.d[lane] = advance.d;
            lanes.p[lane] = advance.p / theta;
            lanes.q[lane] = advance.q / theta;
            lanes.z2[lane] = 2.0 * oscillator.damping;
            lanes.theta[lane] = theta;
        }
        lanes
    }
}

/// Where a block of steps begins, and the largest magnitudes in it.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    pub(crate) x: [f64; LANES],
    pub(crate) v: [f64; LANES],
    pub(crate) pseudo: [f64; LANES],
    pub(crate) total: [f64; LANES],
}

/// A pass through the record, compiled for every register width.
struct Sweep<'a> {
    blocks: &'a mut BlockPeaks,
    lanes: &'a Lanes,
    ground: &'a [f64],
}

impl pulp::WithSimd for Sweep<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.blocks.sweep(self.lanes, self.ground);
    }
}

#[derive(Default)]
pub(crate) struct BlockPeaks {
    pub(crate) blocks: Vec<Block>,
}

impl BlockPeaks {
    /// Advances all lanes through the record.
    #[inline(always)]
    fn sweep(&mut self, lanes: &Lanes, ground: &[f64]) {
        self.blocks.clear();
        // At rest u = u̇ = 0, but x = a_g.
        let mut x = [ground[0]; LANES];
        let mut v = [0.0; LANES];
        let share = 1.0 / lanes.parts as f64;
        let mut first = 0;
        while first + 1 < ground.len() {
            let last = (first + BLOCK).min(ground.len() - 1);
            let start = (x, v);
            // The extreme may follow right upon the end of the block before.
            let mut pseudo: [f64; LANES] = std::array::from_fn(|l| (x[l] - ground[first]).abs());
            let mut total: [f64; LANES] =
                std::array::from_fn(|l| (x[l] - ground[first] + lanes.z2[l] * v[l]).abs());
            for pair in ground[first..=last].windows(2) {
                let change = (pair[1] - pair[0]) * share;
                for part in 1..=lanes.parts {
                    let a = if part == lanes.parts {
                        pair[1]
                    } else {
                        pair[0] + part as f64 * change
                    };
                    for l in 0..LANES {
                        let next = lanes.a[l] * x[l] + lanes.b[l] * v[l] + lanes.p[l] * change;
                        v[l] = lanes.d[l] * v[l] - lanes.b[l] * x[l] + lanes.q[l] * change;
                        x[l] = next;
                        let y = next - a;
                        let w = (y + lanes.z2[l] * v[l]).abs();
                        let y = y.abs();
                        // Not f64::max, whose care for NaN costs a third of the time.
                        pseudo[l] = if y > pseudo[l] { y } else { pseudo[l] };
                        total[l] = if w > total[l] { w } else { total[l] };
                    }
                }
            }
            self.blocks.push(Block {
                x: start.0,
                v: start.1,
                pseudo,
                total,
            });
            first = last;
        }
    }

    /// Largest pseudo- and total acceleration of a lane at the ends of parts \[m/s²\].
    pub(crate) fn largest(&self, lane: usize) -> [f64; 2] {
        self.blocks.iter().fold([0.0_f64; 2], |most, block| {
            [
                most[0].max(block.pseudo[lane]),
                most[1].max(block.total[lane]),
            ]
        })
    }
}
