//! Accelerations against the kinetic energy differentiated in double-double.

use precess_dynamics::Devices;
use precess_dynamics::kind::Each;
use precess_tests::blocks::largest;
use precess_tests::bounds::{ACCELERATIONS_WORST, BACKWARD_EPSILONS};

use crate::craft::{Case, SEED, Size};
use crate::reference::reference;

/// `a_B`, omega', eta'', q'' as one list.
pub(crate) fn listed<D: Devices<Scalar = f64>>(case: &Case<D>) -> Vec<f64> {
    let found = case.craft.accelerations(&case.state, &case.inputs).expect("a solution");
    let rigid = &found;
    let hub = rigid.r_b_n_ddot.iter().chain(&rigid.omega_dot).copied();
    hub.chain(found.modal.eta_ddot.iter().copied()).chain(rigid.devices.values()).collect()
}

/// Largest difference within each block, in units of its largest magnitude; the worst.
pub(crate) fn block_error(found: &[f64], expected: &[f64], modes: usize) -> f64 {
    assert_eq!(found.len(), expected.len());
    let blocks = [0..3, 3..6, 6..6 + modes, 6 + modes..found.len()];
    largest(blocks.into_iter().filter(|block| !block.is_empty()).map(|block| {
        let unit = largest(expected[block.clone()].iter().map(|a| a.abs()));
        let pairs = found[block.clone()].iter().zip(&expected[block]);
        largest(pairs.map(|(a, b)| (a - b).abs())) / unit
    }))
}

/// The largest error of a block against the reference, and the backward error.
pub(crate) fn errors<D: Devices<Scalar = f64>>(case: &Case<D>) -> [f64; 2] {
    let (found, expected) = (listed(case), reference(case));
    let modes = case.modes.frequencies.len();
    [block_error(&found, &expected.accelerations, modes), expected.backward_error(&found)]
}

#[test]
fn accelerations_are_those_of_the_kinetic_energy() {
    let (mut worst, mut backward) = (0.0_f64, 0.0_f64);
    let sizes = [(1, 0.02), (3, 0.3), (4, 1.5), (5, 0.02)];
    for (number, (modes, rotation)) in (0..).zip(sizes.into_iter().cycle().take(8)) {
        let size = Size { modes, contained: number % 2 == 1, rotation, free: false };
        let case = Case::new(SEED + number, size);
        let [error, residual] = errors(&case);
        println!("seed {:#x}, {size:?}: {error:.1e}, {residual:.1e}", case.seed);
        (worst, backward) = (worst.max(error), backward.max(residual));
    }
    assert!(worst <= ACCELERATIONS_WORST, "{worst:e}");
    assert!(backward <= BACKWARD_EPSILONS * f64::EPSILON, "{backward:e}");
}
