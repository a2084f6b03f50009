//! How a kind's second file calls the kernels: arguments gathered, results put into structures.

use super::device::body_name;
use super::device_items::{Items, function};
use super::layout::fitted;
use crate::derivation::chain::XYZ;
use crate::kernel::pose;
use crate::kinds::{Kind, Link};

/// A parameter of the interface: its name, its type, and the letters of the kernels' arguments that
/// are made of it.
type Parameter = (&'static str, &'static str, &'static [&'static str]);

const CONSTANTS: Parameter = ("constants", "&Self::Constants<T>", &["p"]);
const POSE: Parameter = ("pose", "&Self::Pose<T>", &["q", "s"]);
const JOINTS: Parameter = ("joints", "&Joints<T>", &["v"]);
const OMEGA: Parameter = ("omega", "&BodyRate<T>", &["w"]);
const DRIVES: Parameter = ("drives", "&PerJoint<Drive<T>>", &["u", "m"]);
const VELOCITY: Parameter = ("hub", "&BodyVelocity<T>", &["b"]);
const ACCELERATION: Parameter = ("hub", "&BodyAcceleration<T>", &["a"]);
const ACCELERATIONS: Parameter = ("accelerations", "&JointAccelerations<T>", &["j"]);
const BODIES: Parameter = ("bodies", "&Wrenches<Self>", &["x"]);
const GRADIENT: Parameter = ("gradient", "[T; 6]", &["g"]);
/// Joints of a function that makes the pose itself.
const POSED: Parameter = ("joints", "&Joints<T>", &["q", "s", "v"]);

impl Items<'_> {
    /// The letters of a kernel's arguments.
    fn letters(&self, kernel: &str) -> &[&'static str] {
        self.signatures.get(kernel).map_or(&[], |signature| signature.letters.as_slice())
    }

    /// Letters of what a pose consists of.
    pub(super) fn pose_letters(&self) -> Vec<&'static str> {
        pose(self.kind).into_iter().map(|(letter, _)| letter).collect()
    }

    /// The argument of a kernel behind a letter.
    fn argument(&self, letter: &str) -> String {
        let letters = self.pose_letters();
        let place = letters.iter().position(|known| *known == letter);
        match (letter, place) {
            ("p", _) => "constants".to_owned(),
            (_, Some(_)) if letters.len() == 1 => "pose".to_owned(),
            (_, Some(place)) => format!("&pose.{place}"),
            ("v", _) => "&rates(joints)".to_owned(),
            ("w", _) => "omega".to_owned(),
            ("a" | "b", _) => "hub".to_owned(),
            ("u", _) => "&motors".to_owned(),
            ("m", _) => "&modes".to_owned(),
            ("j", _) => "accelerations".to_owned(),
            ("x", _) => "&wrenches".to_owned(),
            ("g", _) => "&gradient".to_owned(),
            _ => letter.to_owned(),
        }
    }

    /// `super::kernel(arguments)`.
    fn call(&self, indent: usize, before: &str, kernel: &str, after: &str) -> String {
        let arguments: Vec<_> = self.letters(kernel).iter().map(|l| self.argument(l)).collect();
        fitted(indent, &format!("{before}super::{kernel}("), &arguments, &format!("){after}"))
    }

    /// A function that asks one kernel; what the kernel does not read has no name. The name may have
    /// type parameters.
    fn asks(
        &self,
        name: &str,
        kernel: &str,
        given: &[Parameter],
        result: &str,
        body: &str,
    ) -> String {
        let read = self.letters(kernel);
        let parameter = |(name, ty, letters): &Parameter| {
            let used = letters.iter().any(|letter| read.contains(letter));
            let empty = *ty == POSE.1 && self.pose_letters().is_empty();
            format!(
                "{}: {ty}",
                if used {
                    name
                } else if empty {
                    "()"
                } else {
                    "_"
                }
            )
        };
        let parameters: Vec<_> = given.iter().map(parameter).collect();
        let head = fitted(4, &format!("fn {name}("), &parameters, &format!(") -> {result} {{"));
        format!("{head}\n{body}\n    }}")
    }

    /// Sines, cosines and lengths.
    pub(super) fn pose(&self) -> String {
        let mut lines = Vec::new();
        for link in self.kind.turning() {
            let angle = link.joint.coordinate;
            lines.push(format!(
                "        let (sin_{angle}, cos_{angle}) = joints.{angle}.sin_cos();"
            ));
        }
        let records = pose(self.kind);
        let literal = |record: &crate::kernel::Record, indent| {
            let slides = record.name == "Positions";
            let fields = record.fields.iter().map(|field| {
                let name = &field.name;
                if slides { format!("{name}: joints.{name}") } else { name.clone() }
            });
            fitted(indent, &format!("super::{} {{", record.name), &fields.collect::<Vec<_>>(), "}")
        };
        lines.push(match records.as_slice() {
            [] => String::new(),
            [(_, one)] => literal(one, 8),
            both => {
                let items: Vec<_> = both.iter().map(|(_, record)| literal(record, 0)).collect();
                fitted(8, "(", &items, ")")
            }
        });
        let joints = if records.is_empty() { "_" } else { "joints" };
        lines.retain(|line| !line.is_empty());
        if lines.is_empty() {
            return inlined(&format!(
                "    fn pose<T: Angle>({joints}: &Joints<T>) -> Self::Pose<T> {{}}"
            ));
        }
        let signature = format!("pose<T: Angle>({joints}: &Joints<T>) -> Self::Pose<T>");
        inlined(&function(&signature, &lines.join("\n")))
    }

    /// The links with a motor of their own.
    fn driven(&self) -> Vec<&Link> {
        self.kind.driven().collect()
    }

    pub(super) fn eliminate(&self) -> String {
        let motors: Vec<_> = self
            .driven()
            .iter()
            .map(|link| format!("{}: drives.{}.torque", link.joint.torque, body_name(&link.body)))
            .collect();
        let modes: Vec<_> = self
            .driven()
            .iter()
            .flat_map(|link| {
                ["driven", "held", "given"].map(|what| {
                    format!("{what}_{}: drives.{}.{what}", link.joint.tag, body_name(&link.body))
                })
            })
            .collect();
        let body = [
            fitted(8, "let motors = super::Motors {", &motors, "};"),
            fitted(8, "let modes = super::Modes {", &modes, "};"),
            self.call(8, "", "eliminate", ""),
        ];
        let given = [CONSTANTS, POSE, JOINTS, OMEGA, DRIVES];
        let asked = self.asks(
            "eliminate<T: Real>",
            "eliminate",
            &given,
            "Self::Eliminated<T>",
            &body.join("\n"),
        );
        let part = |name: &str, of: &str| {
            let signature =
                format!("{name}<T: Real>(eliminated: &Self::Eliminated<T>) -> &{of}<T>");
            function(&signature, &format!("        &eliminated.{name}"))
        };
        let [share, gains] = [part("share", "HubShare"), part("gains", "Self::Gains")];
        [asked, share, gains].map(|item| inlined(&item)).join("\n\n")
    }

    pub(super) fn pivots(&self) -> String {
        let text = self.per_joint(8, "", "}", |link| {
            if link.is_driven() {
                let tag = link.joint.tag;
                format!("Some([eliminated.pivot_{tag}, eliminated.diagonal_{tag}])")
            } else {
                "None".to_owned()
            }
        });
        let signature =
            "pivots<T: Real>(eliminated: &Self::Eliminated<T>) -> PerJoint<Option<[T; 2]>>";
        inlined(&function(signature, &text))
    }

    pub(super) fn back_substitute(&self) -> String {
        let back = self.letters("back_substitute");
        let name = |letter, name| if back.contains(&letter) { name } else { "_" };
        let arguments: Vec<_> = back
            .iter()
            .map(|letter| if *letter == "e" { "gains" } else { "hub" }.to_owned())
            .collect();
        let head = fitted(
            4,
            "fn back_substitute<T: Real>(",
            &[
                format!("{}: &Self::Gains<T>", name("e", "gains")),
                format!("{}: &BodyAcceleration<T>", name("a", "hub")),
            ],
            ") -> JointAccelerations<T> {",
        );
        let call = fitted(8, "super::back_substitute(", &arguments, ")");
        inlined(&format!("{head}\n{call}\n    }}"))
    }

    /// What the joints' coordinates and rates change by.
    pub(super) fn slope(&self) -> String {
        let links = self.kind.links;
        let coordinates = links
            .iter()
            .map(|link| format!("{}: joints.{}", link.joint.coordinate, link.joint.rate));
        let rates = links
            .iter()
            .map(|link| format!("{}: accelerations.{}", link.joint.rate, link.joint.acceleration));
        let fields: Vec<_> = coordinates.chain(rates).collect();
        let arguments = ["joints: &Joints<T>", "accelerations: &JointAccelerations<T>"];
        let arguments = arguments.map(str::to_owned);
        let head = fitted(4, "fn slope<T: Value>(", &arguments, ") -> Joints<T> {");
        let text = format!("{head}\n{}\n    }}", fitted(8, "Joints {", &fields, "}"));
        inlined(&text)
    }

    /// Number by number, for what is gathered into lanes or spread from them.
    pub(super) fn zips() -> Vec<String> {
        let zip = |name: &str, record: &str| {
            let text = format!(
                "    fn zip_{name}<T: Value, U: Value, W: Value>(\n        a: &{record}<T>,\n        \
                 b: &{record}<U>,\n        join: impl FnMut(T, U) -> W,\n    ) -> {record}<W> {{\n        \
                 a.zip(b, join)\n    }}"
            );
            inlined(&text)
        };
        vec![
            zip("constants", "super::Prepared"),
            zip("joints", "Joints"),
            zip("gains", "super::Gains"),
            zip("accelerations", "JointAccelerations"),
            zip("per_joint", "PerJoint"),
        ]
    }

    /// Energy and momenta, first moment.
    pub(super) fn motion(&self) -> Vec<String> {
        let posed = |kernel: &str| {
            let read = self.letters(kernel).iter().any(|letter| ["q", "s"].contains(letter));
            if read { "        let pose = &Self::pose(joints);\n" } else { "" }
        };
        let energy =
            format!("{}{}", posed("energy_momentum"), self.call(8, "", "energy_momentum", ""));
        // What is zero in every state of the kind is not returned.
        let returned = self.signatures.get("first_moment").map_or(&[][..], |s| &s.fields);
        let component = |stem: &str, axis: &str| {
            let name = format!("{stem}_b{axis}");
            if returned.contains(&name) { format!("found.{name}") } else { "zero()".to_owned() }
        };
        let rows = ["mc", "mc_prime"].map(|stem| {
            let components = XYZ.map(|axis| component(stem, axis));
            format!("[{}]", components.join(", "))
        });
        let moment = format!(
            "{}{}\n{}",
            posed("first_moment"),
            self.call(8, "let found = ", "first_moment", ";"),
            fitted(8, "[", &rows, "]")
        );
        vec![
            self.asks(
                "energy_momentum",
                "energy_momentum",
                &[CONSTANTS, POSED, VELOCITY],
                "EnergyMomentum<T>",
                &energy,
            ),
            self.asks("first_moment", "first_moment", &[CONSTANTS, POSED], "[[T; 3]; 2]", &moment),
        ]
    }

    /// Axes, loads, external wrenches, gravity.
    pub(super) fn carried(&self) -> Vec<String> {
        let axes = self.per_joint(8, "", "}", |link| {
            let frame = link.body.frame;
            let columns = XYZ.map(|axis| {
                let rows = XYZ.map(|row| format!("axes.{frame}_{axis}_b{row}"));
                format!("    [{}],\n", rows.join(", "))
            });
            format!("[\n{}]", columns.concat())
        });
        let axes = format!("{}\n{axes}", self.call(8, "let axes = ", "axes", ";"));
        let wrenches = {
            let fields = self.kind.links.iter().flat_map(|link| {
                let (frame, body) = (link.body.frame, body_name(&link.body));
                ["f", "n"].into_iter().flat_map(move |what| {
                    let of = if what == "f" { "force" } else { "moment" };
                    let body = body.clone();
                    XYZ.map(move |axis| {
                        format!("{what}_on_{frame}{axis}: bodies.{body}.{of}.{axis}")
                    })
                })
            });
            fitted(8, "let wrenches = super::Wrenches {", &fields.collect::<Vec<_>>(), "};")
        };
        let gradient = "        let [g_11, g_12, g_13, g_22, g_23, g_33] = gradient;\n        \
                        let gradient = Gradient { g_11, g_12, g_13, g_22, g_23, g_33 };";
        let second = ["11", "12", "13", "22", "23", "33"]
            .map(|entry| format!("found.second_moment_{entry}"));
        let on_bodies = self.per_joint(8, "let wrenches = ", "};", |link| {
            wrench(12, "found.wrenches", "on", link.body.frame)
        });
        let carried = "Carried<Wrenches<Self>, Wrench<T>>";
        vec![
            self.asks("axes", "axes", &[CONSTANTS, POSE], "PerJoint<[[T; 3]; 3]>", &axes),
            self.asks(
                "loads",
                "loads",
                &[CONSTANTS, POSE, JOINTS, OMEGA, ACCELERATION, ACCELERATIONS],
                carried,
                &format!(
                    "{}\n{}",
                    self.call(8, "let found = ", "loads", ";"),
                    self.carried_by("load")
                ),
            ),
            self.asks(
                "external",
                "external",
                &[CONSTANTS, POSE, BODIES],
                carried,
                &format!(
                    "{wrenches}\n{}\n{}",
                    self.call(8, "let found = ", "external", ";"),
                    self.carried_by("sum")
                ),
            ),
            self.asks(
                "gravity",
                "gravity",
                &[CONSTANTS, POSE, GRADIENT],
                "(Wrenches<Self>, [T; 6])",
                &format!(
                    "{gradient}\n{}\n{on_bodies}\n{}\n        (wrenches, second_moment)",
                    self.call(8, "let found = ", "gravity", ";"),
                    fitted(8, "let second_moment = [", &second, "];"),
                ),
            ),
        ]
    }

    /// `Carried { .. }` from the fields of `found`.
    fn carried_by(&self, what: &str) -> String {
        let joints = self
            .per_joint(8, "let joints = ", "};", |link| wrench(12, "found", what, link.body.frame));
        let hub = wrench(8, "found", what, "b").replace('\n', "\n        ");
        format!("{joints}\n        let hub = {hub};\n        Carried {{ joints, hub }}")
    }
}

/// A function that is part of the one that calls it.
fn inlined(item: &str) -> String {
    format!("    #[inline(always)]\n{item}")
}

/// `Wrench { .. }` from six fields, to stand behind so many columns.
fn wrench(indent: usize, of: &str, what: &str, frame: &str) -> String {
    let vector = |name: &str, letter: &str| {
        let components = XYZ.map(|axis| format!("{of}.{letter}_{what}_{frame}{axis}"));
        let line = fitted(indent + 4, &format!("{name}: vector(["), &components, "])");
        let relative: Vec<_> = line.lines().map(|line| &line[indent..]).collect();
        relative.join("\n")
    };
    format!("Wrench {{\n{},\n{},\n}}", vector("force", "f"), vector("moment", "n"))
}

/// The joint rates as the kernels take them.
pub(super) fn rates_function(kind: &Kind) -> String {
    let fields: Vec<_> =
        kind.links.iter().map(|link| format!("{0}: joints.{0}", link.joint.rate)).collect();
    format!(
        "#[inline(always)]\nfn rates<T: Real>(joints: &Joints<T>) -> super::Rates<T> {{\n{}\n}}",
        fitted(4, "super::Rates {", &fields, "}")
    )
}
