# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of the flow alone: a folder of scenes/, with the numbers of a run in files that its dictionaries include."""
import shutil

from .programs import SCENES, digest_of


def digest(scene):
    """Of all files of a scene."""
    return digest_of(*sorted(file for file in (SCENES / scene).rglob("*") if file.is_file()))


def set_up(folder, scene, **files):
    """Makes the case anew. files: {name: {keyword: value}}."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(SCENES / scene, folder)
    for name, entries in files.items():
        put(folder / name, **entries)


def put(path, **entries):
    """A file that dictionaries include."""
    path.write_text("".join(f"{name} {value}{'' if str(value).startswith('{') else ';'}\n" for name, value in entries.items()))
