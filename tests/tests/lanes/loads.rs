//! Applied loads and dry friction in lanes: wrenches on bodies, a central field, the lumped model, in
//! every mixture beside lanes that have none of them, against each state by itself: to the bit,
//! errors and the sign of zero included.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::lanes::Batch;
use precess_dynamics::{
    Each as _, Gravity, ImbalanceModel, Inputs, JointStates as _, Mode, Passive, ReactionWheel,
    Sgcmg, SolveError, Spacecraft, State,
};
use precess_tests::random::Random;

use super::batch::one_after_another;
use super::batch::{Mixed, hub, mixed, states};
use super::one_spacecraft_each::printed;

/// Which loads spacecraft and inputs have.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a load that is there or not")]
struct Loads {
    wrenches: bool,
    central: bool,
    lumped: bool,
    dry: bool,
}

impl Loads {
    /// Every combination.
    fn all() -> impl Iterator<Item = Self> {
        let bit = |of: u32, place: u32| of & (1 << place) != 0;
        (0..16).map(move |of| Self {
            wrenches: bit(of, 0),
            central: bit(of, 1),
            lumped: bit(of, 2),
            dry: bit(of, 3),
        })
    }

    /// Devices with these loads of their own, some of them.
    fn devices(self, random: &mut Random) -> Mixed {
        let mut devices = mixed();
        devices.0[0].r_w_b = random.vector(0.3);
        devices.1.r_g_b = random.vector(0.4);
        devices.1.d = 0.01;
        let mut some = || random.bits() & 1 == 0;
        if self.lumped && some() {
            (devices.0[0].model, devices.0[0].d) = (ImbalanceModel::Lumped, 0.002);
        }
        if self.lumped && some() {
            devices.1.model = ImbalanceModel::Lumped;
        }
        if self.dry && some() {
            devices.0[1].passive.wheel = Passive::friction(0.01, 0.02, 0.5);
        }
        if self.dry && some() {
            let sprung = Passive { rest: 0.1, ..Passive::spring(0.3, 0.02) };
            devices.1.passive.gimbal = Passive { coulomb: 0.01, coulomb_rate: 0.2, ..sprung };
        }
        if some() {
            devices.2.passive.slosh_mass = Passive::none();
        }
        devices
    }

    /// Inputs with these loads, some of them; zeros of either sign among the numbers.
    fn inputs(self, random: &mut Random) -> Inputs<Mixed> {
        let mut inputs: Inputs<Mixed> = Inputs::none();
        inputs.force = random.vector(3.0);
        inputs.force.y = -0.0;
        inputs.torque_b = random.vector(2.0);
        inputs.motors.0[1].u_w = -0.0;
        inputs.motors.1.u_g = 0.3;
        inputs.modes.1.gimbal = match random.bits() % 4 {
            0 => Mode::Prescribed(0.2),
            // Rejected: it moves.
            1 if random.bits().is_multiple_of(8) => Mode::Locked,
            _ => Mode::Driven,
        };
        inputs.gravity = match random.bits() % 3 {
            0 => Gravity::None,
            1 => Gravity::Uniform(Vector3::new(0.0, -0.0, -9.81)),
            _ if self.central => Gravity::Central { mu: random.log_within(1.0, 4e14) },
            _ => Gravity::None,
        };
        if self.wrenches && !random.bits().is_multiple_of(3) {
            let mut bodies = Inputs::<Mixed>::no_wrenches();
            for wrench in bodies.values_mut() {
                wrench.force = random.vector(2.0);
                wrench.moment = random.vector(0.5);
                wrench.moment.z = -0.0;
            }
            inputs.bodies = Some(bodies);
        }
        inputs
    }
}

/// States near a centre of gravity, whose gimbals turn in either direction, slowly in some.
fn moving(count: u32, random: &mut Random) -> Vec<State<Mixed>> {
    let mut states = states(count);
    for state in &mut states {
        let far = random.log_within(5.0, 7e6);
        state.r_b_n = random.vector(far);
        state.devices.1.gamma_dot = random.within(-0.5, 0.5);
        state.devices.0[1].spin = random.within(-3.0, 3.0);
    }
    states
}

/// A campaign: spacecraft, states, inputs.
struct Campaign {
    crafts: Vec<Spacecraft<Mixed>>,
    states: Vec<State<Mixed>>,
    inputs: Vec<Inputs<Mixed>>,
}

impl Campaign {
    fn new(loads: Loads, count: u32, random: &mut Random) -> Self {
        let craft = |random: &mut Random| {
            let devices = loads.devices(random);
            Spacecraft::new(&hub(), &devices).unwrap()
        };
        Self {
            crafts: (0..count).map(|_| craft(random)).collect(),
            states: moving(count, random),
            inputs: (0..count).map(|_| loads.inputs(random)).collect(),
        }
    }

    /// All accelerations, one by one.
    fn accelerations<'a>(&self, craft: impl Fn(usize) -> &'a Spacecraft<Mixed>) -> String {
        let all = self.states.iter().zip(&self.inputs).enumerate();
        let found = all.map(|(k, (state, inputs))| craft(k).accelerations(state, inputs));
        printed(&found.collect::<Vec<_>>())
    }

    /// Ends of all runs and what became of them, one by one.
    fn runs<'a>(&self, steps: usize, craft: impl Fn(usize) -> &'a Spacecraft<Mixed>) -> String {
        let all = self.states.iter().zip(&self.inputs).enumerate();
        let ends = all.map(|(k, (start, inputs))| {
            let mut state = *start;
            let end = (0..steps).try_for_each(|_| {
                state = craft(k).step(&state, inputs, 1e-3)?;
                Ok::<_, SolveError<f64>>(())
            });
            (state, end)
        });
        printed(&ends.collect::<Vec<_>>())
    }
}

#[test]
fn every_mixture_of_loads_has_the_bits_of_single_evaluations() {
    let random = &mut Random::new(0x10AD);
    for loads in Loads::all() {
        for count in [1, 8, 21] {
            let campaign = Campaign::new(loads, count, random);
            let Campaign { crafts, states, inputs } = &campaign;
            let mut found = Vec::new();
            let batch = Batch::from_spacecraft(crafts.clone());
            batch.accelerations(states, inputs, &mut found).unwrap();
            let single = campaign.accelerations(|k| &crafts[k]);
            assert_eq!(printed(&found), single, "{loads:?}, {count} spacecraft");
            // One spacecraft, and one for each state with its own inputs.
            let devices = loads.devices(random);
            let batch = Batch::new(&hub(), &devices).unwrap();
            batch.accelerations(states, inputs, &mut found).unwrap();
            let single = campaign.accelerations(|_| &batch.spacecraft()[0]);
            assert_eq!(printed(&found), single, "{loads:?}, {count} states");
        }
    }
}

#[test]
fn inputs_of_all_states_have_the_bits_of_single_evaluations() {
    let random = &mut Random::new(0x10AE);
    for loads in Loads::all() {
        let mut campaign = Campaign::new(loads, 19, random);
        let one = campaign.inputs[0];
        campaign.inputs.fill(one);
        let Campaign { crafts, states, .. } = &campaign;
        let mut found = Vec::new();
        let batch = Batch::from_spacecraft(crafts.clone());
        batch.accelerations(states, &one, &mut found).unwrap();
        assert_eq!(printed(&found), campaign.accelerations(|k| &crafts[k]), "{loads:?}");
        let batch = Batch::new(&hub(), &loads.devices(random)).unwrap();
        batch.accelerations(states, &one, &mut found).unwrap();
        let single = campaign.accelerations(|_| &batch.spacecraft()[0]);
        assert_eq!(printed(&found), single, "{loads:?}");
    }
}

#[test]
fn runs_with_loads_have_the_bits_of_single_steps() {
    let random = &mut Random::new(0x10AF);
    for loads in Loads::all() {
        let campaign = Campaign::new(loads, 11, random);
        let Campaign { crafts, states, inputs } = &campaign;
        let (mut run, mut ends) = (states.clone(), Vec::new());
        let batch = Batch::from_spacecraft(crafts.clone());
        batch.run(&mut run, inputs, 1e-3, 12, &mut ends).unwrap();
        let found = run.into_iter().zip(ends.drain(..)).collect::<Vec<_>>();
        assert_eq!(printed(&found), campaign.runs(12, |k| &crafts[k]), "{loads:?}");
        let batch = Batch::new(&hub(), &loads.devices(random)).unwrap();
        let mut run = states.clone();
        batch.run(&mut run, inputs, 1e-3, 12, &mut ends).unwrap();
        let found = run.into_iter().zip(ends.drain(..)).collect::<Vec<_>>();
        assert_eq!(printed(&found), campaign.runs(12, |_| &batch.spacecraft()[0]), "{loads:?}");
    }
}

/// Wheels that friction stops, some within the run and some not.
#[test]
fn joints_that_friction_stops_have_the_bits_of_single_steps() {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01));
    let mut wheel = ReactionWheel { d: 1e-5, ..ReactionWheel::bare_wheel(3.0, disc) };
    wheel.passive.wheel = Passive::friction(0.0, 0.05, 0.01);
    let batch = Batch::new(&hub(), &[wheel; 2]).unwrap();
    let start = |k: u32| {
        let mut state: State<[ReactionWheel; 2]> = State::at_rest();
        (state.devices[0].spin, state.devices[1].spin) = (0.02 * f64::from(k), -1.0);
        state
    };
    let mut inputs: Inputs<[ReactionWheel; 2]> = Inputs::none();
    inputs.motors[0].u_w = -0.01;
    let starts: Vec<_> = (0..16).map(start).collect();
    let (mut run, mut ends) = (starts.clone(), Vec::new());
    // The friction of 5 N m s/rad near rest is stable up to 11 ms. A single step that is too long
    // shows in the stiffness only, several in a rate that changes its sign.
    for (dt, steps) in [(1e-3, 60), (0.02, 60), (0.02, 1)] {
        run.clone_from(&starts);
        batch.run(&mut run, &inputs, dt, steps, &mut ends).unwrap();
        for (k, start) in starts.iter().enumerate() {
            let mut state = *start;
            let end = (0..steps).try_for_each(|_| {
                state = batch.spacecraft()[0].step(&state, &inputs, dt)?;
                Ok::<_, SolveError<f64>>(())
            });
            assert_eq!(printed(&(run[k], &ends[k])), printed(&(state, end)), "{dt} s, run {k}");
        }
        let stopped = run.iter().filter(|state| state.devices[0].spin <= 0.0).count();
        assert!((1..16).contains(&stopped) || dt > 0.01, "{stopped} of 16 stopped");
        assert_eq!(ends.iter().any(Result::is_err), dt > 0.01);
    }
}

/// Minus zero and zero add up to zero: what acts in one lane may not change zeros of another.
#[test]
fn loads_of_other_lanes_leave_the_sign_of_zero() {
    let mut states: Vec<State<Mixed>> = vec![State::at_rest(); 8];
    for (k, state) in states.iter_mut().enumerate() {
        state.r_b_n.x = if k == 3 { 1e3 } else { -0.0 };
    }
    let minus = Vector3::new(-0.0, -0.0, -0.0);
    let mut quiet: Inputs<Mixed> = Inputs::none();
    (quiet.force, quiet.torque_b) = (minus, minus);
    (quiet.motors.0[0].u_w, quiet.motors.1.u_g) = (-0.0, -0.0);
    let mut inputs = vec![quiet; 8];
    inputs[1].gravity = Gravity::Uniform(minus);
    inputs[2].bodies = Some(Inputs::<Mixed>::no_wrenches());
    inputs[3].gravity = Gravity::Central { mu: 1.0 };
    let mut bodies = Inputs::<Mixed>::no_wrenches();
    bodies.values_mut().for_each(|wrench| (wrench.force, wrench.moment) = (minus, minus));
    inputs[4].bodies = Some(bodies);
    let craft = |k: usize| {
        let (mut hub, mut devices) = (hub(), mixed());
        hub.r_bc_b = Vector3::zeros();
        if k == 5 {
            devices.0[0].model = ImbalanceModel::Lumped;
        }
        if k == 6 {
            devices.0[0].passive.wheel = Passive::friction(0.0, 1e-3, 0.1);
        }
        Spacecraft::new(&hub, &devices).unwrap()
    };
    let crafts: Vec<_> = (0..8).map(craft).collect();
    let mut found = Vec::new();
    Batch::from_spacecraft(crafts.clone()).accelerations(&states, &inputs, &mut found).unwrap();
    let campaign = Campaign { crafts: crafts.clone(), states, inputs };
    let single = campaign.accelerations(|k| &crafts[k]);
    assert!(single.contains("-0.0"), "no minus zero: nothing is checked");
    assert_eq!(printed(&found), single);
}

#[test]
fn loads_that_are_rejected_are_named_as_by_themselves() {
    let mut states = states(8);
    let mut inputs: Vec<Inputs<Mixed>> = vec![Inputs::none(); 8];
    for (k, (state, inputs)) in states.iter_mut().zip(&mut inputs).enumerate() {
        inputs.gravity = Gravity::Central { mu: 4e14 };
        state.r_b_n = match k {
            0 => Vector3::zeros(),
            // Beyond where the square of the distance is a number, or its reciprocal.
            1 => Vector3::new(1e-40, 0.0, 0.0),
            2 => Vector3::new(0.3e35, 0.7e35, -0.2e35),
            _ => Vector3::new(7e6, 1.0, 2.0),
        };
        if k == 2 {
            inputs.gravity = Gravity::Central { mu: 1e71 };
        }
        if k == 4 {
            inputs.gravity = Gravity::Central { mu: f64::NAN };
        }
        if k == 5 {
            let mut bodies = Inputs::<Mixed>::no_wrenches();
            bodies.1.gimbal.moment.y = f64::NEG_INFINITY;
            inputs.bodies = Some(bodies);
        }
    }
    let batch = Batch::new(&hub(), &mixed()).unwrap();
    let mut found = Vec::new();
    batch.accelerations(&states, &inputs, &mut found).unwrap();
    let crafts = vec![batch.spacecraft()[0].clone(); 8];
    let single = Campaign { crafts: crafts.clone(), states, inputs };
    assert_eq!(printed(&found), single.accelerations(|k| &crafts[k]));
    let rejected = found.iter().map(Result::is_err).collect::<Vec<_>>();
    assert_eq!(rejected, [true, false, false, false, true, true, false, false]);
}

#[test]
fn devices_side_by_side_have_the_bits_of_one_state_with_loads() {
    let random = &mut Random::new(0x10B1);
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    for _ in 0..50 {
        let mut devices = [Sgcmg { d: 1e-3, ..Sgcmg::bare_wheel(4.0, disc) }; 5];
        let mut inputs: Inputs<[Sgcmg; 5]> = Inputs::none();
        let mut state: State<[Sgcmg; 5]> = State::at_rest();
        for device in &mut devices {
            device.r_g_b = random.vector(0.5);
            if random.bits() & 1 == 0 {
                device.model = ImbalanceModel::Lumped;
            }
            if random.bits() & 1 == 0 {
                device.passive.gimbal = Passive::friction(0.01, 0.1, 0.2);
            }
        }
        for [coordinate, rate] in state.devices.states_mut() {
            (*coordinate, *rate) = (random.within(-3.0, 3.0), random.within(-2.0, 2.0));
        }
        (state.r_b_n, state.omega) = (random.vector(50.0), random.vector(0.3));
        if random.bits() & 1 == 0 {
            inputs.gravity = Gravity::Central { mu: 1e3 };
        }
        if random.bits() & 1 == 0 {
            let mut bodies = Inputs::<[Sgcmg; 5]>::no_wrenches();
            for wrench in bodies.values_mut() {
                wrench.force = random.vector(2.0);
            }
            inputs.bodies = Some(bodies);
        }
        let craft = Spacecraft::new(&hub(), &devices).unwrap();
        let in_order = one_after_another(&craft);
        let single = in_order.accelerations(&state, &inputs).unwrap();
        assert_eq!(craft.accelerations(&state, &inputs).unwrap(), single);
        let single = in_order.step(&state, &inputs, 1e-4).unwrap();
        assert_eq!(craft.step(&state, &inputs, 1e-4).unwrap(), single);
    }
}
