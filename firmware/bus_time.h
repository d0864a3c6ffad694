// SPDX-License-Identifier: Apache-2.0
// Bus time: the master's clock, as a line over the board's own clock that is fitted to pairs of stamps.
//
// The line is fitted by least squares whose memory grows to BUS_TIME_MEMORY pairs and stays there: the alpha-beta
// filter with alpha = 2 (2 n - 1) / (n (n + 1)) and beta = 6 / (n (n + 1)) for pair n (the expanding-memory filter of
// degree 1, Morrison 1969). With stamps that scatter by s, the line's end is off by 2 s / sqrt(n) while it grows and
// by 1.7 s / sqrt(n) after that (one deviation). To outliers it is robust: the first BUS_TIME_MEDIAN pairs give their
// median; later ones count for at most three times the mean distance of pairs from the line; those beyond
// BUS_TIME_STEP_US do not count, but BUS_TIME_STEP_PAIRS of them in a row make it start anew.
//
// Measured with pairs 125 ms apart, clocks up to 50 ppm apart, 1 % of the pairs lost and 1 % off by up to 20 ms, 20
// hours: stamps of both sides late by 0 to 200 us: locked after 6 to 20 s, then within 60 us; the receiver's off by 200
// us either way: after 17 to 50 s, within 80 us. Exact stamps: after 4 s, within 2 us.
//
// Integers only, no pointers inside, constant time. A board's clock is any that hal_time.h allows, within +-2^50 us.
#ifndef FIRMWARE_BUS_TIME_H
#define FIRMWARE_BUS_TIME_H

#include <stdbool.h>
#include <stdint.h>

enum {
    BUS_TIME_MEDIAN = 5,         /**< pairs after which there is a bus time */
    BUS_TIME_LEAST_PAIRS = 32,   /**< locked only from here on */
    BUS_TIME_MEMORY = 256,       /**< pairs: 32 s of them */
    BUS_TIME_LOCK_US = 100,      /**< an error, as estimated, of at most so much: locked */
    BUS_TIME_LOOSE_US = 200,     /**< and of more than so much: no longer */
    BUS_TIME_LOST_US = 400,      /**< and of more than so much after a silence: find a new line */
    BUS_TIME_STEP_US = 1000,     /**< a pair farther than this from the line is a stray */
    BUS_TIME_STEP_PAIRS = 4,     /**< so many strays in a row: the master's clock has jumped */
    BUS_TIME_RUN_PAIRS = 24,     /**< so many pairs in a row on one side: the rate has changed, forget three quarters */
    BUS_TIME_SILENT_US = 500000, /**< without a good pair for so long: holdover */
    BUS_TIME_MAX_PPM = 500       /**< between two clocks; more is not followed */
};

/** Bus time as a board knows it. All zero bytes knows none. */
typedef struct {
    bool known;       /**< there is a line: the next four mean something */
    bool locked;      /**< its error was estimated below BUS_TIME_LOCK_US, and has not passed BUS_TIME_LOOSE_US since */
    int64_t local_us; /**< a moment on the board's clock; */
    int64_t offset_q12; /**< bus time less the board's clock there, us; */
    int64_t rate_q32;   /**< and by how much bus time is faster */
    int64_t paired_us;  /**< the newest pair that counted, on the board's clock */

    int32_t pairs;                  /**< in the line, up to BUS_TIME_MEMORY; while finding one, up to BUS_TIME_MEDIAN */
    int32_t spread_q12;             /**< mean distance of pairs from the line, us */
    int32_t run;                    /**< pairs in a row above the line, or below as a negative number */
    int32_t strays;                 /**< in a row */
    int64_t first[BUS_TIME_MEDIAN]; /**< bus time less the board's clock, us, of the pairs while finding a line */
    uint32_t relocks;               /**< lines found in place of an older one, since start */
} bus_time_t;

/** Begin a bus time that runs as the board's own clock: what the first master of a bus does. Locked from the start. */
void bus_time_begin(bus_time_t *time, int64_t local_us, int64_t bus_us);

/**
 * Take a pair: what the board's clock and what the master's clock said at one moment.
 *
 * @param local_us  Pairs must be in order: one that is not newer than the newest is ignored.
 * @param bus_us    0 to 2^48 - 1.
 */
void bus_time_pair(bus_time_t *time, int64_t local_us, int64_t bus_us);

/**
 * Keep the line as it is and as good as it is: what the master does, who takes no pairs. There must be a line. Call it
 * once an hour or oftener.
 */
void bus_time_keep(bus_time_t *time, int64_t now_us);

/** @return Bus time at a moment of the board's clock within 20 days of the line; the clock itself while none is known.
 */
int64_t bus_time_from_local(const bus_time_t *time, int64_t local_us);

/**
 * @return Within which bus_time_from_local(now_us) is right, us: six deviations of the line's end, and since the newest
 *         pair six of its rate and 1 ppm for what crystals do. UINT32_MAX while none is known, or a new one is being
 *         found.
 */
uint32_t bus_time_error_us(const bus_time_t *time, int64_t now_us);

/** @return The moment nearest to near_us that is `wrapped` modulo wrap_us. @param wrap_us  2 to 2^62. */
int64_t bus_time_extend(int64_t near_us, uint64_t wrapped_us, uint64_t wrap_us);

#endif
