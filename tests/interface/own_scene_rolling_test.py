#!/usr/bin/env python3
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rolling friction of a case reaches its grains, spheres and clusters: own_scene_rolling_test.py BIN SOURCE."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BIN, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])


def shell(words, folder):
    """(exit code, what is said)."""
    done = subprocess.run([str(word) for word in words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=120, check=False)
    return done.returncode, done.stdout


class Rolling(unittest.TestCase):
    def setUp(self):
        home = tempfile.TemporaryDirectory()
        self.addCleanup(home.cleanup)
        self.folder = pathlib.Path(home.name)

    def left(self, name, *options):
        """Of 100 grains that fall on a floor, those that are still there a second later."""
        code, said = shell([BIN / "eccentra", "new", "heap", name, "--count", 100, "--seconds", 1, *options], self.folder)
        self.assertEqual(code, 0, said)
        code, log = shell([self.folder / name / "run", "--output", f"{name}-run"], self.folder)
        self.assertEqual(code, 0, log)
        lines = re.findall(r"^ +\d+ +\S+ +(\d+) ", log, re.MULTILINE)
        return int(lines[-1]), said

    def test_spheres_of_several_sizes_stay_where_they_fall(self):
        sizes = ["--diameter", "3.6mm", "--spread", "uniform 0.3"]
        rolled, said = self.left("smooth", *sizes)
        self.assertIn("warning: spheres without rolling friction roll apart", said)
        stayed, said = self.left("rough", *sizes, "--rolling", 0.3)
        self.assertNotIn("warning", said)
        self.assertLess(rolled, 50)
        self.assertGreater(stayed, 90)

    def test_every_script_with_rolling_gives_it_to_pairs_and_walls(self):
        scripts = [path for top in ("cases", "scripts/study/scenes") for path in (SOURCE / top).rglob("*") if path.is_file() and path.suffix != ".png"]
        known = 0
        for path in scripts:
            text = path.read_text(errors="replace").replace("&\n", " ")
            if "{roll}" not in text:
                continue
            known += 1
            for line in text.splitlines():
                for style in re.findall(r"pair_style gran[^\"]*|fix +\w+ +\w+ +wall/gran/cluster .*", line):
                    with self.subTest(path=path.name, style=style[:60]):
                        self.assertIn("rolling_friction", style)
        self.assertGreaterEqual(known, 6)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
