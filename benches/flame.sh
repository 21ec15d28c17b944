#!/bin/sh
# Draws where the time of a break goes: benches/flame.sh [OUT.svg]. Needs Linux's perf, addr2line and readelf (binutils), Python 3.11.
# The body is Table 1's glass, dropped on its foot; BODY, SIDE and SPEED in the environment choose another blow of example `hit`.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$here/.." && pwd)
target=${CARGO_TARGET_DIR:-$root/target}
case $target in /*) ;; *) target=$PWD/$target ;; esac
out=${1:-$root/docs/performance-flame.svg}
work=$target/flame
program=$work/release/examples/hit

command -v perf >/dev/null || { echo "perf is missing: apt-get install linux-perf" >&2; exit 1; }
mkdir -p "$work"
body=${BODY:-$target/bench/glass-100.frangible}
if [ ! -f "$body" ]; then
    CARGO_TARGET_DIR=$target cargo run --quiet --release --manifest-path "$root/Cargo.toml" -p frangible-lab -- \
        bench table1 --body glass --cache "$target/bench" --runs 1 --no-reference >/dev/null
fi
# Line tables and frame pointers, in a folder of their own.
CARGO_TARGET_DIR=$work CARGO_PROFILE_RELEASE_DEBUG=line-tables-only CARGO_PROFILE_RELEASE_STRIP=none \
    RUSTFLAGS='-C force-frame-pointers=yes' \
    cargo build --quiet --release --manifest-path "$root/Cargo.toml" -p frangible --example hit
perf record --quiet --event cpu-clock --freq 3000 --call-graph fp --output "$work/perf.data" -- \
    "$program" again "$body" "${SIDE:--z}" "${SPEED:-101.257}" "${SECONDS_LONG:-8}"
perf script --input "$work/perf.data" --fields ip,sym,dso >"$work/samples.txt" 2>/dev/null
python3 "$here/flame.py" "$program" "$work/samples.txt" "$out"
