//! [`Collector`]: frames of the whole run in bounded memory, and those of a few turns of the fastest
//! wheel; [`ReplayData`]: both as the page reads them.
//!
//! The frames of the run are every 2^k-th sample, so that there are between half the capacity and
//! the capacity, and the last sample.

use precess_dynamics::{Mrp, Quaternion};
use serde::Serialize;

use super::slow_motion::Turns;
use crate::record::Header;
use crate::record::columns::Quantity;
use crate::report::data::{doubles, singles};
use crate::scenario::Scenario;
use crate::scenario::mass::momentum_size;
use crate::shapes::{Hub, Joint, hub, joints};

/// Most frames of the run.
const FRAMES_MAX: usize = 600;
/// Bytes of a page for them.
const FRAMES_BYTES: usize = 110_000;

/// A momentum below this share of the sum of those of hub and joints at the start is rounding: drawn as zero. Runs end with
/// 1e-12 of the sum.
const RESIDUE: f64 = 1e-9;

/// Time, quaternion (4), angular velocity (3), angular momentum (3), coordinates, rates.
pub(in crate::report) type Frame = Vec<f64>;
/// Where in a frame the angular momentum is.
const MOMENTUM: std::ops::Range<usize> = 8..11;
/// Where in a frame the coordinates start.
pub(in crate::report) const COORDINATES: usize = 11;

/// Collects frames.
pub(in crate::report) struct Collector {
    sources: Sources,
    hub: Hub,
    joints: Vec<Joint>,
    capacity: usize,
    frames: Vec<Frame>,
    /// One in so many samples is a frame.
    stride: u64,
    samples: u64,
    last: Frame,
    turns: Turns,
    /// A smaller angular momentum is drawn as zero, N m s.
    residue: f64,
}

/// The columns of a frame's numbers.
struct Sources {
    /// Euler parameters, or modified Rodrigues parameters.
    attitude: Vec<usize>,
    omega: Vec<usize>,
    momentum: Vec<usize>,
    coordinates: Vec<usize>,
    rates: Vec<usize>,
}

/// The replay of the data block.
#[derive(Serialize)]
pub(in crate::report) struct ReplayData {
    hub: Hub,
    joints: Vec<Joint>,
    /// The first is the whole run.
    windows: Vec<Window>,
    /// The largest rotation of the hub between two frames of the run, rad.
    #[serde(skip)]
    pub(in crate::report) step: f64,
}

/// A span of the run.
#[derive(Serialize)]
struct Window {
    label: String,
    frames: usize,
    time: String,
    attitude: String,
    omega: String,
    momentum: String,
    coordinates: String,
    rates: String,
    magnify: f64,
}

impl Collector {
    /// The collector of a run; none where a column that a frame needs is not recorded.
    pub(in crate::report) fn new(header: &Header, scenario: &Scenario) -> Option<Self> {
        let sources = Sources::new(header, scenario)?;
        let joints = joints(scenario);
        // Of a frame: ten doubles and six singles, and a double and a single for each joint.
        let bytes = (64 + 12 * joints.len()) * 4 / 3;
        let wheels = scenario.joints().map(|(_, _, info)| info.body == "wheel").collect();
        Some(Self {
            turns: Turns::new(wheels, header.rate),
            sources,
            hub: hub(scenario),
            joints,
            capacity: (FRAMES_BYTES / bytes).clamp(100, FRAMES_MAX).next_multiple_of(2),
            frames: Vec::new(),
            stride: 1,
            samples: 0,
            last: Frame::new(),
            residue: RESIDUE * momentum_size(scenario).unwrap_or(0.0),
        })
    }

    /// Adds a sample.
    pub(in crate::report) fn add(&mut self, row: &[f64]) {
        self.last.clear();
        self.sources.fill(row, &mut self.last);
        self.turns.add(&self.last);
        if self.samples.is_multiple_of(self.stride) {
            if self.frames.len() == self.capacity {
                let mut index = 0_usize;
                self.frames.retain(|_| {
                    index += 1;
                    index % 2 == 1
                });
                self.stride *= 2;
            }
            if self.samples.is_multiple_of(self.stride) {
                self.frames.push(self.last.clone());
            }
        }
        self.samples += 1;
    }

    /// What the page reads; none of a run with fewer than two samples, or with one that is no
    /// number.
    pub(in crate::report) fn data(&self) -> Option<ReplayData> {
        let mut frames = self.frames.clone();
        if frames.last().is_some_and(|frame| frame[0] < self.last[0]) {
            frames.push(self.last.clone());
        }
        if frames.len() < 2 || !frames.iter().flatten().all(|number| number.is_finite()) {
            return None;
        }
        let is_residue = frames.iter().all(|frame| momentum_of(frame) < self.residue);
        let window = |label: String, mut frames: Vec<Frame>, magnify: f64| {
            if is_residue {
                for frame in &mut frames {
                    frame[MOMENTUM].fill(0.0);
                }
            }
            Window::from_frames(label, &frames, magnify)
        };
        let mut windows = vec![window("whole run".to_owned(), frames.clone(), 1.0)];
        if let Some((label, frames, magnify)) = self.turns.window() {
            windows.push(window(label, frames, magnify));
        }
        let step = frames.windows(2).map(|pair| {
            let size = |frame: &Frame| frame[5..8].iter().map(|w| w * w).sum::<f64>().sqrt();
            (pair[1][0] - pair[0][0]) * size(&pair[0]).max(size(&pair[1]))
        });
        Some(ReplayData {
            hub: self.hub.clone(),
            joints: self.joints.clone(),
            windows,
            step: step.fold(0.0, f64::max),
        })
    }
}

/// Magnitude of the angular momentum of a frame.
fn momentum_of(frame: &[f64]) -> f64 {
    frame[MOMENTUM].iter().map(|of| of * of).sum::<f64>().sqrt()
}

impl Sources {
    fn new(header: &Header, scenario: &Scenario) -> Option<Self> {
        let index = |quantity: Quantity| {
            header.columns.iter().position(|column| column.quantity == quantity)
        };
        let all = |count: usize, of: fn(usize) -> Quantity| {
            (0..count).map(|which| index(of(which))).collect::<Option<Vec<_>>>()
        };
        let joints = scenario.joint_count();
        Some(Self {
            attitude: all(4, Quantity::Quaternion).or_else(|| all(3, Quantity::Sigma))?,
            omega: all(3, Quantity::Omega)?,
            momentum: all(3, Quantity::Angular)?,
            coordinates: all(joints, Quantity::Coordinate)?,
            rates: all(joints, Quantity::Rate)?,
        })
    }

    fn fill(&self, row: &[f64], frame: &mut Frame) {
        let of = |column: &usize| row.get(*column).copied().unwrap_or(f64::NAN);
        frame.push(of(&0));
        match self.attitude.as_slice() {
            [x, y, z] => {
                let sigma = Mrp(nalgebra::Vector3::new(of(x), of(y), of(z)));
                let Quaternion { q0, q1, q2, q3 } = sigma.into();
                frame.extend([q0, q1, q2, q3]);
            }
            all => frame.extend(all.iter().map(of)),
        }
        for columns in [&self.omega, &self.momentum, &self.coordinates, &self.rates] {
            frame.extend(columns.iter().map(of));
        }
    }
}

impl Window {
    fn from_frames(label: String, frames: &[Frame], magnify: f64) -> Self {
        let joints = frames.first().map_or(0, |frame| (frame.len() - COORDINATES) / 2);
        let part = |from: usize, count: usize| -> Vec<f64> {
            frames.iter().flat_map(|frame| frame[from..from + count].iter().copied()).collect()
        };
        Self {
            label,
            frames: frames.len(),
            time: doubles(&part(0, 1)),
            attitude: doubles(&part(1, 4)),
            omega: singles(&part(5, 3)),
            momentum: singles(&part(8, 3)),
            coordinates: doubles(&part(COORDINATES, joints)),
            rates: singles(&part(COORDINATES + joints, joints)),
            magnify,
        }
    }
}
