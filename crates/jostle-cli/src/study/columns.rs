//! Names of columns by their owners, so that those of many floors take one line.

/// Runs of columns of one owner.
struct Owned<'a> {
    owners: Vec<&'a str>,
    quantities: Vec<&'a str>,
}

/// Lines of names that follow each other, by what stands before their last dot; owners that differ in numbers only, and have
/// the same quantities, share one.
pub(super) fn by_owner(names: &[&str]) -> String {
    let mut all: Vec<Owned<'_>> = Vec::new();
    for name in names {
        let (owner, quantity) = name.rsplit_once('.').unwrap_or(("", name));
        match all.last_mut().filter(|last| last.owners == [owner]) {
            Some(last) => last.quantities.push(quantity),
            None => all.push(Owned {
                owners: vec![owner],
                quantities: vec![quantity],
            }),
        }
    }
    all.dedup_by(|next, last| {
        let is_alike = without_digits(next.owners[0]) == without_digits(last.owners[0])
            && next.quantities == last.quantities;
        if is_alike {
            last.owners.append(&mut next.owners);
        }
        is_alike
    });
    let lines = all.iter().map(|group| {
        let quantities = group.quantities.join(", ");
        match group.owners[..] {
            [""] => format!("  {quantities}"),
            [owner] => format!("  {owner}: {quantities}"),
            [first, .., last] => format!("  {first} … {last}: {quantities}"),
            [] => String::new(),
        }
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn without_digits(text: &str) -> String {
    text.chars().filter(|c| !c.is_ascii_digit()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floors_share_a_line() {
        let names = [
            "case",
            "gap_m",
            "A.drift",
            "A.floor1.u",
            "A.floor1.v",
            "A.floor2.u",
            "A.floor2.v",
            "B.drift",
            "B.floor1.u",
            "steps",
        ];
        assert_eq!(
            by_owner(&names),
            "  case, gap_m\n  A: drift\n  A.floor1 … A.floor2: u, v\n  B: drift\n  B.floor1: u\n  steps"
        );
    }
}
