//! Does nothing; its dependency has the features that the tests ask for, see `Cargo.toml`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
}
