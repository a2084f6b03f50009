//! Four formulations of the accelerations, each against the others: backward error, error against
//! double-double, difference in double-double.
//!
//! - solver: the emitted kernels;
//! - assembly: the paper's own equations, in the forms of the hand-checked pages;
//! - recursion: articulated bodies in spatial vectors, none of the paper's equations;
//! - Newton-Euler: laws body by body over differentiated positions, the reference of the other
//!   suites.
//!
//! The backward error is measured in the assembly's system, the error against the next formulation
//! of this list (the last against the first) in double-double. Both are asserted of the solver and
//! printed for all. The difference in double-double is asserted of every pair.
//!
//! Run with `--nocapture` to see the table.

use std::fmt::{self, Display, Formatter};
use std::sync::LazyLock;

use precess_dynamics::{Accelerations, Scalar};
use precess_tests::blocks::{Figures, errors, largest, worst};
use precess_tests::bounds::{
    ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST, BACKWARD_EPSILONS, ROUTES_IN_DOUBLE_DOUBLE,
    SPACECRAFT,
};
use precess_tests::case::{Case, Set, converted};
use precess_tests::cases;
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::newton_euler::to_list;
use precess_tests::random::{Sample, Visitor, visit};

#[derive(Clone, Copy, Debug, PartialEq)]
enum Route {
    Solver,
    Assembly,
    Recursion,
    NewtonEuler,
}

impl Route {
    const ALL: [Self; 4] = [Self::Solver, Self::Assembly, Self::Recursion, Self::NewtonEuler];

    fn accelerations<const N: usize, T: Scalar>(
        self,
        case: &Case<N, T>,
        sample: &Sample<N>,
    ) -> Accelerations<Set<N, T>> {
        match self {
            Self::Solver => case.solved(sample),
            Self::Assembly => case.assembled(),
            Self::Recursion => case.recursive(),
            Self::NewtonEuler => case.reference(),
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Solver => "solver",
            Self::Assembly => "assembly",
            Self::Recursion => "recursion",
            Self::NewtonEuler => "Newton-Euler",
        }
    }
}

/// Figures of many spacecraft, and where the worst was.
#[derive(Debug, Default)]
struct Tally {
    figures: Figures,
    worst: f64,
    at: String,
}

impl Tally {
    fn add(&mut self, figure: f64, at: impl FnOnce() -> String) {
        self.figures.add(figure);
        let figure = largest([figure]);
        if self.at.is_empty() || figure > self.worst {
            (self.worst, self.at) = (figure, at());
        }
    }
}

/// What is measured of one route.
#[derive(Debug)]
struct Measured {
    route: Route,
    /// Backward error, in epsilons.
    backward: Tally,
    /// Error, of the block, against the next formulation in double-double.
    forward: Tally,
    /// Difference in double-double, of the block, from each other formulation.
    wide: Tally,
}

/// All routes over all spacecraft: measured once, printed, then asserted by each test below.
static MEASURED: LazyLock<Table> = LazyLock::new(|| {
    let mut table = Table(Route::ALL.map(|route| Measured {
        route,
        backward: Tally::default(),
        forward: Tally::default(),
        wide: Tally::default(),
    }));
    visit(cases(SPACECRAFT), &mut table);
    println!("{table}");
    table
});

struct Table([Measured; 4]);

impl Visitor for Table {
    fn visit<const N: usize>(&mut self, sample: &Sample<N>) {
        let (narrow, wide) = (sample.case::<f64>(), sample.case::<Wide>());
        let system = wide.assembly();
        let in_wide = Route::ALL.map(|route| (route, route.accelerations(&wide, sample)));
        for (index, measured) in self.0.iter_mut().enumerate() {
            let route = measured.route;
            let found = route.accelerations(&narrow, sample);
            let list = to_list(&converted::<N, f64, Wide>(&found));
            let error = system.backward_error(&list) / f64::EPSILON;
            measured.backward.add(error, || sample.to_string());

            let (other, expected) = &in_wide[(index + 1) % in_wide.len()];
            let (error, block) = worst(errors(&found, expected));
            measured.forward.add(error, || format!("{block} against {}, {sample}", other.name()));

            let (_, own) = &in_wide[index];
            for (other, expected) in in_wide.iter().filter(|(other, _)| *other != route) {
                let (error, block) = worst(errors(own, expected));
                measured.wide.add(error, || format!("{block} against {}, {sample}", other.name()));
            }
        }
    }
}

impl Display for Table {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "| formulation | backward error worst, median (eps) | error | in double-double |"
        )?;
        writeln!(f, "|---|---|---|---|")?;
        for Measured { route, backward, forward, wide } in &self.0 {
            let [backward, forward, wide] = [backward, forward, wide].map(|row| &row.figures);
            writeln!(
                f,
                "| {} | {:.3}, {:.3} | {:.1e}, {:.1e} | {:.1e}, {:.1e} |",
                route.name(),
                backward.worst(),
                backward.median(),
                forward.worst(),
                forward.median(),
                wide.worst(),
                wide.median()
            )?;
        }
        Ok(())
    }
}

#[test]
fn solver_satisfies_the_papers_assembly() {
    let Table([solver, ..]) = &*MEASURED;
    let Tally { worst, at, .. } = &solver.backward;
    assert!(*worst <= BACKWARD_EPSILONS, "{worst} eps are above {BACKWARD_EPSILONS} ({at})");
}

#[test]
fn solver_agrees_with_the_assembly_in_higher_precision() {
    let Table([solver, ..]) = &*MEASURED;
    let Tally { worst, at, figures } = &solver.forward;
    assert!(*worst <= ACCELERATIONS_WORST, "{worst:e} is above {ACCELERATIONS_WORST:e} ({at})");
    assert!(figures.median() <= ACCELERATIONS_MEDIAN, "median {:e}", figures.median());
}

#[test]
fn all_routes_agree_in_double_double() {
    for Measured { route, wide: Tally { worst, at, .. }, .. } in &MEASURED.0 {
        assert!(
            *worst <= ROUTES_IN_DOUBLE_DOUBLE,
            "{worst:e} is above {ROUTES_IN_DOUBLE_DOUBLE:e}, {} in {at}",
            route.name()
        );
    }
}
