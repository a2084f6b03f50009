//! [`Dense`]: the solution of DOP853 within a step, of order 7, from the stages of the step.
//!
//! Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, II.6: a polynomial from
//! the 12 stages, the derivative at the end and three more stages. The integrator of
//! differential-equations 0.7.0 evaluates all of them, but its own interpolant exchanges the
//! factors s and 1 - s in the upper half of the polynomial, which at tolerance 1e-13 costs five
//! digits of momentum. So the stages are kept here as they are evaluated. Over Table 1 at that
//! tolerance this polynomial departs by less than 1e-12 from a step of its own to the same time
//! (a test), and costs no evaluation.

/// Stages kept of a step: the first is the derivative at its start, number 12 that at its end.
pub(crate) const STAGES: usize = 16;

/// Number of the derivative at the end of the step.
const LAST: usize = 12;

/// Which stages have a weight in the upper half of the polynomial.
const USED: [usize; 12] = [0, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// Their weights, Hairer's `d4` to `d7`.
#[expect(clippy::unreadable_literal, reason = "as printed")]
const WEIGHTS: [[f64; 12]; 4] = [
    [
        -8.428938276109013,
        0.5667149535193777,
        -3.0689499459498917,
        2.38466765651207,
        2.117034582445028,
        -0.871391583777973,
        2.2404374302607883,
        0.6315787787694688,
        -0.0889903364513333,
        18.148505520854727,
        -9.194632392478356,
        -4.436036387594894,
    ],
    [
        10.427508642579134,
        242.28349177525817,
        165.20045171727028,
        -374.5467547226902,
        -22.113666853125306,
        7.733432668472264,
        -30.674084731089398,
        -9.332130526430229,
        15.697238121770845,
        -31.139403219565178,
        -9.35292435884448,
        35.81684148639408,
    ],
    [
        19.985053242002433,
        -387.0373087493518,
        -189.17813819516758,
        527.8081592054236,
        -11.57390253995963,
        6.8812326946963,
        -1.0006050966910838,
        0.7777137798053443,
        -2.778205752353508,
        -60.19669523126412,
        84.32040550667716,
        11.99229113618279,
    ],
    [
        -25.69393346270375,
        -154.18974869023643,
        -231.5293791760455,
        357.6391179106141,
        93.40532418362432,
        -37.45832313645163,
        104.0996495089623,
        29.8402934266605,
        -43.53345659001114,
        96.32455395918828,
        -39.17726167561544,
        -149.72683625798564,
    ],
];

/// The stages of the present step, and the polynomial once a state within the step is needed.
#[derive(Clone, Debug)]
pub(crate) struct Dense {
    size: usize,
    /// The stages, one after the other.
    stages: Vec<f64>,
    /// The coefficients; empty until they are needed.
    coefficients: Vec<[f64; 8]>,
    /// The stage that is evaluated next.
    next: usize,
}

impl Dense {
    pub(crate) fn new(size: usize) -> Self {
        let stages = vec![0.0; STAGES * size];
        Self { size, stages, coefficients: Vec::with_capacity(size), next: 0 }
    }

    /// Keeps the derivative at the start of an integration, the last one that is evaluated.
    pub(crate) fn start(&mut self) {
        self.next = 0;
    }

    /// Begins an attempt at a step.
    pub(crate) fn attempt(&mut self) {
        self.next = 1;
    }

    /// Keeps a derivative.
    pub(crate) fn keep(&mut self, dydt: &[f64]) {
        let from = self.next * self.size;
        if let Some(stage) = self.stages.get_mut(from..from + dydt.len()) {
            stage.copy_from_slice(dydt);
        }
        // Before the first step, every evaluation is that of its start.
        if self.next > 0 {
            self.next += 1;
        }
    }

    /// Makes the end of the step the start of the next one.
    pub(crate) fn advance(&mut self) {
        self.stages.copy_within(LAST * self.size..(LAST + 1) * self.size, 0);
    }

    /// Forgets the polynomial of the step before.
    pub(crate) fn forget(&mut self) {
        self.coefficients.clear();
    }

    /// Writes the state at the share `s` of the step of length `h` from `y0` to `y1`.
    pub(crate) fn state(&mut self, y0: &[f64], y1: &[f64], h: f64, s: f64, y: &mut [f64]) {
        if self.coefficients.is_empty() {
            self.compute(y0, y1, h);
        }
        let r = 1.0 - s;
        for (y, c) in y.iter_mut().zip(&self.coefficients) {
            let upper = c[4] + s * (c[5] + r * (c[6] + s * c[7]));
            *y = c[0] + s * (c[1] + r * (c[2] + s * (c[3] + r * upper)));
        }
    }

    fn compute(&mut self, y0: &[f64], y1: &[f64], h: f64) {
        let stage = |stage: usize, i: usize| self.stages[stage * self.size + i];
        let number = |(i, (y0, y1)): (usize, (&f64, &f64))| {
            let difference = y1 - y0;
            let from_start = h * stage(0, i) - difference;
            let to_end = difference - h * stage(LAST, i) - from_start;
            let upper = WEIGHTS.each_ref().map(|weights| {
                let terms = weights.iter().zip(USED).map(|(weight, used)| weight * stage(used, i));
                h * terms.sum::<f64>()
            });
            let [c4, c5, c6, c7] = upper;
            [*y0, difference, from_start, to_end, c4, c5, c6, c7]
        };
        self.coefficients.extend(y0.iter().zip(y1).enumerate().map(number));
    }
}
