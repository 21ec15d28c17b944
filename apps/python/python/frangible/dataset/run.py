"""Makes the breaks of a dataset that are not there yet, in one process or in several."""

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
    """What a run did.

    Attributes:
        made: Breaks made in this run.
        there: Breaks that were there already.
        failed: Rows of what could not be made, with the reason.
        seconds: The time of all workers together, s.
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
    """Makes the breaks of a shard that are not there yet; an object that cannot be baked is a row, not the end.

    Args:
        meshes: Mesh files.
        out: The folder of the dataset.
        plan: What is made of each mesh.
        shard: ``(i, n)``: every n-th object from the i-th on.
        workers: Processes on this machine.
        ray: Gives the objects to a Ray cluster instead, whose machines all see ``out`` and the meshes under these paths.
        quiet: Tells no progress.

    Raises:
        ValueError: Something about the meshes, the plan or the folder, or a process was killed: what was made stays, and the same call goes on.
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
    """Says how many breaks there are and how long the others take, each this long, s."""
    left = each * (all_of_them - done)
    print(f"\r{done} of {all_of_them} breaks, {left / 60:.0f} min left ", end="", file=sys.stderr, flush=True)


def _each(todo: list[Object], out: Path, plan: Plan, workers: int) -> Iterator[Row | None]:
    """Rows as they come, None for what is there."""
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
                    "a worker was killed, perhaps for want of memory; what was made is kept: run this again, with fewer workers"
                ) from error


def in_turn(
    todo: Iterable[Object], most: int, submit: Callable[[Object], Task], first: Callable[[list[Task]], Iterable[Task]]
) -> Iterator[tuple[Object, Task]]:
    """Objects with their tasks as these end, of which so many wait at most: a million objects are not all in memory."""
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
    """All rows of one object, for a worker that gives them back together."""
    return list(break_object(one, out, plan))


def break_object(one: Object, out: Path, plan: Plan) -> Iterator[Row | None]:
    """Breaks one object; a row for each break, None where it is there."""
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
    """The row of a break that could not be made, with the reason."""
    return {**row, "break": k, "failed": str(error), "seconds": seconds}
