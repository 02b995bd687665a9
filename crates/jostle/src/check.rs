//! Every fault of a model, in one go.

use crate::contact::{ContactLaw, LawKind};
use crate::model::{
    Base, Building, Damping, FloorPairs, Frame, Gap, Hinges, Model, ModelFault, Shear, Structure,
};

/// Floors closer in height than this can touch \[m\].
pub(crate) const LEVEL_TOLERANCE: f64 = 1e-3;

/// Collects faults under the path of the part being checked.
struct Faults(Vec<ModelFault>);

impl Faults {
    fn add(&mut self, path: impl Into<String>, problem: impl Into<String>) {
        self.0.push(ModelFault {
            path: path.into(),
            problem: problem.into(),
        });
    }

    fn require(&mut self, good: bool, path: impl Into<String>, problem: impl FnOnce() -> String) {
        if !good {
            self.add(path, problem());
        }
    }

    fn positive(&mut self, value: f64, path: impl Into<String>, unit: &str) {
        self.require(value.is_finite() && value > 0.0, path, || {
            format!("must be greater than zero, found {value} {unit}")
        });
    }

    fn not_negative(&mut self, value: f64, path: impl Into<String>, unit: &str) {
        self.require(value.is_finite() && value >= 0.0, path, || {
            format!("must not be negative, found {value} {unit}")
        });
    }
}

/// The entries of a list with their paths, `path[0]`, `path[1]`, ….
fn each<'a, T>(list: &'a [T], path: &'a str) -> impl Iterator<Item = (String, &'a T)> + 'a {
    list.iter()
        .enumerate()
        .map(move |(i, value)| (format!("{path}[{i}]"), value))
}

pub(crate) fn check(model: &Model) -> Result<(), Vec<ModelFault>> {
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
    for (path, gap) in each(&model.gaps, "gap") {
        check_gap(&mut faults, &path, gap, model);
        faults.require(
            model
                .gaps
                .iter()
                .filter(|other| other.left == gap.left)
                .count()
                == 1,
            format!("{path}.between"),
            || "these two neighbours have more than one gap; keep one".into(),
        );
    }
    check_analysis(&mut faults, model);
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
    for (field, height) in each(building.storey_heights(), &format!("{path}.storey_height")) {
        faults.positive(*height, field, "m");
    }
    match &building.structure {
        Structure::Frame(frame) => check_frame(faults, path, frame),
        Structure::Shear(shear) => check_shear(faults, path, shear),
    }
    check_base(
        faults,
        &format!("{path}.base"),
        &building.base,
        matches!(building.structure, Structure::Shear(_)),
    );
    if let Some(hinges) = &building.hinges {
        check_hinges(
            faults,
            &format!("{path}.hinges"),
            hinges,
            &building.structure,
        );
    }
    match &building.damping {
        Damping::Ratio { ratio, modes } => {
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
        }
        Damping::Rayleigh { alpha, beta } => {
            faults.not_negative(*alpha, format!("{path}.damping.alpha"), "1/s");
            faults.not_negative(*beta, format!("{path}.damping.beta"), "s");
        }
    }
}

fn check_base(faults: &mut Faults, path: &str, base: &Base, is_shear: bool) {
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
            !is_shear || name == "horizontal" || stiffness.is_none(),
            format!("{path}.{name}_stiffness"),
            || "is for frames only: the floors of a shear building neither rise nor turn".into(),
        );
    }
    faults.not_negative(base.mass, format!("{path}.mass"), "kg");
    faults.require(
        base.mass == 0.0 || !base.is_fixed(),
        format!("{path}.mass"),
        || "does not move on a fixed base; add a stiffness, or leave it out".into(),
    );
}

/// Hinges are sound by themselves; here they are held against the structure that they belong to.
fn check_hinges(faults: &mut Faults, path: &str, hinges: &Hinges, structure: &Structure) {
    match (hinges, structure) {
        (Hinges::Frame(hinges), Structure::Frame(frame)) => {
            let storeys = frame.storey_heights.len();
            let members = [
                ("column", &hinges.columns, frame.spans.len() + 1),
                ("beam", &hinges.beams, frame.spans.len()),
            ];
            for (name, hinges, abreast) in members {
                let fits = hinges.len() == storeys && hinges.iter().all(|row| row.len() == abreast);
                faults.require(hinges.is_empty() || fits, format!("{path}.{name}"), || {
                    format!("needs {abreast} hinges in each of {storeys} storeys, or none at all")
                });
            }
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

fn check_frame(faults: &mut Faults, path: &str, frame: &Frame) {
    let storeys = frame.storey_heights.len();
    faults.require(storeys >= 1, format!("{path}.storeys"), || {
        "a frame needs at least one storey".into()
    });
    faults.require(!frame.spans.is_empty(), format!("{path}.spans"), || {
        "a frame needs at least one span".into()
    });
    for (field, span) in each(&frame.spans, &format!("{path}.spans")) {
        faults.positive(*span, field, "m");
    }
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
    for (name, sections, flexible) in [
        ("column", &frame.columns, frame.axial.columns_flexible),
        ("beam", &frame.beams, frame.axial.beams_flexible),
    ] {
        for (field, section) in each(sections, &format!("{path}.{name}")) {
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
    for (field, mass) in each(&frame.beam_mass, &format!("{path}.beam_mass")) {
        faults.not_negative(*mass, field, "kg/m");
    }
    for (field, mass) in each(&frame.floor_mass, &format!("{path}.floor_mass")) {
        faults.not_negative(*mass, field, "kg");
    }
    let floors_have_mass = (0..storeys).all(|floor| {
        let above = frame
            .columns
            .get(floor + 1)
            .map_or(0.0, |section| section.line_mass);
        let here = [frame.beam_mass.get(floor), frame.floor_mass.get(floor)];
        let column = frame
            .columns
            .get(floor)
            .map_or(0.0, |section| section.line_mass);
        here.into_iter().flatten().sum::<f64>() + above + column > 0.0
    });
    faults.require(floors_have_mass, format!("{path}.floor_mass"), || {
        "every floor needs some mass: set beam_mass, floor_mass or a column density".into()
    });
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

fn check_gap(faults: &mut Faults, path: &str, gap: &Gap, model: &Model) {
    faults.require(
        gap.width.is_finite() && gap.width >= 0.0,
        format!("{path}.width"),
        || {
            format!(
                "must not be negative, found {} m; touching buildings have a gap of zero",
                gap.width
            )
        },
    );
    let separation = gap.minimum_separation;
    faults.require(
        separation.is_finite() && separation >= 0.0,
        format!("{path}.minimum_separation"),
        || format!("must not be negative, found {separation} s"),
    );
    let (Some(left), Some(right)) = (
        model.buildings.get(gap.left),
        model.buildings.get(gap.left + 1),
    ) else {
        faults.add(
            format!("{path}.between"),
            "must name two neighbouring buildings",
        );
        return;
    };
    faults.positive(
        gap.law.stiffness,
        format!("{path}.stiffness"),
        if gap.law.kind.is_hertzian() {
            "N/m^1.5"
        } else {
            "N/m"
        },
    );
    let e = gap.law.restitution;
    if gap.law.kind.is_dissipative() {
        faults.require(e > 0.0 && e <= 1.0, format!("{path}.restitution"), || {
            format!("must be greater than 0 and at most 1, found {e}")
        });
        let least = gap.law.least_restitution();
        faults.require(e > least, format!("{path}.restitution"), || {
            format!(
                "cannot be realised by {} below {least:.4}; use hertz-damp, or a larger value",
                gap.law.kind.name()
            )
        });
    }
    check_shape(faults, path, &gap.law);
    check_floors(faults, &format!("{path}.floors"), gap, left, right);
}

/// What only some laws have.
fn check_shape(faults: &mut Faults, path: &str, law: &ContactLaw) {
    match law.kind {
        LawKind::Bilinear(shape) => {
            let a = shape.yield_share;
            faults.require(a > 0.0 && a < 0.5, format!("{path}.yield_share"), || {
                format!("must lie between 0 and 0.5, found {a}")
            });
            if let Some(speed) = shape.design_speed {
                faults.positive(speed, format!("{path}.design_speed"), "m/s");
            }
        }
        LawKind::Rubber(bumper) => {
            faults.positive(bumper.thickness, format!("{path}.thickness"), "m");
            let n = bumper.exponent;
            faults.require((1.0..=6.0).contains(&n), format!("{path}.exponent"), || {
                format!("must lie between 1 and 6, found {n}")
            });
        }
        _ => {}
    }
}

fn check_floors(faults: &mut Faults, path: &str, gap: &Gap, left: &Building, right: &Building) {
    let (left_heights, right_heights) = (left.floor_heights(), right.floor_heights());
    let level = |height: f64, heights: &[f64]| {
        heights
            .iter()
            .any(|h| (h - height).abs() <= LEVEL_TOLERANCE)
    };
    match &gap.floors {
        FloorPairs::Common => {
            let any = left_heights
                .iter()
                .any(|height| level(*height, &right_heights));
            faults.require(any, path, || {
                format!(
                    "no floors of \"{}\" and \"{}\" lie at equal height; list the pairs that can touch, as floors = [[1, 1]], or the heights",
                    left.name, right.name
                )
            });
        }
        FloorPairs::Listed(pairs) => {
            faults.require(!pairs.is_empty(), path, || {
                "is empty; list the pairs that can touch, as [[5, 5], [4, 4]]".into()
            });
            for (i, (l, r)) in pairs.iter().enumerate() {
                for (building, heights, floor) in
                    [(left, &left_heights, *l), (right, &right_heights, *r)]
                {
                    faults.require(
                        (1..=heights.len()).contains(&floor),
                        format!("{path}[{i}]"),
                        || {
                            format!(
                                "floor {floor} does not exist: \"{}\" has floors 1 to {}",
                                building.name,
                                heights.len()
                            )
                        },
                    );
                }
                if let (Some(a), Some(b)) = (
                    left_heights.get(l.wrapping_sub(1)),
                    right_heights.get(r.wrapping_sub(1)),
                ) {
                    faults.require((a - b).abs() <= LEVEL_TOLERANCE, format!("{path}[{i}]"), || {
                        format!("floor {l} of \"{}\" is at {a:.3} m and floor {r} of \"{}\" at {b:.3} m; only floors at equal height can touch", left.name, right.name)
                    });
                }
                faults.require(
                    !pairs[..i].contains(&(*l, *r)),
                    format!("{path}[{i}]"),
                    || format!("the pair [{l}, {r}] is listed twice"),
                );
            }
        }
        FloorPairs::Heights(heights) => {
            faults.require(!heights.is_empty(), path, || {
                "is empty; list the heights where the buildings can touch".into()
            });
            for (i, height) in heights.iter().enumerate() {
                for building in [left, right] {
                    let points = building.contact_heights();
                    faults.require(level(*height, &points), format!("{path}[{i}]"), || {
                        let nearest = points.iter().copied().min_by(|a, b| (a - height).abs().total_cmp(&(b - height).abs()));
                        format!(
                            "\"{}\" has no floor or lumped mass at {height:.3} m (nearest: {:.3} m); move the contact, or change column_segments",
                            building.name,
                            nearest.unwrap_or(0.0)
                        )
                    });
                }
            }
        }
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

impl Building {
    /// Heights of the points of a face that can touch a neighbour: floors, and lumped masses of columns \[m\].
    #[must_use]
    pub fn contact_heights(&self) -> Vec<f64> {
        let segments = match &self.structure {
            Structure::Frame(frame) => frame.column_segments.max(1),
            Structure::Shear(_) => 1,
        };
        let mut base = 0.0;
        let mut heights = Vec::new();
        for storey in self.storey_heights() {
            heights.extend((1..=segments).map(|k| base + storey * k as f64 / segments as f64));
            base += storey;
        }
        heights
    }
}
