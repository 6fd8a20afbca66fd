"""What is in a figure."""
import csv
from contextlib import AbstractContextManager
from itertools import combinations
from pathlib import Path
from unittest import TestCase, mock

import matplotlib
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

import made_up  # finds plots

import drawing as sheets
import figures
from drawing import SMALLEST_PT, Drawing
from records import Row
from running import FolderTest, run


class FiguresTest(FolderTest):
    program = figures

    def setUp(self) -> None:
        super().setUp()
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(sheets.STYLE)

    def draw(self, rows: list[dict] | None = None) -> tuple[str, dict[str, str]]:
        """stdout, and the words in each figure of these, or of the folder's records; nothing is
        rendered."""
        kept: dict[str, Figure] = {}

        def keep(figure: Figure, *place: object, **_: object) -> None:
            kept[place[-1].stem] = figure
            place[-1].touch()
        if rows is not None:
            made_up.write(self.csv, rows)
        with mock.patch.multiple(sheets, write=keep, write_small_png=keep):
            status, out, err = run(figures, self.results)
        self.assertEqual((status, err), (0, ""))
        return out, {name: words_of(figure) for name, figure in kept.items()}


def plan(rows: list[Row], name: str) -> Drawing:
    """Of all the drawings of these rows."""
    drawing, = (drawing for drawing in figures.drawings_of(rows) if drawing.name == name)
    return drawing


def table_of(drawing: Drawing) -> list[dict[str, str]]:
    return list(csv.DictReader(drawing.table(drawing.rows).splitlines()))


def assert_fonts_inside(test: TestCase, figure: Path) -> None:
    """Its PDF has its fonts as TrueType, its SVG needs none; figure: without suffix."""
    pdf = figure.with_name(figure.name + ".pdf").read_bytes()
    test.assertTrue(pdf.startswith(b"%PDF"), figure)
    test.assertIn(b"/FontFile2", pdf)
    test.assertNotIn(b"/Type3", pdf)
    test.assertNotIn(b"/CreationDate", pdf)  # the same bytes tomorrow
    svg = figure.with_name(figure.name + ".svg").read_text(encoding="utf-8")
    test.assertIn("<path", svg)
    test.assertNotIn("<text", svg)


def without_minor_ticks() -> AbstractContextManager:
    """A context in which figures are drawn without: they take half of the time."""
    return mock.patch.object(Axis, "get_minor_ticks", lambda axis, count=None: [])


def words_of(figure: Figure) -> str:
    """Of the picture and of its caption."""
    # Asked for its ticks, an axis would make them all; those without words are not there yet.
    with mock.patch.multiple(Axis, get_major_ticks=lambda axis: axis.majorTicks,
                             get_minor_ticks=lambda axis: axis.minorTicks):
        texts = figure.findobj(lambda artist: hasattr(artist, "get_text"))
    words = [text.get_text() for text in texts] + [getattr(figure, "caption", "")]
    return " ".join(" ".join(words).split())


def paint(figure: Figure) -> tuple[list[Text], object]:
    """The texts that are painted, and who painted them."""
    painted: list[Text] = []
    draw = Text.draw

    def keep(words: Text, renderer: object) -> None:
        if words.get_visible() and words.get_text().strip():
            painted.append(words)
        draw(words, renderer)
    canvas = FigureCanvasAgg(figure)
    with mock.patch.object(Text, "draw", keep):
        canvas.draw()
    return painted, canvas.get_renderer()


def assert_readable(test: TestCase, figure: Figure, painted: list[Text], renderer: object) -> None:
    """Words are large enough, on the sheet and apart, but for a pixel; those at an angle are passed
    over."""
    boxes = [(words, words.get_window_extent(renderer)) for words in painted
             if words.get_rotation() in (0, 90)]
    for words, box in boxes:
        test.assertGreaterEqual(words.get_fontsize(), SMALLEST_PT, words)
        test.assertTrue(0 <= box.x0 and box.x1 <= figure.bbox.x1 and 0 <= box.y0
                        and box.y1 <= figure.bbox.y1, words)
    for (words, box), (other, other_box) in combinations(boxes, 2):
        test.assertFalse(box.padded(-1).overlaps(other_box), f"{words} {other}")
