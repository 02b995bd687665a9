//! The report page: one HTML file, offline, animated.
