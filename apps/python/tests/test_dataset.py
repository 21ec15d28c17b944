"""Datasets: what is in them, and that nothing is lost or made twice."""

import hashlib
import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path

import frangible as fr
import numpy as np
import pytest
from frangible import dataset

PLAN = dataset.Plan(materials=("glass", "concrete"), breaks=3, tetrahedra=1500, modes=20, val_share=0.5, pieces=(2, 40))


def write_obj(path: Path, sides: tuple[float, float, float]) -> Path:
    vertices, faces = fr.box(*sides)
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    path.write_text("\n".join(lines))
    return path


@pytest.fixture(scope="module")
def meshes(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("meshes")
    return [write_obj(folder / "tile.obj", (0.1, 0.08, 0.05)), write_obj(folder / "block.obj", (0.1, 0.05, 0.05))]


@pytest.fixture(scope="module")
def made(meshes: list[Path], tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dataset.Summary]:
    out = tmp_path_factory.mktemp("data")
    return out, dataset.make(meshes, out, PLAN, quiet=True)


def files(folder: Path) -> dict[str, bytes]:
    return {str(f.relative_to(folder)): f.read_bytes() for f in sorted(folder.rglob("*")) if f.is_file() and "manifest" not in f.parts}


def test_breaks_are_in_the_layout_that_loaders_list(made) -> None:
    trimesh = pytest.importorskip("trimesh")
    out, summary = made
    assert (summary.made, summary.there, summary.failed) == (12, 0, [])
    root = out / "breaking_bad"
    named = [line for split in ("train", "val") for line in (root / f"everyday.{split}.txt").read_text().split()]
    assert len(named) == len(set(named)) == 4
    assert all((root / f"everyday.{s}.txt").read_text() == (root / "data_split" / f"everyday.{s}.txt").read_text() for s in ("train", "val"))
    # As the loaders do: each folder of an object whose name has this word, and every file of it, of which trimesh reads 2 to 20.
    lines = [f"{name}/{folder}" for name in named for folder in os.listdir(root / name) if "fractured" in folder]
    assert len(lines) == 12
    for line in lines:
        there = sorted(os.listdir(root / line))
        assert 2 <= len(there) <= 40
        assert there == sorted(f"piece_{i}.obj" for i in range(len(there)))
        pieces = [trimesh.load(root / line / name) for name in there]
        about = json.loads((out / "meta" / f"{line}.json").read_text())
        assert all(p.is_watertight for p in pieces)
        volumes = [p["volume"] for p in about["pieces"]]
        assert sorted(p.volume for p in pieces) == pytest.approx(sorted(volumes), rel=1e-4)
        assert volumes == sorted(volumes, reverse=True)
        assert volumes[-1] >= PLAN.least_share * sum(volumes)
        assert sum(p["mass"] for p in about["pieces"]) == pytest.approx(about["mass"], rel=1e-6)
        blow = about["blow"]
        assert blow["speed"] > 0 and about["touching"]
        assert blow["kind"] == "ball" or blow["speed"] ** 2 == pytest.approx(2 * 9.81 * blow["height"])


def test_an_object_is_in_one_split(made) -> None:
    out, _ = made
    train, val = (
        {line.split("/")[1] for line in (out / "breaking_bad/data_split" / f"everyday.{s}.txt").read_text().split()} for s in ("train", "val")
    )
    assert not train & val
    assert train | val == {"tile-glass", "tile-concrete", "block-glass", "block-concrete"}


def test_the_manifest_has_a_row_for_each_break(made) -> None:
    out, _ = made
    rows = [json.loads(line) for line in (out / "manifest" / "0-of-1.jsonl").read_text().splitlines()]
    assert len(rows) == 12 and all(row["failed"] is None and row["seconds"] > 0 for row in rows)
    import hashlib

    row = rows[0]
    folder = out / "breaking_bad" / row["category"] / row["object"] / f"fractured_{row['break']}"
    for name, digest in row["sha256"].items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest


def test_shards_and_workers_make_the_same_bits(made, meshes, tmp_path) -> None:
    out, _ = made
    for shard, workers in (((1, 2), 1), ((0, 2), 2)):
        dataset.make(meshes, tmp_path, PLAN, shard=shard, workers=workers, quiet=True)
    mine, theirs = files(tmp_path), files(out)
    assert mine.keys() == theirs.keys()
    for name, content in mine.items():
        assert content == theirs[name], name


def test_what_is_there_is_not_made_again(made, meshes) -> None:
    out, _ = made
    before = files(out)
    again = dataset.make(meshes, out, PLAN, quiet=True)
    assert (again.made, again.there) == (0, 12)
    assert files(out) == before
    with pytest.raises(ValueError, match="another plan"):
        dataset.make(meshes, out, replace(PLAN, seed=2), quiet=True)


def test_a_mesh_that_has_changed_is_broken_anew(tmp_path) -> None:
    plan = replace(PLAN, materials=("glass",), breaks=2)
    mesh = write_obj(tmp_path / "tile.obj", (0.1, 0.08, 0.05))
    out = tmp_path / "data"
    dataset.make([mesh], out, plan, quiet=True)
    before = files(out)
    write_obj(mesh, (0.1, 0.08, 0.04))
    changed = dataset.make([mesh], out, plan, quiet=True)
    assert (changed.made, changed.there, changed.failed) == (2, 0, [])
    rows = [json.loads(line) for line in (out / "manifest" / "0-of-1.jsonl").read_text().splitlines()]
    assert len(rows) == 2
    # As if the mesh had never been another one.
    fresh = tmp_path / "fresh"
    dataset.make([mesh], fresh, plan, quiet=True)
    assert files(out) == files(fresh) != before


def test_a_run_that_is_killed_loses_nothing(made, meshes, tmp_path) -> None:
    out, _ = made
    words = words_of(meshes, tmp_path)
    plan = replace(PLAN, modes=dataset.Plan().modes, val_share=dataset.Plan().val_share)
    kills = int(os.environ.get("FRANGIBLE_KILLS", "3"))
    moments = np.random.default_rng(1).uniform(0.8, 2.6, kills)
    for wait in moments:
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
        time.sleep(wait)
        if process.poll() is not None:
            # All is made: the next run begins anew.
            shutil.rmtree(tmp_path)
            continue
        process.send_signal(signal.SIGKILL)
        process.wait()
        # What has its final name is whole.
        for file in tmp_path.glob("meta/*/*/*.json"):
            about = json.loads(file.read_text())
            folder = tmp_path / "breaking_bad" / file.relative_to(tmp_path / "meta").with_suffix("")
            hashes = {piece.name: hashlib.sha256(piece.read_bytes()).hexdigest() for piece in folder.iterdir()}
            assert hashes == about["sha256"]
            assert np.load(file.with_suffix(".npz")).files
    subprocess.run(words, check=True, capture_output=True)
    fresh = tmp_path / "fresh"
    dataset.make(meshes, fresh, plan, quiet=True)
    killed = {name: content for name, content in files(tmp_path).items() if not name.startswith(("fresh", "parts"))}
    assert killed == files(fresh)


def words_of(meshes: list[Path], out: Path) -> list[str]:
    words = [sys.executable, "-m", "frangible", "dataset", *map(str, meshes), "-o", str(out), "--material", "glass", "--material", "concrete"]
    return [*words, "--breaks", "3", "--tetrahedra", "1500", "--pieces", "2-40", "--quiet"]


def test_two_runs_into_one_folder_make_what_one_makes(meshes, tmp_path) -> None:
    both, one = tmp_path / "both", tmp_path / "one"
    runs = [subprocess.Popen(words_of(meshes, both), stderr=subprocess.PIPE) for _ in range(2)]
    assert [(run.wait(), run.stderr.read()) for run in runs] == [(0, b"")] * 2
    subprocess.run(words_of(meshes, one), check=True, capture_output=True)
    assert {n: c for n, c in files(both).items() if not n.startswith("parts")} == files(one)


def test_a_run_that_another_one_overtakes_goes_on(meshes, tmp_path, monkeypatch) -> None:
    plan = replace(PLAN, materials=("glass",), breaks=1)
    put, overtaken = os.replace, []

    def late(source: Path, target: Path) -> None:
        if source.name == "pieces" and not overtaken:
            # Between a look at the place and the move another run has put its pieces there.
            overtaken.append(target)
            target.mkdir()
            (target / "piece_0.obj").write_text("v 0 0 0\n")
        put(source, target)

    monkeypatch.setattr(os, "replace", late)
    dataset.make(meshes[:1], tmp_path / "late", plan, quiet=True)
    monkeypatch.undo()
    dataset.make(meshes[:1], tmp_path / "one", plan, quiet=True)
    assert overtaken and files(tmp_path / "late") == files(tmp_path / "one")


def test_a_full_disk_is_named_and_the_same_call_goes_on(meshes, tmp_path) -> None:
    full, one = tmp_path / "full", tmp_path / "one"
    words = words_of(meshes, full)
    limited = f"ulimit -f 8; exec {shlex.join(words)}"
    run = subprocess.run(["sh", "-c", limited], capture_output=True, text=True, check=False)
    assert run.returncode == 1, run.stderr
    message = run.stderr.strip().splitlines()
    assert len(message) == 1 and "the same call continues" in message[0] and str(full) in message[0], run.stderr
    assert not list(full.glob("breaking_bad/*/*/*")) and not list(full.glob("meta/*/*/*.json"))
    subprocess.run(words, check=True, capture_output=True)
    subprocess.run(words_of(meshes, one), check=True, capture_output=True)
    assert files(full) == files(one)


def test_the_manifest_mends_itself(made, meshes) -> None:
    out, _ = made
    file = out / "manifest" / "0-of-1.jsonl"
    before = file.read_text()
    lines = before.splitlines()
    # A row is lost, one is there twice, one is half written.
    file.write_text("\n".join([lines[0], *lines[2:], lines[2]]) + "\n" + lines[1][:40])
    dataset.make(meshes, out, PLAN, quiet=True)
    settled = [json.loads(line) for line in file.read_text().splitlines()]
    expected = [json.loads(line) for line in lines]
    assert settled[1].pop("seconds") is None and expected[1].pop("seconds") > 0
    assert settled == expected
    file.write_text(before)


def ray_workers() -> list[int]:
    """Processes of Ray that break an object now."""
    found = []
    for folder in Path("/proc").iterdir():
        try:
            if folder.name.isdigit() and b"ray::break_all_of" in (folder / "cmdline").read_bytes():
                found.append(int(folder.name))
        except OSError:
            continue
    return found


@pytest.mark.skipif(not Path("/proc/self/cmdline").exists(), reason="finds the workers' processes in /proc")
def test_a_ray_worker_that_is_killed_loses_nothing(made, meshes, tmp_path) -> None:
    ray = pytest.importorskip("ray")
    out, _ = made
    os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    killed = []
    done = threading.Event()

    def kill() -> None:
        while not killed and not done.is_set():
            # Once something is made: then there is something to lose.
            if any(tmp_path.glob("meta/*/*/*.json")):
                for worker in ray_workers()[:1]:
                    os.kill(worker, signal.SIGKILL)
                    killed.append(worker)
            time.sleep(0.01)

    thread = threading.Thread(target=kill)
    thread.start()
    try:
        summary = dataset.make(meshes, tmp_path, PLAN, ray=True, quiet=True)
    finally:
        done.set()
        thread.join()
        ray.shutdown()
    assert killed
    assert summary.failed == [] and summary.made + summary.there == 12
    mine, theirs = ({n: c for n, c in files(f).items() if not n.startswith("parts")} for f in (tmp_path, out))
    assert mine == theirs
    rows = [json.loads(line) for line in (tmp_path / "manifest" / "0-of-1.jsonl").read_text().splitlines()]
    keys = [(row["object"], row["break"]) for row in rows]
    assert len(keys) == len(set(keys)) == 12


def test_hdf5_has_exact_neighbours_in_the_order_that_garf_lists(made, meshes) -> None:
    h5py = pytest.importorskip("h5py")
    out, _ = made
    path = out.parent / "garf.hdf5"
    assert dataset.write_hdf5(out, path) == 12
    with h5py.File(path) as file:
        names = [n.decode() for split in ("train", "val") for n in file[f"data_split/everyday/{split}"]]
        assert len(names) == 12
        for name in names:
            group = file[name]
            keys = list(group["pieces"].keys())
            assert keys == sorted(keys, key=int)
            pieces = [(group["pieces"][k]["vertices"][:], group["pieces"][k]["faces"][:], group["pieces"][k]["shared_faces"][:]) for k in keys]
            for i, (vertices, faces, shared) in enumerate(pieces):
                assert len(shared) == len(faces) and shared.max() < len(pieces) and i not in shared
                for j in set(shared[shared >= 0]):
                    here = vertices[faces[shared == j]].mean(axis=1)
                    other = pieces[j]
                    there = other[0][other[1][other[2] == i]].mean(axis=1)
                    assert np.linalg.norm(here[:, None] - there[None], axis=2).min(axis=1).max() < 1e-6
            masks, order = group["removal_masks"][:], group["removal_order"][:]
            assert masks.shape == (len(keys) - 1, len(keys)) and len(order) == len(set(order)) == len(keys) - 1
            assert (masks.sum(axis=1) == np.arange(len(keys) - 1, 0, -1)).all()


def test_one_hdf5_file_holds_all_categories_in_the_unit_of_each(meshes, tmp_path) -> None:
    h5py = pytest.importorskip("h5py")
    few = replace(PLAN, materials=("glass",), breaks=1)
    everyday = dataset.make(meshes[:1], tmp_path, few, quiet=True)
    artifact = dataset.make(meshes[:1], tmp_path, replace(few, category="artifact", normalized=True), quiet=True)
    assert (everyday.made, artifact.made) == (1, 1)
    path = tmp_path / "garf.hdf5"
    assert dataset.write_hdf5(tmp_path, path) == 2

    def sides(vertices: list[np.ndarray]) -> float:
        return float(np.ptp(np.concatenate(vertices), axis=0).max())

    with h5py.File(path) as file:
        for category, longest in (("everyday", 0.1), ("artifact", 1.0)):
            name = f"{category}/tile/fractured_0"
            named = [n.decode() for split in ("train", "val") for n in file[f"data_split/{category}/{split}"]]
            assert named == [name]
            pieces = file[name]["pieces"]
            assert sides([pieces[k]["vertices"][:] for k in pieces]) == pytest.approx(longest, rel=1e-3)
            texts = [f.read_text() for f in sorted((tmp_path / "breaking_bad" / name).glob("*.obj"))]
            corners = [np.array([line.split()[1:] for line in text.splitlines() if line.startswith("v ")], dtype=float) for text in texts]
            assert sides(corners) == pytest.approx(longest, rel=1e-3)
            assert json.loads((tmp_path / "meta" / f"{name}.json").read_text())["unit"] == pytest.approx(0.1 / longest, rel=1e-3)


def test_what_cannot_be_baked_is_a_row(meshes, tmp_path) -> None:
    (tmp_path / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    plan = replace(PLAN, materials=("glass",), breaks=1)
    summary = dataset.make([tmp_path / "flat.obj", meshes[0]], tmp_path / "out", plan, quiet=True)
    assert summary.made == 1
    [row] = summary.failed
    assert row["object"] == "flat" and row["failed"]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"breaks": 0}, "breaks is 0"),
        ({"pieces": (5, 3)}, "pieces is 5 to 3"),
        ({"least_share": -1}, "least_share"),
        ({"materials": ()}, "no material"),
    ],
)
def test_plans_that_mean_nothing_are_refused(change, words) -> None:
    with pytest.raises(ValueError, match=words):
        replace(PLAN, **change)


def test_meshes_of_one_name_are_refused(meshes, tmp_path) -> None:
    twin = write_obj(tmp_path / "tile.obj", (1, 1, 1))
    with pytest.raises(ValueError, match="the same name"):
        dataset.objects([meshes[0], twin], PLAN)
    with pytest.raises(ValueError, match="not a file"):
        dataset.objects([tmp_path / "nothing.obj"], PLAN)
    with pytest.raises(ValueError, match="shard"):
        dataset.objects(meshes, PLAN, (2, 2))


def test_datasets_are_imported_where_they_are_asked_for() -> None:
    code = (
        "import sys, frangible as fr; assert 'frangible.dataset' not in sys.modules; "
        "print(fr.dataset.Plan().breaks, *({'h5py', 'ray'} & set(sys.modules))); fr.nothing"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.stdout.split() == [str(dataset.Plan().breaks)]
    assert "AttributeError: module 'frangible' has no attribute 'nothing'" in run.stderr
