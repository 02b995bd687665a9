//! Which build of jostle this is.

/// The commit that was built, if it is known: of release builds from a clone.
pub const BUILD: Option<&str> = match COMMIT.is_empty() {
    true => None,
    false => Some(COMMIT),
};

const COMMIT: &str = env!("JOSTLE_COMMIT");

/// Version and commit, for people.
#[must_use]
pub fn version() -> String {
    match BUILD {
        Some(commit) => format!("{} ({commit})", env!("CARGO_PKG_VERSION")),
        None => env!("CARGO_PKG_VERSION").to_owned(),
    }
}
