//! What cracked, yielded and buckled, each in its own words: hinges, braces, and struts of panels.

use jostle::hysteresis::{HysteresisRule, Side};
use jostle::model::{Building, Diagonal, DiagonalKind, Structure};
use jostle::results::summary::{BuildingSummary, PartSummary, SpringSummary};
use jostle::structure::SpringPlace;

use crate::{format, message};

/// Members of one kind that left the elastic range.
#[derive(Clone, Debug, PartialEq)]
pub struct Damage {
    /// What is counted, and what became of it, such as `braces buckled`.
    pub name: &'static str,
    /// Those it happened to, and all of them.
    pub count: [usize; 2],
    /// When it first happened \[s\].
    pub first_s: Option<f64>,
    /// Further numbers in words; may be empty.
    pub note: String,
}

impl Damage {
    /// The count and the name in a sentence, such as `6 of 10 braces buckled, first at 2.310 s; …`.
    #[must_use]
    pub fn sentence(&self) -> String {
        let [some, all] = self.count;
        let first = self.first_s.map(|first| format::fixed(first, 3));
        let first = first.map_or_else(String::new, message::damage_first_at);
        let note = match self.note.is_empty() {
            true => String::new(),
            false => format!("; {}", self.note),
        };
        format!(
            "{} {}{first}{note}",
            message::one_of_all(some, all),
            self.name
        )
    }
}

/// Damage of a building by kind; empty if nothing in it can yield. Without its model all counts are those of hinges.
#[must_use]
pub fn damage(model: Option<&Building>, summary: &BuildingSummary) -> Vec<Damage> {
    let hinges = &summary.hinges;
    let braces = model.map_or(0, yielding_braces);
    let is_brace = |spring: &&SpringSummary| spring.is_brace();
    let mut found = Vec::new();
    if hinges.total > braces {
        let is_hinge = |spring: &&SpringSummary| !is_brace(spring);
        let list = || hinges.list.iter().filter(is_hinge);
        let yields = || list().filter_map(|hinge| hinge.yielded_s);
        let (cracked, yielded, first_s) = if braces == 0 {
            (hinges.cracked, hinges.yielded, hinges.first_yield_s)
        } else {
            let cracked = list().filter(|hinge| hinge.cracked_s.is_some()).count();
            (cracked, yields().count(), yields().min_by(f64::total_cmp))
        };
        let ductility = hinges.ductility;
        found.push(Damage {
            name: yielded_word(&list().filter_map(|hinge| hinge.at).collect::<Vec<_>>()),
            count: [yielded, hinges.total - braces],
            first_s,
            note: match (hinges.without_cracking, cracked) {
                (true, 0) => String::new(),
                (true, _) => message::ductility_of(format::significant(ductility, 2)),
                (false, 0) => message::count_cracked(0),
                (false, _) => {
                    message::cracked_ductility(cracked, format::significant(ductility, 2))
                }
            },
        });
    }
    if braces > 0 {
        let buckled = summary.parts.iter().filter_map(|part| part.buckled_s);
        let yielded = hinges.list.iter().filter(is_brace);
        let yielded = yielded.filter_map(|hinge| hinge.yielded_s);
        let (name, times): (_, Vec<f64>) = match buckles(model) {
            true => (message::braces_buckled(), buckled.collect()),
            false => (message::braces_yielded(), yielded.collect()),
        };
        found.push(Damage {
            name,
            count: [times.len(), braces],
            first_s: times.into_iter().min_by(f64::total_cmp),
            note: String::new(),
        });
    }
    found.extend(model.and_then(|model| struts(model, summary)));
    found
}

/// A footing in words: of `Tower.footing` "footing of Tower", of `Tower.footing.2` "footing 2 of Tower".
#[must_use]
pub fn footing_name(name: &str) -> String {
    match name.rsplit_once(".footing") {
        Some((building, "")) => message::footing_of(building),
        Some((building, line)) => message::footing_of_line(line.trim_start_matches('.'), building),
        None => name.to_owned(),
    }
}

/// What yielded apart from braces, in words of its places.
fn yielded_word(places: &[SpringPlace]) -> &'static str {
    let is_storey = |at: &SpringPlace| {
        use SpringPlace::{PlanStorey, Storey};
        matches!(at, Storey { .. } | PlanStorey { .. })
    };
    match places {
        [] => message::hinges_yielded_word(),
        all if all.iter().all(is_storey) => message::storeys_yielded_word(),
        _ => message::hinges_yielded_word(),
    }
}

/// Number of braces of a building that can yield.
fn yielding_braces(model: &Building) -> usize {
    let yields = |diagonal: &&Diagonal| {
        diagonal.place.kind == DiagonalKind::Brace && diagonal.hysteresis.is_some()
    };
    diagonals(model).iter().filter(yields).count()
}

/// Whether the braces of a building buckle; otherwise they yield in either sense.
fn buckles(model: Option<&Building>) -> bool {
    let buckling = |diagonal: &Diagonal| {
        let rule = diagonal.hysteresis.map(|hysteresis| hysteresis.rule());
        matches!(rule, Some(HysteresisRule::Buckling(_)))
    };
    model.is_some_and(|model| diagonals(model).iter().any(buckling))
}

/// Braces and struts of a building, frame after frame.
fn diagonals(model: &Building) -> Vec<Diagonal> {
    match &model.structure {
        Structure::Frame(frame) => frame.diagonals.clone(),
        Structure::Tiers(tiers) => {
            let of_frames = tiers.frames.iter().flat_map(|frame| &frame.frame.diagonals);
            let in_space = tiers
                .space_frame
                .iter()
                .flat_map(|space_frame| &space_frame.diagonals);
            of_frames.chain(in_space).copied().collect()
        }
        _ => Vec::new(),
    }
}

/// Struts of panels, by the corners that their greatest compression has passed: `None` for those without a strength, 0 to 2.
pub(crate) fn strut_stages(model: &Building, summary: &BuildingSummary) -> Vec<Option<u8>> {
    let mut struts = diagonals(model);
    struts.retain(|diagonal| diagonal.place.kind == DiagonalKind::Infill);
    let parts = summary.parts.iter().filter(|part| part.kind == "infill");
    let stage = |(strut, part): (&Diagonal, &PartSummary)| {
        let law = strut.hysteresis?;
        // Those that bear compression alone, without a strength, have no corner.
        if matches!(law.rule(), HysteresisRule::Stop { .. }) {
            return None;
        }
        let curve = *law.backbone().side(Side::Negative);
        let corners = [curve.cracking, curve.yielding].into_iter();
        let passed = corners.filter(|corner| part.deformation_min >= corner.deformation);
        Some(passed.count() as u8)
    };
    struts.iter().zip(parts).map(stage).collect()
}

fn struts(model: &Building, summary: &BuildingSummary) -> Option<Damage> {
    let stages: Vec<u8> = strut_stages(model, summary).into_iter().flatten().collect();
    let passed = |least: u8| stages.iter().filter(|stage| **stage >= least).count();
    (!stages.is_empty()).then(|| Damage {
        name: message::struts_cracked(),
        count: [passed(1), stages.len()],
        first_s: None,
        note: message::crushed_of_struts(passed(2)),
    })
}
