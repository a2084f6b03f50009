//! Results of the solver and of the Newton-Euler reference for a stored spacecraft with any number
//! of devices.

use nalgebra::Vector3;
use precess_dynamics::{About, Accelerations, Attitude, Momentum, SolveError};
use precess_tests::case::{Set, converted};
use precess_tests::double_double::DoubleDouble;
use precess_tests::stored::ATTITUDE;

use super::stored::{Blocks, Craft};

/// Accelerations by two routes; energy and momenta; all along B.
pub(crate) struct Solved {
    pub(crate) solver: Blocks,
    /// Of the Newton-Euler equations body by body, in double-double and without generated code.
    pub(crate) reference: Blocks,
    pub(crate) energy: f64,
    pub(crate) linear: Vector3<f64>,
    /// Moment of momentum about B.
    pub(crate) angular_b: Vector3<f64>,
}

impl Solved {
    pub(crate) fn new(craft: &Craft) -> Self {
        match craft.stored.devices.len() {
            1 => Self::with_devices::<1>(craft),
            2 => Self::with_devices::<2>(craft),
            3 => Self::with_devices::<3>(craft),
            4 => Self::with_devices::<4>(craft),
            n => panic!("{}: {n} devices; the file is to have 1 to 4", craft.name),
        }
    }

    fn with_devices<const N: usize>(craft: &Craft) -> Self {
        let case = craft.stored.case::<N>();
        let spacecraft = case.spacecraft(&craft.name);
        let rejected = |error: SolveError| -> ! { panic!("{}: {error}", craft.name) };
        let energy = spacecraft.energy(&case.state).unwrap_or_else(|error| rejected(error));
        // The point of N in which B is at this moment.
        let b = About::Point(case.state.r_b_n);
        let Momentum { linear, angular } =
            spacecraft.momentum(&case.state, b).unwrap_or_else(|error| rejected(error));
        let along_b = ATTITUDE.dcm();
        Self {
            solver: blocks(&case.solved(&craft.name)),
            reference: blocks(&converted(&case.converted::<DoubleDouble>().reference())),
            energy,
            linear: along_b * linear,
            angular_b: along_b * angular,
        }
    }
}

fn blocks<const N: usize>(accelerations: &Accelerations<Set<N>>) -> Blocks {
    let joints = || accelerations.devices.iter();
    [
        accelerations.r_b_n_ddot.as_slice().to_vec(),
        accelerations.omega_dot.as_slice().to_vec(),
        joints().map(|joint| joint.gamma_o_ddot).collect(),
        joints().map(|joint| joint.gamma_i_ddot).collect(),
        joints().map(|joint| joint.spin_dot).collect(),
    ]
}
