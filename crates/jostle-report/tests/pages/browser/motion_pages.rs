//! The pages of a motion and of a set of motions.

use jostle_motion::{
    Accelerogram, Candidate, Gb50011, GbGroup, GbIntensity, GbLevel, GbSite, MainPeriod, Origin,
    TargetKind, TargetSpectrum, check_selection, measures,
};
use jostle_report::{MotionPage, SelectionPage, render_motion, render_selection};
use jostle_testkit::browser::{Mouse, Page, open_page};

/// Twenty seconds of waves that come and go.
fn wave(speed: f64) -> Accelerogram {
    let value = |i: u32| {
        let t = 0.01 * f64::from(i);
        let swell = (t / 4.0) * (1.0 - t / 4.0).exp();
        swell * ((9.0 * speed * t).sin() + 0.6 * (23.0 * speed * t).cos())
    };
    Accelerogram::new(0.01, (0..2000).map(value).collect()).unwrap()
}

fn motion_page(width: u32, height: u32) -> Option<Page> {
    let motion = wave(1.0);
    let measures = measures(&motion).unwrap();
    let page = MotionPage {
        name: "a <wave> & more",
        motion: &motion,
        measures: &measures,
    };
    open_page(&render_motion(&page).unwrap(), width, height)
}

fn selection_page(width: u32, height: u32) -> Option<Page> {
    let target = TargetSpectrum::new(TargetKind::Gb50011(Gb50011 {
        intensity: GbIntensity::Seven,
        site: GbSite::II,
        group: GbGroup::First,
        level: GbLevel::Frequent,
    }));
    let one = |name: &str, speed: f64, origin| Candidate {
        name: name.into(),
        motion: wave(speed).scaled_to_peak(0.35).unwrap(),
        origin,
    };
    let set = [
        one("first", 1.0, Origin::Natural),
        one("second", 1.4, Origin::Natural),
        one("made", 0.8, Origin::Artificial),
    ];
    let periods =
        [(0.8, 0.8), (0.25, 0.12)].map(|(period, mass_ratio)| MainPeriod { period, mass_ratio });
    let check = check_selection(&set, &target, &periods, 0.05).unwrap();
    let page = SelectionPage {
        target: &target,
        damping: 0.05,
        periods: &periods,
        set: &set,
        check: &check,
    };
    open_page(&render_selection(&page).unwrap(), width, height)
}

/// Lines of a chart that are no lines: too few points, or numbers that are none.
fn bad_lines(page: &Page) -> String {
    page.text("[...document.querySelectorAll('.chart .line')].map((l) => l.getAttribute('d') ?? '').filter((d) => /NaN|Infinity|undefined/.test(d) || (d.match(/L/g) ?? []).length < 40).join(' ; ')")
}

/// Puts the pointer over the middle of a chart.
fn point_at(page: &Page, chart: &str) {
    page.value(&format!(
        "document.querySelector('{chart}').scrollIntoView({{block: 'center'}})"
    ));
    page.drawn();
    let at = |of: &str| {
        page.number(&format!(
            "(() => {{ const r = document.querySelector('{chart}').getBoundingClientRect(); return {of}; }})()"
        ))
    };
    let (x, y) = (at("r.left + r.width / 2"), at("r.top + r.height / 2"));
    page.mouse(Mouse::Move, x, y);
    page.drawn();
}

/// What the outputs of a figure say.
fn said(page: &Page, figure: &str) -> String {
    page.text(&format!(
        "[...document.querySelectorAll('{figure} output')].map((o) => o.textContent).join('|')"
    ))
}

const TIME_LABELS: &str =
    "[...document.querySelectorAll('#time-charts svg')][0].querySelector('.grid').textContent";
const SPECTRUM_LABELS: &str = "document.querySelector('#spectra svg .grid').textContent";

#[test]
fn a_motion_is_drawn_whole_and_loads_nothing() {
    let Some(page) = motion_page(1280, 900) else {
        return;
    };
    let count = |what: &str| page.number(&format!("document.querySelectorAll('{what}').length"));
    assert_eq!(count("#time-charts .chart"), 4.0);
    assert_eq!(count("#spectra .line"), 4.0, "a curve for each damping");
    assert_eq!(count("#fourier .line"), 1.0);
    assert_eq!(count(".tile"), 11.0);
    assert_eq!(bad_lines(&page), "");
    assert_eq!(
        page.text("document.querySelector('h1').textContent"),
        "a <wave> & more"
    );
    page.picture("motion");
    page.assert_fits(1280.0);
    page.assert_alone();
    page.assert_content();
}

#[test]
fn histories_of_a_motion_zoom_together_and_tell_their_values() {
    let Some(page) = motion_page(1280, 900) else {
        return;
    };
    let whole = page.text(TIME_LABELS);
    for button in ["zoom-strong", "zoom-in"] {
        let before = page.text(TIME_LABELS);
        page.value(&format!("document.getElementById('{button}').click()"));
        page.drawn();
        assert_ne!(page.text(TIME_LABELS), before, "{button} did nothing");
    }
    let all = "new Set([...document.querySelectorAll('#time-charts svg')].map((s) => [...s.querySelectorAll('.grid text')].map((t) => t.textContent).filter((t) => / s$/.test(t)).join())).size";
    assert_eq!(page.number(all), 1.0, "one chart shows other instants");
    page.value("document.getElementById('zoom-all').click()");
    page.drawn();
    assert_eq!(page.text(TIME_LABELS), whole, "not the whole motion");
    let before = said(&page, "#time-charts");
    point_at(&page, "#time-charts .chart svg");
    let after = said(&page, "#time-charts");
    assert!(
        after != before && after.chars().any(|c| c.is_ascii_digit()),
        "nothing to read at the pointer: {after}"
    );
    page.assert_content();
}

#[test]
fn spectra_of_a_motion_change_quantity_and_axes_and_tell_their_values() {
    let Some(page) = motion_page(1280, 900) else {
        return;
    };
    let line = "document.querySelector('#spectra .line').getAttribute('d')";
    let choose = |id: &str, value: &str| {
        page.value(&format!("{{ const s = document.getElementById('{id}'); s.value = '{value}'; s.dispatchEvent(new Event('change')); }}"));
        page.drawn();
    };
    let mut seen = vec![page.text(line)];
    for (value, unit) in [
        ("sa", "m/s²"),
        ("psv", "m/s"),
        ("sd", "mm"),
        ("psa", "m/s²"),
    ] {
        choose("quantity", value);
        let caption = page.text("document.querySelector('#spectra .unit').textContent");
        assert!(caption.contains(unit), "{value}: {caption}");
        assert_eq!(bad_lines(&page), "", "{value}");
        seen.push(page.text(line));
    }
    assert_eq!(seen[0], seen[4], "the first quantity came back changed");
    assert!(seen[1] != seen[2] && seen[2] != seen[3] && seen[3] != seen[4]);
    let labels = page.text(SPECTRUM_LABELS);
    for value in ["linear", "log", "semilog"] {
        choose("axes", value);
        assert_eq!(
            page.text(SPECTRUM_LABELS) == labels,
            value == "semilog",
            "{value}"
        );
        assert_eq!(bad_lines(&page), "", "{value}");
    }
    assert_eq!(said(&page, "#spectra").replace('|', ""), "");
    point_at(&page, "#spectra svg");
    let read = said(&page, "#spectra");
    let values: Vec<&str> = read.split('|').collect();
    assert_eq!(values.len(), 5, "{read}");
    assert!(values[4].starts_with("at T = "), "{read}");
    let numbers: Vec<f64> = values[..4].iter().map(|v| v.parse().unwrap()).collect();
    assert!(
        numbers.iter().all(|value| *value > 0.0) && numbers[3] < numbers[0],
        "more damping, more response: {read}"
    );
    page.assert_content();
}

#[test]
fn motion_pages_turn_dark_and_fit_a_phone() {
    for (name, open) in [
        ("motion", motion_page as fn(u32, u32) -> Option<Page>),
        ("selection", selection_page),
    ] {
        let Some(page) = open(375, 740) else {
            return;
        };
        page.assert_fits(375.0);
        page.picture(&format!("phone-{name}"));
        let paper = "getComputedStyle(document.body).backgroundColor";
        let light = page.text(paper);
        page.value("document.getElementById('theme').click()");
        assert_ne!(page.text(paper), light);
        page.picture(&format!("dark-{name}"));
        page.assert_content();
    }
}

#[test]
fn a_selection_shows_verdict_spectra_and_numbers() {
    let Some(page) = selection_page(1280, 900) else {
        return;
    };
    let count = |what: &str| page.number(&format!("document.querySelectorAll('{what}').length"));
    // Three motions, their mean, the code and its two bounds.
    assert_eq!(count("#spectra .line"), 7.0);
    assert_eq!(count("#spectra .level"), 2.0, "a mark at each main period");
    assert_eq!((count("#rules tr"), count("#numbers tbody tr")), (4.0, 4.0));
    assert_eq!(bad_lines(&page), "");
    let verdict = page.text("document.querySelector('.verdict').textContent");
    let unmet = page.text("document.getElementById('rules').textContent");
    assert_eq!(verdict.contains("does not meet"), unmet.contains("not met"));
    page.picture("selection");
    point_at(&page, "#spectra svg");
    let read = said(&page, "#spectra");
    let values: Vec<&str> = read.split('|').collect();
    assert_eq!(values.len(), 8, "{read}");
    let number = |i: usize| values[i].parse::<f64>().unwrap();
    let mean = (number(0) + number(1) + number(2)) / 3.0;
    assert!((number(3) / mean - 1.0).abs() < 0.01, "{read}");
    assert!((number(5) / number(4) - 0.8).abs() < 0.01, "{read}");
    let labels = page.text(SPECTRUM_LABELS);
    page.value("{ const s = document.getElementById('axes'); s.value = 'log'; s.dispatchEvent(new Event('change')); }");
    page.drawn();
    assert_ne!(page.text(SPECTRUM_LABELS), labels);
    assert_eq!(bad_lines(&page), "");
    page.assert_fits(1280.0);
    page.assert_alone();
    page.assert_content();
}
