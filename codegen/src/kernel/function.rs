//! [`Kernel`]: one function to be emitted, and the [`Claim`]s that its names have to prove.

use super::records::{Record, placed, rates};
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::script::{Section, pairs, triple};
use crate::graph::{Expr, Node};
use crate::kinds::{Kind, Link, Motion};
use crate::space::{Frame, Vector, XYZ};

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
    /// Whether `prepare` computes what it needs of the parameters only: not for what no evaluation calls, so that a
    /// spacecraft is not larger for it.
    pub hoisted: bool,
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
    pub(super) fn vector<F: Frame>(tag: &str, stem: &str, frame: &str, v: Vector<'g, F>) -> Self {
        let components = pairs(triple(stem, frame), v.components()).collect();
        Self { tag: tag.to_owned(), name: stem.to_owned(), components }
    }

    /// Force and moment, by their equations: `f_load_gox`, `n_load_gox`.
    pub(super) fn wrench<F: Frame>(
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
    pub(super) fn along_joint([tag, name, what]: [&str; 3], link: &Link, value: Expr<'g>) -> Self {
        let components = vec![(along_joint(what, link), value)];
        Self { tag: tag.to_owned(), name: name.to_owned(), components }
    }
}

/// The name of the component of the wrench `what` along a link's joint.
pub(super) fn along_joint(what: &str, link: &Link) -> String {
    let letter = match link.joint.motion {
        Motion::Turn(_) => "n",
        Motion::Slide(_) => "f",
    };
    let (frame, axis) = (link.body.frame, XYZ[link.joint.motion.axis().cycle()[0]]);
    format!("{letter}_{what}_{frame}{axis}")
}

/// Constants, pose and rates, which every kernel of motion takes, and what `more` it needs.
pub(super) fn inputs(
    kind: &Kind,
    more: impl IntoIterator<Item = (&'static str, Record)>,
) -> Vec<(&'static str, Record)> {
    let mut list = placed(kind);
    list.push(("v", rates(kind)));
    list.extend(more);
    list
}
