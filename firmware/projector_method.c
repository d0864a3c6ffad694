// SPDX-License-Identifier: Apache-2.0
// Which method makes the next picture: the board's own, or one that this board has the time for.
#include "firmware/projector.h"

void projector_begin_ladder(projector_t *projector)
{
    ladder_t *ladder = &projector->ladder;
    for (int32_t step = 1; step < ladder->steps; step++)
        if (!warp_has_method(&projector->warp, *ladder->method[step]))
            ladder->steps = step;
    degrade_init(&projector->degrade, projector->keeps_method ? 1 : ladder->steps);
    warp_use_method(&projector->warp, *ladder->method[0]);
}

void projector_keep_method(projector_t *projector)
{
    projector->keeps_method = true;
    degrade_init(&projector->degrade, 1);
}

void projector_choose_method(projector_t *p, int64_t time_us)
{
    const int64_t *us = p->report.times.us;
    const int32_t panel_pixels = p->wall.panel_width * p->wall.panel_height;
    if (!p->report.corrected || !p->report.times.shown ||
        p->report.warp.lit_pixels < panel_pixels / PROJECTOR_JUDGED_LIT)
        return;
    if (ladder_needs_step(&p->ladder))
        warp_report_step(&p->warp, &p->report.warp);
    const ladder_frame_t work = {
        .lit_pixels = p->report.warp.lit_pixels,
        .picture_pixels = p->camera.width * p->camera.height,
        .k_q16 = p->warp.step_all ? p->report.warp.k_all_q16 : p->report.warp.k_in_q16,
    };
    degrade_frame_t frame = {
        .busy_us = us[STAGE_POSE] + us[STAGE_WARP] + us[STAGE_SHOW],
        .warp_us = us[STAGE_WARP],
        .time_us = time_us,
        .late = p->report.times.late,
    };
    for (int32_t step = 0; step < p->degrade.steps; step++)
        frame.cost[step] = ladder_cost(p->ladder.method[step], &work);
    const int32_t before = p->degrade.step;
    if (degrade_next(&p->degrade, &frame) != before)
        warp_use_method(&p->warp, *p->ladder.method[p->degrade.step]);
}
