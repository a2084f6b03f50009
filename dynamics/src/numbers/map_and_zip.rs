//! [`map_and_zip`](crate::map_and_zip): records changed and joined number by number, whatever the numbers are.

/// Writes `map` and `zip` of a record with one type of numbers: each number changed, and two records joined
/// number by number. What is emitted calls it, here and in crates with kinds of their own.
///
/// ```
/// struct Pair<T> {
///     x: T,
///     y: T,
/// }
///
/// precess_dynamics::map_and_zip!(Pair<T: Copy> { x, y });
///
/// let sum = Pair { x: 1.0, y: 2.0 }.zip(&Pair { x: 0.5, y: 0.5 }, |a, b| a + b).map(f64::sqrt);
/// assert_eq!([sum.x, sum.y], [1.5_f64.sqrt(), 2.5_f64.sqrt()]);
/// ```
#[macro_export]
macro_rules! map_and_zip {
    ($record:ident<$number:ident: $bound:ident> { $($field:ident),* $(,)? }) => {
        impl<$number: $bound> $record<$number> {
            /// The record with each of its numbers changed.
            #[inline(always)]
            #[must_use]
            pub fn map<U: Copy>(&self, mut change: impl FnMut($number) -> U) -> $record<U> {
                self.zip(self, |number, _| change(number))
            }

            /// Two records joined number by number.
            #[inline(always)]
            #[must_use]
            pub fn zip<U: Copy, W>(
                &self,
                other: &$record<U>,
                mut join: impl FnMut($number, U) -> W,
            ) -> $record<W> {
                $record { $($field: join(self.$field, other.$field)),* }
            }
        }
    };
}
