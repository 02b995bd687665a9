//! The reference against numbers known otherwise.
