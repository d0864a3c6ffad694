// SPDX-License-Identifier: Apache-2.0
// A plugin for qemu-aarch64: how often each piece of code ran between two markers.
//
// Its arguments, addresses being hexadecimal and those of functions:
//   begin=ADDRESS    from the return of this function on, instructions are counted,
//   end=ADDRESS      until this one is called; both may be called again
//   without=ADDRESS  a call of this function, with all that it calls, is left out; up to 16 of them
//   out=FILE         gets a line per piece of code: address of its first instruction, instructions, executions
// Nothing but the calls of `end` and of functions left out is counted beyond the code between the markers. FILE is not
// written when `end` is never reached, or when it is reached within a function left out.
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bench/plugin_arguments.h"
#include "tests/bench/qemu_plugin_abi.h"

enum { MAX_LEFT_OUT = 16, INSTRUCTION_BYTES = 4 };

typedef enum { BLOCK_PLAIN, BLOCK_BEGINS, BLOCK_ENDS, BLOCK_LEFT_OUT } block_role_t;

typedef struct block {
    struct block *next;
    uint64_t address, end; /* one past its last instruction */
    uint64_t executions;
    block_role_t role;
} block_t;

/* QEMU hands no data of ours to translated(), so that what is counted must be found without. */
static struct {
    uint64_t begin, end, left_out[MAX_LEFT_OUT];
    int left_out_count;
    const char *out_path;
    block_t *blocks;
    bool is_counting, is_complete, is_broken;
    uint64_t return_address; /* of the present call that is left out; 0 outside of such */
    uint64_t last_end;       /* of the last block executed: a call is a block's last instruction */
} counter;

static void executed(unsigned int cpu, void *data)
{
    (void)cpu;
    block_t *block = data;
    const uint64_t last_end = counter.last_end;
    counter.last_end = block->end;
    if (block->address == counter.return_address)
        counter.return_address = 0;
    if (block->role == BLOCK_BEGINS) {
        counter.is_counting = true;
        return;
    }
    if (!counter.is_counting)
        return;
    if (block->role == BLOCK_ENDS) {
        counter.is_counting = false;
        counter.is_complete = true;
        counter.is_broken |= counter.return_address != 0;
    } else if (block->role == BLOCK_LEFT_OUT && counter.return_address == 0) {
        counter.return_address = last_end;
    } else if (counter.return_address == 0) {
        block->executions++;
    }
}

static block_role_t role_of(uint64_t address)
{
    if (address == counter.begin)
        return BLOCK_BEGINS;
    if (address == counter.end)
        return BLOCK_ENDS;
    for (int i = 0; i < counter.left_out_count; i++)
        if (address == counter.left_out[i])
            return BLOCK_LEFT_OUT;
    return BLOCK_PLAIN;
}

static void translated(uint64_t id, struct qemu_plugin_tb *tb)
{
    (void)id;
    block_t *block = calloc(1, sizeof *block);
    if (block == NULL) {
        fprintf(stderr, "count_plugin: out of memory\n");
        exit(1);
    }
    block->address = qemu_plugin_tb_vaddr(tb);
    block->end = block->address + INSTRUCTION_BYTES * qemu_plugin_tb_n_insns(tb);
    block->role = role_of(block->address);
    block->next = counter.blocks;
    counter.blocks = block;
    qemu_plugin_register_vcpu_tb_exec_cb(tb, executed, QEMU_PLUGIN_REGISTERS_UNTOUCHED, block);
}

static void write_counts(uint64_t id, void *data)
{
    (void)id;
    (void)data;
    if (!counter.is_complete || counter.is_counting || counter.is_broken) {
        fprintf(stderr, "count_plugin: %s\n",
                counter.is_broken     ? "a function that is left out had not returned at the end marker"
                : counter.is_complete ? "the begin marker is not followed by the end marker"
                                      : "the end marker was not reached");
        return;
    }
    FILE *out = fopen(counter.out_path, "w");
    bool written = out != NULL;
    for (const block_t *block = counter.blocks; written && block != NULL; block = block->next)
        if (block->executions != 0)
            written = fprintf(out, "%" PRIx64 " %" PRIu64 " %" PRIu64 "\n", block->address,
                              (block->end - block->address) / INSTRUCTION_BYTES, block->executions) > 0;
    if (out == NULL || fclose(out) != 0 || !written)
        fprintf(stderr, "count_plugin: cannot write %s\n", counter.out_path);
}

static bool take_argument(char *argument)
{
    char *value = plugin_value(argument);
    if (value == NULL)
        return false;
    if (strcmp(argument, "out") == 0) {
        counter.out_path = value;
        return true;
    }
    const uint64_t address = plugin_address(value);
    if (address == 0)
        return false;
    if (strcmp(argument, "begin") == 0)
        counter.begin = address;
    else if (strcmp(argument, "end") == 0)
        counter.end = address;
    else if (strcmp(argument, "without") == 0 && counter.left_out_count < MAX_LEFT_OUT)
        counter.left_out[counter.left_out_count++] = address;
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
            fprintf(stderr, "count_plugin: bad argument %s, expected begin=, end=, without= or out=\n", argv[i]);
            return 1;
        }
    }
    if (counter.begin == 0 || counter.end == 0 || counter.out_path == NULL) {
        fprintf(stderr, "count_plugin: begin=, end= and out= are needed\n");
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, write_counts, NULL);
    return 0;
}
