//! The map of a city, the list of its pairs to look at, and the same as GeoJSON and GeoParquet.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use jostle_io::shown::{HEIGHT, LENGTH, MEGANEWTON};
use jostle_io::{Values, csv_field, write_atomically};
use maud::{Markup, html};
use serde_json::json;

use crate::answers::{Answers, BuildingAnswer, MEDIANS, OWN, STATES};
use crate::fault::CityError;
use crate::inventory::extent;
use crate::model::{PairModel, Runner};
use crate::run::City;
use crate::tables::{building_columns, write_buildings};

/// Of pairs the model that shows most, and the address that runs it.
type Links<'m> = BTreeMap<usize, (&'m PairModel, String)>;

/// Pairs of the list on the page.
const LISTED: usize = 100;
/// Names of damage states.
pub(crate) const STATE_NAMES: [&str; STATES] =
    ["none", "slight", "moderate", "extensive", "complete"];

impl City {
    /// Writes the results of a run: `index.html` (the map), `worst-pairs.csv`, `buildings.parquet` and `buildings.geojson`
    /// with the answers. `runner` may make a page that runs the pairs of the list, to which the map then leads.
    ///
    /// # Errors
    ///
    /// When parts of the run are missing, or a file cannot be written.
    pub fn report(
        &self,
        folder: &Path,
        runner: &mut Runner<'_>,
    ) -> Result<(Answers, Vec<PathBuf>), CityError> {
        let answers = self.answers(folder)?;
        let order = ranked(&answers);
        let models = self.pair_models(&answers, &order[..LISTED.min(order.len())])?;
        let links = runner(&models)?;
        let links: Links<'_> = models
            .iter()
            .zip(links)
            .map(|(model, link)| (model.pair, (model, link)))
            .collect();
        let page = folder.join("index.html");
        write_atomically(&page, self.page(&answers, &order, &links).as_bytes())?;
        let worst = folder.join("worst-pairs.csv");
        write_atomically(&worst, self.pairs_csv(&answers, &order).as_bytes())?;
        let table = folder.join("buildings.parquet");
        let mut columns = building_columns(&self.inventory.buildings);
        columns.extend(self.answer_columns(&answers));
        write_buildings(&table, &self.inventory, columns)?;
        let map = folder.join("buildings.geojson");
        write_atomically(&map, self.geojson(&answers).as_bytes())?;
        Ok((answers, vec![page, worst, table, map]))
    }

    /// Columns of the answers of buildings; absent without a neighbour.
    fn answer_columns(&self, answers: &Answers) -> Vec<(String, Values)> {
        let real = |of: &dyn Fn(&BuildingAnswer) -> f64| {
            Values::Instant(
                answers
                    .buildings
                    .iter()
                    .map(|building| building.as_ref().map(of))
                    .collect(),
            )
        };
        let classes = self
            .structures
            .iter()
            .map(|structure| structure.class.name.to_string());
        let levels = self
            .structures
            .iter()
            .map(|structure| structure.class.level.name().to_owned());
        let half = OWN - 2;
        let twice = OWN + 2;
        let mut columns = vec![
            ("class".to_owned(), Values::Text(classes.collect())),
            ("level".to_owned(), Values::Text(levels.collect())),
            ("p_struck".to_owned(), real(&|own| own.struck[OWN])),
            (
                "p_struck_half_gaps".to_owned(),
                real(&|own| own.struck[half]),
            ),
            (
                "p_struck_double_gaps".to_owned(),
                real(&|own| own.struck[twice]),
            ),
            ("p_column_strike".to_owned(), real(&|own| own.column)),
            ("drift_ratio_alone".to_owned(), real(&|own| own.drift[0])),
            ("drift_ratio".to_owned(), real(&|own| own.drift[1])),
        ];
        for (which, suffix) in ["_alone", ""].into_iter().enumerate() {
            for (state, name) in STATE_NAMES.into_iter().enumerate() {
                columns.push((
                    format!("p_{name}{suffix}"),
                    real(&|answer| answer.states[which][state]),
                ));
            }
        }
        columns
    }

    /// Every pair, the worst first.
    fn pairs_csv(&self, answers: &Answers, order: &[usize]) -> String {
        let mut text = String::from(
            "pair,left,right,position,distance_m,face_m,p_struck,p_column_strike,closing_median_m,closing_q90_m,\
             force_median_n,force_q90_n,p_worse,p_better\n",
        );
        for at in order {
            let (pair, answer) = (&self.neighbours.pairs[*at], &answers.pairs[*at]);
            let [left, right] = pair
                .buildings
                .map(|at| csv_field(&self.inventory.buildings[at].id));
            let _ = writeln!(
                text,
                "{at},{left},{right},{},{:.3},{:.2},{:.4},{:.4},{:.5},{:.5},{:.0},{:.0},{:.4},{:.4}",
                pair.position.name(),
                pair.distance,
                pair.face,
                answer.struck,
                answer.column,
                answer.closing[0],
                answer.closing[1],
                answer.force[0],
                answer.force[1],
                answer.worse,
                answer.better
            );
        }
        text
    }

    fn geojson(&self, answers: &Answers) -> String {
        let mut text = String::from("{\"type\":\"FeatureCollection\",\"features\":[\n");
        for (at, building) in self.inventory.buildings.iter().enumerate() {
            let outline = self.inventory.plane.outline(&building.outline);
            let rings = std::iter::once(outline.exterior()).chain(outline.interiors());
            let rings = rings.map(|ring| {
                let corners =
                    (ring.0.iter()).map(|place| format!("[{:.8},{:.8}]", place.x, place.y));
                format!("[{}]", corners.collect::<Vec<_>>().join(","))
            });
            let rings = rings.collect::<Vec<_>>().join(",");
            let mut known = json!({ "id": building.id, "storeys": building.likely_storeys(), "class": *self.structures[at].class.name });
            if let Some(building) = &answers.buildings[at] {
                let round = |value: f64| (value * 1e4).round() / 1e4;
                known["p_struck"] = json!(round(building.struck[OWN]));
                known["p_column_strike"] = json!(round(building.column));
                for (which, suffix) in ["_alone", ""].into_iter().enumerate() {
                    let worse: f64 = building.states[which][2..].iter().sum();
                    known[format!("p_moderate_or_worse{suffix}")] = json!(round(worse));
                }
            }
            let comma = if at == 0 { "" } else { ",\n" };
            let _ = write!(
                text,
                "{comma}{{\"type\":\"Feature\",\"properties\":{known},\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[{rings}]}}}}"
            );
        }
        text.push_str("\n]}\n");
        text
    }

    fn page(&self, answers: &Answers, order: &[usize], links: &Links<'_>) -> String {
        let body = self.body(answers, order, links);
        let data = self.data(answers);
        jostle_report::render_document(
            &self.file.title,
            "Which neighbours collide",
            &body.into_string(),
            &data,
            include_str!("../assets/city.css"),
            include_str!("../assets/city.js"),
        )
    }

    /// Outlines and answers for the map: about forty bytes a building.
    fn data(&self, answers: &Answers) -> serde_json::Value {
        let corner = extent(&self.inventory.buildings)
            .map_or([0.0; 2], |extent| [extent.min().x, extent.min().y]);
        let (mut outlines, mut last) = (Vec::new(), [0_i64; 2]);
        for building in &self.inventory.buildings {
            // Courts hang on the first corner: one line goes round all of them.
            let first = building.outline.exterior().0.first();
            let courts = building.outline.interiors().iter();
            let courts = courts.flat_map(|court| court.0.iter().chain(first));
            let ring = building.outline.exterior().0.iter().skip(1);
            let ring: Vec<_> = ring.chain(courts).collect();
            number(&mut outlines, ring.len() as u64);
            for place in ring {
                for (k, value) in [place.x, place.y].into_iter().enumerate() {
                    let here = ((value - corner[k]) * 10.0).round() as i64;
                    let step = here - last[k];
                    last[k] = here;
                    number(&mut outlines, ((step << 1) ^ (step >> 63)) as u64);
                }
            }
        }
        let width = MEDIANS.len() + 1 + 2 * (STATES - 1);
        let byte = |value: f64| (255.0 * value.clamp(0.0, 1.0)).round() as u8;
        let mut values = Vec::with_capacity(width * answers.buildings.len());
        for building in &answers.buildings {
            let Some(answer) = building else {
                values.extend(std::iter::repeat_n(0, width));
                continue;
            };
            values.extend(answer.struck.map(byte));
            values.push(byte(answer.column));
            for states in answer.states {
                values.extend((1..STATES).map(|state| byte(states[state..].iter().sum())));
            }
        }
        let mut what: Vec<String> = Vec::new();
        let kinds = self.structures.iter().map(|structure| {
            let name = format!(
                "{}, {} code",
                structure.class.name,
                structure.class.level.name()
            );
            what.iter()
                .position(|known| *known == name)
                .unwrap_or_else(|| {
                    what.push(name);
                    what.len() - 1
                })
        });
        let kinds: Vec<usize> = kinds.collect();
        let known: Vec<u8> = answers
            .buildings
            .iter()
            .map(|building| u8::from(building.is_some()))
            .collect();
        json!({
            "count": self.inventory.buildings.len(),
            "outlines": STANDARD.encode(outlines),
            "known": STANDARD.encode(known),
            "values": STANDARD.encode(values),
            "width": width,
            "medians_mm": MEDIANS.map(|own| 1e3 * own * self.file.gap_median),
            "median_mm": 1e3 * self.file.gap_median,
            "units": {
                "length": { "name": LENGTH.name(), "size": LENGTH.size() },
                "height": { "name": HEIGHT.name(), "size": HEIGHT.size() },
            },
            "ids": self.inventory.buildings.iter().map(|own| own.id.as_str()).collect::<Vec<_>>(),
            "storeys": self.structures.iter().map(|own| own.storeys).collect::<Vec<_>>(),
            "kinds": kinds,
            "what": what,
        })
    }

    fn body(&self, answers: &Answers, order: &[usize], links: &Links<'_>) -> Markup {
        let count = self.inventory.buildings.len();
        let means = answers.means();
        let with = means.buildings;
        let percent = |value: f64| format!("{:.1} %", 100.0 * value);
        let [half, struck, twice] = means.struck;
        let [capacities, drifts] = self.types.sources();
        let median = LENGTH.text(self.file.gap_median, 0);
        let moderate = means.moderate;
        let [_, middle, high, _] = answers.drift_ratios;
        let tiles = [
            (
                "Struck by a neighbour",
                percent(struck),
                format!(
                    "of buildings with a neighbour, median gap {median}; {} with half the median gap, {} with twice",
                    percent(half),
                    percent(twice)
                ),
            ),
            (
                "Neighbours within reach",
                percent(with as f64 / count.max(1) as f64),
                format!(
                    "of {count} buildings, in {} pairs and {} blocks",
                    self.neighbours.pairs.len(),
                    self.blocks.len()
                ),
            ),
            (
                "Slabs strike columns",
                percent(means.column),
                "of buildings with a neighbour: the kind of pounding that breaks columns"
                    .to_owned(),
            ),
            (
                "Moderate damage and worse",
                percent(moderate[1]),
                format!(
                    "with neighbours, {} alone; counting every state, contact worsens it in {} of the samples and improves it in {}",
                    percent(moderate[0]),
                    percent(answers.changed[0]),
                    percent(answers.changed[1])
                ),
            ),
        ];
        let motions = self.motions();
        let shaken = match motions {
            [one] => format!("one motion, {one}"),
            many => format!("{} motions", many.len()),
        };
        let differs = self.told();
        let sampled = answers.sampled.within(self.file.tolerance).map_or_else(
            || "No row was repeated with the standard solvers.".to_owned(),
            |(within, worst)| {
                format!(
                    "{} rows were repeated with the standard solvers at a tolerance of 1e-4: {} of their peaks agree within {}; the \
                     greatest difference is {}.",
                    answers.sampled.rows,
                    percent(within),
                    self.file.tolerance,
                    percent(worst)
                )
            },
        );
        let mended = self.inventory.mends.len();
        let gaps = if self.file.gap_is_given {
            "as the city file says"
        } else {
            "an assumption, because no survey of gaps is public"
        };
        html! {
            p.verdict {
                "A building with a neighbour is struck with a probability of " (percent(struck)) " in this shaking ("
                (shaken) ", " (self.file.draws) " draws)."
            }
            @if let Some(at) = order.first() {
                @let [left, right] = self.neighbours.pairs[*at].buildings;
                @let own = &answers.pairs[*at];
                p { "Most critical pair: " a href="#pairs" { "number " (at) }
                    ", " (self.inventory.buildings[left].id) " and " (self.inventory.buildings[right].id)
                    ", which collide with a probability of " (percent(own.struck))
                    ". Contact worsens a damage state in " (of_samples(own.worse * own.samples as f64, own.samples)) " samples." }
            }
            div.tiles {
                @for (name, value, note) in &tiles {
                    div.tile { p.tile-name { (name) } p.tile-value { (value) } p.tile-note { (note) } }
                }
            }
            section {
                h2 { "Map" }
                div.controls {
                    label { "Show "
                        select #show {
                            option value="struck" { "probability of being struck" }
                            option value="column" { "probability that a slab strikes columns" }
                            option value="moderate" { "moderate damage and worse, with neighbours" }
                            option value="extensive" { "extensive damage and worse, with neighbours" }
                            option value="change" { "change of moderate and worse by neighbours" }
                        }
                    }
                    label { "Median gap "
                        input #median type="range" min="-3" max="2" step="0.05" value="0";
                        output #median-text {}
                    }
                    span.buttons role="group" aria-label="Zoom" {
                        button #zoom-in type="button" aria-label="Zoom in" { "+" }
                        button #zoom-out type="button" aria-label="Zoom out" { "−" }
                        button #zoom-all type="button" { "Whole city" }
                    }
                }
                div #legend.scale {}
                div.city {
                    canvas #map aria-label="Map of the buildings" {}
                    aside #detail {}
                }
                p.quiet.screen { "The slider redraws the probability of an impact from the closing without contact: no run is needed for other gaps. "
                    "Other layers are shares of the samples that were run: one sample of a building is "
                    (percent(1.0 / (self.file.draws as f64 * motions.len() as f64).max(1.0))) "." }
            }
            section #pairs {
                h2 { "Pairs to look at first" }
                p.quiet {
                    "Counts are of samples: draws of gaps and buildings, times motions. The probability of an impact also averages over the gaps that were not drawn. "
                    "Worse: contact brings either building into a worse state, also by other neighbours in its row. "
                    "Ranked by four times the share of worse samples, twice the share with impacts on columns, and the probability of an impact. All " (order.len())
                    " pairs are in worst-pairs.csv. Any of them becomes a model file by " code { "jostle city model FOLDER --pair NUMBER --draw 0" } "."
                    @if !links.is_empty() {
                        " Run opens a pair here in the browser, in the draw that shows most of what contact does to it; every number can be changed there."
                    }
                }
                div.worst tabindex="0" { table {
                    thead { tr {
                        th { "Pair" } th { "Left" } th { "Right" } th { "Storeys" } th { "On the map" } th { "Probability of a strike" } th { "Struck" }
                        th { "On columns" } th { "Closing, median" } th { "90 %" } th { "Force, median" } th { "Worse" }
                        @if !links.is_empty() { th { "Model" } }
                    } }
                    tbody {
                        @for at in order.iter().take(LISTED) {
                            @let pair = &self.neighbours.pairs[*at];
                            @let own = &answers.pairs[*at];
                            @let [left, right] = pair.buildings;
                            tr tabindex="0" data-left=(left) data-right=(right) {
                                td { (at) }
                                td { (self.inventory.buildings[left].id) }
                                td { (self.inventory.buildings[right].id) }
                                td { (self.structures[left].storeys) " | " (self.structures[right].storeys) }
                                td { (LENGTH.text(pair.distance, 0)) }
                                td { (percent(own.struck)) }
                                td { (of_samples(own.hits as f64, own.samples)) }
                                td { (of_samples(own.column * own.samples as f64, own.samples)) }
                                td { (LENGTH.text(own.closing[0], 0)) }
                                td { (LENGTH.text(own.closing[1], 0)) }
                                td { @if own.force[0] > 0.0 { (MEGANEWTON.text(own.force[0], 2)) } @else { "–" } }
                                td { (of_samples(own.worse * own.samples as f64, own.samples)) }
                                @if let Some((model, link)) = links.get(at) {
                                    @let [draw, motion] = model.sample;
                                    td { a href=(link) title=(format!("draw {draw}, motion {motion}")) { "Run" } }
                                } @else if !links.is_empty() { td { "–" } }
                            }
                        }
                    }
                } }
            }
            section {
                h2 { "What was known, and what was sampled" }
                div.note {
                    p { b { "Not a prediction for any one building. " } "These are probabilities over draws: they show which pairs to inspect, not what will happen to a particular building." }
                    p { "Known from the inventory: outlines, and storeys, height, year and type where it has them; " (mended)
                        " rows were repaired, left out or assumed, all listed in mended.csv." }
                    p { "Sampled: gaps, lognormal with a median of " (median) " and a scatter of "
                        (self.file.gap_scatter) " (" (gaps) "); stiffness, strength, damping and contact stiffness. Maps show which buildings are adjacent, not their gaps." }
                    @if !differs.is_empty() {
                        p { "The shaking differs from place to place. " (differs.join(". ")) "." }
                    }
                    p { "Buildings are shear buildings of their class: capacities of " (capacities) ", damage drifts of " (drifts) ". Slabs in line and slabs against columns are followed; out-of-plane failure of walls, "
                        "torsion and the failure of a struck column are not. Where neighbours hit, the drift with contact over that alone is " (format!("{middle:.2}"))
                        " in the median and " (format!("{high:.2}")) " in the 95 % quantile." }
                    p { "Blocks are cut into rows of at most 32 buildings in a line at their widest gaps; " (percent(answers.in_rows))
                        " of the pairs' samples ran in rows of more than two."
                        @if answers.cut.0 > 0 {
                            " Cut at the narrowest gaps instead, the drift of " (answers.cut.0) " buildings of such blocks changes by "
                            (percent(answers.cut.1[0])) " in the median and " (percent(answers.cut.1[1])) " in the 95 % quantile."
                        }
                    }
                    p { (sampled) }
                }
            }
        }
    }
}

/// A count of samples.
fn of_samples(count: f64, samples: usize) -> String {
    format!("{count:.0} of {samples}")
}

/// Pairs, most critical first.
fn ranked(answers: &Answers) -> Vec<usize> {
    let mut order: Vec<usize> = (0..answers.pairs.len()).collect();
    order.sort_by(|a, b| {
        answers.pairs[*b]
            .concern()
            .total_cmp(&answers.pairs[*a].concern())
            .then(a.cmp(b))
    });
    order
}

/// A whole number, seven bits a byte, the lowest first.
fn number(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 128 {
        bytes.push((value & 127) as u8 | 128);
        value >>= 7;
    }
    bytes.push(value as u8);
}
