//! Limits: no modes are the rigid hub; hidden directions; more modes than directions.

use nalgebra::Vector3;
use precess_dynamics::kind::{Each, JointStates, Kind};
use precess_dynamics::{
    BuiltInKind, FixedModes, Flexible, Gravity, Hub, HubMode, Inputs, ListedModes, LoadAxes,
    ModalInputs, ModalMount, ModalPoint, ModalState, Mode, Modes, Quaternion, Rigid, Spacecraft,
    State,
};
use precess_tests::blocks::largest;
use precess_tests::bounds::LIMITS;
use precess_tests::measured::{EachKind, each_kind, hub};
use precess_tests::random::Random;

use crate::accelerations::block_error;
use crate::craft::{self, Case, SEED, Size};

/// Modes that nobody has, on one mount.
fn no_modes(position: Vector3<f64>) -> Modes<FixedModes<0, 1>> {
    let point = ModalPoint { position, translation: [], rotation: [] };
    let mounts = [ModalMount { point, contained: None }];
    Modes { frequencies: [], damping: [], linear: [], angular: [], mounts }
}

/// Compares accelerations, energy, momentum and a step of two devices of each kind.
struct AsRigid {
    kinds: usize,
    stops: usize,
    worst: f64,
}

impl EachKind<f64> for AsRigid {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, device: K) {
        self.kinds += 1;
        let random = &mut Random::new(SEED);
        let drawn: [K; 2] = [craft::device(random, 5.0), craft::device(random, 8.0)];
        for devices in [[device; 2], drawn] {
            let rigid = Spacecraft::new(&hub(), &devices).expect("valid");
            let modes = no_modes(random.vector(1.0));
            let bending = Spacecraft::flexible(&hub(), &modes, &devices, &[0; 2]).expect("valid");
            let mut state: State<[K; 2], Quaternion> = State::at_rest();
            state.r_b_n_dot = random.vector(3.0);
            state.omega = random.vector(0.7);
            state.attitude = Quaternion { q0: 0.5, q1: 0.5, q2: -0.5, q3: 0.5 };
            for [coordinate, rate] in state.devices.states_mut() {
                (*coordinate, *rate) = (random.within(-1.0, 1.0), random.within(-3.0, 3.0));
            }
            let mut inputs = Inputs::none_for(&rigid);
            inputs.force = random.vector(5.0);
            inputs.torque_b = random.vector(2.0);
            inputs.motors.values_mut().for_each(|u| *u = random.within(-0.5, 0.5));
            state.r_b_n = Vector3::new(4.0, -7.0, 5.0);
            for gravity in
                [Gravity::Uniform(Vector3::new(0.3, -0.2, 9.0)), Gravity::Central { mu: 900.0 }]
            {
                inputs.gravity = gravity;
                self.compare(name, (&rigid, &bending), &state, inputs);
            }
        }
    }
}

/// A kind's spacecraft on a rigid hub, and on a structure without modes.
type Both<'a, K> = (&'a Spacecraft<[K; 2]>, &'a Spacecraft<[K; 2], Flexible<FixedModes<0, 1>>>);

impl AsRigid {
    fn compare<K: Kind<Scalar = f64>>(
        &mut self,
        name: &str,
        (rigid, bending): Both<'_, K>,
        state: &State<[K; 2], Quaternion>,
        mut inputs: Inputs<[K; 2]>,
    ) {
        {
            let state = *state;
            for mode in [
                HubMode::Free,
                HubMode::Prescribed {
                    r_b_n_ddot: Vector3::new(0.1, 0.2, -0.3),
                    omega_dot: Vector3::new(-0.2, 0.1, 0.4),
                },
            ] {
                inputs.hub = mode;
                let mut both = state.with_modal(ModalState { eta: [], eta_dot: [] });
                let given = inputs.with_modal(Inputs::none_for(bending).modal);
                let list = |a: &precess_dynamics::Accelerations<[K; 2]>| -> Vec<f64> {
                    let hub = a.r_b_n_ddot.iter().chain(&a.omega_dot).copied();
                    hub.chain(a.devices.values()).collect()
                };
                let expected = list(&rigid.accelerations(&state, &inputs).expect(name));
                let accelerations = bending.accelerations(&both, &given).expect(name);
                let of_hub = accelerations.with_modal(());
                let found = list(&of_hub);
                let error = block_error(&found, &expected, 0);
                self.worst = self.worst.max(error);
                assert!(error <= LIMITS, "{name}: {error:e}");

                let (own, other) = (bending.energy(&both), rigid.energy(&state));
                let (own, other) = (own.expect(name), other.expect(name));
                assert!((own - other).abs() <= LIMITS * other, "{name}: {own} {other}");
                let about = precess_dynamics::About::CentreOfMass;
                let momentum = bending.momentum(&both, about).expect(name);
                let other = rigid.momentum(&state, about).expect(name);
                let difference = (momentum.angular - other.angular).norm()
                    / other.angular.norm().max(other.linear.norm());
                assert!(difference <= LIMITS, "{name}: {difference:e}");

                let loads = bending.loads(&both, &given, &accelerations, LoadAxes::Inertial);
                let loads = loads.expect(name).devices.map(|of| of.mount);
                let expected = rigid.loads(&state, &inputs, &of_hub, LoadAxes::Inertial);
                for (own, other) in loads.iter().zip(expected.expect(name).devices) {
                    let (force, moment) = (other.mount.force, other.mount.moment);
                    let unit = force.norm() + moment.norm();
                    assert!((own.force - force).norm() <= LIMITS * unit, "{name}: force");
                    assert!((own.moment - moment).norm() <= LIMITS * unit, "{name}: moment");
                }
                let ledger = bending.ledger(&both, &given, &accelerations).expect(name);
                let other = rigid.ledger(&state, &inputs, &of_hub).expect(name);
                let pairs = [
                    (ledger.gravity, other.gravity, other.gravity.abs()),
                    (ledger.power.gravity, other.power.gravity, other.magnitude),
                    (ledger.kinetic_rate, other.kinetic_rate, other.magnitude),
                ];
                for (own, other, unit) in pairs {
                    assert!((own - other).abs() <= LIMITS * unit, "{name}: {own} {other}");
                }

                let (mut brake, mut brake_given) = (inputs, given);
                if let Some(first) = brake.modes[0].values_mut().next() {
                    *first = Mode::Locked;
                }
                brake_given.modes = brake.modes;
                match rigid.stop(&state, &brake) {
                    Ok(stopped) => {
                        let own = bending.stop(&both, &brake_given).expect(name);
                        let omega = stopped.state.omega;
                        assert!((own.state.omega - omega).norm() <= LIMITS * omega.norm());
                        let unit = rigid.energy(&state).expect(name);
                        let difference = own.energy_lost - stopped.energy_lost;
                        assert!(difference.abs() <= LIMITS * unit, "{name}: {difference:e}");
                        self.stops += 1;
                    }
                    // A joint of this kind that cannot be locked.
                    Err(error) => assert_eq!(bending.stop(&both, &brake_given).err(), Some(error)),
                }

                both = bending.step(&both, &given, 1e-3).expect(name);
                let next = rigid.step(&state, &inputs, 1e-3).expect(name);
                assert!((both.omega - next.omega).norm() <= LIMITS * next.omega.norm());
                let pairs = both.devices.states().zip(next.devices.states());
                for ([q, rate], [p, other]) in pairs {
                    assert!((q - p).abs() <= LIMITS && (rate - other).abs() <= LIMITS * 4.0);
                }
            }
        }
    }
}

#[test]
fn no_modes_are_the_rigid_hub_for_every_kind() {
    let mut visitor = AsRigid { kinds: 0, stops: 0, worst: 0.0 };
    each_kind(&mut visitor);
    println!("worst {:.1e}", visitor.worst);
    let kinds = BuiltInKind::ALL.len();
    assert_eq!((visitor.kinds, visitor.stops), (kinds, kinds * 2 * 2 * 2));
}

/// Sixty modes on three mounts have 24 directions. With forty-two of them moved into a structure of
/// twelve unused mounts, every mode is a direction: other arithmetic, the same equations.
#[test]
fn directions_of_the_mounts_are_all_that_devices_meet() {
    let mut worst = 0.0_f64;
    for seed in 0..4 {
        let size = Size { modes: 60, contained: seed % 2 == 1, rotation: 0.05, free: false };
        let case = Case::new(SEED + 100 + seed, size);
        let mut modes = case.modes.clone();
        for _ in 0..12 {
            let ModalMount { point, .. } = modes.mounts[0].clone();
            modes.mounts.push(ModalMount { point, contained: None });
        }
        let dense =
            Spacecraft::flexible(&case.hub, &modes, &case.devices, &craft::ON_MOUNT).unwrap();
        let mut inputs = case.inputs.clone();
        inputs.modal.mounts.resize(15, precess_dynamics::Wrench::none());
        let expected = dense.accelerations(&case.state, &inputs).expect("a solution");
        let found = case.craft.accelerations(&case.state, &case.inputs).expect("a solution");
        let list = |a: &precess_dynamics::Accelerations<_, Flexible<ListedModes>>| -> Vec<f64> {
            let a: &precess_dynamics::Accelerations<craft::Mixed, Flexible<ListedModes>> = a;
            let hub = a.r_b_n_ddot.iter().chain(&a.omega_dot).copied();
            hub.chain(a.modal.eta_ddot.iter().copied()).chain(a.devices.values()).collect()
        };
        worst = worst.max(block_error(&list(&found), &list(&expected), 60));
    }
    println!("worst {worst:.1e}");
    assert!(worst <= LIMITS, "{worst:e}");
}

/// Arrays and vectors hold the same numbers in the same order.
#[test]
fn fixed_and_listed_modes_give_the_same_bits() {
    let size = Size { modes: 4, contained: true, rotation: 0.1, free: false };
    let case = Case::new(SEED + 200, size);
    let fixed = |v: &[f64]| -> [f64; 4] { v.try_into().unwrap() };
    let vectors = |v: &[Vector3<f64>]| -> [Vector3<f64>; 4] { v.try_into().unwrap() };
    let mount = |k: usize| -> ModalMount<FixedModes<4, 3>> {
        let ModalMount { point, contained } = &case.modes.mounts[k];
        let translation = vectors(&point.translation);
        let rotation = vectors(&point.rotation);
        let point = ModalPoint { position: point.position, translation, rotation };
        ModalMount { point, contained: *contained }
    };
    let modes = Modes {
        frequencies: fixed(&case.modes.frequencies),
        damping: fixed(&case.modes.damping),
        linear: vectors(&case.modes.linear),
        angular: vectors(&case.modes.angular),
        mounts: [mount(0), mount(1), mount(2)],
    };
    let hub: Hub = case.hub;
    let craft = Spacecraft::flexible(&hub, &modes, &case.devices, &craft::ON_MOUNT).unwrap();
    let state: State<craft::Mixed, Quaternion, Flexible<FixedModes<4, 3>>> =
        case.state.clone().with_modal(ModalState {
            eta: fixed(&case.state.modal.eta),
            eta_dot: fixed(&case.state.modal.eta_dot),
        });
    let forces = fixed(&case.inputs.modal.forces);
    let mounts = core::array::from_fn(|mount| case.inputs.modal.mounts[mount]);
    let inputs = case.inputs.clone().with_modal(ModalInputs { forces, mounts });
    let found = craft.step(&state, &inputs, 1e-3).unwrap();
    let expected = case.craft.step(&case.state, &case.inputs, 1e-3).unwrap();
    assert_eq!(found.with_modal::<Rigid>(()), expected.clone().with_modal(()));
    assert_eq!(found.modal.eta.as_slice(), expected.modal.eta.as_slice());
    assert_eq!(found.modal.eta_dot.as_slice(), expected.modal.eta_dot.as_slice());
}

/// In the frame that falls with a uniform field there is none.
#[test]
fn uniform_gravity_adds_itself_to_the_acceleration_of_b() {
    let size = Size { modes: 5, contained: true, rotation: 0.1, free: false };
    let mut case = Case::new(SEED + 300, size);
    let without = case.craft.accelerations(&case.state, &case.inputs).unwrap();
    let g = Vector3::new(1.0, -2.0, 9.0);
    case.inputs.gravity = Gravity::Uniform(g);
    let with = case.craft.accelerations(&case.state, &case.inputs).unwrap();
    let at_b = precess_dynamics::Attitude::dcm(&case.state.attitude) * g;
    assert_eq!(
        (with.omega_dot, &with.modal.eta_ddot),
        (without.omega_dot, &without.modal.eta_ddot)
    );
    let difference = with.r_b_n_ddot - without.r_b_n_ddot - at_b;
    assert!(largest(difference.iter().map(|d| d.abs())) <= LIMITS * g.norm());
}
