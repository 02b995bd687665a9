//! Numbers between 0 and 1, each a function of the seed and its index only, and their transformation by
//! distributions.

mod copula;
mod joe_kuo;
mod latin_hypercube;
mod quantile;
mod sequence;
mod stream;

pub use copula::{Copula, CopulaError};
pub use latin_hypercube::LatinHypercube;
pub use quantile::quantile;
pub(crate) use quantile::{normal_cdf, normal_quantile};
pub(crate) use sequence::MOST_DIMENSIONS;
pub use sequence::SobolSequence;
pub use stream::Stream;
