#!/bin/sh
# Breaks the same bodies with ours, three-pinata (npm) and Blender's Cell Fracture (Debian's package); see README.md for the options.
# Blender is GPL-2.0-or-later and three-pinata MIT: both are run for comparison only and linked to nothing.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$here/../.." && pwd)
target=${CARGO_TARGET_DIR:-$root/target}
case $target in /*) ;; *) target=$PWD/$target ;; esac
work=$target/peers

install=yes
for word in "$@"; do
    case $word in --no-install | --help | -h) install=no ;; esac
done
if [ $install = yes ] && ! command -v blender >/dev/null && command -v apt-get >/dev/null; then
    # Without it, or without the right to install it, Blender is left out and the table says so.
    apt-get install --yes --no-install-recommends blender >&2 || echo "Blender could not be installed" >&2
fi
if [ ! -x "$work/venv-pieces/bin/python" ]; then
    python3 -m venv "$work/venv-pieces"
fi
"$work/venv-pieces/bin/python" -m pip install --quiet --requirement "$here/requirements-scipy.txt"
mkdir -p "$work/pinata"
cp "$here"/pinata/* "$work/pinata/"
if command -v npm >/dev/null; then
    (cd "$work/pinata" && npm ci --silent --no-fund --no-audit >&2)
fi
export CARGO_TARGET_DIR="$target"
cargo build --quiet --release --manifest-path "$root/Cargo.toml" --workspace --bins
cargo build --quiet --release --manifest-path "$root/Cargo.toml" -p frangible --example hit
export PYTHONDONTWRITEBYTECODE=1
exec "$work/venv-pieces/bin/python" "$here/pieces.py" --frangible "$target/release/frangible" \
    --lab "$target/release/frangible-lab" --hit "$target/release/examples/hit" --work "$work/pieces" --pinata "$work/pinata" "$@"
