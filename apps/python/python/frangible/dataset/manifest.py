"""The list of all breaks of a shard: how each was made, or why it could not be."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from .files import meta_of
from .plan import Plan

Row = dict[str, Any]


class Manifest:
    """A file with a line of JSON for each break of a shard.

    Lines are added as breaks are made. A run that is killed may leave half a line, or a break without one; :meth:`settle` mends both.
    """

    def __init__(self, out: Path, plan: Plan, shard: tuple[int, int]) -> None:
        self.out, self.plan = out, plan
        self.file = out / "manifest" / f"{shard[0]}-of-{shard[1]}.jsonl"
        self.file.parent.mkdir(parents=True, exist_ok=True)

    def add(self, row: Row) -> None:
        """Adds a row at the end."""
        with self.file.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row, sort_keys=True) + "\n")

    def settle(self, names: Iterable[str]) -> None:
        """Leaves one row for each break, the latest, and gives those of these objects that are there without a row the one they lost."""
        rows = {(row["category"], row["object"], row["break"]): row for row in self._rows()}
        for name in names:
            for k in range(self.plan.breaks):
                key = (self.plan.category, name, k)
                row = rows.get(key)
                meta = meta_of(self.out, self.plan, name, k).with_suffix(".json")
                if (row is None or row["failed"] is not None) and meta.exists():
                    rows[key] = row_of(json.loads(meta.read_text()))
        part = self.file.with_suffix(f".{os.getpid()}.part")
        part.write_text("".join(json.dumps(row, sort_keys=True) + "\n" for _, row in sorted(rows.items())), encoding="utf-8")
        os.replace(part, self.file)

    def _rows(self) -> Iterable[Row]:
        if not self.file.exists():
            return
        for line in self.file.read_text(encoding="utf-8").splitlines():
            try:
                yield json.loads(line)
            except json.JSONDecodeError:
                # Half a line, of a run that was killed while it wrote.
                continue


def row_of(about: Row, seconds: float | None = None) -> Row:
    """The row of a break from what is written about it; the seconds that it took are known to the run that made it alone."""
    keys = ("category", "object", "mesh", "mesh_sha256", "material", "break", "blow", "sha256")
    return {**{key: about[key] for key in keys}, "failed": None, "seconds": seconds}
