//! [`DeviceContributions`]: what the devices add to the equations of the hub once their joints are eliminated, for a
//! program that has the hub itself and solves its equations.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::parameterisation::Attitude;
use crate::equations::assembly::Assembly;
use crate::equations::error::SolveError;
use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::Environment;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Columns, components, finite, vector, zeros};
use crate::results::momentum::first_moments;
use crate::sets::devices::{ConstantShares, Devices};
use crate::sets::per_device as data;
use crate::solve::diagnosis::overflow;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::State;

/// What the devices contribute to the equations of a hub that another program has, their joints eliminated. Everything
/// is expressed in B; the hub's own mass, inertia, force and torque are not in it.
///
/// The hub's equations are `(M_hub + M) [a; omega'] = h_hub + h`, with `a` the inertial acceleration of B; in a uniform field
/// `g`, expressed in B, that acceleration less `g`: gravity of the inputs is not read, nor are the hub's mode, force
/// and torque. The joints' accelerations are those on a [prescribed hub](crate::HubMode::Prescribed) with that `a` and `omega'`,
/// without gravity.
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
        if !self.are_finite(state, inputs) {
            return Err(self.diagnosis(state, inputs, overflow()));
        }
        let found = self.contributions(state, inputs);
        found.map_err(|failure| self.diagnosis(state, inputs, failure))
    }

    fn contributions<A: Attitude<D::Scalar>>(
        &self,
        state: &State<D, A>,
        inputs: &Inputs<D>,
    ) -> Result<DeviceContributions<D::Scalar>, SolveError<D::Scalar>> {
        let omega = components(&state.omega);
        let environment = Environment { omega, central: None, impulse: false, reduction: None };
        let nothing = HubConstants { m_b: zero(), first_moment: zeros(), i_b_b: Symmetric::zero() };
        let constant = nothing.with_constant_shares(D::list::<ConstantShares>(&self.devices));
        let mut assembly = Assembly::new(&constant, zeros(), zeros());
        let mut gains = D::new_data(&self.devices, &data::Gains);
        let (given, by) = (inputs.of_joints(), self.arithmetic);
        self.eliminate_devices(by, state, given, &environment, &mut assembly, &mut gains)?;
        let (body, system) = (assembly.body(), assembly.system(omega));
        let [_, prime] = first_moments::<D>(&self.devices, &state.devices);
        let found = DeviceContributions {
            m_vv: symmetric(&system.m_vv),
            m_vw: matrix(&system.m_vw),
            m_ww: symmetric(&system.m_ww),
            h_v: vector(system.h_v),
            h_w: vector(system.h_w),
            mass: body.m_b,
            first_moment: vector(body.first_moment),
            first_moment_prime: vector(prime),
            inertia: symmetric(&body.i_b_b),
        };
        if found.is_finite() { Ok(found) } else { Err(overflow()) }
    }
}

impl<T: Scalar> DeviceContributions<T> {
    fn is_finite(&self) -> bool {
        let vectors = [self.h_v, self.h_w, self.first_moment, self.first_moment_prime];
        let matrices = [self.m_vv, self.m_vw, self.m_ww, self.inertia];
        vectors.iter().map(components).all(finite)
            && matrices.iter().flat_map(Matrix3::iter).copied().all(Scalar::is_finite)
    }
}

fn symmetric<T: Scalar>(of: &Symmetric<T>) -> Matrix3<T> {
    let Symmetric { xx, xy, xz, yy, yz, zz } = *of;
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

fn matrix<T: Scalar>([x, y, z]: &Columns<T>) -> Matrix3<T> {
    Matrix3::from_columns(&[vector(*x), vector(*y), vector(*z)])
}
