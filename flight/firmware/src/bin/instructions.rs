//! Counts the instructions of evaluations and steps on a Cortex-M, per kind, of one device and
//! four, and of what steers four DGVSCMGs.
//!
//! Costs depend on the set, modes and gravity, not on the numbers: a free
//! hub, every motor driven, no gravity, as in the committed counts of the desktop.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::fmt::Write;
use core::hint::black_box;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Accelerations, Angle, BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg,
    BalancedVscmg, Dgcmg, Dgvscmg, FixedSet, FlexibleReactionWheel, FlexibleVscmg, HingedPanel,
    Inputs, ReactionWheel, Scalar, Servo, Sgcmg, SloshMass, Spacecraft, State, Steered,
    SteeringLaw, Vscmg,
};
use precess_firmware::board::Options;
use precess_firmware::count::{Counts, Stop, hub, moving};
use precess_flight_library as library;
use precess_flight_library::{Evaluate, Step};

precess_firmware::program!(program);

/// Step of the integrator, s.
const STEP: f64 = 1e-3;

/// Counts each of these: `module device devices;`.
macro_rules! count {
    ($counts:ident, $($module:ident $device:ident $devices:literal;)*) => {$(
        $counts.count(
            stringify!($module),
            &[$device; $devices],
            library::$module::accelerations,
            library::$module::step,
        )?;
    )*};
}

fn program(out: &mut dyn Write, _: Options) -> Result<(), Stop> {
    let mut counts = Measured(Counts::new(out));
    counts.0.line("sin_cos", || {
        black_box(Angle::sin_cos(black_box(1.25_f64)));
        true
    })?;
    counts.0.line("sqrt", || {
        black_box(Scalar::sqrt(black_box(1.25_f64)));
        true
    })?;
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let dgvscmg = Dgvscmg::bare_wheel(4.0, disc);
    let balanced_dgvscmg = BalancedDgvscmg::bare_wheel(4.0, 0.2, 0.1);
    let dgcmg = Dgcmg::bare_wheel(4.0, disc);
    let balanced_dgcmg = BalancedDgcmg::bare_wheel(4.0, 0.2, 0.1);
    let vscmg = Vscmg::bare_wheel(4.0, disc);
    let balanced_vscmg = BalancedVscmg::bare_wheel(4.0, 0.2, 0.1);
    let sgcmg = Sgcmg::bare_wheel(4.0, disc);
    let balanced_sgcmg = BalancedSgcmg::bare_wheel(4.0, 0.2, 0.1);
    let reaction_wheel = ReactionWheel::bare_wheel(4.0, disc);
    let balanced_reaction_wheel = BalancedReactionWheel::bare_wheel(4.0, 0.2, 0.1);
    let hinged_panel = HingedPanel::bare_panel(4.0, disc);
    let slosh_mass = SloshMass::bare_slosh_mass(4.0);
    let flexible_reaction_wheel = FlexibleReactionWheel::bare_wheel(4.0, disc);
    // A massless gimbal whose rotor moves in all six freedoms has no inertia at all.
    let flexible_vscmg =
        FlexibleVscmg { m_g: 4.0, i_g_gc: disc, ..FlexibleVscmg::bare_wheel(4.0, disc) };
    count! { counts,
        dgvscmg_1 dgvscmg 1;
        dgvscmg_4 dgvscmg 4;
        balanced_dgvscmg_1 balanced_dgvscmg 1;
        balanced_dgvscmg_4 balanced_dgvscmg 4;
        dgcmg_1 dgcmg 1;
        dgcmg_4 dgcmg 4;
        balanced_dgcmg_1 balanced_dgcmg 1;
        balanced_dgcmg_4 balanced_dgcmg 4;
        vscmg_1 vscmg 1;
        vscmg_4 vscmg 4;
        balanced_vscmg_1 balanced_vscmg 1;
        balanced_vscmg_4 balanced_vscmg 4;
        sgcmg_1 sgcmg 1;
        sgcmg_4 sgcmg 4;
        balanced_sgcmg_1 balanced_sgcmg 1;
        balanced_sgcmg_4 balanced_sgcmg 4;
        reaction_wheel_1 reaction_wheel 1;
        reaction_wheel_4 reaction_wheel 4;
        balanced_reaction_wheel_1 balanced_reaction_wheel 1;
        balanced_reaction_wheel_4 balanced_reaction_wheel 4;
        hinged_panel_1 hinged_panel 1;
        hinged_panel_4 hinged_panel 4;
        slosh_mass_1 slosh_mass 1;
        slosh_mass_4 slosh_mass 4;
        flexible_reaction_wheel_1 flexible_reaction_wheel 1;
        flexible_reaction_wheel_4 flexible_reaction_wheel 4;
        flexible_vscmg_1 flexible_vscmg 1;
        flexible_vscmg_4 flexible_vscmg 4;
    }
    counts.steering(dgvscmg)?;
    counts.baked()?;
    counts.0.end()
}

/// What is counted of devices.
struct Measured<'a>(Counts<'a>);

impl Measured<'_> {
    /// An evaluation and a step of these devices.
    fn count<D: FixedSet<Scalar = f64>>(
        &mut self,
        name: &str,
        devices: &D,
        evaluate: Evaluate<D>,
        step: Step<D>,
    ) -> Result<(), Stop> {
        let craft = Spacecraft::new(&hub(), devices).map_err(Stop::Parameters)?;
        let (mut state, mut inputs) = (State::<D>::at_rest(), Inputs::<D>::none());
        moving(&mut state, &mut inputs);
        let mut found: Accelerations<D> =
            craft.accelerations(&state, &inputs).map_err(Stop::Solve)?;
        // Known to the compiler neither by address nor by value: nothing is inlined.
        let (evaluate, step) = (black_box(evaluate), black_box(step));
        write!(self.0.out, "{name} accelerations")?;
        self.0.line("", || evaluate(&craft, black_box(&state), &inputs, black_box(&mut found)))?;
        write!(self.0.out, "{name} step")?;
        self.0.line("", || step(&craft, black_box(&mut state), &inputs, STEP))
    }

    /// Terms, allocation of a torque, and servo of four DGVSCMGs: every gimbal by its rate, every wheel by its acceleration.
    fn steering(&mut self, device: Dgvscmg) -> Result<(), Stop> {
        use library::steering;
        const JOINTS: usize = steering::JOINTS;
        let mut devices = [device; 4];
        // Along different axes: four gyros on one axis give no torque across it.
        for (k, device) in devices.iter_mut().enumerate() {
            if k % 2 == 1 {
                device.mount = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
            }
        }
        let craft = Spacecraft::new(&hub(), &devices).map_err(Stop::Parameters)?;
        let (mut state, mut inputs) =
            (State::<steering::Set>::at_rest(), Inputs::<steering::Set>::none());
        moving(&mut state, &mut inputs);
        let steered = [Steered::Rate, Steered::Rate, Steered::Acceleration];
        let steered: [Steered; JOINTS] = core::array::from_fn(|k| steered[k % 3]);
        let mut terms = craft.steering_terms(&state).map_err(|_| Stop::Rejected)?;
        let matrix = terms.matrix(&steered);
        let (law, torque) = (SteeringLaw::exact(), Vector3::new(0.3, -0.2, 0.1));
        let mut found = law.allocate(&matrix, &torque).map_err(|_| Stop::Rejected)?;
        let servo = Servo { steered, gains: [20.0; JOINTS], limits: [f64::INFINITY; JOINTS] };
        let mut torques = [0.0; JOINTS];
        // By address, so that nothing is inlined.
        let of_terms: extern "C" fn(&_, &_, &mut _) -> bool = black_box(steering::terms);
        self.0.line("dgvscmg_4 steering_terms", || {
            of_terms(&craft, black_box(&state), black_box(&mut terms))
        })?;
        let allocate: extern "C" fn(&_, &_, &_, &mut _) -> bool = black_box(steering::allocate);
        self.0.line("dgvscmg_4 allocate", || {
            allocate(&law, black_box(&matrix), &torque, black_box(&mut found))
        })?;
        let commands = [0.1; JOINTS];
        let of_servo: extern "C" fn(&_, &_, &_, &_, &_, &mut _) -> bool =
            black_box(steering::servo);
        self.0.line("dgvscmg_4 servo", || {
            let state = black_box(&state);
            of_servo(&craft, &servo, state, &inputs, &commands, black_box(&mut torques))
        })
    }

    /// An evaluation of a spacecraft by kernels of its own: four DGVSCMGs, gimbals locked.
    fn baked(&mut self) -> Result<(), Stop> {
        use imaging_satellite::cmg::{Device, Drives, Joints};
        use imaging_satellite::{
            Body, Drive, Error as Failed, Inputs as Given, Parameters, Spacecraft, State,
        };
        type Evaluated =
            fn(&Spacecraft, &State, &Given) -> Result<imaging_satellite::Accelerations, Failed>;
        let body = |mass: f64, centre: f64, [x, y, z]: [f64; 3]| Body {
            mass,
            origin: [0.0; 3],
            centre_of_mass: [0.0, centre, 0.0],
            inertia: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]],
        };
        let outer = Body { origin: [0.0, 0.0, 0.45], ..body(4.0, 0.0, [0.09, 0.07, 0.08]) };
        let bodies = [
            outer,
            body(3.0, 0.0, [0.03, 0.05, 0.03]),
            body(6.0, 2.5e-6, [0.0191, 0.0114, 0.0114]),
        ];
        // Axes exchanged as those of the pyramid are, and no turn.
        let mount = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let device = Device { mount, bodies, gamma_o: 0.3, gamma_i: 0.2 };
        let inertia = [[900.0, 50.0, 30.0], [50.0, 800.0, 20.0], [30.0, 20.0, 600.0]];
        let centre_of_mass = [0.1, -0.2, 0.3];
        let hub = imaging_satellite::Hub { mass: 800.0, centre_of_mass, inertia };
        let craft = Spacecraft::new(&Parameters { hub, cmg: [device; 4] });
        let craft = craft.map_err(|_| Stop::Rejected)?;
        let omega = [0.3, -0.2, 0.4];
        let state = State { omega, cmg: [Joints { theta: 0.7, spin: 1.5 }; 4] };
        let inputs = Given {
            force: [5.0, 6.0, 7.0],
            torque_b: [0.5, 0.6, 0.7],
            cmg: [Drives { u_w: Drive::Torque(0.1) }; 4],
        };
        // By address, so that nothing is inlined.
        let evaluate = black_box(Spacecraft::accelerations as Evaluated);
        self.0.line("imaging_satellite accelerations", || {
            let found = evaluate(black_box(&craft), black_box(&state), black_box(&inputs));
            black_box(&found).is_ok()
        })
    }
}
