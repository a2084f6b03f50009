//! [`Unknown`]: what is to be found, and [`Component`]: its numbers, in the order in which they are estimated.
//!
//! An imbalance has four numbers: the static one `m_w (y, z)` of the centre of mass and the products of inertia `(J_12, J_13)`, both
//! expressed in the axes of the wheel that the scenario's angle of it at the start gives. In these the readings are linear near
//! any value, zero included, where `U_s` and a phase are not.

use nalgebra::Vector3;
use precess_dynamics::{BuiltIn, JointStates as _};

use super::error::IdentifyError;
use crate::scenario::Scenario;

/// Scales of what has no prior: what a change of one is worth when directions are compared, and the reach of the first steps.
const STATIC: f64 = 1e-5;
const DYNAMIC: f64 = 1e-6;
const TILT: f64 = 0.05;
const BIAS: f64 = 1e-3;
const OMEGA: f64 = 1e-2;
const ATTITUDE: f64 = 1e-2;
const CENTRE: f64 = 0.05;
/// Of the inertia of the hub, of the rate of a joint.
const SHARE: f64 = 0.3;
const RATE_SHARE: f64 = 0.02;
/// Friction that stops a wheel of a moment of inertia I in a thousand seconds: `I / 1000 s`.
const STOPS: f64 = 1000.0;

/// Something that is to be found. Devices and joints are by their numbers in the scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// The inertia of the hub about its centre of mass: six numbers.
    HubInertia,
    /// Its moments, the products as they are: three.
    HubMoments,
    /// Its centre of mass.
    HubCentre,
    /// Static and dynamic imbalance of the wheel of a device, with their angles.
    Imbalance(usize),
    /// Viscous friction of a joint.
    Viscous(usize),
    /// Coulomb friction of a joint.
    Coulomb(usize),
    /// A small rotation of the mount of a device about the axes of B.
    Mount(usize),
    /// The bias of the gyro at the start.
    GyroBias,
}

/// An unknown with what is known of it before.
#[derive(Clone, Debug, PartialEq)]
pub struct UnknownPrior {
    /// What.
    pub unknown: Unknown,
    /// Standard deviations about the scenario's value (of an imbalance about zero: of static and dynamic; of a mount about none); empty
    /// where nothing is known.
    pub deviations: Vec<f64>,
}

/// Which number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    Inertia(usize, usize),
    Centre(usize),
    Static(usize, usize),
    Dynamic(usize, usize),
    Viscous(usize),
    Coulomb(usize),
    Mount(usize, usize),
    Bias(usize),
    Attitude(usize),
    Omega(usize),
    Coordinate(usize),
    Rate(usize),
}

/// A number that is estimated.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    pub(super) target: Target,
    /// `hub.i_b_bc_xx`, `rw1.static_y`, `rw1.wheel.viscous`.
    pub name: String,
    /// SI.
    pub unit: &'static str,
    /// Its value at first.
    pub start: f64,
    /// Mean and standard deviation before; none where nothing is known.
    pub prior: Option<[f64; 2]>,
    /// What a change of it is worth.
    pub scale: f64,
}

const ELEMENTS: [(usize, usize, &str); 6] =
    [(0, 0, "xx"), (1, 1, "yy"), (2, 2, "zz"), (0, 1, "xy"), (0, 2, "xz"), (1, 2, "yz")];
const LETTERS: [&str; 3] = ["x", "y", "z"];

/// Whether a device has a wheel that may be off balance.
pub(super) fn has_imbalance(scenario: &Scenario, device: usize) -> bool {
    let of = scenario.devices_on_hub().and_then(|all| all.get(device).copied());
    of.is_some_and(|of| of.parameter("d").is_ok())
}

/// The joint of the tip of a device, which is that of its wheel.
pub(super) fn wheel_joint(scenario: &Scenario, device: usize) -> Option<usize> {
    scenario.joints().enumerate().filter(|(_, (of, ..))| *of == device).last().map(|(k, _)| k)
}

/// The number of the last body of a device, which is the wheel where it has one.
pub(super) fn tip_of(device: &BuiltIn) -> Option<usize> {
    device.kind().joints().len().checked_sub(1)
}

/// The state at the start, as sensors have it.
pub(super) struct Start {
    /// None of a spacecraft without gyro.
    pub(super) omega: Vector3<f64>,
    /// Whether the attitude is measured.
    pub(super) attitude: bool,
    /// Of each joint: whether its coordinate is measured; its rate, where that is.
    pub(super) joints: Vec<(Option<f64>, Option<f64>)>,
}

impl Component {
    /// The coordinate at the start of a joint whose encoder nobody reads: any angle.
    pub(super) fn free_coordinate(scenario: &Scenario, joint: usize) -> Option<Self> {
        let (_, device, info) = scenario.joints().nth(joint)?;
        let [start, _] = scenario.initial.devices.states().nth(joint)?;
        Some(Self {
            target: Target::Coordinate(joint),
            name: format!("{device}.{} at the start", info.coordinate),
            unit: info.units()[0],
            start,
            prior: None,
            scale: std::f64::consts::PI,
        })
    }

    /// Whether it is of the spacecraft, and not of the start of a record.
    pub(super) fn is_of_spacecraft(&self) -> bool {
        use Target::{Attitude, Bias, Coordinate, Omega, Rate};
        !matches!(self.target, Attitude(_) | Bias(_) | Coordinate(_) | Omega(_) | Rate(_))
    }
}

/// The numbers of all unknowns, and of the state at the start.
pub(super) fn components(
    scenario: &Scenario,
    unknowns: &[UnknownPrior],
    start: &Start,
) -> Result<Vec<Component>, IdentifyError> {
    let mut all: Vec<Component> = Vec::new();
    for of in unknowns {
        add_unknown(&mut all, scenario, of)?;
    }
    let mut add = |target, name: String, unit, start, scale| {
        all.push(Component { target, name, unit, start, prior: None, scale });
    };
    for (k, letter) in LETTERS.iter().enumerate() {
        let name = format!("omega_{letter} at the start");
        add(Target::Omega(k), name, "rad/s", start.omega[k], OMEGA);
    }
    for (k, letter) in LETTERS.iter().enumerate().filter(|_| start.attitude) {
        add(Target::Attitude(k), format!("attitude_{letter} at the start"), "rad", 0.0, ATTITUDE);
    }
    for (joint, ((_, device, info), (coordinate, rate))) in
        scenario.joints().zip(&start.joints).enumerate()
    {
        let [unit, rate_unit, ..] = info.units();
        if let Some(value) = coordinate {
            let name = format!("{device}.{} at the start", info.coordinate);
            add(Target::Coordinate(joint), name, unit, *value, ATTITUDE);
        }
        if let Some(value) = rate {
            let name = format!("{device}.{} at the start", info.rate);
            let scale = RATE_SHARE * value.abs().max(1.0);
            add(Target::Rate(joint), name, rate_unit, *value, scale);
        }
    }
    let repeated =
        |of: &&Component| all.iter().filter(|other| other.target == of.target).count() > 1;
    match all.iter().find(repeated) {
        Some(of) => Err(IdentifyError::Twice { name: of.name.clone() }),
        None => Ok(all),
    }
}

fn add_unknown(
    all: &mut Vec<Component>,
    scenario: &Scenario,
    of: &UnknownPrior,
) -> Result<(), IdentifyError> {
    let prior = |index: usize| of.deviations.get(index).or(of.deviations.last()).copied();
    let mut add =
        |target, name: String, unit, start: f64, mean: f64, deviation: Option<f64>, scale| {
            let prior = deviation.map(|deviation| [mean, deviation]);
            let scale = deviation.unwrap_or(scale);
            all.push(Component { target, name, unit, start, prior, scale });
        };
    let hub = &scenario.hub;
    let devices = scenario.devices_on_hub().unwrap_or_default();
    let name_of = |device: usize| scenario.names.get(device).cloned().unwrap_or_default();
    match of.unknown {
        Unknown::HubInertia | Unknown::HubMoments => {
            let count = if of.unknown == Unknown::HubMoments { 3 } else { 6 };
            let scale = SHARE * hub.i_b_bc.trace() / 3.0;
            for (row, column, letters) in ELEMENTS.into_iter().take(count) {
                let value = hub.i_b_bc[(row, column)];
                let name = format!("hub.i_b_bc_{letters}");
                let target = Target::Inertia(row, column);
                add(target, name, "kg m²", value, value, prior(0), scale);
            }
        }
        Unknown::HubCentre => {
            for (k, letter) in LETTERS.iter().enumerate() {
                let value = hub.r_bc_b[k];
                let name = format!("hub.r_bc_b_{letter}");
                add(Target::Centre(k), name, "m", value, value, prior(0), CENTRE);
            }
        }
        Unknown::Imbalance(device) => {
            let own = devices.get(device).filter(|_| has_imbalance(scenario, device));
            let Some(own) = own else {
                return Err(IdentifyError::NoWheel { device: name_of(device) });
            };
            let name = name_of(device);
            let parameters = own.parameters();
            let tip = tip_of(own).and_then(|tip| parameters.bodies.get(tip));
            let Some(body) = tip else { return Ok(()) };
            for (k, letter) in ["y", "z"].into_iter().enumerate() {
                let value = body.mass * body.centre[k + 1];
                let target = Target::Static(device, k);
                add(
                    target,
                    format!("{name}.static_{letter}"),
                    "kg m",
                    value,
                    0.0,
                    prior(0),
                    STATIC,
                );
            }
            for (k, letters) in ["12", "13"].into_iter().enumerate() {
                let value = body.inertia[(0, k + 1)];
                let target = Target::Dynamic(device, k);
                add(target, format!("{name}.j_{letters}"), "kg m²", value, 0.0, prior(1), DYNAMIC);
            }
        }
        Unknown::Viscous(joint) | Unknown::Coulomb(joint) => {
            let Some((device, name, info)) = scenario.joints().nth(joint) else { return Ok(()) };
            let Some(own) = devices.get(device) else { return Ok(()) };
            let parameters = own.parameters();
            let (Some(passive), Some(body)) =
                (parameters.passive.get(info.index), parameters.bodies.get(info.index))
            else {
                return Ok(());
            };
            let scale = body.inertia.m11.max(f64::MIN_POSITIVE) / STOPS;
            let body = info.body.replace(' ', "_");
            if let Unknown::Viscous(_) = of.unknown {
                let unit = if info.slides { "N s/m" } else { "N m s/rad" };
                let (name, value) = (format!("{name}.{body}.viscous"), passive.viscous);
                add(Target::Viscous(joint), name, unit, value, value, prior(0), scale);
            } else {
                if passive.coulomb_rate <= 0.0 {
                    return Err(IdentifyError::NoCoulombRate { joint: format!("{name}.{body}") });
                }
                let unit = if info.slides { "N" } else { "N m" };
                let rate = scenario.initial.devices.states().nth(joint).map_or(1.0, |of| of[1]);
                let (name, value) = (format!("{name}.{body}.coulomb"), passive.coulomb);
                let scale = scale * rate.abs().max(1.0);
                add(Target::Coulomb(joint), name, unit, value, value, prior(0), scale);
            }
        }
        Unknown::Mount(device) => {
            for (k, letter) in LETTERS.iter().enumerate() {
                let name = format!("{}.mount_{letter}", name_of(device));
                add(Target::Mount(device, k), name, "rad", 0.0, 0.0, prior(0), TILT);
            }
        }
        Unknown::GyroBias => {
            for (k, letter) in LETTERS.iter().enumerate() {
                let name = format!("gyro.bias_{letter}");
                add(Target::Bias(k), name, "rad/s", 0.0, 0.0, prior(0), BIAS);
            }
        }
    }
    Ok(())
}
