//! Storey shears and overturning moments of one building.

use crate::linear::Row;
use crate::model::LEVEL_TOLERANCE;
use crate::structure::Equations;
use crate::structure::element::{self, Part, Place, THETA, X, Y};
use crate::structure::stick_elements;
use crate::structure::{LinkEnd, StickModel};

/// Storey forces as linear forms of displacements.
///
/// The storey shear is the sum of the horizontal restoring forces (rows x of (K + K′) u, of springs that yield, and of links
/// between floors) of all nodes above the base of the storey, positive when the building leans to the right. The overturning moment
/// is the moment of the same forces about the base of the storey. Vertical forces are not included. (A. K. Chopra,
/// Dynamics of Structures, sections 9.4.4 and 13.2.)
#[derive(Clone, Debug, Default)]
pub struct StoreyForces {
    storeys: Vec<Storey>,
    /// Storeys of one direction: of the list, or a third of it for a building in plan.
    per_direction: usize,
}

/// Forces of the nodes between the base of a storey and that of the next.
#[derive(Clone, Debug, Default)]
struct Storey {
    /// Height of the storey \[m\].
    height: f64,
    /// What displacements of the building contribute to the sum of forces \[N/m, N/rad\] and to their moment about the base of the
    /// storey \[N, N·m/rad\], over the same degrees of freedom.
    of_displacements: [Row; 2],
    /// Spring that yields, and the contribution of its force \[–, m\].
    of_springs: Vec<(usize, [f64; 2])>,
    /// Link between floors, among those of the building, and the contribution of its compression \[–, m\].
    of_links: Vec<(usize, [f64; 2])>,
}

/// Rounding errors of stiffnesses that cancel.
const ROUNDING: f64 = 1e-13;

impl Storey {
    fn displace(&mut self, dof: usize, shares: [f64; 2]) {
        for (row, share) in self.of_displacements.iter_mut().zip(shares) {
            row.add(dof, share);
        }
    }

    /// Adds up terms of one degree of freedom. Those that cancel are left out where they cancel in the moment as well.
    fn merge(&mut self) {
        let least = ROUNDING * self.of_displacements[0].greatest();
        let [shear, moment] = self.of_displacements.each_ref().map(Row::summed);
        let both = shear.entries().iter().zip(moment.entries());
        let kept = both.filter(|((_, force), (_, moment))| force.abs().max(moment.abs()) > least);
        let (shear, moment): (Vec<_>, Vec<_>) = kept.unzip();
        self.of_displacements = [shear, moment].map(Row::from_iter);
        // Both ends of a spring within one storey.
        self.of_springs.dedup_by(|(spring, share), (kept, sum)| {
            let same = spring == kept;
            if same {
                (0..2).for_each(|term| sum[term] += share[term]);
            }
            same
        });
        self.of_springs.retain(|(_, share)| *share != [0.0; 2]);
    }
}

/// What a unit force at a displacement of a node adds to the force in a direction \[–\], or to the torque about a vertical axis through the
/// centre of mass of the lowest floor \[m\]; `floor`: that at its height, or else the next above.
fn force_about(
    stick_model: &StickModel,
    place: Place,
    direction: usize,
    floor: usize,
    centres: &[[f64; 2]],
) -> f64 {
    let acts = stick_model.influence(place).horizontal();
    let [Some([x, y]), Some(axis)] = [centres.get(floor).or(centres.last()), centres.first()]
    else {
        return acts[direction];
    };
    match direction {
        THETA => acts[2] + acts[0] * (axis[1] - y) + acts[1] * (x - axis[0]),
        direction => acts[direction],
    }
}

/// Forces of a storey.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StoreyForce {
    /// Storey shear \[N\].
    pub shear: f64,
    /// Overturning moment about the base of the storey \[N·m\].
    pub moment: f64,
}

impl StoreyForces {
    /// `tops`: heights of the floors above the base, rising \[m\]. `centres`: centres of mass of the floors on the site, for a
    /// building in plan \[m\]; empty in one plane.
    ///
    /// Of a building in plan: shears along x of all storeys, then shears across, then torques about the vertical axis through the
    /// centre of mass of the lowest floor, each from the ground up. What acts on a floor acts at its centre of mass.
    pub(crate) fn new(
        stick_model: &StickModel,
        equations: &Equations,
        tops: &[f64],
        centres: &[[f64; 2]],
    ) -> Self {
        let directions = match centres.is_empty() {
            true => &[X][..],
            false => &[X, Y, THETA],
        };
        let mut all = Self {
            storeys: Vec::with_capacity(directions.len() * tops.len()),
            per_direction: tops.len(),
        };
        for direction in directions {
            let mut below = 0.0;
            let storeys = tops.iter().map(|top| Storey {
                height: top - std::mem::replace(&mut below, *top),
                ..Storey::default()
            });
            let mut forces = Self {
                storeys: storeys.collect(),
                per_direction: tops.len(),
            };
            // What a unit force at a displacement adds to the forces of its storey; nothing at the ground.
            let acts = |place: Place| {
                let height = stick_model.nodes[place.0].y;
                let floor = tops.partition_point(|top| *top + LEVEL_TOLERANCE < height);
                force_about(stick_model, place, *direction, floor, centres)
            };
            let elements = stick_elements::stiffnesses(stick_model);
            for (part, a, b, value) in elements.flat_map(|element| element.entries) {
                let Some(dof) = equations.dof(b).filter(|_| part != Part::Dashpot) else {
                    continue;
                };
                let share = acts(a);
                if share == 0.0 && *direction != THETA {
                    continue;
                }
                if let Some((storey, arm)) = forces.arm(tops, stick_model.nodes[a.0].y) {
                    let force = share * value;
                    storey.displace(dof, [force, arm * force]);
                }
            }
            for (index, spring) in stick_model.single_springs().enumerate() {
                for (place, share) in element::places(&spring.row) {
                    let force = share * acts(place);
                    // Ends of columns act at the joints that move them.
                    let carried = stick_model.carried(place);
                    let mut carried = element::places(&carried);
                    let node = carried.next().map_or(place.0, |((node, _), _)| node);
                    let at = forces.arm(tops, stick_model.nodes[node].y);
                    if let (true, Some((storey, arm))) = (force != 0.0, at) {
                        storey.of_springs.push((index, [force, arm * force]));
                    }
                }
            }
            forces.storeys.iter_mut().for_each(Storey::merge);
            all.storeys.append(&mut forces.storeys);
        }
        all
    }

    /// Adds a link between floors of a building; `axis`: centre of mass of its lowest floor on the site \[m\].
    pub(crate) fn add_link(&mut self, link: usize, ends: &[LinkEnd], axis: [f64; 2]) {
        let mut top = 0.0;
        let storeys = self.storeys[..self.per_direction].iter();
        let tops = storeys.map(|storey| {
            top += storey.height;
            top
        });
        let tops: Vec<f64> = tops.collect();
        let directions = self.storeys.len() / self.per_direction.max(1);
        for end in ends {
            let [x, y, torque] = end.shares;
            let about_axis = torque - axis[0] * y + axis[1] * x;
            let shares = [x, y, about_axis].into_iter().enumerate();
            for (direction, share) in shares.take(directions) {
                if let (true, Some((storey, arm))) = (share != 0.0, self.place(&tops, end.height)) {
                    let storey = &mut self.storeys[direction * self.per_direction + storey];
                    storey.of_links.push((link, [share, share * arm]));
                }
            }
        }
    }

    /// The storey of a node, and its height above the base of the storey \[m\]; `None` at the ground.
    fn arm(&mut self, tops: &[f64], height: f64) -> Option<(&mut Storey, f64)> {
        let (at, arm) = self.place(tops, height)?;
        Some((&mut self.storeys[at], arm))
    }

    /// The same with the index of the storey.
    fn place(&self, tops: &[f64], height: f64) -> Option<(usize, f64)> {
        if height <= LEVEL_TOLERANCE {
            return None;
        }
        let above = tops.partition_point(|top| *top + LEVEL_TOLERANCE < height);
        let at = above.min(tops.len().checked_sub(1)?);
        let base = if at == 0 { 0.0 } else { tops[at - 1] };
        Some((at, height - base))
    }

    /// Number of storeys; three times as many for a building in plan.
    #[must_use]
    pub fn len(&self) -> usize {
        self.storeys.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.storeys.is_empty()
    }

    /// Calls `take` with every storey, from the top down, direction by direction for a building in plan, and its forces, for displacements of the building \[m,
    /// rad\], forces of its springs that yield and of the links between its floors \[N\].
    pub fn for_each(
        &self,
        displacement: &[f64],
        spring: impl Fn(usize) -> f64,
        link: impl Fn(usize) -> f64,
        mut take: impl FnMut(usize, StoreyForce),
    ) {
        let mut above = StoreyForce::default();
        for (index, storey) in self.storeys.iter().enumerate().rev() {
            if (index + 1).is_multiple_of(self.per_direction) {
                above = StoreyForce::default();
            }
            let mut storey_force = StoreyForce {
                shear: above.shear,
                moment: above.moment + above.shear * storey.height,
            };
            let mut add = |[force, moment]: [f64; 2], by: f64| {
                storey_force.shear += force * by;
                storey_force.moment += moment * by;
            };
            let [shear, moment] = storey.of_displacements.each_ref().map(Row::entries);
            for ((dof, force), (_, moment)) in shear.iter().zip(moment) {
                add([*force, *moment], displacement[*dof]);
            }
            for (index, share) in &storey.of_springs {
                add(*share, spring(*index));
            }
            for (index, share) in &storey.of_links {
                add(*share, link(*index));
            }
            take(index, storey_force);
            above = storey_force;
        }
    }
}
