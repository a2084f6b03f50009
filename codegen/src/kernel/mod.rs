//! Kernels: the functions to be emitted, as named statements in sections over input records.

mod axes;
mod back_substitute;
mod constant_share;
mod eliminate;
mod external;
mod gravity;
mod kinematics;
mod loads;
mod momenta;
mod parameters;
mod records;

pub use parameters::{parameters, parameters_of};
pub use records::{
    Field, Record, Source, joint_accelerations, modes, motors, pose, rates, shared_records,
    wrenches,
};

use crate::derivation::chain::{Chain, XYZ};
use crate::derivation::script::{Section, pairs, triple};
use crate::derivation::wrench::Wrench;
use crate::graph::{Expr, Node};
use crate::kinds::{Kind, Link, Motion};
use crate::space::{Frame, Vector};

/// One function to be emitted.
pub struct Kernel<'g> {
    /// Its name.
    pub name: String,
    /// Its documentation, line by line.
    pub doc: Vec<String>,
    /// Argument letters and their records.
    pub inputs: Vec<(&'static str, Record)>,
    /// What it computes, section by section.
    pub sections: Vec<Section<'g>>,
    /// The record it returns.
    pub output: Record,
    /// What its named values must be equal to.
    pub claims: Vec<Claim<'g>>,
}

impl<'g> Kernel<'g> {
    /// Names of what is a symbol or a constant by itself: written in place, without a name.
    pub fn plain(&self) -> impl Iterator<Item = (String, Expr<'g>)> {
        let statements = self.sections.iter().flat_map(|section| &section.statements);
        let plain = statements.filter(|statement| {
            let leaf = matches!(statement.value.node(), Node::Symbol(_) | Node::Constant(_));
            leaf && statement.cut.is_none()
        });
        plain.map(|statement| (statement.name.clone(), statement.value))
    }
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

impl<'g> Claim<'g> {
    /// Three components of a vector.
    fn vector<F: Frame>(tag: &str, stem: &str, frame: &str, v: Vector<'g, F>) -> Self {
        let components = pairs(triple(stem, frame), v.components()).collect();
        Self { tag: tag.to_owned(), name: stem.to_owned(), components }
    }

    /// Force and moment, by their equations: `f_load_gox`, `n_load_gox`.
    fn wrench<F: Frame>(
        [force, moment]: [&str; 2],
        what: &str,
        frame: &str,
        wrench: Wrench<'g, F>,
    ) -> [Self; 2] {
        [('f', force, wrench.force), ('n', moment, wrench.moment)]
            .map(|(letter, tag, v)| Self::vector(tag, &format!("{letter}_{what}"), frame, v))
    }

    /// The component of the wrench `what` along a link's joint: of its moment where the joint
    /// turns, of its force where it slides.
    fn along_joint([tag, name, what]: [&str; 3], link: &Link, value: Expr<'g>) -> Self {
        let letter = match link.joint.motion {
            Motion::Turn(_) => "n",
            Motion::Slide(_) => "f",
        };
        let (frame, axis) = (link.body.frame, XYZ[link.joint.motion.axis().cycle()[0]]);
        let components = vec![(format!("{letter}_{what}_{frame}{axis}"), value)];
        Self { tag: tag.to_owned(), name: name.to_owned(), components }
    }
}

/// Every kernel of a chain, in the order of the emitted file; where something is assumed of the
/// parameters, those of an evaluation; where every joint stands, the constant share of the hub.
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
    list.push(external::kernel(chain));
    list.push(gravity::kernel(chain));
    list
}

/// Constants, pose and rates, which every kernel of motion takes, and what `more` it needs.
fn inputs(
    kind: &Kind,
    more: impl IntoIterator<Item = (&'static str, Record)>,
) -> Vec<(&'static str, Record)> {
    let mut list = records::placed(kind);
    list.push(("v", rates(kind)));
    list.extend(more);
    list
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
