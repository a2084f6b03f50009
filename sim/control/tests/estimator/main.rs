//! The estimator of attitude and bias: normalised errors over seeded runs, the steady state in closed form, latency.

mod normalised_error;
mod steady_state;
mod transition;
mod truth;
