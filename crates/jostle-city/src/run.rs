//! Every pair of a city, drawn and shaken: part by part, so that memory stays the same and a stopped run goes on.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use jostle::GroundMotion;
use jostle_batch::{Gap, Law, Motion, Options, Peaks, Row};
use jostle_classes::{Types, lognormal};
use jostle_io::{CityFile, write_values_parquet};
use sha2::{Digest, Sha256};

use crate::blocks::{Block, Line, blocks, rows};
use crate::case::{Case, case_columns, read_cases};
use crate::columns::Table;
use crate::draw::{GapWidths, number_of_pair};
use crate::fault::CityError;
use crate::inventory::{Inventory, ReadOptions};
use crate::neighbours::{Neighbours, Pair};
use crate::sample::Sampled;
use crate::shaking::{Shaking, Strength};
use crate::structure::{Structure, structures};
use crate::tables;

/// Pairs times draws times motions of a part.
const PART: usize = 65_536;
/// Directions of shaking in plan are rounded to this, so that rows share motions \[°\].
const DIRECTION: f64 = 10.0;
/// Of so many rows one is run again in full.
const SAMPLE_EVERY: usize = 1000;
/// Blocks that are cut otherwise, to see what cutting changes.
const CUT_BLOCKS: usize = 200;

/// A city ready to be shaken.
#[derive(Debug)]
pub struct City {
    /// What it was made of.
    pub file: CityFile,
    /// Buildings.
    pub inventory: Inventory,
    /// Pairs within reach.
    pub neighbours: Neighbours,
    /// Blocks of them.
    pub blocks: Vec<Block>,
    pub(crate) types: Types,
    pub(crate) structures: Vec<Structure>,
    pub(crate) pair_ids: Vec<u64>,
    shaking: Shaking,
    fingerprint: String,
    parts: Vec<std::ops::Range<usize>>,
}

/// What a run does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RunOptions {
    /// This share of the parts, from 1, and how many shares there are; `None` for all parts.
    pub shard: Option<(usize, usize)>,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Done {
    /// Pairs times draws times motions that are finished.
    pub cases: usize,
    /// Of so many.
    pub of: usize,
    /// Parts that other shares have yet to make.
    pub missing: usize,
}

/// A row of a draw under a motion.
pub(crate) struct Job {
    pub(crate) line: Line,
    pub(crate) draw: usize,
    pub(crate) motion: usize,
}

impl City {
    /// Reads the inventory of a city file, finds the neighbours and resolves the motions.
    ///
    /// # Errors
    ///
    /// When the inventory or the motions cannot be used.
    pub fn new(file: CityFile) -> Result<Self, CityError> {
        let options = ReadOptions {
            columns: tables::columns_of(&file.columns)?,
            metres: file.metres,
        };
        let mut inventory = Inventory::read(&file.inventory, &options)?;
        let neighbours = Neighbours::within(&inventory.buildings, file.reach);
        tables::refuse_overlaps(&file.inventory, &inventory, &neighbours)?;
        let types = Types::read(&file.types).map_err(CityError::Input)?;
        let (structures, assumed) = structures(&inventory, &file, &types)?;
        inventory.mends.extend(assumed);
        inventory.mends.sort_by_key(|mend| mend.row);
        let ids: Vec<u64> = structures.iter().map(|structure| structure.id).collect();
        let pair_ids = neighbours
            .pairs
            .iter()
            .map(|pair| number_of_pair(&ids, pair))
            .collect();
        let found = blocks(&neighbours.pairs, inventory.buildings.len());
        let shaking = Shaking::of(&file, &inventory, &found)?;
        let parts = parts(&found, file.draws * shaking.count(), PART);
        let mut city = Self {
            file,
            inventory,
            neighbours,
            blocks: found,
            types,
            structures,
            pair_ids,
            shaking,
            fingerprint: String::new(),
            parts,
        };
        city.fingerprint = city.fingerprint()?;
        Ok(city)
    }

    /// The city of a folder that a run wrote into, by the city file and the options that it was run with.
    ///
    /// # Errors
    ///
    /// When the folder holds no run, or its city file or inventory is gone or has changed.
    pub fn of_folder(folder: &Path) -> Result<Self, CityError> {
        let known = tables::Known::read(folder)?;
        let mut file = CityFile::load(&known.city_file)
            .map_err(|error| CityError::Input(error.to_string()))?;
        file.draws = known.draws;
        file.tolerance = known.tolerance;
        let city = Self::new(file)?;
        if city.fingerprint != known.fingerprint {
            return Err(CityError::of(
                folder,
                format!(
                    "{}, its inventory or its motion has changed since the run; run it again into another folder",
                    known.city_file.display()
                ),
            ));
        }
        Ok(city)
    }

    /// What shakes it.
    pub(crate) fn shaking(&self) -> &Shaking {
        &self.shaking
    }

    /// Names of the motions.
    #[must_use]
    pub fn motions(&self) -> &[String] {
        self.shaking.names()
    }

    /// How motions were found that differ from place to place, a line each.
    #[must_use]
    pub fn told(&self) -> &[String] {
        self.shaking.told()
    }

    /// Pairs times draws times motions.
    #[must_use]
    pub fn cases(&self) -> usize {
        self.neighbours.pairs.len() * self.file.draws * self.shaking.count()
    }

    /// What decides the numbers of a run, as a hash.
    fn fingerprint(&self) -> Result<String, CityError> {
        let mut hash = Sha256::new();
        hash.update(env!("CARGO_PKG_VERSION"));
        // Everything that decides a number, and no path: the same city may be moved.
        let file = &self.file;
        let buildings = (
            file.metres,
            &file.columns,
            file.reach,
            &file.kind,
            &file.level,
            file.scatter,
        );
        let gaps = (file.gap_median, file.gap_scatter, file.party_wall);
        let contact = (
            file.contact_stiffness,
            file.restitution,
            file.contact_scatter,
        );
        hash.update(format!(
            "{:?}",
            (buildings, gaps, contact, file.draws, file.tolerance)
        ));
        hash.update(self.types.content());
        let path = &self.file.inventory;
        let mut read = jostle_io::open_file(path).map_err(|error| CityError::of(path, error))?;
        std::io::copy(&mut read, &mut HashWriter(&mut hash))
            .map_err(|error| CityError::of(path, error))?;
        self.shaking.hash(&mut hash)?;
        Ok(hash
            .finalize()
            .iter()
            .take(16)
            .map(|byte| format!("{byte:02x}"))
            .collect())
    }

    /// Makes a folder ready for this city, or makes sure that it holds this one, and writes its tables of buildings, pairs and
    /// blocks.
    ///
    /// # Errors
    ///
    /// When the folder holds the run of another city, or cannot be written.
    pub fn settle(&self, folder: &Path) -> Result<(), CityError> {
        let runs = folder.join("runs");
        std::fs::create_dir_all(&runs).map_err(|error| CityError::of(&runs, error))?;
        tables::claim(folder, &self.file, &self.fingerprint)?;
        tables::write_tables(folder, &self.inventory, &self.neighbours, &self.blocks)
    }

    /// How many parts a run has.
    #[must_use]
    pub fn parts(&self) -> usize {
        self.parts.len()
    }

    /// Numbers of the parts that a folder lacks: unfinished, damaged, or of another run.
    #[must_use]
    pub fn missing(&self, folder: &Path) -> Vec<usize> {
        let all = 0..self.parts.len();
        all.filter(|part| !self.holds(&part_path(folder, *part)))
            .collect()
    }

    /// Runs one part of a folder that is ready, unless it is there.
    ///
    /// # Errors
    ///
    /// As [`Self::run`].
    pub fn run_one(
        &self,
        folder: &Path,
        part: usize,
        stop: &dyn Fn() -> bool,
    ) -> Result<(), CityError> {
        let path = part_path(folder, part);
        if part >= self.parts.len() || self.holds(&path) {
            return Ok(());
        }
        self.run_part(part, &path, stop, &mut |_| {})
    }

    /// Runs what `folder/runs` does not hold yet; `stop` ends after a while with what is finished, `show` hears how far it is.
    ///
    /// # Errors
    ///
    /// [`CityError::Stopped`] when told to stop; when a folder holds the run of another city, or cannot be written.
    pub fn run(
        &self,
        folder: &Path,
        options: RunOptions,
        stop: &dyn Fn() -> bool,
        show: &mut dyn FnMut(Done),
    ) -> Result<Done, CityError> {
        self.settle(folder)?;
        let each = self.file.draws * self.shaking.count();
        let mut done = Done {
            cases: 0,
            of: self.cases(),
            missing: 0,
        };
        let of_part = |part: usize| -> usize {
            self.blocks[self.parts[part].clone()]
                .iter()
                .map(|block| block.pairs.len() * each)
                .sum()
        };
        for part in 0..self.parts.len() {
            let path = part_path(folder, part);
            let finished = self.holds(&path);
            let in_shard = options
                .shard
                .is_none_or(|(shard, of)| part % of == shard - 1);
            if !in_shard {
                done.missing += usize::from(!finished);
                done.of -= of_part(part);
                continue;
            }
            if !finished {
                let before = done.cases;
                self.run_part(part, &path, stop, &mut |cases| {
                    show(Done {
                        cases: before + cases,
                        ..done
                    });
                })?;
            }
            done.cases += of_part(part);
            show(done);
        }
        Ok(done)
    }

    /// Whether a part is there, whole, and of this run.
    fn holds(&self, path: &Path) -> bool {
        path.exists()
            && Table::read(path)
                .is_ok_and(|table| table.facts.get("fingerprint") == Some(&self.fingerprint))
    }

    /// With smaller parts.
    #[doc(hidden)]
    #[must_use]
    pub fn in_parts_of(mut self, cases: usize) -> Self {
        self.parts = parts(&self.blocks, self.file.draws * self.shaking.count(), cases);
        self
    }

    /// Of every case: closing and gap \[m\], buildings of the row, impacts, the pair, the left drift ratio alone and in the row.
    ///
    /// # Errors
    ///
    /// When a part cannot be read.
    #[doc(hidden)]
    pub fn cases_for_tests(&self, folder: &Path) -> Result<Vec<[f64; 7]>, CityError> {
        let mut all = Vec::new();
        for path in self.part_paths(folder) {
            all.extend(read_cases(&path)?.0.iter().map(|case| {
                let gap = case.gap.unwrap_or(f64::INFINITY);
                [
                    case.closing,
                    gap,
                    case.row as f64,
                    case.impacts as f64,
                    case.pair as f64,
                    case.drift[0][0],
                    case.drift[1][0],
                ]
            }));
        }
        Ok(all)
    }

    /// Refuses a part of another run.
    pub(crate) fn same_run(&self, path: &Path, table: &Table) -> Result<(), CityError> {
        if table.facts.get("fingerprint") == Some(&self.fingerprint) {
            return Ok(());
        }
        Err(CityError::of(
            path,
            "is a part of another run: run `jostle city run` again, or remove the folder",
        ))
    }

    /// Paths of all parts, in order.
    pub(crate) fn part_paths(&self, folder: &Path) -> Vec<PathBuf> {
        (0..self.parts.len())
            .map(|part| part_path(folder, part))
            .collect()
    }

    fn run_part(
        &self,
        part: usize,
        path: &Path,
        stop: &dyn Fn() -> bool,
        show: &mut dyn FnMut(usize),
    ) -> Result<(), CityError> {
        let block = &self.blocks[self.parts[part].clone()];
        let jobs = self.jobs(block);
        let total: usize = jobs.iter().map(|job| job.line.pairs.len()).sum();
        let motions = self.directed(&jobs)?;
        let options = Options::for_tolerance(self.file.tolerance);
        let fault = |error: jostle_batch::Error| CityError::Analysis(error.to_string());
        // Free first: how near they come says who can hit at all.
        let mut free: Vec<Peaks> = Vec::with_capacity(jobs.len());
        let mut seen = 0;
        let all = jobs.iter().map(|job| self.row(job, &motions, false));
        jostle_batch::run(&motions.own, all, &options, |_, peaks| {
            seen += peaks.gaps.len();
            free.push(peaks);
            show(seen / 2);
            if stop() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .map_err(fault)?;
        if free.len() < jobs.len() {
            return Err(CityError::Stopped);
        }
        let struck: Vec<usize> = (0..jobs.len())
            .filter(|at| {
                let job = &jobs[*at];
                job.line.pairs.iter().enumerate().any(|(gap, pair)| {
                    let width = self.width(*pair, job.draw);
                    width.is_some_and(|width| closing(&free[*at], gap) > width)
                })
            })
            .collect();
        let mut with: BTreeMap<usize, Peaks> = BTreeMap::new();
        let hit = struck.iter().map(|at| self.row(&jobs[*at], &motions, true));
        jostle_batch::run(&motions.own, hit, &options, |at, peaks| {
            with.insert(struck[at], peaks);
            show(total / 2 + total * with.len() / (2 * struck.len().max(1)));
            if stop() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .map_err(fault)?;
        if with.len() < struck.len() {
            return Err(CityError::Stopped);
        }
        // Some of those that touch are run again in full.
        let share = (self.file.sample * total).div_ceil(self.cases().max(1));
        let wanted = match self.file.sample {
            0 => 0,
            _ => share.max(struck.len() / SAMPLE_EVERY),
        };
        let every = (struck.len() / wanted.max(1)).max(1);
        let chosen = struck.iter().step_by(every).take(wanted);
        let mut sample = Sampled::default();
        for at in chosen {
            if stop() {
                return Err(CityError::Stopped);
            }
            let row = self.row(&jobs[*at], &motions, true);
            let building = &self.inventory.buildings[jobs[*at].line.buildings[0]].id;
            let title = format!("building {building} and its row in draw {}", jobs[*at].draw);
            sample.add(&row, &motions.own[row.motion], &options, &title, stop)?;
        }
        let mut cases = Vec::with_capacity(total);
        for (at, job) in jobs.iter().enumerate() {
            cases.extend(self.cases_of(job, &free[at], with.get(&at)));
        }
        cases.sort_by_key(|case| (case.pair, case.draw, case.motion));
        let base = Drifts::of(&jobs, |at| with.get(&at).unwrap_or(&free[at]));
        let cut = self.cut_otherwise(block, &base, &options)?;
        let facts = [
            ("sample", sample.to_json()),
            ("cut", serde_json::json!(cut).to_string()),
            ("fingerprint", self.fingerprint.clone()),
        ];
        write_values_parquet(path, &self.file.title, &facts, case_columns(&cases))?;
        Ok(())
    }

    /// Blocks that are cut, cut at their narrowest gaps instead: how much the drift of each of their buildings changes, over
    /// that of the usual cut \[–\].
    fn cut_otherwise(
        &self,
        blocks: &[Block],
        base: &Drifts,
        options: &Options,
    ) -> Result<Vec<f64>, CityError> {
        let lines = blocks
            .iter()
            .map(|block| (self.lines(block, 0, |width| width), block));
        let cut: Vec<&Block> = lines
            .filter(|(lines, _)| lines.len() > 1)
            .map(|(_, block)| block)
            .collect();
        let pairs: usize = blocks.iter().map(|block| block.pairs.len()).sum();
        let wanted = (CUT_BLOCKS * pairs).div_ceil(self.neighbours.pairs.len().max(1));
        let every = (cut.len() / wanted.max(1)).max(1);
        let mut jobs = Vec::new();
        for block in cut.into_iter().step_by(every).take(wanted) {
            let lines = self.lines(block, 0, |width| -width);
            jobs.extend(lines.into_iter().map(|line| Job {
                line,
                draw: 0,
                motion: 0,
            }));
        }
        let motions = self.directed(&jobs)?;
        let mut peaks = Vec::with_capacity(jobs.len());
        let rows = jobs.iter().map(|job| self.row(job, &motions, true));
        jostle_batch::run(&motions.own, rows, options, |_, row_peaks| {
            peaks.push(row_peaks);
            ControlFlow::Continue(())
        })
        .map_err(|error| CityError::Analysis(error.to_string()))?;
        let other = Drifts::of(&jobs, |at| &peaks[at]);
        let change = |(building, drift): (&usize, &f64)| {
            let usual = *base.0.get(building)?;
            (usual > 0.0).then(|| (drift / usual - 1.0).abs())
        };
        Ok(other.0.iter().filter_map(change).collect())
    }

    /// Every row of some blocks in every draw under every motion. Draws of a row follow each other: alike rows fill the
    /// lanes of a batch.
    fn jobs(&self, blocks: &[Block]) -> Vec<Job> {
        let mut jobs = Vec::new();
        for block in blocks {
            let draws: Vec<Vec<Line>> = (0..self.file.draws)
                .map(|draw| self.lines(block, draw, |width| width))
                .collect();
            for motion in 0..self.shaking.count() {
                for (draw, lines) in draws.iter().enumerate() {
                    let line = |line: &Line| Job {
                        line: line.clone(),
                        draw,
                        motion,
                    };
                    jobs.extend(lines.iter().map(line));
                }
            }
        }
        jobs
    }

    /// The rows of a block in a draw, cut at the widest gaps; `rank` may order them otherwise.
    pub(crate) fn lines(&self, block: &Block, draw: usize, rank: impl Fn(f64) -> f64) -> Vec<Line> {
        rows(block, &self.neighbours.pairs, |pair| {
            rank(self.width(pair, draw).unwrap_or(0.0))
        })
    }

    /// The gap of a pair in a draw.
    pub(crate) fn width(&self, pair: usize, draw: usize) -> Option<f64> {
        let neighbour_pair = &self.neighbours.pairs[pair];
        self.gaps()
            .draw(self.pair_ids[pair], neighbour_pair.distance, draw as u64)
    }

    pub(crate) fn gaps(&self) -> GapWidths {
        GapWidths {
            median: self.file.gap_median,
            scatter: self.file.gap_scatter,
            party_wall: self.file.party_wall,
        }
    }

    /// Buildings, gaps and motion of a row.
    fn row(&self, job: &Job, motions: &Directed, contact: bool) -> Row {
        let draw = job.draw as u64;
        let structure = |at: &usize| self.structures[*at].drawn(draw, self.file.scatter);
        let buildings: Vec<_> = job.line.buildings.iter().map(structure).collect();
        let gaps = job.line.pairs.iter().enumerate().map(|(at, pair)| {
            let scatter = self.file.contact_scatter;
            let factor = if scatter > 0.0 {
                lognormal(self.pair_ids[*pair], draw, "contact", scatter)
            } else {
                1.0
            };
            let width = self.width(*pair, job.draw);
            let law = Law::HertzDamp {
                stiffness: self.file.contact_stiffness * factor,
                restitution: self.file.restitution,
            };
            let law = (contact && width.is_some()).then_some(law);
            Gap::between(
                &buildings[at],
                &buildings[at + 1],
                width.unwrap_or(0.0),
                law,
                0.0,
            )
        });
        let strength = self.strength(job);
        Row {
            gaps: gaps.collect(),
            motion: motions.of(strength.motion, self.direction(&job.line)),
            scale: strength.factor,
            buildings,
        }
    }

    /// The row in which a pair stands in a draw.
    pub(crate) fn line_of(&self, pair: usize, draw: usize) -> Line {
        let of_pair = |block: &&Block| block.pairs.contains(&pair);
        let lines = self.blocks.iter().find(of_pair);
        let lines = lines.map(|block| self.lines(block, draw, |width| width));
        let mut lines = lines.into_iter().flatten();
        let alone = || Line {
            buildings: self.neighbours.pairs[pair].buildings.to_vec(),
            pairs: vec![pair],
        };
        lines
            .find(|line| line.pairs.contains(&pair))
            .unwrap_or_else(alone)
    }

    /// The row of a job, and its motion.
    pub(crate) fn row_alone(&self, job: Job) -> Result<(Row, Motion), CityError> {
        let jobs = [job];
        let motions = self.directed(&jobs)?;
        let row = self.row(&jobs[0], &motions, true);
        let motion = motions.own[row.motion].clone();
        Ok((row, motion))
    }

    /// The motion of a job at the place of its row.
    fn strength(&self, job: &Job) -> Strength {
        self.shaking.at(job.line.buildings[0], job.motion)
    }

    /// Direction of a row from left to right, in steps of ten degrees; 0 where it does not matter.
    fn direction(&self, line: &Line) -> usize {
        if !self.shaking.has_directions() {
            return 0;
        }
        let pair: &Pair = &self.neighbours.pairs[line.pairs[0]];
        let turned = if pair.buildings[0] == line.buildings[0] {
            0.0
        } else {
            180.0
        };
        let angle = (pair.normal.to_degrees() + turned).rem_euclid(360.0);
        (angle / DIRECTION).round() as usize % (360.0 / DIRECTION) as usize
    }

    /// The motions along the rows of some jobs.
    fn directed(&self, jobs: &[Job]) -> Result<Directed, CityError> {
        let mut wanted: Vec<(usize, usize)> = jobs
            .iter()
            .map(|job| (self.strength(job).motion, self.direction(&job.line)))
            .collect();
        wanted.sort_unstable();
        wanted.dedup();
        let mut motions = Vec::with_capacity(wanted.len());
        for one in wanted.chunk_by(|a, b| a.0 == b.0) {
            let motion = self.shaking.motion(one[0].0)?;
            let directions = one.iter().map(|entry| entry.1 as f64 * DIRECTION);
            motions.extend(directions.map(|direction| along(&motion, direction)));
        }
        Ok(Directed {
            wanted,
            own: motions,
        })
    }

    fn cases_of(&self, job: &Job, free: &Peaks, with: Option<&Peaks>) -> Vec<Case> {
        let of = |peaks: &Peaks, at: usize| {
            let structure = &self.structures[job.line.buildings[at]];
            let drift = peaks.buildings[at]
                .drift
                .iter()
                .copied()
                .fold(0.0, f64::max);
            let ratio = drift / structure.storey_height;
            let acceleration = peaks.buildings[at]
                .acceleration
                .iter()
                .copied()
                .fold(0.0, f64::max);
            (ratio, acceleration, structure.state(ratio))
        };
        let with = with.unwrap_or(free);
        let pairs = job.line.pairs.iter().enumerate();
        pairs
            .map(|(gap, pair)| {
                // The pair names its buildings in the order of the inventory, the row from left to right.
                let mut sides = [gap, gap + 1];
                if job.line.buildings[gap] != self.neighbours.pairs[*pair].buildings[0] {
                    sides.swap(0, 1);
                }
                let contacts = &with.gaps[gap];
                let mut case = Case {
                    pair: *pair,
                    draw: job.draw,
                    motion: job.motion,
                    row: job.line.buildings.len(),
                    gap: self.width(*pair, job.draw),
                    closing: closing(free, gap),
                    force: contacts
                        .iter()
                        .map(|contact| contact.force)
                        .fold(0.0, f64::max),
                    impulse: contacts
                        .iter()
                        .map(|contact| contact.impulse)
                        .fold(0.0, f64::max),
                    impacts: contacts
                        .iter()
                        .map(|contact| contact.impacts as usize)
                        .sum(),
                    column_impacts: contacts
                        .iter()
                        .filter(|contact| contact.column)
                        .map(|contact| contact.impacts as usize)
                        .sum(),
                    ..Case::default()
                };
                for (side, at) in sides.into_iter().enumerate() {
                    for (which, peaks) in [free, with].into_iter().enumerate() {
                        let (drift, acceleration, state) = of(peaks, at);
                        case.drift[which][side] = drift;
                        case.acceleration[which][side] = acceleration;
                        case.state[which][side] = state;
                    }
                }
                case
            })
            .collect()
    }
}

/// Greatest drift of buildings over the rows that they stand in, in the first draw under the first motion \[m\].
struct Drifts(BTreeMap<usize, f64>);

impl Drifts {
    fn of<'p>(jobs: &[Job], peaks: impl Fn(usize) -> &'p Peaks) -> Self {
        let mut greatest = BTreeMap::new();
        for (at, job) in jobs
            .iter()
            .enumerate()
            .filter(|(_, job)| job.draw == 0 && job.motion == 0)
        {
            for (building, peaks) in job.line.buildings.iter().zip(&peaks(at).buildings) {
                let fold = peaks.drift.iter().copied().fold(0.0, f64::max);
                let kept = greatest.entry(*building).or_insert(0.0_f64);
                *kept = kept.max(fold);
            }
        }
        Self(greatest)
    }
}

/// Motions along rows, each once.
struct Directed {
    wanted: Vec<(usize, usize)>,
    own: Vec<Motion>,
}

impl Directed {
    fn of(&self, motion: usize, direction: usize) -> usize {
        self.wanted
            .binary_search(&(motion, direction))
            .unwrap_or_default()
    }
}

/// Greatest approach of the buildings of a gap \[m\].
fn closing(peaks: &Peaks, gap: usize) -> f64 {
    peaks.gaps[gap]
        .iter()
        .map(|gap| gap.closing)
        .fold(f64::NEG_INFINITY, f64::max)
        .max(0.0)
}

/// A motion along a direction \[°\]; one without a direction of its own acts along every row.
fn along(motion: &GroundMotion, direction: f64) -> Motion {
    let step = match &motion.wave {
        jostle::Wave::Sampled { step, .. } => *step,
        jostle::Wave::Sine { period, .. } | jostle::Wave::Ricker { period, .. } => period / 200.0,
    };
    let (one, other) = match &motion.bearing {
        None => (1.0, 0.0),
        Some(bearing) => {
            let angle = direction.to_radians() - bearing.angle;
            (libm::cos(angle), libm::sin(angle))
        }
    };
    let across = motion
        .bearing
        .as_ref()
        .and_then(|bearing| bearing.across.as_ref());
    let points = (motion.duration / step).round() as usize + 1;
    let acceleration = (0..points).map(|at| {
        let time = at as f64 * step;
        one * motion.acceleration(time)
            + across.map_or(0.0, |component| other * component.acceleration(time))
    });
    Motion {
        step,
        acceleration: acceleration.collect(),
    }
}

/// Blocks of about as many cases together.
fn parts(blocks: &[Block], each: usize, size: usize) -> Vec<std::ops::Range<usize>> {
    let (mut parts, mut first, mut cases) = (Vec::new(), 0, 0);
    for (at, block) in blocks.iter().enumerate() {
        cases += block.pairs.len() * each;
        if cases >= size {
            parts.push(first..at + 1);
            (first, cases) = (at + 1, 0);
        }
    }
    if first < blocks.len() {
        parts.push(first..blocks.len());
    }
    parts
}

fn part_path(folder: &Path, part: usize) -> PathBuf {
    folder.join("runs").join(format!("part-{part:05}.parquet"))
}

/// A hash as a place to copy a file to.
struct HashWriter<'a>(&'a mut Sha256);

impl std::io::Write for HashWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
