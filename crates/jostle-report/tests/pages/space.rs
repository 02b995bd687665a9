//! The page of buildings in space, and the drawing of their site.

use jostle::System;
use jostle::model::Structure;
use jostle_report::{SitePlace, render, site_svg};

use crate::fixture::{in_space, two_frames};

#[test]
fn the_site_has_corners_gaps_directions_and_a_scale() {
    let run = in_space();
    let system = System::assemble(&run.model).unwrap();
    let drawing = site_svg(&run.model, &system, Some(&run.motion), None).unwrap();
    assert!(drawing.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
    for part in [
        "Two in space",
        "West, 4 floors",
        "East, 3 floors",
        "1: 20.0 mm",
        "shaking at 34.38° from x: two tones",
        ">x</text>",
        ">y</text>",
        " m</text>",
    ] {
        assert!(drawing.contains(part), "{part} is absent");
    }
    // Six and four corners.
    assert_eq!(drawing.matches("corner-number\"").count(), 10);
    // Programs that show drawings know no variables.
    assert!(!drawing.contains("var(--"), "{drawing}");
    assert_eq!(drawing.matches("<polygon class=\"plan\"").count(), 2);
    let document = drawing.replace("xmlns=\"http://www.w3.org/2000/svg\" ", "");
    assert!(!document.contains("http"));
    let plane = two_frames(0.1);
    let system = System::assemble(&plane.model).unwrap();
    assert_eq!(site_svg(&plane.model, &system, None, None), None);
}

/// The face lies between corners 2 and 3 of the L and 4 and 1 of the box, from y = 2 m to 8 m.
#[test]
fn places_are_what_the_geometry_found() {
    let run = in_space();
    let system = System::assemble(&run.model).unwrap();
    let places = SitePlace::of_system(&run.model, &system);
    assert_eq!(places.len(), 1, "{places:?}");
    let place = &places[0];
    assert_eq!(place.between, [0, 1]);
    assert_eq!(place.floors, [1, 2, 3].map(|floor| [Some(floor); 2]));
    assert_eq!(place.floors_in_words(), "1 to 3");
    assert_eq!(place.parts_in_words(&run.model), ["edge 2–3", "edge 4–1"]);
    assert_eq!(place.normal, [1.0, 0.0]);
    assert!((place.overlap - 6.0).abs() < 1e-12);
    assert!((place.middle[0] - 16.01).abs() < 1e-12 && (place.middle[1] - 5.0).abs() < 1e-12);
    assert!((place.gap[0] - 0.02).abs() < 1e-12 && (place.gap[1] - 0.02).abs() < 1e-12);
}

/// Forces of the points add up to the force of the face, act at its centre of pressure, and lie on the face.
#[test]
fn forces_of_points_add_up_to_that_of_their_face() {
    let run = in_space();
    let contacts = run.summary.gaps.iter().flat_map(|gap| &gap.contacts);
    let mut struck = 0;
    for contact in contacts.filter(|contact| contact.peak_force_n > 0.0) {
        let plan = contact.in_plan.unwrap();
        let total: f64 = plan.points.iter().map(|point| point.force).sum();
        assert!((total / contact.peak_force_n - 1.0).abs() < 1e-9);
        let moment: f64 = plan.points.iter().map(|p| p.force * p.place[1]).sum();
        let centre = plan.points.centre.unwrap();
        assert!((moment / total - centre[1]).abs() < 1e-9);
        assert!(
            plan.points
                .iter()
                .all(|p| (2.0..=8.0).contains(&p.place[1]))
        );
        let shares: f64 = plan.points.iter().map(|point| point.share).sum();
        assert!((shares - 1.0).abs() < 1e-12);
        assert_eq!(plan.points.at, contact.peak_force_at_s);
        struck += 1;
    }
    assert!(struck > 0, "there is contact");
}

#[test]
fn the_report_shows_faces_paths_and_the_scene() {
    let run = in_space();
    let page = render(&run.page());
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    for part in [
        "Seen from above",
        "How they move in space",
        "id=\"space\"",
        "id=\"orbits\"",
        "class SpaceScene",
        "Force along the faces at their largest impacts",
        "centre of pressure",
        "Roof rotation",
        "West without contact",
        "edge 2–3",
    ] {
        assert!(page.contains(part), "{part} is absent");
    }
    assert!(page.contains("\"plans\""));
    let plane = render(&two_frames(0.1).page());
    for part in [
        "class SpaceScene",
        "id=\"orbits\"",
        ".site .plan",
        "\"plans\"",
    ] {
        assert!(
            !plane.contains(part),
            "{part} has no place in a report of frames"
        );
    }
}

/// North at 90° is y: a shaking at 34.38° from x comes from 55.62° clockwise of it.
#[test]
fn north_is_drawn_and_directions_have_bearings() {
    let run = in_space();
    let system = System::assemble(&run.model).unwrap();
    let north = std::f64::consts::FRAC_PI_2;
    let drawing = site_svg(&run.model, &system, Some(&run.motion), Some(north)).unwrap();
    for part in [
        "class=\"north\"",
        ">N</text>",
        "shaking at 34.38° from x, bearing 55.62°: two tones",
    ] {
        assert!(drawing.contains(part), "{part} is absent");
    }
    let without = site_svg(&run.model, &system, Some(&run.motion), None).unwrap();
    assert!(!without.contains("north\"") && !without.contains("bearing"));
}

/// The elevation draws every storey as wide as its floor.
#[test]
fn floors_that_are_set_back_are_drawn_narrower() {
    let mut run = in_space();
    assert!(!render(&run.page()).contains("\"standing\":"));
    let Structure::Tiers(tiers) = &mut run.model.buildings[1].structure else {
        panic!("in plan");
    };
    let [from, to] = tiers.extent_along();
    let middle = 0.5 * (from + to);
    // The upper floor ends at the middle.
    let top = tiers.floors.last_mut().expect("floors");
    for corner in &mut top.plan {
        corner[0] = corner[0].min(middle);
    }
    let all = tiers.floors.len();
    let whole: Vec<String> = (1..=all).map(|storey| storey.to_string()).collect();
    let low = whole[..all - 1].join(",");
    let said = format!("\"standing\":[[{}],[{all}],[{low}]]", whole.join(","));
    let page = render(&run.page());
    assert!(page.contains(&said), "{said}");
}
