"""Writes files all together or not at all, and pictures small."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

# Of a colour's value: what is left of it in steps of 6.
STEPS = (255 - (255 - np.arange(256) + 2) // 6 * 6).astype(np.uint8)


def replace_all(folder: Path, writers: dict[str, Callable[[Path], object]]) -> None:
    """Each writer writes its file beside its place; when all are there they are moved to it."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder, prefix=".figures-") as temporary:
        for name, write in writers.items():
            write(Path(temporary) / name)
        for name in writers:
            os.replace(Path(temporary) / name, folder / name)


def write_small_png(figure: Figure, dpi: int, path: Path, colours: int | None = None) -> None:
    """In steps of 6/255 of colour, which halves a PNG with shades, or with so many colours."""
    figure.set_dpi(dpi)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    image = Image.fromarray(STEPS[np.asarray(canvas.buffer_rgba())[..., :3]])
    if colours:
        image = image.quantize(colours, dither=Image.Dither.NONE)
    image.save(path, format="PNG", optimize=True, dpi=(dpi, dpi))
