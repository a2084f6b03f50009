//! The shapes that a set of devices can have: lists, arrays, tuples, on board and in lanes.

use precess_dynamics::kind::Kind;
use precess_dynamics::lanes::{Batch, LanedSet};
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, BuiltIn,
    BuiltInKind, Dgcmg, Dgvscmg, FlexibleReactionWheel, FlexibleVscmg, HingedPanel, Inputs,
    ReactionWheel, Scalar, Sgcmg, SloshMass, SolveError, Spacecraft, State, Vscmg,
};

use super::call_results::{CallResult, of_accelerations, of_state};
use super::case::{Case, PreparedCase, given, moved};

/// Six kinds; with [`Others`] all but those with flexible bearings.
pub type Six<T = f64> =
    (Dgvscmg<T>, Vscmg<T>, Sgcmg<T>, ReactionWheel<T>, HingedPanel<T>, SloshMass<T>);
/// The other six, in sets of sets.
pub type Others<T = f64> = (
    (BalancedDgvscmg<T>, [Dgcmg<T>; 1]),
    (BalancedVscmg<T>, BalancedSgcmg<T>),
    [(BalancedDgcmg<T>, BalancedReactionWheel<T>); 1],
);
/// Six devices of any kinds, in sets of sets.
pub type Nested<T = f64> =
    (BuiltIn<T>, [BuiltIn<T>; 2], ((BuiltIn<T>, BuiltIn<T>), [(BuiltIn<T>,); 1]));

/// The kinds of [`Six`].
pub const SIX: &[BuiltInKind] = &[
    BuiltInKind::Dgvscmg,
    BuiltInKind::Vscmg,
    BuiltInKind::Sgcmg,
    BuiltInKind::ReactionWheel,
    BuiltInKind::HingedPanel,
    BuiltInKind::SloshMass,
];
/// The kinds of [`Others`].
pub const OTHERS: &[BuiltInKind] = &[
    BuiltInKind::BalancedDgvscmg,
    BuiltInKind::Dgcmg,
    BuiltInKind::BalancedVscmg,
    BuiltInKind::BalancedSgcmg,
    BuiltInKind::BalancedDgcmg,
    BuiltInKind::BalancedReactionWheel,
];

/// A small mixed set.
pub type Three = (Sgcmg, [ReactionWheel; 1], SloshMass);

/// The kinds of [`Three`].
pub const THREE: &[BuiltInKind] =
    &[BuiltInKind::Sgcmg, BuiltInKind::ReactionWheel, BuiltInKind::SloshMass];

/// A list, in whose length spacecraft of one type may differ.
pub type Wheels = Vec<ReactionWheel>;

/// The kinds of [`Wheels`] where it is longest.
pub const RAGGED: &[BuiltInKind] = &[BuiltInKind::ReactionWheel; 4];

/// How many devices of one kind are evaluated side by side: more than four lanes have.
pub const ABREAST: usize = 5;

/// A set whose members are taken from a list, one after another.
pub trait Taken<T: Scalar>: Sized {
    /// The next members; none where the list has other kinds.
    fn taken<'a>(devices: &mut impl Iterator<Item = &'a BuiltIn<T>>) -> Option<Self>;
}

/// The whole list in another shape, if it has these kinds in this order.
#[must_use]
pub fn exactly<T: Scalar, D: Taken<T>>(devices: &[BuiltIn<T>]) -> Option<D> {
    let mut rest = devices.iter();
    D::taken(&mut rest).filter(|_| rest.next().is_none())
}

macro_rules! kinds {
    ($($kind:ident)*) => {
        $(impl<T: Scalar> Taken<T> for $kind<T> {
            fn taken<'a>(devices: &mut impl Iterator<Item = &'a BuiltIn<T>>) -> Option<Self> {
                match devices.next()? {
                    BuiltIn::$kind(device) => Some(*device),
                    _ => None,
                }
            }
        })*
    };
}

kinds! {
    ReactionWheel BalancedReactionWheel SloshMass HingedPanel Sgcmg BalancedSgcmg Vscmg
    BalancedVscmg Dgcmg BalancedDgcmg Dgvscmg BalancedDgvscmg FlexibleReactionWheel FlexibleVscmg
}

impl<T: Scalar> Taken<T> for BuiltIn<T> {
    fn taken<'a>(devices: &mut impl Iterator<Item = &'a Self>) -> Option<Self> {
        devices.next().copied()
    }
}

impl<T: Scalar, D: Taken<T>, const N: usize> Taken<T> for [D; N] {
    fn taken<'a>(devices: &mut impl Iterator<Item = &'a BuiltIn<T>>) -> Option<Self> {
        let members: Option<Vec<D>> = (0..N).map(|_| D::taken(devices)).collect();
        members?.try_into().ok()
    }
}

/// Everything that is left.
impl<T: Scalar, D: Taken<T>> Taken<T> for Vec<D> {
    fn taken<'a>(devices: &mut impl Iterator<Item = &'a BuiltIn<T>>) -> Option<Self> {
        let mut rest = devices.peekable();
        let mut members = Self::new();
        while rest.peek().is_some() {
            members.push(D::taken(&mut rest)?);
        }
        Some(members)
    }
}

macro_rules! tuples {
    ($($($member:ident)*;)*) => {$(
        impl<T: Scalar, $($member: Taken<T>),*> Taken<T> for ($($member,)*) {
            fn taken<'a>(devices: &mut impl Iterator<Item = &'a BuiltIn<T>>) -> Option<Self> {
                Some(($($member::taken(devices)?,)*))
            }
        }
    )*};
}

tuples! {
    A;
    A B;
    A B C;
    A B C D E F;
}

/// The devices as an array of `Option<BuiltIn>`; none if there are too many.
#[must_use]
pub fn on_board<T: Scalar>(devices: &[BuiltIn<T>]) -> Option<[Option<BuiltIn<T>>; 8]> {
    (devices.len() <= 8).then(|| std::array::from_fn(|index| devices.get(index).copied()))
}

trait AcrossKind: Kind<Scalar = f64, With<f64> = Self> + Taken<f64> {}

impl<K: Kind<Scalar = f64, With<f64> = Self> + Taken<f64>> AcrossKind for K {}

fn across_of<K: AcrossKind>(case: &Case) -> Option<Vec<(&'static str, CallResult)>> {
    let devices: [K; ABREAST] = exactly(&case.devices)?;
    let PreparedCase { craft, state, inputs } = case.placed(&devices).ok()?;
    let results = |side_by_side: bool| {
        let (found, next) = if side_by_side {
            (craft.accelerations(&state, &inputs), craft.step(&state, &inputs, case.dt))
        } else {
            // What is converted has no groups of devices.
            let craft = craft.with_numbers(|number| number);
            (craft.accelerations(&state, &inputs), craft.step(&state, &inputs, case.dt))
        };
        (found.map(|found| of_accelerations(&found)), next.map(|next| of_state(&next)))
    };
    let (found, next) = results(true);
    let (one_by_one, next_one_by_one) = results(false);
    Some(vec![
        ("accelerations across", found),
        ("step across", next),
        ("accelerations one after another", one_by_one),
        ("step one after another", next_one_by_one),
    ])
}

/// What devices of one kind result, side by side and one after another; none for other lists. Compiled
/// for some kinds: with and without imbalance, a motor on the wheel, a sliding joint.
#[must_use]
pub fn across(case: &Case) -> Option<Vec<(&'static str, CallResult)>> {
    across_of::<ReactionWheel>(case)
        .or_else(|| across_of::<SloshMass>(case))
        .or_else(|| across_of::<BalancedSgcmg>(case))
        .or_else(|| across_of::<Dgcmg>(case))
        .or_else(|| across_of::<Dgvscmg>(case))
}

/// What a batch makes of all states of a case, with the inputs of the first or each with its own;
/// none for lists of which no batch is compiled.
#[must_use]
pub fn batched(case: &Case, each: bool) -> Option<Batched> {
    batch_of::<[Dgvscmg; 1]>(case, each)
        .or_else(|| batch_of::<[BalancedVscmg; 1]>(case, each))
        .or_else(|| batch_of::<Three>(case, each))
}

/// What a batch makes of each state of a case.
#[derive(Clone, Debug)]
pub struct Batched {
    /// Accelerations, state by state.
    pub accelerations: Vec<CallResult>,
    /// The states after the run, and how each run ended.
    pub runs: Vec<(Vec<f64>, Result<(), SolveError>)>,
}

fn batch_of<D: LanedSet + Taken<f64>>(case: &Case, each: bool) -> Option<Batched> {
    let devices: D = exactly(&case.devices)?;
    let batch = Batch::new(&case.hub, &devices).ok()?;
    let craft = Spacecraft::new(&case.hub, &devices).ok()?;
    let all = case.all();
    let mut states: Vec<State<D>> =
        all.iter().map(|(state, _)| moved(state, State::at_rest_for(&craft))).collect();
    let inputs: Vec<Inputs<D>> = all.iter().map(|(_, inputs)| given(inputs, &craft)).collect();
    let (mut found, mut ends) = (Vec::new(), Vec::new());
    let called = if each {
        batch
            .accelerations(&states, &inputs, &mut found)
            .and_then(|()| batch.run(&mut states, &inputs, case.dt, case.steps, &mut ends))
    } else {
        batch
            .accelerations(&states, &inputs[0], &mut found)
            .and_then(|()| batch.run(&mut states, &inputs[0], case.dt, case.steps, &mut ends))
    };
    // One input for each state, and a step that is finite.
    called.ok()?;
    let accelerations =
        found.into_iter().map(|found| found.map(|found| of_accelerations(&found))).collect();
    let runs = states.iter().map(of_state).zip(ends).collect();
    Some(Batched { accelerations, runs })
}

/// Calls something with the case in every shape that its list fits, with its name. Tuples of kinds
/// are compiled for `f64`, the other shapes for every number.
macro_rules! in_every_shape {
    (@shape $case:ident |$name:ident, $placed:ident| $then:expr; $called:expr, $devices:expr) => {
        if let Some(devices) = $devices {
            let $name = $called;
            let $placed = $case.placed(&devices);
            $then
        }
    };
    (@all $case:ident $number:ty, |$name:ident, $placed:ident| $then:expr) => {
        let list = $case.devices_in::<$number>();
        in_every_shape!(@shape $case |$name, $placed| $then; "Vec<BuiltIn>", Some(list.clone()));
        in_every_shape!(@shape $case |$name, $placed| $then;
            "[Option<BuiltIn>; 8]", $crate::shapes::on_board(&list));
    };
    ($case:expr, f64, |$name:ident, $placed:ident| $then:expr) => {{
        let case: &$crate::Case = $case;
        in_every_shape!(@all case f64, |$name, $placed| $then);
        in_every_shape!(@shape case |$name, $placed| $then; "tuple of kinds",
            $crate::shapes::exactly::<f64, $crate::shapes::Six>(&case.devices));
        in_every_shape!(@shape case |$name, $placed| $then; "tuples of kinds",
            $crate::shapes::exactly::<f64, $crate::shapes::Others>(&case.devices));
        in_every_shape!(@shape case |$name, $placed| $then; "sets of sets",
            $crate::shapes::exactly::<f64, $crate::shapes::Nested>(&case.devices));
    }};
    ($case:expr, f32, |$name:ident, $placed:ident| $then:expr) => {{
        let case: &$crate::Case = $case;
        in_every_shape!(@all case f32, |$name, $placed| $then);
    }};
}

pub(crate) use in_every_shape;

/// The state with its angles wrapped.
#[must_use]
pub fn wrapped<D: precess_dynamics::Devices>(placed: &PreparedCase<D>) -> State<D> {
    placed.state.clone().wrapped(&placed.craft)
}
