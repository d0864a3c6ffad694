// SPDX-License-Identifier: Apache-2.0
// The experiment of a moving viewer whose poses come late, or with noise: how far off and how bad the picture is.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/study/study_walk.h"
#include "sim/eval/mesh_psnr.h"
#include "sim/study/latency_tracks.h"
#include "sim/study/latency_view.h"
#include "sim/study/study_experiments.h"
#include "sim/study/study_image.h"

enum { STEPS = 11, NOISES = 2, TEXT_LENGTH = 1000 };

static const double worst_latency_s = 0.1, worst_noise_mm = 20.0, worst_noise_deg = 2.0;

/* Geometry is told in pixels of a full HD picture. */
static const study_sizes_t full_hd = {1920, 1080, 1920, 1080};

/* Content as far behind the wall as the viewer is before it, and at the ends of what there is. */
enum { ON_WALL, BEHIND, FAR, CONTENTS };
static const double content_m[CONTENTS] = {0.0, 2.5, HUGE_VAL};

typedef struct {
    study_t *study;
    study_scene_t scene, view_scene;
    image_t picture;
    int32_t view_times;
    latency_error_t late[LATENCY_TRACKS][CONTENTS][STEPS];
    /* By noise of position and of orientation: of the wall's pose alone, and of one pose for picture and wall. */
    latency_error_t moved[NOISES][STEPS], turned[NOISES][STEPS];
    double late_db[2][STEPS], moved_db[STEPS], turned_db[STEPS]; /* walking and turning, the wall late */
} experiment_t;

static double part_of(int32_t step, double worst)
{
    return worst * step / (STEPS - 1);
}

static study_noise_t noise_of_position(int32_t step)
{
    return (study_noise_t){.position_mm = part_of(step, worst_noise_mm)};
}

static study_noise_t noise_of_orientation(int32_t step)
{
    return (study_noise_t){.orientation_deg = part_of(step, worst_noise_deg)};
}

/* What the eye sees with one step of each kind of error: late, walking and turning; moved; turned. */
static bool see(experiment_t *experiment, int32_t step)
{
    latency_square_t sum[4] = {{0.0, 0}};
    bool made = true;
    for (int32_t n = 0; made && n < experiment->view_times; n++) {
        const double time_s = latency_time_s(n, experiment->view_times);
        const pose_t walking = latency_pose(LATENCY_WALKING, time_s), turning = latency_pose(LATENCY_TURNING, time_s);
        const double latency_s = part_of(step, worst_latency_s);
        const study_noise_t move = noise_of_position(step), turn = noise_of_orientation(step);
        const pose_t corrected[4] = {latency_pose(LATENCY_WALKING, time_s - latency_s),
                                     latency_pose(LATENCY_TURNING, time_s - latency_s),
                                     latency_tracked(&walking, &move, n), latency_tracked(&walking, &turn, n)};
        for (int kind = 0; made && kind < 4; kind++)
            made = latency_view_add(&sum[kind], &experiment->view_scene, &experiment->picture, &corrected[kind],
                                    kind == 1 ? &turning : &walking);
    }
    experiment->late_db[0][step] = mesh_db(sum[0].square, sum[0].pixels);
    experiment->late_db[1][step] = mesh_db(sum[1].square, sum[1].pixels);
    experiment->moved_db[step] = mesh_db(sum[2].square, sum[2].pixels);
    experiment->turned_db[step] = mesh_db(sum[3].square, sum[3].pixels);
    return made;
}

static void measure(void *context, int32_t step)
{
    experiment_t *experiment = context;
    const study_scene_t *scene = &experiment->scene;
    for (int t = 0; t < LATENCY_TRACKS; t++)
        for (int c = 0; c < CONTENTS; c++)
            experiment->late[t][c][step] =
                latency_late_error(scene, (latency_track_t)t, part_of(step, worst_latency_s), content_m[c]);
    const study_noise_t move = noise_of_position(step), turn = noise_of_orientation(step);
    for (int n = 0; n < NOISES; n++) {
        experiment->moved[n][step] = latency_noise_error(scene, n == 1, &move, content_m[BEHIND]);
        experiment->turned[n][step] = latency_noise_error(scene, n == 1, &turn, content_m[BEHIND]);
    }
    if (!see(experiment, step))
        study_fail(experiment->study, "out of memory");
}

static const char *content_name(int content)
{
    static const char *const name[CONTENTS] = {"on the wall", "2.5 m behind it", "far away"};
    return name[content];
}

static void write_late(const experiment_t *experiment)
{
    FILE *csv = study_csv_begin(experiment->study, "latency.csv",
                                "poses,content,latency_ms,mean_px,worst_px,mean_deg,worst_deg");
    for (int t = 0; t < LATENCY_TRACKS; t++)
        for (int c = 0; c < CONTENTS; c++)
            for (int32_t step = 0; step < STEPS; step++) {
                const latency_error_t *error = &experiment->late[t][c][step];
                fprintf(csv, "%s,%s,%g,%.3f,%.3f,%.4f,%.4f\n", latency_track_name((latency_track_t)t), content_name(c),
                        part_of(step, worst_latency_s) * 1e3, latency_mean_px(error), error->worst_px,
                        latency_mean_deg(error), error->worst_deg);
            }
    study_csv_end(experiment->study, csv);
}

/* One file for each plot's x: latency, noise of position, noise of orientation. */
static void write_curves(const experiment_t *experiment)
{
    study_t *study = experiment->study;
    char header[TEXT_LENGTH] = "latency_ms";
    for (int t = 0; t < LATENCY_TRACKS; t++) {
        strcat(header, ",");
        strcat(header, latency_track_name((latency_track_t)t));
    }
    strcat(header, ",walking dB,turning dB");
    FILE *csv = study_csv_begin(study, "latency_late.csv", header);
    for (int32_t step = 0; step < STEPS; step++) {
        fprintf(csv, "%g", part_of(step, worst_latency_s) * 1e3);
        for (int t = 0; t < LATENCY_TRACKS; t++)
            fprintf(csv, ",%.4f", latency_mean_px(&experiment->late[t][BEHIND][step]));
        fprintf(csv, ",%.3f,%.3f\n", experiment->late_db[0][step], experiment->late_db[1][step]);
    }
    study_csv_end(study, csv);
    csv = study_csv_begin(study, "latency_noise.csv",
                          "position_mm,wall px,wall and picture px,wall dB,"
                          "orientation_deg,wall px,wall and picture px,wall dB");
    for (int32_t step = 0; step < STEPS; step++)
        fprintf(csv, "%g,%.4f,%.4f,%.3f,%g,%.4f,%.4f,%.3f\n", part_of(step, worst_noise_mm),
                latency_mean_px(&experiment->moved[0][step]), latency_mean_px(&experiment->moved[1][step]),
                experiment->moved_db[step], part_of(step, worst_noise_deg),
                latency_mean_px(&experiment->turned[0][step]), latency_mean_px(&experiment->turned[1][step]),
                experiment->turned_db[step]);
    study_csv_end(study, csv);
}

/* The largest latency, up to a second, with a mean error of a pixel, or with no point off by more. */
static double latency_for_a_pixel_ms(const study_scene_t *scene, latency_track_t track, bool worst)
{
    double good_s = 0.0, bad_s = 1.0;
    for (int i = 0; i < 14; i++) {
        const double middle_s = 0.5 * (good_s + bad_s);
        const latency_error_t error = latency_late_error(scene, track, middle_s, content_m[BEHIND]);
        if ((worst ? error.worst_px : latency_mean_px(&error)) <= 1.0)
            good_s = middle_s;
        else
            bad_s = middle_s;
    }
    return good_s * 1e3;
}

/* What a user needs to know of each motion. */
static void write_needs(const experiment_t *experiment)
{
    enum { AT_50_MS = (STEPS - 1) / 2 };
    FILE *csv =
        study_csv_begin(experiment->study, "latency_needs.csv",
                        "at 50 ms,px,degrees,worst px,px on the wall,px far away,ms for 1 px,ms for 1 px at worst");
    for (int t = 0; t < LATENCY_TRACKS; t++) {
        const latency_error_t *error = &experiment->late[t][BEHIND][AT_50_MS];
        fprintf(csv, "%s,%.2f,%.3f,%.1f,%.2f,%.2f,%.1f,%.1f\n", latency_track_name((latency_track_t)t),
                latency_mean_px(error), latency_mean_deg(error), error->worst_px,
                latency_mean_px(&experiment->late[t][ON_WALL][AT_50_MS]),
                latency_mean_px(&experiment->late[t][FAR][AT_50_MS]),
                latency_for_a_pixel_ms(&experiment->scene, (latency_track_t)t, false),
                latency_for_a_pixel_ms(&experiment->scene, (latency_track_t)t, true));
    }
    study_csv_end(experiment->study, csv);
}

static void draw_all(study_t *study)
{
    const char *late = "latency_late.csv", *noise = "latency_noise.csv";
    const char *pixels = "mean error, px", *logarithmic = "set logscale y\nset yrange [0.1:1000]\n";
    enum { LONG_KEY_HEIGHT = 470 };
    study_line_t tracks[LATENCY_TRACKS];
    for (int t = 0; t < LATENCY_TRACKS; t++)
        tracks[t] = (study_line_t){late, 1, t + 2, latency_track_name((latency_track_t)t), t, false, false};
    const study_line_t view[] = {{late, 1, LATENCY_TRACKS + 2, "walking", 0, false, false},
                                 {late, 1, LATENCY_TRACKS + 3, "turning", 1, false, false}};
    const study_line_t position[] = {{noise, 1, 2, "of the wall's pose", 0, false, false},
                                     {noise, 1, 3, "of one pose for both", 2, false, false}};
    const study_line_t orientation[] = {{noise, 5, 6, "of the wall's pose", 0, false, false},
                                        {noise, 5, 7, "of one pose for both", 2, false, false}};
    const study_plot_t plots[] = {
        {"latency_late.svg", NULL, "latency, ms", pixels, logarithmic, 0, LONG_KEY_HEIGHT, tracks, LATENCY_TRACKS},
        {"latency_late_db.svg", NULL, "latency, ms", "PSNR, dB", NULL, 0, 0, view, 2},
        {"latency_position.svg", NULL, "noise of position, mm", pixels, logarithmic, 0, 0, position, 2},
        {"latency_orientation.svg", NULL, "noise of orientation, degrees", pixels, logarithmic, 0, 0, orientation, 2},
    };
    for (size_t p = 0; p < sizeof plots / sizeof *plots; p++)
        study_plot(study, &plots[p]);
    study_figure(study, "latency_late.svg", late, "Error of the content's place, by who uses which pose");
    study_figure(study, "latency_late_db.svg", late, "What the eye sees, wall late, against the picture");
    study_figure(study, "latency_position.svg", noise,
                 "Error by noise of the tracked position; below 0.1 px it is not drawn");
    study_figure(study, "latency_orientation.svg", noise,
                 "Error by noise of the tracked orientation; below 0.1 px it is not drawn");
}

static void begin_section(const experiment_t *experiment)
{
    study_section(
        experiment->study, "A moving viewer: late and noisy poses",
        "A viewer 2.5 m before the wall; walking is %.1f m/s along it with a bob of %.0f mm at %.1f Hz, turning is "
        "%.0f degrees times sin(2 pi %.1f t); one swing of the head, %.2f s. Errors are means over the view and "
        "the swing, in pixels of a 1920x1080 picture, of which one is about %.3f degrees, for content %.1f m "
        "behind the wall. PSNR: mean+cubic, studio, %dx%d, where wall and picture are seen. Noise: normal, seeds "
        "1 to 20, deviation along each axis.",
        study_walk_speed_m_s, study_walk_bob_m * 1e3, study_walk_bob_hz, latency_yaw_deg, study_walk_yaw_hz,
        1.0 / study_walk_yaw_hz, 180.0 / M_PI * 1e6 / (double)experiment->scene.camera.focal_upx[0], content_m[BEHIND],
        experiment->picture.width, experiment->picture.height);
    study_text(experiment->study,
               "Three poses meet in a frame: the one that the engine drew the picture for, the one that the wall is "
               "corrected for, and the true one when the light arrives. Wall late: the picture is drawn for the true "
               "pose, the wall corrected for an old one. Picture late: the engine's picture is old, as it always is by "
               "its way through renderer and cable. Then the trap is to correct the wall for the newest pose: the "
               "picture is nailed to the head, and each turn of the head turns the whole world on the wall. One late "
               "pose: picture and wall use the same old pose; turning then costs nothing, and walking only as much as "
               "content is away from the wall. Late turn and newest place: the wall uses the picture's orientation "
               "and the newest position, which is exact for content far away, and off by the whole step for content "
               "on the wall.");
}

static void claims(const experiment_t *experiment)
{
    enum { AT_50_MS = (STEPS - 1) / 2 };
    const double trap = latency_mean_px(&experiment->late[LATENCY_TRAP][BEHIND][AT_50_MS]);
    const double one_pose = latency_mean_px(&experiment->late[LATENCY_ONE_POSE][BEHIND][AT_50_MS]);
    const double one_turn = latency_mean_px(&experiment->late[LATENCY_ONE_TURN][BEHIND][AT_50_MS]);
    study_claim(
        experiment->study, study_verdict(trap > 3.0 * fmax(one_pose, one_turn), 1), "wallwarp",
        "The wall must be corrected for the orientation that its picture was drawn for: the newest puts content "
        "three times as far off, or more.",
        "With a picture 50 ms old and a head that walks and turns, the newest pose puts content %.0f px off; "
        "the picture's own pose %.1f px, and its orientation at the newest position %.1f px.",
        trap, one_pose, one_turn);
    const double alone = latency_mean_px(&experiment->turned[0][STEPS - 1]);
    const double both = latency_mean_px(&experiment->turned[1][STEPS - 1]);
    study_claim(
        experiment->study, study_verdict(both < 0.1 * alone, 1), "wallwarp",
        "When picture and wall use the same pose, noise of its orientation costs less than a tenth.",
        "With %g degrees of noise content is %.0f px off when only the wall's pose has it, and %.2f px when the "
        "picture was drawn for the same noisy pose.",
        worst_noise_deg, alone, both);
}

static void show(const experiment_t *experiment)
{
    study_t *study = experiment->study;
    write_late(experiment);
    write_curves(experiment);
    write_needs(experiment);
    begin_section(experiment);
    draw_all(study);
    study_table(study, "latency_needs.csv",
                "What a tracker must deliver: errors at 50 ms, and the latency that keeps their mean, or the worst "
                "of them, within a pixel");
    study_table(study, "latency_noise.csv", "Noise of the tracker, of the wall's pose or of one pose for both");
    study_data(study, "latency.csv", "Every latency, for content on the wall, behind it and far away:");
    claims(experiment);
}

void study_latency(study_t *study)
{
    experiment_t *experiment = study_memory(study, sizeof *experiment);
    if (experiment == NULL)
        return;
    const study_sizes_t seen =
        study_quick(study) ? (study_sizes_t){240, 135, 240, 135} : (study_sizes_t){480, 270, 480, 270};
    experiment->study = study;
    experiment->view_times = study_quick(study) ? 2 : 5;
    study_scene(&experiment->scene, &full_hd);
    study_scene(&experiment->view_scene, &seen);
    if (!study_image(STUDY_STUDIO, seen.picture_width, seen.picture_height, 1, &experiment->picture, NULL))
        study_fail(study, "out of memory");
    study_parallel(study, STEPS, measure, experiment);
    if (!study_failed(study))
        show(experiment);
    free(experiment->picture.data);
    free(experiment);
}
