// SPDX-License-Identifier: Apache-2.0
// The experiment of the moving viewer: how much still content flickers with each method, and how sharp it is.
#include <stdlib.h>
#include <string.h>

#include "sim/study/flicker_labels.h"
#include "sim/study/flicker_watch.h"
#include "sim/study/study_experiments.h"
#include "sim/study/study_methods.h"
#include "sim/study/study_image.h"

enum { SIZES = 3, ANGLES = 2, PHOTOGRAPHS = 3, PLOTS = SIZES * ANGLES, NAME_LENGTH = 40 };

static const double angle_deg[ANGLES] = {20.0, 50.0};

/* Looks: three or more in each projector pixel, along each side. */
typedef struct {
    const char *name, *text;
    study_sizes_t size;
    int32_t looks;
} setting_t;

static const setting_t setting[SIZES] = {
    {"equal", "picture as large as the projector", {480, 270, 480, 270}, 6},
    {"smaller", "picture smaller than the projector", {240, 135, 960, 540}, 12},
    {"larger", "picture larger than the projector", {480, 270, 240, 135}, 4},
};

/* Plot p is of size p / ANGLES and angle p % ANGLES. */
typedef struct {
    study_t *study;
    int32_t frames, photographs, methods;
    const warp_method_t *method[WARP_METHODS];
    study_scene_t scene[SIZES];
    image_t picture[SIZES][PHOTOGRAPHS];
    flicker_case_t seen[PLOTS * PHOTOGRAPHS]; /* case c is of plot c / photographs */
    flicker_case_t mean[PLOTS];               /* over the photographs */
} experiment_t;

/* All sizes are halved with --quick. */
static void prepare(experiment_t *experiment)
{
    const bool quick = study_quick(experiment->study);
    const int32_t part = quick ? 2 : 1;
    experiment->frames = quick ? 6 : 16;
    experiment->photographs = quick ? 1 : PHOTOGRAPHS;
    for (int32_t m = 0; m < WARP_METHODS; m++)
        if (study_measures(m))
            experiment->method[experiment->methods++] = &warp_methods[m];
    for (int32_t size = 0; size < SIZES; size++) {
        const study_sizes_t *full = &setting[size].size;
        const study_sizes_t sizes = {full->picture_width / part, full->picture_height / part, full->panel_width / part,
                                     full->panel_height / part};
        study_scene(&experiment->scene[size], &sizes);
        for (int32_t p = 0; p < experiment->photographs; p++)
            if (!study_image((study_image_t)p, sizes.picture_width, sizes.picture_height, 1,
                             &experiment->picture[size][p], NULL))
                study_fail(experiment->study, "out of memory");
    }
}

/* Each case with all methods, not yet measured. */
static void name_cases(experiment_t *experiment)
{
    for (int32_t plot = 0; plot < PLOTS; plot++) {
        flicker_case_t *mean = &experiment->mean[plot];
        snprintf(mean->text, sizeof mean->text, "%s, %g degrees", setting[plot / ANGLES].text,
                 angle_deg[plot % ANGLES]);
        mean->points = experiment->methods;
        for (int32_t m = 0; m < experiment->methods; m++)
            mean->point[m].name = experiment->method[m]->name;
        for (int32_t p = 0; p < experiment->photographs; p++) {
            flicker_case_t *seen = &experiment->seen[plot * experiment->photographs + p];
            *seen = *mean;
            snprintf(seen->text, sizeof seen->text, "%s, %g degrees, %s", setting[plot / ANGLES].text,
                     angle_deg[plot % ANGLES], study_image_name((study_image_t)p));
        }
    }
}

static void measure(void *context, int32_t index)
{
    experiment_t *experiment = context;
    const int32_t m = index % experiment->methods, c = index / experiment->methods;
    const int32_t plot = c / experiment->photographs, size = plot / ANGLES;
    const flicker_watch_t watch = {
        .scene = &experiment->scene[size],
        .picture = &experiment->picture[size][c % experiment->photographs],
        .method = experiment->method[m],
        .walk = {study_pose(angle_deg[plot % ANGLES]), study_walk_speed_m_s, study_walk_bob_m, 0.0},
        .frames = experiment->frames,
        .looks = setting[size].looks};
    flicker_sums_t sums;
    if (!flicker_watch(&sums, &watch)) {
        study_fail(experiment->study, "out of memory");
        return;
    }
    experiment->seen[c].point[m].sharpness = flicker_sharpness(&sums);
    experiment->seen[c].point[m].flicker = flicker_level(&sums);
}

static void take_means(experiment_t *experiment)
{
    for (int32_t c = 0; c < PLOTS * experiment->photographs; c++)
        for (int32_t m = 0; m < experiment->methods; m++) {
            const flicker_point_t *point = &experiment->seen[c].point[m];
            flicker_point_t *mean = &experiment->mean[c / experiment->photographs].point[m];
            mean->sharpness += point->sharpness / experiment->photographs;
            mean->flicker += point->flicker / experiment->photographs;
        }
}

static void write_points(const experiment_t *experiment)
{
    FILE *csv =
        study_csv_begin(experiment->study, "flicker.csv", "sizes,angle_deg,picture,method,sharpness,flicker_levels");
    for (int32_t c = 0; c < PLOTS * experiment->photographs; c++)
        for (int32_t m = 0; m < experiment->methods; m++) {
            const flicker_point_t *point = &experiment->seen[c].point[m];
            const int32_t plot = c / experiment->photographs;
            fprintf(csv, "%s,%g,%s,%s,%.4f,%.4f\n", setting[plot / ANGLES].name, angle_deg[plot % ANGLES],
                    study_image_name((study_image_t)(c % experiment->photographs)), point->name, point->sharpness,
                    point->flicker);
        }
    study_csv_end(experiment->study, csv);
}

/* The family's marks have a column of their own, for their colour. */
static void write_marks(study_t *study, const char *name, const flicker_case_t *mean)
{
    FILE *csv = study_csv_begin(study, name, "method,sharpness,others_levels,family_levels");
    for (int32_t m = 0; m < mean->points; m++) {
        const flicker_point_t *point = &mean->point[m];
        const bool family = flicker_in_family(point->name);
        fprintf(csv, "%s,%.4f,%s%.4f%s\n", point->name, point->sharpness, family ? "," : "", point->flicker,
                family ? "" : ",");
    }
    study_csv_end(study, csv);
}

static void draw(const experiment_t *experiment, int32_t plot)
{
    const char *size = setting[plot / ANGLES].name;
    const double angle = angle_deg[plot % ANGLES];
    const flicker_case_t *mean = &experiment->mean[plot];
    char marks[NAME_LENGTH], svg[NAME_LENGTH], setup[FLICKER_SETUP_LENGTH];
    snprintf(marks, sizeof marks, "flicker_%s_%g.csv", size, angle);
    snprintf(svg, sizeof svg, "flicker_%s_%g.svg", size, angle);
    write_marks(experiment->study, marks, mean);
    const flicker_axes_t axes = flicker_axes(mean);
    flicker_labels(setup, &axes, mean);
    const study_line_t line[] = {{marks, 2, 3, NULL, 0, false, true}, {marks, 2, 4, NULL, 2, false, true}};
    study_plot(experiment->study, &(study_plot_t){.name = svg,
                                                  .x_label = "sharpness, 1 = ideal",
                                                  .y_label = "flicker, gray levels",
                                                  .setup = setup,
                                                  .width = axes.width,
                                                  .height = axes.height,
                                                  .line = line,
                                                  .lines = 2});
    study_figure(experiment->study, svg, marks, mean->text);
}

static void begin_section(const experiment_t *experiment)
{
    study_section(
        experiment->study, "A moving viewer: flicker and sharpness",
        "A viewer walks past the wall at %.1f m/s, bobbing %.0f mm at %.1f Hz, %d frames at %.0f Hz around the "
        "pose at 20 or 50 degrees, the head not turning. Sizes of picture and projector%s: equal 480x270 and "
        "480x270, smaller 240x135 and 960x540, larger 480x270 and 240x135; the eye takes 6x6, 12x12, 4x4 looks "
        "in each picture pixel. Pictures: studio%s. Pixels within %.0f of the edge of the wall or the picture are "
        "left out.",
        study_walk_speed_m_s, study_walk_bob_m * 1e3, study_walk_bob_hz, experiment->frames, flicker_watch_hz,
        study_quick(experiment->study) ? ", halved here" : "",
        experiment->photographs > 1 ? ", astronaut, coffee; a plot shows their mean" : "", flicker_watch_margin_px);
    study_text(experiment->study,
               "The picture is the same in every frame, so the eye should see no change: what changes is the wall's "
               "sampling grid, which slides under the picture as the viewer walks. Flicker is the mean absolute change "
               "of what the eye sees from frame to frame, in its own picture. Sharpness is the part of the ideal "
               "picture's gradient that arrives in what it sees, as a regression: aliases, noise and the edges of "
               "pixels do not follow the ideal gradient and so count for nothing. A good method is far right and low; "
               "blur alone moves left and down. area is made for another truth, the picture as squares: where a "
               "footprint is as large as a picture pixel it takes one of them or the mean of two by where it lies, a "
               "blur that comes and goes. Where the picture is smaller than the projector nothing is filtered, and "
               "methods of one interpolator are the same.");
}

/* Say how a claim fares, with its worst case. */
static void claim(const experiment_t *experiment, const flicker_defeats_t *defeats, const char *text)
{
    char worst[300] = "";
    if (defeats->worst != NULL)
        snprintf(worst, sizeof worst,
                 " Worst: %s with sharpness %.3f and flicker %.2f against %.3f and %.2f of %s (%s).",
                 defeats->victor->name, defeats->victor->sharpness, defeats->victor->flicker,
                 defeats->victim->sharpness, defeats->victim->flicker, defeats->victim->name, defeats->worst->text);
    study_claim(experiment->study, study_verdict(defeats->pairs - defeats->defeats, defeats->pairs), "wallwarp", text,
                "In %d of %d comparisons (a method from outside the family, a size, an angle, a picture) the outsider "
                "is sharper by more than %g and steadier by more than %g gray levels.%s",
                defeats->defeats, defeats->pairs, flicker_least_sharper, flicker_least_steadier, worst);
}

static void claims(const experiment_t *experiment)
{
    const int32_t cases = PLOTS * experiment->photographs;
    const flicker_defeats_t all = flicker_defeats(experiment->seen, cases, NULL);
    study_headline(experiment->study,
                   "For a viewer who walks, a method from outside is both sharper and steadier than each of area, "
                   "mean+cubic and mean+spline in %d of %d comparisons.",
                   all.defeats, all.pairs);
    claim(experiment, &all, "No method is both sharper and steadier than the adaptive family.");
    for (int32_t m = 0; m < experiment->methods; m++) {
        const char *name = experiment->method[m]->name;
        if (!flicker_in_family(name))
            continue;
        char text[120];
        snprintf(text, sizeof text, "No method outside the adaptive family is both sharper and steadier than %s.",
                 name);
        const flicker_defeats_t one = flicker_defeats(experiment->seen, cases, name);
        claim(experiment, &one, text);
    }
}

static void show(experiment_t *experiment)
{
    take_means(experiment);
    write_points(experiment);
    begin_section(experiment);
    for (int32_t plot = 0; plot < PLOTS; plot++)
        draw(experiment, plot);
    study_data(experiment->study, "flicker.csv", "Every picture by itself:");
    claims(experiment);
}

void study_flicker(study_t *study)
{
    experiment_t *experiment = study_memory(study, sizeof *experiment);
    if (experiment == NULL)
        return;
    experiment->study = study;
    prepare(experiment);
    name_cases(experiment);
    study_parallel(study, PLOTS * experiment->photographs * experiment->methods, measure, experiment);
    if (!study_failed(study))
        show(experiment);
    for (int32_t size = 0; size < SIZES; size++)
        for (int32_t p = 0; p < PHOTOGRAPHS; p++)
            free(experiment->picture[size][p].data);
    free(experiment);
}
