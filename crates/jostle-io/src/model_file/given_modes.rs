//! `kind = "given"` by floor masses, periods and shapes of modes.

use jostle::{Given, Model, Structure};

use super::building::{per_storey, storeys};
use super::shear::DEFAULT_STOREY_HEIGHT;
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Greatest product of two shapes of unit mass that should be orthogonal.
const ORTHOGONAL: f64 = 0.05;
/// What the nearest of the modes left out count more than the others \[–\].
const NEAREST_COUNT: f64 = 0.85;

/// A building by its modes.
struct Modes {
    /// Floor masses \[kg\].
    mass: Vec<f64>,
    /// \[m\]
    storey_heights: Vec<f64>,
    /// \[s\]
    periods: Vec<f64>,
    /// Shapes of unit mass, one per period \[1/√kg\].
    shapes: Vec<Vec<f64>>,
}

impl Modes {
    /// K = M (Σ ω² φφᵀ + ω_r² (M⁻¹ − Σ φφᵀ)) M, with one ω_r² for all that the modes leave out \[1/s²\].
    fn building(self, rest: f64) -> Given {
        let mass = &self.mass;
        let entry = |i: usize, j: usize| {
            let diagonal = if i == j { rest * mass[i] } else { 0.0 };
            let modes = self.shapes.iter().zip(&self.periods);
            let of_modes =
                modes.map(|(shape, period)| (square(*period) - rest) * shape[i] * shape[j]);
            diagonal + mass[i] * mass[j] * of_modes.sum::<f64>()
        };
        let floors = 0..mass.len();
        let row = |i: usize| floors.clone().map(|j| entry(i, j)).collect();
        let rows: Vec<Vec<f64>> = floors.clone().map(row).collect();
        Given::condensed(self.mass, &rows, self.storey_heights)
    }

    /// ω_r² with which a floor, from 0, has this flexibility \[m/N\]: (1/m − Σφ²)/(f − Σφ²/ω²).
    ///
    /// # Errors
    /// What is wrong with the flexibility, and what may be done about it.
    fn rest_of(&self, floor: usize, flexibility: f64) -> Result<f64, (String, &'static str)> {
        let shapes = self.shapes.iter().map(|shape| shape[floor].powi(2));
        let inertia = 1.0 / self.mass[floor] - shapes.clone().sum::<f64>();
        if inertia * self.mass[floor] < LEAST_LEFT {
            let problem =
                "the modes leave out nothing of this floor, so that it gives way by them alone";
            return Err((problem.into(), "leave it out"));
        }
        let by_modes: f64 = shapes
            .zip(&self.periods)
            .map(|(shape, period)| shape / square(*period))
            .sum();
        if flexibility <= by_modes {
            return Err((
                format!(
                    "floor {} moves {by_modes:.4e} m per newton by the given modes alone, more than {flexibility:.4e} m/N",
                    floor + 1
                ),
                "check units, and that contact_floor is the floor with the unit force, whose displacement counts",
            ));
        }
        Ok(inertia / (flexibility - by_modes))
    }
}

/// Least part of the mass of a floor that modes leave out, for its flexibility to say anything about them.
const LEAST_LEFT: f64 = 1e-6;

/// Sets what modes leave out by the flexibility of the floors that are hit, where files state it.
pub(super) fn soften_contacts(model: &mut Model, reader: &mut Reader<'_>, view: &View<'_>) {
    let buildings = reader
        .get(view, "building")
        .and_then(|field| field.entries());
    for (index, field) in buildings.unwrap_or_default().iter().enumerate() {
        let Some(building_view) = reader.reopen(field, &[Section::Building, Section::Given]) else {
            continue;
        };
        let Some(stated) = reader.get(&building_view, "contact_flexibility") else {
            continue;
        };
        let (Some(Structure::Given(_)), Some(flexibility)) = (
            model
                .buildings
                .get(index)
                .map(|building| &building.structure),
            reader.positive(&stated, Dimension::Flexibility),
        ) else {
            continue;
        };
        let floor = match reader.get(&building_view, "contact_floor") {
            Some(field) => match reader.count(&field) {
                Some(floor) if (1..=model.buildings[index].floors()).contains(&floor) => floor - 1,
                Some(_) => {
                    let floors = model.buildings[index].floors();
                    reader.bad(&field, format!("must be a floor from 1 to {floors}"));
                    continue;
                }
                None => continue,
            },
            None => highest_struck(model, index),
        };
        // What was sound when the building was read is read again.
        let Some(modes) = read_modes(reader, &building_view) else {
            continue;
        };
        match modes.rest_of(floor, flexibility) {
            Ok(rest) => model.buildings[index].structure = Structure::Given(modes.building(rest)),
            Err((problem, remedy)) => *reader.bad(&stated, problem) = Some(remedy.into()),
        }
    }
}

/// The highest floor of a building that a neighbour reaches, from 0; the roof if it has none.
fn highest_struck(model: &Model, index: usize) -> usize {
    let heights = model.buildings[index].floor_levels();
    let roof = heights.last().copied().unwrap_or(0.0);
    let gaps = model.gaps.iter().map(|gap| gap.between);
    let beside = gaps
        .filter(|between| between.contains(&Some(index)))
        .map(|between| {
            let others = between
                .into_iter()
                .flatten()
                .filter(|other| *other != index);
            let roofs = others.filter_map(|other| model.buildings.get(other)?.floor_levels().pop());
            // A wall reaches every floor.
            roofs.fold(roof, f64::min)
        });
    let reached = beside.reduce(f64::max).unwrap_or(roof);
    let away = |height: &f64| (height - reached).abs();
    let nearest = heights.iter().enumerate();
    let nearest = nearest.min_by(|a, b| away(a.1).total_cmp(&away(b.1)));
    nearest.map_or(0, |(floor, _)| floor)
}

/// Floor masses, periods and shapes.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Given> {
    let modes = read_modes(reader, view)?;
    let remainder = reader
        .get(view, "remainder_period")
        .and_then(|field| reader.positive(&field, Dimension::Time));
    if let Some(field) = reader.get(view, "contact_flexibility") {
        reader.positive(&field, Dimension::Flexibility);
        if remainder.is_some() {
            *reader.bad(&field, "cannot be combined with remainder_period") = Some(
                "keep the one that you know; the flexibility decides the force of an impact".into(),
            );
        }
    } else if let Some(field) = reader.get(view, "contact_floor") {
        *reader.bad(&field, "needs contact_flexibility") =
            Some("add contact_flexibility = \"2.1e-8 m/N\", its displacement per unit force, or leave it out".into());
    }
    let last = modes.periods.iter().copied().fold(f64::INFINITY, f64::min);
    let usual = || last * usual_remainder(modes.periods.len(), modes.mass.len());
    let rest = square(remainder.unwrap_or_else(usual));
    Some(modes.building(rest))
}

/// Square of the circular frequency of a period.
fn square(period: f64) -> f64 {
    (std::f64::consts::TAU / period).powi(2)
}

fn read_modes(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Modes> {
    for key in ["matrices", "ports", "units"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "belongs to a building given by matrices") =
                Some("keep either matrices and ports, or mass, periods and shapes".into());
        }
    }
    let count = storeys(reader, view, &["mass", "storey_height"]);
    let mass = match reader.get(view, "mass") {
        Some(field) => per_storey(reader, &field, Dimension::Mass, count),
        None => {
            reader.missing(
                view,
                "mass",
                "add mass = [\"40 t\", …], of every floor from the ground up",
            );
            None
        }
    };
    let storey_heights = match reader.get(view, "storey_height") {
        Some(field) => per_storey(reader, &field, Dimension::Length, count),
        None => count.map(|count| vec![DEFAULT_STOREY_HEIGHT; count]),
    };
    let periods = match reader.get(view, "periods") {
        Some(field) => read_periods(reader, &field),
        None => {
            reader.missing(
                view,
                "periods",
                "add periods = [\"0.8 s\", \"0.27 s\"], the longest first",
            );
            None
        }
    };
    let shapes = match reader.get(view, "shapes") {
        Some(field) => Some((read_shapes(reader, &field, count), field)),
        None => {
            reader.missing(view, "shapes", "add shapes = [[0.3, 0.7, 1.0], …], one list for each period, floors from the ground up");
            None
        }
    };
    let (mass, storey_heights, periods) = (mass?, storey_heights?, periods?);
    let (shapes, field) = shapes?;
    let shapes = shapes?;
    if mass.iter().any(|mass| *mass <= 0.0) {
        reader.missing(view, "mass", "every floor needs a mass greater than zero");
        return None;
    }
    if shapes.len() != periods.len() || periods.len() > mass.len() {
        reader.bad(
            &field,
            format!(
                "has {} shapes for {} periods of a building with {} floors; give one shape for each period, and at most one for each floor",
                shapes.len(),
                periods.len(),
                mass.len()
            ),
        );
        return None;
    }
    let shapes = match orthonormal(&mass, &shapes) {
        Ok(shapes) => shapes,
        Err(problem) => {
            reader.bad(&field, problem);
            return None;
        }
    };
    Some(Modes {
        mass,
        storey_heights,
        periods,
        shapes,
    })
}

/// Period of what so many modes of a building of so many floors leave out, over the last of their periods: from the modes that a
/// uniform shear building has left, ω_j ∝ s_j = sin((2j − 1)π/(4N + 2)). A floor that is hit gives way by their flexibilities together,
/// s_n²/s_j² each, of which those nearest count most: 0.85 of their root mean square. 1 if none is left out.
fn usual_remainder(modes: usize, floors: usize) -> f64 {
    let s =
        |j: usize| libm::sin((2 * j - 1) as f64 * std::f64::consts::PI / (4 * floors + 2) as f64);
    let left = floors - modes;
    if left == 0 {
        return 1.0;
    }
    let squares = (modes + 1..=floors).map(|j| s(j).powi(-2)).sum::<f64>();
    NEAREST_COUNT * s(modes) * (squares / left as f64).sqrt()
}

fn read_periods(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Vec<f64>> {
    let Some(entries) = field.entries() else {
        reader.bad(field, "must be a list, such as [\"0.8 s\", \"0.27 s\"]");
        return None;
    };
    let periods: Vec<_> = entries
        .iter()
        .map(|e| reader.positive(e, Dimension::Time))
        .collect();
    periods.into_iter().collect()
}

fn read_shapes(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    floors: Option<usize>,
) -> Option<Vec<Vec<f64>>> {
    let Some(entries) = field.entries() else {
        reader.bad(field, "must be a list of shapes, such as [[0.3, 0.7, 1.0]]");
        return None;
    };
    let mut shapes = Vec::new();
    let mut sound = true;
    for entry in &entries {
        let Some(values) = entry.entries() else {
            reader.bad(
                entry,
                "must be a list of the displacements of all floors, from the ground up",
            );
            sound = false;
            continue;
        };
        let read: Vec<_> = values
            .iter()
            .map(|value| reader.quantity(value, Dimension::Dimensionless))
            .collect();
        if floors.is_some_and(|floors| floors != read.len()) {
            reader.bad(
                entry,
                format!(
                    "has {} values for {} floors",
                    read.len(),
                    floors.unwrap_or(0)
                ),
            );
            sound = false;
        }
        match read.into_iter().collect() {
            Some(shape) => shapes.push(shape),
            None => sound = false,
        }
    }
    sound.then_some(shapes)
}

/// Shapes of unit mass, orthogonal to each other: those of programs are rounded.
fn orthonormal(mass: &[f64], shapes: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, String> {
    let product = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).zip(mass).map(|((a, b), m)| a * b * m).sum()
    };
    let mut found: Vec<Vec<f64>> = Vec::new();
    for (index, shape) in shapes.iter().enumerate() {
        let mut shape = shape.clone();
        let size = product(&shape, &shape).sqrt();
        if size.is_nan() || size == 0.0 {
            return Err(format!("shape {} is zero", index + 1));
        }
        shape.iter_mut().for_each(|value| *value /= size);
        for (other, known) in found.iter().enumerate() {
            let shared = product(&shape, known);
            if shared.abs() > ORTHOGONAL {
                return Err(format!(
                    "shapes {} and {} are not orthogonal with these masses (their product is {shared:.3}); check that shapes are of this direction, floors from the ground up, and that masses are those of the program",
                    other + 1,
                    index + 1
                ));
            }
            for (value, known) in shape.iter_mut().zip(known) {
                *value -= shared * known;
            }
        }
        let size = product(&shape, &shape).sqrt();
        shape.iter_mut().for_each(|value| *value /= size);
        found.push(shape);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::usual_remainder;

    /// A floor of a uniform shear building gives way by i/k under a force. By modes with the usual remainder that is nearly so, and
    /// the nearer the more modes there are.
    #[test]
    fn floors_of_uniform_buildings_give_way_as_they_do() {
        for floors in 4..=13_usize {
            let turn = PI / (2 * floors + 1) as f64;
            let omega = |j: usize| 2.0 * ((2 * j - 1) as f64 * 0.5 * turn).sin();
            let shape = |j: usize, i: usize| ((2 * j - 1) as f64 * i as f64 * turn).sin();
            let size = |j: usize| (1..=floors).map(|i| shape(j, i).powi(2)).sum::<f64>();
            for (modes, allowed) in [(floors.div_ceil(2), 0.03), (3 * floors / 4, 0.02)] {
                let rest = omega(modes) / usual_remainder(modes, floors);
                for i in floors.div_ceil(2)..=floors {
                    let squares = (1..=modes).map(|j| shape(j, i).powi(2) / size(j));
                    let left = 1.0 - squares.sum::<f64>();
                    let of_modes =
                        (1..=modes).map(|j| shape(j, i).powi(2) / size(j) / omega(j).powi(2));
                    let flexibility = of_modes.sum::<f64>() + left / rest.powi(2);
                    let off = (flexibility / i as f64 - 1.0).abs();
                    assert!(
                        off < allowed,
                        "floor {i} of {floors}, {modes} modes: {off:.1e}"
                    );
                }
            }
            assert_eq!(usual_remainder(floors, floors), 1.0);
        }
    }
}
