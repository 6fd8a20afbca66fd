"""What the programs share: wrong input ends them with one line and exit status 2, and files are
written whole."""
import argparse
import fcntl
import os
import shutil
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from fnmatch import fnmatchcase
from functools import partial
from pathlib import Path

from messages import messages_escaped
from records import RecordsError

PARTS = ".airybench.part"  # a folder of files that are not whole yet
MADE = ".airybench.made"  # the files of a folder that programs made, a line each: PROGRAM/FILE


def run(doc: str, add_arguments: Callable[[argparse.ArgumentParser], object],
        act: Callable[[argparse.Namespace], object], expected: str) -> None:
    """expected: what a place that cannot be written should have been, for the message."""
    with messages_escaped(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", r"(?s)Glyph .* missing")  # an empty box tells it
        run_shown(doc, add_arguments, act, expected)


def run_shown(doc: str, add_arguments: Callable[[argparse.ArgumentParser], object],
              act: Callable[[argparse.Namespace], object], expected: str) -> None:
    def fail(message: object) -> None:
        print(f"{Path(sys.argv[0]).name}: {message}", file=sys.stderr)
        sys.exit(2)

    parser = argparse.ArgumentParser(description=doc,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    add_arguments(parser)
    try:
        arguments, unknown = parser.parse_known_args()
        if unknown:
            fail(f"unknown '{' '.join(unknown)}' (valid: {', '.join(valid_arguments(parser))})")
        act(arguments)
        sys.stdout.flush()
    except RecordsError as error:
        fail(error)
    except OSError as error:
        if error.filename is None and sys.__stdout__ is not None:  # what its buffer holds would fail at exit, too
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.__stdout__.fileno())
        fail(f"{error.filename or 'standard output'}: {error.strerror}; expected {expected}")
    except MemoryError:
        fail("out of memory")
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)


def valid_arguments(parser: argparse.ArgumentParser) -> list[str]:
    """Options as typed; of the others what they are: their help up to a semicolon, or their name."""
    shown = [action for action in parser._actions if action.help != argparse.SUPPRESS and action.dest != "help"]
    return [f"{action.option_strings[0]}{f'={action.metavar}' * (action.nargs != 0)}" if action.option_strings
            else (action.help or str(action.metavar)).split(";")[0] for action in shown]


def results_and_out(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR", help="the --out of bench")
    parser.add_argument("--out", type=Path, metavar="DIR", help="default: RESULTS_DIR/figures")
    parser.add_argument("--vector", action="store_true", help="each figure also as .svg and .pdf")


def selected(only: str | None, kind: str, names: list[str]) -> list[str]:
    """The names that one of the globs in `only` fits; all without globs."""
    if only is None:
        return names
    globs = only.split(",")
    for glob in globs:
        if not any(fnmatchcase(name, glob) for name in names):
            raise RecordsError(f"--only: '{glob}' is no {kind} (there are: {', '.join(names) or 'none'})")
    return [name for name in names if any(fnmatchcase(name, glob) for glob in globs)]


def replace_all(folder: Path, writers: dict[str, Callable[[Path], object]]) -> None:
    """All files or none: each is written next to its place, links followed; when all are on disk
    they are moved. What is no regular file is not replaced. Throws OSError with the file's name."""
    places = {name: place_of(folder / name) for name in writers}
    with ExitStack() as parts:
        parts_in = {parent: parts.enter_context(locked_parts(parent))
                    for parent in sorted({place.parent for place in places.values()})}
        for name, write in writers.items():
            part = parts_in[places[name].parent] / name
            try:
                write(part)
                synchronise(part)
            except OSError as error:
                raise OSError(error.errno, error.strerror or str(error), str(folder / name))
        for name, place in places.items():
            os.replace(parts_in[place.parent] / name, place)


class Made:
    """What a program makes in a folder, listed in MADE before it is there. The files of its earlier
    runs that it does not make now are removed at the end; files that it never made stay."""

    def __init__(self, folder: Path, program: str) -> None:
        self.folder, self.program = folder, program
        self.now: set[str] = set()

    def listed(self) -> list[tuple[str, str]]:
        """Program and file. Lines that no program wrote are passed over."""
        with suppress(OSError, UnicodeDecodeError):
            lines = (self.folder / MADE).read_text(encoding="utf-8").splitlines()
            return [(program, name) for program, _, name in (line.partition("/") for line in lines)
                    if name and "/" not in name and name not in (".", "..")]
        return []

    def earlier(self) -> set[str]:
        return {name for program, name in self.listed() if program == self.program}

    def replace(self, writers: dict[str, Callable[[Path], object]]) -> None:
        self.now |= set(writers)
        self.list_as(self.now | self.earlier(), writers)

    def remove_others(self) -> list[str]:
        """The names that are gone."""
        gone = sorted(name for name in self.earlier() - self.now if (self.folder / name).is_file())
        for name in gone:
            (self.folder / name).unlink(missing_ok=True)
        if self.earlier() != self.now:
            self.list_as(self.now, {})
        return gone

    def list_as(self, names: set[str], writers: dict[str, Callable[[Path], object]]) -> None:
        others = [line for line in self.listed() if line[0] != self.program]
        lines = sorted(others + [(self.program, name) for name in names])
        text = "".join(f"{program}/{name}\n" for program, name in lines)
        replace_all(self.folder, {MADE: text_writer(text)} | writers)


@contextmanager
def locked_parts(folder: Path) -> Iterator[Path]:
    """A folder for unfinished files, locked, so what is in it already is a killed run's."""
    parts = folder / PARTS
    os.stat(folder)  # or the message would name the parts
    descriptor = locked(parts)
    try:
        for left in parts.iterdir():
            left.unlink()
        yield parts
    finally:
        shutil.rmtree(parts, ignore_errors=True)
        os.close(descriptor)
    synchronise(folder)


def locked(folder: Path) -> int:
    while True:
        folder.mkdir(exist_ok=True)
        with suppress(FileNotFoundError):  # its last owner removes it
            descriptor = os.open(folder, os.O_RDONLY)
            with suppress(OSError):  # not every file system locks folders
                fcntl.flock(descriptor, fcntl.LOCK_EX)
            if folder.exists() and os.path.samestat(folder.stat(), os.fstat(descriptor)):
                return descriptor
            os.close(descriptor)


def text_writer(text: str) -> Callable[[Path], object]:
    return partial(Path.write_text, data=text, encoding="utf-8")


def place_of(path: Path) -> Path:
    place = Path(os.path.realpath(path))
    if place.exists() and not place.is_file():
        raise RecordsError(f"{path}: is no regular file; expected one, or a name that is not there")
    return place


def synchronise(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
