//! Writes `docs/validation.md` and the pages in `docs/validation`, or only compares every number.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use jostle_io::write_atomically;
use jostle_validation::bits::Comparison;
use jostle_validation::certify::record::{self, Record};
use jostle_validation::{
    Extent, batches, bits, certify, document, families, harmonic, loops, misses, pairs, paper,
    work_precision,
};

const USAGE: &str = "\
usage: jostle-validation [--full] [--check] [--reference] [--pairs [FIRST LAST [TOLERANCE]]] [--work-precision] [--figures] [--harmonic]
  --full        small steps as well; takes minutes
  --check       writes nothing; exits with 1 if a number misses
  --family T    prints every comparison of the family with that title
  --pairs       compares automatic with uniform steps on random pairs of buildings, by default seeds 1 to 1000, and prints
                the distribution of the errors; takes minutes
  --work-precision  writes docs/work-precision.md and its figure; takes minutes
  --figures     writes the figure of the contact laws
  --harmonic    writes docs/harmonic-pounding.md and its figures; takes minutes
  --certify N [--family NAME] [--seed S] [--only K] [--json FILE]  holds every promised number of N random models against a reference of
                other means; FILE gets every ratio
  --batches PAIRS ROWS [--seed S] [--page]  compares batches of random rows with the standard solvers, and measures their speed
  --certify-report FILE …  writes the tables of docs/certify.md and its figure from such files: those of families, those of others, or both
  --certify-dump K FOLDER [--family NAME] [--seed S]  writes random model K as a model file, with its record if it has one of its own
  --certify-file FILE [TOLERANCE …]  prints the reference of a model file, and how far both solvers are from it
  --bits [FAMILY …] [--write]  compares the results of many models with those on record, number by number, or records them
  --reference   makes the reference runs of the built-in model anew; takes minutes";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.first().is_some_and(|a| a == "--pairs") {
        return random_pairs(&arguments[1..]);
    }
    if arguments.first().is_some_and(|a| a == "--batches") {
        return batched(&arguments[1..]);
    }
    if arguments.first().is_some_and(|a| a == "--certify-report") {
        return certify_report(&arguments[1..]);
    }
    if arguments
        .first()
        .is_some_and(|a| a.starts_with("--certify"))
    {
        return certified(&arguments);
    }
    if let [option, title] = &arguments[..]
        && option == "--family"
    {
        return one_family(title);
    }
    if arguments.first().is_some_and(|a| a == "--bits") {
        return bits_of(&arguments[1..]);
    }
    if arguments.first().is_some_and(|a| a == "--work-precision") {
        let ways = work_precision::study();
        let figure = in_crate("../../docs/figures/work-precision.svg");
        if written(&figure, &work_precision::figure(&ways)) == ExitCode::FAILURE {
            return ExitCode::FAILURE;
        }
        return written(
            &in_crate("../../docs/work-precision.md"),
            &work_precision::page(&ways),
        );
    }
    if arguments.first().is_some_and(|a| a == "--figures") {
        return written(
            &in_crate("../../docs/figures/contact-loops.svg"),
            &loops::figure(),
        );
    }
    if arguments.first().is_some_and(|a| a == "--harmonic") {
        let study = harmonic::study();
        for (name, text) in [
            ("figures/harmonic-speed.svg", harmonic::speed_figure(&study)),
            (
                "figures/harmonic-poincare.svg",
                harmonic::section_figure(&study),
            ),
            ("harmonic-pounding.md", harmonic::page(&study)),
        ] {
            if written(&in_crate("../../docs").join(name), &text) == ExitCode::FAILURE {
                return ExitCode::FAILURE;
            }
        }
        return ExitCode::SUCCESS;
    }
    let asked = |option: &str| arguments.iter().any(|argument| argument == option);
    if let Some(unknown) = arguments
        .iter()
        .find(|a| !["--full", "--check", "--reference"].contains(&a.as_str()))
    {
        say(&format!("unknown option {unknown}\n{USAGE}"));
        return ExitCode::from(2);
    }
    if asked("--reference") {
        let reference =
            serde_json::to_string_pretty(&paper::reference()).unwrap_or_default() + "\n";
        return written(&in_crate("data/paper/reference.json"), &reference);
    }
    let extent = if asked("--full") {
        Extent::Full
    } else {
        Extent::Reduced
    };
    let families = families(extent);
    for (family, row) in misses(&families) {
        say(&document::missed_line(family, row));
    }
    let compared: usize = families.iter().map(|family| family.rows.len()).sum();
    say(&format!(
        "{compared} numbers compared, {} miss",
        misses(&families).count()
    ));
    if !asked("--check") {
        let folder = in_crate("../../docs/validation");
        let mut pages = vec![(
            folder.with_extension("md"),
            document::page(&families, extent),
        )];
        pages.extend(families.iter().map(|family| {
            (
                folder.join(document::file_name(family)),
                document::family_page(family),
            )
        }));
        for (page, text) in &pages {
            if written(page, text) == ExitCode::FAILURE {
                return ExitCode::FAILURE;
            }
        }
    }
    if misses(&families).next().is_some() {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    }
}

/// Prints every comparison of one family.
fn one_family(title: &str) -> ExitCode {
    let Some(family) = jostle_validation::family(title, Extent::Reduced) else {
        say(&format!("no family is called {title}"));
        return ExitCode::from(2);
    };
    for row in &family.rows {
        say(&format!(
            "{} {}: {}: expected {:e}, got {:e}, error {:.2e}",
            if row.misses() { "MISS" } else { "ok  " },
            row.source,
            row.quantity,
            row.expected,
            row.got,
            row.error
        ));
    }
    if family.rows.iter().any(jostle_validation::row::Row::misses) {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    }
}

/// Compares the results of many models with those on record, or records them.
fn bits_of(arguments: &[String]) -> ExitCode {
    let folder = in_crate("data/pins");
    let (options, families): (Vec<String>, Vec<String>) = arguments
        .iter()
        .cloned()
        .partition(|argument| argument.starts_with("--"));
    let write = options.iter().any(|option| option == "--write");
    if options.iter().any(|option| option != "--write") {
        say(USAGE);
        return ExitCode::from(2);
    }
    if write {
        return match bits::record(&folder, &families) {
            Ok(bytes) => {
                say(&format!("recorded {bytes} bytes in {}", folder.display()));
                ExitCode::SUCCESS
            }
            Err(why) => {
                say(&why);
                ExitCode::FAILURE
            }
        };
    }
    match bits::compare(&folder, &families) {
        Err(why) => {
            say(&why);
            ExitCode::FAILURE
        }
        Ok(Comparison {
            results,
            values,
            moved,
        }) if moved.is_empty() => {
            say(&format!(
                "{values} values of {results} results, every bit as recorded"
            ));
            ExitCode::SUCCESS
        }
        Ok(Comparison { results, moved, .. }) => {
            for change in &moved {
                say(&change.to_string());
            }
            say(&format!("{} of {results} results moved", moved.len()));
            ExitCode::FAILURE
        }
    }
}

fn random_pairs(arguments: &[String]) -> ExitCode {
    let number = |index: usize, usual: f64| match arguments.get(index) {
        Some(text) => text.parse().ok(),
        None => Some(usual),
    };
    let (Some(first), Some(last), Some(tolerance)) =
        (number(0, 1.0), number(1, 1000.0), number(2, 1e-3))
    else {
        say(USAGE);
        return ExitCode::from(2);
    };
    let compared = pairs::study(first as u64..=last as u64, tolerance);
    for pair in &compared {
        say(&format!("{pair:?}"));
    }
    say(&pairs::describe(&compared, tolerance));
    ExitCode::SUCCESS
}

/// Random models against their reference, or one of them as a file.
fn certified(arguments: &[String]) -> ExitCode {
    let after = |option: &str| {
        let place = arguments.iter().position(|a| a == option)?;
        arguments.get(place + 1)
    };
    let number = |option: &str| after(option).and_then(|text| text.parse::<u64>().ok());
    let seed = number("--seed").unwrap_or(1);
    if let Some(path) = after("--certify-file") {
        let asked: Vec<f64> = arguments[2..]
            .iter()
            .filter_map(|a| a.parse().ok())
            .collect();
        let tolerances = if asked.is_empty() {
            &certify::TOLERANCES[..]
        } else {
            &asked
        };
        return match certify::of_file(Path::new(path), tolerances) {
            Ok(text) => {
                say(&text);
                ExitCode::SUCCESS
            }
            Err(why) => {
                say(&why);
                ExitCode::FAILURE
            }
        };
    }
    let family = match after("--family").map(|name| (name, certify::Family::named(name))) {
        None => None,
        Some((_, Some(family))) => Some(family),
        Some((name, None)) => {
            let names = certify::FAMILIES.map(|family| family.name).join(", ");
            say(&format!("there is no family {name}; give one of {names}"));
            return ExitCode::from(2);
        }
    };
    if let Some(model) = number("--certify-dump") {
        let Some(folder) = arguments.get(2) else {
            say(USAGE);
            return ExitCode::from(2);
        };
        let drawn = match family {
            Some(family) => family.model(seed, model),
            None => certify::draw(seed, model),
        };
        let text = serde_json::to_string_pretty(&drawn.tree).unwrap_or_default();
        if let (Some(pulse), Some(name)) = (drawn.pulse, drawn.tree["motion"]["record"].as_str()) {
            let record = Path::new(folder).join(name);
            if written(&record, &pulse.text()) == ExitCode::FAILURE {
                return ExitCode::FAILURE;
            }
        }
        return written(
            &Path::new(folder).join(format!("seed{seed}_model{model}.json")),
            &(text + "\n"),
        );
    }
    let Some(count) = number("--certify") else {
        say(USAGE);
        return ExitCode::from(2);
    };
    let all = certify::study(
        family,
        count,
        seed,
        number("--only"),
        &certify::every_run(family, &certify::TOLERANCES),
    );
    say(&certify::describe(&all));
    let records = [Record::new(seed, &all)];
    say(&record::closing_text(&records));
    let Some(path) = after("--json") else {
        return ExitCode::SUCCESS;
    };
    match serde_json::to_string(&records[0]) {
        Ok(text) => written(Path::new(path), &(text + "\n")),
        Err(error) => {
            say(&error.to_string());
            ExitCode::FAILURE
        }
    }
}

/// Tables and figure of certified runs.
/// `--batches PAIRS ROWS [--seed S] [--page]`.
fn batched(arguments: &[String]) -> ExitCode {
    let number = |at: usize| {
        arguments
            .get(at)
            .and_then(|argument| argument.parse::<u64>().ok())
    };
    let seed = arguments.iter().position(|argument| argument == "--seed");
    let seed = seed.map_or(Some(1), |at| number(at + 1));
    let (Some(pairs), Some(rows), Some(seed)) = (number(0), number(1), seed) else {
        say(&format!(
            "--batches PAIRS ROWS [--seed S] [--page]\n{USAGE}"
        ));
        return ExitCode::from(2);
    };
    let folder = std::env::temp_dir().join(format!("jostle-batches-{}", std::process::id()));
    let made = (|| {
        let compared = batches::compare(pairs as usize, rows as usize, seed)?;
        let speed = batches::speed()?;
        let city = batches::city(&folder)?;
        Ok::<_, String>((
            batches::page([pairs, rows, seed], &compared, &speed, city),
            compared,
        ))
    })();
    let _ = std::fs::remove_dir_all(&folder);
    let (page, compared) = match made {
        Ok(made) => made,
        Err(problem) => {
            say(&problem);
            return ExitCode::FAILURE;
        }
    };
    say(&page);
    if arguments.iter().any(|argument| argument == "--page") {
        return written(&in_crate("../../docs/batches.md"), &page);
    }
    let kept = compared
        .iter()
        .all(|compare| compare.within() >= 0.995 && compare.worst() < 5.0 * compare.tolerance());
    if kept {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

fn certify_report(paths: &[String]) -> ExitCode {
    if paths.is_empty() {
        say(USAGE);
        return ExitCode::from(2);
    }
    let mut records = Vec::new();
    for path in paths {
        let read = std::fs::read_to_string(path).map_err(|error| error.to_string());
        let read = read.and_then(|text| {
            serde_json::from_str::<Record>(&text).map_err(|error| error.to_string())
        });
        match read {
            Ok(record) => records.push(record),
            Err(why) => {
                say(&format!(
                    "{path}: {why}; give files that --certify N --json FILE wrote"
                ));
                return ExitCode::from(2);
            }
        }
    }
    let place = in_crate("../../docs/certify.md");
    let old = std::fs::read_to_string(&place).map_err(|error| error.to_string());
    // Each part of the page is written from its own files; the other stays as it is.
    let (families, others): (Vec<Record>, Vec<Record>) = records
        .into_iter()
        .partition(|record| record.family().is_some());
    let page = old.and_then(|old| {
        let page = match others.is_empty() {
            true => old,
            false => record::page(&old, &others)?,
        };
        match families.is_empty() {
            true => Ok(page),
            false => certify::families_page(&page, &families),
        }
    });
    match page {
        Ok(page) => {
            let figure = in_crate("../../docs/figures/certify.svg");
            if !others.is_empty() && written(&figure, &record::figure(&others)) == ExitCode::FAILURE
            {
                return ExitCode::FAILURE;
            }
            written(&place, &page)
        }
        Err(why) => {
            say(&format!("{}: {why}", place.display()));
            ExitCode::FAILURE
        }
    }
}

fn in_crate(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn written(path: &Path, text: &str) -> ExitCode {
    match write_atomically(path, text.as_bytes()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            say(&error.to_string());
            ExitCode::FAILURE
        }
    }
}

#[allow(clippy::print_stderr, reason = "this is a command")]
fn say(text: &str) {
    eprintln!("{text}");
}
