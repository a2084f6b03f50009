//! From how many devices of a kind on side by side takes less time than one after another, and from how many
//! on registers of eight than a group of four and the rest.
//!
//! Accelerations on a free hub on one core, devices next to each other: in registers of four (AVX2) over one
//! after another, in registers of eight (AVX-512) over a group of four and the rest:
//!
//! | kind | two | three | four | five in eight | six | seven |
//! |---|---:|---:|---:|---:|---:|---:|
//! | reaction wheel | 1.05 | 0.84 | 0.6 | 1.08 | 0.87 | 0.87 |
//! | balanced reaction wheel | 1.14 | 0.97 | 0.8 | 1.20 | 1.07 | 0.98 |
//! | slosh mass | 1.22 | 1.03 | 0.8 | 1.23 | 1.07 | 0.95 |
//! | hinged panel | 1.03 | 0.82 | 0.66 | 1.05 | 0.85 | 0.86 |
//! | SGCMG | 0.99 | 0.81 | 0.63 | 0.98 | 0.82 | 0.85 |
//! | VSCMG | 0.97 | 0.73 | 0.58 | 0.98 | 0.85 | 0.85 |
//! | DGVSCMG | 0.88 | 0.64 | 0.48 | 0.92 | 0.78 | 0.79 |
//!
//! A register of two has to be full.

/// How many numbers the registers of AVX2 hold: more devices need wider ones.
const FOUR: usize = 4;

/// Kinds, and the fewest devices of each in registers of four and of eight.
const FEWEST: [(&str, [usize; 2]); 7] = [
    ("reaction_wheel", [3, 6]),
    ("balanced_reaction_wheel", [3, 7]),
    ("slosh_mass", [4, 7]),
    ("hinged_panel", [3, 6]),
    ("sgcmg", [3, 5]),
    ("vscmg", [2, 5]),
    ("dgvscmg", [2, 5]),
];

/// The fewest devices of other kinds: of one joint, of two, and of more.
const OTHERS: [[usize; 2]; 3] = [[3, 6], [3, 5], [2, 5]];

/// How many of so many devices of a kind, of so many joints, are evaluated side by side where the widest
/// registers hold `widest` numbers; none if one after another takes less time.
pub(super) fn side_by_side(
    kind: &str,
    joints: usize,
    devices: usize,
    widest: usize,
) -> Option<usize> {
    let of_kind = FEWEST.iter().find(|(name, _)| *name == kind);
    let [of_one, of_two, of_more] = OTHERS;
    let others = match joints {
        0 | 1 => of_one,
        2 => of_two,
        _ => of_more,
    };
    let [in_four, in_eight] = of_kind.map_or(others, |(_, fewest)| *fewest);
    match devices.min(widest) {
        many if many > FOUR && many < in_eight => Some(FOUR),
        many if many >= in_four.min(widest) => Some(many),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::side_by_side;

    #[test]
    fn five_wheels_are_four_and_one() {
        let wheels = |devices, widest| side_by_side("reaction_wheel", 1, devices, widest);
        assert_eq!([2, 3, 4].map(|devices| wheels(devices, 8)), [None, Some(3), Some(4)]);
        assert_eq!([5, 6, 9].map(|devices| wheels(devices, 8)), [Some(4), Some(6), Some(8)]);
        assert_eq!([5, 9].map(|devices| wheels(devices, 4)), [Some(4), Some(4)]);
        // A register of two has to be full.
        assert_eq!([1, 2].map(|devices| wheels(devices, 2)), [None, Some(2)]);
    }

    #[test]
    fn five_gyros_are_one_group() {
        assert_eq!(side_by_side("dgvscmg", 3, 5, 8), Some(5));
        // A kind of another crate, with a joint.
        assert_eq!([2, 5].map(|devices| side_by_side("own", 1, devices, 8)), [None, Some(4)]);
    }
}
