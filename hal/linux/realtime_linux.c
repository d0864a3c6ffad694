// SPDX-License-Identifier: Apache-2.0
// What Linux must grant so that the loop keeps its time: memory that stays in memory, and real-time priority.
#include "hal/linux/realtime_linux.h"

#include <errno.h>
#include <sched.h>
#include <stdbool.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include "hal/linux/board_error.h"

/* Asked by doing it, on the calling thread, and undoing it: rights come from limits, capabilities and cgroups. */
static bool may_have(int32_t priority, int *failure)
{
    struct sched_param before;
    const struct sched_param wanted = {.sched_priority = priority};
    const int policy = sched_getscheduler(0);
    *failure =
        policy < 0 || sched_getparam(0, &before) != 0 || sched_setscheduler(0, SCHED_FIFO, &wanted) != 0 ? errno : 0;
    return *failure == 0 && sched_setscheduler(0, policy, &before) == 0;
}

hal_status_t realtime_linux_open(int32_t priority, char error[HAL_BOARD_ERROR_LENGTH])
{
    struct rlimit limit = {0, 0};
    int failure;
    if (priority == 0)
        return HAL_OK;
    if (!may_have(priority, &failure)) {
        (void)getrlimit(RLIMIT_RTPRIO, &limit);
        return board_error(error,
                           "realtime: no right to priority %d (%s), the limit is %llu: `ulimit -r %d`, or "
                           "LimitRTPRIO=%d in the service, or CAP_SYS_NICE",
                           priority, strerror(failure), (unsigned long long)limit.rlim_cur, priority, priority);
    }
    if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0)
        return HAL_OK;
    failure = errno;
    (void)getrlimit(RLIMIT_MEMLOCK, &limit);
    return board_error(error,
                       "realtime: memory can't be locked (%s), the limit is %llu KB: `ulimit -l unlimited`, or "
                       "LimitMEMLOCK=infinity in the service, or CAP_IPC_LOCK",
                       strerror(failure), (unsigned long long)limit.rlim_cur / 1024);
}

void realtime_linux_close(void)
{
    (void)munlockall();
}
