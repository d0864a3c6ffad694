// SPDX-License-Identifier: Apache-2.0
// Draws the code of firmware/frame_tag.h in a shader: the last thing that is done to a picture. Needs no other file.
//
// It is GLSL (from 1.30, or ES 3.00 with `precision highp int;`), HLSL and C at once: numbers only, no vectors. In a
// fragment shader of GLSL, with the size of the picture and the number of this frame, and time and viewer of the pose
// that it was drawn from (sim/tag/paint_tag.h says which time exactly):
//
//   int x = int(gl_FragCoord.x), y = height - 1 - int(gl_FragCoord.y);      // y = 0 is the top row
//   int block = paint_tag_block(x, y, width, height);
//   if (block >= 0)
//       color = vec4(vec3(float(paint_tag_level(block, viewer, capture_time_us, frame_number)) / 255.0), 1.0);
//
// In a pixel shader of HLSL x and y are int(position.x) and int(position.y).
// The levels are those of the cable. A render target that turns linear light to sRGB wants 32 / 255 as 0.0144 and
// 224 / 255 as 0.7454.

// Which block of the code is pixel (x, y) of? -1: of none, or the picture has no room for the code.
int paint_tag_block(int x, int y, int width, int height)
{
    int side = width < 320 ? 4 : 8;
    int columns = width / side < 120 ? width / side : 120;
    if (columns < 1 || y < 0 || x < 0 || x / side >= columns)
        return -1;
    int rows = (119 + columns) / columns;
    int block = (y / side) * columns + x / side;
    return height < 2 * (rows * side + 2) || block >= 120 ? -1 : block;
}

// CRC-32, without the final xor, of the lowest `bytes` bytes of a word, highest first.
uint paint_tag_crc(uint crc, uint word, int bytes)
{
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
        crc ^= (word >> shift) & 255u;
        for (int bit = 0; bit < 8; bit++)
            crc = (crc & 1u) != 0u ? (crc >> 1) ^ 0xEDB88320u : crc >> 1;
    }
    return crc;
}

// The level of a block, 0 to 119: 32 or 224, of 255. The viewer is 0 to 3.
int paint_tag_level(int block, uint viewer, uint capture_time_us, uint frame_number)
{
    uint head = 0xF35010u | viewer;
    uint word = head << 8;
    int bit = block;
    if (block >= 88) {
        uint crc = paint_tag_crc(0xFFFFFFFFu, head, 1);
        crc = paint_tag_crc(crc, capture_time_us, 4);
        word = ~paint_tag_crc(crc, frame_number, 4);
        bit = block - 88;
    } else if (block >= 56) {
        word = frame_number;
        bit = block - 56;
    } else if (block >= 24) {
        word = capture_time_us;
        bit = block - 24;
    }
    return ((word >> (31 - bit)) & 1u) != 0u ? 224 : 32;
}
