// SPDX-License-Identifier: Apache-2.0
// CSV files with one column per method, and plots of chosen methods from them.
#include "sim/study/study_mesh_curves.h"

#include <string.h>

#include "sim/study/study_methods.h"

enum { NAME_LENGTH = 64, HEADER_LENGTH = 1024, MAX_LINES = 8, EXTRA_COLOUR = 6, LS_COLOUR = 7 };

FILE *study_curves_begin(study_t *study, const char *name, const char *first)
{
    char header[HEADER_LENGTH];
    int used = snprintf(header, sizeof header, "%s", first);
    for (int m = 0; m < WARP_METHODS && used < HEADER_LENGTH; m++)
        if (study_measures(m))
            used += snprintf(header + used, sizeof header - (size_t)used, ",%s", warp_methods[m].name);
    return study_csv_begin(study, name, header);
}

void study_curves_print(FILE *csv, const double value[WARP_METHODS])
{
    for (int m = 0; m < WARP_METHODS; m++)
        if (study_measures(m))
            fprintf(csv, ",%.4f", value[m]);
    fputc('\n', csv);
}

/* The column of a method, 0 when the build has none of that name. */
static int column_of(const char *name, int before)
{
    int column = before;
    for (int m = 0; m < WARP_METHODS; m++) {
        column += study_measures(m);
        if (study_measures(m) && strcmp(warp_methods[m].name, name) == 0)
            return column;
    }
    return 0;
}

void study_curves_plot(study_t *study, const study_curves_t *curves)
{
    study_line_t line[MAX_LINES];
    int lines = 0, colour = 0;
    const int most = curves->extra != NULL ? MAX_LINES - 1 : MAX_LINES;
    for (int n = 0; curves->method[n] != NULL && lines < most; n++) {
        const char *method = curves->method[n];
        const int column = column_of(method, curves->before);
        const int own = strcmp(method, "ls") == 0 ? LS_COLOUR : colour++;
        if (column != 0)
            line[lines++] =
                (study_line_t){.csv = curves->csv, .x = curves->x, .y = column, .title = method, .colour = own};
    }
    if (curves->extra != NULL)
        line[lines++] = (study_line_t){.csv = curves->csv,
                                       .x = curves->x,
                                       .y = curves->extra_column,
                                       .title = curves->extra,
                                       .colour = EXTRA_COLOUR,
                                       .dashed = true};
    study_plot(study, &(study_plot_t){.name = curves->svg,
                                      .x_label = curves->x_label,
                                      .y_label = curves->y_label,
                                      .setup = curves->setup,
                                      .line = line,
                                      .lines = lines});
    study_figure(study, curves->svg, curves->csv, curves->caption);
}

static void print_psnr(study_t *study, const char *name, const study_mesh_run_t *run, int32_t angles)
{
    FILE *csv = study_curves_begin(study, name, "angle_deg,k_in,k_all,coverage,limit");
    for (int32_t a = 0; a < angles; a++) {
        const study_mesh_result_t *found = &run[a].found;
        fprintf(csv, "%g,%.4f,%.4f,%.4f,%.4f", run[a].at.angle_deg, found->k_in, found->k_all, found->coverage,
                found->limit_db[STUDY_TRUTH_PICTURE]);
        study_curves_print(csv, found->psnr_db[STUDY_TRUTH_PICTURE]);
    }
    study_csv_end(study, csv);
}

static void plot_filter(study_t *study, const char *experiment, const study_mesh_case_t *at, const char *filter)
{
    static const char *const interpolators[] = {"nearest", "linear", "cubic", "spline"};
    enum { INTERPOLATORS = sizeof interpolators / sizeof interpolators[0], COLUMNS_BEFORE = 5 };
    const char *picture = study_image_name(at->image);
    char name[INTERPOLATORS][NAME_LENGTH], svg[NAME_LENGTH], csv[NAME_LENGTH], caption[2 * NAME_LENGTH];
    const char *method[MAX_LINES] = {NULL};
    for (int i = 0; i < INTERPOLATORS; i++) {
        snprintf(name[i], NAME_LENGTH, "%s+%s", filter, interpolators[i]);
        method[i] = name[i];
    }
    method[INTERPOLATORS] = "area";
    method[INTERPOLATORS + 1] = "mean+cubic";
    method[INTERPOLATORS + 2] = "ls";
    snprintf(svg, sizeof svg, "%s_%s_%s.svg", experiment, picture, filter);
    snprintf(csv, sizeof csv, "%s_%s.csv", experiment, picture);
    snprintf(caption, sizeof caption, "%s %d x %d on %d x %d, filter: %s", picture, at->sizes.picture_width,
             at->sizes.picture_height, at->sizes.panel_width, at->sizes.panel_height, filter);
    study_curves_plot(study, &(study_curves_t){.svg = svg,
                                               .csv = csv,
                                               .x_label = "angle of the viewer, degrees",
                                               .y_label = "PSNR, dB",
                                               .caption = caption,
                                               .x = 1,
                                               .before = COLUMNS_BEFORE,
                                               .method = method,
                                               .extra = "limit",
                                               .extra_column = COLUMNS_BEFORE});
}

void study_curves_by_filter(study_t *study, const char *experiment, const study_mesh_sweep_t *sweep)
{
    for (int32_t p = 0; p < sweep->places; p++) {
        const study_mesh_run_t *run = &sweep->run[p * sweep->angles];
        char csv[NAME_LENGTH];
        snprintf(csv, sizeof csv, "%s_%s.csv", experiment, study_image_name(run->at.image));
        print_psnr(study, csv, run, sweep->angles);
        plot_filter(study, experiment, &run->at, "kaiser");
        for (int f = 0; p == 0 && f < 3; f++)
            plot_filter(study, experiment, &run->at, (const char *[]){"butter", "gauss", "none"}[f]);
    }
}
