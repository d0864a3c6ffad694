// SPDX-License-Identifier: Apache-2.0
// Where in the picture the gap to the limit comes from: squared error by the projector pixels' footprint area.
#include <math.h>
#include <stdlib.h>

#include "sim/study/footprints_bins.h"
#include "sim/study/footprints_claims.h"
#include "sim/study/study_experiments.h"
#include "sim/study/study_mesh_curves.h"
#include "sim/study/study_methods.h"

enum { NAME_LENGTH = 64, CAPTION_LENGTH = 128, COLUMNS_BEFORE = 2 };

static const double angle_deg = 60.0;
/* Square picture pixels: magnified below the one; from the other on two pixels along an axis, on average. */
static const double near_area = 1.0, far_area = 4.0;

static const char *const truth_name[STUDY_TRUTHS] = {"picture", "original"};

/* One truth: what every method gets wrong, by footprint. */
typedef struct {
    study_mesh_case_t at;
    study_truth_t truth;
    footprints_bin_t bin[WARP_METHODS][FOOTPRINTS_BINS];
    char error[FILE_ERROR_LENGTH];
} footprints_case_t;

static void measure(void *context, int32_t index)
{
    footprints_case_t *one = (footprints_case_t *)context + index;
    study_mesh_t mesh;
    if (!study_mesh_open(&mesh, &one->at, one->error))
        return;
    for (int m = 0; m < WARP_METHODS; m++)
        if (study_measures(m)) {
            study_mesh_warp(&mesh, m);
            footprints_bins(one->bin[m], &mesh.mesh[one->truth], &mesh.exact, &mesh.panel);
        }
    study_mesh_close(&mesh);
}

/* Rms error above the limit, gray levels; NAN without samples. */
static double rms_of(const footprints_bin_t *bin)
{
    return sqrt(bin->error / (double)bin->samples);
}

/* Both CSV files have a row for each bin with pixels: its middle, the share of pixels, a column for each method. */
static void write_bins(study_t *study, const footprints_case_t *one, const char *name, bool shares)
{
    FILE *csv = study_curves_begin(study, name, "area_px2,pixels_percent");
    const double pixels = (double)footprints_bins_sum(one->bin[0], 0.0, HUGE_VAL).pixels;
    for (int b = 0; b < FOOTPRINTS_BINS; b++) {
        if (one->bin[0][b].pixels == 0)
            continue;
        double value[WARP_METHODS];
        for (int m = 0; m < WARP_METHODS; m++) {
            const footprints_bin_t *bin = &one->bin[m][b];
            value[m] =
                shares ? 100.0 * bin->error / footprints_bins_sum(one->bin[m], 0.0, HUGE_VAL).error : rms_of(bin);
        }
        fprintf(csv, "%.4g,%.3f", sqrt(footprints_bin_area(b) * footprints_bin_area(b + 1)),
                100.0 * (double)one->bin[0][b].pixels / pixels);
        study_curves_print(csv, value);
    }
    study_csv_end(study, csv);
}

static void show_bins(study_t *study, const footprints_case_t *one, bool shares)
{
    static const char *const method[] = {"none+nearest", "none+cubic", "gauss+cubic", "kaiser+cubic",
                                         "area",         "mean+cubic", "ls",          NULL};
    const char *what = shares ? "share" : "rms";
    char csv[NAME_LENGTH], svg[NAME_LENGTH], caption[CAPTION_LENGTH];
    snprintf(csv, sizeof csv, "footprints_%s_%s.csv", truth_name[one->truth], what);
    snprintf(svg, sizeof svg, "footprints_%s_%s.svg", truth_name[one->truth], what);
    snprintf(caption, sizeof caption, "%s, truth: the %s",
             shares ? "Which footprints a method's error above the limit is in" : "Error above the limit by footprint",
             truth_name[one->truth]);
    write_bins(study, one, csv, shares);
    study_curves_plot(study, &(study_curves_t){.svg = svg,
                                               .csv = csv,
                                               .x_label = "footprint area, square picture pixels",
                                               .y_label = shares ? "share of its error, %" : "rms error, gray levels",
                                               .caption = caption,
                                               .setup = "set logscale x 2\nset yrange [0:*]\n",
                                               .x = 1,
                                               .before = COLUMNS_BEFORE,
                                               .method = method,
                                               .extra = shares ? "share of pixels" : NULL,
                                               .extra_column = COLUMNS_BEFORE});
}

static double rms_between(const footprints_case_t *one, const char *name, double from, double to)
{
    const warp_method_t *method = warp_method_from_name(name);
    if (method == NULL)
        return (double)NAN;
    const footprints_bin_t part = footprints_bins_sum(one->bin[method - warp_methods], from, to);
    return rms_of(&part);
}

static footprints_parts_t parts_of(const footprints_case_t *one)
{
    static const char *const name[FOOTPRINTS_METHODS] = {"none+cubic", "gauss+cubic", "kaiser+cubic", "butter+cubic",
                                                         "mean+cubic"};
    footprints_parts_t parts;
    for (int m = 0; m < FOOTPRINTS_METHODS; m++) {
        parts.near[m] = rms_between(one, name[m], 0.0, near_area);
        parts.far[m] = rms_between(one, name[m], far_area, HUGE_VAL);
    }
    return parts;
}

static void say_parts(study_t *study, const footprints_case_t *one, const footprints_parts_t *parts)
{
    study_text(
        study,
        "%s %d x %d, truth: the %s. Rms error above the limit, gray levels. Near part, footprints below %g: "
        "none+cubic %.2f, gauss+cubic %.2f, kaiser+cubic %.2f, butter+cubic %.2f, mean+cubic %.2f. Far part, from "
        "%g on: none+cubic %.2f, gauss+cubic %.2f, kaiser+cubic %.2f, butter+cubic %.2f, mean+cubic %.2f.",
        study_image_name(one->at.image), one->at.sizes.picture_width, one->at.sizes.picture_height,
        truth_name[one->truth], near_area, parts->near[FOOTPRINTS_NONE], parts->near[FOOTPRINTS_GAUSS],
        parts->near[FOOTPRINTS_KAISER], parts->near[FOOTPRINTS_BUTTER], parts->near[FOOTPRINTS_MEAN], far_area,
        parts->far[FOOTPRINTS_NONE], parts->far[FOOTPRINTS_GAUSS], parts->far[FOOTPRINTS_KAISER],
        parts->far[FOOTPRINTS_BUTTER], parts->far[FOOTPRINTS_MEAN]);
}

static void say(study_t *study, const footprints_case_t one[STUDY_TRUTHS])
{
    footprints_parts_t parts[STUDY_TRUTHS];
    for (int truth = 0; truth < STUDY_TRUTHS; truth++) {
        parts[truth] = parts_of(&one[truth]);
        say_parts(study, &one[truth], &parts[truth]);
    }
    const footprints_verdicts_t verdicts = footprints_verdicts(parts);
    const footprints_parts_t *p = &parts[STUDY_TRUTH_ORIGINAL];
    study_claim(study, verdicts.filters_blur_near, "wallwarp", "One cut-off for the whole wall blurs its near part.",
                "k is that of the largest footprint. Where footprints are below %g nothing needs a filter; against the "
                "original the error there is %.1f (gauss), %.1f (kaiser) and %.1f times (butter) that of none+cubic.",
                near_area, p->near[FOOTPRINTS_GAUSS] / p->near[FOOTPRINTS_NONE],
                p->near[FOOTPRINTS_KAISER] / p->near[FOOTPRINTS_NONE],
                p->near[FOOTPRINTS_BUTTER] / p->near[FOOTPRINTS_NONE]);
    study_claim(study, verdicts.none_aliases_far, "wallwarp", "Without a filter the far part aliases.",
                "From %g square pixels on, against the original, none+cubic errs %.1f times as much as gauss+cubic and "
                "%.1f times as much as mean+cubic.",
                far_area, p->far[FOOTPRINTS_NONE] / p->far[FOOTPRINTS_GAUSS],
                p->far[FOOTPRINTS_NONE] / p->far[FOOTPRINTS_MEAN]);
    study_claim(study, verdicts.mean_is_best, "wallwarp",
                "A mean over each pixel's own footprint is as sharp as no filter near, and smoother than a filter far.",
                "Against the original mean+cubic errs %.2f times as much as none+cubic near, and %.2f times as much as "
                "gauss+cubic far.",
                p->near[FOOTPRINTS_MEAN] / p->near[FOOTPRINTS_NONE],
                p->far[FOOTPRINTS_MEAN] / p->far[FOOTPRINTS_GAUSS]);
}

static void show_settings(study_t *study, const footprints_case_t one[STUDY_TRUTHS])
{
    const study_sizes_t *first = &one[0].at.sizes, *second = &one[1].at.sizes;
    study_section(
        study, "Where the gap comes from",
        "studio, viewer at %g degrees. Truth picture: %d x %d on %d x %d, S = %d. Truth original: %d x %d on %d x "
        "%d, S = %d, original %d times as fine. Footprint area: |det J| at the projector pixel's centre.",
        angle_deg, first->picture_width, first->picture_height, first->panel_width, first->panel_height,
        one[0].at.factor, second->picture_width, second->picture_height, second->panel_width, second->panel_height,
        one[1].at.factor, one[1].at.finer);
    study_text(study,
               "Within a projector pixel nothing but its one value can be chosen. What a method gets wrong there "
               "is counted by the pixel's footprint in the picture: below 1 the picture is magnified, in the near "
               "part of the wall; above, minified. Footprints of one size are a strip of the picture, each with "
               "its own content: compare methods at one size, not one method at two.");
}

void study_footprints(study_t *study)
{
    static const study_sizes_t paper = {1920, 1080, 1920, 1080}, small = {480, 270, 480, 270};
    footprints_case_t *one = study_memory(study, STUDY_TRUTHS * sizeof *one);
    if (one == NULL)
        return;
    one[0] = (footprints_case_t){
        .at = {study_quick(study) ? small : paper, STUDY_STUDIO, .finer = 1, .factor = 4, .angle_deg = angle_deg},
        .truth = STUDY_TRUTH_PICTURE};
    one[1] = (footprints_case_t){.at = {small, STUDY_STUDIO, .finer = 4, .factor = 4, .angle_deg = angle_deg},
                                 .truth = STUDY_TRUTH_ORIGINAL};
    study_parallel(study, STUDY_TRUTHS, measure, one);
    for (int truth = 0; truth < STUDY_TRUTHS; truth++)
        if (one[truth].error[0] != '\0')
            study_fail(study, "%s", one[truth].error);
    if (!study_failed(study)) {
        show_settings(study, one);
        for (int truth = 0; truth < STUDY_TRUTHS; truth++)
            for (int shares = 0; shares < 2; shares++)
                show_bins(study, &one[truth], shares != 0);
        say(study, one);
    }
    free(one);
}
