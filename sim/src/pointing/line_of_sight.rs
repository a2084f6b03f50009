//! [`LineOfSight`]: two angles of an image by small motions of nodes, `los = sum_k S_k [x_k; theta_k]`.

use nalgebra::{Matrix2x3, RowVector3, Vector2, Vector3};

use super::PointingError;

/// The part of a direction across the boresight that is at least needed of its length.
const ACROSS_MIN: f64 = 1e-6;

/// Optical sensitivities of the nodes of an instrument.
#[derive(Clone, Debug, PartialEq)]
pub struct LineOfSight {
    sensitivities: Vec<Sensitivity>,
}

/// How far the line of sight turns about its two axes by motions of one node, expressed in the axes of the motions.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// The node.
    pub node: String,
    /// By its displacement, rad/m.
    pub displacement: Matrix2x3<f64>,
    /// By its rotation, rad/rad.
    pub rotation: Matrix2x3<f64>,
}

/// A small motion of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodeMotion {
    /// x, m.
    pub displacement: Vector3<f64>,
    /// theta, rad.
    pub rotation: Vector3<f64>,
}

impl LineOfSight {
    /// Of sensitivities, node by node.
    ///
    /// # Errors
    ///
    /// A sensitivity that is not finite, or no node.
    pub fn new(sensitivities: Vec<Sensitivity>) -> Result<Self, PointingError> {
        if sensitivities.is_empty() {
            return Err(PointingError::Nodes { expected: 1, found: 0 });
        }
        for (index, sensitivity) in sensitivities.iter().enumerate() {
            let all = sensitivity.displacement.iter().chain(sensitivity.rotation.iter());
            if let Some(value) = all.copied().find(|value| !value.is_finite()) {
                return Err(PointingError::Number { of: "sensitivity of node", index, value });
            }
        }
        Ok(Self { sensitivities })
    }

    /// Of a rigid instrument on a node: the node's rotation about two axes across the boresight, which with it, in
    /// this order, are right-handed. The first is the part of `across` at right angles to the boresight.
    ///
    /// # Errors
    ///
    /// A boresight without direction, or `across` along it.
    pub fn rigid(
        node: &str,
        boresight: &Vector3<f64>,
        across: &Vector3<f64>,
    ) -> Result<Self, PointingError> {
        let unit = |v: &Vector3<f64>| {
            // By its largest component first: squares of components do not overflow.
            let scaled = v / v.amax();
            let unit = scaled / scaled.norm();
            let is_direction = unit.iter().all(|component| component.is_finite());
            is_direction.then_some(unit).ok_or(PointingError::Boresight([v.x, v.y, v.z]))
        };
        let boresight = unit(boresight)?;
        let given = unit(across)?;
        let part = given - boresight * boresight.dot(&given);
        if part.norm() < ACROSS_MIN {
            return Err(PointingError::Boresight([across.x, across.y, across.z]));
        }
        let first = unit(&part)?;
        let second = boresight.cross(&first);
        let rotation =
            Matrix2x3::from_rows(&[RowVector3::from(first.transpose()), second.transpose()]);
        let (node, displacement) = (node.to_owned(), Matrix2x3::zeros());
        Self::new(vec![Sensitivity { node, displacement, rotation }])
    }

    /// The nodes with their sensitivities, in order.
    #[must_use]
    pub fn sensitivities(&self) -> &[Sensitivity] {
        &self.sensitivities
    }

    /// The two angles, rad, by the motions of the nodes in order.
    ///
    /// # Errors
    ///
    /// Another number of motions than nodes, or an angle that is not finite.
    pub fn angles(&self, motions: &[NodeMotion]) -> Result<Vector2<f64>, PointingError> {
        let (expected, found) = (self.sensitivities.len(), motions.len());
        if expected != found {
            return Err(PointingError::Nodes { expected, found });
        }
        let of = |(s, motion): (&Sensitivity, &NodeMotion)| {
            s.displacement * motion.displacement + s.rotation * motion.rotation
        };
        let angles: Vector2<f64> = self.sensitivities.iter().zip(motions).map(of).sum();
        let wrong = angles.iter().enumerate().find(|(_, angle)| !angle.is_finite());
        wrong.map_or(Ok(angles), |(index, value)| {
            Err(PointingError::Number { of: "angle", index, value: *value })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of a few numbers of size one, rounded.
    const ROUNDING: f64 = 1e-15;

    #[test]
    fn a_rigid_instrument_shows_the_rotation_across_its_boresight_only() {
        let boresight = Vector3::new(0.0, 3.0, 4.0);
        let los = LineOfSight::rigid("hub", &boresight, &Vector3::x()).expect("a line of sight");
        let of = |rotation: Vector3<f64>| {
            let motion = NodeMotion { displacement: Vector3::new(5.0, 6.0, 7.0), rotation };
            los.angles(&[motion]).expect("angles")
        };
        assert!(of(1e-6 * boresight).norm() < ROUNDING);
        assert!((of(Vector3::x()) - Vector2::x()).norm() < ROUNDING);
        // (0, 3, 4) x (1, 0, 0) / 5 = (0, 4, -3) / 5.
        assert!((of(Vector3::new(0.0, 0.8, -0.6)) - Vector2::y()).norm() < ROUNDING);
    }

    #[test]
    fn nodes_add_up() {
        let sensitivity = |node: &str, factor: f64| Sensitivity {
            node: node.to_owned(),
            displacement: Matrix2x3::new(factor, 0.0, 0.0, 0.0, 2.0 * factor, 0.0),
            rotation: Matrix2x3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0),
        };
        let los = LineOfSight::new(vec![sensitivity("m1", 10.0), sensitivity("m2", -4.0)]);
        let los = los.expect("a line of sight");
        let motion = |x: f64, rz: f64| NodeMotion {
            displacement: Vector3::new(x, x, 9.0),
            rotation: Vector3::new(0.0, 0.0, rz),
        };
        let angles = los.angles(&[motion(1.0, 0.5), motion(0.25, 0.0)]).expect("angles");
        assert!((angles - Vector2::new(10.0 + 0.5 - 1.0, 20.0 - 2.0)).norm() < ROUNDING);
        let one = los.angles(&[motion(1.0, 0.5)]).expect_err("a node is missing");
        assert_eq!(one, PointingError::Nodes { expected: 2, found: 1 });
    }

    #[test]
    fn directions_that_are_none_are_rejected() {
        let zero = Vector3::zeros();
        for (boresight, across) in [
            (zero, Vector3::x()),
            (Vector3::x(), Vector3::x()),
            (Vector3::x(), zero),
            (Vector3::new(f64::NAN, 0.0, 0.0), Vector3::y()),
        ] {
            let rejected = LineOfSight::rigid("hub", &boresight, &across);
            assert!(matches!(rejected, Err(PointingError::Boresight(_))));
        }
        assert!(LineOfSight::new(Vec::new()).is_err());
        assert!(LineOfSight::rigid("hub", &Vector3::new(1e300, 0.0, 0.0), &Vector3::y()).is_ok());
    }
}
