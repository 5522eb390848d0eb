// Rebuilds strands of hair from guides on the graphics card: what lissom_hair_rebuild does on the processor.
// GLSL 3.30 core and GLSL ES 3.00: the program puts `#version 330 core` or `#version 300 es` before this text, and
// `#define HAS_DETAILS` behind that for hair with details.
//
// One instance a strand, one vertex a point: glDrawArraysInstanced(GL_LINE_STRIP, 0, point_count, strand_count).
// What the program gives it, from hair that lissom_hair_open has opened:
//   root_length, guide_ids, weights_width    the strand, 48 bytes as in `strands`: two attributes of 4 floats around
//                   one of 4 unsigned integers (glVertexAttribIPointer), each with the divisor 1.
//   rest_guides     a texture of format RGB32F with GL_NEAREST, point_count texels wide and guide_count high: `guides`.
//   moved_guides    the same of the guides as they are now, in the space of the head.
//   details         a texture of format RGB16I with GL_NEAREST, point_count texels wide and a strand high:
//                   `details` of the strands that are drawn. One texture takes GL_MAX_TEXTURE_SIZE strands; more of
//                   them are drawn by several calls.
//   to_clip         from the space of the head to the screen.
//
// Details do not turn here. The fragment shader gets the place along the strand, 0 at the root and 1 at the tip, and
// the direction of the strand, by which hair is lit.
#ifdef GL_ES
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp isampler2D;
#endif

layout(location = 0) in vec4 root_length;
layout(location = 1) in uvec4 guide_ids;
layout(location = 2) in vec4 weights_width;

uniform sampler2D rest_guides, moved_guides;
uniform int point_count;
uniform mat4 to_clip;
#ifdef HAS_DETAILS
uniform isampler2D details;
uniform float detail_step;
#endif

out vec3 hair_position;
out vec3 hair_direction;
out float hair_place;

vec3 moved(int guide, int point) {
    return texelFetch(moved_guides, ivec2(point, guide), 0).xyz;
}

vec3 point_at(int point) {
    vec3 position = root_length.xyz;
    for (int i = 0; i < 3; ++i) {
        int guide = int(guide_ids[i]);
        vec3 root = moved(guide, 0), rest = texelFetch(rest_guides, ivec2(0, guide), 0).xyz;
        position += weights_width[i] * (root - rest + root_length.w * (moved(guide, point) - root));
    }
#ifdef HAS_DETAILS
    position += detail_step * vec3(texelFetch(details, ivec2(point, gl_InstanceID), 0).xyz);
#endif
    return position;
}

void main() {
    int point = gl_VertexID;
    hair_position = point_at(point);
    vec3 along = point_at(min(point + 1, point_count - 1)) - point_at(max(point - 1, 0));
    hair_direction = dot(along, along) > 0.0 ? normalize(along) : vec3(0.0, -1.0, 0.0);
    hair_place = float(point) / float(point_count - 1);
    gl_Position = to_clip * vec4(hair_position, 1.0);
}
