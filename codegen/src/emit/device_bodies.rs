//! A kind's parameters as a list of bodies, and back: what every kind can be stated in.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::device::{body_name, imbalanced, inertia_name, moments};
use super::device_items::{Items, components, number, own, set};
use super::text::ident;
use crate::kinds::{Centre, Inertia, Link};

impl Items<'_> {
    /// The bodies of the device.
    pub(super) fn body_parameters(&self) -> TokenStream {
        let bodies = self.per_joint(|link| {
            let body = &link.body;
            let centre = match body.centre {
                Centre::Free(triple) => components(triple.name),
                Centre::On(axis, name) => {
                    let mut components = [quote!(zero()), quote!(zero()), quote!(zero())];
                    components[axis.cycle()[0]] = own(name);
                    quote!([#(#components),*])
                }
                Centre::At => quote!([zero(); 3]),
            };
            let inertia = match body.inertia {
                Inertia::Full(_) => own(inertia_name(body)),
                Inertia::Point => quote!(no_inertia()),
                Inertia::Diagonal(_) | Inertia::Symmetric(..) => {
                    let [xx, _, _, yy, _, zz] = body.inertia.names().map(Option::unwrap_or_default);
                    let moments = [xx, yy, zz].map(own);
                    quote!(diagonal([#(#moments),*]))
                }
            };
            let origin = link.joint.place();
            let origin = origin.map_or(quote!([zero(); 3]), |place| components(place.name));
            let mass = body.mass.map_or(quote!(zero()), own);
            quote! {
                BodyParameters {
                    origin: #origin,
                    mass: #mass,
                    centre: #centre,
                    inertia: #inertia,
                }
            }
        });
        quote! {
            fn bodies(&self) -> PerJoint<BodyParameters<T>> {
                #bodies
            }
        }
    }

    /// The device of its bodies: what it has a parameter for is taken over.
    pub(super) fn of_bodies(&self) -> TokenStream {
        let fields = self.links().iter().flat_map(of_body);
        let (model, given) = match imbalanced(self.kind) {
            Some(_) => (quote!(model), quote!(model)),
            None => (quote!(), quote!(_)),
        };
        quote! {
            fn of_bodies(
                mount: &Matrix3<T>,
                bodies: &PerJoint<BodyParameters<T>>,
                passive: &PerJoint<Passive<T>>,
                #given: ImbalanceModel,
            ) -> Self {
                Self { mount: *mount, #(#fields,)* passive: *passive, #model }
            }
        }
    }
}

/// The fields of a device that one of its bodies gives.
fn of_body(link: &Link) -> Vec<TokenStream> {
    let (body, of) = (&link.body, ident(body_name(&link.body)));
    let mut fields = Vec::new();
    let place = link.joint.place();
    fields.extend(place.map(|place| set(place.name, &quote!(vector(bodies.#of.origin)))));
    fields.extend(body.mass.map(|mass| set(mass, &quote!(bodies.#of.mass))));
    match body.centre {
        Centre::Free(triple) => {
            fields.push(set(triple.name, &quote!(vector(bodies.#of.centre))));
        }
        Centre::On(axis, name) => {
            let component = number(axis);
            fields.push(set(name, &quote!(bodies.#of.centre[#component])));
        }
        Centre::At => {}
    }
    match body.inertia {
        Inertia::Full(_) => fields.push(set(inertia_name(body), &quote!(bodies.#of.inertia))),
        Inertia::Diagonal(_) | Inertia::Symmetric(..) | Inertia::Point => {
            fields.extend(moments(body).iter().map(|name| {
                let entry = format_ident!("m{}", &name[name.len() - 2..]);
                set(name, &quote!(bodies.#of.inertia.#entry))
            }));
        }
    }
    fields
}
