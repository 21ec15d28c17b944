# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks by frangible's own simulation: a ball flies at the body, and all fall on the ground."""

import os
import tempfile

import frangible as fr

from .recording import BODY, TO_FILE, read_pieces, to_file

# Pictures per second of a recording.
RATE = 60
# Seconds after which a break must have come.
SOON = 0.1
# How far outside the surface a ball starts, as a share of its radius.
OUTSIDE = 0.02
# What lies no lower than this stands on the ground, m.
STANDING = 1e-3


def play(target, blow, seed, seconds):
    """The pieces of a blow and their paths, for so many seconds; no pieces if the body holds, even if its fall would break it later."""
    low = float(target.shape.world[:, 2].min())
    if low < -STANDING:
        raise ValueError(f"The object reaches {-low:.3g} m below the ground at z = 0; lift it, or choose rigid bodies for the pieces.")
    world = fr.World(floor="stone", seed=seed)
    world.add(target.body, position=to_file(target.center), rotation=TO_FILE, name=BODY)
    # The ball touches the surface at the point, and goes back along its way by a little.
    touching = blow.point + blow.radius * blow.normal
    start = touching - OUTSIDE * blow.radius * blow.direction
    if start[2] < blow.radius:
        inside = blow.radius - start[2]
        raise ValueError(f"The striker would start {inside:.3g} m inside the ground; hit the object higher up, or use a smaller striker.")
    world.throw(to_file(start), to_file(touching), blow.speed, mass=blow.mass, radius=blow.radius, material=blow.material)
    world.step(min(SOON, seconds))
    if any(thing.kind == "piece" for thing in world.things) and seconds > SOON:
        world.step(seconds - SOON)
    with tempfile.TemporaryDirectory(prefix="frangible-") as folder:
        path = os.path.join(folder, "break.glb")
        world.export(path, rate=RATE)
        pieces = read_pieces(path)
    return [piece for piece in pieces if piece.broke <= SOON + 1 / RATE]
