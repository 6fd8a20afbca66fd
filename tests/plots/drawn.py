"""What is in a figure."""
from contextlib import AbstractContextManager
from unittest import mock

from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text


def without_minor_ticks() -> AbstractContextManager:
    """A context in which figures are drawn without: they take half of the time."""
    return mock.patch.object(Axis, "get_minor_ticks", lambda axis, count=None: [])


def words_of(figure: Figure) -> str:
    # Asked for its ticks, an axis would make them all; those without words are not there yet.
    with mock.patch.multiple(Axis, get_major_ticks=lambda axis: axis.majorTicks,
                             get_minor_ticks=lambda axis: axis.minorTicks):
        texts = figure.findobj(lambda artist: hasattr(artist, "get_text"))
    return " ".join(text.get_text() for text in texts)


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
