//! Steps of RK4 of a batch of one spacecraft, for `python/benchmarks/throughput.py`, which times this program: no Python.
//!
//!     throughput SCENARIO STATES STEPS CALLS

use precess_dynamics::lanes::Batch;
use precess_dynamics::{BuiltIn, Dgvscmg, Inputs, State};

/// By how much the body rate of a state exceeds that of the one before, of itself.
const APART: f64 = 1e-3;
/// Step, s: short, so that no call runs into a state unlike the first.
const STEP: f64 = 1e-7;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [file, states, steps, calls] = words.as_slice() else {
        return Err("usage: throughput SCENARIO STATES STEPS CALLS".into());
    };
    let (states, steps, calls): (usize, usize, usize) =
        (states.parse()?, steps.parse()?, calls.parse()?);
    let text = std::fs::read_to_string(file)?;
    let folder = std::path::Path::new(file).parent().unwrap_or(std::path::Path::new(""));
    let (scenario, _) = precess::file::from_toml("throughput", &text, folder)?;
    let gyro = |device: &BuiltIn| match device {
        BuiltIn::Dgvscmg(gyro) => Some(*gyro),
        _ => None,
    };
    let devices: Vec<Dgvscmg> = scenario.devices.0.iter().filter_map(gyro).collect();
    let batch = Batch::new(&scenario.hub, &devices)?;
    let craft = batch.spacecraft().first().ok_or("no spacecraft")?;
    let mut state = State::at_rest_for(craft);
    state.omega = scenario.initial.omega;
    let rates = scenario.initial.devices.0.iter();
    for (to, from) in state.devices.iter_mut().zip(rates) {
        use precess_dynamics::JointStates as _;
        to.states_mut().zip(from.states()).for_each(|([x, rate], [y, other])| {
            (*x, *rate) = (y, other);
        });
    }
    let mut all = Vec::with_capacity(states);
    for _ in 0..states {
        all.push(state.clone());
        state.omega *= 1.0 + APART;
    }
    let inputs = Inputs::none_for(craft);
    let mut ends = Vec::new();
    for _ in 0..calls {
        let mut now = all.clone();
        batch.run(&mut now, &inputs, STEP, steps, &mut ends)?;
        if let Some(Err(error)) = ends.iter().find(|end| end.is_err()) {
            return Err((*error).into());
        }
        std::hint::black_box(now);
    }
    Ok(())
}
