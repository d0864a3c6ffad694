// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval psnr: the paper's mesh evaluation of methods, as CSV.
#include "sim/eval/eval_psnr.h"

#include <stdlib.h>
#include <string.h>

#include "sim/eval/eval_options.h"
#include "sim/eval/psnr_options.h"
#include "sim/eval/psnr_scene.h"
#include "sim/program.h"

static const char view_name[] = "view";

/* Every channel of one board, or of the whole view. The header is printed before the first. */
static void print_channels(const psnr_scene_t *scene, const char *board, psnr_row_t row[PSNR_CHANNELS], bool header)
{
    for (int32_t c = 0; c < scene->channels; c++) {
        row[c].board = board;
        row[c].channel = scene->channels > 1 ? psnr_channel_name(c) : NULL;
        if (header && c == 0)
            psnr_row_print_header(stdout, &row[0]);
        psnr_row_print(stdout, &row[c]);
    }
}

static void print_view(const psnr_scene_t *scene, psnr_row_t row[ROOM_MAX_BOARDS][PSNR_CHANNELS])
{
    psnr_row_t view[PSNR_CHANNELS];
    for (int32_t c = 0; c < scene->channels; c++) {
        view[c] = row[0][c];
        for (int32_t n = 1; n < scene->walls; n++)
            psnr_row_add(&view[c], &row[n][c]);
    }
    print_channels(scene, view_name, view, false);
}

static int print_rows(psnr_scene_t *scene, const psnr_options_t *options, const char *command)
{
    const bool one_board = options->place.board != NULL;
    for (int m = 0; m < options->method_count; m++) {
        psnr_row_t row[ROOM_MAX_BOARDS][PSNR_CHANNELS];
        if (!psnr_scene_measure(scene, options->method[m], row)) {
            eval_error(command, "warp_frame refused the sizes");
            return WARP_ONCE_FAILED;
        }
        for (int32_t n = 0; n < scene->walls; n++)
            print_channels(scene, one_board ? NULL : scene->wall[n].board.name, row[n], m == 0 && n == 0);
        if (!one_board)
            print_view(scene, row);
    }
    return program_finish(command);
}

/* The row of the whole view must be the only one of its name. */
static bool names_are_free(const psnr_scene_t *scene, const psnr_options_t *options, const char *command)
{
    for (int32_t n = 0; options->place.board == NULL && n < scene->walls; n++)
        if (strcmp(scene->wall[n].board.name, view_name) == 0) {
            eval_error(command,
                       "%s: a board is named '%s', as is the row of the whole view; expected --board or "
                       "another name",
                       options->place.room, view_name);
            return false;
        }
    return true;
}

int eval_psnr(int argc, char **argv)
{
    psnr_options_t options;
    psnr_options_parse(&options, argc, argv);
    psnr_scene_t *scene = malloc(sizeof *scene);
    if (scene == NULL) {
        eval_error(argv[0], "out of memory");
        return WARP_ONCE_FAILED;
    }
    int status = (int)psnr_scene_open(scene, &options, argv[0]);
    if (status == WARP_ONCE_OK)
        status = names_are_free(scene, &options, argv[0]) ? print_rows(scene, &options, argv[0]) : WARP_ONCE_FAILED;
    psnr_scene_close(scene);
    free(scene);
    return status;
}
