//! What moves as a weighted sum of displacements is a `Row`: no other type holds such sums.

use std::collections::BTreeSet;
use std::path::Path;

use jostle_testkit::imports::collect;

/// Types that hold indices with shares, and why they are no rows.
const ALLOWED: [(&str, &str); 17] = [
    ("linear/row.rs: Terms", "the row itself"),
    (
        "statics/equilibrium_path.rs: EquilibriumPath",
        "one displacement and the stiffness that holds it",
    ),
    (
        "stepping/modal/member_ratios.rs: FormRow",
        "all modes of a building: a full list",
    ),
    (
        "stepping/modal/members.rs: Passed",
        "all modes of a building: a full list",
    ),
    (
        "stepping/modal/ports/path.rs: Path",
        "coefficients of a polynomial of time",
    ),
    (
        "stepping/modal/plan_rows.rs: PlanRow",
        "on its way to strips of registers",
    ),
    (
        "structure/inner_link.rs: LinkEnd",
        "a force along, across and about an axis, without displacements",
    ),
    (
        "structure/space_frame.rs: Deformation",
        "over unknowns that are no displacements of nodes yet",
    ),
    (
        "structure/storey_forces.rs: Storey",
        "over forces of springs and links, two at once",
    ),
    (
        "system/limited_ends.rs: PlasticRotation",
        "over deformations and forces of springs, two at once",
    ),
    (
        "system/soil.rs: Between",
        "displacements and rotations of two foundations",
    ),
    (
        "transfer/elementwise.rs: KeptFloor",
        "a beam and the scale of its equation",
    ),
    (
        "transfer/riccati.rs: TangentPlace",
        "a product of two shares",
    ),
    ("interface/friction.rs: PushedFloor", "two lever arms"),
    ("model/members.rs: JointRequest", "lever arms of two beams"),
    (
        "results/in_plan.rs: FacePoints",
        "how a face shares its force among its points",
    ),
    ("simd.rs: WeightedSquare", "a sum of squares in registers"),
];

#[test]
fn no_other_type_holds_displacements_with_shares() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    let mut found = BTreeSet::new();
    for file in files {
        let inside = file.strip_prefix(&root).expect("it was found there");
        let text = std::fs::read_to_string(&file).expect("a source file can be read");
        let types = types_with_shares(&text);
        found.extend(types.map(|name| format!("{}: {name}", inside.display())));
    }
    let allowed: BTreeSet<String> = ALLOWED.iter().map(|(name, _)| (*name).to_owned()).collect();
    let more: Vec<_> = found.difference(&allowed).collect();
    assert!(
        more.is_empty(),
        "make these a `Row`, or say why not: {more:?}"
    );
    let gone: Vec<_> = allowed.difference(&found).collect();
    assert!(gone.is_empty(), "these are no longer there: {gone:?}");
}

#[test]
fn pairs_and_lists_of_shares_are_recognised() {
    let text = "struct One {\n    at: Vec<(usize, f64)>,\n}\nenum Two {\n    A([(Place, f64); 3]),\n}\n\
                struct Three {\n    dof: usize,\n    pub shares: [f64; 2],\n}\ntype Four = Vec<(Unknown, f64)>;\n\
                struct Five {\n    row: Row,\n    force: f64,\n}\nfn six(of: &[(usize, f64)]) {}\n";
    let found: Vec<&str> = types_with_shares(text).collect();
    assert_eq!(found, ["One", "Two", "Three", "Four"]);
}

/// Names of the types of a source file that hold pairs of an index and a share, or a list of shares.
fn types_with_shares(text: &str) -> impl Iterator<Item = &str> {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or("");
    let mut found: Vec<&str> = Vec::new();
    let mut inside: Option<&str> = None;
    for line in code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
    {
        if !line.starts_with([' ', ')', '}']) {
            inside = type_named(line);
        }
        if let Some(name) = inside.filter(|_| holds_shares(line))
            && found.last() != Some(&name)
        {
            found.push(name);
        }
    }
    found.into_iter()
}

fn type_named(line: &str) -> Option<&str> {
    let mut words = line.split(|letter: char| !(letter.is_alphanumeric() || letter == '_'));
    words.find(|word| ["struct", "enum", "type"].contains(word))?;
    words.find(|word| !word.is_empty())
}

fn holds_shares(line: &str) -> bool {
    let pair = ["usize", "u32", "Place", "Unknown", "(usize, usize)"]
        .iter()
        .any(|index| {
            line.contains(&format!("({index}, f64)")) || line.contains(&format!("({index}, [f64"))
        });
    let named = line.trim_start().split(": ").next().unwrap_or("");
    let name = named.rsplit(' ').next().unwrap_or("");
    let listed = ["shares", "weights", "levers", "coefficients"].contains(&name);
    pair || listed && line.contains("f64")
}
