"""What is drawn of a run, and how it is written: pictures small."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from record_keys import Row

# Of a colour's value: what is left of it in steps of 6.
STEPS = (255 - (255 - np.arange(256) + 2) // 6 * 6).astype(np.uint8)
VECTOR_DPI, DPI, COLOURS = 200, 120, 128
# A page shows a figure about 830 pixels wide: 100 an inch of the widest, 7 points as 9.7 pixels.
PAGE_WIDTH, SMALLEST_PT = 8.3, 7


@dataclass(frozen=True)
class Drawing:
    """A figure of a run, as the `drawings` of its module plans it."""

    name: str                          # of its files
    rows: list[Row]                    # that it shows, or names
    draw: Callable[..., Figure | str]  # of rows and options: the figure, or why there is none
    table: Callable[[list[Row]], str]  # of rows: the numbers drawn, a CSV beside the figure
    vector: bool = False               # as .svg and .png; else as a small .png
    options: dict[str, object] = field(default_factory=dict)

    @property
    def suffixes(self) -> tuple[str, ...]:
        return (".svg", ".png", ".csv") if self.vector else (".png", ".csv")

    def writer(self, figure: Figure, suffix: str) -> Callable[[Path], object]:
        if suffix == ".csv":
            return partial(Path.write_text, data=self.table(self.rows), encoding="utf-8")
        return partial(write, figure) if self.vector else \
            partial(write_small_png, figure, DPI, colours=COLOURS)


def write(figure: Figure, path: Path) -> None:
    metadata = {"Date": None} if path.suffix == ".svg" else {"Software": None}
    figure.savefig(path, dpi=VECTOR_DPI, metadata=metadata)


def write_small_png(figure: Figure, dpi: int, path: Path, colours: int | None = None) -> None:
    """In steps of 6/255 of colour, which halves a PNG with shades, or with so many colours."""
    figure.set_dpi(dpi)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    image = Image.fromarray(STEPS[np.asarray(canvas.buffer_rgba())[..., :3]])
    if colours:  # the commonest as they are, the others as the nearest of them
        known = sorted(image.getcolors(image.width * image.height), reverse=True)[:colours]
        palette = Image.new("P", (1, 1))
        palette.putpalette([value for _, colour in known for value in colour])
        image = image.quantize(palette=palette, dither=Image.Dither.NONE)
    image.save(path, format="PNG", optimize=True, dpi=(dpi, dpi))
