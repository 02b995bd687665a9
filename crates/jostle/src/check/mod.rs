//! Collects all faults of a model at once.

mod fibres;
mod floor_loads;
mod frame_places;
mod frame_walls;
mod given;
mod isolation;
mod members;
mod neighbours;
mod plan;
mod plan_frames;
mod soil;
mod space_frame;

use floor_loads::check_floor_loads;
use members::check_members;
use neighbours::check_neighbours;

use crate::model::{
    Base, Building, Damping, Diagonal, Frame, FrameHinges, Hinges, Model, ModelFault, Shear,
    ShearSpring, Structure, Sway, WALL,
};

/// Collects faults under the path of the part being checked.
pub(crate) struct Faults(Vec<ModelFault>);

impl Faults {
    pub(crate) fn add(&mut self, path: impl Into<String>, problem: impl Into<String>) {
        self.0.push(ModelFault {
            path: path.into(),
            problem: problem.into(),
        });
    }

    pub(crate) fn require(
        &mut self,
        good: bool,
        path: impl Into<String>,
        problem: impl FnOnce() -> String,
    ) {
        if !good {
            self.add(path, problem());
        }
    }

    pub(crate) fn positive(&mut self, value: f64, path: impl Into<String>, unit: &str) {
        self.require(value.is_finite() && value > 0.0, path, || {
            format!("must be greater than zero, found {value} {unit}")
        });
    }

    pub(crate) fn not_negative(&mut self, value: f64, path: impl Into<String>, unit: &str) {
        self.require(value.is_finite() && value >= 0.0, path, || {
            format!("must not be negative, found {value} {unit}")
        });
    }
}

/// The entries of a list with their paths, `path[0]`, `path[1]`, ….
pub(crate) fn each<'a, T>(
    list: &'a [T],
    path: &'a str,
) -> impl Iterator<Item = (String, &'a T)> + 'a {
    list.iter()
        .enumerate()
        .map(move |(i, value)| (format!("{path}[{i}]"), value))
}

impl Model {
    /// Checks every value and the geometry; returns all faults.
    ///
    /// # Errors
    /// The list of faults, in the order of the fields, never empty.
    pub fn check(&self) -> Result<(), Vec<ModelFault>> {
        check(self)
    }
}

fn check(model: &Model) -> Result<(), Vec<ModelFault>> {
    let mut faults = Faults(Vec::new());
    faults.require(!model.buildings.is_empty(), "building", || {
        "a model needs at least one building".into()
    });
    for (path, building) in each(&model.buildings, "building") {
        check_building(&mut faults, &path, building);
        let namesake = model
            .buildings
            .iter()
            .filter(|other| other.name == building.name)
            .count()
            > 1;
        faults.require(!namesake, format!("{path}.name"), || {
            format!(
                "another building is called \"{}\" too; give every building its own name",
                building.name
            )
        });
    }
    isolation::check_walls(&mut faults, model);
    plan::check_space(&mut faults, model);
    check_neighbours(&mut faults, model);
    soil::check_soil(&mut faults, model);
    check_analysis(&mut faults, model);
    check_members(&mut faults, model);
    if faults.0.is_empty() {
        Ok(())
    } else {
        Err(faults.0)
    }
}

fn check_building(faults: &mut Faults, path: &str, building: &Building) {
    faults.require(
        !building.name.trim().is_empty(),
        format!("{path}.name"),
        || "must not be empty".into(),
    );
    faults.require(building.name != WALL, format!("{path}.name"), || {
        format!(
            "\"{WALL}\" stands for a rigid wall in gaps and links; give the building another name"
        )
    });
    for (field, height) in each(building.storey_heights(), &format!("{path}.storey_height")) {
        faults.positive(*height, field, "m");
    }
    match &building.structure {
        Structure::Frame(frame) => check_frame(faults, path, frame),
        Structure::Shear(shear) => check_shear(faults, path, shear),
        Structure::Given(given) => given::check_given(faults, path, given, building),
        Structure::Tiers(tiers) => plan::check_tiers(faults, path, tiers, building),
    }
    let in_plan = matches!(building.structure, Structure::Tiers(_));
    check_base(
        faults,
        &format!("{path}.base"),
        &building.base,
        [
            in_plan || matches!(building.structure, Structure::Frame(_)),
            in_plan,
        ],
    );
    isolation::check_isolation(faults, path, building);
    soil::check_foundation(faults, path, building);
    soil::check_uplift(faults, path, building);
    if let Some(hinges) = &building.hinges {
        check_hinges(
            faults,
            &format!("{path}.hinges"),
            hinges,
            &building.structure,
        );
        if matches!(hinges, Hinges::Frame(hinges) if !hinges.fibres.is_empty()) {
            fibres::check_weight(faults, &format!("{path}.hinges"), building);
        }
    }
    let of_plan = format!("{path}.frame");
    let frames: Vec<(String, &Frame)> = match &building.structure {
        Structure::Frame(frame) => vec![(path.to_owned(), frame)],
        Structure::Tiers(tiers) => {
            let frames: Vec<_> = each(&tiers.frames, &of_plan).collect();
            for (field, own) in &frames {
                if !own.hinges.fibres.is_empty() {
                    fibres::check_weight(faults, &format!("{field}.hinges"), building);
                }
            }
            let frames = frames.into_iter();
            frames.map(|(field, own)| (field, &own.frame)).collect()
        }
        _ => Vec::new(),
    };
    for (path, frame) in frames {
        for (field, wall) in each(&frame.walls, &format!("{path}.wall")) {
            if !wall.fibres.is_empty() {
                fibres::check_weight(faults, &format!("{field}.hinge"), building);
            }
        }
    }
    match &building.damping {
        Damping::Ratio { ratio, modes, sway } => {
            let field = format!("{path}.damping");
            faults.require((0.0..1.0).contains(ratio), format!("{field}.ratio"), || {
                format!("must lie between 0 and 1 (0.05 is 5 % of critical), found {ratio}")
            });
            let usable = modes.is_empty()
                || matches!(modes[..], [a] if a >= 1)
                || matches!(modes[..], [a, b] if a >= 1 && b > a);
            faults.require(usable, format!("{field}.modes"), || {
                format!("takes one lateral mode, or two different ones in rising order, counted from 1; found {modes:?}")
            });
            let has_plan = matches!(building.structure, Structure::Tiers(_));
            faults.require(
                *sway == Sway::Along || has_plan,
                format!("{field}.along"),
                || "is for buildings with a plan; leave it out".into(),
            );
        }
        Damping::AllModes { ratio } => {
            faults.require(
                (0.0..1.0).contains(ratio),
                format!("{path}.damping.ratio"),
                || format!("must lie between 0 and 1 (0.05 is 5 % of critical), found {ratio}"),
            );
        }
        Damping::Rayleigh { alpha, beta } => {
            faults.not_negative(*alpha, format!("{path}.damping.alpha"), "1/s");
            faults.not_negative(*beta, format!("{path}.damping.beta"), "s");
        }
    }
}

fn check_base(faults: &mut Faults, path: &str, base: &Base, [turns, in_plan]: [bool; 2]) {
    let directions = [
        (
            "horizontal",
            base.horizontal_stiffness,
            base.horizontal_damping,
            base.horizontal_hinge,
            ["N/m", "N.s/m"],
        ),
        (
            "vertical",
            base.vertical_stiffness,
            base.vertical_damping,
            None,
            ["N/m", "N.s/m"],
        ),
        (
            "torsional",
            base.torsional_stiffness,
            base.torsional_damping,
            None,
            ["N.m/rad", "N.m.s/rad"],
        ),
        (
            "rotational",
            base.rotational_stiffness,
            base.rotational_damping,
            base.rotational_hinge,
            ["N.m/rad", "N.m.s/rad"],
        ),
    ];
    for (name, stiffness, damping, hinge, [stiffness_unit, damping_unit]) in directions {
        if let Some(stiffness) = stiffness {
            faults.positive(
                stiffness,
                format!("{path}.{name}_stiffness"),
                stiffness_unit,
            );
        }
        faults.not_negative(damping, format!("{path}.{name}_damping"), damping_unit);
        faults.require(
            stiffness.is_some() || damping == 0.0,
            format!("{path}.{name}_damping"),
            || format!("has nothing to do where the base is rigid; add {name}_stiffness"),
        );
        if let Some(hinge) = hinge {
            let initial = hinge.backbone().initial();
            faults.require(
                stiffness == Some(initial),
                format!("{path}.{name}_hinge"),
                || {
                    format!(
                        "starts with {initial} {stiffness_unit}, which must be {name}_stiffness"
                    )
                },
            );
        }
        faults.require(
            turns || name == "horizontal" || name == "torsional" || stiffness.is_none(),
            format!("{path}.{name}_stiffness"),
            || "is for frames only: the floors of a shear building neither rise nor turn".into(),
        );
    }
    for (key, given) in [
        ("torsional_stiffness", base.torsional_stiffness.is_some()),
        ("across", base.across.is_some()),
    ] {
        faults.require(in_plan || !given, format!("{path}.{key}"), || {
            "is for buildings with a plan; add plan, or leave it out".into()
        });
    }
    faults.not_negative(base.mass, format!("{path}.mass"), "kg");
    faults.require(
        base.mass == 0.0 || !base.is_fixed(),
        format!("{path}.mass"),
        || "does not move on a fixed base; add a stiffness, or leave it out".into(),
    );
}

/// Hinges are valid by themselves; this function compares them with their structure.
fn check_hinges(faults: &mut Faults, path: &str, hinges: &Hinges, structure: &Structure) {
    match (hinges, structure) {
        (Hinges::Frame(hinges), Structure::Frame(frame)) => {
            check_frame_hinges(faults, path, hinges, frame);
        }
        (Hinges::Storeys(springs), Structure::Shear(shear)) => {
            let storeys = shear.stiffness.len();
            faults.require(springs.len() == storeys, path, || {
                format!("has {} springs for {storeys} storeys", springs.len())
            });
            for (spring, stiffness) in springs.iter().zip(&shear.stiffness) {
                let initial = spring.backbone().initial();
                let same = (initial - stiffness).abs() <= 1e-9 * stiffness;
                faults.require(same, path, || {
                    format!("starts with {initial} N/m in a storey of {stiffness} N/m; they must be equal")
                });
            }
        }
        _ => faults.add(path, "are those of another kind of building"),
    }
}

fn check_frame_hinges(faults: &mut Faults, path: &str, hinges: &FrameHinges, frame: &Frame) {
    let storeys = frame.storey_heights.len();
    let fits = |rows: &[Vec<ShearSpring>]| {
        rows.len() == storeys && rows.iter().all(|row| row.len() == frame.spans.len() + 1)
    };
    faults.require(
        hinges.shear.is_empty() || fits(&hinges.shear),
        format!("{path}.shear"),
        || {
            format!(
                "needs {} shear springs in each of {storeys} storeys, or none at all",
                frame.spans.len() + 1
            )
        },
    );
    let mut shear = hinges.shear.iter().flatten();
    faults.require(
        shear.all(|column| column.spring.falling_branch().is_some()),
        format!("{path}.shear"),
        || "takes springs that lose their strength, from Hysteresis::failing".into(),
    );
    for ([storey, line], column_fibres) in &hinges.fibres {
        let path = format!("{path}.fibres");
        faults.require(frame.column(*storey, *line).is_some(), &path, || {
            format!(
                "stand where there is no column: storey {}, line {}",
                storey + 1,
                line + 1
            )
        });
        fibres::check_fibres(faults, &path, column_fibres, false);
    }
    faults.require(
        hinges.fibres.is_empty() || frame.axial.columns_flexible,
        format!("{path}.fibres"),
        || {
            "need columns that change their length: without it their axial force is not known"
                .into()
        },
    );
    let members = [
        ("column", &hinges.columns, frame.spans.len() + 1),
        ("beam", &hinges.beams, frame.spans.len()),
    ];
    for (name, hinges, per_storey) in members {
        let fits = hinges.len() == storeys && hinges.iter().all(|row| row.len() == per_storey);
        faults.require(hinges.is_empty() || fits, format!("{path}.{name}"), || {
            format!("needs {per_storey} hinges in each of {storeys} storeys, or none at all")
        });
    }
}

fn check_frame(faults: &mut Faults, path: &str, frame: &Frame) {
    check_members_of(faults, path, frame);
    let storeys = frame.storey_heights.len();
    let floors_have_mass = (0..storeys).all(|floor| {
        let here = [frame.beam_mass.get(floor), frame.floor_mass.get(floor)];
        // Beams need a second joint.
        let on_beams = here[0].filter(|_| frame.beam_length(floor) > 0.0);
        let places = (0..frame.lines()).flat_map(|line| [[floor, line], [floor + 1, line]]);
        let columns = places.filter_map(|[storey, line]| frame.column(storey, line));
        let mut masses = [on_beams, here[1]].into_iter().flatten().copied();
        masses.any(|mass| mass > 0.0) || columns.into_iter().any(|column| column.line_mass > 0.0)
    });
    faults.require(floors_have_mass, format!("{path}.floor_mass"), || {
        "every floor needs some mass: set beam_mass, floor_mass or a column density".into()
    });
}

/// Members and masses of a frame, each by itself.
fn check_members_of(faults: &mut Faults, path: &str, frame: &Frame) {
    let storeys = frame.storey_heights.len();
    faults.require(storeys >= 1, format!("{path}.storeys"), || {
        "a frame needs at least one storey".into()
    });
    for (field, span) in each(&frame.spans, &format!("{path}.spans")) {
        faults.positive(*span, field, "m");
    }
    check_floor_loads(faults, path, &frame.floor_load, storeys, |floor| {
        let line = frame.beam_mass.get(floor).copied().unwrap_or(0.0);
        let mass = frame.floor_mass.get(floor).copied().unwrap_or(0.0);
        line * frame.beam_length(floor) + mass
    });
    let per_storey = [
        ("column", frame.columns.len()),
        ("beam", frame.beams.len()),
        ("beam_mass", frame.beam_mass.len()),
        ("floor_mass", frame.floor_mass.len()),
    ];
    for (name, count) in per_storey {
        faults.require(count == storeys, format!("{path}.{name}"), || {
            format!("has {count} entries for {storeys} storeys; give one value, or one per storey from the ground up")
        });
    }
    for (name, sections, overrides, flexible) in [
        (
            "column",
            &frame.columns,
            &frame.own_columns,
            frame.axial.columns_flexible,
        ),
        (
            "beam",
            &frame.beams,
            &frame.own_beams,
            frame.axial.beams_flexible,
        ),
    ] {
        let single_sections = overrides.iter().filter_map(|([storey, place], section)| {
            let field = format!("{path}.{name}[{storey}][{place}]");
            Some((field, section.as_ref()?))
        });
        for (field, section) in each(sections, &format!("{path}.{name}")).chain(single_sections) {
            faults.positive(section.flexural_rigidity, format!("{field}.EI"), "N.m2");
            faults.not_negative(section.line_mass, format!("{field}.mass"), "kg/m");
            match section.axial_rigidity {
                Some(rigidity) => faults.positive(rigidity, format!("{field}.EA"), "N"),
                None if flexible => {
                    faults.add(format!("{field}.EA"), "is needed because the member is axially flexible; add EA, or width and depth");
                }
                None => {}
            }
            if let Some(rigidity) = section.shear_rigidity {
                faults.positive(rigidity, format!("{field}.GA"), "N");
            }
        }
    }
    let complete = per_storey.iter().all(|(_, count)| *count == storeys);
    if complete && storeys > 0 && !frame.is_regular() {
        frame_places::check_places(faults, path, frame);
    }
    if complete {
        frame_walls::check_walls(faults, path, frame);
    }
    for (field, mass) in each(&frame.beam_mass, &format!("{path}.beam_mass")) {
        faults.not_negative(*mass, field, "kg/m");
    }
    for (field, mass) in each(&frame.floor_mass, &format!("{path}.floor_mass")) {
        faults.not_negative(*mass, field, "kg");
    }
    faults.require(
        (1..=64).contains(&frame.column_segments),
        format!("{path}.column_segments"),
        || format!("must lie between 1 and 64, found {}", frame.column_segments),
    );
    faults.require(
        frame.beam_segments.len() == frame.spans.len(),
        format!("{path}.beam_segments"),
        || {
            format!(
                "has {} entries for {} spans; give one value, or one per span",
                frame.beam_segments.len(),
                frame.spans.len()
            )
        },
    );
    for (field, segments) in each(&frame.beam_segments, &format!("{path}.beam_segments")) {
        faults.require((1..=64).contains(segments), field, || {
            format!("must lie between 1 and 64, found {segments}")
        });
    }
    check_diagonals(faults, path, &frame.diagonals, |diagonal| {
        frame_places::fault_of_diagonal(frame, diagonal.place)
            .or_else(|| frame_places::fault_of_offsets(frame, diagonal))
    });
    for (name, stiffness, unit) in [
        ("rotational", frame.joint.rotational_stiffness, "N.m/rad"),
        ("horizontal", frame.joint.horizontal_stiffness, "N/m"),
        ("vertical", frame.joint.vertical_stiffness, "N/m"),
    ] {
        if let Some(stiffness) = stiffness {
            faults.positive(stiffness, format!("{path}.joint.{name}_stiffness"), unit);
        }
    }
}

/// Braces and struts. `fault_of`: what is wrong with where one stands.
fn check_diagonals(
    faults: &mut Faults,
    path: &str,
    diagonals: &[Diagonal],
    fault_of: impl Fn(&Diagonal) -> Option<String>,
) {
    for (index, diagonal) in diagonals.iter().enumerate() {
        let (place, field) = (
            diagonal.place,
            format!("{path}.{}", diagonal.place.kind.name()),
        );
        if let Some(fault) = fault_of(diagonal) {
            let field = match diagonal.offsets == [0.0; 2] {
                true => field.clone(),
                false => format!("{field}.offset"),
            };
            faults.add(field, fault);
        }
        let before = &diagonals[..index];
        let is_first = before.iter().all(|other| other.place != place);
        faults.require(is_first, field.as_str(), || {
            format!("there are two of {place}; give one with the stiffness of both")
        });
        if let Some(damage) = diagonal.damage {
            let rises = damage.drifts.windows(2).all(|pair| pair[0] < pair[1]);
            let sound = rises && damage.drifts[0] > 0.0 && damage.drifts[3].is_finite();
            let drifts = format!("{field}.damage_drifts");
            faults.require(sound, drifts.as_str(), || {
                format!("must be greater than 0 and rise, found {:?}", damage.drifts)
            });
            faults.positive(damage.drift_per_shortening, drifts, "1/m");
        }
        if let Some(across) = diagonal.across {
            faults.positive(
                across.strength,
                format!("{field}.out_of_plane.strength"),
                "Pa",
            );
            faults.positive(
                across.surface_mass,
                format!("{field}.out_of_plane.density"),
                "kg/m2",
            );
        }
        faults.positive(diagonal.stiffness, field, "N/m");
    }
}

fn check_shear(faults: &mut Faults, path: &str, shear: &Shear) {
    let floors = shear.mass.len();
    faults.require(floors >= 1, format!("{path}.mass"), || {
        "a shear building needs at least one floor".into()
    });
    for (name, count) in [
        ("stiffness", shear.stiffness.len()),
        ("storey_height", shear.storey_heights.len()),
    ] {
        faults.require(count == floors, format!("{path}.{name}"), || {
            format!("has {count} entries for {floors} floors; give one value, or one per storey from the ground up")
        });
    }
    for (field, mass) in each(&shear.mass, &format!("{path}.mass")) {
        faults.positive(*mass, field, "kg");
    }
    for (field, stiffness) in each(&shear.stiffness, &format!("{path}.stiffness")) {
        faults.positive(*stiffness, field, "N/m");
    }
}

fn check_analysis(faults: &mut Faults, model: &Model) {
    let analysis = &model.analysis;
    for (name, step) in [
        ("step", analysis.step),
        ("contact_step", analysis.contact_step),
    ] {
        if let Some(step) = step {
            faults.require(step.is_finite() && (1e-7..=0.1).contains(&step), format!("analysis.{name}"), || {
                format!("must lie between 1e-7 s and 0.1 s, found {step} s; \"auto\" chooses it from the tolerance")
            });
        }
    }
    if let (Some(step), Some(contact_step)) = (analysis.step, analysis.contact_step) {
        faults.require(contact_step <= step, "analysis.contact_step", || {
            format!("must not exceed step, found {contact_step} s for a step of {step} s")
        });
    }
    let integrator = analysis.integrator;
    let stable = integrator.gamma >= 0.5 && 2.0 * integrator.beta >= integrator.gamma - 1e-12;
    faults.require(stable, "analysis.integrator", || {
        format!(
            "is unstable for stiff parts of the structure: gamma must be at least 0.5 and beta at least gamma/2, found gamma = {} and beta = {}",
            integrator.gamma, integrator.beta
        )
    });
    let drift = analysis.collapse_drift;
    faults.require(
        drift > 0.0 && drift <= 1.0,
        "analysis.collapse_drift",
        || format!("must lie above 0 and be at most 1, found {drift}"),
    );
    for (name, value, range) in [
        ("tolerance", analysis.tolerance, 1e-6..=0.1),
        ("energy_tolerance", analysis.energy_tolerance, 1e-15..=1.0),
    ] {
        faults.require(range.contains(&value), format!("analysis.{name}"), || {
            format!(
                "must lie between {:e} and {}, found {value:e}",
                range.start(),
                range.end()
            )
        });
    }
}
