//! The solver in numbers. One program: its generic code, which is most of what the suites take to
//! compile, is compiled once for all of them.

mod accelerations;
mod accuracy;
mod conservation;
mod flexible_vscmg;
mod flexible_wheel;
mod imbalance;
mod input_parameters;
mod input_states;
mod invariants;
mod kinds_and_modes;
mod known_cases;
mod locked;
mod locked_gyros;
mod operations;
mod parameterisations;
mod power_balance;
mod promises;
mod reference;
mod reference_runs;
mod routes;
mod sines;
mod single_precision;
mod whole_turns;
