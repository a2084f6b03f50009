//! [`SweptDevice`]: a device, or a platform or panel with what stands on it, at any speed of its rotors.
//!
//! The means over a turn of the derivatives by accelerations, rates and coordinates are polynomials of second degree in
//! the rates (inertia does not depend on them, gyroscopic terms are linear, centrifugal ones quadratic), so
//! three speeds give them at every speed, exactly. The force of a rotor that is out of balance is `Omega^2` times
//! one at a unit rate.

use nalgebra::{Complex, DMatrix, DVector, Vector3};
use precess_dynamics::kind::{Each, JointStates};
use precess_dynamics::{
    DerivativeError, HubMode, Inputs, LoadAxes, Loads, Mode, Spacecraft, State,
};

use crate::engine::MemberLoads;
use crate::scenario::steady::SteadyJoints;
use crate::scenario::{Scenario, Set, set_of};
use crate::structure::averaged::{AveragedDevices, mount_hub};
use crate::structure::condensed::{Condensed, Derivatives, condensed};
use crate::structure::dynamic_mass::Motor;
use crate::structure::harmonics::{fourier, share};
use crate::structure::{COORDINATES, Fault};

/// Angles of a turn at which the blocked force is sampled: harmonics up to the third are exact.
const ANGLES: usize = 8;
/// A harmonic of the blocked force that is rounding, of the rate squared times the inertia.
const HARMONIC_MIN: f64 = 1e-12;

/// A rotor whose speed is swept, or that keeps its rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotor {
    /// Device and body: `rw1.wheel`.
    pub name: String,
    /// Number of its joint among those of the device.
    pub(crate) joint: usize,
    /// Its rate by the speed, 1 or -1, and what is added, rad/s: one of them is zero.
    rate: [f64; 2],
}

impl Rotor {
    /// Its rate at a speed, rad/s.
    #[must_use]
    pub fn rate(&self, speed: f64) -> f64 {
        self.rate[0] * speed + self.rate[1]
    }

    /// Whether it has the speed that is swept.
    #[must_use]
    pub fn is_swept(&self) -> bool {
        self.rate[0] != 0.0
    }
}

/// A tone: a force of a rotor at a multiple of its rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Tone {
    /// What causes it: `imbalance`, or the name of a source.
    pub cause: String,
    /// Number of the rotor.
    pub rotor: usize,
    /// Harmonic number `h`: the frequency by the rate; above zero.
    pub order: f64,
    /// Load on mount and free joints that holds them where they are, by the rate squared, for `exp(i h |Omega| t)`:
    /// kg m and kg m².
    load: DVector<Complex<f64>>,
}

/// A device on a mount, at any speed.
#[derive(Clone, Debug)]
pub struct SweptDevice {
    /// Its name; of a platform or panel with what stands on it, that of the platform or panel.
    pub name: String,
    /// The rotors.
    pub rotors: Vec<Rotor>,
    /// The tones.
    pub tones: Vec<Tone>,
    /// Numbers among the joints of the device of those that are free.
    pub(crate) free: Vec<usize>,
    /// The first of its joints among those of the scenario.
    pub(crate) first_joint: usize,
    /// Coefficients of the speed's powers 0, 1, 2.
    powers: [Derivatives; 3],
    /// As it is at the initial rates, by which what averaging leaves out is known.
    averaged: AveragedDevices,
}

/// What is swept and what small motions do.
#[derive(Clone, Copy, Debug)]
pub struct Steady<'a> {
    /// What motors of rotors do to small changes of their rates.
    pub motor: Motor,
    /// Whether the other joints are free on their springs.
    pub sprung: bool,
    /// Names of the rotors whose speed is swept, empty for all; none where each keeps its initial rate.
    pub swept: Option<&'a [String]>,
}

impl SweptDevice {
    /// A member of a scenario, with the devices on it, whose mount is at `mount`, m, from B.
    ///
    /// Rotors turn as their initial rates do; one that is at rest does not turn.
    ///
    /// # Errors
    /// As [`AveragedDevices::new`].
    pub fn new(
        scenario: &Scenario,
        chosen: &[usize],
        mount: &Vector3<f64>,
        steady: &Steady<'_>,
    ) -> Result<Self, Fault> {
        Self::with_free(scenario, chosen, mount, steady, &[])
    }

    /// The same with more joints free, by their numbers among those of the scenario.
    ///
    /// # Errors
    /// As [`AveragedDevices::new`].
    pub(super) fn with_free(
        scenario: &Scenario,
        chosen: &[usize],
        mount: &Vector3<f64>,
        steady: &Steady<'_>,
        free: &[usize],
    ) -> Result<Self, Fault> {
        let set = set_of(scenario, chosen);
        let joints = SteadyJoints::new(scenario, chosen, steady.motor, steady.sprung)
            .with_free(scenario, chosen, free);
        let turning = joints.states.iter().zip(&joints.names).enumerate();
        let turning = turning.filter(|(_, ([_, rate], _))| *rate != 0.0);
        let rotor = |(joint, ([_, rate], name)): (usize, (&[f64; 2], &String))| {
            let swept = steady.swept.is_some_and(|of| of.is_empty() || of.contains(name));
            let rate = if swept { [rate.signum(), 0.0] } else { [0.0, *rate] };
            Rotor { name: name.clone(), joint, rate }
        };
        let rotors: Vec<Rotor> = turning.map(rotor).collect();
        // Any speed gives the same polynomials; that of the scenario has their size.
        let unit = rotors.iter().filter(|rotor| rotor.is_swept());
        let unit =
            unit.filter_map(|rotor| joints.states.get(rotor.joint)).map(|[_, rate]| rate.abs());
        let unit = unit.fold(0.0, f64::max);
        let unit = if unit > 0.0 { unit } else { 1.0 };
        let at = |speed: f64| {
            let states = states_at(&joints.states, &rotors, speed);
            AveragedDevices::of_set(&set, mount, &states, &joints.motors)
        };
        let averaged = at(unit)?;
        let powers = if rotors.iter().any(Rotor::is_swept) {
            polynomials(unit, [averaged.mean(), at(-unit)?.mean(), at(2.0 * unit)?.mean()])
        } else {
            let mean = averaged.mean().clone();
            let none = mean.each_ref().map(|m| DMatrix::zeros(m.nrows(), m.ncols()));
            [mean, none.clone(), none]
        };
        let mut tones = Vec::new();
        let states = states_at(&joints.states, &rotors, unit);
        for (index, rotor) in rotors.iter().enumerate() {
            let harmonics = BlockedLoads { set: &set, mount, motors: &joints.motors }
                .harmonics(&states, rotor.joint)?;
            let rate = rotor.rate(unit);
            for (harmonic, load) in (1..ANGLES / 2).zip(harmonics.into_iter().skip(1)) {
                let load = load.map(|value| 2.0 * value / (rate * rate));
                if is_rounding(&load, &powers[0][0]) {
                    continue;
                }
                // A rotor that turns backwards: exp(i k theta) is exp(-i k |Omega| t).
                let load = if rate < 0.0 { load.map(|value| value.conj()) } else { load };
                let (cause, order) = (String::from("imbalance"), share(harmonic, 1));
                tones.push(Tone { cause, rotor: index, order, load });
            }
        }
        let name = chosen.first().and_then(|index| scenario.names.get(*index));
        let name = name.cloned().unwrap_or_default();
        let free = joints.motors.iter().enumerate();
        let free = free.filter(|(_, motor)| **motor == Motor::ConstantTorque).map(|(k, _)| k);
        let first = chosen.first().copied().unwrap_or(0);
        let first_joint = scenario.joints().take_while(|(device, ..)| *device < first).count();
        Ok(Self { name, rotors, tones, free: free.collect(), first_joint, powers, averaged })
    }

    /// Adds a tone of a blocked force and moment at the mount, by the rate squared, for `exp(i h |Omega| t)`, kg m and
    /// kg m².
    ///
    /// # Errors
    /// [`Fault::Number`] for no rotor of the number, [`Fault::Range`] for an order that is not above zero,
    /// [`Fault::NotFinite`] for a force that is not.
    pub fn add_tone(
        &mut self,
        cause: &str,
        rotor: usize,
        order: f64,
        force: &[Complex<f64>; COORDINATES],
    ) -> Result<(), Fault> {
        if rotor >= self.rotors.len() {
            let (what, range) = (String::from("as number of a rotor"), [0, self.rotors.len()]);
            return Err(Fault::Number { what, found: rotor, range });
        }
        crate::structure::within("order of a tone".into(), order, [f64::MIN_POSITIVE, 1e6])?;
        for value in force.iter().flat_map(|value| [value.re, value.im]) {
            let what = String::from("blocked force of a tone");
            crate::structure::within(what, value, [-1e12, 1e12])?;
        }
        // The load that holds the mount is the opposite of the force on it.
        let mut load = DVector::zeros(self.powers[0][0].nrows());
        for (to, from) in load.iter_mut().zip(force) {
            *to = -*from;
        }
        self.tones.push(Tone { cause: cause.to_owned(), rotor, order, load });
        Ok(())
    }

    /// Torques of the motors of the free joints that keep the steady spin, averaged over a turn, N m: against friction, and
    /// against springs that are not at rest.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn motors(
        &self,
        scenario: &Scenario,
        steady: &Steady<'_>,
        speed: f64,
    ) -> Result<Vec<f64>, Fault> {
        let first = scenario.joints().nth(self.first_joint).map_or(0, |(device, ..)| device);
        let groups = scenario.groups().into_iter();
        let chosen: Vec<usize> = groups.filter(|group| group.contains(&first)).flatten().collect();
        let set = set_of(scenario, &chosen);
        let joints = SteadyJoints::new(scenario, &chosen, steady.motor, steady.sprung);
        let states = states_at(&joints.states, &self.rotors, speed);
        let blocked = BlockedLoads { set: &set, mount: &Vector3::zeros(), motors: &joints.motors };
        let Some(rotor) = self.rotors.first() else { return Ok(vec![0.0; self.free.len()]) };
        let harmonics = blocked.harmonics(&states, rotor.joint)?;
        let mean =
            harmonics.first().map(|mean| mean.rows(COORDINATES, self.free.len()).into_owned());
        Ok(mean.map_or_else(Vec::new, |mean| mean.iter().map(|value| value.re).collect()))
    }

    /// Other means; blocked forces stay those on the mount.
    pub(super) fn set_powers(&mut self, powers: [Derivatives; 3]) {
        for tone in &mut self.tones {
            tone.load = tone.load.rows(0, COORDINATES).into_owned();
        }
        self.powers = powers;
    }

    /// Means of the derivatives at a speed, rad/s.
    #[must_use]
    pub fn mean(&self, speed: f64) -> Derivatives {
        let [constant, linear, square] = &self.powers;
        std::array::from_fn(|k| &constant[k] + &linear[k] * speed + &square[k] * (speed * speed))
    }

    /// Dynamic mass and elimination of the free joints at a speed and an angular frequency, rad/s.
    ///
    /// # Errors
    /// As [`AveragedDevices::dynamic_mass`].
    pub fn condensed(&self, speed: f64, frequency: f64) -> Result<Condensed, Fault> {
        condensed(&self.mean(speed), frequency)
    }

    /// What averaging leaves out at an angular frequency, rad/s, as [`AveragedDevices::periodic`] has it, at the initial rates.
    pub(crate) fn periodic(&self, frequency: f64) -> Result<f64, Fault> {
        self.averaged.periodic(frequency)
    }

    /// Angular frequency of a tone at a speed, rad/s.
    #[must_use]
    pub fn frequency(&self, tone: &Tone, speed: f64) -> f64 {
        let rate = self.rotors.get(tone.rotor).map_or(0.0, |rotor| rotor.rate(speed));
        tone.order * rate.abs()
    }

    /// Force of a tone on mount and free joints, as it is without their motion, N, N m and each joint's.
    pub(crate) fn force(&self, tone: &Tone, speed: f64) -> DVector<Complex<f64>> {
        let rate = self.rotors.get(tone.rotor).map_or(0.0, |rotor| rotor.rate(speed));
        &tone.load * Complex::new(-rate * rate, 0.0)
    }

    /// Number among the joints of the device of each free joint, and the load that a tone puts on it by itself.
    pub(super) fn joint_loads(&self, tone: &Tone, speed: f64) -> DVector<Complex<f64>> {
        let rate = self.rotors.get(tone.rotor).map_or(0.0, |rotor| rotor.rate(speed));
        let joints = tone.load.len().saturating_sub(COORDINATES);
        tone.load.rows(COORDINATES, joints) * Complex::new(rate * rate, 0.0)
    }

    /// Blocked force and moment of a tone on the mount, N and N m, with the free joints free.
    #[must_use]
    pub fn blocked(&self, tone: &Tone, speed: f64, condensed: &Condensed) -> DVector<Complex<f64>> {
        let rate = self.rotors.get(tone.rotor).map_or(0.0, |rotor| rotor.rate(speed));
        let joints = tone.load.len().saturating_sub(COORDINATES);
        let of_joints = &condensed.gain * tone.load.rows(COORDINATES, joints);
        (of_joints - tone.load.rows(0, COORDINATES)) * Complex::new(rate * rate, 0.0)
    }
}

/// States of the joints with the rotors at their rates.
fn states_at(states: &[[f64; 2]], rotors: &[Rotor], speed: f64) -> Vec<[f64; 2]> {
    let mut states = states.to_vec();
    for rotor in rotors {
        if let Some([_, rate]) = states.get_mut(rotor.joint) {
            *rate = rotor.rate(speed);
        }
    }
    states
}

/// Coefficients of polynomials of second degree from their values at `u`, `-u` and `2 u`.
fn polynomials(u: f64, [plus, minus, twice]: [&Derivatives; 3]) -> [Derivatives; 3] {
    let mut powers = [plus.clone(), plus.clone(), plus.clone()];
    for k in 0..3 {
        let linear = (&plus[k] - &minus[k]) / (2.0 * u);
        let even = (&plus[k] + &minus[k]) / 2.0;
        let square = (&twice[k] - &linear * (2.0 * u) - &even) / (3.0 * u * u);
        powers[0][k] = even - &square * (u * u);
        (powers[1][k], powers[2][k]) = (linear, square);
    }
    powers
}

/// Whether a load is rounding beside the inertia: of the mount each element by the root of its own and the largest
/// moment of inertia.
fn is_rounding(load: &DVector<Complex<f64>>, mass: &DMatrix<f64>) -> bool {
    let inertia = (3..COORDINATES).map(|k| mass[(k, k)]).fold(0.0, f64::max);
    let small = |(k, value): (usize, &Complex<f64>)| {
        let own = mass.get((k, k)).copied().unwrap_or(0.0);
        value.norm() <= HARMONIC_MIN * (own.abs() * inertia).sqrt()
    };
    load.iter().enumerate().all(small)
}

/// What mount and free joints need to stay where they are while rotors turn.
struct BlockedLoads<'a> {
    set: &'a Set,
    mount: &'a Vector3<f64>,
    motors: &'a [Motor],
}

impl BlockedLoads<'_> {
    /// Fourier coefficients over a turn of a joint.
    fn harmonics(
        &self,
        states: &[[f64; 2]],
        joint: usize,
    ) -> Result<Vec<DVector<Complex<f64>>>, Fault> {
        let rejected = |error| Fault::Device(DerivativeError::Parameter(error));
        let craft = Spacecraft::new(&mount_hub(), self.set).map_err(rejected)?;
        let mut samples = Vec::new();
        for angle in 0..ANGLES {
            let mut turned = states.to_vec();
            if let Some([coordinate, _]) = turned.get_mut(joint) {
                // From the initial angle: it is the phase.
                *coordinate += std::f64::consts::TAU * share(angle, ANGLES);
            }
            samples.push([self.load(&craft, &turned)?]);
        }
        let columns = fourier(&samples).into_iter();
        Ok(columns.map(|[matrix]| matrix.column(0).into_owned()).collect())
    }

    /// Load on the mount, and motor torques of the free joints.
    fn load(&self, craft: &Spacecraft<Set>, states: &[[f64; 2]]) -> Result<DMatrix<f64>, Fault> {
        let rejected = |error| Fault::Device(DerivativeError::Solve(error));
        let mut state: State<Set> = State::at_rest_for(craft);
        for (to, [coordinate, rate]) in state.devices.states_mut().zip(states) {
            (*to[0], *to[1]) = (*coordinate, *rate);
        }
        let mut inputs = Inputs::none_for(craft);
        let still = [Vector3::zeros(), Vector3::zeros()];
        inputs.hub = HubMode::Prescribed { r_b_n_ddot: still[0], omega_dot: still[1] };
        for (mode, (_, info)) in inputs.modes.values_mut().zip(craft.joints()) {
            if info.driven {
                *mode = Mode::Prescribed(0.0);
            }
        }
        let accelerations = craft.accelerations(&state, &inputs).map_err(rejected)?;
        let loads = craft.loads(&state, &inputs, &accelerations, LoadAxes::Hub);
        let loads = loads.map_err(rejected)?;
        let moment = loads.hub.moment - self.mount.cross(&loads.hub.force);
        let free = motors(&loads).into_iter().zip(self.motors);
        let free = free.filter(|(_, motor)| **motor == Motor::ConstantTorque).map(|(u, _)| u);
        let all: Vec<f64> =
            loads.hub.force.iter().chain(moment.iter()).copied().chain(free).collect();
        Ok(DMatrix::from_column_slice(all.len(), 1, &all))
    }
}

/// Motor torques of all joints, in order.
fn motors(loads: &Loads<Set>) -> Vec<f64> {
    MemberLoads::new(loads, &[]).motors
}
