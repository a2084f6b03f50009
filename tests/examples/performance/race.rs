//! Timing: contenders take short turns, round after round, so that a change of the machine meets
//! them all.

use std::path::Path;

use crate::contender::Contender;
use crate::plan::Heat;
use crate::program::Turn;

/// Time of one contender on one case, ns per evaluation or step.
#[derive(Clone, Debug)]
pub(crate) struct Time {
    /// Of those that took turns with it.
    heat: usize,
    pub(crate) name: String,
    pub(crate) case: String,
    /// Turn by turn.
    turns: Vec<f64>,
    /// The part of a turn in which it had no core, the median of the turns; 0 where that is unknown.
    pub(crate) waited: f64,
}

/// How many times longer one takes than another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ratio {
    /// The median of the ratios of their turns, round by round.
    pub(crate) value: f64,
    /// The larger one of their spreads.
    pub(crate) spread: f64,
    /// The larger one of the parts of a turn in which they had no core.
    pub(crate) waited: f64,
}

/// All times.
pub(crate) struct Times(Vec<Time>);

impl Time {
    /// The median of the turns.
    pub(crate) fn ns(&self) -> f64 {
        median(&self.turns)
    }

    /// Of the turns without the slowest tenth and the quickest tenth, the largest less the least, of
    /// the median.
    pub(crate) fn spread(&self) -> f64 {
        let mut turns = self.turns.clone();
        turns.sort_by(f64::total_cmp);
        let tenth = turns.len() / 10;
        let kept = &turns[tenth..turns.len() - tenth];
        match (kept.first(), kept.last()) {
            (Some(least), Some(largest)) => (largest - least) / self.ns(),
            _ => f64::NAN,
        }
    }
}

impl Times {
    /// The time of a contender on a case.
    pub(crate) fn of_contender(&self, contender: &Contender, case: &str) -> Option<&Time> {
        self.0.iter().find(|time| time.name == contender.name && time.case == case)
    }

    /// All of a contender.
    pub(crate) fn all_of(&self, contender: &Contender) -> impl Iterator<Item = &Time> {
        self.0.iter().filter(|time| time.name == contender.name)
    }

    /// How many times longer one takes than another, where they took turns.
    pub(crate) fn ratio(
        &self,
        (longer, its_case): (&Contender, &str),
        (shorter, case): (&Contender, &str),
    ) -> Option<Ratio> {
        let of = |contender: &Contender, case: &str, heat: usize| {
            self.all_of(contender).find(|time| time.case == case && time.heat == heat).cloned()
        };
        let heats = self.all_of(longer).map(|time| time.heat);
        let mut pairs =
            heats.filter_map(|heat| of(longer, its_case, heat).zip(of(shorter, case, heat)));
        let (longer, shorter) = pairs.next()?;
        let ratios: Vec<_> = longer.turns.iter().zip(&shorter.turns).map(|(a, b)| a / b).collect();
        Some(Ratio {
            value: median(&ratios),
            spread: longer.spread().max(shorter.spread()),
            waited: longer.waited.max(shorter.waited),
        })
    }
}

/// Times everyone: in every round each takes one turn, from first to last and in the next round from
/// last to first, so that a steady drift favours nobody.
pub(crate) fn race(heats: &[Heat<'_>], rounds: usize, folder: &Path) -> Result<Times, String> {
    let mut times = Vec::new();
    for (number, heat) in heats.iter().enumerate() {
        times.extend(turns(number, heat, rounds, folder)?);
    }
    Ok(Times(times))
}

fn turns(number: usize, heat: &Heat, rounds: usize, folder: &Path) -> Result<Vec<Time>, String> {
    let started = heat.entries.iter().map(|(who, case)| who.start(folder, case));
    let mut programs = started.collect::<Result<Vec<_>, _>>()?;
    let mut turns = vec![Vec::with_capacity(rounds); programs.len()];
    for round in 0..rounds {
        let mut order: Vec<_> = programs.iter_mut().zip(&mut turns).collect();
        if round % 2 == 1 {
            order.reverse();
        }
        for (program, turns) in order {
            turns.push(program.next()?);
        }
    }
    let timed = heat.entries.iter().zip(turns).map(|((who, case), turns)| {
        let all = |part: fn(&Turn) -> f64| turns.iter().map(part).collect::<Vec<_>>();
        let waited = median(&all(|turn| turn.waited.unwrap_or(0.0)));
        let (name, case, turns) = (who.name.clone(), case.clone(), all(|turn| turn.ns));
        let time = Time { heat: number, name, case, turns, waited };
        let (ns, spread, waited) = (time.ns(), 100.0 * time.spread(), 100.0 * time.waited);
        eprintln!(
            "{}: {} ({}), {ns:.4} ns, spread {spread:.0} %, waited {waited:.0} %",
            heat.title, time.name, time.case
        );
        time
    });
    Ok(timed.collect())
}

/// The middle one.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::Time;

    #[test]
    fn spread_leaves_out_a_tenth_at_each_end() {
        let turns = [9.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.5, 10.5, 90.0].to_vec();
        let [name, case] = [String::new(), String::new()];
        let time = Time { heat: 0, name, case, turns, waited: 0.0 };
        assert_eq!((time.ns(), time.spread()), (10.0, 0.05));
    }
}
