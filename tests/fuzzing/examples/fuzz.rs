//! Long campaigns: `fuzz COUNT [SEED] [TARGET...]`, inputs of each target; faults are kept in `fuzz/found`.

use fuzzing::{Seeds, Target, campaign};
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let count: usize = arguments.next().ok_or("how many inputs?")?.parse()?;
    let seed: u64 = arguments.next().unwrap_or("1".to_owned()).parse()?;
    let named: Vec<String> = arguments.collect();
    let mut targets = Vec::new();
    for name in &named {
        targets.push(Target::named(name).ok_or_else(|| format!("no target {name}"))?);
    }
    if targets.is_empty() {
        targets = Target::ALL.to_vec();
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz");
    let folder = tempfile::tempdir()?;
    let seeds = Seeds::new(&root.join("corpus"), folder.path())?;
    // faults are counted, not told one by one
    std::panic::set_hook(Box::new(|_| {}));
    let mut faults = 0;
    for target in targets {
        let report = campaign(target, &seeds, count, seed);
        println!(
            "{:10} {} tried, {} read, {} refused, {} faults, slowest {:.2} s",
            target.name(),
            report.tried,
            report.read,
            report.tried - report.read - report.faults.len(),
            report.faults.len(),
            report.slowest_s
        );
        faults += report.faults.len();
        for (index, (input, what)) in report.faults.iter().enumerate().take(20) {
            let found = root.join("found").join(target.name());
            std::fs::create_dir_all(&found)?;
            let name = format!("{seed}-{index}");
            std::fs::write(found.join(&name), input)?;
            println!("           {name}: {what}");
        }
    }
    if faults > 0 {
        return Err(format!("{faults} faults, kept in fuzz/found").into());
    }
    Ok(())
}
