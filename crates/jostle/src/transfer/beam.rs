//! Massless beam segments (theory, Eqs. T3 and T4), with shear, axial force and P-Delta.

use super::Transfer;

/// Direction in which a member is traversed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heading {
    /// A column from its foot.
    Up,
    /// A column from its head.
    Down,
    /// A beam from its left end.
    Right,
    /// A beam from its right end.
    Left,
}

/// Straight massless member between two lumped masses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamSegment {
    /// l > 0 \[m\].
    pub length: f64,
    /// EI > 0 \[N·m²\].
    pub flexural_rigidity: f64,
    /// EA \[N\]; `None` is axially rigid.
    pub axial_rigidity: Option<f64>,
    /// GA_s \[N\]; `None` neglects shear deformation.
    pub shear_rigidity: Option<f64>,
    /// P, known axial compression; zero for first-order theory \[N\].
    pub compression: f64,
}

impl BeamSegment {
    /// Bending only: axially rigid, rigid in shear, without compression.
    #[must_use]
    pub fn bending(length: f64, flexural_rigidity: f64) -> Self {
        Self {
            length,
            flexural_rigidity,
            axial_rigidity: None,
            shear_rigidity: None,
            compression: 0.0,
        }
    }

    /// The segment with every elastic stiffness multiplied by κ (theory, Eq. D2): as required by κ K of the step
    /// equations. The compression is not multiplied, because damping does not act on P-Delta.
    #[must_use]
    pub fn stiffened(&self, factor: f64) -> Self {
        Self {
            length: self.length,
            flexural_rigidity: factor * self.flexural_rigidity,
            axial_rigidity: self.axial_rigidity.map(|ea| factor * ea),
            shear_rigidity: self.shear_rigidity.map(|ga| factor * ga),
            compression: self.compression,
        }
    }

    /// Transfer from the input to the output end.
    ///
    /// ```text
    /// δ   = [∓σ l θ_I ± σ l²/(2EI) m_I + (l³/(6EI) − l/GA_s) q_I] / (1 + P l²/(6EI) − P/GA_s)
    /// q_e = q_I − P δ/l
    /// w_O = w_I + δ,   θ_O = θ_I − l/(EI) m_I ∓ σ l²/(2EI) q_e,   m_O = m_I ± σ l q_e,   q_O = q_I   (T3, T4)
    /// v_O = v_I − l/(EA) p_I,   p_O = p_I
    /// ```
    /// The upper signs are those of columns (w = x, q = qx, v = y, p = qy), the lower ones those of beams (w = y, q
    /// = qy, v = x, p = qx); σ = +1 upwards and to the right, −1 downwards and to the left. The compression P acts
    /// on the chord (Eq. K1); without it q_e = q_I.
    ///
    /// A Timoshenko cantilever deflects by F l³/(3EI) + F l/(GA_s), a rod shortens by N l/(EA):
    ///
    /// ```
    /// use jostle::transfer::{BeamSegment, Heading, StateVector};
    /// let (l, ei, ea, ga, f, n) = (2.0_f64, 1e7, 4e9, 2e8, 1e4, 5e5);
    /// let beam = BeamSegment { axial_rigidity: Some(ea), shear_rigidity: Some(ga), ..BeamSegment::bending(l, ei) };
    /// // The wall on the left holds up the tip load −F and presses with N.
    /// let tip = beam.transfer(Heading::Right).apply(StateVector::at_base([f * l, n, f]));
    /// assert!(tip.m.abs() < 1e-9);
    /// assert!((tip.y + f * l.powi(3) / (3.0 * ei) + f * l / ga).abs() < 1e-15);
    /// assert!((tip.x + n * l / ea).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn transfer(&self, heading: Heading) -> Transfer {
        let (l, ei, p) = (self.length, self.flexural_rigidity, self.compression);
        // Rows and columns of the displacement across and along the axis and of their forces.
        let (across, along, shear, axial, turn) = match heading {
            Heading::Up => (0, 1, 4, 5, 1.0),
            Heading::Down => (0, 1, 4, 5, -1.0),
            Heading::Right => (1, 0, 5, 4, -1.0),
            Heading::Left => (1, 0, 5, 4, 1.0),
        };
        let (theta, m) = (2, 3);
        let (bending, coupling) = (l / ei, turn * l * l / (2.0 * ei));
        let slip = self.shear_rigidity.map_or(0.0, |ga| 1.0 / ga);
        let softening = 1.0 + p * (l * l / (6.0 * ei) - slip);
        // δ and q_e as rows over the input state.
        let (mut chord, mut effective) = ([0.0; 6], [0.0; 6]);
        chord[theta] = -turn * l / softening;
        chord[m] = coupling / softening;
        chord[shear] = (l * l * l / (6.0 * ei) - l * slip) / softening;
        for k in 0..6 {
            effective[k] = -p / l * chord[k];
        }
        effective[shear] += 1.0;
        let mut transfer = Transfer::identity();
        let u = &mut transfer.matrix;
        for k in 0..6 {
            u[across][k] += chord[k];
            u[theta][k] -= coupling * effective[k];
            u[m][k] += turn * l * effective[k];
        }
        u[theta][m] -= bending;
        if let Some(ea) = self.axial_rigidity {
            u[along][axial] -= l / ea;
        }
        transfer
    }

    /// Transfer of a member with stiffness-proportional damping: every stiffness multiplied by κ, and the ends
    /// displaced by s D (theory, Eqs. D2 and T3), `shift` holding s D of x, y, θ at the input and the output end.
    ///
    /// ```text
    /// e = U (s D_I, 0) − (s D_O, 0)
    /// ```
    /// Rigid directions have no such load. P must be zero: it is not damped.
    ///
    /// ```
    /// use jostle::transfer::{BeamSegment, Heading, StateVector};
    /// // Ends that shift like a rigid body cause no force: the state passes unchanged.
    /// let column = BeamSegment::bending(3.0, 1e7);
    /// let turned = 0.01; // about the foot, so that the head moves to the left
    /// let passed = column
    ///     .damped(Heading::Up, 1.3, [[0.0, 0.0, turned], [-3.0 * turned, 0.0, turned]])
    ///     .apply(StateVector::default());
    /// assert!(passed.to_array().iter().all(|value| value.abs() < 1e-15));
    /// ```
    #[must_use]
    pub fn damped(&self, heading: Heading, kappa: f64, shift: [[f64; 3]; 2]) -> Transfer {
        let mut transfer = self.stiffened(kappa).transfer(heading);
        for row in 0..6 {
            let moved: f64 = (0..3).map(|k| transfer.matrix[row][k] * shift[0][k]).sum();
            transfer.load[row] = moved - shift[1].get(row).copied().unwrap_or(0.0);
        }
        if self.axial_rigidity.is_none() {
            let along = match heading {
                Heading::Up | Heading::Down => 1,
                Heading::Right | Heading::Left => 0,
            };
            transfer.load[along] = 0.0;
        }
        transfer
    }
}
