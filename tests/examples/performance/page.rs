//! The page: `docs/performance.md` with its drawing, and the tables on the terminal.

use std::error::Error;

use tera::{Context, Tera};

use crate::breakdown::{Parts, limits, shares};
use crate::chart::chart;
use crate::contender::{Contender, Missing};
use crate::goals::Measured;
use crate::machine::Machine;
use crate::plan::Plan;
use crate::race::Times;
use crate::tables::{Table, TableRow, Tables};
use crate::tried::TRIED;

/// What the page is made of.
pub(crate) struct Page {
    pub(crate) plan: Plan,
    pub(crate) machine: Machine,
    pub(crate) contenders: Vec<Contender>,
    pub(crate) missing: Vec<Missing>,
    /// Of each contender, how far it lies from the reference.
    pub(crate) worst: Vec<(String, f64)>,
    pub(crate) times: Times,
    pub(crate) parts: Vec<Parts>,
}

impl Page {
    /// The tables, on the terminal.
    pub(crate) fn show(&self) {
        let measured = self.measured();
        let tables = self.tables(&measured);
        for (title, Table { heading, rows }) in [
            ("ns per evaluation (times dispatched, spread)", tables.services()),
            ("ns per RK4 step (times typed, spread)", tables.steps()),
            ("ns per state (times batch, spread)", tables.batches()),
            ("imaging satellite (times general, spread)", tables.baked()),
        ] {
            println!();
            line(title, &heading);
            for TableRow { name, cells, .. } in &rows {
                line(name, cells);
            }
        }
        println!();
        for goal in measured.goals() {
            println!("{goal}");
        }
    }

    /// The files, by name.
    pub(crate) fn files(&self) -> Result<Vec<(&'static str, String)>, Box<dyn Error>> {
        let measured = self.measured();
        let tables = self.tables(&measured);
        let notes = self.contenders.iter().map(|who| [&who.name, &who.note]);
        let notes: Vec<_> = notes.filter(|[_, note]| !note.is_empty()).collect();
        let services = || self.contenders.iter().filter_map(|who| who.service.as_ref());
        let mut context = Context::new();
        context.insert("threads", &services().any(|service| service.threads > 1));
        context.insert("machine", &self.machine);
        context.insert("rounds", &self.plan.rounds);
        context.insert("counts", &self.plan.counts);
        context.insert("services", &tables.services());
        context.insert("steps", &tables.steps());
        context.insert("batches", &tables.batches());
        context.insert("baked", &tables.baked());
        context.insert("notes", &notes);
        context.insert("missing", &self.missing);
        context.insert("goals", &measured.goals());
        context.insert("shares", &shares(&self.parts, &tables, &self.machine));
        context.insert("reached", &tables.reached());
        context.insert("limits", &limits(&self.parts, &tables));
        context.insert("tried", TRIED);
        let mut tera = Tera::default();
        tera.autoescape_on(Vec::<&str>::new());
        tera.add_raw_template("page", include_str!("performance.md.tera"))?;
        let text = tera.render("page", &context)?;
        let drawing = chart(&self.contenders, &self.times)?;
        Ok(vec![("performance.md", text), ("performance.svg", drawing)])
    }

    fn measured(&self) -> Measured<'_> {
        Measured { contenders: &self.contenders, times: &self.times }
    }

    fn tables<'a>(&'a self, measured: &'a Measured<'a>) -> Tables<'a> {
        Tables { measured, plan: &self.plan, worst: &self.worst }
    }
}

fn line(name: &str, cells: &[String]) {
    print!("{name:52}");
    for cell in cells {
        print!("{cell:>24}");
    }
    println!();
}
