#!/usr/bin/python3
# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Grammar fuzzing of every reader of text: sentences of a grammar, with a few changes, must be accepted or end with one sentence, soon."""
import argparse
import concurrent.futures
import os
import pathlib
import re
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
try:
    import hypothesis
    import lark
    import zmq  # noqa: F401
    from hypothesis import strategies as st
    from hypothesis.extra.lark import from_lark
except ImportError as error:
    sys.exit(f"reader_fuzz: error: there is no Python package '{error.name}': run scripts/setup, and this with /usr/bin/python3")

import false_solver  # noqa: E402
import mutations  # noqa: E402
import programs  # noqa: E402
import scenes  # noqa: E402


class Grammar:
    def __init__(self, name):
        self.text = (HERE / "grammars" / f"{name}.lark").read_text()
        self.words = sorted(set(re.findall(r'"([^"\\]+)"', self.text)) | set(" ".join(re.findall(r'"([^"\\]+)"', self.text)).split()))

    def sentences(self, rule):
        """Sentences that start at a rule, changed."""
        return mutations.mutated(from_lark(lark.Lark(self.text, start=rule), start=rule), self.words)


def any_stl():
    facet = st.one_of(st.sampled_from(scenes.FACETS), st.lists(st.tuples(*[st.floats(width=32)] * 3), min_size=3, max_size=3))
    facets = st.one_of(st.just(scenes.FACETS), st.lists(facet, max_size=6))
    count = st.one_of(st.none(), st.none(), st.sampled_from([0, 1, 5, 2**31, 2**32 - 1]))
    whole = st.builds(scenes.binary_stl, facets, count)
    return st.one_of(Grammar("stl").sentences("stl"), whole, st.builds(lambda data, keep: data[: keep * len(data) // 100], whole, st.integers(0, 100)))


class Reader:
    """inputs: a strategy; attempt(input) raises programs.Broken; good: an input that must be accepted, or none."""

    def __init__(self, inputs, attempt, good=None):
        self.inputs, self.attempt, self.good = inputs, attempt, good


def readers(ours, source):
    """All readers that are built, by name."""
    found = {}
    beside = {"good.clump": scenes.GOOD_CLUMP, "good.stl": scenes.GOOD_STL}
    liggghts = Grammar("liggghts")
    dem = ["eccentra-dem", "-in", "in.script", "-log", "none"]

    def script(lines, name):
        return Reader(liggghts.sentences(name), lambda text: ours.run(dem, {**beside, "in.script": scenes.script(lines, name, text)}), lines[name])

    for rule in ("template", "pair", "wall", "force", "flow", "limit", "balance", "move", "dump"):
        found[f"script_{rule}"] = script(scenes.CLUSTERS, rule)
    found["script_rolling"] = script(scenes.SPHERES, "rolling")
    guest = {"in.script": scenes.script(scenes.GUEST, "run", scenes.GUEST["run"])}
    found["messages"] = Reader(false_solver.answers(), lambda said: ours.run(
        dem, guest, lambda folder, process: false_solver.serve(said, folder, process)))
    found["clump"] = Reader(Grammar("clump").sentences("clump"), lambda text: ours.run(
        ["clusterShape", "file", "a.clump", "--json"], {"a.clump": text}), scenes.GOOD_CLUMP)
    found["stl"] = Reader(any_stl(), lambda data: ours.run(
        ["clusterShape", "stl", "a.stl", "--spheres", "2", "--missing", "0.9", "--resolution", "12", "--json"], {"a.stl": data}), scenes.GOOD_STL)
    if (ours.bin / "annulusReport").exists():
        found["coupling_csv"] = Reader(Grammar("tables").sentences("coupling"), lambda text: ours.run(
            ["annulusReport", "case", "--no-pictures"], {**scenes.REPORTED, "case/postProcessing/eccentra/coupling.csv": text}), scenes.GOOD_TABLE)
    if (ours.bin / "annulusFoam").exists():
        foam, case = Grammar("foam"), scenes.section(source)
        mesh = "system/annulusMeshDict"
        found["foam_mesh"] = Reader(foam.sentences("mesh"), lambda text: ours.run(["annulusMesh"], {**case, mesh: text}), case[mesh])
        for rule, name in (("transport", "transportProperties"), ("flow", "flowProperties"), ("coupling", "couplingProperties")):
            path = f"constant/{name}"
            found[f"foam_{rule}"] = Reader(foam.sentences(rule), lambda text, path=path: ours.run(
                ["sh", "-c", "annulusMesh >log.mesh && exec annulusFoam"], {**case, path: text}), case[path])
    return found


def fuzz(reader, examples, seconds, seed):
    """Inputs tried, and those that broke the promise once and not again, as on a machine whose load outlasts a timeout; raises
    programs.Broken with the smallest input that breaks it twice."""
    begun, tried, once = time.monotonic(), 0, []

    def attempt(text):
        nonlocal tried
        if time.monotonic() - begun > seconds:
            return
        tried += 1
        try:
            reader.attempt(text)
        except programs.Broken:
            try:
                reader.attempt(text)
            except programs.Broken as broken:
                raise programs.Broken(f"input {text!r}\n{broken}") from None
            once.append(text)

    test = hypothesis.given(reader.inputs)(attempt)
    test = hypothesis.settings(max_examples=examples, deadline=None, database=None, print_blob=False, report_multiple_bugs=False,
                               suppress_health_check=list(hypothesis.HealthCheck))(test)
    hypothesis.seed(seed)(test)()
    return tried, once


def examine(name, words):
    """Whether a reader kept the promise, and a line that says it."""
    ours = programs.Programs(words.build, words.slow)
    reader, begun = readers(ours, HERE.parent.parent.parent)[name], time.monotonic()
    try:
        if reader.good is not None:  # or every change of it would be refused as it should
            reader.attempt(reader.good)
            if not ours.accepted:
                raise programs.Broken(f"the input that works is refused: {reader.good!r}")
        tried, once = fuzz(reader, words.examples, words.seconds, words.seed)
        kept, verdict = True, f"{tried} inputs" + "".join(f"; broke the promise once and not again: {text!r}" for text in once)
    except (programs.Broken, hypothesis.errors.HypothesisException) as error:
        kept, verdict = False, f"BROKEN: {error}"
    return kept, f"{name}: {ours.accepted} accepted, {ours.refused} refused with one sentence, {time.monotonic() - begun:.0f} s: {verdict}"


def main():
    parser = argparse.ArgumentParser(prog="reader_fuzz", description=__doc__)
    parser.add_argument("--build", default="build", type=lambda name: pathlib.Path(name).resolve(), metavar="DIR")
    parser.add_argument("--only", default="", metavar="REGEX", help="readers whose name matches")
    parser.add_argument("--examples", type=int, default=40, metavar="N", help="inputs for each reader (default 40)")
    parser.add_argument("--seconds", type=float, default=1e9, metavar="S", help="stop with a reader after this time, its shrinking too")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="another seed, other inputs")
    parser.add_argument("--slow", type=float, default=1, metavar="FACTOR", help="how much slower the programs are (sanitizers: 6)")
    parser.add_argument("--jobs", type=int, default=4, metavar="N", help="readers that are tried at the same time")
    parser.add_argument("--list", action="store_true")
    words = parser.parse_args()
    os.chdir(tempfile.gettempdir())  # hypothesis leaves a folder where it runs
    ours = programs.Programs(words.build, words.slow)
    if not (ours.bin / "eccentra-dem").exists():
        parser.error(f"there are no programs in {ours.bin}: build them first")
    chosen = {name: reader for name, reader in readers(ours, HERE.parent.parent.parent).items() if re.search(words.only, name)}
    if words.list or not chosen:
        print("\n".join(chosen) or f"no reader matches '{words.only}'")
        return 0 if chosen else 2
    # Most of a start of LIGGGHTS is waiting for MPI: several at a time.
    with concurrent.futures.ProcessPoolExecutor(words.jobs) as pool:
        kept = [pool.submit(examine, name, words) for name in chosen]
        for promise in concurrent.futures.as_completed(kept):
            print(promise.result()[1], flush=True)
    return 0 if all(promise.result()[0] for promise in kept) else 1


sys.exit(main())
