//! Paths of axial force and moment of ends of columns made of fibres, over the capacity of their sections.

use jostle::linear::sort_by;
use jostle::results::summary::FibreSummary;
use jostle::structure::FibreSection;
use jostle_section::Section;
use jostle_section::capacity::Interaction;

use crate::static_plot::{Line, Plot};
use crate::thin_loop::thin_loop;
use crate::{Page, format, message};

/// Ends that are drawn at most.
const MOST: usize = 4;
/// Points of a path at most.
const POINTS: usize = 1200;

/// An end of a column.
struct End<'a> {
    summary: &'a FibreSummary,
    section: FibreSection,
    /// Its first spring among those of all buildings.
    first_spring: usize,
    building: usize,
}

/// Those whose strains came nearest to their limits, in space one for each plane of bending; none without histories.
pub(crate) fn plots(page: &Page) -> Vec<Plot> {
    let mut ends = ends(page);
    let strained = |end: &End<'_>| end.summary.worst_ratio().unwrap_or(0.0);
    sort_by(&mut ends, |a, b| strained(b).total_cmp(&strained(a)));
    ends.truncate(MOST);
    let planes = ends.iter().flat_map(|end| {
        let planes = 0..end.section.rotations.len();
        planes.map(move |plane| (end, plane))
    });
    planes
        .filter_map(|(end, plane)| plot(page, end, plane))
        .collect()
}

fn ends<'a>(page: &Page<'a>) -> Vec<End<'a>> {
    let mut found = Vec::new();
    for (index, system) in page.system.buildings.iter().enumerate() {
        let discretization = &system.discretization;
        let summaries = page.summary.buildings.get(index);
        let summaries = summaries.map_or(&[][..], |summary| &summary.sections);
        for (section, summary) in discretization.sections.iter().zip(summaries) {
            found.push(End {
                summary,
                section: section.clone(),
                first_spring: system.spring_offset
                    + discretization.springs_of_section(section).start,
                building: index,
            });
        }
    }
    found
}

/// The path in a plane of bending: of a space frame, that along the lines x, then that along the lines y. The capacity is that of bending
/// in this plane alone.
fn plot(page: &Page, end: &End<'_>, plane: usize) -> Option<Plot> {
    let springs = page.springs?;
    let time = page.history.column(jostle::Column::TIME)?;
    // Moment and compression.
    let mut path = vec![[0.0_f64; 2]; time.len()];
    for (number, fibre) in end.section.fibres.iter().enumerate() {
        let forces = springs.of_spring(end.first_spring + number);
        for (sum, [_, force]) in path.iter_mut().zip(forces) {
            let force = f64::from(force);
            *sum = [sum[0] + force * fibre.at[plane], sum[1] - force];
        }
    }
    let shown = |[moment, compression]: [f64; 2]| {
        [format::MOMENT.of(moment), format::FORCE.of(compression)]
    };
    let single: Vec<[f32; 2]> = path
        .iter()
        .map(|path| path.map(|value| value as f32))
        .collect();
    let kept = thin_loop(&time, &single, POINTS);
    let path = kept.into_iter().map(|row| shown(path[row])).collect();
    let mut lines = vec![Line {
        name: message::path_of_the_run().to_owned(),
        points: path,
        colour: end.building,
        dashed: false,
    }];
    let discretization = &page.system.buildings[end.building].discretization;
    let member = discretization.column_of_section(&end.section);
    let mut known = page.sections.iter();
    let known = known.find(|candidate| {
        candidate.building == end.building && candidate.members.iter().any(|name| *name == member)
    });
    lines.extend(known.map(|point| {
        Line {
            name: message::interaction_of_the_section().to_owned(),
            points: match plane {
                0 => outline(point.section),
                _ => outline(&point.section.turned()),
            }
            .into_iter()
            .map(shown)
            .collect(),
            colour: end.building + 1,
            dashed: true,
        }
    }));
    Some(Plot {
        title: match (end.section.rotations.len(), plane) {
            (1, _) => message::path_over_interaction(&end.summary.name),
            (_, 0) => message::path_in_plane(&end.summary.name, "x"),
            _ => message::path_in_plane(&end.summary.name, "y"),
        },
        x_label: message::moment_axis(format::MOMENT.name()),
        y_label: message::compression_axis(format::FORCE.name()),
        logarithmic: false,
        aspect: 0.8,
        lines,
    })
}

/// Moments and compressions that a section bears: a closed line \[N·m, N\].
fn outline(section: &Section) -> Vec<[f64; 2]> {
    let [right, left] = Interaction::of_both_signs(section);
    let right = right.points.iter().map(|[load, moment]| [*moment, *load]);
    let left = left.points.iter().rev();
    let mut all: Vec<[f64; 2]> = right
        .chain(left.map(|[load, moment]| [-moment, *load]))
        .collect();
    all.extend(all.first().copied());
    all
}
