//! Tables of the benchmark: for people, and as CSV.

use std::fmt::Write as _;

use super::super::table::{aligned, six};
use super::Found;
use crate::health::{CaseScore, Method, MethodAlarm, RatePoint, TrueChange, rates};

/// Points of each method at each bound.
pub(super) fn points(bounds: &[f64], found: &Found) -> [Vec<RatePoint>; 3] {
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

/// For people: of each case, for each method, the delays to the first alarm, to that at its place and to that of its name, the error of the
/// size, and false alarms; names and sizes only of a method that has them.
pub(super) fn table(names: &[String], scores: &[&[CaseScore]]) -> String {
    let naming: Vec<bool> =
        scores.iter().map(|of| of.iter().any(|score| score.named.is_some())).collect();
    let mut head = vec!["case".to_owned()];
    for (name, naming) in names.iter().zip(&naming) {
        head.extend([format!("{name}: first, s"), "at its place, s".to_owned()]);
        if *naming {
            head.extend(["named, s", "size, %"].map(str::to_owned));
        }
        head.push("false".to_owned());
    }
    let mut rows = vec![head];
    let count = scores.first().map_or(0, |of| of.len());
    for index in 0..count {
        let mut row = Vec::new();
        let own = scores.iter().zip(&naming);
        for (of, naming) in own.filter_map(|(of, naming)| Some((of.get(index)?, *naming))) {
            if row.is_empty() {
                row.push(of.case.clone());
            }
            row.extend([delay(of.delay), delay(of.located)]);
            if naming {
                row.extend([delay(of.named), size(of.size)]);
            }
            row.push(of.false_alarms.to_string());
        }
        rows.push(row);
    }
    aligned(&rows)
        + "delays are from the fault to the end of the block that raised the alarm; *: the interval of 95 % does not have the change\n"
}

/// An error of a size as a cell, %.
fn size(of: Option<(f64, bool)>) -> String {
    of.map_or_else(
        || "-".to_owned(),
        |(error, covered)| format!("{:+.0}{}", 100.0 * error, if covered { "" } else { "*" }),
    )
}

pub(super) fn rates_text(points: &[Vec<RatePoint>; 3]) -> String {
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

pub(super) fn rates_csv(points: &[Vec<RatePoint>; 3]) -> String {
    let mut text = "method,stated_per_hour,false_alarms_per_hour,found,located\n".to_owned();
    for (method, points) in Method::ALL.iter().zip(points) {
        for RatePoint { bound, false_alarms, found, located } in points {
            let _ = writeln!(text, "{method},{bound},{false_alarms},{found},{located}");
        }
    }
    text
}

pub(super) fn truth_csv(truths: &[TrueChange]) -> String {
    let mut text = "case,place,quantity,onset,change\n".to_owned();
    for TrueChange { case, place, quantity, onset, change } in truths {
        let change = if change.is_nan() { String::new() } else { format!("{change:e}") };
        let _ = writeln!(text, "{case},{place},{quantity},{onset},{change}");
    }
    text
}

pub(super) fn alarms_csv(found: &Found) -> String {
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

pub(super) fn scores_csv(found: &Found) -> String {
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
