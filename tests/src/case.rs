//! One spacecraft in one state under known forces, in any scalar.

mod conversion;

use core::fmt::Display;

use precess_dynamics::{Accelerations, Dgvscmg, Hub, Inputs, Scalar, Spacecraft, State};

pub use conversion::converted;

/// Why references have a result.
pub(crate) const REGULAR: &str = "the mass matrix of a spacecraft with massive bodies is regular";

/// The set of devices that the references know: `N` of the paper's.
pub type Set<const N: usize, T = f64> = [Dgvscmg<T>; N];

/// Parameters, state and inputs, as solver and references take them.
///
/// The references know a free hub without gravity, and driven joints without springs or friction:
/// with other inputs and parameters their results differ from the solver's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case<const N: usize, T: Scalar = f64> {
    /// The hub.
    pub hub: Hub<T>,
    /// The devices.
    pub devices: Set<N, T>,
    /// The state.
    pub state: State<Set<N, T>>,
    /// Force, torque and motor torques.
    pub inputs: Inputs<Set<N, T>>,
}

impl<const N: usize, T: Scalar> Case<N, T> {
    /// The same numbers in another scalar: exact where `U` is the wider one.
    #[must_use]
    pub fn converted<U: Scalar>(&self) -> Case<N, U> {
        conversion::case(self)
    }

    /// The spacecraft, prepared.
    ///
    /// # Panics
    ///
    /// If the solver rejects the parameters, saying whose they are: a seed or a scenario.
    #[must_use]
    pub fn spacecraft(&self, whose: impl Display) -> Spacecraft<Set<N, T>> {
        Spacecraft::new(&self.hub, &self.devices).unwrap_or_else(|error| panic!("{whose}: {error}"))
    }

    /// The solver's accelerations.
    ///
    /// # Panics
    ///
    /// If the solver gives an error, naming the case: a seed or a scenario.
    #[must_use]
    pub fn solved(&self, whose: impl Display) -> Accelerations<Set<N, T>> {
        self.spacecraft(&whose)
            .accelerations(&self.state, &self.inputs)
            .unwrap_or_else(|error| panic!("{whose}: {error}"))
    }
}
