// SPDX-License-Identifier: Apache-2.0
// Bus time: the line, its growing-memory filter, and what is read off it.
#include "firmware/bus_time.h"

#include "warp_fixed/fixed.h"

enum {
    ONE_Q12 = 1 << 12,
    SPREAD_MEMORY = 128,
    BEGIN_SPREAD_US = 50,   /* of an own clock, should it have to follow later */
    FIRST_SPREAD_US = 250,  /* until pairs have shown it */
    LEAST_LIMIT_US = 50,    /* how far a pair may count, when stamps hardly scatter */
    LEAST_APART_US = 60000, /* pairs nearer to each other say little of the rate */
    FLOOR_US = 2,           /* stamps are whole microseconds */
    WANDER_PPM = 1
};

static const int64_t FARTHEST_US = INT64_C(1) << 41;
static const int64_t MAX_RATE_Q32 = (INT64_C(1) << 32) / 1000000 * BUS_TIME_MAX_PPM;

static int64_t limited(int64_t value, int64_t limit)
{
    return value > limit ? limit : value < -limit ? -limit : value;
}

/* |rate| < 2^22 and |apart| <= 2^41: fits. */
static int64_t drifted_q12(const bus_time_t *time, int64_t apart_us)
{
    return time->rate_q32 * limited(apart_us, FARTHEST_US) / (INT64_C(1) << 20);
}

/* |offset| < 2^51 us and a bit: fits in Q12. */
static int64_t offset_q12_at(const bus_time_t *time, int64_t local_us)
{
    return time->offset_q12 + drifted_q12(time, local_us - time->local_us);
}

static int64_t rounded_us(int64_t q12)
{
    return (q12 + (q12 < 0 ? -ONE_Q12 / 2 : ONE_Q12 / 2)) / ONE_Q12;
}

void bus_time_begin(bus_time_t *time, int64_t local_us, int64_t bus_us)
{
    *time = (bus_time_t){.known = true,
                         .local_us = local_us,
                         .offset_q12 = (bus_us - local_us) * ONE_Q12,
                         .paired_us = local_us,
                         .locked = true,
                         .pairs = BUS_TIME_MEMORY,
                         .spread_q12 = BEGIN_SPREAD_US * ONE_Q12,
                         .relocks = time->relocks + time->known};
}

static void find_anew(bus_time_t *time)
{
    time->locked = false;
    time->pairs = time->run = time->strays = 0;
}

static int64_t median_of_first(bus_time_t *time)
{
    for (int i = 1; i < BUS_TIME_MEDIAN; i++)
        for (int k = i; k > 0 && time->first[k] < time->first[k - 1]; k--) {
            const int64_t larger = time->first[k - 1];
            time->first[k - 1] = time->first[k];
            time->first[k] = larger;
        }
    return time->first[BUS_TIME_MEDIAN / 2];
}

/* The first pairs: the rate is still that of the line before, or 0, which costs no more than 0.3 ms here. */
static void find(bus_time_t *time, int64_t local_us, int64_t bus_us)
{
    time->first[time->pairs++] = bus_us - local_us;
    time->paired_us = local_us;
    if (time->pairs < BUS_TIME_MEDIAN)
        return;
    time->relocks += time->known;
    time->known = true;
    time->local_us = local_us;
    time->offset_q12 = median_of_first(time) * ONE_Q12;
    time->spread_q12 = FIRST_SPREAD_US * ONE_Q12;
}

/* Nearly six deviations of a line through that many pairs, a deviation being 1.25 of the spread: 14 spread / sqrt(n).
 */
static int64_t line_error_us(const bus_time_t *time)
{
    const int64_t root_q4 = floor_sqrt((uint64_t)time->pairs << 8);
    return FLOOR_US + time->spread_q12 * INT64_C(224) / (root_q4 * ONE_Q12);
}

/* Shorten the memory when pairs stay on one side, which scatter would not do. */
static void watch_side(bus_time_t *time, int64_t distance_q12)
{
    const int32_t side = (distance_q12 > 0) - (distance_q12 < 0);
    time->run = side * time->run > 0 ? time->run + side : side;
    if (time->run != BUS_TIME_RUN_PAIRS && time->run != -BUS_TIME_RUN_PAIRS)
        return;
    time->run = 0;
    time->pairs = time->pairs / 4 > BUS_TIME_LEAST_PAIRS ? time->pairs / 4 : BUS_TIME_LEAST_PAIRS;
}

static void fit(bus_time_t *time, int64_t local_us, int64_t distance_q12)
{
    const int64_t limit_q12 = time->spread_q12 * INT64_C(3) + LEAST_LIMIT_US * ONE_Q12;
    const int64_t counted_q12 = limited(distance_q12, limit_q12);
    const int64_t size_q12 = counted_q12 < 0 ? -counted_q12 : counted_q12;
    time->pairs += time->pairs < BUS_TIME_MEMORY;
    const int64_t n = time->pairs, apart_us = local_us - time->local_us;
    const int64_t learnt = n - BUS_TIME_MEDIAN < SPREAD_MEMORY ? n - BUS_TIME_MEDIAN : SPREAD_MEMORY;
    time->spread_q12 += (int32_t)((size_q12 - time->spread_q12) / learnt);

    time->offset_q12 = offset_q12_at(time, local_us) + counted_q12 * 2 * (2 * n - 1) / (n * (n + 1));
    const int64_t apart = apart_us > LEAST_APART_US ? apart_us : LEAST_APART_US;
    const int64_t turned = counted_q12 * (6 << 20) / (n * (n + 1)) / apart; /* |counted| < 2^23: fits */
    time->rate_q32 = limited(time->rate_q32 + turned, MAX_RATE_Q32);
    time->local_us = local_us;
    time->paired_us = local_us;
    watch_side(time, distance_q12);
}

void bus_time_pair(bus_time_t *time, int64_t local_us, int64_t bus_us)
{
    if ((time->pairs > 0 || time->known) && local_us <= time->paired_us)
        return;
    if (local_us - time->paired_us > BUS_TIME_SILENT_US && bus_time_error_us(time, local_us) > BUS_TIME_LOST_US)
        find_anew(time);
    if (time->pairs < BUS_TIME_MEDIAN) {
        find(time, local_us, bus_us);
        return;
    }
    const int64_t distance_us = bus_us - local_us - rounded_us(offset_q12_at(time, local_us));
    if (limited(distance_us, BUS_TIME_STEP_US) != distance_us) {
        if (++time->strays == BUS_TIME_STEP_PAIRS)
            find_anew(time);
        return;
    }
    time->strays = 0;
    fit(time, local_us, (bus_us - local_us) * ONE_Q12 - offset_q12_at(time, local_us));
    const int64_t error_us = line_error_us(time);
    if (error_us > BUS_TIME_LOOSE_US)
        time->locked = false;
    else if (time->pairs >= BUS_TIME_LEAST_PAIRS && error_us <= BUS_TIME_LOCK_US)
        time->locked = true;
}

void bus_time_keep(bus_time_t *time, int64_t now_us)
{
    time->paired_us = now_us;
    if (now_us - time->local_us < INT64_C(1) << 36)
        return;
    time->offset_q12 = offset_q12_at(time, now_us);
    time->local_us = now_us;
}

int64_t bus_time_from_local(const bus_time_t *time, int64_t local_us)
{
    return time->known ? local_us + rounded_us(offset_q12_at(time, local_us)) : local_us;
}

uint32_t bus_time_error_us(const bus_time_t *time, int64_t now_us)
{
    if (!time->known || time->pairs < BUS_TIME_MEDIAN)
        return UINT32_MAX;
    const int64_t silent_ms = (now_us - time->paired_us) / 1000;
    int64_t error_us = line_error_us(time);
    /* Of a line through n pairs 125 ms apart, the rate's deviation per second is 14 / n of the end's. */
    if (silent_ms > 0)
        error_us += limited(silent_ms, INT64_C(1) << 31) * (error_us * 14 / time->pairs + WANDER_PPM) / 1000;
    return (uint32_t)limited(error_us, UINT32_MAX - 1);
}

int64_t bus_time_extend(int64_t near_us, uint64_t wrapped_us, uint64_t wrap_us)
{
    const int64_t wrap = (int64_t)wrap_us;
    const int64_t rest = near_us % wrap;
    int64_t ahead = (int64_t)(wrapped_us % wrap_us) - (rest < 0 ? rest + wrap : rest);
    if (ahead > wrap / 2)
        ahead -= wrap;
    else if (ahead < -(wrap / 2))
        ahead += wrap;
    return near_us + ahead;
}
