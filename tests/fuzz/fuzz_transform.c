// SPDX-License-Identifier: Apache-2.0
// Fuzzes transform files: what is accepted moves poses rigidly, what is refused says where and why.
#include "sim/trackers/transform.h"

#include <math.h>
#include <string.h>

#include "tests/fuzz/input.h"

enum { UNTOUCHED = 0xA5 };

static void check_axes(const double axis[3][3])
{
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b <= a; b++) {
            const double product = axis[a][0] * axis[b][0] + axis[a][1] * axis[b][1] + axis[a][2] * axis[b][2];
            fuzz_check(fabs(product - (a == b)) < 1e-9, "axes are at right angles and of unit length");
        }
    }
}

static void check_accepted(const tracker_transform_t *transform)
{
    const tracker_pose_t pose = {.position = {1, 2, 3}, .quaternion = {0.5, 0.5, -0.5, 0.5}};
    fuzz_check(transform->viewers >= 1 && transform->viewers <= CAN_VIEWERS, "one to four viewers");
    fuzz_check(transform->latency_us >= 0 && transform->latency_us <= 1000000, "the latency is in its range");
    fuzz_check(transform->tracker <= 15, "the tracker is in its range");
    check_axes(transform->room_axis);
    for (int v = 0; v < transform->viewers; v++) {
        pose_t out;
        check_axes(transform->viewer[v].camera_axis);
        fuzz_check(transform->viewer[v].viewer < CAN_VIEWERS, "the viewer is in its range");
        fuzz_check(tracker_transform_viewer(transform, transform->viewer[v].body) == &transform->viewer[v],
                   "every body has one viewer");
        if (!tracker_transform_apply(transform, &transform->viewer[v], 1.0, &pose, &out))
            continue;
        double length = 0.0;
        for (int i = 0; i < 4; i++)
            length = hypot(length, out.quaternion_q30[i] / 1073741824.0);
        fuzz_check(fabs(length - 1.0) < 1e-6, "the turn is one");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tracker_transform_t transform;
    char error[ROOM_MESSAGE_LENGTH] = "";
    const input_file_t file = input_file_open(data, size);
    memset(&transform, UNTOUCHED, sizeof transform);
    if (tracker_transform_load(&transform, file.path, error)) {
        check_accepted(&transform);
    } else {
        const uint8_t *byte = (const uint8_t *)&transform;
        for (size_t i = 0; i < sizeof transform; i++)
            fuzz_check(byte[i] == UNTOUCHED, "a refused file leaves the transform untouched");
        fuzz_check_line(error);
    }
    input_file_close(&file);
    return 0;
}
