//! Operations of an evaluation, counted as it runs, by the number of modes: with four wheels on four mounts.
//!
//! Run with `--nocapture` to see the counts.

use precess_tests::bending::Bending;
use precess_tests::counted::{Counted, count};

/// Modes and operations.
const MODES: [(usize, u64); 7] = [
    (0, 6_395),
    (6, 14_175),
    (20, 44_555),
    (40, 85_805),
    (80, 97_485),
    (160, 120_845),
    (200, 132_525),
];

/// Modes from which on the elimination is that of the thirty directions in which mounts and hub move them, six each.
const MANY: usize = 40;

/// What each further mode adds.
const A_MODE: u64 = 292;

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn modes_take_what_is_recorded_and_from_forty_on_each_the_same() {
    let counted = |modes: usize| {
        let Bending { craft, state, inputs } = Bending::<Counted>::new(modes);
        let (found, operations) = count(|| craft.accelerations(&state, &inputs));
        assert!(found.is_ok(), "{modes} modes: {:?}", found.err());
        (modes, operations.arithmetic())
    };
    let found = MODES.map(|(modes, _)| counted(modes));
    for (modes, operations) in found {
        println!("{modes} modes: {operations} operations");
    }
    assert_eq!(found, MODES, "record what is true");
    for modes in [MANY, 100, 199] {
        let more = counted(modes + 1).1 - counted(modes).1;
        println!("{more} for mode {}", modes + 1);
        assert_eq!(more, A_MODE, "of mode {}: record what is true", modes + 1);
    }
}
