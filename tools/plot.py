#!/usr/bin/env python3
"""Draws the charts of the documentation from the data that the laboratory wrote.

    python3 tools/plot.py [NAME ...]

NAME is a data file of docs/data without its ending; all of those that are there without one. Needs matplotlib. `sound` and `levels` also need the
sounds, and one picture of `experiments` the cracks, that `frangible-lab` leaves in target/lab.
"""

import json
import sys
import wave
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
SOUNDS = ROOT / "target" / "lab" / "sound"
PATTERNS = ROOT / "target" / "lab" / "experiments" / "patterns.json"
# Okabe and Ito's colours, which the colour-blind tell apart too.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]
# Of spectrograms: silence has no level, and is as black as what is soft.
SILENT = plt.get_cmap("magma").with_extremes(bad="black")
MARKERS = ["s", "o", "^", "D", "v", "P"]
plt.rcParams.update({"figure.figsize": (8, 6), "axes.grid": True, "grid.alpha": 0.3, "axes.prop_cycle": plt.cycler(color=COLOURS)})


def save(name):
    """Writes the current figure to docs/NAME without a date, so that the same data gives the same file."""
    path = DOCS / name
    path.parent.mkdir(exist_ok=True)
    plt.savefig(path, dpi=100, bbox_inches="tight", metadata={"Software": None})
    plt.close()
    print(path.relative_to(ROOT))


def label(title, x, y, x_scale="linear", y_scale="linear"):
    plt.title(title)
    plt.xlabel(x)
    plt.ylabel(y)
    plt.xscale(x_scale)
    plt.yscale(y_scale)
    if plt.gca().get_legend_handles_labels()[0]:
        plt.legend()


def curves(rows, name, points, marker=True, line="-", factor=(1, 1)):
    for i, row in enumerate(rows):
        x, y = zip(*points(row))
        style = MARKERS[i % len(MARKERS)] if marker else None
        plt.plot([v * factor[0] for v in x], [v * factor[1] for v in y], line, marker=style, label=name(row), markersize=5)


def lines(axes, segments, half, title):
    """Cracks of a plate, mm: x and y of both ends of each."""
    axes.add_collection(LineCollection([[(a, b), (c, d)] for a, b, c, d in segments], colors="#202020", linewidths=0.8))
    axes.set(xlim=(-half, half), ylim=(-half, half), aspect="equal", xticks=[], yticks=[])
    axes.set_title(title, fontsize=9)


def near_field(data):
    curves(data["stress"], lambda r: r["name"], lambda r: r["points"], factor=(1e3, 1))
    label("Far face of a plate of 1 mm, pushed by 100 N", "distance from the contact, mm", "hoop stress, MPa", "log")
    save("near-field/hoop-stress.png")


def verification(data):
    curves(data["convergence"]["curves"], lambda r: r["name"], lambda r: r["points"], factor=(1, 100))
    label("First frequency of a free plate, 400 × 400 × 10 mm", "unknowns", "error of the frequency, %", "log", "log")
    save("verification/convergence.png")


def experiments(data):
    stars, masses = data["stars"], data["masses"]["runs"]
    counts = lambda run: [(c["speed_m_s"], c["mean"]) for c in run["counts"] if c["mean"] > 0]
    curves(stars["runs"], lambda r: f"computed, {1e3 * r['thickness_m']:g} mm", counts)
    measured = [(m["speed_m_s"], m["measured"]) for m in stars["beside_measured"]]
    plt.plot(*zip(*measured), "D", color=COLOURS[3], label="measured, 1 mm, means")
    plt.plot([22.2, 56.7], [4, 8], "x", color=COLOURS[4], label="measured, 1 mm, photographs")
    (v, n), speeds = measured[0], [10, 113]
    plt.plot(speeds, [n * (s / v) ** 0.5 for s in speeds], "--", color="#808080", label="speed to the power 1/2")
    label("Radial cracks of a PMMA plate hit by a steel bullet 4 mm wide", "speed of the projectile, m/s", "radial cracks", "log", "log")
    save("experiments/star-law.png")
    for run, colour, marker in zip(masses, COLOURS, MARKERS):
        small = sorted(m for body in run["masses"] for m in body[1:])
        bodies = len(run["masses"])
        plt.step(small, [(len(small) - i) / bodies for i in range(len(small))], color=colour, label=run["name"])
        if law := run["law"]:
            m = [law["least"] * (small[-1] / law["least"]) ** (k / 50) for k in range(51)]
            cut_off = law["cut_off"] or float("inf")
            share = [(x / law["least"]) ** (1 - law["exponent"]) * 2.718281828 ** (-(x - law["least"]) / cut_off) for x in m]
            plt.plot(m, [law["masses"] / bodies * s for s in share], "--", color=colour, label=f"{run['name']}, fitted")
    label("Pieces heavier than a mass", "mass, masses of the body", "pieces per body", "log", "log")
    save("experiments/masses.png")
    if not PATTERNS.exists():
        print(f"star-patterns.png stays: {PATTERNS.relative_to(ROOT)} is missing; `frangible-lab experiments` leaves it there")
        return
    patterns = json.loads(PATTERNS.read_text(encoding="utf-8"))
    columns = len(patterns) // 2
    figure, grid = plt.subplots(2, columns, figsize=(2.5 * columns, 5.6))
    for axes, pattern in zip(grid.flat, patterns):
        name = "default" if pattern["variant"] == "default" else "the paper's"
        lines(axes, pattern["lines_mm"] or [], 50, f"{name}, {pattern['speed_m_s']:g} m/s")
        axes.add_patch(plt.Circle((0, 0), 10, fill=False, color=COLOURS[1], linewidth=0.8))
    figure.suptitle("Cracks of a 1 mm PMMA plate")
    save("experiments/star-patterns.png")


def recursive(data):
    # Auto repeats one of the others.
    ways = data["ways"][:-1]
    curves(ways, lambda r: r["way"], lambda r: [(max(e, 1e-3), s) for e, s in r["errors"]], factor=(100, 100))
    label("How far the largest tension of a blow is off", "error, % of the full analysis", "blows with no larger error, %", "log")
    save("recursive/errors.png")
    curves(ways, lambda r: r["way"], lambda r: r["times"], line="", factor=(1, 1e3))
    label("Until a piece can break again", "uncut tetrahedra of the piece", "time of one thread, ms", "log", "log")
    save("recursive/time.png")


def levels(data):
    for scene in sorted({row["scene"] for row in data["levels"]}):
        plt.figure(figsize=(7.6, 4.2))
        for i, row in enumerate(r for r in data["levels"] if r["scene"] == scene):
            name = ["true to scale", "by loudness"][i]
            time = [0.02 * (k + 0.5) for k in range(len(row["levels_db"]))]
            plt.plot(time, row["levels_db"], color=COLOURS[i], label=name)
            landings = row["landings"]
            plt.plot([time[k] for k in landings], [row["levels_db"][k] for k in landings], MARKERS[i], color=COLOURS[i], markersize=4)
        label(scene, "time, s", "level of 20 ms, dB over full scale")
        save(f"sound/level-{scene}.png")
    spectrograms({}, lambda name: name.startswith("window-"))


def sound(data):
    spectrograms({scene["name"]: scene["blows_s"] for scene in data["scenes"]}, lambda name: not name.startswith("window-"))


def spectrograms(marks, drawn):
    for path in sorted(SOUNDS.glob("*.wav")):
        if not drawn(path.stem):
            continue
        with wave.open(str(path)) as file:
            rate, raw = file.getframerate(), file.readframes(file.getnframes())
        samples = memoryview(raw).cast("h")
        plt.figure(figsize=(7.6, 4.2))
        levels = plt.specgram(samples, NFFT=1024, Fs=rate, noverlap=768, cmap=SILENT)[3]
        levels.set_clim(levels.get_clim()[1] - 90, levels.get_clim()[1])
        for time in marks.get(path.stem, []):
            plt.plot(time, 15800, "v", color=COLOURS[1])
        plt.ylim(0, 16000)
        plt.grid(False)
        label(path.stem, "time, s", "frequency, Hz")
        save(f"sound/{path.stem}.png")


def figures(data):
    for key, y, value in [("duration", "duration, ms", lambda r: 1e3 * r["duration_s"]), ("area", "crack area, cm²", lambda r: 1e4 * r["damage"]["area_m2"])]:
        for k, model in enumerate(["the paper's model", "ours"]):
            rows = [r for r in data["fig4"]["balls"] if r["model"] == model]
            plt.plot([r["modulus_pa"] for r in rows], [value(r) for r in rows], MARKERS[k] + "-", label=model)
        label("Balls of different stiffness on a piggy bank", "stiffness of the ball, Pa", y, "log", "log" if key == "duration" else "linear")
        save(f"figures/fig4-{key}.png")
    grid = plt.subplots(2, 3, figsize=(9, 6.4))[1]
    for axes, row in zip(grid.flat, data["fig7"]):
        lines(axes, row["lines_mm"], 150, f"{row['model']}, {row['toughness_j_m2']:g} J/m²")
    save("figures/fig7-cracks.png")


def soak(data):
    curve = data["curve"]
    plt.figure(figsize=(7.2, 4.2))
    plt.plot([row["of_pieces"] for row in curve], [row["resident_mb"] for row in curve])
    plt.ylim(bottom=0)
    label("Resident memory over breaks of pieces", "breaks of pieces", "MB")
    save("soak.png")


def main():
    drawn = {"near-field": near_field, "verification": verification, "experiments": experiments, "recursive": recursive, "sound": sound, "levels": levels, "figures": figures, "soak": soak}
    for name in sys.argv[1:] or drawn:
        if name not in drawn:
            sys.exit(f"there is nothing to draw of `{name}`; names: {', '.join(drawn)}")
        path = DOCS / "data" / f"{name}.json"
        if path.exists():
            drawn[name](json.loads(path.read_text())["measured"])
        elif name in sys.argv[1:]:
            sys.exit(f"`{path}` is missing; `frangible-lab {name} --write docs` makes it")


if __name__ == "__main__":
    main()
