//! The sets of devices that are run: each kind by itself, several of a kind, several kinds
//! together.

use core::array::from_fn;

use precess_dynamics::{
    BalancedVscmg, Dgvscmg, FixedSet, HingedPanel, Isolated, ReactionWheel, Scalar, Sgcmg,
    SloshMass,
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

/// Kinds together, some of them twice, arrays and tuples nested.
pub type Mixed<T> = (
    [ReactionWheel<T>; 2],
    Sgcmg<T>,
    (Dgvscmg<T>, BalancedVscmg<T>),
    [HingedPanel<T>; 2],
    SloshMass<T>,
);

/// A platform with wheels and a gyro, beside a device on the hub.
pub type WithPlatform<T> = (Isolated<([ReactionWheel<T>; 2], Sgcmg<T>)>, Dgvscmg<T>);

/// Shows every set to a visitor.
///
/// # Errors
/// The first of the visitor.
pub fn each_set<T: Scalar, V: EachSet<T>>(visitor: &mut V) -> Result<(), V::Error> {
    macro_rules! each {
        ($($kind:ident $module:ident $number:literal;)*) => {
            $(single::<precess_dynamics::$kind<T>, V>(visitor)?;)*
        };
    }
    precess_dynamics::every_kind!(each);
    visitor.visit("dgvscmg", 4, |random| -> [Dgvscmg<T>; 4] {
        from_fn(|_| RandomDevice::drawn(random))
    })?;
    visitor.visit("mixed", 7, mixed::<T>)?;
    visitor.visit("isolated", 5, with_platform::<T>)
}

fn single<K: RandomDevice, V: EachSet<K::Scalar>>(visitor: &mut V) -> Result<(), V::Error> {
    visitor.visit(K::NAME, 1, |random| [K::drawn(random)])
}

fn mixed<T: Scalar>(random: &mut Random) -> Mixed<T> {
    (
        from_fn(|_| RandomDevice::drawn(random)),
        RandomDevice::drawn(random),
        (RandomDevice::drawn(random), RandomDevice::drawn(random)),
        from_fn(|_| RandomDevice::drawn(random)),
        RandomDevice::drawn(random),
    )
}

fn with_platform<T: Scalar>(random: &mut Random) -> WithPlatform<T> {
    let carried = (from_fn(|_| RandomDevice::drawn(random)), RandomDevice::drawn(random));
    (isolated(carried, random), RandomDevice::drawn(random))
}
