//! Friction behind a spring, its strength fast − (fast − slow) e^(−rate |v|).

/// Its numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slider {
    pub(super) stiffness: f64,
    pub(super) slow: f64,
    pub(super) fast: f64,
    pub(super) rate: f64,
}

/// What it does.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mode {
    /// It sticks, since this deformation with this force.
    Stick(f64, f64),
    /// It slips in this direction.
    Slip(f64),
}

impl Mode {
    pub(super) const REST: Self = Self::Stick(0.0, 0.0);
}

impl Slider {
    fn strength(&self, speed: f64) -> f64 {
        self.fast - (self.fast - self.slow) * (-self.rate * speed.abs()).exp()
    }

    /// Force at deformation x and rate v.
    pub(super) fn force(&self, mode: Mode, x: f64, v: f64) -> f64 {
        match mode {
            Mode::Stick(at, force) => force + self.stiffness * (x - at),
            Mode::Slip(sign) => sign * self.strength(v),
        }
    }

    /// How far it is from leaving its mode, in newtons and metres a second, at the derivative w of the rate.
    pub(super) fn conditions(&self, mode: Mode, x: f64, v: f64, w: f64) -> [f64; 2] {
        match mode {
            Mode::Stick(..) => [
                self.strength(v) * (1.0 + 1e-12) - self.force(mode, x, v).abs(),
                1.0,
            ],
            Mode::Slip(sign) => {
                // What slips is the rate less that of the spring.
                let missing = (self.fast - self.slow) * (-self.rate * v.abs()).exp();
                let rise = self.rate * missing * w / self.stiffness;
                [sign * v + 1e-13, sign * (v - rise) + 1e-12]
            }
        }
    }

    /// The mode that follows at deformation x and rate v.
    pub(super) fn next(&self, mode: Mode, x: f64, v: f64) -> Mode {
        match mode {
            Mode::Stick(..) => Mode::Slip(1.0_f64.copysign(self.force(mode, x, v))),
            Mode::Slip(_) => Mode::Stick(x, self.force(mode, x, v)),
        }
    }
}
