//! The figures of a [`MarginsReport`]: Bode, Nichols and Nyquist plots, singular values, sensitivity.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::super::blocks::Block;
use super::super::draw::bode::{Bode, level};
use super::super::draw::plane::Plane;
use super::super::error::DrawError;
use super::MarginsReport;
use crate::margins::analysis::{AXES, LoopPoint};

/// Points of a curve, at most.
const POINTS_MAX: usize = 1500;
/// Points of a curve in a plane, at most: a plane draws as many as they are.
const POINTS_OF_PLANE: usize = 650;
/// The window about -1 of a Nyquist plot: of the real and of the imaginary part.
const NYQUIST: [[f64; 2]; 2] = [[-3.4, 1.6], [-1.5, 1.5]];
/// That of a Nichols plot: deg and dB.
const NICHOLS: [[f64; 2]; 2] = [[-360.0, 0.0], [-40.0, 40.0]];
/// Values of |S| that a Nichols and a Nyquist plot show: on them the distance from -1 is their reciprocal.
const CIRCLE: f64 = 2.0;

/// What a curve shows of a point.
type PointValue<'a> = &'a dyn Fn(&LoopPoint) -> Complex<f64>;

impl MarginsReport<'_> {
    /// Points of the curves, so many at most.
    fn points(&self, most: usize) -> Vec<&LoopPoint> {
        let all = &self.analysis.points;
        let step = all.len().div_ceil(most).max(1);
        // One that stands out by an axis is kept.
        let outstanding = |group: &[LoopPoint]| {
            let size = |of: &LoopPoint| of.open[0];
            (0..group.len()).max_by(|a, b| {
                let at = |k: &usize| group.get(*k).map_or(0.0, size);
                at(a).total_cmp(&at(b))
            })
        };
        all.chunks(step).filter_map(|group| group.get(outstanding(group)?)).collect()
    }

    fn bode_of(&self, title: &str, curves: &[(&str, PointValue<'_>)], has_phases: bool) -> Bode {
        let points = self.points(POINTS_MAX);
        Bode {
            description: format!("{title} over the frequency in Hz, in decibels."),
            title: title.to_owned(),
            frequencies: points.iter().map(|at| at.omega / TAU).collect(),
            curves: curves
                .iter()
                .map(|(name, of)| ((*name).to_owned(), points.iter().map(|at| of(at)).collect()))
                .collect(),
            has_phases,
        }
    }

    pub(super) fn bode(&self) -> Bode {
        self.bode_of(
            "Open loop of each axis, others closed",
            &[("L_x", &|at| at.axes[0]), ("L_y", &|at| at.axes[1]), ("L_z", &|at| at.axes[2])],
            true,
        )
    }

    pub(super) fn whole_loop(&self) -> Bode {
        let real = |value: f64| Complex::new(value, 0.0);
        self.bode_of(
            "Singular values and loci of the whole loop",
            &[
                ("largest", &|at| real(at.open[0])),
                ("smallest", &|at| real(at.open[1])),
                ("largest eigenvalue", &|at| at.loci[0]),
            ],
            false,
        )
    }

    pub(super) fn sensitivity(&self) -> Bode {
        let real = |value: f64| Complex::new(value, 0.0);
        self.bode_of(
            "Sensitivity and complementary sensitivity",
            &[("S", &|at| real(at.peaks[0])), ("T", &|at| real(at.peaks[1]))],
            false,
        )
    }

    /// A curve of each axis in a plane.
    fn plane(
        &self,
        [title, across, up]: [&str; 3],
        ranges: [[f64; 2]; 2],
        of: impl Fn(&[Complex<f64>]) -> Vec<[f64; 2]>,
    ) -> Plane {
        let points = self.points(POINTS_OF_PLANE);
        let curve = |(axis, name): (usize, &&str)| {
            let values: Vec<Complex<f64>> =
                points.iter().filter_map(|at| at.axes.get(axis).copied()).collect();
            (format!("L_{name}"), of(&values))
        };
        Plane {
            description: format!("{title}: {up} over {across}."),
            title: title.to_owned(),
            axes: [across.to_owned(), up.to_owned()],
            curves: AXES.iter().enumerate().map(curve).collect(),
            lines: Vec::new(),
            dots: Vec::new(),
            marks: Vec::new(),
            large: true,
            logarithmic: false,
            ranges: ranges.map(Some),
        }
    }

    pub(super) fn nichols(&self) -> Plane {
        let labels = ["Nichols plot of each axis", "Phase (deg)", "Magnitude (dB)"];
        let mut plane = self.plane(labels, NICHOLS, |values| {
            let at = |value: &Complex<f64>| [phase(value), level(value.norm())];
            interrupted(values.iter().map(at).collect(), 180.0)
        });
        let circle: Vec<[f64; 2]> =
            circle().iter().map(|value| [phase(value), level(value.norm())]).collect();
        plane.curves.push((format!("|S| = {CIRCLE}"), circle));
        plane.marks.push([-180.0, 0.0]);
        plane
    }

    pub(super) fn nyquist(&self) -> Plane {
        let labels = ["Nyquist plot of each axis", "Real part", "Imaginary part"];
        let [re, im] = NYQUIST;
        let mut plane = self.plane(labels, NYQUIST, |values| {
            let inside = |value: &Complex<f64>| {
                (re[0]..=re[1]).contains(&value.re) && (im[0]..=im[1]).contains(&value.im)
            };
            let at =
                |value: &Complex<f64>| [value.re, if inside(value) { value.im } else { f64::NAN }];
            values.iter().map(at).collect()
        });
        let circle: Vec<[f64; 2]> = circle().iter().map(|value| [value.re, value.im]).collect();
        plane.curves.push((format!("|S| = {CIRCLE}"), circle));
        plane.marks.push([-1.0, 0.0]);
        plane
    }

    pub(super) fn loop_figures(&self) -> Result<Vec<Block>, DrawError> {
        let [bode, whole] = [self.bode(), self.whole_loop()];
        let of = |id: &str, number: &str, caption: String, svg: String, charts| Block::Figure {
            id: format!("figure-{id}"),
            number: number.to_owned(),
            caption,
            svg,
            charts,
        };
        let near = format!(
            "The circle marks -1; on the curve |S| = {CIRCLE} a loop is 1/{CIRCLE} away from it."
        );
        Ok(vec![
            of(
                "bode",
                "1",
                "Bode plot: what the torque about an axis sees, the others closed.".to_owned(),
                bode.inline()?,
                bode.charts(),
            ),
            of(
                "nichols",
                "2",
                format!("Nichols plot. {near}"),
                self.nichols().inline()?,
                Vec::new(),
            ),
            of(
                "nyquist",
                "3",
                format!("Nyquist plot about -1. {near}"),
                self.nyquist().inline()?,
                Vec::new(),
            ),
            of(
                "singular-values",
                "4",
                "Singular values of the whole loop, and its largest eigenvalue.".to_owned(),
                whole.inline()?,
                whole.charts(),
            ),
        ])
    }

    pub(super) fn sensitivity_figures(&self) -> Result<Vec<Block>, DrawError> {
        let figure = self.sensitivity();
        Ok(vec![Block::Figure {
            id: "figure-sensitivity".to_owned(),
            number: "5".to_owned(),
            caption: "Largest singular values of S = 1 / (1 + L), from a disturbing torque to the torque that acts, and of T = 1 - S.".to_owned(),
            svg: figure.inline()?,
            charts: figure.charts(),
        }])
    }
}

/// Degrees from -360 to 0.
fn phase(value: &Complex<f64>) -> f64 {
    let degrees = value.im.atan2(value.re).to_degrees();
    if degrees > 0.0 { degrees - 360.0 } else { degrees }
}

/// Points, interrupted where an abscissa jumps by more than so much.
fn interrupted(points: Vec<[f64; 2]>, jump: f64) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = Vec::with_capacity(points.len());
    for point in points {
        if let Some(last) = all.last()
            && (last[0] - point[0]).abs() > jump
        {
            all.push([point[0], f64::NAN]);
        }
        all.push(point);
    }
    all
}

/// The circle about -1 on which the sensitivity has one magnitude.
fn circle() -> Vec<Complex<f64>> {
    let at = |k: i32| Complex::from_polar(CIRCLE.recip(), TAU * f64::from(k) / 180.0) - 1.0;
    (0..=180).map(at).collect()
}
