// SPDX-License-Identifier: Apache-2.0
// Figure 5: where the projector's pixels fall in the picture, for turns about each axis, and the step k.
#include <math.h>
#include <stdlib.h>

#include "sim/study/study_experiments.h"
#include "sim/study/study_scene.h"
#include "warp_fixed/fixed.h"

enum { TURNS = 4, WIDTH = 1920, HEIGHT = 1080, LINE_EVERY = 120, POINT_EVERY = 20 };

typedef struct {
    const char *name, *title, *picture;
    double angle_deg[3];
} turn_t;

static const turn_t turns[TURNS] = {
    {"x", "About X by 35 degrees", "fig05_x.svg", {35, 0, 0}},
    {"y", "About Y by 40 degrees", "fig05_y.svg", {0, 40, 0}},
    {"z", "About Z by 20 degrees", "fig05_z.svg", {0, 0, 20}},
    {"xyz", "About X by 20, Y by 30, Z by 10 degrees", "fig05_xyz.svg", {20, 30, 10}},
};

typedef struct {
    grid_t grid[TURNS];
    footprint_step_t step[TURNS];
    double measured[TURNS]; /* the greatest distance between neighbours that are both in the picture */
} grids_t;

static bool point_in_picture(const grid_t *grid, int32_t i, int32_t j, double point[2])
{
    int32_t x_q18, y_q18;
    if (!grid_point(grid, i, j, &x_q18, &y_q18) || x_q18 < 0 || y_q18 < 0 || x_q18 > WIDTH << GRID_FRACTION_BITS ||
        y_q18 > HEIGHT << GRID_FRACTION_BITS)
        return false;
    point[0] = ldexp(x_q18, -GRID_FRACTION_BITS);
    point[1] = ldexp(y_q18, -GRID_FRACTION_BITS);
    return true;
}

/* Eq 4 and 5 neighbour by neighbour. */
static double measured_step(const grid_t *grid)
{
    double longest = 0.0;
    for (int32_t j = 0; j < HEIGHT; j++)
        for (int32_t i = grid->row[j].begin; i < grid->row[j].end; i++) {
            double here[2], next[2];
            if (!point_in_picture(grid, i, j, here))
                continue;
            if (i + 1 < WIDTH && point_in_picture(grid, i + 1, j, next))
                longest = fmax(longest, hypot(next[0] - here[0], next[1] - here[1]));
            if (j + 1 < HEIGHT && point_in_picture(grid, i, j + 1, next))
                longest = fmax(longest, hypot(next[0] - here[0], next[1] - here[1]));
        }
    return longest;
}

static void make_grid(void *context, int32_t index)
{
    grids_t *grids = context;
    const study_sizes_t sizes = {WIDTH, HEIGHT, WIDTH, HEIGHT};
    const pose_t pose = study_pose_turned(turns[index].angle_deg);
    study_scene_t scene;
    homography_t homography;
    study_scene(&scene, &sizes);
    if (!homography_from_pose(&homography, &scene.camera, &scene.wall, &pose))
        return;
    grid_from_homography(&grids->grid[index], &homography);
    grids->step[index] = footprint_step(&homography);
    grids->measured[index] = measured_step(&grids->grid[index]);
}

static void print_point(FILE *csv, const grids_t *grids, int32_t i, int32_t j)
{
    fprintf(csv, "%d,%d", i, j);
    for (int t = 0; t < TURNS; t++) {
        double point[2];
        if (point_in_picture(&grids->grid[t], i, j, point))
            fprintf(csv, ",%.3f,%.3f", point[0], point[1]);
        else
            fputs(",,", csv);
    }
    fputc('\n', csv);
}

static void write_lines(study_t *study, const grids_t *grids)
{
    FILE *csv = study_csv_begin(study, "fig05.csv",
                                "column,row,about_x_x,about_x_y,about_y_x,about_y_y,about_z_x,about_z_y,"
                                "about_xyz_x,about_xyz_y");
    for (int32_t j = LINE_EVERY / 2; j < HEIGHT; j += LINE_EVERY) {
        for (int32_t i = 0; i < WIDTH; i += POINT_EVERY)
            print_point(csv, grids, i, j);
        fputc('\n', csv);
    }
    for (int32_t i = LINE_EVERY / 2; i < WIDTH; i += LINE_EVERY) {
        for (int32_t j = 0; j < HEIGHT; j += POINT_EVERY)
            print_point(csv, grids, i, j);
        fputc('\n', csv);
    }
    study_csv_end(study, csv);
}

static void write_steps(study_t *study, const grids_t *grids)
{
    FILE *csv = study_csv_begin(study, "fig05_k.csv", "turn,k_measured,k_in,k_all");
    for (int t = 0; t < TURNS; t++)
        fprintf(csv, "%s,%.4f,%.4f,%.4f\n", turns[t].name, grids->measured[t], grids->step[t].in_q16 / 65536.0,
                grids->step[t].all_q16 / 65536.0);
    study_csv_end(study, csv);
}

static void plot(study_t *study, const grids_t *grids, int t)
{
    char title[96], setup[256];
    snprintf(title, sizeof title, "%s: k = %.3f", turns[t].title, grids->step[t].in_q16 / 65536.0);
    snprintf(setup, sizeof setup,
             "set xrange [-20:%d]\nset yrange [%d:-20]\nset size ratio -1\nunset grid\n"
             "set object rectangle from 0,0 to %d,%d fs empty border lc rgb '#f5a65b' lw 1.5\n",
             WIDTH + 20, HEIGHT + 20, WIDTH, HEIGHT);
    const study_line_t line = {.csv = "fig05.csv", .x = 2 * t + 3, .y = 2 * t + 4};
    study_plot(study, &(study_plot_t){.name = turns[t].picture,
                                      .title = title,
                                      .x_label = "picture x, px",
                                      .y_label = "picture y, px",
                                      .setup = setup,
                                      .line = &line,
                                      .lines = 1});
}

static void report(study_t *study, const grids_t *grids)
{
    double away = 0.0;
    for (int t = 0; t < TURNS; t++)
        away = fmax(away, fabs(grids->step[t].in_q16 / 65536.0 - grids->measured[t]));
    study_section(study, "Figure 5: resampling grids",
                  "Wall 4 m x 2.25 m, viewer 2.5 m from its centre and looking at it, turned about the wall's axes. "
                  "Picture and projector 1920 x 1080; every 120th row and column of projector pixel centres, as the "
                  "fixed-point grid places them in the picture (orange frame).");
    study_text(study,
               "Each line joins centres of projector pixels. Where lines lie apart the wall has few pixels for "
               "the picture, and the picture must be smoothed there; where they crowd it has more than it needs. "
               "One number k for the whole wall, as the paper takes it, is the widest gap.");
    for (int t = 0; t < TURNS; t++) {
        plot(study, grids, t);
        study_figure(study, turns[t].picture, "fig05.csv", turns[t].title);
    }
    study_table(study, "fig05_k.csv",
                "Step k: measured neighbour by neighbour, and as a board computes it, over pixels in the picture (in) "
                "and over the whole wall (all).");
    study_claim(
        study, study_verdict(away <= 1e-3, 1), "wallwarp",
        "The k that a board computes from one pair of pixels of each row and column is the measured one, to 0.001.",
        "Largest difference over these four grids: %.4f px; the grid that is measured errs by up to 1/256 px.", away);
}

void study_fig05(study_t *study)
{
    grids_t *grids = study_memory(study, sizeof *grids);
    if (grids == NULL)
        return;
    study_parallel(study, TURNS, make_grid, grids);
    write_lines(study, grids);
    write_steps(study, grids);
    report(study, grids);
    free(grids);
}
