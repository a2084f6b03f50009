//! The sets of devices that are run: each kind by itself, several of a kind, several kinds
//! together.

use core::array::from_fn;

use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, FixedSet, HingedPanel, ReactionWheel, Scalar, Sgcmg, SloshMass, Vscmg,
};

use crate::devices::Drawn;
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

/// Shows every set to a visitor.
///
/// # Errors
/// The first of the visitor.
pub fn each_set<T: Scalar, V: EachSet<T>>(visitor: &mut V) -> Result<(), V::Error> {
    single::<Dgvscmg<T>, V>(visitor)?;
    single::<BalancedDgvscmg<T>, V>(visitor)?;
    single::<Dgcmg<T>, V>(visitor)?;
    single::<BalancedDgcmg<T>, V>(visitor)?;
    single::<Vscmg<T>, V>(visitor)?;
    single::<BalancedVscmg<T>, V>(visitor)?;
    single::<Sgcmg<T>, V>(visitor)?;
    single::<BalancedSgcmg<T>, V>(visitor)?;
    single::<ReactionWheel<T>, V>(visitor)?;
    single::<BalancedReactionWheel<T>, V>(visitor)?;
    single::<HingedPanel<T>, V>(visitor)?;
    single::<SloshMass<T>, V>(visitor)?;
    visitor
        .visit("dgvscmg", 4, |random| -> [Dgvscmg<T>; 4] { from_fn(|_| Drawn::drawn(random)) })?;
    visitor.visit("mixed", 7, mixed::<T>)
}

fn single<K: Drawn, V: EachSet<K::Scalar>>(visitor: &mut V) -> Result<(), V::Error> {
    visitor.visit(K::NAME, 1, |random| [K::drawn(random)])
}

fn mixed<T: Scalar>(random: &mut Random) -> Mixed<T> {
    (
        from_fn(|_| Drawn::drawn(random)),
        Drawn::drawn(random),
        (Drawn::drawn(random), Drawn::drawn(random)),
        from_fn(|_| Drawn::drawn(random)),
        Drawn::drawn(random),
    )
}
