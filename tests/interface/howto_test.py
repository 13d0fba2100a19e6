#!/usr/bin/env python3
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands of a how-to page (its blocks `sh`) in a clean folder, and looks for the files that the page promises: howto_test.py PAGE BIN CASES."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time


def main(page, programs, cases):
    text = pathlib.Path(page).read_text()
    blocks = re.findall(r"^```sh\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    if not blocks:
        sys.exit(f"howto_test: {page}: no block of commands")
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}", ECCENTRA_BIN=str(programs))
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(cases, pathlib.Path(folder) / "cases", ignore=shutil.ignore_patterns("results*"))
        for number, block in enumerate(blocks, 1):
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", block], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, check=False)
            if done.returncode:
                said = (done.stdout + done.stderr)[-3000:]
                sys.exit(f"howto_test: {page}: block {number} of {len(blocks)} ends with {done.returncode}:\n{block}\n{said}")
        promised = [name for name in set(re.findall(r"`([\w.-]+/[\w./-]+\.(?:png|svg|pvd|csv|html|md|vtp))`", text)) if not name.startswith("docs/")]
        missing = [name for name in promised if not (pathlib.Path(folder) / name).is_file()]
        if missing:
            sys.exit(f"howto_test: {page}: its commands do not make {', '.join(sorted(missing))}")
    print(f"howto_test: {page}: {len(blocks)} blocks, {len(promised)} files, {time.monotonic() - begun:.0f} s")


if __name__ == "__main__":
    main(sys.argv[1], *(pathlib.Path(path).resolve() for path in sys.argv[2:4]))
