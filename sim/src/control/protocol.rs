//! The lines of JSON between a controller and its program: greeting, sample and answer.
//!
//! One line of JSON each way for a sample. Numbers are written in the fewest digits that read back the same, so nothing is
//! lost on the way; what the program writes is read likewise.
//!
//! ```text
//! to the program, at its start:
//! {"protocol":1,"name":"aocs","rate":10.0,"offset":0.0,"delay":0.0,
//!  "joints":[{"name":"rw1.wheel","commanded":"acceleration"}],"inertia":[[..],[..],[..]]}
//! at each sample:
//! {"time":0.1,"attitude":[q0,q1,q2,q3],"omega":[..],"momentum":[..],"external":[..],"elapsed":0.1,"limited":false,
//!  "reference":{"attitude":[..],"omega":[..],"omega_dot":[..]},"joints":[[coordinate,rate],..]}
//! (with an accelerometer "specific_force":[..] behind the joints)
//! from the program, for each sample:
//! {"torque":[x,y,z]}    or    {"motors":[u,..]}    or    {"error":"why"}
//! ```

use std::fmt::Write as _;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Quaternion;
use serde_json::Value;

use super::{Command, ControllerError, ControllerSample};

/// The number of the protocol.
const PROTOCOL: u32 = 1;
/// What a program receives at its start.
#[derive(Clone, Copy, Debug)]
pub struct Greeting<'a> {
    /// Name of the controller.
    pub name: &'a str,
    /// Samples per second, Hz; time of the first; and delay, s.
    pub times: [f64; 3],
    /// Joints that it commands: `rw1.wheel`, and whether its rate, otherwise its acceleration, is what laws command.
    pub joints: &'a [(String, bool)],
    /// Inertia of the spacecraft about its centre of mass at the start, B, kg m².
    pub inertia: Matrix3<f64>,
}

impl Greeting<'_> {
    /// The line that greets.
    pub(super) fn line(&self) -> String {
        let [rate, offset, delay] = self.times;
        let joints: Vec<_> = self
            .joints
            .iter()
            .map(|(name, by_rate)| {
                let commanded = if *by_rate { "rate" } else { "acceleration" };
                format!("{{\"name\":{},\"commanded\":\"{commanded}\"}}", Value::from(name.as_str()))
            })
            .collect();
        let rows: Vec<_> =
            (0..3).map(|k| numbers(&[0, 1, 2].map(|j| self.inertia[(k, j)]))).collect();
        format!(
            "{{\"protocol\":{PROTOCOL},\"name\":{},\"rate\":{rate:?},\"offset\":{offset:?},\"delay\":{delay:?},\
             \"joints\":[{}],\"inertia\":[{}]}}\n",
            Value::from(self.name),
            joints.join(","),
            rows.join(",")
        )
    }
}

/// The line of a sample.
pub(super) fn line_of(sample: &ControllerSample<'_>) -> String {
    let of = &sample.of;
    let attitude = |q: &Quaternion| numbers(&[q.q0, q.q1, q.q2, q.q3]);
    let vector = |v: &Vector3<f64>| numbers(v.as_slice());
    let joints: Vec<_> = sample.joints.iter().map(|joint| numbers(joint)).collect();
    let mut line =
        format!("{{\"time\":{:?},\"attitude\":{}", sample.time, attitude(&of.motion.attitude));
    let force = sample.specific_force.map(|of| format!(",\"specific_force\":{}", vector(&of)));
    // Writing to a string cannot fail.
    let _ = writeln!(
        line,
        ",\"omega\":{},\"momentum\":{},\"external\":{},\"elapsed\":{:?},\"limited\":{},\
         \"reference\":{{\"attitude\":{},\"omega\":{},\"omega_dot\":{}}},\"joints\":[{}]{}}}",
        vector(&of.motion.omega),
        vector(&of.momentum),
        vector(&of.external),
        of.elapsed,
        of.limited,
        attitude(&of.reference.attitude),
        vector(&of.reference.omega),
        vector(&of.reference.omega_dot),
        joints.join(","),
        force.unwrap_or_default()
    );
    line
}

fn numbers(of: &[f64]) -> String {
    let each: Vec<_> = of.iter().map(|number| format!("{number:?}")).collect();
    format!("[{}]", each.join(","))
}

/// What a program answers.
pub(super) fn answer(line: &str) -> Result<Command, ControllerError> {
    let wrong = || {
        let shown = shown(line);
        because(&format!("its program answers no `torque`, `motors` or `error`: {shown}"))
    };
    let Ok(Value::Object(map)) = serde_json::from_str::<Value>(line) else { return Err(wrong()) };
    let list = |value: &Value| {
        let list = value.as_array()?;
        list.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>()
    };
    if let Some(Value::String(why)) = map.get("error") {
        return Err(because(&format!("its program says: {why}")));
    }
    match (map.get("torque").map(list), map.get("motors").map(list)) {
        (Some(Some(torque)), None) => {
            let torque = <[f64; 3]>::try_from(torque).map_err(|_| wrong())?;
            Ok(Command::Torque(Vector3::from(torque)))
        }
        (None, Some(Some(motors))) => Ok(Command::Motors(motors)),
        _ => Err(wrong()),
    }
}

/// The start of the first line of what a program writes.
pub(super) fn shown(of: &str) -> String {
    of.lines().next().unwrap_or_default().chars().take(100).collect()
}

/// An error of a program.
pub(super) fn because(reason: &str) -> ControllerError {
    ControllerError::Program { reason: reason.to_owned() }
}
