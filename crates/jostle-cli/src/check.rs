//! `jostle check`: is the model valid, and what does it amount to?

use std::fmt::Write;

use jostle::modal::Mode;
use jostle::model::Structure;
use jostle::stepping::StepEquations;
use jostle::system::BuildingSystem;
use jostle::{Model, Plan, RiccatiSweep, System};

use crate::args::ModelArgs;
use crate::failure::Failure;
use crate::numbers::{counted, grouped, mm};
use crate::open::open;
use crate::terminal::{self, BOLD, LOUD, styled};

pub(crate) fn check(args: &ModelArgs) -> Result<(), Failure> {
    let opened = open(args.model.as_deref(), &args.overrides()?)?;
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = describe(&mut text, &opened.input.model, &opened.system);
    for warning in &opened.input.warnings {
        let _ = writeln!(text, "{} {warning}", styled(LOUD, "note:"));
    }
    if opened.input.motion.is_some() {
        let (motion, plan) = opened.plan()?;
        let _ = writeln!(text, "{}", styled(BOLD, "Expected work"));
        let _ = describe_work(&mut text, &opened.system, &plan, motion.duration);
    } else {
        let _ = writeln!(
            text,
            "{} the model has no ground motion; give one with --record to run it",
            styled(LOUD, "note:")
        );
    }
    text.push_str("The model is valid.");
    terminal::print(&text)
}

fn describe(text: &mut String, model: &Model, system: &System) -> std::fmt::Result {
    writeln!(text, "{}\n", styled(BOLD, &model.title))?;
    for (index, building) in system.buildings.iter().enumerate() {
        let kind = match &model.buildings[index].structure {
            Structure::Frame(frame) => format!(
                "frame, {}, {}",
                counted(frame.storey_heights.len(), "storey"),
                counted(frame.spans.len(), "span")
            ),
            Structure::Shear(shear) => {
                format!("shear building, {}", counted(shear.mass.len(), "storey"))
            }
        };
        describe_building(text, building, &kind)?;
    }
    for (index, gap) in model.gaps.iter().enumerate() {
        let contacts: Vec<_> = system
            .contacts
            .iter()
            .filter(|contact| contact.gap == index)
            .collect();
        let heights: Vec<String> = contacts
            .iter()
            .map(|contact| format!("{:.2}", contact.height))
            .collect();
        let names =
            [gap.left, gap.left + 1].map(|building| system.buildings[building].name.as_str());
        writeln!(
            text,
            "{}",
            styled(BOLD, &format!("{} ↔ {}", names[0], names[1]))
        )?;
        writeln!(
            text,
            "  gap {} mm, {} at {} m",
            mm(gap.width),
            counted(contacts.len(), "contact"),
            heights.join(", ")
        )?;
        let unit = if gap.law.kind.is_hertzian() {
            "N/m^1.5"
        } else {
            "N/m"
        };
        writeln!(
            text,
            "  {} with {:.3e} {unit}; free masses rebound with {:.3}",
            gap.law.kind.name(),
            gap.law.stiffness,
            gap.law.free_restitution()
        )?;
        if let Some(contact) = contacts.last() {
            writeln!(
                text,
                "  colliding masses at the top {:.1} t and {:.1} t; an elastic impact at 0.5 m/s lasts {:.1} ms\n",
                contact.masses[0] * 1e-3,
                contact.masses[1] * 1e-3,
                contact.law.elastic_duration(contact.effective_mass(), 0.5) * 1e3
            )?;
        }
    }
    Ok(())
}

fn describe_building(text: &mut String, building: &BuildingSystem, kind: &str) -> std::fmt::Result {
    let equations = &building.equations;
    let skeleton = &building.idealisation.skeleton;
    let lumps = skeleton.nodes.iter().filter(|node| node.mass > 0.0).count();
    writeln!(text, "{}  {kind}", styled(BOLD, &building.name))?;
    writeln!(
        text,
        "  mass {:.3} t in {}, {} degrees of freedom",
        equations.total_mass() * 1e-3,
        counted(lumps, "lumped mass").replace("masss", "masses"),
        equations.len()
    )?;
    let periods: Vec<String> = building
        .lateral_modes()
        .take(5)
        .map(|mode: &Mode| format!("{:.4}", mode.period()))
        .collect();
    writeln!(text, "  lateral periods {} s", periods.join(", "))?;
    writeln!(
        text,
        "  Rayleigh damping α = {:.5} 1/s, β = {:.6} s\n",
        equations.alpha, equations.beta
    )
}

fn describe_work(
    text: &mut String,
    system: &System,
    plan: &Plan,
    duration: f64,
) -> std::fmt::Result {
    let steps = (duration / plan.step).ceil() as u64;
    let couplings: usize = system
        .buildings
        .iter()
        .map(|building| RiccatiSweep::of(building).couplings())
        .sum();
    writeln!(
        text,
        "  {} steps of {:.4} ms through {duration:.2} s, more while buildings touch",
        grouped(steps),
        plan.step * 1e3
    )?;
    writeln!(
        text,
        "  {} couplings in the factors: {} multiply-adds per solution\n",
        grouped(couplings as u64),
        grouped(2 * couplings as u64)
    )
}
