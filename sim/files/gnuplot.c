// SPDX-License-Identifier: Apache-2.0
// gnuplot at the other end of a pipe, drawing SVG files in the dark style of this project's pages.
#include "sim/files/gnuplot.h"

#include <signal.h>
#include <sys/wait.h>

enum { NOT_FOUND = 127 };

static const char style[] =
    "set encoding utf8\n"
    "set border 3 lc rgb '#46536a'\n"
    "set tics nomirror scale 0.5 tc rgb '#9aa8bd'\n"
    "set grid lc rgb '#263042' lw 1 dt 1\n"
    "set key outside top center horizontal samplen 1.6 tc rgb '#c6d0de'\n"
    "set datafile missing 'nan'\n"
    "array colour[8] = ['#6cb6ff','#f5a65b','#7fdca0','#c99bff','#ff8fa3','#e8d56b','#5fd3d3','#b9c3d0']\n";

bool gnuplot_open(gnuplot_t *plot, char error[FILE_ERROR_LENGTH])
{
    FILE *pipe = popen("command -v gnuplot >/dev/null || exit 127; exec gnuplot", "w");
    if (pipe == NULL)
        return file_error(error, "gnuplot", "can't be started");
    *plot = (gnuplot_t){pipe, signal(SIGPIPE, SIG_IGN)}; /* it may not be there to read */
    fputs(style, pipe);
    return true;
}

bool gnuplot_close(gnuplot_t *plot, char error[FILE_ERROR_LENGTH])
{
    const int status = pclose(plot->pipe);
    signal(SIGPIPE, plot->before);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND)
        return file_error(error, "gnuplot", "is not installed, so the plots are missing: apt-get install gnuplot-nox");
    return file_error(error, "gnuplot", "has failed, so plots are missing: see its message above");
}

void gnuplot_output(const gnuplot_t *plot, const char *folder, const char *name, int width, int height)
{
    char path[8192];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    fprintf(plot->pipe,
            "set terminal svg size %d,%d dynamic font 'Inter,Helvetica,Arial,sans-serif,13' background '#121926'\n"
            "set output ",
            width, height);
    gnuplot_string(plot, path);
    fputc('\n', plot->pipe);
}

void gnuplot_string(const gnuplot_t *plot, const char *text)
{
    fputc('\'', plot->pipe);
    for (const char *c = text; *c != '\0'; c++)
        fputs(*c == '\'' ? "''" : *c == '\n' ? " " : (char[]){*c, '\0'}, plot->pipe); /* '' is read as one quote */
    fputc('\'', plot->pipe);
}
