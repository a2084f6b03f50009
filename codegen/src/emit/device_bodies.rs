//! A kind's parameters as a list of bodies, and back: what every kind can be stated in.

use super::device::{body_name, imbalanced, inertia_name, moments};
use super::device_items::{Items, function, number};
use super::layout::fitted;
use crate::kinds::{Body, Centre, Inertia};

impl Items<'_> {
    /// The bodies of the device.
    pub(super) fn body_parameters(&self) -> String {
        let text = self.per_joint(8, "", "}", |link| {
            let body = &link.body;
            let centre = match body.centre {
                Centre::Free(triple) => format!("components(&self.{})", triple.name),
                Centre::On(axis, name) => {
                    let mut components = ["zero()".to_owned(), "zero()".into(), "zero()".into()];
                    components[number(axis)] = format!("self.{name}");
                    format!("[{}]", components.join(", "))
                }
                Centre::At => "[zero(); 3]".to_owned(),
            };
            let inertia = match body.inertia {
                Inertia::Full(_) => format!("self.{}", inertia_name(body)),
                Inertia::Point => "no_inertia()".to_owned(),
                _ => {
                    let [xx, _, _, yy, _, zz] = body.inertia.names().map(Option::unwrap_or_default);
                    format!("diagonal([self.{xx}, self.{yy}, self.{zz}])")
                }
            };
            format!(
                "BodyParameters {{\n    origin: components(&self.{}),\n    mass: self.{},\n    \
                 centre: {centre},\n    inertia: {inertia},\n}}",
                link.joint.origin.name, body.mass
            )
        });
        function("bodies(&self) -> PerJoint<BodyParameters<T>>", &text)
    }

    /// The device of its bodies: what it has a parameter for is taken over.
    pub(super) fn of_bodies(&self) -> String {
        let mut fields = vec!["mount: *mount".to_owned()];
        for link in self.links() {
            let (body, from) = (&link.body, format!("bodies.{}", body_name(&link.body)));
            fields.push(format!("{}: vector({from}.origin)", link.joint.origin.name));
            fields.push(format!("{}: {from}.mass", body.mass));
            fields.extend(centre(body, &from));
            match body.inertia {
                Inertia::Full(_) => fields.push(format!("{}: {from}.inertia", inertia_name(body))),
                _ => fields.extend(moments(body).iter().map(|name| {
                    let entry = &name[name.len() - 2..];
                    format!("{name}: {from}.inertia.m{entry}")
                })),
            }
        }
        fields.push("passive: *passive".to_owned());
        let model = if imbalanced(self.kind).is_some() {
            fields.push("model".to_owned());
            "model"
        } else {
            "_"
        };
        let arguments = [
            "mount: &Matrix3<T>".to_owned(),
            "bodies: &PerJoint<BodyParameters<T>>".to_owned(),
            "passive: &PerJoint<Passive<T>>".to_owned(),
            format!("{model}: ImbalanceModel"),
        ];
        let signature = fitted(4, "fn of_bodies(", &arguments, ") -> Self {");
        format!("{signature}\n{}\n    }}", fitted(8, "Self {", &fields, "}"))
    }
}

/// The field of a centre of mass, where there is one.
fn centre(body: &Body, from: &str) -> Option<String> {
    match body.centre {
        Centre::Free(triple) => Some(format!("{}: vector({from}.centre)", triple.name)),
        Centre::On(axis, name) => Some(format!("{name}: {from}.centre[{}]", number(axis))),
        Centre::At => None,
    }
}
