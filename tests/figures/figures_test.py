"""tools/figures makes tables and plots of what benches wrote, and sees documents that say something else."""
import importlib.machinery
import importlib.util
import json
import pathlib
import sys
import tempfile
import unittest

TOOL = sys.argv.pop(1)
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("figures", TOOL)
figures = importlib.util.module_from_spec(importlib.util.spec_from_loader("figures", loader))
loader.exec_module(figures)


def spread(value):
    return {"median": value, "min": 0.5 * value, "max": 2 * value, "p99": 2 * value, "count": 3}


def point(setting, psnr, ms):
    return {"setting": setting, "errors": {"psnr": spread(psnr), "msSsim": spread(psnr / 30)},
            "costs": {"frameMs": spread(ms), "bytes": spread(2e6)}}


SWEEP = {"processor": "A processor", "threads": 2, "commit": "abc", "frames": 8,
         "points": [point({}, 27.0, 4.0), point({"layers": "2"}, 24.0, 3.0), {"setting": {"layers": "4"}, "skipped": "no time"}],
         "front": [{}, {"layers": "2"}], "presets": {"accurate": {}, "fast": {"layers": "2"}},
         "numerics": [{"title": "Signs", "explanation": "", "columns": ["wrong, %"],
                       "rows": [{"cases": "anywhere", "hard": False, "way": "exact", "values": {"wrong, %": 0}},
                                {"cases": "anywhere", "hard": False, "way": "naive", "values": {"wrong, %": 12.3456}}]}]}
DOCUMENT = """# Costs
before
<!-- figures sweep walk -->
old
<!-- /figures -->
between
<!-- figures numerics walk table=1 -->
<!-- /figures -->
<!-- figures sweep-plot walk -->
<!-- /figures -->
after
"""


class Figures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        (self.root / "docs" / "pictures").mkdir(parents=True)
        self.document = self.root / "docs" / "costs.md"
        self.document.write_text(DOCUMENT)
        (self.root / "README.md").write_text("no tables\n")
        measured = self.root / "sweep.json"
        measured.write_text(json.dumps(SWEEP | {"sets": [{"name": "path", "views": [1, 2, 3]}]}))
        self.assertEqual(self.run_tool("import", "walk", str(measured), "--command", "acentric sweep P"), 0)

    def run_tool(self, *words):
        return figures.main(list(words), self.root)

    def test_single_frames_are_left_out_and_the_command_is_kept(self):
        kept = json.loads((self.root / "docs/figures/walk.json").read_text())
        self.assertEqual(kept["command"], "acentric sweep P")
        self.assertNotIn("views", kept["sets"][0])
        self.assertEqual(kept["frames"], 8, "a number is no list of frames")

    def test_tables_are_written_between_their_marks_and_nothing_else_changes(self):
        self.assertEqual(self.run_tool("write"), 0)
        text = self.document.read_text()
        self.assertIn("| as it is (*accurate*) | 27.00 dB |", text)
        self.assertIn("| layers 2 (*fast*) | 24.00 dB |", text)
        self.assertIn("3.00 ms (1.50 to 6.00)", text)
        self.assertNotIn("layers 4", text, "what was skipped has no row unless it is asked for")
        self.assertIn("|  | naive | 12.35 |", text)
        self.assertIn("(`acentric sweep P`; A processor, 2 threads; commit abc)", text)
        self.assertNotIn("old", text)
        for line in ("# Costs", "before", "between", "after"):
            self.assertIn(line, text.split("\n"))
        picture = (self.root / "docs/pictures/walk-sweep.svg").read_text()
        self.assertIn("<title>layers 2</title>", picture)
        self.assertEqual(self.run_tool("write"), 0)
        self.assertEqual(self.document.read_text(), text, "written twice it is the same")

    def test_functions_stand_beside_what_they_were_timed_with(self):
        measured = self.root / "functions.json"
        measured.write_text(json.dumps({"processor": "A processor", "threads": 2, "commit": "abc", "benches": [
            {"bench": "layout", "facts": {}, "figures": [
                {"what": "exact sign", "unit": "ns", "median": 18.76, "min": 18, "max": 20.5, "count": 5, "ratio": 3.95,
                 "beside": {"name": "naive", "median": 4.75, "min": 4, "max": 5, "count": 5}}]},
            {"bench": "plan", "facts": {}, "figures": [
                {"what": "send", "unit": "ms", "median": 13, "min": 12, "max": 14, "count": 5}]}]}))
        self.assertEqual(self.run_tool("import", "parts", str(measured), "--command", "acentric bench functions"), 0)
        self.document.write_text("<!-- figures functions parts bench=layout -->\n<!-- /figures -->\n")
        self.assertEqual(self.run_tool("write"), 0)
        text = self.document.read_text()
        self.assertIn("| exact sign | 18.76 ns | 18 to 20.5 | naive: 4.75 ns | 3.95 |", text)
        self.assertNotIn("send", text)

    def test_walks_through_ever_more_regions_have_a_row_each(self):
        walk = {"regions": 1000000, "openSeconds": 0.125, "openBytes": 150000, "firstFrameSeconds": 0.25, "firstFrameBytes": 180000,
                "frameMsMedian": 12.34, "frameMsP99": 30, "frameMsMax": 41, "processorMs": 20.04, "residentBytesPeak": 456e6,
                "peakBytes": 128e6, "loads": 1234, "coarseLoads": 500, "evictions": 800, "coarseFrames": 16, "incompleteFrames": 0}
        measured = self.root / "walks.json"
        measured.write_text(json.dumps({"walks": [walk | {"regions": 100}, walk]}))
        self.assertEqual(self.run_tool("import", "grown", str(measured)), 0)
        self.document.write_text("<!-- figures walks grown -->\n<!-- /figures -->\n")
        self.assertEqual(self.run_tool("write"), 0)
        self.assertIn("| 1,000,000 | 125 ms, 150 kB | 250 ms, 180 kB | 12.3 / 30.0 / 41 ms | 20.0 ms | 456 MB | 128 MB | 1,234 + 500 / 800 | 16 / 0 |",
                      self.document.read_text())

    def test_a_document_that_says_something_else_is_seen(self):
        self.assertEqual(self.run_tool("check"), 1)
        self.run_tool("write")
        self.assertEqual(self.run_tool("check"), 0)
        self.document.write_text(self.document.read_text().replace("27.00 dB", "28.00 dB"))
        self.assertEqual(self.run_tool("check"), 1)
        self.assertIn("28.00 dB", self.document.read_text(), "checking changes nothing")

    def test_mistakes_are_told(self):
        for wrong in ("<!-- figures sweep walk -->\n", "<!-- /figures -->\n", "<!-- figures sweep nowhere -->\n<!-- /figures -->\n",
                      "<!-- figures pie walk -->\n<!-- /figures -->\n",
                      "<!-- figures sweep walk rows=nothing -->\n<!-- /figures -->\n",
                      "<!-- figures numerics walk table=9 -->\n<!-- /figures -->\n",
                      "<!-- figures functions walk -->\n<!-- /figures -->\n"):
            self.document.write_text(wrong)
            self.assertEqual(self.run_tool("write"), 1, wrong)
            self.assertEqual(self.document.read_text(), wrong)


if __name__ == "__main__":
    unittest.main()
