# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A short piece of the whole scene: interrupted, it goes on to the same digits; the balance of mass is closed."""
import csv
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("ECCENTRA_BUILD", ROOT / "build"))
WORDS = ["--run", "S1", "--length", "0.6", "--end", "0.8"]
PATIENCE = 250  # seconds


def call(out, *more):
    return [ROOT / "scripts" / "full-scene", "--build", BUILD, "--out", out, *WORDS, *more]


def table(out):
    """coupling.csv of the run without what it cost."""
    file, = out.glob("runs/*/case/postProcessing/eccentra/coupling.csv")
    with open(file, newline="") as rows:
        return [{name: value for name, value in row.items() if not name.endswith("_seconds")} for row in csv.DictReader(rows)]


def time_of(out):
    """That the run has come to [s]."""
    files = list(out.glob("runs/*/case/postProcessing/eccentra/coupling.csv"))
    lines = files[0].read_text().splitlines()[1:] if files else []
    return float(lines[-1].partition(",")[0] or 0) if lines else 0.0


class WholeScene(unittest.TestCase):
    def test_interrupted_run_goes_on_to_the_same_digits(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        cut, whole = folder / "cut", folder / "whole"
        subprocess.run(call(whole), check=True, capture_output=True)
        with subprocess.Popen(call(cut), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            until = time.monotonic() + PATIENCE
            while time.monotonic() < until and process.poll() is None and time_of(cut) < 0.15:
                time.sleep(0.05)
            process.send_signal(signal.SIGTERM)
        self.assertNotEqual(process.returncode, 0)
        self.assertLess(float(table(cut)[-1]["time"]), 0.8)
        said = subprocess.run(call(cut, "--show"), check=True, capture_output=True, text=True)
        self.assertIn("the run has not come to its end", (cut / "results.md").read_text(), said.stdout)

        subprocess.run(call(cut), check=True, capture_output=True)
        self.assertEqual(table(cut), table(whole))
        self.assertEqual((cut / "S1-along.csv").read_text(), (whole / "S1-along.csv").read_text())
        page = (cut / "results.md").read_text()
        self.assertIn("computed in 2 call(s)", page)
        self.assertRegex(page, r"balance is closed to (0\.0e\+00|\d\.\de-1[3-9])")
        from PIL import Image
        with Image.open(cut / "S1-film.png") as film:
            self.assertEqual(film.n_frames, len(list(cut.glob("runs/*/case/postProcessing/eccentra/grains_*.vtp"))))
        for name in ("S1-hole.png", "S1-piece.png", "S1.svg", "S1-beside-the-paper.csv"):
            self.assertGreater((cut / name).stat().st_size, 100)


if __name__ == "__main__":
    unittest.main()
