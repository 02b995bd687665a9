//! What is no frame is called by its fault.

use jostle::structure::StepEquations;
use jostle::structure::{Discretization, Member, Node, Spring, StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::transfer::{ElementwiseRiccati, NotAFrame, ProductEquations, ProductRefusal};

use crate::transfer::support::{COLUMN, Variant, frame, tower};

/// The refusal of a frame of two bays and two storeys after a change.
fn refusal(change: impl FnOnce(&mut StickModel)) -> NotAFrame {
    refusal_of(
        &frame(Variant::FlexibleMembers, &[4.0, 6.0], 2, COLUMN),
        change,
    )
}

fn refusal_of(building: &BuildingSystem, change: impl FnOnce(&mut StickModel)) -> NotAFrame {
    let mut discretization: Discretization = building.discretization.clone();
    change(&mut discretization.stick_model);
    let building = BuildingSystem::new("misfit", discretization);
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
fn joint(stick_model: &StickModel, x: f64, y: f64) -> usize {
    let at = |node: &Node| (node.x - x).abs() < 1e-9 && (node.y - y).abs() < 1e-9;
    stick_model
        .nodes
        .iter()
        .position(at)
        .expect("the frame has a joint there")
}

#[test]
fn a_frame_without_base_is_refused() {
    let free = |stick_model: &mut StickModel| {
        stick_model
            .nodes
            .iter_mut()
            .for_each(|node| node.support = Support::Free);
    };
    assert_eq!(refusal(free), NotAFrame::NoBase);
}

#[test]
fn stray_nodes_and_elements_are_refused() {
    let stray = refusal(|stick_model| {
        let node = stick_model.nodes[3];
        stick_model.nodes.push(node);
    });
    assert!(matches!(stray, NotAFrame::LooseNode { .. }), "{stray}");
    // A second beam beside the first.
    let twin = refusal(|stick_model| {
        let ends = [joint(stick_model, 0.0, 3.2), joint(stick_model, 4.0, 3.2)];
        stick_model.members.push(brace(ends[0], ends[1]));
    });
    assert!(matches!(twin, NotAFrame::LooseElement { .. }), "{twin}");
    assert!(twin.to_string().starts_with("member "), "{twin}");
    // A tie from the first to the last column line.
    let far = refusal(|stick_model| {
        let ends = [joint(stick_model, 0.0, 6.4), joint(stick_model, 10.0, 6.4)];
        stick_model.springs.push(Spring::elastic(ends, 1e6));
    });
    assert!(matches!(far, NotAFrame::LooseElement { .. }), "{far}");
}

#[test]
fn a_head_that_no_beam_meets_is_refused() {
    let building = frame(Variant::FlexibleMembers, &[4.0, 6.0], 2, COLUMN);
    let mast = |stick_model: &mut StickModel| {
        let head = joint(stick_model, 10.0, 6.4);
        let mut tip = stick_model.nodes[head];
        tip.y += 2.0;
        stick_model.nodes.push(tip);
        let tip = stick_model.nodes.len() - 1;
        stick_model.members.push(brace(head, tip));
    };
    assert!(matches!(
        refusal_of(&building, mast),
        NotAFrame::HeadWithoutBeam { .. }
    ));
    // The recursion from the base has no need of it.
    let mut discretization = building.discretization.clone();
    mast(&mut discretization.stick_model);
    let masted = BuildingSystem::new("masted", discretization);
    let mut factor = <ElementwiseRiccati as StepEquations>::Factor::default();
    assert!(
        ElementwiseRiccati::new(&masted)
            .factorize(&jostle::linear::StepMatrix::new(1.0, 1e4), &[], &mut factor)
            .is_ok()
    );
}

#[test]
fn forks_slopes_and_guides_are_refused() {
    let fork = refusal(|stick_model| {
        let mut node = stick_model.nodes[0];
        node.y += 1.0;
        node.support = Support::Free;
        stick_model.nodes.push(node);
        let tip = stick_model.nodes.len() - 1;
        stick_model.members.push(brace(0, tip));
    });
    assert_eq!(fork, NotAFrame::Branches { node: 0 });
    let slope = refusal(|stick_model| {
        let sunk = stick_model.members.iter().rposition(|member| {
            let [a, b] = member.ends.map(|end| stick_model.nodes[end]);
            a.y == b.y
        });
        let node = stick_model.members[sunk.expect("the frame has beams")].ends[0];
        stick_model.nodes[node].y -= 0.3;
    });
    assert!(matches!(slope, NotAFrame::NotLevel { .. }), "{slope}");
    let guided = refusal(|stick_model| {
        stick_model.nodes[5].support = Support::Guided;
    });
    assert_eq!(guided, NotAFrame::Guided { node: 5 });
    let loose_floor = refusal_of(&tower(3), |stick_model| {
        stick_model.nodes[2].support = Support::Free;
    });
    assert_eq!(loose_floor, NotAFrame::LooseNode { node: 2 });
}
