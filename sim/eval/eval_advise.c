// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval advise: which method suits each wall of a room.
#include "sim/eval/eval_advise.h"

#include <stdlib.h>
#include <unistd.h>

#include "sim/eval/advice_print.h"
#include "sim/eval/advise_options.h"
#include "sim/eval/eval_options.h"
#include "sim/program.h"

/* All that a run needs to know. */
typedef struct {
    advise_options_t options;
    room_t room;
    wall_place_t wall[ROOM_MAX_BOARDS];
    double eye_mm[ADVISE_MAX_AREAS * WALK_PLACES][3];
    advice_walk_t walk;
    double at_eye_mm; /* along the way up */
    wall_advice_t advice;
    int32_t board; /* at work */
} run_t;

/* Fill in what the command line leaves open, and the places. */
static void plan(run_t *run)
{
    advise_options_t *options = &run->options;
    const int32_t walls = run->room.board_count;
    for (int32_t n = 0; n < walls; n++)
        wall_place(&run->wall[n], &run->room.board[n].wall);
    if (options->up.sign == 0)
        options->up = walk_up(run->wall, walls);
    if (options->areas == 0)
        options->area[options->areas++] = walk_area(run->wall, walls, options->up);
    run->at_eye_mm = walk_eye_mm(run->wall, walls, options->up, options->height_mm);
    run->walk = (advice_walk_t){.camera = &run->room.camera, .eye_mm = run->eye_mm};
    run->walk.up[options->up.axis] = options->up.sign;
    for (int32_t a = 0; a < options->areas; a++)
        for (int32_t place = 0; place < WALK_PLACES; place++)
            walk_place(run->eye_mm[run->walk.eyes++], &options->area[a], options->up, run->at_eye_mm, place);
}

static void print_plan(const run_t *run)
{
    static const char *const level[3][2] = {{"y", "z"}, {"x", "z"}, {"x", "y"}};
    static const char *const axis[3] = {"x", "y", "z"};
    const advise_options_t *options = &run->options;
    printf("%s: up is %s; the viewer's eye is at %s = %.0f mm", options->room, walk_up_name(options->up),
           axis[options->up.axis], run->at_eye_mm);
    for (int32_t a = 0; a < options->areas; a++)
        printf("%s %s %.0f to %.0f, %s %.0f to %.0f mm", a == 0 ? " and walks" : " and", level[options->up.axis][0],
               options->area[a].low_mm[0], options->area[a].high_mm[0], level[options->up.axis][1],
               options->area[a].low_mm[1], options->area[a].high_mm[1]);
    putchar('\n');
}

static void show_progress(void *context, const wall_advice_t *advice, int32_t method)
{
    const run_t *run = context;
    fprintf(stderr, "\r\033[Kboard %d of %d, %s: %s", run->board + 1, run->room.board_count, advice->board->name,
            warp_methods[method].name);
}

static bool advise_wall(run_t *run, bool terminal)
{
    wall_advice_t *advice = &run->advice;
    if (!wall_advice_survey(advice, &run->room.board[run->board], &run->walk))
        return false;
    advice_print_warnings(stderr, advice);
    const bool ok = wall_advice_measure(advice, &run->room.camera, terminal ? show_progress : NULL, run);
    if (terminal)
        fputs("\r\033[K", stderr);
    if (ok && run->options.csv)
        advice_print_csv(stdout, advice);
    else if (ok)
        advice_print_table(stdout, advice);
    return ok;
}

static int advise(run_t *run, const char *command)
{
    char error[ROOM_MESSAGE_LENGTH];
    if (!room_load(&run->room, run->options.room, program_warn, NULL, error)) {
        eval_error(command, "%s", error);
        return PROGRAM_FAILED;
    }
    plan(run);
    if (run->options.csv)
        advice_print_csv_header(stdout);
    else
        print_plan(run);
    for (run->board = 0; run->board < run->room.board_count; run->board++)
        if (!advise_wall(run, isatty(STDERR_FILENO) == 1)) {
            eval_error(command, "board %s: out of memory", run->room.board[run->board].name);
            return PROGRAM_FAILED;
        }
    return program_finish(command);
}

int eval_advise(int argc, char **argv)
{
    run_t *run = calloc(1, sizeof *run);
    if (run == NULL) {
        eval_error(argv[0], "out of memory");
        return PROGRAM_FAILED;
    }
    advise_options_parse(&run->options, argc, argv);
    const int status = advise(run, argv[0]);
    free(run);
    return status;
}
