"""The decisions of ./run.  /usr/bin/python3 -m unittest FILE"""
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

RUN = Path(__file__).resolve().parents[2] / "run"


# The text of its functions.
FUNCTIONS = "\n".join(re.findall(r"^\w+\(\) (?:[({] *(?:#[^\n]*)?\n.*?^[)}]|\{[^\n]*\})$",
                               RUN.read_text(encoding="utf-8"), re.M | re.S))


def functions(project: Path) -> str:
    return f"set -euo pipefail\nproject='{project}'\ntrees=$project/build\n{FUNCTIONS}\n"


class RunScriptTest(unittest.TestCase):
    def call(self, name: str, *arguments: str, stubs: dict[str, str], **environment: str):
        """Calls a function of ./run, with these shell scripts in place of programs."""
        with tempfile.TemporaryDirectory() as folder:
            for stub, text in stubs.items():
                Path(folder, stub).write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
                Path(folder, stub).chmod(0o755)
            for file in ("build/release/.ninja_log", "cmake/packages.txt"):
                Path(folder, "project", file).parent.mkdir(parents=True)
                Path(folder, "project", file).touch()
            script = functions(Path(folder, "project")) + f'{name} "$@"'
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
        ran = self.call("build", "release", "meshgen",  # also with --quiet
                        stubs={"cmake": 'case "$*" in *" --target "*) echo "ninja: no work to do." ;; esac'})
        self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (0, "", ""))

    def test_sources_from_the_future_are_named(self) -> None:
        """Ninja would run CMake a hundred times, which takes minutes."""
        stubs = {"cmake": 'case "$*" in *" -n") echo "[0/1] Re-running CMake..." ;; *" --target "*) sleep 9 ;; esac',
                 "find": "echo CMakeLists.txt"}
        ran = self.call("build", "release", "bench", stubs=stubs)
        self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (
            2, "", "run: CMakeLists.txt: is from the future (allowed: touch it, or set the clock)\n"))

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
            script = functions(folder) + "build release bench"
            at_once = [subprocess.Popen(["bash", "-c", script], stderr=subprocess.PIPE, text=True,
                                        env={"PATH": f"{folder}:/usr/bin:/bin"}) for _ in range(3)]
            said = "".join(one.communicate()[1] for one in at_once)
            self.assertEqual([one.returncode for one in at_once], [0, 0, 0])
            self.assertEqual((folder / "log").read_text().split(), 3 * ["begin", "end"])
            self.assertEqual(set(said.splitlines()),
                             {f"run: another ./run installs or builds in {folder}: waiting for it"})

    def test_memory_bounds_the_compilers(self) -> None:
        for kibibytes, limit, processors, compilers in ((8 << 20, "max", 4, 4), (3 << 20, "max", 64, 3),
                                                        (1 << 19, "max", 64, 1), (8 << 20, 2 << 30, 4, 2)):
            memory = f"echo 'MemAvailable: {kibibytes} kB'; echo {limit}"
            ran = self.call("compilers", stubs={"cat": memory, "nproc": f"echo {processors}"})
            self.assertEqual((ran.stdout, ran.stderr), (f"{compilers}\n", ""))
        ran = self.call("compilers", stubs={"cat": "exit 1"})  # neither is known
        self.assertEqual((ran.stdout, ran.stderr), ("1\n", ""))

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

    def test_a_group_of_packages_is_its_packages(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            Path(name, "cmake").mkdir()
            Path(name, "cmake/packages.txt").write_text("a: b g++\na: c\nb: d\n", encoding="utf-8")
            ran = subprocess.run(["bash", "-c", functions(Path(name)) + "packages a g++ valgrind"], text=True,
                                 capture_output=True, check=False)
            self.assertEqual((ran.stdout.split(), ran.stderr), (["b", "g++", "c", "g++", "valgrind"], ""))

    def test_a_tree_of_a_checkout_that_was_moved_is_configured_again(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            old, new = Path(name, "old"), Path(name, "new")
            old.mkdir()
            (old / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(p NONE)\n",
                                                encoding="utf-8")
            preset = '{"name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/release"}'
            (old / "CMakePresets.json").write_text(f'{{"version": 6, "configurePresets": [{preset}]}}', encoding="utf-8")
            for project in (old, old, new):  # the first, the same, the moved one
                if project is new:
                    old.rename(new)
                (project / "build").mkdir(exist_ok=True)
                ran = subprocess.run(["bash", "-c", functions(project) + "configure release -DX=1"], text=True,
                                     capture_output=True, check=False)
                self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (0, "", ""))
                self.assertIn(f"={project}\n", (project / "build/release/CMakeCache.txt").read_text(encoding="utf-8"))
            (new / "CMakeLists.txt").write_text("message(FATAL_ERROR why)\n", encoding="utf-8")
            ran = subprocess.run(["bash", "-c", functions(new) + "configure release"], text=True,
                                 capture_output=True, check=False)
            self.assertEqual((ran.returncode, ran.stdout), (2, ""))
            self.assertEqual(ran.stderr.count("why"), 1, ran.stderr)
            self.assertTrue(ran.stderr.endswith(f"\nrun: {new}/build/release: cannot be configured\n"), ran.stderr)

    def project_in(self, folder: Path) -> Path:
        """A project whose programs tell their arguments."""
        project = folder / "project"
        bench = project / "build/release/bench/bench"
        bench.parent.mkdir(parents=True)
        shutil.copy(RUN, project)
        (bench.parents[1] / ".ninja_log").touch()
        (project / "bench").mkdir()
        (project / "cmake").mkdir()
        (project / "cmake/packages.txt").write_text("bench: cmake\n", encoding="utf-8")
        shutil.copy(RUN.parent / "bench/compare_revisions.sh", project / "bench")
        programs = {bench: 'echo "bench $*"', folder / "cmake": ":",
                    folder / "dpkg-query": "printf 'installed %s\\n' \"$@\"",
                    **{folder / name: f'echo "{name} $*" >> {folder}/log' for name in ("one", "two")}}
        for program, text in programs.items():
            program.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            program.chmod(0o755)
        return project

    def compare(self, folder: Path, *arguments: str) -> subprocess.CompletedProcess:
        return subprocess.run([self.project_in(folder) / "run", "compare", *arguments], cwd=folder, text=True,
                              capture_output=True, check=False,
                              env={"PATH": f"{folder}:/usr/bin:/bin", "AIRYBENCH_INSTALL": "no"})

    def run_bench(self, folder: Path, before: str, command: str = "bench export") -> subprocess.CompletedProcess:
        project = folder / "project"
        if not project.exists():
            self.project_in(folder)
        return subprocess.run(["bash", "-c", f"{before} project/run {command}", "bash"], cwd=folder, text=True,
                              capture_output=True, check=False,
                              env={"PATH": f"{folder}:/usr/bin:/bin", "AIRYBENCH_INSTALL": "no"})

    def test_surroundings_are_no_obstacle_or_one_line(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name).resolve()
            for before in ("CDPATH=.:/usr", "export CDPATH=/usr; exec <&-;", "exec 2>&-;", "exec <&- 2>&-;"):
                ran = self.run_bench(folder, before)
                self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (0, "bench export\n", ""), before)
            ran = self.run_bench(folder, "exec >&-;")
            self.assertEqual((ran.stdout, ran.stderr.count("\n")), ("", 1), ran.stderr)  # the program's, which sees it
            for before, said in (("TMPDIR=nowhere", "TMPDIR: nowhere: is no folder to write to"),
                                 ("AIRYBENCH_BUILD_DIR=one/trees",
                                  f"{folder}/one/trees: cannot be written (AIRYBENCH_BUILD_DIR=FOLDER: build there)")):
                ran = self.run_bench(folder, before)
                self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (2, "", f"run: {said}\n"))
            # Bash opens the script in place of a closed stream.
            for before in ("exec 2>&-;", "exec 2>/dev/full;"):
                self.assertEqual(self.run_bench(folder, before, "nonsense").returncode, 2)
            (folder / "project/build/release/bench/bench").write_text("#!/bin/sh\ncat; echo said >&2\n")
            self.assertEqual(self.run_bench(folder, "exec <&- 2>&-;").returncode, 0)
            self.assertEqual(self.run_bench(folder, "exec <&-;").stdout, "")

    def test_folders_that_cmake_cannot_have_are_refused(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            project = Path(name, "project")
            self.project_in(Path(name))
            taken = {f"a{character}b": 0 for character in "$ '(&%ß"}
            for named, status in ({f"a{character}b": 2 for character in '"#;[]\\\n|<>'} | {"a\n": 2} | taken).items():
                other = project.rename(Path(name, named))
                ran = subprocess.run([other / "run", "bench", "export"], text=True, capture_output=True, check=False,
                                     env={"PATH": f"{name}:/usr/bin:/bin", "AIRYBENCH_INSTALL": "no"})
                self.assertEqual((ran.returncode, ran.stderr.count("\n")), (status, status // 2), ran.stderr)
                project = other

    def test_trees_are_where_the_variable_says(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            project = self.project_in(folder)
            (project / "build").rename(folder / "-trees")
            ran = self.run_bench(folder, "AIRYBENCH_BUILD_DIR=-trees")
            self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (0, "bench export\n", ""))
            self.assertFalse((project / "build").exists())

    def measuring_project(self, folder: Path, bench: str) -> tuple[Path, dict[str, str]]:
        """A project with this bench, and figures that tell what they are to draw; its environment."""
        project = self.project_in(folder)
        (project / "build/release/bench/bench").write_text(f"#!/bin/bash\n{bench}\n", encoding="utf-8")
        (project / "plots").mkdir()
        (project / "plots/draw_folder.py").write_text(
            "import os, sys\nprint('draws', *sys.argv[1:])\nsys.exit(int(os.environ.get('FAILS', '0')))\n")
        (folder / "tmp").mkdir()
        return project, {"PATH": f"{folder}:/usr/bin:/bin", "AIRYBENCH_INSTALL": "no", "TMPDIR": f"{folder}/tmp"}

    def test_what_a_run_leaves_to_draw_is_drawn_and_has_no_say_in_the_exit_code(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            project, environment = self.measuring_project(folder, r'''echo "measures $*"
[[ -z $AIRYBENCH_TO_DRAW || $* == *--dry-run* ]] || printf -- '--html\0--\0a b\0' >"$AIRYBENCH_TO_DRAW"
exit ${CODE:-0}''')
            drawn = "draws --quiet --html -- a b\n"
            for command, said in {("bench", "--mesh=Mesh0"): drawn, ("solve", "part.inp"): drawn,
                                  ("bench", "advise"): drawn, ("bench", "--dry-run"): "",
                                  ("bench", "list"): "", ("bench", "track"): ""}.items():
                for code in ("0", "1", "3"):
                    ran = subprocess.run([project / "run", *command], env=environment | {"CODE": code}, text=True,
                                         capture_output=True, check=False)
                    measured = " ".join(command).removeprefix("bench ")
                    self.assertEqual((ran.returncode, ran.stdout, ran.stderr),
                                     (int(code), f"measures {measured}\n{said}", ""), command)
            ran = subprocess.run([project / "run", "bench"], env=environment | {"AIRYBENCH_FIGURES": "no"}, text=True,
                                 capture_output=True, check=False)
            self.assertEqual((ran.returncode, ran.stdout, ran.stderr), (0, "measures \n", ""))
            ran = subprocess.run([project / "run", "bench"], env=environment | {"FAILS": "1"}, text=True,
                                 capture_output=True, check=False)
            self.assertEqual((ran.returncode, ran.stderr), (0, "run: not all figures of a b are drawn\n"))
            self.assertEqual(list((folder / "tmp").iterdir()), [])
            (folder / "mktemp").write_text("#!/bin/sh\necho full >&2\nexit 1\n")  # a full disk
            (folder / "mktemp").chmod(0o755)
            ran = subprocess.run([project / "run", "bench"], env=environment, text=True, capture_output=True,
                                 check=False)
            self.assertEqual((ran.returncode, ran.stdout, ran.stderr),
                             (2, "", f"run: TMPDIR: {folder}/tmp: no file can be made there\n"))

    def test_an_interrupted_run_draws_nothing(self) -> None:
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, -signal.SIGTERM)):
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                project, environment = self.measuring_project(
                    folder, f"trap 'exit {128 + number}' {number}; touch {name}/begun; while :; do sleep 0.01; done")
                # A terminal's signal goes to all of a process group; so does that of timeout.
                with subprocess.Popen([project / "run", "bench"], env=environment, start_new_session=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
                    while not (folder / "begun").exists():
                        time.sleep(0.01)
                    os.killpg(run.pid, number)
                    self.assertEqual((run.communicate()[0], run.returncode), ("", code))
                self.assertEqual(list((folder / "tmp").iterdir()), [])

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

    def test_an_unpacked_tree_is_no_part_of_the_repository_around_it(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name).resolve()
            git = ["git", "-C", name, "-c", "user.name=test", "-c", "user.email=test@localhost"]
            for command in (["init", "--quiet"], ["commit", "--quiet", "--allow-empty", "-m", "its own"]):
                subprocess.run([*git, *command], check=True)
            ran = self.compare(folder, "./one", "HEAD")
            self.assertEqual((ran.returncode, ran.stdout), (2, ""))
            self.assertEqual(ran.stderr, f"run: compare: HEAD (allowed: a program): {folder}/project is no repository\n")
            (folder / "project/.ci").mkdir()
            shutil.copy(RUN.parent / ".ci/format", folder / "project/.ci")
            ran = subprocess.run([folder / "project/.ci/format"], text=True, capture_output=True, check=False)
            self.assertEqual((ran.returncode, ran.stdout, ran.stderr),
                             (2, "", f"run: format: {folder}/project: git lists no sources\n"))
            (folder / "project/CMakeLists.txt").touch()
            for revision in ("unknown", r"[0-9a-f]{40}"):  # as it is; as a part of that repository
                subprocess.run(["cmake", f"-DSOURCE_DIR={folder}/project", f"-DOUTPUT={folder}/info.cpp", "-P",
                                RUN.parent / "cmake/build_info.cmake"], check=True)
                self.assertRegex((folder / "info.cpp").read_text(), f'git_revision = "{revision}"')
                subprocess.run([*git, "add", "project/CMakeLists.txt"], check=True)

    def test_what_is_neither_a_program_nor_a_revision_is_refused(self) -> None:
        for arguments, said in ((("./one", "nowhere"), "nowhere (allowed: a git revision, or a program)"),
                                (("./one",), "./one (allowed: two revisions or programs")):
            with tempfile.TemporaryDirectory() as name:
                ran = self.compare(Path(name), *arguments)
                self.assertEqual((ran.returncode, ran.stdout), (2, ""))
                self.assertIn(f"run: compare: {said}", ran.stderr)
