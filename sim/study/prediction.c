// SPDX-License-Identifier: Apache-2.0
// The experiment of prediction: how far off the predicted pose is, against holding the newest one, by lead.
#include <math.h>
#include <stdlib.h>

#include "firmware/pose_predict.h"
#include "sim/study/prediction_tracks.h"
#include "sim/study/study_experiments.h"

enum { LEADS = 11, LEAD_STEP_MS = 10, FIRST_JUDGED = 1, LAST_JUDGED = 6, AT_40_MS = 4 };

typedef struct {
    study_t *study;
    uint64_t seeds;
    prediction_error_t error[PREDICTION_TRACKS][LEADS];
} experiment_t;

/* What a track is about: the others only have noise there. */
static const struct {
    bool moves, turns;
} about[PREDICTION_TRACKS] = {[PREDICTION_WALKING] = {true, false},
                              [PREDICTION_TURNING] = {false, true},
                              [PREDICTION_BOTH] = {true, true},
                              [PREDICTION_STOP_AND_GO] = {true, false},
                              [PREDICTION_STANDING] = {false, false}};

static void measure(void *context, int32_t index)
{
    experiment_t *experiment = context;
    const int32_t track = index / LEADS, lead = index % LEADS;
    for (uint64_t seed = 1; seed <= experiment->seeds; seed++)
        prediction_error_add(&experiment->error[track][lead], (prediction_track_t)track, lead * LEAD_STEP_MS * 1000,
                             0.0, seed);
}

/* Hold's error, the prediction's and their ratio; of the position in mm, of the orientation in degrees. */
static void write_errors(FILE *csv, const prediction_error_t *error)
{
    const double frames = (double)error->frames;
    fprintf(csv, ",%.3f,%.3f,%.3f,%.4f,%.4f,%.3f\n", sqrt(error->hold_mm2 / frames),
            sqrt(error->predicted_mm2 / frames), prediction_position_ratio(error), sqrt(error->hold_deg2 / frames),
            sqrt(error->predicted_deg2 / frames), prediction_angle_ratio(error));
}

static void write_tables(const experiment_t *experiment)
{
    study_t *study = experiment->study;
    FILE *csv = study_csv_begin(study, "prediction.csv",
                                "motion,lead_ms,hold_mm,predicted_mm,ratio_mm,hold_deg,predicted_deg,ratio_deg");
    for (int t = 0; t < PREDICTION_TRACKS; t++)
        for (int lead = 0; lead < LEADS; lead++) {
            fprintf(csv, "%s,%d", prediction_track_name((prediction_track_t)t), lead * LEAD_STEP_MS);
            write_errors(csv, &experiment->error[t][lead]);
        }
    study_csv_end(study, csv);
    csv = study_csv_begin(study, "prediction_40ms.csv",
                          "40 ms lead,hold mm,predicted mm,ratio,hold degrees,predicted degrees,ratio of degrees");
    for (int t = 0; t < PREDICTION_TRACKS; t++) {
        fprintf(csv, "%s", prediction_track_name((prediction_track_t)t));
        write_errors(csv, &experiment->error[t][AT_40_MS]);
    }
    study_csv_end(study, csv);
}

/* One row a lead; four columns a track. */
static void write_curves(const experiment_t *experiment)
{
    FILE *csv = study_csv_begin(experiment->study, "prediction_curves.csv",
                                "lead_ms,walking hold mm,walking mm,walking hold deg,walking deg,turning hold mm,"
                                "turning mm,turning hold deg,turning deg,both hold mm,both mm,both hold deg,both deg,"
                                "stop and go hold mm,stop and go mm,stop and go hold deg,stop and go deg,"
                                "standing hold mm,standing mm,standing hold deg,standing deg");
    for (int lead = 0; lead < LEADS; lead++) {
        fprintf(csv, "%d", lead * LEAD_STEP_MS);
        for (int t = 0; t < PREDICTION_TRACKS; t++) {
            const prediction_error_t *error = &experiment->error[t][lead];
            const double frames = (double)error->frames;
            fprintf(csv, ",%.4f,%.4f,%.5f,%.5f", sqrt(error->hold_mm2 / frames), sqrt(error->predicted_mm2 / frames),
                    sqrt(error->hold_deg2 / frames), sqrt(error->predicted_deg2 / frames));
        }
        fprintf(csv, "\n");
    }
    study_csv_end(experiment->study, csv);
}

/* The column of a track's hold error in mm. */
static int column(prediction_track_t track)
{
    return 2 + 4 * (int)track;
}

static void draw_all(study_t *study)
{
    const char *csv = "prediction_curves.csv", *logarithmic = "set logscale y\n";
    const int walking = column(PREDICTION_WALKING), going = column(PREDICTION_STOP_AND_GO);
    const int standing = column(PREDICTION_STANDING), turning = column(PREDICTION_TURNING);
    const study_line_t position[] = {{csv, 1, walking, "walking, held", 0, true, false},
                                     {csv, 1, walking + 1, "walking, predicted", 0, false, false},
                                     {csv, 1, going, "stop and go, held", 1, true, false},
                                     {csv, 1, going + 1, "stop and go, predicted", 1, false, false},
                                     {csv, 1, standing, "standing, held", 2, true, false},
                                     {csv, 1, standing + 1, "standing, predicted", 2, false, false}};
    const study_line_t angle[] = {{csv, 1, turning + 2, "turning, held", 0, true, false},
                                  {csv, 1, turning + 3, "turning, predicted", 0, false, false},
                                  {csv, 1, walking + 2, "at rest, held", 2, true, false},
                                  {csv, 1, walking + 3, "at rest, predicted", 2, false, false}};
    const study_plot_t plots[] = {
        {"prediction_position.svg", NULL, "lead, ms", "error, mm", logarithmic, 0, 0, position, 6},
        {"prediction_angle.svg", NULL, "lead, ms", "error, degrees", logarithmic, 0, 0, angle, 4},
    };
    for (size_t p = 0; p < sizeof plots / sizeof *plots; p++)
        study_plot(study, &plots[p]);
    study_figure(study, "prediction_position.svg", csv, "Error of the position, held and predicted");
    study_figure(study, "prediction_angle.svg", csv, "Error of the orientation, held and predicted");
}

/* Only what moves or turns: at rest the error of the newest pose is noise. */
static void claim_figure(const experiment_t *experiment)
{
    int cases = 0, held = 0;
    double worst = 0.0;
    for (int t = 0; t < PREDICTION_TRACKS; t++) {
        const prediction_error_t *error = &experiment->error[t][AT_40_MS];
        const double ratio[2] = {prediction_position_ratio(error), prediction_angle_ratio(error)};
        const bool counts[2] = {about[t].moves, about[t].turns};
        for (int k = 0; k < 2; k++) {
            cases += counts[k];
            held += counts[k] && ratio[k] <= 0.3;
            worst = counts[k] ? fmax(worst, ratio[k]) : worst;
        }
    }
    study_claim(experiment->study, study_verdict(held, cases), "wallwarp",
                "40 ms ahead, prediction leaves at most 30 % of the error of the newest pose.",
                "In %d of %d cases: position when walking, doing both, and stopping and going; orientation when "
                "turning and doing both. At worst %.1f %% is left.",
                held, cases, 100.0 * worst);
}

static void claim_no_harm(const experiment_t *experiment)
{
    int cases = 0, held = 0;
    double worst = 0.0;
    for (int t = 0; t < PREDICTION_TRACKS; t++)
        for (int lead = FIRST_JUDGED; lead <= LAST_JUDGED; lead++) {
            const prediction_error_t *error = &experiment->error[t][lead];
            const double ratio[2] = {prediction_position_ratio(error), prediction_angle_ratio(error)};
            for (int k = 0; k < 2; k++, cases++) {
                held += ratio[k] <= 1.1;
                worst = fmax(worst, ratio[k]);
            }
        }
    study_claim(experiment->study, study_verdict(held, cases), "wallwarp",
                "From 10 to 60 ms ahead, prediction is nowhere worse than the newest pose by more than 10 %.",
                "In %d of %d cases, of position and orientation, moving or not; the worst has %.0f %% of the error of "
                "the newest pose.",
                held, cases, 100.0 * worst);
}

static void show(const experiment_t *experiment)
{
    study_t *study = experiment->study;
    write_tables(experiment);
    write_curves(experiment);
    study_section(
        study, "Prediction of the viewer's pose",
        "Poses at %d Hz with normal noise of %.1f mm along and %.2f degrees about each axis, seeds 1 to %d, %d s each. "
        "Walking: 1.4 m/s and a bob of 30 mm times sin(2 pi 2 t). Turning: the head, 45 degrees times sin(2 pi 0.7 t). "
        "Stop and go: 1 m/s^2 up to 1.4 m/s, 1 s so, 1 m/s^2 down, 1 s standing; standing is that last second alone. "
        "Errors are root mean squares over 60 frames a second: of the distance between two places, and of the angle of "
        "the one rotation between two orientations.",
        PREDICTION_RATE_HZ, prediction_noise.position_mm, prediction_noise.orientation_deg, (int)experiment->seeds,
        PREDICTION_SECONDS);
    study_text(study,
               "A picture is on its way to the wall for a while after its pose was measured. Holding the newest pose "
               "costs what the viewer moves in that time. The firmware goes on along a parabola through the poses of "
               "the last %d ms, as far as it is more than noise: at rest it is the mean, which is quieter than the "
               "newest pose. Of that it keeps the part that would have been best for the same lead over the last "
               "quarter of a second. Beyond %d ms the motion fades, and ends at %d ms.",
               POSE_PREDICT_WINDOW_US / 1000, POSE_PREDICT_FULL_US / 1000, POSE_PREDICT_STILL_US / 1000);
    draw_all(study);
    study_table(study, "prediction_40ms.csv", "Errors 40 ms after the newest pose");
    study_data(study, "prediction.csv", "Every motion and lead:");
    claim_figure(experiment);
    claim_no_harm(experiment);
}

void study_prediction(study_t *study)
{
    experiment_t *experiment = study_memory(study, sizeof *experiment);
    if (experiment == NULL)
        return;
    experiment->study = study;
    experiment->seeds = study_quick(study) ? 1 : 3;
    study_parallel(study, PREDICTION_TRACKS * LEADS, measure, experiment);
    if (!study_failed(study))
        show(experiment);
    free(experiment);
}
