//! [`is_reserved`]: names that no device, platform or point may have.

/// Names of columns, vectors and groups that a result has whatever devices, points and sources a scenario has. A test of
/// the columns compares them.
pub(crate) const RESERVED_NAMES: [&str; 46] = [
    "time",
    "position_x",
    "position_y",
    "position_z",
    "position",
    "velocity_x",
    "velocity_y",
    "velocity_z",
    "velocity",
    "acceleration_x",
    "acceleration_y",
    "acceleration_z",
    "acceleration",
    "q0",
    "q1",
    "q2",
    "q3",
    "attitude",
    "sigma_1",
    "sigma_2",
    "sigma_3",
    "sigma",
    "omega_x",
    "omega_y",
    "omega_z",
    "omega",
    "omega_dot_x",
    "omega_dot_y",
    "omega_dot_z",
    "omega_dot",
    "modes.eta_1",
    "modes.eta_dot_1",
    "modes",
    "energy",
    "work",
    "energy_lost",
    "linear_momentum_x",
    "linear_momentum_y",
    "linear_momentum_z",
    "linear_momentum",
    "angular_momentum_x",
    "angular_momentum_y",
    "angular_momentum_z",
    "angular_momentum",
    "momentum",
    "loads",
];

/// Whether a name is of columns that every result has.
pub(super) fn is_reserved(name: &str) -> bool {
    RESERVED_NAMES.contains(&name)
}
