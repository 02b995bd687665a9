//! Values and operations of a formula, with derivatives by indentation and rate.

use super::{Formula, MOST_CONSTANTS, Name};

/// One step of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Constant(u8),
    Name(Name),
    Apply(Operation),
}

/// What is done to the values before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Negate,
    Below,
    Above,
    Sqrt,
    Abs,
    Exp,
    Ln,
    Tanh,
    Min,
    Max,
    If,
}

/// A value with its derivatives by indentation and rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Dual {
    pub(super) value: f64,
    pub(super) by_indentation: f64,
    pub(super) by_rate: f64,
}

impl Dual {
    pub(super) fn new(value: f64, by_indentation: f64, by_rate: f64) -> Self {
        Self {
            value,
            by_indentation,
            by_rate,
        }
    }

    pub(super) fn constant(value: f64) -> Self {
        Self::new(value, 0.0, 0.0)
    }

    /// A function of this value with its slope there.
    fn through(self, value: f64, slope: f64) -> Self {
        // A value that does not change has no derivative, however steep the function is there.
        let chain = |value: f64| if value == 0.0 { 0.0 } else { slope * value };
        Self::new(value, chain(self.by_indentation), chain(self.by_rate))
    }

    /// The sum of the derivatives of two values, at another value.
    fn joined(value: f64, a: Self, b: Self) -> Self {
        Self::new(
            value,
            a.by_indentation + b.by_indentation,
            a.by_rate + b.by_rate,
        )
    }
}

impl Operation {
    /// Functions by name.
    pub(super) const FUNCTIONS: [(Self, &'static str); 8] = [
        (Self::Sqrt, "sqrt"),
        (Self::Abs, "abs"),
        (Self::Exp, "exp"),
        (Self::Ln, "ln"),
        (Self::Tanh, "tanh"),
        (Self::Min, "min"),
        (Self::Max, "max"),
        (Self::If, "if"),
    ];

    /// Signs between two values.
    pub(super) const SIGNS: [(Self, char); 7] = [
        (Self::Add, '+'),
        (Self::Subtract, '-'),
        (Self::Multiply, '*'),
        (Self::Divide, '/'),
        (Self::Power, '^'),
        (Self::Below, '<'),
        (Self::Above, '>'),
    ];

    /// Number of values that it takes.
    pub(super) const fn takes(self) -> usize {
        match self {
            Self::Negate | Self::Sqrt | Self::Abs | Self::Exp | Self::Ln | Self::Tanh => 1,
            Self::Add
            | Self::Subtract
            | Self::Multiply
            | Self::Divide
            | Self::Power
            | Self::Below
            | Self::Above
            | Self::Min
            | Self::Max => 2,
            Self::If => 3,
        }
    }

    /// How tightly a sign binds: the greater first.
    pub(super) const fn rank(self) -> u8 {
        match self {
            Self::Below | Self::Above => 1,
            Self::Add | Self::Subtract => 2,
            Self::Multiply | Self::Divide => 3,
            Self::Negate => 4,
            Self::Power => 5,
            _ => 6,
        }
    }

    /// Whether its slope jumps.
    pub(super) const fn has_corner(self) -> bool {
        matches!(self, Self::Abs | Self::Min | Self::Max | Self::If)
    }

    /// Its result for as many values as it takes.
    #[inline]
    pub(super) fn apply(self, of: &[Dual]) -> Dual {
        let a = of[0];
        let b = of.get(1).copied().unwrap_or_default();
        let truth = |holds: bool| Dual::constant(f64::from(u8::from(holds)));
        match self {
            Self::Add => Dual::joined(a.value + b.value, a, b),
            Self::Subtract => Dual::joined(a.value - b.value, a, b.through(0.0, -1.0)),
            Self::Multiply => Dual::joined(
                a.value * b.value,
                a.through(0.0, b.value),
                b.through(0.0, a.value),
            ),
            Self::Divide => {
                let value = a.value / b.value;
                Dual::joined(
                    value,
                    a.through(0.0, 1.0 / b.value),
                    b.through(0.0, -value / b.value),
                )
            }
            Self::Power => {
                let value = libm::pow(a.value, b.value);
                let by_base = b.value * libm::pow(a.value, b.value - 1.0);
                let by_exponent = value * libm::log(a.value);
                Dual::joined(value, a.through(0.0, by_base), b.through(0.0, by_exponent))
            }
            Self::Negate => a.through(-a.value, -1.0),
            Self::Below => truth(a.value < b.value),
            Self::Above => truth(a.value > b.value),
            Self::Sqrt => {
                let root = a.value.sqrt();
                a.through(root, 0.5 / root)
            }
            Self::Abs => a.through(a.value.abs(), a.value.signum()),
            Self::Exp => {
                let value = libm::exp(a.value);
                a.through(value, value)
            }
            Self::Ln => a.through(libm::log(a.value), 1.0 / a.value),
            Self::Tanh => {
                let value = libm::tanh(a.value);
                a.through(value, 1.0 - value * value)
            }
            Self::Min if b.value < a.value => b,
            Self::Max if b.value > a.value => b,
            Self::Min | Self::Max => a,
            Self::If if a.value > 0.0 => b,
            Self::If => of[2],
        }
    }
}

/// Indentations from nothing up, each a quarter deeper than the one before \[m\].
pub(super) struct Depths {
    last: f64,
}

/// The first of them, and the last \[m\].
const SHALLOW: f64 = 1e-8;
const DEEP: f64 = 10.0;

impl Depths {
    pub(super) fn new() -> Self {
        Self { last: 0.0 }
    }
}

impl Iterator for Depths {
    type Item = [f64; 2];

    fn next(&mut self) -> Option<[f64; 2]> {
        let from = self.last;
        self.last = (1.25 * from).max(SHALLOW);
        (from < DEEP).then_some([from, self.last])
    }
}

/// The formula as text, with as few brackets as its meaning needs.
pub(super) fn written(formula: &Formula) -> String {
    // Each text with the rank of its last operation.
    let mut waiting: Vec<(String, u8)> = Vec::new();
    const VALUE: u8 = 6;
    for step in formula.steps() {
        let text = match step {
            Step::Constant(index) => {
                debug_assert!(usize::from(*index) < MOST_CONSTANTS);
                (format!("{}", formula.constants[usize::from(*index)]), VALUE)
            }
            Step::Name(name) => {
                let known = Name::ALL.iter().find(|(candidate, _)| candidate == name);
                (known.map_or("", |(_, text)| text).to_owned(), VALUE)
            }
            Step::Apply(operation) => {
                let first = waiting.len().saturating_sub(operation.takes());
                let of = waiting.split_off(first);
                let rank = operation.rank();
                let bracketed =
                    |(text, text_rank): &(String, u8), least: u8| match *text_rank < least {
                        true => format!("({text})"),
                        false => text.clone(),
                    };
                let sign = Operation::SIGNS
                    .iter()
                    .find(|(candidate, _)| candidate == operation);
                let function = Operation::FUNCTIONS
                    .iter()
                    .find(|(candidate, _)| candidate == operation);
                let text = match (sign, function) {
                    (Some((_, sign)), _) => {
                        // Only what is written after - or / needs brackets at the same rank; powers are read from the right.
                        let [left, right] = match operation {
                            Operation::Power => [rank + 1, rank],
                            Operation::Subtract | Operation::Divide => [rank, rank + 1],
                            _ => [rank, rank],
                        };
                        let wide = if rank < 3 { " " } else { "" };
                        let (left, right) = (bracketed(&of[0], left), bracketed(&of[1], right));
                        format!("{left}{wide}{sign}{wide}{right}")
                    }
                    (None, Some((_, name))) => {
                        let of: Vec<&str> = of.iter().map(|(text, _)| &text[..]).collect();
                        format!("{name}({})", of.join(", "))
                    }
                    (None, None) => format!("-{}", bracketed(&of[0], rank)),
                };
                (text, rank)
            }
        };
        waiting.push(text);
    }
    waiting.pop().map_or_else(String::new, |(text, _)| text)
}
