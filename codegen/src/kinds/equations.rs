//! Where the paper states the quantities of a body. A device that is a special case of the DGVSCMG
//! cites the equations that it is a special case of.

/// Equation numbers of a body's quantities.
#[derive(Clone, Copy, Debug)]
pub struct Equations {
    /// Angular velocity.
    pub omega: &'static str,
    /// Second derivative of the centre of mass, seen from B.
    pub r_dprime: &'static str,
    /// Derivative of the inertia about the body's own centre of mass.
    pub i_prime: &'static str,
    /// Inertia about B.
    pub i_b: &'static str,
    /// Its derivative.
    pub i_b_prime: &'static str,
    /// Motor torque across the body's joint.
    pub torque: &'static str,
    /// Inertial second derivative of the centre of mass from B.
    pub r_ddot: &'static str,
    /// Angular momentum about B.
    pub h: &'static str,
    /// Its inertial derivative.
    pub h_dot: &'static str,
    /// Mass and first moment of this body and all outboard of it; for the tip, the body itself.
    pub assembly: &'static str,
    /// Torque on them about the joint's origin.
    pub about_origin: &'static str,
    /// The same by components: what the motor exerts and what the structure bears.
    pub across: &'static str,
}

impl Equations {
    /// No numbers: what the emitted text and the proofs say where nothing states a quantity.
    pub const NONE: Self = Self {
        omega: "(none)",
        r_dprime: "(none)",
        i_prime: "(none)",
        i_b: "(none)",
        i_b_prime: "(none)",
        torque: "(none)",
        r_ddot: "(none)",
        h: "(none)",
        h_dot: "(none)",
        assembly: "(none)",
        about_origin: "(none)",
        across: "(none)",
    };
}

/// The outer gimbal: a body with its centre of mass anywhere, on a joint of the hub.
pub(super) const OUTER_GIMBAL: Equations = Equations {
    omega: "(31)",
    r_dprime: "(12)",
    i_prime: "(36)",
    i_b: "(40)",
    i_b_prime: "(42)",
    torque: "(80)",
    r_ddot: "(38)",
    h: "(33)",
    h_dot: "(34)",
    assembly: "(89)",
    about_origin: "(78)",
    across: "(77)",
};

/// The inner gimbal.
pub(super) const INNER_GIMBAL: Equations = Equations {
    omega: "(44)",
    r_dprime: "(13)",
    i_prime: "(49)-(52)",
    i_b: "(55)",
    i_b_prime: "(57)",
    torque: "(101)",
    r_ddot: "(53)",
    h: "(46)",
    h_dot: "(47)",
    assembly: "(108)",
    about_origin: "(99)",
    across: "(98)",
};

/// The wheel.
pub(super) const WHEEL: Equations = Equations {
    omega: "(59)",
    r_dprime: "(14)",
    i_prime: "(64)",
    i_b: "(71)",
    i_b_prime: "(73)",
    torque: "(119)",
    r_ddot: "(69)",
    h: "(61)",
    h_dot: "(62)",
    assembly: "(63)",
    about_origin: "(117)",
    across: "(116)",
};
