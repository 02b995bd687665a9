//! Buildings on soil: the foundation, what its rotation deforms, and springs of the soil, also between neighbours.
//!
//! A lever is a `twoNodeLink` with a shear spring: its deformation is the difference of displacements along it plus its length times
//! rotations of its ends. Levers start at nodes that move and turn with the foundation, at the length that is wanted. So no
//! constraint but equal displacements is needed, which the handler `Plain` takes back where a step fails.

use std::fmt::Write;

use jostle::hysteresis::HysteresisRule;
use jostle::interface::LinkElement;
use jostle::structure::{Node, Spring, Support};
use jostle::system::BuildingSystem;
use jostle::{MassDamping, ProportionalDamping};

use super::script::{Script, python_damping, rounded};
use super::soil::{Matrix, SoilSpring, springs_of};
use super::ties::{COMPONENTS, ROTATION, SAME_LINE, Ties};

/// Stiffness of what holds the feet of columns on the foundation, in units of the rocking stiffness of the soil over the square of
/// their distance from its middle \[–\].
const STIFF: f64 = 1e7;
/// What a script says about ground in compression alone.
pub(super) const GROUND: &str = "Ground under what can lift off is OpenSees' ElasticPPGap without a gap: the same law, without a search \
     for the instant at which it opens.";
/// Length of levers of the soil \[m\].
const LEVER: f64 = 1.0;

/// How much of the rotations of both ends acts on a lever.
#[derive(Clone, Copy)]
pub(super) enum Turning {
    Both,
    First,
}

/// The ends of a link that a foundation turns: a `twoNodeLink` upwards.
#[derive(Clone, Copy)]
pub(super) struct TurningEnds {
    /// Nodes of the first and of the second floor.
    pub(super) ends: [usize; 2],
    /// Whether its strain is its shortening, which is so where the first floor is the lower one.
    pub(super) turned: bool,
}

impl Script<'_> {
    /// A storey that deforms by u_i − u_{i−1} + hθ; P-Delta and what is left of it act on displacements alone.
    pub(super) fn add_storey_on_foundation(
        &mut self,
        [first, last]: [usize; 2],
        spring: &Spring,
    ) -> Result<(), &'static str> {
        // Deformation of a lever counts the other way.
        let hysteresis = spring
            .hysteresis
            .as_ref()
            .map(|hysteresis| hysteresis.mirrored());
        for material in self.spring_materials(spring.stiffness, hysteresis.as_ref(), 0.0)? {
            let ends = [first, last];
            self.lever(ends, material, Turning::Both, spring.proportional_damping);
        }
        if spring.dashpot != 0.0 {
            let material = self.materials.elastic(0.0, spring.dashpot);
            self.spring(first, last, &[(1, material)], ProportionalDamping::None);
        }
        Ok(())
    }

    pub(super) fn lever(
        &mut self,
        [first, last]: [usize; 2],
        material: usize,
        turning: Turning,
        damped: ProportionalDamping,
    ) {
        let tag = self.element();
        let share = match turning {
            Turning::Both => 0.5,
            Turning::First => 1.0,
        };
        let _ = writeln!(
            self.levered,
            "    ({tag}, {first}, {last}, {material}, {share:?}, {}),",
            python_damping(damped)
        );
    }

    /// Feet on a foundation, and damping of motion relative to it.
    pub(super) fn add_foundation(&mut self, index: usize, building: &BuildingSystem, ties: &Ties) {
        let stick_model = &building.discretization.stick_model;
        let Some(foundation) = &stick_model.foundation else {
            return;
        };
        let nodes = &stick_model.nodes;
        let base = nodes[foundation.node];
        let base_tag = self.tag(index, foundation.node);
        let lifts = !stick_model.bed.is_empty();
        let rocking = match building.foundation.filter(|_| lifts) {
            Some(place) => place.springs.rocking_stiffness,
            None => foundation.stiffness[2],
        };
        let levers = foundation
            .feet
            .iter()
            .map(|foot| (nodes[*foot].x - base.x).abs());
        let reach = levers.fold(0.0, f64::max);
        for &foot in &foundation.feet {
            let lever = nodes[foot].x - base.x;
            if lever.abs() <= SAME_LINE {
                continue;
            }
            // The middle of one that lifts off may stand close to its node.
            let lever = if lifts { reach } else { lever };
            let stiffness = STIFF * rocking / (lever * lever);
            let material = self.materials.elastic(stiffness, 0.0);
            let ends = [base_tag, self.tag(index, foot)];
            self.lever(ends, material, Turning::Both, ProportionalDamping::None);
            self.remark(
                "Feet of columns are held on their foundation by springs 10⁷ times as stiff as the soil in rocking; all other \
                 displacements that are equal are tied.",
            );
        }
        self.add_bed(index, building);
        let alpha = building.equations.alpha;
        if alpha == 0.0 || !self.is_damped_on_its_foundation(index, building) {
            return;
        }
        let lever = |node: usize| stick_model.lever(node);
        for (number, node) in nodes.iter().enumerate() {
            let of_mass = alpha * node.mass();
            if of_mass == 0.0 || number == foundation.node || node.support == Support::Fixed {
                continue;
            }
            let material = self.materials.elastic(0.0, of_mass);
            let tag = self.tag(index, number);
            if node.y > 0.0 {
                let below = self.on_foundation(index, building, ties, [node.x, base.y]);
                self.lever(
                    [below, tag],
                    material,
                    Turning::First,
                    ProportionalDamping::None,
                );
            }
            // Floors of a shear building do not rise, and columns that keep their length rise with the foundation.
            if node.support == Support::Free && lever(number).is_none() {
                if (node.x - base.x).abs() <= SAME_LINE {
                    let below = match lifts {
                        true => base_tag,
                        false => self.ground_point(index, [node.x, node.y]),
                    };
                    self.spring(below, tag, &[(2, material)], ProportionalDamping::None);
                } else {
                    let beside = self.on_foundation(index, building, ties, [base.x, node.y]);
                    self.lever(
                        [beside, tag],
                        material,
                        Turning::First,
                        ProportionalDamping::None,
                    );
                }
            }
        }
    }

    /// Whether the damping of the masses of a building acts on its motion relative to its foundation.
    pub(super) fn is_damped_on_its_foundation(
        &self,
        index: usize,
        building: &BuildingSystem,
    ) -> bool {
        let of_model = self.export.model.buildings.get(index);
        building.foundation.is_some()
            && of_model.is_some_and(|building| building.mass_damping == MassDamping::Support)
    }

    /// Contact springs under a foundation that lifts off, and the dashpot beside them.
    fn add_bed(&mut self, index: usize, building: &BuildingSystem) {
        let stick_model = &building.discretization.stick_model;
        let Some(foundation) = stick_model
            .foundation
            .as_ref()
            .filter(|_| !stick_model.bed.is_empty())
        else {
            return;
        };
        for element in &stick_model.yielding {
            if element.hysteresis.rule() != HysteresisRule::Ground {
                continue;
            }
            let mut shares = element.row.entries().iter();
            let turned =
                shares.find(|(place, _)| *place == COMPONENTS * foundation.node + ROTATION);
            let arm = turned.map_or(0.0, |(_, arm)| *arm);
            let material = self.materials.ground(&element.hysteresis, arm > SAME_LINE);
            self.hold_foundation(index, building, arm, material);
        }
        let dashpot = building
            .foundation
            .map_or(0.0, |place| place.springs.vertical_damping);
        if dashpot > 0.0 {
            let material = self.materials.elastic(0.0, dashpot);
            self.hold_foundation(index, building, foundation.middle, material);
        }
        self.remark(GROUND);
    }

    /// A spring between the ground and a point of a foundation at a distance to the right of its node. Its strain is the rise of the
    /// point, or the opposite to the right of the node.
    fn hold_foundation(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        arm: f64,
        material: usize,
    ) {
        let stick_model = &building.discretization.stick_model;
        let Some(foundation) = &stick_model.foundation else {
            return;
        };
        let base = stick_model.nodes[foundation.node];
        let tag = self.tag(index, foundation.node);
        let ground = self.ground_point(index, [base.x + arm, base.y]);
        if arm.abs() <= SAME_LINE {
            self.spring(ground, tag, &[(2, material)], ProportionalDamping::None);
        } else {
            self.lever(
                [tag, ground],
                material,
                Turning::First,
                ProportionalDamping::None,
            );
        }
    }

    /// Springs and dashpots of the soil, under every foundation and between them.
    pub(super) fn add_soil(&mut self) {
        let system = self.export.system;
        let founded: Vec<usize> = system
            .buildings
            .iter()
            .enumerate()
            .filter_map(|(index, building)| building.foundation.map(|_| index))
            .collect();
        if founded.is_empty() {
            return;
        }
        self.springs.push_str("    # soil\n");
        self.levered.push_str("    # soil\n");
        let [stiffness, damping] = Matrix::of_soil(system);
        let bases: Vec<(usize, Node)> = founded
            .iter()
            .filter_map(|index| {
                let sticks = &system.buildings[*index].discretization.stick_model;
                let foundation = sticks.foundation.as_ref()?;
                Some((
                    self.tag(*index, foundation.node),
                    sticks.nodes[foundation.node],
                ))
            })
            .collect();
        for (spring, [stiffness, dashpot]) in springs_of(stiffness, damping, LEVER) {
            let material = self.materials.elastic(stiffness, dashpot);
            let ties =
                |at: usize| Ties::new(&system.buildings[founded[at]].discretization.stick_model);
            let place = |at: usize, height: f64| [bases[at].1.x, bases[at].1.y + height];
            match spring {
                SoilSpring::Sway(at) | SoilSpring::Rocking(at) => {
                    let direction = match spring {
                        SoilSpring::Sway(_) => 1,
                        _ => 6,
                    };
                    let ground = self.ground_point(founded[at], place(at, 0.0));
                    self.spring(
                        ground,
                        bases[at].0,
                        &[(direction, material)],
                        ProportionalDamping::None,
                    );
                }
                SoilSpring::Between([left, right], direction) => {
                    let ends = [bases[left].0, bases[right].0];
                    self.spring(
                        ends[0],
                        ends[1],
                        &[(direction, material)],
                        ProportionalDamping::None,
                    );
                }
                SoilSpring::Lever(at, None) => {
                    let ground = self.ground_point(founded[at], place(at, LEVER));
                    self.lever(
                        [bases[at].0, ground],
                        material,
                        Turning::First,
                        ProportionalDamping::None,
                    );
                }
                SoilSpring::Lever(at, Some(other)) => {
                    // The node that turns below, that of the neighbour above it.
                    let beside = &system.buildings[founded[other]];
                    let shift = self.places[founded[at]] - self.places[founded[other]];
                    let [level, other_level] = [at, other]
                        .map(|number| system.buildings[founded[number]].discretization.elevation);
                    let [x, y] = place(at, LEVER + level - other_level);
                    let above =
                        self.on_foundation(founded[other], beside, &ties(other), [x + shift, y]);
                    self.lever(
                        [bases[at].0, above],
                        material,
                        Turning::First,
                        ProportionalDamping::None,
                    );
                }
            }
        }
    }

    /// The ends of a link between floors of a building on a foundation; `None` where it stands on none.
    pub(super) fn ends_on_foundation(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        link: &LinkElement,
    ) -> Option<TurningEnds> {
        let stick_model = &building.discretization.stick_model;
        let foundation = stick_model.foundation.as_ref()?;
        let ties = Ties::new(stick_model);
        let heights = link
            .ports
            .0
            .each_ref()
            .map(|port| port.as_ref().map_or(0.0, |port| port.height));
        let ends = [0, 1].map(|side| {
            let floor = link.ports.floors()[side];
            let node = match floor {
                Some(floor) => building.discretization.floors[floor - 1],
                None => foundation.node,
            };
            let base = foundation.node;
            if ties.followed_by(node, 2) == ties.followed_by(base, 2) {
                return self.tag(index, node);
            }
            let followed = [ties.followed_by(node, 0), ties.followed_by(base, 2)];
            self.following(
                index,
                followed,
                None,
                [stick_model.nodes[base].x, heights[side]],
            )
        });
        Some(TurningEnds {
            ends,
            turned: heights[1] > heights[0],
        })
    }

    /// A node that moves and turns with a foundation, wherever it stands.
    fn on_foundation(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        ties: &Ties,
        at: [f64; 2],
    ) -> usize {
        let stick_model = &building.discretization.stick_model;
        let Some(foundation) = &stick_model.foundation else {
            return self.ground_point(index, at);
        };
        let base = stick_model.nodes[foundation.node];
        if [at[0] - base.x, at[1] - base.y]
            .iter()
            .all(|apart| apart.abs() <= SAME_LINE)
        {
            return self.tag(index, foundation.node);
        }
        let followed = [0, 2].map(|component| ties.followed_by(foundation.node, component));
        let rise = (!stick_model.bed.is_empty()).then(|| ties.followed_by(foundation.node, 1));
        self.following(index, followed, rise, at)
    }

    /// A node that moves along x with one node and turns with another. It rises with a third, or not at all.
    fn following(
        &mut self,
        index: usize,
        followed: [usize; 2],
        rise: Option<usize>,
        at: [f64; 2],
    ) -> usize {
        let tag = self.plane_point(index, at);
        if rise.is_none() {
            let _ = writeln!(self.supports, "    ({tag}, 0, 1, 0),");
        }
        let risen = rise.map(|node| (node, 2));
        for (node, component) in followed.into_iter().zip([1, 3]).chain(risen) {
            let followed = self.tag(index, node);
            let _ = writeln!(self.ties, "    ({followed}, {tag}, {component}),");
        }
        tag
    }

    /// A node that stands still, or moves with the ground of a building.
    pub(super) fn ground_point(&mut self, index: usize, at: [f64; 2]) -> usize {
        let tag = self.plane_point(index, at);
        let _ = writeln!(self.supports, "    ({tag}, 1, 1, 1),");
        tag
    }

    /// A node without mass of a building in one plane.
    pub(super) fn plane_point(&mut self, index: usize, [x, y]: [f64; 2]) -> usize {
        let tag = self.tag(index, self.next_point[index]);
        self.next_point[index] += 1;
        let x = rounded(x + self.places[index]);
        let y = y + self.export.system.buildings[index].discretization.elevation;
        let _ = writeln!(
            self.nodes,
            "    ({tag}, {x:?}, {:?}, 0.0, 0.0),",
            rounded(y)
        );
        tag
    }
}
