// SPDX-License-Identifier: Apache-2.0
// `wallwarp-sim update`: play a room's update, in virtual time.
#ifndef SIM_UPDATE_UPDATE_COMMAND_H
#define SIM_UPDATE_UPDATE_COMMAND_H

/**
 * Play it: the time line and what the operator is told on stdout, update.csv and update.svg in a folder.
 *
 * @param argv  argv[0] is how the command names itself. Bad usage ends the program with status 2.
 * @return The exit status: 0 when it was played to its end, whatever that is; 1 after an error message.
 */
int update_command(int argc, char **argv);

#endif
