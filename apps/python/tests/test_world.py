"""Worlds, the command line and the examples in the documentation."""

import doctest
import json
import re
import signal
import struct
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import frangible as fr
import numpy as np
import pytest


def gltf(path: Path) -> dict:
    data = path.read_bytes()
    magic, version, length = struct.unpack("<4sII", data[:12])
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20 : 20 + size])


def test_a_body_falls_as_it_should_and_breaks(plate: fr.Body, tmp_path) -> None:
    world = fr.World(floor="stone", seed=2)
    world.add(plate, position=(0, 4.0, 0), name="plate")
    world.step(0.2)
    [thing] = world.things
    assert thing.kind == "body" and thing.name == "plate"
    assert thing.position[1] == pytest.approx(4 - 0.5 * 9.81 * world.time**2, abs=0.01)
    world.step(1.0)
    pieces = [t for t in world.things if t.kind == "piece"]
    assert len(pieces) > 1
    assert sum(t.mass for t in pieces) == pytest.approx(plate.mass, rel=1e-5)
    world.export(tmp_path / "fall.glb")
    scene = gltf(tmp_path / "fall.glb")
    assert scene["animations"] and len(scene["nodes"]) > len(pieces)


def test_another_thread_steps_a_world_while_this_one_goes_on(plate: fr.Body) -> None:
    worlds = [fr.World(floor="stone", seed=2) for _ in range(2)]
    for world in worlds:
        world.add(plate, position=(0, 1.0, 0))
    worlds[0].step(0.05)
    with ThreadPoolExecutor(1) as pool:
        there = pool.submit(worlds[0].step, 0.4)
        worlds[1].step(0.05)
        worlds[1].step(0.4)
        there.result()
    poses = [[thing.position.tolist() for thing in world.things] for world in worlds]
    assert poses[0] == poses[1]


def test_a_ball_can_be_thrown(plate: fr.Body) -> None:
    world = fr.World(floor=None)
    world.add(plate, position=(0, 0, 0))
    world.throw(start=(0, 0, 1.0), through=(0, 0, 0), speed=20, mass=0.2, radius=0.02)
    world.step(0.1)
    assert sum(t.kind == "ball" for t in world.things) == 1
    assert sum(t.kind == "piece" for t in world.things) > 1


def test_worlds_refuse_what_they_cannot_use(plate: fr.Body) -> None:
    world = fr.World()
    with pytest.raises(ValueError, match="no body"):
        world.step()
    with pytest.raises(ValueError, match="rotation"):
        world.add(plate, position=(0, 1, 0), rotation=(0, 0, 0, 2))
    world.add(plate, position=(0, 1, 0))
    with pytest.raises(ValueError, match="seconds"):
        world.step(-1)
    world.step()
    with pytest.raises(ValueError, match="before the first step"):
        world.add(plate, position=(0, 2, 0))
    with pytest.raises(ValueError, match="mass"):
        world.throw((0, 1, 1), (0, 1, 0), 5, mass=-1)
    with pytest.raises(ValueError):
        world.export("/nowhere/at/all.glb")
    with pytest.raises(ValueError, match="load_duration is -1"):
        fr.World(load_duration=-1)
    with pytest.raises(ValueError, match="cheese"):
        unknown = fr.World(floor="cheese")
        unknown.add(plate, position=(0, 1, 0))
        unknown.step()


def test_the_command_line_is_there(tmp_path) -> None:
    program = [sys.executable, "-m", "frangible"]
    listed = subprocess.run([*program, "scenes"], capture_output=True, text=True, check=True)
    assert "piggy-bank" in listed.stdout
    wrong = subprocess.run([*program, "brake"], capture_output=True, text=True, check=False)
    assert wrong.returncode == 2 and "brake" in wrong.stderr
    vertices, faces = fr.box(0.1, 0.05, 0.05)
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    (tmp_path / "block.obj").write_text("\n".join(lines))
    words = ["bake", "block.obj", "--material", "brick", "--resolution", "1500", "-o", "block.frangible"]
    subprocess.run([*program, *words], cwd=tmp_path, capture_output=True, check=True)
    assert fr.load(tmp_path / "block.frangible").material == "brick"


def test_control_c_stops_a_bake() -> None:
    # What a shell runs in the background ignores the signal unless it asks for it.
    listen = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
    code = listen + "import frangible as fr; print('begun', flush=True); fr.bake(*fr.box(1, 1, 1), tetrahedra=400000, modes=300)"
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "begun\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode != 0 and "KeyboardInterrupt" in errors


@pytest.mark.parametrize("module", [fr, fr.bodies, fr.world], ids=["frangible", "bodies", "world"])
def test_the_examples_in_the_documentation_run(module) -> None:
    assert doctest.testmod(module).failed == 0
    assert doctest.testmod(module).attempted > 0


def test_the_first_lines_of_the_readme_run() -> None:
    page = (Path(__file__).parents[1] / "README.md").read_text()
    code = re.search(r"```python\n(.*?)```", page, re.S)
    assert code is not None
    names: dict = {"np": np}
    exec(code.group(1), names)
    assert names["outcome"].broke
