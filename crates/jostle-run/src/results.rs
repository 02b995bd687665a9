//! The results from which the files of a run are written.

use jostle::method::MethodSurvey;
use jostle::{History, Outcome, RunEnd, Summary};
use jostle_io::Input;
use jostle_io::shown::by_model;
use jostle_report::{Page, ReinforcedSection};

use crate::contact_advice::contact_boxes;
use crate::prepared::Prepared;

/// A run in the form that its files are written from.
#[derive(Clone, Copy)]
pub struct Results<'a> {
    /// What was run.
    pub prepared: &'a Prepared,
    /// Results of the run; histories may have been moved out of it.
    pub outcome: &'a Outcome,
    /// Its numbers.
    pub summary: &'a Summary,
    /// Its histories, if they were recorded.
    pub history: Option<&'a History>,
    /// Those of the run without contact, if it was made and came to its end.
    pub without_contact: Option<&'a History>,
    /// Surveys of the method for the report; usually none.
    pub methods: &'a [MethodSurvey],
}

impl<'a> Results<'a> {
    /// The histories of a run without contact that a report can compare with.
    #[must_use]
    pub fn comparable(without_contact: &'a Outcome) -> Option<&'a History> {
        let history = without_contact.history.as_ref();
        history.filter(|_| without_contact.end == RunEnd::Completed)
    }

    /// The report as one HTML page; `None` without histories.
    #[must_use]
    pub fn report(&self) -> Option<String> {
        self.with_page(jostle_report::render)
    }

    /// Hands what a report shows to a function; `None` without histories.
    pub fn with_page<T>(&self, show: impl FnOnce(&Page<'_>) -> T) -> Option<T> {
        let history = self.history?;
        let sections = reinforced(&self.prepared.input);
        let calculation = self.prepared.calculation();
        let contacts = contact_boxes(
            &self.prepared.input.model,
            &self.prepared.input.stated,
            &self.prepared.system,
            self.summary,
        );
        let page = Page {
            model: &self.prepared.input.model,
            system: &self.prepared.system,
            motion: &self.prepared.motion,
            summary: self.summary,
            history,
            without_contact: self.without_contact,
            springs: self.outcome.spring_history.as_ref(),
            sections: &sections,
            codes: &self.prepared.input.codes,
            north: self.prepared.input.north,
            contacts: &contacts,
            methods: self.methods,
            calculation: Some(&calculation),
        };
        let asked = self.prepared.input.units;
        Some(by_model(asked, || show(&page)))
    }
}

/// Reinforced sections of a model; members with the same section share one.
fn reinforced(input: &Input) -> Vec<ReinforcedSection<'_>> {
    let mut sections: Vec<ReinforcedSection<'_>> = Vec::new();
    for member in &input.members.reinforced {
        let alike = sections.iter_mut().find(|known| {
            known.building == member.building
                && known.member == member.member
                && *known.section == member.section
        });
        match alike {
            Some(known) => known.add(&member.name, member.floor, member.compression),
            None => sections.push(ReinforcedSection {
                building: member.building,
                member: member.member,
                section: &member.section,
                members: vec![&member.name],
                floors: [member.floor; 2],
                compression: [member.compression; 2],
            }),
        }
    }
    sections
}
