//! [`Emitted`]: columns of a linearised system by the emitted derivatives of the loads, where there are.

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::by_loads::{ByLoads, HubChange};
use crate::derivatives::by_tree::ByTree;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::Variable;
use crate::equations::device::Device;
use crate::isolation::carrier::Carrier;
use crate::isolation::carrier_elimination::CarrierConstants;
use crate::model::kind::Kind;
use crate::numbers::real::Scalar;
use crate::sets::devices::{Devices, List};
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// By the devices of a hub, or by those of a tree of carriers.
#[derive(Debug)]
pub(super) enum Emitted<T> {
    OnHub(ByLoads<T>),
    OnCarriers(ByTree<T>),
}

/// Whether each device carries others.
struct Carries;

impl<T: Scalar> List<T> for Carries {
    type Item = bool;

    fn of<K: Kind<Scalar = T>>(_: &Device<K>) -> impl Iterator<Item = bool> {
        core::iter::once(false)
    }

    fn of_carrier<C: Carrier<Scalar = T>>(_: &CarrierConstants<C>) -> impl Iterator<Item = bool> {
        core::iter::once(true)
    }
}

impl<T: Scalar> Emitted<T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a flexible structure, a platform
    /// that is no carrier.
    pub(super) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Option<Self> {
        if D::list::<Carries>(&craft.devices).any(|carries| carries) {
            return ByTree::new(craft, state, inputs, accelerations).map(Self::OnCarriers);
        }
        ByLoads::new(craft, state, inputs, accelerations).map(Self::OnHub)
    }

    /// The accelerations' derivatives by one variable, those of the joints into `joints`.
    pub(super) fn column(&self, by: Variable, joints: &mut [T]) -> HubChange<T> {
        match self {
            Self::OnHub(found) => found.column(by, joints),
            Self::OnCarriers(found) => found.column(by, joints),
        }
    }
}
