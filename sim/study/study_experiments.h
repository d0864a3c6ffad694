// SPDX-License-Identifier: Apache-2.0
// The experiments of the study, in the order of its page. Each measures, writes its CSV files and plots, and its
// section.
#ifndef SIM_STUDY_STUDY_EXPERIMENTS_H
#define SIM_STUDY_STUDY_EXPERIMENTS_H

#include "sim/study/study_run.h"

study_experiment_fn study_fig05;      /**< resampling grids */
study_experiment_fn study_fig08;      /**< figures 8 and 9: how rectangular the viewer sees a rectangle */
study_experiment_fn study_fig10;      /**< PSNR against angle, the picture as fine as the projector */
study_experiment_fn study_fig11;      /**< the same, the picture coarser */
study_experiment_fn study_larger;     /**< the paper's third case, the picture finer */
study_experiment_fn study_gap;        /**< how far every method is below the limit, under both truths */
study_experiment_fn study_footprints; /**< where that comes from: error by the footprint's area */
study_experiment_fn study_flicker;    /**< a moving viewer: flicker and sharpness */
study_experiment_fn study_intensity;  /**< beyond the paper: uneven pixels, walls that shine */
study_experiment_fn study_latency;    /**< beyond the paper: old and noisy poses */
study_experiment_fn study_prediction; /**< beyond the paper: poses that are yet to come */

/** The table of them all, ended by a row without a name. */
extern const study_experiment_t study_experiments[];

#endif
