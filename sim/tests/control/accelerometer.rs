//! An accelerometer in the loop: what it reads of the truth, its noise, and who reads it.

use precess::control::{Command, Controller, ControllerError, ControllerSample};
use precess::engine::{Advance, Run, RunQuantities};
use precess::file::to_toml;
use precess::record::Samples;
use precess::scenario::Scenario;

use super::{BUS, column, controller, ran, read};

const START: &str = "[gravity]\nuniform = \"1, -2, -9 m/s^2\"\n[initial]\nangular_velocity = \"0.2, -0.1, 0.5 rad/s\"\n\
    [initial.attitude]\naxis = [1, 2, 3]\nangle = \"40 deg\"\n";
/// Products of numbers up to ten that are summed in another order.
const ROUNDING: f64 = 1e-13;

fn text(keys: &str, more: &str, duration: &str) -> String {
    let run = format!(
        "[run]\nduration = \"{duration}\"\nintegrator = \"rk4\"\nstep = \"50 ms\"\n[output]\nrate = \"4 Hz\"\n"
    );
    // What a sample commands acts later: at the sample the torques are those of the columns.
    format!("{BUS}{START}{}{keys}\n{more}\n{run}", controller("delay = \"0.1 s\"", ""))
}

fn vector(samples: &Samples, name: &str) -> Vec<[f64; 3]> {
    let [x, y, z] = ["x", "y", "z"].map(|axis| column(samples, &format!("{name}_{axis}")));
    x.iter().zip(&y).zip(&z).map(|((x, y), z)| [*x, *y, *z]).collect()
}

/// Gravity expressed in B.
fn gravity(samples: &Samples) -> Vec<[f64; 3]> {
    let [q0, q1, q2, q3] = ["q0", "q1", "q2", "q3"].map(|name| column(samples, name));
    let in_b = |k: usize| {
        let turn = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(
            q0[k], q1[k], q2[k], q3[k],
        ));
        turn.inverse_transform_vector(&nalgebra::Vector3::new(1.0, -2.0, -9.0)).into()
    };
    (0..q0.len()).map(in_b).collect()
}

/// All samples but the last, at the end of the run, where no controller samples.
fn assert_specific_force(samples: &Samples, point: &str, bias: [f64; 3]) {
    let (read, truth) = (vector(samples, "aocs.accelerometer"), vector(samples, point));
    let gravity = gravity(samples);
    let mut largest = 0.0_f64;
    for k in 0..read.len() - 1 {
        for axis in 0..3 {
            let force = truth[k][axis] - gravity[k][axis];
            largest = largest.max(force.abs());
            let apart = (read[k][axis] - force - bias[axis]).abs();
            assert!(apart < ROUNDING, "{k} {axis}: {} {force}: {apart:e}", read[k][axis]);
        }
    }
    assert!(largest > 1e-2, "it turns: {largest}");
}

#[test]
fn it_reads_acceleration_less_gravity_at_a_point_of_the_hub() {
    let keys = "[controller.sensors.accelerometer]\nposition = \"0.3, -0.2, 0.5 m\"\nbias = \"1, 2, -3 mm/s^2\"";
    let point = "[[point]]\nname = \"imu\"\nposition = \"0.3, -0.2, 0.5 m\"";
    let scenario = read(&text(keys, point, "5 s"));
    let (outcome, samples) = ran(&scenario);
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    assert_specific_force(&samples, "imu.acceleration", [1e-3, 2e-3, -3e-3]);
    let written = to_toml(&scenario);
    assert_eq!(read(&written).controllers, scenario.controllers);
}

#[test]
fn it_reads_the_motion_of_a_node() {
    let keys = "[controller.sensors.accelerometer]\nnode = \"tip\"";
    let structure = "[structure]\ncontains_devices = false\n\
         [[structure.node]]\nname = \"base\"\nposition = \"0, 0, 0 m\"\n\
         [[structure.node]]\nname = \"tip\"\nposition = \"0, 1, 2 m\"\n\
         [[structure.point]]\nname = \"end\"\nnode = \"tip\"\n\
         [[structure.mode]]\nfrequency = \"0.7 Hz\"\ndamping = 0.01\nangular_momentum = [1.5, 0, 0.5]\n\
         [[structure.mode.shape]]\nnode = \"tip\"\ntranslation = [0.1, 0.8, 0.2]\nrotation = [0, 0, 0]";
    let on_base = text(keys, structure, "5 s")
        .replace("kind = \"balanced", "node = \"base\"\nkind = \"balanced");
    let (outcome, samples) = ran(&read(&on_base));
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    assert_specific_force(&samples, "end.acceleration", [0.0; 3]);
}

/// Of 6000 readings the variance is known to 1.8 percent, one standard deviation.
#[test]
fn its_noise_has_the_stated_density() {
    let keys =
        "[controller.sensors]\nseed = 3\naccelerometer = { noise_density = \"2 mm/s^2/sqrt(Hz)\" }";
    let (_, noisy) = ran(&read(&text(keys, "", "500 s")));
    let keys = "[controller.sensors]\nseed = 3\naccelerometer = {}";
    let (_, silent) = ran(&read(&text(keys, "", "500 s")));
    let (noisy, silent) =
        (vector(&noisy, "aocs.accelerometer"), vector(&silent, "aocs.accelerometer"));
    let rows = noisy.len() - 1;
    let square =
        |k: usize| (0..3).map(|axis| (noisy[k][axis] - silent[k][axis]).powi(2)).sum::<f64>();
    #[expect(clippy::cast_precision_loss, reason = "thousands")]
    let variance = (0..rows).map(square).sum::<f64>() / (3 * rows) as f64;
    // One-sided up to half of the rate.
    let stated = 2e-3_f64.powi(2) * 2.0;
    assert!((variance / stated - 1.0).abs() < 0.075, "{variance:e} {stated:e}");
}

/// No torque; it notes what it reads.
struct Listening(std::sync::mpsc::Sender<Option<[f64; 3]>>);

impl Controller for Listening {
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        let told = sample.specific_force.map(Into::into);
        self.0
            .send(told)
            .map_err(|error| ControllerError::Program { reason: error.to_string() })?;
        Ok(Command::Torque(nalgebra::Vector3::zeros()))
    }
}

fn told(scenario: &Scenario) -> Vec<Option<[f64; 3]>> {
    let (to, from) = std::sync::mpsc::channel();
    let own: Vec<(String, Box<dyn Controller>)> =
        vec![("aocs".to_owned(), Box::new(Listening(to)))];
    let mut run = Run::with_controllers(scenario, RunQuantities::All, own).expect("a run");
    while let Advance::Stepped = run.advance().unwrap_or_else(|error| panic!("{error}")) {}
    drop(run);
    from.iter().collect()
}

#[test]
fn controllers_of_ones_own_are_told() {
    let keys = "[controller.sensors.accelerometer]\nposition = \"0.3, -0.2, 0.5 m\"";
    let with = told(&read(&text(keys, "", "2 s")));
    assert_eq!(with.len(), 8);
    assert!(with.iter().all(|of| of.is_some_and(|of| of.iter().any(|a| a.abs() > 1e-3))));
    assert!(told(&read(&text("", "", "2 s"))).iter().all(Option::is_none));
}

/// A program ends the run where its line has no reading.
#[cfg(unix)]
#[test]
fn programs_are_told() {
    let program = r#"law = { kind = "program", command = ["sh", "-c", '''read start
while read line; do case "$line" in
*'"specific_force":['*) echo '{"torque":[0,0,0]}';;
*) echo '{"error":"not told"}';;
esac; done'''] }"#;
    let own = |sensors: &str| {
        let text = format!(
            "{BUS}{START}[[controller]]\nname = \"aocs\"\nrate = \"4 Hz\"\noffset = \"0.5 s\"\n{program}\n{sensors}\n\
             [run]\nduration = \"2 s\"\n[output]\nrate = \"4 Hz\"\n"
        );
        ran(&read(&text)).0.end
    };
    let told = own("[controller.sensors]\naccelerometer = {}");
    assert!(told.is_complete(), "{told}");
    let silent = own("").to_string();
    assert!(silent.contains("not told"), "{silent}");
}
