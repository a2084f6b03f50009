//! How a kind's second file calls the kernels that are read beside a solution: energy, momentum,
//! axes, loads, external wrenches and gravity.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::device::body_name;
use super::device_calls::{A, P, Q, V, W};
use super::device_items::Items;
use super::text::ident;
use crate::space::XYZ;

impl Items<'_> {
    pub(super) fn energy_momentum(&self) -> TokenStream {
        let (pose, call) = (self.posed("energy_momentum"), self.call("energy_momentum"));
        let [constants, joints, hub] =
            self.names("energy_momentum", [P, ("joints", "qsv"), ("hub", "b")]);
        quote! {
            fn energy_momentum(
                #constants: &Self::Constants<T>,
                #joints: &Joints<T>,
                #hub: &BodyVelocity<T>,
            ) -> EnergyMomentum<T> {
                #pose
                #call
            }
        }
    }

    pub(super) fn first_moment(&self) -> TokenStream {
        let (pose, call) = (self.posed("first_moment"), self.call("first_moment"));
        let [constants, joints] = self.names("first_moment", [P, ("joints", "qsv")]);
        // What is zero in every state of the kind is not returned.
        let returned = self.returned("first_moment");
        let rows = ["mc", "mc_prime"].map(|stem| {
            let components = XYZ.map(|axis| format!("{stem}_b{axis}")).map(|name| {
                let component = ident(&name);
                if returned.contains(&name) { quote!(found.#component) } else { quote!(zero()) }
            });
            quote!([#(#components),*])
        });
        quote! {
            fn first_moment(#constants: &Self::Constants<T>, #joints: &Joints<T>) -> [[T; 3]; 2] {
                #pose
                let found = #call;
                [#(#rows),*]
            }
        }
    }

    /// The pose, where a kernel reads it.
    fn posed(&self, kernel: &str) -> Option<TokenStream> {
        let read = self.letters(kernel).iter().any(|letter| Q.1.contains(letter));
        read.then(|| quote!(let pose = &Self::pose(joints);))
    }

    pub(super) fn axes(&self) -> TokenStream {
        let (call, [constants, pose]) = (self.call("axes"), self.names("axes", [P, Q]));
        let axes = self.per_joint(|link| {
            let columns = XYZ.map(|axis| {
                let rows = XYZ.map(|row| format_ident!("{}_{axis}_b{row}", link.body.frame));
                quote!([#(axes.#rows),*])
            });
            quote!([#(#columns),*])
        });
        quote! {
            fn axes(
                #constants: &Self::Constants<T>,
                #pose: &Self::Pose<T>,
            ) -> PerJoint<[[T; 3]; 3]> {
                let axes = #call;
                #axes
            }
        }
    }

    pub(super) fn loads(&self) -> TokenStream {
        let (call, carried) = (self.call("loads"), self.carried_by("load"));
        let [constants, pose, joints, omega, hub, accelerations] =
            self.names("loads", [P, Q, V, W, A, ("accelerations", "j")]);
        quote! {
            fn loads(
                #constants: &Self::Constants<T>,
                #pose: &Self::Pose<T>,
                #joints: &Joints<T>,
                #omega: &BodyRate<T>,
                #hub: &BodyAcceleration<T>,
                #accelerations: &JointAccelerations<T>,
            ) -> Carried<Wrenches<Self>, Wrench<T>> {
                let found = #call;
                #carried
            }
        }
    }

    /// Derivatives of the loads, column by column.
    pub(super) fn load_derivatives(&self) -> TokenStream {
        let call = self.call("load_derivatives");
        let [constants, pose, joints, omega, hub, accelerations] =
            self.names("load_derivatives", [P, Q, V, W, A, ("accelerations", "j")]);
        let column = |by: &str| {
            let joints = self.per_joint(|link| {
                let name = format_ident!("{}_by_{by}", link.joint.torque);
                let none = quote!(#omega.omega_bx.like(0.0));
                if link.is_driven() { quote!(found.#name) } else { none }
            });
            let [force, moment] = ["f", "n"].map(|letter| {
                let components = XYZ.map(|axis| format_ident!("{letter}_b{axis}_by_{by}"));
                quote!(vector([#(found.#components),*]))
            });
            quote!(Carried { joints: #joints, hub: Wrench { force: #force, moment: #moment } })
        };
        let coordinates = self.per_joint(|link| column(link.joint.coordinate));
        let rates = self.per_joint(|link| column(link.joint.rate));
        let by_accelerations = self.per_joint(|link| column(link.joint.acceleration));
        let [by_omega, by_omega_dot] =
            ["omega", "omega_dot"].map(|stem| XYZ.map(|axis| column(&format!("{stem}_b{axis}"))));
        let feature = self.feature.map(|feature| quote!(#[cfg(feature = #feature)]));
        quote! {
            #feature
            fn load_derivatives<T: Real>(
                #constants: &Self::Constants<T>,
                #pose: &Self::Pose<T>,
                #joints: &Joints<T>,
                #omega: &BodyRate<T>,
                #hub: &BodyAcceleration<T>,
                #accelerations: &JointAccelerations<T>,
            ) -> Option<LoadDerivatives<Self, T>> {
                let found = #call;
                Some(LoadDerivatives {
                    coordinates: #coordinates,
                    rates: #rates,
                    accelerations: #by_accelerations,
                    omega: [#(#by_omega),*],
                    omega_dot: [#(#by_omega_dot),*],
                })
            }
        }
    }

    /// What each joint's motion requires about B.
    pub(super) fn steer(&self) -> TokenStream {
        let call = self.call("steer");
        let [constants, pose, joints, omega] = self.names("steer", [P, Q, V, W]);
        let returned = self.returned("steer");
        // What is zero in every state of the kind is not returned.
        let component = |name: String| {
            let field = ident(&name);
            if returned.contains(&name) { quote!(found.#field) } else { quote!(zero()) }
        };
        let along_b = |stem: &str| {
            let components = XYZ.map(|axis| component(format!("{stem}_b{axis}")));
            quote!(vector([#(#components),*]))
        };
        let of_joints = self.per_joint(|link| {
            let tag = link.joint.tag;
            let (by_rate, by_acceleration) =
                (along_b(&format!("n_rate_{tag}")), along_b(&format!("n_acceleration_{tag}")));
            quote!(JointSteering { by_rate: #by_rate, by_acceleration: #by_acceleration })
        });
        let [momentum, first_moment, gyroscopic] =
            ["h_relative", "first_moment", "n_gyroscopic"].map(along_b);
        let inertia =
            ["11", "12", "13", "22", "23", "33"].map(|entry| component(format!("inertia_{entry}")));
        quote! {
            fn steer(
                #constants: &Self::Constants<T>,
                #pose: &Self::Pose<T>,
                #joints: &Joints<T>,
                #omega: &BodyRate<T>,
            ) -> Option<Steering<Self>> {
                let found = #call;
                Some(Steering {
                    joints: #of_joints,
                    momentum: #momentum,
                    first_moment: #first_moment,
                    inertia: [#(#inertia),*],
                    gyroscopic: #gyroscopic,
                })
            }
        }
    }

    /// The loads of external wrenches.
    pub(super) fn external(&self) -> TokenStream {
        let (call, carried) = (self.call("external"), self.carried_by("sum"));
        let [constants, pose, bodies] = self.names("external", [P, Q, ("bodies", "x")]);
        let fields = self.links().iter().flat_map(|link| {
            let (frame, body) = (link.body.frame, ident(body_name(&link.body)));
            [("f", ident("force")), ("n", ident("moment"))].map(|(letter, of)| {
                let names = XYZ.map(|axis| format_ident!("{letter}_on_{frame}{axis}"));
                let axes = XYZ.map(ident);
                quote!(#(#names: bodies.#body.#of.#axes),*)
            })
        });
        quote! {
            fn external<T: Real>(
                #constants: &Self::Constants<T>,
                #pose: &Self::Pose<T>,
                #bodies: &PerJoint<Wrench<T>>,
            ) -> Carried<PerJoint<Wrench<T>>, Wrench<T>> {
                let wrenches = super::Wrenches { #(#fields),* };
                let found = #call;
                #carried
            }
        }
    }

    pub(super) fn gravity(&self) -> TokenStream {
        let call = self.call("gravity");
        let [constants, pose, gradient] = self.names("gravity", [P, Q, ("gradient", "g")]);
        let wrenches =
            self.per_joint(|link| wrench(&quote!(found.wrenches), "on", link.body.frame));
        let second = ["11", "12", "13", "22", "23", "33"]
            .map(|entry| format_ident!("second_moment_{entry}"));
        quote! {
            fn gravity<T: Real>(
                #constants: &Self::Constants<T>,
                #pose: &Self::Pose<T>,
                #gradient: [T; 6],
            ) -> (PerJoint<Wrench<T>>, [T; 6]) {
                let [g_11, g_12, g_13, g_22, g_23, g_33] = gradient;
                let gradient = Gradient { g_11, g_12, g_13, g_22, g_23, g_33 };
                let found = #call;
                let wrenches = #wrenches;
                let second_moment = [#(found.#second),*];
                (wrenches, second_moment)
            }
        }
    }

    /// `Carried { .. }` from the fields of `found`.
    fn carried_by(&self, what: &str) -> TokenStream {
        let joints = self.per_joint(|link| wrench(&quote!(found), what, link.body.frame));
        let hub = wrench(&quote!(found), what, "b");
        quote! {
            let joints = #joints;
            let hub = #hub;
            Carried { joints, hub }
        }
    }
}

/// `Wrench { .. }` from six fields.
fn wrench(of: &TokenStream, what: &str, frame: &str) -> TokenStream {
    let [force, moment] = ["f", "n"].map(|letter| {
        let components = XYZ.map(|axis| format_ident!("{letter}_{what}_{frame}{axis}"));
        quote!(vector([#(#of.#components),*]))
    });
    quote!(Wrench { force: #force, moment: #moment })
}
