//! Whether the HDF5 library that is linked can be told not to lock files: `H5Pset_file_locking` of 1.10.7, 1.12.1 and later.

fn main() {
    let has = |version: &str| std::env::var_os(format!("DEP_HDF5_VERSION_{version}")).is_some();
    println!("cargo::rustc-check-cfg=cfg(hdf5_locks)");
    if (has("1_10_7") && !has("1_12_0")) || has("1_12_1") {
        println!("cargo::rustc-cfg=hdf5_locks");
    }
}
