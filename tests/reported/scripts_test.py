# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What went wrong with the scripts: kept results of other inputs, numbers with a comma, a traceback where nothing can be written."""
import concurrent.futures
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("ECCENTRA_BUILD", ROOT / "build"))
sys.path.insert(0, str(ROOT / "scripts"))
from study import options  # noqa: E402

# Of each study: a short call, another value of each of its own options, and the options that do not change what any run computes.
STUDIES = {
    "accuracy-cost": (["--bodies", "cube", "--levels", "S1", "--scenes", "heap", "--seeds", "1", "--parts", "levels"], {
        "--bodies": ["disk"], "--levels": ["C8"], "--scenes": ["drum"], "--seeds": ["2"], "--parts": ["levels", "methods"], "--quick": [],
        "--full": [], "--retime": [], "--inclinations": ["0"], "--velocities": ["0.58"], "--rounding": ["0.3"], "--shape": ["disk"],
        "--scene": ["OTHER_SCENE"], "--measure": ["KinEng"], "--share": ["0"]}, ("--within", "--most-seeds")),  # of which runs are added after the pilot
    "calibrate-rolling": (["--shape", "cube", "--scene", "drum", "--others", "heap", "--seeds", "2"], {
        "--shape": ["disk"], "--rounding": ["0.3"], "--scene": ["heap"], "--seeds": ["3"], "--range": ["0.1", "0.5"], "--vary": ["mu_s"],
        "--mu-shape": ["0.1"]}, ("--others", "--mine", "--measure", "--share")),  # of runs that a plan cannot name before the fit
    "paper": (["--figures", "10", "--velocities", "1.165"], {
        "--figures": ["7"], "--velocities": ["0.58"], "--rungs": ["0.3"], "--turbulence": ["kEpsilon"], "--quick": [],
        "--full": [], "--seeds": ["2"], "--length": ["0.16"]}, ("--measured", "--refine")),  # what lies between is known after the rungs
    "full-scene": (["--levels", "S1", "--fillings", "0.5"], {
        "--levels": ["S1", "C8"], "--fillings": ["0.1"], "--ranks": ["1"], "--quick": [], "--run": ["S1"], "--accuracy": [], "--angle": ["40"],
        "--velocity": ["0.72"], "--rpm": ["0"], "--end": ["30"], "--length": ["6"], "--fluid-step": ["0.01"], "--tolerances": ["tight"],
        "--interval": ["200"], "--safety": ["2"]}, ()),
    "compare-rolling": (["--scenes", "slope", "section", "--models", "cluster", "cdt", "--seeds", "1"], {
        "--scenes": ["drum"], "--models": ["off"], "--seeds": ["2"], "--quick": [], "--mu": ["0.5"], "--shape": ["cube 8"], "--cost": [], "--cohesion": []},
        ()),
    "effects": ([], {"--scenes": [], "--annulus": [], "--off": [], "--rheology": ["newtonian 0.1"], "--gradient": ["6"], "--steps": ["2000"],
                     "--quick": []}, ()),
    "closure-cost": ([], {"--repetitions": ["2"], "--quick": []}, ("--csv", "--coupled")),
    "rheology-accuracy": ([], {"--cells": ["20"], "--ratios": ["10"], "--steps": ["30"], "--quick": []}, ()),
    "creeping-drag": (["--indices", "1", "--bingham", "1", "--aspects", "1"], {
        "--indices": ["0.6"], "--bingham": ["10"], "--aspects": ["2"], "--checks": ["no"], "--quick": []}, ()),
    "oriented-section": (["--shapes", "disk:7", "--inclinations", "80", "--seeds", "1", "--count", "50"], {
        "--shapes": ["cube:8"], "--inclinations": ["0"], "--seeds": ["2"], "--count": ["60"], "--forces": ["sphere"], "--tau0": ["1"],
        "--yield-forms": ["cross"], "--quick": []}, ()),
    "drag-against-measurement": (["--data", "POINTS"], {"--data": ["OTHER_POINTS"], "--laws": ["chien"], "--falling": []}, ()),
    "rounding": (["--scenes", "heap", "--bodies", "cube", "--seeds", "1"], {
        "--scenes": ["drum"], "--bodies": ["disk"], "--seeds": ["2"], "--quick": []}, ()),
    "solver-cost": ([], {"--cells": ["4 24 10"], "--length": ["0.2"], "--steps": ["3"], "--turns": ["1"], "--pressure": ["pcg"],
                         "--viscosity": ["strainRate"], "--turbulence": ["kEpsilon"], "--quick": []}, ()),
    "link-cost": ([], {"--parts": ["ranks"], "--turns": ["2"], "--quick": []}, ()),
    "cluster-speed": (["--scenes", "settled", "--shapes", "cube:8", "--repeat", "1"], {
        "--scenes": ["drum"], "--shapes": ["cube:27"], "--rounded": ["disk:0.3"], "--bodies": ["70"], "--repeat": ["2"], "--portable": ["OTHER"],
        "--ranks": ["2"], "--quick": []}, ()),
    "compare-peers": (["--codes", "ours", "stock", "--shapes", "cube 8"], {
        "--codes": ["ours", "stock", "yade"], "--shapes": ["cube 27"], "--scenes": ["drop"], "--bodies": ["20"], "--repeat": ["1"], "--quick": []},
        ("--install",)),
    "demo": (["--skip-setup"], {"--scenes": ["cubes"], "--quick": []}, ("--skip-setup",)),
}
BENCHMARKS = ("closures_benchmark", "openfoam_coupled_cost", "exchange_benchmark", "link_benchmark")
ANNULUS = ["--bodies", "cube", "--levels", "S1", "--scenes", "section", "--seeds", "1", "--parts", "levels"]
# Where an option has something to choose from only in another call than the short one.
STARTS = {("accuracy-cost", option): ANNULUS for option in ("--inclinations", "--velocities", "--quick")}
OF_A_SHAPE = ["--shape", "cube", "--levels", "sphere", "--scene", "OWN_SCENE", "--measure", "v_height", "--seeds", "1"]
STARTS |= {("accuracy-cost", option): OF_A_SHAPE for option in ("--shape", "--scene", "--measure", "--share")}
STARTS["calibrate-rolling", "--mu-shape"] = [*STUDIES["calibrate-rolling"][0], "--vary", "mu_s"]
STARTS["full-scene", "--quick"] = ["--levels", "S1"]
STARTS |= {("full-scene", option): ["--run", "S1"]
           for option in ("--angle", "--velocity", "--rpm", "--end", "--length", "--fluid-step", "--tolerances", "--interval", "--safety")}
STARTS["rounding", "--quick"] = []
STARTS["compare-rolling", "--cohesion"] = ["--scenes", "heap", "--seeds", "1"]
STARTS["oriented-section", "--yield-forms"] = [*STUDIES["oriented-section"][0], "--tau0", "1"]
STARTS["paper", "--quick"] = ["--figures", "7"]


def run(script, *words, root=ROOT, build=BUILD, **environment):
    return subprocess.run([root / "scripts" / script, "--build", build, *words], capture_output=True, text=True, env=os.environ | environment,
                          stdin=subprocess.DEVNULL, check=False)


def own_options(script):
    """All options that --help names."""
    said = subprocess.run([ROOT / "scripts" / script, "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"(?<![\w'-])--[a-z][a-z0-9-]*", said[said.index("options:"):])) - {"--output", "--build"} - set(options.NO_INPUTS)


def replaced(base, option, value):
    """A call with another value of an option."""
    words = list(base)
    if option in words:
        at = words.index(option)
        end = next((k for k in range(at + 1, len(words)) if words[k].startswith("--")), len(words))
        del words[at:end]
    return [*words, option, *value]


class Reported(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.files = {"OTHER": str(self.folder / "other")}
        scene = (ROOT / "cases" / "own-scene" / "in.collapse").read_text()
        for name, text in (("OWN_SCENE", scene), ("OTHER_SCENE", scene + "# another line\n")):
            self.files[name] = str(self.folder / name)
            (self.folder / name).write_text(text)
        for name, drag in (("POINTS", 30.0), ("OTHER_POINTS", 31.0)):
            self.files[name] = str(self.folder / name)
            (self.folder / name).write_text(f"sphericity,Re,Cd,source,flag,shape,crosswise\n1,1,{drag},nobody,0,sphere in air,\n")

    def fake_build(self, name):
        """A build with our programs, and with files in place of benchmarks that are not built for the tests."""
        build = self.folder / name
        (build / "tests").mkdir(parents=True)
        for part in ("bin", "lib"):
            (build / part).mkdir()
            for file in (BUILD / part).iterdir():
                (build / part / file.name).symlink_to(file)
        for benchmark in BENCHMARKS:
            (build / "tests" / benchmark).write_text(name)
        return build

    def keys(self, script, words, **where):
        said = run(script, *(self.files.get(word, word) for word in words), "--plan", "--out", self.folder / "out", **where)
        self.assertEqual(said.returncode, 0, f"{script} {words}: {said.stderr}")
        found = set(re.findall(r"^([0-9a-f]{16}\.[0-9a-f]{16})  (?:there|to run)", said.stdout, re.M))
        self.assertTrue(found, f"{script} {words}: {said.stdout}{said.stderr}")
        return found

    def test_caches_of_studies(self):
        build, other = self.fake_build("one"), self.fake_build("other")
        (other / "lib" / "libmore.so").write_text("more")
        calls = {}
        for script, (base, changed, _) in STUDIES.items():
            calls[script, None, "build"] = (base, other)
            calls[script, None, "before"] = (base, build)
            for option, value in changed.items():
                start = STARTS.get((script, option), base)
                calls[script, option, "before"] = (start, build)
                calls[script, option, "after"] = (replaced(start, option, value), build)
        different = {(script, tuple(words), where): None for (script, *_), (words, where) in calls.items()}
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for call, keys in zip(different, pool.map(lambda call: self.keys(call[0], call[1], build=call[2]), different)):
                different[call] = keys
        keys_of = lambda *call: different[call[0], tuple(calls[call][0]), calls[call][1]]
        for script, (_, changed, kept) in STUDIES.items():
            with self.subTest(script):
                self.assertEqual(own_options(script), set(changed) | set(kept), "an option that this test does not know")
                self.assertFalse(keys_of(script, None, "before") & keys_of(script, None, "build"), "the same key with another build")
                for option in changed:
                    self.assertNotEqual(keys_of(script, option, "before"), keys_of(script, option, "after"), option)

    def test_caches_know_their_files(self):
        """A change in a scene, or in what measures, gives another key. Part of the row above."""
        copy = self.folder / "copy"
        for part in ("scripts", "cases", "tests/exchange", "tests/stability"):
            shutil.copytree(ROOT / part, copy / part, symlinks=True)
        shutil.copy(ROOT / "CMakeLists.txt", copy)  # what tells a source tree from an installation
        build = self.fake_build("one")
        for script, file, words in (
                ("cluster-speed", "scripts/study/scenes/speed.in", ["--scenes", "settled", "--repeat", "1"]),
                ("compare-peers", "scripts/study/scenes/peers.in", ["--codes", "ours"]),
                ("compare-peers", "scripts/study/scenes/peers.lammps", ["--codes", "lammps-hertz"]),
                ("compare-peers", "scripts/study/scenes/peers-dpm/constant/kinematicCloudProperties", ["--codes", "ours", "--scenes", "coupled"]),
                ("compare-rolling", "cases/rolling-comparison/bodies.in", ["--scenes", "heap"]),
                ("compare-rolling", "cases/rolling-comparison/in.section", ["--scenes", "section"]),
                ("compare-rolling", "cases/tomren-section/0/U", ["--scenes", "section"]),
                ("compare-rolling", "scripts/study/frames.py", ["--scenes", "heap"]),
                ("effects", "cases/effects/in.sheared_suspension", []),
                ("effects", "cases/effects/in.scene", ["--scenes"]),
                ("effects", "scripts/study/scenes/off.in", ["--off"]),
                ("rheology-accuracy", "scripts/study/scenes/channel/constant/flowProperties", []),
                ("creeping-drag", "scripts/study/scenes/creeping-drag/system/fvSolution", ["--quick"]),
                ("creeping-drag", "scripts/study/wedge.py", ["--quick"]),
                ("drag-against-measurement", "scripts/study/drag_points.py", ["--data", "POINTS"]),
                ("solver-cost", "scripts/study/scenes/solver-cost/system/fvSolution", []),
                ("demo", "cases/run-coupled", ["--skip-setup"]),
                ("hard-cases", "tests/stability/harness/checks.py", ["--only", "contact/slope10"]),
                ("hard-cases", "tests/stability/cases/rheology/system/fvSchemes", ["--only", "rheology/fast"])):
            with self.subTest(f"{script}: {file}"):
                before = self.keys(script, words, root=copy, build=build)
                with open(copy / file, "a") as out:
                    out.write("\n# another line\n")
                self.assertNotEqual(before, self.keys(script, words, root=copy, build=build))

    def test_second_call_of_compare_rolling(self):
        def called(*words):
            said = run("compare-rolling", "--quick", "--scenes", "plane", "--models", "cluster", "shape-limited", "--seeds", "1", "--jobs", "1",
                       "--out", self.folder, *words)
            self.assertEqual(said.returncode, 0, said.stderr)
            with open(self.folder / "comparison.csv", newline="") as rows:
                return [float(row["mean"]) for row in csv.DictReader(rows)], said.stderr
        cube, _ = called()
        disk, _ = called("--shape", "disk 7")
        rough, _ = called("--mu", "0.1")
        again, said = called()
        self.assertNotEqual(cube[0], disk[0])
        self.assertNotEqual(cube[1], rough[1])
        self.assertEqual(cube[0], rough[0])  # clusters have no such coefficient
        self.assertEqual(cube, again)
        self.assertNotIn(" s of CPU |", said)  # nothing is repeated

    def test_comma_locale(self):
        if not shutil.which("localedef") or not pathlib.Path("/usr/share/i18n/locales/de_DE").is_file():
            print("localedef or the locales' sources are missing: install Debian's package locales")
            sys.exit(77)
        locales = self.folder / "locales"
        locales.mkdir()
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", locales / "de_DE.UTF-8"], capture_output=True, check=False)
        comma = {"LOCPATH": str(locales), "LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"}
        said = subprocess.run(["printf", "%.1f", "1,5"], capture_output=True, text=True, env=os.environ | comma, check=True).stdout
        self.assertEqual(said, "1,5", "the locale is not there")
        started = "from study import programs; print(programs.output_of(['printf', '%.1f', '2.5']))"  # a comma is what printf would want
        said = subprocess.run(["/usr/bin/python3", "-Bc", started], capture_output=True, text=True, cwd=ROOT / "scripts", env=os.environ | comma, check=False)
        self.assertEqual(said.stdout, "2.5\n", said.stderr)
        # Results that need a fraction.
        results = {}
        for name, environment in (("point", {"LC_ALL": "C"}), ("comma", comma)):
            out = self.folder / name
            for script, words, table in (
                    ("rheology-accuracy", ["--ratios", "3.6", "36.5", "--steps", "20", "--cells", "12"], "accuracy.csv"),
                    ("effects", ["--quick", "--gradient", "2.5"], "effects.csv"),
                    ("compare-rolling", ["--quick", "--scenes", "slope", "--models", "shape-limited", "--mu", "0.25", "--seeds", "1"],
                     "comparison.csv")):
                done = run(script, *words, "--out", out, **environment)
                self.assertEqual(done.returncode, 0, done.stderr)
                with open(out / table, newline="") as rows:
                    table = [{k: v for k, v in row.items() if not k.startswith(("ns_", "seconds", "share_of_time", "cpu"))}
                             for row in csv.DictReader(rows)]
                results[name, script] = table
        for (name, script), table in results.items():
            self.assertEqual(table, results["point", script], name)

    def test_read_only_checkout(self):
        """One sentence where nothing can be written: of each script, and of a checkout whose owner is somebody else."""
        file = self.folder / "file"
        file.write_text("")
        build = self.fake_build("one")
        for script in [*STUDIES, "hard-cases"]:
            with self.subTest(script):
                words = {"demo": ["--skip-setup"], "compare-peers": ["--codes", "ours"],
                         "drag-against-measurement": ["--data", self.files["POINTS"]]}.get(script, [])
                said = run(script, *words, "--out", file / "results", build=build)
                self.assertNotEqual(said.returncode, 0)
                self.assertRegex(said.stderr, rf"^{script}: error: .*; name a folder that can be written with --out\n$")
        copy = self.folder / "checkout"
        for part in ("scripts", "tests/stability", "cases"):
            shutil.copytree(ROOT / part, copy / part, symlinks=True)
        (self.folder).chmod(0o755)
        subprocess.run(["chmod", "-R", "a+rX,a-w", copy], check=True)
        user = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        for words in ([copy / "scripts" / "hard-cases", "--only", "contact/slope10", "--build", build], [copy / "scripts" / "setup"]):
            said = subprocess.run(words, capture_output=True, text=True, check=False, **user)
            with self.subTest(words[0].name):
                self.assertNotEqual(said.returncode, 0)
                self.assertEqual(said.stderr.count("\n"), 1, said.stderr)
                self.assertRegex(said.stderr, rf"^{words[0].name}: error: .*(written|writable)")


if __name__ == "__main__":
    unittest.main()
