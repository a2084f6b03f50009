//! From how many devices of a kind on side by side takes less time than one after another.
//!
//! Accelerations on a free hub on one core with AVX2 in registers of four, time over that of one after
//! another, devices next to each other:
//!
//! | kind | two | three | four |
//! |---|---:|---:|---:|
//! | reaction wheel | 1.05 | 0.84 | 0.6 |
//! | balanced reaction wheel | 1.14 | 0.97 | 0.8 |
//! | slosh mass | 1.22 | 1.03 | 0.8 |
//! | hinged panel | 1.03 | 0.82 | 0.66 |
//! | SGCMG | 0.99 | 0.81 | 0.63 |
//! | VSCMG | 0.97 | 0.73 | 0.58 |
//! | DGVSCMG | 0.88 | 0.64 | 0.48 |
//!
//! Registers of eight are for five devices and more. A register of two has to be full.

/// Kinds, and the fewest devices of each in registers of four.
const FEWEST: [(&str, usize); 7] = [
    ("reaction_wheel", 3),
    ("balanced_reaction_wheel", 3),
    ("slosh_mass", 4),
    ("hinged_panel", 3),
    ("sgcmg", 3),
    ("vscmg", 2),
    ("dgvscmg", 2),
];

/// The fewest devices of other kinds in registers of four: of one joint or two, and of more.
const OTHERS: [usize; 2] = [3, 2];

/// The fewest devices of a kind of so many joints that are evaluated side by side in registers of so
/// many numbers.
pub(super) fn fewest(kind: &str, joints: usize, width: usize) -> usize {
    let of_kind = FEWEST.iter().find(|(name, _)| *name == kind);
    let [short, long] = OTHERS;
    let others = if joints > 2 { long } else { short };
    of_kind.map_or(others, |(_, fewest)| *fewest).min(width)
}
