//! Checks of MCAP files: counts and last values read back, frames against points of bodies, bytes, the layout.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use mcap::MessageStream;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

use super::Mcap;
use super::channels::Group;
use crate::engine::run;
use crate::record::{Columns, RecorderGroup, Samples};
use crate::scenario::Scenario;

/// Two wheels and a panel on a platform, a point on a wheel; two requirements, of which one is violated.
const SCENARIO: &str = r#"
format = 1
[hub]
mass = "350 kg"
centre_of_mass = "1, -2, 30 mm"
inertia = "80, 70, 60 kg m^2"
[initial]
angular_velocity = "0.1, -0.2, 0.3 rad/s"
[[platform]]
name = "isolator"
mass = "3 kg"
inertia = "0.2, 0.2, 0.3 kg m^2"
position = "0, 0.1, 0.4 m"
[[device]]
name = "cmg"
on = "isolator"
kind = "vscmg"
mount = { spin_axis = [0, 1, 0], gimbal_axis = [0, 0, 1] }
position = "0.1, 0.2, 0.3 m"
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
gimbal = { mass = "2 kg", inertia = "20, 20, 30 g m^2", rate = "1 rad/s" }
wheel = { mass = "4 kg", inertia = "288, 150, 150 kg cm^2", rate = "300 rpm" }
[[point]]
name = "rim"
on = "cmg.wheel"
position = "0.02, 0.1, -0.05 m"
[[requirement]]
name = "fast"
quantity = "omega"
statistic = "peak"
limit = "1 mrad/s"
[[requirement]]
name = "slow"
quantity = "omega"
statistic = "peak"
limit = "900 rad/s"
[run]
duration = "0.3 s"
[output]
rate = "10 kHz"
columns = ["omega", "rim", "cmg.mount.force"]
formats = ["mcap"]
"#;
/// Rounding of a chain of ten frames, m: each turn has some 4 eps of a metre.
const ROUNDING: f64 = 1e-13;

fn scenario() -> Scenario {
    crate::file::from_toml("two", SCENARIO, Path::new("")).expect("a scenario").0
}

/// The file of a run, and its samples.
fn recorded(scenario: &Scenario) -> (Vec<u8>, Samples) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let (mut samples, mut file) = (Samples::default(), Mcap::new(&path, scenario));
    let mut both = RecorderGroup::new(vec![&mut samples, &mut file]);
    run(scenario, &mut both, &mut |_| ControlFlow::Continue(())).expect("it runs");
    (fs::read(path).expect("a file"), samples)
}

/// The messages of each topic, with their times, ns.
fn messages(bytes: &[u8]) -> BTreeMap<String, Vec<(u64, Value)>> {
    let mut topics: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for message in MessageStream::new(bytes).expect("an MCAP file") {
        let message = message.expect("a message");
        assert!(message.channel.schema.is_some() && message.channel.message_encoding == "json");
        let value = serde_json::from_slice(&message.data).expect("JSON");
        let topic = message.channel.topic.clone();
        topics.entry(topic).or_default().push((message.log_time, value));
    }
    topics
}

#[test]
fn every_column_reads_back_with_every_sample() {
    let scenario = scenario();
    let (bytes, samples) = recorded(&scenario);
    let topics = messages(&bytes);
    let header = samples.header.as_ref().expect("a run");
    let mut columns = 0;
    for group in Group::all(&header.columns) {
        let found = &topics[&group.topic];
        assert_eq!(found.len(), samples.rows.len(), "{}", group.topic);
        let schema: Value = serde_json::from_str(&group.schema().text).expect("JSON");
        for (key, about) in schema["properties"].as_object().expect("keys") {
            let column = samples.column(about["title"].as_str().expect("a name")).expect("there");
            for ((time, value), (expected, at)) in
                found.iter().zip(column.iter().zip(&samples.rows))
            {
                assert_eq!(value[key].as_f64(), Some(*expected), "{key}");
                assert!(
                    (u32::try_from(*time).map(f64::from).expect("short") * 1e-9 - at[0]).abs()
                        < 1e-9
                );
            }
            columns += 1;
        }
    }
    assert_eq!(columns, header.columns.len());
    let summary = mcap::Summary::read(&bytes).expect("a file").expect("a summary");
    let stats = summary.stats.expect("statistics");
    let count: usize = topics.values().map(Vec::len).sum();
    assert_eq!(usize::try_from(stats.message_count), Ok(count));
    assert_eq!((stats.attachment_count, stats.metadata_count), (1, 1));
}

#[test]
fn frames_place_a_point_of_a_wheel_where_its_column_does() {
    let scenario = scenario();
    let (bytes, samples) = recorded(&scenario);
    let topics = messages(&bytes);
    let frames = &topics["/scene/frames"];
    // 3001 samples: every third one, of which the last is one.
    assert_eq!(frames.len(), 1001);
    let own = Vector3::new(0.02, 0.1, -0.05);
    let mut moved = 0.0_f64;
    for (index, (_, message)) in frames.iter().enumerate() {
        let all = message["transforms"].as_array().expect("frames");
        let (mut at, mut name) = (own, "cmg.wheel");
        while name != "N" {
            let frame = all.iter().find(|of| of["child_frame_id"] == name).expect("a frame");
            let number = |of: &str, key: &str| frame[of][key].as_f64().expect("a number");
            let turn = |key| number("rotation", key);
            let turn = Quaternion::new(turn("w"), turn("x"), turn("y"), turn("z"));
            assert!((turn.norm() - 1.0).abs() < ROUNDING);
            let offset = ["x", "y", "z"].map(|key| number("translation", key));
            at = UnitQuaternion::new_unchecked(turn) * at + Vector3::from(offset);
            name = frame["parent_frame_id"].as_str().expect("a name");
        }
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            let column = samples.column(&format!("rim.position_{letter}")).expect("there");
            assert!((at[axis] - column[3 * index]).abs() < ROUNDING, "{at} at sample {index}");
            moved = moved.max((column[3 * index] - column[0]).abs());
        }
    }
    assert!(moved > 0.1, "the wheel turns: {moved} m");
    let lines = &topics["/cmg/lines"];
    assert_eq!(lines.len(), frames.len());
    let first = &lines[0].1["lines"][0];
    // 1 g cm and 20 g cm² at 300 rpm = 5 Hz.
    let square = (10.0 * std::f64::consts::PI).powi(2);
    for (key, expected) in [("frequency", 5.0), ("force", 1e-5 * square), ("moment", 2e-6 * square)]
    {
        let found = first[key].as_f64().expect("a number");
        assert!((found / expected - 1.0).abs() < 1e-9, "{key}: {found}, expected {expected}");
    }
}

#[test]
fn requirements_and_bodies_are_messages_of_foxglove() {
    let scenario = scenario();
    let (bytes, _) = recorded(&scenario);
    let topics = messages(&bytes);
    let levels: Vec<_> =
        topics["/result/log"].iter().map(|(_, log)| log["level"].as_u64()).collect();
    assert_eq!(levels, [Some(4), Some(2)]);
    let [(time, states)] = topics["/result/requirements"].as_slice() else { panic!("one message") };
    assert_eq!(*time, 300_000_000);
    let states = states["requirements"].as_array().expect("a list");
    assert_eq!([&states[0]["state"], &states[1]["state"]], ["violated", "met"]);
    assert_eq!(states[0]["unit"], "mrad/s");
    let [(_, scene)] = topics["/scene/bodies"].as_slice() else { panic!("one message") };
    let entities = scene["entities"].as_array().expect("a list");
    let named = |of: &str| entities.iter().find(|body| body["id"] == of).expect("a body");
    assert_eq!(named("B")["cubes"].as_array().map(Vec::len), Some(1));
    assert_eq!(named("isolator.platform")["cubes"].as_array().map(Vec::len), Some(1));
    assert_eq!(named("cmg.gimbal")["lines"].as_array().map(Vec::len), Some(1));
    assert_eq!(named("cmg.wheel")["cylinders"].as_array().map(Vec::len), Some(1));
    // The heavy spot.
    assert_eq!(named("cmg.wheel")["spheres"].as_array().map(Vec::len), Some(1));
}

#[test]
fn the_same_run_makes_the_same_bytes() {
    let scenario = scenario();
    assert!(recorded(&scenario).0 == recorded(&scenario).0);
}

fn of_repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

#[test]
fn keys_of_a_group_are_unique_in_every_scenario() {
    let mut seen = 0;
    for entry in fs::read_dir(of_repository("scenarios")).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|of| of != "toml") {
            continue;
        }
        let (scenario, _) = crate::file::from_file(&path, &[]).expect("a scenario");
        for group in Group::all(Columns::all(&scenario).as_slice()) {
            let schema: Value = serde_json::from_str(&group.schema().text).expect("JSON");
            let keys = schema["properties"].as_object().expect("keys").len();
            let columns = Columns::all(&scenario);
            let topic = |name: &str| format!("/{}", name.replace('.', "/"));
            let of = columns.as_slice().iter().filter(|of| topic(&of.group) == group.topic);
            assert_eq!(keys, of.count(), "{}: {}", path.display(), group.topic);
            seen += keys;
        }
    }
    assert!(seen > 1000, "{seen}");
}

/// Whatever the layout for Foxglove plots or shows, the file of the imaging satellite has.
#[test]
fn the_layout_names_topics_and_columns_of_the_imaging_satellite() {
    let text = fs::read_to_string(of_repository("scenarios/foxglove/imaging-satellite.json"));
    let layout: Value = serde_json::from_str(&text.expect("a layout")).expect("JSON");
    let path = of_repository("scenarios/imaging-satellite.toml");
    let set = ["output.formats=[\"mcap\"]", "output.rate=\"500 Hz\""].map(str::to_owned);
    let (scenario, _) = crate::file::from_file(&path, &set).expect("a scenario");
    let (bytes, _) = recorded(&scenario);
    let topics = messages(&bytes);
    let mut named = BTreeSet::new();
    texts(&layout, &mut named);
    let named: Vec<_> = named.iter().filter(|text| text.starts_with('/')).collect();
    assert!(named.len() > 5, "{named:?}");
    for of in named {
        let (topic, keys) = of.split_once('.').unwrap_or((of, ""));
        let (_, message) = topics.get(topic).and_then(|all| all.last()).expect(of);
        let mut at = message;
        for key in keys.split('.').filter(|key| !key.is_empty()) {
            let (key, slice) = key.split_once('[').unwrap_or((key, ""));
            at = &at[key];
            if !slice.is_empty() {
                at = &at[0];
            }
        }
        assert!(!at.is_null(), "{of}");
    }
}

/// All texts and keys of a document.
fn texts(of: &Value, to: &mut BTreeSet<String>) {
    match of {
        Value::String(text) => drop(to.insert(text.clone())),
        Value::Array(all) => all.iter().for_each(|of| texts(of, to)),
        Value::Object(all) => all.iter().for_each(|(key, of)| {
            to.insert(key.clone());
            texts(of, to);
        }),
        _ => {}
    }
}
