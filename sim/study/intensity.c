// SPDX-License-Identifier: Apache-2.0
// The experiment beyond the paper's ideal pixels: uneven light within a pixel, and a wall that shines.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/study/intensity_order.h"
#include "sim/study/intensity_see.h"
#include "sim/study/study_experiments.h"
#include "sim/study/study_methods.h"
#include "sim/study/study_image.h"

enum { MAX_ANGLES = 5, PHOTOGRAPHS = 3, TEXT_LENGTH = 900 };

/* Straight on, equal grids fall upon each other: no angle of use. */
static const double angle_deg[MAX_ANGLES] = {5.0, 20.0, 35.0, 50.0, 60.0};

/* Differences that nobody sees, as for advise: methods that near may change places. */
static const double least_db = 0.1;

/* What of their order methods must keep for a model to leave it as it is. */
static const double alike_percent = 95.0;

typedef struct {
    study_t *study;
    int32_t angles, angle_step, photographs, methods, default_method;
    const warp_method_t *method[WARP_METHODS];
    study_scene_t scene;
    image_t picture[PHOTOGRAPHS];
    intensity_seen_t seen[MAX_ANGLES * PHOTOGRAPHS][INTENSITY_MODELS]; /* place: angle * photographs + photograph */
} experiment_t;

static void prepare(experiment_t *experiment)
{
    const bool quick = study_quick(experiment->study);
    const study_sizes_t sizes = quick ? (study_sizes_t){160, 90, 160, 90} : (study_sizes_t){320, 180, 320, 180};
    experiment->angle_step = quick ? 2 : 1;
    experiment->angles = quick ? 3 : MAX_ANGLES;
    experiment->photographs = quick ? 1 : PHOTOGRAPHS;
    for (int32_t m = 0; m < WARP_METHODS; m++) {
        if (!study_measures(m))
            continue;
        if (&warp_methods[m] == warp_method_default())
            experiment->default_method = experiment->methods;
        experiment->method[experiment->methods++] = &warp_methods[m];
    }
    study_scene(&experiment->scene, &sizes);
    for (int32_t p = 0; p < experiment->photographs; p++)
        if (!study_image((study_image_t)p, sizes.picture_width, sizes.picture_height, 1, &experiment->picture[p], NULL))
            study_fail(experiment->study, "out of memory");
}

static double angle_of(const experiment_t *experiment, int32_t place)
{
    return angle_deg[place / experiment->photographs * experiment->angle_step];
}

static void measure(void *context, int32_t place)
{
    experiment_t *experiment = context;
    const intensity_place_t seen_at = {.scene = &experiment->scene,
                                       .picture = &experiment->picture[place % experiment->photographs],
                                       .angle_deg = angle_of(experiment, place),
                                       .method = experiment->method,
                                       .methods = experiment->methods};
    if (!intensity_see(experiment->seen[place], &seen_at))
        study_fail(experiment->study, "out of memory");
}

/* The model's figures of a row, mean over the photographs. */
static double mean_db(const experiment_t *experiment, int32_t model, int32_t angle, int32_t row, bool fine)
{
    double sum = 0.0;
    for (int32_t p = 0; p < experiment->photographs; p++) {
        const intensity_seen_t *seen = &experiment->seen[angle * experiment->photographs + p][model];
        sum += (fine ? seen->fine_db : seen->eye_db)[row];
    }
    return sum / experiment->photographs;
}

static void write_all(const experiment_t *experiment)
{
    FILE *csv = study_csv_begin(experiment->study, "intensity.csv",
                                "model,angle_deg,picture,method,eye_db,fine_db,uneven_db,mean_gain");
    const int32_t places = experiment->angles * experiment->photographs;
    for (int32_t n = 0; n < INTENSITY_MODELS * places; n++) {
        const int32_t model = n / places, place = n % places;
        const intensity_seen_t *seen = &experiment->seen[place][model];
        for (int32_t row = 0; row <= experiment->methods; row++)
            fprintf(csv, "%s,%g,%s,%s,%.3f,%.3f,%.3f,%.4f\n", intensity_models[model].name, angle_of(experiment, place),
                    study_image_name((study_image_t)(place % experiment->photographs)),
                    row < experiment->methods ? experiment->method[row]->name : "limit", seen->eye_db[row],
                    seen->fine_db[row], seen->uneven_db[row], seen->gain);
    }
    study_csv_end(experiment->study, csv);
}

/* The default's PSNR against angle, one column for each model. */
static void draw(const experiment_t *experiment, const char *csv_name, const char *svg, bool fine)
{
    char header[TEXT_LENGTH] = "angle_deg";
    study_line_t line[INTENSITY_MODELS];
    for (int32_t model = 0; model < INTENSITY_MODELS; model++) {
        strcat(header, ",");
        strcat(header, intensity_models[model].name);
        line[model] = (study_line_t){csv_name, 1, model + 2, intensity_models[model].name, model, false, false};
    }
    FILE *csv = study_csv_begin(experiment->study, csv_name, header);
    for (int32_t a = 0; a < experiment->angles; a++) {
        fprintf(csv, "%g", angle_deg[a * experiment->angle_step]);
        for (int32_t model = 0; model < INTENSITY_MODELS; model++)
            fprintf(csv, ",%.3f", mean_db(experiment, model, a, experiment->default_method, fine));
        fputc('\n', csv);
    }
    study_csv_end(experiment->study, csv);
    study_plot(experiment->study, &(study_plot_t){.name = svg,
                                                  .x_label = "angle, degrees",
                                                  .y_label = "PSNR of mean+cubic, dB",
                                                  .line = line,
                                                  .lines = INTENSITY_MODELS});
}

/* What a model changes, over all places. */
typedef struct {
    intensity_order_t eye, fine;
    int32_t best, family; /* the methods with the best mean as the eye sees it: of all, of the adaptive family */
    double family_db;     /* the family's mean below the best of all */
    double default_db;    /* the default's below it */
    double over_limit_db; /* the default's mean over that of the limit of ideal pixels */
    double gain;
} effect_t;

static effect_t effect_of(const experiment_t *experiment, int32_t model)
{
    const int32_t places = experiment->angles * experiment->photographs;
    double mean[INTENSITY_ROWS] = {0.0};
    effect_t effect = {.family = experiment->default_method};
    for (int32_t place = 0; place < places; place++) {
        const intensity_seen_t *ideal = &experiment->seen[place][0], *seen = &experiment->seen[place][model];
        intensity_order_add(&effect.eye, ideal->eye_db, seen->eye_db, experiment->methods, least_db);
        intensity_order_add(&effect.fine, ideal->fine_db, seen->fine_db, experiment->methods, least_db);
        effect.gain += seen->gain / places;
        for (int32_t row = 0; row <= experiment->methods; row++)
            mean[row] += seen->eye_db[row] / places;
    }
    for (int32_t m = 0; m < experiment->methods; m++) {
        if (mean[m] > mean[effect.best])
            effect.best = m;
        if (mean[m] > mean[effect.family] && warp_averages(experiment->method[m]->resampler))
            effect.family = m;
    }
    effect.family_db = mean[effect.best] - mean[effect.family];
    effect.default_db = mean[effect.best] - mean[experiment->default_method];
    effect.over_limit_db = mean[experiment->default_method] - mean[experiment->methods];
    return effect;
}

static void write_effects(const experiment_t *experiment)
{
    FILE *csv = study_csv_begin(experiment->study, "intensity_order.csv",
                                "model,mean gain,same order %,the same sample by sample,best method,"
                                "best of the family,below it dB,mean+cubic below it dB,"
                                "mean+cubic over the limit dB");
    for (int32_t model = 0; model < INTENSITY_MODELS; model++) {
        const effect_t effect = effect_of(experiment, model);
        fprintf(csv, "%s,%.3f,%.1f,%.1f,%s,%s,%.2f,%.2f,%.2f\n", intensity_models[model].name, effect.gain,
                intensity_order_percent(&effect.eye), intensity_order_percent(&effect.fine),
                experiment->method[effect.best]->name, experiment->method[effect.family]->name, effect.family_db,
                effect.default_db, effect.over_limit_db);
    }
    study_csv_end(experiment->study, csv);
}

static void begin_section(const experiment_t *experiment)
{
    const camera_t *camera = &experiment->scene.camera;
    study_section(
        experiment->study, "Beyond the paper: uneven pixels and a shining wall",
        "Picture and projector %dx%d, %dx%d samples in each picture pixel; viewer at 2.5 m, %g to %g degrees; "
        "studio%s. Pixels, along each side: dark gap, lit on 85 %% of the pitch; bright middle, a raised cosine "
        "over the whole pitch; both, half that cosine on 85 %%. Shining wall: light 0.4 + 1.6 cos^%g of the angle "
        "between the eye and the mirrored ray of a projector %g m before the wall and %g m above its centre.",
        camera->width, camera->height, INTENSITY_FACTOR, INTENSITY_FACTOR, angle_deg[0], angle_deg[MAX_ANGLES - 1],
        experiment->photographs > 1 ? ", astronaut and coffee, means over the three" : "", intensity_exponent,
        -intensity_projector_m[2], -intensity_projector_m[1]);
    study_text(
        experiment->study,
        "The paper draws each projector pixel as an even square on a matt wall, and says that its model can be "
        "extended. Here a pixel's light has a shape (its mean over the pixel stays 1), and the wall throws more "
        "light one way than another. Gray levels stand for light, as in the paper. The eye adapts: light is "
        "divided by the wall's mean gain. PSNR is taken against the true picture on the same wall, so that it "
        "compares pictures and not brightness (uneven_db in the CSV: against a true picture on an even wall; a "
        "hot spot then outweighs all that the methods differ in). It is taken twice: after a blur as wide as a picture "
        "pixel, for an eye that does not make out single pixels; and sample by sample, as in the paper, which "
        "counts each pixel's own shape as an error. Where pixels become larger than the picture's, at strong "
        "angles, their shape shows through the blur.");
}

static void claim(const experiment_t *experiment)
{
    double fewest_percent = 100.0, behind_db = 0.0;
    int32_t alike = 0;
    for (int32_t model = 1; model < INTENSITY_MODELS; model++) {
        const effect_t effect = effect_of(experiment, model);
        const double percent = intensity_order_percent(&effect.eye);
        alike += percent >= alike_percent;
        fewest_percent = fmin(fewest_percent, percent);
        behind_db = fmax(behind_db, effect.family_db);
    }
    study_claim(experiment->study, study_verdict(alike, INTENSITY_MODELS - 1), "wallwarp",
                "Uneven pixels and a shining wall leave 19 of 20 pairs of methods in their order.",
                "Counted are pairs that differ by more than %g dB with the paper's pixels, at one angle with one "
                "picture. It holds with %d of the %d other models; the fewest that keep their order as the eye sees it "
                "are %.1f %%. The best of area, mean+cubic and mean+spline is %.2f dB below the best method of all "
                "with the paper's pixels, and at most %.2f dB with the others.",
                least_db, alike, INTENSITY_MODELS - 1, fewest_percent, effect_of(experiment, 0).family_db, behind_db);
}

static void show(const experiment_t *experiment)
{
    write_all(experiment);
    write_effects(experiment);
    begin_section(experiment);
    draw(experiment, "intensity_eye.csv", "intensity_eye.svg", false);
    draw(experiment, "intensity_fine.csv", "intensity_fine.svg", true);
    study_figure(experiment->study, "intensity_eye.svg", "intensity_eye.csv",
                 "As the eye sees it, single pixels blurred");
    study_figure(experiment->study, "intensity_fine.svg", "intensity_fine.csv",
                 "Sample by sample: the shape of the projector's pixels counts as error");
    study_table(experiment->study, "intensity_order.csv",
                "Pairs of methods that keep the order they have with ideal pixels, and the best of them as the eye "
                "sees it. The limit is that of the paper: each pixel's mean of the picture.");
    study_data(experiment->study, "intensity.csv", "Every method, model, angle and picture:");
    claim(experiment);
}

void study_intensity(study_t *study)
{
    experiment_t *experiment = study_memory(study, sizeof *experiment);
    if (experiment == NULL)
        return;
    experiment->study = study;
    prepare(experiment);
    study_parallel(study, experiment->angles * experiment->photographs, measure, experiment);
    if (!study_failed(study))
        show(experiment);
    for (int32_t p = 0; p < PHOTOGRAPHS; p++)
        free(experiment->picture[p].data);
    free(experiment);
}
