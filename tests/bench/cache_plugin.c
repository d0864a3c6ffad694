// SPDX-License-Identifier: Apache-2.0
// A plugin for qemu-aarch64: how many lines a Cortex-A72's data caches fetch between two markers.
//
// Its arguments, addresses being hexadecimal and those of functions:
//   begin=ADDRESS  from a call of this function on, accesses are counted; the caches are empty then
//   end=ADDRESS    until this one is called
//   out=FILE       gets one line: accesses, lines that the first cache fetched, lines that the second did
//
// The caches are those of a Raspberry Pi 4: 32 KiB of 2 ways for the core, 1 MiB of 16 ways behind it, lines of 64
// bytes, the line used longest ago replaced, stores fetch like loads. There is no prefetcher in it, which hides most
// fetches of a walk along rows, and no other core. Memory lies as the program sees it: each frame in one piece, as a
// camera's do.
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "tests/bench/cache_model.h"
#include "tests/bench/plugin_arguments.h"
#include "tests/bench/qemu_plugin_abi.h"

enum { L1_BYTES = 32 << 10, L1_WAYS = 2, L2_BYTES = 1 << 20, L2_WAYS = 16 };

/* QEMU hands no data of ours to translated(), so that what is counted must be found without. */
static struct {
    uint64_t begin, end;
    const char *out_path;
    cache_t l1, l2;
    bool is_counting, is_complete;
    int64_t accesses, l1_misses, l2_misses;
} model;

static void began(unsigned int cpu, void *data)
{
    (void)cpu;
    (void)data;
    model.is_counting = true;
}

static void ended(unsigned int cpu, void *data)
{
    (void)cpu;
    (void)data;
    model.is_complete |= model.is_counting;
    model.is_counting = false;
}

static void touch(uint64_t address)
{
    if (cache_touch(&model.l1, address))
        return;
    model.l1_misses++;
    model.l2_misses += !cache_touch(&model.l2, address);
}

static void accessed(unsigned int cpu, uint32_t info, uint64_t address, void *data)
{
    (void)cpu;
    (void)data;
    if (!model.is_counting)
        return;
    model.accesses++;
    const uint64_t last = address + (1u << qemu_plugin_mem_size_shift(info)) - 1;
    touch(address);
    if (last / CACHE_LINE_BYTES != address / CACHE_LINE_BYTES)
        touch(last);
}

static void translated(uint64_t id, struct qemu_plugin_tb *tb)
{
    (void)id;
    if (qemu_plugin_tb_vaddr(tb) == model.begin)
        qemu_plugin_register_vcpu_tb_exec_cb(tb, began, QEMU_PLUGIN_REGISTERS_UNTOUCHED, NULL);
    if (qemu_plugin_tb_vaddr(tb) == model.end)
        qemu_plugin_register_vcpu_tb_exec_cb(tb, ended, QEMU_PLUGIN_REGISTERS_UNTOUCHED, NULL);
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(tb); i++)
        qemu_plugin_register_vcpu_mem_cb(qemu_plugin_tb_get_insn(tb, i), accessed, QEMU_PLUGIN_REGISTERS_UNTOUCHED,
                                         QEMU_PLUGIN_MEMORY_RW, NULL);
}

static void write_counts(uint64_t id, void *data)
{
    (void)id;
    (void)data;
    if (!model.is_complete || model.is_counting) {
        fprintf(stderr, "cache_plugin: the markers were not reached in turn\n");
        return;
    }
    FILE *out = fopen(model.out_path, "w");
    const bool written = out != NULL && fprintf(out, "%" PRId64 " %" PRId64 " %" PRId64 "\n", model.accesses,
                                                model.l1_misses, model.l2_misses) > 0;
    if (out == NULL || fclose(out) != 0 || !written)
        fprintf(stderr, "cache_plugin: cannot write %s\n", model.out_path);
}

static bool take_argument(char *argument)
{
    char *value = plugin_value(argument);
    if (value == NULL)
        return false;
    if (strcmp(argument, "out") == 0) {
        model.out_path = value;
        return true;
    }
    const uint64_t address = plugin_address(value);
    if (address == 0)
        return false;
    if (strcmp(argument, "begin") == 0)
        model.begin = address;
    else if (strcmp(argument, "end") == 0)
        model.end = address;
    else
        return false;
    return true;
}

/* The arguments live as long as the plugin. */
int qemu_plugin_install(uint64_t id, const struct qemu_info_t *info, int argc, char **argv)
{
    (void)info;
    for (int i = 0; i < argc; i++) {
        if (!take_argument(argv[i])) {
            fprintf(stderr, "cache_plugin: bad argument %s, expected begin=, end= or out=\n", argv[i]);
            return 1;
        }
    }
    if (model.begin == 0 || model.end == 0 || model.out_path == NULL) {
        fprintf(stderr, "cache_plugin: begin=, end= and out= are needed\n");
        return 1;
    }
    cache_init(&model.l1, L1_BYTES, L1_WAYS);
    cache_init(&model.l2, L2_BYTES, L2_WAYS);
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, write_counts, NULL);
    return 0;
}
