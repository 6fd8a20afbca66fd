"""What is shown of names and messages that others have chosen, as support/messages.hpp has it."""
import contextlib
import io
import os
import re
import sys
import unicodedata
from collections.abc import Iterator
from typing import TextIO

OBEYED = {"Cc", "Cf", "Cs", "Zl", "Zp"}  # by a terminal; or without a glyph
MOST_OF_WORD = 400


def escaped(text: str, backslash: str = "\\") -> str:
    r"""Control characters as \x1b, marks of writing direction as \u202e, bytes that are not UTF-8 as \xff."""
    def shown(c: str) -> str:
        code = ord(c)
        if c in "\n\t" or unicodedata.category(c) not in OBEYED:
            return c
        is_byte = code < 0x80 or 0xDC80 <= code <= 0xDCFF
        return backslash + (f"x{code & 0xFF:02x}" if is_byte else f"u{code:04x}")
    return "".join(map(shown, text))


def in_figures(name: str, most: int = 60) -> str:
    """A name that has room, and glyphs that show."""
    name = escaped(name)
    return name if len(name) <= most else f"{name[:most // 2]}…{name[-(most // 2 - 1):]}"


class Messages(io.TextIOBase):
    def __init__(self, stream: TextIO) -> None:
        self.stream = stream

    def write(self, text: str) -> int:
        encoding = self.stream.encoding or "utf-8"
        shown = re.sub(rf"(\S{{{MOST_OF_WORD}}})\S+", r"\1…", escaped(text))
        self.stream.write(shown.encode(encoding, "backslashreplace").decode(encoding))
        return len(text)

    def flush(self) -> None:
        if not self.stream.closed:  # at the end of the program; Python 3.13 tells what fails there
            self.stream.flush()


@contextlib.contextmanager
def messages_escaped() -> Iterator[None]:
    """On standard output and standard error, which may be closed. Throws OSError where output cannot be written."""
    with contextlib.ExitStack() as opened:
        def shown(stream: TextIO | None) -> Messages:
            return Messages(stream or opened.enter_context(open(os.devnull, "w", encoding="utf-8")))
        out = shown(sys.stdout)
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(shown(sys.stderr)):
            yield
