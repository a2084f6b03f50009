//! A list of built-in devices has the bits of the typed set, for every kind.

use std::vec::Vec;

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::equations::device_loads::{DeviceLoads, JointPower};
use crate::every_kind;
use crate::generated::devices::*;
use crate::model::kind::{BodyParameters, ImbalanceModel, Kind, Wrenches};
use crate::numbers::each::{Each, JointStates};
use crate::results::loads::Loads;
use crate::sets::built_in::{BuiltIn, BuiltInKind};
use crate::sets::device_parameters::{DeviceParameters, UnsupportedParameter};
use crate::validation::parameter_error::{Parameter, ParameterError};
use crate::{
    About, Accelerations, Devices, Gravity, Hub, HubMode, Inputs, LoadAxes, MAX_JOINTS, Mode,
    Passive, Spacecraft, State, Wrench,
};

/// Up to three devices.
type List = [Option<BuiltIn>; 3];

/// Numbers in a row, the same each time.
struct Numbers(u64);

impl Numbers {
    /// Between -1 and 1.
    fn next(&mut self) -> f64 {
        // Knuth's multiplier; the upper bits are the good ones.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let upper = u32::try_from(self.0 >> 32).unwrap();
        f64::from(upper) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.next())
    }

    /// An inertia that is symmetric and has only positive moments.
    fn inertia(&mut self) -> Matrix3<f64> {
        let (moments, products) = (self.vector(), self.vector() * 0.1);
        let products = products.cross_matrix().map(f64::abs);
        Matrix3::from_diagonal(&moments.map(|moment| 1.5 + moment)) + products
    }

    fn parameters(&mut self, model: ImbalanceModel) -> DeviceParameters {
        let angles = self.vector();
        DeviceParameters {
            mount: Rotation3::from_euler_angles(angles.x, angles.y, angles.z).into_inner(),
            bodies: [(); MAX_JOINTS].map(|()| BodyParameters {
                origin: self.vector().into(),
                mass: 3.0 + self.next(),
                centre: (self.vector() * 0.1).into(),
                inertia: self.inertia(),
            }),
            passive: [(); MAX_JOINTS].map(|()| Passive {
                stiffness: 2.0 + self.next(),
                rest: self.next(),
                viscous: 1.0 + self.next(),
                coulomb: 1.0 + self.next(),
                coulomb_rate: 2.0 + self.next(),
            }),
            model,
        }
    }

    /// A device of a kind, which leaves out what it has no parameter for.
    fn device<K: Kind<Scalar = f64>>(&mut self, model: ImbalanceModel) -> K {
        let parameters = self.parameters(model);
        let mut bodies = <K as Kind>::all(parameters.bodies[0]);
        bodies.values_mut().zip(parameters.bodies).for_each(|(to, from)| *to = from);
        let mut passive = <K as Kind>::all(Passive::none());
        passive.values_mut().zip(parameters.passive).for_each(|(to, from)| *to = from);
        K::of_bodies(&parameters.mount, &bodies, &passive, model)
    }

    fn fill<D: Devices<Scalar = f64>>(&mut self, state: &mut State<D>, inputs: &mut Inputs<D>) {
        state.r_b_n = self.vector() * 7e6;
        state.r_b_n_dot = self.vector();
        state.omega = self.vector();
        inputs.force = self.vector();
        inputs.torque_b = self.vector();
        for [coordinate, rate] in state.devices.states_mut() {
            (*coordinate, *rate) = (self.next(), 5.0 * self.next());
        }
        inputs.motors.values_mut().for_each(|torque| *torque = self.next());
        for wrench in inputs.bodies.iter_mut().flat_map(Each::values_mut) {
            *wrench = Wrench { force: self.vector(), moment: self.vector() };
        }
    }
}

/// All that a spacecraft answers, as bits.
fn answers<D: Devices<Scalar = f64>>(
    craft: &Spacecraft<D>,
    seed: u64,
    loads: impl Fn(&Loads<D>) -> Vec<f64>,
) -> Vec<u64> {
    let mut found = Vec::new();
    for gravity in [Gravity::Uniform(Vector3::new(0.1, 0.2, 9.8)), Gravity::Central { mu: 4e14 }] {
        let mut state = State::at_rest_for(craft);
        let bodies = Some(Inputs::no_wrenches_for(craft));
        let mut inputs = Inputs { gravity, bodies, ..Inputs::none_for(craft) };
        Numbers(seed).fill(&mut state, &mut inputs);
        let first = inputs.modes.values().next();
        for hub in [
            HubMode::Free,
            HubMode::Prescribed {
                r_b_n_ddot: Vector3::new(0.1, 0.2, 0.3),
                omega_dot: Vector3::new(0.3, 0.2, 0.1),
            },
        ] {
            inputs.hub = hub;
            if first == Some(Mode::Driven) && hub != HubMode::Free {
                inputs.modes.values_mut().take(1).for_each(|mode| *mode = Mode::Prescribed(0.5));
            }
            let accelerations = craft.accelerations(&state, &inputs).unwrap();
            found.extend(numbers(&accelerations));
            for axes in [LoadAxes::Body, LoadAxes::Parent, LoadAxes::Hub, LoadAxes::Inertial] {
                let of_craft = craft.loads(&state, &inputs, &accelerations, axes).unwrap();
                found.extend(of_wrench(&of_craft.hub));
                found.extend(loads(&of_craft));
            }
            let books = craft.ledger(&state, &inputs, &accelerations).unwrap();
            found.extend([books.energy(), books.residual, books.power.total()]);
            for _ in 0..10 {
                state = craft.step(&state, &inputs, 1e-3).unwrap();
            }
            found.extend(&state.r_b_n);
            found.extend(state.devices.states().flatten());
            found.push(craft.energy(&state).unwrap());
            let momentum = craft.momentum(&state, About::CentreOfMass).unwrap();
            found.extend(momentum.linear.iter().chain(&momentum.angular));
        }
        if first == Some(Mode::Driven) {
            inputs.hub = HubMode::Free;
            inputs.modes.values_mut().take(1).for_each(|mode| *mode = Mode::Locked);
            let stopped = craft.stop(&state, &inputs).unwrap();
            found.push(stopped.energy_lost);
            found.extend(stopped.state.devices.states().flatten());
        }
    }
    found.into_iter().map(f64::to_bits).collect()
}

fn numbers<D: Devices<Scalar = f64>>(accelerations: &Accelerations<D>) -> Vec<f64> {
    let hub = accelerations.r_b_n_ddot.iter().chain(&accelerations.omega_dot).copied();
    hub.chain(accelerations.devices.values()).collect()
}

fn of_wrench(wrench: &Wrench) -> [f64; 6] {
    let Wrench { force, moment } = wrench;
    [force.x, force.y, force.z, moment.x, moment.y, moment.z]
}

fn of_device<W: Each<Wrench>, U: Each<f64>, P: Each<JointPower>>(
    loads: &DeviceLoads<W, U, P, f64>,
) -> Vec<f64> {
    let mut found = Vec::from(of_wrench(&loads.mount));
    found.extend(loads.joints.values().flat_map(|load| of_wrench(&load)));
    found.extend(loads.motors.values());
    found.extend(loads.powers.values().flat_map(|p| [p.motor, p.spring, p.friction]));
    found
}

fn agrees<K>(seed: u64, model: ImbalanceModel)
where
    K: Kind<Scalar = f64>,
    BuiltIn: From<K>,
    Wrenches<K>: Each<Wrench>,
    K::PerJoint<f64>: Each<f64>,
    K::PerJoint<JointPower>: Each<JointPower>,
{
    let mut seeded = Numbers(seed);
    let hub = Hub { m_b: 500.0, r_bc_b: seeded.vector(), i_b_bc: seeded.inertia() * 100.0 };
    let devices: [K; 2] = [seeded.device(model), seeded.device(model)];
    let list = devices.map(BuiltIn::from);
    for device in &list {
        assert_eq!(BuiltIn::new(device.kind(), &device.parameters()), Ok(*device));
    }
    let typed = Spacecraft::new(&hub, &devices).unwrap();
    let list: List = [Some(list[0]), None, Some(list[1])];
    let listed = Spacecraft::new(&hub, &list).unwrap();
    assert!(typed.joints().eq(listed.joints()));
    assert_eq!(typed.mass().to_bits(), listed.mass().to_bits());
    let of_typed = |loads: &Loads<[K; 2]>| loads.devices.iter().flat_map(of_device).collect();
    let of_list =
        |loads: &Loads<List>| loads.devices.iter().flatten().flat_map(of_device).collect();
    assert_eq!(answers(&typed, seed, of_typed), answers(&listed, seed, of_list), "seed {seed}");
}

#[test]
fn list_of_built_in_devices_has_the_bits_of_the_typed_set() {
    macro_rules! each {
        ($($kind:ident $module:ident $number:literal;)*) => {
            assert_eq!(BuiltInKind::ALL, [$(BuiltInKind::$kind),*]);
            $(assert_eq!(BuiltInKind::of_number($number), Some(BuiltInKind::$kind));)*
            $(for seed in 1..6 {
                agrees::<$kind>(seed, ImbalanceModel::Coupled);
            })*
        };
    }
    every_kind!(each);
    agrees::<Dgvscmg>(7, ImbalanceModel::Lumped);
    assert_eq!(BuiltInKind::of_number(0), None);
}

#[test]
fn what_a_kind_has_no_parameter_for_is_rejected() {
    let wheel = BuiltIn::from(ReactionWheel::bare_wheel(4.0, Matrix3::identity()));
    let rejected = |kind, change: fn(&mut DeviceParameters)| {
        let mut parameters = wheel.parameters();
        change(&mut parameters);
        BuiltIn::new(kind, &parameters).unwrap_err()
    };
    let of = |parameter| UnsupportedParameter { body: "wheel", parameter };
    let (coupled, balanced) = (BuiltInKind::ReactionWheel, BuiltInKind::BalancedReactionWheel);
    assert_eq!(
        rejected(coupled, |p| p.bodies[0].centre[2] = 0.1),
        of(Some(Parameter::CentreOfMass))
    );
    assert_eq!(rejected(balanced, |p| p.bodies[0].inertia.m33 = 2.0), of(Some(Parameter::Inertia)));
    assert_eq!(rejected(balanced, |p| p.model = ImbalanceModel::Lumped), of(None));
    assert!(BuiltIn::new(balanced, &wheel.parameters()).is_ok());
}

/// Links without a body have no mass, and what is at the bearing centre has no offset from it.
#[test]
fn bearings_have_no_bodies() {
    let flexible = FlexibleReactionWheel::bare_wheel(4.0, Matrix3::identity());
    let parameters = BuiltIn::from(flexible).parameters();
    let kind = BuiltInKind::FlexibleReactionWheel;
    assert_eq!(BuiltIn::new(kind, &parameters), Ok(BuiltIn::from(flexible)));
    let rejected = |change: fn(&mut DeviceParameters)| {
        let mut parameters = parameters;
        change(&mut parameters);
        BuiltIn::new(kind, &parameters).unwrap_err()
    };
    let of = |body, parameter| UnsupportedParameter { body, parameter: Some(parameter) };
    assert_eq!(rejected(|p| p.bodies[1].mass = 0.1), of("radial slide y", Parameter::Mass));
    assert_eq!(rejected(|p| p.bodies[3].origin[0] = 0.1), of("tilt y", Parameter::Origin));
    assert_eq!(rejected(|p| p.bodies[5].origin[2] = 0.1), of("wheel", Parameter::Origin));
    assert_eq!(rejected(|p| p.bodies[4].inertia.m11 = 0.1), of("tilt z", Parameter::Inertia));
}

/// A number that is none is left to the validation, which names it.
#[test]
fn nan_is_named_by_the_validation() {
    let mut parameters =
        BuiltIn::from(ReactionWheel::bare_wheel(4.0, Matrix3::identity())).parameters();
    parameters.bodies[0].inertia.m12 = f64::NAN;
    let device = BuiltIn::new(BuiltInKind::ReactionWheel, &parameters).unwrap();
    let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    let rejected = Spacecraft::new(&hub, &[Some(device)]).unwrap_err();
    assert!(matches!(rejected, ParameterError::NotFinite { parameter: Parameter::Inertia, .. }));
}
