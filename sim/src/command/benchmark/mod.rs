//! `benchmark health`: records of spacecraft whose hardware changes, alarms of the watch and of baselines in them, and their scores; scores
//! of alarms of others.

mod tables;

use std::fs;
use std::path::PathBuf;
use std::thread;

use clap::{Args, Subcommand};

use super::error::CommandError;
use super::exit::Exit;
use super::options::Threads;
use super::outputs::Outputs;
use super::plot::time;
use super::progress::{interrupted, progress_bar, watch_interrupts};
use super::table::six;
use super::terminal::{note, print};
use crate::health::{
    CaseScore, Examined, Examining, HealthCase, HealthError, Method, MethodAlarm, RatePoint,
    Spacecraft, Timing, TrueChange, alarms_from_csv, examine, rates, record, score,
};
use crate::report::rate_curves;
use tables::{alarms_csv, points, rates_csv, rates_text, scores_csv, table, truth_csv};

pub(super) const HELP: &str = "\
Examples:
  precess benchmark health --out health
      records of 100 cases with their truth, alarms of precess watch and two baselines, scores; one of the bus takes three seconds of a core
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
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "2 s")]
    block: f64,
    /// How long the reference is taken, from the start.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "200 s")]
    learn: f64,
    /// After which the fault begins, within a block.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "230 s")]
    healthy: f64,
    /// Length of a record.
    #[arg(long, value_name = "TIME", value_parser = time, default_value = "300 s")]
    duration: f64,
    /// Score these alarms (CSV) of another method, and write nothing.
    #[arg(long, value_name = "ALARMS")]
    score: Option<PathBuf>,
    /// Write no telemetry, only truth, alarms and scores.
    #[arg(long)]
    no_telemetry: bool,
    #[command(flatten)]
    threads: Threads,
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
        for group in cases.chunks(self.threads.count()) {
            if interrupted() {
                break;
            }
            for (case, made) in group.iter().zip(self.side_by_side(group, with)) {
                let (telemetry, examined) = made?;
                if let Some(telemetry) = telemetry {
                    outputs.write(&[(format!("{}.csv", case.name()), telemetry)])?;
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
        }
        bar.finish_and_clear();
        Ok(found)
    }

    /// Records and examines cases, each in a thread of its own: the telemetry as CSV where it is written, and the alarms.
    fn side_by_side(
        &self,
        cases: &[HealthCase],
        with: &Examining,
    ) -> Vec<Result<(Option<String>, Examined), CommandError>> {
        let one = |case: &HealthCase| {
            let other = |error: HealthError| format!("{}: {error}", case.name());
            let recorded = record(case, self.seed, &with.timing).map_err(other)?;
            let examined = examine(case, &recorded, with).map_err(other)?;
            Ok::<_, String>(((!self.no_telemetry).then(|| recorded.csv()), examined))
        };
        let found: Vec<_> = thread::scope(|scope| {
            let running: Vec<_> = cases.iter().map(|case| scope.spawn(move || one(case))).collect();
            running.into_iter().map(thread::ScopedJoinHandle::join).collect()
        });
        let fault = || Err("a fault of the program ended a case".to_owned());
        let each = found.into_iter().map(|of| of.unwrap_or_else(|_| fault()));
        each.map(|of| of.map_err(CommandError::Other)).collect()
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
