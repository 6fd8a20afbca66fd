"""Names of cases: those of tests/bench/records/case_name_test.cpp."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "plots"))
from case_names import case_name, file_of  # noqa: E402

SWEPT = "Mesh0/default/SYMMLQ:SSOR0.7,schur=sparse/study=error/contact_sweeps=1e-12/stop=paper"


class CaseNamesTest(unittest.TestCase):
    def test_the_parts_that_are_not_the_default(self) -> None:
        case = dict(mesh="Mesh0", scene="default", method="HYBRID")
        self.assertEqual(case_name(case), "Mesh0/default/HYBRID")
        self.assertEqual(case_name(case | dict(stop="target", study="", knob="", knob_value=None)),
                         "Mesh0/default/HYBRID")
        case |= dict(method="SYMMLQ:SSOR0.7,schur=sparse", study="error", knob="contact sweeps",
                     stop="paper")
        self.assertEqual(case_name(case | dict(knob_value=1e-12)), SWEPT)
        self.assertEqual(case_name(case | dict(knob_value="1e-12")), SWEPT)  # a cell of CSV
        self.assertTrue(case_name(case | dict(knob_value=30.0)).endswith("_sweeps=30/stop=paper"))

    def test_files(self) -> None:
        self.assertEqual(file_of(SWEPT), "Mesh0--default--SYMMLQ+SSOR0.7,schur=sparse--study=error--"
                                         "contact_sweeps=1e-12--stop=paper")
        self.assertEqual(file_of("-a-/b+--c%/d-e"), "%2Da%2D--b%2B%2D%2Dc%25--d-e")


if __name__ == "__main__":
    unittest.main()
