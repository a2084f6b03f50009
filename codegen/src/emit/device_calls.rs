//! How a kind's second file calls the kernels: arguments gathered, results put into structures.
//!
//! A function of the interface names its parameter only if the kernel reads something of it.

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};
use syn::Index;

use super::device::body_name;
use super::device_items::Items;
use super::text::ident;
use crate::derivation::chain::XYZ;
use crate::kernel::{Record, pose};
use crate::kinds::Kind;

/// Parameters of several functions, each with the letters of the kernels' arguments that are made
/// of it.
const P: (&str, &str) = ("constants", "p");
const Q: (&str, &str) = ("pose", "qs");
const V: (&str, &str) = ("joints", "v");
const W: (&str, &str) = ("omega", "w");
const U: (&str, &str) = ("drives", "um");
const A: (&str, &str) = ("hub", "a");

impl Items<'_> {
    /// The letters of a kernel's arguments.
    fn letters(&self, kernel: &str) -> &[&'static str] {
        self.signatures.get(kernel).map_or(&[], |signature| signature.letters.as_slice())
    }

    /// Letters of what a pose consists of.
    pub(super) fn pose_letters(&self) -> Vec<&'static str> {
        pose(self.kind).into_iter().map(|(letter, _)| letter).collect()
    }

    /// The argument of a kernel for a letter.
    fn argument(&self, letter: &str) -> TokenStream {
        let letters = self.pose_letters();
        let place = letters.iter().position(|known| *known == letter);
        match (letter, place) {
            ("p", _) => quote!(constants),
            (_, Some(_)) if letters.len() == 1 => quote!(pose),
            (_, Some(place)) => {
                let place = Index::from(place);
                quote!(&pose.#place)
            }
            ("v", _) => quote!(&rates(joints)),
            ("w", _) => quote!(omega),
            ("e", _) => quote!(gains),
            ("a" | "b", _) => quote!(hub),
            ("u", _) => quote!(&motors),
            ("m", _) => quote!(&modes),
            ("j", _) => quote!(accelerations),
            ("x", _) => quote!(&wrenches),
            ("g", _) => quote!(&gradient),
            (other, None) => ident(other).to_token_stream(),
        }
    }

    /// `super::kernel(arguments)`.
    fn call(&self, kernel: &str) -> TokenStream {
        let arguments = self.letters(kernel).iter().map(|letter| self.argument(letter));
        let kernel = ident(kernel);
        quote!(super::#kernel(#(#arguments),*))
    }

    /// The names of parameters in a function that calls a kernel, each with the letters of the
    /// kernel's arguments that are made of it.
    fn names<const N: usize>(&self, kernel: &str, given: [(&str, &str); N]) -> [TokenStream; N] {
        given.map(|(name, letters)| {
            let parameter = ident(name);
            if self.letters(kernel).iter().any(|letter| letters.contains(letter)) {
                quote!(#parameter)
            } else if name == "pose" && self.pose_letters().is_empty() {
                quote!(())
            } else {
                quote!(_)
            }
        })
    }

    /// Sines, cosines and lengths.
    pub(super) fn pose(&self) -> TokenStream {
        let sines = self.kind.turning().map(|link| {
            let angle = ident(link.joint.coordinate);
            let (sine, cosine) = (format_ident!("sin_{angle}"), format_ident!("cos_{angle}"));
            quote!(let (#sine, #cosine) = joints.#angle.sin_cos();)
        });
        let literal = |(_, record): &(&str, Record)| {
            let name = ident(&record.name);
            let fields: Vec<_> = record.fields.iter().map(|field| ident(&field.name)).collect();
            if record.name == "Positions" {
                quote!(super::#name { #(#fields: joints.#fields),* })
            } else {
                quote!(super::#name { #(#fields),* })
            }
        };
        let records: Vec<_> = pose(self.kind).iter().map(literal).collect();
        let (joints, result) = match records.as_slice() {
            [] => (quote!(_), quote!()),
            [one] => (quote!(joints), quote!(#one)),
            both => (quote!(joints), quote!((#(#both),*))),
        };
        quote! {
            fn pose<T: Angle>(#joints: &Joints<T>) -> Self::Pose<T> {
                #(#sines)*
                #result
            }
        }
    }

    /// The elimination, and its two parts.
    pub(super) fn eliminate(&self) -> [TokenStream; 3] {
        let driven: Vec<_> = self.kind.driven().collect();
        let motors = driven.iter().map(|link| {
            let (torque, body) = (ident(link.joint.torque), ident(body_name(&link.body)));
            quote!(#torque: drives.#body.torque)
        });
        let modes = driven.iter().flat_map(|link| {
            ["driven", "held", "given"].map(|what| {
                let name = format_ident!("{what}_{}", link.joint.tag);
                let [body, what] = [body_name(&link.body), what.to_owned()].map(ident);
                quote!(#name: drives.#body.#what)
            })
        });
        let call = self.call("eliminate");
        let [constants, pose, joints, omega, drives] = self.names("eliminate", [P, Q, V, W, U]);
        [
            quote! {
                fn eliminate<T: Real>(
                    #constants: &Self::Constants<T>,
                    #pose: &Self::Pose<T>,
                    #joints: &Joints<T>,
                    #omega: &BodyRate<T>,
                    #drives: &PerJoint<Drive<T>>,
                ) -> Self::Eliminated<T> {
                    let motors = super::Motors { #(#motors),* };
                    let modes = super::Modes { #(#modes),* };
                    #call
                }
            },
            quote! {
                fn share<T: Real>(eliminated: &Self::Eliminated<T>) -> &HubShare<T> {
                    &eliminated.share
                }
            },
            quote! {
                fn gains<T: Real>(eliminated: &Self::Eliminated<T>) -> &Self::Gains<T> {
                    &eliminated.gains
                }
            },
        ]
    }

    pub(super) fn pivots(&self) -> TokenStream {
        let pivots = self.per_joint(|link| {
            if link.is_driven() {
                let tag = link.joint.tag;
                let [pivot, diagonal] =
                    ["pivot", "diagonal"].map(|what| format_ident!("{what}_{tag}"));
                quote!(Some([eliminated.#pivot, eliminated.#diagonal]))
            } else {
                quote!(None)
            }
        });
        quote! {
            fn pivots<T: Real>(eliminated: &Self::Eliminated<T>) -> PerJoint<Option<[T; 2]>> {
                #pivots
            }
        }
    }

    pub(super) fn back_substitute(&self) -> TokenStream {
        let call = self.call("back_substitute");
        let [gains, hub] = self.names("back_substitute", [("gains", "e"), A]);
        quote! {
            fn back_substitute<T: Real>(
                #gains: &Self::Gains<T>,
                #hub: &BodyAcceleration<T>,
            ) -> JointAccelerations<T> {
                #call
            }
        }
    }

    /// What the joints' coordinates and rates change by.
    pub(super) fn slope(&self) -> TokenStream {
        let coordinates = self.each(|link| ident(link.joint.coordinate));
        let rates = self.each(|link| ident(link.joint.rate));
        let accelerations = self.each(|link| ident(link.joint.acceleration));
        quote! {
            fn slope<T: Value>(
                joints: &Joints<T>,
                accelerations: &JointAccelerations<T>,
            ) -> Joints<T> {
                Joints {
                    #(#coordinates: joints.#rates,)*
                    #(#rates: accelerations.#accelerations),*
                }
            }
        }
    }

    /// Number by number, for what is gathered into lanes or spread from them.
    pub(super) fn zips() -> [TokenStream; 5] {
        [
            ("constants", quote!(super::Prepared)),
            ("joints", quote!(Joints)),
            ("gains", quote!(super::Gains)),
            ("accelerations", quote!(JointAccelerations)),
            ("per_joint", quote!(PerJoint)),
        ]
        .map(|(name, record)| {
            let name = format_ident!("zip_{name}");
            quote! {
                fn #name<T: Value, U: Value, W: Value>(
                    a: &#record<T>,
                    b: &#record<U>,
                    join: impl FnMut(T, U) -> W,
                ) -> #record<W> {
                    a.zip(b, join)
                }
            }
        })
    }

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
        let returned = self.signatures.get("first_moment").map_or(&[][..], |s| &s.fields);
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
            fn external(
                #constants: &Self::Constants<T>,
                #pose: &Self::Pose<T>,
                #bodies: &Wrenches<Self>,
            ) -> Carried<Wrenches<Self>, Wrench<T>> {
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
            fn gravity(
                #constants: &Self::Constants<T>,
                #pose: &Self::Pose<T>,
                #gradient: [T; 6],
            ) -> (Wrenches<Self>, [T; 6]) {
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

/// The joint rates as the kernels take them.
pub(super) fn rates_function(kind: &Kind) -> TokenStream {
    let rates: Vec<_> = kind.links.iter().map(|link| ident(link.joint.rate)).collect();
    quote! {
        #[inline(always)]
        fn rates<T: Real>(joints: &Joints<T>) -> super::Rates<T> {
            super::Rates { #(#rates: joints.#rates),* }
        }
    }
}
