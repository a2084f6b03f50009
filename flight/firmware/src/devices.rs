//! A device of each kind, drawn at random: physical bodies, off centre, out of balance, with
//! springs.

use nalgebra::{Matrix6, Vector6};
use precess_dynamics::kind::Kind;
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Coupled,
    Dgcmg, Dgvscmg, FixedSet, FlexibleReactionWheel, FlexibleVscmg, HingedPanel, ImbalanceModel,
    Isolated, Passive, Platform, ReactionWheel, Scalar, Sgcmg, SloshMass, Strut, Suspension, Vscmg,
};

use crate::random::Random;

/// A kind of which a device can be drawn.
pub trait RandomDevice: Kind {
    /// The next device.
    fn drawn(random: &mut Random) -> Self;
}

/// How far a body's origin or centre of mass is from its parent body's origin, m.
const OFFSET: f64 = 0.1;

/// How far a device is from the hub's point B, m.
const PLACE: f64 = 0.8;

/// A wheel out of balance: mass, offset, inertia.
macro_rules! wheel {
    ($kind:ident, $random:ident) => {{
        let mass = $random.within(2.0, 8.0);
        let bare = $kind::bare_wheel(T::from_f64(mass), $random.tilted_disc(mass));
        let model = match $random.one_of(4) {
            0 => ImbalanceModel::Lumped,
            _ => ImbalanceModel::Coupled,
        };
        $kind { d: $random.number(1e-5, 5e-3), model, ..bare }
    }};
}

/// A wheel in balance.
macro_rules! balanced_wheel {
    ($kind:ident, $random:ident) => {{
        let mass = $random.within(2.0, 8.0);
        let [axial, across] = $random.disc(mass).map(T::from_f64);
        $kind::bare_wheel(T::from_f64(mass), axial, across)
    }};
}

macro_rules! drawn {
    ($($kind:ident $wheel:ident $inboard:ident;)*) => {$(
        impl<T: Scalar> RandomDevice for $kind<T> {
            fn drawn(random: &mut Random) -> Self {
                let wheel = $wheel!($kind, random);
                let mut device = $inboard!($kind, random, wheel);
                device.mount = random.rotation();
                suspend(&mut device.passive, random);
                device
            }
        }
    )*};
}

/// Two gimbals around a wheel.
macro_rules! two_gimbals {
    ($kind:ident, $random:ident, $wheel:ident) => {{
        let (outer, inner) = ($random.within(1.0, 5.0), $random.within(1.0, 5.0));
        $kind {
            r_go_b: $random.vector(PLACE),
            m_go: T::from_f64(outer),
            r_goc_go: $random.vector(OFFSET),
            i_go_goc: $random.block(outer),
            l_o: $random.vector(OFFSET),
            m_gi: T::from_f64(inner),
            r_gic_gi: $random.vector(OFFSET),
            i_gi_gic: $random.block(inner),
            l_i: $random.vector(OFFSET),
            ..$wheel
        }
    }};
}

/// One gimbal around a wheel.
macro_rules! one_gimbal {
    ($kind:ident, $random:ident, $wheel:ident) => {{
        let gimbal = $random.within(1.0, 5.0);
        $kind {
            r_g_b: $random.vector(PLACE),
            m_g: T::from_f64(gimbal),
            r_gc_g: $random.vector(OFFSET),
            i_g_gc: $random.block(gimbal),
            l_g: $random.vector(OFFSET),
            ..$wheel
        }
    }};
}

/// A wheel on the hub.
macro_rules! no_gimbal {
    ($kind:ident, $random:ident, $wheel:ident) => {
        $kind { r_w_b: $random.vector(PLACE), ..$wheel }
    };
}

/// A wheel on bearings of the hub.
macro_rules! bearings {
    ($kind:ident, $random:ident, $wheel:ident) => {
        $kind { r_sx_b: $random.vector(PLACE), ..$wheel }
    };
}

drawn! {
    Dgvscmg wheel two_gimbals;
    BalancedDgvscmg balanced_wheel two_gimbals;
    Dgcmg wheel two_gimbals;
    BalancedDgcmg balanced_wheel two_gimbals;
    Vscmg wheel one_gimbal;
    BalancedVscmg balanced_wheel one_gimbal;
    Sgcmg wheel one_gimbal;
    FlexibleVscmg wheel one_gimbal;
    BalancedSgcmg balanced_wheel one_gimbal;
    ReactionWheel wheel no_gimbal;
    BalancedReactionWheel balanced_wheel no_gimbal;
    FlexibleReactionWheel wheel bearings;
}

impl<T: Scalar> RandomDevice for HingedPanel<T> {
    fn drawn(random: &mut Random) -> Self {
        let mass = random.within(2.0, 20.0);
        let mut panel = Self {
            mount: random.rotation(),
            r_p_b: random.vector(PLACE),
            r_pc_p: random.vector(0.5),
            ..Self::bare_panel(T::from_f64(mass), random.block(mass))
        };
        suspend(&mut panel.passive, random);
        panel
    }
}

impl<T: Scalar> RandomDevice for SloshMass<T> {
    fn drawn(random: &mut Random) -> Self {
        let mut mass = Self {
            mount: random.rotation(),
            r_s_b: random.vector(PLACE),
            ..Self::bare_slosh_mass(random.number(1.0, 10.0))
        };
        suspend(&mut mass.passive, random);
        mass
    }
}

/// Devices on a platform with springs of its joints, coupled ones and two struts.
pub fn isolated<D: FixedSet>(carried: D, random: &mut Random) -> Isolated<D> {
    let mass = random.within(5.0, 20.0);
    let mut platform = Platform {
        mount: random.rotation(),
        r_p_b: random.vector(PLACE),
        r_pc_p: random.vector(OFFSET),
        ..Platform::bare(D::Scalar::from_f64(mass), random.block(mass))
    };
    suspend(&mut platform.passive, random);
    let suspension = Suspension {
        coupled: Some(coupled(random)),
        struts: [Some(strut(random)), Some(strut(random)), None, None, None, None],
    };
    Isolated { carrier: platform, suspension, carried }
}

/// A multiple of the unit matrix and a product of a vector with itself: positive definite.
fn coupled<T: Scalar>(random: &mut Random) -> Coupled<T> {
    let across: [T; 6] = [(); 6].map(|()| random.number(-2.0, 2.0));
    let along = random.number::<T>(0.5, 5.0);
    let matrix = |scale: T| {
        Matrix6::from_fn(|j, k| {
            let product = across[j] * across[k];
            scale * if j == k { product + along } else { product }
        })
    };
    Coupled {
        stiffness: matrix(T::from_f64(1.0)),
        rest: Vector6::from_fn(|_, _| random.number(-0.05, 0.05)),
        damping: matrix(T::from_f64(0.01)),
    }
}

fn strut<T: Scalar>(random: &mut Random) -> Strut<T> {
    let turned = random.rotation();
    Strut {
        position: random.vector(0.3),
        direction: turned.column(0).into_owned(),
        length: random.number(0.2, 0.5),
        stiffness: random.number(0.1, 10.0),
        damping: random.number(1e-3, 1e-1),
    }
}

/// Gives half of the joints a spring with its damper and dry friction: so soft that a millisecond
/// resolves them.
fn suspend<T: Scalar>(joints: &mut impl precess_dynamics::Each<Passive<T>>, random: &mut Random) {
    for joint in joints.values_mut() {
        if random.one_of(2) == 0 {
            *joint = Passive {
                stiffness: random.number(0.1, 10.0),
                rest: random.number(-0.1, 0.1),
                viscous: random.number(1e-3, 1e-1),
                coulomb: random.number(1e-4, 1e-2),
                coulomb_rate: random.number(0.1, 1.0),
            };
        }
    }
}
