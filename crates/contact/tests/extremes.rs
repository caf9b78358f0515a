//! Numbers outside the physics are refused with the number and the limit; what is not refused has finite results.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use contact::{
    Choice, Collision, ContactError, Exact, HalfSpace, Material, Model, Resampler, Results,
    Settings, Solver, Striker,
};

fn ball_on_block() -> Collision {
    let named = |name| Material::named(name).unwrap();
    let block = HalfSpace::new(named("steel")).unwrap();
    let ball = Striker::ball(named("bearing-steel"), 0.005).unwrap();
    Collision::new(&block, &ball, 1.0)
}

/// Results as numbers, or the sentence.
fn solve(collision: &Collision, model: Model) -> Result<[f64; 9], ContactError> {
    let settings = Settings {
        model,
        disc_radius_m: (model == Model::Wave).then_some(collision.tip_radius_m * 0.02),
        ..Settings::default()
    };
    let mut solver = Solver::new(&Exact);
    let solved = solver.solve(collision, &settings)?;
    let r = Results::new(collision, &settings, &solved);
    Ok([
        r.peak_force_n,
        r.contact_time_s,
        r.restitution,
        r.loss,
        r.peak_displacement_m,
        r.impulse_n_s,
        r.initial_energy_j,
        r.radiated_energy_j,
        r.relative_error_estimate,
    ])
}

#[test]
fn an_approach_as_fast_as_rayleighs_wave_is_refused_by_every_model() {
    let ball = ball_on_block();
    for &model in Model::ALL {
        let fast = [
            (1e160, "1e160"),
            (f64::MAX, "1.798e308"),
            (1e4, "10000"),
            (3.1e3, "3100"),
        ];
        for (velocity_m_s, written) in fast {
            let fast = Collision {
                velocity_m_s,
                ..ball
            };
            let text = solve(&fast, model).unwrap_err().to_string();
            assert!(
                text.contains(&format!("velocity_m_s = {written} is")) && text.contains("2972 m/s"),
                "{model:?}: {text}"
            );
        }
    }
    // steel's Rayleigh wave: 2.9 to 3.0 km/s
    let limit = |velocity_m_s| match (Collision {
        velocity_m_s,
        ..ball
    })
    .check()
    {
        Err(ContactError::TooFast { limit_m_s, .. }) => Some(limit_m_s),
        _ => None,
    };
    let speed = limit(4000.0).unwrap();
    assert!((2.7e3..3.1e3).contains(&speed), "{speed}");
    assert!(limit(speed).is_some() && limit(speed * (1.0 - 1e-12)).is_none());
}

#[test]
fn numbers_that_no_body_has_are_refused_and_others_stay_numbers() {
    let ball = ball_on_block();
    let tiny = f64::MIN_POSITIVE * f64::EPSILON;
    let mut refused = 0;
    for value in [
        tiny, 1e-300, 1e-160, 1e-31, 1e-29, 1e-10, 1e10, 1e29, 1e31, 1e160, 1e300,
    ] {
        let cases = [
            (
                "mass_kg",
                Collision {
                    mass_kg: value,
                    ..ball
                },
            ),
            (
                "tip_radius_m",
                Collision {
                    tip_radius_m: value,
                    ..ball
                },
            ),
            (
                "velocity_m_s",
                Collision {
                    velocity_m_s: value,
                    ..ball
                },
            ),
            (
                "the half-space's wave speed in m/s",
                Collision {
                    target_longitudinal_speed_m_s: value,
                    ..ball
                },
            ),
            (
                "the effective modulus in Pa",
                Collision {
                    effective_modulus_pa: value.min(ball.target_plane_modulus_pa),
                    ..ball
                },
            ),
        ];
        for (name, collision) in cases {
            for &model in Model::ALL {
                match solve(&collision, model) {
                    Ok(found) => assert!(
                        found.iter().all(|x| x.is_finite()),
                        "{name} = {value:e}, {model:?}: {found:?}"
                    ),
                    Err(error) => {
                        let text = error.to_string();
                        assert!(text.len() > 20 && !text.contains("NaN"), "{text}");
                        refused += 1;
                    }
                }
            }
            let outside = !(1e-30..=1e30).contains(&value);
            let checked = collision.check();
            if outside && name != "the effective modulus in Pa" {
                let text = checked.unwrap_err().to_string();
                assert!(
                    text.contains(name) || text.contains("velocity_m_s"),
                    "{text}"
                );
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

/// The deflection is lost in the rounding of the indentation there, and no reason to refuse the force.
#[test]
fn very_slow_contacts_have_a_history() {
    for &model in Model::ALL {
        for velocity_m_s in [1e-6, 1e-10] {
            let slow = Collision {
                velocity_m_s,
                ..ball_on_block()
            };
            let settings = Settings {
                model,
                ..Settings::default()
            };
            let solved = Solver::new(&Exact).solve_with_history(&slow, &settings);
            let (solved, history) = solved.unwrap_or_else(|error| panic!("{model:?}: {error}"));
            let middle = 0.5 * solved.summary.contact_time;
            let [force, ..] = Resampler::new(history).force(middle);
            let peak = solved.summary.peak_force;
            assert!(
                (force / peak - 1.0).abs() < 1e-3,
                "{model:?}: {force} {peak}"
            );
        }
    }
}
