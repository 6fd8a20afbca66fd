"""Writes files all together or not at all."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path


def replace_all(folder: Path, writers: dict[str, Callable[[Path], object]]) -> None:
    """Each writer writes its file beside its place; when all are there they are moved to it."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder, prefix=".figures-") as temporary:
        for name, write in writers.items():
            write(Path(temporary) / name)
        for name in writers:
            os.replace(Path(temporary) / name, folder / name)
