// SPDX-License-Identifier: Apache-2.0
// Fuzzes the PNG reader: any file is a whole picture, or an error of one line and nothing written.
//
// An input that begins like a PNG file is read as it is, and again with right CRCs. Any other input is made into a PNG
// file: 13 bytes of its header chunk, then chunks of "kind, length, bytes", so that few of them are refused at once.
#include "sim/files/png_file.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "sim/files/pixel.h"
#include "tests/fuzz/input.h"

enum { FILE_BYTES = 1 << 16, CHUNK_BYTES = 1 << 12, UNTOUCHED = 0xa5, SIGNATURE_BYTES = 8, AROUND_DATA = 12 };

static const uint8_t signature[SIGNATURE_BYTES] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

typedef struct {
    uint8_t bytes[FILE_BYTES];
    size_t size;
} png_bytes_t;

static void put_word(uint8_t *to, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(word >> (24 - 8 * i));
}

static uint32_t get_word(const uint8_t *from)
{
    return (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3];
}

static void put_chunk(png_bytes_t *png, const char *type, const uint8_t *data, size_t length)
{
    if (png->size + AROUND_DATA + length > FILE_BYTES)
        return;
    uint8_t *chunk = png->bytes + png->size;
    put_word(chunk, (uint32_t)length);
    memcpy(chunk + 4, type, 4);
    memcpy(chunk + 8, data, length);
    put_word(chunk + 8 + length, (uint32_t)crc32(0, chunk + 4, (uInt)length + 4));
    png->size += AROUND_DATA + length;
}

static void put_header(png_bytes_t *png, input_t *input)
{
    uint8_t header[13] = {0};
    const uint8_t kind = input_byte(input);
    static const uint8_t colour_types[] = {2, 0, 3, 4, 6, 1, 5, 255};
    put_word(header, 1 + (uint32_t)input_bits(input, kind & 1 ? 4 : 1));
    put_word(header + 4, 1 + (uint32_t)input_bits(input, kind & 2 ? 4 : 1));
    header[8] = kind & 4 ? input_byte(input) : (uint8_t)(1 << (kind >> 3) % 5);
    header[9] = colour_types[input_byte(input) % 8];
    header[12] = input_byte(input);
    put_chunk(png, "IHDR", header, sizeof header);
}

/* Picture data are packed here: nobody finds a whole zlib stream by chance. */
static void put_pixels(png_bytes_t *png, input_t *input)
{
    uint8_t raw[CHUNK_BYTES * 4], packed[CHUNK_BYTES * 5];
    uLongf packed_size = sizeof packed;
    const size_t length = (size_t)input_range(input, 0, CHUNK_BYTES) * 4;
    const uint8_t step = input_byte(input);
    for (size_t i = 0; i < length; i++)
        raw[i] = input->left > 0 ? input_byte(input) : (uint8_t)(i * step % 5);
    if (compress2(packed, &packed_size, raw, length, 1) == Z_OK)
        put_chunk(png, "IDAT", packed, packed_size);
}

static void put_any_chunk(png_bytes_t *png, input_t *input)
{
    static const char types[][5] = {"PLTE", "tRNS", "gAMA", "sBIT", "bKGD", "iCCP", "tEXt", "IDAT", "IEND", "IHDR"};
    uint8_t data[CHUNK_BYTES];
    char type[5] = "";
    const uint8_t kind = input_byte(input);
    if (kind < 10)
        memcpy(type, types[kind], sizeof type);
    else
        for (int i = 0; i < 4; i++)
            type[i] = (char)input_byte(input);
    const size_t length = (size_t)input_range(input, 0, 800);
    for (size_t i = 0; i < length; i++)
        data[i] = input_byte(input);
    put_chunk(png, type, data, length);
}

static void make_png(png_bytes_t *png, input_t *input)
{
    memcpy(png->bytes, signature, SIGNATURE_BYTES);
    png->size = SIGNATURE_BYTES;
    put_header(png, input);
    for (int chunks = input_byte(input) % 8; chunks > 0; chunks--)
        put_any_chunk(png, input);
    put_pixels(png, input);
    put_chunk(png, "IEND", signature, 0);
}

static void repair_crcs(png_bytes_t *png)
{
    for (size_t at = SIGNATURE_BYTES; at + AROUND_DATA <= png->size;) {
        const uint32_t length = get_word(png->bytes + at);
        if (length > png->size - at - AROUND_DATA)
            return;
        uint8_t *type = png->bytes + at + 4;
        put_word(type + 4 + length, (uint32_t)crc32(0, type, length + 4));
        at += AROUND_DATA + length;
    }
}

static void check_picture(const char *path, const image_t *colour)
{
    char error[FILE_ERROR_LENGTH] = "";
    int32_t width = 0, height = 0;
    image_t gray;
    fuzz_check(colour->width >= 1 && colour->width <= IMAGE_MAX_WIDTH, "a width fits the buffers");
    fuzz_check(colour->height >= 1 && colour->height <= IMAGE_MAX_HEIGHT, "a height fits the buffers");
    fuzz_check(png_file_size(path, &width, &height, error), "a picture that was read has a size");
    fuzz_check(width == colour->width && height == colour->height, "the size is the picture's");
    fuzz_check(png_file_load(path, IMAGE_GRAY8, &gray, error), "a picture in colour can be read as gray");
    for (int32_t i = 0; i < width * height; i++) {
        const uint8_t *pixel = colour->data + (ptrdiff_t)4 * i;
        fuzz_check(pixel[3] == 0, "X is 0");
        fuzz_check(gray.data[i] == luma_from_rgb(pixel[2], pixel[1], pixel[0]), "gray is the luma of the colour");
    }
    free(gray.data);
}

/* Into a picture of 3x2 pixels with some bytes after each row; only the file's own size is taken. */
static void check_reading_in_place(const char *path, const image_t *loaded)
{
    enum { WIDTH = 3, HEIGHT = 2, STRIDE = WIDTH * 4 + 5 };
    char error[FILE_ERROR_LENGTH] = "";
    uint8_t pixels[STRIDE * HEIGHT];
    memset(pixels, UNTOUCHED, sizeof pixels);
    const image_t image = {pixels, WIDTH, HEIGHT, STRIDE, IMAGE_XRGB8888};
    const bool read = png_file_read(path, &image, error);
    const bool fits = loaded != NULL && loaded->width == WIDTH && loaded->height == HEIGHT;
    fuzz_check(read == fits, "a picture is read in place when it has the size asked for");
    for (int i = 0; i < STRIDE * HEIGHT; i++) {
        const bool written = read && i % STRIDE < WIDTH * 4;
        const uint8_t expected = written ? loaded->data[i / STRIDE * WIDTH * 4 + i % STRIDE] : UNTOUCHED;
        fuzz_check(pixels[i] == expected, "only the pixels are written, and only on success");
    }
}

static void check_file(const png_bytes_t *png)
{
    char error[FILE_ERROR_LENGTH] = "";
    image_t image = {.data = NULL};
    const input_file_t file = input_file_open(png->bytes, png->size);
    const bool loaded = png_file_load(file.path, IMAGE_XRGB8888, &image, error);
    if (loaded)
        check_picture(file.path, &image);
    else
        fuzz_check_line(error);
    fuzz_check(loaded == (image.data != NULL), "a picture comes with success only");
    check_reading_in_place(file.path, loaded ? &image : NULL);
    free(image.data);
    input_file_close(&file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    png_bytes_t png;
    input_t input = {data, size};
    if (size >= 4 && size <= FILE_BYTES && memcmp(data, signature, 4) == 0) {
        memcpy(png.bytes, data, size);
        png.size = size;
        check_file(&png);
        repair_crcs(&png);
    } else {
        make_png(&png, &input);
    }
    check_file(&png);
    return 0;
}
