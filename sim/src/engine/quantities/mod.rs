//! What is computed of a state: the numbers of a sample, the loads of members, and the drift of conserved quantities.

mod control;
pub(super) mod drift;
pub(super) mod joint_torques;
pub(super) mod member_loads;
pub(super) mod sample_values;
