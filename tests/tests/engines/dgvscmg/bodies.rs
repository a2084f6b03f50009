//! Motion of the bodies relative to B, from the emitted kernels of kinematics, expressed in B.

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_dynamics::generated::dgvscmg::{
    FirstMoment, InnerGimbal, OuterGimbal, Prepared, Rates, Trig, Wheel, first_moment,
    inner_gimbal, outer_gimbal, prepare, wheel,
};
use precess_tests::stored::{StoredDevice, symmetric};

use super::stored::StoredJoints;

/// One body: centre of mass from B with its derivatives, angular velocity, inertia about B.
pub(crate) struct Body {
    pub(crate) r: Vector3<f64>,
    pub(crate) r_prime: Vector3<f64>,
    pub(crate) r_dprime: Vector3<f64>,
    pub(crate) omega_b: Vector3<f64>,
    pub(crate) i_b: Matrix3<f64>,
}

/// `sum m r` of a device and its derivatives seen from B.
pub(crate) struct Moment {
    pub(crate) mc: Vector3<f64>,
    pub(crate) mc_prime: Vector3<f64>,
    pub(crate) mc_dprime: Vector3<f64>,
}

/// A device ready for its kernels.
pub(crate) struct Kernels {
    prepared: Prepared<f64>,
    trig: Trig<f64>,
    rates: Rates<f64>,
    accelerations: StoredJoints,
    axes: Axes,
}

/// The frames along which the kernels resolve, in B.
struct Axes {
    mount: Matrix3<f64>,
    outer: Matrix3<f64>,
    inner: Matrix3<f64>,
    wheel: Matrix3<f64>,
}

impl Kernels {
    pub(crate) fn new(device: &StoredDevice, accelerations: StoredJoints) -> Self {
        let (sin_gamma_o, cos_gamma_o) = libm::sincos(device.angles.gamma_o);
        let (sin_gamma_i, cos_gamma_i) = libm::sincos(device.angles.gamma_i);
        let (sin_theta, cos_theta) = libm::sincos(device.angles.theta);
        let turn = |axis, angle| *Rotation3::from_axis_angle(&axis, angle).matrix();
        let mount = device.mount();
        let outer = mount * turn(Vector3::z_axis(), device.angles.gamma_o);
        let inner = outer * turn(Vector3::y_axis(), device.angles.gamma_i);
        let wheel = inner * turn(Vector3::x_axis(), device.angles.theta);
        Self {
            prepared: prepare(&device.parameters),
            trig: Trig { sin_gamma_o, cos_gamma_o, sin_gamma_i, cos_gamma_i, sin_theta, cos_theta },
            rates: device.rates,
            accelerations,
            axes: Axes { mount, outer, inner, wheel },
        }
    }

    /// Outer gimbal, inner gimbal and wheel.
    pub(crate) fn bodies(&self) -> [Body; 3] {
        [self.outer(), self.inner(), self.wheel()]
    }

    #[rustfmt::skip]
    pub(crate) fn moment(&self) -> Moment {
        let FirstMoment {
            mc_bx, mc_by, mc_bz, mc_prime_bx, mc_prime_by, mc_prime_bz,
            mc_dprime_o_bx, mc_dprime_o_by, mc_dprime_o_bz,
            mc_dprime_i_bx, mc_dprime_i_by, mc_dprime_i_bz,
            mc_dprime_w_bx, mc_dprime_w_by, mc_dprime_w_bz,
            f_tilde_bx, f_tilde_by, f_tilde_bz,
        } = first_moment(&self.prepared, &self.trig, &self.rates);
        let mount = self.axes.mount;
        Moment {
            mc: mount * Vector3::new(mc_bx, mc_by, mc_bz),
            mc_prime: mount * Vector3::new(mc_prime_bx, mc_prime_by, mc_prime_bz),
            mc_dprime: mount * self.with_joints(
                [
                    [mc_dprime_o_bx, mc_dprime_o_by, mc_dprime_o_bz],
                    [mc_dprime_i_bx, mc_dprime_i_by, mc_dprime_i_bz],
                    [mc_dprime_w_bx, mc_dprime_w_by, mc_dprime_w_bz],
                ],
                [f_tilde_bx, f_tilde_by, f_tilde_bz],
            ),
        }
    }

    #[rustfmt::skip]
    fn outer(&self) -> Body {
        let OuterGimbal {
            omega_go_b_gox, omega_go_b_goy, omega_go_b_goz, r_goc_b_bx, r_goc_b_by, r_goc_b_bz,
            r_goc_b_prime_bx, r_goc_b_prime_by, r_goc_b_prime_bz,
            r_goc_b_dprime_o_bx, r_goc_b_dprime_o_by, r_goc_b_dprime_o_bz,
            r_goc_b_dprime_rest_bx, r_goc_b_dprime_rest_by, r_goc_b_dprime_rest_bz,
            i_go_b_11, i_go_b_12, i_go_b_13, i_go_b_22, i_go_b_23, i_go_b_33, ..
        } = outer_gimbal(&self.prepared, &self.trig, &self.rates);
        let Axes { mount, outer, .. } = self.axes;
        Body {
            r: mount * Vector3::new(r_goc_b_bx, r_goc_b_by, r_goc_b_bz),
            r_prime: mount * Vector3::new(r_goc_b_prime_bx, r_goc_b_prime_by, r_goc_b_prime_bz),
            r_dprime: mount * self.with_joints(
                [[r_goc_b_dprime_o_bx, r_goc_b_dprime_o_by, r_goc_b_dprime_o_bz], NONE, NONE],
                [r_goc_b_dprime_rest_bx, r_goc_b_dprime_rest_by, r_goc_b_dprime_rest_bz],
            ),
            omega_b: outer * Vector3::new(omega_go_b_gox, omega_go_b_goy, omega_go_b_goz),
            i_b: along(
                &outer, [i_go_b_11, i_go_b_12, i_go_b_13, i_go_b_22, i_go_b_23, i_go_b_33],
            ),
        }
    }

    #[rustfmt::skip]
    fn inner(&self) -> Body {
        let InnerGimbal {
            omega_gi_b_gix, omega_gi_b_giy, omega_gi_b_giz, r_gic_b_gox, r_gic_b_goy, r_gic_b_goz,
            r_gic_b_prime_gox, r_gic_b_prime_goy, r_gic_b_prime_goz,
            r_gic_b_dprime_o_gox, r_gic_b_dprime_o_goy, r_gic_b_dprime_o_goz,
            r_gic_b_dprime_i_gox, r_gic_b_dprime_i_goy, r_gic_b_dprime_i_goz,
            r_gic_b_dprime_rest_gox, r_gic_b_dprime_rest_goy, r_gic_b_dprime_rest_goz,
            i_gi_b_11, i_gi_b_12, i_gi_b_13, i_gi_b_22, i_gi_b_23, i_gi_b_33, ..
        } = inner_gimbal(&self.prepared, &self.trig, &self.rates);
        let Axes { outer, inner, .. } = self.axes;
        Body {
            r: outer * Vector3::new(r_gic_b_gox, r_gic_b_goy, r_gic_b_goz),
            r_prime: outer
                * Vector3::new(r_gic_b_prime_gox, r_gic_b_prime_goy, r_gic_b_prime_goz),
            r_dprime: outer * self.with_joints(
                [
                    [r_gic_b_dprime_o_gox, r_gic_b_dprime_o_goy, r_gic_b_dprime_o_goz],
                    [r_gic_b_dprime_i_gox, r_gic_b_dprime_i_goy, r_gic_b_dprime_i_goz],
                    NONE,
                ],
                [r_gic_b_dprime_rest_gox, r_gic_b_dprime_rest_goy, r_gic_b_dprime_rest_goz],
            ),
            omega_b: inner * Vector3::new(omega_gi_b_gix, omega_gi_b_giy, omega_gi_b_giz),
            i_b: along(
                &inner, [i_gi_b_11, i_gi_b_12, i_gi_b_13, i_gi_b_22, i_gi_b_23, i_gi_b_33],
            ),
        }
    }

    #[rustfmt::skip]
    fn wheel(&self) -> Body {
        let Wheel {
            omega_w_b_wx, omega_w_b_wy, omega_w_b_wz, r_wc_b_gix, r_wc_b_giy, r_wc_b_giz,
            r_wc_b_prime_gix, r_wc_b_prime_giy, r_wc_b_prime_giz,
            r_wc_b_dprime_o_gix, r_wc_b_dprime_o_giy, r_wc_b_dprime_o_giz,
            r_wc_b_dprime_i_gix, r_wc_b_dprime_i_giy, r_wc_b_dprime_i_giz,
            r_wc_b_dprime_w_gix, r_wc_b_dprime_w_giy, r_wc_b_dprime_w_giz,
            r_wc_b_dprime_rest_gix, r_wc_b_dprime_rest_giy, r_wc_b_dprime_rest_giz,
            i_w_b_11, i_w_b_12, i_w_b_13, i_w_b_22, i_w_b_23, i_w_b_33, ..
        } = wheel(&self.prepared, &self.trig, &self.rates);
        let Axes { inner, wheel, .. } = self.axes;
        Body {
            r: inner * Vector3::new(r_wc_b_gix, r_wc_b_giy, r_wc_b_giz),
            r_prime: inner * Vector3::new(r_wc_b_prime_gix, r_wc_b_prime_giy, r_wc_b_prime_giz),
            r_dprime: inner * self.with_joints(
                [
                    [r_wc_b_dprime_o_gix, r_wc_b_dprime_o_giy, r_wc_b_dprime_o_giz],
                    [r_wc_b_dprime_i_gix, r_wc_b_dprime_i_giy, r_wc_b_dprime_i_giz],
                    [r_wc_b_dprime_w_gix, r_wc_b_dprime_w_giy, r_wc_b_dprime_w_giz],
                ],
                [r_wc_b_dprime_rest_gix, r_wc_b_dprime_rest_giy, r_wc_b_dprime_rest_giz],
            ),
            omega_b: wheel * Vector3::new(omega_w_b_wx, omega_w_b_wy, omega_w_b_wz),
            i_b: along(&wheel, [i_w_b_11, i_w_b_12, i_w_b_13, i_w_b_22, i_w_b_23, i_w_b_33]),
        }
    }

    /// A second derivative from its share per joint acceleration and the rest.
    fn with_joints(&self, [o, i, w]: [[f64; 3]; 3], rest: [f64; 3]) -> Vector3<f64> {
        let StoredJoints { gamma_o_ddot, gamma_i_ddot, spin_dot } = self.accelerations;
        Vector3::from(o) * gamma_o_ddot
            + Vector3::from(i) * gamma_i_ddot
            + Vector3::from(w) * spin_dot
            + Vector3::from(rest)
    }
}

/// The share of a joint beyond the body.
const NONE: [f64; 3] = [0.0; 3];

/// A tensor along B, from its entries along turned axes.
fn along(axes: &Matrix3<f64>, entries: [f64; 6]) -> Matrix3<f64> {
    axes * symmetric(entries) * axes.transpose()
}
