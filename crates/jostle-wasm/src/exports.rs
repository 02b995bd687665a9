//! Functions that the page calls.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::ops::ControlFlow;

use jostle_live::{Answer, Engine, Local};

#[link(wasm_import_module = "jostle")]
unsafe extern "C" {
    /// Called during a run with the share that is done, from 0 to 1.
    safe fn progress(share: f64);
}

/// What is kept between calls.
#[derive(Default)]
struct Kept {
    local: Option<Local>,
    input: Vec<u8>,
    output: Vec<u8>,
    answers: VecDeque<Answer>,
    /// Files of the page, by the name that the model has for them.
    files: BTreeMap<String, Vec<u8>>,
}

thread_local! {
    static KEPT: RefCell<Kept> = RefCell::default();
}

fn with<T>(act: impl FnOnce(&mut Kept) -> T) -> T {
    KEPT.with_borrow_mut(act)
}

/// Makes room for the input of the next call: its address.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn reserve(length: usize) -> usize {
    with(|kept| {
        kept.input.clear();
        kept.input.resize(length, 0);
        kept.input.as_mut_ptr() as usize
    })
}

/// Keeps a file. The input is its path, of this many bytes, and its content.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn provide(path_length: usize) {
    with(|kept| {
        let (path, content) = kept.input.split_at(path_length.min(kept.input.len()));
        let path = String::from_utf8_lossy(path).into_owned();
        let content = content.to_vec();
        kept.files.insert(path, content);
    });
}

/// Opens a model. The input is its name, of this many bytes, and its text. 1 when it could be opened; otherwise the
/// answer is what is wrong.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn open(name_length: usize) -> u32 {
    with(|kept| {
        let (name, text) = kept.input.split_at(name_length.min(kept.input.len()));
        let [name, text] = [name, text].map(String::from_utf8_lossy);
        let files = jostle_io::Files::held(kept.files.clone());
        match Engine::with_files(&name, &text, files) {
            Ok(engine) => {
                let local = Local::new(engine);
                kept.answers.push_back(local.hello());
                kept.local = Some(local);
                1
            }
            Err(error) => {
                kept.answers.push_back(Answer::Text(error.to_string()));
                0
            }
        }
    })
}

/// Answers the request in the input. 1 when it is one; otherwise the answer is what is wrong.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn answer() -> u32 {
    with(|kept| {
        let request = String::from_utf8_lossy(&kept.input);
        let watch = |share| {
            progress(share);
            ControlFlow::Continue(())
        };
        let Some(local) = &mut kept.local else {
            return 0;
        };
        match local.answer(&request, &watch) {
            Ok(answer) => {
                kept.answers.extend(answer);
                1
            }
            Err(problem) => {
                kept.answers.push_back(Answer::Text(problem));
                0
            }
        }
    })
}

/// Computes the next point of the curve: 0 when there is nothing more to compute.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn more() -> u32 {
    with(|kept| {
        let answer = kept.local.as_mut().and_then(Local::more);
        let found = u32::from(answer.is_some());
        kept.answers.extend(answer);
        found
    })
}

/// Looks for an instant on which the later results of the latest run depend: 0 when there is nothing to look for.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn accuracy() -> u32 {
    with(|kept| {
        let local = kept.local.as_mut();
        let answer = local.and_then(|local| local.accuracy(&|| ControlFlow::Continue(())));
        let found = u32::from(answer.is_some());
        kept.answers.extend(answer);
        found
    })
}

/// Takes the next answer: 0 when there is none, 1 for text, 2 for binary.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn next() -> u32 {
    with(|kept| {
        let (kind, bytes) = match kept.answers.pop_front() {
            None => (0, Vec::new()),
            Some(Answer::Text(text)) => (1, text.into_bytes()),
            Some(Answer::Binary(bytes)) => (2, bytes),
        };
        kept.output = bytes;
        kind
    })
}

/// Address of the answer that was taken last.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn output_address() -> usize {
    with(|kept| kept.output.as_ptr() as usize)
}

/// Its length in bytes.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn output_length() -> usize {
    with(|kept| kept.output.len())
}
