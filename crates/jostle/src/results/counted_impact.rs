//! Counting of impacts: successive short impacts, and simultaneous impacts at several contacts (docs/contact.md,
//! "What counts as an impact").

use crate::history::Impact;
use crate::linear::sort_by;

/// A counted impact: one closed episode, or several in close succession.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountedImpact {
    /// Start of the first and end of the last episode, peak force and indentation of all, sums of impulses and
    /// dissipated energies, impact speed of the first and separation speed of the last.
    pub impact: Impact,
    /// Number of merged closed episodes.
    pub touches: usize,
    /// Greatest number of contacts of the same gap in impact at one instant of this one, itself included.
    pub simultaneous: usize,
}

/// Counts the impacts of one contact, given in order of time. Episodes less than `minimum_separation` apart, from
/// the end of the force to the next first contact, count as one impact \[s\].
#[must_use]
pub fn counted<'a>(
    impacts: impl IntoIterator<Item = &'a Impact>,
    minimum_separation: f64,
) -> Vec<CountedImpact> {
    let mut counted: Vec<CountedImpact> = Vec::new();
    for impact in impacts {
        match counted.last_mut() {
            Some(last) if impact.start - last.impact.end < minimum_separation => {
                join(&mut last.impact, impact);
                last.touches += 1;
            }
            _ => counted.push(CountedImpact {
                impact: *impact,
                touches: 1,
                simultaneous: 1,
            }),
        }
    }
    counted
}

fn join(first: &mut Impact, next: &Impact) {
    if next.peak_force > first.peak_force {
        (first.peak_force, first.peak_force_at) = (next.peak_force, next.peak_force_at);
    }
    first.peak_indentation = first.peak_indentation.max(next.peak_indentation);
    first.end = next.end;
    first.separation_speed = next.separation_speed;
    first.finished = next.finished;
    first.impulse += next.impulse;
    first.dissipated += next.dissipated;
    first.sliding = first.sliding.and(&next.sliding);
}

/// Poundings of a gap: intervals in which at least one of its contacts is in impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Poundings {
    /// All of them.
    pub count: usize,
    /// Those in which two or more contacts were in impact at the same instant.
    pub multiple: usize,
    /// Most contacts in impact at one instant.
    pub most_at_once: usize,
}

/// Finds simultaneous impacts at several contacts of one gap, and sets their number in every impact. Impacts that
/// end at the instant at which another begins share that instant.
pub fn find_simultaneous(contacts: &mut [Vec<CountedImpact>]) -> Poundings {
    // (instant, 0 starts or 1 ends, contact, impact): starts come before ends.
    let mut edges: Vec<(f64, u8, usize, usize)> = Vec::new();
    for (contact, impacts) in contacts.iter().enumerate() {
        for (index, counted) in impacts.iter().enumerate() {
            edges.push((counted.impact.start, 0, contact, index));
            edges.push((counted.impact.end, 1, contact, index));
        }
    }
    sort_by(&mut edges, |a, b| {
        a.0.total_cmp(&b.0)
            .then((a.1, a.2, a.3).cmp(&(b.1, b.2, b.3)))
    });
    let mut poundings = Poundings::default();
    let mut under_way: Vec<(usize, usize)> = Vec::new();
    let mut most = 0;
    for (_, edge, contact, index) in edges {
        if edge == 0 {
            under_way.push((contact, index));
            most = most.max(under_way.len());
            let now = under_way.len();
            for &(contact, index) in &under_way {
                let simultaneous = &mut contacts[contact][index].simultaneous;
                *simultaneous = now.max(*simultaneous);
            }
            continue;
        }
        under_way.retain(|&impact| impact != (contact, index));
        if under_way.is_empty() {
            poundings.count += 1;
            poundings.multiple += usize::from(most > 1);
            poundings.most_at_once = poundings.most_at_once.max(most);
            most = 0;
        }
    }
    poundings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::Sliding;

    fn impact(contact: usize, start: f64, end: f64) -> Impact {
        Impact {
            contact,
            start,
            end,
            peak_force: 1e5 * end,
            peak_force_at: 0.5 * (start + end),
            peak_indentation: 1e-3,
            impact_speed: 0.5,
            separation_speed: 0.3 * end,
            finished: true,
            impulse: 10.0,
            dissipated: 2.0,
            sliding: Sliding::default(),
        }
    }

    #[test]
    fn friction_of_joined_impacts_is_joined() {
        let rubbing = |start: f64, force: f64| Impact {
            sliding: Sliding {
                slip_speed: start,
                peak_force: force,
                peak_force_at: start + 0.05,
                slip_peak: 1e-3 * force,
                impulse: -2.0 * force,
                friction: 3.0 * force,
                slid_off: false,
            },
            ..impact(0, start, start + 0.1)
        };
        let found = counted(&[rubbing(1.0, 4.0), rubbing(1.2, 5.0)], 0.5);
        assert_eq!(found.len(), 1);
        let expected = Sliding {
            slip_speed: 1.0,
            peak_force: 5.0,
            peak_force_at: 1.25,
            slip_peak: 5e-3,
            impulse: -18.0,
            friction: 27.0,
            slid_off: false,
        };
        assert_eq!(found[0].impact.sliding, expected);
    }

    #[test]
    fn bounces_closer_than_asked_are_one_impact() {
        let all = [
            impact(0, 1.0, 1.1),
            impact(0, 1.15, 1.2),
            impact(0, 1.3, 1.4),
        ];
        assert_eq!(counted(&all, 0.0).len(), 3, "all stand alone by default");
        let joined = counted(&all, 0.08);
        let [first, last] = joined[..] else {
            panic!("{joined:?}");
        };
        assert_eq!((first.touches, last.touches), (2, 1));
        assert_eq!((first.impact.start, first.impact.end), (1.0, 1.2));
        assert_eq!((first.impact.impulse, first.impact.dissipated), (20.0, 4.0));
        assert_eq!(first.impact.peak_force, 1.2e5);
        assert_eq!(first.impact.separation_speed, 0.3 * 1.2);
    }

    #[test]
    fn impacts_at_once_are_recognised() {
        let mut contacts = vec![
            counted(&[impact(0, 1.0, 1.1), impact(0, 2.0, 2.1)], 0.0),
            counted(&[impact(1, 1.05, 1.2), impact(1, 3.0, 3.0)], 0.0),
            counted(&[impact(2, 1.15, 1.3), impact(2, 3.0, 3.0)], 0.0),
        ];
        let poundings = find_simultaneous(&mut contacts);
        // 1.0…1.3 in a chain of two at a time, 2.0…2.1 alone, two impacts at 3.0.
        assert_eq!(
            poundings,
            Poundings {
                count: 3,
                multiple: 2,
                most_at_once: 2
            }
        );
        let at_once: Vec<Vec<usize>> = contacts
            .iter()
            .map(|c| c.iter().map(|i| i.simultaneous).collect())
            .collect();
        assert_eq!(at_once, [[2, 1], [2, 2], [2, 2]]);
    }
}
