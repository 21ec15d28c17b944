"""Draws where the time of a break goes, from what `perf script -F ip,sym,dso` prints: flame.py PROGRAM SAMPLES.txt OUT.svg; used by flame.sh.

Functions that the compiler put into others come back by the program's line tables. Only names of this project are shown, standard
library and system count as their caller's own, but for memory (the system's page faults, copies).
"""

import re
import subprocess
import sys
from collections import Counter
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = "impact"
SOURCE = re.compile(r"crates/frangible(?:-(\w+))?/src/")
WIDTH, LINE, MARGIN, LETTER = 1200, 17, 12, 6.3
LEAST = 0.0015  # share of a box that is drawn
GROUPS = [
    ("blow, modes", "#8fbf6a", ["blow", "contact", "modal", "near_field"]),
    ("displacements, stresses", "#7fb0de", ["motion", "stress"]),
    ("bounds", "#c7d36f", ["bounds", "refuse"]),
    ("cracks", "#eda45e", ["crack", "cracking", "state", "tips"]),
    ("fragments", "#b99adb", ["fragment", "piece"]),
    ("geometry", "#d78fb5", ["geometry", "mesh"]),
    ("memory", "#b8b8b8", ["memory"]),
]
COLOURS = {folder: colour for _, colour, folders in GROUPS for folder in folders}
OTHER = "#e3d9b8"
NAMELESS = ("", "closure", "imp", "call", "call_mut", "call_once")


def main():
    program, samples, out = sys.argv[1:]
    stacks = list(read(samples))
    names = names_of(program, {ip for stack in stacks for ip, _, file in stack if file == Path(program).name})
    folded = Counter()
    for stack in stacks:
        path = fold(stack, names, Path(program).name)
        if path:
            folded[path] += 1
    Path(out).write_text(draw(folded), encoding="utf-8")
    print(shares(folded))


def read(path):
    """(address, symbol, name of its file) of every frame, the innermost first, of each sample."""
    stack = []
    for line in Path(path).read_text(encoding="utf-8", errors="replace").splitlines():
        words = line.split(maxsplit=1)
        if len(words) == 2:
            symbol, _, file = words[1].rpartition(" (")
            stack.append((int(words[0], 16), symbol, file.rstrip(")").split("/")[-1]))
        elif stack:
            yield stack
            stack = []
    if stack:
        yield stack


def names_of(program, addresses):
    """This project's functions at each address, the innermost first."""
    shift = text_shift(program)
    order = sorted(addresses)
    words = [hex(ip + shift) for ip in order]
    lines = subprocess.run(
        ["addr2line", "--functions", "--inlines", "--demangle", "--addresses", f"--exe={program}"],
        input="\n".join(words), capture_output=True, text=True, check=True,
    ).stdout.splitlines()
    found, current = {}, []
    for number, line in enumerate(lines):
        if line.startswith("0x") and re.fullmatch(r"0x[0-9a-f]+", line):
            current = found.setdefault(int(line, 16) - shift, [])
            first = number + 1
        elif (number - first) % 2 == 1 and SOURCE.search(line):
            current.append(label(lines[number - 1], line))
    return {ip: [name for name in labels if name] for ip, labels in found.items()}


def text_shift(program):
    """What separates perf's addresses, which count in the file, from those of the line tables."""
    about = subprocess.run(["readelf", "--segments", "--wide", program], capture_output=True, text=True, check=True).stdout
    for line in about.splitlines():
        words = line.split()
        if words[:1] == ["LOAD"] and "E" in words[6:-1]:
            return int(words[2], 16) - int(words[1], 16)
    sys.exit(f"{program} has no code")


def label(function, place):
    """`folder/file: function`; nothing for closures and the shells of the dispatch, whose time is their caller's."""
    source = SOURCE.search(place)
    folder = f"{source[1]}/" if source[1] else ""
    module = folder + place[source.end():].split(".rs:")[0].removesuffix("/mod")
    plain = function
    while (shorter := re.sub(r"<[^<>]*>", "", plain)) != plain:
        plain = shorter
    plain = re.sub(r"\{.*\}", "", plain).strip(":").split("::")[-1]
    return f"{module}: {plain}" if plain not in NAMELESS else ""


def fold(stack, names, program):
    """Labels from the impact inwards, or nothing."""
    path = []
    for ip, symbol, file in stack:
        if file == "[kernel.kallsyms]":
            path.append("memory: system")
        elif "memmove" in symbol or "memcpy" in symbol or "memset" in symbol:
            path.append("memory: copies")
        elif symbol in ("malloc", "cfree", "realloc", "_int_malloc", "_int_free"):
            path.append("memory: allocator")
        else:
            path += names.get(ip, []) if file == program else []
    path.reverse()
    while path and path[0] != f"impact: {ROOT}":
        path.pop(0)
    return tuple(name for number, name in enumerate(path) if number == 0 or name != path[number - 1])


def boxes(folded):
    """(depth, start, samples, label), depth by depth merged."""
    found = {}
    start = 0
    for path in sorted(folded):
        count = folded[path]
        for depth, name in enumerate(path):
            key = path[: depth + 1]
            begin, so_far = found.get(key, (start, 0))
            found[key] = (begin, so_far + count)
        start += count
    return [(len(key) - 1, begin, count, key[-1]) for key, (begin, count) in found.items()], start


def draw(folded):
    found, total = boxes(folded)
    drawn = [box for box in found if box[2] >= LEAST * total]
    depth = max(box[0] for box in drawn) + 1
    height = (depth + 3) * LINE + 2 * MARGIN
    scale = (WIDTH - 2 * MARGIN) / total
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" font-size="11">',
        f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
    ]
    x = MARGIN
    for title, colour, _ in [*GROUPS, ("other", OTHER, [])]:
        parts.append(f'<rect x="{x}" y="{MARGIN}" width="12" height="12" fill="{colour}"/>')
        parts.append(f'<text x="{x + 16}" y="{MARGIN + 10}">{title}</text>')
        x += 34 + LETTER * len(title)
    for level, begin, count, name in sorted(drawn):
        y = height - MARGIN - (level + 1) * LINE
        width = max(count * scale - 0.5, 0.3)
        folder = re.split("[/:]", name)[0]
        share = f"{name}, {100 * count / total:.1f} %"
        left = MARGIN + begin * scale
        parts.append(f"<g><title>{escape(share)}</title>")
        fill = COLOURS.get(folder, OTHER)
        parts.append(f'<rect x="{left:.1f}" y="{y}" width="{width:.1f}" height="{LINE - 1}" fill="{fill}"/>')
        room = int((width - 4) / LETTER)
        shown = share if len(share) <= room else name if len(name) <= room else name.split(": ")[-1]
        if len(shown) > room:
            shown = shown[: room - 1] + "…"
        if room >= 4:
            parts.append(f'<text x="{left + 3:.1f}" y="{y + 12}">{escape(shown)}</text>')
        parts.append("</g>")
    parts.append("</svg>\n")
    return "\n".join(parts)


def shares(folded):
    """Functions by their own time and by time with what they call, in percent."""
    total = sum(folded.values())
    own, all_of = Counter(), Counter()
    for path, count in folded.items():
        own[path[-1]] += count
        for name in set(path):
            all_of[name] += count
    lines = [f"{total} samples; own %, all %:"]
    lines += [f"{100 * n / total:6.1f} {100 * all_of[name] / total:6.1f}  {name}" for name, n in own.most_common(25)]
    return "\n".join(lines)


if __name__ == "__main__":
    main()
