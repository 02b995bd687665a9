//! All buildings, contacts, links and yielding springs as one system of full matrices: Newton's method on all
//! displacements at once, without condensation, increments or events.

use jostle::hysteresis::HysteresisMemory;
use jostle::interface::PortPair;
use jostle::{GroundMotion, System};
use nalgebra::{DMatrix, DVector};

use crate::verification::support::largest;

/// Force that pushes both sides apart, in the residual and, with its slope, in the tangent where that is wanted.
fn push(
    ports: &PortPair,
    force: f64,
    slope: f64,
    residual: &mut [f64],
    tangent: &mut Option<DMatrix<f64>>,
) {
    for (port, sign) in ports.sides() {
        port.row.push(sign * force, residual);
        let Some(tangent) = tangent.as_mut() else {
            continue;
        };
        for (other, other_sign) in ports.sides() {
            for &(row, a) in port.row.entries() {
                for &(column, b) in other.row.entries() {
                    tangent[(row, column)] += sign * other_sign * a * b * slope;
                }
            }
        }
    }
}

/// Deformation of a spring, from the committed one itself, so that standing still is exactly that.
fn reached(shares: &[(usize, f64)], memory: &HysteresisMemory, next: &[f64], now: &[f64]) -> f64 {
    let changes = shares.iter();
    let change: f64 = changes
        .map(|(dof, share)| share * (next[*dof] - now[*dof]))
        .sum();
    memory.deformation() + change
}

/// Peak force of every contact, then of every link, and displacements at the end, by Newton's method on all
/// displacements of all buildings, over given instants. Links are free of force where nothing is displaced.
pub(crate) fn monolith(
    system: &System,
    motion: &GroundMotion,
    times: &[f64],
) -> (Vec<f64>, Vec<f64>) {
    let n = system.len();
    let (mut mass, mut driven) = (vec![0.0; n], vec![0.0; n]);
    let (mut stiffness, mut damping) = (DMatrix::<f64>::zeros(n, n), DMatrix::<f64>::zeros(n, n));
    let mut springs = Vec::new();
    for building in &system.buildings {
        let (equations, offset) = (&building.equations, building.offset);
        let range = offset..offset + equations.len();
        mass[range.clone()].copy_from_slice(&equations.mass);
        driven[range].copy_from_slice(&equations.driven_mass);
        for dof in 0..equations.len() {
            damping[(offset + dof, offset + dof)] += equations.alpha * equations.mass[dof];
        }
        // What of every matrix stiffens, and what damps.
        for (matrix, stiffens, damps) in [
            (&equations.stiffness, 1.0, equations.beta),
            (&equations.undamped, 1.0, 0.0),
            (&equations.dashpots, 0.0, 1.0),
        ] {
            let mut add = |row: usize, column: usize, value: f64| {
                stiffness[(offset + row, offset + column)] += stiffens * value;
                damping[(offset + row, offset + column)] += damps * value;
            };
            for column in 0..equations.len() {
                add(column, column, matrix.diagonal[column]);
                for entry in matrix.starts[column]..matrix.starts[column + 1] {
                    let row = matrix.rows[entry] as usize;
                    add(row, column, matrix.values[entry]);
                    add(column, row, matrix.values[entry]);
                }
            }
        }
        springs.extend(equations.springs.iter().map(|spring| {
            let row = spring.row.moved_up(offset);
            (row.entries().to_vec(), spring.hysteresis)
        }));
    }
    let state = jostle::State::at_rest(system, motion.acceleration(0.0));
    let (mut u, mut v, mut a) = (state.displacement, state.velocity, state.acceleration);
    let mut memories = vec![HysteresisMemory::default(); springs.len()];
    let mut speeds: Vec<Option<f64>> = vec![None; system.contacts.len()];
    let mut peaks = vec![0.0_f64; system.contacts.len() + system.links.len()];
    for pair in times.windows(2) {
        let h = pair[1] - pair[0];
        for (contact, speed) in system.contacts.iter().zip(&mut speeds) {
            let indentation = contact.ports.closing(&u) - contact.width;
            let rate = contact.ports.closing(&v);
            if speed.is_none() && indentation >= -1e-11 && rate > 0.0 {
                *speed = Some(rate);
            } else if speed.is_some() && indentation <= 0.0 && rate <= 0.0 {
                *speed = None;
            }
        }
        let ground = motion.acceleration(pair[1]);
        let mut next = u.clone();
        let mut forces = vec![0.0; peaks.len()];
        // What is left over at trial displacements, with its tangent where wanted.
        let left_over = |next: &[f64], tangent: &mut Option<DMatrix<f64>>, forces: &mut [f64]| {
            let velocity: Vec<f64> = (0..n).map(|i| 2.0 / h * (next[i] - u[i]) - v[i]).collect();
            let acceleration: Vec<f64> = (0..n)
                .map(|i| 4.0 / (h * h) * (next[i] - u[i]) - 4.0 / h * v[i] - a[i])
                .collect();
            let column = DVector::from_column_slice;
            let resisted = &stiffness * column(next) + &damping * column(&velocity);
            let mut residual: Vec<f64> = (0..n)
                .map(|i| -driven[i] * ground - mass[i] * acceleration[i] - resisted[i])
                .collect();
            if let Some(tangent) = tangent {
                *tangent = DMatrix::from_fn(n, n, |i, j| {
                    let inertia = if i == j { 4.0 / (h * h) * mass[i] } else { 0.0 };
                    stiffness[(i, j)] + 2.0 / h * damping[(i, j)] + inertia
                });
            }
            for ((shares, hysteresis), memory) in springs.iter().zip(&memories) {
                let response = hysteresis.respond(memory, reached(shares, memory, next, &u));
                for &(i, sign) in shares {
                    residual[i] -= sign * response.force;
                    for &(j, other) in shares {
                        if let Some(tangent) = tangent.as_mut() {
                            tangent[(i, j)] += sign * other * response.tangent;
                        }
                    }
                }
            }
            for (k, contact) in system.contacts.iter().enumerate() {
                let Some(speed) = speeds[k] else { continue };
                let rate = contact.ports.closing(&velocity);
                let indentation = contact.ports.closing(next) - contact.width;
                let response = contact.law.respond(indentation, rate, speed);
                forces[k] = response.force;
                let slope = response.by_indentation + 2.0 / h * response.by_rate;
                push(
                    &contact.ports,
                    response.force,
                    slope,
                    &mut residual,
                    tangent,
                );
            }
            for (k, link) in system.links.iter().enumerate() {
                let shortening = link.ports.closing(next);
                let rate = link.ports.closing(&velocity);
                let force = link.stiffness * shortening + link.damping * rate;
                forces[system.contacts.len() + k] = force;
                let slope = link.stiffness + 2.0 / h * link.damping;
                push(&link.ports, force, slope, &mut residual, tangent);
            }
            residual
        };
        let mut previous = f64::INFINITY;
        for round in 0..200 {
            let mut tangent = Some(DMatrix::zeros(0, 0));
            let residual = left_over(&next, &mut tangent, &mut forces);
            let factor = tangent.expect("wanted").lu();
            let update = factor.solve(&DVector::from_vec(residual));
            let update = update.expect("a tangent that is not singular");
            let moved =
                |share: f64| -> Vec<f64> { (0..n).map(|i| next[i] + share * update[i]).collect() };
            let size = (0..n).fold(0.0_f64, |most, i| most.max(update[i].abs()));
            let small = size <= 1e-14 * largest(&next)
                || (size <= 1e-11 * largest(&next) && size >= previous);
            previous = size;
            // Where the way overshoots, back to where the forces along it vanish.
            let along = |share: f64| -> f64 {
                let mut unused = forces.clone();
                let residual = left_over(&moved(share), &mut None, &mut unused);
                (0..n).map(|i| update[i] * residual[i]).sum()
            };
            let (mut low, mut high) = (0.0, 1.0);
            if !small && round > 4 && along(1.0) < 0.0 {
                for _ in 0..20 {
                    let middle = 0.5 * (low + high);
                    if along(middle) < 0.0 {
                        high = middle;
                    } else {
                        low = middle;
                    }
                }
            }
            next = moved(high);
            if small {
                break;
            }
            assert!(
                round < 199,
                "the monolith does not converge at {} s: {size:e}",
                pair[0]
            );
        }
        for i in 0..n {
            let (v0, a0) = (v[i], a[i]);
            v[i] = 2.0 / h * (next[i] - u[i]) - v0;
            a[i] = 4.0 / (h * h) * (next[i] - u[i]) - 4.0 / h * v0 - a0;
        }
        for ((shares, hysteresis), memory) in springs.iter().zip(&mut memories) {
            *memory = hysteresis
                .respond(memory, reached(shares, memory, &next, &u))
                .memory;
        }
        u = next;
        for (peak, force) in peaks.iter_mut().zip(&forces) {
            *peak = peak.max(force.abs());
        }
    }
    (peaks, u)
}
