// SPDX-License-Identifier: Apache-2.0
// wallwarp-eval psnr: the paper's mesh evaluation of methods, as CSV.
#include "sim/eval/eval_psnr.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/eval/eval_options.h"
#include "sim/eval/mesh_psnr.h"
#include "sim/files/png_file.h"
#include "sim/program.h"

enum { DEFAULT_FACTOR = 4, MAX_METHODS = 64 };

static const char limit_name[] = "limit";

typedef struct {
    warp_once_place_t place;
    const char *picture, *original;
    int32_t factor;
    const warp_method_t *method[MAX_METHODS]; /* NULL is the limit */
    int method_count;
} options_t;

/* What one run holds. */
typedef struct {
    warp_once_t once;
    image_t picture, truth, panel;
    mesh_t mesh;
} work_t;

static void add_method(options_t *options, const char *name, struct argp_state *state)
{
    const warp_method_t *method = warp_method_from_name(name);
    if (method == NULL && strcmp(name, limit_name) != 0) {
        char names[PROGRAM_NAMES_LENGTH];
        program_method_names(names);
        argp_error(state, "--method '%s': no such method, expected all, limit, %s", name, names);
    }
    if (options->method_count == MAX_METHODS)
        argp_error(state, "--method: too many methods, expected at most %d", MAX_METHODS);
    options->method[options->method_count++] = method;
}

static void parse_methods(options_t *options, char *list, struct argp_state *state)
{
    options->method_count = 0;
    if (strcmp(list, "all") == 0) {
        add_method(options, limit_name, state);
        for (int m = 0; m < WARP_METHODS; m++)
            add_method(options, warp_methods[m].name, state);
        return;
    }
    for (char *name = strsep(&list, ","); name != NULL; name = strsep(&list, ","))
        add_method(options, name, state);
}

static int32_t parse_factor(const char *text, struct argp_state *state)
{
    char *end = NULL;
    const long factor = strtol(text, &end, 10);
    if (end == text || *end != '\0' || factor < 1 || factor > MESH_MAX_FACTOR)
        argp_error(state, "--factor '%s': expected a whole number from 1 to %d", text, MESH_MAX_FACTOR);
    return (int32_t)factor;
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    options_t *options = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->place;
        return 0;
    case 'i':
        options->picture = argument;
        return 0;
    case 'o':
        options->original = argument;
        return 0;
    case 'f':
        options->factor = parse_factor(argument, state);
        return 0;
    case 'm':
        parse_methods(options, argument, state);
        return 0;
    case ARGP_KEY_END:
        if (options->picture == NULL)
            argp_error(state, "--in is missing: a PNG of the camera's size");
        if (options->method_count == 0)
            argp_error(state, "--method is missing: names of methods, or all");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* @return false when the frame could not be made. */
static bool print_row(work_t *work, const warp_method_t *method, double limit_db)
{
    const footprint_step_t step = footprint_step(&work->once.homography);
    double psnr_db = limit_db;
    if (method != NULL) {
        if (!warp_once(&work->once, method, &work->panel, &work->picture))
            return false;
        psnr_db = mesh_psnr_db(&work->mesh, &work->panel);
    }
    printf("%s,%.3f,%.3f,%.4f,%.4f,%.4f\n", method != NULL ? method->name : limit_name, psnr_db, limit_db,
           step.in_q16 / 65536.0, step.all_q16 / 65536.0, mesh_coverage(&work->mesh));
    return true;
}

/* Everything is read and its sizes agree. */
static int print_rows(work_t *work, const options_t *options, const char *command)
{
    puts("method,psnr_db,limit_db,k_in,k_all,coverage");
    mesh_limit(&work->mesh, &work->panel);
    const double limit_db = mesh_psnr_db(&work->mesh, &work->panel);
    for (int m = 0; m < options->method_count; m++)
        if (!print_row(work, options->method[m], limit_db)) {
            eval_error(command, "board %s: warp_frame refused the sizes", work->once.board.name);
            return WARP_ONCE_FAILED;
        }
    return program_finish(command);
}

static int sample_and_print(work_t *work, const options_t *options, const char *command)
{
    double_homography_t homography;
    double_homography_from_fixed(&homography, &work->once.homography);
    const char *path = options->original != NULL ? options->original : options->picture;
    char error[FILE_ERROR_LENGTH];
    if (!mesh_sample(&work->mesh, &homography, &work->truth, options->factor, error)) {
        eval_error(command, "%s: %s", path, error);
        return WARP_ONCE_FAILED;
    }
    int status = WARP_ONCE_FAILED;
    if (warp_once_panel(&work->once, IMAGE_GRAY8, &work->panel))
        status = print_rows(work, options, command);
    else
        eval_error(command, "out of memory");
    free(work->panel.data);
    mesh_free(&work->mesh);
    return status;
}

static int read_and_print(work_t *work, const options_t *options, const char *command)
{
    char error[ROOM_MESSAGE_LENGTH];
    if (!warp_once_read(&work->once, options->picture, IMAGE_GRAY8, &work->picture, error)) {
        eval_error(command, "%s", error);
        return WARP_ONCE_FAILED;
    }
    int status = WARP_ONCE_FAILED;
    work->truth = work->picture;
    if (options->original == NULL || png_file_load(options->original, IMAGE_GRAY8, &work->truth, error))
        status = sample_and_print(work, options, command);
    else
        eval_error(command, "%s", error);
    if (work->truth.data != work->picture.data)
        free(work->truth.data);
    free(work->picture.data);
    return status;
}

int eval_psnr(int argc, char **argv)
{
    static const struct argp_option own[] = {
        {.name = "in", .key = 'i', .arg = "PNG", .doc = "The picture, of the camera's size; colour is taken as luma"},
        {.name = "method", .key = 'm', .arg = "M[,M...]", .doc = "Methods to try, or all; limit is the best possible"},
        {.name = "factor", .key = 'f', .arg = "S", .doc = "Samples per picture pixel along each axis (default 4)"},
        {.name = "original",
         .key = 'o',
         .arg = "PNG",
         .doc = "Take this finer original as the truth: q times the picture's size; S is a multiple of q"},
        {0},
    };
    static const struct argp_child children[] = {{.argp = &eval_place_argp}, {0}};
    static const struct argp argp = {
        .options = own,
        .parser = parse,
        .args_doc = "ROOM",
        .doc = "How well each method's wall matches the picture from the viewer's eye: the paper's mesh evaluation.\v"
               "CSV on stdout. psnr_db is 'inf' when no sample differs; coverage is the share of samples on the wall.",
        .children = children,
    };
    options_t options = {.factor = DEFAULT_FACTOR};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    work_t work = {0};
    const warp_once_status_t opened = eval_open(&work.once, &options.place, argv[0]);
    if (opened != WARP_ONCE_OK)
        return (int)opened;
    const int status = read_and_print(&work, &options, argv[0]);
    warp_once_close(&work.once);
    return status;
}
