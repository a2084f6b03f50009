//! Nine equations, affine in nine accelerations, as something that moves a state.

use super::ConsequenceError;
use super::assembled::Equations;
use super::elimination::{LinearEquation, solve};
use super::state::{INPUTS, State, cross, plus, turning};
use super::table1::{TORQUES, parameter};
use super::tape::Tape;
use precess_codegen::graph::{Expr, Graph, Stage};

/// The unknowns: acceleration of B, of the body rate, of the joints.
const UNKNOWNS: [&str; 9] = [
    "r_b_n_ddot_bx",
    "r_b_n_ddot_by",
    "r_b_n_ddot_bz",
    "omega_dot_bx",
    "omega_dot_by",
    "omega_dot_bz",
    "gamma_o_ddot",
    "gamma_i_ddot",
    "spin_dot",
];

/// The equations without what Table 1 sets to zero, a force on the system included.
pub(super) fn at_table_1<'g>(equations: &Equations<'g>) -> Equations<'g> {
    let zero = |name: &str| parameter(name) == Some(0.0) || name.starts_with("r_c_n_ddot_b");
    equations.map(|equation| {
        let graph = equation.graph();
        equation.rebuild(|symbol| zero(&graph.symbol_info(symbol).name).then(|| graph.zero()))
    })
}

/// Why a state has no slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// The state has run out of the range of numbers.
    NotFinite,
    /// The equations do not determine the accelerations.
    Singular,
}

/// The equations by their coefficients, ready to be evaluated.
pub(super) struct System {
    tape: Tape,
    slots: Vec<f64>,
}

impl System {
    /// Takes the coefficients out of the equations.
    ///
    /// # Errors
    /// When they are not affine in the unknowns, or contain what has no number.
    pub(super) fn new<'g>(
        graph: &'g Graph,
        equations: &Equations<'g>,
    ) -> Result<Self, ConsequenceError> {
        let mut roots: Vec<Expr<'g>> = Vec::new();
        let unknowns = UNKNOWNS.map(|name| graph.symbol(name, Stage::Acceleration));
        for equation in at_table_1(equations) {
            roots.extend(unknowns.map(|unknown| equation.partial(unknown)));
            roots.push(equation.without(Stage::Acceleration));
        }
        Ok(Self { tape: Tape::new(graph, &roots, &INPUTS)?, slots: Vec::new() })
    }

    /// The slope of a state.
    fn slope(&mut self, state: &State) -> Result<State, Failure> {
        let [o, i, w] = TORQUES;
        let torques = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, o, i, w];
        let mut values = self.tape.evaluate(&state.inputs(), &mut self.slots);
        let rows = torques.map(|torque| {
            let coefficients = std::array::from_fn(|_| values.next().unwrap_or(f64::NAN));
            LinearEquation { coefficients, right: torque - values.next().unwrap_or(f64::NAN) }
        });
        if !rows.iter().all(LinearEquation::is_finite) {
            return Err(Failure::NotFinite);
        }
        let [x, y, z, p, q, r, gamma_o, gamma_i, theta] = solve(rows).ok_or(Failure::Singular)?;
        let power = TORQUES.iter().zip(state.rates).map(|(torque, rate)| torque * rate);
        Ok(State {
            angles: state.rates,
            rates: [gamma_o, gamma_i, theta],
            omega: [p, q, r],
            // Components along axes that turn: r_ddot - omega x r_dot.
            velocity: plus([x, y, z], -1.0, cross(state.omega, state.velocity)),
            attitude: turning(state.attitude, state.omega),
            work: power.clone().sum(),
            throughput: power.map(f64::abs).sum(),
        })
    }

    /// The state after one classical Runge-Kutta step.
    pub(super) fn step(&mut self, state: &State, h: f64) -> Result<State, Failure> {
        let k_1 = self.slope(state)?;
        let k_2 = self.slope(&state.moved(h / 2.0, &k_1))?;
        let k_3 = self.slope(&state.moved(h / 2.0, &k_2))?;
        let k_4 = self.slope(&state.moved(h, &k_3))?;
        let outer = state.moved(h / 6.0, &k_1).moved(h / 6.0, &k_4);
        Ok(outer.moved(h / 3.0, &k_2).moved(h / 3.0, &k_3))
    }
}
