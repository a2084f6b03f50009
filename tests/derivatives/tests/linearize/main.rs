//! Derivatives: against differences in double-double, against what is known, and what is rejected.

mod acceleration_derivatives;
mod accuracy;
mod along;
mod by_loads;
mod columns;
mod draw;
mod figures;
mod fixed;
mod heap;
mod known;
mod outputs;
mod parameter_loads;
mod parameters;
mod perturb;
mod products;
mod rejected;
mod route;
mod step;
mod step_modes;
mod zeros;
