//! [`WheelLines`]: the lines of a wheel at its present rate: of its imbalance, once per turn, and of harmonic sources.
//!
//! ```text
//! static imbalance     force   m rho Omega²               rho: offset of the centre of mass across the axis
//! dynamic imbalance    moment  |J_xy, J_xz| Omega²        about the wheel's origin, x along the axis
//! harmonic source      force   |C_force| Omega², moment |C_moment| Omega², at h |Omega| / 2 pi
//! ```
//!
//! Amplitudes are those of a rigid base; the loads of the coupled wheel are the columns `loads`.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::disturbance::Model;
use crate::record::Header;
use crate::record::columns::Quantity;
use crate::scenario::Scenario;

/// The lines of a wheel.
pub(super) struct WheelLines {
    /// `/cmg1/lines`.
    pub(super) topic: String,
    /// The column of its rate.
    rate: usize,
    /// Harmonic; force, kg m, and moment, kg m², over the square of the rate.
    lines: Vec<[f64; 3]>,
}

/// `precess.lines`.
#[derive(Serialize)]
pub(super) struct Lines {
    /// |Omega| / 2 pi, Hz.
    turns_per_second: f64,
    pub(super) lines: Vec<Line>,
}

/// One of them.
#[derive(Serialize)]
pub(super) struct Line {
    harmonic: f64,
    /// Hz.
    pub(super) frequency: f64,
    /// Amplitude, N.
    pub(super) force: f64,
    /// Amplitude, N m.
    pub(super) moment: f64,
}

impl WheelLines {
    /// Those of the wheels whose rates are recorded.
    pub(super) fn all(header: &Header, scenario: &Scenario) -> Vec<Self> {
        let mut wheels = Vec::new();
        let bodies = scenario.members().flat_map(|(_, member)| member.bodies());
        for (joint, ((_, device, info), body)) in scenario.joints().zip(bodies).enumerate() {
            let column = |of: &crate::record::Column| of.quantity == Quantity::Rate(joint);
            let Some(rate) = header.columns.iter().position(column) else { continue };
            if info.body != "wheel" {
                continue;
            }
            let [a, b] = [(info.axis + 1) % 3, (info.axis + 2) % 3];
            let (centre, along) = (body.centre, info.axis.min(2));
            // Products about the origin: those about the centre of mass less m c_x c_y.
            let product = |other: usize| {
                body.inertia[(along, other)] - body.mass * centre[along] * centre[other]
            };
            let force = body.mass * centre[a].hypot(centre[b]);
            let mut lines = vec![[1.0, force, product(a).hypot(product(b))]];
            for source in scenario.disturbances.iter().filter(|of| of.wheel == Some(joint)) {
                let Model::Harmonic(tones) = &source.model else { continue };
                lines.extend(tones.iter().map(|tone| {
                    let [fx, fy, fz, mx, my, mz] = tone.amplitudes;
                    [tone.number, fx.hypot(fy).hypot(fz), mx.hypot(my).hypot(mz)]
                }));
            }
            wheels.push(Self { topic: format!("/{device}/lines"), rate, lines });
        }
        wheels
    }

    /// The lines of a sample.
    pub(super) fn message(&self, row: &[f64]) -> Lines {
        let rate = row.get(self.rate).copied().unwrap_or(f64::NAN).abs();
        let square = rate * rate;
        let lines = self.lines.iter().map(|[harmonic, force, moment]| Line {
            harmonic: *harmonic,
            frequency: harmonic * rate / TAU,
            force: force * square,
            moment: moment * square,
        });
        Lines { turns_per_second: rate / TAU, lines: lines.collect() }
    }
}
