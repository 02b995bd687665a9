//! Axial force and moment of a section bounded by a surface: a convex polygon with associated flow.
//!
//! With the radius ℓ = √(k_M / k_N) the section is two points at ±ℓ from its axis. They move by q = e ± ℓ θ and bear p with
//! N = p₁ + p₂ and M = ℓ (p₁ − p₂). Both have the elastic stiffness k = k_N / 2, so that the plane of N and M/ℓ has one stiffness in
//! every direction. A share r of it stays after yield (Prager's kinematic hardening): p = r k q + s, and s lies within the polygon.
//!
//! The step is the return mapping of associated flow: s is the point of the polygon closest to the elastic trial
//! s + (1 − r) k Δq (J. C. Simo, T. J. R. Hughes, 1998, *Computational Inelasticity*, sections 1.4 and 5.2; J. J. Moreau, 1977, for the
//! evolution). On a polygon it is exact, as long as a step turns around no corner; then its error is of the order of the step. The
//! mapping is the gradient of a convex potential: the tangent is symmetric and at least r k, and a closed path takes no energy out.
//!
//! In the list of springs that yield it has three rows, as forces in plan have: both points, and the difference of their displacements.
//! They keep the corners of the polygon together, [`KEPT`] each.

use super::backbone::{Backbone, Corners, Quantity, Side, SpringFault};
use super::circular::{ForceRow, PlanAnswer};
use super::memory::HysteresisMemory;
use super::rule::{Hysteresis, HysteresisRule};

/// Corners that a row keeps.
pub(super) const KEPT: usize = 4;

/// Most corners of a surface on the side of positive moments, those without moment included.
pub const MOST_CORNERS: usize = 3 * KEPT;

/// Overlap of corners that counts as convex, as a fraction of the surface.
const FLAT: f64 = 1e-9;

/// Distance from an edge that counts as none, as a fraction of the surface, and of rates.
const NEAR: f64 = 1e-10;

/// Plastic part of a force from which on a row has yielded, as a fraction of the greatest force.
const YIELDS: f64 = 1e-9;

/// Corners of a surface that a row keeps, with the axial force and the moment over ℓ; the last one fills the rest \[N\].
pub type KeptCorners = [[f64; 2]; KEPT];

/// Axial force and moment of a section that yields on a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    /// k \[N/m\].
    stiffness: f64,
    /// r \[–\].
    post_yield: f64,
    /// Corners from the greatest compression to the greatest tension.
    corners: [[f64; 2]; MOST_CORNERS + 2],
}

/// Which way a section gives at a point of its surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Flow {
    /// Not at all.
    Elastic,
    /// Across an edge, in the unit direction of which it moves on \[N and M/ℓ\].
    Edge([f64; 2]),
    /// At a corner.
    Corner,
}

/// Energy of a point with p = r k q + s: that of r k, and that of the rest, which s strains \[J\].
pub(super) fn stored_energy(backbone: &Backbone, memory: &HysteresisMemory) -> f64 {
    let kept = backbone.side(Side::Positive).post_yield;
    let inner = memory.force - kept * memory.deformation;
    0.5 * (kept * memory.deformation.powi(2) + inner * inner / (backbone.initial() - kept))
}

impl Hysteresis {
    /// The three rows of a section that yields on a surface, and the distance ℓ of its points \[m\].
    ///
    /// `stiffness`: elastic stiffness over elongation \[N/m\] and over rotation \[N·m/rad\]. `corners`: axial forces, positive in
    /// tension, in ascending order, and the greatest moments there, ≥ 0 \[N, N·m\]; negative moments have the same. `post_yield`: share
    /// of both stiffnesses after yield, 0 ≤ r < 1.
    ///
    /// # Errors
    /// Stiffnesses out of range, corners that are too few or too many, in disorder or not convex, and a surface that the section without
    /// forces is not inside of.
    pub fn surface(
        stiffness: [f64; 2],
        corners: &[[f64; 2]],
        post_yield: f64,
    ) -> Result<([Self; 3], f64), Vec<SpringFault>> {
        let [axial, bending] = stiffness;
        if !(axial > 0.0 && bending > 0.0 && axial.is_finite() && bending.is_finite()) {
            return refused(format!(
                "needs stiffnesses above zero, found {axial} N/m and {bending} N·m/rad"
            ));
        }
        if !(0.0..1.0).contains(&post_yield) {
            return refused(format!(
                "must keep at least 0 and less than 1 of its stiffness after yield, found {post_yield}"
            ));
        }
        if let Some(problem) = fault_of(corners) {
            return refused(problem);
        }
        let radius = libm::sqrt(bending / axial);
        let scaled = |[force, moment]: [f64; 2]| [force, moment / radius];
        let mut kept = [scaled(corners[corners.len() - 1]); MOST_CORNERS];
        for (kept, corner) in kept.iter_mut().zip(corners) {
            *kept = scaled(*corner);
        }
        let most = corners.iter().flat_map(|[force, moment]| {
            let half = 0.5 * (moment / radius).abs();
            [(0.5 * force).abs() + half, half]
        });
        let bounds = Corners::bilinear(most.fold(0.0, f64::max), post_yield);
        let backbone = Backbone::from_forces(0.5 * axial, bounds, bounds)?;
        let rows = [0, 1, 2].map(|index| {
            let mut corners = [[0.0; 2]; KEPT];
            corners.copy_from_slice(&kept[KEPT * index..KEPT * (index + 1)]);
            Self {
                rule: HysteresisRule::Surface {
                    row: ForceRow::ALL[index],
                    corners,
                },
                backbone,
            }
        });
        Ok((rows, radius))
    }

    /// Whether it is a row of a section that yields on a surface.
    #[must_use]
    pub fn is_on_surface(&self) -> bool {
        matches!(
            self.rule,
            HysteresisRule::Surface { .. } | HysteresisRule::SpaceSurface { .. }
        )
    }

    /// Whether it is the first of them.
    pub(crate) fn starts_surface(&self) -> bool {
        matches!(
            self.rule,
            HysteresisRule::Surface {
                row: ForceRow::X,
                ..
            } | HysteresisRule::SpaceSurface { row: 0, .. }
        )
    }

    /// Whether a row on a surface has yielded.
    pub(super) fn has_flowed(&self, memory: &HysteresisMemory) -> bool {
        let plastic = memory.force - self.backbone.initial() * memory.deformation;
        plastic.abs() > YIELDS * self.backbone.yield_force()
    }
}

/// A surface that is refused.
pub(super) fn refused<T>(problem: String) -> Result<T, Vec<SpringFault>> {
    Err(vec![SpringFault {
        quantity: Quantity::Rule,
        side: None,
        problem,
    }])
}

/// What is wrong with the corners of a surface.
pub(super) fn fault_of(corners: &[[f64; 2]]) -> Option<String> {
    let count = corners.len();
    if !(3..=MOST_CORNERS).contains(&count) {
        return Some(format!(
            "needs 3 to {MOST_CORNERS} corners of axial force and moment, found {count}"
        ));
    }
    if corners.iter().flatten().any(|value| !value.is_finite()) {
        return Some("needs finite forces and moments".into());
    }
    if let Some(at) = corners.iter().position(|[_, moment]| *moment < 0.0) {
        return Some(format!(
            "needs moments of at least zero, found less at corner {}: negative moments have the same surface",
            at + 1
        ));
    }
    if let Some(at) = corners.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
        return Some(format!(
            "needs axial forces in ascending order, tension positive, found none at corner {}",
            at + 2
        ));
    }
    let [first, last] = [corners[0][0], corners[count - 1][0]];
    if !(first < 0.0 && last > 0.0) {
        return Some(format!(
            "needs compression at its first corner and tension at its last, found {first} N and {last} N"
        ));
    }
    let tallest = corners
        .iter()
        .fold(0.0_f64, |most, [_, moment]| most.max(*moment));
    let flat = FLAT * (last - first) * tallest;
    let bends_in = |three: &[[f64; 2]]| {
        let [a, b, c] = [three[0], three[1], three[2]];
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > flat
    };
    if let Some(at) = corners.windows(3).position(bends_in) {
        return Some(format!(
            "must be convex, but corner {} lies inside of the line between its neighbours",
            at + 2
        ));
    }
    (tallest <= 0.0).then(|| "needs a moment above zero".into())
}

impl Surface {
    /// The law of three rows; `None` for other springs.
    pub(crate) fn of(rows: [&Hysteresis; 3]) -> Option<Self> {
        let mut all = [[0.0; 2]; MOST_CORNERS + 2];
        for (index, row) in rows.into_iter().enumerate() {
            let HysteresisRule::Surface { corners, .. } = row.rule else {
                return None;
            };
            all[1 + KEPT * index..][..KEPT].copy_from_slice(&corners);
        }
        // Both ends are closed down to the axis.
        all[0] = [all[1][0], 0.0];
        all[MOST_CORNERS + 1] = [all[MOST_CORNERS][0], 0.0];
        Some(Self {
            stiffness: rows[0].backbone.initial(),
            post_yield: rows[0].backbone.side(Side::Positive).post_yield
                / rows[0].backbone.initial(),
            corners: all,
        })
    }

    /// Its corners as they were stated, with the distance ℓ \[m\].
    pub(crate) fn stated(&self, radius: f64) -> Vec<[f64; 2]> {
        let inner = &self.corners[1..=MOST_CORNERS];
        let mut corners: Vec<_> = inner
            .iter()
            .map(|[force, moment]| [*force, radius * moment])
            .collect();
        corners.dedup();
        corners
    }

    /// Stiffness of what flows, (1 − r) k.
    fn flowing(&self) -> f64 {
        (1.0 - self.post_yield) * self.stiffness
    }

    /// Forces of both points and their tangent at displacements reached on a straight path.
    pub(crate) fn answer(&self, from: [&HysteresisMemory; 2], to: [f64; 2]) -> PlanAnswer {
        let (k, kept) = (self.flowing(), self.post_yield * self.stiffness);
        let trial = [0, 1].map(|point| {
            let memory = from[point];
            memory.force - kept * memory.deformation + k * (to[point] - memory.deformation)
        });
        let (within, flow) = self.closest([trial[0] + trial[1], trial[0] - trial[1]]);
        let inner = match flow {
            Flow::Elastic => trial,
            Flow::Edge(_) | Flow::Corner => {
                [0.5 * (within[0] + within[1]), 0.5 * (within[0] - within[1])]
            }
        };
        let force = [0, 1].map(|point| inner[point] + kept * to[point]);
        PlanAnswer::new(force, self.tangent(flow))
    }

    /// Stiffness of the three rows while it gives this way.
    pub(crate) fn tangents(&self, flow: Flow) -> [f64; 3] {
        PlanAnswer::new([0.0; 2], self.tangent(flow)).tangents
    }

    /// Tangent \[a b; b c\] over the displacements of both points.
    fn tangent(&self, flow: Flow) -> [f64; 3] {
        let (k, kept) = (self.flowing(), self.post_yield * self.stiffness);
        let [a, b, c] = match flow {
            Flow::Elastic => [1.0, 0.0, 1.0],
            Flow::Edge([axial, moment]) => {
                // A unit vector of the plane of N and M/ℓ is √2 of one of both points.
                let [x, y] = [axial + moment, axial - moment];
                [0.5 * x * x, 0.5 * x * y, 0.5 * y * y]
            }
            Flow::Corner => [0.0; 3],
        };
        [k * a + kept, k * b, k * c + kept]
    }

    /// The point of the surface, or inside of it, that is closest to N and M/ℓ.
    fn closest(&self, at: [f64; 2]) -> ([f64; 2], Flow) {
        let sign = if at[1] < 0.0 { -1.0 } else { 1.0 };
        let upper = [at[0], at[1].abs()];
        let mut outside = false;
        let mut best = (f64::INFINITY, [0.0; 2], Flow::Corner);
        for pair in self.corners.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let edge = [to[0] - from[0], to[1] - from[1]];
            let length = libm::hypot(edge[0], edge[1]);
            if length == 0.0 {
                continue;
            }
            let along = edge.map(|part| part / length);
            let away = [upper[0] - from[0], upper[1] - from[1]];
            // Corners go clockwise above the axis: what lies to the left of an edge is outside.
            outside |= along[0] * away[1] - along[1] * away[0] > 0.0;
            let reached = along[0] * away[0] + along[1] * away[1];
            let (point, flow) = if reached <= 0.0 {
                (from, Flow::Corner)
            } else if reached >= length {
                (to, Flow::Corner)
            } else {
                let point = [0, 1].map(|part| from[part] + reached * along[part]);
                // A vertical end goes on below the axis.
                (point, Flow::Edge(along))
            };
            let distance = libm::hypot(upper[0] - point[0], upper[1] - point[1]);
            if distance < best.0 {
                best = (distance, point, flow);
            }
        }
        if !outside {
            return (at, Flow::Elastic);
        }
        let (_, point, flow) = best;
        let flow = match flow {
            Flow::Edge([axial, moment]) => Flow::Edge([axial, sign * moment]),
            // On the axis of a vertical end both halves are one edge.
            Flow::Corner if point[1] == 0.0 && self.is_blunt_at(point[0]) => Flow::Edge([0.0, 1.0]),
            other => other,
        };
        ([point[0], sign * point[1]], flow)
    }

    /// N and M/ℓ of the part that flows, by the states of both points.
    fn flowing_part(&self, rows: [&HysteresisMemory; 2]) -> [f64; 2] {
        let kept = self.post_yield * self.stiffness;
        let [x, y] = rows.map(|row| row.force - kept * row.deformation);
        [x + y, x - y]
    }

    /// Edges on either side of the axis, as a corner, the unit direction of the edge and its normal outwards.
    fn edges(&self) -> impl Iterator<Item = [[f64; 2]; 3]> + '_ {
        let pairs = self.corners.windows(2);
        pairs.flat_map(|pair| {
            let edge = [0, 1].map(|part| pair[1][part] - pair[0][part]);
            let length = libm::hypot(edge[0], edge[1]);
            let both = [1.0, -1.0].into_iter().filter(move |_| length > 0.0);
            both.map(move |side| {
                let [axial, moment] = edge.map(|part| part / length);
                let corner = [pair[0][0], side * pair[0][1]];
                [corner, [axial, side * moment], [-moment, side * axial]]
            })
        })
    }

    /// How far inside of an edge a point is.
    fn within(at: [f64; 2], [corner, _, normal]: &[[f64; 2]; 3]) -> f64 {
        (0..2)
            .map(|part| normal[part] * (corner[part] - at[part]))
            .sum()
    }

    /// Distance from an edge below which a point is on it \[N\].
    fn near(&self) -> f64 {
        let [first, last] = [self.corners[0][0], self.corners[MOST_CORNERS + 1][0]];
        NEAR * (last - first)
    }

    /// Whether a state is on the surface.
    pub(crate) fn is_reached(&self, rows: [&HysteresisMemory; 2]) -> bool {
        let at = self.flowing_part(rows);
        let near = self.near();
        self.edges().any(|edge| Self::within(at, &edge) <= near)
    }

    /// How it gives from a state if both points move at these rates: the elastic rate of the force, projected on what the edges there leave.
    pub(crate) fn flow(&self, rows: [&HysteresisMemory; 2], rates: [f64; 2]) -> Flow {
        let at = self.flowing_part(rows);
        let near = self.near();
        let elastic = [rates[0] + rates[1], rates[0] - rates[1]];
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let here = || self.edges().filter(|edge| Self::within(at, edge) <= near);
        let leaves = |rate: [f64; 2]| {
            let small = NEAR * libm::hypot(elastic[0], elastic[1]);
            here().all(|[_, _, normal]| dot(normal, rate) <= small)
        };
        if leaves(elastic) {
            return Flow::Elastic;
        }
        let mut along = here().map(|[_, along, _]| along);
        along
            .find(|along| leaves(along.map(|part| part * dot(*along, elastic))))
            .map_or(Flow::Corner, Flow::Edge)
    }

    /// Time until the next edge, if both points move at these rates and it gives this way; infinite if there is none.
    pub(crate) fn time_to_edge(
        &self,
        rows: [&HysteresisMemory; 2],
        rates: [f64; 2],
        flow: Flow,
    ) -> f64 {
        let k = self.flowing();
        let elastic = [k * (rates[0] + rates[1]), k * (rates[0] - rates[1])];
        let rate = match flow {
            Flow::Elastic => elastic,
            Flow::Edge(along) => {
                let speed = along[0] * elastic[0] + along[1] * elastic[1];
                along.map(|part| part * speed)
            }
            Flow::Corner => return f64::INFINITY,
        };
        let at = self.flowing_part(rows);
        let near = self.near();
        let small = NEAR * libm::hypot(rate[0], rate[1]);
        let times = self.edges().filter_map(|edge| {
            let [_, _, normal] = edge;
            let (left, closing) = (
                Self::within(at, &edge),
                normal[0] * rate[0] + normal[1] * rate[1],
            );
            (left > near && closing > small).then(|| left / closing)
        });
        times.fold(f64::INFINITY, f64::min)
    }

    /// Whether the surface is vertical where it crosses the axis at an axial force.
    fn is_blunt_at(&self, force: f64) -> bool {
        let on_axis = self.corners.iter().filter(|corner| corner[0] == force);
        on_axis.fold(0.0_f64, |most, corner| most.max(corner[1])) > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hysteresis::Stage;

    /// Compression of 4 MN, tension of 1 MN, 400 kN·m at 1.5 MN.
    const CORNERS: [[f64; 2]; 6] = [
        [-4e6, 0.0],
        [-3e6, 2.6e5],
        [-1.5e6, 4e5],
        [-5e5, 3.3e5],
        [0.0, 2.4e5],
        [1e6, 0.0],
    ];
    const STIFFNESS: [f64; 2] = [1e10, 2e8];

    /// A section that is driven by elongations and rotations.
    struct Driven {
        law: Surface,
        radius: f64,
        rows: [HysteresisMemory; 2],
        work: f64,
    }

    impl Driven {
        fn new(corners: &[[f64; 2]], post_yield: f64) -> Self {
            let (rows, radius) =
                Hysteresis::surface(STIFFNESS, corners, post_yield).expect("sound");
            let [a, b, c] = &rows;
            Self {
                law: Surface::of([a, b, c]).expect("rows of a surface"),
                radius,
                rows: [HysteresisMemory::default(); 2],
                work: 0.0,
            }
        }

        fn displacements(&self, [elongation, rotation]: [f64; 2]) -> [f64; 2] {
            [1.0, -1.0].map(|side| elongation + side * self.radius * rotation)
        }

        fn forces(&self, force: [f64; 2]) -> [f64; 2] {
            [force[0] + force[1], self.radius * (force[0] - force[1])]
        }

        /// Axial force and moment there.
        fn go(&mut self, deformation: [f64; 2]) -> [f64; 2] {
            let to = self.displacements(deformation);
            let answer = self.law.answer(self.rows.each_ref(), to);
            for (point, row) in self.rows.iter_mut().enumerate() {
                let mean = 0.5 * (row.force + answer.force[point]);
                self.work += mean * (to[point] - row.deformation);
                (row.deformation, row.force) = (to[point], answer.force[point]);
            }
            self.forces(answer.force)
        }
    }

    /// Moment of a surface at an axial force.
    fn moment_at(force: f64) -> f64 {
        let pair = CORNERS.windows(2).find(|pair| pair[1][0] >= force);
        let [a, b] = pair.map_or([CORNERS[0]; 2], |pair| [pair[0], pair[1]]);
        a[1] + (b[1] - a[1]) * (force - a[0]) / (b[0] - a[0])
    }

    /// Under a constant axial force the moment stops at that of the surface, on either side; the section goes on to stretch as the normal
    /// of the surface says.
    #[test]
    fn the_moment_under_constant_force_is_that_of_the_surface() {
        for force in [-3.5e6, -2e6, -1e6, -2e5, 5e5] {
            for side in [1.0, -1.0] {
                let mut section = Driven::new(&CORNERS, 0.0);
                let mut elongation = 0.0;
                let (mut moment, mut stretched) = (0.0, [0.0; 2]);
                for step in 0..=400 {
                    let rotation = side * 1e-4 * f64::from(step);
                    let axial = |elongation: f64| {
                        let to = section.displacements([elongation, rotation]);
                        let answer = section.law.answer(section.rows.each_ref(), to);
                        section.forces(answer.force)[0] - force
                    };
                    // The axial force never falls with elongation.
                    let (mut low, mut high) = (elongation - 0.1, elongation + 0.1);
                    for _ in 0..80 {
                        let middle = 0.5 * (low + high);
                        *(if axial(middle) < 0.0 {
                            &mut low
                        } else {
                            &mut high
                        }) = middle;
                    }
                    elongation = 0.5 * (low + high);
                    moment = section.go([elongation, rotation])[1];
                    if step == 200 {
                        stretched = [elongation, rotation];
                    }
                }
                let expected = side * moment_at(force);
                assert!(
                    (moment / expected - 1.0).abs() < 1e-9,
                    "{force}: {moment} {expected}"
                );
                let slope = (moment_at(force + 1.0) - moment_at(force - 1.0)) / 2.0;
                let flow = (elongation - stretched[0]) / (side * (0.04 - stretched[1].abs()));
                assert!(
                    (flow + side * slope).abs() < 1e-6 * slope.abs().max(1e-3),
                    "{force}: {flow} {slope}"
                );
            }
        }
    }

    /// A path of elongation and rotation through many edges, both ways.
    fn path(t: f64) -> [f64; 2] {
        let (a, b) = (libm::sin(2.3 * t), libm::sin(3.7 * t + 0.4));
        [-4e-4 + 1.5e-3 * t * a, 8e-3 * t * b]
    }

    /// Forces at times, by explicit steps of the flow rule written anew: stresses beyond an edge are returned along its normal in the
    /// metric of the elastic stiffness, one edge after the other, until none is passed.
    fn explicit(post_yield: f64, steps: u32, times: &[f64]) -> Vec<[f64; 2]> {
        let mut lines = Vec::new();
        for side in [1.0, -1.0] {
            for pair in CORNERS.windows(2) {
                let [a, b] = [pair[0], pair[1]];
                // n · (N, M) ≤ n · a
                let normal = [-(b[1] - a[1]), side * (b[0] - a[0])];
                let bound = normal[0] * a[0] + normal[1] * side * a[1];
                lines.push((normal, bound));
            }
        }
        let elastic = STIFFNESS.map(|stiffness| (1.0 - post_yield) * stiffness);
        let mut plastic = [0.0_f64; 2];
        let mut found = Vec::new();
        let end = times[times.len() - 1];
        let mut due = times.iter().peekable();
        for step in 1..=steps {
            let t = end * f64::from(step) / f64::from(steps);
            let at = path(t);
            let stress = |plastic: &[f64; 2]| [0, 1].map(|i| elastic[i] * (at[i] - plastic[i]));
            for _ in 0..50 {
                let now = stress(&plastic);
                let beyond = lines.iter().map(|(normal, bound)| {
                    let over = normal[0] * now[0] + normal[1] * now[1] - bound;
                    let stiff: f64 = (0..2).map(|i| normal[i] * normal[i] * elastic[i]).sum();
                    (over / stiff.sqrt(), over / stiff, normal)
                });
                let worst = beyond.max_by(|a, b| a.0.total_cmp(&b.0));
                let Some((size, rate, normal)) = worst else {
                    break;
                };
                if size <= 1e-9 * 1e3 {
                    break;
                }
                for (plastic, normal) in plastic.iter_mut().zip(normal) {
                    *plastic += rate * normal;
                }
            }
            if due.next_if(|due| **due <= t + 1e-12).is_some() {
                let inner = stress(&plastic);
                found.push([0, 1].map(|i| inner[i] + post_yield * STIFFNESS[i] * at[i]));
            }
        }
        found
    }

    /// The law in steps equals the flow rule in much finer ones.
    #[test]
    fn a_path_follows_the_flow_rule() {
        let times: Vec<f64> = (1..=40).map(|n| 0.1 * f64::from(n)).collect();
        for post_yield in [0.0, 0.02] {
            let expected = explicit(post_yield, 400_000, &times);
            let error = |per_time: u32| {
                let mut section = Driven::new(&CORNERS, post_yield);
                let mut worst = 0.0_f64;
                for (k, expected) in expected.iter().enumerate() {
                    let mut reached = [0.0; 2];
                    for part in 1..=per_time {
                        let t = 0.1 * (k as f64 + f64::from(part) / f64::from(per_time));
                        reached = section.go(path(t));
                    }
                    worst = worst
                        .max((reached[0] - expected[0]).abs() / 4e6)
                        .max((reached[1] - expected[1]).abs() / 4e5);
                }
                worst
            };
            let errors = [20, 200, 2000].map(error);
            assert!(errors[0] < 0.05, "{errors:?}");
            assert!(errors[2] < 1e-3, "{errors:?}");
            assert!(errors[1] < 0.5 * errors[0], "{errors:?}");
        }
    }

    /// Tangents are derivatives of the forces, symmetric and at least what is kept.
    #[test]
    fn tangents_are_differences_of_forces() {
        for post_yield in [0.0, 0.03] {
            let section = Driven::new(&CORNERS, post_yield);
            let k = 0.5 * STIFFNESS[0];
            for deformation in [
                [1e-4, 2e-4],
                [-2e-4, 4e-3],
                [-1e-3, -4e-3],
                [2e-3, 1e-3],
                [-9e-4, 1e-5],
            ] {
                let to = section.displacements(deformation);
                let rows = section.rows.each_ref();
                let answer = |to: [f64; 2]| section.law.answer(rows, to);
                let by = 1e-9;
                let column = |point: usize| {
                    let [less, more] = [-by, by].map(|by| {
                        let mut to = to;
                        to[point] += by;
                        answer(to).force
                    });
                    [0, 1].map(|row| (more[row] - less[row]) / (2.0 * by))
                };
                let [x, y] = [column(0), column(1)];
                assert!((x[1] - y[0]).abs() < 1e-5 * k);
                let expected = [x[0] + x[1], y[1] + x[1], -x[1]];
                for (found, expected) in answer(to).tangents.iter().zip(expected) {
                    assert!(
                        (found - expected).abs() < 1e-5 * k,
                        "{deformation:?}: {found:e} {expected:e}"
                    );
                }
                let least = post_yield * k;
                let [a, b, c] = [x[0] - least, x[1], y[1] - least];
                assert!(a > -1e-5 * k && c > -1e-5 * k && a * c - b * b > -1e-5 * k * k);
            }
        }
    }

    /// From no path back to no forces comes more energy than went in.
    #[test]
    fn no_closed_path_gives_energy() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        for post_yield in [0.0, 0.05] {
            let mut section = Driven::new(&CORNERS, post_yield);
            let mut least = 0.0_f64;
            let mut at = [0.0; 2];
            for _ in 0..300 {
                let to = [4e-3 * random(), 2e-2 * random()];
                for part in 1..=200 {
                    let share = f64::from(part) / 200.0;
                    section.go([0, 1].map(|i| at[i] + share * (to[i] - at[i])));
                    // What stays in the section: F²/2k of both points bounds what it can give back.
                    let held = section.rows.iter().map(|row| {
                        let inner = row.force - post_yield * 0.5 * STIFFNESS[0] * row.deformation;
                        inner * inner / (1.0 - post_yield)
                            + post_yield * (0.5 * STIFFNESS[0] * row.deformation).powi(2)
                    });
                    let held: f64 = held.sum::<f64>() / STIFFNESS[0];
                    least = least.min((section.work - held) / held.max(1.0));
                }
                at = to;
            }
            assert!(least > -1e-3, "{least}");
            assert!(section.work > 0.0);
        }
    }

    /// Surfaces whose ends are blunt, and rows that yield.
    #[test]
    fn ends_may_be_blunt_and_rows_tell_whether_they_yielded() {
        let blunt = [[-4e6, 1e5], [-1.5e6, 4e5], [1e6, 0.0]];
        let mut section = Driven::new(&blunt, 0.0);
        let (rows, _) = Hysteresis::surface(STIFFNESS, &blunt, 0.0).expect("sound");
        let stage = |section: &Driven| rows[0].stage(&section.rows[0]);
        section.go([-3.9e-4, 0.0]);
        assert_eq!(stage(&section), Stage::Uncracked);
        assert_eq!(section.go([-3e-3, 0.0]), [-4e6, 0.0]);
        assert_eq!(stage(&section), Stage::Yielded);
        // On the blunt end moments change at will.
        let [force, moment] = section.go([-3e-3, 2e-4]);
        assert!(
            (force + 4e6).abs() < 1.0 && (moment - 4e4).abs() < 1.0,
            "{force} {moment}"
        );
    }

    #[test]
    fn surfaces_out_of_range_are_refused() {
        let problem = |corners: &[[f64; 2]], post_yield: f64| {
            let faults = Hysteresis::surface(STIFFNESS, corners, post_yield).expect_err("refused");
            faults[0].problem.clone()
        };
        let of = |corners: &[[f64; 2]]| problem(corners, 0.0);
        assert!(of(&CORNERS[..2]).contains("3 to 12"));
        assert!(of(&[[-1.0, 0.0], [-2.0, 1.0], [3.0, 0.0]]).contains("ascending"));
        assert!(of(&[[-1.0, 0.0], [0.0, -1.0], [3.0, 0.0]]).contains("at least zero"));
        assert!(of(&[[1.0, 0.0], [2.0, 1.0], [3.0, 0.0]]).contains("compression"));
        assert!(of(&[[-1.0, 0.0], [0.0, 0.0], [3.0, 0.0]]).contains("above zero"));
        assert!(of(&[[-2.0, 0.0], [-1.0, 5.0], [0.0, 1.0], [3.0, 0.0]]).contains("corner 3"));
        assert!(of(&[[-1.0, 0.0], [0.0, f64::NAN], [3.0, 0.0]]).contains("finite"));
        assert!(problem(&CORNERS, 1.0).contains("less than 1"));
        let faults = Hysteresis::surface([0.0, 1.0], &CORNERS, 0.0);
        assert!(faults.is_err());
    }
}
