// SPDX-License-Identifier: Apache-2.0
// Part of hal_board_check(): the machine and this process's rights on it.
#include <inttypes.h>
#include <linux/capability.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "hal/linux/check.h"
#include "hal/linux/machine_linux.h"

enum { NAME_LENGTH = 32 };

/* Memory that is locked: one projector_t (projector.h), the programs' code, and buffers of camera and display. */
static const uint64_t locked_bytes = UINT64_C(400) << 20;

/* Has this process the capability? */
static bool is_capable(const check_t *check, int bit)
{
    char path[CHECK_LINE_LENGTH], line[CHECK_LINE_LENGTH];
    (void)snprintf(path, sizeof path, "%s/proc/self/status", check->root);
    FILE *file = fopen(path, "re");
    if (file == NULL)
        return false;
    uint64_t capabilities = 0;
    while (fgets(line, sizeof line, file) != NULL)
        if (strncmp(line, "CapEff:", 7) == 0)
            capabilities = strtoull(line + 7, NULL, 16);
    fclose(file);
    return (capabilities >> bit & 1) != 0;
}

static void check_priority(check_t *check)
{
    struct rlimit limit;
    const rlim_t wanted = (rlim_t)check->table->workers.priority;
    if (wanted == 0)
        return;
    if (is_capable(check, CAP_SYS_NICE))
        check_found(check, "rights: real-time priority %u, by CAP_SYS_NICE", (unsigned)wanted);
    else if (getrlimit(RLIMIT_RTPRIO, &limit) == 0 && limit.rlim_cur >= wanted)
        check_found(check, "rights: real-time priority %u", (unsigned)wanted);
    else
        check_miss(check, "LimitRTPRIO= in the service's unit, or: ulimit -r 99 as root before the program",
                   "rights: this user may not have real-time priority %u", (unsigned)wanted);
}

static void check_locked_memory(check_t *check)
{
    struct rlimit limit;
    if (is_capable(check, CAP_IPC_LOCK))
        check_found(check, "rights: locked memory, by CAP_IPC_LOCK");
    else if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur >= locked_bytes)
        check_found(check, "rights: locked memory");
    else
        check_miss(check, "LimitMEMLOCK=infinity in the service's unit, or: ulimit -l unlimited as root before it",
                   "rights: this user may lock less than %u MB of memory", (unsigned)(locked_bytes >> 20));
}

/* Who has it may restart a controller that is bus-off; otherwise the interface's restart-ms must. */
static void check_network_right(check_t *check)
{
    if (is_capable(check, CAP_NET_ADMIN))
        check_found(check, "rights: CAP_NET_ADMIN, to restart the bus after bus-off");
    else
        check_found(check, "rights: no CAP_NET_ADMIN, so restart-ms of the bus must end a bus-off");
}

/* Is the core in a list of the kernel's, "0-1,3"? */
static bool has_core(const char *list, long core)
{
    while (*list != '\0') {
        char *end;
        const long first = strtol(list, &end, 10);
        const long last = *end == '-' ? strtol(end + 1, &end, 10) : first;
        if (end == list)
            return false;
        if (core >= first && core <= last)
            return true;
        list = *end == ',' ? end + 1 : end;
    }
    return false;
}

static bool has_cores(const char *list, const hal_workers_settings_t *workers)
{
    bool all = true;
    for (int32_t core = workers->first_core; core < workers->first_core + workers->count; core++)
        all = all && has_core(list, core);
    return all;
}

static void check_cores(check_t *check)
{
    const hal_workers_settings_t *workers = &check->table->workers;
    const int32_t first = workers->first_core, last = first + workers->count - 1;
    char online[CHECK_WORD_LENGTH] = "", isolated[CHECK_WORD_LENGTH] = "";
    (void)check_read(check, "/sys/devices/system/cpu/online", online, sizeof online);
    (void)check_read(check, "/sys/devices/system/cpu/isolated", isolated, sizeof isolated);
    if (workers->first_core == HAL_WORKERS_ANY_CORE)
        check_found(check, "cores: %s", online);
    else if (!has_cores(online, workers))
        check_miss(check, "choose fewer with --workers, or other cores in the board's table",
                   "cores: found %s, expected %d to %d among them", online, (int)first, (int)last);
    else if (!has_cores(isolated, workers))
        check_advise(check, "isolcpus= on the kernel's command line, as the page of the board has it, and restart",
                     "cores: found %s, of them isolated: %s; expected %d to %d", online,
                     isolated[0] == '\0' ? "none" : isolated, (int)first, (int)last);
    else
        check_found(check, "cores: %s, of them isolated: %s", online, isolated);
}

/* A clock that follows the load is slow just when a picture is due. */
static void check_governor(check_t *check)
{
    const hal_workers_settings_t *workers = &check->table->workers;
    const int core = workers->first_core == HAL_WORKERS_ANY_CORE ? 0 : (int)workers->first_core;
    char path[CHECK_LINE_LENGTH], governor[NAME_LENGTH];
    (void)snprintf(path, sizeof path, "/sys/devices/system/cpu/cpu%d/cpufreq/scaling_governor", core);
    if (!check_read(check, path, governor, sizeof governor))
        check_found(check, "governor: none, the cores' clock is fixed");
    else if (strcmp(governor, "performance") == 0)
        check_found(check, "governor: performance");
    else
        check_advise(check, "echo performance | sudo tee /sys/devices/system/cpu/cpufreq/policy*/scaling_governor",
                     "governor: found %s, expected performance", governor);
}

static void check_clock(check_t *check)
{
    char source[NAME_LENGTH];
    if (check_read(check, "/sys/devices/system/clocksource/clocksource0/current_clocksource", source, sizeof source))
        check_found(check, "clock: CLOCK_MONOTONIC from %s", source);
    else
        check_advise(check, "mount -t sysfs none /sys", "clock: CLOCK_MONOTONIC, its source is not known");
}

static void check_machine(check_t *check)
{
    char found[MACHINE_LINUX_NAME_LENGTH];
    if (!machine_linux_is(check->root, check->table->machine, found))
        check_miss(check, "install the firmware of this board (make BOARD=NAME)",
                   "machine: found %s, expected %s, as this is the firmware of board %s", found, check->table->machine,
                   check->table->name);
    else
        check_found(check, "machine: %s", found[0] == '\0' ? "it has no device tree" : found);
}

void check_system(check_t *check)
{
    check_machine(check);
    check_priority(check);
    check_locked_memory(check);
    check_network_right(check);
    check_cores(check);
    check_governor(check);
    check_clock(check);
}
