// SPDX-License-Identifier: Apache-2.0
// The page of a study: a template, and the parts that grow while experiments run.
#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "sim/files/folder.h"
#include "sim/files/html_template.h"
#include "sim/study/study_internal.h"

/* sim/study/study_files.S */
extern const char study_template[], study_template_end[];

enum { TEXT_LENGTH = 4096, ROW_LENGTH = 4096 };

/* Text of HTML, fit for between quotes too. */
static void print_escaped(FILE *file, const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        if (*c == '&')
            fputs("&amp;", file);
        else if (*c == '<')
            fputs("&lt;", file);
        else if (*c == '>')
            fputs("&gt;", file);
        else if (*c == '"')
            fputs("&quot;", file);
        else
            fputc(*c, file);
    }
}

static void print_element(FILE *file, const char *begin, const char *text, const char *end)
{
    fputs(begin, file);
    print_escaped(file, text);
    fputs(end, file);
}

static bool open_buffer(study_buffer_t *buffer)
{
    buffer->file = open_memstream(&buffer->text, &buffer->length);
    return buffer->file != NULL;
}

void study_page_open(study_t *study)
{
    if (!open_buffer(&study->contents) || !open_buffer(&study->headlines) || !open_buffer(&study->claims) ||
        !open_buffer(&study->sections))
        study_fail(study, "out of memory");
}

static void close_buffer(study_buffer_t *buffer)
{
    if (buffer->file != NULL)
        fclose(buffer->file);
    free(buffer->text);
}

void study_page_close(study_t *study)
{
    close_buffer(&study->contents);
    close_buffer(&study->headlines);
    close_buffer(&study->claims);
    close_buffer(&study->sections);
}

static void end_figures(study_t *study)
{
    if (study->figures_open)
        fputs("</div>\n", study->sections.file);
    study->figures_open = false;
}

static void end_section(study_t *study)
{
    end_figures(study);
    if (study->section_count > 0)
        fputs("</section>\n", study->sections.file);
}

void study_section(study_t *study, const char *title, const char *format, ...)
{
    if (study_failed(study))
        return;
    char settings[TEXT_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(settings, sizeof settings, format, arguments);
    va_end(arguments);
    end_section(study);
    const int number = ++study->section_count;
    fprintf(study->sections.file, "<section id=\"s%d\">\n", number);
    print_element(study->sections.file, "<h2>", title, "</h2>\n");
    print_element(study->sections.file, "<p class=\"settings\">", settings, "</p>\n");
    fprintf(study->contents.file, "<a href=\"#s%d\">", number);
    print_element(study->contents.file, "", title, "</a>\n");
}

void study_text(study_t *study, const char *format, ...)
{
    if (study_failed(study))
        return;
    char text[TEXT_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    end_figures(study);
    print_element(study->sections.file, "<p class=\"note\">", text, "</p>\n");
}

static void print_link(FILE *file, const char *csv)
{
    print_element(file, " <a href=\"", csv, "\">");
    print_element(file, "", csv, "</a>");
}

void study_figure(study_t *study, const char *picture, const char *csv, const char *caption)
{
    if (study_failed(study))
        return;
    FILE *file = study->sections.file;
    if (!study->figures_open)
        fputs("<div class=\"figures\">\n", file);
    study->figures_open = true;
    print_element(file, "<figure class=\"card\"><img src=\"", picture, "\" alt=\"");
    print_element(file, "", caption, "\"><figcaption>");
    print_escaped(file, caption);
    if (csv != NULL)
        print_link(file, csv);
    fputs("</figcaption></figure>\n", file);
}

static void print_row(FILE *file, char *row, const char *cell)
{
    fputs("<tr>", file);
    row[strcspn(row, "\r\n")] = '\0';
    for (char *field = strsep(&row, ","); field != NULL; field = strsep(&row, ",")) {
        fprintf(file, "<%s>", cell);
        print_escaped(file, field);
        fprintf(file, "</%s>", cell);
    }
    fputs("</tr>\n", file);
}

void study_table(study_t *study, const char *csv, const char *caption)
{
    char path[FILE_ERROR_LENGTH], row[ROW_LENGTH];
    if (study_failed(study) || study_path(study, csv, path) == NULL)
        return;
    FILE *from = fopen(path, "rb");
    if (from == NULL) {
        study_fail(study, "%s: can't be read: %s", path, strerror(errno));
        return;
    }
    end_figures(study);
    FILE *file = study->sections.file;
    fputs("<figure class=\"card table\"><div class=\"scroll\"><table>\n", file);
    for (int32_t n = 0; fgets(row, sizeof row, from) != NULL; n++)
        print_row(file, row, n == 0 ? "th" : "td");
    print_element(file, "</table></div><figcaption>", caption, "");
    print_link(file, csv);
    fputs("</figcaption></figure>\n", file);
    fclose(from);
}

void study_data(study_t *study, const char *csv, const char *caption)
{
    if (study_failed(study))
        return;
    end_figures(study);
    FILE *file = study->sections.file;
    print_element(file, "<p class=\"note\">", caption, "");
    print_link(file, csv);
    fputs("</p>\n", file);
}

static int all_claims(const study_t *study)
{
    int claims = 0;
    for (int v = 0; v < STUDY_VERDICTS; v++)
        claims += study->claims_of[v];
    return claims;
}

void study_headline(study_t *study, const char *format, ...)
{
    if (study_failed(study))
        return;
    char text[TEXT_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    print_element(study->headlines.file, "<p>", text, "</p>\n");
}

static void print_claim(FILE *file, study_verdict_t verdict, const char *source, const char *claim)
{
    static const char *const pills[] = {
        [STUDY_HOLDS] = "good\">holds", [STUDY_PARTLY] = "part\">holds in part", [STUDY_FAILS] = "bad\">does not hold"};
    fprintf(file, "<span class=\"pill %s</span>", pills[verdict]);
    print_element(file, "<div><b>", claim, "</b>");
    print_element(file, " <small>", source, "</small>");
}

void study_claim(study_t *study, study_verdict_t verdict, const char *source, const char *claim, const char *format,
                 ...)
{
    if (study_failed(study))
        return;
    char why[TEXT_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why, sizeof why, format, arguments);
    va_end(arguments);
    end_figures(study);
    study->claims_of[verdict]++;
    const int number = all_claims(study);
    fprintf(study->claims.file, "<a class=\"claim\" href=\"#c%d\">", number);
    print_claim(study->claims.file, verdict, source, claim);
    fputs("</div></a>\n", study->claims.file);
    fprintf(study->sections.file, "<div class=\"claim card\" id=\"c%d\">", number);
    print_claim(study->sections.file, verdict, source, claim);
    print_element(study->sections.file, "<p>", why, "</p></div></div>\n");
}

/* Write the page up to a mark, and there the buffer. */
static void print_part(html_template_t *page, const char *mark, const study_buffer_t *buffer)
{
    html_template_until(page, mark);
    fwrite(buffer->text, 1, buffer->length, page->file);
}

void study_page_write(study_t *study)
{
    if (study_failed(study))
        return;
    end_section(study);
    study_buffer_t *const buffers[] = {&study->contents, &study->headlines, &study->claims, &study->sections};
    for (size_t b = 0; b < sizeof buffers / sizeof *buffers; b++)
        if (fflush(buffers[b]->file) != 0) {
            study_fail(study, "out of memory");
            return;
        }
    char error[FILE_ERROR_LENGTH];
    FILE *file = folder_create_file(study->options.folder, "index.html", error);
    if (file == NULL) {
        study_fail(study, "%s", error);
        return;
    }
    html_template_t page = html_template_begin(file, study_template, study_template_end);
    print_part(&page, "<!--HEADLINES-->", &study->headlines);
    html_template_until(&page, "<!--COUNT-->");
    fprintf(file, "%d claims: %d hold, %d in part, %d not.", all_claims(study), study->claims_of[STUDY_HOLDS],
            study->claims_of[STUDY_PARTLY], study->claims_of[STUDY_FAILS]);
    print_part(&page, "<!--CLAIMS-->", &study->claims);
    print_part(&page, "<!--CONTENTS-->", &study->contents);
    print_part(&page, "<!--SECTIONS-->", &study->sections);
    html_template_end(&page);
    if (!folder_close_file(file, "index.html", error))
        study_fail(study, "%s", error);
}
