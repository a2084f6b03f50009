//! Outwards along the chain: origin of each joint and axes of its body, expressed in B.

use crate::derivation::chain::{Chain, Link};
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, triple};
use crate::space::{Axis, BodyFrame, Frame, Hub, ParentFrame, Vector, XYZ};

/// Writes the axes of every body and the origin of its joint to `script`.
pub fn axes<'g>(chain: &Chain<'g>, script: &mut Script<'g>) {
    let unit = |axis| Vector::unit(chain.graph, axis);
    let mut here =
        Axes { columns: [Axis::X, Axis::Y, Axis::Z].map(unit), origin: Vector::zero(chain.graph) };
    for (link, data) in chain.links.iter().zip(chain.kind.links) {
        here = here.across(link);
        let (frame, title) = (data.body.frame, data.body.title);
        let letter = data.body.letters[0];
        let whose = if link.turn.is_none() { "parent body of the " } else { "" };
        let heading = Heading::new(format!("Axes of the {whose}{title}")).equation("(D1)");
        script.section("axis", heading.axes("the device's axes").unit("1"));
        for (column, axis) in here.columns.into_iter().zip(XYZ) {
            script.names(pairs(triple(&format!("{frame}_{axis}"), "b"), column.components()));
        }
        let heading = Heading::new(format!("{letter} from B")).equation("(D2)");
        script.section("pos", heading.axes("the device's axes").unit("m"));
        script.names(pairs(triple(&format!("origin_{frame}"), "b"), here.origin.components()));
    }
}

/// Axes and origin of one body.
#[derive(Clone, Copy)]
struct Axes<'g> {
    /// Its axes: the columns of its rotation.
    columns: [Vector<'g, Hub>; 3],
    /// Its joint's origin, from B.
    origin: Vector<'g, Hub>,
}

impl<'g> Axes<'g> {
    /// Across one more joint: two of the axes turn in their plane.
    fn across(self, link: &Link<'g>) -> Self {
        let origin = self.origin + self.along_b(link.origin);
        // All three axes at once, expressed in B: rows of the rotation turn as vectors do.
        let row = |place: usize| {
            let row = self.columns.map(|column| column.components()[place]);
            Vector::<ParentFrame>::new(row).turned::<BodyFrame>(link.turn).components()
        };
        let rows = [0, 1, 2].map(row);
        let columns = [0, 1, 2].map(|axis| Vector::new(rows.map(|row| row[axis])));
        Self { columns, origin }
    }

    /// A vector given along these axes.
    fn along_b<F: Frame>(self, v: Vector<'g, F>) -> Vector<'g, Hub> {
        let [x, y, z] = v.components();
        x * self.columns[0] + y * self.columns[1] + z * self.columns[2]
    }
}
