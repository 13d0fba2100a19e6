# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line that all studies share, and how they end."""
import argparse
import importlib
import os
import pathlib
import re
import sys

from . import runs
from .programs import BUILD, RESULTS, Failure, need, version

KEPT = "Finished runs are kept: the same command goes on where it stopped."
# Options that choose what is run and shown, or how: a run's result does not depend on them.
NO_INPUTS = ("--help", "--out", "--jobs", "--any-build", "--show", "--plan", "--again")


class Words(argparse.Action):
    """One or more words of a list: separate, or in one with blanks or commas between them."""

    def __init__(self, *words, choices=None, **keywords):
        self.known = choices
        if choices and "metavar" not in keywords:
            keywords["metavar"] = "{" + ",".join(str(choice) for choice in choices) + "}"
        super().__init__(*words, nargs="+", **keywords)

    def __call__(self, parser, namespace, values, option=None):
        found = [word for value in values for word in re.split(r"[\s,]+", value) if word]
        for word in found:
            if self.known and word not in self.known:
                parser.error(f"argument {option}: invalid choice: {word!r} (choose from {', '.join(map(repr, self.known))})")
        setattr(namespace, self.dest, found)


def at_least_one(text):
    """A whole number from 1 on."""
    if not re.fullmatch(r"[1-9][0-9]*", text):
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number of at least 1")
    return int(text)


class Parser(argparse.ArgumentParser):
    """`name`: of the script; `quick`: what --quick does (empty: no such option); `at_once`: runs at a time (None: the user's --jobs)."""

    def __init__(self, name, description, quick="", at_once=None, epilog="", sizes=("quick",)):
        super().__init__(prog=name, description=description, epilog=f"{epilog} {KEPT}".strip(), allow_abbrev=False)
        self.name, self.at_once, self.sizes = name, at_once, sizes
        if quick:
            self.add_argument("--quick", nargs="?", const="yes", default="no", choices=("yes", "no"), help=quick)

    def settle(self, programs, check=lambda chosen: None):
        """Parses and completes: folders as absolute paths, the store of runs; Failure where the build lacks one of `programs`. `check` says
        by self.error what is wrong with the script's own options, before anything is written."""
        if self.at_once is None:
            self.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at a time (default: the number of cores)")
        self.add_argument("--build", type=pathlib.Path, default=BUILD, metavar="DIR", help="build folder (default: build; of an installation: its prefix)")
        self.add_argument("--out", "--output", type=pathlib.Path, metavar="DIR",
                          help=f"tables, charts and runs (default: results/{self.name}{''.join(f'[-{size}]' for size in self.sizes)}, and results/runs)")
        self.add_argument("--again", action="store_true", help="repeat runs that are there")
        self.add_argument("--any-build", action="store_true", help="take finished runs of other builds, too (default: repeat them)")
        self.add_argument("--show", action="store_true", help="run nothing: tables and charts of the runs that are there")
        self.add_argument("--plan", action="store_true", help="name the runs of this call with their keys, which are there and which are not; "
                          "run nothing but what others need to be planned")
        chosen = self.parse_args()
        jobs = self.at_once or chosen.jobs
        if jobs < 1:
            self.error(f"--jobs is {jobs}: give 1 or more")
        if hasattr(chosen, "quick"):
            chosen.quick = chosen.quick in (True, "yes")
        chosen.build = chosen.build.resolve()
        need(chosen.build, *(program if "/" in program else f"bin/{program}" for program in (programs(chosen) if callable(programs) else programs)))
        check(chosen)
        size = next((f"-{size}" for size in self.sizes if getattr(chosen, size, False)), "")
        results = chosen.out.resolve() if chosen.out else RESULTS
        chosen.out = results if chosen.out else results / f"{self.name}{size}"
        chosen.out.mkdir(parents=True, exist_ok=True)
        # All studies and sizes share the runs, unless the user has named a folder for this one.
        chosen.store = runs.Store(results / "runs", jobs, chosen.build, chosen.any_build, chosen.show, chosen.plan, chosen.again)
        return chosen


def start(script):
    """Runs the module of study.commands that a script is named as; whatever goes wrong is said in one sentence."""
    try:
        if sys.argv[1:2] == ["--version"]:
            print(script, version())
            sys.exit(0)
        status = importlib.import_module(f"study.commands.{script.replace('-', '_')}").main()
        sys.stdout.flush()
    except Failure as failure:
        sys.exit(f"{script}: error: {failure}")
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        status = 1
    except OSError as error:
        sys.exit(f"{script}: error: {error.filename or 'output'}: {error.strerror}; name a folder that can be written with --out")
    except KeyboardInterrupt:
        status = 130
    sys.exit(status)
