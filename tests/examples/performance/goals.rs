//! The project's goals for speed, and what was measured of each.

use precess_tests::counted::EVALUATION;

use crate::contender::Contender;
use crate::plan::LINEAR;
use crate::race::{Ratio, Time, Times};
use crate::subject::{Subject, WHEELS};
use crate::verdict::{Bound, Goal};

/// Words in the names of the peers that goals are stated for.
const DEFAULT: &str = "default build";
const BEST: &str = "best build";
const CASADI: &str = "casadi";

/// One state with four devices, by services that give the same bits: how many times faster than
/// default build, best build and generated C.
const ONE_STATE: [(&str, &str, [f64; 3]); 2] =
    [("dispatched", "dispatched", [12.0, 8.0, 4.0]), ("portable", "portable", [9.0, 6.0, 3.0])];

/// More devices: times faster than Pinocchio's best build.
const MORE_DEVICES: [(usize, f64); 2] = [(16, 17.0), (64, 22.0)];

/// A batch, per state with four devices: share of the issue floor, times faster than Pinocchio's best
/// build, and how many times longer it may take with parameters per lane.
const BATCH: (f64, f64, f64) = (0.65, 26.0, 1.12);

/// Largest cost per device against the least.
const LINEAR_WITHIN: f64 = 1.15;

/// A step of three reaction wheels, times faster than Basilisk's: service or C library.
const STEP: [(&str, &str, f64); 3] = [
    ("step", "typed", 30.0),
    ("step-list", "list of any kinds", 25.0),
    ("c library", "C library", 25.0),
];

/// What goals are computed from.
pub(crate) struct Measured<'a> {
    pub(crate) contenders: &'a [Contender],
    pub(crate) times: &'a Times,
}

impl<'a> Measured<'a> {
    /// All goals.
    pub(crate) fn goals(&self) -> Vec<Goal> {
        let groups = [
            self.one_state(),
            self.more_devices(),
            self.batch(),
            vec![self.linear()],
            self.steps(),
        ];
        groups.into_iter().flatten().collect()
    }

    fn one_state(&self) -> Vec<Goal> {
        let mut rows = Vec::new();
        for (name, title, goals) in ONE_STATE {
            for (peer, goal) in [DEFAULT, BEST, CASADI].into_iter().zip(goals) {
                let what = format!("one state, {title}, N = 4, against {}", titled(peer));
                rows.push(Goal::new(what, Bound::Times, goal, self.faster(name, peer, 4)));
            }
        }
        rows
    }

    fn more_devices(&self) -> Vec<Goal> {
        let row = |(count, times)| {
            let what = format!("one state, dispatched, N = {count}, against {}", titled(BEST));
            Goal::new(what, Bound::Times, times, self.faster("dispatched", BEST, count))
        };
        MORE_DEVICES.into_iter().map(row).collect()
    }

    fn batch(&self) -> Vec<Goal> {
        let (share, times, slower) = BATCH;
        let of = |against: &str| format!("batch, per state, N = 4, {against}");
        let parameters = self.service("parameters").zip(self.service("batch"));
        let parameters =
            parameters.and_then(|(own, same)| self.times.ratio((own, "4"), (same, "4")));
        vec![
            Goal::new(of("of the issue floor"), Bound::Share, share, self.share("batch", 4)),
            Goal::new(
                of("against Pinocchio, best build"),
                Bound::Times,
                times,
                self.faster("batch", BEST, 4),
            ),
            Goal::new(
                of("time with parameters per lane to that without"),
                Bound::AtMost,
                slower,
                parameters,
            ),
        ]
    }

    fn steps(&self) -> Vec<Goal> {
        let (case, wheels) = WHEELS;
        let peer =
            self.contenders.iter().find(|who| who.subject == Subject::Step && !who.is_ours());
        let row = |(name, title, goal)| {
            let step = |who: &&Contender| who.subject == Subject::Step;
            let mut own = self.contenders.iter().filter(step);
            let own = own.find(|who| who.serves(name) || who.name.to_lowercase().ends_with(name));
            let found = peer.zip(own);
            let found = found.and_then(|(peer, own)| self.times.ratio((peer, case), (own, case)));
            let what = format!("RK4 step, {wheels}, {title}, against Basilisk");
            Goal::new(what, Bound::Times, goal, found)
        };
        STEP.into_iter().map(row).collect()
    }

    /// The largest cost per device against the least.
    #[expect(clippy::cast_precision_loss, reason = "devices are few")]
    fn linear(&self) -> Goal {
        let one = self.service("dispatched");
        let time = |count: &usize| {
            // They took turns with each other last.
            let case = count.to_string();
            let own = self.times.all_of(one?).filter(|time| time.case == case).last()?;
            Some([own.ns() / *count as f64, own.spread(), own.waited])
        };
        let costs: Option<Vec<_>> = LINEAR.iter().map(time).collect();
        let found = costs.map(|costs| {
            let of = |part: usize| costs.iter().map(move |cost| cost[part]);
            let [most, spread, waited] = [0, 1, 2].map(|part| of(part).fold(f64::MIN, f64::max));
            Ratio { value: most / of(0).fold(f64::MAX, f64::min), spread, waited }
        });
        let what = "one state, dispatched, cost per device, N = 16 to 256, largest to least";
        Goal::new(what.to_owned(), Bound::AtMost, LINEAR_WITHIN, found)
    }

    /// How many times faster a service is than a peer.
    fn faster(&self, service: &str, peer: &str, count: usize) -> Option<Ratio> {
        let case = count.to_string();
        self.times.ratio((named(self.contenders, peer)?, &case), (self.service(service)?, &case))
    }

    /// What a service reaches of its issue floor, at the operations of an evaluation.
    pub(crate) fn share(&self, service: &str, count: usize) -> Option<Ratio> {
        let (service, case) = (self.service(service)?, count.to_string());
        let floor = self.floor(service)?;
        let found = self.times.ratio((floor, &case), (service, &case))?;
        Some(Ratio { value: found.value * operations(count), ..found })
    }

    /// The row of the issue floor that bounds a service, as it was timed in turns with it.
    fn floor(&self, service: &Contender) -> Option<&'a Contender> {
        let row = service.service.as_ref()?.floor.as_ref()?;
        self.contenders.iter().find(|who| who.subject == Subject::Floor && who.name == *row)
    }

    /// A service by its name.
    pub(crate) fn service(&self, name: &str) -> Option<&'a Contender> {
        self.contenders.iter().find(|contender| contender.serves(name))
    }

    /// Time of a state of four devices at the issue floor of a batch, ns; the goal of a batch from the
    /// time of Pinocchio's best build, ns; and how many times faster than that it is.
    pub(crate) fn batch_limits(&self) -> (Option<f64>, Option<f64>, f64) {
        let ns = |who: &Contender| self.times.of_contender(who, "4").map(Time::ns);
        let floor = self.service("batch").and_then(|batch| self.floor(batch)).and_then(ns);
        let best = named(self.contenders, BEST).and_then(ns);
        let times = BATCH.1;
        (floor.map(|ns| ns * operations(4)), best.map(|ns| ns / times), times)
    }
}

/// Operations of an evaluation with so many DGVSCMGs, as the tests `dynamics/operations.rs` assert them.
#[expect(clippy::cast_precision_loss, reason = "thousands")]
pub(crate) fn operations(count: usize) -> f64 {
    let [hub, device] = EVALUATION.map(|number| number as f64);
    hub + device * count as f64
}

/// A peer of evaluations by what its name has in it.
fn named<'a>(contenders: &'a [Contender], part: &str) -> Option<&'a Contender> {
    let peer = |who: &&Contender| who.subject == Subject::Evaluation && !who.is_ours();
    contenders.iter().filter(peer).find(|who| who.name.to_lowercase().contains(part))
}

/// A peer as the goals call it.
fn titled(part: &str) -> String {
    match part {
        CASADI => "C generated by CasADi".to_owned(),
        build => format!("Pinocchio, {build}"),
    }
}
