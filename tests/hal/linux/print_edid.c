// SPDX-License-Identifier: Apache-2.0
// Writes the EDID of a size and rate to stdout, for another program to judge: print_edid WIDTH HEIGHT FRAMES SECONDS
#include <stdio.h>
#include <stdlib.h>

#include "hal/linux/edid.h"

int main(int argc, char **argv)
{
    edid_mode_t mode;
    uint8_t edid[EDID_BYTES];
    if (argc != 5 || !edid_mode(&mode, atoi(argv[1]), atoi(argv[2]), atoi(argv[3]), atoi(argv[4])))
        return 1;
    edid_write(edid, &mode);
    return fwrite(edid, 1, sizeof edid, stdout) == sizeof edid ? 0 : 1;
}
