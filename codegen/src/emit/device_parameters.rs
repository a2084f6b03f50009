//! The parameters of a kind as a user states them: one row each, from which the structure's fields
//! and their documentation, the table of names and the access by name follow.

use proc_macro2::TokenStream;
use quote::quote;

use super::device::{imbalanced, inertia_name, moments};
use super::text::{capital, ident};
use crate::kinds::{Centre, Inertia, Kind, Link, Motion};

/// A parameter.
pub(super) struct Parameter {
    /// The field of the structure.
    pub(super) name: String,
    /// As the paper writes it.
    symbol: String,
    /// Unit of each component; empty where there is no number.
    unit: &'static str,
    /// What the components form.
    shape: Shape,
    /// The frame that the components are expressed in: `B` or a body.
    frame: Option<&'static str>,
    /// The body that it belongs to.
    body: Option<&'static str>,
    /// What it is.
    meaning: String,
    /// What a user has to know beside it.
    note: String,
}

/// What the components of a parameter form: `Shape` of the dynamics crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Scalar,
    Vector,
    Rotation,
    Symmetric,
    Model,
}

/// The parameters in the order of the structure; `passive` comes before the last, the model, where
/// the kind has one, and is none of them.
pub(super) fn parameters(kind: &Kind) -> Vec<Parameter> {
    let mut list = vec![mount(kind)];
    for (k, link) in kind.links.iter().enumerate() {
        list.extend(origin(kind, k));
        list.extend(mass(link, k + 1 == kind.links.len()));
        list.extend(centre(link));
        list.extend(inertia(link));
    }
    if let Some((body, _)) = imbalanced(kind) {
        list.push(Parameter {
            name: "model".to_owned(),
            symbol: String::new(),
            unit: "",
            shape: Shape::Model,
            frame: None,
            body: Some(body.title),
            meaning: "whether the imbalance is coupled with all motion or lumped".to_owned(),
            note: String::new(),
        });
    }
    list
}

fn mount(kind: &Kind) -> Parameter {
    let joint = |link: &Link| {
        let (verb, axis) = match link.joint.motion {
            Motion::Turn(axis) => ("turns about", axis),
            Motion::Slide(axis) => ("slides along", axis),
        };
        format!("the {} {verb} {axis:?}", link.body.title).to_lowercase()
    };
    let joints: Vec<_> = kind.links.iter().map(joint).collect();
    Parameter {
        name: "mount".to_owned(),
        symbol: "mount".to_owned(),
        unit: "1",
        shape: Shape::Rotation,
        frame: Some("B"),
        body: None,
        meaning: "columns: the device's axes, those of its first body at zero".to_owned(),
        note: format!(" At zero, {}.", joints.join(", ")),
    }
}

fn origin(kind: &Kind, k: usize) -> Option<Parameter> {
    let (joint, body) = (&kind.links[k].joint, &kind.links[k].body);
    let origin = joint.place()?;
    let inboard = k.checked_sub(1).map(|k| kind.links[k].body.title);
    let from = inboard.map_or("B".to_owned(), |parent| format!("the origin of the {parent}"));
    let slides = match joint.motion {
        Motion::Turn(_) => "",
        Motion::Slide(_) => ", the coordinate at zero",
    };
    Some(Parameter {
        name: origin.name.to_owned(),
        symbol: origin.symbol.to_owned(),
        unit: "m",
        shape: Shape::Vector,
        frame: Some(inboard.unwrap_or("B")),
        body: Some(body.title),
        meaning: format!("origin of the {} from {from}{slides}", body.title),
        note: String::new(),
    })
}

fn mass(link: &Link, tip: bool) -> Option<Parameter> {
    let body = &link.body;
    Some(Parameter {
        name: body.mass?.to_owned(),
        symbol: format!("m_{}", body.letters[0]),
        unit: "kg",
        shape: Shape::Scalar,
        frame: None,
        body: Some(body.title),
        meaning: format!("mass of the {}", body.title),
        note: if tip { " Above zero." } else { " Zero is legal." }.to_owned(),
    })
}

fn centre(link: &Link) -> Option<Parameter> {
    let title = link.body.title;
    let (name, symbol, shape, meaning) = match link.body.centre {
        Centre::Free(triple) => {
            let meaning = format!("centre of mass of the {title} from its origin");
            (triple.name, triple.symbol, Shape::Vector, meaning)
        }
        Centre::On(axis, name) => {
            let axis = format!("{axis:?}").to_lowercase();
            let meaning =
                format!("centre of mass of the {title} from its origin, on its {axis} axis");
            (name, name, Shape::Scalar, meaning)
        }
        Centre::At => return None,
    };
    Some(Parameter {
        name: name.to_owned(),
        symbol: symbol.to_owned(),
        unit: "m",
        shape,
        frame: Some(title),
        body: Some(title),
        meaning,
        note: String::new(),
    })
}

fn inertia(link: &Link) -> Vec<Parameter> {
    let (body, title) = (&link.body, link.body.title);
    let [letter, point] = body.letters;
    let symbol = format!("[I_{{{letter},{point}}}]");
    let about = format!("of the {title} about its centre of mass");
    let row = |name: String, symbol: String, shape, meaning| Parameter {
        name,
        symbol,
        unit: "kg m²",
        shape,
        frame: Some(title),
        body: Some(title),
        meaning,
        note: String::new(),
    };
    match body.inertia {
        Inertia::Full(_) => {
            vec![row(inertia_name(body), symbol, Shape::Symmetric, format!("inertia {about}"))]
        }
        Inertia::Diagonal(_) | Inertia::Symmetric(..) | Inertia::Point => {
            let entry = |name: String| {
                let entry = name[name.len() - 2..].to_owned();
                let meaning = format!("entry {entry} of the inertia {about}");
                row(name, format!("{symbol}_{entry}"), Shape::Scalar, meaning)
            };
            moments(body).into_iter().map(entry).collect()
        }
    }
}

impl Parameter {
    /// The documentation of the field.
    pub(super) fn doc(&self) -> String {
        let frame = match self.frame {
            Some("B") => ", expressed in *B*".to_owned(),
            Some(body) if self.shape != Shape::Scalar => {
                format!(", expressed in the axes of the {body}")
            }
            _ => String::new(),
        };
        let symbol = match self.symbol.as_str() {
            "" | "mount" => String::new(),
            symbol => format!("`{symbol}`, "),
        };
        let unit = match self.unit {
            "" | "1" => String::new(),
            unit => format!(", {unit}"),
        };
        let text = format!("{symbol}{}{frame}{unit}.{}", self.meaning, self.note);
        if symbol.is_empty() { capital(&text) } else { text }
    }

    /// The type of the field.
    pub(super) fn field_type(&self) -> TokenStream {
        match self.shape {
            Shape::Scalar => quote!(T),
            Shape::Vector => quote!(Vector3<T>),
            Shape::Rotation | Shape::Symmetric => quote!(Matrix3<T>),
            Shape::Model => quote!(ImbalanceModel),
        }
    }

    /// The row of the table.
    fn info(&self) -> TokenStream {
        let Self { name, symbol, unit, shape, frame, body, meaning, .. } = self;
        let shape = ident(format!("{shape:?}"));
        let option = |text: Option<&str>| text.map_or(quote!(None), |text| quote!(Some(#text)));
        let (frame, body) = (option(*frame), option(*body));
        quote! {
            ParameterInfo {
                name: #name,
                symbol: #symbol,
                unit: #unit,
                shape: Shape::#shape,
                frame: #frame,
                body: #body,
                meaning: #meaning,
            }
        }
    }

    /// The arm that finds the field.
    fn arm(&self) -> TokenStream {
        let (name, field) = (&self.name, ident(&self.name));
        let variant = match self.shape {
            Shape::Scalar => quote!(Scalar),
            Shape::Vector => quote!(Vector),
            Shape::Rotation | Shape::Symmetric => quote!(Matrix),
            Shape::Model => quote!(Model),
        };
        quote!(#name => ParameterMut::#variant(&mut self.#field))
    }
}

/// The items of `Kind` that name the kind and its parameters.
pub(super) fn named(kind: &Kind) -> [TokenStream; 4] {
    let (name, list) = (kind.name, parameters(kind));
    let (infos, arms) = (list.iter().map(Parameter::info), list.iter().map(Parameter::arm));
    [
        quote!(const NAME: &'static str = #name;),
        quote!(const PARAMETERS: &'static [ParameterInfo] = &[#(#infos),*];),
        quote! {
            fn parameter_mut(&mut self, name: &str) -> Option<ParameterMut<'_, T>> {
                let field = match name {
                    #(#arms,)*
                    _ => return None,
                };
                Some(field)
            }
        },
        quote! {
            fn passive_mut(&mut self) -> &mut PerJoint<Passive<T>> {
                &mut self.passive
            }
        },
    ]
}
