//! Colours of one palette stay apart for every kind of colour vision, on light and on dark paper.

use super::TWO_FRAMES;

/// Matrices on linear RGB for full vision and for full protanopia, deuteranopia and tritanopia: G. M. Machado,
/// M. M. Oliveira, L. A. F. Fernandes (2009), IEEE Trans. Visualization and Computer Graphics 15, 1291–1298, Table 1.
const VISIONS: [(&str, [[f64; 3]; 3]); 4] = [
    ("full", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    (
        "protanopia",
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
    ),
    (
        "deuteranopia",
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ],
    ),
    (
        "tritanopia",
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ],
    ),
];

/// Least distance of two colours of a palette in CIELAB (1976): several times what is just noticed, about 2.3.
const APART: f64 = 9.0;

fn linear(byte: f64) -> f64 {
    let share = byte / 255.0;
    if share <= 0.04045 {
        share / 12.92
    } else {
        ((share + 0.055) / 1.055).powf(2.4)
    }
}

/// CIELAB under D65 of linear sRGB.
fn lab(rgb: [f64; 3]) -> [f64; 3] {
    const XYZ: [([f64; 3], f64); 3] = [
        ([0.4124564, 0.3575761, 0.1804375], 0.95047),
        ([0.2126729, 0.7151522, 0.0721750], 1.0),
        ([0.0193339, 0.1191920, 0.9503041], 1.08883),
    ];
    let [x, y, z] = XYZ.map(|(row, white)| {
        let value: f64 = row.iter().zip(rgb).map(|(a, b)| a * b).sum();
        let share = value.max(0.0) / white;
        if share > 0.008856 {
            share.cbrt()
        } else {
            7.787 * share + 16.0 / 116.0
        }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[test]
fn palettes_suit_every_colour_vision() {
    let Some(page) = TWO_FRAMES.open(1280, 900) else {
        return;
    };
    let names = |stem: &str, ends: &[&str]| -> Vec<String> {
        ends.iter().map(|end| format!("--{stem}{end}")).collect()
    };
    let digits = ["0", "1", "2", "3", "4", "5", "6"];
    let energies = ["contact", "hysteretic", "damped", "strain", "kinetic"];
    let palettes = [
        names("c", &digits),
        names("f", &digits),
        names("e-", &energies),
    ];
    for theme in ["light", "dark"] {
        page.value(&format!(
            "document.documentElement.dataset.theme = '{theme}'"
        ));
        for palette in &palettes {
            let script = format!(
                "{palette:?}.map((name) => {{ const s = document.createElement('i'); s.style.color = `var(${{name}})`; document.body.append(s); const c = getComputedStyle(s).color; s.remove(); return c.match(/\\d+/g).slice(0, 3).join(' '); }}).join()"
            );
            let colours: Vec<[f64; 3]> = page
                .text(&script)
                .split(',')
                .map(|colour| {
                    let bytes: Vec<f64> = colour
                        .split(' ')
                        .map(|byte| linear(byte.parse().unwrap()))
                        .collect();
                    [bytes[0], bytes[1], bytes[2]]
                })
                .collect();
            assert_eq!(colours.len(), palette.len());
            for (vision, matrix) in VISIONS {
                let seen: Vec<[f64; 3]> = colours
                    .iter()
                    .map(|rgb| lab(matrix.map(|row| row.iter().zip(rgb).map(|(a, b)| a * b).sum())))
                    .collect();
                for (i, a) in seen.iter().enumerate() {
                    for (j, b) in seen.iter().enumerate().skip(i + 1) {
                        let apart: f64 = a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum();
                        assert!(
                            apart.sqrt() > APART,
                            "{theme}, {vision}: {} and {} are {:.1} apart",
                            palette[i],
                            palette[j],
                            apart.sqrt()
                        );
                    }
                }
            }
        }
    }
}
