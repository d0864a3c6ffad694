// SPDX-License-Identifier: Apache-2.0
// What every experiment of the study is written with: its settings, its table, its plots, its part of the page.
//
// An experiment is one function that measures (study_parallel), writes one CSV per figure (study_csv_*), draws SVG
// plots from these CSV files (study_plot), and says on the page what they show and which claim holds (study_*).
// Failures are remembered: each function does nothing after the first one, and study_failed() ends an experiment early.
#ifndef SIM_STUDY_STUDY_H
#define SIM_STUDY_STUDY_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "sim/files/file_io.h"

typedef struct study study_t;

/** @return true for --quick: fewer angles, smaller pictures, the same figures. */
bool study_quick(const study_t *study);

/** @return true once something has failed: no disk, no memory, no gnuplot. */
bool study_failed(const study_t *study);

/** Remember a failure; only the first is kept and told at the end. */
void study_fail(study_t *study, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** @return So many bytes, all 0, to be given to free(); NULL when the study has failed, which it has without memory. */
void *study_memory(study_t *study, size_t size);

/** One piece of work of an experiment: it writes only its own slot of what context points to. */
typedef void study_task_fn(void *context, int32_t index);

/** Run task(context, 0) to task(context, count - 1), as many at once as there are cores; shows progress. */
void study_parallel(study_t *study, int32_t count, study_task_fn *task, void *context);

/**
 * Begin a CSV file in the study's folder.
 *
 * @param name    "fig10.csv".
 * @param header  Its first line, without newline.
 * @return Where to print rows to, then to be given to study_csv_end(); after a failure a file that forgets them.
 */
FILE *study_csv_begin(study_t *study, const char *name, const char *header);
void study_csv_end(study_t *study, FILE *csv);

/** One line or set of marks of a plot, from a CSV file's columns. */
typedef struct {
    const char *csv;   /**< file in the study's folder */
    int x, y;          /**< columns, from 1 */
    const char *title; /**< NULL leaves it out of the key */
    int colour;        /**< 0 to 7 */
    bool dashed;
    bool marks; /**< points without a line */
} study_line_t;

typedef struct {
    const char *name;  /**< "fig10.svg" */
    const char *title; /**< may be NULL */
    const char *x_label, *y_label;
    const char *setup; /**< more gnuplot commands ("set yrange [0:1]\n"), or NULL */
    int width, height; /**< 0 for the page's own size */
    const study_line_t *line;
    int lines;
} study_plot_t;

/** Draw a plot with gnuplot. Values that are not finite, and empty fields, leave a gap; no value at all is a failure.
 */
void study_plot(study_t *study, const study_plot_t *plot);

/** Begin a section of the page. @param format  Everything needed to do it again: sizes, poses, pictures, seeds. */
void study_section(study_t *study, const char *title, const char *format, ...) __attribute__((format(printf, 3, 4)));

/** A paragraph of plain text (escaped here). */
void study_text(study_t *study, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Show an SVG or PNG of the study's folder with its caption. @param csv  The figures behind it, or NULL. */
void study_figure(study_t *study, const char *picture, const char *csv, const char *caption);

/** Show a small CSV file as a table. */
void study_table(study_t *study, const char *csv, const char *caption);

/** Offer a CSV file that is too long to show. */
void study_data(study_t *study, const char *csv, const char *caption);

typedef enum { STUDY_HOLDS, STUDY_PARTLY, STUDY_FAILS, STUDY_VERDICTS } study_verdict_t;

/** @return What a claim's cases make of it: it holds in all, in some (in part), in none (or there are none: fails). */
study_verdict_t study_verdict(int64_t held, int64_t cases);

/** One sentence for the top of the page: what came out, in this run's own numbers. */
void study_headline(study_t *study, const char *format, ...) __attribute__((format(printf, 2, 3)));

/**
 * A claim, of the paper or of this product, and what this study's own numbers say to it. The list at the top of the
 * page leads here.
 *
 * @param source  "paper, fig 10" or "wallwarp".
 * @param claim   One sentence.
 * @param format  Why, with the numbers.
 */
void study_claim(study_t *study, study_verdict_t verdict, const char *source, const char *claim, const char *format,
                 ...) __attribute__((format(printf, 5, 6)));

#endif
