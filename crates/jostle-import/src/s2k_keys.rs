//! Columns of the tables of SAP2000 text models.

use crate::known::{Kind, Missing};

/// Tables that are read, whose columns are checked.
pub(crate) const KINDS: &[Kind] = &[
    Kind {
        name: "JOINT COORDINATES",
        used: "Joint CoordSys CoordType XorR Y Z GlobalX GlobalY GlobalZ",
        harmless: "SpecialJt GUID",
        missing: &[],
    },
    Kind {
        name: "COORDINATE SYSTEMS",
        used: "Name X Y Z AboutZ AboutY AboutX",
        harmless: "Type",
        missing: &[],
    },
    Kind {
        name: "ACTIVE DEGREES OF FREEDOM",
        used: "",
        harmless: "",
        missing: &[Missing {
            keys: "UX UY UZ RX RY RZ",
            neutral: &["Yes"],
            meaning: "degrees of freedom that the analysis does not have: jostle's building moves along X and Y and turns; --direction x or y gives one in a plane",
        }],
    },
    Kind {
        name: "JOINT RESTRAINT ASSIGNMENTS",
        used: "Joint U1 U2 U3 R1 R2 R3",
        harmless: "",
        missing: &[],
    },
    Kind {
        name: "CONNECTIVITY - FRAME",
        used: "Frame JointI JointJ",
        harmless: "Length CentroidX CentroidY CentroidZ GUID",
        missing: &[Missing {
            keys: "IsCurved",
            neutral: &["No"],
            meaning: "curved members: jostle's are straight between their joints",
        }],
    },
    Kind {
        name: "CONNECTIVITY - AREA",
        used: "Area NumJoints Joint1 Joint2 Joint3 Joint4",
        harmless: "Perimeter AreaArea CentroidX CentroidY CentroidZ GUID",
        missing: &[],
    },
    Kind {
        name: "AREA SECTION ASSIGNMENTS",
        used: "Area Section MatProp",
        harmless: "",
        missing: &[],
    },
    Kind {
        name: "AREA SECTION PROPERTIES",
        used: "Section Material Thickness F22Mod F12Mod M22Mod M12Mod",
        // A wide column does not deform along its width, nor by shear across it.
        harmless: "MatAngle AreaType Type DrillDOF BendThick Arc InComp CoordSys Color TotalWt TotalMass F11Mod M11Mod V13Mod V23Mod \
            MMod WMod GUID Notes",
        missing: &[],
    },
    Kind {
        name: "AREA STIFFNESS MODIFIERS",
        used: "Area f22 f12 m22 m12",
        harmless: "f11 m11 v13 v23 MassMod WeightMod MMod WMod",
        missing: &[],
    },
    Kind {
        name: "AREA THICKNESS OVERWRITES",
        used: "Area Thickness1 Thickness2 Thickness3 Thickness4",
        harmless: "Type ThickType",
        missing: &[],
    },
    Kind {
        name: "FRAME SECTION ASSIGNMENTS",
        used: "Frame AnalSect MatProp",
        harmless: "SectionType AutoSelect DesignSect",
        missing: &[],
    },
    Kind {
        name: "FRAME SECTION PROPERTIES 01 - GENERAL",
        used: "SectionName Material Shape t3 t2 tf tw t2b tfb Area TorsConst I22 I33 I23 AS2 AS3 AMod A2Mod A3Mod JMod I2Mod I3Mod",
        harmless: "S33 S22 Z33 Z22 R33 R22 S33Top S33Bot S22Left S22Right CGOffset3 CGOffset2 EccV2 EccV3 EccV2Top Cw FilletRad \
            ConcCol ConcBeam Color TotalWt TotalMass FromFile FileName SectInFile MMod WMod GUID Notes NotionalSize",
        missing: &[],
    },
    Kind {
        name: "FRAME PROPERTY MODIFIERS",
        used: "Frame AMod AS2Mod AS3Mod JMod I22Mod I33Mod",
        harmless: "MassMod WeightMod",
        missing: &[],
    },
    Kind {
        name: "FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL",
        used: "Frame Angle",
        harmless: "MirrorAbt2 MirrorAbt3",
        missing: &[Missing {
            keys: "AdvanceAxes",
            neutral: &["No"],
            meaning: "local axes by directions or points: sections stand as without them, and may be turned",
        }],
    },
    Kind {
        name: "FRAME RELEASE ASSIGNMENTS 1 - GENERAL",
        used: "Frame PI V2I V3I TI M2I M3I PJ V2J V3J TJ M2J M3J PartialFix",
        harmless: "",
        missing: &[],
    },
    Kind {
        name: "FRAME OFFSET ALONG LENGTH ASSIGNMENTS",
        used: "Frame Type LengthI LengthJ RigidFactor",
        harmless: "RigidFact SelfWtMass WeightMass",
        missing: &[],
    },
    Kind {
        name: "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES",
        used: "Material E1 U12 G12",
        harmless: "UnitWeight UnitMass G13 G23 E2 E3 U13 U23 A1 A2 A3 Temp",
        missing: &[],
    },
    Kind {
        name: "CONSTRAINT DEFINITIONS - DIAPHRAGM",
        used: "Name Axis MultiLevel",
        harmless: "CoordSys",
        missing: &[],
    },
    Kind {
        name: "JOINT CONSTRAINT ASSIGNMENTS",
        used: "Joint Constraint",
        harmless: "Type",
        missing: &[],
    },
    Kind {
        name: "JOINT ADDED MASS ASSIGNMENTS",
        used: "Joint Mass1 Mass2 MMI3",
        harmless: "CoordSys Mass3 MMI1 MMI2",
        missing: &[],
    },
];

/// Tables that are read, whose columns need no check.
pub(crate) const READ: &[&str] = &[
    "PROGRAM CONTROL",
    "MASS SOURCE",
    "MASSES 1 - MASS SOURCE",
    "FRAME ADDED MASS ASSIGNMENTS",
    "AREA ADDED MASS ASSIGNMENTS",
    "JOINT ADDED MASS BY WEIGHT ASSIGNMENTS",
    "JOINT ADDED MASS BY VOLUME ASSIGNMENTS",
    "FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY",
    "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED",
    "JOINT SPRING ASSIGNMENTS 2 - COUPLED",
    "FRAME SPRING ASSIGNMENTS",
    "AREA SPRING ASSIGNMENTS",
];

/// Beginnings of names of tables without effect on stiffness, geometry and mass.
pub(crate) const HARMLESS: &[&str] = &[
    "OPTIONS",
    "PREFERENCES",
    "PROJECT INFORMATION",
    "DATABASE",
    "GRID LINES",
    "GROUPS",
    "REBAR SIZES",
    "FUNCTION",
    "OVERWRITES",
    "MATERIAL PROPERTIES 01",
    "MATERIAL PROPERTIES 03",
    "MATERIAL PROPERTIES 04",
    "MATERIAL PROPERTIES 05",
    "FRAME OUTPUT STATION",
    "FRAME AUTO MESH",
    "FRAME DESIGN PROCEDURES",
    "AREA AUTO MESH",
    "AREA EDGE CONSTRAINT",
    "JOINT PATTERN",
    "NAMED",
    "TABLE",
];
