"""Makes a dataset on a Ray cluster, with one task per object. Tasks of a lost machine are run again on another one."""

from __future__ import annotations

import os
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from .files import meta_of
from .manifest import Row
from .plan import Object, Plan
from .run import break_all_of, failed, in_turn

# So many tasks wait for each processor, so that none is idle and the cluster's memory does not fill with those to come.
WAITING = 2
# How often an object is begun again when the process that worked on it has died.
RETRIES = 3


def each_object(todo: list[Object], out: Path, plan: Plan) -> Iterator[Row | None]:
    """Yields rows as they are completed, None for an existing break. Joins the cluster that ``ray.init`` finds, or starts one on this machine."""
    try:
        ray: Any = import_module("ray")
    except ImportError as error:
        raise ImportError("this needs Ray: pip install frangible[ray]") from error
    if not ray.is_initialized():
        # Nobody is told of this run unless its owner has said so.
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
        ray.init(log_to_driver=False)
    task = ray.remote(max_retries=RETRIES)(break_all_of)
    most = WAITING * max(int(ray.cluster_resources().get("CPU", 1)), 1)
    # The machines have other working directories.
    out = out.resolve()
    absolute = ((mesh.resolve(), material, name) for mesh, material, name in todo)
    for one, ready in in_turn(absolute, most, lambda one: task.remote(one, out, plan), lambda waiting: ray.wait(waiting, num_returns=1)[0]):
        try:
            yield from ray.get(ready)
        except ray.exceptions.RayError as error:
            yield from _lost(one, out, plan, error)


def _lost(one: Object, out: Path, plan: Plan, error: Exception) -> Iterator[Row | None]:
    """Yields the rows of an object whose task died at every attempt, None for the breaks that were made before."""
    mesh, material, name = one
    row = {"category": plan.category, "object": name, "mesh": mesh.name, "material": material}
    for k in range(plan.breaks):
        there = meta_of(out, plan, name, k).with_suffix(".json").exists()
        yield None if there else failed(row, k, f"the task died: {error}".splitlines()[0])
