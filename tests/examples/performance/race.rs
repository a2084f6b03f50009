//! Timing: contenders take turns, round after round, so that a change of the machine meets them
//! all.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::contender::Contender;

/// What is timed how often.
pub(crate) struct Plan {
    /// Numbers of devices for everyone.
    pub(crate) counts: &'static [usize],
    /// More of them for Precess, whose curve they draw.
    pub(crate) curve: &'static [usize],
    rounds: usize,
}

impl Plan {
    /// What the page is made of.
    pub(crate) const FULL: Self =
        Self { counts: &[1, 4, 16, 64], curve: &[2, 8, 32, 128, 256], rounds: 3 };
    /// A quick look.
    pub(crate) const QUICK: Self = Self { counts: &[1, 4], curve: &[], rounds: 1 };

    /// Every number of devices, rising.
    pub(crate) fn all(&self) -> Vec<usize> {
        let mut all = [self.counts, self.curve].concat();
        all.sort_unstable();
        all
    }

    /// The numbers of devices on which all must agree.
    pub(crate) fn checked(&self) -> impl Iterator<Item = usize> {
        self.counts.iter().copied()
    }
}

/// What a contender says of its time, ns per evaluation.
#[derive(Deserialize)]
struct Said {
    /// Medians of its repeats.
    ns: Vec<f64>,
}

/// Time of one contender on one spacecraft, ns per evaluation.
#[derive(Clone, Debug)]
pub(crate) struct Time {
    /// Of the contender.
    pub(crate) name: String,
    /// Devices.
    pub(crate) count: usize,
    /// Median of all repeats.
    pub(crate) ns: f64,
    /// Least and largest of them.
    pub(crate) range: [f64; 2],
}

impl Time {
    /// Largest less least repeat, of the median.
    pub(crate) fn spread(&self) -> f64 {
        let [least, most] = self.range;
        (most - least) / self.ns
    }
}

/// Times everyone on every spacecraft.
pub(crate) fn race(
    contenders: &[Contender],
    plan: &Plan,
    folder: &Path,
) -> Result<Vec<Time>, String> {
    let mut entries = Vec::new();
    for count in plan.all() {
        let everyone = plan.counts.contains(&count);
        let takes = |contender: &&Contender| {
            contender.takes(count) && (everyone || contender.service.is_some())
        };
        entries.extend(contenders.iter().filter(takes).map(|who| (who, count, Vec::new())));
    }
    for round in 1..=plan.rounds {
        for (contender, count, repeats) in &mut entries {
            let said: Said = contender.query("time", &file(folder, *count))?;
            let ns = said.ns.iter().copied().fold(f64::INFINITY, f64::min);
            eprintln!("round {round}: {} with {count} devices, {ns:.1} ns", contender.name);
            repeats.extend(said.ns);
        }
    }
    let timed = entries.into_iter().map(|(contender, count, mut repeats)| {
        repeats.sort_by(f64::total_cmp);
        let at = |index: usize| repeats.get(index).copied();
        let (ns, least, most) = (at(repeats.len() / 2), at(0), repeats.last().copied());
        let missing = || format!("{} printed no time", contender.name);
        let (ns, least, most) =
            (ns.ok_or_else(missing)?, least.ok_or_else(missing)?, most.ok_or_else(missing)?);
        Ok(Time { name: contender.name.clone(), count, ns, range: [least, most] })
    });
    timed.collect()
}

/// The file of a spacecraft with so many devices.
pub(crate) fn file(folder: &Path, count: usize) -> PathBuf {
    folder.join(format!("{count}.json"))
}
