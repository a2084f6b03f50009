//! [`Emitted`]: columns of a linearised system by the emitted derivatives of the loads, where there are.

use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::loads::by_joints::Both;
use crate::derivatives::loads::by_loads::ByLoads;
use crate::derivatives::loads::load_columns::LoadsWorkspace;
use crate::derivatives::slopes::Slopes;
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::tree::by_tree::ByTree;
use crate::derivatives::variable::Variable;
use crate::numbers::real::Scalar;
use crate::sets::devices::Devices;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// By the devices of a hub with nothing but a uniform field, or by those of a tree of carriers under whatever acts.
#[derive(Debug)]
pub(crate) enum Emitted<'a, T> {
    OnHub(ByLoads<'a, T>),
    OfTree(ByTree<T>),
}

impl<'a, T: Scalar> Emitted<'a, T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a platform that is no
    /// carrier.
    pub(crate) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        workspace: &'a mut LoadsWorkspace<T>,
    ) -> Option<Self> {
        let on_hub = ByLoads::new(craft, state, inputs, accelerations, workspace).map(Self::OnHub);
        on_hub.or_else(|| ByTree::new(craft, state, inputs, accelerations).map(Self::OfTree))
    }

    /// All four matrices by all states and inputs, whole; false where that has to be done column by column.
    pub(crate) fn fill_matrices(&self, slopes: &Slopes<'_, T>, into: [Both<'_, T>; 2]) -> bool {
        match self {
            Self::OnHub(found) => found.fill_matrices(slopes, into),
            Self::OfTree(_) => false,
        }
    }

    /// Those of the accelerations by all states and by all inputs, whole; false where that has to be done column by column.
    pub(crate) fn fill_accelerations(
        &self,
        slopes: &Slopes<'_, T>,
        into: [&mut DMatrix<T>; 2],
    ) -> bool {
        match self {
            Self::OnHub(found) => found.fill_accelerations(slopes, into),
            Self::OfTree(_) => false,
        }
    }

    /// The accelerations' derivatives by these variables into the columns of a matrix; the first of the variables of which
    /// one is not finite.
    pub(crate) fn columns(
        &self,
        variables: &[Variable],
        into: &mut DMatrix<T>,
    ) -> Result<(), usize> {
        match self {
            Self::OnHub(found) => found.columns(variables, into),
            Self::OfTree(found) => found.columns(variables, into),
        }
    }
}
