//! Buildings as independent first-order modes: q̇ = λ q + b f, every output Re Σ c q.
//!
//! The dense matrices M, K, K′ and C of the buildings that links join are put together here. Degrees of freedom without
//! mass are eliminated exactly: where only Rayleigh-damped members meet they follow the others at once (u + βu̇ obeys the
//! static equation, and so does u from a start at rest); where a spring or a dashpot of the ground holds them they keep
//! a first-order equation of their own. Undamped modes come from the flexibility matrix, so that the lowest are the most
//! accurate. Where damping does not couple them each gives one complex mode, or two real ones if overdamped; else the
//! eigenvectors of the first-order system are taken.

use jostle::System;
use jostle::linear::SparseSymmetric;
use nalgebra::DMatrix;

use super::C64;
use super::eigen::eigen;

/// Modes of buildings that links join.
pub(super) struct Component {
    /// Buildings of it.
    pub(super) buildings: Vec<usize>,
    /// Growth rates; conjugates are left out.
    pub(super) lambda: Vec<C64>,
    /// Input of the ground acceleration.
    pub(super) ground: Vec<C64>,
    basis: Basis,
    place: Vec<Place>,
    offset: usize,
    eliminated: DMatrix<f64>,
}

#[derive(Clone, Copy)]
enum Place {
    Massive(usize),
    Held(usize),
    Following(usize),
}

/// How physical displacements come from modes: x_d = Φ y, x_h = T Φ y + ξ.
struct Basis {
    shapes: DMatrix<f64>,
    held: DMatrix<f64>,
    kind: Kind,
}

enum Kind {
    /// Per mode of q: which y, and the factor of Re.
    Classical(Vec<(usize, C64)>),
    /// z = U q with z = (Ω y, ẏ, ξ), and the inverse of U.
    Coupled {
        frequency: Vec<f64>,
        right: DMatrix<C64>,
        left: DMatrix<C64>,
        factor: Vec<f64>,
    },
}

fn dense(matrix: &SparseSymmetric, offset: usize, factor: f64, into: &mut DMatrix<f64>) {
    for column in 0..matrix.diagonal.len() {
        into[(offset + column, offset + column)] += factor * matrix.diagonal[column];
        for place in matrix.starts[column]..matrix.starts[column + 1] {
            let row = matrix.rows[place] as usize;
            into[(offset + row, offset + column)] += factor * matrix.values[place];
            into[(offset + column, offset + row)] += factor * matrix.values[place];
        }
    }
}

fn part(matrix: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
        matrix[(rows[i], columns[j])]
    })
}

/// Groups of buildings that links join.
pub(super) fn components(system: &System) -> Result<Vec<Component>, String> {
    let n = system.buildings.len();
    let mut group: Vec<usize> = (0..n).collect();
    for link in &system.links {
        if let [Some(a), Some(b)] = link.ports.buildings() {
            let (from, to) = (group[a].max(group[b]), group[a].min(group[b]));
            group
                .iter_mut()
                .filter(|g| **g == from)
                .for_each(|g| *g = to);
        }
    }
    (0..n)
        .filter(|g| group.contains(g))
        .map(|g| Component::new(system, (0..n).filter(|b| group[*b] == g).collect()))
        .collect()
}

impl Component {
    fn new(system: &System, buildings: Vec<usize>) -> Result<Self, String> {
        // Buildings that links join are neighbours, so that their degrees of freedom follow each other.
        let offset = system.buildings[buildings[0]].offset;
        let size: usize = buildings
            .iter()
            .map(|b| system.buildings[*b].equations.len())
            .sum();
        let (mut plain, mut damped, mut other, mut dashpots) = (
            DMatrix::<f64>::zeros(size, size),
            DMatrix::<f64>::zeros(size, size),
            DMatrix::<f64>::zeros(size, size),
            DMatrix::<f64>::zeros(size, size),
        );
        let (mut mass, mut driven) = (vec![0.0; size], vec![0.0; size]);
        let mut alpha = vec![0.0; size];
        for &index in &buildings {
            let building = &system.buildings[index];
            let (equations, at) = (&building.equations, building.offset - offset);
            if !equations.springs.is_empty() {
                return Err("yielding is not part of this".into());
            }
            dense(&equations.stiffness, at, 1.0, &mut plain);
            dense(&equations.stiffness, at, equations.beta, &mut damped);
            dense(&equations.undamped, at, 1.0, &mut other);
            dense(&equations.dashpots, at, 1.0, &mut dashpots);
            for dof in 0..equations.len() {
                mass[at + dof] = equations.mass[dof];
                driven[at + dof] = equations.driven_mass[dof];
                alpha[at + dof] = equations.alpha;
            }
        }
        for link in &system.links {
            let sides: Vec<_> = link.ports.sides().collect();
            if !sides
                .iter()
                .any(|(face, _)| buildings.contains(&face.building))
            {
                continue;
            }
            for (a, s) in &sides {
                for (b, t) in &sides {
                    for &(row, c) in a.row.moved_down(offset).entries() {
                        for &(column, d) in b.row.moved_down(offset).entries() {
                            other[(row, column)] += s * t * c * d * link.stiffness;
                            dashpots[(row, column)] += s * t * c * d * link.damping;
                        }
                    }
                }
            }
        }
        let (mut massive, mut held, mut following) = (Vec::new(), Vec::new(), Vec::new());
        let mut place = Vec::new();
        for dof in 0..size {
            let touched = |matrix: &DMatrix<f64>| (0..size).any(|k| matrix[(dof, k)] != 0.0);
            if mass[dof] > 0.0 {
                place.push(Place::Massive(massive.len()));
                massive.push(dof);
            } else if touched(&other) || touched(&dashpots) {
                place.push(Place::Held(held.len()));
                held.push(dof);
            } else {
                place.push(Place::Following(following.len()));
                following.push(dof);
            }
        }
        let (nd, nh) = (massive.len(), held.len());
        let rest: Vec<usize> = massive.iter().chain(&held).copied().collect();
        // What follows: x_f = E x_rest, the same for K and βK.
        let eliminated = if following.is_empty() {
            DMatrix::zeros(0, rest.len())
        } else {
            let block = part(&plain, &following, &following);
            let factor = block.cholesky().ok_or("a joint without stiffness")?;
            -factor.solve(&part(&plain, &following, &rest))
        };
        let condense = |matrix: &DMatrix<f64>| {
            part(matrix, &rest, &rest) + part(matrix, &rest, &following) * &eliminated
        };
        let stiffness = condense(&plain) + part(&other, &rest, &rest);
        let mut damping = condense(&damped) + part(&dashpots, &rest, &rest);
        for i in 0..nd {
            damping[(i, i)] += alpha[massive[i]] * mass[massive[i]];
        }
        let d: Vec<usize> = (0..nd).collect();
        let h: Vec<usize> = (nd..nd + nh).collect();
        let held_stiffness = part(&stiffness, &h, &h);
        let held_shape = if nh == 0 {
            DMatrix::zeros(0, nd)
        } else {
            let factor = held_stiffness.clone().cholesky();
            let factor = factor.ok_or("a base without stiffness")?;
            -factor.solve(&part(&stiffness, &h, &d))
        };
        let condensed = part(&stiffness, &d, &d) + part(&stiffness, &d, &h) * &held_shape;
        let root: Vec<f64> = massive.iter().map(|dof| mass[*dof].sqrt()).collect();
        let symmetric =
            DMatrix::from_fn(nd, nd, |i, j| 0.5 * (condensed[(i, j)] + condensed[(j, i)]));
        let scaled = DMatrix::from_fn(nd, nd, |i, j| symmetric[(i, j)] / (root[i] * root[j]));
        let flexibility = scaled
            .cholesky()
            .ok_or("a building that can move without deforming")?
            .inverse();
        let modes = flexibility
            .try_symmetric_eigen(f64::EPSILON, 100 * (nd + 1))
            .ok_or("no eigenvalues")?;
        // Longest period first.
        let mut order = d.clone();
        order.sort_by(|a, b| modes.eigenvalues[*b].total_cmp(&modes.eigenvalues[*a]));
        let mut omega = Vec::new();
        let mut shapes = DMatrix::zeros(nd, nd);
        for (k, &from) in order.iter().enumerate() {
            let value = modes.eigenvalues[from];
            if value <= 0.0 {
                return Err("a mode without a frequency".into());
            }
            omega.push((1.0 / value).sqrt());
            for i in 0..nd {
                shapes[(i, k)] = modes.eigenvectors[(i, from)] / root[i];
            }
        }
        let modal_ratio: Vec<Option<f64>> = buildings
            .iter()
            .map(|b| system.buildings[*b].modal_damping)
            .collect();
        let mut modal_damping = shapes.transpose() * part(&damping, &d, &d) * &shapes;
        if let Some(ratio) = modal_ratio[0] {
            if buildings.len() > 1 {
                return Err("damping in all modes beside links".into());
            }
            for k in 0..nd {
                modal_damping[(k, k)] += 2.0 * ratio * omega[k];
            }
        }
        // Damping of one building that does not couple its modes, without rounding.
        if let [only] = buildings[..] {
            let equations = &system.buildings[only].equations;
            let bare = equations.undamped.is_zero() && system.links.is_empty();
            if equations.dashpots.is_zero()
                && (bare || equations.beta == 0.0)
                && system.links.is_empty()
            {
                modal_damping = DMatrix::zeros(nd, nd);
                for k in 0..nd {
                    let ratio = modal_ratio[0].unwrap_or(0.0);
                    modal_damping[(k, k)] = equations.alpha
                        + equations.beta * omega[k] * omega[k]
                        + 2.0 * ratio * omega[k];
                }
            }
        }
        let load = |vector: &[f64]| -> Vec<f64> {
            (0..nd)
                .map(|k| (0..nd).map(|i| shapes[(i, k)] * vector[i]).sum())
                .collect()
        };
        let driven: Vec<f64> = massive.iter().map(|dof| -driven[*dof]).collect();
        let driven = load(&driven);
        let coupled_damping =
            nh > 0 && (nd..nd + nh).any(|i| (0..nd + nh).any(|j| damping[(i, j)] != 0.0));
        let size = |k: usize| modal_damping[(k, k)].abs();
        let couples = (0..nd).any(|i| {
            (0..nd).any(|j| {
                i != j
                    && modal_damping[(i, j)].abs()
                        > 1e-9 * (size(i) * size(j)).sqrt() + 1e-12 * omega[i].min(omega[j])
            })
        });
        let mut lambda = Vec::new();
        let (ground, kind) = if coupled_damping || couples {
            let held_damping = part(&damping, &h, &h);
            let across = part(&damping, &d, &h);
            let nz = 2 * nd + if coupled_damping { nh } else { 0 };
            let mut matrix = DMatrix::<f64>::zeros(nz, nz);
            // D_hd + D_hh T, in modes.
            for k in 0..nd {
                matrix[(k, nd + k)] = omega[k];
                matrix[(nd + k, k)] = -omega[k];
                for l in 0..nd {
                    matrix[(nd + k, nd + l)] -= modal_damping[(k, l)];
                }
            }
            if coupled_damping {
                let factor = held_damping.clone().cholesky();
                let factor = factor.ok_or("a massless base with a dashpot one way only")?;
                let driven_by = (across.transpose() + &held_damping * &held_shape) * &shapes;
                let by_velocity = -factor.solve(&driven_by);
                let by_itself = -factor.solve(&held_stiffness);
                let in_modes = shapes.transpose() * &across;
                let held_velocity = &held_shape * &shapes + &by_velocity;
                let stiff = shapes.transpose() * part(&stiffness, &d, &h);
                let from_velocity = &in_modes * &held_velocity;
                let from_itself = &stiff + &in_modes * &by_itself;
                for k in 0..nd {
                    for l in 0..nd {
                        matrix[(nd + k, nd + l)] -= from_velocity[(k, l)];
                    }
                    for l in 0..nh {
                        matrix[(nd + k, 2 * nd + l)] -= from_itself[(k, l)];
                        matrix[(2 * nd + l, nd + k)] = by_velocity[(l, k)];
                    }
                }
                for k in 0..nh {
                    for l in 0..nh {
                        matrix[(2 * nd + k, 2 * nd + l)] = by_itself[(k, l)];
                    }
                }
            }
            let (values, vectors) = eigen(matrix).ok_or("no complex eigenvalues")?;
            let left = vectors.clone().lu().try_inverse();
            let left = left.ok_or("a double eigenvalue with one eigenvector")?;
            let kept: Vec<usize> = (0..nz).filter(|k| values[*k].im >= 0.0).collect();
            lambda.extend(kept.iter().map(|k| values[*k]));
            let factor = lambda
                .iter()
                .map(|l| if l.im > 0.0 { 2.0 } else { 1.0 })
                .collect();
            let right = DMatrix::from_fn(nz, kept.len(), |i, j| vectors[(i, kept[j])]);
            let left = DMatrix::from_fn(kept.len(), nz, |i, j| left[(kept[i], j)]);
            let kind = Kind::Coupled {
                frequency: omega,
                right,
                left,
                factor,
            };
            (Vec::new(), kind)
        } else {
            let mut list = Vec::new();
            for k in 0..nd {
                let half = 0.5 * modal_damping[(k, k)];
                let square = omega[k] * omega[k] - half * half;
                if square > 0.0 {
                    let square = square.sqrt();
                    lambda.push(C64::new(-half, square));
                    list.push((k, C64::new(0.0, -1.0 / square)));
                } else {
                    let square = (-square).sqrt();
                    let fast = -half - square;
                    let slow = omega[k] * omega[k] / fast;
                    lambda.extend([C64::new(slow, 0.0), C64::new(fast, 0.0)]);
                    list.push((k, C64::new(1.0 / (slow - fast), 0.0)));
                    list.push((k, C64::new(-1.0 / (slow - fast), 0.0)));
                }
            }
            (Vec::new(), Kind::Classical(list))
        };
        let mut component = Self {
            buildings,
            lambda,
            ground,
            basis: Basis {
                shapes,
                held: held_shape,
                kind,
            },
            place,
            offset,
            eliminated,
        };
        component.ground = component.input(&driven);
        Ok(component)
    }

    /// What a load on y does to every q.
    fn input(&self, load: &[f64]) -> Vec<C64> {
        match &self.basis.kind {
            Kind::Classical(list) => list.iter().map(|(k, _)| C64::new(load[*k], 0.0)).collect(),
            Kind::Coupled { left, .. } => (0..left.nrows())
                .map(|i| {
                    load.iter()
                        .enumerate()
                        .fold(C64::new(0.0, 0.0), |sum, (k, f)| {
                            sum + left[(i, load.len() + k)] * *f
                        })
                })
                .collect(),
        }
    }

    /// What a force on a degree of freedom with mass (of the system) does to every q.
    pub(super) fn push(&self, dof: usize) -> Vec<C64> {
        let shapes = &self.basis.shapes;
        let load: Vec<f64> = match self.place[dof - self.offset] {
            Place::Massive(i) => (0..shapes.ncols()).map(|k| shapes[(i, k)]).collect(),
            _ => vec![0.0; shapes.ncols()],
        };
        self.input(&load)
    }

    /// Coefficients of Σ weight · displacement, (dof of the system, weight).
    pub(super) fn output(&self, weights: &[(usize, f64)]) -> Vec<C64> {
        let Basis { shapes, held, kind } = &self.basis;
        let (nd, nh) = (shapes.ncols(), held.nrows());
        let mut rest = vec![0.0; nd + nh];
        for (dof, weight) in weights {
            match self.place[dof - self.offset] {
                Place::Massive(i) => rest[i] += weight,
                Place::Held(i) => rest[nd + i] += weight,
                Place::Following(i) => {
                    for (k, value) in rest.iter_mut().enumerate() {
                        *value += weight * self.eliminated[(i, k)];
                    }
                }
            }
        }
        let (mut massive, xi) = (rest[..nd].to_vec(), rest[nd..].to_vec());
        for (h, weight) in xi.iter().enumerate() {
            for (k, value) in massive.iter_mut().enumerate() {
                *value += weight * held[(h, k)];
            }
        }
        let in_modes: Vec<f64> = (0..nd)
            .map(|k| (0..nd).map(|i| shapes[(i, k)] * massive[i]).sum())
            .collect();
        match kind {
            Kind::Classical(list) => list.iter().map(|(k, c)| *c * in_modes[*k]).collect(),
            Kind::Coupled {
                frequency,
                right,
                factor,
                ..
            } => (0..right.ncols())
                .map(|j| {
                    let mut sum = C64::new(0.0, 0.0);
                    for k in 0..nd {
                        sum += right[(k, j)] * (in_modes[k] / frequency[k]);
                    }
                    for (h, weight) in xi.iter().enumerate().take(right.nrows() - 2 * nd) {
                        sum += right[(2 * nd + h, j)] * *weight;
                    }
                    sum * factor[j]
                })
                .collect(),
        }
    }
}
