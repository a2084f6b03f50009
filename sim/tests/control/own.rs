//! Controllers of one's own, in Rust and as a program: the bits of a law that is built in, and what ends a program.

use std::path::Path;

use nalgebra::Vector3;
use precess::control::{Command, Controller, ControllerError, ControllerSample};
use precess::engine::{Advance, Run, RunQuantities};
use precess::file::from_toml;
use precess::record::End;
use precess::scenario::Scenario;

use super::{BUS, ran, read};

const START: &str = "[initial]\nangular_velocity = \"0.1, -0.2, 0.05 rad/s\"\n";
const RUN: &str = "[run]\nduration = \"5 s\"\nintegrator = \"rk4\"\nstep = \"50 ms\"\n[output]\nrate = \"4 Hz\"\n";

fn scenario(law: &str) -> Scenario {
    let controller = format!(
        "[[controller]]\nname = \"aocs\"\nrate = \"4 Hz\"\ndelay = \"0.1 s\"\nlaw = {{ {law} }}\n"
    );
    read(&format!("{BUS}{START}{controller}{RUN}"))
}

fn damped() -> Scenario {
    scenario("kind = \"rate_damping\", rate_gain = \"1 N m s\"")
}

/// Rate and attitude at the end, in bits.
fn end(mut run: Run<'_>) -> Vec<u64> {
    while let Advance::Stepped = run.advance().unwrap_or_else(|error| panic!("{error}")) {}
    let state = run.state();
    let q = state.attitude;
    let numbers = state.omega.iter().copied().chain([q.q0, q.q1, q.q2, q.q3]);
    numbers.map(f64::to_bits).collect()
}

/// Minus the angular velocity.
struct Damping;

impl Controller for Damping {
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        Ok(Command::Torque(-sample.of.motion.omega))
    }
}

#[test]
fn a_controller_in_rust_has_the_bits_of_the_law() {
    let scenario = damped();
    let law = end(Run::new(&scenario).expect("a run"));
    let own: Vec<(String, Box<dyn Controller>)> = vec![("aocs".to_owned(), Box::new(Damping))];
    let run = Run::with_controllers(&scenario, RunQuantities::All, own).expect("a run");
    assert_eq!(end(run), law);
    let none: Vec<(String, Box<dyn Controller>)> = vec![("rcs".to_owned(), Box::new(Damping))];
    let error = Run::with_controllers(&scenario, RunQuantities::All, none).err().expect("no rcs");
    assert_eq!(error.to_string(), "no controller is named `rcs`");
}

/// Torques of motors as they are: nothing is allocated.
struct Motors(usize);

impl Controller for Motors {
    fn sample(&mut self, _: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        Ok(Command::Motors(vec![0.01; self.0]))
    }
}

#[test]
fn torques_of_motors_are_held_as_they_are() {
    let scenario = damped();
    let with = |count| -> Vec<(String, Box<dyn Controller>)> {
        vec![("aocs".to_owned(), Box::new(Motors(count)))]
    };
    let mut run = Run::with_controllers(&scenario, RunQuantities::All, with(3)).expect("a run");
    while let Advance::Stepped = run.advance().expect("a step") {}
    // 4.9 s of 10 mN m on rotor and hub, which turns against it about each axis; coupled by the hub's rate.
    let spin = run.state().devices.0[2][0][1];
    assert!((spin - 0.01 * 4.9 / 0.02).abs() < 0.2, "{spin}");
    let error = Run::with_controllers(&scenario, RunQuantities::All, with(2)).err().expect("two");
    assert!(error.to_string().contains("2 torques of motors for 3 joints"), "{error}");
}

/// Answers in the shell: what is before the numbers of the first `omega` and behind them is cut off, and signs are
/// turned, so that minus the angular velocity is exact.
#[cfg(unix)]
const DAMPING: &str = r#"neg() { case $1 in -*) printf %s "${1#-}";; *) printf %s "-$1";; esac; }
read -r greeting
case $greeting in *'"protocol":1,"name":"aocs"'*'"rwx.wheel","commanded":"acceleration"'*) ;; *) exit 7;; esac
while read -r line; do
  omega=${line#*'"omega":['}; omega=${omega%%]*}
  x=${omega%%,*}; rest=${omega#*,}; y=${rest%%,*}; z=${rest#*,}
  printf '{"torque":[%s,%s,%s]}\n' "$(neg "$x")" "$(neg "$y")" "$(neg "$z")"
done"#;

#[cfg(unix)]
fn shell(script: &str, limit: &str) -> Scenario {
    let script = serde_json::to_string(script).expect("a text");
    scenario(&format!(
        "kind = \"program\", time_limit = \"{limit}\", command = [\"sh\", \"-c\", {script}]"
    ))
}

#[cfg(unix)]
#[test]
fn a_program_has_the_bits_of_the_law() {
    let law = damped();
    let law = end(Run::new(&law).expect("a run"));
    let program = shell(DAMPING, "60 s");
    assert_eq!(end(Run::new(&program).expect("a run")), law);
    // And in several runs at a time.
    let threads: Vec<_> = (0..3)
        .map(|_| std::thread::spawn(|| end(Run::new(&shell(DAMPING, "60 s")).expect("a run"))))
        .collect();
    for thread in threads {
        assert_eq!(thread.join().expect("a thread"), law);
    }
}

#[cfg(unix)]
#[test]
fn a_program_that_ends_or_is_silent_ends_the_run_with_what_there_is() {
    let answer = "read -r line; printf '{\"torque\":[0,0,0]}\\n';";
    let after =
        |samples: usize, then: &str| format!("read -r greeting; {}{then}", answer.repeat(samples));
    for (script, limit, message, ended) in [
        (after(5, "exit 3"), "60 s", "its program has ended (exit status: 3) and", 1.25),
        (after(5, "kill -9 $$"), "60 s", "its program has ended (signal: 9", 1.25),
        (after(5, "sleep 30"), "0.5 s", "its program does not answer within 0.5 s", 1.25),
        (
            // Two lines at once: the second one is not the answer to the next sample.
            after(4, "read -r l; printf '{\"torque\":[0,0,0]}\\n{\"torque\":[1,0,0]}\\n'; sleep 1"),
            "9 s",
            "its program answers before it is asked: {\"torque\":[1,0,0]}",
            1.0,
        ),
        (
            after(5, "read -r l; echo no; sleep 1"),
            "9 s",
            "answers no `torque`, `motors` or `error`: no",
            1.25,
        ),
        (
            after(5, "read -r l; echo '{\"error\":\"lost\"}'; sleep 1"),
            "9 s",
            "its program says: lost",
            1.25,
        ),
    ] {
        let scenario = shell(&script, limit);
        let begun = std::time::Instant::now();
        let (outcome, samples) = ran(&scenario);
        let End::Failed(error) = &outcome.end else { panic!("{message}: {}", outcome.end) };
        let shown = error.to_string();
        assert!(
            shown.contains(message) && shown.contains("controller `aocs`"),
            "{message}: {shown}"
        );
        assert_eq!((error.time(), outcome.end_time), (Some(ended), ended), "{shown}");
        // A sample at each quarter of a second, and the last.
        assert_eq!(outcome.samples, if ended > 1.0 { 6 } else { 5 }, "{shown}");
        assert_eq!(samples.column("time").and_then(|times| times.last().copied()), Some(ended));
        println!("{shown}: {:?}", begun.elapsed());
    }
}

/// Torques of motors leave nothing of an earlier torque in the columns.
#[cfg(unix)]
#[test]
fn columns_are_those_of_the_last_answer() {
    let script = "read -r greeting; read -r l; printf '{\"torque\":[1,0,0]}\\n'; \
                  while read -r l; do printf '{\"motors\":[0,0,0]}\\n'; done";
    let (outcome, samples) = ran(&shell(script, "60 s"));
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    for name in ["aocs.torque_x", "rwx.commanded_spin_dot", "aocs.measure"] {
        let of = samples.column(name).expect("a column");
        let nothing = |value: &f64| *value == 0.0 || (value.is_nan() && name == "aocs.measure");
        assert!(!nothing(&of[0]) && of[1..].iter().all(nothing), "{name}: {of:?}");
    }
}

#[test]
fn a_program_that_does_not_start_is_an_error_of_the_start() {
    let scenario = scenario("kind = \"program\", command = \"no-such-program-of-precess\"");
    let error = Run::new(&scenario).err().expect("no program");
    assert!(error.to_string().contains("`no-such-program-of-precess` does not start"), "{error}");
    let text = format!(
        "{BUS}[[controller]]\nname = \"aocs\"\nrate = \"4 Hz\"\nlaw = {{ kind = \"program\", command = \"x\", time_limit = \"0 s\" }}\n{RUN}"
    );
    let errors = from_toml("test.toml", &text, Path::new("")).expect_err("no time").to_string();
    assert!(errors.contains("0 s is not above 0 s"), "{errors}");
}

#[test]
fn numbers_that_are_not_finite_end_the_run() {
    struct Nothing;
    impl Controller for Nothing {
        fn sample(&mut self, _: &ControllerSample<'_>) -> Result<Command, ControllerError> {
            Ok(Command::Torque(Vector3::new(0.0, f64::NAN, 0.0)))
        }
    }
    let scenario = damped();
    let own: Vec<(String, Box<dyn Controller>)> = vec![("aocs".to_owned(), Box::new(Nothing))];
    let error = Run::with_controllers(&scenario, RunQuantities::All, own).err().expect("NaN");
    assert!(error.to_string().contains("number 2 of its answer is NaN"), "{error}");
}
