//! What a sample costs: N DGVSCMGs of Table 1 for ten seconds by DOP853, at 1 kHz to CSV, to NPZ, to
//! nothing, and without samples.
//!
//! `cargo run --release -p precess --example sample_cost -- [N]`; the least of seven runs each.

use std::ops::ControlFlow;
use std::time::Instant;

use nalgebra::{Matrix3, Vector3};
use precess::engine::{Outcome, run};
use precess::record::{Csv, Header, Npz, RecordError, Recorder};
use precess::scenario::{
    Drive, IntegratorChoice, Output, Profile, Scenario, Set, Settings, Source,
};
use precess_dynamics::{Dgvscmg, Gravity, Hub, HubMode, JointArray, Quaternion, Spacecraft, State};

/// Records nothing.
struct Nothing;

impl Recorder for Nothing {
    fn begin(&mut self, _: &Header) -> Result<(), RecordError> {
        Ok(())
    }

    fn sample(&mut self, _: &[f64]) -> Result<(), RecordError> {
        Ok(())
    }

    fn finish(&mut self, _: &Outcome) -> Result<(), RecordError> {
        Ok(())
    }
}

fn scenario(count: usize) -> Result<Scenario, Box<dyn std::error::Error>> {
    let gimbal = Matrix3::from_diagonal(&Vector3::new(9.0, 11.0, 5.0));
    let hub = Hub {
        m_b: 810.0,
        r_bc_b: Vector3::new(0.0, 0.0, 0.1),
        i_b_bc: Matrix3::from_diagonal(&Vector3::new(900.0, 800.0, 600.0)),
    };
    let wheel = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let devices: Set = (0..count)
        .map(|_| {
            let device = Dgvscmg {
                r_go_b: Vector3::new(0.3, 0.0, 0.0),
                m_go: 24.0,
                i_go_goc: gimbal,
                m_gi: 24.0,
                i_gi_gic: gimbal,
                d: 8e-3,
                ..Dgvscmg::bare_wheel(4.0, wheel)
            };
            device.into()
        })
        .collect();
    let torque =
        |newton_metres| Drive::Torque { profile: Profile::Constant(newton_metres), limit: None };
    let spacecraft = Spacecraft::new(&hub, &devices)?;
    let mut initial: State<Set, Quaternion> = State::at_rest_for(&spacecraft);
    initial.omega = Vector3::new(0.085, 0.01, 0.0);
    for joints in initial.devices.iter_mut().map(JointArray::as_mut_slice) {
        joints[2] = [0.0, 52.36];
    }
    Ok(Scenario {
        name: "cost".to_owned(),
        title: String::new(),
        description: String::new(),
        hub,
        hub_size: Vector3::repeat(1.0),
        names: (1..=count).map(|number| format!("cmg{number}")).collect(),
        devices,
        initial,
        hub_mode: HubMode::Free,
        gravity: Gravity::None,
        drives: [0.1, 0.1, 0.2].repeat(count).into_iter().map(torque).collect(),
        stops: Vec::new(),
        wrenches: Vec::new(),
        changes: Vec::new(),
        crossings: Vec::new(),
        settings: Settings {
            duration: 10.0,
            integrator: IntegratorChoice::Dop853 { tolerance: 1e-10 },
        },
        output: Output { rate: 1000.0, columns: Vec::new(), formats: Vec::new() },
        requirements: Vec::new(),
        source: Source::default(),
    })
}

/// The least time of seven runs, s, and the outcome of the last.
fn time(
    scenario: &Scenario,
    mut recorder: impl FnMut() -> Box<dyn Recorder>,
) -> Result<(f64, Outcome), Box<dyn std::error::Error>> {
    let mut least = f64::INFINITY;
    let mut last = None;
    for _ in 0..7 {
        let mut recorder = recorder();
        let start = Instant::now();
        last = Some(run(scenario, &mut *recorder, &mut |_| ControlFlow::Continue(()))?);
        least = least.min(start.elapsed().as_secs_f64());
    }
    last.map(|outcome| (least, outcome)).ok_or_else(|| "no run".into())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(4), |count| count.parse())?;
    let full = scenario(count)?;
    let mut none = full.clone();
    none.output.rate = 1.0 / none.settings.duration;
    let mut state = full.clone();
    state.output.columns =
        ["position", "velocity", "attitude", "omega"].map(str::to_owned).to_vec();
    let folder = tempfile::tempdir()?;
    let (base, outcome) = time(&none, || Box::new(Nothing))?;
    println!("{count} devices, no samples: {:.1} ms, {:?}", base * 1e3, outcome.steps);
    let show = |what: &str, scenario: &Scenario, make: &dyn Fn() -> Box<dyn Recorder>| {
        let (seconds, outcome) = time(scenario, make)?;
        #[expect(clippy::cast_precision_loss, reason = "ten thousand")]
        let samples = outcome.samples as f64;
        let each = (seconds - base) / samples * 1e6;
        println!("{what}: {:.1} ms, {each:.2} us a sample", seconds * 1e3);
        Ok::<_, Box<dyn std::error::Error>>(())
    };
    show("default columns, to nothing", &full, &|| Box::new(Nothing))?;
    let csv = folder.path().join("cost.csv");
    show("default columns, CSV", &full, &|| Box::new(Csv::new(&csv)))?;
    let npz = folder.path().join("cost.npz");
    show("default columns, NPZ", &full, &|| Box::new(Npz::new(&npz)))?;
    show("hub's state, CSV", &state, &|| Box::new(Csv::new(&csv)))?;
    let mut loads = full.clone();
    loads.output.columns = ["omega", "cmg1", "loads"].map(str::to_owned).to_vec();
    show("all loads, CSV", &loads, &|| Box::new(Csv::new(&csv)))?;
    Ok(())
}
