//! Cross-sections of columns and beams, and the material they are made of.

use jostle::Section;
use jostle_section::formula::Member;
use jostle_section::{STEEL_DENSITY, Span, StrengthLevel};

use super::places::{self, Layout};
use super::slab::{self, OnSlab};
use super::steel_profile;
use crate::grade::ConcreteGrade;
use crate::keys::{CONCRETES, SECTION_CONCRETES};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Modulus of elasticity of the concrete grades C20 … C80 \[GPa\] (GB 50010, table 4.1.5).
const CONCRETE_MODULI: [f64; 13] = [
    25.5, 28.0, 30.0, 31.5, 32.5, 33.5, 34.5, 35.5, 36.0, 36.5, 37.0, 37.5, 38.0,
];

/// Material and cracking factor of columns or beams.
#[derive(Clone, Copy)]
pub(super) struct Material {
    /// Modulus of elasticity; `None` if the file has none \[Pa\].
    pub(super) modulus: Option<f64>,
    /// Whether the building states a modulus in numbers, which then holds for members of any concrete.
    pub(super) modulus_is_stated: bool,
    /// Whether a fault of the modulus was noted.
    pub(super) modulus_is_bad: bool,
    /// Density of columns; beams weigh nothing by themselves \[kg/m³\].
    pub(super) density: f64,
    /// Factor on every EI \[–\].
    pub(super) factor: f64,
    /// Whether shear deforms the member.
    pub(super) shears: bool,
    /// ν, of G = E/(2(1 + ν)) \[–\].
    pub(super) poisson_ratio: f64,
}

/// Stands in after a fault.
pub(super) const STAND_IN: Section = Section {
    flexural_rigidity: 1.0,
    axial_rigidity: Some(1.0),
    shear_rigidity: None,
    line_mass: 1.0,
};

/// Reads the modulus; also returns whether there is one that could not be read.
pub(super) fn read_modulus(reader: &mut Reader<'_>, view: &View<'_>) -> (Option<f64>, bool) {
    let modulus = reader.get(view, "elastic_modulus");
    let concrete = reader.get(view, "concrete");
    let stated = modulus.is_some() || concrete.is_some();
    if let (Some(_), Some(concrete)) = (&modulus, &concrete) {
        *reader.bad(concrete, "cannot be combined with elastic_modulus") =
            Some("keep either concrete or elastic_modulus".into());
    }
    let value = match (modulus, concrete) {
        (Some(field), _) => reader.positive(&field, Dimension::Modulus),
        (None, Some(field)) => reader
            .concrete_name(&field, CONCRETES)
            .and_then(modulus_of_grade),
        (None, None) => None,
    };
    (value, stated && value.is_none())
}

/// The same beside bars, whose concrete `concrete` names: `elastic_modulus` decides where both are stated. Faults of the concrete are
/// noted where the bars are read.
pub(super) fn read_modulus_beside_bars(
    reader: &mut Reader<'_>,
    view: &View<'_>,
) -> (Option<f64>, bool) {
    if let Some(field) = reader.get(view, "elastic_modulus") {
        let modulus = reader.positive(&field, Dimension::Modulus);
        return (modulus, modulus.is_none());
    }
    let Some(field) = reader.get(view, "concrete") else {
        return (None, false);
    };
    let grade = reader.quietly(|reader| reader.concrete(&field, SECTION_CONCRETES));
    let modulus = grade.and_then(modulus_of_grade);
    (modulus, modulus.is_none())
}

/// E of a grade: of GB 50010 up to C80, of EN 1992-1-1 or of ACI 318 \[Pa\].
fn modulus_of_grade(grade: ConcreteGrade) -> Option<f64> {
    if let ConcreteGrade::Named(name) = grade {
        let index = CONCRETES.iter().position(|known| *known == name)?;
        if let Some(gigapascals) = CONCRETE_MODULI.get(index) {
            return Some(1e9 * gigapascals);
        }
    }
    let concrete = grade.at(StrengthLevel::Characteristic);
    concrete.map(|concrete| concrete.modulus)
}

/// What a table gives its members: one section, or for beams with a slab one for each span.
#[derive(Clone, Copy)]
pub(super) struct OfTable {
    section: Section,
    slab: Option<OnSlab>,
    /// Size in the direction of bending, if the table gives one \[m\].
    pub(super) depth: Option<f64>,
}

impl OfTable {
    /// The section in a span; columns have none.
    pub(super) fn at(&self, span: Option<Span>) -> Section {
        match (self.slab, span) {
            (Some(slab), Some(span)) => slab.with(self.section, span),
            _ => self.section,
        }
    }
}

/// Sections of the tables of columns or beams: `None` of a table that omits its places, `STAND_IN` after a fault.
pub(super) fn read_sections(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    member: Member,
    layout: Option<&Layout<'_>>,
    material: Material,
) -> Vec<Option<OfTable>> {
    let Some(layout) = layout else {
        let key = if member == Member::Column {
            "column"
        } else {
            "beam"
        };
        reader.missing(
            view,
            key,
            format!("add {key} = {{ width = \"300 mm\", depth = \"600 mm\" }}"),
        );
        return Vec::new();
    };
    let tables = layout.tables.iter();
    let sections = tables.map(|table| {
        if table.omits {
            // Its keys are checked all the same.
            reader.open(&table.field, places::sections(member));
            return None;
        }
        let section = read_section(reader, &table.field, member, material);
        Some(section.unwrap_or(OfTable {
            section: STAND_IN,
            slab: None,
            depth: None,
        }))
    });
    sections.collect()
}

fn read_section(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    member: Member,
    material: Material,
) -> Option<OfTable> {
    let view = reader.open(field, places::sections(member))?;
    let material = of_own_concrete(reader, &view, material);
    let by_rigidity = view.has("EI") || view.has("EA") || view.has("GA");
    let by_size = view.has("width") || view.has("depth");
    let (mut density, mut factor) = (material.density, material.factor);
    let mut section = match (by_size, by_rigidity, reader.get(&view, "profile")) {
        (false, false, Some(field)) => {
            // Steel does not crack, whatever concrete does.
            (density, factor) = (STEEL_DENSITY, 1.0);
            steel_profile::read(reader, &view, &field, material)
        }
        (_, _, Some(field)) => {
            *reader.bad(&field, "is given together with a size or rigidities") =
                Some("keep either profile, or width and depth, or EI, EA and GA".into());
            None
        }
        (true, true, None) => {
            *reader.bad(field, "has both a size and rigidities") =
                Some("keep either width and depth, or EI, EA and GA".into());
            None
        }
        (false, true, None) => rigidities(reader, &view, material.shears),
        _ => rectangle(reader, &view, material, SIDES),
    };
    if !view.has("profile")
        && let Some(field) = reader.get(&view, "axis")
    {
        *reader.bad(&field, "is for a profile") =
            Some("leave it out: depth is in the direction of bending".into());
    }
    if let Some(section) = &mut section {
        section.flexural_rigidity *= factor;
    }
    let depth = depth_of(reader, &view);
    if member == Member::Beam {
        let slab = match reader.get(&view, "slab") {
            Some(field) => Some(slab::read(reader, &view, &field, material)?),
            None => None,
        };
        let section = Section {
            line_mass: 0.0,
            ..section?
        };
        return Some(OfTable {
            section,
            slab,
            depth,
        });
    }
    let stated = reader.get(&view, "mass");
    let mass = match stated {
        Some(field) => reader.quantity(&field, Dimension::LineMass),
        None => own_mass(
            reader,
            &view,
            section,
            by_rigidity,
            Material {
                density,
                ..material
            },
        ),
    };
    let section = Section {
        line_mass: mass?,
        ..section?
    };
    Some(OfTable {
        section,
        slab: None,
        depth,
    })
}

/// Size of a rectangle or a profile in the direction of bending. Faults are noted where the section is read.
pub(super) fn depth_of(reader: &mut Reader<'_>, view: &View<'_>) -> Option<f64> {
    reader.quietly(|reader| match reader.get(view, "profile") {
        Some(field) => steel_profile::depth(reader, view, &field),
        None => {
            let field = reader.get(view, "depth")?;
            reader.positive(&field, Dimension::Length)
        }
    })
}

/// The material of a member that names its own concrete.
fn of_own_concrete(reader: &mut Reader<'_>, view: &View<'_>, material: Material) -> Material {
    let Some(field) = reader.get(view, "concrete") else {
        return material;
    };
    // Faults are noted where the reinforcement is read.
    let grade = reader.quietly(|reader| reader.concrete(&field, SECTION_CONCRETES));
    let characteristic = grade.and_then(|grade| grade.at(StrengthLevel::Characteristic));
    let modulus = characteristic.map(|concrete| concrete.modulus);
    Material {
        modulus: material
            .modulus
            .filter(|_| material.modulus_is_stated)
            .or(modulus)
            .or(material.modulus),
        modulus_is_bad: material.modulus_is_bad || characteristic.is_none(),
        ..material
    }
}

/// Keys of the width and the depth of a rectangle, with examples.
pub(super) type Sides = [(&'static str, &'static str); 2];

/// Of columns and beams.
const SIDES: Sides = [("width", "\"300 mm\""), ("depth", "\"600 mm\"")];

/// Width × depth, of one material. The line mass is that of the density.
pub(super) fn rectangle(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    material: Material,
    sides: Sides,
) -> Option<Section> {
    let names = sides.map(|(key, _)| key).join(" and ");
    let mut side = |(key, example): (&'static str, &str)| match reader.get(view, key) {
        Some(field) => reader.positive(&field, Dimension::Length),
        None => {
            reader.missing(
                view,
                key,
                format!("add {key} = {example}, or give EI instead of {names}"),
            );
            None
        }
    };
    let (width, depth) = (side(sides[0]), side(sides[1]));
    let Some(modulus) = material.modulus else {
        if !material.modulus_is_bad {
            let place = view.span.clone();
            *reader.fault(&place, view.path.clone(), "needs a modulus of elasticity") = Some(
                "add elastic_modulus = \"30 GPa\" or concrete = \"C30\" to the building".into(),
            );
        }
        return None;
    };
    let (width, depth) = (width?, depth?);
    let area = width * depth;
    Some(Section {
        flexural_rigidity: modulus * area * depth * depth / 12.0,
        axial_rigidity: Some(modulus * area),
        // 5/6 of a rectangle resists shear.
        shear_rigidity: material
            .shears
            .then(|| 5.0 / 6.0 * area * modulus / (2.0 * (1.0 + material.poisson_ratio))),
        line_mass: material.density * area,
    })
}

pub(super) fn rigidities(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    shears: bool,
) -> Option<Section> {
    let bending = match reader.get(view, "EI") {
        Some(field) => reader.positive(&field, Dimension::FlexuralRigidity),
        None => {
            reader.missing(
                view,
                "EI",
                "add EI = \"150 MN.m2\" beside EA and GA, or give width and depth instead",
            );
            None
        }
    };
    let mut force = |key: &'static str| {
        reader
            .get(view, key)
            .map(|field| reader.positive(&field, Dimension::Force))
    };
    let (axial, shear) = (force("EA"), force("GA"));
    if shears && shear.is_none() {
        reader.missing(
            view,
            "GA",
            "shear = \"flexible\" needs the shear rigidity: add GA = \"2.6 GN\", give the size of the section instead, or set shear = \"rigid\"",
        );
    }
    Some(Section {
        flexural_rigidity: bending?,
        axial_rigidity: match axial {
            Some(rigidity) => Some(rigidity?),
            None => None,
        },
        shear_rigidity: match shear {
            Some(rigidity) => Some(rigidity?).filter(|_| shears),
            None => None,
        },
        line_mass: 0.0,
    })
}

/// Self mass of a column that does not state it: of the rectangle, or of the area EA/E.
pub(super) fn own_mass(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    section: Option<Section>,
    by_rigidity: bool,
    material: Material,
) -> Option<f64> {
    let section = section?;
    if !by_rigidity {
        return Some(section.line_mass);
    }
    if material.density == 0.0 {
        return Some(0.0);
    }
    if let (Some(axial), Some(modulus)) = (section.axial_rigidity, material.modulus) {
        return Some(material.density * axial / modulus);
    }
    if !material.modulus_is_bad {
        reader.missing(
            view,
            "mass",
            "what is given by EI needs its mass: add mass = \"1500 kg/m\" (0 is possible), or EA here and elastic_modulus in the building",
        );
    }
    None
}
