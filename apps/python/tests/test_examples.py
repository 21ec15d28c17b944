"""The examples run as they stand."""

import importlib.util
from pathlib import Path

import pytest
from frangible import dataset

EXAMPLES = Path(__file__).parents[1] / "examples"


# What is asked of the notebook's names after its last cell.
CHECKS = """
assert outcome.broke and abs(masses.sum() / plate.mass - 1) < 1e-6
assert len(scene.geometry) == len(outcome.fragments)
# It holds below the slowest speed, and the margin falls with the speed.
assert (np.diff(margins) < 0).all()
assert things[0] == 1 and things[-1] > 1
"""


def test_the_notebook_runs_in_a_kernel_from_its_first_cell_to_its_last(tmp_path) -> None:
    for needed in ("ipykernel", "matplotlib", "nbclient", "scipy", "trimesh"):
        pytest.importorskip(needed)
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(EXAMPLES / "plate.ipynb", as_version=4)
    notebook.cells.append(nbformat.v4.new_code_cell(CHECKS))
    NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}).execute()
    kinds = [kind for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs for kind in output.get("data", ())]
    assert kinds.count("image/png") == 5 and kinds.count("text/html") == 1
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
