// SPDX-License-Identifier: Apache-2.0
// What the wire (sim_bus.c), its controllers (sim_can_controller.c) and its faults (sim_bus_faults.c) share.
#ifndef SIM_BUS_SIM_BUS_INTERNAL_H
#define SIM_BUS_SIM_BUS_INTERNAL_H

#include "sim/bus/sim_bus.h"
#include "sim/rng.h"

enum {
    SIM_CAN_TRANSMIT_FRAMES = 64,
    SIM_CAN_RECEIVE_FRAMES = 256,
    SIM_CAN_PASSIVE_LIMIT = 128, /* error passive from here on */
    SIM_CAN_BUS_OFF_LIMIT = 256,
    SIM_CAN_RECOVERY_BITS = 128 * 11,
    SIM_CAN_UNANSWERED_BITS = 16 * 150 /* 16 tries of 8 error counts each make a sender that is alone error passive */
};

/** A frame waiting for the wire. */
typedef struct {
    uint32_t key;      /**< arbitration field as sent: the lower one wins */
    uint64_t sequence; /**< when it was queued, among all of the bus */
    hal_can_frame_t frame;
} sim_can_pending_t;

/** A frame heard, waiting to be taken. */
typedef struct {
    int64_t due_ns; /**< not to be had earlier */
    hal_can_frame_t frame;
} sim_can_heard_t;

struct hal_can {
    sim_bus_t *bus;
    int index;
    bool plugged, stuck, keep_order, bus_off;
    bool in_flight; /**< one frame has left the queue and is on the wire; its place is kept */
    sim_can_stats_t stats;
    sim_can_stamp_fn *stamp;
    void *stamp_context;
    uint32_t jitter_us;
    rng_t random;          /**< of the jitter */
    int64_t delay_ns;      /**< of delivery */
    int64_t last_due_ns;   /**< of the newest frame in the receive queue */
    int64_t recovered_ns;  /**< end of a running recovery from bus-off; 0 when none runs */
    int64_t resume_ns;     /**< earliest next start: end of suspend transmission */
    int64_t unanswered_ns; /**< since when it has been sending to nobody; 0 when it is not */
    int32_t transmit_count;
    int32_t receive_first, receive_count;
    sim_can_pending_t transmit[SIM_CAN_TRANSMIT_FRAMES]; /**< next to be sent first */
    sim_can_heard_t receive[SIM_CAN_RECEIVE_FRAMES];     /**< a ring */
};

/** What occupies the wire. */
typedef struct {
    bool busy;
    bool destroyed;    /**< by an error frame */
    hal_can_t *sender; /**< NULL: the flooding node */
    sim_can_pending_t pending;
    int64_t done_ns; /**< end of end of frame, or of the error frame */
} sim_wire_t;

struct sim_bus {
    int64_t bitrate, data_bitrate;
    bool fd;
    int64_t start_ns, now_ns;
    int64_t free_ns; /**< the wire is free for a new frame from here on */
    sim_wire_t wire;
    uint64_t sequence;
    uint64_t seed;
    rng_t random;
    sim_bus_stats_t stats;   /**< busy_ns runs ahead to free_ns */
    int64_t window_start_ns; /**< of the window now is in */
    int64_t window_start_busy_ns, last_window_busy_ns;
    sim_bus_fail_t fail[SIM_BUS_FAULTS];
    bool flooding;
    sim_can_pending_t flood;
    sim_bus_log_fn *log;
    void *log_context;
    int count;
    hal_can_t *controller[SIM_BUS_MAX_CONTROLLERS];
};

/** @return Whether this bus can carry the frame. */
bool sim_bus_carries(const sim_bus_t *bus, const hal_can_frame_t *frame);

/** @return The frame as the wire carries it, with its place in arbitration. */
sim_can_pending_t sim_bus_pending(sim_bus_t *bus, const hal_can_frame_t *frame);

/** @return The time of that many bits at the nominal rate. */
int64_t sim_bus_bits_ns(const sim_bus_t *bus, int64_t bits);

/** @return Whether the controller hears and can send. */
bool sim_can_is_on_bus(const hal_can_t *can);

/** Let time pass at the controller: recovery from bus-off, and sending to nobody. */
void sim_can_settle(hal_can_t *can);

/** Take the first pending frame for the wire. The queue must not be empty. */
sim_can_pending_t sim_can_take_first(hal_can_t *can);

/** The frame taken last was sent, or destroyed and is pending again (or discarded, when that drives it bus-off). */
void sim_can_was_sent(hal_can_t *can);
void sim_can_was_destroyed(hal_can_t *can, const sim_can_pending_t *pending);

/** A listener heard a good frame, or an error frame. */
void sim_can_hear(hal_can_t *can, const hal_can_frame_t *frame);
void sim_can_hear_error(hal_can_t *can);

/** Hand a heard frame to the receive queue, or count an overrun. */
void sim_can_deliver(hal_can_t *can, const hal_can_frame_t *frame);

/** Go bus-off and discard what is queued. */
void sim_can_go_bus_off(hal_can_t *can);

/** @return Whether the frame now starting is destroyed. Sender NULL: the flooding node. */
bool sim_bus_is_destroyed(sim_bus_t *bus, const hal_can_t *sender);

/** Deliver a frame that ended to all who hear it, with the faults that are set. */
void sim_bus_deliver(sim_bus_t *bus, const hal_can_t *sender, const hal_can_frame_t *frame);

#endif
