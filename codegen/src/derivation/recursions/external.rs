//! Applied wrenches on the bodies, summed inwards at the joints and on the hub.

use crate::derivation::chain::Chain;
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::heading::Heading;
use crate::derivation::script::Script;
use crate::graph::Stage;
use crate::kinds;
use crate::space::{BodyFrame, Vector};

/// Writes to `script` the sum of the wrenches on each body and the bodies outboard of it, expressed
/// in own axes, about its joint's origin, and the sum on the hub, about B.
pub fn external<'g>(chain: &Chain<'g>, script: &mut Script<'g>) {
    let mut sum = Wrench::zero(chain.graph);
    let links = chain.links.iter().zip(chain.kind.links);
    for ((link, data), own) in links.zip(acting(chain)).rev() {
        sum = sum.plus(own);
        let (whole, body) = (data.assembly.to_uppercase(), &data.body);
        let what = format!("On {whole}, the {} and the bodies outboard of it", body.title);
        let heading = Heading::new(what).equation("(D14), (D15)");
        script.section("sum", heading.wrench(["N", "N m"], body.letters[0]));
        script.names(sum.named("sum", body.frame));
        sum = sum.in_parent_frame(link);
    }
    script.section("sum", Heading::new("On the hub").equation("(D14)").wrench(["N", "N m"], "B"));
    script.names(sum.named("sum", "b"));
}

/// The symbols of the wrench on each body only: expressed in own axes, about its joint's origin.
#[must_use]
pub fn acting<'g>(chain: &Chain<'g>) -> Vec<Wrench<'g, BodyFrame>> {
    let zero = Wrench::<BodyFrame>::zero(chain.graph);
    let symbols = |link: &kinds::Link| {
        let names: Vec<_> = zero.named("on", link.body.frame);
        let symbol = |place: usize| chain.graph.symbol(&names[place].0, Stage::Rate);
        Wrench {
            force: Vector::new([0, 1, 2].map(symbol)),
            moment: Vector::new([3, 4, 5].map(symbol)),
        }
    };
    chain.kind.links.iter().map(symbols).collect()
}
