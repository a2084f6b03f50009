//! [`ReportError`]: a page or a figure that could not be made; a fault of the program.

use std::fmt;
use std::io;

use plotters::drawing::DrawingAreaErrorKind;

/// The page or a figure could not be made.
#[derive(Debug)]
pub enum ReportError {
    /// A figure could not be drawn.
    Draw(DrawError),
    /// The template and its data do not agree.
    Template(tera::Error),
    /// The data block is no JSON.
    Data(serde_json::Error),
}

/// plotters could not draw.
#[derive(Debug)]
pub struct DrawError {
    /// What it reports.
    pub source: DrawingAreaErrorKind<io::Error>,
}

impl fmt::Display for ReportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Draw(error) => error.fmt(f),
            Self::Template(error) => {
                write!(f, "cannot lay out the report: {error}; this is a fault of the program")
            }
            Self::Data(error) => {
                write!(f, "cannot write the report's data: {error}; this is a fault of the program")
            }
        }
    }
}

impl std::error::Error for ReportError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Draw(source) => Some(source),
            Self::Template(source) => Some(source),
            Self::Data(source) => Some(source),
        }
    }
}

impl From<DrawError> for ReportError {
    fn from(error: DrawError) -> Self {
        Self::Draw(error)
    }
}

impl From<tera::Error> for ReportError {
    fn from(error: tera::Error) -> Self {
        Self::Template(error)
    }
}

impl From<serde_json::Error> for ReportError {
    fn from(error: serde_json::Error) -> Self {
        Self::Data(error)
    }
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot draw the figure: {}; this is a fault of the program", self.source)
    }
}

impl std::error::Error for DrawError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.source)
    }
}

impl From<DrawingAreaErrorKind<io::Error>> for DrawError {
    fn from(source: DrawingAreaErrorKind<io::Error>) -> Self {
        Self { source }
    }
}
