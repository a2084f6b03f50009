//! Kernels: the functions to be emitted, as named statements in sections over input records.

mod axes;
mod back_substitute;
mod constant_share;
mod eliminate;
mod external;
mod function;
mod gravity;
mod kinematics;
mod load_derivatives;
mod loads;
mod momenta;
mod parameters;
mod records;
mod steer;

pub use function::{Claim, Kernel};
pub use parameters::{parameters, parameters_of};
pub use records::{
    Field, Record, Source, joint_accelerations, modes, motors, pose, rates, shared_records,
    wrenches,
};

use crate::derivation::chain::Chain;

/// Every kernel of a chain, in the order of the emitted file; where something is assumed of the
/// parameters, those of an evaluation; where every joint is locked, the constant share of the hub.
#[must_use]
pub fn kernels<'g>(chain: &Chain<'g>) -> Vec<Kernel<'g>> {
    if chain.is_rigid() {
        return vec![constant_share::kernel(chain)];
    }
    let mut list = if chain.assumed.is_none() { kinematics::kernels(chain) } else { Vec::new() };
    let (kernel, eliminated, gains) = eliminate::kernel(chain);
    let back = back_substitute::kernel(chain, &eliminated, gains);
    list.extend([constant_share::kernel(chain), kernel, back]);
    if chain.assumed.is_some() {
        return list;
    }
    list.push(momenta::kernel(chain));
    list.push(axes::kernel(chain));
    list.push(loads::kernel(chain));
    list.push(load_derivatives::kernel(chain));
    list.push(steer::kernel(chain));
    list.push(external::kernel(chain));
    list.push(gravity::kernel(chain));
    list
}

/// `eliminate` of a chain by itself.
pub(crate) fn elimination<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    eliminate::kernel(chain).0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::kinds::{Equations, KINDS, Link};

    /// A kind whose bodies cite no equation is not in the paper, and its sections need none.
    #[test]
    fn every_section_of_a_kind_in_the_paper_names_its_equation() {
        let cites = |link: &Link| link.body.equations.omega != Equations::NONE.omega;
        let in_paper: Vec<_> =
            KINDS.iter().filter(|kind| kind.links.iter().all(cites)).copied().collect();
        assert_eq!(in_paper.len(), 12, "all but the two with flexible bearings");
        for kind in in_paper {
            let graph = Graph::new();
            for kernel in kernels(&Chain::new(&graph, kind)) {
                for section in kernel.sections.iter().filter(|s| !s.statements.is_empty()) {
                    let named = !section.heading.equations().is_empty();
                    assert!(named, "{}: {}", kernel.name, section.heading);
                }
            }
        }
    }
}
