//! [`SteeringDevices`]: the steering terms of a list of devices on the hub, joint by joint, for any number of joints.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BuiltIn, Hub, JointStates, ParameterError, Quaternion, Spacecraft, State, SteeringError,
    SteeringTerms,
};

/// Devices on the hub, each by itself.
pub struct SteeringDevices(Vec<Prepared>);

/// A device on a hub of its own, which has no part in its terms.
struct Prepared {
    craft: Spacecraft<BuiltIn>,
    state: State<BuiltIn>,
    joints: usize,
}

/// The moment about B that the hub exerts on the devices, term by term, expressed in B:
/// `sum by_rate q' + sum by_acceleration q'' + inertia omega' + gyroscopic`, as [`SteeringTerms`] has it, without what
/// the acceleration of B adds.
#[derive(Clone, Debug, PartialEq)]
pub struct SteeringSums {
    /// Per rate of each joint, N m s.
    pub by_rate: Vec<Vector3<f64>>,
    /// Per acceleration of each joint, kg m².
    pub by_acceleration: Vec<Vector3<f64>>,
    /// Angular momentum of the devices about B relative to the hub, N m s.
    pub momentum: Vector3<f64>,
    /// Inertia of the devices about B, kg m².
    pub inertia: Matrix3<f64>,
    /// `omega x inertia omega`, N m.
    pub gyroscopic: Vector3<f64>,
}

impl SteeringDevices {
    /// Prepares devices in their order.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::new`].
    pub fn new(devices: &[BuiltIn]) -> Result<Self, ParameterError> {
        let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
        let prepared = |device: &BuiltIn| {
            let craft = Spacecraft::new(&hub, device)?;
            let state = State::at_rest_for(&craft);
            Ok(Prepared { craft, state, joints: device.kind().joints().len() })
        };
        Ok(Self(devices.iter().map(prepared).collect::<Result<_, _>>()?))
    }

    /// The terms at coordinates and rates of their joints, in order, and an angular velocity of the hub, B, rad/s.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::steering_terms`]; [`SteeringError::Joints`] of a device with more joints than any kind has.
    pub fn terms(
        &mut self,
        joints: impl IntoIterator<Item = [f64; 2]>,
        omega: &Vector3<f64>,
    ) -> Result<SteeringSums, SteeringError> {
        let mut joints = joints.into_iter();
        let mut sums = SteeringSums {
            by_rate: Vec::new(),
            by_acceleration: Vec::new(),
            momentum: Vector3::zeros(),
            inertia: Matrix3::zeros(),
            gyroscopic: Vector3::zeros(),
        };
        for Prepared { craft, state, joints: count } in &mut self.0 {
            for (to, from) in state.devices.states_mut().zip(joints.by_ref().take(*count)) {
                let [coordinate, rate] = to;
                [*coordinate, *rate] = from;
            }
            state.omega = *omega;
            match count {
                1 => sums.add(&craft.steering_terms::<Quaternion, 1>(state)?),
                2 => sums.add(&craft.steering_terms::<Quaternion, 2>(state)?),
                3 => sums.add(&craft.steering_terms::<Quaternion, 3>(state)?),
                6 => sums.add(&craft.steering_terms::<Quaternion, 6>(state)?),
                7 => sums.add(&craft.steering_terms::<Quaternion, 7>(state)?),
                found => return Err(SteeringError::Joints { expected: 7, found: *found }),
            }
        }
        Ok(sums)
    }
}

impl SteeringSums {
    fn add<const N: usize>(&mut self, terms: &SteeringTerms<f64, N>) {
        self.by_rate.extend(terms.by_rate);
        self.by_acceleration.extend(terms.by_acceleration);
        self.momentum += terms.momentum;
        self.inertia += terms.inertia;
        self.gyroscopic += terms.gyroscopic;
    }
}
