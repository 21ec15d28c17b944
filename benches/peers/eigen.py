"""Runs our eigensolver and SciPy's eigsh on the same matrices and prints a Markdown table; started by eigen.sh.

With --peer FOLDER MODES ORDERING it is one run of SciPy in a process of its own, which prints a line of JSON.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np

ONE_THREAD = {name: "1" for name in ["RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"]}
CASES = ["cube-2k", "slab-8k", "slab-20k", "slab-40k", "plate-t10", "glass-t10", "rabbit-cover"]
AGREEMENT = 1e-7  # relative, of every eigenvalue
SHIFT = 0.05  # below zero, in lowest elastic eigenvalues: what eigsh is told to look near
# The first uses that the matrix is symmetric; the second is what eigsh does when left alone.
ORDERINGS = ["MMD_AT_PLUS_A", "COLAMD"]


def main():
    if sys.argv[1:2] == ["--peer"]:
        return peer(*sys.argv[2:])
    options = parse()
    load = os.getloadavg()[0]
    rows = [compare(case, options) for case in options.only or CASES]
    text = "\n".join(report(rows, options, load)) + "\n"
    print(text, end="")
    if options.out:
        options.out.write_text(text, encoding="utf-8")
    return 0 if all(row["agrees"] for row in rows) else 1


def parse():
    parser = argparse.ArgumentParser(prog="eigen.sh", description="Compares our eigensolver with SciPy's eigsh.")
    parser.add_argument("--out", type=Path, help="also write the table to this file")
    parser.add_argument("--only", nargs="+", metavar="CASE", help=f"cases; by default {' '.join(CASES)}")
    parser.add_argument("--modes", type=int, default=100, help="modes above the rigid ones (default %(default)s)")
    parser.add_argument("--runs", type=int, default=3, help="runs of each, the median counts (default %(default)s)")
    parser.add_argument("--eigen-bench", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--work", type=Path, required=True, help=argparse.SUPPRESS)
    return parser.parse_args()


def compare(case, options):
    """Medians of interleaved runs, and whether the eigenvalues are the same."""
    folder = options.work / case
    command = [options.eigen_bench, folder, case, "--modes", options.modes, "--runs", 1]
    theirs = {ordering: [] for ordering in ORDERINGS}
    ours = [run(command)]
    for turn in range(options.runs):
        if turn:
            ours.append(run([*command, "--no-matrices"]))
        for ordering, results in theirs.items():
            results.append(run([sys.executable, __file__, "--peer", folder, options.modes, ordering]))
    best = min(theirs, key=lambda ordering: median(theirs[ordering]))
    expected = np.array(theirs[best][0]["eigenvalues"])
    found = np.loadtxt(folder / "eigenvalues.txt", ndmin=1)
    difference = float(np.max(np.abs(found / expected - 1.0)))
    row = {
        "case": case,
        **ours[0],
        "seconds": median(ours),
        "phases": min(ours, key=lambda result: abs(result["seconds"] - median(ours)))["phases"],
        "peers": {ordering: median(results) for ordering, results in theirs.items()},
        "best": best,
        "difference": difference,
        "peer_residual": theirs[best][0]["residual"],
        "agrees": difference < AGREEMENT,
    }
    row["ratio"] = row["peers"][best] / row["seconds"]
    print(f"{case}: {row}", file=sys.stderr, flush=True)
    return row


def median(results):
    return statistics.median(result["seconds"] for result in results)


def run(command):
    """The last line of a process on one thread, as JSON."""
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, env={**os.environ, **ONE_THREAD}, check=False
    )
    if done.returncode:
        sys.exit(f"{command[0]} failed: {done.stderr.strip() or done.returncode}")
    return json.loads(done.stdout.splitlines()[-1])


def peer(folder, modes, ordering):
    """Processor seconds of one factorization and eigsh in shift-invert mode, and the eigenvalues above the rigid ones."""
    from scipy.io import mmread
    from scipy.sparse.linalg import LinearOperator, eigsh, splu

    folder, modes = Path(folder), int(modes)
    stiffness, mass = (mmread(folder / name).tocsc() for name in ["K.mtx", "M.mtx"])
    lowest = float(np.loadtxt(folder / "eigenvalues.txt", ndmin=1)[0])
    sigma = -SHIFT * lowest
    start = time.process_time()
    factor = splu(
        (stiffness - sigma * mass).tocsc(),
        permc_spec=ordering,
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": ordering == "MMD_AT_PLUS_A"},
    )
    inverse = LinearOperator(stiffness.shape, matvec=factor.solve, dtype=float)
    # Six rigid motions come first. The tolerance is ARPACK's own for θ, an order tighter than what we promise.
    values, vectors = eigsh(stiffness, k=modes + 6, M=mass, sigma=sigma, OPinv=inverse, tol=1e-9)
    seconds = time.process_time() - start
    order = np.argsort(values)[6:]
    values, vectors = values[order], vectors[:, order]
    forces = stiffness @ vectors
    rest = np.linalg.norm(forces - (mass @ vectors) * values, axis=0) / np.linalg.norm(forces, axis=0)
    print(json.dumps({"seconds": seconds, "residual": float(rest.max()), "eigenvalues": values.tolist()}))
    return 0


def report(rows, options, load):
    """The table, how it is to be read, and where our seconds go."""
    lines = [
        f"The {options.modes} lowest elastic modes, one thread, processor seconds, medians of {options.runs} interleaved runs. "
        f"SciPy {version('scipy')} with numpy {version('numpy')}: eigsh (ARPACK) in shift-invert mode, tolerance 1e-9, "
        f"factorized by SuperLU. {os.cpu_count()} processors, load {load:.1f} before and {os.getloadavg()[0]:.1f} after.",
        "",
        "| Case | Unknowns | Entries of K | Ours | " + " | ".join(f"SciPy, {o}" for o in ORDERINGS)
        + " | Ratio to the better | Largest difference of an eigenvalue | Residual: ours | SciPy's |",
        "|---|--:|--:|--:|" + "--:|" * len(ORDERINGS) + "--:|--:|--:|--:|",
    ]
    for row in rows:
        peers = " | ".join(f"{row['peers'][ordering]:.2f}" for ordering in ORDERINGS)
        remark = "" if row["agrees"] else " (too large)"
        lines.append(
            f"| {row['case']} | {row['unknowns']} | {row['entries']} | {row['seconds']:.2f} | {peers} | {row['ratio']:.1f} × | "
            f"{row['difference']:.1e}{remark} | {row['residual']:.0e} | {row['peer_residual']:.0e} |"
        )
    phases = list(rows[0]["phases"])
    lines += [
        "",
        "Ours by phase, wall-clock seconds of the median run:",
        "",
        "| Case | " + " | ".join(phase.capitalize() for phase in phases) + " |",
        "|---|" + "--:|" * len(phases),
    ]
    for row in rows:
        lines.append(f"| {row['case']} | " + " | ".join(f"{row['phases'][phase]:.3f}" for phase in phases) + " |")
    return lines


if __name__ == "__main__":
    sys.exit(main())
