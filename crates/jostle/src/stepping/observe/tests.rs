//! A quantity that is followed needs one entry.

use super::*;
use crate::history::Extreme;
use crate::linear::Row;
use crate::model::{Building, Damping, Model, Shear, Structure};
use watch::Statistic;

/// Two towers of one storey, without a gap.
fn pair() -> System {
    let tower = |name: &str| Building {
        name: name.into(),
        structure: Structure::Shear(Shear {
            mass: vec![1e4],
            stiffness: vec![1e7],
            storey_heights: vec![3.0],
        }),
        damping: Damping::Rayleigh {
            alpha: 0.0,
            beta: 0.0,
        },
        ..Building::default()
    };
    let model = Model {
        title: "pair".into(),
        buildings: vec![tower("left"), tower("right")],
        ..Model::default()
    };
    System::assemble(&model).expect("a sound model")
}

/// Both floors swing at 2 rad/s, the right one a quarter of a cycle later: their distance changes by √2 sin(2t + π/4), and the area
/// that they cover as if at right angles stays a circle. Peaks lie between the ends of steps.
#[test]
fn a_watch_more_is_followed_like_the_others() {
    let system = pair();
    let column = |kind| Column::along(Owner::Run, kind);
    let apart = Row::new(&[(0, 1.0), (1, -1.0)]);
    let more = [
        (Kind::Stroke, Statistic::Extremes(apart.clone())),
        (Kind::Drift, Statistic::Size(apart)),
        (
            Kind::CornerDisplacement,
            Statistic::Length([0, 1].map(Row::single)),
        ),
    ];
    let more = more.map(|(kind, statistic)| Watch::new(column(kind), statistic));
    let all = watches(&system, false).into_iter().chain(more);
    let (grounds, step) = (RunGrounds::default(), 0.03);
    let mut observer = Observer::watching(&system, 3.0, all.collect());
    let mut state = State::at_rest(&system, 0.0);
    for end in 0..100 {
        if end > 0 {
            observer.before_step(&system, &state, &grounds);
        }
        state.time = step * f64::from(end);
        let (sin, cos) = (2.0 * state.time).sin_cos();
        state.displacement = vec![sin, -cos];
        state.velocity = vec![2.0 * cos, 2.0 * sin];
        let reached = Reached {
            state: &state,
            links: &[],
            grounds: &grounds,
            ground: GroundsAt::common([0.0; 3]),
        };
        if end > 0 {
            observer.after_step(&system, &reached, step);
        }
    }
    let peaks = observer.finish();
    let of = |kind| peaks.of(column(kind));
    let close = |extreme: Extreme, value: f64, at: f64| {
        assert!((extreme.value - value).abs() < 1e-6, "{extreme:?}");
        assert!((extreme.at - at).abs() < 1e-3, "{extreme:?}");
    };
    let (most, turn) = (std::f64::consts::SQRT_2, std::f64::consts::PI / 8.0);
    close(of(Kind::Stroke).greatest, most, turn);
    close(of(Kind::Stroke).least, -most, 5.0 * turn);
    assert!((of(Kind::Drift).size() - most).abs() < 1e-6);
    assert!((of(Kind::CornerDisplacement).size() - 1.0).abs() < 1e-6);
    // What runs follow by themselves is there as well.
    assert!((peaks.floor(0, 1).displacement().size() - 1.0).abs() < 1e-6);
    assert!((peaks.floor(1, 1).storey_drift() - 1.0 / 3.0).abs() < 1e-3);
}
