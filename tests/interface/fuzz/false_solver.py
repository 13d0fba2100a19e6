# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A solver at the other end of the socket link that answers whatever it is told: messages whose header is right or nearly so."""
import struct
import time

import zmq
from hypothesis import strategies as st

HEADER = 32  # docs/link.md: magic 8, byte order 4, version 4, kind 4, bytes of a double 4, length of the body 8
FIELDS = {"order": 8, "version": 12, "kind": 16, "double": 20}
KINDS = range(0, 12)
QUIET = 2.5  # seconds without a word from the DEM side: it has gone, or it waits for what does not come


def answers():
    """What the false solver says, one after the other: kind, fields of the header that are wrong, error of the length, body."""
    doubles = st.lists(st.floats(), max_size=40).map(lambda values: struct.pack(f"<{len(values)}d", *values))
    words = st.lists(st.integers(0, 2**32 - 1), max_size=60).map(lambda values: struct.pack(f"<{len(values)}I", *values))
    body = st.one_of(st.just(b""), st.binary(max_size=64), doubles, words, st.text(max_size=30).map(lambda text: text.encode("utf-8", "surrogateescape")))
    wrong = st.dictionaries(st.sampled_from(sorted(FIELDS)), st.sampled_from([0, 1, 2, 7, 0x80000000, 0xFFFFFFFF]), max_size=1)
    length = st.sampled_from([0, 0, 0, 0, 1, -1, 2**40])
    return st.lists(st.tuples(st.sampled_from(KINDS), wrong, length, body), min_size=1, max_size=3)


def message(header, kind, wrong, error, body):
    """header: a right one, as received."""
    data = bytearray(header[:HEADER])
    struct.pack_into("<I", data, FIELDS["kind"], kind)
    for name, value in wrong.items():
        struct.pack_into("<I", data, FIELDS[name], value)
    struct.pack_into("<Q", data, 24, max(0, len(body) + error))
    return bytes(data) + body


def serve(said, folder, process):
    """Binds, answers each message of the DEM side with the next one of `said`, and leaves."""
    context = zmq.Context()
    socket = context.socket(zmq.ROUTER)
    socket.linger = 0
    try:
        socket.bind(f"ipc://{folder}/s")
        for answer in said:
            until = time.monotonic() + 15
            while process.poll() is None and time.monotonic() < until and not socket.poll(50):
                pass
            if not socket.poll(0):
                return
            parts = socket.recv_multipart()
            socket.send_multipart([parts[0], message(parts[-1], *answer)])
        until = time.monotonic() + QUIET
        while process.poll() is None and time.monotonic() < until:
            time.sleep(0.02)
    finally:
        socket.close()
        context.term()
