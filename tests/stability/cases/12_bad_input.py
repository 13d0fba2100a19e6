# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Malformed input, by hand, by grammar, and as messages."""
from harness import checks
from harness.case import Check, Fails, Group

GROUP = Group("bad_input", "12. Bad input", """
Whatever is written into a script, a dictionary, a shape, an STL file, a table or a message: it is accepted, or the program ends with exactly one sentence and a failing status,
within seconds and without a crash. tests/interface/bad_input holds the malformed inputs, tests/interface/fuzz the grammars whose sentences are changed at random, tests/link/wire_test.cpp
200,000 changed messages.""")


GROUP.case(
    "malformed",
    "malformed scripts, dictionaries, shapes, STL files, tables and command lines, one by one",
    seconds=120,
    values={"inputs": ""},
    files=["bad_input/malformed"],
    commands=lambda inputs, source, tests: [
        f"env ECCENTRA_BAD_INPUT={inputs or f'{source}/tests/interface/bad_input:{source}/tests/interface/bad_input/openfoam'} {tests}/interface_bad_input"],
    checks=[
        Check("inputs that ended as they must", checks.tests_passed, above=149),
        Check("exit status: none crashed, hung, was accepted or said more than one sentence", checks.status, equals=0),
    ],
    fails=[
        Fails("an input with nothing wrong must be noticed as accepted", set={"inputs": "harmless"}),
    ])


GROUP.case(
    "grammar_seed{seed}",
    "{examples} sentences of the grammar of each reader, changed at random (seed {seed}), and false messages to a waiting DEM side",
    seconds=200,
    vary={"seed": [1, 2]},
    values={"examples": 40, "programs": ""},
    files=["bad_input/grammar"],
    commands=lambda source, programs, build, examples, seed: [
        "chmod -R u+x crashing",
        f"/usr/bin/python3 {source}/tests/interface/fuzz/reader_fuzz.py --build {programs or build} --examples {examples} --seed {seed}"],
    checks=[
        Check("readers", checks.readers, above=13),
        Check("inputs refused with one sentence", checks.inputs_refused, above=100),
        Check("inputs accepted", checks.inputs_accepted, above=100),
        Check("exit status: every input was accepted or refused with one sentence", checks.status, equals=0),
    ],
    fails=[
        Fails("programs that crash, or say two sentences", set={"programs": "crashing", "examples": 2}),
    ])


GROUP.case(
    "messages",
    "200,000 changed messages to the decoder of the socket link",
    quick=True,
    seconds=3,
    values={"only": "*"},
    commands=["{tests}/link_wire --gtest_filter={only}"],
    checks=[
        Check("tests passed", checks.tests_passed, above=5),
        Check("exit status", checks.status, equals=0),
    ],
    fails=[
        Fails("a filter that leaves nothing to pass", set={"only": "Nothing*"}),
    ])
