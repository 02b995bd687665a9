//! The page of capacity curves.

use jostle_report::render_pushover;
use jostle_testkit::browser::open_page;

use crate::pushover::{frame, pushed};

#[test]
fn hinges_change_colour_along_the_push() {
    let building = frame("J1");
    let pushed = pushed(&building);
    let text = render_pushover("two storeys", std::slice::from_ref(&pushed), None, &[]);
    let Some(page) = open_page(&text, 1100, 900) else {
        return;
    };
    let count = |share: f64, which: usize| -> Vec<u64> {
        let script = format!(
            r#"(() => {{
                const set = (role, value, event) => {{
                    const element = document.querySelector(`[data-role="${{role}}"]`);
                    element.value = value;
                    element.dispatchEvent(new Event(event));
                }};
                set("which", {which}, "change");
                set("slider", {share}, "input");
                const all = (name) => document.querySelectorAll(`.deformed .hinge${{name}}`).length;
                return [all(""), all(".cracked"), all(".yielded")].join(" ");
            }})()"#
        );
        page.text(&script)
            .split(' ')
            .map(|number| number.parse().unwrap())
            .collect()
    };
    let springs = building.equations.springs.len();
    for (which, curve) in pushed.curves.iter().enumerate() {
        let [cracked, yielded] = curve.counts(springs);
        let at_rest = curve.points[0].events.len();
        assert!(at_rest > 0 && yielded > 0);
        assert_eq!(count(0.0, which), [springs as u64, at_rest as u64, 0]);
        assert_eq!(
            count(1.0, which),
            [springs, cracked - yielded, yielded].map(|number| number as u64)
        );
    }
    page.assert_content();
}
