// Moves a surface by its handles on the graphics card: what lissom_basis_evaluate does on the processor.
// GLSL 3.30 core and GLSL ES 3.00: the program puts `#version 330 core` or `#version 300 es` before this
// text, and `#define MAX_HANDLES n` behind that for more than 8 handles.
//
// What the program gives it, from a basis that lissom_basis_open has opened:
//   rest            where each vertex lies at rest, relative to the origin of the basis: `rest` of the basis,
//                   or the position in the model less `origin`.
//   basis_row       the row of the basis for each vertex, -1 for those outside the region. Models have more
//                   vertices than the surface where texture coordinates meet: bake.lua saves the rows with
//                   the model, as the attribute _BASIS_ROW.
//   weights         a texture of format RGBA32F with GL_NEAREST, as many texels wide as you like: `weights`
//                   of the basis, row after row of the texture, 16 bytes a texel.
//   vertex_count, handle_count     as in the basis.
//   corrections     of a basis with key poses: `corrections` in a texture of format RGB32F, laid out likewise, 12
//                   bytes a texel; key_count as in the basis, 0 without keys; key_weights from
//                   lissom_basis_key_weights, for each frame. `#define MAX_KEYS n` for more than 32.
//   transforms      3 rows a handle, relative to the origin: what lissom_basis_local writes.
//   to_clip         from the space of the mesh, moved so that the origin of the basis is at 0, to the screen.
//
// The shape is exact to the rounding of floats. Normals are not part of a basis. The fragment shader may take
// normalize(cross(dFdx(surface_position), dFdy(surface_position))), which is flat on each face; smooth ones
// come from lissom_basis_normals.
#ifdef GL_ES
precision highp float;
precision highp sampler2D;
#endif

#ifndef MAX_HANDLES
#define MAX_HANDLES 8
#endif

#ifndef MAX_KEYS
#define MAX_KEYS 32
#endif

layout(location = 0) in vec3 rest;
layout(location = 1) in float basis_row;

uniform sampler2D weights, corrections;
uniform int vertex_count, handle_count, key_count;
uniform float key_weights[MAX_KEYS];
uniform vec4 transforms[3 * MAX_HANDLES];
uniform mat4 to_clip;

out vec3 surface_position;

vec4 weight_of(int handle, int row) {
    int texel = handle * vertex_count + row, width = textureSize(weights, 0).x;
    return texelFetch(weights, ivec2(texel % width, texel / width), 0);
}

vec3 correction_of(int key, int row) {
    int texel = key * vertex_count + row, width = textureSize(corrections, 0).x;
    return texelFetch(corrections, ivec2(texel % width, texel / width), 0).xyz;
}

// rest + sum over handles of (T - I) weight + sum over keys of weight correction.
vec3 moved(vec3 position, int row) {
    for (int h = 0; h < handle_count; ++h) {
        vec4 weight = weight_of(h, row);
        position += vec3(dot(transforms[3 * h] - vec4(1, 0, 0, 0), weight),
                         dot(transforms[3 * h + 1] - vec4(0, 1, 0, 0), weight),
                         dot(transforms[3 * h + 2] - vec4(0, 0, 1, 0), weight));
    }
    for (int k = 0; k < key_count; ++k) position += key_weights[k] * correction_of(k, row);
    return position;
}

void main() {
    surface_position = basis_row < 0.0 ? rest : moved(rest, int(basis_row + 0.5));
    gl_Position = to_clip * vec4(surface_position, 1.0);
}
