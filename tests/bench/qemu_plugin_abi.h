// SPDX-License-Identifier: Apache-2.0
// The part of QEMU's plugin interface that our plugins use. Debian packages the interface, but no header of it.
//
// The names, types and meanings are those of QEMU's manual ("TCG plugins"), and are the same from QEMU 5 to 10. QEMU
// looks up the two symbols below in a plugin and binds the functions when it loads one.
#ifndef TESTS_BENCH_QEMU_PLUGIN_ABI_H
#define TESTS_BENCH_QEMU_PLUGIN_ABI_H

#include <stddef.h>
#include <stdint.h>

/** Straight-line guest code as QEMU translates it: it runs from its first instruction to its last. */
struct qemu_plugin_tb;

/** One guest instruction of it. */
struct qemu_plugin_insn;

/** What QEMU tells a plugin about itself; not read here. */
struct qemu_info_t;

typedef void qemu_translated_fn(uint64_t id, struct qemu_plugin_tb *tb);
typedef void qemu_executed_fn(unsigned int cpu, void *data);
typedef void qemu_memory_fn(unsigned int cpu, uint32_t info, uint64_t address, void *data);
typedef void qemu_exit_fn(uint64_t id, void *data);

/** What an executed_fn does to the guest's registers. */
enum { QEMU_PLUGIN_REGISTERS_UNTOUCHED = 0 };

/** Which accesses to memory are told: loads and stores. */
enum { QEMU_PLUGIN_MEMORY_RW = 3 };

/* Ours, found by QEMU. It refuses a plugin whose version of the interface it does not serve. */
__attribute__((visibility("default"))) extern int qemu_plugin_version;
__attribute__((visibility("default"))) int qemu_plugin_install(uint64_t id, const struct qemu_info_t *info, int argc,
                                                               char **argv);

/* QEMU's. */
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *tb);
uint64_t qemu_plugin_tb_vaddr(const struct qemu_plugin_tb *tb);
void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t id, qemu_translated_fn *translated);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb *tb, qemu_executed_fn *executed, int registers,
                                          void *data);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *tb, size_t index);
void qemu_plugin_register_vcpu_mem_cb(struct qemu_plugin_insn *insn, qemu_memory_fn *accessed, int registers, int which,
                                      void *data);
/** @return log2 of an access's bytes. */
unsigned int qemu_plugin_mem_size_shift(uint32_t info);
void qemu_plugin_register_atexit_cb(uint64_t id, qemu_exit_fn *at_exit, void *data);

/** Only in version 1 and before; absent from QEMU 9 on. */
__attribute__((weak)) int qemu_plugin_n_vcpus(void);

#endif
