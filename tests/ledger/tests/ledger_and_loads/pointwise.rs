//! The energy ledger at one instant: its residual, and each power as force times velocity.

use precess_dynamics::{HubMode, Ledger, Wrench};
use precess_tests::cases;

use super::bounds::{EPSILONS, SPACECRAFT, Worst};
use super::craft::{Case, Craft, Mixed, Others};
use super::kinematics::{self, Frame};
use super::random::SEED;

fn ledger<D: Craft>(case: &Case<D>) -> Ledger {
    let found = case.craft.ledger(&case.state, &case.inputs, &case.accelerations());
    found.unwrap_or_else(|error| panic!("{case}: {error}"))
}

#[test]
fn powers_of_all_sources_are_the_rate_of_kinetic_energy() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let case = Case::<D>::drawn(seed);
        let ledger = ledger(&case);
        let unit = f64::EPSILON * ledger.magnitude;
        let error = ledger.residual.abs();
        // Nothing moves on a fixed hub with every joint locked, and zero is zero.
        worst.add(if error == 0.0 { 0.0 } else { error / unit });
        assert!(error <= EPSILONS * unit, "residual of {} eps; {case}", error / unit);
        assert!(ledger.power.friction <= 0.0, "{case}");
        let held = matches!(case.inputs.hub, HubMode::Prescribed { .. });
        assert!(held || ledger.power.hub == 0.0, "{case}");
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("residual, mixed kinds: worst {:.2} eps", worst.0);
}

/// An error in both sides of the balance leaves the residual zero. So each power is compared with
/// force times velocity of its point, from the reference kinematics. The unit is the sum of the
/// magnitudes of their terms: a body's force as a part of its centripetal one, and so on.
#[test]
fn powers_are_forces_times_velocities() {
    fn check<D: Craft>(seed: u64, worst: &mut Worst) {
        let case = Case::<D>::drawn(seed);
        let found = case.accelerations();
        let ledger = ledger(&case);
        let hub = kinematics::hub_frame(&case, &found);
        let of_hub =
            |wrench: &Wrench| wrench.force.dot(&hub.velocity) + wrench.moment.dot(&hub.omega);
        let given = Wrench { force: case.inputs.force, moment: case.inputs.torque_b };
        let devices = kinematics::bodies(&case, &found);
        let (needed, pull) =
            (kinematics::hub_needs(&case, &found), kinematics::hub_pull(&case, &devices));
        let mut outside = of_hub(&given) + of_hub(&pull);
        let mut kinetic_rate = of_hub(&needed);
        let mut unit = ledger.magnitude;
        for body in devices.iter().flatten() {
            let Frame { velocity, omega, .. } = body.frame;
            let power = |wrench: &Wrench| wrench.force.dot(&velocity) + wrench.moment.dot(&omega);
            outside += power(&body.applied);
            kinetic_rate += power(&body.needs());
            let [force, moment] = body.sizes();
            unit += (force + body.applied.force.norm()) * velocity.norm();
            unit += (moment + body.applied.moment.norm()) * omega.norm();
        }
        let found = [ledger.power.external + ledger.power.gravity, ledger.kinetic_rate];
        for (found, expected) in found.into_iter().zip([outside, kinetic_rate]) {
            let error = (found - expected).abs();
            worst.add(if error == 0.0 { 0.0 } else { error / (f64::EPSILON * unit) });
            assert!(error <= EPSILONS * f64::EPSILON * unit, "{found} is not {expected}; {case}");
        }
    }
    let mut worst = Worst::default();
    for seed in SEED..SEED + cases(SPACECRAFT) {
        check::<Mixed>(seed, &mut worst);
        check::<Others>(seed, &mut worst);
    }
    println!("power of external and gravity, and dT/dt: worst {:.2} eps", worst.0);
}
