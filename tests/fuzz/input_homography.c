// SPDX-License-Identifier: Apache-2.0
// A homography out of a fuzzer's input.
#include "tests/fuzz/input_homography.h"

#include <string.h>

#include "warp_fixed/kernels.h"

enum { SMALL = 64, LARGEST = 160, PLAIN_SIZE = 20, GUARD_BYTE = 0xa5 };

_Static_assert((int)LARGEST > 2 * (int)PATCH_MAX_WIDTH, "panels have more than two tiles side by side");

/* 1 to LARGEST; mostly small, which is quick. */
static int32_t size_from_input(input_t *input, bool even)
{
    const uint8_t byte = input_byte(input);
    const int32_t size = byte < 192 ? 1 + (PLAIN_SIZE - 1 + byte) % SMALL : LARGEST - (UINT8_MAX - byte);
    return even ? (size + 1) & ~1 : size;
}

static int32_t moved(input_t *input, int64_t from, int bits)
{
    const int64_t limit = INT64_C(1) << 30;
    const int64_t at = from + input_number(input, bits);
    return (int32_t)(at > limit ? limit : at < -limit ? -limit : at);
}

static wall_corners_t measured_from_input(input_t *input, bool even)
{
    static const int32_t plain[4][3] = {
        {-1000000, -1000000}, {1000000, -1000000}, {1000000, 1000000}, {-1000000, 1000000}};
    wall_corners_t measured = {.panel_width = size_from_input(input, even),
                               .panel_height = size_from_input(input, even)};
    const uint8_t unknown = input_byte(input), markers = input_byte(input);
    for (int c = 0; c < 4; c++) {
        measured.corner_known[c] = !(unknown & 1 << c);
        for (int a = 0; a < 3; a++)
            measured.corner_um[c][a] = moved(input, plain[c][a], 31);
    }
    measured.marker_count = markers % 4;
    for (int m = 0; m < measured.marker_count; m++) {
        measured.marker[m].px_q16[0] = input_range(input, 0, measured.panel_width) * (1 << 16);
        measured.marker[m].px_q16[1] = input_range(input, 0, measured.panel_height) * (1 << 16);
        for (int a = 0; a < 3; a++)
            measured.marker[m].um[a] = moved(input, 0, 31);
    }
    return measured;
}

static camera_t camera_from_input(input_t *input, bool even)
{
    camera_t camera = {.width = size_from_input(input, even), .height = size_from_input(input, even)};
    for (int a = 0; a < 2; a++) {
        camera.focal_upx[a] = INT64_C(1000000) * PLAIN_SIZE + input_number(input, 36);
        if (camera.focal_upx[a] < 1)
            camera.focal_upx[a] = 1;
        camera.principal_upx[a] = INT64_C(500000) * PLAIN_SIZE + input_number(input, 36);
    }
    return camera;
}

/* By a wall, as the firmware does it. @return false when the wall or the pose is refused. */
static bool homography_by_wall(homography_t *homography, input_t *input, bool even)
{
    wall_t wall, untouched;
    memset(&wall, GUARD_BYTE, sizeof wall);
    memset(&untouched, GUARD_BYTE, sizeof untouched);
    const wall_corners_t measured = measured_from_input(input, even);
    if (wall_from_corners(&wall, &measured) != WALL_OK) {
        fuzz_check(memcmp(&wall, &untouched, sizeof wall) == 0, "a refused wall is untouched");
        return false;
    }
    fuzz_check(wall.rms_um >= 0 && wall.worst_um >= wall.rms_um && wall.marker_um >= 0, "residuals are in order");
    fuzz_check(wall.skew_mdeg >= 0 && wall.skew_mdeg <= 90000, "a skew is 0 to 90 degrees");
    const camera_t camera = camera_from_input(input, even);
    pose_t pose = {.eye_nm = {0, 0, -INT64_C(2000000000)}, .quaternion_q30 = {1 << 30}};
    for (int i = 0; i < 3; i++)
        pose.eye_nm[i] += input_number(input, 49);
    for (int i = 0; i < 4; i++)
        pose.quaternion_q30[i] = (int32_t)((uint32_t)pose.quaternion_q30[i] + (uint32_t)input_number(input, 32));
    return homography_from_pose(homography, &camera, &wall, &pose);
}

/*
 * By its nine numbers: any, also those that no wall gives; or gentle ones, most of which light many pixels, at any
 * angle and with edges of the picture anywhere on the panel.
 */
static void homography_by_numbers(homography_t *homography, input_t *input, input_homography_t kind)
{
    enum { ANY_BITS = 62 };
    static const int gentle_bits[3][3] = {{43, 43, 48}, {43, 43, 48}, {33, 33, 39}};
    int32_t panel[2], picture[2];
    int64_t rows_q40[3][3] = {{INT64_C(1) << 40, 0, 0}, {0, INT64_C(1) << 40, 0}, {0, 0, INT64_C(1) << 40}};
    for (int i = 0; i < 2; i++) {
        panel[i] = size_from_input(input, kind.even);
        picture[i] = size_from_input(input, kind.even);
    }
    for (int i = 0; i < 9; i++)
        rows_q40[i / 3][i % 3] += input_number(input, kind.gentle ? gentle_bits[i / 3][i % 3] : ANY_BITS);
    homography_from_indices(homography, (const int64_t(*)[3])rows_q40, panel, picture);
}

bool input_homography(homography_t *homography, input_t *input, input_homography_t kind)
{
    if (!kind.by_numbers)
        return homography_by_wall(homography, input, kind.even);
    homography_by_numbers(homography, input, kind);
    return true;
}
