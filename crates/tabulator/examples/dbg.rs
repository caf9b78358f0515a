use halfspace::*;
fn main() {
    let k = Kernel::new(&Medium::new(0.3).unwrap(), Profile::Hertz, 1e-9).unwrap();
    let t = lookup::Table::open(&std::env::temp_dir().join("hertzlamb-measure.h5")).unwrap();
    for (r, z) in [(0.5625, 0.5625), (3.0625, 3.0625)] {
        let mut a = vec![[0.0; 6]; 600];
        let mut b = a.clone();
        t.trace(0.3, r, z, 0, &mut a).unwrap();
        k.cell_averages(r, z, 0.1, &mut b).unwrap();
        for j in (0..600).step_by(1) {
            if j < 30 || j % 20 == 0 {
                print!("{j:4}");
                for f in 0..6 {
                    print!(" {:10.2e} {:8.0e}", b[j][f], a[j][f] - b[j][f]);
                }
                println!();
            }
        }
    }
}
