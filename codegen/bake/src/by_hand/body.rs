//! What the spacecraft is made of, and what the pivots of its joints are checked against. SI units.

/// The hub.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hub {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass from B, B axes, m.
    pub centre_of_mass: [f64; 3],
    /// Inertia about the centre of mass, B axes, kg m².
    pub inertia: [[f64; 3]; 3],
}

/// A body of a device, and the joint that it moves on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Mass, kg.
    pub mass: f64,
    /// Origin of the joint from the origin of the parent body, expressed in the parent body's axes,
    /// m; of the first joint from B, expressed in B.
    pub origin: [f64; 3],
    /// Centre of mass from the joint's origin, own axes, m.
    pub centre_of_mass: [f64; 3],
    /// Inertia about the centre of mass, own axes, kg m².
    pub inertia: [[f64; 3]; 3],
}

/// How a joint moves, by the axis (0, 1, 2) of its parent body.
#[derive(Clone, Copy)]
pub(crate) struct Joint {
    pub(crate) axis: usize,
    pub(crate) slides: bool,
}

/// Mass or inertia outboard of a joint, in the pose that makes the most of it: what its pivot is
/// checked against.
pub(crate) fn outboard(bodies: &[Body], joints: &[Joint], joint: usize) -> f64 {
    let Some(own) = joints.get(joint) else { return 0.0 };
    let (mut sum, mut arm) = (0.0, 0.0);
    // Whether a body turns only about the joint's axis, in any pose.
    let mut parallel = true;
    for (index, (body, info)) in bodies.iter().zip(joints).enumerate().skip(joint) {
        if own.slides {
            sum += body.mass;
            continue;
        }
        if index > joint {
            arm += lever(body.origin, own.axis, parallel);
            parallel = parallel && (info.slides || info.axis == own.axis);
        }
        let [x, y, z] = [0, 1, 2].map(|k| body.inertia[k][k].abs());
        let moment = match own.axis {
            _ if !parallel => x + y + z,
            0 => x,
            1 => y,
            _ => z,
        };
        let reach = arm + lever(body.centre_of_mass, own.axis, parallel);
        sum += moment + body.mass * reach * reach;
    }
    sum
}

/// Length of an offset; where it keeps its angle with the axis, of what it has across it.
fn lever([x, y, z]: [f64; 3], axis: usize, parallel: bool) -> f64 {
    let [x, y, z] = match axis {
        _ if !parallel => [x, y, z],
        0 => [0.0, y, z],
        1 => [x, 0.0, z],
        _ => [x, y, 0.0],
    };
    square_root(x * x + y * y + z * z)
}

/// By Newton's method from above; of zero, zero.
fn square_root(x: f64) -> f64 {
    // Half the exponent, to a tenth; each step then doubles the digits.
    let mut root = f64::from_bits((x.to_bits() >> 1) + (1023_u64 << 51));
    for _ in 0..5 {
        root = 0.5 * (root + x / root);
    }
    if x > 0.0 { root } else { 0.0 }
}
