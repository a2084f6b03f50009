//! Random devices of every kind, each with its chain of bodies written down by hand from the
//! meaning of its fields: no emitted code is used.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, Kind};
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, FlexibleReactionWheel, FlexibleVscmg, HingedPanel, Passive, ReactionWheel, Sgcmg,
    SloshMass, Vscmg,
};
use precess_point_masses::{Chain, Link, Motion};
use precess_tests::bearings::sprung;

use super::random::Random;

/// A kind that can be drawn.
pub(crate) trait Drawn: Kind<Scalar = f64> {
    /// At random, with no body heavier than `heaviest`.
    fn drawn(random: &mut Random, heaviest: f64) -> Self;
    /// As bodies in a row.
    fn chain(&self) -> Chain;

    /// At random, with springs, dampers and friction.
    fn sprung(random: &mut Random, heaviest: f64) -> Self {
        let mut device = Self::drawn(random, heaviest);
        for (passive, info) in device.passive_mut().values_mut().zip(Self::JOINTS) {
            *passive = sprung(random, info);
        }
        device
    }
}

fn link(
    motion: Motion,
    origin: Vector3<f64>,
    mass: f64,
    centre: Vector3<f64>,
    i: Matrix3<f64>,
) -> Link {
    Link { motion, origin, mass, centre, inertia: i, round: false }
}

/// Turns about z, y, x.
fn about(x: f64, y: f64, z: f64) -> Motion {
    Motion::Turns(Vector3::new(x, y, z))
}

/// An imbalanced wheel, its centre of mass on its y axis.
fn wheel(origin: Vector3<f64>, mass: f64, d: f64, inertia: Matrix3<f64>) -> Link {
    link(about(1.0, 0.0, 0.0), origin, mass, Vector3::new(0.0, d, 0.0), inertia)
}

/// A wheel as it should be.
fn round_wheel(origin: Vector3<f64>, mass: f64, j_11: f64, j_22: f64) -> Link {
    let inertia = Matrix3::from_diagonal(&Vector3::new(j_11, j_22, j_22));
    Link { round: true, ..wheel(origin, mass, 0.0, inertia) }
}

/// The other kinds share their fields with one that is drawn field by field.
macro_rules! same_fields {
    ($kind:ident of $larger:ident by $of:ident: $($field:ident)*) => {
        /// The same parameters as another kind's.
        pub(crate) fn $of(larger: &$larger) -> $kind {
            let mut same = $kind { $($field: larger.$field,)* ..$kind::bare_wheel(1.0, larger.i_w_wc) };
            copy(&mut same.passive, &larger.passive);
            same
        }

        impl Drawn for $kind {
            fn drawn(random: &mut Random, heaviest: f64) -> Self {
                $of(&$larger::drawn(random, heaviest))
            }

            fn chain(&self) -> Chain {
                let mut larger =
                    $larger { $($field: self.$field,)* ..$larger::bare_wheel(1.0, self.i_w_wc) };
                copy(&mut larger.passive, &self.passive);
                larger.chain()
            }
        }
    };
}

/// The balanced kinds take the axial and one transverse moment of the wheel.
macro_rules! balanced {
    ($kind:ident of $made:ident by $of:ident: $($field:ident)*) => {
        /// What is left of a device whose wheel loses its imbalance.
        pub(crate) fn $of(made: &$made) -> $kind {
            let bare = $kind::bare_wheel(1.0, made.i_w_wc.m11, made.i_w_wc.m22);
            let mut balanced = $kind { $($field: made.$field,)* ..bare };
            copy(&mut balanced.passive, &made.passive);
            balanced
        }

        impl Drawn for $kind {
            fn drawn(random: &mut Random, heaviest: f64) -> Self {
                $of(&$made::drawn(random, heaviest))
            }

            fn chain(&self) -> Chain {
                let bare = $made::bare_wheel(1.0, Matrix3::identity());
                let mut made = $made { $($field: self.$field,)* ..bare };
                copy(&mut made.passive, &self.passive);
                let mut chain = made.chain();
                let last = chain.links.last_mut().expect("a wheel");
                *last = round_wheel(last.origin, self.m_w, self.j_11, self.j_22);
                chain
            }
        }
    };
}

same_fields!(Sgcmg of Vscmg by sgcmg: mount r_g_b m_g r_gc_g i_g_gc l_g m_w d i_w_wc model);
same_fields!(Dgcmg of Dgvscmg by dgcmg:
    mount r_go_b m_go r_goc_go i_go_goc l_o m_gi r_gic_gi i_gi_gic l_i m_w d i_w_wc model);
balanced!(BalancedReactionWheel of ReactionWheel by balanced_reaction_wheel: mount r_w_b m_w);
balanced!(BalancedVscmg of Vscmg by balanced_vscmg: mount r_g_b m_g r_gc_g i_g_gc l_g m_w);
balanced!(BalancedSgcmg of Sgcmg by balanced_sgcmg: mount r_g_b m_g r_gc_g i_g_gc l_g m_w);
balanced!(BalancedDgvscmg of Dgvscmg by balanced_dgvscmg:
    mount r_go_b m_go r_goc_go i_go_goc l_o m_gi r_gic_gi i_gi_gic l_i m_w);
balanced!(BalancedDgcmg of Dgcmg by balanced_dgcmg:
    mount r_go_b m_go r_goc_go i_go_goc l_o m_gi r_gic_gi i_gi_gic l_i m_w);

/// Copies a value for each joint from one kind's structure to another's.
pub(crate) fn copy(to: &mut impl Each<Passive>, from: &impl Each<Passive>) {
    for (to, from) in to.values_mut().zip(from.values()) {
        *to = from;
    }
}

fn mount(random: &mut Random) -> Matrix3<f64> {
    random.rotation().to_rotation_matrix().into_inner()
}

impl Drawn for ReactionWheel {
    fn drawn(random: &mut Random, heaviest: f64) -> Self {
        let m_w = random.log_within(0.1, heaviest);
        let (i_w_wc, radius) = random.disc(m_w);
        let d = random.log_within(1e-6, radius);
        let (mount, r_w_b) = (mount(random), random.position());
        Self { mount, r_w_b, d, ..Self::bare_wheel(m_w, i_w_wc) }
    }

    fn chain(&self) -> Chain {
        let links = vec![wheel(Vector3::zeros(), self.m_w, self.d, self.i_w_wc)];
        let passive = self.passive.values().collect();
        Chain { mount: self.mount, position: self.r_w_b, links, passive }
    }
}

impl Drawn for Vscmg {
    fn drawn(random: &mut Random, heaviest: f64) -> Self {
        let ReactionWheel { mount, r_w_b, m_w, d, i_w_wc, .. } =
            ReactionWheel::drawn(random, heaviest);
        let m_g = random.log_within(0.1, heaviest);
        let (i_g_gc, r_gc_g, l_g) = (random.block(m_g), random.offset(), random.offset());
        Self { mount, r_g_b: r_w_b, m_g, r_gc_g, i_g_gc, l_g, d, ..Self::bare_wheel(m_w, i_w_wc) }
    }

    fn chain(&self) -> Chain {
        let z = about(0.0, 0.0, 1.0);
        let gimbal = link(z, Vector3::zeros(), self.m_g, self.r_gc_g, self.i_g_gc);
        let links = vec![gimbal, wheel(self.l_g, self.m_w, self.d, self.i_w_wc)];
        let passive = self.passive.values().collect();
        Chain { mount: self.mount, position: self.r_g_b, links, passive }
    }
}

impl Drawn for Dgvscmg {
    fn drawn(random: &mut Random, heaviest: f64) -> Self {
        let Vscmg { mount, r_g_b, m_g, r_gc_g, i_g_gc, l_g, m_w, d, i_w_wc, .. } =
            Vscmg::drawn(random, heaviest);
        let m_gi = random.log_within(0.1, heaviest);
        let (i_gi_gic, r_gic_gi, l_i) = (random.block(m_gi), random.offset(), random.offset());
        let (m_go, r_goc_go, i_go_goc) = (m_g, r_gc_g, i_g_gc);
        let bare = Self::bare_wheel(m_w, i_w_wc);
        let outer = Self { mount, r_go_b: r_g_b, m_go, r_goc_go, i_go_goc, l_o: l_g, ..bare };
        Self { m_gi, r_gic_gi, i_gi_gic, l_i, d, ..outer }
    }

    fn chain(&self) -> Chain {
        let (y, z) = (about(0.0, 1.0, 0.0), about(0.0, 0.0, 1.0));
        let links = vec![
            link(z, Vector3::zeros(), self.m_go, self.r_goc_go, self.i_go_goc),
            link(y, self.l_o, self.m_gi, self.r_gic_gi, self.i_gi_gic),
            wheel(self.l_i, self.m_w, self.d, self.i_w_wc),
        ];
        let passive = self.passive.values().collect();
        Chain { mount: self.mount, position: self.r_go_b, links, passive }
    }
}

/// Of the offset of a wheel's centre of mass, which is up to its radius: a rotor on flexible bearings is balanced
/// to a hundredth of it, more than they would bear.
const ON_BEARINGS: f64 = 0.01;

impl Drawn for FlexibleReactionWheel {
    fn drawn(random: &mut Random, heaviest: f64) -> Self {
        let ReactionWheel { mount, r_w_b, m_w, d, i_w_wc, .. } =
            ReactionWheel::drawn(random, heaviest);
        let d = d * ON_BEARINGS;
        Self { mount, r_sx_b: r_w_b, d, ..Self::bare_wheel(m_w, i_w_wc) }
    }

    fn chain(&self) -> Chain {
        let rotor = wheel(Vector3::zeros(), self.m_w, self.d, self.i_w_wc);
        let links = on_bearings(Vector3::zeros(), rotor);
        let passive = self.passive.values().collect();
        Chain { mount: self.mount, position: self.r_sx_b, links, passive }
    }
}

impl Drawn for FlexibleVscmg {
    fn drawn(random: &mut Random, heaviest: f64) -> Self {
        let Vscmg { mount, r_g_b, m_g, r_gc_g, i_g_gc, l_g, m_w, d, i_w_wc, .. } =
            Vscmg::drawn(random, heaviest);
        // The gimbal holds bearings and motor. Its inertia is all that opposes its own, since the rotor moves freely.
        let (d, m_g) = (d * ON_BEARINGS, m_g.max(m_w / 3.0));
        Self { mount, r_g_b, m_g, r_gc_g, i_g_gc, l_g, d, ..Self::bare_wheel(m_w, i_w_wc) }
    }

    fn chain(&self) -> Chain {
        let z = about(0.0, 0.0, 1.0);
        let gimbal = link(z, Vector3::zeros(), self.m_g, self.r_gc_g, self.i_g_gc);
        let rotor = wheel(Vector3::zeros(), self.m_w, self.d, self.i_w_wc);
        let links = [&[gimbal][..], &on_bearings(self.l_g, rotor)].concat();
        let passive = self.passive.values().collect();
        Chain { mount: self.mount, position: self.r_g_b, links, passive }
    }
}

/// Three slides and two tilts without a body, of which the first has its origin here, and the rotor.
fn on_bearings(origin: Vector3<f64>, rotor: Link) -> Vec<Link> {
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let slides = [x, y, z].map(Motion::Slides);
    let tilts = [y, z].map(Motion::Turns);
    let o = Vector3::zeros();
    let bodiless = |motion| link(motion, o, 0.0, o, Matrix3::zeros());
    let mut links: Vec<Link> = slides.into_iter().chain(tilts).map(bodiless).collect();
    links[0].origin = origin;
    links.push(rotor);
    links
}

impl Drawn for HingedPanel {
    fn drawn(random: &mut Random, heaviest: f64) -> Self {
        let m_p = random.log_within(0.1, heaviest);
        let bare = Self::bare_panel(m_p, random.block(m_p));
        Self { mount: mount(random), r_p_b: random.position(), r_pc_p: random.offset(), ..bare }
    }

    fn chain(&self) -> Chain {
        let z = about(0.0, 0.0, 1.0);
        let links = vec![link(z, Vector3::zeros(), self.m_p, self.r_pc_p, self.i_p_pc)];
        let passive = self.passive.values().collect();
        Chain { mount: self.mount, position: self.r_p_b, links, passive }
    }
}

impl Drawn for SloshMass {
    fn drawn(random: &mut Random, heaviest: f64) -> Self {
        let bare = Self::bare_slosh_mass(random.log_within(0.1, heaviest));
        Self { mount: mount(random), r_s_b: random.position(), ..bare }
    }

    fn chain(&self) -> Chain {
        let (x, o) = (Motion::Slides(Vector3::x()), Vector3::zeros());
        let links = vec![link(x, o, self.m_s, o, Matrix3::zeros())];
        let passive = self.passive.values().collect();
        Chain { mount: self.mount, position: self.r_s_b, links, passive }
    }
}
