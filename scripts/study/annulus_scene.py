# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The annulus of cases/tomren-section as a scene for any shape: what is judged, and how a level of detail runs in it."""
import dataclasses

from . import level_study, section

LENGTH, CELLS = 0.15, "8 32 10"
SECONDS = {0: 1.0, 40: 2.0, 80: 2.5}  # by inclination
NAMES = tuple(f"annulus-{inclination}" for inclination in level_study.JUDGED_BY)


@dataclasses.dataclass(frozen=True)
class AnnulusScene:
    """name: of NAMES; sphericity: of the true body, for the drag of spheres that stand for it by friction."""
    name: str
    sphericity: float

    def inclination(self):
        return int(self.name.split("-")[1])

    def _judged(self):
        return level_study.JUDGED_BY[self.inclination()]

    def title(self):
        return f"annulus {self.inclination()} deg, {level_study.CENTRAL_VELOCITY} m/s: {level_study.SECTION_RESULTS[self._judged()][0]}"

    def unit(self):
        return level_study.SECTION_RESULTS[self._judged()][1]

    def job(self, build, level, seed, critical):
        words = {"inclination": self.inclination(), "velocity": level_study.CENTRAL_VELOCITY, "seconds": SECONDS[self.inclination()],
                 "length": LENGTH, "cells": CELLS, "count": section.bodies_at(level_study.CONCENTRATION, LENGTH), "seed": seed,
                 "interval": section.steps_per_fluid_step(critical), **section.level_words(level)}
        if level.kind in ("friction", "eccentric"):
            words["sphericity"] = round(self.sphericity, 4)
        return section.section_job(build, f"{self.name} {level.name} seed {seed}", words, spheres=level.spheres)

    def value(self, result):
        quantity = self._judged()
        return result["mean"][quantity][0] * level_study.SECTION_RESULTS[quantity][2]
