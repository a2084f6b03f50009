//! What is made of a random device: the device itself, or its wheel on gimbals without mass, of
//! every kind that has gimbals.

use precess_dynamics::kind::Kind;
use precess_dynamics::{BalancedDgvscmg, Dgcmg, Dgvscmg, Scalar, Vscmg};

/// A device made of a random one, in every scalar.
pub trait Form {
    /// Name of its kind.
    const NAME: &'static str;

    /// Its kind.
    type Device<T: Scalar>: Kind<Scalar = T>;

    /// Makes it.
    fn from_dgvscmg<T: Scalar>(drawn: &Dgvscmg<T>) -> Self::Device<T>;
}

/// The random device itself.
#[derive(Clone, Copy, Debug)]
pub struct RandomDgvscmg;

impl Form for RandomDgvscmg {
    const NAME: &'static str = "dgvscmg";

    type Device<T: Scalar> = Dgvscmg<T>;

    fn from_dgvscmg<T: Scalar>(drawn: &Dgvscmg<T>) -> Dgvscmg<T> {
        *drawn
    }
}

/// Declares the wheel of a device on the massless gimbals of a kind, with its position and its
/// imbalance.
macro_rules! bare_wheels {
    ($($form:ident: $kind:ident, $name:literal, $origin:ident;)*) => {$(
        #[doc = concat!("The wheel on the massless gimbals of a `", $name, "`.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $form;

        impl Form for $form {
            const NAME: &'static str = $name;

            type Device<T: Scalar> = $kind<T>;

            fn from_dgvscmg<T: Scalar>(drawn: &Dgvscmg<T>) -> $kind<T> {
                let Dgvscmg { mount, r_go_b: $origin, m_w, d, i_w_wc, .. } = *drawn;
                $kind { mount, $origin, d, ..$kind::bare_wheel(m_w, i_w_wc) }
            }
        }
    )*};
}

bare_wheels! {
    BareDgvscmg: Dgvscmg, "dgvscmg", r_go_b;
    BareDgcmg: Dgcmg, "dgcmg", r_go_b;
    BareVscmg: Vscmg, "vscmg", r_g_b;
}

/// A balanced wheel with the same two moments on the massless gimbals of a `balanced_dgvscmg`.
#[derive(Clone, Copy, Debug)]
pub struct BareBalancedDgvscmg;

impl Form for BareBalancedDgvscmg {
    const NAME: &'static str = "balanced_dgvscmg";

    type Device<T: Scalar> = BalancedDgvscmg<T>;

    fn from_dgvscmg<T: Scalar>(drawn: &Dgvscmg<T>) -> BalancedDgvscmg<T> {
        let Dgvscmg { mount, r_go_b, m_w, i_w_wc, .. } = *drawn;
        let bare = BalancedDgvscmg::bare_wheel(m_w, i_w_wc.m11, i_w_wc.m22);
        BalancedDgvscmg { mount, r_go_b, ..bare }
    }
}
