// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval: measures the grid and the quality of the methods.
#include <argp.h>
#include <string.h>

#include "sim/eval/eval_advise.h"
#include "sim/eval/eval_grid.h"
#include "sim/eval/eval_psnr.h"
#include "sim/eval/eval_study.h"
#include "sim/program.h"

typedef int command_fn(int argc, char **argv);

typedef struct {
    char name[8];
    char full_name[24]; /* as its help and its errors call it */
    command_fn *run;
} command_t;

static command_t *command_named(const char *name)
{
    static command_t commands[] = {
        {"grid", "wallwarp-eval grid", eval_grid},
        {"psnr", "wallwarp-eval psnr", eval_psnr},
        {"study", "wallwarp-eval study", eval_study},
        {"advise", "wallwarp-eval advise", eval_advise},
    };
    for (size_t c = 0; c < sizeof commands / sizeof *commands; c++)
        if (strcmp(commands[c].name, name) == 0)
            return &commands[c];
    return NULL;
}

typedef struct {
    command_t *command;
    int at; /* its word in argv */
} chosen_t;

static error_t parse(int key, char *argument, struct argp_state *state)
{
    chosen_t *chosen = state->input;
    switch (key) {
    case ARGP_KEY_ARG:
        chosen->command = command_named(argument);
        if (chosen->command == NULL)
            argp_error(state, "'%s' is no command, expected grid, psnr, study or advise", argument);
        chosen->at = state->next - 1;
        state->next = state->argc; /* the rest is the command's */
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "a command is missing, expected grid, psnr, study or advise");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    static const struct argp argp = {
        .parser = parse,
        .args_doc = "grid ROOM ...\npsnr ROOM ...\nstudy --out DIR\nadvise ROOM",
        .doc = "Measure the grid and the quality of the methods.\v"
               "grid    where projector pixels fall in the viewer's picture\n"
               "psnr    how well each method's walls match the picture\n"
               "study   the paper's figures again, on one page\n"
               "advise  which method suits each wall of a room\n\n"
               "'wallwarp-eval COMMAND --help' tells more. Exit status: 0 done, 1 failed, 2 bad usage.",
    };
    argp_err_exit_status = PROGRAM_BAD_USAGE;
    chosen_t chosen = {0};
    argp_parse(&argp, argc, argv, ARGP_IN_ORDER, NULL, &chosen);
    char **words = argv + chosen.at;
    words[0] = chosen.command->full_name;
    return chosen.command->run(argc - chosen.at, words);
}
