#!/usr/bin/env python3
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""eccentra new asks at a terminal for what no option says: own_scene_questions_test.py BIN."""
import os
import pathlib
import re
import select
import shlex
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve() / "eccentra"


def at_terminal(words, answers, folder):
    """(exit code, what a terminal shows) with an answer for each prompt, which ends with '] :' or ': '."""
    master, slave = os.openpty()
    job = subprocess.Popen([str(PROGRAM), *words], cwd=folder, stdin=slave, stdout=slave, stderr=slave)
    os.close(slave)
    shown, answered, until = "", 0, time.monotonic() + 60
    while time.monotonic() < until:
        if not select.select([master], [], [], 0.1)[0]:
            if job.poll() is not None:
                break
            continue
        try:
            shown += os.read(master, 4096).decode()
        except OSError:
            break
        if shown.endswith(": ") and answered < len(answers):
            os.write(master, answers[answered].encode() + b"\n")
            answered += 1
    os.close(master)
    return job.wait(60), shown.replace("\r", "")


def alone(words, folder, text=None):
    """(exit code, what is said) without a terminal."""
    done = subprocess.run([str(PROGRAM), *words], cwd=folder, input=text, stdin=None if text is not None else subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60, check=False)
    return done.returncode, done.stdout


class Questions(unittest.TestCase):
    def setUp(self):
        home = tempfile.TemporaryDirectory()
        self.addCleanup(home.cleanup)
        self.folder = home.name

    def test_a_wrong_answer_is_asked_again_and_the_command_is_told(self):
        code, shown = at_terminal(["new"], ["heap", "cone", "cube 7", "cube 8", "5furlong", "5mm", "", "", "60"], self.folder)
        self.assertEqual(code, 0, shown)
        self.assertIn("cube 7", shown)
        self.assertRegex(shown, r"--diameter: '5furlong' is not a number with a unit; expected .*\ndiameter \(")
        self.assertTrue((pathlib.Path(self.folder) / "cone" / "scene").is_file())
        scene = (pathlib.Path(self.folder) / "cone" / "scene").read_text()
        for entry in (r'shape +"cube 8";', r"diameter +0.005;", r"count +60;", r"solidDensity +2619;"):
            self.assertRegex(scene, entry)
        line = re.search(r"the same without questions: (.*)", shown).group(1)
        words = shlex.split(line)[1:]
        words[words.index("cone")] = "again"
        self.assertEqual(alone(words, self.folder)[0], 0)
        self.assertEqual((pathlib.Path(self.folder) / "again" / "scene").read_text(), scene)

    def test_a_pipe_wider_than_the_hole_is_refused_at_its_question(self):
        code, shown = at_terminal(["new", "section", "x", "--plan"], ["4in", "5in", "2in"] + [""] * 20, self.folder)
        self.assertEqual(code, 0, shown)
        self.assertIn("--pipe: '5in' does not fit into the hole of '4in'", shown)
        self.assertRegex(shown, r"gap .* 2 in|gap .*\(1.5 in\) wide")

    def test_who_gives_an_option_is_not_asked_and_sees_what_was_taken(self):
        code, shown = at_terminal(["new", "heap", "x", "--plan", "--count", "50"], [], self.folder)
        self.assertEqual(code, 0, shown)
        self.assertNotIn("[", shown)
        self.assertIn("by default: --shape sphere, --diameter 6.35mm", shown)

    def test_ask_asks_without_a_terminal_for_what_is_missing(self):
        code, shown = alone(["new", "heap", "x", "--plan", "--ask", "--count", "50"], self.folder, "cube 8\n\n\n\n")
        self.assertEqual(code, 0, shown)
        self.assertNotIn("count (", shown)
        code, shown = alone(["new", "heap", "x", "--plan", "--ask"], self.folder, "cube 8\n")
        self.assertEqual(code, 1, shown)
        self.assertIn("the answers end before the questions", shown)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
