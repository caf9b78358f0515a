//! Draws one figure of each kind with synthetic data into a folder, as SVG, PNG and PDF.
//!
//! `cargo run -p hertzlamb-figure --example gallery -- FOLDER`

mod curves;
mod fields;
mod waves;

use figure::{Figure, to_pdf, to_png, to_svg};
use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or("gallery".to_owned());
    let folder = PathBuf::from(folder);
    std::fs::create_dir_all(&folder)?;
    for (name, figure) in all() {
        let path = |ending: &str| folder.join(format!("{name}.{ending}"));
        std::fs::write(path("svg"), to_svg(&figure)?)?;
        std::fs::write(path("png"), to_png(&figure, 1.5)?)?;
        std::fs::write(path("pdf"), to_pdf(&figure)?)?;
        println!("{}", path("png").display());
    }
    Ok(())
}

/// Every figure of the gallery, with the name of its files.
pub(crate) fn all() -> Vec<(&'static str, Figure)> {
    vec![
        ("histories", curves::histories()),
        ("convergence", curves::convergence()),
        ("styles", curves::styles()),
        ("classes", curves::classes()),
        ("histograms", curves::histograms()),
        ("section", fields::section()),
        ("frames", fields::frames()),
        ("magnitude", fields::magnitude()),
        ("column", curves::column()),
    ]
}
