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
import sys
import time
import typing

from .programs import Failure, RunFailed, code_of, digest_of, stop_with_the_user

MEASURING = ("frames", "measures", "screen", "timing")  # modules that turn what a run wrote into its result


@dataclasses.dataclass
class Job:
    """One run: `inputs` (JSON) say all that its result depends on beside the build and the code that measures, `work(folder)` runs it in
    its folder and returns the result (JSON); `estimate`: CPU seconds that it may take, for the time left; `first`: others need it; `tell`: what is
    said of a result; `keep`: whether a result counts the next time."""
    name: str
    inputs: dict
    work: typing.Callable[[pathlib.Path], dict]
    estimate: float = 5.0
    first: bool = False
    tell: typing.Callable[[dict], str] = lambda result: f"{result.get('cpu', 0):.1f} s of CPU"
    keep: typing.Callable[[dict], bool] = lambda result: True

    def key(self):
        return hashlib.sha256(json.dumps([self.inputs, measured_by(self.work)], sort_keys=True).encode()).hexdigest()[:16]


def measured_by(work):
    """Digest of the module of a job's work and of those that measure for it."""
    module = sys.modules[work.__module__]
    used = {value.__name__ for value in vars(module).values() if getattr(value, "__name__", "").startswith("study.")}
    chosen = [name for name in MEASURING if f"study.{name}" in used]
    return digest_of(pathlib.Path(module.__file__), *(pathlib.Path(__file__).with_name(f"{name}.py") for name in chosen))


def good(result):
    """Neither failed nor, where only kept results are shown, not run yet."""
    return "failed" not in result and "missing" not in result


def needed(results, jobs):
    """Results of jobs {name: Job} that a script cannot do without."""
    for job in jobs.values():
        result = results[job.key()]
        if not good(result):
            raise Failure(f"{job.name}: {result.get('failed', 'not run yet: leave out --show')}")
    return {name: results[job.key()] for name, job in jobs.items()}


class Store:
    """Results of jobs in FOLDER/KEY/result.json, with the build that made them. `any_build`: those of other builds count, too; `only_kept`:
    nothing is run, what is not there is {"missing": True}; `plan`: the same, and each run is named; `again`: what is there does not count."""

    def __init__(self, folder, at_once, build, any_build=False, only_kept=False, plan=False, again=False):
        self.folder, self.at_once = pathlib.Path(folder), at_once
        self.code, self.any_build, self.only_kept, self.plan, self.again = code_of(build), any_build, only_kept, plan, again
        self.used = {}  # key: what its file says besides the result
        self.made = set()  # keys of this call's own runs
        stop_with_the_user()

    def folder_of(self, job):
        return self.folder / job.key()

    def result_of(self, job):
        """The kept result, or None."""
        file = self.folder_of(job) / "result.json"
        if not file.is_file() or (self.again and job.key() not in self.made):
            return None
        kept = json.loads(file.read_text())
        if kept.get("code") != self.code and not self.any_build or not job.keep(kept["result"]) and job.key() not in self.made:
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
        (folder / "result.json").unlink(missing_ok=True)  # its files are about to change
        try:
            result = job.work(folder)
        except RunFailed as failure:
            return {"failed": str(failure)}
        about = {"code": self.code, "made": datetime.datetime.now().isoformat(" ", "minutes"), "load": round(os.getloadavg()[0], 1)}
        part = folder / "result.part"
        part.write_text(json.dumps({"name": job.name, **about, "inputs": job.inputs, "result": result}, indent=1))
        part.replace(folder / "result.json")
        self.used[job.key()] = about | {"cpu": result.get("cpu", 0.0)}
        self.made.add(job.key())
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
        if self.plan:
            for key, job in unique.items():
                print(f"{key}.{self.code}  {'there  ' if results[key] is not None else 'to run '} {title}: {job.name}", flush=True)
        todo = sorted((job for key, job in unique.items() if results[key] is None and (job.first or not self.plan)), key=lambda j: -j.estimate)
        if self.only_kept:
            todo = []
        if todo:
            say = say or (lambda text: print(text, file=sys.stderr, flush=True))
            say(f"{title}: {len(todo)} runs, {len(unique) - len(todo)} are there already, {self.at_once} at a time"
                + f", about {sum(j.estimate for j in todo) / self.at_once:.0f} s on an idle machine")
        began, total, finished, used = time.monotonic(), sum(j.estimate for j in todo), 0.0, 0.0
        with concurrent.futures.ThreadPoolExecutor(self.at_once) as pool:
            futures = {pool.submit(self._run, job): job for job in todo}
            try:
                for number, future in enumerate(concurrent.futures.as_completed(futures), 1):
                    job = futures[future]
                    result = results[job.key()] = future.result()
                    finished += job.estimate
                    used += result.get("cpu", 0.0)
                    spent = time.monotonic() - began
                    left = spent * (total - finished) / finished
                    verdict = f"FAILED: {result['failed']}" if "failed" in result else job.tell(result)
                    say(f"  [{number}/{len(todo)}] {spent:.0f} s, about {left:.0f} s left, {used:.0f} s of CPU | {job.name}: {verdict}")
            except BaseException:  # out of disk, say: what has not begun does not begin
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        return {key: {"missing": True} if result is None else result for key, result in results.items()}
