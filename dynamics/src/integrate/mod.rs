//! From one state to the next: the fourth-order Runge-Kutta step, and the impulsive stop.
//!
//! Both evaluate through [`solve`](crate::solve).

pub(crate) mod energy_lost;
pub(crate) mod joint_stages;
pub(crate) mod longest_step;
pub(crate) mod rk4;
pub(crate) mod stability;
pub(crate) mod stop;
pub(crate) mod structure;
