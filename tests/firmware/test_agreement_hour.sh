#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# An hour of eight projectors with faults, in virtual time; too long for the sanitizers. usage: test_agreement_hour.sh BUILD
set -eu
"$1/tests/firmware/agreement_hour"
