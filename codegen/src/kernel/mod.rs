//! Kernels: the functions to be emitted, as named statements in sections over input records.

mod back_substitute;
mod eliminate;
mod kinematics;
mod momenta;
mod records;

pub use records::{
    Field, Record, Source, joint_accelerations, motors, parameters, rates, shared_records, trig,
};

use crate::derivation::chain::Chain;
use crate::derivation::script::Section;
use crate::graph::Expr;

/// One function to be emitted.
pub struct Kernel<'g> {
    /// Its name.
    pub name: String,
    /// Its documentation, line by line.
    pub doc: Vec<String>,
    /// Argument letters and the records behind them.
    pub inputs: Vec<(&'static str, Record)>,
    /// What it computes, section by section.
    pub sections: Vec<Section<'g>>,
    /// The record it returns.
    pub output: Record,
    /// What its named values must be equal to.
    pub claims: Vec<Claim<'g>>,
}

/// Emitted names and what they must be equal to, by another way than they are computed.
#[derive(Clone, Debug)]
pub struct Claim<'g> {
    /// The paper's number.
    pub tag: String,
    /// The quantity.
    pub name: String,
    /// Emitted name and reference of each component.
    pub components: Vec<(String, Expr<'g>)>,
}

/// Every kernel of a chain, in the order of the emitted file.
#[must_use]
pub fn kernels<'g>(chain: &Chain<'g>) -> Vec<Kernel<'g>> {
    let mut list = kinematics::kernels(chain);
    let (kernel, eliminated) = eliminate::kernel(chain);
    let back = back_substitute::kernel(chain, &eliminated, kernel.output.clone());
    list.extend([kernel, back]);
    list.push(momenta::kernel(chain));
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::kinds::KINDS;

    #[test]
    fn every_section_names_its_equation() {
        for kind in KINDS {
            let graph = Graph::new();
            for kernel in kernels(&Chain::new(&graph, kind)) {
                for section in kernel.sections.iter().filter(|s| !s.statements.is_empty()) {
                    let named = ["eq. (", "eqs. ("].iter().any(|name| section.title.contains(name));
                    assert!(named, "{}: {}", kernel.name, section.title);
                }
            }
        }
    }
}
