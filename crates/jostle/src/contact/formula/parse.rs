//! Reads a formula into steps. Stacks of operations take the place of recursion, so that no text is too deep.

use std::fmt;

use super::step::{Operation, Step};
use super::{Formula, MOST_CONSTANTS, MOST_STEPS, MOST_WAITING, Name};

/// What is wrong with a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormulaError(String);

impl fmt::Display for FormulaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for FormulaError {}

fn wrong<T>(text: impl Into<String>) -> Result<T, FormulaError> {
    Err(FormulaError(text.into()))
}

/// What is read next.
#[derive(Clone, Debug, PartialEq)]
enum Token<'a> {
    Number(f64),
    Word(&'a str),
    Sign(Operation),
    Open,
    Close,
    Comma,
}

/// What waits for its right side or its bracket.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Open {
    Operation(Operation),
    Bracket,
    /// A function and the number of its values so far.
    Function(Operation, usize),
}

/// Longest text of a formula.
const MOST_CHARACTERS: usize = 1000;

pub(super) fn parse(text: &str) -> Result<Formula, FormulaError> {
    if text.chars().count() > MOST_CHARACTERS {
        return wrong(format!(
            "a formula has at most {MOST_CHARACTERS} characters"
        ));
    }
    let mut writer = Writer::default();
    let mut open: Vec<Open> = Vec::new();
    let mut rest = text;
    // Whether a value ended just before, so that a sign or bracket may follow.
    let mut ended = false;
    while let Some((token, after)) = next(rest)? {
        let place = || rest.trim_start().chars().take(12).collect::<String>();
        let value = matches!(token, Token::Number(_) | Token::Word(_) | Token::Open);
        if value && ended {
            return wrong(format!(
                "an operation such as * is missing before \"{}\"",
                place()
            ));
        }
        match token {
            Token::Number(number) => {
                writer.constant(number)?;
                ended = true;
            }
            Token::Word(word) => match function(word) {
                Some(function) if after.trim_start().starts_with('(') => {
                    open.push(Open::Function(function, 1));
                    rest = &after.trim_start()[1..];
                    ended = false;
                    continue;
                }
                Some(_) => return wrong(format!("{word} needs its values in brackets: {word}(…)")),
                None => {
                    writer.push(Step::Name(name(word)?))?;
                    ended = true;
                }
            },
            Token::Sign(sign) if ended => {
                // What binds tighter, or as tight and stands left, is done first; powers from the right.
                while let Some(&Open::Operation(before)) = open.last()
                    && (before.rank() > sign.rank()
                        || (before.rank() == sign.rank() && sign != Operation::Power))
                {
                    open.pop();
                    writer.push(Step::Apply(before))?;
                }
                open.push(Open::Operation(sign));
                ended = false;
            }
            Token::Sign(Operation::Subtract) => open.push(Open::Operation(Operation::Negate)),
            Token::Sign(Operation::Add) => {}
            Token::Sign(_) => return wrong(format!("a value is missing before \"{}\"", place())),
            Token::Open => open.push(Open::Bracket),
            Token::Comma | Token::Close if !ended => {
                return wrong(format!("a value is missing before \"{}\"", place()));
            }
            Token::Comma => {
                finish(&mut open, &mut writer)?;
                match open.last_mut() {
                    Some(Open::Function(_, count)) => *count += 1,
                    _ => {
                        return wrong(
                            "a comma stands outside the brackets of a function; write 1.5 for a decimal",
                        );
                    }
                }
                ended = false;
            }
            Token::Close => {
                finish(&mut open, &mut writer)?;
                match open.pop() {
                    Some(Open::Bracket) => {}
                    Some(Open::Function(function, count)) => {
                        let due = function.takes();
                        if count != due {
                            let name = Operation::FUNCTIONS
                                .iter()
                                .find(|(candidate, _)| *candidate == function);
                            let name = name.map_or("", |(_, name)| name);
                            return wrong(format!(
                                "{name} takes {due} value{}, found {count}",
                                if due == 1 { "" } else { "s" }
                            ));
                        }
                        writer.push(Step::Apply(function))?;
                    }
                    _ => return wrong("a bracket is closed that was not opened"),
                }
            }
        }
        rest = after;
    }
    if !ended {
        return wrong("a value is missing at the end");
    }
    finish(&mut open, &mut writer)?;
    if !open.is_empty() {
        return wrong("a bracket is not closed");
    }
    let formula = writer.formula();
    for (name, text, meaning) in [
        (Name::Indentation, "d", "the indentation"),
        (Name::Stiffness, "k", "the stiffness of the gap"),
    ] {
        if !formula.uses(name) {
            return wrong(format!(
                "must contain {text}, {meaning}, as in \"k * d^1.5\""
            ));
        }
    }
    Ok(formula)
}

/// Does what waits since the last bracket.
fn finish(open: &mut Vec<Open>, writer: &mut Writer) -> Result<(), FormulaError> {
    while let Some(&Open::Operation(operation)) = open.last() {
        open.pop();
        writer.push(Step::Apply(operation))?;
    }
    Ok(())
}

fn function(word: &str) -> Option<Operation> {
    let known = Operation::FUNCTIONS.iter().find(|(_, name)| *name == word);
    known.map(|(function, _)| *function)
}

fn name(word: &str) -> Result<Name, FormulaError> {
    let known = Name::ALL.iter().find(|(_, text)| *text == word);
    known.map(|(name, _)| *name).ok_or_else(|| {
        let names: Vec<&str> = Name::ALL.iter().map(|(_, text)| *text).collect();
        let (last, rest) = names.split_last().unwrap_or((&"", &[]));
        FormulaError(format!(
            "\"{word}\" is no name of a formula; use {} or {last}",
            rest.join(", ")
        ))
    })
}

/// The next token and the text after it; `None` at the end.
fn next(text: &str) -> Result<Option<(Token<'_>, &str)>, FormulaError> {
    let text = text.trim_start();
    let Some(first) = text.chars().next() else {
        return Ok(None);
    };
    let cut = |length: usize| text.split_at(length);
    if first.is_ascii_digit() || first == '.' {
        let length = number_length(text);
        let (number, rest) = cut(length);
        let value = number.parse().ok().filter(|value: &f64| value.is_finite());
        return match value {
            Some(value) => Ok(Some((Token::Number(value), rest))),
            None => wrong(format!("\"{number}\" is not a usable number")),
        };
    }
    if first.is_ascii_alphabetic() || first == '_' {
        let length = text
            .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
            .unwrap_or(text.len());
        let (word, rest) = cut(length);
        return Ok(Some((Token::Word(word), rest)));
    }
    let sign = Operation::SIGNS.iter().find(|(_, sign)| *sign == first);
    let token = match (first, sign) {
        (_, Some((operation, _))) => Token::Sign(*operation),
        ('(', _) => Token::Open,
        (')', _) => Token::Close,
        (',', _) => Token::Comma,
        _ => return wrong(format!("\"{first}\" has no meaning in a formula")),
    };
    Ok(Some((token, cut(first.len_utf8()).1)))
}

/// Length of the number with which a text begins, such as `2`, `1.5` or `2e9`.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        let bytes = bytes[from..].iter().take_while(|b| b.is_ascii_digit());
        from + bytes.count()
    };
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let signed = matches!(bytes.get(end + 1), Some(b'+' | b'-'));
        let from = end + 1 + usize::from(signed);
        // A letter without digits behind it is a name.
        if from < bytes.len() && bytes[from].is_ascii_digit() {
            end = digits(from);
        }
    }
    end
}

/// Collects steps and counts the values that wait.
#[derive(Default)]
struct Writer {
    steps: Vec<Step>,
    constants: Vec<f64>,
    waiting: usize,
}

impl Writer {
    fn constant(&mut self, number: f64) -> Result<(), FormulaError> {
        let known = self
            .constants
            .iter()
            .position(|constant| constant.to_bits() == number.to_bits());
        let index = known.unwrap_or(self.constants.len());
        if index == MOST_CONSTANTS {
            return wrong(format!(
                "a formula has at most {MOST_CONSTANTS} different numbers"
            ));
        }
        if known.is_none() {
            self.constants.push(number);
        }
        // Fewer than 256.
        self.push(Step::Constant(u8::try_from(index).unwrap_or_default()))
    }

    fn push(&mut self, step: Step) -> Result<(), FormulaError> {
        if self.steps.len() == MOST_STEPS {
            return wrong(format!(
                "a formula has at most {MOST_STEPS} values and operations"
            ));
        }
        match step {
            Step::Apply(operation) => self.waiting = self.waiting + 1 - operation.takes(),
            Step::Constant(_) | Step::Name(_) => self.waiting += 1,
        }
        if self.waiting > MOST_WAITING {
            return wrong(
                "the brackets are nested too deeply; write sums and products from the left",
            );
        }
        self.steps.push(step);
        Ok(())
    }

    fn formula(&self) -> Formula {
        let mut steps = [Step::Constant(0); MOST_STEPS];
        steps[..self.steps.len()].copy_from_slice(&self.steps);
        let mut constants = [0.0; MOST_CONSTANTS];
        constants[..self.constants.len()].copy_from_slice(&self.constants);
        Formula {
            steps,
            length: u8::try_from(self.steps.len()).unwrap_or_default(),
            constants,
            share: 1.0,
        }
    }
}
