// SPDX-License-Identifier: Apache-2.0
// The commands of wallwarp-pose, each with its own options; see `wallwarp-pose --help`.
#ifndef SIM_POSE_COMMANDS_H
#define SIM_POSE_COMMANDS_H

#include <signal.h>
#include <stdbool.h>

/**
 * Run one command. Bad usage ends the program with status 2.
 *
 * @param argv  argv[0] is how the command names itself in messages, such as "wallwarp-pose send".
 * @return The program's exit status.
 */
int command_send(int argc, char **argv);
int command_bridge(int argc, char **argv);
int command_record(int argc, char **argv);
int command_replay(int argc, char **argv);
int command_monitor(int argc, char **argv);
int command_check(int argc, char **argv);
int command_fault(int argc, char **argv);
int command_command(int argc, char **argv);
int command_update(int argc, char **argv);

/** From now on SIGINT and SIGTERM set the flag instead of ending the program. @return The flag. */
const volatile sig_atomic_t *command_catch_stop(void);

#endif
