//! Steering: its terms against inverse dynamics, its laws against what is known of pyramids and wheels, its servo in steps.

mod basilisk;
mod laws;
mod pyramid;
mod servo;
mod steered;
mod terms;
mod wheels;
