// SPDX-License-Identifier: Apache-2.0
// The homography of a frame's pixels -> that of its chroma pixels.
#include "warp_fixed/homography_of_chroma.h"

void homography_of_chroma(homography_t *chroma, const homography_t *homography, chroma_log2_t panel,
                          chroma_log2_t picture)
{
    const int row_log2[3] = {-picture.x, -picture.y, 0}, column_log2[3] = {panel.x, panel.y, 0};
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++)
            chroma->row[r][c] = real_scale(homography->row[r][c], row_log2[r] + column_log2[c]);
        chroma->weight[c] = real_scale(homography->weight[c], column_log2[c]);
    }
    chroma->panel_width = homography->panel_width >> panel.x;
    chroma->panel_height = homography->panel_height >> panel.y;
    chroma->picture_width = homography->picture_width >> picture.x;
    chroma->picture_height = homography->picture_height >> picture.y;
}
