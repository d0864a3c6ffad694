#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Decodes what the firmware's encoders make by means of wallwarp.dbc, with canmatrix, and compares every signal.

usage: dbc_decodes_traffic.py PROGRAM...    programs that print frames: see print_frame.h
"""
import decimal
import subprocess
import sys

import canmatrix
import canmatrix.formats


class Tally:
    def __init__(self):
        self.passed = 0
        self.failed = 0

    def check(self, what, found, expected):
        if found == expected:
            self.passed += 1
        else:
            self.failed += 1
            print(f"FAILED {what}: found {found}, expected {expected}")


def crc(data, width, polynomial, start):
    """Not reflected, no final xor."""
    value = start
    for byte in data:
        value ^= byte << (width - 8)
        for _ in range(8):
            value <<= 1
            if value >> width:
                value ^= 1 << width | polynomial
    return value


def expected_crc(profile, data_id, data):
    identity = bytes([data_id & 0xFF, data_id >> 8])
    if profile == 1:
        return crc(identity + data[1:], 8, 0x1D, 0x00)
    return crc(data[2:32] + identity, 16, 0x1021, 0xFFFF)


def read_frames(program):
    """[(message, identifier, fd, cycle in ms, data, {signal: value}, {signal: name of the value})]: a program's."""
    frames = []
    for line in subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines():
        kind, *words = line.split()
        if kind == "frame":
            name, identifier, fd, cycle, data = words
            frames.append((name, int(identifier), fd == "1", int(cycle), bytes.fromhex(data), {}, {}))
        elif kind == "named":
            frames[-1][6][words[0]] = words[1]
        else:
            frames[-1][5][words[0]] = decimal.Decimal(words[1])
    return frames


def check_layout(tally, message):
    """Every bit of the message belongs to exactly one signal."""
    owners = [0] * (8 * message.size)
    for signal in message.signals:
        tally.check(f"{message.name}.{signal.name} byte order", signal.is_little_endian, True)
        start = signal.get_startbit()
        for bit in range(start, start + signal.size):
            owners[bit] += 1
    tally.check(f"{message.name}: signals per bit", set(owners), {1})


def check_frame(tally, message, frame):
    name, identifier, fd, cycle, data, signals, names = frame
    tally.check(f"{name} identifier", message.arbitration_id.id, identifier)
    tally.check(f"{name} extended", bool(message.arbitration_id.extended), False)
    tally.check(f"{name} length", message.size, len(data))
    tally.check(f"{name} FD", bool(message.is_fd), fd)
    tally.check(f"{name} cycle time", int(message.cycle_time), cycle)
    profile = int(message.attribute("E2EProfile"))
    tally.check(f"{name} E2E profile", profile, 5 if fd else 0 if name.endswith("Code") else 1)
    if profile != 0:
        signals[f"{name}Crc"] = decimal.Decimal(expected_crc(profile, int(message.attribute("E2EDataId")), data))

    decoded = message.decode(data)
    tally.check(f"{name} signals", sorted(decoded), sorted(signals))
    for signal, value in signals.items():
        if signal not in decoded:
            continue
        described = message.signal_by_name(signal)
        tally.check(f"{name}.{signal}", decimal.Decimal(str(decoded[signal].phys_value)), value)
        tally.check(f"{name}.{signal} in its range", described.min <= value <= described.max, True)
    for signal, text in names.items():
        tally.check(f"{name}.{signal} name", decoded[signal].named_value, text)


def main():
    if len(sys.argv) < 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    matrix = canmatrix.formats.loadp_flat("firmware/wallwarp.dbc")
    frames = [frame for program in sys.argv[1:] for frame in read_frames(program)]
    tally = Tally()
    tally.check("messages", sorted({frame[0] for frame in frames}), sorted(message.name for message in matrix.frames))
    for message in matrix.frames:
        check_layout(tally, message)
    for frame in frames:
        message = matrix.frame_by_name(frame[0])
        if message is not None:
            check_frame(tally, message, frame)
    print(f"{tally.passed} passed, {tally.failed} failed")
    return 1 if tally.failed else 0


if __name__ == "__main__":
    sys.exit(main())
