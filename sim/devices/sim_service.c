// SPDX-License-Identifier: Apache-2.0
// The service manager in the simulator.
#include "sim/devices/sim_service.h"

#include <stdlib.h>
#include <string.h>

struct hal_service {
    sim_service_heard_t heard;
};

hal_service_t *sim_service_create(char error[FILE_ERROR_LENGTH])
{
    hal_service_t *service = calloc(1, sizeof *service);
    if (service == NULL) {
        file_error(error, "service", "out of memory");
        return NULL;
    }
    service->heard.ready_us = INT64_MIN;
    return service;
}

void sim_service_destroy(hal_service_t *service)
{
    free(service);
}

const sim_service_heard_t *sim_service_heard(const hal_service_t *service)
{
    return &service->heard;
}

void hal_service_report(hal_service_t *service, const hal_service_report_t *report)
{
    if (service == NULL)
        return;
    sim_service_heard_t *heard = &service->heard;
    if (heard->reports == 0 || strcmp(heard->last.state, report->state) != 0)
        heard->states++;
    if (report->showing && heard->ready_us == INT64_MIN)
        heard->ready_us = report->now_us;
    heard->reports++;
    heard->healthy += report->healthy;
    heard->last = *report;
}
