//! Whether accelerations solve the equations: inverse dynamics of the computed accelerations.
//!
//! Errors are in epsilons of the [`sizes`](super::sizes) of what is added, so they do not depend on
//! conditioning: a backward error.

use nalgebra::Vector3;
use precess_dynamics::{
    Accelerations, Devices, Each, HubMode, JointArray, LoadAxes, Mode, Scalar, Spacecraft,
};

use super::call_results::{no_accelerations, of_accelerations};
use super::case::{Case, List, PreparedCase};
use super::sizes::sizes;
use super::{Checked, Verdict};

/// Backward error of accelerations, in epsilons of the sizes: the worst of 40 000 cases is 1.3, in
/// `f32` as in `f64`.
pub const BACKWARD: f64 = 10.0;

/// Accelerations of a list from their numbers.
///
/// # Errors
/// Where not even a spacecraft at rest can be evaluated.
pub fn from_numbers<T: Scalar>(
    craft: &Spacecraft<List<T>>,
    numbers: &[T],
) -> Result<Accelerations<List<T>>, String> {
    let mut found = no_accelerations(craft).ok_or("a spacecraft at rest overflows")?;
    let hub = found.r_b_n_ddot.iter_mut().chain(found.omega_dot.iter_mut());
    hub.chain(found.devices.iter_mut().flat_map(JointArray::as_mut_slice))
        .zip(numbers)
        .for_each(|(to, from)| *to = *from);
    Ok(found)
}

/// The largest backward error of accelerations, in epsilons of their number, and where.
///
/// # Errors
/// What inverse dynamics rejects, and a prescribed acceleration that differs from the computed one.
pub fn residual<T: Scalar>(
    case: &Case,
    list: &PreparedCase<List<T>>,
    numbers: &[T],
) -> Result<(f64, String), String> {
    let PreparedCase { craft, state, inputs } = list;
    let found = from_numbers(craft, numbers)?;
    let loads = craft
        .loads(state, inputs, &found, LoadAxes::Body)
        .map_err(|error| format!("loads of these accelerations: {error}"))?;
    let sizes = sizes(case, &case.state, &case.inputs, &wide(numbers));
    let mut worst = (0.0, String::new());
    let mut add = |error: f64, size: f64, what: String| {
        let error = if error == 0.0 { 0.0 } else { error / (T::EPSILON.to_f64() * size) };
        if error > worst.0 || error.is_nan() {
            worst = (error, what);
        }
    };
    match inputs.hub {
        HubMode::Free => {
            let [force, moment] = [loads.hub.force, loads.hub.moment];
            let norm = |v: Vector3<T>| v.map(Scalar::to_f64).norm();
            add(norm(force), sizes.force, "force on the hub".to_owned());
            add(norm(moment), sizes.moment, "moment on the hub".to_owned());
        }
        HubMode::Fixed if wide(numbers).iter().take(6).any(|x| *x != 0.0) => {
            return Err(format!("fixed hub accelerates: {numbers:?}"));
        }
        HubMode::Prescribed { r_b_n_ddot, omega_dot }
            if (found.r_b_n_ddot, found.omega_dot) != (r_b_n_ddot, omega_dot) =>
        {
            return Err(format!("prescribed hub accelerates otherwise: {numbers:?}"));
        }
        _ => {}
    }
    let motors = loads.devices.iter().flat_map(|device| device.motors.values());
    let drives = inputs.motors.values().zip(inputs.modes.values());
    let joints = motors.zip(drives).zip(craft.joints()).zip(numbers.iter().skip(6));
    for (index, (((motor, (given, mode)), (device, info)), found)) in joints.enumerate() {
        let what = format!("torque at the {} of device {device}", info.body);
        let held = match mode {
            Mode::Driven => {
                let error = (motor.to_f64() - given.to_f64()).abs();
                add(error, sizes.joints.get(index).copied().unwrap_or_default(), what);
                continue;
            }
            Mode::Prescribed(acceleration) => acceleration,
            Mode::Locked => T::from_f64(0.0),
        };
        if *found != held {
            return Err(format!("{what}: accelerates at {found:?}, not as given at {held:?}"));
        }
    }
    Ok(worst)
}

/// Whether accelerations solve the equations to rounding.
///
/// # Errors
/// Where they do not.
pub fn solves<T: Scalar>(
    case: &Case,
    list: &PreparedCase<List<T>>,
    numbers: &[T],
    what: &str,
) -> Verdict {
    match residual(case, list, numbers) {
        Ok((error, _)) if error <= BACKWARD => Ok(Checked::Holds),
        Ok((error, block)) => Err(format!("{what}: {error:.1} epsilons in the {block}")),
        Err(error) => Err(format!("{what}: {error}")),
    }
}

/// `inverse-dynamics-residual`: loads of the accelerations need no wrench on a free hub and give
/// back the torque of each driven motor, in `f64` and `f32`.
///
/// # Errors
/// Where it does not hold.
pub fn inverse_dynamics(case: &Case) -> Verdict {
    let Ok(list) = case.list() else { return Ok(Checked::Rejected) };
    let mut checked = Checked::Rejected;
    if let Ok(found) = list.craft.accelerations(&list.state, &list.inputs) {
        checked = solves(case, &list, &of_accelerations(&found), "accelerations")?;
    }
    if let Ok(single) = case.placed(&case.devices_in::<f32>())
        && let Ok(found) = single.craft.accelerations(&single.state, &single.inputs)
    {
        checked = solves(case, &single, &of_accelerations(&found), "accelerations in f32")?;
    }
    Ok(checked)
}

/// Numbers of any kind in `f64`.
pub fn wide<T: Scalar>(numbers: &[T]) -> Vec<f64> {
    numbers.iter().map(|number| number.to_f64()).collect()
}

/// The numbers of accelerations in `f64`.
pub fn numbers<D: Devices>(found: &Accelerations<D>) -> Vec<f64> {
    wide(&of_accelerations(found))
}
