//! Every function that C calls, with every pointer null, misaligned, or to what another points to: a call
//! that is rejected writes nothing but its fault.
//!
//! The functions are those of the list in [`exports`](crate::exports) and the few of one version, held
//! against the prototypes of the header.

mod structures;
mod tracking;

use core::ffi::c_void;

use self::structures::{law, servo, wheel};
use crate::craft::{ALIGN, precess_joints, precess_mass};
use crate::error::{Code, Fault, precess_error_text};
use crate::exports;
use crate::state::precess_state_length;
use crate::types::{Entry, Hub, Inputs, State};
use crate::version::{EntryOf, Interface, Versions};

/// A function, called with arguments by their names.
pub(crate) struct Call {
    pub(crate) name: &'static str,
    pub(crate) call: fn(&mut Arguments<'_>) -> i32,
}

/// A type of an argument.
pub(crate) trait Argument {
    /// The argument of a name.
    fn taken(arguments: &mut Arguments<'_>, name: &'static str) -> Self;
}

impl<T> Argument for *const T {
    fn taken(arguments: &mut Arguments<'_>, name: &'static str) -> Self {
        arguments.pointer::<T>(name, false).cast()
    }
}

impl<T> Argument for *mut T {
    fn taken(arguments: &mut Arguments<'_>, name: &'static str) -> Self {
        arguments.pointer::<T>(name, true).cast()
    }
}

macro_rules! numbers {
    ($($number:ty)*) => {$(
        impl Argument for $number {
            fn taken(arguments: &mut Arguments<'_>, name: &'static str) -> Self {
                arguments.number(name).try_into().unwrap()
            }
        }
    )*};
}

numbers! { i32 u32 usize }

impl Argument for f64 {
    fn taken(_: &mut Arguments<'_>, name: &'static str) -> Self {
        if name == "memory" { 100.0 } else { 1e-3 }
    }
}

/// What is wrong with one pointer, by its number.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Changed {
    Nothing,
    Null(usize),
    Misaligned(usize),
    /// The first points to what the second points to.
    Onto(usize, usize),
}

/// A pointer of a call, and its memory before and after.
struct Pointer {
    name: &'static str,
    align: usize,
    size: usize,
    /// Whether it is only written to.
    is_result: bool,
    is_mut: bool,
    before: Vec<u64>,
    memory: Vec<u64>,
}

/// The arguments of one call.
pub(crate) struct Arguments<'a> {
    /// What pointers of a name point to, where that is read.
    contents: &'a [(&'static str, Vec<u8>)],
    function: &'static str,
    changed: Changed,
    pointers: Vec<Pointer>,
}

/// Bytes of each memory: more than any structure has.
const ROOM: usize = 1 << 17;

/// What a result is written over.
const PATTERN: u64 = 0xA5A5_A5A5_A5A5_A5A5;

impl Arguments<'_> {
    fn pointer<T>(&mut self, name: &'static str, is_mut: bool) -> *mut c_void {
        let number = self.pointers.len();
        // The memory of a spacecraft has no type.
        let align = if name == "memory" { ALIGN } else { align_of::<T>() };
        let in_place = ["step", "stop", "wrap"].iter().any(|of| self.function.contains(of));
        let tracked = ["line", "drag"].contains(&name) && self.function.ends_with("update");
        let is_result = is_mut && !(name == "state" && in_place) && !tracked;
        let mut memory = vec![PATTERN; ROOM / 8];
        if !is_result {
            for (to, from) in memory.iter_mut().zip(self.content(name).chunks(8)) {
                let mut bytes = [0; 8];
                bytes[..from.len()].copy_from_slice(from);
                *to = u64::from_ne_bytes(bytes);
            }
        }
        let (before, size) = (memory.clone(), size_of::<T>());
        self.pointers.push(Pointer { name, align, size, is_result, is_mut, before, memory });
        let at = match self.changed {
            Changed::Onto(from, onto) if from == number => onto,
            _ => number,
        };
        let pointer = self.pointers[at].memory.as_mut_ptr().cast::<u8>();
        match self.changed {
            Changed::Null(at) if at == number => core::ptr::null_mut(),
            Changed::Misaligned(at) if at == number => pointer.wrapping_add(1).cast(),
            _ => pointer.cast(),
        }
    }

    fn content(&self, name: &str) -> &[u8] {
        let stops = self.function.contains("stop") && name == "inputs";
        let name = if stops { "stopping" } else { name };
        let found = self.contents.iter().find(|(of, _)| *of == name);
        &found.unwrap_or_else(|| panic!("{}: what does {name} point to?", self.function)).1
    }

    fn number(&self, name: &str) -> usize {
        let state = self.function.contains("state_");
        match name {
            "size" | "capacity" => ROOM,
            "count" if state => self.content("numbers").len() / 8,
            "length" if self.function.contains("text") => 128,
            "length" => self.content("table").len(),
            "count" | "code" => 1,
            "substeps" | "about" => 2,
            "axes" | "device" => 0,
            _ => panic!("{}: how much is {name}?", self.function),
        }
    }
}

fn called<'a>(
    of: &Call,
    contents: &'a [(&'static str, Vec<u8>)],
    changed: Changed,
) -> (i32, Arguments<'a>) {
    let mut arguments = Arguments { contents, function: of.name, changed, pointers: Vec::new() };
    let code = (of.call)(&mut arguments);
    (code, arguments)
}

/// The functions of all versions.
fn of_all_versions() -> Vec<Call> {
    let mass: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: each pointer is to memory larger than its structure, or is what a function rejects.
        unsafe { precess_mass(taken(of, "craft"), taken(of, "mass")) }
    };
    let joints: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: as above.
        unsafe { precess_joints(taken(of, "craft"), taken(of, "device"), taken(of, "joints")) }
    };
    let length: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: as above.
        unsafe { precess_state_length(taken(of, "craft"), taken(of, "count")) }
    };
    let text: fn(&mut Arguments<'_>) -> i32 = |of| {
        // SAFETY: as above.
        unsafe { precess_error_text(taken(of, "code"), taken(of, "buffer"), taken(of, "length")) }
    };
    vec![
        Call { name: "precess_mass", call: mass },
        Call { name: "precess_joints", call: joints },
        Call { name: "precess_state_length", call: length },
        Call { name: "precess_error_text", call: text },
    ]
    .into_iter()
    .chain(tracking::calls())
    .collect()
}

fn taken<A: Argument>(arguments: &mut Arguments<'_>, name: &'static str) -> A {
    A::taken(arguments, name)
}

/// Bytes of a value without padding.
fn bytes<T: Copy>(value: &T) -> Vec<u8> {
    // SAFETY: numbers only, as many bytes as they have.
    unsafe { core::slice::from_raw_parts((&raw const *value).cast(), size_of::<T>()) }.to_vec()
}

/// What the pointers of each name point to: a hub with a wheel that turns.
fn contents<const J: usize>(calls: &[Call], entry: EntryOf<J>) -> Vec<(&'static str, Vec<u8>)>
where
    Versions: Interface<J>,
{
    let inertia = [9.0, 0.0, 0.0, 0.0, 8.0, 0.0, 0.0, 0.0, 7.0];
    let hub = Hub { mass: 50.0, centre: [0.0; 3], inertia };
    let mut contents =
        vec![("hub", bytes(&hub)), ("devices", bytes(&entry)), ("point", bytes(&[1.0, 2.0, 3.0]))];
    // Each from the result of the function that makes it.
    for (name, of, result) in [
        ("craft", "precess_init", "memory"),
        ("table", "precess_table_write", "table"),
        ("state", "precess_state_at_rest", "state"),
        ("inputs", "precess_inputs_none", "inputs"),
        ("gains", "precess_eliminate", "gains"),
    ] {
        let found = calls.iter().find(|call| call.name.trim_end_matches("_v2") == of).unwrap();
        let (code, arguments) = called(found, &contents, Changed::Nothing);
        assert_eq!(code, 0, "{of}");
        let pointer = |name| arguments.pointers.iter().find(|pointer| pointer.name == name);
        let made = &pointer(result).unwrap().memory;
        let mut made: Vec<u8> = made.iter().flat_map(|number| number.to_ne_bytes()).collect();
        let length = match name {
            "craft" => Versions::SIZE,
            "table" => usize::try_from(pointer("length").unwrap().memory[0]).unwrap(),
            "state" => size_of::<State<J>>(),
            "gains" => Versions::GAINS_SIZE,
            _ => size_of::<Inputs<J>>(),
        };
        made.truncate(length);
        contents.push((name, made));
    }
    let of = |name| contents.iter().position(|(of, _)| *of == name).unwrap();
    let (state, inputs) = (of("state"), of("inputs"));
    let mut moving = read::<State<J>>(&contents[state].1);
    (moving.omega, moving.velocity, moving.rate[0][0]) = ([0.1, 0.2, 0.3], [1.0; 3], 30.0);
    moving.coordinate[0][0] = 7.0;
    contents[state].1 = bytes(&moving);
    let mut stopping = read::<Inputs<J>>(&contents[inputs].1);
    stopping.mode[0][0] = 2;
    contents.push(("stopping", bytes(&stopping)));
    for name in ["torque", "linear", "angular"] {
        contents.push((name, bytes(&[1.0, 2.0, 3.0])));
    }
    let [line, drag] = tracking::contents();
    contents.extend([("line", line), ("drag", drag)]);
    contents.push(("law", bytes(&law::<J>())));
    contents.push(("servo", bytes(&servo::<J>())));
    // A state saved: 13 numbers, and two of the wheel.
    let numbers = [moving.position, moving.velocity].concat().into_iter().chain(moving.attitude);
    let joint = [moving.coordinate[0][0], moving.rate[0][0]];
    let numbers = numbers.chain(moving.omega).chain(joint);
    contents.push(("numbers", numbers.flat_map(f64::to_ne_bytes).collect()));
    contents
}

fn read<T: Copy>(bytes: &[u8]) -> T {
    assert_eq!(bytes.len(), size_of::<T>());
    // SAFETY: numbers only, as many bytes as they have.
    unsafe { bytes.as_ptr().cast::<T>().read_unaligned() }
}

/// Whether a pointer may be null.
fn is_optional(name: &str) -> bool {
    ["fault", "work", "lost"].contains(&name)
}

/// A call with one pointer changed is rejected, with its code in the fault, and changes nothing else.
fn is_rejected(call: &Call, contents: &[(&'static str, Vec<u8>)], changed: Changed, right: Code) {
    let (code, after) = called(call, contents, changed);
    let what = format!("{} with {changed:?}", call.name);
    assert_eq!(code, right as i32, "{what}");
    for (number, pointer) in after.pointers.iter().enumerate() {
        let is_changed = [Changed::Null(number), Changed::Misaligned(number)].contains(&changed);
        if pointer.name == "fault" && !is_changed {
            let fault: Fault = read(&bytes_of(&pointer.memory)[..size_of::<Fault>()]);
            assert_eq!(fault.code, code, "{what}");
        } else {
            assert!(pointer.memory == pointer.before, "{what} writes to {}", pointer.name);
        }
    }
}

fn bytes_of(memory: &[u64]) -> Vec<u8> {
    memory.iter().flat_map(|number| number.to_ne_bytes()).collect()
}

fn check<const J: usize>(calls: &[Call], entry: EntryOf<J>)
where
    Versions: Interface<J>,
{
    let contents = contents::<J>(calls, entry);
    for call in calls {
        let (code, right) = called(call, &contents, Changed::Nothing);
        assert_eq!(code, 0, "{}", call.name);
        let results = || right.pointers.iter().enumerate();
        let writes = results()
            .any(|(_, pointer)| pointer.name != "fault" && pointer.memory != pointer.before);
        assert!(writes, "{} writes nothing", call.name);
        for (number, pointer) in results() {
            if is_optional(pointer.name) {
                let (code, _) = called(call, &contents, Changed::Null(number));
                assert_eq!(code, 0, "{} without {}", call.name, pointer.name);
            } else {
                is_rejected(call, &contents, Changed::Null(number), Code::Null);
            }
            if pointer.align > 1 {
                is_rejected(call, &contents, Changed::Misaligned(number), Code::Misaligned);
            }
            // Structures are read before one is written.
            let structure = pointer.is_result && pointer.size > 8 && pointer.name != "fault";
            for (onto, _) in results()
                .filter(|(_, of)| structure && !of.is_mut && ["state", "inputs"].contains(&of.name))
            {
                if onto < number {
                    let (code, found) = called(call, &contents, Changed::Onto(number, onto));
                    let words = pointer.size / 8;
                    let (found, right) = (&found.pointers[onto].memory, &pointer.memory);
                    assert_eq!((code, &found[..words]), (0, &right[..words]), "{}", call.name);
                }
            }
        }
    }
}

#[test]
fn a_rejected_pointer_of_any_function_leaves_everything_as_it_was() {
    let [first, second] = [exports::first(), exports::second()];
    let all = || of_all_versions().into_iter();
    check::<3>(&first.into_iter().chain(all()).collect::<Vec<_>>(), wheel());
    let entry = Entry { device: wheel(), ..Entry::EMPTY };
    check::<7>(&second.into_iter().chain(all()).collect::<Vec<_>>(), entry);
}

/// Names of the functions of the header, with those of the arguments that are pointers.
fn prototypes() -> Vec<(String, Vec<String>)> {
    let header = concat!(
        include_str!("../include/precess.h"),
        include_str!("../include/precess_steering.h"),
        include_str!("../include/precess_tracking.h")
    );
    let mut text = String::new();
    for (index, part) in header.split("/*").enumerate() {
        text += if index == 0 { part } else { part.split_once("*/").map_or("", |(_, code)| code) };
    }
    let code = text.lines().filter(|line| !line.trim_start().starts_with('#'));
    let code = code.collect::<Vec<_>>().join(" ");
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let last = |text: &str| -> String {
        let name = text.trim_end().rsplit(|c| !is_name(c)).next();
        name.unwrap_or_default().to_owned()
    };
    let mut found = Vec::new();
    for statement in code.split(';') {
        let Some((head, arguments)) = statement.split_once('(') else { continue };
        let name = last(head);
        if name.starts_with("precess_") {
            let pointers = arguments.split(',').filter(|argument| argument.contains('*'));
            let pointers = pointers.map(|argument| last(argument.trim_end().trim_end_matches(')')));
            found.push((name, pointers.collect()));
        }
    }
    found
}

#[test]
fn every_function_of_the_header_is_checked_with_each_of_its_pointers() {
    let prototypes = prototypes();
    assert!(prototypes.len() >= 23, "{prototypes:?}");
    let [first, second] = [exports::first(), exports::second()];
    assert_eq!(first.len(), second.len());
    let contents = contents::<3>(&first, wheel());
    let calls: Vec<Call> = first.into_iter().chain(of_all_versions()).collect();
    for (name, pointers) in &prototypes {
        if pointers.is_empty() {
            continue;
        }
        let call = calls.iter().find(|call| call.name == name);
        let call = call.unwrap_or_else(|| panic!("{name} of the header is not checked"));
        let (_, arguments) = called(call, &contents, Changed::Nothing);
        let found = arguments.pointers.iter().map(|pointer| pointer.name);
        assert!(found.eq(pointers), "{name} has the pointers {pointers:?}");
    }
    for call in calls.iter().chain(&second) {
        let name = call.name.trim_end_matches("_v2");
        assert!(prototypes.iter().any(|(of, _)| of == name), "{name} is not in the header");
    }
}
