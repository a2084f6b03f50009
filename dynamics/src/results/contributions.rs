//! [`DeviceContributions`]: what the devices add to the equations of the hub once their joints are eliminated, for a
//! program that has the hub itself and solves its equations; and [`JointGains`], by which the joints' accelerations follow.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::parameterisation::Attitude;
use crate::equations::assembly::Assembly;
use crate::equations::error::{Quantity, SolveError};
use crate::equations::joint_inputs::Environment;
use crate::equations::system::Solution;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, Vec3, add, components, scale, vector, zeros};
use crate::results::momentum::first_moments;
use crate::sets::devices::Devices;
use crate::sets::per_device as data;
use crate::solve::diagnosis::overflow;
use crate::solve::elimination::back_substitute;
use crate::solve::finite::all_finite;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// What the devices contribute to the equations of a hub that another program has, their joints eliminated. Everything
/// is expressed in B; the hub's own mass, inertia, force and torque are not in it.
///
/// The hub's equations are `(M_hub + M) [a; omega'] = h_hub + h`, with `a` the inertial acceleration of B; in a uniform field
/// `g`, expressed in B, that acceleration less `g`: gravity of the inputs is not read, nor are the hub's mode, force
/// and torque. The joints' accelerations are [`Spacecraft::joint_accelerations`] with that `a` and `omega'`: those on a
/// [prescribed hub](crate::HubMode::Prescribed), without gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceContributions<T = f64> {
    /// `M`, force by `a`, kg; symmetric.
    pub m_vv: Matrix3<T>,
    /// `M`, force by `omega'`, kg m; its transpose is moment by `a`.
    pub m_vw: Matrix3<T>,
    /// `M`, moment about B by `omega'`, kg m^2; symmetric.
    pub m_ww: Matrix3<T>,
    /// `h`, force, N.
    pub h_v: Vector3<T>,
    /// `h`, moment about B, N m.
    pub h_w: Vector3<T>,
    /// Mass of the devices, kg.
    pub mass: T,
    /// First moment of the devices about B, kg m.
    pub first_moment: Vector3<T>,
    /// Its derivative seen from B, kg m/s.
    pub first_moment_prime: Vector3<T>,
    /// Inertia of the devices about B, joints locked, kg m^2.
    pub inertia: Matrix3<T>,
}

/// What [`Spacecraft::joint_accelerations`] needs of an elimination: each joint's acceleration is linear in the hub's.
#[derive(Clone, Debug)]
pub struct JointGains<D: Devices>(pub(crate) D::Per<data::Gains>);

impl<D: Devices> Spacecraft<D> {
    /// What the devices contribute to the equations of the hub, their joints eliminated: motors, springs, friction and
    /// modes of the joints, and wrenches on the bodies, are those of the inputs.
    ///
    /// # Errors
    ///
    /// Those of [`Self::accelerations`] but for the hub's.
    pub fn device_contributions<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
    ) -> Result<DeviceContributions<D::Scalar>, SolveError<D::Scalar>> {
        self.eliminate_joints(state, inputs, &mut self.joint_gains())
    }

    /// Gains before any elimination: [`Self::joint_accelerations`] rejects them.
    pub fn joint_gains(&self) -> JointGains<D> {
        JointGains(D::new_data(&self.devices, &data::Gains))
    }

    /// [`Self::device_contributions`], and the gains by which the accelerations of the joints follow once those of the
    /// hub are known.
    ///
    /// # Errors
    ///
    /// Those of [`Self::device_contributions`]; the gains are then of no use.
    pub fn eliminate_joints<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        gains: &mut JointGains<D>,
    ) -> Result<DeviceContributions<D::Scalar>, SolveError<D::Scalar>> {
        if !self.are_finite(state, inputs) {
            return Err(self.diagnosis(state, inputs, overflow()));
        }
        let found = self.contributions(state, inputs, &mut gains.0);
        found.map_err(|failure| self.diagnosis(state, inputs, failure))
    }

    /// Accelerations of the joints, rad/s^2 or m/s^2, device by device, on a hub with the inertial acceleration `a` of B, less
    /// that of a uniform field, m/s^2, and the angular acceleration `omega_dot`, rad/s^2, both expressed in B.
    ///
    /// # Errors
    ///
    /// [`SolveError::NotFinite`] where an acceleration of the hub is infinite or NaN, [`SolveError::Overflow`] of the first
    /// joint whose acceleration is, as it is where the gains are not of these devices.
    pub fn joint_accelerations(
        &self,
        gains: &JointGains<D>,
        a: &Vector3<D::Scalar>,
        omega_dot: &Vector3<D::Scalar>,
    ) -> Result<D::Per<data::Accelerations>, SolveError<D::Scalar>> {
        let hub = Solution { r_b_n_ddot: components(a), omega_dot: components(omega_dot) };
        if !hub.is_finite() {
            let of = a.iter().chain(omega_dot).copied();
            let value = of.into_iter().find(|number| !number.is_finite()).unwrap_or(zero());
            return Err(SolveError::NotFinite { what: Quantity::HubAcceleration, value });
        }
        let mut found = D::new_data(&self.devices, &data::Accelerations);
        if back_substitute::<D>(&self.devices, &gains.0, &hub, &mut found) {
            return Ok(found);
        }
        let not_finite = found.values().zip(self.joints()).find(|(value, _)| !value.is_finite());
        let joint = not_finite.or_else(|| found.values().zip(self.joints()).next());
        let what = joint.map_or(Quantity::HubAcceleration, |(_, (device, info))| {
            Quantity::JointAcceleration { device, joint: info.body }
        });
        Err(SolveError::Overflow { what })
    }

    fn contributions<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
        gains: &mut D::Per<data::Gains>,
    ) -> Result<DeviceContributions<D::Scalar>, SolveError<D::Scalar>> {
        let omega = components(&state.omega);
        let environment = Environment { omega, central: None, impulse: false, reduction: None };
        let mut assembly = Assembly::new(&self.shares, zeros(), zeros());
        let (given, by) = (inputs.of_joints(), self.arithmetic);
        self.eliminate_devices(by, state, given, &environment, &mut assembly, gains)?;
        let [_, prime] = first_moments::<D>(&self.devices, &state.devices);
        let found = DeviceContributions::new(&assembly, omega, prime);
        if found.is_finite() { Ok(found) } else { Err(overflow()) }
    }
}

impl<T: Scalar> DeviceContributions<T> {
    /// Of devices whose joints are eliminated, on a hub that turns at `omega`, with the derivative of their first moment.
    pub(crate) fn new(assembly: &Assembly<T>, omega: Vec3<T>, prime: Vec3<T>) -> Self {
        let (body, system) = (assembly.body(), assembly.system(omega));
        Self {
            m_vv: symmetric(&system.m_vv),
            m_vw: matrix(&system.m_vw),
            m_ww: symmetric(&system.m_ww),
            h_v: vector(system.h_v),
            h_w: vector(system.h_w),
            mass: body.m_b,
            first_moment: vector(body.first_moment),
            first_moment_prime: vector(prime),
            inertia: symmetric(&body.i_b_b),
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let Self { m_vv, m_vw, m_ww, h_v, h_w, mass: _, first_moment, first_moment_prime, inertia } =
            self;
        // By one comparison: a number times zero is zero unless it is infinite or NaN.
        let mut vanishing = zeros();
        for matrix in [m_vv, m_vw, m_ww, inertia] {
            // Not by nalgebra's iterator of columns, which may panic.
            for column in matrix.data.0 {
                vanishing = add(vanishing, scale(zero(), column));
            }
        }
        let [x, y, z] = vanishing;
        all_finite([h_v, h_w, first_moment, first_moment_prime]) && x + y + z == zero()
    }
}

fn symmetric<T: Scalar>(of: &Symmetric<T>) -> Matrix3<T> {
    let Symmetric { xx, xy, xz, yy, yz, zz } = *of;
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

fn matrix<T: Scalar>([x, y, z]: &Columns<T>) -> Matrix3<T> {
    Matrix3::from_columns(&[vector(*x), vector(*y), vector(*z)])
}
