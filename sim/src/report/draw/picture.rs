//! [`Picture`]: any of the figures that are not of a run, as a file of its own and as a part of a page.

use super::cells::CellMap;
use super::curves::CurveChart;
use super::fitted_lines::FittedLines;
use super::plane::Plane;
use super::spectrum::SpectrumFigure;
use super::waterfall::Waterfall;
use crate::report::error::DrawError;

/// What is drawn.
pub(crate) enum Picture {
    Waterfall(Waterfall),
    Lines(FittedLines),
    Plane(Plane),
    Spectrum(SpectrumFigure),
    Cells(CellMap),
}

impl Picture {
    /// As an SVG file of its own.
    pub(crate) fn file(&self) -> Result<String, DrawError> {
        match self {
            Self::Waterfall(figure) => figure.file(),
            Self::Lines(figure) => figure.file(),
            Self::Plane(figure) => figure.file(),
            Self::Spectrum(figure) => figure.file(),
            Self::Cells(figure) => figure.file(),
        }
    }

    /// What the script of a page draws in its place; nothing of a map or a waterfall.
    pub(in crate::report) fn charts(&self) -> Vec<CurveChart> {
        match self {
            Self::Waterfall(_) | Self::Cells(_) => Vec::new(),
            Self::Lines(figure) => vec![figure.chart()],
            Self::Plane(figure) => figure.chart().into_iter().collect(),
            Self::Spectrum(figure) => figure.charts(),
        }
    }

    /// As a part of a page that turns its colours.
    pub(crate) fn inline(&self) -> Result<String, DrawError> {
        match self {
            Self::Waterfall(figure) => figure.inline(),
            Self::Lines(figure) => figure.inline(),
            Self::Plane(figure) => figure.inline(),
            Self::Spectrum(figure) => figure.inline(),
            Self::Cells(figure) => figure.inline(),
        }
    }
}
