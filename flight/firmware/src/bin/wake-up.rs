//! An application in the shape flight software has: initialised once, woken up in turn, sending its
//! health.
//!
//! Three imbalanced reaction wheels hold a small spacecraft's attitude. Each wake-up is a tenth of
//! a second: the controller reads the state and sets the motors, the model makes a hundred
//! sub-steps, and once a second a line of housekeeping goes out with the residuals of energy and
//! momentum. Nothing is allocated; the data of the application are in one structure, which its
//! caller owns.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::fmt::{self, Display, Write};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::units::{from_g_cm, from_g_cm2, from_rpm, to_rpm};
use precess_dynamics::{
    About, Hub, Imbalance, ImbalanceError, Inputs, ParameterError, ReactionWheel, SolveError,
    Spacecraft, State,
};
use precess_firmware::board::Options;

precess_firmware::program!(program);

/// Wheels along the hub's axes.
type Wheels = [ReactionWheel; 3];

/// Wake-ups of the run, and how many there are in a second.
const WAKE_UPS: u32 = 100;
const PER_SECOND: u32 = 10;

/// Steps of the model per wake-up, and their length in seconds: a wheel at 1500 rpm turns by 0.16
/// rad.
const SUB_STEPS: u32 = 100;
const STEP: f64 = 1e-3;

/// Gains of the controller, N m and N m s.
const STIFFNESS: f64 = 0.4;
const DAMPING: f64 = 4.0;

/// What a motor can do, N m.
const LARGEST_TORQUE: f64 = 0.02;

/// What energy and momentum may drift by, relative to their size: the step's own error.
const DRIFT: f64 = 1e-9;

/// Runs the application, as the scheduler of a flight computer would.
fn program(out: &mut dyn Write, _: Options) -> Result<(), Fault> {
    let mut app = App::init()?;
    for wake_up in 1..=WAKE_UPS {
        app.wake_up()?;
        if wake_up % PER_SECOND == 0 {
            let telemetry = app.housekeeping()?;
            writeln!(out, "{:>3} s  {telemetry}", wake_up / PER_SECOND)?;
            telemetry.check()?;
        }
    }
    Ok(writeln!(out, "end: {} lines", WAKE_UPS / PER_SECOND)?)
}

/// What the application knows.
struct App {
    craft: Spacecraft<Wheels>,
    state: State<Wheels>,
    inputs: Inputs<Wheels>,
    /// Work of the motors since the start, J.
    work: f64,
    /// Energy, J, and angular momentum about the centre of mass, kg m²/s, at the start.
    start: (f64, Vector3<f64>),
}

impl App {
    /// Checks the parameters and sets the state: once, before the first wake-up.
    fn init() -> Result<Self, Fault> {
        let hub = Hub {
            m_b: 60.0,
            r_bc_b: Vector3::new(0.0, 0.01, 0.02),
            i_b_bc: Matrix3::from_diagonal(&Vector3::new(6.0, 5.0, 4.0)),
        };
        let disc = Matrix3::from_diagonal(&Vector3::new(4e-3, 2.2e-3, 2.2e-3));
        let sheet = Imbalance { u_s: from_g_cm(0.5), u_d: from_g_cm2(5.0), phase: 0.3 };
        let wheel = ReactionWheel::bare_wheel(2.0, disc).with_imbalance(&sheet)?;
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
        let along = |axes: [Vector3<f64>; 3], position: Vector3<f64>| ReactionWheel {
            mount: Matrix3::from_columns(&axes),
            r_w_b: position * 0.2,
            ..wheel
        };
        let wheels = [along([x, y, z], x), along([y, z, x], y), along([z, x, y], z)];
        let craft = Spacecraft::new(&hub, &wheels)?;
        let mut state = State::<Wheels>::at_rest();
        state.omega = Vector3::new(0.01, -0.02, 0.015);
        for (joints, rpm) in state.devices.iter_mut().zip([1500.0, -1200.0, 900.0]) {
            joints.spin = from_rpm(rpm);
        }
        let start = (craft.energy(&state)?, craft.momentum(&state, About::CentreOfMass)?.angular);
        Ok(Self { craft, state, inputs: Inputs::none(), work: 0.0, start })
    }

    /// One cycle: the controller, then the model.
    fn wake_up(&mut self) -> Result<(), Fault> {
        let q = &self.state.attitude;
        let turned = Vector3::new(q.q1, q.q2, q.q3) * (2.0 * q.q0.signum());
        let torque = turned * STIFFNESS + self.state.omega * DAMPING;
        for (motor, torque) in self.inputs.motors.iter_mut().zip(torque.iter()) {
            // A motor's torque on its wheel is the reverse on the hub.
            motor.u_w = torque.clamp(-LARGEST_TORQUE, LARGEST_TORQUE);
        }
        for _ in 0..SUB_STEPS {
            let stepped = self.craft.step_with_work(&self.state, &self.inputs, STEP)?;
            self.state = stepped.state;
            self.work += stepped.work.total();
        }
        // Angles stay where their sines are cheap and exact, however long the mission.
        self.state = self.state.wrapped(&self.craft);
        Ok(())
    }

    /// What goes to the ground.
    fn housekeeping(&self) -> Result<Telemetry, Fault> {
        let (energy, momentum) = self.start;
        let now = self.craft.momentum(&self.state, About::CentreOfMass)?.angular;
        let left = self.craft.energy(&self.state)? - energy - self.work;
        Ok(Telemetry {
            rate: self.state.omega.norm(),
            speeds: self.state.devices.map(|joints| to_rpm(joints.spin)),
            energy: left / energy,
            momentum: (now - momentum).norm() / momentum.norm(),
        })
    }
}

/// Housekeeping.
struct Telemetry {
    /// Of the hub, rad/s.
    rate: f64,
    /// Of the wheels, rpm.
    speeds: [f64; 3],
    /// Energy less its start and the motors' work, of the start.
    energy: f64,
    /// What angular momentum has changed by, of the start.
    momentum: f64,
}

impl Telemetry {
    /// The model is valid while the residuals are within their bounds.
    fn check(&self) -> Result<(), Fault> {
        for (what, value) in [("energy", self.energy), ("momentum", self.momentum)] {
            // NaN is no drift within bounds either.
            if value.abs().partial_cmp(&DRIFT).is_none_or(core::cmp::Ordering::is_gt) {
                return Err(Fault::Books { what, value });
            }
        }
        Ok(())
    }
}

impl Display for Telemetry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.speeds;
        write!(f, "rate {:.3e} rad/s  wheels {x:.1} {y:.1} {z:.1} rpm  ", self.rate)?;
        write!(f, "residuals: energy {:+.1e}, momentum {:.1e}", self.energy, self.momentum)
    }
}

/// Why the application stops.
enum Fault {
    Console,
    Parameters(ParameterError<f64>),
    Imbalance(ImbalanceError<f64>),
    Solve(SolveError<f64>),
    Books { what: &'static str, value: f64 },
}

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Console => write!(f, "the console took no more"),
            Self::Parameters(error) => write!(f, "{error}"),
            Self::Imbalance(error) => write!(f, "{error}"),
            Self::Solve(error) => write!(f, "{error}"),
            Self::Books { what, value } => {
                write!(
                    f,
                    "{what} drifts by {value:.1e} of itself, beyond {DRIFT:.0e}; shorten the step"
                )
            }
        }
    }
}

impl From<fmt::Error> for Fault {
    fn from(_: fmt::Error) -> Self {
        Self::Console
    }
}

impl From<ParameterError<f64>> for Fault {
    fn from(error: ParameterError<f64>) -> Self {
        Self::Parameters(error)
    }
}

impl From<ImbalanceError<f64>> for Fault {
    fn from(error: ImbalanceError<f64>) -> Self {
        Self::Imbalance(error)
    }
}

impl From<SolveError<f64>> for Fault {
    fn from(error: SolveError<f64>) -> Self {
        Self::Solve(error)
    }
}
