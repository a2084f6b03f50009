//! Faulty parameters: each is rejected by a typed error that names it, with value, bound and
//! remedy; unusual but valid ones are accepted.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Hub, Inputs, Parameter, ParameterError, Part, Spacecraft, State, Warning};
use precess_tests::case::{Case, Set};
use precess_tests::table1::{self, Drive, Imbalance, pair};

/// The bodies of device 1.
const BODIES: [Part; 3] = [
    Part::Body { device: 1, body: "outer gimbal" },
    Part::Body { device: 1, body: "inner gimbal" },
    Part::Body { device: 1, body: "wheel" },
];

/// Sets one parameter to a number.
type Spoil = fn(&mut Case<2>, f64);

fn accepted<const N: usize>(case: &Case<N>) -> Spacecraft<Set<N>> {
    Spacecraft::new(&case.hub, &case.devices).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn rejected(spoil: impl FnOnce(&mut Case<2>)) -> ParameterError {
    let mut case = pair();
    accepted(&case);
    spoil(&mut case);
    match Spacecraft::new(&case.hub, &case.devices) {
        Ok(_) => panic!("the parameters were accepted"),
        Err(error) => error,
    }
}

#[test]
fn nan_in_any_parameter_is_named() {
    let [outer, inner, wheel] = BODIES;
    let spoils: [(Spoil, Part, Parameter); 22] = [
        (|c, x| c.hub.m_b = x, Part::Hub, Parameter::Mass),
        (|c, x| c.hub.r_bc_b.z = x, Part::Hub, Parameter::CentreOfMass),
        (|c, x| c.hub.i_b_bc[(1, 1)] = x, Part::Hub, Parameter::Inertia),
        (|c, x| c.devices[1].mount[(2, 0)] = x, outer, Parameter::Mount),
        (|c, x| c.devices[1].r_go_b.x = x, outer, Parameter::Origin),
        (|c, x| c.devices[1].m_go = x, outer, Parameter::Mass),
        (|c, x| c.devices[1].r_goc_go.y = x, outer, Parameter::CentreOfMass),
        (|c, x| c.devices[1].i_go_goc[(0, 0)] = x, outer, Parameter::Inertia),
        (|c, x| c.devices[1].l_o.z = x, inner, Parameter::Origin),
        (|c, x| c.devices[1].m_gi = x, inner, Parameter::Mass),
        (|c, x| c.devices[1].r_gic_gi.x = x, inner, Parameter::CentreOfMass),
        (|c, x| c.devices[1].i_gi_gic[(0, 2)] = x, inner, Parameter::Inertia),
        (|c, x| c.devices[1].l_i.y = x, wheel, Parameter::Origin),
        (|c, x| c.devices[1].m_w = x, wheel, Parameter::Mass),
        (|c, x| c.devices[1].d = x, wheel, Parameter::CentreOfMass),
        (|c, x| c.devices[1].i_w_wc[(2, 2)] = x, wheel, Parameter::Inertia),
        (|c, x| c.devices[1].i_w_wc[(2, 1)] = x, wheel, Parameter::Inertia),
        (|c, x| c.devices[1].passive.outer_gimbal.rest = x, outer, Parameter::Passive("rest")),
        (
            |c, x| c.devices[1].passive.inner_gimbal.viscous = x,
            inner,
            Parameter::Passive("viscous"),
        ),
        (|c, x| c.devices[1].passive.wheel.stiffness = x, wheel, Parameter::Passive("stiffness")),
        (|c, x| c.devices[1].passive.wheel.coulomb = x, wheel, Parameter::Passive("coulomb")),
        (
            |c, x| c.devices[1].passive.wheel.coulomb_rate = x,
            wheel,
            Parameter::Passive("coulomb_rate"),
        ),
    ];
    for (spoil, part, parameter) in spoils {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            match rejected(|case| spoil(case, bad)) {
                ParameterError::NotFinite { part: p, parameter: q, value } => {
                    assert_eq!((p, q), (part, parameter));
                    assert_eq!(value.to_bits(), bad.to_bits());
                }
                other => panic!("{parameter} of the {part}: {other}"),
            }
        }
    }
    assert_eq!(
        rejected(|case| case.devices[1].d = f64::NAN).to_string(),
        "centre of mass of the wheel of device 1 contains NaN, which is not finite; give a number",
    );
    assert_eq!(
        rejected(|case| case.hub.m_b = f64::INFINITY).to_string(),
        "mass of the hub contains inf, which is not finite; give a number",
    );
}

#[test]
fn hub_or_wheel_without_mass_is_rejected() {
    let error = rejected(|case| case.hub.m_b = 0.0);
    assert_eq!(error, ParameterError::Mass { part: Part::Hub, massless: false, value: 0.0 });
    assert_eq!(
        error.to_string(),
        "mass 0.0 kg of the hub is not above 0; only a body with a child body in its device may \
         be massless"
    );

    let [.., wheel] = BODIES;
    let error = rejected(|case| case.devices[1].m_w = 0.0);
    assert_eq!(error, ParameterError::Mass { part: wheel, massless: false, value: 0.0 });
    assert_eq!(
        error.to_string(),
        "mass 0.0 kg of the wheel of device 1 is not above 0; only a body with a child body in \
         its device may be massless",
    );
}

#[test]
fn negative_mass_is_rejected() {
    let [outer, _, wheel] = BODIES;
    let error = rejected(|case| case.hub.m_b = -810.0);
    assert_eq!(error, ParameterError::Mass { part: Part::Hub, massless: false, value: -810.0 });
    let error = rejected(|case| case.devices[1].m_w = -4.0);
    assert_eq!(error, ParameterError::Mass { part: wheel, massless: false, value: -4.0 });
    let error = rejected(|case| case.devices[1].m_go = -24.0);
    assert_eq!(error, ParameterError::Mass { part: outer, massless: true, value: -24.0 });
    let error = rejected(|case| case.devices[1].m_gi = -1e-9);
    assert_eq!(
        error.to_string(),
        "mass -1e-9 kg of the inner gimbal of device 1 is below 0; use 0 for a massless one",
    );
}

#[test]
fn inertia_with_a_negative_principal_moment_is_rejected() {
    // [1, 2; 2, 1] has the principal moments 3 and -1.
    let indefinite = Matrix3::new(1.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    for part in 0..4 {
        let error = rejected(|case| match part {
            0 => case.hub.i_b_bc = indefinite,
            1 => case.devices[1].i_go_goc = indefinite,
            2 => case.devices[1].i_gi_gic = indefinite,
            _ => case.devices[1].i_w_wc = indefinite,
        });
        let [outer, inner, wheel] = BODIES;
        let expected = [Part::Hub, outer, inner, wheel][part];
        let ParameterError::NegativeInertia { part, value, bound } = error else {
            panic!("{error}");
        };
        assert_eq!(part, expected);
        assert!((value + 1.0).abs() < 1e-14, "the smallest moment is -1, not {value}");
        assert!(bound < 0.0 && bound > -1e-11, "a bound of rounding, not {bound}");
        assert_eq!(
            error.to_string(),
            format!(
                "smallest principal moment {value:?} kg m^2 of the {expected} is below {bound:?}; \
                 check the signs and units of its inertia"
            ),
        );
    }
}

#[test]
fn asymmetric_inertia_is_rejected() {
    let error = rejected(|case| case.hub.i_b_bc[(0, 1)] += 0.5);
    let ParameterError::Asymmetric { part, row, column, difference, bound } = error else {
        panic!("{error}");
    };
    assert_eq!((part, row, column), (Part::Hub, 1, 2));
    assert!((difference - 0.5).abs() < 1e-12 && bound < 1e-8, "{difference}, {bound}");
    assert_eq!(
        error.to_string(),
        format!(
            "inertia of the hub: element 12 differs from element 21 by {difference:?} kg m^2, more \
             than {bound:?}; make the tensor symmetric"
        ),
    );
}

#[test]
fn skewed_mount_is_rejected() {
    let error = rejected(|case| case.devices[1].mount[(0, 1)] = 0.001);
    let ParameterError::SkewedMount { device: 1, residual, bound } = error else {
        panic!("{error}");
    };
    assert!((residual - 0.001).abs() < 1e-15 && bound < 1e-11, "{residual}, {bound}");
    assert_eq!(
        error.to_string(),
        format!(
            "mount of device 1 is off orthonormal by {residual:?}, more than {bound:?}; its \
             columns must be orthogonal unit vectors to full precision"
        ),
    );
}

#[test]
fn left_handed_mount_is_rejected() {
    let error = rejected(|case| case.devices[1].mount[(2, 2)] = -1.0);
    assert_eq!(error, ParameterError::LeftHandedMount { device: 1, determinant: -1.0 });
    assert_eq!(
        error.to_string(),
        "mount of device 1 has determinant -1.0, not 1; reverse one column to make it right-handed",
    );
}

/// `J_13` of the printed table: the largest principal moment is `0.15 + sqrt(0.05^2 + 0.0154^2)`.
#[test]
fn wheel_of_table_1_as_printed_is_accepted_with_a_warning() {
    let spacecraft = accepted(&table1::scenario(Imbalance::Printed, Drive::Free));
    let warnings: Vec<_> = spacecraft.warnings().collect();
    let [Warning::Triangle { part: Part::Body { device: 0, body: "wheel" }, excess }] =
        warnings[..]
    else {
        panic!("{warnings:?}");
    };
    let half_spread = 0.05_f64.hypot(0.0154);
    let expected = (0.15 + half_spread) - (0.15 - half_spread) - 0.1;
    assert!((excess - expected).abs() < 1e-15, "{excess} instead of {expected}");
    assert_eq!(
        warnings[0].to_string(),
        format!(
            "largest principal moment of the wheel of device 0 exceeds the sum of the other two by \
             {excess:?} kg m^2; no mass distribution has this inertia, check its moments and \
             products"
        ),
    );
}

#[test]
fn empty_device_list_is_a_plain_rigid_hub() {
    let hub = Hub { r_bc_b: Vector3::zeros(), ..table1::hub() };
    let spacecraft = Spacecraft::<Set<0>>::new(&hub, &[]).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(spacecraft.mass(), 810.0);
    assert_eq!(spacecraft.warnings().count(), 0);

    let inputs = Inputs { force: Vector3::new(81.0, 0.0, 0.0), ..Inputs::none() };
    let state: State<Set<0>> = State::at_rest();
    let found = spacecraft.accelerations(&state, &inputs).unwrap_or_else(|error| panic!("{error}"));
    assert!((found.r_b_n_ddot - Vector3::new(0.1, 0.0, 0.0)).norm() < 1e-16);
    assert!(found.omega_dot.norm() < 1e-16);
}
