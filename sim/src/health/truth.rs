//! Scenarios of a case: what is watched, and the truth before and after its change.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use nalgebra::Vector3;
use precess_control::rotation;
use precess_dynamics::units::{from_g_cm, from_g_cm2};

use super::case::{HealthCase, Loop, Spacecraft, Timing};
use super::error::HealthError;
use super::fault::Fault;
use crate::file::{Numbers, Tables, from_program, from_toml};
use crate::scenario::Scenario;

/// Amplitude, rad, and period, s, of the scan that a closed loop follows, about the diagonal of the axes.
const SCAN: [f64; 2] = [0.035, 40.0];
/// Times of the rows of the scan, s.
const ROW: f64 = 2.5;

/// Static and dynamic imbalance, g cm and g cm², and its phase, degrees, of the truth's wheels: as the files have them.
const IMBALANCES: [[[f64; 3]; 4]; 2] = [
    [[0.55, 5.5, 40.0], [0.45, 6.0, -70.0], [0.5, 4.5, 120.0], [0.6, 5.0, 10.0]],
    [[1.1, 11.0, 40.0], [0.9, 12.0, -70.0], [1.0, 9.0, 120.0], [1.2, 10.0, 10.0]],
];

impl Spacecraft {
    fn texts(self) -> [&'static str; 2] {
        match self {
            Self::Bus => [include_str!("bus.toml"), include_str!("bus-truth.toml")],
            Self::Pyramid => [include_str!("pyramid.toml"), include_str!("pyramid-truth.toml")],
        }
    }

    /// The text of what is watched.
    #[must_use]
    pub fn watched_text(self) -> &'static str {
        let [watched, _] = self.texts();
        watched
    }

    /// What is watched.
    ///
    /// # Errors
    ///
    /// None of these texts; as any scenario's.
    pub fn watched(self) -> Result<Scenario, HealthError> {
        Ok(from_toml(self.name(), self.watched_text(), Path::new(""))?.0)
    }
}

impl HealthCase {
    /// The truth at the start and after the change.
    pub(super) fn truths(self, seed: u32, timing: &Timing) -> Result<[Scenario; 2], HealthError> {
        let [_, text] = self.spacecraft.texts();
        let read = |overrides: &[String]| {
            let tables = Tables::Text {
                name: self.spacecraft.name(),
                text,
                numbers: Numbers::WithUnits,
                folder: Path::new(""),
            };
            from_program(tables, overrides).map(|(scenario, _)| scenario)
        };
        let mut overrides = vec![
            format!("run.duration = \"{} s\"", timing.duration),
            format!("controller.aocs.sensors.seed = {seed}"),
        ];
        for number in 1..=4 {
            overrides.push(format!("source.tones{number}.seed = {}", source_seed(seed, number)));
            overrides.push(format!("source.noise{number}.seed = {}", source_seed(seed, number)));
        }
        if self.of == Loop::Closed {
            overrides.push(scan(timing.duration));
        }
        let before = read(&overrides)?;
        overrides.extend(self.changes(seed));
        Ok([before, read(&overrides)?])
    }

    /// Keys of the truth that change; none of what is not of the spacecraft.
    fn changes(self, seed: u32) -> Vec<String> {
        let Some((fault, size)) = self.fault else { return Vec::new() };
        let number = self.number(seed);
        let device = self.spacecraft.device(number);
        let bus = self.spacecraft == Spacecraft::Bus;
        let change = fault.change(self.spacecraft, size);
        let [static_imbalance, dynamic_imbalance, phase] =
            IMBALANCES[usize::from(!bus)][(number - 1) % 4];
        let key = |key: &str, value: f64, unit: &str| {
            format!("device.{device}.{key} = \"{value} {unit}\"")
        };
        match fault {
            Fault::StaticImbalance => {
                let value = static_imbalance + change / from_g_cm(1.0);
                vec![key("imbalance.static", value, "g cm")]
            }
            Fault::DynamicImbalance => {
                let value = dynamic_imbalance + change / from_g_cm2(1.0);
                vec![key("imbalance.dynamic", value, "g cm^2")]
            }
            // The file has the static imbalance along the wheel's y axis: the wheel turns, and the dynamic one back.
            Fault::ImbalancePhase => {
                vec![key("imbalance.phase", phase - change.to_degrees(), "deg")]
            }
            Fault::Drag => {
                let value = if bus { 2.1e-3 } else { 10.5e-3 } + change;
                vec![key("wheel.coulomb", value, "N m")]
            }
            Fault::GimbalDrag => vec![key("outer_gimbal.coulomb", 21e-3 + change, "N m")],
            Fault::Bearing => {
                let axes = [("radial_slide", 6e5, "N/m"), ("tilt", 2500.0, "N m/rad")];
                let of = |(joint, value, unit): (&str, f64, &str)| {
                    ["y", "z"].map(|axis| {
                        key(&format!("{joint}_{axis}.stiffness"), value * (1.0 + change), unit)
                    })
                };
                axes.into_iter().flat_map(of).collect()
            }
            Fault::TorqueConstant | Fault::GyroBias | Fault::Tachometer => Vec::new(),
        }
    }

    /// The angle by which a wheel's axes turn at the change, with its joint's device: of a static imbalance that moves.
    pub(super) fn turn(self, seed: u32) -> Option<(String, f64)> {
        let (fault, size) = self.fault?;
        (fault == Fault::ImbalancePhase).then(|| {
            (self.spacecraft.device(self.number(seed)), fault.change(self.spacecraft, size))
        })
    }
}

/// Of the sources of a device.
fn source_seed(seed: u32, number: u32) -> u32 {
    seed.wrapping_mul(8).wrapping_add(number)
}

/// The override of the reference: turns to and fro, from rest.
fn scan(duration: f64) -> String {
    let [amplitude, period] = SCAN;
    let axis = Vector3::new(1.0, 1.0, 1.0).normalize();
    let (mut times, mut quaternions, mut rates) = (String::new(), String::new(), String::new());
    let mut time = 0.0;
    while time < duration + 2.0 * ROW {
        let angle = 0.5 * amplitude * (1.0 - libm::cos(TAU * time / period));
        let rate = axis * (0.5 * amplitude * TAU / period * libm::sin(TAU * time / period));
        let q = rotation::from_vector(&(axis * angle));
        let _ = write!(times, "{time}, ");
        let _ = write!(quaternions, "[{}, {}, {}, {}], ", q.q0, q.q1, q.q2, q.q3);
        let _ = write!(rates, "\"{}, {}, {} rad/s\", ", rate.x, rate.y, rate.z);
        time += ROW;
    }
    let times = times.trim_end_matches(", ");
    format!(
        "controller.aocs.reference = {{ kind = \"table\", scalar = \"first\", times = \"{times} s\", \
         quaternions = [{quaternions}], angular_velocities = [{rates}] }}"
    )
}
