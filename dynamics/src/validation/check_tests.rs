//! Parameters that are rejected, with what is said of them.

use std::string::ToString;

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::validation::check::{check_device, check_hub};
use crate::validation::parameter_error::{Parameter, ParameterError, Part};
use crate::{Dgvscmg, Hub};

fn hub() -> Hub {
    Hub {
        m_b: 20.0,
        r_bc_b: Vector3::zeros(),
        i_b_bc: Matrix3::from_diagonal(&Vector3::new(4.0, 5.0, 8.0)),
    }
}

fn device() -> Dgvscmg {
    Dgvscmg::bare_wheel(4.0, Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1)))
}

fn rejected_hub(change: fn(&mut Hub)) -> (ParameterError, std::string::String) {
    let mut hub = hub();
    change(&mut hub);
    let error = check_hub(&hub).unwrap_err();
    (error, error.to_string())
}

fn rejected_device(change: fn(&mut Dgvscmg)) -> (ParameterError, std::string::String) {
    let mut device = device();
    change(&mut device);
    let error = check_device(2, &device).unwrap_err();
    (error, error.to_string())
}

#[test]
fn sound_parameters_pass() {
    assert_eq!(check_hub(&hub()), Ok(0.0));
    assert_eq!(check_device(0, &device()), Ok(()));
}

#[test]
fn rounding_of_a_mount_and_an_inertia_passes() {
    let turn = *Rotation3::from_euler_angles(0.3, -1.1, 2.7).matrix();
    let mut turned = device();
    turned.mount = turn * turn.transpose() * turn * turn;
    turned.i_w_wc = turn * turned.i_w_wc * turn.transpose();
    // A flat disc: the triangle inequality is an equality, and rounding does not warn.
    assert_eq!(check_device(0, &turned), Ok(()));
    // A rod: one principal moment is zero, to rounding.
    turned.i_gi_gic =
        turn * Matrix3::from_diagonal(&Vector3::new(0.0, 3.0, 3.0)) * turn.transpose();
    assert_eq!(check_device(0, &turned), Ok(()));
}

#[test]
fn mass_of_hub_and_wheel_must_be_above_zero() {
    let (error, text) = rejected_hub(|hub| hub.m_b = 0.0);
    assert_eq!(error, ParameterError::Mass { part: Part::Hub, massless: false, value: 0.0 });
    assert_eq!(
        text,
        "mass 0.0 kg of the hub is not above 0; only a body with a child body in its device may \
         be massless"
    );
    let (error, text) = rejected_device(|p| p.m_w = -4.0);
    assert_eq!(
        error,
        ParameterError::Mass {
            part: Part::Body { device: 2, body: "wheel" },
            massless: false,
            value: -4.0
        }
    );
    assert_eq!(
        text,
        "mass -4.0 kg of the wheel of device 2 is not above 0; only a body with a child body in \
         its device may be massless"
    );
}

#[test]
fn mass_of_a_gimbal_must_not_be_negative() {
    let (error, text) = rejected_device(|p| p.m_go = -1.0);
    let part = Part::Body { device: 2, body: "outer gimbal" };
    assert_eq!(error, ParameterError::Mass { part, massless: true, value: -1.0 });
    assert_eq!(
        text,
        "mass -1.0 kg of the outer gimbal of device 2 is below 0; use 0 for a massless one"
    );
    let (error, _) = rejected_device(|p| p.m_gi = -1e-300);
    let part = Part::Body { device: 2, body: "inner gimbal" };
    assert_eq!(error, ParameterError::Mass { part, massless: true, value: -1e-300 });
}

#[test]
fn every_number_must_be_finite() {
    let (error, text) = rejected_hub(|hub| hub.r_bc_b.y = f64::INFINITY);
    assert_eq!(
        error,
        ParameterError::NotFinite {
            part: Part::Hub,
            parameter: Parameter::CentreOfMass,
            value: f64::INFINITY
        }
    );
    assert_eq!(text, "centre of mass of the hub contains inf, which is not finite; give a number");
    for (change, beginning) in [
        ((|p| p.mount.m21 = f64::NAN) as fn(&mut Dgvscmg), "mount of the outer gimbal"),
        (|p| p.r_go_b.z = f64::NAN, "origin of the outer gimbal"),
        (|p| p.l_o.x = f64::NAN, "origin of the inner gimbal"),
        (|p| p.l_i.x = f64::NAN, "origin of the wheel"),
        (|p| p.m_go = f64::NAN, "mass of the outer gimbal"),
        (|p| p.m_gi = f64::NAN, "mass of the inner gimbal"),
        (|p| p.m_w = f64::NAN, "mass of the wheel"),
        (|p| p.r_goc_go.x = f64::NAN, "centre of mass of the outer gimbal"),
        (|p| p.r_gic_gi.x = f64::NAN, "centre of mass of the inner gimbal"),
        (|p| p.d = f64::NAN, "centre of mass of the wheel"),
        (|p| p.i_go_goc.m12 = f64::NAN, "inertia of the outer gimbal"),
        (|p| p.i_gi_gic.m33 = f64::NAN, "inertia of the inner gimbal"),
        (|p| p.i_w_wc.m31 = f64::NAN, "inertia of the wheel"),
    ] {
        let (_, text) = rejected_device(change);
        let expected = [beginning, " of device 2 contains NaN, which is not finite; give a number"];
        assert_eq!(text, expected.concat());
    }
    for change in [(|hub| hub.m_b = f64::NAN) as fn(&mut Hub), |hub| hub.i_b_bc.m22 = f64::NAN] {
        assert!(matches!(rejected_hub(change).0, ParameterError::NotFinite { .. }));
    }
}

#[test]
fn inertia_must_be_symmetric() {
    let (error, text) = rejected_device(|p| p.i_w_wc.m13 = 0.0625);
    // Half of it is the largest off-diagonal of the mean; the largest element is 0.2.
    let bound = 4096.0 * f64::EPSILON * 0.2;
    let part = Part::Body { device: 2, body: "wheel" };
    assert_eq!(
        error,
        ParameterError::Asymmetric { part, row: 1, column: 3, difference: 0.0625, bound }
    );
    assert_eq!(
        text,
        "inertia of the wheel of device 2: element 13 differs from element 31 by 0.0625 \
         kg m^2, more than 1.8189894035458566e-13; make the tensor symmetric"
    );
}

#[test]
fn inertia_must_not_be_negative() {
    let (error, text) = rejected_hub(|hub| hub.i_b_bc.m22 = -5.0);
    let ParameterError::NegativeInertia { part: Part::Hub, value, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(value, -5.0);
    assert_eq!(
        text,
        "smallest principal moment -5.0 kg m^2 of the hub is below -7.275957614183426e-12; \
         check the signs and units of its inertia"
    );
    // A negative direction that no diagonal element shows: eigenvalues 1 - 2 and 1 + 2.
    let (error, _) = rejected_device(|p| {
        p.i_go_goc = Matrix3::new(1.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    });
    assert!(matches!(
        error,
        ParameterError::NegativeInertia {
            part: Part::Body { device: 2, body: "outer gimbal" },
            ..
        }
    ));
}

#[test]
fn tiny_inertia_is_checked_like_any_other() {
    for size in [1e-310, f64::from_bits(1)] {
        let mut hub = hub();
        hub.i_b_bc = Matrix3::from_diagonal(&Vector3::new(-size, 0.0, 0.0));
        let error = check_hub(&hub).unwrap_err();
        let ParameterError::NegativeInertia { part: Part::Hub, value, .. } = error else {
            panic!("{error}");
        };
        assert_eq!(value, -size);
        // A point's worth of a rod: one moment of three, and it exceeds the sum of two zeros.
        hub.i_b_bc = Matrix3::from_diagonal(&Vector3::new(0.0, size, 0.0));
        assert_eq!(check_hub(&hub), Ok(size));
    }
}

#[test]
fn huge_inertia_is_accepted_while_its_moments_are_finite() {
    let mut hub = hub();
    hub.i_b_bc = Matrix3::from_diagonal(&Vector3::repeat(1.7e308));
    assert_eq!(check_hub(&hub), Ok(0.0));
    hub.i_b_bc = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, 1.7e308));
    let excess = check_hub(&hub).unwrap();
    assert!((excess / 1.7e308 - 1.0).abs() <= f64::EPSILON, "{excess}");
    hub.i_b_bc = Matrix3::from_diagonal(&Vector3::repeat(f64::MAX));
    assert_eq!(check_hub(&hub), Ok(0.0));

    let (error, text) = rejected_hub(|hub| hub.i_b_bc = Matrix3::repeat(1.7e308));
    assert_eq!(error, ParameterError::LargeInertia { part: Part::Hub, value: f64::INFINITY });
    assert_eq!(
        text,
        "largest principal moment inf kg m^2 of the hub is not finite; check the units of its \
         inertia"
    );
}

#[test]
fn mount_must_be_orthonormal() {
    let (error, text) = rejected_device(|p| p.mount *= 1.5);
    let bound = 4096.0 * f64::EPSILON;
    assert_eq!(error, ParameterError::SkewedMount { device: 2, residual: 1.25, bound });
    assert_eq!(
        text,
        "mount of device 2 is off orthonormal by 1.25, more than 9.094947017729282e-13; its \
         columns must be orthogonal unit vectors to full precision"
    );
    // Unit columns that are not orthogonal.
    let (error, _) = rejected_device(|p| {
        p.mount = Matrix3::new(1.0, 0.6, 0.0, 0.0, 0.8, 0.0, 0.0, 0.0, 1.0);
    });
    assert_eq!(error, ParameterError::SkewedMount { device: 2, residual: 0.6, bound });
}

#[test]
fn mount_must_be_right_handed() {
    let (error, text) = rejected_device(|p| p.mount.m33 = -1.0);
    assert_eq!(error, ParameterError::LeftHandedMount { device: 2, determinant: -1.0 });
    assert_eq!(
        text,
        "mount of device 2 has determinant -1.0, not 1; reverse one column to make it \
         right-handed"
    );
}

#[test]
fn friction_and_stiffness_must_not_be_negative() {
    let (error, text) = rejected_device(|d| d.passive.wheel.viscous = -0.5);
    let part = Part::Body { device: 2, body: "wheel" };
    assert_eq!(error, ParameterError::Passive { part, name: "viscous", value: -0.5 });
    assert_eq!(
        text,
        "viscous -0.5 of the joint of the wheel of device 2 is out of range; stiffness and friction \
         are not below 0, and coulomb friction needs a coulomb_rate above 0"
    );
    let (error, _) = rejected_device(|d| d.passive.inner_gimbal.coulomb = 0.1);
    let part = Part::Body { device: 2, body: "inner gimbal" };
    assert_eq!(error, ParameterError::Passive { part, name: "coulomb_rate", value: 0.0 });
    let (error, text) = rejected_device(|d| d.passive.outer_gimbal.rest = f64::INFINITY);
    let part = Part::Body { device: 2, body: "outer gimbal" };
    let parameter = Parameter::Passive("rest");
    assert_eq!(error, ParameterError::NotFinite { part, parameter, value: f64::INFINITY });
    assert!(text.starts_with("rest of the outer gimbal of device 2 contains inf"), "{text}");
}
