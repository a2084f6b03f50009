//! The system against Boltzmann and Hamel's equations, from the kinetic energy alone: what fixes the
//! place and the sign of every block.

use super::Row;
use super::factors::Unknowns;
use crate::derivation::boltzmann_hamel::{BoltzmannHamel, boltzmann_hamel};
use crate::derivation::by_body;
use crate::derivation::chain::Chain;
use crate::graph::Expr;
use crate::normal::Ring;

/// What the blocks are held against, derived once.
pub(super) struct Laws<'g>(BoltzmannHamel<'g>);

impl<'g> Laws<'g> {
    /// The laws of a chain.
    pub(super) fn of(chain: &Chain<'g>) -> Self {
        Self(boltzmann_hamel(chain))
    }

    /// `M_xy = d^2 T / dx dy`; `M x'' + rest` is each of Boltzmann and Hamel's equations, and the
    /// power that goes into the kinetic energy. `who` states the blocks that `named` finds.
    pub(super) fn rows(
        &self,
        ring: &mut Ring<'g>,
        unknowns: &Unknowns<'g>,
        who: &str,
        named: impl Fn(&str) -> Option<Expr<'g>>,
    ) -> Vec<Row> {
        let Self(laws) = self;
        let assembled = |x: usize, y: usize| unknowns.assembled(x.min(y), x.max(y), &named);
        let mut matrix = Vec::new();
        let mut hessian = Vec::new();
        for (x, row) in laws.mass.iter().enumerate() {
            for (y, entry) in (x..).zip(row) {
                matrix.push((format!("{x}{y}"), assembled(x, y)));
                hessian.push((format!("{x}{y}"), *entry));
            }
        }
        let equation = |x: usize| {
            let terms = unknowns.accelerations.iter().enumerate();
            terms.fold(unknowns.rest(x, &named), |sum, (y, acceleration)| {
                sum + assembled(x, y) * *acceleration
            })
        };
        let equations: Vec<Expr<'g>> = (0..unknowns.len()).map(equation).collect();
        let products = equations.iter().zip(&unknowns.speeds).map(|(e, speed)| *e * *speed);
        let power = products.reduce(|sum, product| sum + product);

        let mut rows = Vec::new();
        let mut row = |tag: &str, name: &str, law: &str, checked: &[_], expected: &[_]| {
            let claim = format!("{who} = {law}");
            rows.push(Row::compare(ring, [tag, name, &claim], checked, expected));
        };
        row("(M_ij)", "M", "d²T/dx dy", &matrix, &hessian);
        let law = "Boltzmann-Hamel";
        for (tag, name, range) in unknowns.equations() {
            let (checked, expected) = (&equations[range.clone()], &laws.equations[range]);
            row(tag, name, law, &labelled(checked), &labelled(expected));
        }
        let rate = laws.energy.time_derivative();
        row("(power)", "v·(M v′ + h)", "dT/dt", &labelled(power.as_slice()), &labelled(&[rate]));
        rows
    }

    /// Energy and momenta of the sums over bodies are T and its slopes.
    pub(super) fn of_momenta(&self, ring: &mut Ring<'g>, chain: &Chain<'g>) -> Vec<Row> {
        let Self(laws) = self;
        let momenta = by_body::momenta(chain);
        let energy = [("(energy)", "energy", "T", vec![momenta.energy], vec![laws.energy])];
        let vectors = [
            ("(momentum)", "linear", "T_v", momenta.linear, laws.linear),
            ("(20)", "angular_b", "T_ω", momenta.angular, laws.angular),
        ];
        let vectors = vectors.map(|(tag, name, law, checked, expected)| {
            (tag, name, law, checked.components().to_vec(), expected.components().to_vec())
        });
        let all = energy.into_iter().chain(vectors);
        all.map(|(tag, name, law, checked, expected)| {
            let claim = format!("derivation = {law}");
            Row::compare(ring, [tag, name, &claim], &labelled(&checked), &labelled(&expected))
        })
        .collect()
    }
}

/// Components by number.
pub(super) fn labelled<'g>(values: &[Expr<'g>]) -> Vec<(String, Expr<'g>)> {
    (1..).zip(values).map(|(number, value): (usize, _)| (number.to_string(), *value)).collect()
}
