#!/bin/sh
# Compares our eigensolver with SciPy's eigsh on the same matrices; see README.md for the options.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$here/../.." && pwd)
target=${CARGO_TARGET_DIR:-$root/target}
case $target in /*) ;; *) target=$PWD/$target ;; esac
work=$target/peers

if [ ! -x "$work/venv-eigen/bin/python" ]; then
    python3 -m venv "$work/venv-eigen"
fi
"$work/venv-eigen/bin/python" -m pip install --quiet --requirement "$here/requirements-scipy.txt"
CARGO_TARGET_DIR=$target cargo build --quiet --release --manifest-path "$root/Cargo.toml" \
    -p frangible-bake --example eigen_bench
export PYTHONDONTWRITEBYTECODE=1
exec "$work/venv-eigen/bin/python" "$here/eigen.py" \
    --eigen-bench "$target/release/examples/eigen_bench" --work "$work/eigen" "$@"
