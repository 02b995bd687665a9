//! The mechanics, by what is tested.

mod column_capacity_by_hand;
mod hysteresis;
mod joint_shear;
mod kinds;
mod layers;
mod member_cost;
mod member_forces;
mod member_ratios;
mod modal;
mod peaks;
mod rows;
mod statics;
mod stepping_allocates_nothing;
mod transfer;
mod verification;
