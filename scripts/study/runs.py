# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a study: each in a folder named by its inputs, kept, several at a time, with the time left."""
import concurrent.futures
import dataclasses
import datetime
import fcntl
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import typing


class RunFailed(Exception):
    """A run that ended with an error; its text is one sentence."""


@dataclasses.dataclass
class Job:
    """One run: `inputs` (JSON) say all that its result depends on, `work(folder)` runs it in its folder and returns
    the result (JSON); `estimate`: CPU seconds that it may take, for the time left."""
    name: str
    inputs: dict
    work: typing.Callable[[pathlib.Path], dict]
    estimate: float = 5.0

    def key(self):
        return hashlib.sha256(json.dumps(self.inputs, sort_keys=True).encode()).hexdigest()[:16]


def digest_of(*paths):
    """Of the contents of files: what a scene says is an input as its variables are."""
    total = hashlib.sha256()
    for path in paths:
        total.update(path.read_bytes())
    return total.hexdigest()[:16]


_running, _lock = set(), threading.Lock()


def command(words, folder, log):
    """Runs a program in a group of its own; returns its status, CPU seconds (with those of its children) and wall seconds."""
    began = time.monotonic()
    environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ,
                   "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    with open(log, "w") as out:
        with _lock:  # none may start behind the back of a stop
            process = subprocess.Popen([str(w) for w in words], cwd=folder, stdout=out, stderr=subprocess.STDOUT,
                                       stdin=subprocess.DEVNULL, start_new_session=True, env=environment)
            _running.add(process)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        with _lock:
            _running.discard(process)
    return process.returncode, usage.ru_utime + usage.ru_stime, time.monotonic() - began


def sentence_of(log, status):
    """What a program that failed said: its first line with an error, or how it ended."""
    lines = pathlib.Path(log).read_text(errors="replace").splitlines()
    return next((line.strip() for line in lines if "error" in line.lower() and "errorcode" not in line),
                f"ended with status {status}: see {log}")


def _stop(*_):
    with _lock:
        for process in _running:
            try:
                os.killpg(process.pid, signal.SIGTERM)
            except ProcessLookupError:
                pass
        sys.stderr.write("\nstopped: the same command goes on from here\n")
        os._exit(130)


def code_of(build):
    """Of all programs and libraries of a build: what they compute with is an input, too."""
    return digest_of(*sorted(file for folder in ("bin", "lib") for file in (build / folder).glob("*") if file.is_file()))


def kept_in(output, root):
    """Folder of a study's runs: all studies and sizes share one, unless the user has named a folder for this one."""
    return (output.resolve() if output else root / "results") / "runs"


def add_words(parser):
    """Options that all studies have."""
    parser.add_argument("--any-build", action="store_true", help="take finished runs of other builds, too (default: repeat them)")
    parser.add_argument("--show", action="store_true", help="run nothing: write the pages from the finished runs, and say what is not run")


def good(result):
    """Neither failed nor, where only kept results are shown, not run yet."""
    return "failed" not in result and "missing" not in result


class Store:
    """Results of jobs in FOLDER/KEY/result.json, with the build that made them. `any_build`: those of other builds count, too;
    `only_kept`: nothing is run, what is not there is {"missing": True}."""

    def __init__(self, folder, at_once, build, any_build=False, only_kept=False):
        self.folder, self.at_once = pathlib.Path(folder), at_once
        self.code, self.any_build, self.only_kept = code_of(build), any_build, only_kept
        self.used = {}  # key: what its file says besides the result
        self.cpu, self.began = 0.0, time.monotonic()
        signal.signal(signal.SIGINT, _stop)
        signal.signal(signal.SIGTERM, _stop)

    def folder_of(self, job):
        return self.folder / job.key()

    def result_of(self, job):
        """The kept result, or None."""
        file = self.folder_of(job) / "result.json"
        if not file.is_file():
            return None
        kept = json.loads(file.read_text())
        if kept.get("code") != self.code and not self.any_build:
            return None
        self.used[job.key()] = {name: kept[name] for name in ("code", "made", "load")} | {"cpu": kept["result"].get("cpu", 0.0)}
        return kept["result"]

    def _run(self, job):
        folder = self.folder_of(job)
        folder.mkdir(parents=True, exist_ok=True)
        with open(folder / "lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)  # another script may run the same job
            kept = self.result_of(job)
            return kept if kept is not None else self._work(job, folder)

    def _work(self, job, folder):
        try:
            result = job.work(folder)
        except RunFailed as failure:
            return {"failed": str(failure)}
        about = {"code": self.code, "made": datetime.datetime.now().isoformat(" ", "minutes"), "load": round(os.getloadavg()[0], 1)}
        part = folder / "result.part"
        part.write_text(json.dumps({"name": job.name, **about, "inputs": job.inputs, "result": result}, indent=1))
        part.replace(folder / "result.json")
        with _lock:
            self.used[job.key()] = about | {"cpu": result.get("cpu", 0.0)}
        return result

    def account(self):
        """When the results that were used were made, and by how much CPU: words of a page."""
        if not self.used:
            return "no run"
        every = list(self.used.values())
        times, loads = sorted(one["made"] for one in every), sorted(one["load"] for one in every)
        others = sum(one["code"] != self.code for one in every)
        return (f"{len(every)} runs of {sum(one['cpu'] for one in every) / 60:.1f} minutes of CPU in all, made from {times[0]} to {times[-1]} "
                f"at a load of {loads[0]:g} to {loads[-1]:g}" + (f", {others} of them by another build" if others else ""))

    def run_all(self, title, jobs, say=None):
        """Results by key; those that are there are not repeated. A run that fails gives {"failed": sentence}."""
        unique = {job.key(): job for job in jobs}
        results = {key: self.result_of(job) for key, job in unique.items()}
        todo = sorted((job for key, job in unique.items() if results[key] is None), key=lambda j: -j.estimate)
        if self.only_kept:
            return {key: {"missing": True} if result is None else result for key, result in results.items()}
        if todo:
            say = say or (lambda text: print(text, file=sys.stderr, flush=True))
            say(f"{title}: {len(todo)} runs, {len(unique) - len(todo)} are there already, {self.at_once} at a time")
        began, total, finished, used = time.monotonic(), sum(j.estimate for j in todo), 0.0, 0.0
        with concurrent.futures.ThreadPoolExecutor(self.at_once) as pool:
            futures = {pool.submit(self._run, job): job for job in todo}
            for number, future in enumerate(concurrent.futures.as_completed(futures), 1):
                job = futures[future]
                result = results[job.key()] = future.result()
                finished += job.estimate
                used += result.get("cpu", 0.0)
                spent = time.monotonic() - began
                left = spent * (total - finished) / finished
                verdict = f"FAILED: {result['failed']}" if "failed" in result else f"{result.get('cpu', 0):.1f} s of CPU"
                say(f"  [{number}/{len(todo)}] {spent:.0f} s, about {left:.0f} s left, {used:.0f} s of CPU | {job.name}: {verdict}")
        self.cpu += used
        return results
