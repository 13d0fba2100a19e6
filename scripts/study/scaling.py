# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a step would take on more ranks than a machine has, from what a rank computes and from counted messages, operations and bytes."""
import dataclasses
import math
import re

PARTS = ("DEM", "fluid", "exchange", "link")
LINE = r"sent by a rank in a coupling step, mean: (.*)"
PART = r"(\w+) (\S+) messages, (\S+) kB, (\S+) operations of all ranks"


@dataclasses.dataclass(frozen=True)
class Sent:
    """By one rank in a coupling step."""
    messages: float = 0.0
    kilobytes: float = 0.0
    operations: float = 0.0  # of all ranks

    def __add__(self, other):
        return Sent(self.messages + other.messages, self.kilobytes + other.kilobytes, self.operations + other.operations)


@dataclasses.dataclass(frozen=True)
class Network:
    name: str
    latency: float  # of a message [s]
    bandwidth: float  # of a rank [bytes/s]


NETWORKS = (Network("InfiniBand (2 us, 10 GB/s)", 2e-6, 10e9), Network("Ethernet (30 us, 1 GB/s)", 30e-6, 1e9))


def sent_in(text):
    """{part: Sent} of what a coupled run says at its end; {} on one rank, which sends nothing."""
    line = re.search(LINE, text)
    return {name: Sent(*map(float, numbers)) for name, *numbers in re.findall(PART, line[1])} if line else {}


def communication(sent, ranks, network):
    """Seconds of a coupling step that a rank communicates: latency and transfer of its messages; an operation of all ranks takes as many
    rounds as there are powers of two in their number."""
    rounds = math.ceil(math.log2(ranks)) if ranks > 1 else 0
    return network.latency * (sent.messages + rounds * sent.operations) + 1e3 * sent.kilobytes / network.bandwidth


def seconds_on(ranks, computing, sent, network):
    """Of a coupling step on a machine with a core for each rank. computing: seconds of one rank alone, divided evenly."""
    return computing / ranks + (communication(sent, ranks, network) if ranks > 1 else 0.0)
