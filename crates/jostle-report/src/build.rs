//! Which build of jostle this is.

/// The commit that was built, if it is known: of release builds from a clone.
pub const BUILD: Option<&str> = match COMMIT.is_empty() {
    true => None,
    false => Some(COMMIT),
};

const COMMIT: &str = env!("JOSTLE_COMMIT");

/// Version and commit, for people.
#[must_use]
pub const fn version() -> &'static str {
    match COMMIT.is_empty() {
        true => env!("CARGO_PKG_VERSION"),
        false => concat!(env!("CARGO_PKG_VERSION"), " (", env!("JOSTLE_COMMIT"), ")"),
    }
}
