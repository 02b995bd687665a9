//! The page of a study is one file with every number on it.

use jostle_report::{
    Axis, Bar, Bars, Cell, Chart, HeatMap, Level, Petal, Rose, Section, Series, Stroke, StudyPage,
    render_study,
};

fn axis(name: &str, unit: &str) -> Axis {
    Axis {
        name: name.into(),
        unit: unit.into(),
    }
}

fn page() -> StudyPage {
    let cells = (0..6).map(|index| Cell {
        value: (index != 4).then(|| f64::from(index) * 111.0),
        cases: format!("case {index}"),
        link: (index == 2).then(|| "runs/case-2/report.html".into()),
    });
    StudyPage {
        kind: String::new(),
        subject: "Two towers; el-centro (one record)".into(),
        title: "A <study> & more".into(),
        headline: vec!["The buildings pound in 5 of 6 cases.".into()],
        answers: vec![["Gap needed".into(), "137 mm".into(), "el-centro".into()]],
        facts: vec![("cases".into(), "6".into())],
        maps: vec![(
            "El Centro".into(),
            vec![HeatMap {
                value: axis("greatest force", "kN"),
                x: axis("gap", "mm"),
                y: axis("peak ground acceleration", "cm/s²"),
                columns: vec![10.0, 20.0, 30.0],
                rows: vec![35.0, 70.0],
                cells: cells.collect(),
                nothing: "no impact".into(),
            }],
        )],
        sections: vec![Section {
            title: "Fragility".into(),
            remark: String::new(),
            charts: vec![Chart {
                title: "Probability".into(),
                x: axis("peak", "cm/s²"),
                y: axis("probability", ""),
                series: vec![Series {
                    name: "pounding".into(),
                    points: vec![[0.0, 0.0], [100.0, 0.5], [200.0, 1.0]],
                    band: vec![[0.0, 0.0], [0.4, 0.6], [0.9, 1.0]],
                    stroke: Stroke::Line,
                    colour: 0,
                }],
                levels: vec![Level {
                    name: "one half".into(),
                    value: 0.5,
                }],
                reach: 1.0,
                ..Chart::default()
            }],
            bars: vec![Bars {
                title: "Force".into(),
                value: axis("force", "kN"),
                centre: 100.0,
                bars: vec![Bar {
                    name: "mass".into(),
                    ends: [80.0, 130.0],
                    limits: None,
                }],
                legend: ["low".into(), "high".into()],
            }],
            roses: vec![Rose {
                title: "Base shear".into(),
                value: axis("base shear", "kN"),
                petals: vec![Petal {
                    name: "J1".into(),
                    points: vec![[0.0, 120.0], [120.0, 250.0], [240.0, 90.0]],
                    colour: 0,
                    dashed: false,
                }],
                north: None,
            }],
            table: Some((
                vec!["curve".into(), "median".into(), "β".into()],
                vec![vec!["gap 10 mm".into(), "cannot be fitted".into()]],
            )),
        }],
        failures: vec![(3, "\"J1\" collapses".into())],
        failed: 1,
        runs: vec![(2, "gap 30 mm".into(), "runs/case-2/report.html".into())],
        command: "jostle study study.toml".into(),
        files: vec![("cases.csv".into(), "everything".into())],
    }
}

#[test]
fn the_page_is_whole_and_loads_nothing() {
    let text = render_study(&page());
    for part in [
        "A &lt;study&gt; &amp; more",
        "gap 10 mm, peak ground acceleration 70 cm/s²: 333 kN (case 3)",
        "no impact (case 4)",
        "href=\"runs/case-2/report.html\"",
        "one half",
        "cannot be fitted",
        "&quot;J1&quot; collapses",
        "jostle study study.toml --case NUMBER",
        "Base shear [kN]",
        "J1 120°: 250 kN",
        "J1: 250 kN at 120°",
        "90° y",
    ] {
        assert!(text.contains(part), "{part} is missing");
    }
    for outside in ["http:", "https:", "src=", "@import", "NaN", "inf"] {
        assert!(!text.contains(outside), "{outside} is on the page");
    }
}

#[test]
fn heights_in_a_chart_are_those_of_the_numbers() {
    let text = render_study(&page());
    // The chart reaches from y = 260 (0) to y = 10 (1), and from x = 78 (0) to x = 492 (200).
    assert!(
        text.contains("d=\"M78.0 260.0L285.0 135.0L492.0 10.0\""),
        "the line of the series"
    );
    // The level and the middle of the line lie at one height.
    assert!(text.contains("y1=\"135\" y2=\"135\""), "the level line");
}

#[test]
fn axes_have_titles_and_rankings_their_base_and_ticks() {
    let text = render_study(&page());
    for part in [
        "text-anchor=\"middle\">peak [cm/s²]</text>",
        "rotate(-90)\" text-anchor=\"middle\">probability</text>",
        ">base 100 kN</text>",
        "text-anchor=\"middle\">force [kN]</text>",
    ] {
        assert!(text.contains(part), "{part} is missing");
    }
    // From 80 to 130 kN on the 278 px between 170 and 448: the base at 281.2, a tick at 120 kN.
    let at = |value: f64| format!("{:.1}", 170.0 + 278.0 * (value - 80.0) / 50.0);
    assert!(text.contains(&format!("x=\"{}\" y=\"11\"", at(100.0))));
    for (value, label) in [(80.0, "80"), (90.0, "90"), (120.0, "120"), (130.0, "130")] {
        let tick = format!(
            "x=\"{}\" y=\"75.0\" text-anchor=\"middle\">{label}<",
            at(value)
        );
        assert!(text.contains(&tick), "{tick} is missing");
    }
}

#[test]
fn levels_of_one_quantity_are_a_sequence_of_colours() {
    let mut page = page();
    let chart = &mut page.sections[0].charts[0];
    let first = chart.series[0].clone();
    chart.series = (0..3)
        .map(|colour| Series {
            colour,
            name: format!("level {colour}"),
            ..first.clone()
        })
        .collect();
    let study = render_study(&page);
    assert!(study.contains("--c:var(--c2)") && !study.contains("--high) 50%"));
    page.sections[0].charts[0].ordered = true;
    let ordered = render_study(&page);
    for (share, to, from) in [
        (0, "middle", "low"),
        (100, "middle", "low"),
        (100, "high", "middle"),
    ] {
        let colour = format!("--c:color-mix(in oklab, var(--{to}) {share}%, var(--{from}))");
        // In the legend, the line and its band.
        assert_eq!(ordered.matches(&colour).count(), 3, "{share} %");
    }
}

#[test]
fn empty_studies_make_a_page_too() {
    let text = render_study(&StudyPage::default());
    assert!(text.ends_with("</html>") && !text.contains("Maps"));
}
