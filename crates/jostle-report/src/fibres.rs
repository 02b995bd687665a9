//! Ends of columns that are made of fibres: what they bore, and how far they stretched.

use jostle::FibreLimit;
use jostle::results::summary::FibreSummary;
use maud::{Markup, html};

use crate::static_plot::Plot;
use crate::{Page, fibre_paths, format, message};

/// Most rows of the table.
const MOST_ROWS: usize = 200;

/// Energy that counts as none \[J\].
const NO_ENERGY: f64 = 1e-6;

/// The section; `None` without such columns.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let buildings = page.summary.buildings.iter();
    let buildings = buildings.filter(|building| !building.sections.is_empty());
    let buildings: Vec<_> = buildings
        .map(|building| (&building.name[..], &building.sections[..]))
        .collect();
    if buildings.is_empty() {
        return None;
    }
    let all: Vec<&FibreSummary> = buildings.iter().flat_map(|(_, all)| *all).collect();
    let paths = fibre_paths::plots(page);
    Some(html! {
        section #fibres {
            h2 { (message::columns_that_follow_their_axial_force()) }
            @for (name, all) in &buildings { p { (sentence(name, all)) } }
            @if !paths.is_empty() {
                div.static-plots { @for path in &paths { (path.figure()) } }
                p.quiet {
                    @let strained = all.iter().any(|end| has_strains(end));
                    @if strained { (message::paths_of_ends()) } @else { (message::paths_on_surfaces()) }
                    @if paths.iter().any(Plot::has_dashes) {
                        " "
                        @if strained { (message::capacity_is_dashed()) } @else { (message::surface_is_dashed()) }
                    }
                }
            }
            (table(&all))
        }
    })
}

/// Whether it is made of fibres, which have strains, or yields on a surface.
fn has_strains(end: &FibreSummary) -> bool {
    end.steel_strain.is_some() || end.concrete_strain.is_some()
}

fn sentence(name: &str, all: &[FibreSummary]) -> String {
    let count = |has: fn(&FibreSummary) -> bool| all.iter().filter(|fibre| has(fibre)).count();
    let yielded = count(|end| end.yielded_s.is_some());
    if count(has_strains) == 0 {
        return message::ends_that_yielded_on_surfaces(name, yielded, all.len());
    }
    let crushed = count(|end| end.crushed_s.is_some());
    let mut text = message::ends_that_yielded_and_crushed(name, yielded, crushed, all.len());
    let limits = FibreLimit::ALL.into_iter().filter_map(|limit| {
        let judged = all.iter().flat_map(|fibre| &fibre.limits);
        let judged: Vec<_> = judged
            .filter(|candidate| candidate.limit == limit)
            .collect();
        let passed = judged
            .iter()
            .filter(|limit| limit.passed_s.is_some())
            .count();
        let what = match limit {
            FibreLimit::Spalling => message::spalling_of_cover(),
            FibreLimit::Crushing => message::crushing_of_cores(),
            FibreLimit::Buckling => message::buckling_of_bars(),
            FibreLimit::Fracture => message::fracture_of_bars(),
        };
        (!judged.is_empty()).then(|| message::ends_that_passed(what, passed, judged.len()))
    });
    let limits: Vec<String> = limits.collect();
    if !limits.is_empty() {
        text.push(' ');
        text += &message::strains_judged(limits.join(", "));
    }
    text
}

/// Which strains it passed, and when.
fn passed(fibre: &FibreSummary) -> String {
    let passed = fibre.limits.iter().filter_map(|limit| {
        let name = match limit.limit {
            FibreLimit::Spalling => message::spalling_name(),
            FibreLimit::Crushing => message::crushing_name(),
            FibreLimit::Buckling => message::buckling_name(),
            FibreLimit::Fracture => message::fracture_name(),
        };
        Some(message::limit_passed_at(
            name,
            format::instant(limit.passed_s?),
        ))
    });
    let passed: Vec<String> = passed.collect();
    match passed.is_empty() {
        true => format::NOTHING.to_owned(),
        false => passed.join(", "),
    }
}

fn table(all: &[&FibreSummary]) -> Markup {
    let in_space = all.iter().any(|fibre| fibre.across.is_some());
    let strained = all.iter().any(|end| has_strains(end));
    let mut columns = vec![
        (message::compression(), format::FORCE.name()),
        (message::moment(), format::MOMENT.name()),
        (message::rotation(), "mrad"),
    ];
    if in_space {
        columns.push((message::moment_across(), format::MOMENT.name()));
        columns.push((message::rotation_across(), "mrad"));
    }
    columns.push((message::yielded(), "s"));
    if strained {
        columns.extend([
            (message::strain_of_bars(), "‰"),
            (message::strain_of_concrete(), "‰"),
            (message::past_its_strength(), "s"),
            (message::limits_passed(), "s"),
        ]);
    }
    columns.push((message::dissipated(), format::ENERGY.name()));
    html! {
        @if all.len() > MOST_ROWS {
            p.quiet { (message::the_first_of_in_order(MOST_ROWS, all.len())) }
        }
        div.scroll {
            table {
                thead { tr {
                    th scope="col" { (message::column()) }
                    @for (name, unit) in columns {
                        th.number scope="col" { (name) br; span.unit { "[" (unit) "]" } }
                    }
                } }
                tbody {
                    @for own in all.iter().take(MOST_ROWS) {
                        tr {
                            th scope="row" { (own.name) }
                            @for value in cells(own, in_space, strained) { td.number { (value) } }
                        }
                    }
                }
            }
        }
    }
}

fn cells(fibre: &FibreSummary, in_space: bool, strained: bool) -> Vec<String> {
    let nothing = || format::NOTHING.to_owned();
    let strain = |strain: Option<f64>| {
        strain.map_or_else(nothing, |strain| format::significant(1e3 * strain, 3))
    };
    let instant = |at: Option<f64>| at.map_or_else(nothing, |at| format::fixed(at, 3));
    let greatest = |a: f64, b: f64, unit: f64| format::significant(a.max(-b) / unit, 4);
    let mut cells = vec![
        message::least_to_greatest(
            format::significant(format::FORCE.of(-fibre.axial_max_n), 3),
            format::significant(format::FORCE.of(-fibre.axial_min_n), 3),
        ),
        greatest(
            fibre.moment_max_n_m,
            fibre.moment_min_n_m,
            format::MOMENT.size(),
        ),
        greatest(fibre.rotation_max_rad, fibre.rotation_min_rad, 1e-3),
    ];
    if in_space {
        let across = fibre.across.as_ref();
        cells.extend(across.map_or_else(
            || [nothing(), nothing()],
            |peaks| {
                let [moment, turned] = [
                    [peaks.moment_across_max_n_m, peaks.moment_across_min_n_m],
                    [peaks.rotation_across_max_rad, peaks.rotation_across_min_rad],
                ];
                [
                    greatest(moment[0], moment[1], format::MOMENT.size()),
                    greatest(turned[0], turned[1], 1e-3),
                ]
            },
        ));
    }
    cells.push(instant(fibre.yielded_s));
    if strained {
        cells.extend([
            strain(fibre.steel_strain),
            strain(fibre.concrete_strain),
            instant(fibre.crushed_s),
            passed(fibre),
        ]);
    }
    // Of what stays elastic only rounding is left.
    cells.push(match fibre.dissipated_j.abs() > NO_ENERGY {
        true => format::significant(format::ENERGY.of(fibre.dissipated_j), 3),
        false => "0".to_owned(),
    });
    cells
}
