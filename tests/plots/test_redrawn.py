"""What is drawn and written from committed numbers is the same again.  /usr/bin/python3 -m unittest FILE"""
import shutil

import matplotlib

from running import PROJECT, FolderTest, run

import figures

# A picture's bytes are those of the library that drew it; the numbers next to it are the same with any.
DRAWN_BY = "3.6.3"
# Few records, and no exponents: these differ in their last digit from one LAPACK to another.
FOLDERS = ("contact", "load-steps", "memory")


class RedrawnTest(FolderTest):
    def test_committed_figures_are_what_their_records_give(self) -> None:
        for folder in (PROJECT / "results" / name for name in FOLDERS):
            shutil.copy(folder / "records.jsonl", self.results)
            drawn = [path for path in (folder / "figures").iterdir()
                     if path.name not in ("drawn.txt", ".airybench.made")]
            names = {path.stem for path in drawn} - {"measured"}
            status, _, err = run(figures, self.results, f"--only={','.join(names)}")
            self.assertEqual((status, err), (0, ""))
            for path in drawn:
                if path.suffix in (".csv", ".md") or matplotlib.__version__ == DRAWN_BY:
                    self.assertEqual((self.figures / path.name).read_bytes(), path.read_bytes(),
                                     f"{folder.name}/{path.name}")
