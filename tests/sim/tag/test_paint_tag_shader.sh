#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The shader compiles as GLSL for desktop and for ES, and as HLSL, by Khronos's own compiler.
#
# usage: test_paint_tag_shader.sh BUILD
set -eu
out=$1/paint_tag_shader
mkdir -p "$out"
failed=0 passed=0
check() { # TEXT COMMAND...
    text=$1
    shift
    if "$@" >"$out/log" 2>&1; then
        passed=$((passed + 1))
        echo "ok      $text"
    else
        failed=$((failed + 1))
        echo "FAILED  $text"
        cat "$out/log"
    fi
}

uniforms='uniform int width, height; uniform uint viewer, capture_time_us, frame_number; out vec4 color;'
main='void main() {
    int x = int(gl_FragCoord.x), y = height - 1 - int(gl_FragCoord.y);
    int block = paint_tag_block(x, y, width, height);
    color = vec4(0.0);
    if (block >= 0)
        color = vec4(vec3(float(paint_tag_level(block, viewer, capture_time_us, frame_number)) / 255.0), 1.0);
}'
{ printf '#version 130\n%s\n' "$uniforms"; cat sim/tag/paint_tag.glsl; echo "$main"; } >"$out/desktop.frag"
{
    printf '#version 300 es\nprecision highp float;\nprecision highp int;\n%s\n' "$uniforms"
    cat sim/tag/paint_tag.glsl
    echo "$main"
} >"$out/es.frag"
{
    cat sim/tag/paint_tag.glsl
    echo 'int width, height; uint viewer, capture_time_us, frame_number;
float4 main(float4 position : SV_Position) : SV_Target {
    int block = paint_tag_block(int(position.x), int(position.y), width, height);
    return block < 0 ? 0.0 : paint_tag_level(block, viewer, capture_time_us, frame_number) / 255.0;
}'
} >"$out/shader.hlsl"
check 'GLSL 1.30' glslangValidator "$out/desktop.frag"
check 'GLSL ES 3.00' glslangValidator "$out/es.frag"
check 'HLSL' glslangValidator -D -S frag -e main -V -o "$out/hlsl.spv" "$out/shader.hlsl"
echo "$passed passed, $failed failed"
test "$failed" = 0
