//! Seeded random spacecraft over the declared ranges.
//!
//! Declared: masses 0.1 to 5000 kg, lengths 0 to 3 m, valid inertias, `|omega|` to 1 rad/s, gimbal
//! rates to 5 rad/s, wheels to 6000 rpm, angles anywhere, 0 to 8 devices. Chosen within that:
//!
//! - hub 1 to 5000 kg, device bodies 0.1 kg to the hub's mass, all log-uniform: small ones are as
//!   likely as large ones, and no gimbal outweighs the hub;
//! - hub and gimbals are solid blocks with edges of 0.05 to 3 m (log-uniform) turned at random, so
//!   every inertia belongs to a real body and has no zero entry;
//! - wheels are solid discs of radius 0.02 to 0.5 m, thickness a tenth to one radius; their axis is
//!   tilted from the spin axis by 1e-6 to 0.1 rad and their centre lies 1e-6 m to one radius beside
//!   it (log-uniform both): from a catalogue wheel to a grossly imbalanced one;
//! - hub offset and device positions up to 3 m (uniform), offsets within a device 1 mm to 3 m
//!   (log-uniform), all in random directions; mounts and attitudes are uniform rotations;
//! - rates uniform up to their limits; gimbal angles in one turn, wheel angles in 160 turns either
//!   way;
//! - B within 100 m of the origin at up to 10 m/s; force to 100 N, torques to 10 N m (log-uniform
//!   from a hundred-thousandth of that).

mod generator;

use core::f64::consts::{PI, TAU};
use core::fmt::{self, Display, Formatter};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::{Joints, MotorTorques, PerJoint};
use precess_dynamics::{Dgvscmg, Hub, ImbalanceModel, Inputs, Passive, Quaternion, Scalar, State};

use crate::case::Case;
use generator::rotation_matrix;

pub use generator::Random;

/// All suites start here; spacecraft `n` of a suite is drawn from `SEED + n`.
pub const SEED: u64 = 0x1AC_17C1;

/// Devices of a random spacecraft: 0 to this many.
pub const MOST_DEVICES: usize = 8;

/// 6000 rpm.
const FASTEST_WHEEL: f64 = 6000.0 * TAU / 60.0;

/// A random spacecraft, kept so that it can be had in any scalar.
#[derive(Clone, Copy, Debug)]
pub struct Sample<const N: usize> {
    /// Its seed: with `N` all that is needed to have it again.
    pub seed: u64,
    case: Case<N>,
    mounts: [[f64; 4]; N],
    attitude: [f64; 4],
}

impl<const N: usize> Sample<N> {
    /// The spacecraft of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let random = &mut Random::new(seed);
        let m_b = random.log_within(1.0, 5000.0);
        let hub = Hub {
            m_b,
            r_bc_b: {
                let length = random.within(0.0, 3.0);
                random.vector(length)
            },
            i_b_bc: random.block(m_b),
        };
        let devices = core::array::from_fn(|_| random_device(random, m_b));
        let mounts = core::array::from_fn(|_| random.rotation());
        let attitude = random.rotation();
        let speed = random.within(0.0, 10.0);
        let turning = random.within(0.0, 1.0);
        let state = State {
            r_b_n: Vector3::from_fn(|_, _| random.within(-100.0, 100.0)),
            r_b_n_dot: random.vector(speed),
            attitude: Quaternion { q0: 1.0, q1: 0.0, q2: 0.0, q3: 0.0 },
            omega: random.vector(turning),
            devices: core::array::from_fn(|_| random_joints(random)),
            modal: (),
        };
        let force = random.signed(100.0);
        let torque = random.signed(10.0);
        let inputs = Inputs {
            force: random.vector(force),
            torque_b: random.vector(torque),
            motors: core::array::from_fn(|_| MotorTorques {
                u_o: random.signed(10.0),
                u_i: random.signed(10.0),
                u_w: random.signed(10.0),
            }),
            ..Inputs::none()
        };
        Self { seed, case: Case { hub, devices, state, inputs }, mounts, attitude }
    }

    /// The spacecraft in a scalar: numbers exactly as drawn, mounts orthonormal and the
    /// attitude of unit norm to the rounding of that scalar.
    #[must_use]
    pub fn case<T: Scalar>(&self) -> Case<N, T> {
        let mut case: Case<N, T> = self.case.converted();
        for (device, mount) in case.devices.iter_mut().zip(self.mounts) {
            device.mount = rotation_matrix(mount);
        }
        let [w, x, y, z] = self.attitude.map(T::from_f64);
        let share = (w * w + x * x + y * y + z * z).sqrt().recip();
        case.state.attitude =
            Quaternion { q0: w * share, q1: x * share, q2: y * share, q3: z * share };
        case
    }
}

/// All that is needed to have the spacecraft again.
impl<const N: usize> Display for Sample<N> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "seed {:#x}, N = {N}", self.seed)
    }
}

fn random_device(random: &mut Random, heaviest: f64) -> Dgvscmg {
    let mut mass = || random.log_within(0.1, heaviest);
    let (m_go, m_gi, m_w) = (mass(), mass(), mass());
    let mut offset = |longest: f64| {
        let length = random.log_within(1e-3, longest);
        random.vector(length)
    };
    let (r_goc_go, l_o, r_gic_gi, l_i) = (offset(3.0), offset(3.0), offset(3.0), offset(3.0));
    let distance = random.within(0.0, 3.0);
    let (i_w_wc, radius) = random.disc(m_w);
    Dgvscmg {
        mount: Matrix3::identity(),
        r_go_b: random.vector(distance),
        m_go,
        r_goc_go,
        i_go_goc: random.block(m_go),
        l_o,
        m_gi,
        r_gic_gi,
        i_gi_gic: random.block(m_gi),
        l_i,
        m_w,
        d: random.log_within(1e-6, radius),
        i_w_wc,
        passive: PerJoint::all(Passive::none()),
        model: ImbalanceModel::Coupled,
    }
}

fn random_joints(random: &mut Random) -> Joints {
    Joints {
        gamma_o: random.within(-PI, PI),
        gamma_i: random.within(-PI, PI),
        theta: random.within(-1000.0, 1000.0),
        gamma_o_dot: random.within(-5.0, 5.0),
        gamma_i_dot: random.within(-5.0, 5.0),
        spin: random.within(-FASTEST_WHEEL, FASTEST_WHEEL),
    }
}

/// Something to do with spacecraft of any number of devices.
pub trait Visitor {
    /// Called once a spacecraft; a failure message should give the `sample`, which says its seed.
    fn visit<const N: usize>(&mut self, sample: &Sample<N>);
}

/// Shows `count` spacecraft to a visitor, the number of devices going round from 0 to
/// [`MOST_DEVICES`]. Without the feature `shapes` only those of none, one and four devices: each number is code of its
/// own, minutes of it to compile.
pub fn visit(count: u64, visitor: &mut impl Visitor) {
    for number in 0..count {
        let seed = SEED + number;
        match number % (MOST_DEVICES as u64 + 1) {
            0 => visitor.visit(&Sample::<0>::new(seed)),
            1 => visitor.visit(&Sample::<1>::new(seed)),
            4 => visitor.visit(&Sample::<4>::new(seed)),
            #[cfg(feature = "shapes")]
            2 => visitor.visit(&Sample::<2>::new(seed)),
            #[cfg(feature = "shapes")]
            3 => visitor.visit(&Sample::<3>::new(seed)),
            #[cfg(feature = "shapes")]
            5 => visitor.visit(&Sample::<5>::new(seed)),
            #[cfg(feature = "shapes")]
            6 => visitor.visit(&Sample::<6>::new(seed)),
            #[cfg(feature = "shapes")]
            7 => visitor.visit(&Sample::<7>::new(seed)),
            #[cfg(feature = "shapes")]
            8 => visitor.visit(&Sample::<8>::new(seed)),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FASTEST_WHEEL, Sample, Visitor, visit};

    #[test]
    fn spacecraft_keep_to_the_declared_ranges() {
        struct Check([u32; 9]);
        impl Visitor for Check {
            fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
                self.0[N] += 1;
                let case = sample.case::<f64>();
                let warnings = case.spacecraft(sample).warnings().count();
                assert_eq!(warnings, 0, "a real body has a valid inertia: {sample}");

                let within = |x: f64, low: f64, high: f64| {
                    assert!((low..=high).contains(&x), "{x} in {low}..={high}");
                };
                let length = |v: &nalgebra::Vector3<f64>| within(v.norm(), 0.0, 3.0 + 1e-12);
                within(case.hub.m_b, 0.1, 5000.0);
                length(&case.hub.r_bc_b);
                within(case.state.omega.norm(), 0.0, 1.0 + 1e-12);
                for device in &case.devices {
                    for mass in [device.m_go, device.m_gi, device.m_w] {
                        within(mass, 0.1 - 1e-12, case.hub.m_b);
                    }
                    within(device.d, 0.0, 3.0);
                    let inner = [device.l_o, device.l_i, device.r_goc_go, device.r_gic_gi];
                    inner.iter().chain([&device.r_go_b]).for_each(length);
                }
                for joints in &case.state.devices {
                    within(joints.gamma_o_dot, -5.0, 5.0);
                    within(joints.gamma_i_dot, -5.0, 5.0);
                    within(joints.spin, -FASTEST_WHEEL, FASTEST_WHEEL);
                }
            }
        }
        let mut check = Check([0; 9]);
        visit(900, &mut check);
        let each =
            if cfg!(feature = "shapes") { [100; 9] } else { [100, 100, 0, 0, 100, 0, 0, 0, 0] };
        assert_eq!(check.0, each, "spacecraft of each number of devices");
    }
}
