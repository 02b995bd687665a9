//! A class beside its neighbour, and the rows that it stands for.

use jostle_batch::{Building, Gap, Law, Row};
use jostle_classes::{Class, Types, lognormal};
use jostle_io::{ClassesFile, ClassesSide, InputError};

/// A class of some storeys.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Member {
    /// Type as the file names it.
    pub(crate) kind: String,
    pub(crate) class: Class,
    pub(crate) storeys: usize,
}

/// A class beside its neighbour.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pair {
    pub(crate) own: Member,
    pub(crate) neighbour: Member,
    /// Whether floors of the neighbour lie half a storey higher.
    pub(crate) half_up: bool,
    /// Whether the neighbour stands on both sides.
    pub(crate) middle: bool,
}

/// What a row of a pair differs in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Draw {
    pub(crate) number: u64,
    pub(crate) motion: usize,
    pub(crate) scale: f64,
    /// Width of the gaps \[m\]; `None` lets buildings pass through each other.
    pub(crate) gap: Option<f64>,
}

/// The structural types of a file.
///
/// # Errors
/// A table that is not understood.
pub(crate) fn types(file: &ClassesFile) -> Result<Types, InputError> {
    let at = if file.types.types.is_some() {
        "buildings.table"
    } else {
        "damage.table"
    };
    Types::read(&file.types).map_err(|problem| file.fault(at, problem))
}

/// Every pair of a file, in its order.
///
/// # Errors
/// A type that is not understood, at its line.
pub(crate) fn pairs(file: &ClassesFile, types: &Types) -> Result<Vec<Pair>, InputError> {
    let owns = members(file, types, &file.class)?;
    let neighbours = members(file, types, &file.neighbour)?;
    let mut pairs = Vec::new();
    for member in &owns {
        for neighbour in &neighbours {
            for &half_up in &file.half_storey_up {
                for &middle in &file.in_the_middle {
                    let (member, neighbour) = (member.clone(), neighbour.clone());
                    pairs.push(Pair {
                        own: member,
                        neighbour,
                        half_up,
                        middle,
                    });
                }
            }
        }
    }
    Ok(pairs)
}

fn members(
    file: &ClassesFile,
    types: &Types,
    side: &ClassesSide,
) -> Result<Vec<Member>, InputError> {
    let level = side.level.parse();
    let level = level.map_err(|problem: String| file.fault(&side.path, problem))?;
    let mut members = Vec::new();
    for (at, kind) in side.types.iter().enumerate() {
        for &storeys in &side.storeys {
            let class = types
                .of(kind, storeys, level)
                .map_err(|problem| file.fault(&format!("{}.types[{at}]", side.path), problem))?;
            let member = Member {
                kind: kind.clone(),
                class,
                storeys,
            };
            // Two names may lead to one class.
            if !members
                .iter()
                .any(|candidate: &Member| candidate.name() == member.name())
            {
                members.push(member);
            }
        }
    }
    Ok(members)
}

impl Member {
    /// Such as `C1M-low-5`.
    pub(crate) fn name(&self) -> String {
        let (class, level) = (&self.class.name, self.class.level.name());
        format!("{class}-{level}-{}", self.storeys)
    }

    /// First period \[s\].
    pub(crate) fn period(&self) -> f64 {
        let class = &self.class;
        let coefficients = class.capacity.coefficients(
            class.typical_storeys,
            class.pinching,
            class.unloading_exponent,
            class.damping,
        );
        coefficients.period_per_storey * self.storeys as f64
    }

    /// Whether the type is meant for that many storeys.
    pub(crate) fn is_usual(&self) -> bool {
        self.class.storeys.contains(&self.storeys)
    }

    /// The building of a draw; `place` tells equal buildings of one row apart.
    fn building(&self, area: f64, scatter: [f64; 3], place: u8, draw: u64) -> Building {
        let mut building = self.class.building(self.storeys, area);
        let id = hash(&self.name()) ^ u64::from(place);
        let [stiffness, strength, damping] = ["stiffness", "strength", "damping"].map(|what| {
            let of = match what {
                "stiffness" => scatter[0],
                "strength" => scatter[1],
                _ => scatter[2],
            };
            lognormal(id, draw, what, of)
        });
        for storey in &mut building.storeys {
            storey.stiffness *= stiffness;
            // Corners are forces over stiffness.
            storey.first_corner *= strength / stiffness;
            storey.second_corner *= strength / stiffness;
        }
        // Frequencies grow with the root of the stiffness: α = 2ζω₁ω₃/(ω₁+ω₃), β = 2ζ/(ω₁+ω₃).
        building.alpha *= damping * stiffness.sqrt();
        building.beta *= damping / stiffness.sqrt();
        building
    }
}

/// FNV-1a: the same for a name on every machine.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |state, byte| {
        (state ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

impl Pair {
    /// Such as `C1M-low-5 | URML-pre-2 half-storey middle`.
    pub(crate) fn name(&self) -> String {
        let mut text = format!("{} | {}", self.own.name(), self.neighbour.name());
        for (holds, word) in [(self.half_up, " half-storey"), (self.middle, " middle")] {
            if holds {
                text.push_str(word);
            }
        }
        text
    }

    /// Which building of a row is the class.
    pub(crate) fn own_place(&self) -> usize {
        usize::from(self.middle)
    }

    /// The row of a draw.
    pub(crate) fn row(&self, file: &ClassesFile, draw: Draw) -> Row {
        let (area, scatter, number) = (file.area, file.scatter, draw.number);
        let building = self.own.building(area, scatter, 0, number);
        let beside = |place| self.neighbour.building(area, scatter, place, number);
        let up = if self.half_up {
            0.5 * self.neighbour.class.storey_height
        } else {
            0.0
        };
        let name = hash(&self.name());
        let width = draw.gap.unwrap_or(0.0);
        let law = draw.gap.map(|_| Law::HertzDamp {
            stiffness: file.contact_stiffness
                * lognormal(name, number, "contact", file.contact_scatter),
            restitution: file.restitution,
        });
        let right = beside(1);
        let mut gaps = vec![Gap::between(&building, &right, width, law, up)];
        let mut buildings = vec![building, right];
        if self.middle {
            let left = beside(2);
            gaps.insert(0, Gap::between(&left, &buildings[0], width, law, -up));
            buildings.insert(0, left);
        }
        Row {
            buildings,
            gaps,
            motion: draw.motion,
            scale: draw.scale,
        }
    }
}
