//! The longest step that the error of a step names: it is accepted, no vibration grows with it, and
//! it is that of the eigenvalues of the whole system, for every kind.

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates, Kind};
use precess_dynamics::{
    FlexibleReactionWheel, HingedPanel, Hub, HubMode, ImbalanceModel, Inputs, Mode, Passive,
    SloshMass, SolveError, Spacecraft, State, flexible_reaction_wheel, hinged_panel,
};
use precess_tests::measured::{EachKind, each_kind};
use precess_tests::random::{Random, SEED};
use precess_tests::vibrations::longest_step;

/// Drawn spacecraft of each kind.
const DRAWN: usize = 12;

/// The named step is at most this much below that of the eigenvalues: an undamped vibration is
/// limited exactly, but for the rounding of eigenvalues; damped ones by lines that stay below the
/// limit by 9 %, and between joints of different damping by what a convex set adds to them.
const UNDAMPED: f64 = 1e-5;
const DAMPED: f64 = 0.15;

/// Steps after which vibrations are compared with those of as many steps before.
const STEPS: usize = 150;

fn diagonal(x: f64, y: f64, z: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(x, y, z))
}

/// The longest step that the errors name; none if any step is accepted.
fn named<K: Kind<Scalar = f64>>(
    craft: &Spacecraft<[K; 2]>,
    state: &State<[K; 2]>,
    inputs: &Inputs<[K; 2]>,
) -> Option<(usize, &'static str, f64)> {
    match craft.step(state, inputs, 1e3) {
        Ok(_) => None,
        Err(SolveError::Unstable { device, joint, dt: 1e3, longest }) => {
            Some((device, joint, longest))
        }
        Err(error) => panic!("{error}"),
    }
}

struct Limits {
    random: Random,
    undamped: f64,
    damped: f64,
    checked: usize,
}

impl EachKind<f64> for Limits {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, device: K) {
        for number in 0..DRAWN {
            self.draw::<K>(&format!("{name} {number}"), &device, number % 2 == 0);
        }
    }
}

impl Limits {
    fn draw<K: Kind<Scalar = f64>>(&mut self, name: &str, device: &K, damped: bool) {
        let random = &mut self.random;
        let size = random.log_within(0.3, 30.0);
        let hub =
            Hub { m_b: size, r_bc_b: random.vector(0.1), i_b_bc: diagonal(0.1, 0.12, 0.15) * size };
        let mut state = State::<[K; 2]>::at_rest();
        for [coordinate, _] in state.devices.states_mut() {
            *coordinate = random.within(-0.5, 0.5);
        }
        let mut coordinates = state.devices.states().map(|[coordinate, _]| coordinate);
        let devices = [(); 2].map(|()| {
            let mut bodies = device.bodies();
            for body in bodies.values_mut() {
                // Gimbals of the bare device have none.
                body.mass += random.log_within(0.1, 3.0);
                body.inertia += diagonal(0.011, 0.013, 0.012) * random.log_within(1.0, 30.0);
                body.origin = random.vector(0.6).into();
            }
            let mut passive = K::all(Passive::none());
            for (passive, rest) in passive.values_mut().zip(&mut coordinates) {
                passive.rest = rest;
                passive.stiffness = random.log_within(1.0, 1e4);
                if damped {
                    passive.viscous = random.log_within(0.1, 100.0);
                    passive.stiffness *= f64::from(u8::from(random.within(0.0, 1.0) < 0.7));
                }
            }
            let mount = device.mount();
            K::of_bodies(mount, &bodies, &passive, ImbalanceModel::Coupled)
        });
        let craft = Spacecraft::new(&hub, &devices).expect(name);
        let mut inputs = Inputs::<[K; 2]>::none();
        if random.within(0.0, 1.0) < 0.3 {
            inputs.hub = HubMode::Fixed;
        }
        let infos: Vec<_> = craft.joints().map(|(_, info)| info).collect();
        let mut driven = Vec::new();
        let modes = inputs.modes.iter_mut().flat_map(Each::values_mut);
        for (index, (mode, info)) in modes.zip(&infos).enumerate() {
            match random.within(0.0, 1.0) {
                _ if !info.driven => {}
                x if x < 0.15 => *mode = Mode::Locked,
                x if x < 0.3 => *mode = Mode::Prescribed(0.0),
                _ => driven.push(index),
            }
        }
        self.check(name, &craft, (&state, &inputs), &devices, &driven, damped);
    }

    fn check<K: Kind<Scalar = f64>>(
        &mut self,
        name: &str,
        craft: &Spacecraft<[K; 2]>,
        (state, inputs): (&State<[K; 2]>, &Inputs<[K; 2]>),
        devices: &[K; 2],
        driven: &[usize],
        damped: bool,
    ) {
        let Some((_, joint, longest)) = named(craft, state, inputs) else {
            assert!(driven.is_empty(), "{name}: every step is accepted");
            return;
        };
        let own: Vec<_> = devices.map(|device| device.passive()).values().collect();
        let responses = DMatrix::from_fn(driven.len(), driven.len(), |_, _| 0.0);
        let responses = (0..driven.len()).fold(responses, |mut responses, column| {
            let mut inputs = *inputs;
            let torque = inputs.motors.iter_mut().flat_map(Each::values_mut).nth(driven[column]);
            *torque.expect("a motor") = 1.0;
            let found = craft.accelerations(state, &inputs).expect(name);
            let found: Vec<_> = found.devices.iter().flat_map(Each::values).collect();
            for (row, joint) in driven.iter().enumerate() {
                responses[(row, column)] = found[*joint];
            }
            responses
        });
        let damping: Vec<_> = driven.iter().map(|joint| own[*joint].viscous).collect();
        let stiffness: Vec<_> = driven.iter().map(|joint| own[*joint].stiffness).collect();
        let exact = longest_step(&responses, &damping, &stiffness);
        let short = 1.0 - longest / exact;
        assert!(short > -UNDAMPED, "{name} ({joint}): {longest}, not {exact}");
        assert!(short < if damped { DAMPED } else { UNDAMPED }, "{name}: {longest}, not {exact}");
        let worst = if damped { &mut self.damped } else { &mut self.undamped };
        *worst = worst.max(short);
        self.checked += 1;

        let step = |state: &State<[K; 2]>| craft.step(state, inputs, 0.999 * longest);
        assert!(craft.step(state, inputs, 1.001 * longest).is_err(), "{name}");
        let mut now = *state;
        for (index, [coordinate, _]) in now.devices.states_mut().enumerate() {
            if driven.contains(&index) {
                *coordinate += self.random.within(-1e-6, 1e-6);
            }
        }
        let mut most = [0.0_f64; 2];
        for half in &mut most {
            for _ in 0..STEPS {
                now = step(&now).unwrap_or_else(|error| panic!("{name}: {error}"));
                let found = craft.accelerations(&now, inputs).expect(name);
                *half = half.max(craft.ledger(&now, inputs, &found).expect(name).energy());
            }
        }
        // Truncation of the motion of the pose is of the square of 1e-6.
        assert!(most[1] <= (1.0 + 1e-4) * most[0], "{name}: {most:?}");
    }
}

#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn longest_step_is_that_of_the_eigenvalues_for_every_kind() {
    let random = Random::new(SEED + 3400);
    let mut limits = Limits { random, undamped: 0.0, damped: 0.0, checked: 0 };
    each_kind(&mut limits);
    let Limits { undamped, damped, checked, .. } = limits;
    println!("{checked} spacecraft, short by {undamped:.1e} undamped, {damped:.2} damped at most");
    assert!(checked > 150, "{checked}");
}

/// A spring without damper beside a damper without spring, on a light hub: the second damps the first
/// by a fraction, which does not lengthen the step beyond the limit of the spring.
#[test]
fn damper_of_another_joint_is_not_ones_own() {
    let hub = Hub { m_b: 1.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() };
    // 1 / m + 1 / m_hub.
    let w = (1000.0_f64 * 11.0).sqrt();
    for viscous in [0.0, 10.0, 20.0, 30.0, 40.0, 60.0] {
        let mut set = [SloshMass::bare_slosh_mass(0.1), SloshMass::bare_slosh_mass(4.0)];
        set[0].passive.slosh_mass = Passive::spring(1000.0, 0.0);
        set[1].passive.slosh_mass = Passive::spring(0.0, viscous);
        let craft = Spacecraft::new(&hub, &set).expect("valid");
        let inputs = Inputs::<[SloshMass; 2]>::none();
        let mut state = State::<[SloshMass; 2]>::at_rest();
        state.devices[0].x = 1e-3;
        let Some((0, "slosh mass", longest)) = named(&craft, &state, &inputs) else {
            panic!("damper {viscous}");
        };
        assert!(longest * w <= 8.0_f64.sqrt() * (1.0 + 1e-9), "{viscous}: {}", longest * w);
        let energy = |state: &State<_>| {
            let found = craft.accelerations(state, &inputs).expect("accelerations");
            craft.ledger(state, &inputs, &found).expect("a ledger").energy()
        };
        let start = energy(&state);
        for _ in 0..3000 {
            state = craft.step(&state, &inputs, 0.9999 * longest).expect("a stable step");
        }
        assert!(energy(&state) <= start, "{viscous}");
    }
}

/// A soft panel beside a wheel on stiff bearings: the bearing limits the step, in whatever units.
#[test]
fn error_names_the_stiff_bearing_beside_a_soft_panel() {
    type Set = (HingedPanel, FlexibleReactionWheel);
    let hub = Hub { m_b: 100.0, r_bc_b: Vector3::zeros(), i_b_bc: diagonal(20.0, 18.0, 15.0) };
    let panel = HingedPanel {
        r_pc_p: Vector3::new(0.8, 0.0, 0.0),
        passive: hinged_panel::PerJoint { panel: Passive::spring(30.0, 0.0) },
        ..HingedPanel::bare_panel(5.0, diagonal(0.3, 0.2, 0.25))
    };
    let (slide, tilt) = (Passive::spring(3e6, 60.0), Passive::spring(8e3, 0.2));
    let passive = flexible_reaction_wheel::PerJoint {
        axial_slide: slide,
        radial_slide_y: slide,
        radial_slide_z: slide,
        tilt_y: tilt,
        tilt_z: tilt,
        wheel: Passive::none(),
    };
    let wheel = FlexibleReactionWheel {
        r_sx_b: Vector3::new(0.0, 0.0, 0.5),
        passive,
        ..FlexibleReactionWheel::bare_wheel(3.0, diagonal(0.02, 0.012, 0.012))
    };
    let (state, inputs) = (State::<Set>::at_rest(), Inputs::<Set>::none());
    let craft = Spacecraft::new(&hub, &(panel, wheel)).expect("valid");
    let error = craft.step(&state, &inputs, 0.1).expect_err("too long");
    let SolveError::Unstable { device: 1, joint, longest, .. } = error else { panic!("{error}") };
    assert!(joint.contains("slide") || joint.starts_with("tilt"), "{joint}");
    assert!(craft.step(&state, &inputs, 0.999 * longest).is_ok());
    assert!(craft.step(&state, &inputs, 1.001 * longest).is_err());
}
