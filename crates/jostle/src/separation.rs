//! What codes of practice ask of a seismic joint, to stand beside the computed closing.

/// Width of the seismic joint between concrete frame structures, GB 50011-2010 (2016) §6.1.4 \[m\].
///
/// 100 mm up to a height of 15 m; above that 20 mm more for every further 5, 4, 3 or 2 m at intensity
/// 6, 7, 8 or 9, read as a straight line: 100 + 20 (H − 15)/(11 − I).
///
/// `height` of the lower building \[m\]; `intensity` 6 to 9, `None` outside.
#[must_use]
pub fn gb50011_frame_joint(height: f64, intensity: u32) -> Option<f64> {
    if !(6..=9).contains(&intensity) {
        return None;
    }
    let per_metre = 0.02 / f64::from(11 - intensity);
    Some(0.1 + per_metre * (height - 15.0).max(0.0))
}

/// Square root of the sum of squares of two peak displacements, the separation of ASCE 7-16 §12.12.3 and
/// EN 1998-1 §4.4.2.7 when the displacements are the design ones \[m\].
#[must_use]
pub fn srss(left: f64, right: f64) -> f64 {
    left.hypot(right)
}

/// Sum of two peak displacements, the widest of the usual rules \[m\].
#[must_use]
pub fn absolute_sum(left: f64, right: f64) -> f64 {
    left.abs() + right.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joint_of_a_16_m_frame_by_intensity() {
        let joint = |i| gb50011_frame_joint(16.0, i).map(|width| (width * 1e4).round() / 10.0);
        assert_eq!(
            [joint(6), joint(7), joint(8), joint(9)],
            [Some(104.0), Some(105.0), Some(106.7), Some(110.0)]
        );
        assert_eq!(joint(5), None);
        assert_eq!(gb50011_frame_joint(9.0, 8), Some(0.1));
    }
}
