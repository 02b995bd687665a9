//! Section, instant, forces and impact of the greatest ratios, and what a building is told about its first and its worst
//! member, all looked up in the recorded forces of the same run.

use std::collections::BTreeMap;

use jostle::history::PeaksOf;
use jostle::model::{CapacityLine, MemberCapacity};
use jostle::results::summary::{ImpactPlace, MemberSummary, RatioPlace};
use jostle::structure::{MemberPlace, SectionAt};
use jostle::{FloorPairs, Gap, Level, Model, Outcome, Solver, System};

use crate::member_ratios::support::{building, capacities, model, run};

/// Between points and level beyond them, written another way than in jostle.
fn interpolate(line: &CapacityLine, x: f64) -> f64 {
    let points = line.points();
    let mut value = points[0][1];
    for ends in points.windows(2) {
        let share = ((x - ends[0][0]) / (ends[1][0] - ends[0][0])).clamp(0.0, 1.0);
        value += share * (ends[1][1] - ends[0][1]);
    }
    value
}

/// All recorded forces of a member: instant, section, axial force, shear and moment.
#[derive(Default)]
pub(crate) struct Recorded(pub(crate) Vec<(f64, &'static str, [f64; 3])>);

impl Recorded {
    /// Of all members, by name.
    pub(crate) fn all(system: &System, outcome: &Outcome) -> BTreeMap<String, Self> {
        let history = outcome.member_history.as_ref().expect("asked for");
        let sections: Vec<(usize, &'static str)> = history
            .members()
            .iter()
            .enumerate()
            .flat_map(|(at, [index, member])| {
                let member = &system.buildings[*index].members.members[*member];
                let column = matches!(member.place, MemberPlace::Column { .. });
                member.sections.iter().map(move |section| match section.at {
                    SectionAt::First if column => (at, "foot"),
                    SectionAt::Last if column => (at, "head"),
                    SectionAt::First => (at, "left"),
                    SectionAt::Last => (at, "right"),
                    SectionAt::Below => (at, "below"),
                    _ => (at, "above"),
                })
            })
            .collect();
        let mut all: Vec<Self> = Vec::new();
        all.resize_with(history.members().len(), Self::default);
        for (time, row) in history.times().iter().zip(history.rows()) {
            for ((member, at), [axial, shear, moment, ..]) in sections.iter().zip(row) {
                all[*member].0.push((*time, at, [axial, shear, moment]));
            }
        }
        let names = history.members().iter().map(|[index, member]| {
            let building = &system.buildings[*index];
            format!(
                "{}.{}",
                building.name, building.members.members[*member].place
            )
        });
        names.zip(all).collect()
    }

    fn at(&self, place: &RatioPlace) -> [f64; 3] {
        let mut rows = self.0.iter();
        let found = rows.find(|(time, at, _)| *time == place.at_s && *at == place.at);
        found.expect("a recorded instant and section").2
    }
}

fn compression(capacity: &MemberCapacity, axial: f64) -> f64 {
    capacity.compression_at_rest - if capacity.follows_axial { axial } else { 0.0 }
}

/// First recorded instants at which shear and moment exceed the capacities of the governing rule.
fn first_excesses(capacity: &MemberCapacity, recorded: &Recorded) -> [Option<f64>; 2] {
    let rule = &capacity.rules[0];
    let mut first = [None; 2];
    for (time, _, [axial, shear, moment]) in &recorded.0 {
        let carried = compression(capacity, *axial);
        let strength = rule.shear.as_ref().expect("given");
        let by_shear =
            interpolate(&strength.steady, carried) + interpolate(&strength.degrading, carried);
        let by_bending = interpolate(&rule.bending[usize::from(*moment < 0.0)], carried);
        for (first, exceeded) in first.iter_mut().zip([
            shear.abs() > by_shear.min(strength.limit),
            moment.abs() > by_bending,
        ]) {
            if exceeded && first.is_none() {
                *first = Some(*time);
            }
        }
    }
    first
}

/// Height of a section: storeys of building A are 3.2 m, the first of the others is 4.5 m.
fn height(name: &str, at: &str) -> f64 {
    let mut parts = name.split('.');
    let first = if parts.next() == Some("A") { 3.2 } else { 4.5 };
    let column = parts.next() == Some("column");
    let numbers: Vec<usize> = parts.map(|part| part.parse().expect("a number")).collect();
    let floor = |number: usize| match number {
        0 => 0.0,
        _ => first + 3.2 * (number - 1) as f64,
    };
    let level = if column { numbers[1] } else { numbers[0] };
    match at {
        "foot" => floor(level - 1),
        // Floors of B strike the columns of A.
        "below" | "above" => [4.5, 7.7][level - 2],
        _ => floor(level),
    }
}

/// Start, height and names of both buildings of an impact.
type Told = (f64, f64, [String; 2]);

/// What impacts were in progress at the instants that are told.
#[derive(Default)]
struct Seen {
    /// An impact on the building.
    own: usize,
    /// Several, so that the strongest has to be chosen.
    several: usize,
    /// Only impacts of other buildings.
    elsewhere: usize,
    /// One on the member itself.
    on_it: usize,
    /// None on the member, but others on its building.
    beside: usize,
}

impl Seen {
    /// The impact told is the strongest of those in which the building is at the instant: on the member itself, where one is.
    fn check(
        &mut self,
        told: Option<&ImpactPlace>,
        member: &MemberSummary,
        index: usize,
        time: f64,
        (system, outcome): (&System, &Outcome),
    ) {
        let (mut count, mut others) = (0, 0);
        let mut strongest: Option<((bool, f64), Told)> = None;
        for impact in &outcome.impacts {
            let contact = &system.contacts[impact.contact];
            let sides = contact
                .ports
                .buildings()
                .map(|side| side.expect("no walls"));
            if time < impact.start || impact.end < time {
                continue;
            }
            if !sides.contains(&index) {
                others += 1;
                continue;
            }
            count += 1;
            let mut struck = member.struck.iter();
            let on_it = struck.any(|struck| (struck.height_m - contact.height).abs() < 1e-9);
            let rank = (on_it, impact.peak_force);
            if strongest.as_ref().is_none_or(|(known, _)| rank > *known) {
                let names = sides.map(|side| system.buildings[side].name.clone());
                strongest = Some((rank, (impact.start, contact.height, names)));
            }
        }
        let on_it = strongest.as_ref().map(|((on_it, _), _)| *on_it);
        assert_eq!(told.and_then(|told| told.on_member), on_it, "at {time} s");
        self.on_it += usize::from(on_it == Some(true));
        self.beside += usize::from(on_it == Some(false));
        self.own += usize::from(count > 0);
        self.several += usize::from(count > 1);
        self.elsewhere += usize::from(count == 0 && others > 0);
        let told = told.map(|told| (told.start_s, told.height_m, told.between.clone()));
        assert_eq!(told, strongest.map(|(_, place)| place), "at {time} s");
    }
}

/// Forces, height and impact of the place of a greatest ratio.
fn check_place(
    member: &MemberSummary,
    place: &RatioPlace,
    [demand, carried]: [f64; 2],
    seen: &mut Seen,
    (index, system, outcome): (usize, &System, &Outcome),
) {
    let name = &member.name;
    assert_eq!(place.demand, demand, "{name}");
    assert_eq!(place.compression_n, carried, "{name}");
    let due = height(name, place.at);
    assert!((place.height_m - due).abs() < 1e-9, "{name}: {}", place.at);
    seen.check(
        place.impact.as_ref(),
        member,
        index,
        place.at_s,
        (system, outcome),
    );
}

fn check(model: &Model) -> Seen {
    let (system, outcome, summary) = run(model, Solver::Riccati);
    let histories = Recorded::all(&system, &outcome);
    let mut seen = Seen::default();
    for (index, building) in summary.buildings.iter().enumerate() {
        let mut firsts = Vec::new();
        let mut exceeded = 0;
        let mut worst = (0.0, String::new(), "");
        for member in &building.members {
            let mut all = model.analysis.members.capacities.iter();
            let member_capacity = all
                .find(|capacity| capacity.member == member.name)
                .expect("rated");
            let recorded = &histories[&member.name];
            for (ratio, rule) in member
                .ratio
                .iter()
                .chain(&member.other_ratios)
                .zip(&member_capacity.rules)
            {
                let [shear_at, bending_at] =
                    [ratio.shear_at.as_ref().expect("given"), &ratio.bending_at];
                let [axial, shear, _] = recorded.at(shear_at);
                let carried = compression(member_capacity, axial);
                check_place(
                    member,
                    shear_at,
                    [shear, carried],
                    &mut seen,
                    (index, &system, &outcome),
                );
                let strength = rule.shear.as_ref().expect("given");
                let capacity = interpolate(&strength.steady, carried)
                    + interpolate(&strength.degrading, carried);
                let due = shear.abs() / capacity.min(strength.limit);
                assert!((ratio.shear.expect("given") / due - 1.0).abs() < 1e-9);
                let [axial, _, moment] = recorded.at(bending_at);
                let carried = compression(member_capacity, axial);
                check_place(
                    member,
                    bending_at,
                    [moment, carried],
                    &mut seen,
                    (index, &system, &outcome),
                );
                let capacity = interpolate(&rule.bending[usize::from(moment < 0.0)], carried);
                // Beyond the capacity it may be less: both forces count together.
                let due = moment.abs() / capacity;
                assert!(ratio.bending <= due * (1.0 + 1e-9), "{}", member.name);
                assert!(
                    due > 1.0 || ratio.bending >= due * (1.0 - 1e-9),
                    "{}",
                    member.name
                );
            }
            // First excesses, by the governing rule and separately for both kinds.
            let ratio = member.ratio.as_ref().expect("rated");
            let shear_at = ratio.shear_at.as_ref().expect("given");
            let due = first_excesses(member_capacity, recorded);
            assert_eq!(
                [shear_at.exceeded_s, ratio.bending_at.exceeded_s],
                due,
                "{}",
                member.name
            );
            exceeded += usize::from(due.iter().any(Option::is_some));
            for (kind, at) in ["shear", "bending"].into_iter().zip(due) {
                firsts.extend(at.map(|at| (at, member.name.clone(), kind)));
            }
            for (kind, value) in [
                ("shear", ratio.shear.expect("given")),
                ("bending", ratio.bending),
            ] {
                if value > worst.0 {
                    worst = (value, member.name.clone(), kind);
                }
            }
            check_axial_failure(
                member,
                member_capacity,
                recorded,
                &outcome.peaks.floors(index),
            );
        }
        let capacity = building.capacity.as_ref().expect("rated");
        assert_eq!(capacity.exceeded, exceeded);
        assert_eq!(
            (
                capacity.worst.ratio,
                capacity.worst.member.clone(),
                capacity.worst.kind
            ),
            worst
        );
        let first = capacity.first.as_ref().expect("some exceed");
        let at = firsts
            .iter()
            .map(|(at, ..)| *at)
            .fold(f64::INFINITY, f64::min);
        let known = (first.at_s, first.member.clone(), first.kind);
        assert!(first.at_s == at && firsts.contains(&known), "{known:?}");
        for (place, at) in [(first, first.at_s), (&capacity.worst, capacity.worst.at_s)] {
            let mut members = building.members.iter();
            let member = members.find(|member| member.name == place.member);
            let member = member.expect("a member of the building");
            seen.check(
                place.impact.as_ref(),
                member,
                index,
                at,
                (&system, &outcome),
            );
        }
        // Forces of the worst instant are those recorded then.
        let instant = &outcome.worst_instants[index];
        assert_eq!(instant.ratio, worst.0);
        assert_eq!(instant.time, capacity.worst.at_s);
        for member in &building.members {
            let recorded = &histories[&member.name];
            let then = recorded.0.iter().filter(|(time, ..)| *time == instant.time);
            let then: Vec<_> = then.map(|(_, at, forces)| (*at, *forces)).collect();
            let found = member.at_worst.iter();
            let found: Vec<_> = found
                .map(|forces| {
                    (
                        forces.at,
                        [forces.axial_n, forces.shear_n, forces.moment_n_m],
                    )
                })
                .collect();
            assert_eq!(found, then, "{}", member.name);
        }
    }
    seen
}

/// The greatest compression of any section, the drift at axial failure under it, and the drift of the column's own storey.
fn check_axial_failure(
    member: &MemberSummary,
    capacity: &MemberCapacity,
    recorded: &Recorded,
    floors: &[PeaksOf<'_>],
) {
    let Some(failure) = &member.axial_failure else {
        assert!(member.name.contains("beam"), "{}", member.name);
        return;
    };
    let axial = recorded
        .0
        .iter()
        .map(|(.., [axial, ..])| compression(capacity, *axial));
    let most = axial.fold(f64::NEG_INFINITY, f64::max);
    assert!(
        (failure.compression_n - most).abs() < 1e-9 * most.abs(),
        "{}",
        member.name
    );
    let drift = 0.05 - 0.02 * (most / 1e6).clamp(0.0, 1.0);
    assert!((failure.drift / drift - 1.0).abs() < 1e-12);
    let storey: usize = member
        .name
        .rsplit('.')
        .next()
        .expect("a storey")
        .parse()
        .expect("a number");
    let due = floors[storey - 1].storey_drift() / drift;
    assert!((failure.ratio / due - 1.0).abs() < 1e-12, "{}", member.name);
}

#[test]
fn ratios_name_their_section_their_instant_and_the_impact() {
    let seen = check(&model());
    assert!(
        seen.own > 2 && seen.several > 0,
        "{} {}",
        seen.own,
        seen.several
    );
}

/// The first rule governs, although the other one gives greater ratios; and shear alone is enough.
#[test]
fn the_first_rule_governs_and_either_kind_counts() {
    let mut model = model();
    for capacity in &mut model.analysis.members.capacities {
        capacity.rules.reverse();
        for rule in &mut capacity.rules {
            let strength = if rule.rule == "second" { 0.7 } else { 0.5 };
            if let Some(shear) = &mut rule.shear {
                shear.limit *= 0.5 * strength;
            }
            rule.bending = rule.bending.each_ref().map(|line| {
                let points = line.points().iter();
                CapacityLine::new(points.map(|[n, m]| [*n, 4.0 * m]).collect())
            });
        }
    }
    let (_, _, summary) = run(&model, Solver::Riccati);
    let members = || {
        summary
            .buildings
            .iter()
            .flat_map(|building| &building.members)
    };
    let by_shear_alone = members()
        .filter_map(|member| member.ratio.as_ref())
        .filter(|ratios| ratios.bending < 1.0 && ratios.shear.is_some_and(|shear| shear > 1.0));
    assert!(by_shear_alone.count() > 2);
    assert!(
        members()
            .all(|own| own.other_ratios[0].shear > own.ratio.as_ref().and_then(|own| own.shear))
    );
    check(&model);
}

/// Forces of the worst instant are those recorded at the end of its step, also where modes give them.
#[test]
fn modal_runs_keep_the_forces_of_the_worst_step() {
    let (system, outcome, summary) = run(&model(), Solver::Modal);
    let histories = Recorded::all(&system, &outcome);
    for (index, building) in summary.buildings.iter().enumerate() {
        let worst = &outcome.worst_instants[index];
        let times = outcome.member_history.as_ref().expect("asked for").times();
        let end = times.iter().copied().find(|time| *time >= worst.time);
        assert_eq!(end, Some(worst.time));
        for member in &building.members {
            let recorded = histories[&member.name].0.iter();
            let then = recorded.filter(|(time, ..)| *time == worst.time);
            let most = |kind: usize| {
                let all = histories[&member.name].0.iter();
                all.fold(0.0_f64, |most, (.., forces)| most.max(forces[kind].abs()))
            };
            for (forces, (_, at, due)) in member.at_worst.iter().zip(then) {
                assert_eq!(forces.at, *at);
                let found = [forces.axial_n, forces.shear_n, forces.moment_n_m];
                for kind in 0..3 {
                    let off = (found[kind] - due[kind]).abs();
                    assert!(off <= 1e-9 * most(kind), "{} {at}: {off}", member.name);
                }
            }
        }
    }
}

/// Three buildings: the impacts of the others do not count for one of them.
#[test]
fn impacts_named_are_those_of_the_building() {
    for wide in [false, true] {
        let mut model = model();
        model.buildings.push(building("C", 2, 4.5, 2e8));
        let more = capacities("C", 2);
        let names = more.iter().map(|more| more.member.clone());
        model.analysis.members.histories.extend(names);
        model.analysis.members.capacities.extend(more);
        let law = model.gaps[0].law;
        model.gaps.push(Gap {
            floors: FloorPairs::Listed(vec![
                [Level::Floor(1), Level::Floor(1)],
                [Level::Floor(2), Level::Floor(2)],
            ]),
            ..Gap::after(1, 0.004, law)
        });
        if wide {
            model.gaps[0].widths = vec![2.0];
        }
        let seen = check(&model);
        assert!(
            seen.own > 2 && seen.elsewhere > 0,
            "{} {}",
            seen.own,
            seen.elsewhere
        );
    }
}
