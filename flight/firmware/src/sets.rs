//! The sets of devices that are run: every kind, in two sets of several kinds; four gyros of one kind; a platform.
//!
//! A set of its own for each kind would have the same kernels, and the solver compiled three times as often.

use core::array::from_fn;

use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, FixedSet, FlexibleReactionWheel, FlexibleVscmg, HingedPanel, Isolated, ReactionWheel,
    Scalar, Sgcmg, SloshMass, Vscmg,
};

use crate::devices::{RandomDevice, isolated};
use crate::random::Random;

/// Something to do with sets of devices.
pub trait EachSet<T: Scalar> {
    /// What can go wrong.
    type Error;

    /// Called once a set, with its name, how many devices it has and how to draw one.
    ///
    /// # Errors
    /// As it likes.
    fn visit<D: FixedSet<Scalar = T>>(
        &mut self,
        name: &str,
        devices: usize,
        draw: impl Fn(&mut Random) -> D,
    ) -> Result<(), Self::Error>;
}

/// Every kind with a gimbal, one of them twice, arrays and tuples nested.
pub type Gyros<T> = (
    (Dgvscmg<T>, BalancedDgvscmg<T>),
    Dgcmg<T>,
    BalancedDgcmg<T>,
    [Vscmg<T>; 2],
    BalancedVscmg<T>,
    Sgcmg<T>,
    BalancedSgcmg<T>,
);

/// Every other kind, wheels on bearings and panels twice.
pub type WheelsAndAppendages<T> = (
    ReactionWheel<T>,
    BalancedReactionWheel<T>,
    [HingedPanel<T>; 2],
    SloshMass<T>,
    [FlexibleReactionWheel<T>; 2],
    FlexibleVscmg<T>,
);

/// A platform with wheels and a gyro, beside a device on the hub.
pub type WithPlatform<T> = (Isolated<([ReactionWheel<T>; 2], Sgcmg<T>)>, Dgvscmg<T>);

/// Shows every set to a visitor.
///
/// # Errors
/// The first of the visitor.
pub fn each_set<T: Scalar, V: EachSet<T>>(visitor: &mut V) -> Result<(), V::Error> {
    visitor.visit("dgvscmg", 4, |random| -> [Dgvscmg<T>; 4] {
        from_fn(|_| RandomDevice::drawn(random))
    })?;
    visitor.visit("gyros", 9, gyros::<T>)?;
    visitor.visit("wheels_and_appendages", 8, wheels_and_appendages::<T>)?;
    visitor.visit("isolated", 5, with_platform::<T>)
}

fn gyros<T: Scalar>(random: &mut Random) -> Gyros<T> {
    (
        (RandomDevice::drawn(random), RandomDevice::drawn(random)),
        RandomDevice::drawn(random),
        RandomDevice::drawn(random),
        from_fn(|_| RandomDevice::drawn(random)),
        RandomDevice::drawn(random),
        RandomDevice::drawn(random),
        RandomDevice::drawn(random),
    )
}

fn wheels_and_appendages<T: Scalar>(random: &mut Random) -> WheelsAndAppendages<T> {
    (
        RandomDevice::drawn(random),
        RandomDevice::drawn(random),
        from_fn(|_| RandomDevice::drawn(random)),
        RandomDevice::drawn(random),
        from_fn(|_| RandomDevice::drawn(random)),
        RandomDevice::drawn(random),
    )
}

fn with_platform<T: Scalar>(random: &mut Random) -> WithPlatform<T> {
    let carried = (from_fn(|_| RandomDevice::drawn(random)), RandomDevice::drawn(random));
    (isolated(carried, random), RandomDevice::drawn(random))
}
