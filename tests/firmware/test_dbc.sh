#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# An independent DBC reader decodes what the firmware encodes. usage: test_dbc.sh BUILD
exec /usr/bin/python3 tests/firmware/dbc_decodes_traffic.py "$1/tests/firmware/print_frames" \
    "$1/tests/firmware/print_reports"
