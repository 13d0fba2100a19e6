# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one of our programs on an input and says whether it kept the promise: accepted, or one sentence and a failing status."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile

ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "WM_PROJECT_DIR": os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam"),
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_smsc": "^cma",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}
CRASHES = ("Segmentation fault", "terminate called", "Sanitizer", "runtime error:", "Signal code:", "Floating point exception")
# As tests/interface/bad_input_test.cpp reads them.
SAID = re.compile(r"^(\[\d+\] )?((ERROR( on proc \d+)?|[A-Za-z-]+: error): )")


LOOK = 0.5  # seconds between looks at a process
ASLEEP = 30.0  # seconds without work after which it waits for what does not come


class Broken(AssertionError):
    """The promise was not kept; the text says how."""


def sentences(output):
    """The sentences in which a program says that it stops."""
    found, lines, before = [], iter(output.split("\n")), ""
    for line in lines:
        if line.startswith("Run with --help"):
            found.append(before)
        elif SAID.match(line):
            found.append(line)
        elif "--> FOAM FATAL" in line:
            text = ""
            for line in lines:
                if (not line and text) or "FOAM exiting" in line:
                    break
                text += line + " "
            found.append(text)
        before = line
    return found


class Programs:
    """Our programs in a build folder. factor: how much slower than usual they may be (sanitizers)."""

    def __init__(self, build, factor=1):
        self.bin = pathlib.Path(build).resolve() / "bin"
        self.limit = 20.0 * factor  # seconds of computing; an answer takes half a second, 500 spheres in an STL file four
        self.accepted = self.refused = 0

    def run(self, words, files, beside=None):
        """files: name -> text or bytes; beside(folder, process): what happens while the program runs. Raises Broken."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix="eccentra-fuzz-"))
        try:
            for name, text in files.items():
                path = folder / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogateescape"))
            status, output = self._start(words, folder, beside)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
        self._judge(words, status, output)

    def _start(self, words, folder, beside):
        ours = self.bin / words[0]
        environment = {**ENVIRONMENT, **os.environ, "PATH": f"{self.bin}:{os.environ['PATH']}"}
        environment.pop("DISPLAY", None)
        process = subprocess.Popen([str(ours) if ours.exists() else words[0], *words[1:]], cwd=folder, env=environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            if beside:
                beside(folder, process)
            output = self._wait(process)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            raise Broken(f"no end after {self.limit:g} s of computing, or {ASLEEP:g} s of waiting") from None
        return process.returncode, output.decode("utf-8", "replace")

    def _wait(self, process):
        """Its output; TimeoutExpired once it has computed for longer than allowed, or has done nothing for ASLEEP seconds."""
        asleep, before = 0.0, 0.0
        while True:
            try:
                return process.communicate(timeout=LOOK)[0]
            except subprocess.TimeoutExpired:
                fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
                busy = sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")
                asleep = asleep + LOOK if busy == before and fields[0] == "S" else 0.0
                before = busy
                if busy > self.limit or asleep > ASLEEP:
                    raise

    def _judge(self, words, status, output):
        tail = output[-1500:]
        if status < 0 or any(crash in output for crash in CRASHES):
            raise Broken(f"{words[0]} crashed (status {status}):\n{tail}")
        said = sentences(output)
        if status == 0 and not said:
            self.accepted += 1
        elif status == 0:
            raise Broken(f"{words[0]} says that it stops, and ends with status 0:\n{tail}")
        elif len(said) != 1:
            raise Broken(f"{words[0]} ended with status {status} and {len(said)} sentences:\n{tail}")
        else:
            self.refused += 1
