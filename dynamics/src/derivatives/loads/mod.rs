//! Derivatives of accelerations of devices on a rigid hub in a uniform field, by the emitted derivatives of the loads
//! and the mass matrix.

#[cfg(feature = "alloc")]
pub(crate) mod by_joints;
pub(crate) mod by_loads;
#[cfg(feature = "lanes")]
mod columns_of_group;
pub(crate) mod device_reduction;
#[cfg(feature = "alloc")]
pub(crate) mod each_device;
pub(crate) mod fixed_columns;
pub(crate) mod joint_elimination;
pub(crate) mod kernel;
#[cfg(feature = "lanes")]
pub(crate) mod kernel_in_lanes;
pub(crate) mod kernel_loads;
pub(crate) mod load_columns;
#[cfg(all(test, feature = "lanes"))]
mod load_columns_tests;
pub(crate) mod mass_system;
#[cfg(feature = "alloc")]
pub(crate) mod row_product;
pub(crate) mod side_by_side;
