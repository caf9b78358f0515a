//! The coefficient of the second term of (24).

use crate::case::anvil;
use crate::error::PaperError;
use halfspace::Medium;

/// Sentences about (24).
pub(crate) fn sentences() -> Result<Vec<String>, PaperError> {
    let medium = Medium::new(anvil()?.material().poisson_ratio)?;
    let at = |q: f64| {
        let [printed, right] = surface_stress(&medium, q);
        format!("{printed:+.4} with 2 and {right:+.4} with 4 at s r0/(c1 k r0) = {q}")
    };
    Ok(vec![
        format!(
            "The second term of (24) has the coefficient 2; (2) asks for szz = -p at z = 0, which holds with 4: szz/p is {}, {}, {}.",
            at(0.5),
            at(1.0),
            at(2.0)
        ),
        "The paper gives no transform of the hoop stress; here it is theory.md (T6).".to_owned(),
    ])
}

/// szz over p at z = 0 from (24) with the coefficients 2 and 4, at q = s/(k c1).
fn surface_stress(medium: &Medium, q: f64) -> [f64; 2] {
    let k = medium.kappa();
    let a = (1.0 + q * q).sqrt();
    let b = (1.0 + (q / k).powi(2)).sqrt();
    let g = 2.0 + (q / k).powi(2);
    let d = g * g - 4.0 * a * b;
    [2.0, 4.0].map(|coefficient| -(g * g - coefficient * a * b) / d)
}
