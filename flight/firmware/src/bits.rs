//! Numbers as bit patterns: what is compared between machines is never rounded to be printed.

use core::fmt::{self, Write};

use precess_dynamics::Scalar;

/// A number with a bit pattern.
pub trait Bits: Scalar {
    /// Hexadecimal digits of the pattern.
    const DIGITS: usize;

    /// The pattern, in the low bits.
    fn pattern(self) -> u64;

    /// The number with the next pattern: one unit in the last place away from zero.
    #[must_use]
    fn next(self) -> Self;
}

impl Bits for f64 {
    const DIGITS: usize = 16;

    fn pattern(self) -> u64 {
        self.to_bits()
    }

    fn next(self) -> Self {
        Self::from_bits(self.to_bits().wrapping_add(1))
    }
}

impl Bits for f32 {
    const DIGITS: usize = 8;

    fn pattern(self) -> u64 {
        u64::from(self.to_bits())
    }

    fn next(self) -> Self {
        Self::from_bits(self.to_bits().wrapping_add(1))
    }
}

/// A running hash of bit patterns: FNV-1a of 64 bits, over bytes from the lowest, so that the order
/// in which a machine stores them does not matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hash(pub u64);

impl Hash {
    /// Of nothing yet.
    pub const EMPTY: Self = Self(0xCBF2_9CE4_8422_2325);

    /// Takes a number in.
    pub fn take<T: Bits>(&mut self, number: T) {
        for byte in number.pattern().to_le_bytes().into_iter().take(T::DIGITS / 2) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }
}

/// Writes a space and the pattern.
pub(crate) fn write<T: Bits>(out: &mut dyn Write, number: T) -> fmt::Result {
    write!(out, " {:0digits$x}", number.pattern(), digits = T::DIGITS)
}

#[cfg(test)]
mod tests {
    use super::{Bits, Hash};

    #[test]
    fn hash_is_fnv_1a() {
        // The published hash of the byte 0x61, "a", here followed by zeros hashed by hand.
        let mut hash = Hash::EMPTY;
        hash.take(f32::from_bits(0x61));
        let expected = [0x61_u64, 0, 0, 0].iter().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
            (hash ^ byte).wrapping_mul(0x0000_0100_0000_01B3)
        });
        assert_eq!(hash.0, expected);
        assert_eq!(1.0_f64.pattern(), 0x3ff0_0000_0000_0000);
    }
}
