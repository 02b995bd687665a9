//! Forces of columns that stand on a foundation that rocks: what they carry into it, inertia of what rises and sinks included,
//! keeps it in equilibrium.

use jostle::{Base, Damping, Foundation, HalfSpace, LawKind, MemberRequest, Soil, SoilCoupling};

use crate::verification::support::{assembled, frame, framed, law, row, run, shaking, steps};

/// I θ̈ + c θ̇ + k θ = Σ N x + Σ M − Σ α m y (u̇ − u̇_f + y θ̇) + Σ α m x (ẇ − x θ̇).
///
/// N is positive in tension and acts x to the right of the middle. M are moments at the feet. Masses m at the height y have dashpots to
/// the foundation; those of beams also rise by w. I includes the masses of the feet.
#[test]
fn columns_keep_a_rocking_foundation_in_equilibrium() {
    for alpha in [0.0, 0.4] {
        let mut building = framed("A", frame(3, &[6.0, 3.0]));
        building.damping = Damping::Rayleigh { alpha, beta: 0.0 };
        building.base = Base {
            foundation: Some(Foundation {
                embedment: 1.5,
                ..Foundation::rectangle(14.0, 9.0, 90e3)
            }),
            ..Base::default()
        };
        let mut model = row(vec![building], 0.0, law(LawKind::Linear, 1.0));
        model.soil = Some(Soil {
            half_space: Some(HalfSpace {
                shear_wave_velocity: 180.0,
                density: 1900.0,
                poisson_ratio: 0.35,
                damping: 0.03,
            }),
            coupling: SoilCoupling::None,
        });
        model.analysis.members = MemberRequest::all();
        let system = assembled(&model);
        let motion = shaking(2.0);
        let state = run(&system, &motion, &steps(1e-3, 1)).state;
        let building = &system.buildings[0];
        let mut forces = vec![0.0; building.members.forms.len()];
        building.member_forces(&state, &[], 0.0, |form, value| forces[form] = value);
        let sticks = &building.discretization.stick_model;
        let foundation = sticks.foundation.as_ref().expect("one");
        let base = foundation.node;
        let middle = sticks.nodes[base].x;
        let turning = building.equations.rotation(base).expect("it rocks");
        let sway = building.equations.horizontal(base).expect("it sways");
        let (u, v, a) = (&state.displacement, &state.velocity, &state.acceleration);
        let springs = building.foundation.expect("it stands on one").springs;
        let of_soil = springs.rocking_stiffness * u[turning] + springs.rocking_damping * v[turning];
        let (mut inertia, mut dashpots) = (0.0, 0.0);
        for (index, node) in sticks.nodes.iter().enumerate() {
            let x = node.x - middle;
            if node.y == 0.0 {
                inertia += (node.inertia[2] + node.mass() * x * x) * a[turning];
            } else if let Some(dof) = building.equations.horizontal(index) {
                let rate = v[dof] - v[sway] + node.y * v[turning];
                dashpots += alpha * node.mass() * node.y * rate;
                if sticks.lever(index).is_none()
                    && let Some(dof) = building.equations.vertical(index)
                {
                    dashpots -= alpha * node.mass() * x * (v[dof] - x * v[turning]);
                }
            }
        }
        let (mut by_columns, mut scale, mut axial) = (0.0, 0.0_f64, 0.0_f64);
        for member in &building.members.members {
            let foot = member.sections[0];
            if !member.place.is_column() || foot.height > 0.0 {
                continue;
            }
            let line = sticks.nodes[sticks.members[elements(building, member.place)].ends[0]];
            let [n, _, m] = foot.forms.map(|form| forces[form]);
            by_columns += n * (line.x - middle) + m;
            scale = scale.max((n * (line.x - middle)).abs()).max(m.abs());
            axial = axial.max(n.abs());
        }
        let off = (inertia + of_soil - by_columns + dashpots) / scale;
        assert!(axial > 1e3 && off.abs() < 1e-9, "{alpha}: {off:e}");
    }
}

/// The lowest member of the stick model of a column.
fn elements(
    building: &jostle::system::BuildingSystem,
    place: jostle::structure::MemberPlace,
) -> usize {
    let mut members = building.discretization.members.iter();
    let found = members.find(|member| member.place == place);
    found.expect("a column").elements.start
}
