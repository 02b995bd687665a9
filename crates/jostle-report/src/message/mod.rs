//! The texts of all pages: one function per message, one table per language.
//!
//! Pages never contain a text of their own. `message::peak_force()` returns the text of that key in the language of the
//! page; a message with values, such as `"first at {instant}"`, is a function of them. A second language is another
//! [`Messages`], complete by construction, and pages are written in it within [`in_language`].
//!
//! The language belongs to the thread that writes a page: some two hundred functions write parts of pages, none of which
//! decides about it.

mod english;

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::{Display, Write};

use jostle_io::shown::{self, Shown, Units};
use maud::{Markup, PreEscaped, html};

pub use english::*;

/// Declares the messages: a function for each, the table [`Messages`] of one language, and the table in English.
///
/// A table is a list of texts, not a field for each: a function that reads a thousand fields one by one takes 80 kB.
macro_rules! messages {
    ($($key:ident $(($($value:ident),+))? = $english:literal;)+) => {
        /// Places of the texts in a table.
        #[allow(non_camel_case_types, reason = "a place is named as its message")]
        enum Place {
            $($key,)+
        }

        const KEYS: &[&str] = &[$(stringify!($key),)+];

        /// The texts of all messages in one language. Values stand in braces: `{width}`; so do units, by their SI name, and
        /// are named in the units that hold: `{kN}` is `kip` in US units.
        #[derive(Clone, Debug)]
        pub struct Messages {
            texts: [&'static str; KEYS.len()],
            /// The texts with the names of units filled in, in SI and in US units.
            with_units: [std::sync::OnceLock<Vec<String>>; 2],
        }

        /// English.
        pub static ENGLISH: Messages = Messages {
            texts: [$($english,)+],
            with_units: [const { std::sync::OnceLock::new() }; 2],
        };

        impl Messages {
            /// Key and text of every message, in the order of the table.
            #[must_use]
            pub fn all(&self) -> Vec<(&'static str, &str)> {
                let texts = self.texts().iter().map(String::as_str);
                KEYS.iter().copied().zip(texts).collect()
            }

            /// Another table: `text` of every key and English text.
            #[must_use]
            pub fn from_english(text: impl Fn(&'static str, &'static str) -> &'static str) -> Self {
                let mut texts = ENGLISH.texts;
                for (key, own) in KEYS.iter().zip(&mut texts) {
                    *own = text(key, own);
                }
                Self { texts, with_units: Default::default() }
            }

            fn texts(&self) -> &[String] {
                let units = jostle_io::shown::units();
                let fill = || {
                    let texts = self.texts.iter();
                    texts.map(|text| crate::message::name_units(text, units)).collect()
                };
                self.with_units[units as usize].get_or_init(fill)
            }

            fn text(&self, place: Place) -> &str {
                &self.texts()[place as usize]
            }
        }

        $(message!($key, $english $(, $($value),+)?);)+
    };
}

/// Declares the function of one message.
macro_rules! message {
    ($key:ident, $english:literal) => {
        #[doc = concat!("`", $english, "`")]
        #[must_use]
        pub fn $key() -> &'static str {
            crate::message::current().text(Place::$key)
        }
    };
    ($key:ident, $english:literal, $($value:ident),+) => {
        #[doc = concat!("`", $english, "`")]
        #[must_use]
        #[allow(clippy::too_many_arguments, reason = "a message has as many values as it names")]
        pub fn $key($($value: impl std::fmt::Display),+) -> String {
            crate::message::fill(crate::message::current().text(Place::$key), &[$((stringify!($value), &$value)),+])
        }
    };
}

use {message, messages};

thread_local! {
    static LANGUAGE: Cell<&'static Messages> = const { Cell::new(&ENGLISH) };
}

/// The table that pages of this thread are written in.
pub(crate) fn current() -> &'static Messages {
    LANGUAGE.get()
}

/// Returns what `write` returns; pages that it writes on this thread are in `language`.
pub fn in_language<T>(language: &'static Messages, write: impl FnOnce() -> T) -> T {
    struct Restore(&'static Messages);
    impl Drop for Restore {
        fn drop(&mut self) {
            LANGUAGE.set(self.0);
        }
    }
    let _restore = Restore(LANGUAGE.replace(language));
    write()
}

/// `text` with names of units in braces, `{kN}`, as they are called in a system of units.
fn name_units(text: &str, units: Units) -> String {
    let mut named = text.to_owned();
    for unit in shown::ALL_SHOWN.iter().filter(|_| text.contains('{')) {
        let name = format!("{{{}}}", unit.si_name());
        named = named.replace(&name, unit.name_in(units));
    }
    named
}

/// `text` with its names in braces replaced by their values. Unknown names stay as they are.
pub(crate) fn fill(text: &str, values: &[(&str, &dyn Display)]) -> String {
    let mut filled = String::with_capacity(text.len() + 16 * values.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        filled.push_str(before);
        let known = after.split_once('}').and_then(|(name, after)| {
            let (_, value) = values.iter().find(|(known, _)| *known == name)?;
            Some((value, after))
        });
        rest = if let Some((value, after)) = known {
            // Writing to a string cannot fail.
            let _ = write!(filled, "{value}");
            after
        } else {
            filled.push('{');
            after
        };
    }
    filled.push_str(rest);
    filled
}

/// The element with the texts that a script of a page asks for by `say("key")`, and that with its units, `unitOf("kN")`.
#[must_use]
pub fn for_scripts(script: &str) -> Markup {
    let known: BTreeMap<&str, &str> = current().all().into_iter().collect();
    let asked = script.split("say(\"").skip(1);
    let keys = asked.filter_map(|after| Some(after.split_once('"')?.0));
    let texts: BTreeMap<&str, &str> = keys
        .filter_map(|key| Some((key, *known.get(key)?)))
        .collect();
    let json = serde_json::json!(texts).to_string().replace('<', "\\u003c");
    let units = script.split("unitOf(\"").skip(1);
    let units = units.filter_map(|after| Shown::named(after.split_once('"')?.0));
    let units: BTreeMap<&str, serde_json::Value> = units
        .map(|unit| {
            let (name, factor) = (unit.name(), unit.of(1.0));
            let more =
                serde_json::json!({ "name": name, "factor": factor, "least": unit.decimals(0) });
            (unit.si_name(), more)
        })
        .collect();
    html! {
        script #page-messages type="application/json" { (PreEscaped(json)) }
        script #page-units type="application/json" { (PreEscaped(serde_json::json!(units).to_string())) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_replace_their_names() {
        let values: [(&str, &dyn Display); 2] = [("width", &"20 mm"), ("left", &3)];
        assert_eq!(
            fill("gap {width}, {left} left", &values),
            "gap 20 mm, 3 left"
        );
        assert_eq!(fill("{left}{width}{left}", &values), "320 mm3");
        assert_eq!(fill("{unknown} {", &values), "{unknown} {");
    }

    #[test]
    fn values_are_not_read_as_messages() {
        let values: [(&str, &dyn Display); 2] = [("name", &"{width}"), ("width", &1)];
        assert_eq!(fill("{name} {width}", &values), "{width} 1");
    }

    #[test]
    fn a_language_ends_with_its_page() {
        static SHOUTED: std::sync::LazyLock<Messages> =
            std::sync::LazyLock::new(|| Messages::from_english(|_, _| "!"));
        let inside = in_language(&SHOUTED, peak_force);
        assert_eq!((inside, peak_force()), ("!", "peak force"));
    }
}
