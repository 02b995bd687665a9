//! Ground that differs under the buildings, and vertical shaking.

use std::fmt::Write;

use jostle::structure::Support;
use jostle::system::BuildingSystem;
use jostle::{GroundMotion, OwnGround, ProportionalDamping};

use super::motion::write_wave;
use super::script::{Script, comment};
use super::ties::is_held;

impl Script<'_> {
    /// Whether grounds of buildings or walls move apart.
    pub(super) fn grounds_part(&self) -> bool {
        let motion = self.export.motion;
        let count = self.export.model.buildings.len() + self.export.system.walls.len();
        // What is not listed stands on the common ground.
        (0..count).any(|index| !motion.moves_alike(index, count))
    }

    /// Whether dashpots damp a building relative to what it stands on, in place of damping of its masses.
    pub(super) fn damps_by_dashpots(&self, index: usize, building: &BuildingSystem) -> bool {
        self.is_damped_on_its_foundation(index, building) || self.grounds_part()
    }

    /// Dashpots α m to the ground of a building, which moves.
    pub(super) fn add_ground_dashpots(&mut self) {
        if !self.grounds_part() {
            return;
        }
        self.remark(
            "Grounds that move apart: displacements are those in space, and supports are moved before every step by the exact \
             integrals of their accelerations; the script reports displacements relative to the ground of each building.",
        );
        self.springs.push_str("    # damping relative to grounds\n");
        for (index, building) in self.export.system.buildings.iter().enumerate() {
            let alpha = building.equations.alpha;
            if alpha == 0.0 || self.is_damped_on_its_foundation(index, building) {
                continue;
            }
            let sticks = &building.discretization.stick_model;
            let ground = self.ground_point(index, [0.0; 2]);
            for (number, node) in sticks.nodes.iter().enumerate() {
                if node.support == Support::Fixed {
                    continue;
                }
                let masses = [1, 2, 6].into_iter().zip(node.inertia);
                let mut dashpots = Vec::new();
                for (component, (direction, mass)) in masses.into_iter().enumerate() {
                    if mass != 0.0 && !is_held(sticks, number, component) {
                        let material = self.materials.elastic(0.0, alpha * mass);
                        dashpots.push((direction, material));
                    }
                }
                if !dashpots.is_empty() {
                    let tag = self.tag(index, number);
                    self.spring(ground, tag, &dashpots, ProportionalDamping::None);
                }
            }
        }
    }

    /// Motions that are not the common one, and which is under every building.
    pub(super) fn write_grounds(&self, out: &mut String) -> std::fmt::Result {
        let Some(grounds) = &self.export.motion.grounds else {
            return writeln!(out, "\nGROUNDS = []\nVERTICAL = []");
        };
        let mut known: Vec<&GroundMotion> = Vec::new();
        let all = grounds.own.iter();
        for motion in all
            .flat_map(|ground| [&ground.motion, &ground.vertical])
            .flatten()
        {
            if !known.contains(&motion) {
                known.push(motion);
            }
        }
        for (number, motion) in known.iter().enumerate() {
            let name = comment(&motion.name);
            writeln!(out, "\n\nclass GROUND_{}:  # {name}", number + 1)?;
            let mut wave = format!("DURATION = {:?}  # s\n", motion.duration);
            write_wave(&mut wave, motion)?;
            for line in wave.lines() {
                writeln!(out, "    {line}")?;
            }
        }
        let name = |motion: &Option<GroundMotion>| {
            let place = motion
                .as_ref()
                .and_then(|motion| known.iter().position(|candidate| *candidate == motion));
            place.map_or_else(
                || "None".to_owned(),
                |place| format!("GROUND_{}", place + 1),
            )
        };
        let common = OwnGround::default();
        let under = |index: usize| grounds.own.get(self.ground_of(index)).unwrap_or(&common);
        let buildings = 0..self.export.system.buildings.len();
        writeln!(
            out,
            "\n# of every building: its motion, None being the common one, and when it arrives [s]; empty where one ground is under all"
        )?;
        let rows = buildings
            .clone()
            .filter(|_| self.grounds_part())
            .map(|index| {
                let ground = under(index);
                format!("({}, {:?})", name(&ground.motion), ground.arrival)
            });
        writeln!(out, "GROUNDS = [{}]", rows.collect::<Vec<_>>().join(", "))?;
        writeln!(
            out,
            "\n# the same of vertical motion, upwards; None is none"
        )?;
        let rows = buildings
            .filter(|_| self.export.motion.is_vertical())
            .map(|index| {
                let ground = under(index);
                match ground.vertical {
                    Some(_) => format!("({}, {:?})", name(&ground.vertical), ground.arrival),
                    None => "None".to_owned(),
                }
            });
        writeln!(out, "VERTICAL = [{}]", rows.collect::<Vec<_>>().join(", "))
    }

    /// The ground under a building of the system: those of the model come first, then all walls, rigid ones too.
    fn ground_of(&self, index: usize) -> usize {
        let mut walls = self.export.system.walls.iter();
        let wall = walls.position(|wall| wall.building == Some(index));
        wall.map_or(index, |wall| self.export.model.buildings.len() + wall)
    }
}
