# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the hard cases of tests/stability/cases and judges each by its criteria; exit status 1 if one is not as it must be."""
import functools
import pathlib
import re
import sys

from .. import options, runs
from ..programs import ROOT, Failure, digest_of

sys.path.insert(0, str(ROOT / "tests" / "stability"))
from harness import case as case_files  # noqa: E402
from harness import page, runner  # noqa: E402

HARNESS = ROOT / "tests" / "stability" / "harness"
DESCRIPTION = """Runs every hard case, and each family of cases once in the configuration that is known to fail (names that end in /fails), which
must be seen failing. Of each: verdict, seconds, name, what was measured. Cases that passed are not repeated until they, the programs that they run
or the harness change. Results: results/hard-cases/report.md."""
digest = functools.cache(lambda *paths: digest_of(*paths))


def job_of(case, program):
    """A case; its key changes with its texts and criteria, the harness, the programs that it runs and our libraries."""
    ours = {program, *(program.parent / word for one in case.runs for line in one.commands for word in line)}
    libraries = program.parent.parent / "lib"
    ours.update(libraries.glob("*.so") if any(line[0] != program.name for one in case.runs for line in one.commands)
                else [libraries / "libeccentra.so"])
    judged = [[check.what, check.measure.__name__, check.fixed, check.relation, case_files.call(check.limit, case.values)] for check in case.checks]
    inputs = {"what": "hard case", "id": case.id, "says": case.says, "checks": judged,
              "runs": [[one.files, [" ".join(line).replace(str(program.parent.parent), "") for line in one.commands], one.ranks] for one in case.runs],
              "programs": digest(*sorted(path for path in ours if path.is_file())), "harness": digest(*sorted(HARNESS.glob("*.py")))}

    def work(folder):
        return runner.run(case, program, folder).as_dict()

    def tell(result):
        return (f"{result['verdict']} {result['seconds']:.1f} s\n    {result['what']}\n    criterion: {result['criterion']}\n"
                f"    measured:  {result['measured']}")

    return runs.Job(case.id, inputs, work, case.seconds, tell=tell, keep=lambda result: result["verdict"] == "pass")


def main():
    parser = options.Parser("hard-cases", DESCRIPTION, "the selection that the tests run, about a minute", sizes=())
    parser.add_argument("--list", action="store_true", help="names of the cases, and nothing else")
    parser.add_argument("--only", metavar="REGEX", help="cases whose name matches, for example 'drag/|long'")
    parser.add_argument("--full", action="store_true", help="the long versions: 1e6 steps of rotation, 1e7 steps at rest")

    def check(chosen):
        try:
            wanted = re.compile(chosen.only or "")
            chosen.groups = case_files.read_all(chosen.build.resolve(), chosen.full)
        except (case_files.CaseFileError, re.error) as error:
            raise Failure(str(error)) from error
        chosen.cases = [case for group in chosen.groups for case in group.cases if wanted.search(case.id) and (case.quick or not chosen.quick)]
        if not chosen.cases:
            raise Failure(f"no case matches '{chosen.only}': see scripts/hard-cases --list")
        if chosen.list:
            print("\n".join(case.id for case in chosen.cases))
            sys.exit(0)

    chosen = parser.settle(lambda c: () if c.list else ("eccentra-dem",), check)
    chosen.store.any_build = True  # the key of a case knows the programs that it runs
    jobs = {case.id: job_of(case, pathlib.Path(chosen.build) / "bin" / "eccentra-dem") for group in chosen.groups for case in group.cases}
    names = [case.id for case in chosen.cases]
    found = chosen.store.run_all("hard cases", [jobs[name] for name in names])
    if chosen.plan:
        return 0
    results = {name: result for name, job in jobs.items() if (result := found.get(job.key()) or chosen.store.result_of(job)) and runs.good(result)}
    page.write(chosen.out, chosen.groups, results)
    good = [name for name in names if results.get(name, {}).get("verdict") == "pass"]
    print(f"{len(good)} of {len(names)} as they must be; written: {chosen.out / 'report.md'}")
    for name in names:
        if name not in good:
            print(f"{'FAIL' if name in results else 'not run'} {name}: {chosen.store.folder_of(jobs[name])}")
    return 0 if len(good) == len(names) else 1
