// SPDX-License-Identifier: Apache-2.0
// The pictures of one frame of a run: what the walls show, what the viewer sees, and how good it is.
#include "sim/run/run_draw.h"

#include <stdio.h>
#include <stdlib.h>

#include "sim/eval/viewer_picture.h"
#include "sim/files/png_file.h"
#include "sim/run/run_judge.h"

enum { LOOKS = 2 };

bool run_draw_viewer(image_t *viewer, const camera_t *camera)
{
    int32_t width = camera->width, height = camera->height;
    while (width > RUN_DRAW_VIEWER_WIDTH) {
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    const int32_t stride = width * (int32_t)IMAGE_XRGB8888;
    uint8_t *data = calloc((size_t)height, (size_t)stride);
    if (data == NULL)
        return false;
    *viewer = (image_t){data, width, height, stride, IMAGE_XRGB8888};
    return true;
}

bool run_draw_path(char path[RUN_DRAW_PATH_LENGTH], const char *folder, const char *name, int32_t frame,
                   char error[FILE_ERROR_LENGTH])
{
    const int length = snprintf(path, RUN_DRAW_PATH_LENGTH, "%s/%s_%05d.png", folder, name, frame);
    return (length >= 0 && length < RUN_DRAW_PATH_LENGTH) || file_error(error, folder, "the name is too long");
}

static bool write_numbered(const run_draw_config_t *config, const char *name, int32_t frame, const image_t *image,
                           char error[FILE_ERROR_LENGTH])
{
    char path[RUN_DRAW_PATH_LENGTH];
    return run_draw_path(path, config->folder, name, frame, error) && png_file_write(path, image, error);
}

static bool write_viewer(const run_draw_config_t *config, const run_job_t *job, const homography_t *homography,
                         const image_t *viewer, char error[FILE_ERROR_LENGTH])
{
    viewer_wall_t wall[ROOM_MAX_BOARDS];
    const int32_t boards = config->room->board_count;
    for (int32_t i = 0; i < boards; i++) {
        double_homography_from_fixed(&wall[i].homography, &homography[i]);
        wall[i].shown = job->shown[i];
    }
    viewer_picture(viewer, wall, boards, LOOKS);
    if (!write_numbered(config, "viewer", job->frame, viewer, error))
        return false;
    for (int32_t i = 0; i < boards; i++)
        wall[i].shown = job->picture;
    viewer_picture(viewer, wall, boards, LOOKS);
    return write_numbered(config, "uncompensated", job->frame, viewer, error);
}

static bool judge_walls(const run_draw_config_t *config, const run_job_t *job, const homography_t *homography,
                        run_psnr_t *psnr, int32_t *psnrs, char error[FILE_ERROR_LENGTH])
{
    for (int32_t i = 0; i < config->room->board_count; i++) {
        const run_judge_t wall = {&homography[i], &job->shown[i], &job->picture, config->original};
        run_psnr_t found = {.frame = job->frame, .board = i};
        if (!job->corrected[i])
            continue;
        if (!run_judge(&found, &wall, error))
            return false;
        if (found.coverage > 0)
            psnr[(*psnrs)++] = found;
    }
    return true;
}

bool run_draw(const run_draw_config_t *config, const run_job_t *job, const image_t *viewer, run_psnr_t *psnr,
              int32_t *psnrs, char error[FILE_ERROR_LENGTH])
{
    homography_t homography[ROOM_MAX_BOARDS];
    const room_t *room = config->room;
    *psnrs = 0;
    for (int32_t i = 0; i < room->board_count; i++)
        if (!write_numbered(config, room->board[i].name, job->frame, &job->shown[i], error))
            return false;
    if (!job->seen)
        return true;
    for (int32_t i = 0; i < room->board_count; i++)
        if (!homography_from_pose(&homography[i], &room->camera, &room->board[i].wall, &job->eye))
            return file_error(error, room->board[i].name, "the pose has no direction");
    return write_viewer(config, job, homography, viewer, error) &&
           (!job->judge || judge_walls(config, job, homography, psnr, psnrs, error));
}
