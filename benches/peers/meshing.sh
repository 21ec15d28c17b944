#!/bin/sh
# Compares our mesher with TetGen and fTetWild on the same surfaces; see README.md for the options.
# TetGen is AGPL-3.0 and fTetWild MPL-2.0: both are installed here for comparison only and linked to nothing.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$here/../.." && pwd)
target=${CARGO_TARGET_DIR:-$root/target}
case $target in /*) ;; *) target=$PWD/$target ;; esac
work=$target/peers

if [ ! -x "$work/venv/bin/python" ]; then
    python3 -m venv "$work/venv"
fi
"$work/venv/bin/python" -m pip install --quiet --requirement "$here/requirements.txt"
CARGO_TARGET_DIR=$target cargo build --quiet --release --manifest-path "$root/Cargo.toml" \
    -p frangible-mesh --example mesh_file
export PYTHONDONTWRITEBYTECODE=1
exec "$work/venv/bin/python" "$here/meshing.py" \
    --mesh-file "$target/release/examples/mesh_file" --work "$work" "$@"
