//! The functions and implementations of a kind's second file, line by line, as `rustfmt` has them.

use super::by_number::by_number;
use super::device::{Signatures, body_name, imbalanced, inertia_name, moments};
use super::device_calls::rates_function;
use super::device_parameters::named;
use super::layout::fitted;
use super::text::{COMMENT, pretty_item, wrapped};
use crate::derivation::chain::mount_entry;
use crate::kinds::{Centre, Inertia, Kind, Link, Motion};
use crate::space::Axis;

/// A kind and the signatures of its kernels.
pub(super) struct Items<'a> {
    pub(super) kind: &'a Kind,
    pub(super) signatures: &'a Signatures,
}

/// The number of an axis.
pub(super) fn number(axis: Axis) -> usize {
    axis.cycle()[0]
}

impl Items<'_> {
    /// All of them.
    pub(super) fn lines(&self) -> Vec<String> {
        let items = [
            self.bare(),
            self.collections(),
            self.kernels(),
            self.kind(),
            rates_function(self.kind),
        ];
        let text = items.join("\n\n");
        text.lines().map(str::to_owned).collect()
    }

    pub(super) fn links(&self) -> &'static [Link] {
        self.kind.links
    }

    /// The names of the bodies.
    fn bodies(&self) -> Vec<String> {
        self.links().iter().map(|link| body_name(&link.body)).collect()
    }

    /// One item per link.
    fn each(&self, of: impl Fn(&Link) -> String) -> Vec<String> {
        self.links().iter().map(of).collect()
    }

    /// `PerJoint { .. }` with one value per link.
    pub(super) fn per_joint(
        &self,
        indent: usize,
        prefix: &str,
        close: &str,
        of: impl Fn(&Link) -> String,
    ) -> String {
        let items = self.each(|link| format!("{}: {}", body_name(&link.body), of(link)));
        fitted(indent, &format!("{prefix}PerJoint {{"), &items, close)
    }

    /// The device with nothing but its outermost body.
    fn bare(&self) -> String {
        let (name, tip) = (self.kind.type_name(), &self.links()[self.links().len() - 1].body);
        let mut arguments = vec![format!("{}: T", tip.mass)];
        match tip.inertia {
            Inertia::Full(_) => arguments.push(format!("{}: Matrix3<T>", inertia_name(tip))),
            _ => arguments.extend(moments(tip).iter().map(|name| format!("{name}: T"))),
        }
        let mut fields = vec!["mount: unit()".to_owned()];
        for (k, link) in self.links().iter().enumerate() {
            let body = &link.body;
            let outermost = k + 1 == self.links().len();
            fields.push(format!("{}: vector([zero(); 3])", link.joint.origin.name));
            fields.push(if outermost {
                body.mass.to_owned()
            } else {
                format!("{}: zero()", body.mass)
            });
            match body.centre {
                Centre::Free(triple) => {
                    fields.push(format!("{}: vector([zero(); 3])", triple.name));
                }
                Centre::On(_, name) => fields.push(format!("{name}: zero()")),
                Centre::At => {}
            }
            let names = match body.inertia {
                Inertia::Full(_) => vec![(inertia_name(body), "no_inertia()")],
                _ => moments(body).into_iter().map(|name| (name, "zero()")).collect(),
            };
            fields.extend(
                names.into_iter().map(
                    |(name, none)| {
                        if outermost { name } else { format!("{name}: {none}") }
                    },
                ),
            );
        }
        fields.push("passive: PerJoint::all(Passive::none())".to_owned());
        if imbalanced(self.kind).is_some() {
            fields.push("model: ImbalanceModel::Coupled".to_owned());
        }
        let carried = self.links().len() > 1;
        let carriers = if carried { "other bodies without mass, " } else { "" };
        let mut doc = vec![
            format!(
                "A bare {} at the hub's point B: {carriers}nothing offset, mount the identity.",
                tip.title
            ),
            "Meant as a start for struct update syntax.".to_owned(),
        ];
        if carried {
            doc.push(
                "Massless bodies are legal, and singular in the pose where one would turn about \
                 the axis of the tip."
                    .to_owned(),
            );
        }
        let lines = |text: &String| wrapped(text, COMMENT - 4).join("\n    /// ");
        let doc: Vec<_> = doc.iter().map(lines).collect();
        format!(
            "impl<T: Scalar> {name}<T> {{\n    /// {}\n    #[must_use]\n{} {{\n{}\n    }}\n}}",
            doc.join("\n    ///\n    /// "),
            fitted(4, &format!("pub fn bare_{}(", body_name(tip)), &arguments, ") -> Self"),
            fitted(8, "Self {", &fields, "}")
        )
    }

    /// Walks over joints.
    fn collections(&self) -> String {
        let bodies = self.bodies();
        let plain = |of: &str| self.each(|link| format!("{of}self.{}", body_name(&link.body)));
        let pairs = |of: &str| {
            self.each(|link| {
                let joint = &link.joint;
                format!("[{of}self.{}, {of}self.{}]", joint.coordinate, joint.rate)
            })
        };
        let all: Vec<_> = bodies.iter().map(|body| format!("{body}: value")).collect();
        let bodies: Vec<_> = bodies.iter().map(String::as_str).collect();
        let coordinates = self.links().iter().map(|link| link.joint.coordinate);
        let rates = self.links().iter().map(|link| link.joint.rate);
        let states: Vec<_> = coordinates.chain(rates).collect();
        let values = |name: &str, fields: &dyn Fn(&Link) -> &'static str| {
            let each = self.each(|link| format!("self.{}", fields(link)));
            let each_mut = self.each(|link| format!("&mut self.{}", fields(link)));
            format!(
                "impl<T: Value> Each<T> for {name}<T> {{\n    \
                 fn values(&self) -> impl Iterator<Item = T> {{\n{}\n    }}\n\n    \
                 fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {{\n{}\n    }}\n}}",
                fitted(8, "[", &each, "].into_iter()"),
                fitted(8, "[", &each_mut, "].into_iter()"),
            )
        };
        [
            format!(
                "impl<V: Value> PerJoint<V> {{\n    /// The same value at every joint.\n    \
                 #[must_use]\n    pub fn all(value: V) -> Self {{\n{}\n    }}\n}}",
                fitted(8, "Self {", &all, "}")
            ),
            format!(
                "impl<V: Value> Each<V> for PerJoint<V> {{\n    \
                 fn values(&self) -> impl Iterator<Item = V> {{\n{}\n    }}\n\n    \
                 fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {{\n{}\n    }}\n}}",
                fitted(8, "[", &plain(""), "].into_iter()"),
                fitted(8, "[", &plain("&mut "), "].into_iter()"),
            ),
            format!(
                "impl<T: Value> JointStates<T> for Joints<T> {{\n    \
                 fn states(&self) -> impl Iterator<Item = [T; 2]> {{\n{}\n    }}\n\n    \
                 fn states_mut(&mut self) -> impl Iterator<Item = [&mut T; 2]> {{\n{}\n    }}\n}}",
                fitted(8, "[", &pairs(""), "].into_iter()"),
                fitted(8, "[", &pairs("&mut "), "].into_iter()"),
            ),
            by_number("Joints", "T: Value", &states).join("\n"),
            by_number("PerJoint", "V: Value", &bodies).join("\n"),
            values("MotorTorques", &|link| link.joint.torque),
            values("JointAccelerations", &|link| link.joint.acceleration),
        ]
        .join("\n\n")
    }

    /// The kernels, over any number.
    fn kernels(&self) -> String {
        let name = self.kind.type_name();
        let pose_type = match self.pose_letters().as_slice() {
            [] => "()".to_owned(),
            [one] => format!("super::{}<T>", record_of(one)),
            both => {
                let names: Vec<_> =
                    both.iter().map(|l| format!("super::{}<T>", record_of(l))).collect();
                format!("({})", names.join(", "))
            }
        };
        let mut items = vec![
            format!(
                "    type Constants<T: Value> = super::Prepared<T>;\n    \
                 type Joints<T: Value> = Joints<T>;\n    \
                 type Accelerations<T: Value> = JointAccelerations<T>;\n    \
                 type PerJoint<V: Value> = PerJoint<V>;\n    \
                 type Pose<T: Value> = {pose_type};\n    \
                 type Eliminated<T: Value> = super::Eliminated<T>;\n    \
                 type Gains<T: Value> = super::Gains<T>;"
            ),
            self.pose(),
            self.eliminate(),
            self.pivots(),
            self.back_substitute(),
            self.slope(),
        ];
        items.extend(Self::zips());
        format!("impl<S: Scalar> Kernels for {name}<S> {{\n{}\n}}", items.join("\n\n"))
    }

    /// The implementation of the solver's interface.
    fn kind(&self) -> String {
        let name = self.kind.type_name();
        let zeros = |of: &dyn Fn(&Link) -> Vec<&'static str>| {
            let names: Vec<_> = self.links().iter().flat_map(of).collect();
            names.iter().map(|name| format!("{name}: zero()")).collect::<Vec<_>>()
        };
        let mut at_rest = zeros(&|link| vec![link.joint.coordinate]);
        at_rest.extend(zeros(&|link| vec![link.joint.rate]));
        let [name_item, table, parameter_mut, passive_mut] =
            named(self.kind).map(|item| pretty_item(&item).join("\n"));
        let mut items = vec![
            "    type Scalar = T;\n    type Motors = MotorTorques<T>;".to_owned(),
            name_item,
            self.infos(),
            table,
            parameter_mut,
            passive_mut,
            function("at_rest() -> Joints<T>", &fitted(8, "Joints {", &at_rest, "}")),
            function(
                "motors_off() -> MotorTorques<T>",
                &fitted(8, "MotorTorques {", &zeros(&|link| vec![link.joint.torque]), "}"),
            ),
            function(
                "no_accelerations() -> JointAccelerations<T>",
                &fitted(
                    8,
                    "JointAccelerations {",
                    &zeros(&|link| vec![link.joint.acceleration]),
                    "}",
                ),
            ),
            function("all<V: Value>(value: V) -> PerJoint<V>", "        PerJoint::all(value)"),
            function("mount(&self) -> &Matrix3<T>", "        &self.mount"),
            self.body_parameters(),
            function("passive(&self) -> PerJoint<Passive<T>>", "        self.passive"),
            self.of_bodies(),
        ];
        items.extend(self.balanced());
        items.push(self.constants());
        let share = "constant_share(constants: &super::Prepared<T>) -> ConstantShare<T>";
        items.push(function(share, "        super::constant_share(constants)"));
        items.extend(self.motion());
        items.extend(self.carried());
        format!("impl<T: Scalar> Kind for {name}<T> {{\n{}\n}}", items.join("\n\n"))
    }

    fn infos(&self) -> String {
        let info = |(k, link): (usize, &Link)| {
            let (joint, body) = (&link.joint, &link.body);
            let slides = matches!(joint.motion, Motion::Slide(_));
            let ignorable = !slides && !self.kind.axes_turn(k);
            format!(
                "JointInfo {{\n    index: {k},\n    body: \"{}\",\n    coordinate: \"{}\",\n    \
                 rate: \"{}\",\n    \
                 acceleration: \"{}\",\n    motor: \"{}\",\n    axis: {},\n    slides: {slides},\n    \
                 ignorable: {ignorable},\n    driven: {},\n    tip: {},\n}}",
                body.title,
                joint.coordinate,
                joint.rate,
                joint.acceleration,
                joint.torque,
                number(joint.motion.axis()),
                link.is_driven(),
                k + 1 == self.links().len(),
            )
        };
        let infos: Vec<_> = self.links().iter().enumerate().map(info).collect();
        fitted(4, "const JOINTS: &'static [JointInfo] = &[", &infos, "];")
    }

    fn balanced(&self) -> Vec<String> {
        let Some((body, offset)) = imbalanced(self.kind) else { return Vec::new() };
        let name = inertia_name(body);
        let text = format!(
            "        let [_, j_12, j_13, ..] = entries(&self.{name});\n        \
             let mut {name} = self.{name};\n        \
             ({name}.m12, {name}.m21) = (zero(), zero());\n        \
             ({name}.m13, {name}.m31) = (zero(), zero());\n        \
             let lumped = Lumped {{ u_s: self.{} * self.{offset}, j_12, j_13 }};\n        \
             Some((Self {{ {offset}: zero(), {name}, ..*self }}, lumped))",
            body.mass
        );
        vec![
            function("model(&self) -> ImbalanceModel", "        self.model"),
            function("balanced(&self) -> Option<(Self, Lumped<T>)>", &text),
        ]
    }

    /// `prepare` of the kernel's parameters.
    fn constants(&self) -> String {
        let mut lines = Vec::new();
        let places = (0..3).flat_map(|row| (0..3).map(move |column| (row, column)));
        let entry = |(row, column)| {
            format!("{}: self.mount.m{}{}", mount_entry(row, column), row + 1, column + 1)
        };
        let mut fields: Vec<_> = places.map(entry).collect();
        for (k, link) in self.links().iter().enumerate() {
            let (joint, body) = (&link.joint, &link.body);
            let names = joint.origin.names;
            let from = if k == 0 {
                "origin".to_owned()
            } else {
                format!("components(&self.{})", joint.origin.name)
            };
            lines.push(format!("        let [{}] = {from};", names.join(", ")));
            fields.extend(names.map(str::to_owned));
            match body.centre {
                Centre::Free(triple) => {
                    let from = format!("components(&self.{})", triple.name);
                    lines.push(format!("        let [{}] = {from};", triple.names.join(", ")));
                    fields.extend(triple.names.map(str::to_owned));
                }
                Centre::On(_, name) => fields.push(format!("{name}: self.{name}")),
                Centre::At => {}
            }
            fields.push(format!("{0}: self.{0}", body.mass));
            match body.inertia {
                Inertia::Full(_) => {
                    let names = moments(body);
                    let from = format!("entries(&self.{})", inertia_name(body));
                    lines.push(format!("        let [{}] = {from};", names.join(", ")));
                    fields.extend(names);
                }
                _ => fields.extend(moments(body).iter().map(|name| format!("{name}: self.{name}"))),
            }
        }
        lines.push(fitted(8, "super::prepare(&super::Parameters {", &fields, "})"));
        function("constants(&self, origin: [T; 3]) -> super::Prepared<T>", &lines.join("\n"))
    }
}

/// A function of the implementation.
pub(super) fn function(signature: &str, body: &str) -> String {
    format!("    fn {signature} {{\n{body}\n    }}")
}

/// The record behind an argument of the pose.
fn record_of(letter: &str) -> &'static str {
    if letter == "q" { "Trig" } else { "Positions" }
}
