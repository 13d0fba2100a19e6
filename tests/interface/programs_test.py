#!/usr/bin/env python3
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Walks the programs of the build and the scripts, in an empty environment and in a folder with a space: --help, --version, a page, completion,
and one sentence where such a folder cannot be used. programs_test.py SOURCE BUILD"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
PROGRAMS = sorted(path for path in (BUILD / "bin").iterdir() if path.is_file())
# Those of the developers have no version of their own.
SCRIPTS = sorted(path for path in (SOURCE / "scripts").iterdir() if path.is_file() and path.stat().st_mode & 0o100 and path.name != "lint-units")
STUDIES = [path for path in SCRIPTS if path.is_symlink()]
# Words with which a program begins to work on the folder "a case".
WORK = {"annulusFoam": ["-case", "{}"], "annulusMesh": ["-case", "{}"], "eccentra-run": ["{}"]}


def said(path, *words, folder):
    """(exit code, what it says) with nothing in the environment but a PATH and a home."""
    done = subprocess.run([str(path), *words], cwd=folder, env={"PATH": "/usr/bin:/bin", "HOME": folder}, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60, check=False)
    return done.returncode, done.stdout


class Programs(unittest.TestCase):
    def setUp(self):
        self.home = tempfile.TemporaryDirectory(prefix="eccentra programs ")
        self.addCleanup(self.home.cleanup)
        self.folder = self.home.name

    def test_there_are_programs(self):
        self.assertGreater(len(PROGRAMS), 5)
        self.assertGreater(len(STUDIES), 10)

    def test_help(self):
        for path in [*PROGRAMS, *SCRIPTS]:
            with self.subTest(program=path.name):
                code, text = said(path, "--help", folder=self.folder)
                self.assertEqual(code, 0, text)
                self.assertRegex(text.lower(), rf"usage|{path.name.lower()}")
                self.assertGreater(len(text.splitlines()), 1, text)

    def test_version(self):
        for path in [*PROGRAMS, *STUDIES]:
            with self.subTest(program=path.name):
                code, text = said(path, "--version", folder=self.folder)
                self.assertEqual(code, 0, text)
                self.assertRegex(text, r"\d+\.\d+\.\d+")

    def test_a_script_says_help_and_version_with_no_other_program_about(self):
        for path in PROGRAMS:
            if path.read_bytes()[:2] != b"#!":
                continue
            alone = pathlib.Path(shutil.copy(path, self.folder))
            for word in ("--help", "--version"):
                with self.subTest(program=path.name, word=word):
                    code, text = said(alone, word, folder=self.folder)
                    self.assertEqual(code, 0, text)

    def test_each_program_has_a_page_a_manual_and_completion(self):
        manual = re.search(r"ECCENTRA_PROGRAMS ([^)]*)\)", (SOURCE / "scripts/cmake/EccentraManual.cmake").read_text()).group(1).split()
        completed = re.search(r"^complete .* -F _eccentra (.*)$", (SOURCE / "scripts/completion.bash").read_text(), re.MULTILINE).group(1).split()
        for path in PROGRAMS:
            with self.subTest(program=path.name):
                self.assertTrue((SOURCE / "docs" / f"{path.name}.md").is_file(), "no page")
                self.assertIn(path.name, manual)
                self.assertIn(path.name, completed)

    def test_a_folder_with_a_space_works_or_is_refused_in_one_sentence(self):
        case = pathlib.Path(self.folder) / "a case"
        case.mkdir()
        for name, words in WORK.items():
            if not (BUILD / "bin" / name).is_file():
                continue
            with self.subTest(program=name):
                code, text = said(BUILD / "bin" / name, *(word.format(case) for word in words), folder=self.folder)
                self.assertNotEqual(code, 0, text)
                self.assertEqual(len(text.strip().splitlines()), 1, text)
                self.assertIn("a case", text)
                self.assertRegex(text, "error: ")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
