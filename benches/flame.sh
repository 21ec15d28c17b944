#!/bin/sh
# Draws where the time of a break goes: benches/flame.sh [FOLDER], docs unless given, as FOLDER/performance-flame-SCENE.svg.
# The blows are those that first break something in the scenes `glass` and `pane`; SCENES in the environment names others.
# Needs Linux's perf, addr2line and readelf (binutils), Python 3.11.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$here/.." && pwd)
target=${CARGO_TARGET_DIR:-$root/target}
case $target in /*) ;; *) target=$PWD/$target ;; esac
folder=${1:-$root/docs}
work=$target/flame
program=$work/release/examples/again

command -v perf >/dev/null || { echo "perf is missing: apt-get install linux-perf" >&2; exit 1; }
mkdir -p "$work"
# Line tables and frame pointers, in a folder of their own.
CARGO_TARGET_DIR=$work CARGO_PROFILE_RELEASE_DEBUG=line-tables-only CARGO_PROFILE_RELEASE_STRIP=none \
    RUSTFLAGS='-C force-frame-pointers=yes' \
    cargo build --quiet --release --manifest-path "$root/Cargo.toml" -p frangible-scenes --example again
for scene in ${SCENES:-glass pane}; do
    perf record --quiet --event cpu-clock --freq 3000 --call-graph fp --output "$work/perf.data" -- \
        "$program" "$scene" "${SECONDS_LONG:-8}"
    perf script --input "$work/perf.data" --fields ip,sym,dso >"$work/samples.txt" 2>/dev/null
    python3 "$here/flame.py" "$program" "$work/samples.txt" "$folder/performance-flame-$scene.svg"
done
