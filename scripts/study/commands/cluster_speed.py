# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times clusters (one body, one atom) against stock fix multisphere, and rounded bodies against clusters, in the same scenes, in turn, with the
same binary."""
import dataclasses
import functools
import pathlib
import re
import shutil
import statistics

from .. import options, programs, runs, tables
from ..programs import SCENES, digest_of, run

SCRIPT = SCENES / "speed.in"
SIDE, HOLE = 0.05, 0.0635  # base of the bed and width of the column; the paper's hole [m]
RADIUS = 3.175e-3  # of equal volume
# Falling in several batches, then coming to rest; from the opening of the gate to the phase that is timed as flowing [steps of 50 us].
FILLING, RESTING, BATCH, OPENING = 7300, 6000, 1200, 1600
SHORT_STEP = 2e-5  # of what is timed [s]
BARS = {"settled": {"cube:8": 3, "cube:27": 7, "disk:48": 10, "cube:64": 14}, "drum": {"cube:8": 3, "cube:27": 7, "disk:48": 12, "cube:64": 16},
        "collapsing": {"cube:8": 5, "cube:27": 13, "disk:48": 18, "cube:64": 30}}
BARS["flowing"] = BARS["collapsing"]
# Rounded bodies: the cluster beside which each family is timed, its words but for the rounding, and the time over that of the cluster.
PARTNERS = {"cube": 27, "disk": 48}
ROUNDED = {"cube": "smooth cube", "disk": "smooth disk aspect 0.3092"}
ROUNDED_BAR = 1.0
COLUMN = ("collapsing", "flowing")
GEOMETRY = {
    "settled": {},
    "drum": {"drum": 1, "boundary": "f f p", "box": f"-0.07 0.07 -0.07 0.07 0 {SIDE}", "fill": f"cylinder z 0 0 0.0634 0 {SIDE}",
             "fall": "0 -0.5 0", "down": "0 -1 0"},
    "collapsing": {"column": 1, "boundary": "f p f", "box": f"-0.001 0.26 0 {SIDE} -0.01 0.40", "fill": f"block 0 0.0499 0 {SIDE} 0 0.39"},
}
GEOMETRY["flowing"] = GEOMETRY["collapsing"]


@dataclasses.dataclass(frozen=True)
class Bodies:
    """What is timed: carrier (sphere: plain spheres; cluster: ours; multisphere: stock), scene, family and number of its spheres, how many.
    With a rounding it is a rounded body beside the cluster of that number."""
    carrier: str
    scene: str
    family: str
    count: int
    number: int
    rounding: float = 0

    def name(self):
        kind = f"rounded {self.family} {self.rounding:g}" if self.rounding else f"{self.carrier} {self.family} {self.count}"
        return f"{self.scene}, {kind}, {self.number} bodies"

    def shape(self):
        return f"{ROUNDED[self.family]} rounding {self.rounding:g}" if self.rounding else f"{self.family} {self.count}"

    def long_step(self):
        """At 50 us stock's beds of disks, whose spheres are small and touch many at once, fly apart: 20 us, and as much time."""
        return 2e-5 if self.family == "disk" else 5e-5

    def in_steps(self, steps):
        """As long as so many steps of 50 us."""
        return steps * 5 // 2 if self.family == "disk" else steps

    def timed_steps(self, quick):
        """More where they cost little, or what is measured would be little more than the run's start."""
        steps = 12000 if self.family == "sphere" else self.in_steps(OPENING) if self.scene == "flowing" else \
            4000 if self.scene == "collapsing" else 6000 if self.count <= 27 else 2000  # collapsing: 80 ms, most of the fall
        return steps // 4 if quick else steps

    def words(self):
        """Variables of the scene, without those of a phase."""
        given = {**GEOMETRY[self.scene], "bodies": self.number, "batch": self.in_steps(BATCH), "filling": self.in_steps(FILLING),
                 "resting": self.in_steps(RESTING)}
        if self.scene == "settled" and self.number > 1000:  # more bodies on the same base fall from higher up
            given |= {"box": f"0 {SIDE} 0 {SIDE} -0.01 1.00", "fill": f"block 0 {SIDE} 0 {SIDE} 0 0.99"}
        # Stock's `shear` of a cylinder is an angular velocity [rad/s], whatever its page says, and it gives the wall the speed
        # it would have at a sub-sphere's centre: 50 rpm at the hole's surface, for spheres of equal volume that do not overlap.
        given["turning"] = f"shear x {5.236 * HOLE / (HOLE - RADIUS / self.count ** (1 / 3)):.4f}"
        shape = f"15485863 atom_type 1 density constant 2619 shape {self.shape()} diameter 6.35e-3"
        if self.carrier == "cluster":
            given |= {"wall": "wall/gran/cluster", "body": f"particletemplate/cluster {shape}", "move": "nve/cluster", "turning": "rotate 5.236",
                      "pair": "gran/cluster model hertz tangential history rolling_friction off", "counted": 1}
        if self.carrier == "multisphere":  # stock's best skin for many small spheres is narrow; ours keeps lists of bodies
            given |= {"body": f"particletemplate/multisphere/shape {shape}", "move": "multisphere", "skin": 0.0006}
        return given | {"named": int(self.carrier == "multisphere")}


def restart_job(dem, bodies):
    """The bed at rest, or the column in full flow, from which steps are timed; it stays in the job's folder."""
    before, given = None, {"phase": 0, **bodies.words(), "step": bodies.long_step()}
    if bodies.scene == "flowing":
        before = restart_job(dem, dataclasses.replace(bodies, scene="collapsing"))
        given |= {"phase": 1, "step": SHORT_STEP, "steps": bodies.in_steps(OPENING)}

    def work(folder):
        start = {"start": before.made_in / "end.restart"} if before else {}
        cpu, *_ = run([dem, "-in", SCRIPT, "-log", "none", *programs.variables(**given, **start)], folder, folder / "out.txt")
        return {"cpu": cpu}

    inputs = {"what": "speed, prepared", "scene": digest_of(SCRIPT), **given, **({"from": before.key()} if before else {})}
    job = runs.Job(f"prepare {bodies.name()}", inputs, work, 20)
    job.before, job.made_in = before, pathlib.Path()
    return job


def turn_job(sides, prepared, steps, turn, ranks=None):
    """One run of each side (program, Bodies), one after the other, so that a machine that is slow for a while is slow for all: ms of processor
    time per body and 1000 steps, without the start: the difference of a long and a short run. ranks: seconds of the loop on so many instead."""
    def work(folder):
        costs, logs, spent = [], [], 0.0
        for k, (program, bodies) in enumerate(sides):
            start = folder / f"start{k}.restart"
            shutil.copy(prepared[bodies].made_in / "end.restart", start)
            given = bodies.words() | {"phase": 2, "start": start, "step": bodies.long_step() if bodies.scene == "flowing" else SHORT_STEP}
            line = [*(["mpirun", "--oversubscribe", "-np", ranks[k]] if ranks and ranks[k] > 1 else []), program, "-in", SCRIPT, "-log", "none"]
            times = [0.0] if ranks else []
            for number in ((steps[k],) if ranks else (1, steps[k])):
                took = run([*line, *programs.variables(**given, steps=number)], folder, folder / f"out{k}.txt")
                times.append(took.cpu)
            text = (folder / f"out{k}.txt").read_text(errors="replace")
            # Atoms of stock multisphere are sub-spheres.
            there = int(re.findall(r"^bodies: (\d+)", text, re.M)[-1]) // (bodies.count if bodies.carrier == "multisphere" else 1)
            if there < 0.95 * bodies.number:
                raise programs.RunFailed(f"only {there} of {bodies.number} bodies are there: {bodies.name()}")
            spent += sum(times)
            loop = float(re.findall(r"^Loop time of (\S+)", text, re.M)[-1])
            costs.append(loop if ranks else (times[1] - times[0]) / (steps[k] - 1) / there * 1e6)
            logs.append(parts_of(text) if bodies.carrier == "cluster" else {})
            start.unlink()
        return {"costs": costs, "parts": logs, "cpu": spent}

    inputs = {"what": "speed", "scene": digest_of(SCRIPT), "sides": [[program_key(p), dataclasses.asdict(b)] for p, b in sides], "turn": turn,
              "steps": steps, "prepared": [prepared[b].key() for _, b in sides], "ranks": ranks}
    return runs.Job(f"{' | '.join(dict.fromkeys(b.name() for _, b in sides))}, turn {turn + 1}", inputs, work, 10 * len(sides))


@functools.cache
def program_key(program):
    """A program of another build by its code; stock by its name."""
    path = pathlib.Path(program)
    return programs.code_of(path.parent.parent) if path.parent.name == "bin" and path.name == "eccentra-dem" else path.name


def parts_of(text):
    """Of a run of clusters: contacts per body, and the share of each part of the step [%]."""
    loop, atoms = re.findall(r"^Loop time of (\S+) .* with (\d+) atoms", text, re.M)[-1]
    percent = lambda name: float(re.findall(rf"^{name} +time .*\((\S+)\)", text, re.M)[-1])
    seconds = lambda style: sum(float(s) for s in re.findall(rf"^Fix .*(?:{style}) time \(%\) = (\S+)", text.split("Loop time")[-1], re.M))
    contacts = sum(float(n) for n in re.findall(r"^ +\d+ +\d+ +(\d+) +(\d+) *$", text, re.M)[-1]) / int(atoms)
    share = {"pairs": percent("Pair"), "walls": 100 * seconds("cluster/wall/gran") / float(loop),
             "motion": 100 * seconds("nve/cluster|cluster/bodies") / float(loop),
             "lists": percent("Neigh") + 100 * seconds("cluster/history") / float(loop)}
    return {"contacts": contacts, **share, "rest": 100 - sum(share.values())}


def memory_job(dem, prepared, bodies):
    """Largest resident size of a settled bed's run [kB]."""
    given = bodies.words() | {"phase": 2, "step": SHORT_STEP, "steps": 200}

    def work(folder):
        took = run([dem, "-in", SCRIPT, "-log", "none", *programs.variables(**given, start=prepared.made_in / "end.restart")], folder, folder / "out.txt")
        return {"memory": took.memory, "cpu": took.cpu}

    return runs.Job(f"memory of {bodies.name()}", {"what": "speed, memory", "scene": digest_of(SCRIPT), "from": prepared.key(), **given}, work, 5)


class Compared:
    """Times of the turns: medians, and ratios of columns as median (least to largest) of the turns' ratios."""

    def __init__(self, results):
        self.turns = [r["costs"] for r in results]
        self.parts = results[-1]["parts"]

    def median(self, column):
        return statistics.median(turn[column] for turn in self.turns)

    def ratio(self, a, b):
        each = sorted(turn[a] / turn[b] for turn in self.turns)
        return statistics.median(each), each[0], each[-1]

    def words(self, a, b):
        return "{:.2f} ({:.2f} to {:.2f})".format(*self.ratio(a, b))


class Speed:
    """What is prepared and timed, through the store."""

    def __init__(self, chosen):
        self.chosen, self.store = chosen, chosen.store
        self.dem = chosen.build / "bin" / "eccentra-dem"
        self.missing = False

    def prepared(self, bodies):
        job = restart_job(self.dem, bodies)
        for one in [job.before, job] if job.before else [job]:
            one.made_in = self.store.folder_of(one)
            runs_of_it = self.store.run_all("prepared", [one])
            if not self.chosen.plan:
                runs.needed(runs_of_it, {"": one})
        return job

    def compare(self, *sides, ranks=None):
        """The sides in turns; None where nothing is run."""
        prepared = {bodies: self.prepared(bodies) for _, bodies in sides}
        steps = [2000 if ranks else bodies.timed_steps(self.chosen.quick) for _, bodies in sides]
        jobs = {turn: turn_job(sides, prepared, steps, turn, ranks) for turn in range(self.chosen.repeat)}
        found = self.store.run_all("speed", jobs.values())
        return None if self.chosen.plan else Compared(list(runs.needed(found, jobs).values()))

    def memory(self, bodies):
        jobs = {"": memory_job(self.dem, self.prepared(bodies), bodies)}
        found = self.store.run_all("memory", jobs.values())
        return None if self.chosen.plan else runs.needed(found, jobs)[""]["memory"]

    def memory_per_body(self, bodies):
        """The difference of a settled bed of four times the bodies and of this one, as a process alone varies by some 200 kB [kB]; None where
        nothing is run."""
        many = dataclasses.replace(bodies, number=4 * bodies.number)
        least, most = self.memory(bodies), self.memory(many)
        return (most - least) / (many.number - bodies.number) if most else None


def rounded_rows(speed, words):
    """Rows of the table of rounded bodies, each beside the cluster of its family."""
    rows = []
    for scene in speed.chosen.scenes:
        number = speed.chosen.bodies * (2 if scene in COLUMN else 1)
        for word in words:
            family, rounding = word.split(":")
            cluster = Bodies("cluster", scene, family, PARTNERS[family], number)
            told = speed.compare((speed.dem, dataclasses.replace(cluster, rounding=float(rounding))), (speed.dem, cluster))
            if told:
                bar = ROUNDED_BAR if scene in ("settled", "drum") else "-"
                ours, parts = told.median(0), told.parts[0]
                rows.append([scene, f"{family} {float(rounding):g}", f"{family[0].upper()}{PARTNERS[family]}", f"{ours:.3f}",
                             f"{told.median(1):.3f}", *(f"{r:.2f}" for r in told.ratio(0, 1)), bar, *of_parts(ours, parts)])
    return rows


def of_parts(ours, parts):
    """Contacts per body, ns per contact and the shares of the step, as words of a table."""
    contacts = parts["contacts"]
    return [f"{contacts:.1f}", f"{1000 * ours / contacts if contacts else 0:.0f}",
            *(f"{parts[name]:.0f}" for name in ("pairs", "walls", "motion", "lists", "rest"))]


def main():
    parser = options.Parser(
        "cluster-speed", "Milliseconds of processor time per body and 1000 steps, for ours and for stock, their ratio and the required one; contacts per "
        "body, nanoseconds per contact and the share of each part of the step for ours; the same for rounded bodies beside clusters (a cube beside C27, a "
        "disk of the aspect 0.3092 beside D48); then C64 and a one-sphere cluster in units of a stock sphere, plain "
        "spheres with and without the library, and memory per body. What is compared takes turns; times are medians of the turns, ratios the median (least "
        "to largest) of the turns' ratios. settled: a bed at rest on 50 x 50 mm, periodic. drum: a hole of R 63.5 mm at 50 rpm. collapsing: a column of "
        "twice as many bodies, 50 mm wide and about twice as high, from the step at which its gate is gone. flowing: the same column 80 to 160 ms after that, "
        "when it moves fastest, at the step of 50 us (disks: 20 us). Both sides run the same steps of the same length (20 us) from beds that each has "
        "prepared for itself.", "settled and drum, C8, C64 and a rounded cube, once, a quarter of the steps", at_once=1)
    parser.add_argument("--scenes", action=options.Words, choices=list(GEOMETRY), help="default: all")
    parser.add_argument("--shapes", action=options.Words, metavar="FAMILY:N", help="default: cube:8 cube:27 disk:48 cube:64")
    parser.add_argument("--rounded", action=options.Words, metavar="FAMILY:ROUNDING", help="rounded cubes and disks, or none (default: cube:0.15 disk:0.3)")
    parser.add_argument("--bodies", type=options.at_least_one, default=500, metavar="N", help="of settled and drum (default 500; collapsing and flowing have "
                        "twice as many)")
    parser.add_argument("--repeat", type=options.at_least_one, metavar="N", help="turns (default 3, with --quick 1)")
    parser.add_argument("--portable", type=pathlib.Path, metavar="DIR", help="also times C64 with this build (preset portable)")
    parser.add_argument("--ranks", type=options.at_least_one, default=1, metavar="N", help="also times the settled C64 bed of four times the bodies on N "
                        "ranks (wall clock: give it N free cores)")

    def check(chosen):
        for pair in chosen.shapes or ():
            if not re.fullmatch(r"[a-z]+:[1-9]\d*", pair):
                parser.error(f"--shapes has '{pair}': give FAMILY:N, such as cube:8")
        for pair in chosen.rounded or ():
            family, _, rounding = pair.partition(":")
            if pair != "none" and not (family in ROUNDED and re.fullmatch(r"[01]|[01]?\.\d+", rounding) and 0.01 <= float(rounding) <= 1):
                parser.error(f"--rounded has '{pair}': give cube:R or disk:R with a rounding R of 0.01 to 1, such as cube:0.15, or none")
        if chosen.rounded and "none" in chosen.rounded and len(chosen.rounded) > 1:
            parser.error("--rounded has 'none' beside bodies: give one or the other")
        chosen.rounded = chosen.rounded or (["cube:0.15"] if chosen.quick else ["cube:0.15", "disk:0.3"])
        chosen.rounded = [pair for pair in chosen.rounded if pair != "none"]
        chosen.scenes = chosen.scenes or (["settled", "drum"] if chosen.quick else list(GEOMETRY))
        chosen.shapes = chosen.shapes or (["cube:8", "cube:64"] if chosen.quick else ["cube:8", "cube:27", "disk:48", "cube:64"])
        chosen.repeat = chosen.repeat or (1 if chosen.quick else 3)
        if chosen.portable:
            chosen.portable = chosen.portable.resolve()
            programs.need(chosen.portable, "bin/eccentra-dem")

    chosen = parser.settle(("eccentra-dem",), check)
    speed, rows, page = Speed(chosen), [], []
    header = ["scene", "shape", "ours_ms_per_body_per_1000_steps", "stock", "times_as_fast", "least", "largest", "required", "contacts_per_body",
              "ns_per_contact", "pairs_%", "walls_%", "motion_%", "lists_%", "rest_%"]
    for scene in chosen.scenes:
        number = chosen.bodies * (2 if scene in COLUMN else 1)
        for pair in chosen.shapes:
            family, count = pair.split(":")
            sides = [(speed.dem, Bodies(carrier, scene, family, int(count), number)) for carrier in ("cluster", "multisphere")]
            told = speed.compare(*sides)
            if told:
                ours = told.median(0)
                rows.append([scene, pair.replace(":", ""), f"{ours:.3f}", f"{told.median(1):.3f}", *(f"{r:.2f}" for r in told.ratio(1, 0)),
                             BARS[scene].get(pair, "-"), *of_parts(ours, told.parts[0])])
    if rows:
        shown = ["scene", "shape", "ours ms", "stock ms", "ratio", "least", "largest", "required", "contacts", "ns each", "pairs %", "walls",
                 "motion", "lists", "rest"]
        tables.write_csv(chosen.out / "cluster-speed.csv", header, rows)
        print(tables.text(shown, rows))
        page.append(tables.markdown(shown, rows))
    if rows := rounded_rows(speed, chosen.rounded):
        shown = ["scene", "rounded", "cluster", "rounded ms", "cluster ms", "ratio", *shown[5:]]
        tables.write_csv(chosen.out / "rounded-speed.csv", ["scene", "rounded", "cluster", "rounded_ms_per_body_per_1000_steps", "cluster_ms", "times_as_long",
                                                            *header[5:]], rows)
        print(tables.text(shown, rows))
        page.append(tables.markdown(shown, rows))
    said = []
    one = lambda carrier, count, family="cube", number=chosen.bodies: Bodies(carrier, "settled", family, count, number)
    sides = [(speed.dem, one("sphere", 1, "sphere")), (speed.dem, one("cluster", 1, "sphere")), (speed.dem, one("cluster", 64))]
    if shutil.which("liggghts"):
        sides.append(("liggghts", one("sphere", 1, "sphere")))
    told = speed.compare(*sides)
    if told:
        if len(sides) > 3:
            said.append(f"plain spheres: the library makes the run {told.words(3, 0)} times as fast (required 1.0)")
        said.append(f"settled bed, in units of a stock sphere ({told.median(0):.3f}): one-sphere cluster {told.words(1, 0)} (required 1.2), "
                    f"C64 {told.words(2, 0)} (required 3)")
    memory = speed.memory_per_body(one("cluster", 64))
    if memory:
        said.append(f"memory per C64 body: {memory:.1f} kB (required 4)")
    for pair in chosen.rounded:
        family, rounding = pair.split(":")
        memory = speed.memory_per_body(Bodies("cluster", "settled", family, PARTNERS[family], chosen.bodies, float(rounding)))
        if memory:
            said.append(f"memory per rounded {family} of {float(rounding):g}: {memory:.1f} kB")
    if chosen.portable:
        told = speed.compare((speed.dem, one("cluster", 64)), (chosen.portable / "bin" / "eccentra-dem", one("cluster", 64)))
        said += [f"portable build: C64 takes {told.words(1, 0)} times as long (required 1.6)"] if told else []
    if chosen.ranks > 1:
        crowd = (speed.dem, one("cluster", 64, number=4 * chosen.bodies))
        told = speed.compare(crowd, crowd, ranks=[1, chosen.ranks])
        said += [f"{chosen.ranks} ranks: {told.words(0, 1)} times as fast as one, wall clock (required 1.8 for two)"] if told else []
    if chosen.plan:
        return 0
    print("\n".join(said))
    return tables.finish(chosen, page + [f"{line}\n" for line in said], [], f"{chosen.repeat} turn(s)", "ms of processor time per body and 1000 steps")
