//! The model, the analysis and the energy balance of the run as text and small tables.

use jostle::contact::{ContactLaw, LawKind, RestitutionIs};
use jostle::model::{
    Building, Damping, FloorPairs, Frame, Gap, Level, Link, LinkLaw, Shear, Solver, Structure,
    usual_damping_modes,
};
use jostle::motion::Wave;
use jostle::results::summary::{BuildingSummary, FoundationSummary, GapSummary, LinkSummary};
use maud::{Markup, html};

use crate::damage::{self, Damage};
use crate::facts::{Facts, by_place, grouped};
use crate::message;
use crate::{Page, backbones, format, special};

/// Periods listed for each building.
const PERIODS: usize = 6;
/// Pairs of points listed for each gap or link.
const PAIRS: usize = 8;

fn list(facts: &Facts) -> Markup {
    html! { dl { @for (name, value) in facts { div { dt { (name) } dd { (value) } } } } }
}

/// The whole section.
pub(crate) fn model(page: &Page) -> Markup {
    html! {
        div.cards {
            @for (i, building) in page.model.buildings.iter().enumerate() {
                (self::building(page, i, building, page.summary.buildings.get(i)))
            }
            @for (summary, gap) in page.gaps() {
                div.card {
                    h3 { (message::gap_between(&summary.between[0], &summary.between[1])) }
                    (list(&contact(gap, summary)))
                }
            }
            @for (summary, described) in page.links() {
                div.card {
                    h3 { (message::links_between(&summary.between[0], &summary.between[1])) }
                    (list(&link(described, summary)))
                }
            }
            div.card { h3 { (message::ground_motion()) } (list(&motion(page))) }
            div.card { h3 { (message::analysis()) } (list(&analysis(page))) }
            div.card { h3 { (message::energy_at_the_end()) } (list(&energy(page))) }
        }
    }
}

fn building(
    page: &Page,
    index: usize,
    building: &Building,
    summary: Option<&BuildingSummary>,
) -> Markup {
    let heights = building.floor_heights();
    let storeys = building.storey_heights();
    let (floors, each) = (
        building.floors(),
        grouped(storeys, |h| format::plain(format::HEIGHT.of(h), 3)),
    );
    let top = format::plain(format::HEIGHT.of(heights.last().copied().unwrap_or(0.0)), 4);
    let high = match storeys.windows(2).all(|pair| pair[0] == pair[1]) {
        true => message::of_m_m_high(floors, each, top),
        false => message::in_all_m_high(floors, each, top),
    };
    let mut facts: Facts = vec![(message::storeys(), high)];
    let elevation = building.base.elevation;
    if elevation != 0.0 {
        let unit = format::HEIGHT;
        let text = format!("{} {}", format::plain(unit.of(elevation), 4), unit.name());
        facts.push((message::elevation_of_the_base(), text));
    }
    match &building.structure {
        Structure::Frame(frame) => frame_facts(frame, &mut facts),
        Structure::Shear(shear) => shear_facts(shear, &mut facts),
        Structure::Tiers(tiers) => tiers_facts(tiers, &mut facts),
        Structure::Given(given) => {
            let floors = given.floors.iter().map(|dof| given.mass[*dof]);
            let floors: Vec<f64> = floors.collect();
            facts.push((
                message::mass_at_the_floors(),
                grouped(&floors, format::tonnes),
            ));
            let size = given.len();
            facts.push((message::stiffness(), message::given_as_a_matrix(size)));
        }
    }
    let mut said = damping(building, summary);
    if building.base.foundation.is_some() {
        said += message::of_motion_relative();
    }
    if building.base.isolation.is_some() {
        said += message::of_building_on_its_mat();
    }
    facts.push((message::damping(), said));
    if let Some(summary) = summary {
        facts.push((message::vibrating_mass(), format::tonnes(summary.mass_kg)));
        // Under an isolated building it is the force of its bearings.
        let name = match summary.isolation {
            Some(_) => message::peak_force_of_bearings(),
            None => message::peak_base_shear(),
        };
        facts.push((name, format::force(summary.response.base_shear_peak_n)));
        facts.push((
            message::roof_displacement_at_the_end(),
            format::millimetres(summary.response.residual_roof_displacement_m),
        ));
        if let Some(footing) = &summary.foundation {
            facts.extend(foundation(footing));
        }
        let all = damage::damage(Some(building), summary);
        let all: Vec<String> = all.iter().map(Damage::sentence).collect();
        if !all.is_empty() {
            facts.push((message::damage_word(), all.join("; ")));
        }
    }
    if let Some(failures) = summary.and_then(|summary| summary.shear_failures.as_ref()) {
        facts.push((
            message::columns_that_failed_in_shear(),
            message::failed_of_all(failures.failed, failures.total),
        ));
    }
    facts.extend(special::facts(building));
    facts.extend(special::sections(page, index));
    html! {
        div.card {
            h3 { span.swatch style=(crate::document::colour(index)) {} (building.name) }
            (list(&facts))
            (backbones::curves(index, building))
            @if let Some(summary) = summary {
                @if !summary.periods_s.is_empty() {
                    table.periods {
                        thead { tr { th scope="col" { (message::lateral_mode()) } th.number scope="col" { (message::period_s()) } } }
                        tbody {
                            @for (i, period) in summary.periods_s.iter().take(PERIODS).enumerate() {
                                tr { td { (i + 1) } td.number { (format::fixed(*period, 4)) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn frame_facts(frame: &Frame, facts: &mut Facts) {
    let spans: Vec<String> = frame
        .spans
        .iter()
        .map(|span| format::plain(format::HEIGHT.of(*span), 3))
        .collect();
    if !spans.is_empty() {
        let unit = format::HEIGHT.name();
        facts.push((message::spans(), format!("{} {unit}", spans.join(" + "))));
    }
    let storeys = frame.storey_heights.len();
    let columns = |value: fn(&jostle::Section) -> f64| {
        move |storey: usize| {
            let all = (0..frame.lines()).map(|line| frame.column(storey, line).map(value));
            all.collect()
        }
    };
    let beams = |floor: usize| {
        let all = (0..frame.spans.len()).map(|bay| Some(frame.beam(floor, bay)?.flexural_rigidity));
        all.collect()
    };
    facts.push((
        message::columns_ei(),
        by_place(
            storeys,
            columns(|section| section.flexural_rigidity),
            format::rigidity,
        ),
    ));
    if !spans.is_empty() {
        facts.push((
            message::beams_ei(),
            by_place(storeys, beams, format::rigidity),
        ));
    }
    facts.push((
        message::line_mass(),
        message::columns_beams_kg_m(
            by_place(storeys, columns(|section| section.line_mass), |m| {
                format::plain(format::LINE_MASS.of(m), 4)
            }),
            grouped(&frame.beam_mass, |m| {
                format::plain(format::LINE_MASS.of(m), 4)
            }),
        ),
    ));
    if frame.floor_mass.iter().any(|mass| *mass > 0.0) {
        facts.push((
            message::floor_mass(),
            grouped(&frame.floor_mass, format::tonnes),
        ));
    }
    let segments: Vec<String> = frame.beam_segments.iter().map(usize::to_string).collect();
    facts.push((
        message::segments(),
        message::per_column_storey_per_span(frame.column_segments, segments.join(" + ")),
    ));
    let lengthwise = |flexible| {
        if flexible {
            message::flexible()
        } else {
            message::rigid()
        }
    };
    facts.push((
        message::axially(),
        message::columns_beams(
            lengthwise(frame.axial.columns_flexible),
            lengthwise(frame.axial.beams_flexible),
        ),
    ));
    facts.push((message::beam_ends(), special::joint(&frame.joint)));
}

fn shear_facts(shear: &Shear, facts: &mut Facts) {
    facts.push((message::floor_mass(), grouped(&shear.mass, format::tonnes)));
    facts.push((
        message::storey_stiffness(),
        grouped(&shear.stiffness, format::stiffness),
    ));
}

fn tiers_facts(tiers: &jostle::Tiers, facts: &mut Facts) {
    let masses: Vec<f64> = tiers.floors.iter().map(|floor| floor.mass).collect();
    facts.push((message::floor_mass(), grouped(&masses, format::tonnes)));
    if !tiers.frames.is_empty() {
        let frames = tiers.frames.iter().map(|frame| {
            let spans: Vec<String> = frame
                .frame
                .spans
                .iter()
                .map(|span| format::plain(format::HEIGHT.of(*span), 3))
                .collect();
            format!(
                "{} ({} {})",
                frame.name,
                spans.join(" + "),
                format::HEIGHT.name()
            )
        });
        facts.push((
            message::frames_spans(),
            frames.collect::<Vec<_>>().join(", "),
        ));
    }
    if let Some(frame) = &tiers.space_frame {
        let lines = |lines: &[f64]| -> String {
            let all = lines.iter();
            let all = all.map(|line| format::plain(format::HEIGHT.of(*line), 4));
            format!(
                "{} {}",
                all.collect::<Vec<_>>().join(", "),
                format::HEIGHT.name()
            )
        };
        facts.push((message::grid_lines_at_x(), lines(&frame.lines_x)));
        facts.push((message::grid_lines_at_y(), lines(&frame.lines_y)));
        let columns = frame.members.iter();
        let columns =
            columns.filter(|column| matches!(column.place, jostle::SpacePlace::Column { .. }));
        let columns = columns.count();
        let beams = frame.members.len() - columns;
        let storeys = frame.walls.iter();
        let storeys = storeys.map(|storey| storey.storeys[1] - storey.storeys[0] + 1);
        let columns = columns - storeys.sum::<usize>();
        let members = match frame.walls.len() {
            0 => message::columns_and_beams_count(columns, beams),
            walls => message::columns_beams_and_walls(columns, beams, walls),
        };
        facts.push((message::members_of_the_frame(), members));
    }
    if let Some(matrices) = &tiers.matrices {
        let size = matrices.stiffness.len();
        facts.push((message::stiffness(), message::given_as_a_matrix(size)));
    }
    // Before anything yields.
    let storeys = (0..tiers.floors.len()).filter_map(|storey| tiers.initial_storey(storey));
    let storeys: Vec<jostle::TierStorey> = storeys.collect();
    if storeys.is_empty() {
        return;
    }
    for (label, axis) in [
        (message::storey_stiffness_along_x(), 0),
        (message::storey_stiffness_across(), 1),
    ] {
        let values = storeys.iter().map(|storey| storey.stiffness[axis]);
        facts.push((
            label,
            grouped(&values.collect::<Vec<f64>>(), format::stiffness),
        ));
    }
    let torsion = storeys.iter().map(|storey| storey.stiffness[2]);
    let torsion: Vec<f64> = torsion.collect();
    let quantity = format::ROTATIONAL_STIFFNESS;
    let unit = |value: f64| format::unit(format::plain(quantity.of(value), 4), quantity.name());
    facts.push((message::torsional_stiffness(), grouped(&torsion, unit)));
}

fn damping(building: &Building, summary: Option<&BuildingSummary>) -> String {
    let rayleigh = summary.map(|s| (s.rayleigh_alpha_per_s, s.rayleigh_beta_s));
    let coefficients = |alpha: f64, beta: f64| {
        format!(
            "α = {}\u{a0}1/s, β = {}\u{a0}s",
            format::plain(alpha, 4),
            format::plain(beta, 4)
        )
    };
    match &building.damping {
        Damping::AllModes { ratio } => message::in_all_modes(format::plain(ratio * 100.0, 3)),
        Damping::Rayleigh { alpha, beta } => message::rayleigh_beta(coefficients(*alpha, *beta)),
        Damping::Ratio { ratio, modes, .. } => {
            // Above a soft storey modes of sway replace lateral ones that are missing.
            let known = summary.map_or(0, |summary| summary.periods_s.len());
            let modes = match &modes[..] {
                [] if building.base.isolation.is_some() => &[1],
                [] => usual_damping_modes(known.max(building.floors().min(2))),
                asked => asked,
            };
            let modes: Vec<String> = modes.iter().map(usize::to_string).collect();
            let used =
                rayleigh.map_or_else(String::new, |(a, b)| format!(" ({})", coefficients(a, b)));
            let ratio = format::plain(ratio * 100.0, 3);
            match &modes[..] {
                [only] => message::at_lateral_mode(ratio, only, used),
                several => message::at_lateral_modes(ratio, several.join(message::and()), used),
            }
        }
    }
}

/// Where neighbours can touch or are joined.
fn places(floors: &FloorPairs) -> String {
    match floors {
        FloorPairs::Common => message::floors_of_equal_height().into(),
        FloorPairs::All => message::all_floors_against_floors().into(),
        FloorPairs::Listed(pairs) => {
            let point = |level: Level| match level {
                Level::Floor(floor) => floor.to_string(),
                Level::Height(height) => format::HEIGHT.text(height, 2),
                Level::Wall => message::wall().to_owned(),
            };
            let shown = pairs.iter().take(PAIRS);
            let shown = shown.map(|pair| match *pair {
                [Level::Wall, level] | [level, Level::Wall] => {
                    message::against_the_wall(point(level))
                }
                _ => pair.map(point).join("–"),
            });
            let mut text = message::floors_of_pairs(shown.collect::<Vec<_>>().join(", "));
            if pairs.len() > PAIRS {
                text += &message::and_more_pairs_of_points(pairs.len() - PAIRS);
            }
            text
        }
        FloorPairs::Heights(heights) => message::listed_heights(heights.len()),
    }
}

fn link(link: &Link, summary: &LinkSummary) -> Facts {
    let stroke = summary.floors.iter().map(|floor| floor.peak_stroke_m);
    let mut facts: Facts = vec![(message::joins(), places(&link.floors))];
    if link.law != LinkLaw::Linear {
        facts.push((message::law(), summary.law.clone()));
    }
    if link.stiffness > 0.0 {
        facts.push((
            message::stiffness_of_each(),
            format::stiffness(link.stiffness),
        ));
    }
    if link.damping > 0.0 {
        facts.push((
            message::damping_of_each(),
            format::dashpot_in_words(link.damping, summary.exponent),
        ));
    }
    facts.push((message::peak_force(), format::force(summary.peak_force_n)));
    facts.push((
        message::stroke(),
        format::millimetres(stroke.fold(0.0, f64::max)),
    ));
    facts.push((
        message::dissipated(),
        format::unit(
            format::significant(format::ENERGY.of(summary.dissipated_j), 3),
            format::ENERGY.name(),
        ),
    ));
    facts
}

fn contact(gap: &Gap, summary: &GapSummary) -> Facts {
    let law = &gap.law;
    let mut facts: Facts = vec![
        (
            message::width(),
            match gap.widths.len() {
                0 | 1 => format::millimetres(gap.width()),
                n => message::and_more_widths(format::millimetres(gap.width()), n),
            },
        ),
        (message::can_touch(), places(&gap.floors)),
        (message::contact_law(), law.kind.name().into()),
        (
            message::stiffness(),
            match law.kind.is_hertzian() {
                true => format::exact(law.stiffness, "N/m^1.5"),
                false => format::stiffness(law.stiffness),
            },
        ),
    ];
    facts.extend(constants(law));
    if law.kind.uses_restitution() {
        let meaning = match law.restitution_is {
            RestitutionIs::Input => message::put_into_the_formula(),
            RestitutionIs::Realised => message::realised_by_free_masses(),
        };
        facts.push((
            message::restitution(),
            format!("{} ({meaning})", format::plain(law.restitution, 3)),
        ));
    }
    let least = summary.contacts.iter();
    let least = least.filter_map(|contact| contact.equivalent_restitution);
    if let Some(e) = least.reduce(f64::min) {
        facts.push((message::as_restitution(), format::fixed(e, 3)));
    }
    let deepest = summary
        .contacts
        .iter()
        .filter_map(|contact| contact.crushed_depth_m);
    if let Some(depth) = deepest.reduce(f64::max) {
        facts.push((message::crushed_by(), format::millimetres(depth)));
    }
    if let Some(free) = summary.free_restitution {
        facts.push((message::free_masses_rebound(), format::fixed(free, 3)));
    }
    facts
}

/// Constants that the law states instead of a coefficient of restitution.
fn constants(law: &ContactLaw) -> Facts {
    match law.kind {
        LawKind::Dashpot(kind) => vec![(message::dashpot(), format::linear_dashpot(kind.damping))],
        LawKind::BilinearGiven(kind) => vec![
            (
                message::second_stiffness(),
                format::stiffness(kind.second_stiffness),
            ),
            (
                message::yield_indentation(),
                format::millimetres(kind.yield_indentation),
            ),
        ],
        LawKind::Formula(formula) => vec![(message::contact_force_formula(), formula.to_string())],
        LawKind::Crushing(crushing) => vec![
            (message::crushing_force(), format::force(crushing.force)),
            (
                message::crushing_hardening(),
                format::plain(crushing.hardening, 3),
            ),
        ],
        _ => Facts::new(),
    }
}

fn motion(page: &Page) -> Facts {
    let motion = page.motion;
    let mut facts: Facts = vec![
        (message::name(), motion.name.clone()),
        (message::peak(), format::acceleration(motion.peak())),
        (message::scale(), {
            let reversed = if motion.scale < 0.0 {
                message::reversed()
            } else {
                ""
            };
            format!("{}{reversed}", format::plain(motion.scale, 4))
        }),
        (
            message::length(),
            format::unit(format::plain(motion.duration, 4), "s"),
        ),
    ];
    match &motion.wave {
        Wave::Sampled { step, acceleration } => facts.push((
            message::record(),
            message::points_apart(
                format::fixed(acceleration.len() as f64, 0),
                format::milliseconds(*step),
            ),
        )),
        Wave::Sine { period, .. } => facts.push((message::wave(), sine(*period))),
        Wave::Ricker { period, .. } => facts.push((
            message::wave(),
            message::ricker_pulse_period_s(format::plain(*period, 3)),
        )),
    }
    if let Some(across) = motion.across() {
        facts.push((message::across_fact(), across.name.clone()));
        let peak = format::acceleration(across.peak());
        facts.push((message::peak_across(), peak));
    }
    facts
}

fn sine(period: f64) -> String {
    message::sine_period_s(format::plain(period, 3))
}

fn analysis(page: &Page) -> Facts {
    let work = &page.summary.work;
    let count = |n: u64| format::fixed(n as f64, 0);
    let chosen = |given: bool| {
        if given {
            message::given()
        } else {
            message::automatic()
        }
    };
    let settings = &page.model.analysis;
    let mut facts: Facts = vec![
        (
            message::solver(),
            format!(
                "{} ({})",
                equations(work.solver),
                chosen(settings.solver.is_some())
            ),
        ),
        (
            message::step_of_free_vibration(),
            format!(
                "{} ({})",
                format::milliseconds(work.step_s),
                chosen(settings.step.is_some())
            ),
        ),
    ];
    let exact = [Solver::Modal, Solver::Series].map(Solver::name);
    if !exact.contains(&work.solver) {
        facts.insert(1, (message::integrator(), settings.integrator.to_string()));
    }
    if let Some(step) = work.contact_step_s {
        facts.push((
            message::step_in_contact(),
            format!(
                "{} ({})",
                format::milliseconds(step),
                chosen(settings.contact_step.is_some())
            ),
        ));
    }
    facts.extend([
        (message::tolerance(), format::plain(settings.tolerance, 1)),
        (
            message::steps(),
            message::of_them_in_contact_repeated(
                count(work.steps),
                count(work.contact_steps),
                count(work.repeated_steps),
            ),
        ),
        (
            message::work(),
            message::factorisations_solutions_iterations(
                count(work.factorizations),
                count(work.solves),
                count(work.iterations),
            ),
        ),
        (
            message::wall_time(),
            format::unit(format::plain(work.wall_s, 3), "s"),
        ),
    ]);
    if work.outer_iterations > 0 {
        facts.push((
            message::yielding(),
            message::iterations_for_yielding_springs_steps(
                count(work.outer_iterations),
                count(work.halved_steps),
            ),
        ));
    }
    facts
}

/// Equations that advance a step, by their name in model files.
fn equations(solver: &str) -> &str {
    match Solver::from_name(solver) {
        Some(solver) => solver.description(),
        None => solver,
    }
}

fn energy(page: &Page) -> Facts {
    let energy = &page.summary.energy;
    let mut facts: Facts = vec![
        (message::input(), format::energy(energy.input_j)),
        (message::kinetic(), format::energy(energy.kinetic_j)),
        (message::strain(), format::energy(energy.strain_j)),
        (message::damped(), format::energy(energy.damped_j)),
    ];
    if energy.links_j != 0.0 {
        facts.push((message::of_that_by_links(), format::energy(energy.links_j)));
    }
    if let Some(soil) = energy.soil_j {
        facts.push((message::of_that_by_the_soil(), format::energy(soil)));
    }
    if energy.hysteretic_j != 0.0 {
        facts.push((message::hysteretic(), format::energy(energy.hysteretic_j)));
    }
    facts.extend([(message::contact(), format::energy(energy.contact_j))]);
    if let Some(friction) = energy.friction_j {
        facts.push((message::friction(), format::energy(friction)));
    }
    facts.extend([
        (message::imbalance(), format::plain(energy.imbalance, 2)),
        (
            message::worst_imbalance(),
            format::plain(energy.worst_imbalance, 2),
        ),
    ]);
    facts
}

/// How a foundation moves, and what the soil does to the fundamental modes; of a building with a plan also across, and in torsion.
fn foundation(foundation: &FoundationSummary) -> Facts {
    let milliradians = |value: f64| format::unit(format::plain(value * 1e3, 3), "mrad");
    let mut facts = Facts::new();
    let mut add = |name: &'static str,
                   [sway, rocking, period, ratio, damping, fixed]: [f64; 6],
                   parts: &[(f64, &str)]| {
        let parts = parts.iter().map(|(value, unit)| {
            let (factor, unit) = format::factor_of(unit);
            format::unit(format::plain(factor * value, 4), unit)
        });
        let parts: Vec<String> = parts.collect();
        facts.extend([
            (
                name,
                message::sways_rocks(format::millimetres(sway), milliradians(rocking)),
            ),
            (
                message::first_period_on_the_soil(),
                message::times_that_on_rigid_ground(
                    format::unit(format::plain(period, 3), "s"),
                    format::plain(ratio, 4),
                ),
            ),
            (
                message::damping_of_that_mode(),
                message::on_rigid_ground(
                    format::plain(100.0 * damping, 3),
                    format::plain(100.0 * fixed, 3),
                ),
            ),
            (message::springs_and_dashpots(), parts.join(", ")),
        ]);
    };
    let units = ["N/m", "N·s/m", "N·m/rad", "N·m·s/rad"];
    add(
        message::foundation(),
        [
            foundation.sway_peak_m,
            foundation.rocking_peak_rad,
            foundation.period_s,
            foundation.period_ratio,
            foundation.damping_ratio,
            foundation.damping_ratio_fixed,
        ],
        &[
            (foundation.sway_stiffness_n_m, units[0]),
            (foundation.sway_damping_n_s_m, units[1]),
            (foundation.rocking_stiffness_n_m_rad, units[2]),
            (foundation.rocking_damping_n_m_s_rad, units[3]),
        ],
    );
    let Some(plan) = &foundation.in_plan else {
        return facts;
    };
    add(
        message::foundation_across(),
        [
            plan.sway_across_peak_m,
            plan.rocking_across_peak_rad,
            plan.period_across_s,
            plan.period_ratio_across,
            plan.damping_ratio_across,
            plan.damping_ratio_across_fixed,
        ],
        &[
            (plan.sway_across_stiffness_n_m, units[0]),
            (plan.sway_across_damping_n_s_m, units[1]),
            (plan.rocking_across_stiffness_n_m_rad, units[2]),
            (plan.rocking_across_damping_n_m_s_rad, units[3]),
            (plan.torsional_stiffness_n_m_rad, units[2]),
            (plan.torsional_damping_n_m_s_rad, units[3]),
        ],
    );
    facts.push((
        message::foundation_turns(),
        milliradians(plan.torsion_peak_rad),
    ));
    facts
}
