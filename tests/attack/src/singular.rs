//! A singular mass matrix is rejected in every service.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, BuiltIn, Dgcmg, Dgvscmg,
    HingedPanel, Hub, JointStates, ReactionWheel, Sgcmg, SloshMass, SolveError, Vscmg,
};
use proptest::prelude::{BoxedStrategy, Strategy};

use super::bodies::rotation;
use super::call_results::CallResult;
use super::case::{Case, List, PreparedCase};
use super::number::Number;
use super::residual::numbers;
use super::shapes::{ABREAST, across, batched, in_every_shape};
use super::{Checked, Verdict};

/// Forms of a spacecraft that is singular.
const FORMS: usize = 15;

/// Cases that are singular exactly, but for rounding.
pub fn cases() -> BoxedStrategy<Case> {
    let turn =
        (Number::new(1.0, |r| r.within(-1.0, 1.0)), [(); 3].map(|()| Number::within(-1.0, 1.0)));
    let angles = [(); 3].map(|()| Number::within(-1.0, 1.0));
    let rates = [(); 3].map(|()| Number::within(-1.0, 1.0));
    let sizes = [Number::log_within(1e-3, 1e3), Number::log_within(1e-2, 1e2)];
    (0..FORMS, turn, angles, rates, sizes)
        .prop_map(|(form, (w, [x, y, z]), angles, rates, [mass, length])| {
            spacecraft(form, rotation([w, x, y, z]), angles, rates, [mass, length])
        })
        .boxed()
}

fn spacecraft(
    form: usize,
    mount: Matrix3<f64>,
    [a, b, c]: [f64; 3],
    rates: [f64; 3],
    [mass, length]: [f64; 2],
) -> Case {
    let inertia = mass * length * length;
    let disc = Matrix3::from_diagonal(&(inertia * Vector3::new(0.2, 0.1, 0.1)));
    let (j_11, j_22) = (0.2 * inertia, 0.1 * inertia);
    let nothing = Matrix3::zeros();
    let m_w = 4.0 * mass;
    let point = Hub { m_b: 10.0 * mass, r_bc_b: Vector3::zeros(), i_b_bc: nothing };
    let body =
        Hub { i_b_bc: Matrix3::from_diagonal(&(inertia * Vector3::new(9.0, 8.0, 6.0))), ..point };
    let panel = HingedPanel {
        mount,
        r_pc_p: length * Vector3::new(a, b, c),
        ..HingedPanel::bare_panel(m_w, disc)
    };
    let locked = |spins: f64| FRAC_PI_2 * (1.0 + 2.0 * (2.0 * spins).trunc());
    // A point mass on the outer gimbal's axis, where the inner gimbal brings it.
    let (sin, cos) = a.sin_cos();
    let (long, short) =
        (length * Vector3::new(cos, 0.0, 0.0), length * Vector3::new(-1.0, 0.0, 0.0));
    let on_axis = Dgcmg { mount, l_o: long, l_i: short, ..Dgcmg::bare_wheel(m_w, nothing) };
    let off_axis = Dgcmg { l_o: length * Vector3::new(0.3, 0.0, 0.0), ..on_axis };
    let good = Dgvscmg { mount, m_go: m_w, i_go_goc: disc, ..Dgvscmg::bare_wheel(m_w, disc) };
    let bare = Dgvscmg { mount, ..Dgvscmg::bare_wheel(m_w, disc) };
    let axis = length * Vector3::new(0.0, 0.0, 1.0 + c);
    let _ = sin;
    // The hub, the devices, and the angle of the inner gimbal.
    let (hub, devices, gamma_i): (Hub, List, f64) = match form {
        0 => (point, vec![bare.into()], a),
        1 => {
            (point, vec![ReactionWheel { mount, ..ReactionWheel::bare_wheel(m_w, disc) }.into()], a)
        }
        2 => {
            let wheel = BalancedReactionWheel::bare_wheel(m_w, j_11, j_22);
            (point, vec![BalancedReactionWheel { mount, ..wheel }.into()], a)
        }
        3 => (point, vec![Vscmg { mount, ..Vscmg::bare_wheel(m_w, disc) }.into()], a),
        4 => {
            let double = BalancedDgvscmg::bare_wheel(m_w, j_11, j_22);
            (point, vec![BalancedDgvscmg { mount, ..double }.into()], a)
        }
        5 => {
            let single = BalancedVscmg::bare_wheel(m_w, j_11, j_22);
            (point, vec![BalancedVscmg { mount, ..single }.into()], a)
        }
        6 => (point, vec![Sgcmg { mount, ..Sgcmg::bare_wheel(m_w, disc) }.into()], a),
        7 => {
            let single = BalancedSgcmg::bare_wheel(m_w, j_11, j_22);
            (point, vec![BalancedSgcmg { mount, ..single }.into()], a)
        }
        8 => (point, vec![panel.into()], a),
        9 => (point, vec![SloshMass { mount, ..SloshMass::bare_slosh_mass(m_w) }.into()], a),
        10 => (body, vec![on_axis.into()], a),
        11 => {
            let mut devices = vec![BuiltIn::from(off_axis); ABREAST];
            devices[3] = on_axis.into();
            (body, devices, a)
        }
        12 => {
            let panel = HingedPanel { r_pc_p: axis, i_p_pc: nothing, ..panel };
            (body, vec![panel.into()], a)
        }
        13 => (body, vec![bare.into()], locked(b)),
        _ => {
            let mut devices = vec![BuiltIn::from(good); ABREAST];
            devices[2] = bare.into();
            (body, devices, locked(b))
        }
    };
    let mut case = Case::still(hub, devices);
    let infos: Vec<_> = case.devices.iter().flat_map(|device| device.kind().joints()).collect();
    let [p, q, r] = rates;
    for ([angle, rate], info) in case.state.devices.states_mut().zip(infos) {
        (*angle, *rate) = match info.body {
            "inner gimbal" => (gamma_i, p),
            "wheel" => (c, 100.0 * q),
            "slosh mass" => (0.1 * length * b, r),
            _ => (b, r),
        };
    }
    case.state.omega = 0.1 * Vector3::from(rates);
    case
}

/// `singular-is-refused`: a spacecraft without inertia where something turns freely is rejected by
/// every service.
///
/// # Errors
/// Where it does not hold.
pub fn singular_is_refused(case: &Case) -> Verdict {
    let refused = |result: &CallResult, what: &str| match result {
        Err(SolveError::Singular { .. }) => Ok(()),
        other => Err(format!("{what} gives {other:?}")),
    };
    in_every_shape!(case, f64, |shape, placed| {
        let PreparedCase { craft, state, inputs } =
            placed.map_err(|error| format!("parameters are rejected: {error}"))?;
        refused(&craft.accelerations(&state, &inputs).map(|f| numbers(&f)), shape)?;
        let step = craft.step(&state, &inputs, case.dt);
        refused(&step.map(|_| Vec::new()), &format!("step of {shape}"))?;
        let stop = craft.stop(&state, &inputs);
        refused(&stop.map(|_| Vec::new()), &format!("stop of {shape}"))?;
    });
    for (call, result) in across(case).unwrap_or_default() {
        refused(&result, call)?;
    }
    if let Some(found) = batched(case, false) {
        refused(&found.accelerations[0], "batch")?;
        refused(&found.runs[0].1.map(|()| Vec::new()), "run of a batch")?;
    }
    Ok(Checked::Holds)
}
