//! How a kind's second file calls the kernels that solve the equations: arguments gathered, results
//! put into structures. Those that are read beside a solution are in `device_results`.
//!
//! A function of the interface names its parameter only if the kernel reads something of it.

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};
use syn::Index;

use super::device::body_name;
use super::device_items::Items;
use super::text::ident;
use crate::kernel::{Record, pose};
use crate::kinds::Kind;

/// Parameters of several functions, each with the letters of the kernels' arguments that are made
/// of it.
pub(super) const P: (&str, &str) = ("constants", "p");
pub(super) const Q: (&str, &str) = ("pose", "qs");
pub(super) const V: (&str, &str) = ("joints", "v");
pub(super) const W: (&str, &str) = ("omega", "w");
const U: (&str, &str) = ("drives", "um");
pub(super) const A: (&str, &str) = ("hub", "a");

impl Items<'_> {
    /// The letters of a kernel's arguments.
    pub(super) fn letters(&self, kernel: &str) -> &[&'static str] {
        self.signatures.get(kernel).map_or(&[], |signature| signature.letters.as_slice())
    }

    /// Letters of what a pose consists of.
    pub(super) fn pose_letters(&self) -> Vec<&'static str> {
        pose(self.kind).into_iter().map(|(letter, _)| letter).collect()
    }

    /// The fields that a kernel returns.
    pub(super) fn returned(&self, kernel: &str) -> &[String] {
        self.signatures.get(kernel).map_or(&[], |signature| signature.fields.as_slice())
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
    pub(super) fn call(&self, kernel: &str) -> TokenStream {
        let arguments = self.letters(kernel).iter().map(|letter| self.argument(letter));
        let kernel = ident(kernel);
        quote!(super::#kernel(#(#arguments),*))
    }

    /// The names of parameters in a function that calls a kernel, each with the letters of the
    /// kernel's arguments that are made of it.
    pub(super) fn names<const N: usize>(
        &self,
        kernel: &str,
        given: [(&str, &str); N],
    ) -> [TokenStream; N] {
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
        let links = self.kind.links.iter().enumerate();
        let turning = links.filter(|(joint, _)| self.kind.axes_turn(*joint));
        let sines: Vec<_> = turning
            .map(|(joint, link)| {
                let (joint, angle) = (Index::from(joint), ident(link.joint.coordinate));
                let (sine, cosine) = (format_ident!("sin_{angle}"), format_ident!("cos_{angle}"));
                quote!(let (#sine, #cosine) = sin_cos(#joint, joints.#angle);)
            })
            .collect();
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
        let sin_cos = if sines.is_empty() { quote!(_) } else { quote!(mut sin_cos) };
        quote! {
            fn pose_by<T: Value>(
                #joints: &Joints<T>,
                #sin_cos: impl FnMut(usize, T) -> (T, T),
            ) -> Self::Pose<T> {
                #(#sines)*
                #result
            }
        }
    }

    /// The elimination, and its two parts.
    pub(super) fn eliminate(&self) -> [TokenStream; 3] {
        let driven: Vec<_> = self.kind.driven().collect();
        let read = |letter: &str| self.letters("eliminate").contains(&letter);
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
        // A kind whose joints all keep their rates has neither.
        let motors = read("u").then(|| quote!(let motors = super::Motors { #(#motors),* };));
        let modes = read("m").then(|| quote!(let modes = super::Modes { #(#modes),* };));
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
                    #motors
                    #modes
                    #call
                }
            },
            quote! {
                fn share<T: Real>(eliminated: &Self::Eliminated<T>) -> &HubShare<T> {
                    &eliminated.share
                }
            },
            if self.is_driven() {
                quote! {
                    fn gains<T: Real>(eliminated: &Self::Eliminated<T>) -> &Self::Gains<T> {
                        &eliminated.gains
                    }
                }
            } else {
                quote! {
                    fn gains<T: Real>(_: &Self::Eliminated<T>) -> &Self::Gains<T> {
                        &()
                    }
                }
            },
        ]
    }

    pub(super) fn pivots(&self) -> TokenStream {
        let returned = self.returned("eliminate");
        let pivots = self.per_joint(|link| {
            if link.is_driven() {
                let names = ["pivot", "diagonal"].map(|what| format!("{what}_{}", link.joint.tag));
                let [pivot, own] = names.each_ref().map(ident);
                let diagonal = if returned.contains(&names[1]) { own } else { pivot.clone() };
                quote!(Some([eliminated.#pivot, eliminated.#diagonal]))
            } else {
                quote!(None)
            }
        });
        let eliminated = if self.is_driven() { quote!(eliminated) } else { quote!(_) };
        quote! {
            fn pivots<T: Real>(#eliminated: &Self::Eliminated<T>) -> PerJoint<Option<[T; 2]>> {
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
    pub(super) fn zips(&self) -> Vec<TokenStream> {
        let zip = |name: &str, record: TokenStream| {
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
        };
        let no_gains = || {
            quote! {
                fn zip_gains<T: Value, U: Value, W: Value>(
                    _: &(),
                    _: &(),
                    _: impl FnMut(T, U) -> W,
                ) {
                }
            }
        };
        vec![
            zip("constants", quote!(super::Prepared)),
            zip("joints", quote!(Joints)),
            if self.is_driven() { zip("gains", quote!(super::Gains)) } else { no_gains() },
            zip("accelerations", quote!(JointAccelerations)),
            zip("per_joint", quote!(PerJoint)),
        ]
    }

    /// What back substitution needs: nothing where every joint of the kind keeps its rate.
    pub(super) fn gains_type(&self) -> TokenStream {
        if self.is_driven() { quote!(super::Gains<T>) } else { quote!(()) }
    }

    /// Whether any joint has a motor.
    fn is_driven(&self) -> bool {
        self.kind.driven().next().is_some()
    }
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
