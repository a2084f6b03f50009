//! A flexible structure, `Spacecraft`: against its kinetic energy differentiated in
//! double-double, against the rigid hub, conservation laws, closed forms.

mod accelerations;
mod conservation;
mod craft;
mod derivatives;
mod errors;
mod field;
mod known;
mod limits;
mod loads;
mod operations;
mod platform;
mod points;
mod reference;
mod residual;
mod steps;
mod stop;
mod wide;
