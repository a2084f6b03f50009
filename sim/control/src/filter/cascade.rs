//! [`Filter`]: sections one after another.

use alloc::vec::Vec;

use crate::checkpoint::Checkpoint;
use crate::filter::section::Section;

/// Sections of second order, each filtering the output of the one before. Without sections the output is the input.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filter {
    sections: Vec<Section>,
}

impl Filter {
    /// Of sections in their order.
    #[must_use]
    pub fn new(sections: Vec<Section>) -> Self {
        Self { sections }
    }

    /// The sections.
    #[must_use]
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// The output of the next sample.
    pub fn filter(&mut self, input: f64) -> f64 {
        self.sections.iter_mut().fold(input, |signal, section| section.filter(signal))
    }

    /// The state that a constant input leads to; the output then.
    pub fn settle(&mut self, input: f64) -> f64 {
        self.sections.iter_mut().fold(input, |signal, section| section.settle(signal))
    }

    /// At rest.
    pub fn reset(&mut self) {
        self.sections.iter_mut().for_each(Section::reset);
    }

    /// Visits the states of its sections.
    pub fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        for section in &mut self.sections {
            section.visit(checkpoint);
        }
    }
}
