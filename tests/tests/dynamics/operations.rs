//! Number of operations of an evaluation, counted as it runs: hub and rotations included.
//!
//! Run with `--nocapture` to see the counts by what they are.

use precess_dynamics::Devices;
use precess_dynamics::kind::Kind;
use precess_tests::counted::{Counted, EVALUATION, Operations, count};
use precess_tests::measured::{EachKind, Measured, dgvscmg, each_kind};

/// The largest numbers that the project allows.
const BUDGET: [u64; 2] = [281, 1007];

/// What the graph of the strongest peer for few devices (`CasADi` on Pinocchio's algorithm) has at
/// four devices.
const CASADI_AT_FOUR: u64 = 7248;

/// What one more device of each kind takes: operations, and pairs of sine and cosine.
const KINDS: [(&str, u64, u64); 14] = [
    ("flexible_vscmg", 1961, 4),
    ("flexible_reaction_wheel", 1589, 3),
    ("dgvscmg", EVALUATION[1], 3),
    ("balanced_dgvscmg", 669, 2),
    ("dgcmg", 674, 3),
    ("balanced_dgcmg", 599, 2),
    ("vscmg", 568, 2),
    ("balanced_vscmg", 375, 1),
    ("sgcmg", 410, 2),
    ("balanced_sgcmg", 337, 1),
    ("reaction_wheel", 304, 1),
    ("balanced_reaction_wheel", 85, 0),
    ("hinged_panel", 325, 1),
    ("slosh_mass", 176, 0),
];

/// What the accelerations of these devices take.
fn evaluation<D: Devices<Scalar = Counted>>(devices: &D) -> Operations {
    let measured = Measured::new(devices);
    let (found, operations) = count(|| measured.accelerations());
    assert!(found.is_ok(), "{:?}", found.err());
    operations
}

#[test]
fn dgvscmgs_take_what_is_recorded_each_as_much_as_the_first() {
    let [hub, device] = EVALUATION;
    for n in 0..=8 {
        let found = evaluation(&vec![dgvscmg::<Counted>(); n]);
        let n = n as u64;
        println!("{n} devices: {} operations, {found:?}", found.arithmetic());
        assert_eq!(found.arithmetic(), hub + device * n, "of {n} devices: record what is true");
        assert_eq!(found.sin_cos, 3 * n);
    }
    let [hub_budget, device_budget] = BUDGET;
    println!("{hub} + {device} N recorded, {hub_budget} + {device_budget} N the budget");
    assert!(hub + 4 * device <= CASADI_AT_FOUR, "more than the peer's graph at four devices");
}

#[test]
fn a_device_of_each_kind_takes_what_is_recorded() {
    struct Costs(Vec<(&'static str, u64, u64)>);
    impl EachKind<Counted> for Costs {
        fn visit<K: Kind<Scalar = Counted>>(&mut self, name: &'static str, device: K) {
            let [one, two] = [evaluation(&vec![device; 1]), evaluation(&vec![device; 2])];
            let more = two.arithmetic() - one.arithmetic();
            println!("(\"{name}\", {more}, {}),", two.sin_cos - one.sin_cos);
            self.0.push((name, more, two.sin_cos - one.sin_cos));
        }
    }
    let mut costs = Costs(Vec::new());
    each_kind(&mut costs);
    assert_eq!(costs.0, KINDS, "record what is true");
}
