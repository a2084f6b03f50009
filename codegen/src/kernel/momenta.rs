//! The kernel `energy_momentum`.

use super::eliminate::claims;
use super::function::inputs;
use super::{Kernel, records};
use crate::derivation::chain::Chain;
use crate::derivation::chain::motion::Observer;
use crate::derivation::heading::Heading;
use crate::derivation::recursions::composite;
use crate::derivation::reference;
use crate::derivation::script::{Script, pairs, triple};

/// Kinetic energy and momenta of one device.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let kind = chain.kind;
    let mut script = Script::new(chain.graph);
    let momenta = composite::momenta(chain, &Observer::inertial(chain), &mut script);
    let heading = Heading::new("Kinetic energy and momenta of the device");
    let heading = heading.cited("as in", "(20)").axes("the device's axes").part("energy", "J");
    let heading = heading.part("linear momentum", "kg m/s");
    script.section("sum", heading.part("angular momentum", "kg m²/s").about("B"));
    script.name("energy", momenta.energy);
    script.names(pairs(triple("linear", "b"), momenta.linear.components()));
    script.names(pairs(triple("angular_b", "b"), momenta.angular.components()));
    Kernel {
        name: "energy_momentum".to_owned(),
        doc: vec!["Kinetic energy, linear momentum and angular momentum about B (20).".to_owned()],
        inputs: inputs(kind, [("b", records::body_velocity())]),
        sections: script.sections,
        output: records::energy_momentum(),
        hoisted: true,
        claims: claims(kind, reference::momenta(chain).named()),
    }
}
