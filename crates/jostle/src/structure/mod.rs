//! One building as equations: lumped masses, massless elements, and their matrices.

mod assembled_building;
mod column_ends;
mod column_points;
mod diagonals;
mod discretization;
pub(crate) mod element;
mod equations;
mod foundation;
mod frame_walls;
mod inner_link;
mod member_end;
mod member_forces;
mod order;
mod path;
mod plan_base;
mod plan_frames;
mod plan_mat;
mod plan_matrix;
mod space_frame;
mod space_joints;
mod space_member_forces;
mod spring_place;
mod step_equations;
pub(crate) mod stick_elements;
mod stick_model;
mod storey_forces;
#[cfg(test)]
pub(crate) mod testkit;
mod tiers;
mod wall_forces;

pub use assembled_building::AssembledBuilding;
pub use column_ends::FibreSection;
pub use column_points::{PointNode, StruckPoints};
pub use diagonals::FrameDiagonal;
pub use discretization::{Discretization, Mat};
pub use element::{Element, Part};
pub use equations::{Equations, YieldingSpring};
pub(crate) use foundation::Subgrade;
pub use frame_walls::InFrame;
pub use inner_link::{InnerLink, LinkEnd};
pub(crate) use member_end::{ductility, end_stiffnesses};
pub(crate) use member_forces::Motion;
pub use member_forces::{
    DiagonalForce, FrameMember, JointCore, LinearForm, MemberForces, MemberPlace, MemberSection,
    MemberSections, SectionAt,
};
pub use order::{Stage, Turn};
pub use space_frame::{Bending, CondensedFrame, CondensedJoint, CondensedMember};
pub use space_joints::{JointNodes, JointedFrame, JointedMember, JointedPart};
pub use spring_place::{BaseMotion, MemberEnd, SpringPlace};
pub use step_equations::{StepEquations, solve_once};
pub use stick_model::{
    Hinge, Influence, Member, Node, PlanBase, PlanMat, RigidEnd, RigidFoundation, Spring,
    StickModel, Support, YieldingElement,
};
pub use storey_forces::{StoreyForce, StoreyForces};
pub(crate) use tiers::motion_at;
pub(crate) use wall_forces::AtRest;
pub use wall_forces::{Coupling, CouplingForce, WallForce};
