"""Files of the programs of plots/: whole or not at all.  /usr/bin/python3 -m unittest FILE"""
import errno
import fcntl
import os
import signal
import subprocess
import sys
from pathlib import Path
from unittest import mock

import made_up  # finds plots

import drawing as sheets
import figures
from command import MADE, PARTS, Made, replace_all
from records import RecordsError
from running import FolderTest, run, run_command


class FilesTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.figures.mkdir()
        self.old = self.figures / "size.png"
        self.old.write_text("earlier")

    def assert_as_before(self) -> None:
        self.assertEqual([path.name for path in self.figures.iterdir()], [self.old.name])
        self.assertEqual(self.old.read_text(), "earlier")

    def test_a_picture_that_cannot_be_written_leaves_the_old_ones(self) -> None:
        made_up.write(self.csv, [made_up.case(mesh, "3STEPD") for mesh in ("Mesh0", "Mesh1")])
        full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        for error, why in ((full, full.strerror), (OSError("encoder error -2"), "encoder error -2")):
            def write(figure: object, dpi: int, path: Path, **_: object) -> None:
                path.write_text("half")
                if path.suffix == ".png":
                    raise error
            with mock.patch.object(sheets, "write_small_png", write):
                status, out, err = run(figures, self.results, "--only=size")
            self.assertEqual((status, out), (2, ""))
            self.assertEqual(err, f"figures.py: {self.old}: {why}; expected a folder to write to\n")
            self.assert_as_before()

    def test_a_killed_run_leaves_the_old_file_and_the_next_one_clears_up(self) -> None:
        def die(path: Path) -> None:
            path.write_text("half")
            os.kill(os.getpid(), signal.SIGKILL)
        child = os.fork()
        if child == 0:
            replace_all(self.figures, {"a": Path.touch, self.old.name: die})
            os._exit(0)
        self.assertEqual(os.waitpid(child, 0)[1], signal.SIGKILL)
        self.assertEqual(self.old.read_text(), "earlier")
        self.assertEqual({path.name for path in self.figures.iterdir()}, {self.old.name, PARTS})
        replace_all(self.figures, {"b": Path.touch})
        self.assertEqual({path.name for path in self.figures.iterdir()}, {self.old.name, "b"})

    def test_two_runs_do_not_meet_in_a_folder(self) -> None:
        def write(path: Path) -> None:
            other = os.open(path.parent, os.O_RDONLY)
            self.addCleanup(os.close, other)
            with self.assertRaises(BlockingIOError):
                fcntl.flock(other, fcntl.LOCK_EX | fcntl.LOCK_NB)
            path.write_text("new")
        replace_all(self.figures, {self.old.name: write})
        self.assertEqual(self.old.read_text(), "new")

    def test_links_are_followed_and_what_is_no_regular_file_is_not_replaced(self) -> None:
        pipe, link, device = (self.results / name for name in ("pipe", "link", "device"))
        os.mkfifo(pipe)
        link.symlink_to(pipe)
        device.symlink_to("/dev/null")
        for place in (pipe, link, device):
            with self.assertRaisesRegex(RecordsError, f"^{place}: is no regular file; expected one,"):
                replace_all(self.results, {place.name: Path.touch})
            self.assertFalse(place.is_file())
        self.assertTrue(pipe.is_fifo())
        page = self.results / "page"
        page.symlink_to("figures/page")
        replace_all(self.results, {"page": Path.touch})
        self.assertTrue(page.is_symlink())
        self.assertEqual({path.name for path in self.figures.iterdir()}, {self.old.name, "page"})


class MessagesTest(FolderTest):
    def test_names_are_escaped_and_cut(self) -> None:
        for name, shown in (("Größe ≤ 5", "Größe ≤ 5'"), ("a\u202eb\ufeff\u200b", r"a\u202eb\ufeff\u200b'"),
                            ("\x1b[31m", r"\x1b[31m'"), ("\udcff", r"\xff'"), ("n" * 5000, "n" * 399 + "…")):
            status, out, err = run(figures, self.results, name)
            self.assertEqual((status, out, err.split(" (valid")[0]), (2, "", f"figures.py: unknown '{shown}"))

    def test_figures_have_room_for_any_name(self) -> None:
        long, hidden = "n" * 5000, "a\u202eb\x1bc字"
        made_up.write(self.csv, [made_up.case(mesh + name, f"EXTERNAL:{name}") for name in (long, hidden)
                                 for mesh in ("Mesh0", "Mesh1")])
        self.assertEqual(run_command(figures, self.results, "--only=size")[::2], (0, ""))

    def test_an_interruption_is_no_traceback(self) -> None:
        made_up.write(self.csv, [made_up.case("Mesh0", "3STEPD")])
        with mock.patch.object(figures, "draw_all", side_effect=KeyboardInterrupt):
            self.assertEqual(run(figures, self.results), (130, "", ""))

    def test_closed_and_full_streams(self) -> None:
        """One line or none, and no traceback."""
        made_up.write(self.csv, [made_up.case("Mesh0", "3STEPD")])
        draw = f"'{sys.executable}' '{figures.__file__}' '{self.results}' --only=table1"
        for streams, status, said in ((">&-", 0, ""), ("<&- >&- 2>&-", 0, ""), (">/dev/full", 2, "figures.py: standard "
                                      "output: No space left on device; expected a folder to write to\n")):
            for unbuffered in ("", "1"):
                ran = subprocess.run(["bash", "-c", f"{draw} {streams}"], text=True, capture_output=True, check=False,
                                     env=os.environ | {"PYTHONUNBUFFERED": unbuffered})
                self.assertEqual((ran.returncode, ran.stderr), (status, said), streams)


class MadeTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.figures.mkdir()

    def make(self, program: str, *names: str) -> list[str]:
        made = Made(self.figures, program)
        made.replace({name: Path.touch for name in names})
        return made.remove_others()

    def there(self) -> set[str]:
        return {path.name for path in self.figures.iterdir()} - {MADE}

    def test_what_a_program_no_longer_makes_is_removed_and_nothing_else(self) -> None:
        for stranger in ("notes.txt", "b.png"):
            (self.figures / stranger).touch()
        self.make("one", "a.png", "a.csv")
        self.make("other", "c.png")
        self.assertEqual(["a.csv"], self.make("one", "a.png", "d.png"))
        self.assertEqual({"notes.txt", "b.png", "a.png", "d.png", "c.png"}, self.there())
        self.make("one")
        self.assertEqual({"notes.txt", "b.png", "c.png"}, self.there())

    def test_a_run_that_ends_early_leaves_a_list_with_all_that_it_made(self) -> None:
        self.make("one", "a.png")
        Made(self.figures, "one").replace({"b.png": Path.touch})  # and no more
        self.assertEqual(["a.png", "b.png"], self.make("one", "c.png"))

    def test_a_list_that_is_damaged_removes_nothing_beyond_the_folder(self) -> None:
        self.lines.touch()
        for text in (b"one/../records.jsonl\none/..\none/.\none/\n/a\na\n", b"\xff\xfe", b""):
            (self.figures / MADE).write_bytes(text)
            self.make("one", "a.png")
            self.assertTrue(self.lines.exists())
            self.assertEqual({"a.png"}, self.there())
        (self.figures / MADE).unlink()
        (self.figures / MADE).mkdir()
        with self.assertRaisesRegex(RecordsError, "is no regular file"):
            self.make("one", "b.png")
        self.assertEqual({"a.png"}, self.there())

    def test_figures_of_other_records_go(self) -> None:
        def draw(*meshes: str, only: str = "") -> str:
            made_up.write(self.csv, [made_up.case(mesh, "3STEPD") for mesh in meshes])
            with mock.patch.multiple(sheets, write=lambda figure, path: path.touch(),
                                     write_small_png=lambda figure, dpi, path, **_: path.touch()):
                status, out, err = run(figures, self.results, *[f"--only={only}"] * bool(only))
            self.assertEqual((status, err), (0, ""))
            return out
        draw("Mesh0", "Mesh1")
        self.assertIn("size.png", self.there())
        self.assertNotIn("removed", draw("Mesh0", "Mesh1"))
        (self.figures / "mine.svg").touch()
        draw("Mesh0", "Mesh1", only="size")
        self.assertIn("table1.md", self.there())
        out = draw("part")
        self.assertIn("removed, of other records: size.csv, size.png, size.txt, table1.md\n", out)
        self.assertNotIn("stays", out)
        self.assertEqual({"measured.md", "mine.svg"}, self.there())
