//! `[[building.brace]]`: diagonals of the bays of a frame or of a grid.

use jostle::{Diagonal, DiagonalKind, DiagonalPlace, GridLine, PlanAxis, Reach, Rise, StrutLine};

use super::buckling::{self, Strut};
use super::hinges::read_spring;
use super::places::range;
use super::steel_profile;
use crate::keys::{AXES_OF_PLAN, DIRECTIONS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Bays of the frame that diagonals belong to, and its joints.
#[derive(Clone, Copy)]
pub(super) struct Bays<'a> {
    /// Storey heights \[m\].
    pub(super) heights: &'a [f64],
    pub(super) widths: Widths<'a>,
    /// E I in the plane of the bay of the columns on both sides of it \[N·m²\]; `None` where there is none.
    pub(super) column_rigidity: &'a dyn Fn(DiagonalPlace) -> [Option<f64>; 2],
    /// Whether a floor has a joint at a line of a plane frame from 0, or where two lines of a grid cross; those of floor 0 are feet.
    pub(super) has_joint: &'a dyn Fn(Joint) -> bool,
    /// Whether a diagonal finds both its joints.
    pub(super) has_joints: &'a dyn Fn(DiagonalPlace) -> bool,
}

/// A floor, 0 for the ground, and a line of a plane frame, with 0 across, or the crossing of two lines; both from 0.
pub(super) type Joint = (usize, [usize; 2]);

/// Widths of bays \[m\].
#[derive(Clone, Copy)]
pub(super) enum Widths<'a> {
    /// Of a plane frame.
    OfFrame(&'a [f64]),
    /// Along x and across, of a grid with one line more in the other direction.
    OfGrid(&'a [Vec<f64>; 2]),
}

impl Bays<'_> {
    /// Width of the bay of a diagonal \[m\].
    pub(super) fn width(&self, place: DiagonalPlace) -> f64 {
        let widths = match (self.widths, place.line) {
            (Widths::OfGrid(both), Some(line)) => &both[line.along.index()],
            (Widths::OfGrid(both), None) => &both[0],
            (Widths::OfFrame(widths), _) => return widths[place.bay - 1],
        };
        widths[place.bay - 1]
    }

    /// Length of a diagonal from joint to joint \[m\].
    pub(super) fn length(&self, place: DiagonalPlace) -> f64 {
        let [low, high] = place.floors();
        let rise = self.heights[low..high].iter().sum();
        let [from, to] = match place.crossings() {
            Some(crossings) => crossings,
            None => place.lines().map(|line| [line, 0]),
        };
        let ([x, y], [to_x, to_y]) = (self.at(from), self.at(to));
        let along = match place.reach == Reach::BAY {
            true => self.width(place),
            false => libm::hypot(to_x - x, to_y - y),
        };
        libm::hypot(along, rise)
    }

    /// Where a joint stands in the plan \[m\].
    fn at(&self, [x, y]: [usize; 2]) -> [f64; 2] {
        let before = |widths: &[f64], line: usize| widths[..line].iter().sum();
        match self.widths {
            Widths::OfFrame(widths) => [before(widths, x), 0.0],
            Widths::OfGrid([along, across]) => [before(along, x), before(across, y)],
        }
    }

    /// Lines at which joints stand: those of a plane frame, or of both directions of a grid.
    fn lines(&self) -> [usize; 2] {
        match self.widths {
            Widths::OfFrame(widths) => [widths.len() + 1, 1],
            Widths::OfGrid(both) => both.each_ref().map(|widths| widths.len() + 1),
        }
    }

    /// How joints are written, with an example.
    fn words(&self) -> [&'static str; 2] {
        match self.widths {
            Widths::OfFrame(_) => ["FLOOR.LINE", "\"0.1\""],
            Widths::OfGrid(_) => ["FLOOR.X.Y", "\"0.1.1\""],
        }
    }

    /// Keys of a table for some of the bays.
    pub(super) fn sections(&self, kind: DiagonalKind) -> &'static [Section] {
        match (self.widths, kind) {
            (Widths::OfFrame(_), DiagonalKind::Brace) => {
                &[Section::FrameBay, Section::BraceEnds, Section::Brace]
            }
            (Widths::OfFrame(_), DiagonalKind::Infill) => &[Section::FrameBay, Section::Infill],
            (Widths::OfGrid(_), DiagonalKind::Brace) => {
                &[Section::GridBay, Section::BraceEnds, Section::Brace]
            }
            (Widths::OfGrid(_), DiagonalKind::Infill) => &[Section::GridBay, Section::Infill],
        }
    }

    /// The bays that a table names, each with its line of the grid, and whether it names every one.
    fn named(&self, reader: &mut Reader<'_>, view: &View<'_>) -> Option<NamedBays> {
        let both = match self.widths {
            Widths::OfFrame(widths) => {
                let [from, to] = range(reader, view, "bay", widths.len())?;
                return Some((
                    (from..=to).map(|bay| (None, bay)).collect(),
                    view.has("bay"),
                ));
            }
            Widths::OfGrid(both) => both,
        };
        let along = match reader.get(view, "along") {
            Some(field) => reader.choice(&field, AXES_OF_PLAN, &[]),
            None => {
                let or_ends = match view.sections().contains(&Section::BraceEnds) {
                    true => "; or from and to, the joints of one brace",
                    false => "",
                };
                let remedy = format!(
                    "add along = \"x\" or along = \"y\", the direction of its bays{or_ends}"
                );
                reader.missing(view, "along", remedy);
                None
            }
        };
        let along = match along? {
            "x" => PlanAxis::X,
            _ => PlanAxis::Y,
        };
        let most = |axis: PlanAxis| both[axis.index()].len() + usize::from(axis != along);
        let x = range(reader, view, "x", most(PlanAxis::X));
        let y = range(reader, view, "y", most(PlanAxis::Y));
        let (x, y) = (x?, y?);
        let (bays, lines) = match along {
            PlanAxis::X => (x, y),
            PlanAxis::Y => (y, x),
        };
        let numbers = lines[0]..=lines[1];
        let found = numbers.flat_map(|number| {
            let line = Some(GridLine { along, number });
            (bays[0]..=bays[1]).map(move |bay| (line, bay))
        });
        Some((found.collect(), view.has("x") && view.has("y")))
    }
}

/// Bays, each with its line of a grid, and whether a table names every one.
type NamedBays = (Vec<(Option<GridLine>, usize)>, bool);

/// Force per elongation of what stands in a bay, from its place and its diagonal \[N/m; m\]; `None` after a fault.
pub(super) type Stiffness<'a> = dyn Fn(DiagonalPlace, f64) -> Option<f64> + 'a;

/// Reads the braces of a frame.
pub(super) fn read_all(reader: &mut Reader<'_>, view: &View<'_>, bays: Bays<'_>) -> Vec<Diagonal> {
    let mut braces: Vec<Diagonal> = Vec::new();
    for entry in tables(reader, view, "brace") {
        let found = read(reader, &entry, bays);
        add(reader, &entry, found.unwrap_or_default(), &mut braces);
    }
    braces
}

/// The tables of a list `[[building.key]]`.
pub(super) fn tables<'n>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    key: &'static str,
) -> Vec<Field<'n>> {
    let Some(field) = reader.get(view, key) else {
        return Vec::new();
    };
    field.entries().unwrap_or_else(|| {
        let found = field.node.describe();
        *reader.bad(&field, format!("expected a list of tables, found {found}")) = Some(format!(
            "write [[building.{key}]] with double brackets; in JSON \"{key}\": [{{ … }}]"
        ));
        Vec::new()
    })
}

/// Adds diagonals of a table to those of tables before; two in one place are a fault.
pub(super) fn add(
    reader: &mut Reader<'_>,
    entry: &Field<'_>,
    found: Vec<Diagonal>,
    all: &mut Vec<Diagonal>,
) {
    let twice = found
        .iter()
        .find(|diagonal| all.iter().any(|known| known.place == diagonal.place));
    if let Some(twice) = twice {
        *reader.bad(entry, format!("gives {} a second time", twice.place)) =
            Some("leave it out here, or name other storeys and bays".into());
        return;
    }
    all.extend(found);
}

fn read(reader: &mut Reader<'_>, entry: &Field<'_>, bays: Bays<'_>) -> Option<Vec<Diagonal>> {
    let view = reader.open(entry, bays.sections(DiagonalKind::Brace))?;
    let rises = match reader.get(&view, "direction") {
        Some(field) => match reader.choice(&field, DIRECTIONS, &[])? {
            "both" => &Rise::BOTH[..],
            "down" => &[Rise::Left],
            _ => &[Rise::Right],
        },
        None => &[Rise::Right],
    };
    let mut number = |key, dimension| {
        let field = reader.get(&view, key)?;
        Some(reader.positive(&field, dimension))
    };
    let rigidity = number("EA", Dimension::Force);
    let stiffness = number("stiffness", Dimension::Stiffness);
    let profile = match reader.get(&view, "profile") {
        Some(field) => Some(steel_profile::of_brace(reader, &view, &field)?),
        None => {
            if let Some(field) = reader.get(&view, "axis") {
                *reader.bad(&field, "has no meaning without a profile") =
                    Some("add profile, or remove axis".into());
                return None;
            }
            None
        }
    };
    let rigidity = match (rigidity, stiffness, profile) {
        (None, None, Some(profile)) => Some(Some(profile.modulus * profile.profile.area())),
        _ => rigidity,
    };
    let stiffness_of: &Stiffness<'_> = match (rigidity, stiffness) {
        (Some(_), Some(_)) => {
            let field = reader.get(&view, "EA")?;
            *reader.bad(&field, "and stiffness are both given") =
                Some("leave out one of them: stiffness is EA over the length of the brace".into());
            return None;
        }
        (Some(rigidity), None) => &move |_, length| Some(rigidity? / length),
        (None, Some(stiffness)) => &move |_, _| stiffness,
        (None, None) => {
            reader.missing(
                &view,
                "EA",
                "add EA = \"300 MN\", the modulus of the brace times its area; or a profile; or stiffness = \"45 MN/m\"",
            );
            return None;
        }
    };
    let mut braces = match between(reader, &view, bays)? {
        Some(place) => vec![diagonal(place, stiffness_of(place, bays.length(place))?)],
        None => places(
            reader,
            &view,
            DiagonalKind::Brace,
            rises,
            bays,
            stiffness_of,
        )?,
    };
    if let Some(field) = reader.get(&view, "hinge") {
        const SECTIONS: &[Section] = &[Section::LinkHinge, Section::Buckling];
        let hinge = reader.open(&field, SECTIONS)?;
        let buckles = buckling::asked(reader, &hinge)?;
        for brace in &mut braces {
            // A fault of one is that of all.
            let stiffness = brace.stiffness;
            brace.hysteresis = Some(if buckles {
                let strut = Strut {
                    stiffness,
                    length: bays.length(brace.place),
                    profile,
                };
                buckling::read(reader, &field, &hinge, strut)?
            } else {
                read_spring(reader, &field, SECTIONS, Some(stiffness), Dimension::Force)?
            });
        }
    }
    Some(braces)
}

/// An elastic one from joint to joint.
fn diagonal(place: DiagonalPlace, stiffness: f64) -> Diagonal {
    Diagonal {
        place,
        stiffness,
        hysteresis: None,
        offsets: [0.0; 2],
        across: None,
        damage: None,
    }
}

/// The place of a brace by its two joints: `None` after a fault, `Some(None)` where the table names bays instead.
fn between(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    bays: Bays<'_>,
) -> Option<Option<DiagonalPlace>> {
    const ENDS: [&str; 2] = ["from", "to"];
    if !ENDS.iter().any(|key| view.has(key)) {
        return Some(None);
    }
    let of_bays: &[&'static str] = match bays.widths {
        Widths::OfFrame(_) => &["storeys", "bay", "direction"],
        Widths::OfGrid(_) => &["storeys", "along", "x", "y", "direction"],
    };
    for key in of_bays {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "cannot be combined with from and to") =
                Some(format!("remove {key}, or from and to"));
            return None;
        }
    }
    let ends = ENDS.map(|key| match reader.get(view, key) {
        Some(field) => joint(reader, &field, bays),
        None => {
            let [form, example] = bays.words();
            let remedy = format!("add the other end as {form}, such as {example}");
            reader.missing(view, key, remedy);
            None
        }
    });
    let ([mut low, mut high], field) = ([ends[0]?, ends[1]?], reader.get(view, "to")?);
    if low.0 > high.0 {
        (low, high) = (high, low);
    }
    if low == high {
        *reader.bad(&field, "is the joint at which it begins") = Some("name another joint".into());
        return None;
    }
    if low.0 == high.0 {
        *reader.bad(
            &field,
            format!("is at floor {} as well, whose beams join both", low.0),
        ) = Some("name a joint of another floor".into());
        return None;
    }
    let ([x, y], [to_x, to_y]) = (low.1, high.1);
    // Along the line on which it lies; one that lies on none, along x from its lower end.
    let along = match x == to_x && y != to_y {
        true => PlanAxis::Y,
        false => PlanAxis::X,
    };
    let ([from, to], [own, other]) = match along {
        PlanAxis::X => ([x, to_x], [y, to_y]),
        PlanAxis::Y => ([y, to_y], [x, to_x]),
    };
    let line = GridLine {
        along,
        number: own + 1,
    };
    Some(Some(DiagonalPlace {
        kind: DiagonalKind::Brace,
        line: matches!(bays.widths, Widths::OfGrid(_)).then_some(line),
        storey: low.0 + 1,
        bay: from.min(to) + 1,
        rise: if from <= to { Rise::Right } else { Rise::Left },
        reach: Reach {
            storeys: high.0 - low.0,
            bays: from.abs_diff(to),
            across: other as isize - own as isize,
        },
        strut: StrutLine::Central,
    }))
}

/// A joint by `"FLOOR.LINE"`, or `"FLOOR.X.Y"` in a grid.
fn joint(reader: &mut Reader<'_>, field: &Field<'_>, bays: Bays<'_>) -> Option<Joint> {
    let text = reader.text(field)?;
    let (floors, lines) = (bays.heights.len(), bays.lines());
    let numbers = text.split('.').map(|number| number.trim().parse().ok());
    let numbers: Option<Vec<usize>> = numbers.collect();
    let named = match (bays.widths, numbers.as_deref()) {
        (Widths::OfFrame(_), Some(&[floor, line])) => Some((floor, [line, 1])),
        (Widths::OfGrid(_), Some(&[floor, x, y])) => Some((floor, [x, y])),
        _ => None,
    };
    let exists = |(floor, at): &Joint| {
        let mut both = at.iter().zip(lines);
        *floor <= floors && both.all(|(line, most)| (1..=most).contains(line))
    };
    let Some((floor, at)) = named.filter(exists) else {
        let [form, example] = bays.words();
        let [x, y] = lines;
        let columns = match bays.widths {
            Widths::OfFrame(_) => format!("column lines from 1 to {x}"),
            Widths::OfGrid(_) => {
                format!("lines of lines_x from 1 to {x} and of lines_y from 1 to {y}")
            }
        };
        *reader.bad(field, format!("\"{text}\" is no joint of the frame")) = Some(format!(
            "write {form}, such as {example}: floors from 0, the ground, to {floors}, {columns}"
        ));
        return None;
    };
    let joint = (floor, at.map(|line| line - 1));
    if (bays.has_joint)(joint) {
        return Some(joint);
    }
    let place = |(floor, at): Joint| {
        let [x, y] = bays.at(at);
        [x, y, bays.heights[..floor].iter().sum()]
    };
    let [x, y, height] = place(joint);
    let away = |other: &Joint| {
        let [a, b, c] = place(*other);
        libm::hypot(libm::hypot(a - x, b - y), c - height)
    };
    let crossings = |floor| {
        let across = move |y| (0..lines[0]).map(move |x| (floor, [x, y]));
        (0..lines[1]).flat_map(across)
    };
    let joints = (0..=floors).flat_map(crossings);
    let joints = joints.filter(|other| (bays.has_joint)(*other));
    let nearest = joints.min_by(|a, b| away(a).total_cmp(&away(b)));
    *reader.bad(
        field,
        format!("\"{text}\" has no joint, as no column ends there"),
    ) = nearest.map(|(floor, [x, y])| match bays.widths {
        Widths::OfFrame(_) => format!("the nearest joint is \"{floor}.{}\"", x + 1),
        Widths::OfGrid(_) => format!("the nearest joint is \"{floor}.{}.{}\"", x + 1, y + 1),
    });
    None
}

/// Diagonals that rise these ways in the bays and storeys that a table names; all if it names none. Without bays of its own, it stands
/// only where there are joints.
pub(super) fn places(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    kind: DiagonalKind,
    rises: &[Rise],
    bays: Bays<'_>,
    stiffness: &Stiffness<'_>,
) -> Option<Vec<Diagonal>> {
    let storeys = range(reader, view, "storeys", bays.heights.len());
    let named = bays.named(reader, view);
    let (storeys, (named, names_all)) = (storeys?, named?);
    let mut found = Vec::new();
    for storey in storeys[0]..=storeys[1] {
        for &(line, bay) in &named {
            for &rise in rises {
                let place = DiagonalPlace {
                    kind,
                    line,
                    storey,
                    bay,
                    rise,
                    reach: Reach::BAY,
                    strut: StrutLine::Central,
                };
                // Panels fill bays between columns.
                let columns = (bays.column_rigidity)(place);
                let is_framed = kind == DiagonalKind::Brace || columns.iter().all(Option::is_some);
                let fits = is_framed && (bays.has_joints)(place);
                if !(names_all || fits) {
                    continue;
                }
                found.push(diagonal(place, stiffness(place, bays.length(place))?));
            }
        }
    }
    Some(found)
}
