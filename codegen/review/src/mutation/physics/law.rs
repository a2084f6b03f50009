//! [`Law`]: the laws, by [`Kind`], and what each states.

use std::fmt;

/// The three kinds of check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Energy and momenta: balances, and sums over bodies.
    Conservation,
    /// Derivatives against differences, and joints against what is prescribed.
    Differences,
    /// What other engines compute.
    Engines,
}

impl Kind {
    /// In the order of every table.
    pub const ALL: [Self; 3] = [Self::Conservation, Self::Differences, Self::Engines];

    /// The title of its column.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Conservation => "conservation",
            Self::Differences => "differences",
            Self::Engines => "engines",
        }
    }
}

/// One law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Law {
    /// Newton for the whole.
    LinearMomentum,
    /// Euler for the whole.
    AngularMomentum,
    /// Energy less work.
    Energy,
    /// Pivots and diagonals as energies.
    Pivots,
    /// Energy and momenta as sums over the bodies.
    Bodies,
    /// Newton and Euler body by body.
    Forces,
    /// Momentum of the centre of mass.
    CentreOfMass,
    /// What crosses a joint as a change of momentum.
    JointMomentum,
    /// The power that goes into a device.
    JointPower,
    /// The terms that steer.
    Steering,
    /// The power of what acts on the bodies.
    VirtualPower,
    /// What acts on the bodies as a sum.
    Resultants,
    /// A field's work on each body.
    FieldWork,
    /// A field's work on the device.
    FieldPower,
    /// Second moment as a sum over the bodies.
    SecondMoment,
    /// Place of a body's centre of mass.
    Origins,
    /// Velocity of a body.
    Velocity,
    /// Acceleration of a body.
    Acceleration,
    /// Angular velocity of a body.
    Turning,
    /// Inertias' derivatives.
    Inertia,
    /// Derivatives of the first moment.
    FirstMoment,
    /// Momenta as derivatives of the energy.
    Momenta,
    /// Lagrange's equation of each driven joint.
    Lagrange,
    /// Derivatives of the loads.
    LoadDerivatives,
    /// Given accelerations.
    Given,
    /// Axes that stay square and turn.
    Axes,
    /// Accelerations of the engines.
    EngineAccelerations,
    /// Energy and momenta of the engines.
    EngineMomenta,
    /// Bodies of the engines.
    EngineBodies,
    /// First moment of the engines.
    EngineFirstMoment,
}

impl Law {
    /// Every law, by kind.
    pub const ALL: [Self; 30] = [
        Self::LinearMomentum,
        Self::AngularMomentum,
        Self::Energy,
        Self::Pivots,
        Self::Bodies,
        Self::Forces,
        Self::CentreOfMass,
        Self::JointMomentum,
        Self::JointPower,
        Self::Steering,
        Self::VirtualPower,
        Self::Resultants,
        Self::FieldWork,
        Self::FieldPower,
        Self::SecondMoment,
        Self::Origins,
        Self::Velocity,
        Self::Acceleration,
        Self::Turning,
        Self::Inertia,
        Self::FirstMoment,
        Self::Momenta,
        Self::Lagrange,
        Self::LoadDerivatives,
        Self::Given,
        Self::Axes,
        Self::EngineAccelerations,
        Self::EngineMomenta,
        Self::EngineBodies,
        Self::EngineFirstMoment,
    ];

    /// What kind of check it is.
    #[must_use]
    pub fn kind(self) -> Kind {
        match self {
            Self::LinearMomentum
            | Self::AngularMomentum
            | Self::Energy
            | Self::Pivots
            | Self::Bodies
            | Self::Forces
            | Self::CentreOfMass
            | Self::JointMomentum
            | Self::JointPower
            | Self::Steering
            | Self::VirtualPower
            | Self::Resultants
            | Self::FieldWork
            | Self::FieldPower
            | Self::SecondMoment
            | Self::Origins => Kind::Conservation,
            Self::Velocity
            | Self::Acceleration
            | Self::Turning
            | Self::Inertia
            | Self::FirstMoment
            | Self::Momenta
            | Self::Lagrange
            | Self::LoadDerivatives
            | Self::Given
            | Self::Axes => Kind::Differences,
            Self::EngineAccelerations
            | Self::EngineMomenta
            | Self::EngineBodies
            | Self::EngineFirstMoment => Kind::Engines,
        }
    }

    /// What it states.
    #[must_use]
    pub fn statement(self) -> &'static str {
        match self {
            Self::LinearMomentum => "dp/dt = F, for hub and device",
            Self::AngularMomentum => "dH/dt = L_B - v_B × p, about the moving point B",
            Self::Energy => {
                "dE/dt = F · v_B + L_B · ω + Σ u q′; u by Lagrange where q″ is given instead"
            }
            Self::Pivots => {
                "a joint's diagonal is 2E of its motion alone at unit rate, its pivot the least 2E \
                 with the driven joints behind it free"
            }
            Self::Bodies => "E, p and H about B are sums over the bodies' r, r′, ω, [I_B] (König)",
            Self::Forces => "dp/dt and dH/dt are sums over the bodies' r″, [I]′, [I_B]′",
            Self::CentreOfMass => "p and dp/dt from the device's centre of mass",
            Self::JointMomentum => {
                "the loads at a joint are dp/dt and dH/dt of the bodies outside it"
            }
            Self::JointPower => "Σ u q′ + F · v_B + N · ω of the loads is dE/dt of the device",
            Self::Steering => {
                "the terms of `steer` sum to the moment of the loads; the momentum relative to the hub is H at rest"
            }
            Self::VirtualPower => {
                "what acts on the bodies does the work that joints and hub receive: Σ F · v + N · ω"
            }
            Self::Resultants => "what acts on the bodies outside a joint, summed at its origin",
            Self::FieldWork => {
                "a field's work on each body, moved in any way, is the change of G : S / 2, S by [I_B]"
            }
            Self::FieldPower => "a field's work along the motion is the change of G : S / 2",
            Self::SecondMoment => "S is a sum over the bodies' [I_B]",
            Self::Origins => "r of each body is its joint's origin and its centre along its axes",
            Self::Velocity => "r′ is the derivative of r",
            Self::Acceleration => "r″ is the derivative of r′, whatever the joints' accelerations",
            Self::Turning => "ω is the rate at which the body's axes turn",
            Self::Inertia => "[I]′ and [I_B]′ are the derivatives of [I] and [I_B], along B",
            Self::FirstMoment => "m c′ and m c″ are the derivatives of m c and m c′",
            Self::Momenta => "p and H are the derivatives of E by v_B and ω",
            Self::Lagrange => "d/dt ∂E/∂q′ - ∂E/∂q = u, for each joint whose u is given",
            Self::LoadDerivatives => "derivatives of the loads are their differences",
            Self::Given => "q″ is what is given, to the bit, for each joint that is given it",
            Self::Axes => "axes are square and right-handed, and turn at ω",
            Self::EngineAccelerations => "all accelerations, Pinocchio and MuJoCo",
            Self::EngineMomenta => "energy, linear and angular momentum, Pinocchio; energy, MuJoCo",
            Self::EngineBodies => "r, r′, r″, ω and [I_B] of each body, Pinocchio",
            Self::EngineFirstMoment => "Σ m r, Σ m r′, Σ m r″ of Pinocchio's bodies",
        }
    }
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.statement())
    }
}
