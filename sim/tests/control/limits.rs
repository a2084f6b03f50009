//! Limits of motors: the law and the columns have them.

use precess::record::Samples;

use super::{BUS, I_Z, K, P, column, controller, ran, read};

const TURNED: &str = "[initial.attitude]\naxis = [0, 0, 1]\nangle = \"40 deg\"\n";
const RUN: &str = "[run]\nduration = \"10 s\"\nintegrator = \"rk4\"\nstep = \"12.5 ms\"\n[output]\nrate = \"4 Hz\"\n";
/// `K_I`, 1/(kg m²).
const INTEGRAL: f64 = 0.01;

/// The bus turned about z, with more keys of its wheel along z, of its controller, and of the law.
fn ran_with(wheel: &str, keys: &str, law: &str) -> Samples {
    let along = "mount = { spin_axis = [0, 0, 1] }\nwheel = { ";
    let bus = BUS.replace(along, &format!("{along}{wheel}, "));
    assert_ne!(bus, BUS);
    ran(&read(&format!("{bus}{TURNED}{}{RUN}", controller(keys, law)))).1
}

/// The integral of the law at each sample, N m s: what is in its torque beyond attitude and rate.
fn integrals(samples: &Samples) -> Vec<f64> {
    let [q0, q3, omega, torque] =
        ["q0", "q3", "omega_z", "aocs.torque_z"].map(|name| column(samples, name));
    let each = q0.iter().zip(&q3).zip(omega.iter().zip(&torque));
    each.map(|((q0, q3), (omega, torque))| {
        let without = -K * (0.5 * q3.atan2(*q0)).tan() - P * omega;
        (without - torque) / (P * INTEGRAL) - I_Z * omega
    })
    .collect()
}

/// A wheel at its largest torque, power or rate: the column counts it, and the integral stops until the sample after it
/// has left the limit.
#[test]
fn the_integral_stops_while_a_motor_is_at_a_limit() {
    let law = format!("integral_gain = \"{INTEGRAL} 1/(kg m^2)\"\nintegral_limit = \"100 N m s\"");
    for limit in
        ["torque_limit = \"0.1 N m\"", "power_limit = \"5 W\"", "rate_limit = \"40 rad/s\""]
    {
        let samples = ran_with(limit, "", &law);
        let [limited, spin] = ["aocs.limited", "rwz.spin"].map(|name| column(&samples, name));
        let integral = integrals(&samples);
        println!("{limit}: {limited:?}\n{integral:?}\n{spin:?}");
        let (mut stopped, mut grown) = (0, 0);
        // No controller samples at the end.
        for k in 1..integral.len() - 2 {
            let grows = (integral[k + 1] - integral[k]).abs() > 1e-9;
            if limited[k] > 0.0 {
                stopped += 1;
                assert!(!grows, "{limit}, sample {k}: {} {}", integral[k], integral[k + 1]);
            } else if limited[k + 1] == 0.0 {
                grown += 1;
                assert!(grows, "{limit}, sample {k}: {}", integral[k]);
            }
        }
        println!("stopped {stopped}, grown {grown}");
        assert!(stopped > 10, "{limit}: {stopped}");
        assert!(limited.iter().all(|count| [0.0, 1.0].contains(count)), "{limit}: {limited:?}");
        assert!(grown > 0 || !limit.starts_with("rate"), "it is there before: {integral:?}");
    }
}

/// Commands of the inverse with the least largest one are within the torques of motors, as those of the others.
#[test]
fn the_least_largest_command_is_within_what_a_motor_gives() {
    let keys = "allocation = { inverse = \"least_largest\" }";
    let samples = ran_with("torque_limit = \"0.1 N m\"", keys, "");
    let [torque, error, command, limited] =
        ["aocs.torque_z", "aocs.torque_error_z", "rwz.commanded_spin_dot", "aocs.limited"]
            .map(|name| column(&samples, name));
    let mut clipped = 0;
    for (k, torque) in torque.iter().enumerate() {
        let given = torque.clamp(-0.1, 0.1);
        assert!((command[k] + given / 0.02).abs() < 1e-9, "{k}: {} for {torque}", command[k]);
        assert!((error[k] - (given - torque)).abs() < 1e-9, "{k}: {} for {torque}", error[k]);
        clipped += u32::from(torque.abs() > 0.1);
        assert_eq!(limited[k], f64::from(u8::from(torque.abs() > 0.1)), "{k}: {torque}");
    }
    assert!(clipped > 10, "{clipped}");
}

/// A command at its bound stays counted where the servo computes between samples; the motor itself is below its largest
/// torque, for the hub yields.
#[test]
fn a_bounded_command_is_counted_at_ticks_of_the_servo() {
    let samples = ran_with("torque_limit = \"0.1 N m\"", "servo = { rate = \"16 Hz\" }", "");
    let [torque, limited] = ["aocs.torque_z", "aocs.limited"].map(|name| column(&samples, name));
    for (k, torque) in torque.iter().enumerate() {
        assert_eq!(limited[k], f64::from(u8::from(torque.abs() > 0.1)), "{k}: {torque}");
    }
    assert!(torque.iter().any(|torque| torque.abs() > 0.1));
}
