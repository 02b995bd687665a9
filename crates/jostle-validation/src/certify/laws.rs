//! Contact laws written anew from docs/contact.md, as smooth pieces with the conditions under which each holds.

use jostle::contact::ForceLaw;

/// A law with its numbers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Law {
    /// k δ + c δ̇.
    Kelvin { k: f64, c: f64, tension: bool },
    /// k δ + c δ̇ in approach only.
    Approach { k: f64, c: f64 },
    /// k δⁿ (1 + d δ̇/v).
    Damped { k: f64, d: f64, n: f64 },
    /// k δ^1.5 + c δ^¼ δ̇ in approach only.
    Jankowski { k: f64, c: f64 },
    /// k δ_u (δ/δ_u)ⁿ up to δ_u, beyond along the tangent; in restitution times 1 + d δ̇/v.
    Rubber { k: f64, d: f64, n: f64, limit: f64 },
    /// A spring beside a slider; numbers at the reference speed.
    Bilinear {
        first: f64,
        second: f64,
        yields: f64,
        follows: bool,
    },
}

/// Which smooth piece of a law holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piece {
    /// The formula as it stands.
    Push,
    /// No force although the faces are indented.
    Cut,
    /// Approach.
    In,
    /// Restitution.
    Out,
    /// The speed by which the law divides is the present one.
    Rising,
    /// The slider sticks, since (indentation, its force).
    Stick(f64, f64),
    /// The slider slips at its limit.
    Slip,
    /// The slider slips at zero.
    Slack,
}

/// A closed contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closed {
    pub(super) law: Law,
    pub(super) piece: Piece,
    /// Speed by which the law divides \[m/s\].
    pub(super) speed: f64,
    from_rest: bool,
    scale: f64,
    pub(super) impulse: f64,
}

/// What follows when a condition fails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Next {
    Release,
    Piece(Piece),
}

/// Conditions of a piece: how far each is from failing, and what follows.
pub(super) type Conditions = [(f64, Next); 3];
const NEVER: (f64, Next) = (1.0, Next::Release);
/// Rounding of indentations \[m\] and rates \[m/s\], which is no event.
const NOISE: [f64; 2] = [1e-15, 1e-12];

impl Law {
    /// The law, and the coefficient of sudden impacts of the momentum law.
    pub(super) fn new(law: &ForceLaw) -> Result<(Self, Option<f64>), String> {
        Ok(match *law {
            ForceLaw::Kelvin {
                stiffness,
                damping,
                tension,
            } => (
                Self::Kelvin {
                    k: stiffness,
                    c: damping,
                    tension: tension && damping > 0.0,
                },
                None,
            ),
            ForceLaw::ApproachKelvin { stiffness, damping } => (
                Self::Approach {
                    k: stiffness,
                    c: damping,
                },
                None,
            ),
            ForceLaw::DampedLinear { stiffness, damping } => (
                Self::Damped {
                    k: stiffness,
                    d: damping,
                    n: 1.0,
                },
                None,
            ),
            ForceLaw::Hertz { stiffness, damping } => (
                Self::Damped {
                    k: stiffness,
                    d: damping,
                    n: 1.5,
                },
                None,
            ),
            ForceLaw::Jankowski { stiffness, damping } => (
                Self::Jankowski {
                    k: stiffness,
                    c: damping,
                },
                None,
            ),
            ForceLaw::Bilinear(bilinear) => (
                Self::Bilinear {
                    first: bilinear.first_stiffness,
                    second: bilinear.second_stiffness,
                    yields: bilinear.yield_indentation,
                    follows: bilinear.follows_speed,
                },
                None,
            ),
            ForceLaw::Restitution {
                restitution,
                stiffness,
                damping,
            } => (
                Self::Kelvin {
                    k: stiffness,
                    c: damping,
                    tension: false,
                },
                Some(restitution),
            ),
            ForceLaw::Formula(_) => {
                return Err("formulas are compared with the laws that they write".into());
            }
            ForceLaw::Crushing(_) => {
                return Err("faces that crush have their own references".into());
            }
            ForceLaw::Rubber(rubber) => (
                Self::Rubber {
                    k: rubber.stiffness,
                    d: rubber.damping,
                    n: rubber.exponent,
                    limit: rubber.limit,
                },
                None,
            ),
        })
    }

    /// Whether the force starts and ends as a broken power of the time.
    pub(super) fn is_steep(&self) -> bool {
        matches!(self, Self::Jankowski { .. } | Self::Rubber { .. })
            || matches!(self, Self::Damped { n, .. } if *n > 1.0)
    }
}

impl Closed {
    /// Closing at a rate ≥ 0 \[m/s\].
    pub(super) fn touch(law: Law, rate: f64) -> Self {
        let from_rest = rate < 1e-3;
        let piece = match law {
            Law::Kelvin { .. } => Piece::Push,
            Law::Damped { d, .. } if from_rest && d > 0.0 => Piece::Rising,
            Law::Damped { .. } => Piece::Push,
            Law::Rubber { d, .. } if from_rest && d > 0.0 => Piece::Rising,
            Law::Approach { .. } | Law::Jankowski { .. } | Law::Rubber { .. } => Piece::In,
            Law::Bilinear { .. } => Piece::Stick(0.0, 0.0),
        };
        let scale = match law {
            Law::Bilinear { follows: true, .. } => rate.max(1e-2).powf(0.4),
            _ => 1.0,
        };
        Self {
            law,
            piece,
            speed: rate.max(1e-9),
            from_rest,
            scale,
            impulse: 0.0,
        }
    }

    /// Force at indentation x \[m\] and rate v \[m/s\] along the present piece \[N\].
    pub(super) fn force(&self, x: f64, v: f64) -> f64 {
        match (self.law, self.piece) {
            (_, Piece::Cut) => 0.0,
            (Law::Kelvin { k, c, .. }, _) | (Law::Approach { k, c }, Piece::In) => k * x + c * v,
            (Law::Approach { k, .. }, _) => k * x,
            (Law::Damped { k, d, n }, piece) => {
                let factor = if piece == Piece::Rising {
                    1.0 + d
                } else {
                    1.0 + d * v / self.speed
                };
                let power = if n == 1.0 {
                    x
                } else {
                    x.max(0.0) * x.max(0.0).sqrt()
                };
                k * power * factor
            }
            (Law::Jankowski { k, c }, piece) => {
                let x = x.max(0.0);
                let root = x.sqrt();
                let damper = if piece == Piece::In {
                    c * root.sqrt() * v
                } else {
                    0.0
                };
                k * x * root + damper
            }
            (Law::Rubber { k, d, n, limit }, piece) => {
                let share = x.max(0.0) / limit;
                let elastic = if share > 1.0 {
                    1.0 + n * (share - 1.0)
                } else {
                    share.powf(n)
                };
                let factor = if piece == Piece::Out {
                    1.0 + d * v / self.speed
                } else {
                    1.0
                };
                k * limit * elastic * factor
            }
            (Law::Bilinear { second, .. }, piece) => {
                let (slider, limit) = self.slider();
                let slip = match piece {
                    Piece::Stick(from, force) => force + slider * (x - from),
                    Piece::Slip => limit,
                    _ => 0.0,
                };
                second * self.scale * x + slip
            }
        }
    }

    /// Stiffness of the slider, and the force at which it slips.
    fn slider(&self) -> (f64, f64) {
        let Law::Bilinear {
            first,
            second,
            yields,
            ..
        } = self.law
        else {
            return (0.0, 0.0);
        };
        let stiffness = (first - second) * self.scale;
        (stiffness, stiffness * yields * self.scale * self.scale)
    }

    /// How far the conditions of the piece are from failing, at indentation x, rate v and its derivative w.
    pub(super) fn conditions(&self, x: f64, v: f64, w: f64) -> Conditions {
        // Faces that touch together with others may still be a little apart.
        let release = (
            if v > 0.0 { x.max(0.0) } else { x } + NOISE[0],
            Next::Release,
        );
        let to = |margin: f64, piece: Piece| (margin, Next::Piece(piece));
        match (self.law, self.piece) {
            (Law::Kelvin { tension: true, .. }, _) => [release, NEVER, NEVER],
            (Law::Kelvin { k, c, .. }, Piece::Push) if c > 0.0 => {
                // Before the faces part the force has come to its end; at the touch both are about zero.
                [to(k * x + c * v, Piece::Cut), NEVER, NEVER]
            }
            (Law::Kelvin { k, c, .. }, Piece::Cut) => {
                [release, to(-(k * x + c * v), Piece::Push), NEVER]
            }
            (Law::Kelvin { .. }, _) => [release, NEVER, NEVER],
            (Law::Rubber { d, .. }, Piece::In) if self.from_rest && d > 0.0 => [
                release,
                to(v, Piece::Out),
                to(self.speed - v + NOISE[1], Piece::Rising),
            ],
            (Law::Rubber { .. }, Piece::Rising) => [release, to(w + NOISE[1], Piece::In), NEVER],
            (Law::Rubber { d, .. }, Piece::Out) => [
                release,
                to(-v, Piece::In),
                to(1.0 + d * v / self.speed, Piece::Cut),
            ],
            (_, Piece::In) => [release, to(v, Piece::Out), NEVER],
            (Law::Rubber { d, .. }, _) => {
                [release, to(-(1.0 + d * v / self.speed), Piece::Out), NEVER]
            }
            (Law::Approach { .. } | Law::Jankowski { .. }, _) => {
                [release, to(-v, Piece::In), NEVER]
            }
            (Law::Damped { .. }, Piece::Rising) => [release, to(w + NOISE[1], Piece::Push), NEVER],
            (Law::Damped { d, .. }, Piece::Cut) => {
                [release, to(-(1.0 + d * v / self.speed), Piece::Push), NEVER]
            }
            (Law::Damped { d, .. }, _) => [
                release,
                to(
                    if d > 0.0 {
                        1.0 + d * v / self.speed
                    } else {
                        1.0
                    },
                    Piece::Cut,
                ),
                to(
                    if self.from_rest && d > 0.0 {
                        self.speed - v + NOISE[1]
                    } else {
                        1.0
                    },
                    Piece::Rising,
                ),
            ],
            (Law::Bilinear { .. }, Piece::Stick(from, force)) => {
                let (slider, limit) = self.slider();
                let now = force + slider * (x - from);
                if slider > 0.0 {
                    [release, to(limit - now, Piece::Slip), to(now, Piece::Slack)]
                } else {
                    [release, NEVER, NEVER]
                }
            }
            (Law::Bilinear { .. }, Piece::Slip) => {
                [release, to(v, Piece::Stick(x, self.slider().1)), NEVER]
            }
            (Law::Bilinear { .. }, _) => [release, to(-v, Piece::Stick(x, 0.0)), NEVER],
        }
    }

    /// Goes over to another piece at indentation x and rate v.
    pub(super) fn become_piece(&mut self, piece: Piece, x: f64, v: f64) {
        if self.piece == Piece::Rising {
            self.speed = self.speed.max(v);
        }
        self.piece = match piece {
            Piece::Stick(_, force) => Piece::Stick(x, force),
            other => other,
        };
    }
}
