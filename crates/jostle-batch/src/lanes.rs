//! Numbers of a lane, and plain arrays of them that the compiler puts into registers.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// `f32` or `f64`. Nothing here depends on the processor: powers come from `libm`.
pub(crate) trait Real:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Send
    + Sync
{
    const ZERO: Self;
    const ONE: Self;
    /// Shorter than any length that matters \[m\].
    const SHORT: Self;
    fn of(value: f64) -> Self;
    fn wide(self) -> f64;
    fn root(self) -> Self;
    fn power(self, exponent: Self) -> Self;

    #[inline(always)]
    fn least(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn size(self) -> Self {
        self.most(-self)
    }
}

impl Real for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const SHORT: Self = 1e-9;
    #[inline(always)]
    fn of(value: f64) -> Self {
        value as Self
    }
    #[inline(always)]
    fn wide(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    fn power(self, exponent: Self) -> Self {
        libm::powf(self, exponent)
    }
}

impl Real for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const SHORT: Self = 1e-12;
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn wide(self) -> f64 {
        self
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    fn power(self, exponent: Self) -> Self {
        libm::pow(self, exponent)
    }
}

/// A value of every lane.
#[inline(always)]
pub(crate) fn each<T: Real, const W: usize>(value: impl Fn(usize) -> T) -> [T; W] {
    // Not `array::from_fn`: the compiler leaves that out of line, outside what knows the wide registers.
    let mut all = [T::ZERO; W];
    for l in 0..W {
        all[l] = value(l);
    }
    all
}
