//! The system against Boltzmann and Hamel's equations, from the kinetic energy only: what fixes the
//! place and the sign of every block.

use std::collections::BTreeMap;

use super::Comparison;
use super::unknowns::Unknowns;
use crate::derivation::chain::Chain;
use crate::derivation::reference;
use crate::derivation::reference::boltzmann_hamel::{BoltzmannHamel, boltzmann_hamel};
use crate::graph::Expr;
use crate::normal::Ring;

/// What the blocks are held against, derived once.
pub(super) struct Laws<'g>(BoltzmannHamel<'g>);

impl<'g> Laws<'g> {
    /// The laws of a chain.
    pub(super) fn of_chain(chain: &Chain<'g>) -> Self {
        Self(boltzmann_hamel(chain))
    }

    /// `M_xy = d^2 T / dx dy`; `M x'' + rest` is each of Boltzmann and Hamel's equations, and the
    /// power that goes into the kinetic energy. `who` states the blocks that `named` finds, between
    /// the unknowns numbered in `solved`. The others do not accelerate; what keeps them so is power,
    /// too.
    pub(super) fn rows(
        &self,
        ring: &mut Ring<'g>,
        unknowns: &Unknowns<'g>,
        solved: &[usize],
        who: &str,
        named: impl Fn(&str) -> Option<Expr<'g>>,
    ) -> Vec<Comparison> {
        let Self(laws) = self;
        let others: Vec<usize> = (0..unknowns.len()).filter(|x| !solved.contains(x)).collect();
        let at_rest: Vec<_> = others.iter().filter_map(|&x| unknowns.at_rest(x)).collect();
        let lawful = |e: Expr<'g>| e.with(&at_rest);
        let assembled = |x: usize, y: usize| unknowns.assembled(x.min(y), x.max(y), &named);
        let mut matrix = Vec::new();
        let mut hessian = Vec::new();
        for (place, &x) in solved.iter().enumerate() {
            for &y in &solved[place..] {
                matrix.push((format!("{x}{y}"), assembled(x, y)));
                hessian.push((format!("{x}{y}"), laws.mass[x][y - x]));
            }
        }
        let equation = |x: usize| {
            solved.iter().fold(unknowns.rest(x, &named), |sum, &y| {
                sum + assembled(x, y) * unknowns.accelerations[y]
            })
        };
        let equations: BTreeMap<usize, Expr<'g>> =
            solved.iter().map(|&x| (x, equation(x))).collect();
        let products = equations.iter().map(|(&x, e)| *e * unknowns.speeds[x]);
        let power = products.reduce(|sum, product| sum + product);

        let mut rows = Vec::new();
        let mut row = |tag: &str, name: &str, law: &str, checked: &[_], expected: &[_]| {
            let claim = format!("{who} = {law}");
            rows.push(Comparison::new(ring, [tag, name, &claim], checked, expected));
        };
        row("(M_ij)", "M", "d²T/dx dy", &matrix, &hessian);
        let law = "Boltzmann-Hamel";
        for (tag, name, range) in unknowns.equations() {
            let checked: Vec<_> =
                range.clone().filter_map(|x| equations.get(&x).copied()).collect();
            let expected: Vec<_> = laws.equations[range].iter().map(|e| lawful(*e)).collect();
            if !checked.is_empty() {
                row(tag, name, law, &labelled(&checked), &labelled(&expected));
            }
        }
        let kept = others.iter().map(|&x| laws.equations[x] * unknowns.speeds[x]);
        let rate = lawful(kept.fold(laws.energy.time_derivative(), |rate, power| rate - power));
        let law = if others.is_empty() { "dT/dt" } else { "dT/dt - P of the rest" };
        row("(power)", "v·(M v′ + h)", law, &labelled(power.as_slice()), &labelled(&[rate]));
        rows
    }

    /// Energy and momenta of the sums over bodies are T and its slopes.
    pub(super) fn of_momenta(&self, ring: &mut Ring<'g>, chain: &Chain<'g>) -> Vec<Comparison> {
        let Self(laws) = self;
        let momenta = reference::momenta(chain);
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
            Comparison::new(ring, [tag, name, &claim], &labelled(&checked), &labelled(&expected))
        })
        .collect()
    }
}

/// Components by number.
pub(super) fn labelled<'g>(values: &[Expr<'g>]) -> Vec<(String, Expr<'g>)> {
    (1..).zip(values).map(|(number, value): (usize, _)| (number.to_string(), *value)).collect()
}
