"""Tells what the pieces of a dataset are like, as a table for a page and as a picture.

    python pieces.py data                        # a table, of what `frangible dataset` wrote into data
    python pieces.py data --picture pieces.svg   # and a picture; needs matplotlib
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

QUANTILES = (5, 25, 50, 75, 95)


def kind_of(about: dict[str, Any]) -> str:
    """The kind of an object that has a number behind it: `cup` of `cup-001`."""
    return str(about["object"]).rsplit("-", 1)[0]


def table(breaks: list[dict[str, Any]], rows: list[dict[str, Any]]) -> str:
    """A line for each kind and one for all: how many pieces, and which shares of the mass they have."""
    lines = ["| kind | breaks | not made | pieces: mean | " + " | ".join(f"{q} %" for q in QUANTILES) + " | largest share: 25 % | 50 % | 75 % |"]
    lines.append("|---|" + "---:|" * (lines[0].count("|") - 2))
    for kind in [*sorted({kind_of(row) for row in rows}), "all"]:
        these = [b for b in breaks if kind in ("all", kind_of(b))]
        mine = [row for row in rows if kind in ("all", kind_of(row))]
        counts = [len(b["pieces"]) for b in these]
        largest = np.percentile([shares(b)[0] for b in these], (25, 50, 75))
        pieces = " | ".join(f"{q:.0f}" for q in np.percentile(counts, QUANTILES))
        failed = sum(row["failed"] is not None for row in mine)
        lines.append(f"| {kind} | {len(these)} | {failed} | {np.mean(counts):.1f} | {pieces} | " + " | ".join(f"{x:.2f}" for x in largest) + " |")
    return "\n".join(lines)


def shares(about: dict[str, Any]) -> list[float]:
    """Shares of the pieces' mass, largest first."""
    masses = sorted((piece["mass"] for piece in about["pieces"]), reverse=True)
    return [mass / sum(masses) for mass in masses]


def picture(breaks: list[dict[str, Any]], path: Path) -> None:
    """How many breaks have how many pieces, and how many pieces have which share of the mass."""
    from matplotlib import pyplot, rcParams

    rcParams.update({"svg.hashsalt": "pieces", "svg.fonttype": "none", "font.size": 9})
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 2.6), layout="constrained")
    counts = Counter(len(b["pieces"]) for b in breaks)
    left.bar(list(counts), list(counts.values()), color="#4a6fa5")
    left.set(xlabel="pieces", ylabel="breaks")
    right.hist([s for b in breaks for s in shares(b)], bins=list(np.logspace(-3, 0, 31)), color="#4a6fa5")
    right.set(xlabel="share of the mass", ylabel="pieces", xscale="log")
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--picture", type=Path)
    given = parser.parse_args()
    rows = [json.loads(line) for file in given.folder.glob("manifest/*.jsonl") for line in file.read_text().splitlines()]
    files = sorted(given.folder.glob("meta/*/*/fractured_*.json"))
    breaks = [json.loads(file.read_text()) for file in files]
    print(table(breaks, rows))
    every = np.percentile([s for b in breaks for s in shares(b)], QUANTILES)
    print("shares of the mass:", ", ".join(f"{share:.4f} ({q} %)" for q, share in zip(QUANTILES, every, strict=True)))
    if given.picture:
        picture(breaks, given.picture)


if __name__ == "__main__":
    main()
