"""The list of all breaks of a shard: how each was made, or why it failed."""

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

    Lines are appended as breaks are made. A killed run may leave a partial line, or a break without a line; :meth:`settle` repairs both.
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
        """Keeps the latest row of each break, and restores missing rows of existing breaks of these objects."""
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
    """Returns the row of a break from its metadata. The time is known only in the run that made the break."""
    keys = ("category", "object", "mesh", "mesh_sha256", "material", "break", "blow", "sha256")
    return {**{key: about[key] for key in keys}, "failed": None, "seconds": seconds}
