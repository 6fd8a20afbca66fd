"""The decisions of ./run.  /usr/bin/python3 -m unittest FILE"""
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

RUN = Path(__file__).resolve().parents[2] / "run"


# The text of its functions.
FUNCTIONS = "\n".join(re.findall(r"^\w+\(\) (?:[({] *(?:#[^\n]*)?\n.*?^[)}]|\{[^\n]*\})$",
                               RUN.read_text(encoding="utf-8"), re.M | re.S))


class RunScriptTest(unittest.TestCase):
    def call(self, name: str, *arguments: str, stubs: dict[str, str], **environment: str):
        """Calls a function of ./run, with these shell scripts in place of programs."""
        with tempfile.TemporaryDirectory() as folder:
            for stub, text in stubs.items():
                Path(folder, stub).write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
                Path(folder, stub).chmod(0o755)
            tree = Path(folder, "build", "release")
            tree.mkdir(parents=True)
            (tree / ".ninja_log").touch()
            script = f"set -euo pipefail\nproject='{folder}'\n{FUNCTIONS}\n{name} \"$@\""
            return subprocess.run(["bash", "-c", script, "run", *arguments], text=True, capture_output=True,
                                  env={"PATH": f"{folder}:/usr/bin:/bin", **environment}, check=False)

    def test_a_build_in_which_nothing_is_compiled_is_silent(self) -> None:
        ninja = """case "$*" in
  *" -n") echo "[1/4] Noting revision and compiler"
          echo "[2/4] Building CXX object bench/build_info.cpp.o"; %s ;;
  *--quiet) ;;
  *) echo "[1/4] Building" ;;
esac"""
        for planned, said in ((":", ""), ("echo '[3/4] Building CXX object a.cpp.o'", "[1/4] Building\n")):
            ran = self.call("build", "release", "bench", stubs={"cmake": ninja % planned})
            self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (0, "", said))

    def test_a_dry_run_tells_what_is_to_be_compiled(self) -> None:
        """Globs that Ninja checks would hide it: it begins and ends with CMake then."""
        for file in RUN.parent.rglob("CMakeLists.txt"):
            if "build" not in file.relative_to(RUN.parent).parts:
                self.assertNotIn(" CONFIGURE_DEPENDS", file.read_text(encoding="utf-8"), file)

    def test_of_two_at_once_one_builds_and_the_other_waits(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            stub = folder / "cmake"
            stub.write_text(f"""#!/bin/sh
case "$*" in *" -n") ;; *--quiet) echo begin >> {folder}/log; sleep 0.3; echo end >> {folder}/log ;; esac
""", encoding="utf-8")
            stub.chmod(0o755)
            (folder / "build/release").mkdir(parents=True)
            (folder / "build/release/.ninja_log").touch()
            script = f"set -euo pipefail\nproject='{folder}'\n{FUNCTIONS}\nbuild release bench"
            at_once = [subprocess.Popen(["bash", "-c", script], stderr=subprocess.PIPE, text=True,
                                        env={"PATH": f"{folder}:/usr/bin:/bin"}) for _ in range(3)]
            said = "".join(one.communicate()[1] for one in at_once)
            self.assertEqual([one.returncode for one in at_once], [0, 0, 0])
            self.assertEqual((folder / "log").read_text().split(), 3 * ["begin", "end"])
            self.assertEqual(set(said.splitlines()),
                             {f"run: another ./run installs or builds in {folder}: waiting for it"})

    def test_memory_bounds_the_compilers(self) -> None:
        for kibibytes, processors, compilers in ((8 << 20, 4, 4), (3 << 20, 64, 3), (1 << 19, 64, 1)):
            ran = self.call("compilers", stubs={"awk": f"echo {kibibytes}", "nproc": f"echo {processors}"})
            self.assertEqual(ran.stdout, f"{compilers}\n", ran.stderr)

    def test_a_link_is_the_checkout_that_it_leads_to(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            link = Path(name, "run")
            link.symlink_to(RUN)
            ran = subprocess.run(["bash", "-c", f"source '{link}' help >/dev/null; echo $project"], text=True,
                                 capture_output=True, check=False)
            self.assertEqual(ran.stdout, f"{RUN.parent.resolve()}\n", ran.stderr)

    def test_what_is_installed_is_said_before(self) -> None:
        stubs = {"dpkg-query": "echo 'installed git'; exit 1", "apt-get": 'echo "apt-get $1"',
                 "sudo": 'exec "$@"'}
        ran = self.call("need", "git", "cmake", "g++", stubs=stubs)
        lines = ran.stderr.splitlines()
        self.assertEqual((ran.returncode, ran.stdout, lines[1:]), (0, "", ["apt-get update", "apt-get install"]))
        self.assertRegex(lines[0], r"^run: installing .*AIRYBENCH_INSTALL=no.*: cmake g\+\+$")
        self.assertEqual(self.call("need", "git", stubs=stubs).stderr, "")
        ran = self.call("need", "git", "cmake", "g++", stubs=stubs, AIRYBENCH_INSTALL="no")
        self.assertEqual((ran.returncode, ran.stdout, ran.stderr),
                         (2, "", "run: missing packages: cmake g++ (apt-get install them)\n"))

    def test_a_package_that_others_only_mention_is_not_packaged(self) -> None:
        for said, status in (("echo Package: a", 0), (":", 1), ("echo 'E: No packages found' >&2; exit 100", 1)):
            ran = self.call("packaged", "a", stubs={"apt-cache": said})
            self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (status, "", ""))

    def compare(self, folder: Path, *arguments: str) -> subprocess.CompletedProcess:
        """./run of a project whose programs tell their arguments."""
        project = folder / "project"
        bench = project / "build/release/bench/bench"
        bench.parent.mkdir(parents=True)
        shutil.copy(RUN, project)
        (project / "bench").mkdir()
        shutil.copy(RUN.parent / "bench/compare_revisions.sh", project / "bench")
        programs = {bench: 'echo "bench $*"', folder / "cmake": ":",
                    folder / "dpkg-query": "printf 'installed %s\\n' \"$@\"",
                    **{folder / name: f'echo "{name} $*" >> {folder}/log' for name in ("one", "two")}}
        for program, text in programs.items():
            program.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            program.chmod(0o755)
        return subprocess.run([project / "run", "compare", *arguments], cwd=folder, text=True,
                              capture_output=True, check=False,
                              env={"PATH": f"{folder}:/usr/bin:/bin", "AIRYBENCH_INSTALL": "no"})

    def test_two_programs_run_in_turn_and_are_compared(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            ran = self.compare(folder, "./one", "./two", "--runs=2", "--mesh=Mesh0", "--out=o")
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertEqual((folder / "log").read_text().splitlines(),
                             [f"{program} --mesh=Mesh0 --out=o/{run}" for program, run in
                              (("one", "a1"), ("two", "b1"), ("one", "a2"), ("two", "b2"))])
            self.assertEqual(ran.stdout.splitlines()[-1], "bench compare --names=./one,./two o/a1,o/a2 o/b1,o/b2")
            self.assertEqual(ran.stdout.count("\n"), 1)  # no tables of the runs

    def test_what_is_neither_a_program_nor_a_revision_is_refused(self) -> None:
        for arguments, said in ((("./one", "nowhere"), "nowhere (allowed: a git revision, or a program)"),
                                (("./one",), "./one (allowed: two revisions or programs")):
            with tempfile.TemporaryDirectory() as name:
                ran = self.compare(Path(name), *arguments)
                self.assertEqual((ran.returncode, ran.stdout), (2, ""))
                self.assertIn(f"run: compare: {said}", ran.stderr)


if __name__ == "__main__":
    unittest.main()
