//! A turned face that hits: points of a face against a line of springs, integrated by other code (docs/face-points.md).

#[path = "../../../examples/face_points.rs"]
#[allow(dead_code, reason = "the example also draws figures")]
mod example;

use example::{PERCUSSION, spin_of_line, spin_of_points};

/// Five points keep the spin of a line of springs within 1 % where the face is closed for most of the impact, and within 5 %
/// where it is not; three points the former only. Two end points lose nearly all of it, if each is the centre of percussion of
/// the other: in the limit of a small turn both rebound with their own speed.
#[test]
fn five_points_keep_the_spin_of_a_turned_face_and_two_do_not() {
    for turn in [0.0005, 0.001] {
        let line = spin_of_line(PERCUSSION, turn);
        assert!(line.abs() > 1e-3);
        let ratio = |points: usize| spin_of_points(PERCUSSION, turn, points) / line;
        assert!((ratio(5) - 1.0).abs() < 0.01, "{turn}: {}", ratio(5));
        assert!((ratio(3) - 1.0).abs() < 0.02, "{turn}: {}", ratio(3));
        assert!(ratio(2).abs() < 0.03, "{turn}: {}", ratio(2));
    }
    // Nine points are close to the line even where half of the face stays open.
    let ratio = spin_of_points(PERCUSSION, 0.006, 9) / spin_of_line(PERCUSSION, 0.006);
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
}
