# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which effects matter at each inclination and velocity of the annulus section of Table 2, by a screen of all effects."""
import shutil
import sys
import time

from . import runs

TOLERANCE = 0.01
INCLINATIONS, VELOCITIES = (0, 40, 80), (0.58, 0.72, 1.165)
SECONDS, LENGTH, CUTTINGS = 1.5, 0.1, 404  # 5 % of a third of the paper's section
STEPS = round(SECONDS / 5e-3) * 64  # of the DEM: cases/tomren-section


def cell(share, _, stays):
    """A share in percent, bold where the screen keeps it."""
    text = "alone" if share > 1e6 else f"{100 * share:.0f}" if share > 0.0995 else f"{100 * share:.1f}"
    return f"**{text}**" if stays else text


def run(root, build, out):
    """Runs the nine points that are not there yet and writes their table."""
    shares, began, fresh = {}, time.monotonic(), 0
    points = [(inclination, velocity) for inclination in INCLINATIONS for velocity in VELOCITIES]
    for number, (inclination, velocity) in enumerate(points):
        folder = out / f"annulus-{inclination}-{velocity:g}"
        log = folder / "log.liggghts"
        if not (log.exists() and "screen: " in log.read_text(errors="replace")):
            print(f"[{number + 1}/{len(points)}] {inclination} degrees, {velocity:g} m/s"
                  f"{runs.left(fresh, fresh + len(points) - number, began, time.monotonic())}", file=sys.stderr)
            shutil.rmtree(folder, ignore_errors=True)
            looked = f'"screen {TOLERANCE:g} screen_steps {STEPS - 1} screen_recheck 0"'
            runs.run([root / "cases" / "tomren-section" / "run", "--output", folder, "--bin", build / "bin", "--velocity", f"{velocity:g}",
                      "--inclination", inclination, "--length", LENGTH, "--count", CUTTINGS, "--cells", "8 32 7", "--seconds", SECONDS,
                      "--snapshots", SECONDS, "--effects", looked], out / f"annulus-{inclination}-{velocity:g}.log")
            fresh += 1
        shares[inclination, velocity] = runs.verdicts(log.read_text(errors="replace"))
    names = list(runs.EVERYTHING)
    with open(out / "annulus.csv", "w") as stream:
        stream.write("inclination,velocity," + ",".join(f"{n},{n}_verdict" for n in names) + "\n")
        for (inclination, velocity), row in shares.items():
            stream.write(f"{inclination},{velocity:g}," + ",".join(f"{row[n][0]:.3e},{'on' if row[n][2] else 'off'}" for n in names) + "\n")
    lines = ["| inclination | velocity | " + " | ".join(name.replace("_", " ") for name in names) + " |", "|" + "---|" * (len(names) + 2)]
    for (inclination, velocity), row in shares.items():
        lines.append(f"| {inclination} | {velocity:g} m/s | " + " | ".join(cell(*row[n]) for n in names) + " |")
    lines += ["", f"95 % of all observations lie below this share [%] of the larger of submerged weight and drag (a torque: of all other torques on the particle);",
              f"bold: a screen at {100 * TOLERANCE:g} % keeps it. 'alone': no other torque acted."]
    (out / "annulus.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    return 0
