//! The functions and implementations of a kind's second file, as tokens.
//!
//! Names are those of the kind's data; each list has one entry per link, from the hub to the tip.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::Index;

use super::device::{Signatures, body_name, imbalanced, inertia_name, moments};
use super::device_calls::rates_function;
use super::device_parameters::named;
use super::map_and_zip::map_and_zip;
use super::text::{COMMENT, documented, ident};
use crate::derivation::chain::assumed::mount_entry;
use crate::kinds::{Centre, Inertia, Kind, Link, Motion};
use crate::space::Axis;

/// A kind and the signatures of its kernels.
pub(super) struct Items<'a> {
    pub(super) kind: &'a Kind,
    pub(super) signatures: &'a Signatures,
    /// The feature that derivatives are part of; none where the crate has none.
    pub(super) feature: Option<&'static str>,
}

/// The number of an axis.
pub(super) fn number(axis: Axis) -> Index {
    Index::from(axis.cycle()[0])
}

impl Items<'_> {
    /// All of them.
    pub(super) fn all(&self) -> TokenStream {
        let rates = rates_function(self.kind);
        let items = [self.bare(), self.collections(), self.kernels(), self.kind(), rates];
        quote!(#(#items)*)
    }

    pub(super) fn links(&self) -> &'static [Link] {
        self.kind.links
    }

    /// The structure of the kind.
    fn name(&self) -> Ident {
        ident(self.kind.type_name())
    }

    /// One item per link.
    pub(super) fn each<I>(&self, of: impl Fn(&Link) -> I) -> Vec<I> {
        self.links().iter().map(of).collect()
    }

    /// `PerJoint { .. }` with one value per link.
    pub(super) fn per_joint(&self, of: impl Fn(&Link) -> TokenStream) -> TokenStream {
        let (bodies, values) = (self.each(|link| ident(body_name(&link.body))), self.each(of));
        quote!(PerJoint { #(#bodies: #values),* })
    }

    /// The device with nothing but its outermost body.
    fn bare(&self) -> TokenStream {
        let (name, tip) = (self.name(), &self.links()[self.links().len() - 1].body);
        let mut arguments: Vec<_> = tip.mass.iter().map(|mass| set(mass, &quote!(T))).collect();
        match tip.inertia {
            Inertia::Full(_) => arguments.push(set(inertia_name(tip), &quote!(Matrix3<T>))),
            Inertia::Diagonal(_) | Inertia::Symmetric(..) | Inertia::Point => {
                arguments.extend(moments(tip).iter().map(|name| set(name, &quote!(T))));
            }
        }
        let mut fields = vec![quote!(mount: unit())];
        for (k, link) in self.links().iter().enumerate() {
            let body = &link.body;
            let given = |name: &str, none: TokenStream| {
                let outermost = k + 1 == self.links().len();
                if outermost { ident(name).to_token_stream() } else { set(name, &none) }
            };
            let place = link.joint.place();
            fields.extend(place.map(|place| set(place.name, &quote!(vector([zero(); 3])))));
            fields.extend(body.mass.map(|mass| given(mass, quote!(zero()))));
            match body.centre {
                Centre::Free(triple) => fields.push(set(triple.name, &quote!(vector([zero(); 3])))),
                Centre::On(_, name) => fields.push(set(name, &quote!(zero()))),
                Centre::At => {}
            }
            match body.inertia {
                Inertia::Full(_) => fields.push(given(&inertia_name(body), quote!(no_inertia()))),
                Inertia::Diagonal(_) | Inertia::Symmetric(..) | Inertia::Point => {
                    fields.extend(moments(body).iter().map(|name| given(name, quote!(zero()))));
                }
            }
        }
        fields.push(quote!(passive: PerJoint::all(Passive::none())));
        if imbalanced(self.kind).is_some() {
            fields.push(quote!(model: ImbalanceModel::Coupled));
        }
        let carried = self.links().len() > 1;
        let carriers = if carried { "other bodies without mass, " } else { "" };
        let mut doc = format!(
            "A bare {} at the hub's point B: {carriers}nothing offset, mount the identity.\n\n\
             Meant as a start for struct update syntax.",
            tip.title
        );
        if carried {
            doc.push_str(
                "\n\nMassless bodies are legal, and singular in the pose where one would turn \
                 about the axis of the tip.",
            );
        }
        let (doc, bare) = (documented(&doc, COMMENT - 4), format_ident!("bare_{}", body_name(tip)));
        quote! {
            impl<T: Scalar> #name<T> {
                #doc
                #[must_use]
                pub fn #bare(#(#arguments),*) -> Self {
                    Self { #(#fields),* }
                }
            }
        }
    }

    /// Walks over joints.
    fn collections(&self) -> TokenStream {
        let bodies = self.each(|link| body_name(&link.body));
        let fields: Vec<_> = bodies.iter().map(ident).collect();
        let coordinates = self.each(|link| ident(link.joint.coordinate));
        let rates = self.each(|link| ident(link.joint.rate));
        let values = |number: TokenStream, record: TokenStream, fields: &[Ident]| {
            quote! {
                impl<#number: Value> Each<#number> for #record<#number> {
                    fn values(&self) -> impl Iterator<Item = #number> {
                        [#(self.#fields),*].into_iter()
                    }
                    fn values_mut(&mut self) -> impl Iterator<Item = &mut #number> {
                        [#(&mut self.#fields),*].into_iter()
                    }
                }
            }
        };
        let parts = [
            quote! {
                impl<V: Value> PerJoint<V> {
                    /// The same value at every joint.
                    #[must_use]
                    pub fn all(value: V) -> Self {
                        Self { #(#fields: value),* }
                    }
                }
            },
            values(quote!(V), quote!(PerJoint), &fields),
            quote! {
                impl<T: Value> JointStates<T> for Joints<T> {
                    fn states(&self) -> impl Iterator<Item = [T; 2]> {
                        [#([self.#coordinates, self.#rates]),*].into_iter()
                    }
                    fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {
                        [#([&mut self.#coordinates, &mut self.#rates]),*].into_iter()
                    }
                }
            },
            values(quote!(T), quote!(MotorTorques), &self.each(|link| ident(link.joint.torque))),
            values(
                quote!(T),
                quote!(JointAccelerations),
                &self.each(|link| ident(link.joint.acceleration)),
            ),
        ];
        quote!(#(#parts)*)
    }

    /// What changes and joins records of joints number by number, line by line.
    pub(super) fn by_number(&self, dynamics: &str) -> Vec<String> {
        let mut states = self.each(|link| link.joint.coordinate);
        states.extend(self.each(|link| link.joint.rate));
        let bodies = self.each(|link| body_name(&link.body));
        let mut lines = map_and_zip(dynamics, "Joints", ["T", "Value"], &states);
        lines.push(String::new());
        lines.extend(map_and_zip(dynamics, "PerJoint", ["V", "Value"], &bodies));
        lines
    }

    /// The kernels, over any number.
    fn kernels(&self) -> TokenStream {
        let record = |letter: &&str| if *letter == "q" { quote!(Trig) } else { quote!(Positions) };
        let records: Vec<_> = self.pose_letters().iter().map(record).collect();
        let pose_type = match records.as_slice() {
            [one] => quote!(super::#one<T>),
            none_or_both => quote!((#(super::#none_or_both<T>),*)),
        };
        let mut items = vec![self.pose()];
        items.extend(self.eliminate());
        items.extend([self.pivots(), self.back_substitute(), self.slope()]);
        items.extend([self.load_derivatives(), self.external(), self.gravity()]);
        items.extend(self.zips());
        let (name, gains) = (self.name(), self.gains_type());
        quote! {
            impl<S: Scalar> Kernels for #name<S> {
                type Constants<T: Value> = super::Prepared<T>;
                type Joints<T: Value> = Joints<T>;
                type Accelerations<T: Value> = JointAccelerations<T>;
                type PerJoint<V: Value> = PerJoint<V>;
                type Pose<T: Value> = #pose_type;
                type Eliminated<T: Value> = super::Eliminated<T>;
                type Gains<T: Value> = #gains;
                #(#[inline(always)] #items)*
            }
        }
    }

    /// The implementation of the solver's interface.
    fn kind(&self) -> TokenStream {
        let name = self.name();
        let [name_item, table, parameter_mut, passive_mut] = named(self.kind);
        let infos = self.links().iter().enumerate().map(|(k, link)| self.info(k, link));
        let coordinates = self.each(|link| ident(link.joint.coordinate));
        let rates = self.each(|link| ident(link.joint.rate));
        let torques = self.each(|link| ident(link.joint.torque));
        let accelerations = self.each(|link| ident(link.joint.acceleration));
        let (bodies, of_bodies) = (self.body_parameters(), self.of_bodies());
        let (balanced, constants) = (self.balanced(), self.constants());
        let called =
            [self.energy_momentum(), self.first_moment(), self.axes(), self.loads(), self.steer()];
        quote! {
            impl<T: Scalar> Kind for #name<T> {
                type Scalar = T;
                type Motors = MotorTorques<T>;
                type With<U: Scalar> = #name<U>;
                #name_item
                const JOINTS: &'static [JointInfo] = &[#(#infos),*];
                #table
                #parameter_mut
                #passive_mut
                fn at_rest() -> Joints<T> {
                    Joints { #(#coordinates: zero(),)* #(#rates: zero()),* }
                }
                fn motors_off() -> MotorTorques<T> {
                    MotorTorques { #(#torques: zero()),* }
                }
                fn no_accelerations() -> JointAccelerations<T> {
                    JointAccelerations { #(#accelerations: zero()),* }
                }
                fn all<V: Value>(value: V) -> PerJoint<V> {
                    PerJoint::all(value)
                }
                fn mount(&self) -> &Matrix3<T> {
                    &self.mount
                }
                #bodies
                fn passive(&self) -> PerJoint<Passive<T>> {
                    self.passive
                }
                #of_bodies
                #balanced
                #constants
                fn constant_share(constants: &super::Prepared<T>) -> ConstantShare<T> {
                    super::constant_share(constants)
                }
                #(#called)*
            }
        }
    }

    /// A row of the table of joints.
    fn info(&self, k: usize, link: &Link) -> TokenStream {
        let (joint, title) = (&link.joint, link.body.title);
        let (coordinate, rate) = (joint.coordinate, joint.rate);
        let (acceleration, motor) = (joint.acceleration, joint.torque);
        let slides = matches!(joint.motion, Motion::Slide(_));
        let ignorable = !slides && !self.kind.axes_turn(k);
        let (driven, tip) = (link.is_driven(), k + 1 == self.links().len());
        let (index, axis) = (Index::from(k), number(joint.motion.axis()));
        quote! {
            JointInfo {
                index: #index,
                body: #title,
                coordinate: #coordinate,
                rate: #rate,
                acceleration: #acceleration,
                motor: #motor,
                axis: #axis,
                slides: #slides,
                ignorable: #ignorable,
                driven: #driven,
                tip: #tip,
            }
        }
    }

    /// The imbalance, and the device without it.
    fn balanced(&self) -> TokenStream {
        let Some((body, offset)) = imbalanced(self.kind) else { return TokenStream::new() };
        let Some(mass) = body.mass else { return TokenStream::new() };
        let [name, mass] = [inertia_name(body), mass.to_owned()].map(ident);
        let offset = ident(offset);
        quote! {
            fn model(&self) -> ImbalanceModel {
                self.model
            }
            fn balanced(&self) -> Option<(Self, Lumped<T>)> {
                let [_, j_12, j_13, ..] = entries(&self.#name);
                let mut #name = self.#name;
                (#name.m12, #name.m21) = (zero(), zero());
                (#name.m13, #name.m31) = (zero(), zero());
                let lumped = Lumped { u_s: self.#mass * self.#offset, j_12, j_13 };
                Some((Self { #offset: zero(), #name, ..*self }, lumped))
            }
        }
    }

    /// `prepare` of the kernel's parameters.
    fn constants(&self) -> TokenStream {
        let field = |name: &str| set(name, &own(name));
        let places = (0..3).flat_map(|row| (0..3).map(move |column| (row, column)));
        let entry = |(row, column)| {
            let of = format_ident!("m{}{}", row + 1, column + 1);
            set(mount_entry(row, column), &quote!(self.mount.#of))
        };
        let (mut lets, mut fields) = (Vec::new(), places.map(entry).collect::<Vec<_>>());
        for (k, link) in self.links().iter().enumerate() {
            let (joint, body) = (&link.joint, &link.body);
            let mut taken = |names: &[Ident], from: TokenStream| {
                lets.push(quote!(let [#(#names),*] = #from;));
                names.iter().map(Ident::to_token_stream).collect::<Vec<_>>()
            };
            if let Some(place) = joint.place() {
                let from = if k == 0 { quote!(origin) } else { components(place.name) };
                fields.extend(taken(&place.names.map(ident), from));
            }
            match body.centre {
                Centre::Free(triple) => {
                    fields.extend(taken(&triple.names.map(ident), components(triple.name)));
                }
                Centre::On(_, name) => fields.push(field(name)),
                Centre::At => {}
            }
            fields.extend(body.mass.map(field));
            match body.inertia {
                Inertia::Full(_) => {
                    let names: Vec<_> = moments(body).iter().map(ident).collect();
                    let inertia = own(inertia_name(body));
                    fields.extend(taken(&names, quote!(entries(&#inertia))));
                }
                Inertia::Diagonal(_) | Inertia::Symmetric(..) | Inertia::Point => {
                    fields.extend(moments(body).iter().map(|name| field(name)));
                }
            }
        }
        quote! {
            fn constants(&self, origin: [T; 3]) -> super::Prepared<T> {
                #(#lets)*
                super::prepare(&super::Parameters { #(#fields),* })
            }
        }
    }
}

/// A field, or an argument, and what follows its name.
pub(super) fn set(name: impl AsRef<str>, what: &TokenStream) -> TokenStream {
    let name = ident(name);
    quote!(#name: #what)
}

/// A parameter of the device.
pub(super) fn own(name: impl AsRef<str>) -> TokenStream {
    let name = ident(name);
    quote!(self.#name)
}

/// The components of a parameter that is a vector.
pub(super) fn components(name: &str) -> TokenStream {
    let vector = own(name);
    quote!(components(&#vector))
}
