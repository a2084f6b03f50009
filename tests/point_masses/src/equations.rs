//! Newton's law for point masses, and d'Alembert's principle: the equations in every direction in
//! which a spacecraft may move.

use nalgebra::Vector3;
use precess_dynamics::Wrench;

use super::{Body, Mass, PointMasses, Rates};

/// One direction's equation, `m q'' = h`, summed over the masses.
#[derive(Clone, Debug)]
pub struct DirectionEquation {
    /// Of each acceleration.
    pub m: Vec<f64>,
    /// Without accelerations.
    pub h: f64,
    /// The sum of the magnitudes of the terms of each entry of m, and of h.
    pub magnitudes: (Vec<f64>, f64),
}

impl PointMasses {
    /// The equations, under uniform gravity g along N axes, what the hub's inputs and the motors
    /// exert in each direction, and a wrench on the child body of each joint or none on any.
    #[must_use]
    pub fn equations(
        &self,
        g: &Vector3<f64>,
        inputs: &[f64],
        wrenches: &[Wrench],
    ) -> Vec<DirectionEquation> {
        let g = self.bn * g;
        let passive = [0.0; 6].into_iter().chain(self.passive());
        // The bodies as they are when nothing accelerates: what is left are the rates' own terms.
        let bodies = self.bodies(&Rates::none(self.coordinates.len()));
        let displaced: Vec<_> = (0..self.directions()).map(|i| self.displaced(i)).collect();
        // Every mass once: a pair of directions takes two lists of them.
        let listed = |bodies: &Vec<Body>| bodies.iter().flat_map(Body::masses).collect();
        let now: Vec<Mass> = listed(&bodies);
        let moved: Vec<Vec<Mass>> = displaced.iter().map(listed).collect();
        let row = |((along, moving), acting): ((&Vec<Body>, &Vec<Mass>), f64)| {
            let mut h = vec![acting];
            for (mass, along) in now.iter().zip(moving) {
                let (along, m) = (along.r[1], mass.mass);
                h.extend(&(mass.r[2] * -m).component_mul(&along));
                h.extend(&(g * m).component_mul(&along));
            }
            for ((wrench, body), along) in wrenches.iter().zip(&bodies[1..]).zip(&along[1..]) {
                let (origin, turning) = (along.frame.origin[1], along.frame.angular_velocity());
                h.extend(&(body.own * wrench.force).component_mul(&origin));
                h.extend(&(body.own * wrench.moment).component_mul(&turning));
            }
            let m = moved.iter().map(|other| {
                let terms = moving.iter().zip(other).flat_map(|(a, b)| {
                    let products = a.r[1].component_mul(&b.r[1]) * a.mass;
                    [products.x, products.y, products.z]
                });
                terms.fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()))
            });
            let (m, of_m): (Vec<_>, Vec<_>) = m.unzip();
            let of_h = h.iter().map(|term| term.abs()).sum();
            DirectionEquation { m, h: h.iter().sum(), magnitudes: (of_m, of_h) }
        };
        let acting = inputs.iter().zip(passive).map(|(input, passive)| input + passive);
        displaced.iter().zip(&moved).zip(acting).map(row).collect()
    }
}
