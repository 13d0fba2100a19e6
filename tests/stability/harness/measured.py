# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run left behind: its log, thermo tables and dumps, in the terms that criteria use."""
import glob
import re


class Measured:
    """One finished run. Thermo tables are numbered as the `run` commands of the script; -1 is the last."""

    def __init__(self, folder, output, status, peak_memory):
        self.folder, self.output, self.status, self.memory = folder, output, status, peak_memory
        self.tables = list(self._tables(output))

    @staticmethod
    def _tables(output):
        header = None
        for line in output.splitlines():
            words = line.split()
            if words[:1] == ["Step"]:
                header, rows = words, []
            elif header and words and re.fullmatch(r"-?\d+", words[0]) and len(words) == len(header):
                try:
                    rows.append([float(word) for word in words])
                except ValueError:
                    continue
            elif header and line.startswith("Loop time"):
                yield {name: [row[i] for row in rows] for i, name in enumerate(header)}
                header = None
        if header:
            yield {name: [row[i] for row in rows] for i, name in enumerate(header)}

    def column(self, name, table=-1):
        """A column by the word of thermo_style that asked for it."""
        heading = {"ke": "KinEng", "atoms": "Atoms", "step": "Step"}.get(name, re.sub("^[fvc]_", "", name))
        return self.tables[table][heading]

    def first(self, name, table=-1):
        return self.column(name, table)[0]

    def last(self, name, table=-1):
        return self.column(name, table)[-1]

    def largest(self, name, table=-1):
        values = [abs(value) for value in self.column(name, table)]
        return float("nan") if any(value != value for value in values) else max(values)

    def early(self, name, table=-1):
        """Mean of the first quarter."""
        values = self.column(name, table)
        part = values[: max(1, len(values) // 4)]
        return sum(part) / len(part)

    def late(self, name, table=-1):
        """Mean of the last quarter."""
        values = self.column(name, table)
        part = values[-max(1, len(values) // 4):]
        return sum(part) / len(part)

    def csv(self, name, skip=0):
        """A column of the coupling's CSV, without its first `skip` rows."""
        with open(f"{self.folder}/postProcessing/eccentra/coupling.csv") as stream:
            rows = [line.split(",") for line in stream.read().split()]
        place = rows[0].index(name)
        return [float(row[place]) for row in rows[1 + skip:]]

    def memory_growth(self):
        """Bytes by which the resident memory grew in the second half of the run."""
        half = [size for time, size in self.memory if time > self.memory[-1][0] / 2]
        return max(half) - half[0]

    def says(self, pattern):
        return 1 if re.search(pattern, self.output) else 0

    def number(self, pattern, which=-1):
        """The number that the first group of `pattern` finds in the output; by default the last one."""
        return float(re.findall(pattern, self.output)[which])

    def numbers(self, pattern):
        """All numbers that the first group of `pattern` finds in the output."""
        return [float(text) for text in re.findall(pattern, self.output)]

    def spheres(self, name):
        """Rows x y z r of a .clump file."""
        with open(f"{self.folder}/{name}") as stream:
            return [[float(word) for word in line.split()] for line in stream if line.strip() and not line.startswith("#")]

    def field_range(self, name):
        """Largest less smallest value of the cells of an ASCII scalar field of OpenFOAM at the last time that was written."""
        cells = [float(line) for line in re.findall(r"^[-+0-9.e]+$", self._internal_field(name), re.M)][1:]  # the first: how many
        return max(cells) - min(cells)

    def _internal_field(self, name):
        times = [folder for folder in glob.glob(f"{self.folder}/[0-9]*") if re.fullmatch(r"[-+0-9.e]+", folder.split("/")[-1])]
        with open(max(times, key=lambda folder: float(folder.split("/")[-1])) + "/" + name) as stream:
            text = stream.read()
        return text[text.index("internalField"): text.index("boundaryField")]

    def field_mean(self, name, component):
        """Mean over the cells of a component of an ASCII vector field of OpenFOAM at the last time that was written."""
        cells = re.findall(r"^\(([^()]+)\)$", self._internal_field(name), re.M)
        return sum(float(cell.split()[component]) for cell in cells) / len(cells)

    def frames(self, name="dump"):
        """Frames of a custom dump `name` or `name.*`: lists of dictionaries column -> value, sorted by id."""
        found = []
        for path in sorted(glob.glob(f"{self.folder}/{name}*")):
            with open(path) as stream:
                lines = iter(stream.read().splitlines())
            for line in lines:
                if line.startswith("ITEM: TIMESTEP"):
                    step = int(next(lines))
                elif line.startswith("ITEM: NUMBER OF ATOMS"):
                    count = int(next(lines))
                elif line.startswith("ITEM: ATOMS"):
                    names = line.split()[2:]
                    atoms = [dict(zip(names, map(float, next(lines).split()))) for _ in range(count)]
                    found.append((step, sorted(atoms, key=lambda atom: atom["id"])))
        return [atoms for _, atoms in sorted(found, key=lambda frame: frame[0])]
