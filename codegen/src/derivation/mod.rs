//! The one derivation: positions and angular velocities are stated, differentiation does the rest.
//!
//! - [`chain`]: a kind's symbols, and the hub's. Below it: `motion` outwards by the transport theorem, seen from B or
//!   from N; what is `assumed` of parameters; mass properties and wrenches, moved from origin to origin;
//!   [`chain::framed_value`], a vector or tensor with the frame it is expressed in; [`chain::parallel_axes`], where two
//!   joints' axes can be parallel;
//! - [`quantities`]: the paper's quantities of each body and of the system's centre of mass. Below it, by the same
//!   names: `angular_momenta` (20) to (76) and `motor_torques` (77) to (121);
//! - [`mod@reference`]: mass matrix and bias as sums over bodies, by plain differentiation in B, for the proofs. Below it:
//!   wrenches applied to the bodies, exerted by parent bodies, and of a field; [`reference::boltzmann_hamel`], the same
//!   once more from the kinetic energy only;
//! - [`recursions`] in local frames, each emitted by its own name: `composite` (as `first_moment` and
//!   `energy_momentum`), `axes`, `loads`, `load_derivatives`, `external`, `gravity`;
//! - [`inward_pass`]: the device's share of the mass matrix from base parameters, from the tip to the hub. Below it: base
//!   parameters, motion of the parent bodies, one joint, the first joint's origin, the last step to the hub. Emitted as
//!   `eliminate` and `constant_share`;
//! - [`elimination`]: the joints eliminated into the hub's six equations, tip first: the second half of `eliminate`;
//! - [`share`]: one device's share of the equations of motion; [`script`]: the named steps of the recursions;
//!   [`heading`]: what they compute, as data.

pub mod chain;
pub mod elimination;
pub mod heading;
pub mod inward_pass;
pub mod quantities;
pub mod recursions;
pub mod reference;
pub mod script;
pub mod share;
