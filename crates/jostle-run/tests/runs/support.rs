//! Runs of texts.

use std::ops::ControlFlow;

use jostle::Settings;
use jostle_run::{Opened, Ran};
use jostle_testkit::files::sound;

/// A run of the text of a model, with a history.
pub(crate) fn ran(text: &str) -> Ran {
    ran_with(text, Settings::default())
}

/// The same with other settings.
pub(crate) fn ran_with(text: &str, settings: Settings) -> Ran {
    let opened = Opened::new(sound(text), "model").unwrap_or_else(|error| panic!("{error}"));
    let prepared = opened.prepare().unwrap_or_else(|error| panic!("{error}"));
    prepared.run(settings, &mut |_, _| ControlFlow::Continue(()))
}
