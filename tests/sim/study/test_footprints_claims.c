// SPDX-License-Identifier: Apache-2.0
// The claims about near and far parts of the wall fail when the numbers no longer show them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sim/study/footprints_claims.h"

/* none, gauss, kaiser, butter, mean */
static const footprints_parts_t shown = {{5.0, 8.0, 9.0, 8.5, 5.05}, {6.0, 3.0, 4.0, 3.5, 2.0}};

/* All hold; with one number changed under one truth, then under both, `which` holds in part, then not at all. */
static void flips(size_t which, bool far, footprints_method_t method, double value)
{
    footprints_parts_t parts[STUDY_TRUTHS] = {shown, shown};
    static const study_verdict_t expected[STUDY_TRUTHS + 1] = {STUDY_HOLDS, STUDY_PARTLY, STUDY_FAILS};
    for (int changed = 0; changed <= STUDY_TRUTHS; changed++) {
        const footprints_verdicts_t found = footprints_verdicts(parts);
        const study_verdict_t verdict[3] = {found.filters_blur_near, found.none_aliases_far, found.mean_is_best};
        for (size_t v = 0; v < 3; v++)
            if (verdict[v] != (v == which ? expected[changed] : STUDY_HOLDS))
                fail_msg("claim %zu, %s of method %d is %g under %d truths: verdict %d", v, far ? "far" : "near",
                         (int)method, value, changed, (int)verdict[v]);
        if (changed < STUDY_TRUTHS)
            (far ? parts[changed].far : parts[changed].near)[method] = value;
    }
}

static void verdicts_follow_the_numbers(void **state)
{
    (void)state;
    flips(0, false, FOOTPRINTS_GAUSS, 4.9);
    flips(0, false, FOOTPRINTS_KAISER, 4.9);
    flips(0, false, FOOTPRINTS_BUTTER, 4.9);
    flips(1, true, FOOTPRINTS_NONE, 2.9);
    flips(2, false, FOOTPRINTS_MEAN, 5.2);
    flips(2, true, FOOTPRINTS_MEAN, 3.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(verdicts_follow_the_numbers)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
