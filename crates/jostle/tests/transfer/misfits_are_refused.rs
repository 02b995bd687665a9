//! What is no frame is called by its fault.

use jostle::structure::StepEquations;
use jostle::structure::{Idealisation, Member, Node, Skeleton, Spring, Support};
use jostle::system::BuildingSystem;
use jostle::transfer::{ElementwiseRiccati, NotAFrame, ProductEquations, ProductRefusal};

use crate::support::{COLUMN, Variant, frame, tower};

/// The refusal of a frame of two bays and two storeys after a change.
fn refusal(change: impl FnOnce(&mut Skeleton)) -> NotAFrame {
    refusal_of(
        &frame(Variant::FlexibleMembers, &[4.0, 6.0], 2, COLUMN),
        change,
    )
}

fn refusal_of(building: &BuildingSystem, change: impl FnOnce(&mut Skeleton)) -> NotAFrame {
    let mut idealisation: Idealisation = building.idealisation.clone();
    change(&mut idealisation.skeleton);
    let building = BuildingSystem::new("misfit", idealisation);
    let mut factor = <ProductEquations as StepEquations>::Factor::default();
    let stepped = ProductEquations::new(&building).factorize(
        &jostle::linear::StepMatrix::new(1.0, 1e4),
        &[],
        &mut factor,
    );
    assert!(stepped.is_err(), "what the check refuses cannot be stepped");
    match ProductEquations::check(&building, &jostle::linear::StepMatrix::new(1.0, 1e4)) {
        Err(ProductRefusal::NotAFrame(reason)) => reason,
        other => panic!("{other:?} instead of a refusal"),
    }
}

fn brace(from: usize, to: usize) -> Member {
    Member {
        ends: [from, to],
        flexural_rigidity: 1e7,
        axial_rigidity: Some(1e9),
        shear_rigidity: None,
        compression: 0.0,
    }
}

/// The joint at a place; the ends of beams behind hinges come after it.
fn joint(skeleton: &Skeleton, x: f64, y: f64) -> usize {
    let at = |node: &Node| (node.x - x).abs() < 1e-9 && (node.y - y).abs() < 1e-9;
    skeleton
        .nodes
        .iter()
        .position(at)
        .expect("the frame has a joint there")
}

#[test]
fn a_frame_without_base_is_refused() {
    let free = |skeleton: &mut Skeleton| {
        skeleton
            .nodes
            .iter_mut()
            .for_each(|node| node.support = Support::Free);
    };
    assert_eq!(refusal(free), NotAFrame::NoBase);
}

#[test]
fn stray_nodes_and_elements_are_refused() {
    let stray = refusal(|skeleton| {
        let node = skeleton.nodes[3];
        skeleton.nodes.push(node);
    });
    assert!(matches!(stray, NotAFrame::LooseNode { .. }), "{stray}");
    // A second beam beside the first.
    let twin = refusal(|skeleton| {
        let ends = [joint(skeleton, 0.0, 3.2), joint(skeleton, 4.0, 3.2)];
        skeleton.members.push(brace(ends[0], ends[1]));
    });
    assert!(matches!(twin, NotAFrame::LooseElement { .. }), "{twin}");
    assert!(twin.to_string().starts_with("member "), "{twin}");
    // A tie from the first to the last column line.
    let far = refusal(|skeleton| {
        let ends = [joint(skeleton, 0.0, 6.4), joint(skeleton, 10.0, 6.4)];
        skeleton.springs.push(Spring::elastic(ends, 1e6));
    });
    assert!(matches!(far, NotAFrame::LooseElement { .. }), "{far}");
}

#[test]
fn a_head_that_no_beam_meets_is_refused() {
    let building = frame(Variant::FlexibleMembers, &[4.0, 6.0], 2, COLUMN);
    let mast = |skeleton: &mut Skeleton| {
        let head = joint(skeleton, 10.0, 6.4);
        let mut tip = skeleton.nodes[head];
        tip.y += 2.0;
        skeleton.nodes.push(tip);
        let tip = skeleton.nodes.len() - 1;
        skeleton.members.push(brace(head, tip));
    };
    assert!(matches!(
        refusal_of(&building, mast),
        NotAFrame::HeadWithoutBeam { .. }
    ));
    // The recursion from the base has no need of it.
    let mut idealisation = building.idealisation.clone();
    mast(&mut idealisation.skeleton);
    let masted = BuildingSystem::new("masted", idealisation);
    let mut factor = <ElementwiseRiccati as StepEquations>::Factor::default();
    assert!(
        ElementwiseRiccati::new(&masted)
            .factorize(&jostle::linear::StepMatrix::new(1.0, 1e4), &[], &mut factor)
            .is_ok()
    );
}

#[test]
fn forks_slopes_and_guides_are_refused() {
    let fork = refusal(|skeleton| {
        let mut node = skeleton.nodes[0];
        node.y += 1.0;
        node.support = Support::Free;
        skeleton.nodes.push(node);
        let tip = skeleton.nodes.len() - 1;
        skeleton.members.push(brace(0, tip));
    });
    assert_eq!(fork, NotAFrame::Branches { node: 0 });
    let slope = refusal(|skeleton| {
        let sunk = skeleton.members.iter().rposition(|member| {
            let [a, b] = member.ends.map(|end| skeleton.nodes[end]);
            a.y == b.y
        });
        let node = skeleton.members[sunk.expect("the frame has beams")].ends[0];
        skeleton.nodes[node].y -= 0.3;
    });
    assert!(matches!(slope, NotAFrame::NotLevel { .. }), "{slope}");
    let guided = refusal(|skeleton| {
        skeleton.nodes[5].support = Support::Guided;
    });
    assert_eq!(guided, NotAFrame::Guided { node: 5 });
    let loose_floor = refusal_of(&tower(3), |skeleton| {
        skeleton.nodes[2].support = Support::Free;
    });
    assert_eq!(loose_floor, NotAFrame::LooseNode { node: 2 });
}
