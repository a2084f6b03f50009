//! Flexible bearings as they are built, for suites that draw spacecraft: a rotor that yields by its clearance,
//! on springs that hold it.

use precess_dynamics::Passive;
use precess_dynamics::kind::JointInfo;

use crate::random::Random;

/// How far a bearing yields and how fast, m and m/s or rad and rad/s: a slide or a tilt of the rotor in its
/// housing. None of another joint.
#[must_use]
pub fn clearance(info: &JointInfo) -> Option<[f64; 2]> {
    let is_bearing = ["slide", "tilt"].iter().any(|motion| info.body.contains(motion));
    is_bearing.then_some(if info.slides { [5e-3, 0.1] } else { [0.1, 1.5] })
}

/// Springs, dampers and friction of a joint at random. A bearing holds its rotor.
pub fn sprung(random: &mut Random, info: &JointInfo) -> Passive {
    let (softest, stiffest, rest) = match (clearance(info), info.slides) {
        (None, _) => (0.0, 10.0, 1.0),
        (Some([farthest, _]), true) => (1e2, 1e4, farthest),
        (Some([farthest, _]), false) => (1.0, 1e2, farthest),
    };
    Passive {
        stiffness: random.within(softest, stiffest),
        rest: random.within(-rest, rest),
        viscous: random.within(0.0, 0.1),
        coulomb: random.within(0.0, 1.0),
        coulomb_rate: random.log_within(1e-3, 1.0),
    }
}
