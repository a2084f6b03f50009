//! The assembled blocks against the laws of motion, from the kinetic energy and the momenta of the
//! sums over bodies: what fixes the place and the sign of every block.

use super::Row;
use super::factors::Unknowns;
use super::read_back::Reading;
use crate::derivation::by_body;
use crate::derivation::chain::Chain;
use crate::graph::Expr;
use crate::normal::Ring;

/// What the blocks are held against, derived once.
pub(super) struct Laws<'g> {
    /// `d^2 T / dx dy` for the speeds x before y.
    hessian: Vec<(String, Expr<'g>)>,
    newton: Vec<(String, Expr<'g>)>,
    euler: Vec<(String, Expr<'g>)>,
    energy_rate: Expr<'g>,
}

impl<'g> Laws<'g> {
    /// The laws of a chain.
    pub(super) fn of(chain: &Chain<'g>, unknowns: &Unknowns<'g>) -> Self {
        let momenta = by_body::momenta(chain);
        let mut hessian = Vec::new();
        for (x, speed) in unknowns.speeds.iter().enumerate() {
            let slope = momenta.energy.partial(*speed);
            for (y, speed) in unknowns.speeds.iter().enumerate().skip(x) {
                hessian.push((format!("{x}{y}"), slope.partial(*speed)));
            }
        }
        let (omega, r_b_n_dot) = (chain.hub.omega, chain.hub.r_b_n_dot);
        let newton = momenta.linear.prime(omega);
        // About the moving point B: L_B = d(angular)/dt + r_dot x linear.
        let euler = momenta.angular.prime(omega) + r_b_n_dot.cross(momenta.linear);
        Self {
            hessian,
            newton: labelled(&newton.components()),
            euler: labelled(&euler.components()),
            energy_rate: momenta.energy.time_derivative(),
        }
    }

    /// `M_xy = d^2 T / dx dy`; and `M x'' + rest` is Newton's law for the device, Euler's about
    /// the moving point B, and the power that goes into its kinetic energy.
    pub(super) fn rows(
        &self,
        ring: &mut Ring<'g>,
        unknowns: &Unknowns<'g>,
        back: &Reading<'g>,
    ) -> Vec<Row> {
        let named = |name: &str| back.values.get(name).copied();
        let assembled = |x: usize, y: usize| unknowns.assembled(x.min(y), x.max(y), named);
        let all = 0..unknowns.len();
        let matrix: Vec<_> = all
            .clone()
            .flat_map(|x| (x..unknowns.len()).map(move |y| (x, y)))
            .map(|(x, y)| (format!("{x}{y}"), assembled(x, y)))
            .collect();
        let equation = |x: usize| {
            let terms = unknowns.accelerations.iter().enumerate();
            terms.fold(unknowns.rest(x, named), |sum, (y, acceleration)| {
                sum + assembled(x, y) * *acceleration
            })
        };
        let equations: Vec<Expr<'g>> = all.map(equation).collect();
        let products = equations.iter().zip(&unknowns.speeds).map(|(e, speed)| *e * *speed);
        let power = products.reduce(|sum, product| sum + product);
        let one = |value: Expr<'g>| vec![(String::new(), value)];
        let power: Vec<_> = power.into_iter().flat_map(one).collect();
        let mut row = |heading, checked: &[_], law: &[_]| Row::compare(ring, heading, checked, law);
        let [newton, euler] = [&equations[0..3], &equations[3..6]].map(labelled);
        vec![
            row(["(M_ij)", "M", "fn eliminate = d²T/dx dy"], &matrix, &self.hessian),
            row(["(16)", "F", "fn eliminate = d(linear)/dt"], &newton, &self.newton),
            row(["(75)", "L_B", "fn eliminate = d(angular)/dt"], &euler, &self.euler),
            row(
                ["(power)", "v·(M v′ + h)", "fn eliminate = dT/dt"],
                &power,
                &one(self.energy_rate),
            ),
        ]
    }
}

/// Components along B axes.
fn labelled<'g>(values: &[Expr<'g>]) -> Vec<(String, Expr<'g>)> {
    ["bx", "by", "bz"].map(str::to_owned).into_iter().zip(values.iter().copied()).collect()
}
