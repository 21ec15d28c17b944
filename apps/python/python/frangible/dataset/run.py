"""Makes the missing breaks of a dataset, in one process or several."""

from __future__ import annotations

import hashlib
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path
from typing import TypeVar

from ..bodies import bake
from .blows import broken
from .files import is_there, keep_plan, write_break, write_splits
from .manifest import Manifest, Row, row_of
from .plan import Object, Plan, objects

Task = TypeVar("Task")


@dataclass
class Summary:
    """Summary of a run.

    Attributes:
        made: Number of breaks made in this run.
        there: Number of breaks that already existed.
        failed: Rows of the failed breaks, with the reason.
        seconds: Total time of all workers, s.
    """

    made: int = 0
    there: int = 0
    failed: list[Row] = field(default_factory=list)
    seconds: float = 0.0


def make(
    meshes: Sequence[Path],
    out: Path,
    plan: Plan,
    *,
    shard: tuple[int, int] = (0, 1),
    workers: int = 1,
    ray: bool = False,
    quiet: bool = False,
) -> Summary:
    """Makes the missing breaks of a shard. An object that cannot be baked gets a row in the manifest and does not stop the run.

    Args:
        meshes: Mesh files.
        out: The folder of the dataset.
        plan: Settings of the dataset.
        shard: ``(i, n)``: every n-th object, starting with the i-th.
        workers: Number of processes on this machine.
        ray: Use a Ray cluster instead; all its machines must see ``out`` and the meshes under these paths.
        quiet: Print no progress.

    Raises:
        ValueError: The meshes, the plan or the folder are invalid, or a worker was killed; completed breaks are kept, and the same call
            continues with the rest.
    """
    todo = objects(meshes, plan, shard)
    keep_plan(out, plan)
    summary, begin = Summary(), time.monotonic()
    manifest = Manifest(out, plan, shard)
    names = [name for _, _, name in todo]
    manifest.settle(names)
    if ray:
        from .cluster import each_object

        rows = each_object(todo, out, plan)
    else:
        rows = _each(todo, out, plan, workers)
    for done, row in enumerate(rows, 1):
        if row is None:
            summary.there += 1
        else:
            manifest.add(row)
            summary.seconds += row["seconds"]
            if row["failed"] is None:
                summary.made += 1
            else:
                summary.failed.append(row)
        if not quiet:
            _tell(done, len(todo) * plan.breaks, (time.monotonic() - begin) / max(done - summary.there, 1))
    if not quiet:
        print(file=sys.stderr)
    manifest.settle(names)
    write_splits(out, plan)
    return summary


def _tell(done: int, all_of_them: int, each: float) -> None:
    """Prints the number of completed breaks and the remaining time, from the mean time per break, s."""
    left = each * (all_of_them - done)
    print(f"\r{done} of {all_of_them} breaks, {left / 60:.0f} min left ", end="", file=sys.stderr, flush=True)


def _each(todo: list[Object], out: Path, plan: Plan, workers: int) -> Iterator[Row | None]:
    """Yields rows as they are completed, None for an existing break."""
    if workers <= 1:
        for one in todo:
            yield from break_object(one, out, plan)
        return
    # A forked process would have none of the threads that bake.
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:

        def submit(one: Object) -> Future[list[Row | None]]:
            return pool.submit(break_all_of, one, out, plan)

        def first(waiting: list[Future[list[Row | None]]]) -> Iterable[Future[list[Row | None]]]:
            return wait(waiting, return_when=FIRST_COMPLETED).done

        for _, future in in_turn(todo, 2 * workers, submit, first):
            try:
                yield from future.result()
            except BrokenProcessPool as error:
                raise ValueError(
                    "a worker was killed, perhaps because memory ran out; completed breaks are kept: run this again with fewer workers"
                ) from error


def in_turn(
    todo: Iterable[Object], most: int, submit: Callable[[Object], Task], first: Callable[[list[Task]], Iterable[Task]]
) -> Iterator[tuple[Object, Task]]:
    """Yields objects with their completed tasks. At most ``most`` tasks are pending, so a million objects are never all in memory."""
    waiting: dict[Task, Object] = {}
    rest = iter(todo)
    while True:
        for one in rest:
            waiting[submit(one)] = one
            if len(waiting) >= most:
                break
        if not waiting:
            return
        for task in first(list(waiting)):
            yield waiting.pop(task), task


def break_all_of(one: Object, out: Path, plan: Plan) -> list[Row | None]:
    """Returns all rows of one object, for a worker process."""
    return list(break_object(one, out, plan))


def break_object(one: Object, out: Path, plan: Plan) -> Iterator[Row | None]:
    """Breaks one object. Yields a row for each break, None for an existing one."""
    mesh, material, name = one
    row = {"category": plan.category, "object": name, "mesh": mesh.name, "material": material}
    try:
        digest = hashlib.sha256(mesh.read_bytes()).hexdigest()
    except OSError as error:
        for k in range(plan.breaks):
            yield failed(row, k, error)
        return
    missing = [k for k in range(plan.breaks) if not is_there(out, plan, name, k, digest)]
    yield from [None] * (plan.breaks - len(missing))
    if not missing:
        return
    begin = time.monotonic()
    try:
        body = bake(
            mesh, material=material, name=name, size=plan.size, wall=plan.wall, tetrahedra=plan.tetrahedra, modes=plan.modes, seed=plan.seed
        )
    except ValueError as error:
        for k in missing:
            yield failed(row, k, error, (time.monotonic() - begin) / len(missing))
        return
    baked = (time.monotonic() - begin) / len(missing)
    row["mesh_sha256"] = digest
    for k in missing:
        begin = time.monotonic()
        try:
            found, blow = broken(body, plan, name, k)
            about = write_break(out, plan, body, found, {**row, **blow, "break": k})
            yield row_of(about, time.monotonic() - begin + baked)
        except ValueError as error:
            yield failed(row, k, error, time.monotonic() - begin + baked)


def failed(row: Row, k: int, error: object, seconds: float = 0.0) -> Row:
    """Returns the row of a failed break, with the reason."""
    return {**row, "break": k, "failed": str(error), "seconds": seconds}
