//! `benchmark health`: records of spacecraft whose hardware changes, alarms of the watch and of baselines in them, and their scores; scores
//! of alarms of others.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::error::CommandError;
use super::exit::Exit;
use super::outputs::Outputs;
use super::plot::time;
use super::progress::{interrupted, progress_bar, watch_interrupts};
use super::table::{aligned, six};
use super::terminal::{note, print};
use crate::health::{
    CaseScore, Examining, HealthCase, Method, MethodAlarm, RatePoint, Spacecraft, Timing,
    TrueChange, alarms_from_csv, examine, rates, record, score,
};
use crate::report::rate_curves;

pub(super) const HELP: &str = "\
Examples:
  precess benchmark health --out health
      records of 100 cases with their truth, alarms of precess watch and two baselines, scores: an hour or so
  precess benchmark health --case bus-open-drag-medium --case bus-open-nominal --out health
  precess benchmark health --score alarms.csv
      scores of another method: columns case, time, place, quantity, and change, half_width if it has them (docs/health.md)";

/// Bounds of curves, false alarms an hour.
const BOUNDS: [f64; 7] = [0.01, 0.1, 1.0, 10.0, 30.0, 100.0, 300.0];

/// What is measured.
#[derive(Debug, Subcommand)]
pub(super) enum Benchmark {
    /// Write telemetry of spacecraft whose hardware changes, and score what precess watch, two baselines or others find in it
    #[command(after_help = HELP)]
    Health(HealthCommand),
}

impl Benchmark {
    pub(super) fn execute(&self) -> Result<Exit, CommandError> {
        let Self::Health(health) = self;
        health.execute()
    }
}

/// The options of `benchmark health`.
#[derive(Debug, Args)]
pub(super) struct HealthCommand {
    /// A case; may be repeated. All 100 without it.
    #[arg(long, value_name = "NAME")]
    case: Vec<String>,
    /// Of everything that is drawn: noise, onsets, which device.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u32,
    /// False alarms an hour, of all tests of a method together, of the table.
    #[arg(long, value_name = "NUMBER", default_value_t = 1.0)]
    false_alarms: f64,
    /// Length of a block, with its unit.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "5 s")]
    block: f64,
    /// How long the reference is taken, from the start.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "100 s")]
    learn: f64,
    /// After which the fault begins, within a block.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "130 s")]
    healthy: f64,
    /// Length of a record.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "200 s")]
    duration: f64,
    /// Score these alarms (CSV) of another method, and write nothing.
    #[arg(long, value_name = "ALARMS")]
    score: Option<PathBuf>,
    /// Write no telemetry, only truth, alarms and scores.
    #[arg(long)]
    no_telemetry: bool,
    /// Folder for the files; made if it is missing.
    #[arg(long, value_name = "FOLDER", default_value = "precess-out")]
    out: PathBuf,
    /// Replace files that are there.
    #[arg(long)]
    force: bool,
}

/// What was found: of each case, for each method, the score at each bound; the first bound is that of the table.
struct Found {
    truths: Vec<TrueChange>,
    alarms: Vec<Vec<MethodAlarm>>,
    /// By bound, then method, then case.
    scores: Vec<[Vec<CaseScore>; 3]>,
}

impl HealthCommand {
    fn execute(&self) -> Result<Exit, CommandError> {
        let timing = Timing {
            block: self.block,
            learn: self.learn,
            healthy: self.healthy,
            duration: self.duration,
        };
        let ordered = timing.block > 0.0
            && timing.learn >= 3.0 * timing.block
            && timing.learn <= timing.healthy
            && timing.healthy + timing.block < timing.duration;
        if !ordered {
            return Err(CommandError::Other(
                "a record has three blocks of reference at least, and --learn, --healthy with a block more, --duration in this order"
                    .to_owned(),
            ));
        }
        let cases = self.cases()?;
        if let Some(path) = &self.score {
            return self.score_others(path, &cases, &timing);
        }
        let mut names: Vec<String> =
            ["truth.csv", "alarms.csv", "scores.csv", "rates.csv", "rates.svg"]
                .map(|ending| format!("health-{ending}"))
                .to_vec();
        let spacecraft = [(Spacecraft::Bus, "bus.toml"), (Spacecraft::Pyramid, "pyramid.toml")];
        names.extend(spacecraft.map(|(_, name)| name.to_owned()));
        if !self.no_telemetry {
            names.extend(cases.iter().map(|case| format!("{}.csv", case.name())));
        }
        let mut outputs = Outputs::reserve(&self.out, &names, self.force)?;
        watch_interrupts();
        let mut bounds = vec![self.false_alarms];
        bounds.extend(BOUNDS);
        let found = self.examined(
            &cases,
            &Examining { timing, false_alarms: bounds.clone() },
            &mut outputs,
        )?;
        let points = points(&bounds, &found);
        let mut files = vec![
            ("health-truth.csv".to_owned(), truth_csv(&found.truths)),
            ("health-alarms.csv".to_owned(), alarms_csv(&found)),
            ("health-scores.csv".to_owned(), scores_csv(&found)),
            ("health-rates.csv".to_owned(), rates_csv(&points)),
        ];
        let curves = Method::ALL.iter().zip(&points).map(|(method, points)| {
            let of = |point: &RatePoint| [point.false_alarms, point.found];
            (method.to_string(), points.iter().skip(1).map(of).collect())
        });
        let picture = rate_curves(curves.collect());
        files.push((
            "health-rates.svg".to_owned(),
            picture.map_err(|error| CommandError::Other(error.to_string()))?,
        ));
        files.extend(spacecraft.map(|(of, name)| (name.to_owned(), of.watched_text().to_owned())));
        outputs.write(&files)?;
        let first = found.scores.first();
        let tables = first.map(|of| of.each_ref().map(Vec::as_slice)).unwrap_or_default();
        print(&table(&Method::ALL.map(|of| of.to_string()), &tables))?;
        print(&rates_text(&points))?;
        print(&format!("files: {} in {}\n", names.len(), self.out.display()))?;
        if found.truths.len() < cases.len() {
            note(&format!(
                "warning: interrupted: {} of {} cases are in these files",
                found.truths.len(),
                cases.len()
            ));
            return Ok(Exit::Violated);
        }
        Ok(Exit::Success)
    }

    /// The cases that are named.
    fn cases(&self) -> Result<Vec<HealthCase>, CommandError> {
        let all = HealthCase::all();
        if self.case.is_empty() {
            return Ok(all);
        }
        let names: Vec<String> = all.iter().map(HealthCase::name).collect();
        let of = |name: &String| {
            let found = names.iter().position(|of| of == name).and_then(|index| all.get(index));
            found.copied().ok_or_else(|| {
                let like = crate::nearest::nearest(name, names.iter());
                let like =
                    if like.is_empty() { "bus-open-nominal".to_owned() } else { like.join(", ") };
                CommandError::Other(format!("no case `{name}`; there is {like}"))
            })
        };
        self.case.iter().map(of).collect()
    }

    /// Records, examines and scores cases, until an interrupt; telemetry is written as it comes.
    fn examined(
        &self,
        cases: &[HealthCase],
        with: &Examining,
        outputs: &mut Outputs,
    ) -> Result<Found, CommandError> {
        let bar = progress_bar(cases.len(), "cases");
        let mut found = Found {
            truths: Vec::new(),
            alarms: Vec::new(),
            scores: with.false_alarms.iter().map(|_| Default::default()).collect(),
        };
        for case in cases {
            if interrupted() {
                break;
            }
            let other = |error: crate::health::HealthError| {
                CommandError::Other(format!("{}: {error}", case.name()))
            };
            let recorded = record(case, self.seed, &with.timing).map_err(other)?;
            let examined = examine(case, &recorded, with).map_err(other)?;
            if !self.no_telemetry {
                outputs.write(&[(format!("{}.csv", case.name()), recorded.csv())])?;
            }
            let truth = case.truth(self.seed, &with.timing);
            for (scores, alarms) in found.scores.iter_mut().zip(&examined.alarms) {
                for (scores, method) in scores.iter_mut().zip(Method::ALL) {
                    let own = alarms.iter().filter(|alarm| alarm.method == method);
                    scores.push(score(&truth, own, &with.timing));
                }
            }
            found.truths.push(truth);
            found.alarms.extend(examined.alarms.into_iter().next());
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(found)
    }

    /// Scores alarms of another method.
    fn score_others(
        &self,
        path: &PathBuf,
        cases: &[HealthCase],
        timing: &Timing,
    ) -> Result<Exit, CommandError> {
        let io = |source| CommandError::Io { path: path.clone(), source };
        let text = fs::read_to_string(path).map_err(io)?;
        let alarms = alarms_from_csv(&text)
            .map_err(|error| CommandError::Other(format!("{}: {error}", path.display())))?;
        let names: Vec<String> = cases.iter().map(HealthCase::name).collect();
        if let Some((unknown, _)) = alarms.iter().find(|(case, _)| !names.contains(case)) {
            return Err(CommandError::Other(format!(
                "no case `{unknown}` among those that are scored"
            )));
        }
        let scores: Vec<CaseScore> = cases
            .iter()
            .map(|case| {
                let truth = case.truth(self.seed, timing);
                let own = alarms.iter().filter(|(name, _)| *name == truth.case);
                score(&truth, own.map(|(_, alarm)| alarm), timing)
            })
            .collect();
        print(&table(&["alarms".to_owned()], &[&scores]))?;
        let point = rates(f64::NAN, &scores);
        print(&format!(
            "{} false alarms an hour; {} % of the faults found within 30 s, {} % at their place\n",
            six(point.false_alarms),
            six(100.0 * point.found),
            six(100.0 * point.located)
        ))?;
        Ok(Exit::Success)
    }
}

/// Points of each method at each bound.
fn points(bounds: &[f64], found: &Found) -> [Vec<RatePoint>; 3] {
    let mut points: [Vec<RatePoint>; 3] = Default::default();
    for (bound, scores) in bounds.iter().zip(&found.scores) {
        for (points, scores) in points.iter_mut().zip(scores) {
            points.push(rates(*bound, scores));
        }
    }
    points
}

/// A delay as a cell.
fn delay(of: Option<f64>) -> String {
    of.map_or_else(|| "-".to_owned(), |delay| format!("{delay:.1}"))
}

/// For people: of each case the delays to the first alarm, to that of the right name, its error, and false alarms, of each method.
fn table(names: &[String], scores: &[&[CaseScore]]) -> String {
    let mut head = vec!["case".to_owned()];
    for name in names {
        let of = |what: &str| format!("{name}: {what}");
        head.extend([of("first, s"), "at its place, s".to_owned(), "named, s".to_owned()]);
        head.extend(["size, %".to_owned(), "false".to_owned()]);
    }
    let mut rows = vec![head];
    let count = scores.first().map_or(0, |of| of.len());
    for index in 0..count {
        let mut row = Vec::new();
        for of in scores.iter().filter_map(|of| of.get(index)) {
            if row.is_empty() {
                row.push(of.case.clone());
            }
            row.extend([delay(of.delay), delay(of.located), delay(of.named)]);
            row.push(of.size.map_or_else(
                || "-".to_owned(),
                |(error, covered)| {
                    format!("{:+.0}{}", 100.0 * error, if covered { "" } else { "*" })
                },
            ));
            row.push(of.false_alarms.to_string());
        }
        rows.push(row);
    }
    aligned(&rows)
        + "delays are from the fault to the end of the block that raised the alarm; *: the interval of 95 % does not have the change\n"
}

fn rates_text(points: &[Vec<RatePoint>; 3]) -> String {
    let mut rows = vec![
        [
            "method",
            "false alarms an hour: stated",
            "found",
            "faults within 30 s, %",
            "at their place, %",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    for (method, points) in Method::ALL.iter().zip(points) {
        rows.extend(points.iter().map(|point| {
            vec![
                method.to_string(),
                six(point.bound),
                six(point.false_alarms),
                format!("{:.1}", 100.0 * point.found),
                format!("{:.1}", 100.0 * point.located),
            ]
        }));
    }
    aligned(&rows)
}

fn rates_csv(points: &[Vec<RatePoint>; 3]) -> String {
    let mut text = "method,stated_per_hour,false_alarms_per_hour,found,located\n".to_owned();
    for (method, points) in Method::ALL.iter().zip(points) {
        for RatePoint { bound, false_alarms, found, located } in points {
            let _ = writeln!(text, "{method},{bound},{false_alarms},{found},{located}");
        }
    }
    text
}

fn truth_csv(truths: &[TrueChange]) -> String {
    let mut text = "case,place,quantity,onset,change\n".to_owned();
    for TrueChange { case, place, quantity, onset, change } in truths {
        let change = if change.is_nan() { String::new() } else { format!("{change:e}") };
        let _ = writeln!(text, "{case},{place},{quantity},{onset},{change}");
    }
    text
}

fn alarms_csv(found: &Found) -> String {
    let mut text = "method,case,time,place,quantity,change,half_width\n".to_owned();
    for (truth, alarms) in found.truths.iter().zip(&found.alarms) {
        for MethodAlarm { method, time, name, place, change } in alarms {
            let change = change
                .map_or_else(|| ",".to_owned(), |[change, half]| format!("{change:e},{half:e}"));
            let _ = writeln!(text, "{method},{},{time},{place},{name},{change}", truth.case);
        }
    }
    text
}

fn scores_csv(found: &Found) -> String {
    let mut text =
        "method,case,false_alarms,healthy_s,delay_s,located_s,named_s,size_error,covered,misnamed\n"
            .to_owned();
    let cell = |of: Option<f64>| of.map_or_else(String::new, |value| value.to_string());
    for (method, scores) in found.scores.first().iter().flat_map(|of| Method::ALL.iter().zip(*of)) {
        for of in scores {
            let covered = of.size.map_or("", |(_, covered)| if covered { "yes" } else { "no" });
            let _ = writeln!(
                text,
                "{method},{},{},{},{},{},{},{},{covered},{}",
                of.case,
                of.false_alarms,
                of.healthy,
                cell(of.delay),
                cell(of.located),
                cell(of.named),
                cell(of.size.map(|(error, _)| error)),
                of.misnamed
            );
        }
    }
    text
}
