//! Keys of the records of ETABS text models.

use crate::known::{Kind, Missing};

const LIMITS: Missing = Missing {
    keys: "LIMITCOMPRESSION LIMITTENSION",
    neutral: &[],
    meaning: "limits of tension and compression: members carry both, so that braces for tension alone are too stiff",
};
const ASIDE: Missing = Missing {
    keys: "TRANSFORMSTIFF TRANSSTIFF",
    neutral: &["NO"],
    meaning: "stiffness of members aside of the lines between their joints: jostle's run from joint to joint, so that beams below or above their joints are too soft",
};

/// Records that are read, by their first word.
pub(crate) const KINDS: &[Kind] = &[
    Kind {
        name: "STORY",
        used: "HEIGHT ELEV",
        harmless: "MASTERSTORY SIMILARTO SPLICEABOVE SPLICEHEIGHT COLOR GUID",
        missing: &[],
    },
    Kind {
        name: "DIAPHRAGM",
        used: "TYPE RIGID SEMIRIGID",
        harmless: "COLOR GUID",
        missing: &[],
    },
    Kind {
        name: "MATERIAL",
        used: "E U",
        harmless: "TYPE GRADE WEIGHTPERVOLUME MASSPERVOLUME A G LIGHTWEIGHT LWFACTOR FC FY FU FYE FUE F SSTYPE SSHYSTYPE \
            STRAINATFC ULTSTRAIN STRAINATHARD STRAINATMAX STRAINATRUPTURE FINALSLOPE FANGLE DANGLE TEMP COLOR NOTES GUID \
            HYSTYPE MODALDAMPING VISCCOEFF MASSCOEFF STIFFCOEFF",
        missing: &[Missing {
            keys: "SYMTYPE",
            neutral: &["Isotropic", "Uniaxial"],
            meaning: "materials that are not the same in all directions: jostle's have one modulus, E",
        }],
    },
    Kind {
        name: "FRAMESECTION",
        used: "MATERIAL SHAPE D B TF TW T BB TFB FILLMATERIAL AREA AS2 AS3 TORSION I22 I33 I23 AMOD A2MOD A3MOD JMOD I2MOD I3MOD",
        harmless: "MMOD WMOD S33POS S33NEG S22POS S22NEG S33 S22 Z33 Z22 R33 R22 CGOFFSET3 CGOFFSET2 FILLETRADIUS COLOR NOTES GUID \
            DESIGNTYPE NOTIONALSIZE NOTIONALAUTO FILE PROPERTYFILE ENCASEMENTMATERIAL EMBEDDEDSECTION",
        missing: &[],
    },
    Kind {
        name: "SHELLPROP",
        used: "MATERIAL MODELINGTYPE WALLTHICKNESS F22MOD F12MOD M22MOD M12MOD",
        // A wide column does not deform along its width, nor by shear across it.
        harmless: "PROPTYPE F11MOD M11MOD V13MOD V23MOD MMOD WMOD COLOR NOTES GUID NOTIONALSIZE NOTIONALAUTO INCLUDEAUTOREBAR \
            DRILLDOF RIGIDZONE",
        missing: &[],
    },
    Kind {
        name: "POINT",
        used: "",
        harmless: "GUID",
        missing: &[],
    },
    Kind {
        name: "LINE",
        used: "",
        harmless: "GUID",
        missing: &[],
    },
    Kind {
        name: "AREA",
        used: "",
        harmless: "GUID",
        missing: &[],
    },
    Kind {
        name: "POINTASSIGN",
        used: "RESTRAINT DIAPH DISCONNECTED SPRINGPROP",
        harmless: "FROMAREA USERJOINT GUID LABEL",
        missing: &[Missing {
            keys: "PANELZONE",
            neutral: &["None"],
            meaning: "panel zones: joints of jostle are stiff, so that periods are shorter",
        }],
    },
    Kind {
        name: "LINEASSIGN",
        used: "SECTION ANG RELEASE LENGTHOFFI LENGTHOFFJ RIGIDZONE OFFSETXI OFFSETYI OFFSETXJ OFFSETYJ SPRINGPROP MATERIALOVERWRITE \
            PROPMODA PROPMODA2 PROPMODA3 PROPMODT PROPMODI22 PROPMODI33",
        harmless: "OFFSETZI OFFSETZJ OFFSETSYS LOCAL GLOBAL CARDINALPT PROPMODM PROPMODW MINNUMSTA MAXSTASPC MESH AUTOMESH \
            MESHATINTERSECTIONS MESHATJOINTS MESHMAXLENGTH PIER SPANDREL DESIGNPROC DESIGNTYPE COLOR GUID",
        missing: &[LIMITS, ASIDE],
    },
    Kind {
        name: "AREAASSIGN",
        used: "SECTION DIAPH DISCONNECTED OPENING SPRINGPROP AREATHICKNESSOVERWRITE PROPMODF22 PROPMODF12 PROPMODM22 PROPMODM12",
        harmless: "PROPMODF11 PROPMODM11 PROPMODV13 PROPMODV23 PROPMODM PROPMODW PIER SPANDREL OBJMESHTYPE MESH AUTOMESH ADDRESTRAINT \
            RESTRAINEDGES EDGECONST CARDINALPOINT CARDINALPT ANG MAXMESHSIZE DESIGNPROC COLOR GUID",
        missing: &[Missing {
            keys: "AREAMASS ADDEDMASS",
            neutral: &["0"],
            meaning: "masses of areas: masses come from tables or the .OUT file",
        }],
    },
];
