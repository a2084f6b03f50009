//! A flexible structure, with wheels on two mounts, drawn at random: modes in arrays, without a heap.

use core::array::from_fn;

use nalgebra::Vector3;
use precess_dynamics::{
    FixedModes, Flexible, Hub, Inputs, ModalMount, ModalPoint, ModalState, Modes, ModesError,
    Quaternion, ReactionWheel, Scalar, Spacecraft, State,
};

use crate::craft::{Craft, HubModes};
use crate::devices::RandomDevice;
use crate::random::Random;

/// Modes of the structure.
const MODES: usize = 4;

/// Mounts, with a wheel on each.
const MOUNTS: usize = 2;

/// The devices.
pub type Wheels<T> = [ReactionWheel<T>; MOUNTS];

/// Where the modes are kept.
pub type Storage = FixedModes<MODES, MOUNTS>;

/// A spacecraft with a flexible structure, its state and what acts on it.
#[derive(Clone, Debug)]
pub struct Structure<T: Scalar> {
    /// The spacecraft.
    pub craft: Spacecraft<Wheels<T>, Flexible<Storage>>,
    /// Its state.
    pub state: State<Wheels<T>, Quaternion<T>, Flexible<Storage>>,
    /// What acts on it.
    pub inputs: Inputs<Wheels<T>, Flexible<Storage>>,
}

impl<T: Scalar> Structure<T> {
    /// The next structure; its rigid motion and inputs are those of a rigid [`Craft`].
    ///
    /// # Errors
    /// As [`Spacecraft::flexible`].
    pub fn drawn(random: &mut Random) -> Result<Self, ModesError<T>> {
        let devices: Wheels<T> = from_fn(|_| RandomDevice::drawn(random));
        let rigid = Craft::drawn(&devices, HubModes::Free, random).map_err(ModesError::Rigid)?;
        let mass = random.within(200.0, 1000.0);
        let hub =
            Hub { m_b: T::from_f64(mass), r_bc_b: random.vector(0.2), i_b_bc: random.block(mass) };
        let craft = Spacecraft::flexible(&hub, &modes(random), &devices, &[0, 1])?;
        let state = rigid.state.with_modal(ModalState {
            eta: from_fn(|_| random.number(-0.02, 0.02)),
            eta_dot: from_fn(|_| random.number(-0.1, 0.1)),
        });
        let mut inputs: Inputs<_, Flexible<Storage>> =
            rigid.inputs.with_modal(Inputs::none_for(&craft).modal);
        inputs.modal.forces = from_fn(|_| random.number(-0.1, 0.1));
        Ok(Self { craft, state, inputs })
    }
}

/// Frequencies that a millisecond resolves, shapes of some hundredths.
fn modes<T: Scalar>(random: &mut Random) -> Modes<Storage, T> {
    let vectors = |size: f64, random: &mut Random| -> [Vector3<T>; MODES] {
        from_fn(|_| random.vector(size))
    };
    Modes {
        frequencies: from_fn(|_| random.number(5.0, 60.0)),
        damping: from_fn(|_| random.number(1e-3, 2e-2)),
        linear: vectors(0.5, random),
        angular: vectors(0.5, random),
        mounts: from_fn(|_| ModalMount {
            point: ModalPoint {
                position: random.vector(0.8),
                translation: vectors(0.05, random),
                rotation: vectors(0.05, random),
            },
            contained: None,
        }),
    }
}
