//! The tables of a Monte Carlo campaign as CSV, in SI.

use std::fmt::Write as _;

use super::{ComplianceCount, Correlations, LEVEL, PERCENTILES, Planes, meets, sorted};
use crate::campaign::{Derivative, Finished, digits, percentile};
use crate::command::campaign::{Prepared, shown};

fn cell(value: f64) -> String {
    if value.is_finite() { digits(value) } else { String::new() }
}

/// In SI; an end that the sample is too small for is empty.
pub(super) fn percentiles_csv(prepared: &Prepared, finished: &Finished) -> String {
    let mut text = String::from("number,percentile,value_si,lower_si,upper_si\n");
    for (name, field, _, limit) in shown(prepared) {
        let sorted = sorted(finished, field);
        for share in PERCENTILES {
            let Some(found) = percentile(&sorted, share, LEVEL) else { continue };
            let [lower, upper] = found.interval.map(cell);
            let _ = writeln!(
                text,
                "{},{},{},{lower},{upper}",
                quoted(&name),
                100.0 * share,
                cell(found.value)
            );
        }
        let found = limit.and_then(|limit| meets(finished, field, limit));
        if let Some(ComplianceCount { probability: found, .. }) = found {
            let [lower, upper] = found.interval.map(cell);
            let _ = writeln!(
                text,
                "{},probability of meeting,{},{lower},{upper}",
                quoted(&name),
                cell(found.value)
            );
        }
    }
    text
}

pub(super) fn correlations_csv(of: &Correlations) -> String {
    let mut text = String::from("number,key,rank_correlation,samples,p_value\n");
    for (name, by) in of {
        for (key, found) in by {
            let value = found.map_or_else(String::new, |of| cell(of.value));
            let pairs = found.map_or_else(String::new, |of| of.pairs.to_string());
            let chance = found.and_then(|of| of.by_chance).map_or_else(String::new, cell);
            let _ = writeln!(text, "{},{},{value},{pairs},{chance}", quoted(name), quoted(key));
        }
    }
    text
}

pub(super) fn derivatives_csv(of: &[(String, Vec<Derivative>)], planes: &Planes) -> String {
    let mut text = String::from(
        "number,key,derivative_si_by_key_unit,times_deviation_si,method,sample_slope,sample_slope_error\n",
    );
    for ((name, by), plane) in of.iter().zip(planes) {
        for one in by {
            let (slope, size) = (cell(one.slope), cell(one.size()));
            let method = if one.exact { "exact" } else { "difference" };
            let known = plane.iter().flatten().find(|(label, _)| *label == one.label);
            let [sample, error] = known.map_or([f64::NAN; 2], |(_, found)| *found).map(cell);
            let _ = writeln!(
                text,
                "{},{},{slope},{size},{method},{sample},{error}",
                quoted(name),
                quoted(&one.label)
            );
        }
    }
    text
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
