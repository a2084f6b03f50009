//! The hub with the constant shares of its devices, as one rigid body.

/// Mass properties about B, along the axes of B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RigidBody<T = f64> {
    /// Mass, kg.
    pub(crate) mass: T,
    /// First moment, kg m.
    pub(crate) first_moment: [T; 3],
    /// Inertia, entries 11, 12, 13, 22, 23, 33, kg m².
    pub(crate) inertia: [T; 6],
}

impl RigidBody {
    /// Of a mass, its centre from B, and the inertia about that.
    pub(crate) fn new(mass: f64, r: [f64; 3], i: &[[f64; 3]; 3]) -> Self {
        let m = r.map(|x| mass * x);
        let inertia = [
            i[0][0] + (m[1] * r[1] + m[2] * r[2]),
            i[0][1] - m[0] * r[1],
            i[0][2] - m[0] * r[2],
            i[1][1] + (m[0] * r[0] + m[2] * r[2]),
            i[1][2] - m[1] * r[2],
            i[2][2] + (m[0] * r[0] + m[1] * r[1]),
        ];
        Self { mass, first_moment: m, inertia }
    }

    /// Adds what a device adds whatever its joints do.
    pub(crate) fn add(&mut self, share: &Self) {
        self.mass += share.mass;
        for (to, share) in self.first_moment.iter_mut().zip(share.first_moment) {
            *to += share;
        }
        for (to, share) in self.inertia.iter_mut().zip(share.inertia) {
            *to += share;
        }
    }
}
