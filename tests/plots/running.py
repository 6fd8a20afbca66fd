"""Runs the programs of plots/."""
from __future__ import annotations

import contextlib
import io
import subprocess
import sys
from types import ModuleType
from unittest import mock


def run(program: ModuleType, *arguments: object) -> tuple[int, str, str]:
    """Exit status, stdout, stderr. In this process: to start another takes longer than to draw."""
    out, err, status = io.StringIO(), io.StringIO(), 0
    with mock.patch.object(sys, "argv", [program.__file__, *map(str, arguments)]), \
            contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            program.main()
        except SystemExit as end:
            status = end.code
    return status, out.getvalue(), err.getvalue()


def run_command(program: ModuleType, *arguments: object) -> tuple[int, str, str]:
    """The same in a process of its own."""
    done = subprocess.run([sys.executable, program.__file__, *map(str, arguments)],
                          capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr
