// SPDX-License-Identifier: Apache-2.0
// A CAN bus between the boards of one process: exact bit timing in virtual time, and faults on demand.
#ifndef SIM_BUS_SIM_BUS_H
#define SIM_BUS_SIM_BUS_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_can.h"

/**
 * The bus has its own idea of now, which only sim_bus_advance() moves. A frame handed to hal_can_send() competes for
 * the wire from that moment on: when the caller is at time t on the bus, it advances the bus to t, lets every board
 * do its step, and advances further; frames all boards queue at t then meet in one arbitration. Whenever the wire is
 * free the pending frame with the lowest bits wins, occupies the wire for its exact number of bits, and is handed to
 * every other controller when its last end-of-frame bit is over. The wire itself acknowledges, as a bus analyser
 * does, so that one controller alone can send.
 *
 * Not for several threads. Memory is taken by create and attach only.
 */
typedef struct sim_bus sim_bus_t;

enum {
    SIM_BUS_MAX_CONTROLLERS = 64,
    SIM_BUS_WINDOW_US = 1000000, /**< over which the recent load is taken */
    SIM_BUS_FLOOD_SENDER = -1    /**< stands for the flooding node where a sender's number is told */
};

typedef struct {
    int32_t bitrate;      /**< bit/s, 10,000 to 1,000,000 */
    int32_t data_bitrate; /**< bit/s, bitrate to 8,000,000; used by FD frames that switch. Ignored unless fd */
    bool fd;              /**< the bus carries CAN FD frames beside classic ones */
    uint64_t seed;        /**< of everything random; the same seed and calls give the same bus, bit by bit */
    int64_t start_us;     /**< now of the new bus, >= 0 */
} sim_bus_config_t;

/** @return A bus, for sim_bus_destroy(); NULL when a rate is out of range or there is no memory. */
sim_bus_t *sim_bus_create(const sim_bus_config_t *config);

/** Free the bus and all its controllers. NULL is allowed. */
void sim_bus_destroy(sim_bus_t *bus);

/**
 * Add a controller: error active, plugged in. It lives as long as the bus.
 *
 * Its transmit queue holds 64 frames, lower identifiers first and equal ones in order; its receive queue 256.
 *
 * @return The controller for the hal_can_ calls; NULL when 64 are attached or there is no memory.
 */
hal_can_t *sim_bus_attach(sim_bus_t *bus);

/** Send in the order queued from now on, like the queue of a SocketCAN interface, whatever the identifiers. */
void sim_can_keep_order(hal_can_t *can);

/** @return What a controller's clock shows when the bus is at time_us; never less for a later moment. */
typedef int64_t sim_can_stamp_fn(void *context, int64_t time_us);

/**
 * How a controller stamps what it hears from now on: on a clock of its own, and late by chance, uniformly 0 to
 * jitter_us; the frame can be had no earlier. At first: on the bus's own time, at once.
 *
 * @param stamp  NULL for the bus's own time.
 */
void sim_can_set_stamps(hal_can_t *can, sim_can_stamp_fn *stamp, void *context, uint32_t jitter_us);

/** Run the bus up to a moment. An earlier moment than now changes nothing. A frame still on the wire goes on later. */
void sim_bus_advance(sim_bus_t *bus, int64_t until_us);

/** @return Now on the bus: what the last sim_bus_advance() reached. */
int64_t sim_bus_now_us(const sim_bus_t *bus);

/**
 * Hears every whole frame on the wire, lost ones too, destroyed ones not.
 *
 * @param sender  Number of the sending controller in order of attaching, or SIM_BUS_FLOOD_SENDER.
 * @param frame   time_us is the end of its last end-of-frame bit. May send frames, must not advance the bus.
 */
typedef void sim_bus_log_fn(void *context, int sender, const hal_can_frame_t *frame);

/** Set the listener; NULL for none. */
void sim_bus_set_log(sim_bus_t *bus, sim_bus_log_fn *log, void *context);

/** What has happened on the wire since the bus was created. */
typedef struct {
    int64_t frames;          /**< whole frames */
    int64_t bits;            /**< all bits of frames started, error frames and intermissions included */
    int64_t busy_ns;         /**< time the wire was taken, up to now */
    int64_t elapsed_ns;      /**< from creation to now */
    int32_t load_ppm;        /**< busy / elapsed, parts per million */
    int32_t window_load_ppm; /**< the same over the last full window, or since the start when none is full yet */
    int64_t error_frames;    /**< frames destroyed by a sim_bus_fail() */
    int64_t lost, corrupted, duplicated; /**< frames hit by a sim_bus_fail() */
    int64_t collisions;   /**< frames that beat another sender's of the same identifier; a real bus has errors then */
    int64_t flood_frames; /**< frames of the flooding node */
} sim_bus_stats_t;

sim_bus_stats_t sim_bus_stats(const sim_bus_t *bus);

/** What has happened at one controller. */
typedef struct {
    int64_t sent;            /**< frames sent with success */
    int64_t received;        /**< frames put into the receive queue */
    int64_t overruns;        /**< frames dropped because the receive queue was full */
    int64_t transmit_errors; /**< own frames destroyed on the wire, to be sent again */
    int64_t discarded;       /**< queued frames thrown away by going bus-off */
    int64_t bus_offs;        /**< times it went bus-off */
    int32_t tec, rec;        /**< transmit and receive error counters of ISO 11898-1 */
    int32_t pending;         /**< frames not yet sent */
} sim_can_stats_t;

sim_can_stats_t sim_can_stats(const hal_can_t *can);

/** Faults that strike frame by frame. */
typedef enum {
    SIM_BUS_LOSE,      /**< the frame is on the wire, but is not delivered */
    SIM_BUS_CORRUPT,   /**< one to three payload bits are delivered wrong, as by a faulty gateway; empty frames pass */
    SIM_BUS_DUPLICATE, /**< delivered twice */
    SIM_BUS_ERROR,     /**< destroyed by an error frame at the end of its CRC; the sender tries again */
    SIM_BUS_FAULTS
} sim_bus_fault_t;

/** Which frames a fault strikes: first the next ones, then by chance. All zero: none. */
typedef struct {
    uint32_t next;         /**< this many frames for certain */
    uint32_t ppm;          /**< then each with this chance in a million, 0 to 1,000,000 */
    const hal_can_t *only; /**< lose, corrupt, duplicate: at this listener alone; error: its frames alone; NULL: all */
} sim_bus_fail_t;

/** Set one kind of fault, in place of what was set for that kind before. */
void sim_bus_fail(sim_bus_t *bus, sim_bus_fault_t fault, sim_bus_fail_t fail);

/**
 * A node that sends this frame at every opportunity: it starts whenever no lower identifier is pending.
 *
 * @param frame  Copied; NULL ends the flood.
 * @return HAL_OK; HAL_BAD_CALL when the frame is illegal on this bus, and then nothing is changed.
 */
MUST_CHECK hal_status_t sim_bus_fail_flood(sim_bus_t *bus, const hal_can_frame_t *frame);

/** Deliver to this controller late from now on, with the late time stamp; order is kept. 0 ends it; an hour at most. */
void sim_bus_fail_delay(hal_can_t *can, int64_t delay_us);

/** Drive the controller bus-off at once; hal_can_restart() brings it back after 128 x 11 bits. */
void sim_bus_fail_bus_off(hal_can_t *can);

/**
 * Pull the plug: it hears nothing and nobody hears it; frames still queue until the queue is full. Nobody
 * acknowledges, so with a frame pending it is error passive after 16 tries of 150 bits.
 */
void sim_bus_fail_unplug(hal_can_t *can);

/** Put the plug back; what is queued is sent. */
void sim_bus_replug(hal_can_t *can);

/** Driver stuck: hal_can_send(), hal_can_receive() and hal_can_restart() return HAL_IO while it is. */
void sim_bus_fail_driver(hal_can_t *can, bool stuck);

#endif
