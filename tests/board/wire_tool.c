// SPDX-License-Identifier: Apache-2.0
// Frames of the virtual board's tests: a pose for can-utils' cansend, and what a board reports in a log of candump.
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "firmware/can_e2e.h"
#include "firmware/can_latency.h"
#include "firmware/can_update.h"
#include "sim/bus/candump_text.h"
#include "sim/pose/motion.h"
#include "sim/pose/pose_frames.h"
#include "sim/pose/pose_text.h"

static const char USAGE[] =
    "usage: wire_tool frames POSE fd|classic   the pose with each counter once, a frame a line, as cansend takes it\n"
    "       wire_tool reports <LOG             of candump -L: what the one board in it says of its time\n"
    "       wire_tool updates <LOG             what it says of its update, a line for each change; then the frames "
    "that it\n"
    "                                          has shown and its faults, as its Heartbeat had them last\n";

static int fail(const char *error)
{
    fprintf(stderr, "wire_tool: %s\n", error);
    return 2;
}

static void print_for_cansend(const hal_can_frame_t *frame)
{
    char text[CANDUMP_TEXT_LENGTH];
    (void)candump_text_from_frame(text, frame, "");
    puts(strrchr(text, ' ') + 1);
}

/* As many as the counter has values, so that who sends them again and again sends nothing stale. */
static int print_frames(const char *text, bool fd)
{
    const int count = fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS;
    char error[POSE_TEXT_MESSAGE_LENGTH];
    motion_t still = {.kind = MOTION_STILL, .rate_hz = 1.0, .duration_s = 1.0};
    pose_list_t list;
    if (!pose_from_text(text, &still.start, error))
        return fail(error);
    if (!motion_make(&list, &still))
        return fail("out of memory");
    const can_pose_t pose = {.pose = list.entry[0].pose, .quality = CAN_POSE_TRACKED};
    pose_list_free(&list);
    for (int i = 0; i < count; i++) {
        hal_can_frame_t frame[CAN_POSE_PARTS];
        const int frames = pose_frames(frame, &pose, fd, (uint64_t)i);
        if (frames == 0)
            return fail("the pose does not fit its message");
        for (int k = 0; k < frames; k++)
            print_for_cansend(&frame[k]);
    }
    return 0;
}

/* Sums over the log. */
typedef struct {
    int64_t corrected_us; /**< of the first status that tells of a corrected picture; 0: none */
    struct {
        int64_t mean_us, worst_us;
        int32_t count;
    } stage[STAGES];
    int64_t photon_us;
    int32_t photons, heartbeats;
    uint32_t first_frame, last_frame; /* numbers, of the heartbeats; modulo 2^16 */
    uint32_t late, fault_flags;
} reports_t;

static void take_report(reports_t *all, const hal_can_frame_t *frame)
{
    can_status_t status;
    can_stage_t stage;
    can_latency_t latency;
    can_heartbeat_t heartbeat;
    if (all->corrected_us == 0 && can_status_decode(&status, frame) == CAN_CHECK_OK && status.step_q8 > 0)
        all->corrected_us = frame->time_us;
    if (can_stage_decode(&stage, frame) == CAN_CHECK_OK) {
        all->stage[stage.stage].mean_us += stage.mean_us;
        all->stage[stage.stage].count++;
        if (stage.worst_us > all->stage[stage.stage].worst_us)
            all->stage[stage.stage].worst_us = stage.worst_us;
        if (stage.stage == STAGE_POSE)
            all->late += stage.late;
    }
    if (can_latency_decode(&latency, frame) == CAN_CHECK_OK && latency.photon_us > 0) {
        all->photon_us += latency.photon_us;
        all->photons++;
    }
    if (can_heartbeat_decode(&heartbeat, frame) == CAN_CHECK_OK) {
        all->fault_flags |= heartbeat.fault_flags;
        all->last_frame = heartbeat.frame_number;
        if (all->heartbeats++ == 0)
            all->first_frame = heartbeat.frame_number;
    }
}

static void print_reports(const reports_t *all)
{
    static const char *const name[STAGES] = {"pose", "warp", "show", "wait"};
    printf("corrected_us %" PRId64 "\nframes %" PRIu32 "\nlate %" PRIu32 "\nfault_flags %" PRIu32 "\n",
           all->corrected_us, (all->last_frame - all->first_frame) & UINT16_MAX, all->late, all->fault_flags);
    for (int i = 0; i < STAGES; i++)
        if (all->stage[i].count > 0)
            printf("%s_mean_us %" PRId64 "\n%s_worst_us %" PRId64 "\n", name[i],
                   all->stage[i].mean_us / all->stage[i].count, name[i], all->stage[i].worst_us);
    if (all->photons > 0)
        printf("photon_us %" PRId64 "\n", all->photon_us / all->photons);
}

static int sum_reports(FILE *log)
{
    char line[CANDUMP_TEXT_LENGTH], interface[CANDUMP_INTERFACE_LENGTH];
    reports_t all = {.corrected_us = 0};
    hal_can_frame_t frame;
    while (fgets(line, sizeof line, log) != NULL) {
        const char *expected = candump_frame_from_text(&frame, interface, line);
        if (expected != NULL)
            return fail(expected);
        take_report(&all, &frame);
    }
    print_reports(&all);
    return 0;
}

static bool same_words(const can_update_t *a, const can_update_t *b)
{
    return a->state == b->state && a->slot == b->slot && a->trial == b->trial && a->plan == b->plan;
}

static int print_updates(FILE *log)
{
    static const char *const slot[] = {"-", "A", "B"}, *const plan[] = {"no", "promised", "confirmed"};
    char line[CANDUMP_TEXT_LENGTH], interface[CANDUMP_INTERFACE_LENGTH];
    can_heartbeat_t heartbeat = {.node = 0};
    can_update_t update, told = {.state = CAN_UPDATE_STATES};
    hal_can_frame_t frame;
    while (fgets(line, sizeof line, log) != NULL) {
        const char *expected = candump_frame_from_text(&frame, interface, line);
        if (expected != NULL)
            return fail(expected);
        if (can_heartbeat_decode(&heartbeat, &frame) == CAN_CHECK_OK ||
            can_update_decode(&update, &frame) != CAN_CHECK_OK || same_words(&update, &told))
            continue;
        told = update;
        printf("%s %s %s %s %" PRIu32 " 0x%03" PRIx32 "\n", can_update_state_name(update.state), slot[update.slot],
               update.trial ? "trial" : "good", plan[update.plan], heartbeat.frame_number, heartbeat.fault_flags);
    }
    return 0;
}

int main(int argc, char **argv)
{
    const bool fd = argc == 4 && strcmp(argv[3], "fd") == 0;
    if (argc == 4 && strcmp(argv[1], "frames") == 0 && (fd || strcmp(argv[3], "classic") == 0))
        return print_frames(argv[2], fd);
    if (argc == 2 && strcmp(argv[1], "reports") == 0)
        return sum_reports(stdin);
    if (argc == 2 && strcmp(argv[1], "updates") == 0)
        return print_updates(stdin);
    fputs(USAGE, stderr);
    return 2;
}
