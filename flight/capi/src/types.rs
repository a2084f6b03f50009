//! The structures of the header, field by field. Vectors are x, y, z; matrices row by row; what
//! belongs to joints is in `[device][joint]`, from the hub outwards, and is 0 where there is none.
//! `J` is the number of joints that a device has at most: `PRECESS_MAX_JOINTS` of the version of the
//! interface.

use crate::memory::Plain;
use crate::{MAX_DEVICES, VERSIONS};

/// The joints of a platform.
pub const PLATFORM_JOINTS: usize = 6;

/// A value for each joint.
pub type PerJoint<T, const J: usize> = [[T; J]; MAX_DEVICES];

macro_rules! structures {
    ($($(#[$doc:meta])* $name:ident $(<$j:ident>)? { $($(#[$of:meta])* $field:ident: $ty:ty,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(C)]
        pub struct $name $(<const $j: usize>)? {
            $($(#[$of])* pub $field: $ty,)*
        }

        // SAFETY: integers and floating-point numbers.
        unsafe impl $(<const $j: usize>)? Plain for $name $(<$j>)? {}
    )*};
}

structures! {
    /// `precess_hub`.
    Hub {
        /// kg.
        mass: f64,
        /// B axes, m.
        centre: [f64; 3],
        /// kg m².
        inertia: [f64; 9],
    }

    /// `precess_body`.
    Body {
        /// kg.
        mass: f64,
        /// m.
        origin: [f64; 3],
        /// m.
        centre: [f64; 3],
        /// kg m².
        inertia: [f64; 9],
    }

    /// `precess_passive`.
    Passive {
        /// N m/rad or N/m.
        stiffness: f64,
        /// rad or m.
        rest: f64,
        /// N m s/rad or N s/m.
        viscous: f64,
        /// N m or N.
        coulomb: f64,
        /// rad/s or m/s.
        coulomb_rate: f64,
    }

    /// `precess_device`.
    Device<J> {
        /// `PRECESS_KIND_`.
        kind: i32,
        /// `PRECESS_COUPLED` or `PRECESS_LUMPED`.
        model: i32,
        /// Columns are the device's axes along B.
        mount: [f64; 9],
        /// From the hub outwards.
        bodies: [Body; J],
        /// Of the joint before each body.
        passive: [Passive; J],
    }

    /// `precess_strut`.
    Strut {
        /// On the platform, its axes, m.
        position: [f64; 3],
        /// Unit vector from base to platform, mount axes.
        direction: [f64; 3],
        /// m.
        length: f64,
        /// N/m.
        stiffness: f64,
        /// N s/m.
        damping: f64,
    }

    /// `precess_suspension`.
    Suspension {
        /// N/m, N/rad, N m/rad.
        stiffness: [f64; 36],
        /// m, rad.
        rest: [f64; 6],
        /// N s/m, N s/rad, N m s/rad.
        damping: [f64; 36],
        /// Those of zeros are none.
        strut: [Strut; 6],
    }

    /// `precess_device` of version 2.
    Entry {
        /// What it shares with version 1.
        device: Device<{ VERSIONS[1] }>,
        /// 0 on the hub, otherwise 1 + index of the platform's entry.
        on: i32,
        /// Not read; 0.
        reserved: i32,
        /// Of a platform.
        suspension: Suspension,
    }

    /// `precess_state`.
    State<J> {
        /// N axes, m.
        position: [f64; 3],
        /// N axes, m/s.
        velocity: [f64; 3],
        /// Quaternion, scalar first.
        attitude: [f64; 4],
        /// B axes, rad/s.
        omega: [f64; 3],
        /// rad or m.
        coordinate: PerJoint<f64, J>,
        /// rad/s or m/s.
        rate: PerJoint<f64, J>,
    }

    /// `precess_wrench`.
    Wrench {
        /// N.
        force: [f64; 3],
        /// N m.
        moment: [f64; 3],
    }

    /// `precess_inputs`.
    Inputs<J> {
        /// Through B, B axes, N.
        force: [f64; 3],
        /// About B, B axes, N m.
        torque: [f64; 3],
        /// N m or N.
        motor: PerJoint<f64, J>,
        /// rad/s² or m/s².
        prescribed: PerJoint<f64, J>,
        /// Prescribed acceleration of B, B axes, m/s².
        hub_linear: [f64; 3],
        /// Prescribed angular acceleration of B, B axes, rad/s².
        hub_angular: [f64; 3],
        /// Uniform field, N axes, m/s².
        gravity: [f64; 3],
        /// Central field, m³/s².
        mu: f64,
        /// On the bodies.
        wrench: PerJoint<Wrench, J>,
        /// `PRECESS_DRIVEN`, `PRECESS_PRESCRIBED`, `PRECESS_LOCKED`.
        mode: PerJoint<i32, J>,
        /// `PRECESS_HUB_`.
        hub_mode: i32,
        /// `PRECESS_GRAVITY_`.
        gravity_model: i32,
        /// Whether `wrench` is read: 0 or 1.
        wrenches: i32,
        /// Not read; 0.
        reserved: i32,
    }

    /// `precess_accelerations`.
    Accelerations<J> {
        /// B axes, m/s².
        linear: [f64; 3],
        /// B axes, rad/s².
        angular: [f64; 3],
        /// rad/s² or m/s².
        joint: PerJoint<f64, J>,
    }

    /// `precess_momentum`.
    Momentum {
        /// N axes, kg m/s.
        linear: [f64; 3],
        /// N axes, kg m²/s.
        angular: [f64; 3],
    }

    /// `precess_power`.
    Power {
        /// W or J.
        external: f64,
        /// W or J.
        hub: f64,
        /// W or J.
        gravity: f64,
        /// W or J.
        motors: f64,
        /// W or J.
        springs: f64,
        /// W or J.
        friction: f64,
    }

    /// `precess_loads`.
    Loads<J> {
        /// About B, B axes.
        hub: Wrench,
        /// At each device's mount.
        mount: [Wrench; MAX_DEVICES],
        /// Across each joint.
        joint: PerJoint<Wrench, J>,
        /// N m or N.
        motor: PerJoint<f64, J>,
    }

    /// `precess_contributions`.
    Contributions {
        /// kg.
        force_by_linear: [f64; 9],
        /// kg m.
        force_by_angular: [f64; 9],
        /// kg m².
        moment_by_angular: [f64; 9],
        /// N.
        force: [f64; 3],
        /// About B, N m.
        moment: [f64; 3],
        /// kg.
        mass: f64,
        /// About B, kg m.
        first_moment: [f64; 3],
        /// Seen from B, kg m/s.
        first_moment_prime: [f64; 3],
        /// About B, kg m².
        inertia: [f64; 9],
    }

    /// `precess_steering_terms`.
    SteeringTerms<J> {
        /// N m s or N s.
        by_rate: PerJoint<[f64; 3], J>,
        /// kg m² or kg m.
        by_acceleration: PerJoint<[f64; 3], J>,
        /// About B, kg m²/s.
        momentum: [f64; 3],
        /// About B, kg m.
        first_moment: [f64; 3],
        /// About B, kg m².
        inertia: [f64; 9],
        /// N m.
        gyroscopic: [f64; 3],
    }

    /// `precess_steering_law`.
    SteeringLaw<J> {
        /// How readily each joint moves.
        weight: PerJoint<f64, J>,
        /// rad/s or rad/s².
        lower: PerJoint<f64, J>,
        /// rad/s or rad/s².
        upper: PerJoint<f64, J>,
        /// kg m²/s.
        reference: f64,
        /// Of inverses but the exact one.
        lambda: f64,
        /// How fast it falls with the measure.
        mu: f64,
        /// Elements 23, 13, 12.
        dither: [f64; 3],
        /// How fast weights of accelerations fall with the measure.
        wheel_mu: f64,
        /// `PRECESS_STEER_`.
        steered: PerJoint<i32, J>,
        /// `PRECESS_INVERSE_`.
        inverse: i32,
        /// Whether the bounds are read: 0 or 1.
        bounded: i32,
    }

    /// `precess_allocation`.
    Allocation<J> {
        /// rad/s or rad/s².
        command: PerJoint<f64, J>,
        /// N m.
        torque_error: [f64; 3],
        /// Of the joints whose rates are commanded.
        measure: f64,
        /// How many commands are.
        at_bound: i32,
        /// 0.
        reserved: i32,
    }

    /// `precess_servo`.
    Servo<J> {
        /// rad/s or rad/s².
        command: PerJoint<f64, J>,
        /// rad/s².
        feed_forward: PerJoint<f64, J>,
        /// 1/s.
        gain: PerJoint<f64, J>,
        /// N m or N.
        limit: PerJoint<f64, J>,
        /// `PRECESS_STEER_`.
        steered: PerJoint<i32, J>,
    }

    /// `precess_servo_torques`.
    ServoTorques<J> {
        /// N m or N.
        motor: PerJoint<f64, J>,
        /// How many are at their limit.
        limited: i32,
        /// 0.
        reserved: i32,
    }
}

impl Wrench {
    /// Without force and moment.
    pub(crate) const NONE: Self = Self { force: [0.0; 3], moment: [0.0; 3] };

    pub(crate) fn from_wrench(wrench: &precess_dynamics::Wrench) -> Self {
        Self { force: wrench.force.into(), moment: wrench.moment.into() }
    }
}

impl Strut {
    /// All zero: no strut.
    pub(crate) const NONE: Self =
        Self { position: [0.0; 3], direction: [0.0; 3], length: 0.0, stiffness: 0.0, damping: 0.0 };
}

impl<const J: usize> Device<J> {
    /// All zero.
    pub(crate) const EMPTY: Self = {
        let body = Body { mass: 0.0, origin: [0.0; 3], centre: [0.0; 3], inertia: [0.0; 9] };
        let passive =
            Passive { stiffness: 0.0, rest: 0.0, viscous: 0.0, coulomb: 0.0, coulomb_rate: 0.0 };
        Self { kind: 0, model: 0, mount: [0.0; 9], bodies: [body; J], passive: [passive; J] }
    };
}

impl Entry {
    /// All zero.
    pub(crate) const EMPTY: Self = {
        let (stiffness, damping) = ([0.0; 36], [0.0; 36]);
        let suspension = Suspension { stiffness, rest: [0.0; 6], damping, strut: [Strut::NONE; 6] };
        Self { device: Device::EMPTY, on: 0, reserved: 0, suspension }
    };
}
