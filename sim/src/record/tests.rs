//! Checks of the recorders: files read back, what a killed program leaves, buckets, statistics.

use std::fs;
use std::io::Write as _;
use std::ops::ControlFlow;
use std::path::Path;

use super::partial::{Partial, partial_name};
use super::{
    Bucket, Csv, Decimate, End, Header, Npz, Outcome, Recorder, RecorderGroup, Samples, Statistics,
    Steps,
};
use crate::engine::run;
use crate::engine::tests::turning_panel;
use crate::pointing::{ExposureWeights, Index};
use crate::scenario::{Projection, Requirement, Scenario, Source, Statistic};

/// A run into recorders; all its samples.
fn recorded(scenario: &Scenario, recorder: &mut dyn Recorder) -> (Outcome, Samples) {
    let mut samples = Samples::default();
    let mut both = RecorderGroup::new(vec![&mut samples, recorder]);
    let outcome = run(scenario, &mut both, &mut |_| ControlFlow::Continue(())).expect("it runs");
    (outcome, samples)
}

/// A panel that turns at half a radian per second, with a text.
fn panel() -> Scenario {
    let mut scenario = turning_panel(0.5, 2.0);
    let text = "name = \"check\"\n[run]\nduration = 2".to_owned();
    scenario.source =
        Source { path: "check.toml".into(), text: text.clone(), filled: text, structure: None };
    scenario.output.columns = vec!["panel".to_owned(), "energy".to_owned()];
    scenario
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn header(columns: &[&str], rate: f64, duration: f64) -> Header {
    let scenario = panel();
    let all = super::Columns::all(&scenario);
    let find = |name: &&str| all.as_slice().iter().find(|column| column.name == **name).cloned();
    let mut header = Header::new(&scenario, &all);
    header.columns = columns.iter().map(|name| find(name).expect("a column")).collect();
    (header.rate, header.duration) = (rate, duration);
    header
}

fn outcome(end_time: f64) -> Outcome {
    Outcome {
        end_time,
        end: End::Finished,
        steps: Steps::default(),
        samples: 0,
        events: Vec::new(),
        events_omitted: 0,
        drift: crate::record::Drift::default(),
        energy_lost: 0.0,
        peak_rates: Vec::new(),
    }
}

/// Header and rows of a CSV file.
fn read_csv(path: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).expect("a file");
    let names = reader.headers().expect("names").iter().map(str::to_owned).collect();
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let rows = reader.records().map(|row| row.expect("a row").iter().map(number).collect());
    (names, rows.collect())
}

#[test]
fn csv_reads_back_and_says_what_it_is() {
    let folder = folder();
    let path = folder.path().join("check.csv");
    let (_, samples) = recorded(&panel(), &mut Csv::new(&path));
    let (names, rows) = read_csv(&path);
    let expected =
        ["time", "panel.phi", "panel.phi_dot", "panel.phi_ddot", "panel.u_p", "energy", "work"];
    assert_eq!(names[..7], expected);
    assert_eq!(rows, samples.rows);
    assert!(!partial_name(&path).exists());
    let text = fs::read_to_string(&path).expect("text");
    for line in [
        "# name: check",
        "# sha256 of the scenario: 8a",
        &format!("# samples: {} (finished) ", rows.len()),
        "#   panel.phi_dot [rad/s] rate of the panel",
        "#   duration = 2",
    ] {
        let line = line.trim_end_matches("8a");
        assert!(text.lines().any(|found| found.starts_with(line)), "{line}\n{text}");
    }
}

/// Threads that write one name, again and again: one has it at a time, and the file is always of one of them, whole.
#[test]
fn a_name_is_written_by_one_at_a_time() {
    const LENGTH: usize = 100_000;
    let folder = folder();
    let path = folder.path().join("a");
    let whole = || match fs::read(&path) {
        Ok(bytes) => bytes.len() == LENGTH && bytes.iter().all(|byte| Some(byte) == bytes.first()),
        Err(error) => error.kind() == std::io::ErrorKind::NotFound,
    };
    let written = std::sync::atomic::AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for id in 0_u8..4 {
            let (path, written, whole) = (&path, &written, &whole);
            scope.spawn(move || {
                for _ in 0..100 {
                    match Partial::create(path) {
                        Ok(mut partial) => {
                            partial.write_all(&vec![id; LENGTH]).expect("written");
                            partial.finish().expect("renamed");
                            written.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                        }
                        Err(error) => assert_eq!(error.kind(), std::io::ErrorKind::ResourceBusy),
                    }
                    assert!(whole(), "a mixture");
                }
            });
        }
    });
    assert!(written.into_inner() > 0 && whole());
    assert!(!partial_name(&path).exists());
}

#[test]
fn a_killed_program_leaves_every_row_that_was_flushed() {
    let folder = folder();
    let path = folder.path().join("check.csv");
    fs::write(&path, "an earlier result").expect("a file");
    let mut csv = Csv::new(&path);
    let header = header(&["time", "panel.phi"], 10.0, 1e4);
    csv.begin(&header).expect("a file");
    for i in 0..20_000 {
        csv.sample(&[f64::from(i) * 0.1, 1.0 / 3.0]).expect("a row");
    }
    // Killed: no destructor flushes what is in memory.
    std::mem::forget(csv);
    assert_eq!(fs::read_to_string(&path).expect("it stays"), "an earlier result");
    let text = fs::read_to_string(partial_name(&path)).expect("a partial file");
    let whole = text.rfind('\n').map_or(text.len(), |end| end + 1);
    let rows = text[..whole].lines().filter(|line| !line.starts_with(['#', 't'])).count();
    // All but the last 64 kB of 24 to 26 bytes a row.
    assert!(rows > 20_000 - 64 * 1024 / 20, "{rows}");
}

#[test]
fn npz_reads_back_with_the_number_of_samples_that_came() {
    let folder = folder();
    let path = folder.path().join("check.npz");
    let mut scenario = panel();
    scenario.stops = vec![crate::scenario::EndStop {
        joint: 0,
        lower: -1.0,
        upper: 0.73,
        action: crate::scenario::StopAction::End,
    }];
    let (outcome, samples) = recorded(&scenario, &mut Npz::new(&path));
    assert!(outcome.end_time < 1.5);
    let mut archive = zip::ZipArchive::new(fs::File::open(&path).expect("a file")).expect("a zip");
    let array = npyz::NpyFile::new(archive.by_name("samples.npy").expect("there"));
    let array = array.expect("an array");
    let columns = samples.rows[0].len();
    assert_eq!(array.shape(), [samples.rows.len() as u64, columns as u64]);
    let numbers: Vec<f64> = array.into_vec().expect("doubles");
    assert_eq!(numbers, samples.rows.concat());
    let mut text = |name: &str| -> Vec<String> {
        let member = archive.by_name(&format!("{name}.npy")).expect("there");
        npyz::NpyFile::new(member).expect("an array").into_vec().expect("text")
    };
    assert_eq!(text("columns")[..3], ["time", "panel.phi", "panel.phi_dot"]);
    assert_eq!(text("units")[2], "rad/s");
    assert_eq!(text("scenario"), [scenario.source.filled.as_str()]);
    assert!(text("end")[0].starts_with("ended by the end stop of panel.phi"));
    let names: Vec<_> = fs::read_dir(folder.path()).expect("a folder").collect();
    assert_eq!(names.len(), 1, "{names:?}");
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_reads_back() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;
    let folder = folder();
    let path = folder.path().join("check.parquet");
    let (_, samples) = recorded(&panel(), &mut super::Parquet::new(&path));
    let reader = SerializedFileReader::new(fs::File::open(&path).expect("a file"));
    let reader = reader.expect("a Parquet file");
    let metadata = reader.metadata().file_metadata().key_value_metadata().expect("metadata");
    let value = |key: &str| metadata.iter().find(|pair| pair.key == key)?.value.clone();
    assert_eq!(value("precess.unit.panel.phi").as_deref(), Some("rad"));
    assert_eq!(value("precess.end").as_deref(), Some("finished"));
    let rows = reader.get_row_iter(None).expect("rows");
    for (found, expected) in rows.zip(&samples.rows) {
        let found = found.expect("a row");
        let numbers: Vec<f64> =
            (0..found.len()).map(|column| found.get_double(column).expect("a double")).collect();
        assert_eq!(&numbers, expected);
    }
}

#[test]
fn buckets_keep_a_spike_and_stay_within_their_number() {
    let mut decimate = Decimate::new(100);
    let header = header(&["time", "panel.phi"], 1000.0, 1e3);
    decimate.begin(&header).expect("nothing can fail");
    for i in 0..123_457_u32 {
        let value = if i == 70_001 { 9.0 } else { f64::from(i % 7) };
        decimate.sample(&[f64::from(i) * 1e-3, value]).expect("nothing can fail");
    }
    let buckets = decimate.buckets();
    assert!((50..=100).contains(&buckets.len()), "{}", buckets.len());
    assert_eq!(decimate.samples_per_bucket(), 2048);
    let spike: Vec<_> = buckets.iter().filter(|bucket| bucket.max[1] == 9.0).collect();
    assert_eq!(spike.len(), 1);
    assert!(spike[0].start <= 70.001 && 70.001 <= spike[0].end);
    assert!(buckets.iter().all(|bucket| bucket.min[1] == 0.0));
    assert!(buckets.windows(2).all(|pair| pair[0].end < pair[1].start));
    assert_eq!(buckets[buckets.len() - 1].end, 123.456);
    // The first sample of a bucket is the one at its start.
    let at_start =
        |bucket: &Bucket| bucket.first == [bucket.start, (bucket.start * 1e3).round() % 7.0];
    assert!(buckets.iter().all(at_start));
}

#[test]
fn statistics_are_those_of_the_samples_in_the_window() {
    let requirement = |name: &str, statistic, window| Requirement {
        name: name.to_owned(),
        quantity: "omega".to_owned(),
        projection: Projection::None,
        statistic,
        window,
        limit: 0.9,
        written: "0.9 rad/s".to_owned(),
        unit: ("rad/s".to_owned(), 1.0),
    };
    let whole = [0.0, 10.0];
    let requirements = [
        requirement("peak", Statistic::Peak, whole),
        requirement("rms", Statistic::Rms, whole),
        requirement("band", Statistic::BandRms([2.0, 4.0]), whole),
        requirement("final", Statistic::Final, whole),
        requirement("drift", Statistic::Drift, [0.0, 5.0]),
        requirement("late", Statistic::Peak, [20.0, 30.0]),
    ];
    let mut statistics = Statistics::new(&requirements);
    let header = header(&["time", "omega_x", "omega_y", "omega_z"], 100.0, 30.0);
    statistics.begin(&header).expect("known quantities");
    for i in 0..=1000 {
        let time = f64::from(i) / 100.0;
        // Three hertz in two components, and a mean in the third.
        let (sin, cos) = (std::f64::consts::TAU * 3.0 * time).sin_cos();
        statistics.sample(&[time, 0.6 * sin, 0.6 * cos, 0.8]).expect("nothing can fail");
    }
    statistics.finish(&outcome(10.0)).expect("nothing can fail");
    let value = |name: &str| {
        let verdict = statistics.verdicts().iter().find(|verdict| verdict.name == name);
        verdict.expect("a verdict").value
    };
    let near = |name: &str, expected: f64, within: f64| {
        let found = value(name).expect("a value");
        assert!((found - expected).abs() < within, "{name}: {found}");
    };
    near("peak", 1.0, 1e-12);
    near("rms", 1.0, 1e-12);
    near("band", 0.6, 1e-3);
    near("final", 1.0, 1e-12);
    near("drift", 1.2, 1e-3);
    assert_eq!(value("late"), None);
    let met: Vec<bool> = statistics.verdicts().iter().map(super::Verdict::is_met).collect();
    assert_eq!(met, [false, false, true, false, false, false]);
}

#[test]
fn a_requirement_of_a_band_beyond_half_the_rate_is_rejected_with_the_remedy() {
    let requirement = Requirement {
        name: "jitter".to_owned(),
        quantity: "omega_x".to_owned(),
        projection: Projection::None,
        statistic: Statistic::BandRms([10.0, 80.0]),
        window: [0.0, 1.0],
        limit: 1.0,
        written: "1 rad/s".to_owned(),
        unit: ("rad/s".to_owned(), 1.0),
    };
    let header = header(&["time", "omega_x"], 100.0, 1.0);
    let error = Statistics::new(&[requirement]).begin(&header).expect_err("rejected");
    assert_eq!(
        error.to_string(),
        "requirement `jitter`: the band 10 Hz to 80 Hz is not within 0 Hz to 50 Hz, half the \
         sampling rate; raise output.rate"
    );
}

#[test]
fn exposures_and_indices_of_a_requirement_are_those_of_known_histories() {
    // A line of 2 at 7.3 Hz about 5, whose phases at the starts of 100 exposures of 0.1 s are evenly spread; a ramp.
    let header = header(&["time", "omega_x", "omega_y"], 1000.0, 10.0);
    let requirement = |quantity: &str, statistic| Requirement {
        name: quantity.to_owned(),
        quantity: quantity.to_owned(),
        projection: Projection::None,
        statistic,
        window: [0.0, 10.0],
        limit: 1.0,
        written: "1 rad/s".to_owned(),
        unit: ("rad/s".to_owned(), 1.0),
    };
    let index = |index, level| Statistic::Index { index, level };
    let (window, time) = (0.1, 0.1);
    let weights = ExposureWeights::new(7.3, time);
    let line = |share: f64| 2.0 * share;
    let expected = [
        ("omega_x", Statistic::Displacement(time), (25.0 + line(weights.displacement)).sqrt()),
        ("omega_x", Statistic::Smear(time), line(weights.smear).sqrt()),
        ("omega_x", Statistic::Jitter(time), line(weights.jitter).sqrt()),
        ("omega_x", index(Index::Ape, 0.5), 5.0),
        ("omega_x", index(Index::Ape, 0.75), 5.0 + 2.0_f64.sqrt()),
        ("omega_y", index(Index::Mpe { window }, 0.5), 0.2 * 4.95),
        ("omega_y", index(Index::Rpe { window }, 0.5), 0.2 * 0.025),
        ("omega_y", index(Index::Pde { window, stability: 1.0 }, 0.9973), 0.2),
    ];
    let requirements: Vec<_> =
        expected.iter().map(|(name, statistic, _)| requirement(name, *statistic)).collect();
    let mut statistics = Statistics::new(&requirements);
    statistics.begin(&header).expect("metrics");
    for i in 0..10_000 {
        let time = f64::from(i) * 1e-3;
        let line = 5.0 + 2.0 * (std::f64::consts::TAU * 7.3 * time).sin();
        statistics.sample(&[time, line, 0.2 * time]).expect("kept");
    }
    statistics.finish(&outcome(10.0)).expect("finished");
    for (verdict, (name, statistic, value)) in statistics.verdicts().iter().zip(&expected) {
        let found = verdict.value.expect("a value");
        // Sums of 100 samples for integrals, 3e-4; quantiles of 10000 samples from buckets, 1e-3; a sample of the
        // ramp's windows, 1 by 50.
        let within = if *name == "omega_y" { 0.02 } else { 1e-3 };
        assert!((found / value - 1.0).abs() < within, "{statistic:?}: {found} for {value}");
        assert_eq!(verdict.is_met(), found <= 1.0);
    }
    let long = requirement("omega_x", Statistic::Jitter(0.0015));
    let error = Statistics::new(&[long]).begin(&header).expect_err("rejected");
    assert!(error.to_string().starts_with("requirement `omega_x`: a window of 0.0015 s is 1.5"));
}
