# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs that the studies start: where they are, in which environment they run, what they said."""
import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import typing

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent  # of the source tree, or share/eccentra of an installation
INSTALLED = not (ROOT / "CMakeLists.txt").is_file()
BUILD = ROOT.parent.parent if INSTALLED else ROOT / "build"  # programs are in its bin
RESULTS = pathlib.Path.cwd() / "results" if INSTALLED else ROOT / "results"
CASES = ROOT / "cases"
RUN_CASE = BUILD / "bin" / "eccentra-run" if INSTALLED else CASES / "run-coupled"  # what runs a case
SCENES = pathlib.Path(__file__).resolve().parent / "scenes"
OPENFOAM = "/usr/share/openfoam"  # of Debian's package, where WM_PROJECT_DIR names no other installation
PROGRESS = re.compile(r"t \S+ (of \S+ )?s ")  # how a line of progress of annulusFoam begins
HOSTS = ("liggghts", "libopenfoam", "libopenmpi3", "lammps", "yade")  # Debian packages whose code takes part in results
said_version = ""  # by the program eccentra
# What computes, in a build folder, and in the prefix of an installation, which has others' programs beside.
OURS = ("bin/annulus*", "bin/clusterShape", "bin/dragLaw", "bin/eccentra*", "lib/libeccentra*", "lib/*/libeccentra*") if INSTALLED else ("bin/*", "lib/*")


def version():
    """Of Eccentra: what the program eccentra was made with, or what the source tree states."""
    return said_version or re.search(r"^project\(eccentra VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE).group(1)


class Failure(Exception):
    """What ends a script: one sentence."""


class RunFailed(Failure):
    """A run that ended with an error; its text is one sentence."""


def environment():
    """Of every program that a study starts: no result depends on the user's language."""
    of_root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return {"WM_PROJECT_DIR": OPENFOAM, **os.environ, **of_root, "LC_ALL": "C"}


def digest_of(*paths):
    """Of the contents of files: what a scene says is an input as its variables are."""
    total = hashlib.sha256()
    for path in paths:
        total.update(path.read_bytes())
    return total.hexdigest()[:16]


def code_of(build):
    """Of all that computes: programs and libraries of a build, the packages of its hosts, the OpenFOAM installation."""
    said = subprocess.run(["dpkg-query", "-W", *HOSTS], capture_output=True, text=True, check=False).stdout if shutil.which("dpkg-query") else ""
    ours = digest_of(*sorted(file for pattern in OURS for file in build.glob(pattern) if file.is_file()))
    return hashlib.sha256(" ".join((ours, said, environment()["WM_PROJECT_DIR"])).encode()).hexdigest()[:16]


def need(build, *names):
    """Fails where the build lacks a program."""
    for name in names:
        if not (build / name).is_file():
            raise Failure(f"there is no {build / name}: build it with 'cmake --build {build} --target {pathlib.Path(name).name}'")


_running, _lock = set(), threading.Lock()


class Spent(typing.NamedTuple):
    """What a program took, with its children: CPU seconds, wall seconds, largest resident memory [kB]."""
    cpu: float
    wall: float
    memory: int


def begin(words, folder, out, **more):
    """Starts a program, in a group of its own and with `more` in its environment; a stop of the script stops it, too, until `end`."""
    with _lock:  # none may start behind the back of a stop
        try:
            process = subprocess.Popen([str(w) for w in words], cwd=folder, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                       start_new_session=True, env=environment() | more)
        except FileNotFoundError:
            raise Failure(f"there is no program {words[0]} on this machine: run scripts/setup") from None
        _running.add(process)
    return process


def end(process):
    with _lock:
        _running.discard(process)


def run(words, folder, log, **more):
    """Runs a program that must succeed; RunFailed, in its own words, if not."""
    began = time.monotonic()
    with open(log, "w") as out:
        process = begin(words, folder, out, **more)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        end(process)
    if process.returncode:
        raise RunFailed(sentence_of(log, process.returncode))
    return Spent(usage.ru_utime + usage.ru_stime, time.monotonic() - began, usage.ru_maxrss)


def output_of(words, folder=None):
    """What a short program prints; Failure if it fails."""
    done = subprocess.run([str(w) for w in words], cwd=folder, env=environment(), capture_output=True, text=True, check=False)
    if done.returncode:
        last = (done.stderr.strip() or done.stdout.strip() or f"status {done.returncode}").splitlines()[-1]
        raise Failure(f"{pathlib.Path(str(words[0])).name} failed: {last}")
    return done.stdout


def sentence_of(log, status):
    """What a program that failed said: its first line with an error, or how it ended. Lines of progress, which tell the errors of a step, are none."""
    lines = pathlib.Path(log).read_text(errors="replace").splitlines()
    return next((line.strip() for line in lines if "error" in line.lower() and "errorcode" not in line and not PROGRESS.match(line)),
                f"ended with status {status}: see {log}")


def options(**values):
    """`--name value` for each."""
    return [word for name, value in values.items() for word in (f"--{name}", value)]


def variables(**values):
    """`-var name value` of LIGGGHTS for each."""
    return [word for name, value in values.items() for word in ("-var", name, value)]


def write_output(texts):
    """Writes what --output names and what lies beside it, {path: text}, and names the files."""
    for path, text in texts.items():
        try:
            path.write_text(text)
        except OSError as problem:
            raise Failure(f"{path}: cannot be written ({problem.strerror}): give another file by --output") from None
    sys.stdout.write(f"written: {', '.join(map(str, texts))}\n")


def _stop(*_):
    with _lock:
        for process in _running:
            try:
                os.killpg(process.pid, signal.SIGTERM)
            except ProcessLookupError:
                pass
        sys.stderr.write("\nstopped: the same command goes on from here\n")
        os._exit(130)


def stop_with_the_user():
    """What is running ends with Ctrl-C or SIGTERM."""
    signal.signal(signal.SIGINT, _stop)
    signal.signal(signal.SIGTERM, _stop)
