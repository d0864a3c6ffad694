# SPDX-License-Identifier: Apache-2.0
# How the board "host" is built: for this machine, with the simulator's devices.
HAL := sim
