//! Model files as texts.

/// The text of two elastic shear buildings 20 mm apart, as a literal for `concat!`: A of storeys of 40 t and 20 MN/m, B of
/// storeys of 60 t and 90 MN/m, so many each.
#[macro_export]
macro_rules! two_towers {
    (2, 2) => {
        $crate::two_towers!(@ r#""40 t", "40 t""#, r#""20 MN/m", "20 MN/m""#)
    };
    (3, 2) => {
        $crate::two_towers!(@ r#""40 t", "40 t", "40 t""#, r#""20 MN/m", "20 MN/m", "20 MN/m""#)
    };
    (@ $mass:literal, $stiffness:literal) => {
        concat!(
            "[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = [",
            $mass,
            "]\nstiffness = [",
            $stiffness,
            r#"]
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
mass = ["60 t", "60 t"]
stiffness = ["90 MN/m", "90 MN/m"]
storey_height = "3 m"
[[gap]]
between = ["A", "B"]
width = "20 mm"
"#
        )
    };
}
