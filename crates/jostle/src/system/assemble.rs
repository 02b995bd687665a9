//! From a model to a system.

use super::soil::{self, Founded, Ground};
use super::{
    BuildingSystem, Floor, FoundationInPlan, FoundationPlace, LimitedEnd, SpringSupport, System,
    WallPlace, finite,
};
use crate::contact::{ContactLaw, effective_mass};
use crate::interface::contact_points::{PointPair, SAME, mean, set_back};
use crate::interface::{
    Contact, Coulomb, EdgeEnd, Friction, JoinedPoints, LinkElement, PlanPlace, Port, PortPair,
    PushedFloor, Touched, faces_of_gap, narrowest, sticking_stiffness, unique_below,
};
use crate::linear::{Row, sort_by};
use crate::model::{
    Base, Building, Damping, FloorPairs, Foundation, LEVEL_TOLERANCE, Level, Link, LinkLaw,
    LumpedFloor, MassDamping, Model, ModelFault, PlanPoint, Structure, Tier,
};
use crate::structure::{Discretization, InnerLink, LinkEnd, PointNode, StruckPoints};

impl System {
    /// Assembles a model.
    ///
    /// # Errors
    /// All faults of the model, as [`Model::check`] finds them, or what only assembly shows: damping at modes
    /// that do not exist, contacts at points without mass, periods and durations that are not finite.
    pub fn assemble(model: &Model) -> Result<Self, Vec<ModelFault>> {
        model.check()?;
        let row = JoinedPoints::new(model);
        let mut buildings = Vec::new();
        let mut foundations: Vec<(usize, FoundationPlace)> = Vec::new();
        let mut faults = Vec::new();
        for (index, building) in model.buildings.iter().enumerate() {
            let points = &row.struck_points(model, index);
            let number = foundations.len();
            let has_plan = matches!(building.structure, Structure::Tiers(_));
            let plane_base = Some(&building.base).filter(|_| !has_plan);
            let on_soil = plane_base.and_then(|base| {
                let foundation = base.foundation?;
                let ground = Ground::of(model, &foundation, number)?;
                Some((foundation, ground))
            });
            let in_plan = founded_in_plan(model, index).filter(|_| has_plan);
            let mut damped_at = Vec::new();
            let mut fixed = |on_mat| {
                fixed(model, index, points, on_mat)
                    .inspect(|fixed| damped_at.clone_from(&fixed.damped_at))
            };
            let damping = match (building.base.isolation, &on_soil, in_plan) {
                (Some(_), ..) => fixed(true).map(|fixed| (rayleigh(&fixed), None, None)),
                (None, Some((foundation, ground)), _) => fixed(false)
                    .and_then(|fixed| Founded::new(building, &fixed, points, foundation, ground))
                    .map(|founded| (founded.damping.clone(), Some((founded, *foundation)), None)),
                (None, None, Some((foundation, ground))) => fixed(false).and_then(|fixed| {
                    let plan = FoundationInPlan::new(building, &fixed, &foundation, &ground)?;
                    Ok((rayleigh(&fixed), None, Some(plan)))
                }),
                (None, None, None) => Ok((building.damping.clone(), None, None)),
            };
            let (damping, founded, in_plan) = match damping {
                Ok(damping) => damping,
                Err((field, problem)) => {
                    faults.push(ModelFault {
                        path: format!("building[{index}].{field}"),
                        problem,
                    });
                    continue;
                }
            };
            let on_springs = in_plan.map(|plan| Building {
                base: plan.base(&building.base),
                ..building.clone()
            });
            let building = on_springs.as_ref().unwrap_or(building);
            let mut discretization = Discretization::with_points(building, points);
            if let Some((founded, foundation)) = &founded {
                founded.support(&mut discretization, foundation, building.mass_damping);
            } else if let Damping::Rayleigh { alpha, .. } = damping {
                discretization.damp_relative_to_mat(alpha);
                if in_plan.is_some() && building.mass_damping == MassDamping::Support {
                    discretization.damp_relative_to_base(alpha);
                }
            }
            let mut assembled = BuildingSystem::new(&building.name, discretization);
            if let Err(problem) = assembled.put_under_gravity(building.gravity) {
                faults.push(ModelFault {
                    path: format!("building[{index}].{}", problem.field()),
                    problem: problem.to_string(),
                });
                continue;
            }
            assembled.weaken_with_ductility(building);
            assembled.limit_rotations(building);
            let ends = &assembled.limited_ends;
            if let Some(problem) = LimitedEnd::fault(building, &assembled.structure, ends) {
                faults.push(ModelFault {
                    path: format!("building[{index}].rotation_limit"),
                    problem: problem.into(),
                });
                continue;
            }
            // Modes and damping are those with the links between its floors.
            match inner_links(&assembled, model, index) {
                Ok(links) if founded.is_none() => assembled.link(links),
                Ok(_) => {}
                Err(mut found) => {
                    faults.append(&mut found);
                    continue;
                }
            }
            if let Some(fault) = finite::of_building(index, building, &assembled) {
                faults.push(fault);
                continue;
            }
            if let Structure::Tiers(tiers) = &building.structure {
                let plans: Vec<&[PlanPoint]> =
                    tiers.floors.iter().map(|floor| &floor.plan[..]).collect();
                assembled.place_corners(&plans);
            }
            if let Err(problem) = assembled.damp(&damping) {
                faults.push(ModelFault {
                    path: format!("building[{index}].damping.modes"),
                    problem,
                });
            }
            assembled.damped_at.append(&mut damped_at);
            assembled.foundation_in_plan = in_plan.and_then(|plan| plan.under(&assembled));
            if let Some((founded, foundation)) = &founded {
                assembled.foundation = founded.place(&assembled, *foundation);
                // Only now what the foundation turns can be taken out of their shortening.
                assembled.link(inner_links(&assembled, model, index)?);
                foundations.extend(assembled.foundation.map(|place| (index, place)));
            }
            buildings.push(assembled);
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let between = couple_foundations(model, &foundations, &mut buildings)?;
        let mut walls = Vec::new();
        for wall in &model.walls {
            let place = wall.stiffness.map(|stiffness| {
                let direction = wall.direction();
                let sticks = Discretization::of_wall(stiffness, wall, direction);
                let mut system = BuildingSystem::new(&wall.name, sticks);
                system.support = Some(SpringSupport {
                    dof: 0,
                    stiffness,
                    damping: wall.damping,
                    spring: None,
                    direction,
                });
                buildings.push(system);
                buildings.len() - 1
            });
            walls.push(WallPlace {
                name: wall.name.clone(),
                building: place,
            });
        }
        let mut system = Self::of_buildings(buildings);
        system.walls = walls;
        system.join(&row, model)?;
        let places = system.buildings.iter().enumerate();
        let places: Vec<_> = places
            .filter_map(|(index, building)| Some((index, building.foundation?)))
            .collect();
        let soil = soil::links(&between, &places, &system.buildings, model.links.len());
        system.soil_links = soil.len();
        system.links.extend(soil);
        system.follow_members(&model.analysis.members);
        system.follow_links(model.analysis.link_motion);
        let faults = finite::of_contacts(&system);
        if faults.is_empty() {
            Ok(system)
        } else {
            Err(faults)
        }
    }

    /// The same buildings with the gaps of another model, which may differ from that of this system in the widths and laws
    /// of its gaps only: nothing is assembled anew.
    ///
    /// # Errors
    /// As [`System::assemble`].
    pub fn with_gaps_of(&self, model: &Model) -> Result<Self, Vec<ModelFault>> {
        model.check()?;
        // Static coupling depends on the distance between foundations.
        if self.soil_links > 0 {
            return Self::assemble(model);
        }
        let mut system = Self {
            buildings: self.buildings.clone(),
            contacts: Vec::new(),
            edge_ends: Vec::new(),
            links: Vec::new(),
            soil_links: 0,
            members_followed: Vec::new(),
            links_followed: Vec::new(),
            ratings: Vec::new(),
            walls: self.walls.clone(),
            rigid_walls: Vec::new(),
        };
        system.join(&JoinedPoints::new(model), model)?;
        system.follow_members(&model.analysis.members);
        system.follow_links(model.analysis.link_motion);
        Ok(system)
    }

    /// Adds the contacts and links of the model.
    ///
    /// # Errors
    /// Points that cannot be pushed.
    fn join(&mut self, row: &JoinedPoints, model: &Model) -> Result<(), Vec<ModelFault>> {
        let mut faults = Vec::new();
        for (index, (gap, joined)) in model.gaps.iter().zip(&row.gaps).enumerate() {
            let mut contacts = Vec::new();
            if model.is_in_space() {
                let first = self.contacts.last().and_then(|last| last.plan);
                let first = first.map_or(0, |place| place.face + 1);
                let (contacts, ends) = plan_contacts(self, model, index, first, &mut faults);
                self.contacts.extend(contacts);
                self.edge_ends.extend(ends);
                continue;
            }
            for (entry, pair) in joined.pairs.iter().enumerate() {
                match ports(self, joined.between, pair) {
                    Ok(ports) => {
                        let [left, right] = ports.masses();
                        contacts.push(Contact {
                            gap: index,
                            width: gap.width_of(entry)
                                + set_back(gap, model.neighbours(gap.between), pair),
                            law: gap.law.between(left, right),
                            ..Contact::without_law(ports)
                        });
                    }
                    Err(problem) => faults.push(ModelFault {
                        path: format!("gap[{index}].floors"),
                        problem,
                    }),
                }
            }
            sort_by(&mut contacts, |a, b| a.height.total_cmp(&b.height));
            self.contacts.extend(contacts);
        }
        let mut joined_inside = vec![0; self.buildings.len()];
        for (index, (link, joined)) in model.links.iter().zip(&row.links).enumerate() {
            let mut pairs = joined.pairs.clone();
            sort_by(&mut pairs, |a, b| mean(a).total_cmp(&mean(b)));
            let inside = link.is_inside();
            let ends: Vec<_> = if let Some(at) = link.at {
                links_in_plan(self, link, &pairs, at)
                    .into_iter()
                    .map(Ok)
                    .collect()
            } else if inside {
                ports_inside(self, link)
            } else {
                let ends = |pair| ports(self, joined.between, pair);
                pairs.iter().map(ends).collect()
            };
            for ends in ends {
                match ends {
                    Ok(ports) => {
                        let element = LinkElement {
                            link: index,
                            inside,
                            height: ports.height(),
                            stiffness: link.stiffness,
                            damping: link.damping,
                            law: link.law,
                            closing_at_rest: closing_at_rest(self, &ports),
                            ports,
                        };
                        if let (true, Some(building)) = (inside, link.between[0]) {
                            let mut inner_links =
                                self.buildings[building].structure.inner_links.iter_mut();
                            let next = inner_links.nth(joined_inside[building]);
                            joined_inside[building] += 1;
                            if let Some(next) = next {
                                next.link = self.links.len();
                            }
                        }
                        self.links.push(element);
                    }
                    Err(problem) => faults.push(ModelFault {
                        path: format!("link[{index}].floors"),
                        problem,
                    }),
                }
            }
        }
        let structures = self.structures().len();
        let rigid = |between: [Option<usize>; 2]| {
            between.map(|side| {
                let wall = side?.checked_sub(structures)?;
                self.walls[wall].building.is_none().then_some(wall)
            })
        };
        let contacts = self
            .contacts
            .iter()
            .map(|contact| row.gaps[contact.gap].between);
        let links = self.links.iter().map(|link| row.links[link.link].between);
        self.rigid_walls = contacts.chain(links).map(rigid).collect();
        // Gaps are measured on buildings that bear their weight.
        let at_rest = self.contacts.iter();
        let at_rest = at_rest.map(|contact| closing_at_rest(self, &contact.ports));
        let at_rest: Vec<f64> = at_rest.collect();
        for (contact, closing) in self.contacts.iter_mut().zip(at_rest) {
            // Frames that do not lean move by rounding alone.
            if closing.abs() > ROUNDING {
                contact.closing_at_rest = closing;
            }
        }
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults)
        }
    }
}

/// The same building fixed on its mat or on its foundation: its damping coefficients are those of motion relative to it (theory,
/// Eqs. B6 and B22).
///
/// # Errors
/// The field of the building, and what is wrong with it.
fn fixed(
    model: &Model,
    index: usize,
    points: &StruckPoints,
    on_mat: bool,
) -> Result<BuildingSystem, (&'static str, String)> {
    let fixed = Building {
        base: Base::default(),
        ..model.buildings[index].clone()
    };
    let mut assembled =
        BuildingSystem::new(&fixed.name, Discretization::with_points(&fixed, points));
    assembled
        .put_under_gravity(fixed.gravity)
        .map_err(|problem| (problem.field(), problem.to_string()))?;
    // Faults of links are found where they are joined.
    assembled.link(inner_links(&assembled, model, index).unwrap_or_default());
    assembled
        .damp_as(&fixed.damping, on_mat)
        .map_err(|problem| ("damping.modes", problem))?;
    Ok(assembled)
}

/// The foundation of a building with a plan, and the ground under it.
fn founded_in_plan(model: &Model, index: usize) -> Option<(Foundation, Ground<'_>)> {
    let foundation = model.buildings[index].base.foundation?;
    Some((foundation, Ground::of(model, &foundation, 0)?))
}

fn rayleigh(building: &BuildingSystem) -> Damping {
    Damping::Rayleigh {
        alpha: building.equations.alpha,
        beta: building.equations.beta,
    }
}

/// Leaves to every foundation the soil of its own, and returns the springs and dashpots between them.
///
/// # Errors
/// Foundations that act on each other more than springs between two of them can.
fn couple_foundations(
    model: &Model,
    foundations: &[(usize, FoundationPlace)],
    buildings: &mut [BuildingSystem],
) -> Result<Vec<soil::Between>, Vec<ModelFault>> {
    let fault = |problem: String| {
        vec![ModelFault {
            path: "soil.coupling".to_owned(),
            problem,
        }]
    };
    let Some(matrices) = soil::matrices(model, foundations).map_err(fault)? else {
        return Ok(Vec::new());
    };
    let split = soil::split(&matrices, foundations.len()).map_err(|worst| {
        fault(format!(
            "the neighbours of \"{}\" leave no positive stiffness or damping for its own soil: put fewer foundations beside each other, or give matrices with smaller entries between them",
            model.buildings[foundations[worst].0].name
        ))
    })?;
    if split.between.is_empty() {
        return Ok(Vec::new());
    }
    for ((building, _), [stiffness, damping]) in foundations.iter().zip(split.own) {
        buildings[*building].stand_on(stiffness, damping);
    }
    Ok(split.between)
}

/// Contacts of a gap between two buildings with plans, or one and a wall, from the lowest floor up, face by face; faces are numbered from
/// `first`.
///
/// The width of the gap is that of its narrowest point; all others are as much wider as the plans say. The stiffness of a
/// face is shared by its points. So is the mass of a side, 1/(1/m + ((c − o) × n)²/J) at the middle of the face, so that
/// dashpots of a face add up to that of the whole.
fn plan_contacts(
    system: &System,
    model: &Model,
    index: usize,
    first: usize,
    faults: &mut Vec<ModelFault>,
) -> (Vec<Contact>, Vec<EdgeEnd>) {
    let gap = &model.gaps[index];
    let [Some(a), Some(b)] = gap.between else {
        return Default::default();
    };
    // By number, the mat first; none of a wall.
    let floor_of = |side: usize, floor: usize| {
        let discretization = &system.buildings.get(side)?.discretization;
        match floor.checked_sub(1) {
            Some(floor) => discretization.lumped.get(floor).cloned(),
            None => discretization.carrier.clone(),
        }
    };
    let found = faces_of_gap(model, gap).unwrap_or_default();
    let narrowest = narrowest(&found).unwrap_or_default();
    let wider = gap.width() - narrowest;
    let (mut contacts, mut ends) = (Vec::new(), Vec::new());
    for (number, (touched, face)) in found.iter().enumerate() {
        let sides = [(a, touched[0]), (b, touched[1])];
        let pushed = sides.map(|(side, touched)| match touched {
            Touched::Floor(floor) => Ok(floor_of(side, floor)),
            Touched::Column(column, above) => {
                let point = system.buildings[side].column_point(column, above)?;
                Ok(Some(point_as_floor(point, face.middle)))
            }
        });
        let [one, other] = match pushed {
            [Ok(one), Ok(other)] => [one, other],
            [Err(problem), _] | [_, Err(problem)] => {
                faults.push(ModelFault {
                    path: format!("gap[{index}].floors"),
                    problem,
                });
                continue;
            }
        };
        let moving = |floor: &LumpedFloor| {
            let tier = &floor.tier;
            let arm = [
                face.middle[0] - tier.centre[0],
                face.middle[1] - tier.centre[1],
            ];
            let lever = arm[0] * face.normal[1] - arm[1] * face.normal[0];
            1.0 / (1.0 / floor.mass_along(face.normal) + lever * lever / tier.polar_mass)
        };
        let wall = |side: usize| system.moving_wall(side.checked_sub(model.buildings.len())?);
        let mass_of = |side: usize, floor: Option<&LumpedFloor>| match (floor, wall(side)) {
            (Some(floor), _) => moving(floor),
            (None, Some((_, wall))) => wall.equations.mass[0],
            (None, None) => f64::INFINITY,
        };
        let masses = [mass_of(a, one.as_ref()), mass_of(b, other.as_ref())];
        let whole = match gap.in_plan.per_length {
            true if face.overlap > 0.0 => gap.law.stiffness * face.overlap,
            _ => gap.law.stiffness,
        };
        let sticking = gap.in_plan.tangential_stiffness.unwrap_or_else(|| {
            let law = ContactLaw {
                stiffness: whole,
                ..gap.law
            };
            sticking_stiffness(&law, effective_mass(masses[0], masses[1]))
        });
        // That of the floor beside a wall, which has none.
        let beside = [(a, touched[0]), (b, touched[1])];
        let beside = beside.into_iter().filter_map(|(side, touched)| {
            let structure = system.structures().get(side)?;
            let height = match touched {
                Touched::Floor(floor) => structure.floors.get(floor.checked_sub(1)?)?.height,
                Touched::Column(column, above) => {
                    structure.column_point(column, above).ok()?.height
                }
            };
            Some(height + structure.discretization.elevation)
        });
        let beside = beside.reduce(f64::max).unwrap_or_default();
        for point in &face.points {
            let port = |building: usize, touched: Touched, mass: f64, direction: PlanPoint| {
                if building >= model.buildings.len() {
                    // Every point of a wall moves alike; friction along it moves nothing.
                    let (building, wall_system) = wall(building)?;
                    let normal = wall_system.support.as_ref()?.direction;
                    let share = direction[0] * normal[0] + direction[1] * normal[1];
                    return (share.abs() > SAME).then(|| Port {
                        building,
                        row: Row::single(wall_system.offset).times(share),
                        mass: point.share * mass,
                        floor: None,
                        height: beside,
                        level: beside,
                    });
                }
                let building_system = system.buildings.get(building)?;
                let (floor, row, height) = match (touched, &building_system.mat_in_plan) {
                    (Touched::Floor(0), mat) => {
                        (Some(0), mat.as_ref()?.row_at(point.at, direction), 0.0)
                    }
                    (Touched::Floor(floor), _) => {
                        let row = building_system.row_at(floor - 1, point.at, direction);
                        (Some(floor), row, building_system.floors[floor - 1].height)
                    }
                    (Touched::Column(column, above), _) => {
                        let node = building_system.column_point(column, above).ok()?;
                        let row = building_system.row_of_point(node, direction);
                        (None, row, node.height)
                    }
                };
                Some(Port {
                    building,
                    row,
                    mass: point.share * mass,
                    floor,
                    height,
                    level: height + building_system.discretization.elevation,
                })
            };
            let ports = |direction| {
                PortPair([
                    port(a, touched[0], masses[0], direction),
                    port(b, touched[1], masses[1], direction),
                ])
            };
            ends.extend(face.ends.iter().map(|end| EdgeEnd {
                contact: system.contacts.len() + contacts.len(),
                ports: ports(end.direction),
                inside: end.inside - if end.is_indentation { wider } else { 0.0 },
            }));
            let along = [-face.normal[1], face.normal[0]];
            let friction = (gap.in_plan.friction > 0.0).then(|| {
                let pushed = [&one, &other].into_iter().flatten();
                Friction {
                    law: Coulomb {
                        coefficient: gap.in_plan.friction,
                        stiffness: point.share * sticking,
                    },
                    ports: ports(along),
                    unique_below: unique_below(
                        pushed.map(|floor| pushed_at(floor, point.at, [face.normal, along])),
                    ),
                }
            });
            let ports = ports(face.normal);
            let law = gap.law.shared(whole, point.share);
            let [left, right] = ports.masses();
            contacts.push(Contact {
                gap: index,
                width: point.gap + wider,
                law: law.between(left, right),
                plan: Some(PlanPlace {
                    kind: face.kind,
                    parts: face.parts,
                    face: first + number,
                    at: point.at,
                    normal: face.normal,
                    overlap: face.overlap,
                    share: point.share,
                }),
                friction,
                ..Contact::without_law(ports)
            });
        }
    }
    (contacts, ends)
}

/// A point of a column as a floor that does not turn.
fn point_as_floor(point: &PointNode, at: PlanPoint) -> LumpedFloor {
    LumpedFloor::rigid(&Tier {
        mass: point.mass,
        polar_mass: f64::INFINITY,
        centre: at,
        plan: Vec::new(),
    })
}

/// A floor as a point sees it that pushes along the normal of a face and along the face.
fn pushed_at(floor: &LumpedFloor, at: PlanPoint, directions: [PlanPoint; 2]) -> PushedFloor {
    let tier = &floor.tier;
    let arm = [at[0] - tier.centre[0], at[1] - tier.centre[1]];
    let [normal, _] = directions;
    PushedFloor {
        levers: directions.map(|[x, y]| arm[0] * y - arm[1] * x),
        inverse_masses: directions.map(|direction| floor.inverse_mass(normal, direction)),
        polar_mass: tier.polar_mass,
    }
}

fn ports(
    system: &System,
    between: [Option<usize>; 2],
    pair: &PointPair,
) -> Result<PortPair, String> {
    let mut ports: [Option<Port>; 2] = [None, None];
    for side in 0..2 {
        let (Some(building), Some(height)) = (between[side], pair[side]) else {
            let structures = system.structures().len();
            let wall = between[side].and_then(|index| index.checked_sub(structures));
            let wall = wall.and_then(|wall| system.walls[wall].building);
            ports[side] = wall.map(|building| {
                let system_building = &system.buildings[building];
                Port {
                    building,
                    row: Row::single(system_building.offset),
                    mass: system_building.equations.mass[0],
                    floor: None,
                    height: mean(pair),
                    level: mean(pair),
                }
            });
            continue;
        };
        let discretization = &system.buildings[building].discretization;
        let port = if side == 0 {
            &discretization.right_face
        } else {
            &discretization.left_face
        };
        let nodes = &discretization.stick_model.nodes;
        let node = port
            .iter()
            .copied()
            .find(|&node| (nodes[node].y + discretization.elevation - height).abs() <= 2.0 * SAME)
            .ok_or_else(|| match discretization.stick_model.rigid_ends.is_empty() {
                true => format!("no point to hit at {height:.3} m"),
                false => format!(
                    "no point to hit at {height:.3} m: the end of the column is rigid there; leave rigid_ends out, or make them shorter"
                ),
            })?;
        ports[side] = Some(system.port(building, node)?);
    }
    Ok(PortPair(ports))
}

/// Ends of the links between floors of one building, from the lowest up. A base that does not move is the ground.
fn ports_inside(system: &System, link: &Link) -> Vec<Result<PortPair, String>> {
    let (Some(building), FloorPairs::Listed(pairs)) = (link.between[0], &link.floors) else {
        return Vec::new();
    };
    let system_building = &system.buildings[building];
    let nodes = &system_building.discretization.stick_model.nodes;
    let port = |level: Level| {
        let Level::Floor(floor) = level else {
            return Ok(None);
        };
        let node = match floor.checked_sub(1) {
            Some(index) => {
                let height = system_building.floors[index].height;
                let mut face = system_building.discretization.right_face.iter().copied();
                face.find(|&node| (nodes[node].y - height).abs() <= 2.0 * SAME)
            }
            None => {
                let base = system_building.discretization.base_node();
                base.filter(|&node| system_building.equations.horizontal(node).is_some())
            }
        };
        let port = |node| {
            let port = system.port(building, node);
            port.map(|port| relative_to_foundation(system_building, port))
        };
        node.map(port).transpose()
    };
    let mut found: Vec<_> = pairs
        .iter()
        .map(|[one, other]| Ok(PortPair([port(*one)?, port(*other)?])))
        .collect();
    sort_by(&mut found, |a: &Result<PortPair, String>, b| {
        let height =
            |ports: &Result<PortPair, String>| ports.as_ref().map_or(0.0, PortPair::height);
        height(a).total_cmp(&height(b))
    });
    found
}

/// Links of the model between floors of one building, with their initial stiffness, in the order in which they are joined.
///
/// # Errors
/// Floors that links cannot reach.
fn inner_links(
    building: &BuildingSystem,
    model: &Model,
    index: usize,
) -> Result<Vec<InnerLink>, Vec<ModelFault>> {
    let is_inner = |link: &&(usize, &Link)| link.1.is_inside() && link.1.between[0] == Some(index);
    let all: Vec<(usize, &Link)> = model.links.iter().enumerate().collect();
    if !all.iter().any(|link| is_inner(&link)) {
        return Ok(Vec::new());
    }
    let alone = System::of_buildings(vec![building.clone()]);
    let building = &alone.buildings[0];
    let mut found = Vec::new();
    for (number, link) in all.iter().filter(is_inner) {
        let of_alone = Link {
            between: [Some(0); 2],
            ..Link::clone(link)
        };
        let ends = match link.at {
            Some(at) => {
                let ends = links_in_plan(&alone, &of_alone, &[], at);
                ends.into_iter().map(Ok).collect()
            }
            None => ports_inside(&alone, &of_alone),
        };
        for ports in ends {
            let ports = ports.map_err(|problem| {
                vec![ModelFault {
                    path: format!("link[{number}].floors"),
                    problem,
                }]
            })?;
            let sides = || ports.sides().filter(|(port, _)| !stands_on(building, port));
            found.push(InnerLink {
                link: 0,
                shortening: ports
                    .sides()
                    .flat_map(|(port, sign)| {
                        let entries = port.row.entries().iter();
                        entries.map(move |(dof, share)| (*dof, -sign * share))
                    })
                    .collect(),
                stiffness: link.initial_stiffness(),
                spring: link.law.slow_spring(link.stiffness),
                floors: ports.floors().map(|floor| floor.unwrap_or(0)),
                damping: if link.law == LinkLaw::Linear {
                    link.damping
                } else {
                    0.0
                },
                ends: sides()
                    .map(|(port, sign)| LinkEnd {
                        height: port.height,
                        shares: force_in_plan(link, sign).map(|share| -sign * share),
                    })
                    .collect(),
            });
        }
    }
    Ok(found)
}

/// Direction of a link from its first to its second end, and the torque of a unit force in it about the origin of the site, at the end
/// with this sign \[m\]; along x in one plane.
fn force_in_plan(link: &Link, sign: f64) -> [f64; 3] {
    let Some(at) = link.at else {
        return [1.0, 0.0, 0.0];
    };
    let [x, y] = direction_of(at);
    let end = at[usize::from(sign > 0.0)];
    [x, y, end[0] * y - end[1] * x]
}

/// Unit vector from one point to another in plan.
fn direction_of([from, to]: [PlanPoint; 2]) -> [f64; 2] {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypot(x, y);
    [x / length, y / length]
}

/// Ends of the links of a model between points in plan, from the lowest up; `pairs`: heights of the floors of neighbours \[m\].
fn links_in_plan(
    system: &System,
    link: &Link,
    pairs: &[PointPair],
    at: [PlanPoint; 2],
) -> Vec<PortPair> {
    let mut ends: Vec<PortPair> = match (&link.floors, link.is_inside()) {
        (FloorPairs::Listed(pairs), true) => {
            let floor = |level: Level| match level {
                Level::Floor(floor) => Some(floor),
                Level::Height(_) | Level::Wall => None,
            };
            let pairs = pairs.iter().map(|pair| pair.map(floor));
            pairs
                .map(|floors| ports_in_plan(system, link.between, floors, at))
                .collect()
        }
        _ => {
            let floor_at = |side: usize, height: f64| {
                let building = system.buildings.get(link.between[side]?)?;
                let foot = building.discretization.elevation;
                let near = |floor: &Floor| (floor.height + foot - height).abs() <= 2.0 * SAME;
                building.floors.iter().position(near).map(|index| index + 1)
            };
            let floors = |pair: &PointPair| [0, 1].map(|side| floor_at(side, pair[side]?));
            pairs
                .iter()
                .map(|pair| ports_in_plan(system, link.between, floors(pair), at))
                .collect()
        }
    };
    sort_by(&mut ends, |a, b| a.height().total_cmp(&b.height()));
    ends
}

/// Ends of a link between two floors in plan, counted from 1, or a floor and the mat, which is floor 0; `None` is a wall or the ground.
fn ports_in_plan(
    system: &System,
    between: [Option<usize>; 2],
    floors: [Option<usize>; 2],
    at: [PlanPoint; 2],
) -> PortPair {
    let direction = direction_of(at);
    let ends = [0, 1].map(|side| {
        let (building, floor) = (between[side]?, floors[side]?);
        let building_system = system.buildings.get(building)?;
        let (mut row, height) = match (floor.checked_sub(1), &building_system.mat_in_plan) {
            (Some(index), _) => (
                building_system.row_at(index, at[side], direction),
                building_system.floors[index].height,
            ),
            (None, Some(mat)) => (mat.row_at(at[side], direction), 0.0),
            (None, None) => (building_system.footing_row_at(at[side], direction)?, 0.0),
        };
        let mass = row
            .moved_down(building_system.offset)
            .moving_mass(&building_system.equations.mass);
        // A building that rocks as a rigid body does not deform what stands between its floors.
        if between[0] == between[1]
            && let Some([.., along, across]) = building_system.base_motions()
        {
            for (rocked, share) in [along, across].into_iter().zip(direction) {
                let rocked = rocked
                    .moved_up(building_system.offset)
                    .times(-height * share);
                row.extend(
                    rocked
                        .entries()
                        .iter()
                        .copied()
                        .filter(|entry| entry.1 != 0.0),
                );
            }
        }
        Some(Port {
            building,
            row,
            mass,
            floor: Some(floor).filter(|floor| *floor > 0),
            height,
            level: height + building_system.discretization.elevation,
        })
    });
    PortPair(ends)
}

/// Whether an end is the foundation of its building: what acts there acts below it.
fn stands_on(building: &BuildingSystem, port: &Port) -> bool {
    building.discretization.stick_model.foundation.is_some() && port.height <= LEVEL_TOLERANCE
}

/// The same end of a link inside a building, with what its foundation turns taken out: u + yθ (theory, Eq. B22). A building that
/// rocks as a rigid body does not deform what stands between its floors.
fn relative_to_foundation(building: &BuildingSystem, port: Port) -> Port {
    let mut port = port;
    if let Some(foundation) = building.foundation
        && port.height != 0.0
    {
        port.row.extend([(foundation.turning, port.height)]);
    }
    port
}

/// Displacement that rounding alone causes \[m\].
const ROUNDING: f64 = 1e-12;

/// What gravity alone closes \[m\].
fn closing_at_rest(system: &System, ports: &PortPair) -> f64 {
    let displacement = |port: &Port| {
        let building = &system.buildings[port.building];
        let rest = &building.rest.displacement;
        if rest.is_empty() {
            return 0.0;
        }
        port.row.moved_down(building.offset).value(rest)
    };
    ports
        .sides()
        .map(|(port, sign)| -sign * displacement(port))
        .sum()
}
