# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks by frangible's own simulation: a ball flies at the body, and all fall on the ground."""

import json
import os
import subprocess
import sys
import tempfile

import frangible as fr
import numpy as np

from .recording import BODY, TO_FILE, read_pieces, to_file

GRAVITY = 9.81
# Pictures per second of a recording.
RATE = 60
# Seconds after which a break must have come.
SOON = 0.1
# How far outside the surface a ball starts, as a share of its radius.
OUTSIDE = 0.02
# What lies no higher than this stands on the ground, m.
STANDING = 1e-3


def play(target, blow, seed, weakness, seconds, ground):
    """The pieces of a blow and when it came, s; no pieces if the body holds, even if its fall would break it later."""
    low = float(target.shape.world[:, 2].min())
    if ground and low < -STANDING:
        raise ValueError(f"The object reaches {-low:.3g} m below the ground at z = 0; lift it, or let rigid bodies move the pieces.")
    with tempfile.TemporaryDirectory(prefix="frangible-") as folder:
        if weakness is None:
            came, path = 0.0, _thrown(target, blow, seed, seconds, ground, folder)
        else:
            came, path = _painted(target, blow, seed, weakness, seconds, ground, low, folder)
        pieces = read_pieces(path)
    return [piece for piece in pieces if piece.broke <= came + SOON + 1 / RATE], came


def _thrown(target, blow, seed, seconds, ground, folder):
    """A ball begins right before the surface of a body at rest."""
    world = fr.World(floor="stone" if ground else None, seed=seed)
    world.add(target.body, position=to_file(target.center), rotation=TO_FILE, name=BODY)
    # The ball touches the surface at the point, and goes back along its way by a little.
    touching = blow.point + blow.radius * blow.normal
    start = touching - OUTSIDE * blow.radius * blow.direction
    if ground and start[2] < blow.radius:
        inside = blow.radius - start[2]
        raise ValueError(f"The striker would start {inside:.3g} m inside the ground; hit the object higher up, or with a smaller one.")
    world.throw(to_file(start), to_file(touching), blow.speed, mass=blow.mass, radius=blow.radius, material=blow.material)
    world.step(min(SOON, seconds))
    if any(thing.kind == "piece" for thing in world.things) and seconds > SOON:
        world.step(seconds - SOON)
    path = os.path.join(folder, "break.glb")
    world.export(path, rate=RATE)
    return path


def _painted(target, blow, seed, weakness, seconds, ground, low, folder):
    """A scene with weak places: it is the command line that knows them."""
    reach = np.linalg.norm(target.body.vertices, axis=1).max()
    distance = min(max(0.05 * blow.speed, 0.1), 1.0)
    arrival = (reach + blow.radius + distance) / blow.speed
    # A body that hangs in the air is tossed up so that the ball meets it at its place, at rest.
    rise = 0.5 * GRAVITY * arrival**2
    stands = ground and low <= STANDING
    if ground and not stands and low < rise:
        raise ValueError(
            f"A painted object that hangs {low:.3g} m above the ground is not met by so slow a striker;"
            f" set it on the ground, lift it to {rise:.3g} m, or strike faster."
        )
    tossed = np.zeros(3) if stands else np.array([0, 0, rise])
    centers, radius, strengths = weakness.zones(target)
    zones = ",\n".join(f"  {{ sphere = {_list(c)}, radius = {radius:.9g}, strength = {s:.6g} }}" for c, s in zip(centers, strengths))
    target.body.save(os.path.join(folder, "body.frangible"))
    # The centre of the ball aims at a place one radius outside; the aim is told from where the body starts.
    aim = blow.point + blow.radius * blow.normal - target.center + tossed
    lines = [
        'name = "break"',
        f"seed = {seed}",
        f"duration = {(arrival + seconds):.9g}",
        'floor = "stone"' if ground else "floor = false",
        "[[body]]",
        f'name = "{BODY}"',
        'asset = "body.frangible"',
        f"position = {_list(to_file(target.center - tossed))}",
        f"rotation = {{ quaternion = {_list(TO_FILE)} }}",
        f"velocity = {_list([0, GRAVITY * arrival if not stands else 0, 0])}",
        f"weakness = [\n{zones}\n]",
        "[[projectile]]",
        f"mass = {blow.mass:.9g}",
        f"radius = {blow.radius:.9g}",
        f"speed = {blow.speed:.9g}",
        f'material = "{blow.material}"',
        f"at = {_list(to_file(aim))}",
        f"toward = {_list(to_file(blow.direction))}",
        "[output]",
        "glb = true",
        "wav = false",
        "picture = false",
    ]
    scene = os.path.join(folder, "break.toml")
    with open(scene, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    _run(["break", scene, "--out", folder, "--json"])
    # The surface of the ball is there earlier than its centre would be.
    return arrival - blow.radius / blow.speed, os.path.join(folder, "break.glb")


def _run(words):
    """The command line in the wheel; its error is ours."""
    package = os.path.dirname(os.path.dirname(fr.__file__))
    paths = [package, os.path.dirname(os.path.dirname(np.__file__))]
    run = subprocess.run(
        [sys.executable, "-m", "frangible", *words],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        capture_output=True,
        text=True,
        check=False,
        # No window of its own on Windows.
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
    )
    if run.returncode != 0:
        said = run.stderr.strip().splitlines() or ["it gave no reason"]
        raise ValueError(f"The painted object cannot be broken: {said[-1].removeprefix('error: ')}")
    return json.loads(run.stdout)


def _list(vector):
    return "[" + ", ".join(f"{float(x):.9g}" for x in vector) + "]"
