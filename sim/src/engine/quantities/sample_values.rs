//! [`SampleValues`]: the numbers of a sample. Only what the columns need is computed: no accelerations, no
//! loads, no momenta where no column shows them.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use precess_control::rotation::{inverse, product, to_vector};
use precess_dynamics::kind::Each;
use precess_dynamics::{
    About, Attitude, JointStates, ListedModes, ModalPoint, Mode, Momentum, Mrp, PointAcceleration,
    PointMotion, Quaternion, SolveError,
};

use super::control::ControlSample;
use super::drift::energies;
use super::member_loads::MemberLoads;
use crate::disturbance::Six;
use crate::engine::equations::points::{
    Accelerations, PointMotion as BodyPointMotion, point_motion,
};
use crate::engine::equations::system::System;
use crate::engine::integration::Moment;
use crate::record::columns::{Columns, Quantity, Source};
use crate::scenario::{BodyPoint, BuiltGuidance, OrbitalFrame, Scenario, roll_pitch_yaw};
use precess_craft::{CraftInputs, CraftState};

/// The numbers of a sample, and what has to be computed for them.
#[expect(clippy::struct_excessive_bools, reason = "each is computed or not, independently")]
pub(crate) struct SampleValues {
    quantities: Vec<Quantity>,
    numbers: Vec<f64>,
    accelerations: bool,
    torques: bool,
    loads: bool,
    energy: bool,
    momentum: bool,
    centre_momentum: bool,
    disturbances: bool,
    orbit: bool,
    inputs: Option<CraftInputs>,
    /// The attitude that rotations are from.
    reference: Quaternion,
    /// The recorded points of the structure.
    points: Vec<Point>,
    /// Those of bodies; none where no column shows them.
    body_points: Vec<BodyPoint>,
    /// References of controllers; none where no column shows what these do.
    guidance: Vec<BuiltGuidance>,
}

/// A recorded point of the structure, and what is computed of it.
struct Point {
    place: ModalPoint<ListedModes>,
    moves: bool,
    accelerates: bool,
    motion: Option<PointMotion>,
    acceleration: Option<PointAcceleration>,
}

/// What is computed of a sample.
struct Computed<'a> {
    moment: &'a Moment,
    turns: &'a [f64],
    time: f64,
    lost: f64,
    energy: f64,
    mrp: Mrp,
    /// Rotation vector from the reference.
    rotation: [f64; 3],
    /// Roll, pitch and yaw, and angular velocity, from the orbital frame.
    orbit: Option<([f64; 3], Vector3<f64>)>,
    momentum: Option<Momentum>,
    /// Angular momentum about the centre of mass, N axes.
    centre_momentum: Option<Vector3<f64>>,
    /// Coordinate and rate of each joint, whole turns taken off.
    joints: Vec<[f64; 2]>,
    accelerations: Option<Accelerations>,
    /// Torques of motor and friction of each joint.
    torques: Option<Vec<[f64; 2]>>,
    loads: Option<MemberLoads>,
    points: &'a [Point],
    body_points: Vec<BodyPointMotion>,
    /// Force and moment of each disturbance.
    disturbances: Vec<Six<f64>>,
    controls: Vec<ControlSample>,
    system: &'a System<'a>,
}

impl SampleValues {
    pub(crate) fn new(scenario: &Scenario, columns: Columns) -> Self {
        let quantities: Vec<_> = columns.into_iter().map(|column| column.quantity).collect();
        let any = |source| quantities.iter().any(|quantity| quantity.source() == source);
        let of_points = scenario.structure.iter().flat_map(|structure| {
            let node = |point: &crate::scenario::RecordedPoint| structure.nodes.get(point.node);
            structure.points.iter().filter_map(node)
        });
        let points = of_points.enumerate().map(|(index, node)| Point {
            place: node.point(),
            moves: any(Source::PointMotion(index)),
            accelerates: any(Source::PointAcceleration(index)),
            motion: None,
            acceleration: None,
        });
        let points = points.collect();
        let of_bodies = quantities.iter().any(|quantity| {
            matches!(
                quantity,
                Quantity::BodyPointPosition(..)
                    | Quantity::BodyPointVelocity(..)
                    | Quantity::BodyPointAcceleration(..)
            )
        });
        Self {
            numbers: vec![0.0; quantities.len()],
            accelerations: quantities.iter().any(Quantity::is_acceleration),
            torques: any(Source::Motors),
            loads: any(Source::Loads),
            energy: any(Source::Energy),
            momentum: any(Source::Momentum),
            centre_momentum: any(Source::CentreMomentum),
            disturbances: any(Source::Disturbances),
            orbit: quantities
                .iter()
                .any(|of| matches!(of, Quantity::OrbitAngle(_) | Quantity::OrbitOmega(_))),
            inputs: None,
            reference: scenario.reference,
            points,
            body_points: if of_bodies { scenario.points.clone() } else { Vec::new() },
            guidance: if any(Source::Control) {
                // Of a checked scenario each is.
                scenario.controllers.iter().filter_map(|of| of.reference.built().ok()).collect()
            } else {
                Vec::new()
            },
            quantities,
        }
    }

    /// The numbers at a time, with inputs held from another.
    pub(crate) fn fill(
        &mut self,
        system: &System<'_>,
        [time, held_from]: [f64; 2],
        moment: &Moment,
        turns: &[f64],
        lost: f64,
    ) -> Result<&[f64], SolveError> {
        let state = &moment.state;
        let mut found = None;
        let mut loads = None;
        let mut inputs = None;
        if self.accelerations || self.torques || self.loads {
            let filled = self.inputs.get_or_insert_with(|| system.inputs(held_from, state));
            system.acting.fill(held_from, state, filled);
            let computed = |mode| mode != Mode::Driven;
            let needs_loads = self.loads || (self.torques && filled.modes.values().any(computed));
            if self.accelerations || needs_loads {
                found = Some(system.craft.accelerations(state, filled)?);
                system.count(1);
            }
            if let (true, Some(found)) = (needs_loads, &found) {
                let of = system.craft.loads(state, filled, found)?;
                let chains = system.acting.chains();
                loads = Some(MemberLoads::new(&of, chains));
            }
            inputs = Some(&*filled);
        }
        let evaluated = inputs.zip(found.as_ref());
        let (energy, known) = if self.energy {
            let ([kinetic, potential], momentum) = energies(system, time, state, evaluated)?;
            (kinetic + potential, momentum)
        } else {
            (f64::NAN, None)
        };
        let momentum = match known {
            None if self.momentum => Some(system.craft.momentum(state, About::InertialOrigin)?),
            known => known,
        };
        let centre_momentum = if self.centre_momentum {
            // The same with B at rest: no difference of momenta of the orbit.
            let mut still = state.clone();
            still.r_b_n_dot = Vector3::zeros();
            Some(system.craft.momentum(&still, About::CentreOfMass)?.angular)
        } else {
            None
        };
        let craft = system.craft.structure();
        for point in &mut self.points {
            if point.moves {
                point.motion = Some(craft.point_motion(&point.place, state)?);
            }
            if let (true, Some(found)) = (point.accelerates, &found) {
                point.acceleration = Some(craft.point_acceleration(&point.place, state, found)?);
            }
        }
        let joints: Vec<_> = state.devices.states().collect();
        let accelerations = found.map(|found| Accelerations {
            b: found.r_b_n_ddot,
            omega_dot: found.omega_dot,
            joints: found.devices.values().collect(),
        });
        let chains = system.acting.chains();
        let body_points = self.body_points.iter();
        let body_points = body_points
            .map(|point| point_motion(point, chains, state, &joints, accelerations.as_ref()));
        let body_points = body_points.collect();
        let computed = Computed {
            moment,
            turns,
            time,
            lost,
            energy,
            mrp: Mrp::from(state.attitude),
            orbit: self.orbit.then(|| in_orbit(state)).flatten(),
            rotation: to_vector(&product(&inverse(&self.reference), &state.attitude)).into(),
            momentum,
            centre_momentum,
            joints,
            accelerations,
            torques: inputs.map(|of| torques(system, held_from, state, (of, loads.as_ref()))),
            loads,
            points: &self.points,
            body_points,
            disturbances: if self.disturbances {
                system.acting.disturbances(held_from, state)
            } else {
                Vec::new()
            },
            controls: self
                .guidance
                .iter()
                .map(|guidance| ControlSample::new(guidance, time, state))
                .collect(),
            system,
        };
        for (number, quantity) in self.numbers.iter_mut().zip(&self.quantities) {
            *number = computed.number(*quantity);
        }
        Ok(&self.numbers)
    }
}

impl Computed<'_> {
    /// One number; NaN of what was not computed, which no column shows.
    fn number(&self, quantity: Quantity) -> f64 {
        let Moment { state, integrals: [work, _] } = self.moment;
        let motion = |point: usize| self.points.get(point).and_then(|point| point.motion.as_ref());
        let joint = |joint: usize| {
            let turns = self.turns.get(joint).copied().unwrap_or_default();
            let [coordinate, rate] = self.joints.get(joint).copied().unwrap_or([f64::NAN; 2]);
            [coordinate + turns * TAU, rate]
        };
        let of_body = |point: usize| self.body_points.get(point);
        let torques = |joint: usize| self.torques.as_ref().and_then(|all| all.get(joint)).copied();
        let loads = self.loads.as_ref();
        let q = state.attitude;
        let known = match quantity {
            Quantity::Time => Some(self.time),
            Quantity::Position(axis) => Some(state.r_b_n[axis]),
            Quantity::Velocity(axis) => Some(state.r_b_n_dot[axis]),
            Quantity::Quaternion(index) => Some(numbers(&q)[index]),
            Quantity::Sigma(axis) => Some(self.mrp.0[axis]),
            Quantity::HubRotation(axis) => Some(self.rotation[axis]),
            Quantity::EulerAngle(index) => Some(roll_pitch_yaw(&q.dcm())[index]),
            Quantity::OrbitAngle(index) => self.orbit.map(|(angles, _)| angles[index]),
            Quantity::OrbitOmega(axis) => self.orbit.map(|(_, omega)| omega[axis]),
            Quantity::Omega(axis) => Some(state.omega[axis]),
            Quantity::Coordinate(index) => Some(joint(index)[0]),
            Quantity::Rate(index) => Some(joint(index)[1]),
            Quantity::Energy => Some(self.energy),
            Quantity::Work => Some(*work),
            Quantity::Lost => Some(self.lost),
            Quantity::Linear(axis) => self.momentum.map(|momentum| momentum.linear[axis]),
            Quantity::Angular(axis) => self.momentum.map(|momentum| momentum.angular[axis]),
            Quantity::CentreMomentum(axis) => self.centre_momentum.map(|angular| angular[axis]),
            Quantity::HubAcceleration(axis) => self
                .accelerations
                .as_ref()
                .map(|found| state.attitude.dcm().column(axis).dot(&found.b)),
            Quantity::OmegaDot(axis) => {
                self.accelerations.as_ref().map(|found| found.omega_dot[axis])
            }
            Quantity::JointAcceleration(joint) => {
                self.accelerations.as_ref().and_then(|found| found.joints.get(joint).copied())
            }
            Quantity::Torque(joint) => torques(joint).map(|[motor, _]| motor),
            Quantity::Friction(joint) => torques(joint).map(|[_, friction]| friction),
            Quantity::MountForce(..)
            | Quantity::MountMoment(..)
            | Quantity::CarriedForce(..)
            | Quantity::CarriedMoment(..)
            | Quantity::LoadForce(..)
            | Quantity::LoadMoment(..) => loads.and_then(|loads| loads.number(quantity)),
            Quantity::Disturbance(source, component) => {
                self.disturbances.get(source).and_then(|of| of.get(component).copied())
            }
            Quantity::Control(controller, quantity) => {
                let control = self.controls.get(controller);
                control.and_then(|control| control.number(self.system, controller, quantity))
            }
            Quantity::ModalCoordinate(mode) => state.modal.eta.get(mode).copied(),
            Quantity::ModalRate(mode) => state.modal.eta_dot.get(mode).copied(),
            Quantity::Displacement(point, axis) => motion(point).map(|m| m.displacement[axis]),
            Quantity::Rotation(point, axis) => motion(point).map(|m| m.rotation[axis]),
            Quantity::PointOmega(point, axis) => motion(point).map(|m| m.omega[axis]),
            Quantity::PointSigma(point, axis) => motion(point).map(|m| pointing(&q, m).0[axis]),
            Quantity::PointAcceleration(point, axis) => {
                let acceleration = self.points.get(point).and_then(|point| point.acceleration);
                acceleration.map(|found| found.acceleration[axis])
            }
            Quantity::BodyPointPosition(point, axis) => of_body(point).map(|of| of.position[axis]),
            Quantity::BodyPointVelocity(point, axis) => of_body(point).map(|of| of.velocity[axis]),
            Quantity::BodyPointAcceleration(point, axis) => {
                of_body(point).map(|of| of.acceleration[axis])
            }
        };
        known.unwrap_or(f64::NAN)
    }
}

/// Torques of motor and friction of each joint: of the motor what the motion requires where that is prescribed.
fn torques(
    system: &System<'_>,
    time: f64,
    state: &CraftState,
    (inputs, loads): (&CraftInputs, Option<&MemberLoads>),
) -> Vec<[f64; 2]> {
    let joints = inputs.motors.values().zip(inputs.modes.values()).enumerate();
    let total = |(joint, (motor, mode)): (usize, (f64, Mode))| {
        let needed = loads.filter(|_| mode != Mode::Driven);
        needed.and_then(|loads| loads.motors.get(joint).copied()).unwrap_or(motor)
    };
    let totals: Vec<_> = joints.map(total).collect();
    system
        .acting
        .friction
        .split(&totals, state, |joint| system.acting.motor_of_profile(joint, time))
}

/// The attitude of a point's axes with respect to N: that of B, then the rotation vector in B.
fn pointing(b: &Quaternion, motion: &PointMotion) -> Mrp {
    let angle = motion.rotation.norm();
    let (sin, cos) = precess_dynamics::Angle::sin_cos(0.5 * angle);
    let axis = if angle > 0.0 { motion.rotation / angle } else { motion.rotation };
    let (v, w) = (sin * axis, Vector3::new(b.q1, b.q2, b.q3));
    // q_PN of the turn q_PB after q_BN, scalar first.
    let q0 = b.q0 * cos - w.dot(&v);
    let [q1, q2, q3] = (b.q0 * v + cos * w + w.cross(&v)).into();
    Mrp::from(Quaternion { q0, q1, q2, q3 }.normalised())
}

fn numbers(q: &Quaternion) -> [f64; 4] {
    [q.q0, q.q1, q.q2, q.q3]
}

/// Roll, pitch and yaw of B, and its angular velocity, from the orbital frame; none where there is no orbit.
fn in_orbit(state: &CraftState) -> Option<([f64; 3], Vector3<f64>)> {
    let frame = OrbitalFrame::new(&state.r_b_n, &state.r_b_n_dot)?;
    let bn = state.attitude.dcm();
    Some((frame.roll_pitch_yaw(&bn), frame.relative(&bn, &state.omega)))
}
