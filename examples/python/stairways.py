#!/usr/bin/env python3
# SPDX-FileCopyrightText: The stairwayd authors
# SPDX-License-Identifier: Apache-2.0
"""Listens to stairwayd and says how a robot would walk to each stairway. A program to copy from.

It needs the Python package `stairway` (installed with stairwayd's development files) and nothing else: messages that fit
into a datagram, as all of stairwayd do, are received by a plain socket. With the package `lcm` of PyPI the class Listener
can be replaced by lcm.LCM().
"""
import argparse
import math
import os
import re
import socket
import struct
import sys
import time

import stairway

DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"
SMALL_MESSAGE = 0x4C433032  # "LC02"; longer messages come as several datagrams, "LC03"
STAND_OFF_M = 0.5  # where to stand before the first step
MAX_SIGMA_M = 0.010  # steps known worse than this are not stepped on
MAX_AGE_S = 60.0  # a stairway that was seen longer ago has moved with the robot


class Listener:
    """Receives LCM messages by multicast: an iterator of (channel, bytes)."""

    def __init__(self, url):
        match = re.fullmatch(r"udpm://([\d.]+):(\d+)(\?.*)?", url)
        if not match:
            sys.exit(f"{url}: this example listens to udpm://ADDRESS:PORT only")
        address, port = match[1], int(match[2])
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        # Scans come 40 times a second; whoever is slow needs room for them.
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self.socket.bind((address, port))
        membership = struct.pack("4s4s", socket.inet_aton(address), socket.inet_aton("0.0.0.0"))
        try:
            self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        except OSError as error:
            sys.exit(f"no multicast here ({error}); without a network: ip route add 224.0.0.0/4 dev lo")

    def __iter__(self):
        while True:
            datagram = self.socket.recv(65536)
            name_end = datagram.find(b"\0", 8)
            if len(datagram) < 8 or name_end < 0 or struct.unpack(">I", datagram[:4])[0] != SMALL_MESSAGE:
                continue
            yield datagram[8:name_end].decode(), datagram[name_end + 1 :]


def describe(stairs):
    kind = "spiral" if stairs.kind == stairs.SPIRAL else "straight"
    direction = "ascending" if stairs.direction == stairs.ASCENDING else "descending"
    railings = {(False, False): "no railing", (True, False): "railing left", (False, True): "railing right"}
    railing = railings.get((bool(stairs.railing_left), bool(stairs.railing_right)), "railings on both sides")
    return (
        f"stairway {stairs.track_id}: {kind}, {direction}, {stairs.num_nosings} steps, "
        f"height {1e3 * stairs.step_height_m:.0f} mm, depth {1e3 * stairs.step_depth_m:.0f} mm, "
        f"width {stairs.width_m:.2f} m, {railing}"
    )


def tidy(value_m):
    return round(value_m, 2) + 0.0  # -0.00 is 0.00


def plan(stairs):
    """Where to stand, in the frame `base` of the instant stairs.utime, and what to do there."""
    is_ascending = stairs.direction == stairs.ASCENDING
    # heading_rad is that of ascent; a robot that goes down walks against it.
    walk_rad = stairs.heading_rad if is_ascending else stairs.heading_rad + math.pi
    walk_rad = math.atan2(math.sin(walk_rad), math.cos(walk_rad))
    x_m = tidy(stairs.anchor_m[0] - STAND_OFF_M * math.cos(walk_rad))
    y_m = tidy(stairs.anchor_m[1] - STAND_OFF_M * math.sin(walk_rad))
    side = {stairs.LEFT: "the left", stairs.MIDDLE: "the middle", stairs.RIGHT: "the right"}[stairs.anchor_side]
    turn = f", turning {math.degrees(stairs.turn_per_step_rad):+.0f} deg a step" if stairs.kind == stairs.SPIRAL else ""
    return (
        f"go to ({x_m:.2f}, {y_m:.2f}) m, face {round(math.degrees(walk_rad))} deg, keep to {side} as seen while ascending, "
        f"walk {'up' if is_ascending else 'down'} {stairs.num_nosings} steps{turn}"
    )


def answer(message):
    """What to do about one message, line by line."""
    if time.time() - 1e-6 * message.utime > MAX_AGE_S:
        return [f"sweep {message.sweep} is too old to act on"]
    if not message.is_final:
        # Enough to walk towards them; the whole sweep may show more steps, and more of their width.
        return ["so far: " + describe(stairs) for stairs in message.stairways]
    if not message.stairways:
        reasons = ", ".join(rejection.reason for rejection in message.rejected) or "no candidate"
        return [f"sweep {message.sweep} shows no stairway: {reasons}"]
    lines = []
    for stairs in message.stairways:
        lines.append(describe(stairs))
        is_certain = max(stairs.step_height_sigma_m, stairs.step_depth_sigma_m) <= MAX_SIGMA_M
        lines.append("  " + (plan(stairs) if is_certain else "too uncertain to step on: go nearer and look again"))
    return lines


def main():
    parser = argparse.ArgumentParser(description="Says how a robot would walk to the stairways that stairwayd finds.")
    parser.add_argument("--url", default=os.environ.get("LCM_DEFAULT_URL", DEFAULT_URL), help="as lcm.url of stairwayd")
    parser.add_argument("--prefix", default="STAIRWAY_", help="as lcm.channel_prefix of stairwayd")
    parser.add_argument("--count", type=int, default=0, metavar="N", help="end after N whole sweeps")
    arguments = parser.parse_args()
    answers = 0
    for channel, data in Listener(arguments.url):
        if channel != arguments.prefix + "STAIRWAYS":
            continue
        try:
            message = stairway.stairways_t.decode(data)
        except ValueError:
            sys.exit(f"{channel} has another type here: install the stairway package of the stairwayd that sends")
        print(*answer(message), sep="\n", flush=True)
        answers += message.is_final
        if answers == arguments.count:
            return


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
