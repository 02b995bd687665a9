//! Springs and dashpots under the base of a building in plan.

use super::discretization::Discretization;
use super::element::{Element, Part, Place, THETA, X, Y, index_of, over_nodes, places};
use super::order::Turn;
use super::plan_matrix::PlanMatrix;
use super::stick_model::{Influence, Node, PlanBase, StickModel, Support};
use super::tiers::motion_at;
use crate::linear::Row;
use crate::model::{Base, LEVEL_TOLERANCE, LumpedFloor, PlanArea, PlanPoint, TierStorey};

/// Least share of the coupled inertia in both others that is more than rounding \[–\].
const COUPLED: f64 = 1e-12;

impl PlanBase {
    /// Its nodes with displacements of their own.
    pub(crate) fn nodes(self) -> impl Iterator<Item = usize> {
        [self.footing]
            .into_iter()
            .chain(self.uncoupled.or(self.rocking))
    }

    /// The rise of its middle over displacements of nodes; `None` if it keeps its height.
    pub(crate) fn rise(self) -> Option<Row> {
        let node = self.rocking.filter(|_| self.rises)?;
        Some(over_nodes([((node, THETA), 1.0)]))
    }

    /// Its motions over displacements of nodes: sway along and across of its middle, rotation about the vertical axis, and rocking along
    /// and across, as displacements of floors per height.
    pub(crate) fn motions(self) -> [Row; 5] {
        let of_middle = motion_at(self.middle, self.centre).map(|shares| {
            let components = [X, Y, THETA].map(|component| (self.footing, component));
            over_nodes(
                components
                    .into_iter()
                    .zip(shares)
                    .filter(|candidate| candidate.1 != 0.0),
            )
        });
        let [along, across, turned] = of_middle;
        let rocked = |component| match self.rocking {
            Some(node) => over_nodes([((node, component), 1.0)]),
            None => Row::default(),
        };
        [along, across, turned, rocked(X), rocked(Y)]
    }

    /// How its rocking raises a point of the site; `None` if it does not rock.
    fn rise_at(self, point: PlanPoint) -> Option<Row> {
        let node = self.rocking?;
        let arms = [0, 1].map(|axis| point[axis] - self.middle[axis]);
        Some(self.risen(leant(node, arms)))
    }

    /// A rise by rocking with that of the middle.
    fn risen(self, mut row: Row) -> Row {
        let rise = self.rise().unwrap_or_default();
        row.extend(rise.entries().iter().copied());
        row
    }

    /// How its rocking turns a vertical plane along this direction, counter-clockwise; `None` if it does not rock.
    fn turn_in(self, direction: [f64; 2]) -> Option<Row> {
        Some(leant(self.rocking?, direction))
    }
}

/// What sinks where floors lean towards it, by these arms.
fn leant(rocking: usize, [along, across]: [f64; 2]) -> Row {
    let shares = [((rocking, X), -along), ((rocking, Y), -across)];
    over_nodes(shares.into_iter().filter(|share| share.1 != 0.0))
}

impl Discretization {
    /// Adds springs and dashpots between the ground and the footing of a building, at the centroid of the plan of the footing.
    pub(super) fn put_on_springs(
        &mut self,
        base: &Base,
        footing: &LumpedFloor,
        [ground, node]: [usize; 2],
    ) {
        let directions = base.in_plan();
        let sticks = &mut self.stick_model;
        let Some(plan_base) = sticks.plan_base else {
            return;
        };
        let bed = base
            .foundation
            .filter(|_| plan_base.rises)
            .and_then(|plate| {
                let vertical = base.vertical_stiffness?;
                let uplift = plate.uplift?;
                let rocking =
                    directions.map(|direction| direction.rotational_stiffness.unwrap_or(0.0));
                // What is not possible is found where the ground is.
                let bed = plate.bed_in_plan(vertical, uplift.ground.is_none().then_some(rocking));
                Some((plate, bed.ok()?))
            });
        if let Some(rocking) = plan_base.rocking {
            let springs = directions.map(|direction| direction.rotational_stiffness.unwrap_or(0.0));
            let stiffness = springs.map(|spring| if bed.is_some() { 0.0 } else { spring });
            let springs = [
                (Part::Undamped, stiffness),
                (
                    Part::Dashpot,
                    directions.map(|direction| direction.rotational_damping),
                ),
            ];
            for (part, values) in springs {
                let ends = [X, Y].map(|component| [(rocking, component), (ground, component)]);
                let springs = ends
                    .into_iter()
                    .zip(values)
                    .filter(|(_, value)| *value != 0.0);
                let springs = springs.map(|(ends, value)| Element::between(ends, part, value));
                sticks.elements.extend(springs);
            }
        }
        if let Some(rise) = plan_base.rise().filter(|_| base.vertical_damping > 0.0) {
            sticks.elements.push(Element::Spring {
                part: Part::Dashpot,
                stiffness: base.vertical_damping,
                row: rise,
            });
        }
        let sways = directions.map(|direction| direction.horizontal_stiffness);
        sticks.nodes[node].support = match (sways, base.torsional_stiffness) {
            ([None, None], None) => Support::Fixed,
            ([None, None], Some(_)) => Support::Turning,
            (_, None) => Support::Swaying,
            (_, Some(_)) => Support::Free,
        };
        let [along, across] = directions;
        let torsion = base.torsional_stiffness.unwrap_or(0.0);
        let stiffness = [sways[0].unwrap_or(0.0), sways[1].unwrap_or(0.0), torsion];
        let damping = [
            along.horizontal_damping,
            across.horizontal_damping,
            base.torsional_damping,
        ];
        let mut matrix = PlanMatrix::new(3);
        // Stiffness-proportional damping of the building does not act on them.
        for (stiffness, part) in [(stiffness, Part::Undamped), (damping, Part::Dashpot)] {
            let springs = TierStorey {
                stiffness,
                centre: plan_base.middle,
            };
            matrix.add_storey(std::slice::from_ref(footing), 0, &springs, part);
        }
        sticks.elements.extend(matrix.elements(ground, &[node]));
        sticks.uncouple_rocking();
        self.foot = Some(node);
        if let (Some((plate, bed)), Some(rocking)) = (bed, plan_base.rocking) {
            self.add_bed(&plate, bed, |spring| {
                plan_base.risen(leant(rocking, [spring.at, spring.across]))
            });
        }
    }

    /// Lets floors that neither columns nor walls carry rise with the base as a rigid body, with their masses and loads \[kg, N\].
    pub(super) fn let_floors_rise(&mut self, carried: &[[f64; 2]]) {
        let sticks = &mut self.stick_model;
        if !sticks.plan_base.is_some_and(|plan_base| plan_base.rises) {
            return;
        }
        for (floor, [mass, load]) in carried.iter().enumerate() {
            let height = sticks.nodes[self.floors[floor]].y;
            let node = sticks.nodes.len();
            sticks.nodes.push(Node {
                load: *load,
                inertia: [0.0, 0.0, *mass],
                influence: [Influence::NONE, Influence::NONE, Influence::UP],
                ..Node::at(0.0, height).held(Support::Turning)
            });
            sticks.note_rise((node, THETA), self.centres[floor]);
            sticks.raise((node, THETA));
        }
    }

    /// Mass-proportional damping of the motion relative to the base in plan: C = Tᵀ α M T instead of α M, T taking sway, rotation and
    /// rocking of the base as a rigid body out of every motion (theory, Eq. B22).
    pub(crate) fn damp_relative_to_base(&mut self, alpha: f64) {
        let sticks = &mut self.stick_model;
        let (Some(base), true) = (sticks.plan_base, alpha > 0.0) else {
            return;
        };
        let heights: Vec<f64> = (self.floors.iter())
            .map(|floor| sticks.nodes[*floor].y)
            .collect();
        let [x, y, turning] = [X, Y, THETA].map(|component| (base.footing, component));
        let carrier = [Some(base.footing), base.rocking];
        let over_nodes_of = |node: usize, component: usize| over_nodes([((node, component), 1.0)]);
        let mut dashpots = Vec::new();
        for (node, moving) in sticks.nodes.iter().enumerate() {
            let mut tops = heights.iter();
            let level = tops.position(|top| moving.y <= top + LEVEL_TOLERANCE);
            let centre = level.map_or(base.centre, |level| self.centres[level]);
            let arm = [0, 1].map(|axis| centre[axis] - base.centre[axis]);
            for (component, inertia) in moving.inertia.into_iter().enumerate() {
                if inertia == 0.0 || moving.support == Support::Fixed {
                    continue;
                }
                if carrier.contains(&Some(node)) {
                    dashpots.push((-alpha * inertia, over_nodes_of(node, component)));
                    continue;
                }
                let [along, across, turned] = moving.influence[component].horizontal();
                let turned = turned + across * arm[0] - along * arm[1];
                let mut rigid = vec![(x, along), (y, across), (turning, turned)];
                if let Some(rocking) = base.rocking {
                    let heights = [along, across].map(|share| share * moving.y);
                    rigid.extend([((rocking, X), heights[0]), ((rocking, Y), heights[1])]);
                }
                if let Some(raised) = sticks.raised.get(&index_of((node, component))) {
                    rigid.extend(places(raised));
                }
                rigid.retain(|(_, share)| *share != 0.0);
                if rigid.is_empty() {
                    continue;
                }
                let taken = rigid.into_iter().map(|(place, share)| (place, -share));
                let relative = [((node, component), 1.0)].into_iter().chain(taken);
                dashpots.push((alpha * inertia, over_nodes(relative)));
                dashpots.push((-alpha * inertia, over_nodes_of(node, component)));
            }
        }
        let dashpots = dashpots.into_iter();
        sticks
            .elements
            .extend(dashpots.map(|(stiffness, row)| Element::Spring {
                part: Part::Dashpot,
                stiffness,
                row,
            }));
    }
}

impl StickModel {
    /// Lets the floors so far stand on a footing, whose node is one of them. If the base rocks, it adds the rocking, as displacements of
    /// floors per height along x and across, and subtracts it from all that deforms so far. P-Delta acts on displacements as they
    /// are.
    ///
    /// A floor at a height h moves by u = u_f + w + h φ: sway of the footing, deformation of the building, and rocking.
    pub(super) fn stand_on_footing(&mut self, base: &Base, footing: &LumpedFloor, node: usize) {
        let area = PlanArea::new(&footing.tier.plan);
        self.plan_base = Some(PlanBase {
            footing: node,
            centre: footing.tier.centre,
            middle: area.centroid,
            rocking: None,
            on_soil: base.foundation.is_some(),
            rises: base.lifts(),
            uncoupled: None,
        });
        if !base.rocks_in_plan() {
            return;
        }
        let [across, along] = area.second_moments.map(|moment| moment / area.area);
        let mass = base
            .foundation
            .map_or(base.mass, |foundation| foundation.mass);
        let [along, across] = [along, across].map(|squared| mass * squared);
        let along = base
            .foundation
            .map_or(along, |foundation| foundation.rotary_inertia);
        let raised = if base.lifts() { mass } else { 0.0 };
        let rocking = self.add_leaning([along, across, raised]);
        if base.lifts() {
            // It rises even where it does not sway, so the node that rises counts its mass.
            self.nodes[rocking].mass = std::mem::take(&mut self.nodes[node].mass);
        }
        if let Some(plan_base) = &mut self.plan_base {
            plan_base.rocking = Some(rocking);
        }
        let deformed = self.elements.iter().map(|element| match element {
            Element::Spring {
                part: Part::Undamped,
                ..
            } => element.clone(),
            Element::Spring {
                part,
                stiffness,
                row,
            } => Element::Spring {
                part: *part,
                stiffness: *stiffness,
                row: self.without_rocking(row),
            },
            Element::Matrix { part, rows, lower } => Element::Matrix {
                part: *part,
                rows: rows.iter().map(|row| self.without_rocking(row)).collect(),
                lower: lower.clone(),
            },
        });
        self.elements = deformed.collect();
    }

    /// Adds a node of two displacements of floors per height, and of a rise if the base can lift off, with these inertias, and returns it.
    /// It comes after the roof, because it deforms every storey.
    fn add_leaning(&mut self, inertia: [f64; 3]) -> usize {
        let node = self.nodes.len();
        let rises = self.plan_base.is_some_and(|plan_base| plan_base.rises);
        self.nodes.push(Node {
            inertia,
            influence: match rises {
                true => [Influence::NONE, Influence::NONE, Influence::UP],
                false => [Influence::NONE; 3],
            },
            ..Node::at(0.0, 0.0).held(match rises {
                true => Support::Free,
                false => Support::Swaying,
            })
        });
        let top = self.nodes.iter().map(|node| node.y).fold(0.0, f64::max);
        let last = Turn {
            position: f64::INFINITY,
            ..Turn::of_floor(top, top)
        };
        self.turns.insert(node, last);
        node
    }

    /// A deformation over displacements of floors, with what the rocking of the base moves them taken out.
    pub(super) fn without_rocking(&self, row: &Row) -> Row {
        let Some(node) = self.plan_base.and_then(|plan_base| plan_base.rocking) else {
            return row.clone();
        };
        let nodes = &self.nodes;
        let rocked = |influence: fn(&Influence) -> f64| -> f64 {
            let shares = places(row).map(|((at, component), share)| {
                share * nodes[at].y * influence(&nodes[at].influence[component])
            });
            -shares.sum::<f64>()
        };
        let rocked = [
            ((node, X), rocked(|influence| influence.along)),
            ((node, Y), rocked(|influence| influence.across)),
        ];
        let rocked = over_nodes(rocked.into_iter().filter(|(_, share)| *share != 0.0));
        let all = row.entries().iter().chain(rocked.entries());
        all.copied().collect()
    }

    /// Lets a displacement of the point of the site at which it is rise with the rocking base as a rigid body, as far as it does not rise
    /// by itself.
    pub(super) fn note_rise(&mut self, place: Place, point: PlanPoint) {
        if let Some(rise) = self
            .plan_base
            .and_then(|plan_base| plan_base.rise_at(point))
        {
            self.raised.insert(index_of(place), rise);
        }
    }

    /// How the rocking base raises the point of the site at which a displacement is; `None` if the base does not rock.
    pub(super) fn rise_with_base(&self, place: Place) -> Option<&Row> {
        self.raised.get(&index_of(place))
    }

    /// Ties the rise of a displacement to that of the rocking base.
    pub(super) fn raise(&mut self, place: Place) {
        let index = index_of(place);
        if let Some(rise) = self.raised.get(&index) {
            self.ties.insert(index, rise.clone());
        }
    }

    /// Ties the rotation of a foot in a vertical plane along this direction to the rocking of the base.
    pub(super) fn turn_foot(&mut self, foot: usize, direction: [f64; 2]) {
        if let Some(turned) = self
            .plan_base
            .and_then(|plan_base| plan_base.turn_in(direction))
        {
            self.ties.insert(index_of((foot, THETA)), turned);
        }
    }

    /// Whether the base rocks.
    pub(super) fn rocks(&self) -> bool {
        self.plan_base
            .is_some_and(|plan_base| plan_base.rocking.is_some())
    }

    /// Lets rocking along and across, and a rise, follow displacements that masses which rise with them do not couple: of the inertia
    /// M = L D Lᵀ the motions q = L⁻ᵀ q′ leave D.
    fn uncouple_rocking(&mut self) {
        let Some((base, rocking)) = self
            .plan_base
            .and_then(|plan_base| Some((plan_base, plan_base.rocking?)))
        else {
            return;
        };
        let mut coupled = [[0.0; 3]; 3];
        for (node, stick_node) in self.nodes.iter().enumerate() {
            for (component, inertia) in stick_node.inertia.into_iter().enumerate() {
                if inertia == 0.0 || stick_node.support == Support::Fixed {
                    continue;
                }
                let row = self.carried((node, component));
                let shares = [X, Y, THETA].map(|component| {
                    let mut all = places(&row);
                    let found = all.find(|(place, _)| *place == (rocking, component));
                    found.map_or(0.0, |(_, share)| share)
                });
                for i in 0..3 {
                    for j in 0..=i {
                        coupled[i][j] += inertia * shares[i] * shares[j];
                    }
                }
            }
        }
        let size = |i: usize| coupled[i][i];
        let is_coupled =
            |&(i, j): &(usize, usize)| coupled[i][j].abs() > COUPLED * (size(i) * size(j)).sqrt();
        if ![(1, 0), (2, 0), (2, 1)].iter().any(is_coupled) {
            return;
        }
        let follows = self.add_leaning([0.0; 3]);
        self.plan_base = Some(PlanBase {
            uncoupled: Some(follows),
            ..base
        });
        let shares = uncoupled(&coupled);
        let last = if base.rises { THETA } else { Y };
        for component in X..=last {
            let pairs =
                (component..=last).map(|other| ((follows, other), shares[component][other]));
            let row = over_nodes(pairs.filter(|(_, share)| *share != 0.0));
            self.ties.insert(index_of((rocking, component)), row);
        }
        let ties = self.ties.iter();
        // One term per displacement: masses take the square of each.
        let ties = ties.map(|(index, row)| (*index, self.carried_row(row).merged()));
        self.ties = ties.collect();
    }
}

/// L⁻ᵀ of M = L D Lᵀ, with ones on the diagonal; `lower`: the lower triangle of M. A motion without inertia stays as it is.
fn uncoupled(lower: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let mut factor = [[0.0; 3]; 3];
    let mut pivots = [0.0; 3];
    for i in 0..3 {
        for j in 0..=i {
            let known = (0..j).map(|k| factor[i][k] * pivots[k] * factor[j][k]);
            let left = lower[i][j] - known.sum::<f64>();
            match (i == j, pivots[j] > 0.0) {
                (true, _) => (pivots[i], factor[i][i]) = (left, 1.0),
                (false, true) => factor[i][j] = left / pivots[j],
                (false, false) => {}
            }
        }
    }
    // Lᵀ X = 1 from the last row up.
    let mut shares = [[0.0; 3]; 3];
    for column in 0..3 {
        for i in (0..=column).rev() {
            let below = (i + 1..=column).map(|k| factor[k][i] * shares[k][column]);
            let unit = if i == column { 1.0 } else { 0.0 };
            shares[i][column] = unit - below.sum::<f64>();
        }
    }
    shares
}
