//! Values of the joints of a set of devices of any shape, in order.
//!
//! A device has a structure with a name per joint; an array of devices has an array of them, a
//! tuple a tuple, a list a list. [`Each`] and [`JointStates`] walk all of them in one order: device
//! by device in the order of the set, in a device from the hub to the tip.

use core::fmt::Debug;

/// A value of a joint: a torque, a mode, a wrench.
pub trait Value: Copy + Debug + PartialEq + Send + Sync + 'static {}

impl<V: Copy + Debug + PartialEq + Send + Sync + 'static> Value for V {}

/// Data of a set, or of one device, with one value per joint: reads and writes all of them in
/// order.
pub trait Each<V: Value>: Clone + Debug + PartialEq + Send + Sync {
    /// The values in order.
    fn values(&self) -> impl Iterator<Item = V>;

    /// The values in order, to be changed.
    fn values_mut(&mut self) -> impl Iterator<Item = &mut V>;
}

/// Data of a set, or of one device, with a coordinate and its rate per joint, in order.
pub trait JointStates<T: Value>: Clone + Debug + PartialEq + Send + Sync {
    /// Coordinate and rate of each joint, in order.
    fn states(&self) -> impl Iterator<Item = [T; 2]>;

    /// Coordinate and rate of each joint, in order, to be changed.
    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]>;
}

/// The same with these values in order; what they leave keeps its own.
pub(crate) fn filled<V: Value, P: Each<V>>(mut of: P, values: impl IntoIterator<Item = V>) -> P {
    for (to, from) in of.values_mut().zip(values) {
        *to = from;
    }
    of
}

impl<V: Value, P: Each<V>, const N: usize> Each<V> for [P; N] {
    fn values(&self) -> impl Iterator<Item = V> {
        self.iter().flat_map(P::values)
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.iter_mut().flat_map(P::values_mut)
    }
}

impl<T: Value, J: JointStates<T>, const N: usize> JointStates<T> for [J; N] {
    fn states(&self) -> impl Iterator<Item = [T; 2]> {
        self.iter().flat_map(J::states)
    }

    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
        self.iter_mut().flat_map(J::states_mut)
    }
}

#[cfg(feature = "alloc")]
impl<V: Value, P: Each<V>> Each<V> for alloc::vec::Vec<P> {
    fn values(&self) -> impl Iterator<Item = V> {
        self.iter().flat_map(P::values)
    }

    fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.iter_mut().flat_map(P::values_mut)
    }
}

#[cfg(feature = "alloc")]
impl<T: Value, J: JointStates<T>> JointStates<T> for alloc::vec::Vec<J> {
    fn states(&self) -> impl Iterator<Item = [T; 2]> {
        self.iter().flat_map(J::states)
    }

    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
        self.iter_mut().flat_map(J::states_mut)
    }
}

macro_rules! tuples {
    ($($first:ident $($rest:ident)*;)*) => {$(
        impl<V: Value, $first: Each<V>, $($rest: Each<V>),*> Each<V> for ($first, $($rest,)*) {
            #[expect(non_snake_case, reason = "the members are called as their types")]
            fn values(&self) -> impl Iterator<Item = V> {
                let ($first, $($rest,)*) = self;
                $first.values()$(.chain($rest.values()))*
            }

            #[expect(non_snake_case, reason = "the members are called as their types")]
            fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
                let ($first, $($rest,)*) = self;
                $first.values_mut()$(.chain($rest.values_mut()))*
            }
        }

        impl<T: Value, $first: JointStates<T>, $($rest: JointStates<T>),*> JointStates<T>
            for ($first, $($rest,)*)
        {
            #[expect(non_snake_case, reason = "the members are called as their types")]
            fn states(&self) -> impl Iterator<Item = [T; 2]> {
                let ($first, $($rest,)*) = self;
                $first.states()$(.chain($rest.states()))*
            }

            #[expect(non_snake_case, reason = "the members are called as their types")]
            fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
                let ($first, $($rest,)*) = self;
                $first.states_mut()$(.chain($rest.states_mut()))*
            }
        }
    )*};
}

tuples! {
    A;
    A B;
    A B C;
    A B C D;
    A B C D E;
    A B C D E F;
    A B C D E F G;
    A B C D E F G H;
}
