//! Tests of the page: what it contains, that it is complete, escaped, small and the same each time; and that its
//! script and style are built from their sources.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "counts of samples"
)]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::Report;
use crate::engine::run;
use crate::file::from_toml;
use crate::record::columns::Quantity;
use crate::record::{Columns, Drift, End, Event, Header, Outcome, Recorder, Steps, sha256};
use crate::scenario::{Projection, Requirement, Scenario, Source, Statistic};

/// Largest page of ten minutes with four double-gimbal devices at the default columns.
const PAGE_MAX: usize = 1_500_000;

/// Sources of the script and of the style.
const FRONT_END: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/report");

fn table1() -> Scenario {
    let text = include_str!("../../../scenarios/table1-printed-free.toml");
    let (mut scenario, _) = from_toml("table1", text, Path::new("")).expect("a scenario");
    scenario.settings.duration = 1.0;
    scenario
}

fn four(scenario: &Scenario) -> Scenario {
    let mut four = scenario.clone();
    four.names = (1..=4).map(|k| format!("cmg{k}")).collect();
    four.devices.0 = [scenario.devices.0[0]; 4].into();
    four.initial.devices.0 = [scenario.initial.devices.0[0]; 4].into();
    four.drives = [scenario.drives.as_slice(); 4].concat();
    four
}

fn outcome(end_time: f64) -> Outcome {
    Outcome {
        end_time,
        end: End::Finished,
        steps: Steps { accepted: 10, rejected: 2, evaluations: 120 },
        samples: 100,
        events: vec![Event { time: 0.25 * end_time, text: "cmg1.gamma_o locked".to_owned() }],
        events_omitted: 0,
        drift: Drift { energy: Some(2e-15), linear: None, angular: Some(1e-15) },
        energy_lost: 0.0,
        peak_rates: Vec::new(),
    }
}

/// A report of made-up samples: noise, but for what a replay needs.
fn sampled(scenario: &Scenario, rate: f64, spike: Option<(usize, f64)>) -> (Report, Outcome) {
    let mut scenario = scenario.clone();
    scenario.output.rate = rate;
    let header = Header::new(&scenario, &Columns::from_scenario(&scenario).expect("columns"));
    let mut report = Report::new(&scenario, &["a < b & \"c\"".to_owned()]);
    report.begin(&header).expect("begins");
    let mut seed = 1_u64;
    let mut noise = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        f64::from(u32::try_from(seed >> 40).expect("24 bits")) / f64::from(1 << 23) - 1.0
    };
    let samples = (scenario.settings.duration * rate) as usize;
    let mut row = vec![0.0; header.columns.len()];
    for k in 0..=samples {
        let time = k as f64 / rate;
        for (number, column) in row.iter_mut().zip(&header.columns) {
            *number = match column.quantity {
                Quantity::Time => time,
                Quantity::Quaternion(0) => (0.005 * time).cos(),
                Quantity::Quaternion(1) => (0.005 * time).sin() + 1e-7 * noise(),
                Quantity::Quaternion(_) => 1e-7 * noise(),
                Quantity::Rate(_) => std::f64::consts::TAU,
                Quantity::Coordinate(_) => std::f64::consts::TAU * time,
                _ => noise(),
            };
        }
        if let Some((_, value)) = spike.filter(|(at, _)| *at == k) {
            let omega = header.index("omega_y").expect("recorded");
            row[omega] = value;
        }
        report.sample(&row).expect("taken");
    }
    let outcome = outcome(samples as f64 / rate);
    report.finish(&outcome).expect("finished");
    (report, outcome)
}

fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"precess-report\">").expect("a data block");
    let (json, _) = rest.split_once("</script>").expect("its end");
    serde_json::from_str(json).expect("JSON")
}

fn requirement(limit: f64) -> Requirement {
    Requirement {
        name: "rate".to_owned(),
        quantity: "omega".to_owned(),
        projection: Projection::None,
        statistic: Statistic::Peak,
        window: [0.0, 1.0],
        limit,
        written: format!("{limit} rad/s"),
        unit: ("rad/s".to_owned(), 1.0),
    }
}

#[test]
fn a_run_of_table_1_makes_a_page_that_fetches_nothing() {
    let mut scenario = table1();
    scenario.requirements = vec![requirement(10.0)];
    let mut report = Report::new(&scenario, &[]);
    let go = &mut |_| std::ops::ControlFlow::Continue(());
    let outcome = run(&scenario, &mut report, go).expect("runs");
    let page = report.html(&outcome).expect("a page");
    let hashes: Value =
        serde_json::from_str(include_str!("../../report/dist/hashes.json")).expect("JSON");
    let script = hashes["script"].as_str().expect("a hash");
    assert!(page.contains(&format!("default-src 'none'; script-src '{script}'")), "policy");
    assert!(page.contains("The requirement is met."));
    // Addresses are names of namespaces and of the libraries' licences, in the script and the SVG.
    let markup = page.replace(include_str!("../../report/dist/report.js"), "");
    let markup = markup.replace("http://www.w3.org/2000/svg", "");
    for fetching in ["http:", "https:", " src=", "url(", "@import", "<link rel=\"stylesheet\""] {
        assert!(!markup.contains(fetching), "{fetching}");
    }
    let data = data(&page);
    assert_eq!((&data["format"], &data["name"]), (&1.into(), &"table1".into()));
    let charts = data["charts"].as_array().expect("charts");
    assert!(charts.len() > 8, "{}", charts.len());
    for chart in charts {
        let figure = format!("<figure id={}>", chart["static"]);
        assert!(page.contains(&figure), "{figure}");
    }
    let windows = data["replay"]["windows"].as_array().expect("windows");
    assert!(windows.len() == 2 && windows[1]["magnify"].as_f64() > Some(1.0));
    assert_eq!(page, report.html(&outcome).expect("a page"));
}

#[test]
fn ten_minutes_of_four_devices_fit_in_one_and_a_half_megabytes() {
    let mut scenario = four(&table1());
    scenario.settings.duration = 600.0;
    let (report, outcome) = sampled(&scenario, 50.0, None);
    let page = report.html(&outcome).expect("a page");
    assert!(page.len() < PAGE_MAX, "{} bytes", page.len());
    assert!(data(&page)["replay"]["windows"].as_array().is_some_and(|windows| windows.len() == 2));
    let figures = report.figures().expect("figures");
    let mut names: Vec<_> = figures.iter().map(|(name, _)| name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), figures.len());
    let drawn = figures.iter().map(|(_, svg)| svg.len()).sum::<usize>();
    println!("page {} bytes, {} figures of {drawn} bytes", page.len(), figures.len());
}

#[test]
fn text_of_the_user_is_escaped() {
    let mut scenario = table1();
    scenario.title = "a </script><b> & c".to_owned();
    let text = "# </script><i>\nx = '<'".to_owned();
    scenario.source =
        Source { path: "x".to_owned(), text, filled: "y = '<u>'".to_owned(), structure: None };
    let (report, outcome) = sampled(&scenario, 20.0, None);
    let page = report.html(&outcome).expect("a page");
    for raw in ["<b>&", "<i>", "<u>", "a < b", "</script><b>"] {
        assert!(!page.contains(raw), "{raw}");
    }
    assert_eq!(data(&page)["title"], "a </script><b> & c");
    assert!(page.contains("&lt;i&gt;") && page.contains("a &lt; b"));
}

#[test]
fn a_verdict_names_value_and_limit() {
    let mut scenario = table1();
    scenario.requirements = vec![requirement(0.5), requirement(2.0)];
    let (report, outcome) = sampled(&scenario, 20.0, None);
    let page = report.html(&outcome).expect("a page");
    assert!(page.contains("1 of 2 requirements is violated:"), "verdict");
    let summary = report.summary(&outcome, &["table1.csv".to_owned()]);
    assert!(summary.contains("above the limit 0.5 rad/s"), "{summary}");
    assert!(summary.lines().count() <= 10 && summary.ends_with("files: table1.csv\n"), "{summary}");
}

/// Limits on a peak are lines on both sides of zero in figure and chart over the window of the requirement; one far away is
/// named in the caption, and one on an RMS is not drawn.
#[test]
fn a_limit_is_drawn_in_the_chart_of_its_column() {
    let mut scenario = table1();
    let of = |name: &str, limit, statistic| Requirement {
        name: name.to_owned(),
        statistic,
        window: [0.25, 9.0],
        ..requirement(limit)
    };
    let far = of("far", 1000.0, Statistic::Peak);
    scenario.requirements =
        vec![of("near", 0.5, Statistic::Peak), far, of("mean", 0.5, Statistic::Rms)];
    let (report, outcome) = sampled(&scenario, 20.0, None);
    let page = report.html(&outcome).expect("a page");
    let data = data(&page);
    let charts = data["charts"].as_array().expect("charts");
    let limits = charts[0]["limits"].as_array().expect("limits");
    assert_eq!(limits.len(), 2, "{limits:?}");
    assert_eq!(limits[0]["written"], "0.5 rad/s");
    // The unit of the chart is deg/s, and the run ends at 1 s.
    let [high, low] = [0, 1].map(|k| limits[0]["values"][k].as_f64().expect("a number"));
    assert!((high - 0.5_f64.to_degrees()).abs() < 1e-9 && high == -low, "{high}");
    assert_eq!((&limits[0]["from"], &limits[0]["to"]), (&0.25.into(), &1.0.into()));
    assert!(charts[1..].iter().all(|chart| chart["limits"].is_null()));
    assert!(page.contains("Beyond the axis: limit of far, 1000 rad/s."));
    let (_, svg) = report.figures().expect("figures").swap_remove(0);
    // A piece in the legend and two lines.
    assert_eq!(svg.matches("stroke-dasharray=\"60 30 10 30\"").count(), 3);
    assert!(svg.contains(">limit of near</text>") && !svg.contains("limit of far"));
}

/// Of a bucket with several samples the legend shows the first one, which is between its ends; of one sample there is no other.
#[test]
fn a_value_at_the_cursor_is_that_of_a_sample() {
    let mut scenario = table1();
    for (duration, banded) in [(1.0, false), (600.0, true)] {
        scenario.settings.duration = duration;
        let (report, outcome) = sampled(&scenario, 50.0, None);
        let data = data(&report.html(&outcome).expect("a page"));
        let column = &data["columns"][0];
        assert_eq!((column["first"].is_string(), column["max"].is_string()), (banded, banded));
        let drawn = report.drawn();
        let curve = &drawn[0].curves[0];
        let values = curve.first.iter().zip(curve.min.iter().zip(&curve.max));
        assert!(values.clone().all(|(first, (min, max))| (min..=max).contains(&first)));
        assert_eq!(values.clone().any(|(first, (min, max))| min < first && first < max), banded);
    }
}

#[test]
fn a_run_that_failed_says_so() {
    let (report, mut outcome) = sampled(&table1(), 20.0, None);
    outcome.end = End::Cancelled;
    let page = report.html(&outcome).expect("a page");
    assert!(page.contains("Cancelled.") && page.contains("Everything up to there is valid."));
    let none = Report::new(&table1(), &[]);
    assert!(none.html(&outcome).is_ok() && none.figures().is_ok_and(|figures| figures.is_empty()));
}

#[test]
fn a_spike_of_one_sample_reaches_its_height_in_the_figure() {
    let mut scenario = table1();
    scenario.settings.duration = 600.0;
    let tops = [None, Some((12_345, 20.0))].map(|spike| {
        let (report, _) = sampled(&scenario, 50.0, spike);
        let drawn = report.drawn();
        let figure = drawn[0].figure().inline().expect("drawn");
        let curve = figure.split("<path d=\"M").last().expect("the last curve").to_owned();
        (drawn[0].curves[1].max.iter().copied().fold(0.0, f64::max), curve, figure)
    });
    let [(plain, ..), (spiked, _, figure)] = &tops;
    assert!(*plain < 60.0 && (spiked - 20.0_f64.to_degrees()).abs() < 1e-9);
    // The second curve's band in tenths of a unit: from the noise to almost the top of the frame.
    let second = figure.split("<path d=\"M").filter(|path| path.contains("fill-opacity")).nth(1);
    let numbers = second.and_then(|path| path.split('z').next()).expect("a band");
    let (start, moves) = numbers.split_once('l').expect("moves");
    let mut y: i32 = start.split_whitespace().nth(1).and_then(|y| y.parse().ok()).expect("y");
    let start = y;
    let moves = moves.replace('-', " -");
    let steps: Vec<i32> = moves.split_whitespace().map(|n| n.parse().expect("a number")).collect();
    let mut least = y;
    for step in steps.chunks(2) {
        y += step[1];
        least = least.min(y);
    }
    assert!(start - least > 1000, "from {start} to {least}");
}

#[test]
fn every_column_is_in_one_chart() {
    let scenario = four(&table1());
    let (report, _) = sampled(&scenario, 20.0, None);
    let collected = report.collected.as_ref().expect("begun");
    let mut drawn = vec![0; collected.header.columns.len() + 1];
    let curves = collected.charts.iter().flat_map(|chart| &chart.curves);
    curves.for_each(|curve| drawn[curve.column] += 1);
    for (column, count) in collected.header.columns.iter().zip(&drawn) {
        let left_out = matches!(column.quantity, Quantity::Time | Quantity::Quaternion(_));
        assert_eq!(*count, i32::from(!left_out), "{}", column.name);
    }
    assert_eq!(drawn.last(), Some(&1));
}

#[test]
fn curves_that_lie_on_one_another_are_named_below_their_figure() {
    let (report, outcome) = sampled(&four(&table1()), 10.0, None);
    let page = report.html(&outcome).expect("a page");
    let words = "Only one of these curves is seen, since they lie on one another: ";
    let (_, rest) = page.split_once(words).expect("equal rates");
    let names = rest.split_once('.').expect("an end").0;
    assert_eq!(names.split(", ").count(), 4, "{names}");
}

/// Every file below a folder of sim/report, by its path from there.
fn files_of(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(Path::new(FRONT_END).join(folder)).expect("a folder");
    let paths = entries.map(|entry| {
        let entry = entry.expect("an entry");
        let path = format!("{folder}/{}", entry.file_name().to_str().expect("text"));
        if entry.file_type().expect("a type").is_dir() { files_of(&path) } else { vec![path] }
    });
    paths.flatten().collect()
}

#[test]
fn script_and_style_are_those_of_their_sources() {
    let mut paths = files_of("src");
    paths.extend(["build.mjs", "package.json", "package-lock.json"].map(str::to_owned));
    let here: BTreeSet<_> = paths
        .iter()
        .map(|path| {
            let text = fs::read_to_string(Path::new(FRONT_END).join(path)).expect("a source");
            format!("{}  {path}", sha256(&text))
        })
        .collect();
    let list = include_str!("../../report/dist/sources.sha256");
    let built: BTreeSet<_> =
        list.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect();
    let path = |line: &String| line.split_once("  ").map(|(_, path)| path.to_owned());
    let differing: BTreeSet<_> = here.symmetric_difference(&built).filter_map(path).collect();
    assert!(
        here == built,
        "sim/report/dist was built from other sources ({differing:?}); in sim/report, run `npm ci && npm run build`, \
         and commit dist"
    );
}
