//! Converged impacts of an independent program.
use halfspace::{Deflection, Medium, SurfaceResponse};
use impact::march::*;
use impact::units::CollisionUnits;

#[test]
fn explore() {
    let text = include_str!("../../../tests/golden/impacts.csv");
    for line in text.lines().skip(1) {
        let f: Vec<&str> = line.rsplit(',').collect();
        let x = |i: usize| f[f.len() - 1 - 0 - i].trim_matches('"').to_string();
        let _ = x;
        let cols: Vec<&str> = f.into_iter().rev().collect();
        let off = cols.len() - 16;
        let g = |i: usize| cols[i + off - 0].parse::<f64>().unwrap();
        // case,V0,m,r0,R,E1,nu1,E,nu,rho,share,peak_force,contact_time,restitution,peak_h,peak_w,rel_change
        let (v0, m, r0, r, e1, nu1, e, nu, rho) = (g(0), g(1), g(2), g(3), g(4), g(5), g(6), g(7), g(8));
        let share = if cols[off + 9] == "full" { StaticShare::Full } else { StaticShare::Dynamic };
        let es = 1.0 / ((1.0 - nu1 * nu1) / e1 + (1.0 - nu * nu) / e);
        let k = 4.0 / 3.0 * es * r.sqrt();
        let u = CollisionUnits::new(k, m, v0);
        let mu = e / 2.0 / (1.0 + nu);
        let c1 = ((2.0 - 2.0 * nu) / (1.0 - 2.0 * nu) * mu / rho).sqrt();
        let resp = SurfaceResponse::new(&Medium::new(nu).unwrap(), Deflection::Centre);
        let d = FixedDisc {
            response: &resp,
            coupling: resp.static_compliance() * u.force_n / (mu * r0 * u.length_m),
            wave_time: r0 / c1 / u.time_s,
            share,
        };
        println!("{line}\n σ={:.4} mem={:.4}", d.coupling, d.memory());
        for n in [25, 50, 100, 200, 400, 800, 1600] {
            let h = 3.0 / n as f64;
            let t0 = std::time::Instant::now();
            let hist = march_implicit(&d, h).unwrap();
            let s = Summary::new(&hist).unwrap();
            let el = t0.elapsed().as_secs_f64() * 1e6;
            println!(
                "  {n:5} F {:+.2e} t {:+.2e} e {:+.2e} h {:+.2e} w {:+.2e}  {el:.1} us",
                s.peak_force * u.force_n / g(10) - 1.0,
                s.contact_time * u.time_s / g(11) - 1.0,
                s.restitution / g(12) - 1.0,
                s.peak_displacement * u.length_m / g(13) - 1.0,
                s.peak_deflection * u.length_m / g(14) - 1.0
            );
        }
        let (_, s) = march_explicit(&d, 0.135e-6 / u.time_s).unwrap();
        println!("explicit {} {} {}", s.peak_force * u.force_n, s.restitution, s.contact_time * u.time_s);
    }
}
