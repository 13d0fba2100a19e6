# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables, charts and sentences of the whole scene, of runs that have ended or not."""
import math
import re

from . import charts, full_run, hole, section

PAPER = ["paper", "32", "140,000", "25,837", "60", "0.001 / 1e-05", "90", "-"]
ROWS = 6  # of the table over time
ENTRY = 0.3  # behind the inlet, in which the bed begins [m]
CONTACT = r"^\s*Step\s+Atoms.*pipe\[6\]"


def contact_loads(case):
    """{step: (force x, y, z [N], torque [N m])} that contacts put on the pipe, from the logs of all calls."""
    found = {}
    logs = sorted(case.glob("log.liggghts*"), key=lambda path: (path.name == "log.liggghts", int(re.sub(r"\D", "", path.name) or 0)))
    for log in logs:
        inside = False
        for line in log.read_text(errors="replace").splitlines():
            if re.match(CONTACT, line):
                inside = True
                continue
            words = line.split()
            if inside and len(words) == 8 and words[0].isdigit():
                found[int(words[0])] = tuple(float(word) for word in words[4:])
            elif inside and line.startswith("Loop time"):
                inside = False
    return found


def limit_sentence(name, case):
    """How near the DEM step came to the critical one: what fix timestep/limit has said in all calls."""
    said = "\n".join(log.read_text(errors="replace") for log in sorted(case.glob("log.liggghts*")))
    parts = [float(part) for part in re.findall(r"critical step \S+ s \([^)]*\); time step \S+ s is (\S+) of it", said)]
    if not parts:
        return f"{name}: fix timestep/limit has said nothing of the DEM step."
    above = sum(part > 1 for part in parts)
    return (f"{name}: the DEM step was at most {max(parts):.3g} of the critical one; of the {len(parts)} times that fix timestep/limit spoke of it, "
            f"it was above 1 in {above}. Energy begins to grow at 1.1 to 1.45.")


def balance_of(row):
    """(injected, present, left [kg], what is missing over what was injected) of a row of coupling.csv."""
    body = row["inserted_mass"] / row["inserted"] if row["inserted"] else 0.0
    left = row["left"] * body
    missing = row["inserted_mass"] - row["mass"] - left
    return row["inserted_mass"], row["mass"], left, abs(missing) / row["inserted_mass"] if row["inserted_mass"] else 0.0


def mean_over(rows, name, share=0.2):
    """Of a column over the last share of the run."""
    last = [row[name] for row in rows if row["time"] >= (1 - share) * rows[-1]["time"]]
    return sum(last) / len(last)


def measures_of(case, step, length):
    """What is compared between runs: hold-up [m3], place of the front [m] (in some seconds it does not move), pressure
    gradient [Pa/m], over the last fifth."""
    rows, pictures = section.rows_of(case), hole.history(case, step, length)
    return {"hold-up": mean_over(rows, "solid_concentration"), "front": mean_over(pictures, "front"), "gradient": mean_over(rows, "pressure_gradient")}


def developed(picture):
    """Concentrations of a picture where neither inlet nor front are near."""
    return [c for z, c, _ in picture["along"] if ENTRY <= z <= 0.5 * picture["front"]]


def time_table(rows, pictures, contacts, step):
    """The state at some times."""
    table = []
    for k in range(1, ROWS + 1):
        time = rows[-1]["time"] * k / ROWS
        row = min(rows, key=lambda r: abs(r["time"] - time))
        picture = min(pictures, key=lambda p: abs(p["time"] - time)) if pictures else None
        near = [load for number, load in contacts.items() if abs(number * step - row["time"]) < 0.5 * rows[-1]["time"] / ROWS]
        contact = [sum(load[i] for load in near) / len(near) for i in range(4)] if near else [math.nan] * 4
        highest = 1e3 * max(h for _, _, h in picture["along"]) if picture else math.nan
        table.append([f"{row['time']:.3g}", int(row["particles"]), 100 * row["solid_concentration"], highest, picture["front"] if picture else math.nan,
                      row["pressure_gradient"], row["pipe_force_z"], row["pipe_torque"], contact[1], contact[2], contact[3]])
    return table


TIME_HEADER = ["time [s]", "bodies", "solid [%]", "highest bed [mm]", "front [m]", "pressure gradient [Pa/m]", "fluid on the pipe: along [N]", "torque [N m]",
               "contacts on the pipe: across [N]", "along [N]", "torque [N m]"]


def chart(path, name, rows, pictures, length):
    """Space-time pictures of concentration and bed, and what changes in time."""
    shown = hole.reached(pictures, length)
    near = [[row for row in p["along"] if row[0] < shown] for p in pictures]
    times, places = [p["time"] for p in pictures], [z for z, _, _ in near[0]]
    maps = [charts.Map("solid concentration [%]", "time [s]", "along the hole [m]", times, places, [[100 * c for _, c, _ in rows_of] for rows_of in near])]
    heights = [[1e3 * h for _, _, h in rows_of] for rows_of in near]
    if any(max(row) > 0 for row in heights):  # a vertical hole has none
        maps.append(charts.Map("height of the bed [mm]", "time [s]", "along the hole [m]", times, places, heights))
    line = lambda title, y, points, colour: charts.Panel(title, "time [s]", y, [charts.Series("", points, charts.COLOURS[colour], line=True, marks=False)])
    of = lambda column, factor=1.0: [charts.Point(row["time"], factor * row[column]) for row in rows]
    front = [charts.Point(p["time"], p["front"]) for p in pictures]
    panels = [*maps, line("front: 99 % of the solid are behind", "[m]", front, 0), line("solid in the hole", "[%]", of("solid_concentration", 100), 1),
              line("pressure gradient", "[Pa/m]", of("pressure_gradient"), 2), line("torque of the fluid on the pipe", "[N m]", of("pipe_torque"), 3)]
    charts.write(path, f"{name}: {shown:g} of {length:g} m", panels, columns=2)


def cost_row(name, chosen, rows, interval, note):
    """A run beside the paper: what was measured, nothing projected."""
    row = rows[-1]
    cells = math.prod(int(n) for n in full_run.cells_of(chosen.length).split())
    fluid = chosen.fluid_step
    return [name, str(chosen.ranks), f"{cells:,}", f"{int(row['inserted']):,}", f"{row['time']:.3g}", f"{fluid:g} / {fluid / interval:.2g}",
            f"{note['cpu'] / 86400:.3g}", f"{sum(row[f'{part}_seconds'] for part in ('dem', 'fluid', 'exchange', 'link')) / 3600:.3g}"]


COST_HEADER = ["", "cores", "cells", "bodies injected", "seconds of it", "steps fluid / DEM [s]", "CPU days", "wall hours"]


def sentences(name, chosen, rows, pictures, note):
    row = rows[-1]
    injected, present, left, missing = balance_of(row)
    wanted = 0.1512 * row["time"]
    yield (f"{name}: injected {injected:.5g} kg ({100 * injected / wanted:.3g} % of 0.1512 kg/s), present {present:.5g} kg, left {left:.5g} kg; "
           f"the balance is closed to {missing:.1e}, the solid volume on the mesh to {max(r['volume_error'] for r in rows):.1e}.")
    if pictures:
        densest = 100 * max(c for _, c, _ in pictures[-1]["along"])
        yield (f"{name}: speed of the front {hole.front_speed(pictures, chosen.length):.3g} m/s; solid in the hole "
               f"{100 * row['solid_concentration']:.3g} %, where it is densest {densest:.3g} % over {hole.BIN:g} m.")
        behind = developed(pictures[-1])
        if behind:
            yield (f"{name}: from {ENTRY:g} m to half of the way to the front {100 * sum(behind) / len(behind):.3g} % of the volume are solid; a "
                   "periodic section carries the injected flux at the concentration of figure 7.")
    if row["time"] < chosen.end * (1 - 1e-9):
        yield f"{name}: the run has not come to its end; it is at {row['time']:.3g} of {chosen.end:g} s."
    yield f"{name}: computed in {note['calls']} call(s) by {len(note['builds'])} build(s)."
