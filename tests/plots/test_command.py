"""Files of the programs of plots/: whole or not at all.  /usr/bin/python3 -m unittest FILE"""
import errno
import fcntl
import os
import signal
from pathlib import Path
from unittest import mock

import made_up  # finds plots

import drawing as sheets
import figures
from command import PARTS, replace_all
from records import RecordsError
from running import FolderTest, run


class FilesTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.figures.mkdir()
        self.old = self.figures / "figure4.png"
        self.old.write_text("earlier")

    def assert_as_before(self) -> None:
        self.assertEqual([path.name for path in self.figures.iterdir()], [self.old.name])
        self.assertEqual(self.old.read_text(), "earlier")

    def test_a_picture_that_cannot_be_written_leaves_the_old_ones(self) -> None:
        made_up.write(self.csv, [made_up.case(mesh, "3STEPD") for mesh in ("Mesh0", "Mesh1")])
        full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        for error, why in ((full, full.strerror), (OSError("encoder error -2"), "encoder error -2")):
            def write(figure: object, path: Path) -> None:
                path.write_text("half")
                if path.suffix == ".png":
                    raise error
            with mock.patch.object(sheets, "write", write):
                status, out, err = run(figures, self.results, "--only=figure4")
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
