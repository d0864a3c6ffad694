// SPDX-License-Identifier: Apache-2.0
// How often and by how much one set of methods beats another: what claims are judged by.
#ifndef SIM_STUDY_STUDY_MESH_TALLY_H
#define SIM_STUDY_STUDY_MESH_TALLY_H

#include <stdint.h>

#include "sim/study/study_mesh.h"
#include "sim/study/study_methods.h"

/** @return The best PSNR of a set's methods, dB; minus infinity for an empty set. */
double study_best_db(const study_mesh_result_t *found, study_truth_t truth, study_methods_t methods);

/** @return a - b, and 0 for two equal infinities. */
double study_db_ahead(double a, double b);

/** A contest: is the best of the contenders as good as the best of the others? */
typedef struct {
    study_truth_t truth;
    study_methods_t contenders, others;
    double tolerance_db;   /**< by which a contender may lose and yet be as good; >= 0 */
    double from_angle_deg; /**< runs at smaller angles are left out */
} study_contest_t;

/** Its outcome. Runs in which both sides have no error at all say nothing, and are left out. */
typedef struct {
    int32_t cases, wins;
    double mean_db;  /**< how far ahead of the others; negative: behind; over cases where neither is without error */
    double worst_db; /**< the smallest of all cases; minus infinity when only the others were without error */
    int32_t worst;   /**< which run that was; -1 without cases */
} study_tally_t;

/** Hold a contest in all runs that have its truth. A side without methods: no cases. */
study_tally_t study_tally(const study_contest_t *contest, const study_mesh_run_t *run, int32_t runs);

/** One contest of a claim, in the words of the page: "ls against the best filtered method". */
typedef struct {
    const char *who;
    study_contest_t contest;
} study_duel_t;

/** A claim that holds when all its contests are won. */
typedef struct {
    const char *source, *claim; /**< as study_claim() takes them */
    const study_duel_t *duel;
    int duels;
} study_contest_claim_t;

/** @return STUDY_HOLDS when all cases of all contests were won, STUDY_FAILS when none was, or there were none. */
study_verdict_t study_contest_verdict(const study_contest_claim_t *claim, const study_mesh_run_t *run, int32_t runs);

/**
 * Put a claim on the page: its verdict and, of each contest, how many cases were won, mean and worst, and where the
 * worst is. Contests without a case are left out; without any there is no claim.
 */
void study_contest_claim(study_t *study, const study_contest_claim_t *claim, const study_mesh_sweep_t *sweep);

#endif
