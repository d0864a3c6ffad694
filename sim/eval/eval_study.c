// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval study: the paper's figures again, and what lies beyond them, on one page.
#include "sim/eval/eval_study.h"

#include <argp.h>
#include <stdio.h>
#include <string.h>

#include "sim/program.h"
#include "sim/study/study_experiments.h"

static void say_names(const char *only, struct argp_state *state)
{
    char names[PROGRAM_NAMES_LENGTH] = "";
    for (const study_experiment_t *e = study_experiments; e->name != NULL; e++) {
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s", used > 0 ? ", " : "", e->name);
    }
    argp_error(state, "--only '%s': no such experiment, expected one of %s", only, names);
}

static void choose(study_options_t *options, const char *only, struct argp_state *state)
{
    for (const study_experiment_t *e = study_experiments; e->name != NULL; e++)
        if (strcmp(e->name, only) == 0) {
            options->experiment = e;
            options->experiments = 1;
            return;
        }
    say_names(only, state);
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    study_options_t *options = state->input;
    switch (key) {
    case 'q':
        options->quick = true;
        return 0;
    case 'o':
        options->folder = argument;
        return 0;
    case 'e':
        choose(options, argument, state);
        return 0;
    case ARGP_KEY_END:
        if (options->folder == NULL)
            argp_error(state, "--out is missing: a folder for the page and its files");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

int eval_study(int argc, char **argv)
{
    static const struct argp_option own[] = {
        {.name = "quick", .key = 'q', .doc = "Fewer angles and smaller pictures: under a minute on two cores"},
        {.name = "out", .key = 'o', .arg = "DIR", .doc = "Folder for index.html and its files; made if it is missing"},
        {.name = "only",
         .key = 'e',
         .arg = "NAME",
         .doc = "Run this experiment alone, such as 'fig 5', for a page of it alone; a wrong name lists them all"},
        {0},
    };
    static const struct argp argp = {
        .options = own,
        .parser = parse,
        .doc = "The paper's figures again, and what lies beyond them: DIR/index.html with its CSV and SVG files.\v"
               "Progress goes to stderr. Plots need gnuplot (Debian's gnuplot-nox).",
    };
    study_options_t options = {.experiment = study_experiments};
    while (study_experiments[options.experiments].name != NULL)
        options.experiments++;
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    char error[FILE_ERROR_LENGTH];
    if (!study_run(&options, error)) {
        fprintf(stderr, "%s: %s\n", argv[0], error);
        return PROGRAM_FAILED;
    }
    printf("%s/index.html\n", options.folder);
    return program_finish(argv[0]);
}
