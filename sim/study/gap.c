// SPDX-License-Identifier: Apache-2.0
// How far every method is below the limit, under the paper's truth and against a finer original.
#include "sim/study/gap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/study/gap_contests.h"
#include "sim/study/study_mesh_curves.h"

enum { ROOMS = 3, MAX_PLACES = 5, QUICK_PLACES = 3, NAME_LENGTH = 64, TITLE_LENGTH = 128 };

typedef struct {
    const char *name, *what;
    study_mesh_case_t place[MAX_PLACES]; /* the first QUICK_PLACES alone for --quick */
} gap_room_t;

static const gap_room_t rooms[ROOMS] = {
    {"eq",
     "picture as fine as the projector",
     {{{480, 270, 480, 270}, STUDY_STUDIO, 4, 4, 0},
      {{120, 68, 120, 68}, STUDY_ASTRONAUT, 4, 4, 0},
      {{120, 68, 120, 68}, STUDY_COFFEE, 4, 4, 0},
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
      {{120, 68, 60, 34}, STUDY_ASTRONAUT, 4, 4, 0},
      {{120, 68, 60, 34}, STUDY_COFFEE, 4, 4, 0},
      {{1920, 1080, 960, 540}, STUDY_STUDIO, 1, 4, 0},
      {{480, 270, 240, 135}, STUDY_COFFEE, 1, 4, 0}}},
};

static const char *const truth_name[STUDY_TRUTHS] = {"picture", "original"};

/* The part of a sweep that is one room's. */
static study_mesh_sweep_t of_room(const study_mesh_sweep_t *sweep, int room)
{
    study_mesh_sweep_t part = *sweep;
    part.places /= ROOMS;
    part.count /= ROOMS;
    part.run += room * part.count;
    return part;
}

/* Gaps of one method in runs that have the truth. */
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
        if ((truth == STUDY_TRUTH_ORIGINAL && run->at.finer == 1) || (angle >= 0 && n % sweep->angles != angle))
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
    static const char *const method[] = {"none+nearest", "none+cubic", "kaiser+cubic", "butter+spline",
                                         "area",         "mean+cubic", "ls",           NULL};
    char csv_name[NAME_LENGTH], svg_name[NAME_LENGTH], title[TITLE_LENGTH];
    snprintf(csv_name, sizeof csv_name, "gap_%s_%s.csv", rooms[r].name, truth_name[truth]);
    snprintf(svg_name, sizeof svg_name, "gap_%s_%s.svg", rooms[r].name, truth_name[truth]);
    snprintf(title, sizeof title, "%s: %s; truth: the %s", rooms[r].name, rooms[r].what, truth_name[truth]);
    FILE *csv = study_curves_begin(study, csv_name, "angle_deg");
    if (csv == NULL)
        return;
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
                                               .title = title,
                                               .x_label = "angle of the viewer, degrees",
                                               .y_label = "gap to the limit, dB (mean over pictures)",
                                               .caption = title,
                                               .setup = "set yrange [0:4]\n",
                                               .x = 1,
                                               .before = 1,
                                               .method = method});
}

static void show_table(study_t *study, const study_mesh_sweep_t *sweep)
{
    FILE *csv = study_csv_begin(study, "gap_table.csv",
                                "method,eq picture mean,worst,eq original mean,worst,low picture mean,worst,"
                                "low original mean,worst,gt picture mean,worst,gt original mean,worst");
    if (csv == NULL)
        return;
    const study_methods_t measured = study_methods_all();
    for (int m = 0; m < WARP_METHODS; m++) {
        if ((measured >> m & 1) == 0)
            continue;
        fputs(warp_methods[m].name, csv);
        for (int column = 0; column < ROOMS * STUDY_TRUTHS; column++) {
            const study_mesh_sweep_t room = of_room(sweep, column / STUDY_TRUTHS);
            const gap_t gap = gap_of(&room, (study_truth_t)(column % STUDY_TRUTHS), m, -1);
            fprintf(csv, ",%.2f,%.2f", gap.mean_db, gap.worst_db);
        }
        fputc('\n', csv);
    }
    study_csv_end(study, csv);
    study_table(study, "gap_table.csv",
                "Gap to the limit, dB: mean and worst over angles and pictures, by room and truth.");
}

static study_tally_t duel(const study_mesh_sweep_t *room, study_truth_t truth, const char *mine, const char *other)
{
    const study_contest_t contest = {.truth = truth, .contenders = study_methods(mine), .others = study_methods(other)};
    return study_tally(&contest, room->run, room->count);
}

/* What the paper's truth rewards: methods that show the picture's pixels as blocks, in the room where each is large. */
static void show_rewards(study_t *study, const study_mesh_sweep_t *low)
{
    const study_tally_t area_blocks = duel(low, STUDY_TRUTH_PICTURE, "area", "mean+cubic");
    const study_tally_t area_eye = duel(low, STUDY_TRUTH_ORIGINAL, "area", "mean+cubic");
    const study_tally_t nearest_blocks = duel(low, STUDY_TRUTH_PICTURE, "none+nearest", "none+cubic");
    const study_tally_t nearest_eye = duel(low, STUDY_TRUTH_ORIGINAL, "none+nearest", "none+cubic");
    study_claim(study,
                nearest_blocks.mean_db > 0 && nearest_eye.mean_db < 0 && area_blocks.mean_db > 0 && area_eye.mean_db < 0
                    ? STUDY_HOLDS
                    : STUDY_FAILS,
                "wallwarp", "The paper's truth rewards blocks, which an eye would not.",
                "Its truth is the picture with each of its pixels a square of one level, so a method that shows these "
                "squares is right. In room low, where a picture pixel covers several of the projector's, none+nearest "
                "is %+.2f dB against none+cubic on average and area %+.2f dB against mean+cubic. Against the original, "
                "of which the picture is only a mean, the squares are errors: the same two are %+.2f and %+.2f dB.",
                nearest_blocks.mean_db, area_blocks.mean_db, nearest_eye.mean_db, area_eye.mean_db);
}

/* @param csv  A row for each figure that must hold, for tests and for the note of a release. */
static void show_contests(study_t *study, const study_mesh_sweep_t *sweep)
{
    gap_contest_t contest[GAP_CONTESTS];
    gap_contests(contest);
    FILE *csv = study_csv_begin(study, "gap_claims.csv",
                                "figure,room,cases,wins,worst_db,bound_db,picture,picture_width,panel_width,angle_deg");
    for (int c = 0; c < GAP_CONTESTS; c++) {
        study_tally_claim(study, &contest[c].words, &contest[c].contest, sweep->run, sweep->count);
        for (int r = 0; r < ROOMS && csv != NULL; r++) {
            const study_mesh_sweep_t room = of_room(sweep, r);
            const study_tally_t tally = study_tally(&contest[c].contest, room.run, room.count);
            const study_mesh_case_t *worst = &room.run[tally.worst < 0 ? 0 : tally.worst].at;
            fprintf(csv, "%s,%s,%d,%d,%.3f,%.3f,%s,%d,%d,%g\n", contest[c].name, rooms[r].name, tally.cases, tally.wins,
                    tally.worst_db, -contest[c].contest.tolerance_db, study_image_name(worst->image),
                    worst->sizes.picture_width, worst->sizes.panel_width, worst->angle_deg);
        }
    }
    if (csv != NULL)
        study_csv_end(study, csv);
    study_table(study, "gap_claims.csv", "The figures that must hold, by room, with the worst case of each.");
}

void study_gap(study_t *study)
{
    const int32_t places = study_quick(study) ? QUICK_PLACES : MAX_PLACES;
    study_mesh_case_t place[ROOMS * MAX_PLACES];
    for (int r = 0; r < ROOMS; r++)
        memcpy(&place[r * places], rooms[r].place, (size_t)places * sizeof place[0]);
    study_mesh_sweep_t sweep;
    if (!study_mesh_sweep(&sweep, study, place, ROOMS * places, study_quick(study) ? 10.0 : 5.0))
        return;
    char settings[STUDY_MESH_SETTINGS_LENGTH];
    study_mesh_settings(settings, &sweep);
    study_section(study, "Gap to the limit, under two truths", settings);
    study_text(study, "The limit is the mean of the truth within each projector pixel, which no method can beat. It is "
                      "not a method: it needs the truth.");
    for (int r = 0; r < ROOMS; r++) {
        const study_mesh_sweep_t room = of_room(&sweep, r);
        for (int truth = 0; truth < STUDY_TRUTHS; truth++)
            show_curves(study, &room, r, (study_truth_t)truth);
    }
    show_table(study, &sweep);
    const study_mesh_sweep_t low = of_room(&sweep, 1);
    show_rewards(study, &low);
    show_contests(study, &sweep);
    free(sweep.run);
}
