//! Dynamic mass of a spinning wheel at its mount: the force that a small motion of the mount takes.
//!
//! Linearised about a mount at rest and a steady spin `Omega`, with the rotor averaged over a turn: mass `m`,
//! first moment zero about W (the origin of the wheel, on its axis), inertia `J_s` about the axis `s` and the
//! mean `J_t` across it, both about W. With acceleration `a` and angular acceleration `alpha` of W, and
//! `alpha = i w omega`,
//!
//! ```text
//! h = J_t (1 - s s^T) omega + J_s Omega s       s' = omega x s       (angular momentum; a free spin keeps J_s Omega)
//! force  = m a
//! moment = J_t (1 - s s^T) alpha + J_s Omega omega x s = [J_t (1 - s s^T) + i (J_s Omega / w) s~] alpha
//! ```
//!
//! and `M_w = T^T M T` about the mount, with `T` the rigid motion of W by the mount's. The moment about the
//! axis of a free spin is zero: no inertia about it reaches the mount. Where the motor holds the relative
//! rate, `J_s s s^T` is added.
//!
//! What averaging leaves out turns with the rotor: the first moment `m d`, the difference of the moments
//! across the axis, and products of inertia. It couples motion at `w` with force at `w ± Omega` and
//! `w ± 2 Omega`, and changes the force at `w` in the second order of [`Wheel::periodic`].

use nalgebra::{Complex, DMatrix, Matrix3, Unit, Vector3};
use precess_dynamics::ReactionWheel;

use super::accelerance::{ComplexMatrix, complex};
use super::{Fault, RigidMass, rigid_rows};

/// What the wheel's motor does to small changes of its rate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Motor {
    /// Its torque does not change: the wheel spins freely.
    #[default]
    ConstantTorque,
    /// It holds the rate relative to the mount.
    ConstantRate,
}

/// A wheel on a mount, averaged over a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// Mass, kg.
    pub mass: f64,
    /// W from the mount, expressed in B, m.
    pub place: Vector3<f64>,
    /// Spin axis, expressed in B.
    pub axis: Unit<Vector3<f64>>,
    /// Inertia about the spin axis, kg m².
    pub spin_inertia: f64,
    /// Mean inertia across the spin axis, about W, kg m².
    pub transverse_inertia: f64,
    /// Rate relative to the mount, rad/s.
    pub rate: f64,
    /// What the motor does.
    pub motor: Motor,
    /// Mass properties of the housing about the mount, if it has one.
    pub housing: Option<RigidMass>,
    /// The largest periodic part of the first moment, over `sqrt(m J_t)`, and of the inertia, over `J_t`.
    pub periodic: [f64; 2],
}

impl Wheel {
    /// A reaction wheel whose mount is at `mount`, m, from B.
    ///
    /// # Errors
    /// [`Fault::Range`] where mass or inertia is not above zero, or a number not finite.
    pub fn from_reaction_wheel(
        wheel: &ReactionWheel,
        mount: &Vector3<f64>,
        rate: f64,
    ) -> Result<Self, Fault> {
        let across = Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, 1.0));
        let i = wheel.i_w_wc + across * (wheel.m_w * wheel.d * wheel.d);
        let positive = [f64::MIN_POSITIVE, 1e12];
        super::within("the wheel's mass, kg,".into(), wheel.m_w, positive)?;
        let transverse_inertia = 0.5 * (i.m22 + i.m33);
        super::within("the wheel's inertia, kg m²,".into(), transverse_inertia, positive)?;
        super::within("the wheel's inertia, kg m²,".into(), i.m11, [0.0, 1e12])?;
        super::within("the wheel's rate, rad/s,".into(), rate, [-1e6, 1e6])?;
        let difference = (0.5 * (i.m22 - i.m33)).hypot(i.m23);
        let inertia = difference.max(i.m12.hypot(i.m13)) / transverse_inertia;
        let moment = wheel.m_w * wheel.d.abs() / (wheel.m_w * transverse_inertia).sqrt();
        Ok(Self {
            mass: wheel.m_w,
            place: wheel.r_w_b - mount,
            axis: Unit::new_normalize(wheel.mount.column(0).into_owned()),
            spin_inertia: i.m11,
            transverse_inertia,
            rate,
            motor: Motor::ConstantTorque,
            housing: None,
            periodic: [moment, inertia],
        })
    }

    /// The 6 × 6 dynamic mass about the mount at an angular frequency, rad/s: kg, kg m, kg m².
    ///
    /// # Errors
    /// [`Fault::Range`] for a frequency that is not above zero.
    pub fn dynamic_mass(&self, frequency: f64) -> Result<ComplexMatrix, Fault> {
        let range = [f64::MIN_POSITIVE, 1e12];
        super::within("angular frequency, rad/s,".into(), frequency, range)?;
        let axis = self.axis.into_inner();
        let along = axis * axis.transpose();
        let spin = match self.motor {
            Motor::ConstantTorque => 0.0,
            Motor::ConstantRate => self.spin_inertia,
        };
        let inertia = (Matrix3::identity() - along) * self.transverse_inertia + along * spin;
        let gyroscopic = axis.cross_matrix() * (self.spin_inertia * self.rate / frequency);
        let mut mass = ComplexMatrix::zeros(6, 6);
        for row in 0..3 {
            mass[(row, row)] = Complex::new(self.mass, 0.0);
            for column in 0..3 {
                let at = (row, column);
                mass[(3 + row, 3 + column)] = Complex::new(inertia[at], gyroscopic[at]);
            }
        }
        let motion = rigid_rows(&self.place);
        let motion = complex(&DMatrix::from_column_slice(6, 6, motion.as_slice()));
        let mass = motion.transpose() * mass * motion;
        Ok(match &self.housing {
            None => mass,
            Some(housing) => {
                mass + complex(&DMatrix::from_column_slice(6, 6, housing.matrix().as_slice()))
            }
        })
    }
}
