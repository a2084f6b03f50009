//! [`ProgramController`]: a controller that is a program of its own, in lockstep over pipes.
//!
//! One line of JSON each way for a sample. Numbers are written in the fewest digits that read back the same, so nothing is
//! lost on the way; what the program writes is read likewise.
//!
//! ```text
//! to the program, at its start:
//! {"protocol":1,"name":"aocs","rate":10.0,"offset":0.0,"delay":0.0,
//!  "joints":[{"name":"rw1.wheel","commanded":"acceleration"}],"inertia":[[..],[..],[..]]}
//! at each sample:
//! {"time":0.1,"attitude":[q0,q1,q2,q3],"omega":[..],"momentum":[..],"elapsed":0.1,"limited":false,
//!  "reference":{"attitude":[..],"omega":[..],"omega_dot":[..]},"joints":[[coordinate,rate],..]}
//! from the program, for each sample:
//! {"torque":[x,y,z]}    or    {"motors":[u,..]}    or    {"error":"why"}
//! ```
//!
//! At the end of a run its standard input is closed; it then has the time limit of a sample to end, and is ended otherwise.

use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{Child, ChildStdin, Command as Program, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Quaternion;
use serde_json::Value;

use super::{Command, Controller, ControllerError, ControllerSample};

/// The number of the protocol.
const PROTOCOL: u32 = 1;
/// Longest line that a program may answer, bytes.
const LINE_MAX: u64 = 1 << 20;
/// How often it is looked whether a program has ended.
const PATIENCE: Duration = Duration::from_millis(5);

/// A program that answers samples.
pub struct ProgramController {
    child: Child,
    /// None once it is closed.
    input: Option<ChildStdin>,
    answers: Receiver<std::io::Result<String>>,
    limit: Duration,
}

/// What a program is told at its start.
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

impl ProgramController {
    /// Starts a program in a folder, and greets it.
    ///
    /// `limit` is how long it may take for an answer, s.
    ///
    /// # Errors
    ///
    /// [`ControllerError::Program`] where it cannot be started.
    pub fn start(
        command: &[String],
        folder: &Path,
        limit: f64,
        greeting: &Greeting<'_>,
    ) -> Result<Self, ControllerError> {
        let [name, arguments @ ..] = command else {
            return Err(because("no program is named"));
        };
        let mut program = Program::new(name);
        program.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped());
        if !folder.as_os_str().is_empty() {
            program.current_dir(folder);
        }
        let started = program.spawn();
        let mut child =
            started.map_err(|error| because(&format!("`{name}` does not start: {error}")))?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let (to, answers) = channel();
        if let Some(output) = output {
            thread::spawn(move || {
                let mut lines = BufReader::new(output);
                loop {
                    let mut line = String::new();
                    let read = std::io::Read::take(&mut lines, LINE_MAX).read_line(&mut line);
                    // At its end nothing more is read. Nobody listens once the run has ended.
                    if matches!(read, Ok(0)) || to.send(read.map(|_| line)).is_err() {
                        return;
                    }
                }
            });
        }
        let limit = Duration::try_from_secs_f64(limit).unwrap_or(Duration::MAX);
        let mut controller = Self { child, input, answers, limit };
        let line = greeting.line();
        controller.write(&line)?;
        Ok(controller)
    }

    fn write(&mut self, line: &str) -> Result<(), ControllerError> {
        let Some(input) = &mut self.input else { return Err(because("the program was closed")) };
        let written = input.write_all(line.as_bytes()).and_then(|()| input.flush());
        written.map_err(|error| self.ended(&format!("does not read: {error}")))
    }

    /// That a program has ended, with how it did.
    fn ended(&mut self, what: &str) -> ControllerError {
        let until = Instant::now() + Duration::from_millis(200);
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => {
                    return because(&format!("its program has ended ({status}) and {what}"));
                }
                _ if Instant::now() < until => thread::sleep(PATIENCE),
                _ => return because(&format!("its program {what}")),
            }
        }
    }
}

impl Controller for ProgramController {
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        self.write(&line_of(sample))?;
        match self.answers.recv_timeout(self.limit) {
            Ok(Ok(line)) => answer(&line),
            Ok(Err(error)) => Err(self.ended(&format!("cannot be read: {error}"))),
            Err(RecvTimeoutError::Timeout) => {
                let limit = self.limit.as_secs_f64();
                Err(because(&format!("its program does not answer within {limit} s")))
            }
            Err(RecvTimeoutError::Disconnected) => Err(self.ended("does not answer")),
        }
    }
}

impl Drop for ProgramController {
    fn drop(&mut self) {
        drop(self.input.take());
        let until = Instant::now() + self.limit.min(Duration::from_secs(10));
        while Instant::now() < until {
            match self.child.try_wait() {
                Ok(None) => thread::sleep(PATIENCE),
                Ok(Some(_)) | Err(_) => return,
            }
        }
        // It may have ended meanwhile.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Greeting<'_> {
    fn line(&self) -> String {
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
fn line_of(sample: &ControllerSample<'_>) -> String {
    let of = &sample.of;
    let attitude = |q: &Quaternion| numbers(&[q.q0, q.q1, q.q2, q.q3]);
    let vector = |v: &Vector3<f64>| numbers(v.as_slice());
    let joints: Vec<_> = sample.joints.iter().map(|joint| numbers(joint)).collect();
    let mut line =
        format!("{{\"time\":{:?},\"attitude\":{}", sample.time, attitude(&of.motion.attitude));
    // Writing to a string cannot fail.
    let _ = writeln!(
        line,
        ",\"omega\":{},\"momentum\":{},\"elapsed\":{:?},\"limited\":{},\
         \"reference\":{{\"attitude\":{},\"omega\":{},\"omega_dot\":{}}},\"joints\":[{}]}}",
        vector(&of.motion.omega),
        vector(&of.momentum),
        of.elapsed,
        of.limited,
        attitude(&of.reference.attitude),
        vector(&of.reference.omega),
        vector(&of.reference.omega_dot),
        joints.join(",")
    );
    line
}

fn numbers(of: &[f64]) -> String {
    let each: Vec<_> = of.iter().map(|number| format!("{number:?}")).collect();
    format!("[{}]", each.join(","))
}

/// What a program answers.
fn answer(line: &str) -> Result<Command, ControllerError> {
    let shown = || line.trim_end().chars().take(100).collect::<String>();
    let wrong =
        || because(&format!("its program answers no `torque`, `motors` or `error`: {}", shown()));
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

fn because(reason: &str) -> ControllerError {
    ControllerError::Program { reason: reason.to_owned() }
}
