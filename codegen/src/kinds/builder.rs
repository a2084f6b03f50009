//! A kind in a few lines: what is not said has a default, and every name follows from a letter.
//!
//! A link with letter `p`, coordinate `phi` has rate `phi_dot`, acceleration `phi_ddot`, motor
//! torque `u_p`, mass `m_p`, centre of mass `r_pc_p`, inertia `i_p`, and its joint's origin is
//! `r_p_b`, or `r_p_f` where `f` is the parent body. The names live as long as the program: a kind
//! is made once.

use super::naming::{self, KindError};
use super::{
    Body, Centre, Drive, Equations, Inertia, Joint, Kind, Link, Motion, Triple, equations,
};
use crate::space::Axis;

/// A kind in the making: see [`Kind::builder`].
#[derive(Clone, Debug)]
pub struct KindBuilder {
    name: String,
    title: String,
    source: String,
    links: Vec<LinkBuilder>,
}

/// A link in the making: see [`Link::turning`] and [`Link::sliding`].
#[derive(Clone, Debug)]
pub struct LinkBuilder {
    letter: String,
    title: String,
    coordinate: String,
    motion: Motion,
    drive: Drive,
    /// Axis and name of the distance, or the whole vector.
    centre: CentreOfMass,
    inertia: fn(&'static str) -> Inertia,
    bodiless: bool,
    concentric: bool,
    equations: Option<Equations>,
}

#[derive(Clone, Debug)]
enum CentreOfMass {
    Free,
    On(Axis, String),
    At,
}

impl Kind {
    /// A kind of this name (of module and file) and title (in words, lower case), without links
    /// yet.
    #[must_use]
    pub fn builder(name: &str, title: &str) -> KindBuilder {
        let source = format!("kind `{name}`");
        KindBuilder { name: name.to_owned(), title: title.to_owned(), source, links: Vec::new() }
    }
}

impl Link {
    /// A body that turns about an axis of its parent body. Its centre of mass is anywhere and its
    /// inertia full, unless something else is said.
    #[must_use]
    pub fn turning(letter: &str, title: &str, axis: Axis, coordinate: &str) -> LinkBuilder {
        LinkBuilder::new([letter, title, coordinate], Motion::Turn(axis))
    }

    /// A body that slides along an axis of its parent body.
    #[must_use]
    pub fn sliding(letter: &str, title: &str, axis: Axis, coordinate: &str) -> LinkBuilder {
        LinkBuilder::new([letter, title, coordinate], Motion::Slide(axis))
    }
}

impl KindBuilder {
    /// The source file that the header of the emitted file cites.
    #[must_use]
    pub fn source(self, path: &str) -> Self {
        Self { source: path.to_owned(), ..self }
    }

    /// One more link, outboard of the one before; the first is on the hub.
    #[must_use]
    pub fn link(mut self, link: LinkBuilder) -> Self {
        self.links.push(link);
        self
    }

    /// The kind, with every name formed and checked.
    ///
    /// # Errors
    /// When there is no link, or a name is not allowed in the emitted code or is there already.
    pub fn build(self) -> Result<&'static Kind, KindError> {
        let carriers = std::iter::once("b").chain(self.links.iter().map(|link| &*link.letter));
        let last = self.links.len().saturating_sub(1);
        let links = self.links.iter().zip(carriers).enumerate();
        let links = links.map(|(k, (link, carrier))| link.build(k, carrier, k == last));
        let kind = Kind {
            name: kept(&self.name),
            title: kept(&self.title),
            source: kept(&self.source),
            links: links.collect::<Vec<_>>().leak(),
        };
        naming::check(&kind)?;
        Ok(Box::leak(Box::new(kind)))
    }
}

impl LinkBuilder {
    fn new([letter, title, coordinate]: [&str; 3], motion: Motion) -> Self {
        let [letter, title, coordinate] = [letter, title, coordinate].map(str::to_owned);
        let (centre, inertia) = (CentreOfMass::Free, Inertia::Full as fn(_) -> _);
        let drive = Drive::Motor;
        let (bodiless, concentric, equations) = (false, false, None);
        Self {
            letter,
            title,
            coordinate,
            motion,
            drive,
            centre,
            inertia,
            bodiless,
            concentric,
            equations,
        }
    }

    /// Its joint keeps its rate, whatever torque that takes, as the wheel of an SGCMG does.
    #[must_use]
    pub fn prescribed(self) -> Self {
        Self { drive: Drive::Prescribed, ..self }
    }

    /// Its centre of mass lies on one of its axes, at a distance of this name from its origin.
    #[must_use]
    pub fn centre_on(self, axis: Axis, distance: &str) -> Self {
        Self { centre: CentreOfMass::On(axis, distance.to_owned()), ..self }
    }

    /// Its centre of mass is its origin.
    #[must_use]
    pub fn centred(self) -> Self {
        Self { centre: CentreOfMass::At, ..self }
    }

    /// Its inertia has no products.
    #[must_use]
    pub fn diagonal(self) -> Self {
        Self { inertia: Inertia::Diagonal, ..self }
    }

    /// Its inertia is the same from every angle about an axis.
    #[must_use]
    pub fn symmetric(self, axis: Axis) -> Self {
        let inertia = match axis {
            Axis::X => |stem| Inertia::Symmetric(Axis::X, stem),
            Axis::Y => |stem| Inertia::Symmetric(Axis::Y, stem),
            Axis::Z => |stem| Inertia::Symmetric(Axis::Z, stem),
        };
        Self { inertia, ..self }
    }

    /// It is a point mass at its origin.
    #[must_use]
    pub fn point(self) -> Self {
        Self { centre: CentreOfMass::At, inertia: |_| Inertia::Point, ..self }
    }

    /// It has no body: only the axes that move with its joint, for a joint of more than one freedom.
    /// It has no mass, no inertia and no parameter of either.
    #[must_use]
    pub fn bodiless(self) -> Self {
        Self { bodiless: true, ..self.point() }
    }

    /// The origin of its joint is that of its parent body: no parameter states it. The first link of a
    /// chain has its origin in the hub all the same.
    #[must_use]
    pub fn concentric(self) -> Self {
        Self { concentric: true, ..self }
    }

    /// Where its quantities are stated. By default these are the paper's numbers for what moves
    /// like it: the outer gimbal for the first link, the inner gimbal for every other.
    #[must_use]
    pub fn equations(self, equations: Equations) -> Self {
        Self { equations: Some(equations), ..self }
    }

    /// Its quantities are stated nowhere: they are cited as [`Equations::NONE`].
    #[must_use]
    pub fn unnumbered(self) -> Self {
        self.equations(Equations::NONE)
    }

    /// The link at place `k` of a chain.
    fn build(&self, k: usize, carrier: &str, tip: bool) -> Link {
        let Self { letter, coordinate, .. } = self;
        let numbers = if k == 0 { equations::OUTER_GIMBAL } else { equations::INNER_GIMBAL };
        let (upper, carrier_upper) = (letter.to_uppercase(), carrier.to_uppercase());
        let origin = format!("r_{letter}_{carrier}");
        let centre = format!("r_{letter}c_{letter}");
        let assembly = match (k, tip) {
            (0, _) => "d".to_owned(),
            (_, true) => letter.clone(),
            (_, false) => format!("{letter}a"),
        };
        Link {
            joint: Joint {
                tag: kept(letter),
                motion: self.motion,
                drive: self.drive,
                coordinate: kept(coordinate),
                coordinate_symbol: kept(&naming::written(coordinate, "")),
                rate: kept(&format!("{coordinate}_dot")),
                acceleration: kept(&format!("{coordinate}_ddot")),
                symbols: ["\u{307}", "\u{308}"]
                    .map(|dots| kept(&naming::written(coordinate, dots))),
                torque: kept(&format!("u_{letter}")),
                concentric: self.concentric && k > 0,
                origin: triple(&format!("r_{{{upper}/{carrier_upper}}}"), &origin, carrier),
            },
            body: Body {
                title: kept(&self.title),
                frame: kept(letter),
                origin: kept(letter),
                triad: ["x", "y", "z"].map(|axis| kept(&format!("{letter}_{axis}"))),
                point: kept(&format!("{letter}c")),
                mass: (!self.bodiless).then(|| kept(&format!("m_{letter}"))),
                centre: match &self.centre {
                    CentreOfMass::Free => {
                        Centre::Free(triple(&format!("r_{{{upper}c/{upper}}}"), &centre, letter))
                    }
                    CentreOfMass::On(axis, distance) => Centre::On(*axis, kept(distance)),
                    CentreOfMass::At => Centre::At,
                },
                inertia: (self.inertia)(kept(&format!("i_{letter}"))),
                letters: [kept(&upper), kept(&format!("{upper}c"))],
                equations: self.equations.unwrap_or(numbers),
            },
            assembly: kept(&assembly),
        }
    }
}

/// A vector by its three components along a frame.
fn triple(symbol: &str, name: &str, frame: &str) -> Triple {
    let names = ["x", "y", "z"].map(|axis| kept(&format!("{name}_{frame}{axis}")));
    Triple { symbol: kept(symbol), name: kept(name), names }
}

/// The text, for as long as the program runs.
fn kept(text: &str) -> &'static str {
    text.to_owned().leak()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::parameters;
    use crate::kinds::HINGED_PANEL;

    fn names(kind: &Kind) -> Vec<String> {
        parameters(kind).fields.into_iter().map(|field| field.name).collect()
    }

    #[test]
    fn a_hinged_panel_is_one_line() {
        let panel = Link::turning("p", "panel", Axis::Z, "phi");
        let made = Kind::builder("hinged_panel", "hinged panel").link(panel).build().unwrap();
        assert_eq!(names(made), names(&HINGED_PANEL));
        let (made, known) = (made.links[0], HINGED_PANEL.links[0]);
        let joint = |joint: Joint| {
            let Joint { tag, coordinate, coordinate_symbol, rate, acceleration, torque, .. } =
                joint;
            [tag, coordinate, coordinate_symbol, rate, acceleration, torque, joint.origin.symbol]
        };
        assert_eq!(joint(made.joint), joint(known.joint));
        let body = |body: Body| {
            let Body { title, frame, origin, point, mass, letters, .. } = body;
            [
                title,
                frame,
                origin,
                point,
                mass.unwrap(),
                letters[0],
                letters[1],
                body.equations.torque,
            ]
        };
        assert_eq!(body(made.body), body(known.body));
        assert_eq!(made.assembly, known.assembly);
    }

    #[test]
    fn what_carries_a_joint_is_in_the_name_of_its_origin() {
        let kind = Kind::builder("arm", "arm")
            .link(Link::turning("a", "upper arm", Axis::Z, "alpha").centre_on(Axis::X, "e"))
            .link(Link::sliding("f", "ram", Axis::X, "x").diagonal())
            .link(
                Link::turning("h", "hand", Axis::Y, "eta")
                    .centred()
                    .symmetric(Axis::Y)
                    .unnumbered(),
            )
            .build()
            .unwrap();
        let [arm, ram, hand] = kind.links else { panic!("three links") };
        assert_eq!(arm.joint.origin.names, ["r_a_b_bx", "r_a_b_by", "r_a_b_bz"]);
        assert_eq!(ram.joint.origin.names, ["r_f_a_ax", "r_f_a_ay", "r_f_a_az"]);
        assert_eq!([arm.assembly, ram.assembly, hand.assembly], ["d", "fa", "h"]);
        assert_eq!(ram.body.equations.torque, "(101)");
        assert_eq!(hand.body.equations.torque, "(none)");
        assert!(!kind.axes_turn(2) && kind.axes_turn(0));
        assert_eq!(names(kind)[9..14], ["r_a_b_bx", "r_a_b_by", "r_a_b_bz", "e", "m_a"]);
    }
}
