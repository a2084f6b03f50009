//! The ledger's rates against differences of its energies along the motion.

use precess_dynamics::{Accelerations, Attitude, Each, JointStates, Ledger};
use precess_tests::cases;

use super::bounds::{SPACECRAFT, Worst};
use super::craft::{Case, Craft, Mixed, Others};
use super::random::SEED;

/// Apart, s: the fastest wheel turns by 0.01 rad.
const STEP: f64 = 1.5e-5;
/// What a four-point difference leaves, of the rates' magnitude: the fourth power of 0.01 rad, as
/// its remainder of a thirtieth is of a fifth derivative that harmonics may make thirty times
/// larger.
const CURVATURE: f64 = 1e-8;
/// What the energies' own rounding leaves, in epsilons of their sizes divided by the step.
const ROUNDING: f64 = 20.0;

/// The ledger some steps along the tangent of the motion: the derivative there is the motion's own,
/// however stiff a damper is.
fn at<D: Craft>(case: &Case<D>, found: &Accelerations<D>, steps: f64) -> Ledger {
    let time = steps * STEP;
    let mut state = case.state.clone();
    state.r_b_n += case.state.r_b_n_dot * time;
    state.r_b_n_dot += case.state.attitude.dcm().transpose() * found.r_b_n_ddot * time;
    let rate = state.attitude.rate(&case.state.omega);
    state.attitude = state.attitude.advanced(&[(time, rate)]);
    state.omega += found.omega_dot * time;
    for ([coordinate, rate], acceleration) in state.devices.states_mut().zip(found.devices.values())
    {
        *coordinate += *rate * time;
        *rate += acceleration * time;
    }
    // Energies do not depend on the accelerations.
    let ledger = case.craft.ledger(&state, &case.inputs, found);
    ledger.unwrap_or_else(|error| panic!("{case}: {error}"))
}

#[test]
fn rates_are_the_derivatives_of_the_energies() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let case = Case::<D>::drawn(seed);
        let found = case.accelerations();
        let ledger @ [here, ..] = [0.0, 1.0, -1.0, 2.0, -2.0].map(|steps| at(&case, &found, steps));
        let curvature = CURVATURE * here.magnitude;
        let mut check = |what, energy: fn(&Ledger) -> f64, rate: f64| {
            let [here, ahead, behind, far_ahead, far_behind] = ledger.map(|ledger| energy(&ledger));
            let found = (8.0 * (ahead - behind) - (far_ahead - far_behind)) / (12.0 * STEP);
            let allowed = curvature + ROUNDING * f64::EPSILON * here.abs() / STEP;
            let error = (found - rate).abs();
            worst.add(if error == 0.0 { 0.0 } else { error / allowed });
            assert!(error <= allowed, "{what}: {found} is not {rate} within {allowed}; {case}");
        };
        check("kinetic energy", |ledger| ledger.kinetic, here.kinetic_rate);
        check("springs", |ledger| ledger.springs, -here.power.springs);
        check("gravity", |ledger| ledger.gravity, -here.power.gravity);
        let work = here.power.total() - here.power.springs - here.power.gravity;
        check("energy", Ledger::energy, work);
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("rates against differences: worst {:.2e} of what is allowed", worst.0);
}
