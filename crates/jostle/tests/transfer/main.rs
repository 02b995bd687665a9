//! Do products of transfer matrices and the Riccati recursions agree, and where do they part?

mod four_ways_one_answer;
mod support;
