//! [`ProgramController`]: a controller that is a program of its own, in lockstep over pipes by the lines of
//! [`protocol`](super::protocol).
//!
//! The time limit of a sample is that of writing its line and of reading the answer. A line that nothing has asked for is an
//! error: it would shift every later answer. At the end of a run its standard input is closed; it then has the time limit of
//! a sample to end, and is ended otherwise; what it still writes is not kept.

use std::io::{self, BufRead as _, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command as Program, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use super::protocol::{Greeting, answer, because, line_of, shown};
use super::{Command, Controller, ControllerError, ControllerSample};

/// Longest line that a program may answer, bytes.
const LINE_MAX: u64 = 1 << 20;
/// How often it is looked whether a program has ended.
const PATIENCE: Duration = Duration::from_millis(5);

/// Events of pipes that wait to be read: an answer, and that its sample is written. A thread that has more waits.
const EVENTS: usize = 2;

/// A program that answers samples.
pub struct ProgramController {
    child: Child,
    /// Lines to write; none once its standard input is to be closed.
    lines: Option<SyncSender<String>>,
    events: Receiver<Event>,
    /// That it writes no more, where that came with the answer to a sample: the next one finds it.
    last: Option<Event>,
    limit: Duration,
}

/// What has happened on the pipes of a program.
#[derive(Debug)]
enum Event {
    /// A line was written to it.
    Written,
    /// A line could not be written.
    NotWritten(io::Error),
    /// It has written a line, and this beside it at once.
    Line(String, String),
    /// What it writes cannot be read.
    NotRead(io::Error),
    /// It writes no more.
    Ended,
}

impl ProgramController {
    /// Starts a program in a folder, and greets it.
    ///
    /// `limit` is how long it may take for an answer, s.
    ///
    /// # Errors
    ///
    /// [`ControllerError::Program`] where it cannot be started.
    pub fn start(
        command: &[String],
        folder: &Path,
        limit: f64,
        greeting: &Greeting<'_>,
    ) -> Result<Self, ControllerError> {
        let [name, arguments @ ..] = command else {
            return Err(because("no program is named"));
        };
        let mut program = Program::new(name);
        program.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped());
        if !folder.as_os_str().is_empty() {
            program.current_dir(folder);
        }
        let started = program.spawn();
        let mut child =
            started.map_err(|error| because(&format!("`{name}` does not start: {error}")))?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let (to, events) = sync_channel(EVENTS);
        let (lines, to_write) = sync_channel(EVENTS);
        if let (Some(input), Some(output)) = (input, output) {
            let written = to.clone();
            thread::spawn(move || write_lines(input, &to_write, &written));
            thread::spawn(move || read_lines(output, &to));
        }
        let limit = Duration::try_from_secs_f64(limit).unwrap_or(Duration::MAX);
        let mut controller = Self { child, lines: Some(lines), events, last: None, limit };
        controller.exchange(greeting.line(), false)?;
        Ok(controller)
    }

    /// Writes a line; returns the answer, or nothing where none is awaited.
    fn exchange(&mut self, line: String, answers: bool) -> Result<String, ControllerError> {
        if let Some(event) = self.last.take().or_else(|| self.events.try_recv().ok()) {
            return Err(self.failed(event));
        }
        let begun = Instant::now();
        // The one before has been written, so this one does not wait.
        let sent = self.lines.as_ref().is_some_and(|lines| lines.send(line).is_ok());
        if !sent {
            return Err(self.ended("does not read"));
        }
        let (mut written, mut answer) = (false, None);
        loop {
            match self.events.recv_timeout(self.limit.saturating_sub(begun.elapsed())) {
                Ok(Event::Written) => written = true,
                Ok(Event::Line(line, more)) if answers && answer.is_none() && more.is_empty() => {
                    answer = Some(line);
                }
                // The threads of both pipes report in any order: it may have answered and ended before its sample counts as written.
                Ok(event @ (Event::Ended | Event::NotRead(_))) if answer.is_some() => {
                    self.last = Some(event);
                }
                Ok(event) => return Err(self.failed(event)),
                Err(RecvTimeoutError::Timeout) => {
                    let limit = self.limit.as_secs_f64();
                    let what = if written { "answer" } else { "read its standard input" };
                    return Err(because(&format!("its program does not {what} within {limit} s")));
                }
                Err(RecvTimeoutError::Disconnected) => return Err(self.ended("does not answer")),
            }
            if written && (answer.is_some() || !answers) {
                return Ok(answer.unwrap_or_default());
            }
        }
    }

    /// What is wrong where something else happens than is awaited.
    fn failed(&mut self, event: Event) -> ControllerError {
        match event {
            Event::Written | Event::Ended => self.ended("does not answer"),
            Event::NotWritten(error) => self.ended(&format!("does not read: {error}")),
            Event::NotRead(error) => self.ended(&format!("cannot be read: {error}")),
            Event::Line(line, more) => {
                let unasked = shown(if more.is_empty() { &line } else { &more });
                because(&format!("its program answers before it is asked: {unasked}"))
            }
        }
    }

    /// That a program has ended, with how it did.
    fn ended(&mut self, what: &str) -> ControllerError {
        let until = Instant::now() + Duration::from_millis(200);
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => {
                    return because(&format!("its program has ended ({status}) and {what}"));
                }
                _ if Instant::now() < until => thread::sleep(PATIENCE),
                _ => return because(&format!("its program {what}")),
            }
        }
    }
}

impl Controller for ProgramController {
    fn sample(&mut self, sample: &ControllerSample<'_>) -> Result<Command, ControllerError> {
        answer(&self.exchange(line_of(sample), true)?)
    }
}

impl Drop for ProgramController {
    fn drop(&mut self) {
        drop(self.lines.take());
        // Nobody listens: what it writes until it ends is read and left.
        self.events = sync_channel(0).1;
        let until = Instant::now() + self.limit.min(Duration::from_secs(10));
        while Instant::now() < until {
            match self.child.try_wait() {
                Ok(None) => thread::sleep(PATIENCE),
                Ok(Some(_)) | Err(_) => return,
            }
        }
        // It may have ended meanwhile.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Writes lines as they come; then closes the standard input of the program.
fn write_lines(mut to: ChildStdin, lines: &Receiver<String>, written: &SyncSender<Event>) {
    for line in lines {
        let event = match to.write_all(line.as_bytes()).and_then(|()| to.flush()) {
            Ok(()) => Event::Written,
            Err(error) => Event::NotWritten(error),
        };
        if written.send(event).is_err() {
            return;
        }
    }
}

/// Reads lines to the end, and leaves them once nobody listens.
fn read_lines(from: impl Read, to: &SyncSender<Event>) {
    let mut from = BufReader::new(from);
    loop {
        let mut line = String::new();
        let event = match (&mut from).take(LINE_MAX).read_line(&mut line) {
            Ok(0) => Event::Ended,
            Ok(_) => Event::Line(line, String::from_utf8_lossy(from.buffer()).into_owned()),
            Err(error) => Event::NotRead(error),
        };
        let last = !matches!(event, Event::Line(..));
        if to.send(event).is_err() {
            // It fails where the program has ended.
            let _ = io::copy(&mut from, &mut io::sink());
            return;
        }
        if last {
            return;
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicU64, Ordering};

    use nalgebra::Matrix3;

    use super::*;

    /// Lines without end, counted.
    struct Endless(Arc<AtomicU64>);

    impl Read for Endless {
        fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
            to.fill(b'\n');
            let count = to.len().try_into().unwrap_or(u64::MAX);
            // Ends what would otherwise fill the memory.
            let before = self.0.fetch_add(count, Ordering::SeqCst);
            Ok(if before < 1 << 24 { to.len() } else { 0 })
        }
    }

    #[test]
    fn what_nobody_asks_for_is_not_kept() {
        let count = Arc::new(AtomicU64::new(0));
        let (to, events) = sync_channel(EVENTS);
        let from = Endless(Arc::clone(&count));
        let reader = thread::spawn(move || read_lines(from, &to));
        assert!(matches!(events.recv(), Ok(Event::Line(..))));
        thread::sleep(Duration::from_millis(100));
        // One buffer of the reader.
        assert!(count.load(Ordering::SeqCst) <= 1 << 16, "{count:?}");
        // At the end of a run what is written is read and left.
        drop(events);
        reader.join().expect("a thread");
        assert!(count.load(Ordering::SeqCst) > 1 << 24);
    }

    #[test]
    fn the_time_limit_is_that_of_writing_as_well() {
        // More than a pipe holds, to a program that does not read.
        let name = "a".repeat(1 << 20);
        let greeting = Greeting {
            name: &name,
            times: [1.0, 0.0, 0.0],
            joints: &[],
            inertia: Matrix3::identity(),
        };
        let command = ["sleep", "20"].map(str::to_owned);
        let begun = Instant::now();
        let started = ProgramController::start(&command, Path::new(""), 0.2, &greeting);
        let error = started.err().expect("it does not read").to_string();
        assert_eq!(error, "its program does not read its standard input within 0.2 s");
        assert!(begun.elapsed() < Duration::from_secs(15), "{:?}", begun.elapsed());
    }

    /// The threads of the pipes report in any order: the end of a program before that its sample is written.
    #[test]
    fn an_answer_before_the_end_is_an_answer() {
        let child = Program::new("sh").args(["-c", "exit 3"]).spawn().expect("a program");
        let (to, events) = sync_channel(EVENTS);
        let (lines, to_write) = sync_channel::<String>(EVENTS);
        let limit = Duration::from_secs(60);
        let mut controller =
            ProgramController { child, lines: Some(lines), events, last: None, limit };
        let reports = thread::spawn(move || {
            to_write.recv().expect("a sample");
            for event in [
                Event::Line("{\"torque\":[1,0,0]}\n".to_owned(), String::new()),
                Event::Ended,
                Event::Written,
            ] {
                to.send(event).expect("a controller");
            }
        });
        let answer = controller.exchange("{}\n".to_owned(), true).expect("an answer");
        assert_eq!(answer, "{\"torque\":[1,0,0]}\n");
        reports.join().expect("reports");
        let error = controller.exchange("{}\n".to_owned(), true).expect_err("it has ended");
        assert!(error.to_string().contains("has ended (exit status: 3)"), "{error}");
    }
}
