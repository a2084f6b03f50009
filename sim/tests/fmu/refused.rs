//! What is not in the solver in C is refused by its name.

use precess::fmu::Fmu;

use super::{UNIT, scenario};

/// What is put in the place of what, and what the error says.
const REFUSED: [(&str, &str, &str); 9] = [
    ("integrator = \"rk4\"\nstep = \"1 ms\"\n", "", "state the length by `--step`"),
    ("at_stop = \"end\"", "at_stop = \"lock\"", "a stop of panel.phi locks it"),
    ("torque_limit = \"0.2 N m\"", "rate_limit = \"6000 rpm\"", "the motor of rw.theta is limited"),
    (
        "damping = ",
        "static_friction = \"1 N m\"\ncoulomb = \"1 N m\"\ndamping = ",
        "friction of panel.phi",
    ),
    (
        "on = \"rw.wheel\"",
        "on = \"rw.wheel\"\naxes = \"inertial\"",
        "wrench 2 acts on a device's body",
    ),
    (
        "[run]",
        "[[at]]\ntime = \"50 ms\"\njoint = \"rw.wheel\"\ntorque = \"0 N m\"\n[run]",
        "the drive of rw.theta changes at 0.05 s",
    ),
    (
        "[run]",
        "[[source]]\nname = \"bearing\"\non = \"rw\"\nseed = 1\nharmonic = [{ number = 2.0, radial_force = \"1 g mm\" }]\n[run]",
        "source bearing",
    ),
    (
        "[run]",
        "[[platform]]\nname = \"isolator\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[run]",
        "isolator is an isolated platform",
    ),
    (
        "[run]",
        "[[controller]]\nname = \"aocs\"\nrate = \"20 Hz\"\ndevices = [\"other\"]\nlaw = { kind = \"rate_damping\", \
         rate_gain = \"1 N m s\" }\n[[device]]\nname = \"other\"\nkind = \"balanced_reaction_wheel\"\nwheel = { mass = \
         \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n[run]",
        "controller aocs",
    ),
];

#[test]
fn what_the_solver_in_c_has_not_is_refused_by_name() {
    Fmu::new(&scenario(UNIT)).expect("a unit");
    for (part, instead, expected) in REFUSED {
        assert!(UNIT.contains(part), "{part}");
        let of = scenario(&UNIT.replacen(part, instead, 1));
        let error = Fmu::new(&of).expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
        // Each says what to do.
        assert!(["remove", "state", "add"].iter().any(|word| error.contains(word)), "{error}");
    }
}

#[test]
fn a_hub_without_devices_is_refused() {
    let (hub, rest) = UNIT.split_once("[[device]]").expect("devices");
    let (_, run) = rest.split_once("[run]").expect("a run");
    let error = Fmu::new(&scenario(&format!("{hub}[run]{run}"))).expect_err("no unit").to_string();
    assert!(error.contains("there is no device"), "{error}");
}

#[test]
fn what_the_importer_has_to_give_is_noted() {
    let varied = UNIT
        .replace("torque = \"0.3 N m\"", "torque = { step = \"20 mN m\", at = \"50 ms\" }")
        .replace(
            "force = \"1, 2, -3 N\"",
            "force = { x = { constant = \"1 N\", from = \"10 ms\", to = \"20 ms\" } }",
        );
    let unit = Fmu::new(&scenario(&varied)).expect("a unit");
    let notes = unit.notes().join("\n");
    assert!(
        notes.contains("varies rw.u_w with time") && notes.contains("varies wrench 1 with time"),
        "{notes}"
    );
    assert_eq!(Fmu::new(&scenario(UNIT)).expect("a unit").notes(), [""; 0]);
}
