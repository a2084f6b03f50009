//! The registry: the kinds that are emitted, each with its number.
//!
//! Every list of kinds follows from it: modules and macro of the emitted code, the solver's
//! `BuiltInKind`, the pages, the measured sets of `xtask`. `codegen/tests/registry.rs` holds the
//! lists that are written by hand against it, the C enumeration among them.
//!
//! Invariant: numbers ascend, so none is given twice. A number is part of the C interface and of
//! parameter tables: a kind keeps its number, and the number of a removed kind goes to no other.

use super::{
    BALANCED_DGCMG, BALANCED_DGVSCMG, BALANCED_REACTION_WHEEL, BALANCED_SGCMG, BALANCED_VSCMG,
    DGCMG, DGVSCMG, FLEXIBLE_REACTION_WHEEL, FLEXIBLE_VSCMG, HINGED_PANEL, Kind, REACTION_WHEEL,
    SGCMG, SLOSH_MASS, VSCMG,
};

/// A kind with its number.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// `PRECESS_KIND_` of C, and the discriminant of `BuiltInKind`.
    pub number: u8,
    /// The kind.
    pub kind: &'static Kind,
}

/// Every kind that is emitted. The next one takes the number after the last.
pub const REGISTRY: [Entry; 14] = [
    Entry { number: 1, kind: &DGVSCMG },
    Entry { number: 2, kind: &BALANCED_DGVSCMG },
    Entry { number: 3, kind: &DGCMG },
    Entry { number: 4, kind: &BALANCED_DGCMG },
    Entry { number: 5, kind: &VSCMG },
    Entry { number: 6, kind: &BALANCED_VSCMG },
    Entry { number: 7, kind: &SGCMG },
    Entry { number: 8, kind: &BALANCED_SGCMG },
    Entry { number: 9, kind: &REACTION_WHEEL },
    Entry { number: 10, kind: &BALANCED_REACTION_WHEEL },
    Entry { number: 11, kind: &HINGED_PANEL },
    Entry { number: 12, kind: &SLOSH_MASS },
    Entry { number: 13, kind: &FLEXIBLE_REACTION_WHEEL },
    Entry { number: 14, kind: &FLEXIBLE_VSCMG },
];

/// The kinds of the registry.
pub const KINDS: [&Kind; REGISTRY.len()] = {
    let mut kinds = [REGISTRY[0].kind; REGISTRY.len()];
    let mut k = 1;
    while k < kinds.len() {
        assert!(REGISTRY[k - 1].number < REGISTRY[k].number, "numbers ascend");
        kinds[k] = REGISTRY[k].kind;
        k += 1;
    }
    kinds
};

impl Entry {
    /// The constant of its number in C: `PRECESS_KIND_BALANCED_VSCMG`.
    #[must_use]
    pub fn c_name(&self) -> String {
        format!("PRECESS_KIND_{}", self.kind.name.to_uppercase())
    }
}

impl Kind {
    /// The structure of its parameters: `BalancedVscmg`.
    #[must_use]
    pub fn type_name(&self) -> String {
        let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
        self.name.split('_').map(capital).collect()
    }
}
