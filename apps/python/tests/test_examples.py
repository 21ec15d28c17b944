"""The examples run as they stand."""

import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest
from frangible import dataset

EXAMPLES = Path(__file__).parents[1] / "examples"


def test_the_notebook_runs_from_its_first_cell_to_its_last(tmp_path, monkeypatch) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    pytest.importorskip("trimesh")
    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    cells = json.loads((EXAMPLES / "plate.ipynb").read_text())["cells"]
    names: dict[str, object] = {}
    for cell in cells:
        if cell["cell_type"] == "code":
            # A viewer in a notebook needs IPython; that the scene can be made is what is asked here.
            text = "".join(cell["source"]).replace('scene.show(viewer="notebook")', "shown = scene.geometry")
            exec(compile(text, "plate.ipynb", "exec"), names)
    outcome, masses = names["outcome"], names["masses"]
    assert outcome.broke and masses.sum() == pytest.approx(names["plate"].mass, rel=1e-6)
    assert len(names["shown"]) == len(outcome.fragments)
    # It holds below the slowest speed, and the margin falls with the speed.
    assert np.all(np.diff(names["margins"]) < 0)
    assert names["things"][0] == 1 and names["things"][-1] > 1
    assert (tmp_path / "plate.glb").read_bytes()[:4] == b"glTF"


def test_the_hundred_vessels_are_closed_and_break(tmp_path) -> None:
    trimesh = pytest.importorskip("trimesh")
    spec = importlib.util.spec_from_file_location("vessels", EXAMPLES / "vessels.py")
    vessels = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(vessels)
    vessels.write(tmp_path, 100)
    files = sorted(tmp_path.glob("*.obj"))
    assert len(files) == 100
    for file in files[::7]:
        mesh = trimesh.load(file)
        assert mesh.is_watertight and mesh.volume > 1e-5
    plan = dataset.Plan(breaks=2, tetrahedra=8000, modes=40)
    summary = dataset.make([tmp_path / "cup-001.obj"], tmp_path / "data", plan, quiet=True)
    assert (summary.made, summary.failed) == (2, [])
