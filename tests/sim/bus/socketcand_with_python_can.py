#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Sends and hears frames through the simulator's socketcand door with python-can.

usage: socketcand_with_python_can.py PORT CHANNEL

Other traffic on the bus is left aside. Prints "N passed, N failed"; exit status 1 when one failed.
"""

import logging
import sys
import time
import traceback

import can

HEARING_S = 3.0
TEST_IDS = range(0x600, 0x700)


def open_bus(port, channel):
    return can.Bus(interface="socketcand", host="127.0.0.1", port=port, channel=channel)


def hear(bus, count, ids=TEST_IDS):
    """The next count frames with one of the ids, or as many as come in time."""
    heard = []
    end = time.monotonic() + HEARING_S
    while len(heard) < count and time.monotonic() < end:
        message = bus.recv(timeout=0.1)
        if message is not None and message.arbitration_id in ids:
            heard.append(message)
    return heard


def frame(identifier, data, extended=False):
    return can.Message(arbitration_id=identifier, data=data, is_extended_id=extended)


def test_every_length_arrives_unchanged(one, two):
    sent = [frame(0x600 + n, bytes(range(0x10, 0x10 + n))) for n in range(9)]
    for message in sent:
        one.send(message)
    heard = hear(two, 9)
    assert [(m.arbitration_id, bytes(m.data)) for m in heard] == [(m.arbitration_id, bytes(m.data)) for m in sent]


def test_extended_identifier_arrives(one, two):
    one.send(frame(0x1ABCDEF0, [1, 2, 3], extended=True))
    heard = hear(two, 1, [0x1ABCDEF0])
    assert len(heard) == 1 and bytes(heard[0].data) == b"\1\2\3"


def test_sender_does_not_hear_itself(one, two):
    one.send(frame(0x620, [1]))
    two.send(frame(0x621, [2]))
    assert [m.arbitration_id for m in hear(two, 1)] == [0x620]
    assert [m.arbitration_id for m in hear(one, 1)] == [0x621]


def test_time_stamps_follow_the_bus(one, two):
    one.send(frame(0x630, [1]))
    time.sleep(0.3)
    one.send(frame(0x631, [2]))
    first, second = hear(two, 2)
    assert 0.2 < second.timestamp - first.timestamp < 2.0, (first.timestamp, second.timestamp)


def test_reader_that_lags_behind_misses_nothing(one, two):
    """More than python-can reads at once is waiting, so that its reads cut frames in two."""
    numbers = list(range(400))
    for n in numbers:
        one.send(frame(0x640, n.to_bytes(2, "big") + bytes(6)))
    time.sleep(0.5)
    heard = [int.from_bytes(m.data[:2], "big") for m in hear(two, len(numbers))]
    assert heard == numbers, f"{len(heard)} heard, missing {sorted(set(numbers) - set(heard))[:5]}"


def test_connecting_to_a_busy_bus(one, two, port, channel):
    for attempt in range(20):
        one.send(frame(0x650, [attempt]))
        open_bus(port, channel).shutdown()


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    logging.getLogger("can").setLevel(logging.ERROR)  # it warns of each frame that a read cuts in two
    port, channel = int(sys.argv[1]), sys.argv[2]
    tests = [
        test_every_length_arrives_unchanged,
        test_extended_identifier_arrives,
        test_sender_does_not_hear_itself,
        test_time_stamps_follow_the_bus,
        test_reader_that_lags_behind_misses_nothing,
        lambda one, two: test_connecting_to_a_busy_bus(one, two, port, channel),
    ]
    failed = 0
    for test in tests:
        one = two = None
        try:
            one, two = open_bus(port, channel), open_bus(port, channel)
            test(one, two)
        except Exception:  # a test's own failure or the bus's: both are told, the others go on
            failed += 1
            traceback.print_exc()
        finally:
            for bus in (one, two):
                if bus is not None:
                    bus.shutdown()
    print(f"{len(tests) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
