# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A bed of spheres that water fluidises, in annulusFoam and in OpenFOAM's own DPMFoam: time of a coupling step and pressure drop."""
import math
import re
import shutil

from . import measures, programs, runs, section

CASE = programs.CASES / "fluidised-bed"
SCENE = programs.SCENES / "peers-dpm"
WORDS = {"clusters": 0, "velocityFirst": 0.055, "velocityLast": 0.055}  # 1.2 of the onset
LAYER = 6.4e-3  # height of a cell [m]
LEFT_OUT = 0.25  # of the steps: the bed opens
GRAVITY = 9.81
RESOLUTION = 20  # steps of DPMFoam in the shortest collision: it chooses them by the speeds that it meets
CODES = {"ours": "annulusFoam and LIGGGHTS", "dpm": "DPMFoam"}
HEADER = ["", "bodies", "ms a step of 2 ms: DEM", "fluid", "exchange", "in all", "times ours", "pressure drop over the weight"]


def scene_of(case):
    """The numbers of a case's scene."""
    text = (case / "scene").read_text()
    return {name: float(value) for name, value in re.findall(r"^\s*(\w+)\s+([-+.\deE]+);", text, re.MULTILINE)}


def weight_of(scene):
    """Of the bed in the fluid, over the area of the column [Pa]."""
    return scene["count"] * math.pi / 6 * scene["diameter"]**3 * (scene["solidDensity"] - scene["fluidDensity"]) * GRAVITY / scene["width"]**2


def settled_places(case, scene):
    """Centres of the bodies when the fluid begins to flow [m]."""
    step = round(scene["settling"] / scene["fluid_step"]) * round(scene["interval"])
    words = (case / "postProcessing" / "eccentra" / f"particles_{step}.vtk").read_text().partition("\nPOINTS ")[2].split()
    numbers = [float(word) for word in words[2:2 + 3 * int(words[0])]]
    return list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))


def mean_step(times, share=LEFT_OUT):
    """Mean difference of a sum of seconds from row to row after the first ones [s]."""
    first = math.ceil(share * (len(times) - 1))
    return (times[-1] - times[first]) / (len(times) - 1 - first)


def ours_job(build, seconds, turn):
    inputs = {"what": "peers, fluidised bed", "case": section.case_digest(CASE), "seconds": seconds, "turn": turn, **WORDS}

    def work(folder):
        case, cpu, wall = section.run_case(build, folder, WORDS | {"seconds": seconds}, source=CASE)
        scene, rows = scene_of(case), section.rows_of(case)
        steps = (rows[1]["time"] - rows[0]["time"]) / scene["fluid_step"]
        share = min(1.0, cpu / wall)  # of the core that the run had
        part = lambda *names: 1e3 * share * mean_step([sum(row[f"{name}_seconds"] for name in names) for row in rows]) / steps
        late = [row["pressure_gradient"] * (scene["height"] + scene["entry"]) for row in rows[len(rows) // 2:]]
        return {"dem": part("dem"), "fluid": part("fluid"), "exchange": part("exchange", "link"), "drop": measures.mean_and_error(late)[0] / weight_of(scene),
                "bodies": int(rows[-1]["particles"]), "cpu": cpu}

    return runs.Job(f"fluidised bed: annulusFoam, turn {turn + 1}", inputs, work, 30 + 100 * seconds)


def write_dpm_case(case, like, scene, seconds, active):
    """The same column without the clear fluid below the floor, which is the inlet here, and the bodies where ours were."""
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(SCENE, case)
    shutil.copy(like / "system" / "blockMeshDict", case / "system")
    changed = scene | {"entry": 0, "seconds": seconds, "cellsAlong": round(scene["height"] / LAYER), "cellsAcross": round(scene["cellsAcross"]),
                       "resolution": RESOLUTION}
    (case / "scene").write_text("".join(f"{name} {value:.12g};\n" for name, value in changed.items()) + f"active {'true' if active else 'false'};\n")
    (case / "constant" / "positions").write_text(
        "FoamFile { version 2.0; format ascii; class vectorField; object positions; }\n(\n"
        + "".join(f"({x:.9g} {y:.9g} {z:.9g})\n" for x, y, z in settled_places(like, scene)) + ")\n")


def dpm_job(seconds, turn, like, settled):
    """like: the folder of our case; settled: the key of its job."""
    inputs = {"what": "peers, fluidised bed, DPMFoam", "scene": section.case_digest(SCENE), "seconds": seconds, "turn": turn, "settled": settled}

    def work(folder):
        scene, took, total = scene_of(like), {}, 0.0
        for name, active in (("whole", True), ("fluid", False)):
            case = folder / name
            write_dpm_case(case, like, scene, seconds, active)
            programs.run(["blockMesh"], case, case / "log.blockMesh")
            total += programs.run(["DPMFoam"], case, case / "log.DPMFoam").cpu
            times = [float(t) for t in re.findall(r"^ExecutionTime = ([\d.]+) s", (case / "log.DPMFoam").read_text(), re.MULTILINE)]
            took[name] = 1e3 * mean_step(times)
        log, = (folder / "whole" / "postProcessing" / "drop" / "0").glob("*.dat")
        pressures = [float(line.split()[1]) for line in log.read_text().splitlines() if line and line[0] != "#"]
        late = pressures[len(pressures) // 2:]
        drop = scene["fluidDensity"] * (sum(late) / len(late) - GRAVITY * scene["height"])
        bodies = re.findall(r"parcels added\s*=\s*(\d+)", (folder / "whole" / "log.DPMFoam").read_text())[-1]
        return {"all": took["whole"], "fluid": took["fluid"], "drop": drop / weight_of(scene), "bodies": int(bodies), "cpu": total}

    return runs.Job(f"fluidised bed: DPMFoam, turn {turn + 1}", inputs, work, 30 + 1000 * seconds)


def table_of(ours, dpm):
    """Rows of the least times of some turns."""
    least = lambda results, value: min(value(result) for result in results)
    whole = lambda r: r["dem"] + r["fluid"] + r["exchange"]
    all_ours = least(ours, whole)
    rows = [[CODES["ours"], ours[0]["bodies"], least(ours, lambda r: r["dem"]), least(ours, lambda r: r["fluid"]), least(ours, lambda r: r["exchange"]),
             all_ours, "1", ours[-1]["drop"]]]
    both, fluid = least(dpm, lambda r: r["all"]), least(dpm, lambda r: r["fluid"])
    rows.append([CODES["dpm"], dpm[0]["bodies"], f"{both - fluid:.3g} (with exchange)", fluid, "", both, f"{both / all_ours:.2g}", dpm[-1]["drop"]])
    return rows


def run(chosen, seconds):
    """Runs both codes in turn; the rows of the table."""
    ours, dpm = [], []
    for turn in range(chosen.repeat):
        first = ours_job(chosen.build, seconds, turn)
        second = dpm_job(seconds, turn, chosen.store.folder_of(first) / "case", first.key())
        for job, results in ((first, ours), (second, dpm)):
            found = chosen.store.run_all("fluidised bed", [job])
            if not chosen.plan:
                results.append(runs.needed(found, {"": job})[""])
    return table_of(ours, dpm) if ours else []
