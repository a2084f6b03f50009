//! The same with carriers and flexible structures, and under wrenches on bodies, in a central field and with lumped
//! imbalance.

pub(crate) mod applied_columns;
pub(crate) mod base_motion;
pub(crate) mod by_tree;
pub(crate) mod changes;
pub(crate) mod device_loads;
pub(crate) mod field_columns;
pub(crate) mod mass_matrix;
pub(crate) mod members;
pub(crate) mod modal_columns;
pub(crate) mod system;
pub(crate) mod variables;
