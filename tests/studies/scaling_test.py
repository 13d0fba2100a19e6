# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What counted messages say of more ranks, on closed forms; pages of which a call renews its own part."""
import pathlib
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from study import full_report, full_study, page_parts, scaling, tables  # noqa: E402
from study.commands import full_scene  # noqa: E402

SAID = """cost by part, mean over 2 rank(s)
sent by a rank in a coupling step, mean: DEM 640 messages, 1280 kB, 2 operations of all ranks; fluid 300 messages, 1e+03 kB, 150.5 operations of all \
ranks; exchange 6 messages, 20 kB, 1 operations of all ranks; link 0 messages, 0 kB, 0 operations of all ranks
"""


class Scaling(unittest.TestCase):
    def test_what_a_run_says_is_read(self):
        sent = scaling.sent_in(SAID)
        self.assertEqual(tuple(sent), scaling.PARTS)
        self.assertEqual(sent["fluid"], scaling.Sent(300, 1000, 150.5))
        self.assertEqual(sum(sent.values(), scaling.Sent()), scaling.Sent(946, 2300, 153.5))
        self.assertEqual(scaling.sent_in("cost by part, mean over 1 rank(s)\n"), {})

    def test_communication_is_latency_rounds_and_transfer(self):
        slow, thin = scaling.Network("slow", 1e-3, 1e300), scaling.Network("thin", 0.0, 1e6)
        sent = scaling.Sent(messages=5, kilobytes=200, operations=3)
        self.assertAlmostEqual(scaling.communication(sent, 2, slow), 8e-3)
        self.assertAlmostEqual(scaling.communication(sent, 16, slow), 17e-3)
        self.assertAlmostEqual(scaling.communication(sent, 9, slow), 17e-3)  # as many rounds as 16 need
        self.assertAlmostEqual(scaling.communication(sent, 16, thin), 0.2)

    def test_computing_is_divided_and_communication_is_not(self):
        network = scaling.Network("slow", 1e-3, 1e300)
        self.assertEqual(scaling.seconds_on(1, 2.0, scaling.Sent(messages=100), network), 2.0)
        self.assertAlmostEqual(scaling.seconds_on(4, 2.0, scaling.Sent(messages=100), network), 0.6)

    def test_hours_of_the_run_from_those_of_a_step(self):
        one = {"bodies": 10, "interval": 100, "fluid_step": 1.0, "exchange": 0.2, "dem_step": 0.006, "sent": {}}
        two = one | {"fluid_step": 0.5, "exchange": 0.1, "dem_step": 0.003, "sent": {"DEM": [0, 0, 0]}}
        rows = full_scene.scaled_rows({("S1", 0.5, 1): one, ("S1", 0.5, 2): two})
        self.assertEqual([row[2] for row in rows], ["1", "2", "8", "16", "32"])
        for row, measured in zip(rows, (1.5, 0.75, None, None, None)):  # 1.8 s a step, 3000 steps
            self.assertEqual(row[3] and round(row[3], 12), measured)
            self.assertAlmostEqual(row[4], 1.5 / int(row[2]))
        self.assertEqual(full_scene.scaled_rows({("S1", 0.5, 2): two}), [])


class Parts(unittest.TestCase):
    def test_a_call_renews_its_own_part(self):
        page = page_parts.page_of("x", {"run S1": "first", "cost": "dear"})
        both = page_parts.renewed("x", page, page_parts.page_of("x", {"run C64": "second"}))
        self.assertEqual(list(page_parts.parts_of("x", both).items()), [("run S1", "first"), ("run C64", "second"), ("cost", "dear")])
        again = page_parts.renewed("x", both, page_parts.page_of("x", {"run S1": "new"}))
        self.assertEqual(again, both.replace("first", "new"))
        self.assertEqual(page_parts.renewed("x", again, "no part\n"), "no part\n")
        self.assertEqual(page_parts.parts_of("y", again), {})

    def test_a_part_says_how_it_was_made_but_for_the_head(self):
        with tempfile.TemporaryDirectory() as folder:
            chosen = types.SimpleNamespace(out=pathlib.Path(folder), store=types.SimpleNamespace(account=lambda: "no runs"))
            study = pathlib.Path(sys.argv[0]).name
            for part in ("figure 7", "figure 10"):
                self.assertEqual(tables.finish(chosen, {page_parts.HEAD: ["## All\n"], part: [f"## {part}\n"]}, [], f"{part} alone"), 0)
            parts = page_parts.parts_of(study, (chosen.out / "results.md").read_text())
            self.assertEqual(parts.pop(page_parts.HEAD), "## All")
            self.assertEqual(list(parts), ["figure 7", "figure 10"])
            for part, lines in parts.items():
                self.assertRegex(lines, rf"(?s)^## {part}\n.*Made by .*; {part} alone; no runs[.][*]$")


class Limit(unittest.TestCase):
    def test_the_nearest_to_the_critical_step_of_all_calls(self):
        line = "fix limit timestep/limit at step {}: critical step {} s (body 3, cube 64, 5 contacts); time step 6e-05 s is {} of it, safety 2 allows 1e-4 s\n"
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder)
            self.assertIn("has said nothing", full_report.limit_sentence("C64", case))
            (case / "log.liggghts").write_text(line.format(1000, 1.2e-4, 0.5))
            (case / "log.liggghts.1").write_text(line.format(2000, 5e-5, 1.2) + line.format(3000, 1.2e-4, 0.5))
            self.assertRegex(full_report.limit_sentence("C64", case), "at most 1.2 of the critical one; of the 3 times .* above 1 in 1[.]")

    def test_another_angle_has_files_of_its_own(self):
        self.assertEqual(full_study.label_of(types.SimpleNamespace(angle=80.0), "S1"), "S1")
        self.assertEqual(full_study.label_of(types.SimpleNamespace(angle=40.0), "S1"), "S1-40-degrees")


if __name__ == "__main__":
    unittest.main()
