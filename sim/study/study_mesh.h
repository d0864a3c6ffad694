// SPDX-License-Identifier: Apache-2.0
// The mesh evaluation of all methods in one case of the study's room, and in a sweep of cases over the viewing angle.
#ifndef SIM_STUDY_STUDY_MESH_H
#define SIM_STUDY_STUDY_MESH_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/eval/mesh_psnr.h"
#include "sim/files/file_io.h"
#include "sim/study/study.h"
#include "sim/study/study_image.h"
#include "sim/study/study_scene.h"
#include "warp_fixed/method.h"
#include "warp_fixed/warp.h"

/** What is taken for the truth: the picture's own pixels as squares, as the paper does, or a finer original. */
typedef enum { STUDY_TRUTH_PICTURE, STUDY_TRUTH_ORIGINAL, STUDY_TRUTHS } study_truth_t;

typedef struct {
    study_sizes_t sizes;
    study_image_t image;
    int32_t finer;    /**< q: the original is q times as fine as the picture; 1 when there is none */
    int32_t factor;   /**< S: samples per picture pixel along each axis, a multiple of q */
    double angle_deg; /**< of study_pose() */
} study_mesh_case_t;

/** PSNR in dB; infinity for no error, NAN for the original where there is none. */
typedef struct {
    double k_in, k_all, coverage;
    double limit_db[STUDY_TRUTHS];
    double psnr_db[STUDY_TRUTHS][WARP_METHODS];
} study_mesh_result_t;

/** A case with its result. */
typedef struct {
    study_mesh_case_t at;
    study_mesh_result_t found;
    char error[FILE_ERROR_LENGTH]; /**< empty unless it could not be measured */
} study_mesh_run_t;

/** A case laid out in memory, for experiments that look at single projector pixels. */
typedef struct {
    homography_t homography;
    double_homography_t exact;
    image_t picture, panel;
    mesh_t mesh[STUDY_TRUTHS]; /**< that of the original is all zero where there is none */
    warp_t *warp;
} study_mesh_t;

/**
 * Make the picture, sample its truths, get an empty panel.
 *
 * @param[out] mesh   Written only when true is returned; to be given to study_mesh_close().
 * @param[out] error  On failure: why, in one line.
 */
bool study_mesh_open(study_mesh_t *mesh, const study_mesh_case_t *at, char error[FILE_ERROR_LENGTH]);

/** Give back its memory. */
void study_mesh_close(study_mesh_t *mesh);

/** Fill mesh->panel with what a method of warp_methods[] shows. */
void study_mesh_warp(study_mesh_t *mesh, int method);

/** Measure all methods in run->at. On failure run->error says why and run->found is untouched. */
void study_mesh_measure(study_mesh_run_t *run);

/** Measure runs, several at once. @return false after a failure, which the study then knows. */
bool study_mesh_measure_all(study_t *study, study_mesh_run_t *run, int32_t runs);

enum { STUDY_MESH_MAX_ANGLE_DEG = 70 };

/** Places, each at all angles from 0 to 70 degrees: run[place * angles + angle]. */
typedef struct {
    study_mesh_run_t *run;
    int32_t places, angles, count;
    double step_deg;
} study_mesh_sweep_t;

/**
 * Measure a sweep.
 *
 * @param[out] sweep  Written only when true is returned; sweep->run is the caller's to free().
 * @param      place  Its cases but for the angle.
 * @return false after a failure, which the study then knows.
 */
bool study_mesh_sweep(study_mesh_sweep_t *sweep, study_t *study, const study_mesh_case_t *place, int32_t places,
                      double step_deg);

/** @return Some of a sweep's places, as a sweep whose memory is the other's. */
study_mesh_sweep_t study_mesh_places(const study_mesh_sweep_t *sweep, int32_t first, int32_t places);

/** Begin a section of the page: its settings are what the sweep was measured with. */
void study_mesh_section(study_t *study, const char *title, const study_mesh_sweep_t *sweep);

#endif
