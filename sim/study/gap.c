// SPDX-License-Identifier: Apache-2.0
// How far every method is below the limit, under the paper's truth and against a finer original.
//
// Three rooms: eq, low, gt, their picture as fine as the projector, coarser, finer. Files:
// gap_ROOM_TRUTH.csv   the mean gap over the pictures by angle, a column for each method
// gap_cases.csv        every case: PSNR of the limit and of each method
// gap_table_TRUTH.csv  mean and worst gap of each method
// gap_claims.csv       a row for each room and figure of gap_contests.h: it holds when cases = wins
// gap_samples.csv      one case with more and more samples
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/study/gap_contests.h"
#include "sim/study/study_experiments.h"
#include "sim/study/study_mesh_curves.h"

enum { ROOMS = 3, MAX_PLACES = 5, QUICK_PLACES = 3, NAME_LENGTH = 64, CAPTION_LENGTH = 128 };

typedef struct {
    const char *name, *what;
    study_mesh_case_t place[MAX_PLACES]; /* the first QUICK_PLACES alone for --quick */
} gap_room_t;

static const gap_room_t rooms[ROOMS] = {
    {"eq",
     "picture as fine as the projector",
     {{{480, 270, 480, 270}, STUDY_STUDIO, 4, 4, 0},
      {{120, 68, 120, 68}, STUDY_ASTRONAUT, 4, 16, 0},
      {{120, 68, 120, 68}, STUDY_COFFEE, 4, 16, 0},
      {{1920, 1080, 1920, 1080}, STUDY_STUDIO, 1, 4, 0},
      {{480, 270, 480, 270}, STUDY_COFFEE, 1, 4, 0}}},
    {"low",
     "picture coarser than the projector",
     {{{240, 135, 960, 540}, STUDY_STUDIO, 4, 16, 0},
      {{120, 68, 480, 272}, STUDY_ASTRONAUT, 4, 16, 0},
      {{120, 68, 480, 272}, STUDY_COFFEE, 4, 16, 0},
      {{480, 270, 1920, 1080}, STUDY_STUDIO, 4, 16, 0},
      {{510, 290, 1920, 1080}, STUDY_ASTRONAUT, 1, 16, 0}}},
    {"gt",
     "picture finer than the projector",
     {{{480, 270, 240, 135}, STUDY_STUDIO, 4, 4, 0},
      {{120, 68, 60, 34}, STUDY_ASTRONAUT, 4, 16, 0},
      {{120, 68, 60, 34}, STUDY_COFFEE, 4, 16, 0},
      {{1920, 1080, 960, 540}, STUDY_STUDIO, 1, 4, 0},
      {{480, 270, 240, 135}, STUDY_COFFEE, 1, 4, 0}}},
};

static const char *const truth_name[STUDY_TRUTHS] = {"picture", "original"};

static study_mesh_sweep_t of_room(const study_mesh_sweep_t *sweep, int room)
{
    const int32_t places = sweep->places / ROOMS;
    return study_mesh_places(sweep, room * places, places);
}

/* Gaps of one method in runs that have the truth and in which the limit is not without error. */
typedef struct {
    double mean_db, worst_db;
} gap_t;

/* @param angle  One of the sweep's, or -1 for all. */
static gap_t gap_of(const study_mesh_sweep_t *sweep, study_truth_t truth, int method, int32_t angle)
{
    gap_t gap = {0};
    int32_t cases = 0;
    for (int32_t n = 0; n < sweep->count; n++) {
        const study_mesh_run_t *run = &sweep->run[n];
        if (!isfinite(run->found.limit_db[truth]) || (angle >= 0 && n % sweep->angles != angle))
            continue;
        const double db = study_db_ahead(run->found.limit_db[truth], run->found.psnr_db[truth][method]);
        cases++;
        gap.mean_db += db;
        gap.worst_db = fmax(gap.worst_db, db);
    }
    gap.mean_db /= cases;
    return gap;
}

static void show_curves(study_t *study, const study_mesh_sweep_t *room, int r, study_truth_t truth)
{
    static const char *const method[] = {
        "none+nearest", "none+cubic", "kaiser+cubic", "butter+spline", "area", "mean+cubic", "mean+spline", "ls", NULL};
    char csv_name[NAME_LENGTH], svg_name[NAME_LENGTH], caption[CAPTION_LENGTH];
    snprintf(csv_name, sizeof csv_name, "gap_%s_%s.csv", rooms[r].name, truth_name[truth]);
    snprintf(svg_name, sizeof svg_name, "gap_%s_%s.svg", rooms[r].name, truth_name[truth]);
    snprintf(caption, sizeof caption, "%s: %s; truth: the %s", rooms[r].name, rooms[r].what, truth_name[truth]);
    FILE *csv = study_curves_begin(study, csv_name, "angle_deg");
    for (int32_t a = 0; a < room->angles; a++) {
        double gap[WARP_METHODS];
        for (int m = 0; m < WARP_METHODS; m++)
            gap[m] = gap_of(room, truth, m, a).mean_db;
        fprintf(csv, "%g", room->run[a].at.angle_deg);
        study_curves_print(csv, gap);
    }
    study_csv_end(study, csv);
    study_curves_plot(study, &(study_curves_t){.svg = svg_name,
                                               .csv = csv_name,
                                               .x_label = "angle of the viewer, degrees",
                                               .y_label = "gap to the limit, dB (mean over pictures)",
                                               .caption = caption,
                                               .setup = "set yrange [0:*<8]\n",
                                               .x = 1,
                                               .before = 1,
                                               .method = method});
}

static void show_table(study_t *study, const study_mesh_sweep_t *sweep, study_truth_t truth)
{
    char name[NAME_LENGTH], caption[2 * CAPTION_LENGTH];
    snprintf(name, sizeof name, "gap_table_%s.csv", truth_name[truth]);
    snprintf(caption, sizeof caption,
             "Gap to the limit, dB, truth: the %s; mean and worst over angles and pictures. Left out: walls seen "
             "straight on, where the limit is without error.",
             truth_name[truth]);
    FILE *csv = study_csv_begin(study, name, "method,eq mean,eq worst,low mean,low worst,gt mean,gt worst");
    for (int m = 0; m < WARP_METHODS; m++) {
        if (!study_measures(m))
            continue;
        fputs(warp_methods[m].name, csv);
        for (int r = 0; r < ROOMS; r++) {
            const study_mesh_sweep_t room = of_room(sweep, r);
            const gap_t gap = gap_of(&room, truth, m, -1);
            fprintf(csv, ",%.3f,%.3f", gap.mean_db, gap.worst_db);
        }
        fputc('\n', csv);
    }
    study_csv_end(study, csv);
    study_table(study, name, caption);
}

static double mean_ahead_db(const study_mesh_sweep_t *room, study_truth_t truth, const char *mine, const char *other)
{
    const study_contest_t contest = {.truth = truth, .contenders = study_methods(mine), .others = study_methods(other)};
    return study_tally(&contest, room->run, room->count).mean_db;
}

/* In the room where picture pixels are large. */
static void show_rewards(study_t *study, const study_mesh_sweep_t *low)
{
    gap_rewards_t rewards;
    for (int truth = 0; truth < STUDY_TRUTHS; truth++) {
        rewards.nearest_db[truth] = mean_ahead_db(low, (study_truth_t)truth, "none+nearest", "none+cubic");
        rewards.area_db[truth] = mean_ahead_db(low, (study_truth_t)truth, "area", "mean+cubic");
    }
    study_claim(study, gap_rewards_verdict(&rewards), "wallwarp",
                "The paper's truth rewards blocks, which an eye would not.",
                "Its truth is the picture with each of its pixels a square of one level, so a method that shows these "
                "squares is right. In room low, where a picture pixel covers several of the projector's, none+nearest "
                "is %+.2f dB against none+cubic on average and area %+.2f dB against mean+cubic. Against the original, "
                "of which the picture is only a mean, the squares are errors: the same two are %+.2f and %+.2f dB.",
                rewards.nearest_db[STUDY_TRUTH_PICTURE], rewards.area_db[STUDY_TRUTH_PICTURE],
                rewards.nearest_db[STUDY_TRUTH_ORIGINAL], rewards.area_db[STUDY_TRUTH_ORIGINAL]);
}

/* The CSV has a row for each figure that must hold and each room, for tests. */
static void show_contests(study_t *study, const study_mesh_sweep_t *sweep)
{
    gap_contest_t contest[GAP_CONTESTS];
    gap_contests(contest);
    FILE *csv = study_csv_begin(study, "gap_claims.csv",
                                "figure,room,cases,wins,worst_db,bound_db,picture,picture_width,panel_width,angle_deg");
    for (int c = 0; c < GAP_CONTESTS; c++) {
        study_contest_claim(study, &(study_contest_claim_t){"wallwarp", contest[c].claim, &contest[c].duel, 1}, sweep);
        for (int r = 0; r < ROOMS; r++) {
            const study_mesh_sweep_t room = of_room(sweep, r);
            const study_tally_t tally = study_tally(&contest[c].duel.contest, room.run, room.count);
            const study_mesh_case_t *worst = &room.run[tally.worst < 0 ? 0 : tally.worst].at;
            fprintf(csv, "%s,%s,%d,%d,%.3f,%.3f,%s,%d,%d,%g\n", contest[c].name, rooms[r].name, tally.cases, tally.wins,
                    tally.worst_db, -contest[c].duel.contest.tolerance_db, study_image_name(worst->image),
                    worst->sizes.picture_width, worst->sizes.panel_width, worst->angle_deg);
        }
    }
    study_csv_end(study, csv);
    const double area_db = study_tally(&contest[0].duel.contest, sweep->run, sweep->count).worst_db;
    const double means_db = study_tally(&contest[2].duel.contest, sweep->run, sweep->count).worst_db;
    study_headline(study,
                   "By the paper's measure area is at most %.2f dB below what is possible; against a finer original, "
                   "which is nearer to what an eye wants, the better of mean+cubic and mean+spline is at most %.2f dB "
                   "below the best other method.",
                   fmax(-area_db, 0.0), fmax(-means_db, 0.0));
    study_text(study,
               "From above or below, at 70 degrees to a wide wall, footprints are sheared, which area's upright box "
               "is not: there it can be some 0.25 dB below the limit.");
    study_table(study, "gap_claims.csv", "The figures that must hold, by room, with the worst case of each.");
}

static double gap_db(const study_mesh_result_t *found, const char *method)
{
    return found->limit_db[STUDY_TRUTH_PICTURE] - study_best_db(found, STUDY_TRUTH_PICTURE, study_methods(method));
}

/* The limit is of the samples that were taken: the fewer a projector pixel has, the more of their chance it knows. */
static void show_samples(study_t *study)
{
    static const int32_t factor[] = {4, 8, 16, 32, 64};
    enum { FACTORS = sizeof factor / sizeof factor[0] };
    study_mesh_run_t run[FACTORS] = {0};
    for (int f = 0; f < FACTORS; f++)
        run[f].at = (study_mesh_case_t){{120, 68, 120, 68}, STUDY_COFFEE, 1, factor[f], .angle_deg = 35};
    if (!study_mesh_measure_all(study, run, FACTORS))
        return;
    FILE *csv = study_csv_begin(study, "gap_samples.csv", "S,limit_db,gap of area,gap of mean+cubic");
    for (int f = 0; f < FACTORS; f++) {
        const study_mesh_result_t *found = &run[f].found;
        fprintf(csv, "%d,%.3f,%.3f,%.3f\n", factor[f], found->limit_db[STUDY_TRUTH_PICTURE], gap_db(found, "area"),
                gap_db(found, "mean+cubic"));
    }
    study_csv_end(study, csv);
    study_text(study,
               "With S samples per picture pixel and axis, the limit is the mean of those samples that fall in a "
               "projector pixel, 16 of them at S = 4 and 1:1: it knows the chance of where they fall, which no "
               "method can. So a small S flatters the limit, and most of area's gap is not its own: in the case below "
               "it is %.3f dB with S = %d and %.3f dB with S = %d. Small pictures have S = 16 above for this reason.",
               gap_db(&run[0].found, "area"), factor[0], gap_db(&run[FACTORS - 1].found, "area"), factor[FACTORS - 1]);
    study_table(study, "gap_samples.csv",
                "The same case with more samples, dB: coffee 120 x 68 on 120 x 68, 35 degrees, truth: the picture.");
}

static void write_cases(study_t *study, const study_mesh_sweep_t *sweep)
{
    FILE *csv = study_curves_begin(study, "gap_cases.csv",
                                   "truth,picture,picture_width,picture_height,panel_width,panel_height,finer,factor,"
                                   "angle_deg,k_in,limit");
    for (int32_t n = 0; n < sweep->count * STUDY_TRUTHS; n++) {
        const study_mesh_run_t *run = &sweep->run[n / STUDY_TRUTHS];
        const int truth = n % STUDY_TRUTHS;
        const study_sizes_t *sizes = &run->at.sizes;
        if (isnan(run->found.limit_db[truth]))
            continue;
        fprintf(csv, "%s,%s,%d,%d,%d,%d,%d,%d,%g,%.4f,%.4f", truth_name[truth], study_image_name(run->at.image),
                sizes->picture_width, sizes->picture_height, sizes->panel_width, sizes->panel_height, run->at.finer,
                run->at.factor, run->at.angle_deg, run->found.k_in, run->found.limit_db[truth]);
        study_curves_print(csv, run->found.psnr_db[truth]);
    }
    study_csv_end(study, csv);
}

void study_gap(study_t *study)
{
    const int32_t places = study_quick(study) ? QUICK_PLACES : MAX_PLACES;
    study_mesh_case_t place[ROOMS * MAX_PLACES];
    for (int r = 0; r < ROOMS; r++)
        memcpy(&place[r * places], rooms[r].place, (size_t)places * sizeof place[0]);
    study_mesh_sweep_t sweep;
    if (!study_mesh_sweep(&sweep, study, place, ROOMS * places, study_quick(study) ? 17.5 : 5.0))
        return;
    study_mesh_section(study, "Gap to the limit, under two truths", &sweep);
    study_text(study,
               "The limit is the mean of the truth within each projector pixel, which no method can beat. It is "
               "not a method: it needs the truth. In room low the original is as fine as the projector, so its limit "
               "is nearly the original itself: the gaps there are what the picture does not hold.");
    for (int r = 0; r < ROOMS; r++) {
        const study_mesh_sweep_t room = of_room(&sweep, r);
        for (int truth = 0; truth < STUDY_TRUTHS; truth++)
            show_curves(study, &room, r, (study_truth_t)truth);
    }
    write_cases(study, &sweep);
    study_data(study, "gap_cases.csv", "Every case of this section, with all figures of every method:");
    show_table(study, &sweep, STUDY_TRUTH_PICTURE);
    show_table(study, &sweep, STUDY_TRUTH_ORIGINAL);
    const study_mesh_sweep_t low = of_room(&sweep, 1);
    show_rewards(study, &low);
    show_contests(study, &sweep);
    show_samples(study);
    free(sweep.run);
}
