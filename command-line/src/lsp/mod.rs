//! `autogen lsp`: a language server on standard input and output. It reads files and writes none.

mod documents;
mod layouts;
mod published;
mod questions;
mod root;
mod server;
mod transport;
mod uri;

use crate::Status;
use server::{Next, Server};
use std::collections::VecDeque;
use std::io;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};
use transport::Incoming;

/// Messages that are kept before they are checked.
const MOST_WAITING: usize = 100;
/// Nothing is checked while somebody types: until nothing has come for so long,
const QUIET: Duration = Duration::from_millis(150);
/// or until so long after the first change.
const LATEST: Duration = Duration::from_secs(2);

pub fn run() -> Status {
    let (sender, receiver) = mpsc::sync_channel(MOST_WAITING);
    thread::spawn(move || {
        let mut input = io::stdin().lock();
        loop {
            let message = transport::read(&mut input);
            let is_last = matches!(message, Incoming::End | Incoming::Lost(_));
            if sender.send(message).is_err() || is_last {
                return;
            }
        }
    });
    match answer_all(&receiver) {
        Ok(status) => status,
        // Nobody reads the answers any more.
        Err(_) => Status::WrongInput,
    }
}

/// Until the client ends it. Well is to ask for a shutdown first.
fn answer_all(receiver: &Receiver<Incoming>) -> io::Result<Status> {
    let mut server = Server::new(io::stdout());
    let mut waiting = VecDeque::new();
    let mut changed: Option<Instant> = None;
    loop {
        let room = MOST_WAITING.saturating_sub(waiting.len());
        waiting.extend(receiver.try_iter().take(room));
        let is_late = changed.is_some_and(|since| since.elapsed() >= LATEST);
        if waiting.is_empty() || is_late {
            let next = match (changed, is_late) {
                (Some(_), true) => Err(RecvTimeoutError::Timeout),
                (Some(_), false) => receiver.recv_timeout(QUIET),
                (None, _) => receiver.recv().map_err(|_| RecvTimeoutError::Disconnected),
            };
            match next {
                Ok(message) => waiting.push_back(message),
                Err(RecvTimeoutError::Timeout) => {
                    server.publish()?;
                    changed = None;
                }
                Err(RecvTimeoutError::Disconnected) => waiting.push_back(Incoming::End),
            }
            continue;
        }
        let Some(message) = waiting.pop_front() else { continue };
        match server.take(message, &waiting)? {
            Next::Ready => {}
            Next::Changed => changed = changed.or_else(|| Some(Instant::now())),
            Next::Ended(status) => return Ok(status),
        }
    }
}
