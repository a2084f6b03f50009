//! Trackers of a rotor: what they converge to, variances against theory, what they do without excitation.

mod drag;
mod draws;
mod line;
mod rejected;
