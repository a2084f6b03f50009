//! The records that the emitted C fills before it calls `eliminate`.

use precess_codegen::kinds::{Link, Motion};
use serde::Serialize;

use crate::shape::Shape;

/// A record that `eliminate` takes in C, and the lines that fill it.
#[derive(Serialize)]
pub(crate) struct PartC {
    record: &'static str,
    name: &'static str,
    lines: Vec<String>,
}

/// The records that `eliminate` takes in C, and its arguments.
pub(crate) fn parts_c(
    shape: &Shape<'_>,
    letters: &[&'static str],
    upper: &str,
) -> (Vec<PartC>, String) {
    let argument = |letter: &&'static str| match *letter {
        "p" => "&constants->prepared".to_owned(),
        "w" => "omega".to_owned(),
        other => format!("&{other}"),
    };
    let arguments: Vec<_> = letters.iter().map(argument).collect();
    let parts = letters.iter().filter_map(|letter| part(shape, letter, upper));
    (parts.collect(), arguments.join(", "))
}

/// The record of an argument; none where it is handed on.
fn part(shape: &Shape<'_>, name: &'static str, upper: &str) -> Option<PartC> {
    let moving = shape.kind.links.iter().filter(|link| !link.is_locked());
    let turning = shape.kind.turning().filter(|link| !link.is_locked());
    let driven = shape.kind.driven();
    let given = |link: &Link| format!("drives->{}.way == {upper}_TORQUE", link.joint.torque);
    let (record, lines): (_, Vec<_>) = match name {
        "q" => ("trig", turning.map(sines).collect()),
        "s" => {
            let sliding = moving.filter(|link| matches!(link.joint.motion, Motion::Slide(_)));
            ("positions", sliding.map(|link| copied("s", link.joint.coordinate)).collect())
        }
        "v" => ("rates", moving.map(|link| copied("v", link.joint.rate)).collect()),
        "u" => {
            let line = |link: &Link| {
                let (name, given) = (link.joint.torque, given(link));
                format!("u.{name} = {given} ? drives->{name}.value : 0.0;")
            };
            ("motors", driven.map(line).collect())
        }
        "m" => {
            let lines = |link: &Link| {
                let (name, tag, given) = (link.joint.torque, link.joint.tag, given(link));
                [
                    format!("m.driven_{tag} = {given} ? 1.0 : 0.0;"),
                    format!("m.held_{tag} = {given} ? 0.0 : 1.0;"),
                    format!("m.given_{tag} = {given} ? 0.0 : drives->{name}.value;"),
                ]
            };
            ("modes", driven.flat_map(lines).collect())
        }
        _ => return None,
    };
    Some(PartC { record, name, lines })
}

fn sines(link: &Link) -> String {
    let name = link.joint.coordinate;
    format!("precess_sin_cos(joints->{name}, &q.sin_{name}, &q.cos_{name});")
}

fn copied(record: &str, name: &str) -> String {
    format!("{record}.{name} = joints->{name};")
}
