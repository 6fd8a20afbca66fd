"""plots/page.py on a made-up history, in headless Chromium.  /usr/bin/python3 -m unittest FILE"""
import json
import os
import re
import shutil
import tempfile
import unittest
from collections.abc import Callable
from pathlib import Path

import made_up_history as made_up
from browser import CHROMIUM, Browser, Element
from running import run, run_command

import page as page_program

# A pixel.
PNG = bytes.fromhex("89504e470d0a1a0a0000000d4948445200000001000000010806000000"
                    "1f15c4890000000d49444154789c626001000000ffff03000006000557bfab"
                    "d40000000049454e44ae426082")


class PageTest(unittest.TestCase):
    views: dict[tuple[str, Path], Element] = {}

    @classmethod
    def setUpClass(cls) -> None:
        if not CHROMIUM:
            raise AssertionError("no chromium: the page cannot be tested (Debian: chromium)")
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.page = cls.make(made_up.write_history(cls.folder / "history"), start=run_command)
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    @classmethod
    def make(cls, *arguments: object, name: str = "page.html",
             start: Callable = run) -> Path:
        out = cls.folder / name
        status, _, err = start(page_program, *arguments, f"--out={out}")
        if status != 0:
            raise AssertionError(f"page.py ended with {status}: {err}")
        return out

    def shown(self, fragment: str = "", page: Path | None = None) -> Element:
        """Without a complaint and without a request; each view is browsed to once."""
        view = (fragment, page or self.page)
        if view not in self.views:
            seen = self.browser.browse(page or self.page, fragment)
            self.assertEqual((seen.console, seen.requests), ([], []))
            self.views[view] = seen.document
        return self.views[view]

    def changed_page(self, name: str, *changes: tuple[str, str]) -> Path:
        """With the policy off, so that scripts of the test run."""
        text = re.sub(r'<meta http-equiv="Content[^>]*>', "", self.page.read_text(encoding="utf-8"))
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        page = self.folder / name
        page.write_text(text, encoding="utf-8")
        return page

    def panels(self, document: Element) -> dict[str, Element]:
        return {panel.attrib["data-case"]: panel
                for panel in document.one("div", id="panels").all("article", class_="panel")}

    def column(self, document: Element, key: str) -> list[str]:
        table = document.one("table", id="table")
        keys = [head.attrib["data-key"] for head in table.all("th", scope="col")]
        return [[cell.words for cell in row][keys.index(key)]
                for row in table.one("tbody").all("tr")]

    def test_headline_says_what_the_last_night_was(self) -> None:
        state = self.shown().one("div", id="state")
        self.assertEqual(state.attrib["class"], "failed")
        self.assertEqual(state.one("h1").words, "Failed: 2 changes for the worse")
        self.assertEqual([item.words[1:] for item in state.all("li")],
                         [verdict["sentence"] for verdict in made_up.made_up_verdicts(11)])
        self.assertIn("7 of 8 cases ok; 12 nights", state.words)
        link = state.all("a")[0].attrib["href"]
        document = self.shown(link)
        self.assertEqual(list(self.panels(document)), [made_up.SLOW_CASE])
        self.assertEqual(self.column(document, "method"), ["3STEPD"])  # and not 3STEPD:LEAN

    def test_a_panel_per_case_and_a_mark_where_it_changed(self) -> None:
        panels = self.panels(self.shown())
        self.assertEqual(len(panels), 8)
        slow = panels[made_up.SLOW_CASE]
        points = slow.all("circle", class_="point")
        self.assertEqual(len(points), made_up.NIGHTS)
        mark = slow.one("line", class_="mark")
        self.assertEqual(mark.attrib["class"], "mark worse")
        self.assertEqual(mark.attrib["data-since"], made_up.date_of(made_up.SLOWER))
        self.assertEqual(mark.attrib["x1"], points[made_up.SLOWER].attrib["cx"])
        heights = [float(point.attrib["cy"]) for point in points]
        self.assertGreater(min(heights[:made_up.SLOWER]), max(heights[made_up.SLOWER:]) + 50)
        self.assertEqual(len(slow.all("path", class_="band")), 1)
        self.assertEqual(len(slow.all("line", class_="tick")), made_up.NIGHTS // 2)  # revisions
        self.assertIn(made_up.revision_of(0)[:7], slow.words)
        self.assertEqual(panels["Mesh0/default/HYBRID"].all("line", class_="mark"), [])
        lost = panels[made_up.LOST_CASE]
        self.assertEqual(lost.one("path", class_="failure").attrib["data-night"], "11")
        self.assertEqual(len(lost.all("circle", class_="point")), made_up.NIGHTS - 1)
        self.assertEqual(lost.one("span", class_="now").words, "–")

    def test_times_of_another_machine_are_not_joined(self) -> None:
        history = made_up.write_history(self.folder / "moved")
        last = max((history / "nights").iterdir())
        last.write_text(last.read_text(encoding="utf-8").replace("A processor", "Another"), encoding="utf-8")
        slow = self.panels(self.shown(page=self.make(history, name="moved.html")))[made_up.SLOW_CASE]
        self.assertEqual(len(slow.all("path", class_="curve")), 2)
        self.assertEqual(slow.one("span", class_="step").words, "")
        here = self.panels(self.shown())[made_up.SLOW_CASE]
        self.assertEqual(len(here.all("path", class_="curve")), 1)
        self.assertIn("%", here.one("span", class_="step").words)

    def test_the_quantity_is_chosen_by_the_address(self) -> None:
        document = self.shown("#quantity=peak_heap_bytes")
        panels = self.panels(document)
        mark = panels[made_up.LEAN_CASE].one("line", class_="mark")
        self.assertEqual(mark.attrib["class"], "mark better")
        self.assertEqual(mark.attrib["data-night"], str(made_up.LEANER))
        self.assertEqual(panels[made_up.SLOW_CASE].all("line", class_="mark"), [])
        self.assertRegex(panels[made_up.SLOW_CASE].one("span", class_="now").words,
                         r"^\d+\.\d MiB$")
        errors = self.panels(self.shown("#quantity=error_stress"))["Mesh0/default/HYBRID"]
        self.assertEqual(errors.one("span", class_="now").words, "4.0e-13")
        self.assertIn("1e-12", errors.words)  # decades

    def test_filter_and_sort(self) -> None:
        document = self.shown("#filter=mesh0+HYB")
        self.assertEqual(self.column(document, "method"), ["HYBRID"])
        self.assertEqual(list(self.panels(document)), ["Mesh0/default/HYBRID"])
        self.assertEqual(document.one("p", id="count").words, "1 of 8 cases")
        document = self.shown("#filter=Mesh0&sort=-time_s")
        self.assertEqual(self.column(document, "method"),
                         ["ALM", "3STEPD:LEAN", "3STEPD", "HYBRID"])
        head = document.one("th", data_key="time_s")
        self.assertEqual(head.attrib["aria-sort"], "descending")
        self.assertEqual(len(head.all("button")), 1)
        for sort in ("time_s", "-time_s"):  # without a time always last
            self.assertEqual(self.column(self.shown(f"#sort={sort}"), "status")[-1],
                             "timeout900 s are up")

    def test_an_address_with_nonsense_is_as_none(self) -> None:
        document = self.shown("#quantity=%&sort=-nothing&other=1")
        self.assertEqual(len(self.panels(document)), 8)
        self.assertEqual(len(self.column(document, "method")), 8)

    def test_environment_marks_what_differs_from_the_night_before(self) -> None:
        table = self.shown().one("table", id="context")
        rows = {row.attrib["data-key"]: row for row in table.all("tr")}
        self.assertEqual(set(rows), set(made_up.made_up_night(0)["context"]))
        self.assertEqual([key for key, row in rows.items() if row.attrib.get("class")],
                         ["kernel"])
        self.assertEqual(rows["kernel"].words, "◆ kernel6.2.0before: 6.1.0")

    def test_a_results_folder_brings_its_records_and_figures(self) -> None:
        results = self.folder / "results"
        (results / "figures").mkdir(parents=True)
        (results / "figures" / "figure4.png").write_bytes(PNG)
        (results / "figures" / "path.gif").write_bytes(b"GIF89a")
        record = made_up.made_up_night(0)["cases"][0] | {"method": "<b>&lt;", "stop": "paper"}
        (results / "records.jsonl").write_text(json.dumps(record) + "\n", encoding="utf-8")
        document = self.shown(page=self.make(self.folder / "history", results, name="both.html"))
        self.assertEqual(self.column(document, "method"), ["<b>&lt;"])
        image, moving = document.one("div", id="pictures").all("img")
        self.assertTrue(image.attrib["src"].startswith("data:image/png;base64,iVBOR"))
        self.assertTrue(moving.attrib["src"].startswith("data:image/gif;base64,R0lGOD"))
        self.assertNotIn("hidden", document.one("section", id="figures").attrib)
        self.assertIn("hidden", self.shown().one("section", id="figures").attrib)

    def test_a_run_alone_has_a_page(self) -> None:
        results = self.folder / "alone"
        (results / "figures").mkdir(parents=True)
        (results / "figures" / "fields_a.png").write_bytes(PNG)
        (results / "figures" / "fields_a.txt").write_text("Stresses & <more>", encoding="utf-8")
        cases = [case | {"error_total": 0.01 * k, "context": {"cpu": "A processor"}}
                 for k, case in enumerate(made_up.made_up_night(11)["cases"], 1)]
        (results / "records.jsonl").write_text("".join(json.dumps(case) + "\n" for case in cases), encoding="utf-8")
        page = self.make(results, name="alone.html")
        document = self.shown(page=page)
        self.assertEqual(document.one("h1").words, "7 of 8 cases ok")
        hidden = {section.attrib["id"]: "hidden" in section.attrib for section in document.all("section")}
        self.assertEqual(hidden, {"history": True, "scatter": False, "cases": False, "figures": False,
                                  "environment": False})
        self.assertEqual(len(document.all("circle", class_="case")), 7)  # one has no time
        self.assertIn("Stresses & <more>", document.one("figcaption").words)
        self.assertEqual(document.one("table", id="context").words, "cpuA processor")
        filtered = self.shown("#filter=Mesh0+HYB&error=error_force", page)
        point, = filtered.all("circle", class_="case")
        self.assertEqual(point.attrib["data-case"], "Mesh0/default/HYBRID")
        self.assertEqual(self.column(filtered, "method"), ["HYBRID"])
        self.assertEqual(self.column(self.shown("#sort=-error_total", page), "error_total")[0], "8.0e-02")

    def test_points_are_told_to_keys(self) -> None:
        page = self.changed_page("told.html", ("</body>", """<script>
            const plot = document.querySelector("#plot svg");
            plot.dispatchEvent(new KeyboardEvent("keydown", {key: "Home", bubbles: true}));
            document.body.dataset.tip = document.getElementById("tip").textContent;
          </script></body>"""))
        document = self.shown(page=page)
        self.assertRegex(document.one("body").attrib["data-tip"], r"^Mesh0/default/HYBRID\n\d.*ms, error force \d")
        plot = document.one("div", id="plot").one("svg")
        self.assertEqual((plot.attrib["tabindex"], plot.attrib["role"]), ("0", "img"))
        self.assertIn("arrow keys", plot.attrib["aria-label"])

    def test_one_night_is_enough_and_its_times_may_not_be_judged_yet(self) -> None:
        for name, judged, headline in (("first", {}, "Passed, nothing has changed"),
                                       ("young", {"times_judged": False}, "Passed, times are not judged yet")):
            history = made_up.write_history(self.folder / name, nights=1)
            file, = (history / "nights").glob("*.json")
            night = json.loads(file.read_text(encoding="utf-8")) | judged
            file.write_text(json.dumps(night), encoding="utf-8")
            document = self.shown(page=self.make(history, name=f"{name}.html"))
            self.assertEqual(document.one("h1").words, headline)
            self.assertEqual(len(self.panels(document)), 8)

    def test_heads_arrows_and_words_are_used(self) -> None:
        page = self.changed_page("used.html", ("</body>", """<script>
            const key = (node, name) =>
              node.dispatchEvent(new KeyboardEvent("keydown", {key: name, bubbles: true}));
            const head = () => document.querySelector("th[data-key=time_s] button");
            head().click();
            head().click();
            const filter = document.getElementById("filter");
            filter.value = "Mesh0";
            filter.dispatchEvent(new Event("input"));
            const panel = document.querySelector(".panel svg");
            key(panel, "Home");
            for (let k = 0; k < 8; ++k) key(panel, "ArrowRight");
            document.body.dataset.fragment = location.hash;
            document.body.dataset.tip = document.getElementById("tip").textContent;
          </script></body>"""))
        document = self.shown("#quantity=time_s", page)
        self.assertEqual(self.column(document, "method"),
                         ["ALM", "3STEPD:LEAN", "3STEPD", "HYBRID"])
        body = document.one("body").attrib
        self.assertEqual(body["data-fragment"], "#filter=Mesh0&sort=-time_s")
        night, value, sentence = body["data-tip"].split("\n")
        self.assertEqual(night, f"{made_up.date_of(8)[:10]}  {made_up.revision_of(8)[:7]}")
        self.assertRegex(value, r"^4\.\d+ ms  \(4\.\d+ ms to 4\.\d+ ms\)$")
        self.assertEqual(sentence, f"▲ {made_up.SENTENCE}")

    def test_the_tests_see_what_they_look_for(self) -> None:
        """A page with an error and a request, which the policy would forbid."""
        page = self.changed_page("bad.html", ("</body>", "<script>nothing();</script>"
                                              "<img src='http://127.0.0.1:9/x.png'></body>"))
        seen = self.browser.browse(page)
        self.assertEqual(seen.requests, ["http://127.0.0.1:9/x.png"])
        self.assertTrue(any("nothing is not defined" in line for line in seen.console))
        kept = self.folder / "kept.html"
        kept.write_text(self.page.read_text(encoding="utf-8").replace(
            "</body>", "<img src='http://127.0.0.1:9/x.png'></body>"), encoding="utf-8")
        seen = self.browser.browse(kept)
        self.assertEqual(seen.requests, [])
        self.assertTrue(any("Content Security Policy" in line for line in seen.console))

    def test_the_page_fetches_nothing(self) -> None:
        text = self.page.read_text(encoding="utf-8")
        self.assertIn("default-src 'none'", text)
        addresses = set(re.findall(r"\w+://[^\s\"'`]*", text))
        self.assertEqual(addresses, {"http://www.w3.org/2000/svg"})  # a name, not a place
        self.assertEqual([word for word in re.findall(r"(?:src|href)=\"([^\"]*)", text)
                          if not word.startswith(("data:", "#"))], [])
        for call in ("fetch(", "XMLHttpRequest", "import(", "WebSocket", "@import", "url("):
            self.assertNotIn(call, text)


class WrongInputTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.history = made_up.write_history(self.folder / "history", nights=2)
        self.file = sorted((self.history / "nights").iterdir())[0]

    def expect(self, line: str, *arguments: object, start: Callable = run) -> None:
        out = self.folder / "page.html"
        status, _, err = start(page_program, *(arguments or [self.history]), f"--out={out}")
        self.assertEqual(status, 2, err)
        self.assertEqual(err, f"page.py: {line}\n")
        self.assertFalse(out.exists())
        self.assertEqual(list(self.folder.glob(".page*")), [])

    def spoil(self, change: dict) -> None:
        night = made_up.made_up_night(0)
        for key, value in change.items():
            if key in ("cases", "verdicts") and isinstance(value, dict):
                items = night[key] or made_up.made_up_verdicts(11)
                night[key] = [items[0] | value]
            else:
                night[key] = value
        self.file.write_text(json.dumps(night), encoding="utf-8")

    def test_folders(self) -> None:
        missing = self.folder / "nowhere"
        self.expect(f"{missing}/nights: no *.json; expected what bench track writes, or the records of a run", missing,
                    start=run_command)
        self.expect(f"{missing}: no such folder; expected the --out of bench", self.history,
                    missing)

    def test_broken_files(self) -> None:
        self.file.write_text('{"format":\n', encoding="utf-8")
        self.expect(f"{self.file}:2: not JSON: Expecting value; expected an object")
        self.file.write_bytes(b"\xff")
        self.expect(f"{self.file}: cannot be read: not UTF-8; expected what bench writes")
        self.file.write_text("[]", encoding="utf-8")
        self.expect(f"{self.file}: not a night; expected an object with format airybench-night-1")
        self.spoil({"noise": {"median_s": float("nan")}})
        self.expect(f"{self.file}: NaN is not JSON; expected null")

    def test_hostile_files(self) -> None:
        for text, why in (("[" * 100_000, "nested too deep"), ("9" * 10_000, "a number too long")):
            self.file.write_text(text, encoding="utf-8")
            self.expect(f"{self.file}: not JSON: {why}; expected an object")
        self.file.unlink()
        os.mkfifo(self.file)
        self.expect(f"{self.file}: is no regular file; expected what bench writes")

    def test_wrong_values_are_named(self) -> None:
        for change, line in (
                ({"date": "yesterday"}, "date is 'yesterday', expected a date in ISO 8601"),
                ({"failed": 1}, "failed is 1, expected true or false"),
                ({"context": {"cpus": 2}}, "cpus is 2, expected a text, or empty"),
                ({"cases": [7]}, "cases[0]: 7, expected an object"),
                ({"cases": {"time_s": "1"}},
                 "cases[0]: time_s is '1', expected a number above 0, or empty"),
                ({"cases": {"stop": "never"}},
                 "cases[0]: stop is 'never', expected one of target, paper"),
                ({"verdicts": {"kind": "odd"}},
                 "verdicts[0]: kind is 'odd', expected one of worse, better, changed")):
            with self.subTest(line):
                self.spoil(change)
                self.expect(f"{self.file}: {line}")

    def test_records(self) -> None:
        results = self.folder / "results"
        results.mkdir()
        (results / "records.jsonl").write_text("{}\n", encoding="utf-8")
        self.expect(f"{results}/records.jsonl:1: mesh is null, expected a name", self.history,
                    results)

    def test_a_file_that_cannot_be_written(self) -> None:
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        for out, why in (("/nowhere/page.html", "/nowhere: No such file or directory; expected a file "
                          "to write"),
                         (pipe, f"{pipe}: is no regular file; expected one, or a name that is not "
                          "there")):
            status, _, err = run(page_program, self.history, f"--out={out}")
            self.assertEqual((status, err), (2, f"page.py: {why}\n"))
