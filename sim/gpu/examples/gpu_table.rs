//! The table of a machine with a GPU, in under five minutes: whether every state of every kind has the bits of the processor,
//! and how many states a second a GPU steps.
//!
//! ```sh
//! cargo run --release -p precess-gpu --example gpu_table -- --out table.json       # on a machine with a GPU and NVRTC
//! cargo run --release -p precess-gpu --example gpu_table -- --write-ptx ptx        # anywhere with NVRTC
//! target/release/examples/gpu_table --ptx ptx --out table.json                     # on one with a GPU and without
//! ```
//!
//! `--peak 17` is the arithmetic of the GPU without contraction, TFLOP/s: of a list of data half of what it has for fused
//! operations. Exit status: 0, 1 where a bit differs or something fails, 77 without a GPU, which a line says.

#[allow(dead_code, reason = "shared with the suite of the emitted solver")]
#[path = "../../../codegen/bake/tests/c_solver/case.rs"]
mod case;
#[allow(dead_code, reason = "shared with the suite of the emitted kernels")]
#[path = "../../../codegen/tests/c_kernels/random.rs"]
mod random;
#[allow(dead_code, reason = "shared with the suite of the emitted solver")]
#[path = "../../../codegen/bake/tests/c_solver/reference.rs"]
mod reference;
#[allow(dead_code, reason = "shared with the suite of batches")]
#[path = "../tests/batches/spacecraft.rs"]
mod spacecraft;

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use precess_bake::{Language, Options, bake, batch, solver};
use precess_dynamics::BuiltInKind;
use precess_gpu::{
    ActingInputs, Batch, BatchInputs, Device, GpuError, SampleSettings, SourceFile, Sources, Steps,
    compile, open, open_compiled,
};

use case::{Case, Settings};
use random::Random;

/// States and steps whose bits are compared.
const STATES: usize = 100_000;
const STEPS: usize = 1000;
/// What the processor may take for the comparison of one kind: it computes as many states as it can.
const PER_KIND: Duration = Duration::from_secs(12);
/// Batches that are timed, and steps of each; devices of a spacecraft.
const COUNTS: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];
const TIMED_STEPS: usize = 20;
const DEVICES: [usize; 3] = [1, 4, 16];
/// States that all cores step for comparison.
const ON_CORES: usize = 20_000;
/// Exit status without a GPU.
const MISSING: u8 = 77;

/// Free, with constant inputs.
const SETTINGS: Settings = Settings {
    mrp: false,
    passive: false,
    wrenches: false,
    field: 0,
    hub: 0,
    modes: false,
    dt: 1e-4,
    steps: 0,
};

struct Arguments {
    out: Option<PathBuf>,
    ptx: Option<PathBuf>,
    write_ptx: Option<PathBuf>,
    peak: f64,
}

fn arguments() -> Result<Arguments, String> {
    let mut found = Arguments { out: None, ptx: None, write_ptx: None, peak: 17.0 };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let value = words.next().ok_or_else(|| format!("{word} needs a value"))?;
        match word.as_str() {
            "--out" => found.out = Some(value.into()),
            "--ptx" => found.ptx = Some(value.into()),
            "--write-ptx" => found.write_ptx = Some(value.into()),
            "--peak" => found.peak = value.parse().map_err(|_| format!("--peak {value}"))?,
            _ => return Err(format!("{word} is no option: --out, --ptx, --write-ptx, --peak")),
        }
    }
    Ok(found)
}

/// The sources of a set.
fn sources(kinds: &[BuiltInKind]) -> Result<Sources, GpuError> {
    let description = Sources::description(kinds);
    let fault = |error: &dyn std::fmt::Display| GpuError::Generator(error.to_string());
    let files = solver(&description).map_err(|error| fault(&error))?.into_iter();
    let files = files.chain(batch(&description).map_err(|error| fault(&error))?);
    let files = files.map(|file| SourceFile { path: file.path, text: file.text });
    Ok(Sources { name: description.name, files: files.collect() })
}

/// Names and kinds of all sets.
fn sets() -> Vec<(String, Vec<BuiltInKind>)> {
    let one = BuiltInKind::ALL.iter().map(|kind| (kind.name().to_owned(), vec![*kind]));
    let several = DEVICES.iter().map(|n| (format!("{n}_dgvscmg"), vec![BuiltInKind::Dgvscmg; *n]));
    one.chain(several).collect()
}

/// States at the end, whether each is computed, seconds.
type Ran = (Vec<f64>, Vec<bool>, f64);

/// States of one spacecraft, all different.
struct States {
    case: Case,
    base: ActingInputs,
    y: Vec<f64>,
}

impl States {
    fn random(kinds: &[BuiltInKind], count: usize) -> Self {
        let mut random = Random::new(42);
        let mut case = spacecraft::random(kinds, SETTINGS, &mut random);
        // Loads that a wheel in bearings bears for all steps.
        case.force = [0.0; 3];
        case.joints.iter_mut().for_each(|joint| joint.torque = 0.0);
        let row = spacecraft::row(&case);
        let mut y = row.repeat(count);
        for row in y.chunks_exact_mut(row.len()) {
            for number in row.iter_mut().skip(10) {
                *number *= random.within(0.9, 1.1);
            }
        }
        Self { base: spacecraft::inputs(&case), case, y }
    }

    /// Steps of the first states on a device; the states, and seconds.
    fn run(
        &self,
        device: Result<&dyn Device, GpuError>,
        kinds: &[BuiltInKind],
        count: usize,
        steps: usize,
    ) -> Result<Ran, Box<dyn Error>> {
        let wanted = device.is_ok();
        let craft = vec![spacecraft::craft(&self.case)];
        let mut batch = Batch::new(craft, false, device, |_| sources(kinds))?;
        let size = batch.state_size();
        let mut y = self.y[..count * size].to_vec();
        let steps = Steps { length: SETTINGS.dt, count: steps, normalises: true };
        let settings =
            SampleSettings { every: steps.count, history: false, reductions: Vec::new() };
        let inputs = BatchInputs { base: &self.base, rows: &[] };
        let start = Instant::now();
        let (_, result) = batch.run(&mut y, inputs, steps, &settings, &|_| true)?;
        let seconds = start.elapsed().as_secs_f64();
        if let (true, Some(reason)) = (wanted, result.fallback) {
            return Err(reason.into());
        }
        Ok((y, result.states.iter().map(Result::is_ok).collect(), seconds))
    }
}

/// Bits of every kind: lines of the table, and whether all are the same.
fn bits(
    device: &dyn Device,
    table: &mut String,
    json: &mut Vec<String>,
) -> Result<bool, Box<dyn Error>> {
    let mut same = true;
    writeln!(
        table,
        "| kind | states | compared | of other bits | failed | GPU, s |\n|---|---:|---:|---:|---:|---:|"
    )?;
    for kind in BuiltInKind::ALL {
        let kinds = [*kind];
        let states = States::random(&kinds, STATES);
        let (found, sound, seconds) = states.run(Ok(device), &kinds, STATES, STEPS)?;
        let size = found.len() / STATES;
        let (mut compared, mut other) = (0, 0);
        let start = Instant::now();
        while compared < STATES && start.elapsed() < PER_KIND {
            let part = compared..STATES.min(compared + 2000);
            let one = States {
                case: states.case.clone(),
                base: states.base.clone(),
                y: states.y[part.start * size..part.end * size].to_vec(),
            };
            let (expected, of, _) = one.run(Err(GpuError::NoDriver), &kinds, part.len(), STEPS)?;
            for (index, row) in part.clone().zip(expected.chunks_exact(size)) {
                let own = &found[index * size..(index + 1) * size];
                let equal = own.iter().zip(row).all(|(a, b)| a.to_bits() == b.to_bits());
                other +=
                    usize::from(sound[index] != of[index - part.start] || sound[index] && !equal);
            }
            compared = part.end;
        }
        same &= other == 0;
        let failed = sound.iter().filter(|sound| !**sound).count();
        let name = kind.name();
        writeln!(table, "| {name} | {STATES} | {compared} | {other} | {failed} | {seconds:.2} |")?;
        json.push(format!(
            "{{\"kind\": \"{name}\", \"states\": {STATES}, \"steps\": {STEPS}, \"compared\": {compared}, \
             \"other_bits\": {other}, \"failed\": {failed}, \"seconds\": {seconds}}}"
        ));
    }
    Ok(same)
}

/// Operations of a step: four evaluations; the sums of the step itself are few.
fn operations(kinds: &[BuiltInKind]) -> Option<f64> {
    let options = Options { language: Language::C, constants: false };
    let baked = bake(&Sources::description(kinds), options).ok()?;
    u32::try_from(4 * baked.operations.general).ok().map(f64::from)
}

/// States a second, and all cores for comparison.
fn speeds(
    device: &dyn Device,
    peak: f64,
    table: &mut String,
    json: &mut Vec<String>,
) -> Result<(), Box<dyn Error>> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    writeln!(
        table,
        "\n| DGVSCMGs | states | million steps a second | share of {peak} TFLOP/s | times {cores} cores |\n\
         |---:|---:|---:|---:|---:|"
    )?;
    for devices in DEVICES {
        let kinds = vec![BuiltInKind::Dgvscmg; devices];
        let operations = operations(&kinds);
        let states = States::random(&kinds, COUNTS[COUNTS.len() - 1]);
        let (_, _, of_cores) =
            states.run(Err(GpuError::NoDriver), &kinds, ON_CORES, TIMED_STEPS)?;
        let on_cores = rate(ON_CORES, of_cores);
        for count in COUNTS {
            let mut best = f64::INFINITY;
            for _ in 0..3 {
                best = best.min(states.run(Ok(device), &kinds, count, TIMED_STEPS)?.2);
            }
            let on_gpu = rate(count, best);
            let share = operations.map(|operations| on_gpu * operations / (peak * 1e12));
            let shown = share.map_or("-".to_owned(), |share| format!("{:.1} %", 100.0 * share));
            let ratio = on_gpu / on_cores;
            writeln!(
                table,
                "| {devices} | {count} | {:.3} | {shown} | {ratio:.1} |",
                on_gpu / 1e6
            )?;
            json.push(format!(
                "{{\"devices\": {devices}, \"states\": {count}, \"steps_per_second\": {on_gpu}, \"share_of_peak\": \
                 {}, \"cores\": {cores}, \"steps_per_second_of_cores\": {on_cores}}}",
                share.map_or("null".to_owned(), |share| share.to_string())
            ));
        }
    }
    Ok(())
}

#[expect(clippy::cast_precision_loss, reason = "counts below 2^53")]
fn rate(states: usize, seconds: f64) -> f64 {
    (states * TIMED_STEPS) as f64 / seconds
}

/// Writes the PTX of every set.
fn write_ptx(folder: &Path) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    for (name, kinds) in sets() {
        let ptx = compile(&sources(&kinds)?, Some("compute_90"))?;
        println!("{name}: {} kB", ptx.len() / 1000);
        fs::write(folder.join(format!("{name}.ptx")), ptx)?;
    }
    Ok(())
}

fn table(arguments: &Arguments) -> Result<u8, Box<dyn Error>> {
    let device = match &arguments.ptx {
        None => open(),
        Some(folder) => {
            let read = |(name, kinds): (String, Vec<BuiltInKind>)| {
                let ptx = fs::read_to_string(folder.join(format!("{name}.ptx")))?;
                Ok::<_, Box<dyn Error>>((sources(&kinds)?, ptx))
            };
            open_compiled(sets().into_iter().map(read).collect::<Result<_, _>>()?)
        }
    };
    let device = match device {
        Ok(device) => device,
        Err(reason) => {
            eprintln!("skipped: {reason}");
            return Ok(MISSING);
        }
    };
    let (mut text, mut of_bits, mut of_speeds) = (String::new(), Vec::new(), Vec::new());
    writeln!(text, "{}: {STATES} states, {STEPS} steps of RK4, f64\n", device.name())?;
    let same = bits(&*device, &mut text, &mut of_bits)?;
    speeds(&*device, arguments.peak, &mut text, &mut of_speeds)?;
    print!("{text}");
    if let Some(path) = &arguments.out {
        let json = format!(
            "{{\n \"gpu\": \"{}\",\n \"bits\": [\n  {}\n ],\n \"speeds\": [\n  {}\n ]\n}}\n",
            device.name(),
            of_bits.join(",\n  "),
            of_speeds.join(",\n  ")
        );
        fs::write(path, json)?;
    }
    Ok(u8::from(!same))
}

fn main() -> ExitCode {
    let done = arguments().map_err(Into::into).and_then(|arguments| match &arguments.write_ptx {
        Some(folder) => write_ptx(folder).map(|()| 0),
        None => table(&arguments),
    });
    match done {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
