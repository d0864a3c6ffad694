// SPDX-License-Identifier: Apache-2.0
// What wallwarp-eval psnr measures on: the walls that one viewer sees, the picture, the truth, and its samples.
#include "sim/eval/psnr_scene.h"

#include <stdlib.h>
#include <string.h>

#include "sim/eval/eval_options.h"
#include "sim/files/png_file.h"

/* Where a channel is in its picture. */
typedef struct {
    char name[2];
    int format; /* which of the scene's pictures */
    int byte;   /* of a pixel */
} channel_t;

static const channel_t channels[PSNR_CHANNELS] = {{"Y", 0, 0}, {"R", 1, 2}, {"G", 1, 1}, {"B", 1, 0}};
static const image_format_t formats[PSNR_FORMATS] = {IMAGE_GRAY8, IMAGE_XRGB8888};

const char *psnr_channel_name(int32_t channel)
{
    return channels[channel].name;
}

static int32_t formats_of(const psnr_scene_t *scene)
{
    return channels[scene->channels - 1].format + 1;
}

/* The wall's panel, in the memory that all share. */
static image_t panel_of(const psnr_scene_t *scene, int32_t wall, int format)
{
    const homography_t *homography = &scene->wall[wall].homography;
    return (image_t){.data = scene->shown,
                     .width = homography->panel_width,
                     .height = homography->panel_height,
                     .stride = homography->panel_width * (int32_t)formats[format],
                     .format = formats[format]};
}

static int64_t square_error(const psnr_scene_t *scene, int32_t wall, int32_t channel)
{
    const image_t panel = panel_of(scene, wall, channels[channel].format);
    const image_t plane = mesh_channel(&panel, channels[channel].byte);
    return mesh_square_error(&scene->mesh[channel][wall], &plane);
}

static bool read_pictures(psnr_scene_t *scene, const psnr_options_t *options, char error[ROOM_MESSAGE_LENGTH])
{
    for (int f = 0; f < formats_of(scene); f++) {
        if (!warp_once_read(&scene->wall[0], options->picture, formats[f], &scene->picture[f], error))
            return false;
        scene->truth[f] = scene->picture[f];
        if (options->original != NULL && !png_file_load(options->original, formats[f], &scene->truth[f], error))
            return false;
    }
    return true;
}

static bool make_panel(psnr_scene_t *scene, char error[ROOM_MESSAGE_LENGTH])
{
    size_t most = 0;
    for (int32_t n = 0; n < scene->walls; n++) {
        const image_t panel = panel_of(scene, n, formats_of(scene) - 1);
        const size_t bytes = (size_t)panel.stride * (size_t)panel.height;
        most = bytes > most ? bytes : most;
    }
    scene->shown = calloc(most, 1);
    if (scene->shown == NULL)
        file_error(error, "panel", "out of memory");
    return scene->shown != NULL;
}

static bool sample(psnr_scene_t *scene, const psnr_options_t *options, char error[ROOM_MESSAGE_LENGTH])
{
    double_homography_t homography[ROOM_MAX_BOARDS];
    for (int32_t n = 0; n < scene->walls; n++)
        double_homography_from_fixed(&homography[n], &scene->wall[n].homography);
    for (int32_t c = 0; c < scene->channels; c++) {
        const image_t truth = mesh_channel(&scene->truth[channels[c].format], channels[c].byte);
        char reason[FILE_ERROR_LENGTH];
        if (!mesh_sample_walls(scene->mesh[c], homography, scene->walls, &truth, options->factor, reason))
            return file_error(error, options->original != NULL ? options->original : options->picture, "%s", reason);
        for (int32_t n = 0; n < scene->walls; n++) {
            const image_t panel = panel_of(scene, n, channels[c].format);
            const image_t plane = mesh_channel(&panel, channels[c].byte);
            mesh_limit(&scene->mesh[c][n], &plane);
            scene->limit_square_error[c][n] = mesh_square_error(&scene->mesh[c][n], &plane);
        }
    }
    return true;
}

warp_once_status_t psnr_scene_open(psnr_scene_t *scene, const psnr_options_t *options, const char *command)
{
    memset(scene, 0, sizeof *scene);
    scene->channels = options->channels ? PSNR_CHANNELS : 1;
    const warp_once_status_t opened = eval_open_walls(scene->wall, &scene->walls, &options->place, command);
    if (opened != WARP_ONCE_OK)
        return opened;
    char error[ROOM_MESSAGE_LENGTH];
    if (read_pictures(scene, options, error) && make_panel(scene, error) && sample(scene, options, error))
        return WARP_ONCE_OK;
    eval_error(command, "%s", error);
    return WARP_ONCE_FAILED;
}

void psnr_scene_close(psnr_scene_t *scene)
{
    for (int32_t c = 0; c < PSNR_CHANNELS; c++)
        for (int32_t n = 0; n < ROOM_MAX_BOARDS; n++)
            mesh_free(&scene->mesh[c][n]);
    for (int f = 0; f < PSNR_FORMATS; f++) {
        if (scene->truth[f].data != scene->picture[f].data)
            free(scene->truth[f].data);
        free(scene->picture[f].data);
    }
    free(scene->shown);
    warp_once_close(&scene->wall[0]);
}

/* The wall's errors in every channel; warps once per format. */
static bool measure_wall(psnr_scene_t *scene, const warp_method_t *method, int32_t wall, psnr_row_t *row)
{
    int warped = -1;
    for (int32_t c = 0; c < scene->channels; c++) {
        const int format = channels[c].format;
        const image_t panel = panel_of(scene, wall, format);
        if (method != NULL && format != warped &&
            !warp_once(&scene->wall[wall], method, &panel, &scene->picture[format]))
            return false;
        warped = format;
        const int64_t limit = scene->limit_square_error[c][wall];
        row[c] = (psnr_row_t){.method = psnr_method_name(method),
                              .square_error = method != NULL ? square_error(scene, wall, c) : limit,
                              .limit_square_error = limit,
                              .covered = scene->mesh[c][wall].covered,
                              .samples = scene->mesh[c][wall].samples,
                              .step = footprint_step(&scene->wall[wall].homography)};
    }
    return true;
}

bool psnr_scene_measure(psnr_scene_t *scene, const warp_method_t *method,
                        psnr_row_t row[ROOM_MAX_BOARDS][PSNR_CHANNELS])
{
    for (int32_t n = 0; n < scene->walls; n++)
        if (!measure_wall(scene, method, n, row[n]))
            return false;
    return true;
}
