//! [`Feedback`]: a linear controller in discrete time.

use nalgebra::{Complex, DMatrix};

use crate::filter::section::Section;
use crate::model::error::{self, ControlError};

/// `w_k+1 = A w_k + B y_k`, `u_k = C w_k + D y_k`: what is commanded from what is measured, of a negative feedback with its sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Feedback {
    /// `A`.
    pub a: DMatrix<f64>,
    /// `B`.
    pub b: DMatrix<f64>,
    /// `C`.
    pub c: DMatrix<f64>,
    /// `D`.
    pub d: DMatrix<f64>,
}

impl Feedback {
    /// Without a state: `u = D y`.
    #[must_use]
    pub fn gain(d: DMatrix<f64>) -> Self {
        let (outputs, inputs) = d.shape();
        let (a, b) = (DMatrix::zeros(0, 0), DMatrix::zeros(0, inputs));
        Self { a, b, c: DMatrix::zeros(outputs, 0), d }
    }

    /// `-K_p theta - K_r omega - K_i T sum(theta)` of three rotations and rates measured, the sum with the present sample;
    /// gains in N m, N m s and N m/s.
    #[must_use]
    pub fn pid([attitude, rate, integral]: [&DMatrix<f64>; 3], period: f64) -> Self {
        let n = attitude.nrows();
        let mut b = DMatrix::zeros(n, n.saturating_mul(2));
        b.view_mut((0, 0), (n, n)).fill_with_identity();
        let mut d = DMatrix::zeros(n, n.saturating_mul(2));
        d.view_mut((0, 0), (n, n)).copy_from(&(-attitude - integral * period));
        d.view_mut((0, n), (n, n)).copy_from(&-rate);
        let c = -integral * period;
        if integral.iter().all(|gain| *gain == 0.0) {
            return Self::gain(d);
        }
        Self { a: DMatrix::identity(n, n), b, c, d }
    }

    /// A filter of second order on each of some signals.
    #[must_use]
    pub fn section(section: &Section, signals: usize) -> Self {
        let ([b0, b1, b2], [a1, a2]) = (section.numerator(), section.denominator());
        let unit = DMatrix::identity(signals, signals);
        let of = |rows: usize, columns: usize, elements: &[f64]| {
            unit.kronecker(&DMatrix::from_row_slice(rows, columns, elements))
        };
        Self {
            a: of(2, 2, &[-a1, 1.0, -a2, 0.0]),
            b: of(2, 1, &[b1 - a1 * b0, b2 - a2 * b0]),
            c: of(1, 2, &[1.0, 0.0]),
            d: unit * b0,
        }
    }

    /// `C (z 1 - A)^-1 B + D`; none at a pole.
    #[must_use]
    pub fn transfer(&self, z: Complex<f64>) -> Option<DMatrix<Complex<f64>>> {
        let complex = |m: &DMatrix<f64>| m.map(|element| Complex::new(element, 0.0));
        if self.a.is_empty() {
            return Some(complex(&self.d));
        }
        let mut resolvent = -complex(&self.a);
        for k in 0..resolvent.nrows() {
            resolvent[(k, k)] += z;
        }
        Some(complex(&self.c) * resolvent.lu().solve(&complex(&self.b))? + complex(&self.d))
    }

    /// This one, then another on its commands.
    ///
    /// # Errors
    ///
    /// Where their shapes do not agree.
    pub fn then(&self, next: &Self) -> Result<Self, ControlError> {
        error::count("inputs of the second", next.d.ncols(), self.d.nrows())?;
        let (n, m) = (self.a.nrows(), next.a.nrows());
        let size = n.saturating_add(m);
        let mut a = DMatrix::zeros(size, size);
        a.view_mut((0, 0), (n, n)).copy_from(&self.a);
        a.view_mut((n, 0), (m, n)).copy_from(&(&next.b * &self.c));
        a.view_mut((n, n), (m, m)).copy_from(&next.a);
        let mut b = DMatrix::zeros(size, self.d.ncols());
        b.view_mut((0, 0), (n, self.d.ncols())).copy_from(&self.b);
        b.view_mut((n, 0), (m, self.d.ncols())).copy_from(&(&next.b * &self.d));
        let mut c = DMatrix::zeros(next.d.nrows(), size);
        c.view_mut((0, 0), (next.d.nrows(), n)).copy_from(&(&next.d * &self.c));
        c.view_mut((0, n), (next.d.nrows(), m)).copy_from(&next.c);
        Ok(Self { a, b, c, d: &next.d * &self.d })
    }

    /// Whether the shapes agree with each other and with a plant.
    pub(crate) fn checked(&self, outputs: usize, inputs: usize) -> Result<(), ControlError> {
        let n = self.a.nrows();
        for (what, found, wanted) in [
            ("columns of A of the feedback", self.a.ncols(), n),
            ("rows of its B", self.b.nrows(), n),
            ("columns of its C", self.c.ncols(), n),
            ("columns of its B", self.b.ncols(), outputs),
            ("columns of its D", self.d.ncols(), outputs),
            ("rows of its C", self.c.nrows(), inputs),
            ("rows of its D", self.d.nrows(), inputs),
        ] {
            error::count(what, found, wanted)?;
        }
        let numbers = self.a.iter().chain(&self.b).chain(&self.c).chain(&self.d);
        numbers.copied().try_for_each(|element| error::finite("feedback", element))
    }
}
