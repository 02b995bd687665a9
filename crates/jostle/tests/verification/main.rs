//! Do we solve the equations right? Each file is named after what it claims.

mod a_row_of_three_buildings;
mod bad_models_are_refused;
mod base_gravity_and_shifted_equilibrium;
mod contact_laws;
mod corners;
mod direct_runs_refine_their_steps;
mod energy_balances;
mod extremes_are_survived;
mod forces_never_pull;
mod given_structures;
mod linked_modal_stepping;
mod links_and_walls;
mod mirrored_model_mirrors_the_answer;
mod modal_stepping;
mod monolith;
mod newmark_is_second_order;
mod no_impact_is_lost_or_counted_twice;
mod riccati_equals_direct_stiffness;
mod rows_of_buildings;
mod same_input_same_bits;
mod space;
mod storey_forces;
mod support;
mod total_force_of_a_gap;
mod wide_gap_leaves_buildings_independent;
mod yielding_frames;
