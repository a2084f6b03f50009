//! [`Passes`]: which passes over the chain, and over the functions, the derivation makes.

/// Which passes are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passes {
    /// Slide origins along their axes.
    pub slide: bool,
    /// Regroup to the parent body.
    pub regroup: bool,
    /// Take common factors out of the functions' sums.
    pub factor: bool,
}

impl Passes {
    /// What is emitted.
    pub const ALL: Self = Self { factor: true, ..Self::CHAIN };
    /// Both passes over the chain.
    pub const CHAIN: Self = Self { slide: true, regroup: true, factor: false };
    /// Bodies, origins and sums as they are given.
    pub const NONE: Self = Self { slide: false, regroup: false, factor: false };
    /// Each by itself, those over the chain together, and all.
    pub const EACH: [Self; 6] = [
        Self::NONE,
        Self { slide: true, ..Self::NONE },
        Self { regroup: true, ..Self::NONE },
        Self::CHAIN,
        Self { factor: true, ..Self::NONE },
        Self::ALL,
    ];
}
