//! The page `docs/performance-flexible.md`: what bearings, a platform and modes cost.

use std::error::Error;

use serde::Serialize;
use tera::{Context, Tera};

use crate::contender::Contender;
use crate::machine::Machine;
use crate::plan::{FLEXIBLE, Plan};
use crate::race::{Ratio, Times};
use crate::subject::Subject;
use crate::tables::{digits, of_reference, of_unit};
use crate::verdict::WAITED;

/// What the page is made of.
pub(crate) struct Page {
    pub(crate) plan: Plan,
    pub(crate) machine: Machine,
    pub(crate) contenders: Vec<Contender>,
    /// Of each contender, how far it lies from the reference.
    pub(crate) worst: Vec<(String, f64)>,
    pub(crate) times: Times,
}

/// A case: times of Precess and of the peer, with what they are compared with.
#[derive(Serialize)]
struct CaseRow {
    case: &'static str,
    ours: String,
    of_rigid: String,
    peer: String,
    of_ours: String,
}

impl Page {
    /// The file, by name.
    pub(crate) fn files(&self) -> Result<Vec<(&'static str, String)>, Box<dyn Error>> {
        let rows: Vec<_> = FLEXIBLE.into_iter().filter_map(|case| self.row(case)).collect();
        for CaseRow { case, ours, of_rigid, peer, of_ours } in &rows {
            println!("{case:44} {ours:>16} {of_rigid:>8} {peer:>16} {of_ours:>8}");
        }
        let peer = self.peer();
        let worst = self.worst.iter().map(|(_, worst)| *worst).fold(0.0, f64::max);
        let mut context = Context::new();
        context.insert("machine", &self.machine);
        context.insert("rounds", &self.plan.rounds);
        context.insert("rows", &rows);
        context.insert("note", &peer.map(|peer| &peer.note));
        context.insert("agrees", &of_reference(worst));
        let mut tera = Tera::default();
        tera.autoescape_on(Vec::<&str>::new());
        tera.add_raw_template("page", include_str!("flexible.md.tera"))?;
        Ok(vec![("performance-flexible.md", tera.render("page", &context)?)])
    }

    fn row(&self, case: &str) -> Option<CaseRow> {
        let ours = self.contenders.iter().find(|who| who.serves(Subject::Flexible.unit()))?;
        let peer = self.peer().filter(|peer| peer.takes(case));
        let ratio = |of: Option<Ratio>| of.map_or("-".to_owned(), |of| of_unit(of.value));
        let rigid = FLEXIBLE[0];
        let compared = peer.and_then(|peer| self.times.ratio((peer, case), (ours, case)));
        Some(CaseRow {
            case: title(case),
            ours: self.time(ours, case),
            of_rigid: ratio(self.times.ratio((ours, case), (ours, rigid))),
            peer: peer.map_or("-".to_owned(), |peer| self.time(peer, case)),
            of_ours: ratio(compared),
        })
    }

    fn peer(&self) -> Option<&Contender> {
        self.contenders.iter().find(|who| !who.is_ours())
    }

    /// Nanoseconds and spread; marked where its core was shared.
    fn time(&self, who: &Contender, case: &str) -> String {
        let Some(time) = self.times.of_contender(who, case) else { return "-".to_owned() };
        let waited = if time.waited < WAITED { "" } else { " †" };
        format!("{} ({:.0} %){waited}", digits(time.ns()), 100.0 * time.spread())
    }
}

fn title(case: &str) -> &'static str {
    match case {
        "bearings" => "four wheels, each on flexible bearings",
        "platform" => "four wheels on an isolated platform",
        "modes-6" => "four wheels on a structure with 6 modes",
        "modes-20" => "four wheels on a structure with 20 modes",
        "modes-200" => "four wheels on a structure with 200 modes",
        _ => "four wheels on a rigid hub",
    }
}
