// Shaders of meshes, hair and lines; lights and terms are those of viewer/render/gl.
const light = `
uniform mat4 u_view;
const vec3 kKeyDirection = normalize(vec3(-0.62, 0.62, 0.48));
const vec3 kFillDirection = normalize(vec3(0.80, 0.05, 0.55));
const vec3 kRimDirection = normalize(vec3(0.45, 0.45, -0.55));
const vec3 kKeyLight = vec3(1.10, 1.08, 1.04), kFillLight = vec3(0.13, 0.14, 0.16), kRimLight = vec3(0.22, 0.235, 0.25);
const vec3 kSkyLight = vec3(0.32, 0.33, 0.35), kGroundLight = vec3(0.105, 0.095, 0.09);
uniform highp sampler3D u_hair;
uniform vec4 u_hair_grid;  // origin, cell; no cell: no hair
uniform vec3 u_hair_size;
uniform vec3 u_hair_color;  // linear, of all the hair
uniform float u_shadow;

// Key, rim and mean light that strands leave at a place of the world.
vec3 hair_light(vec3 place) {
    if (u_hair_grid.w <= 0.0) return vec3(1.0);
    vec3 at = (place - u_hair_grid.xyz) / u_hair_grid.w / u_hair_size;
    vec3 outside = max(max(-at, at - 1.0), vec3(0.0)) * u_hair_size;
    vec4 moments = texture(u_hair, at);
    vec3 slope = 2.0 * moments.gba - 1.0;
    mat3 to_view = mat3(u_view);
    vec3 light = vec3(moments.r + dot(slope, kKeyDirection * to_view), moments.r + dot(slope, kRimDirection * to_view),
                      moments.r);
    float fade = clamp(1.0 - length(outside) / 8.0, 0.0, 1.0);
    return mix(vec3(1.0), clamp(light, 0.0, 1.0), fade * u_shadow);
}
// The same for a strand: looked up nearer to the lights, as the grid blurs strands into the air; of the light from all
// around, the sky is brighter than the ground.
vec3 strand_light(vec3 place) {
    if (u_hair_grid.w <= 0.0) return vec3(1.0);
    mat3 to_view = mat3(u_view);
    float nearer = 0.9 * u_hair_grid.w, sky = dot(kSkyLight, vec3(1.0)), ground = dot(kGroundLight, vec3(1.0));
    vec3 at = (place - u_hair_grid.xyz) / u_hair_grid.w / u_hair_size;
    vec4 moments = texture(u_hair, at);
    float around = moments.r + (sky - ground) / (3.0 * (sky + ground)) * dot(2.0 * moments.gba - 1.0, vec3(0.0, 1.0, 0.0) * to_view);
    return vec3(hair_light(place + nearer * (kKeyDirection * to_view)).x, hair_light(place + nearer * (kRimDirection * to_view)).y,
                mix(1.0, clamp(around, 0.0, 1.0), u_shadow));
}
// Loss of light at a strand, and light that goes through hair by its colour: dual scattering, as in strand_shading.h.
vec3 loss_of(vec3 color) {
    vec3 logs = log(clamp(color, 1e-3, 1.0));
    return 0.0462 * logs * logs - log(0.80);
}
vec3 through_hair(vec3 loss, float left) { return exp(loss * log(max(left, 1e-6)) / 0.378); }
vec3 shown(vec3 linear) {
    linear = clamp(linear, 0.0, 1.0);
    return mix(12.92 * linear, 1.055 * pow(max(linear, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
}
`;
const toLinear = `
vec3 to_linear(vec3 srgb) { return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), step(0.04045, srgb)); }
`;

export const meshVertex = `#version 300 es
precision highp float;
in vec3 a_position;
in vec3 a_normal;
in vec4 a_color;
in float a_flags;
uniform mat4 u_view, u_projection, u_place;
out vec3 v_position, v_world, v_normal, v_color, v_corner;
out float v_value;
flat out int v_flags;
${toLinear}
void main() {
    int corner = gl_VertexID % 3;
    v_corner = vec3(corner == 0, corner == 1, corner == 2);
    vec4 world = u_place * vec4(a_position, 1.0);
    v_world = world.xyz;
    v_position = (u_view * world).xyz;
    v_normal = mat3(u_view) * (mat3(u_place) * a_normal);
    v_color = to_linear(a_color.rgb);
    v_value = a_color.a;
    v_flags = int(a_flags + 0.5);
    gl_Position = u_projection * vec4(v_position, 1.0);
}`;

export const meshFragment = `#version 300 es
precision highp float;
in vec3 v_position, v_world, v_normal, v_color, v_corner;
in float v_value;
flat in int v_flags;
uniform float u_wire;  // pixels
uniform bool u_flat;
uniform sampler2D u_colormap;
uniform highp sampler2D u_openness;
uniform vec2 u_openness_scale, u_openness_offset;  // from pixels to its texels
uniform highp sampler3D u_tint;  // how far the scalp has the colour of its hair
out vec4 o_color;
${toLinear}
${light}
// Openness around this fragment, from the four nearest texels at its depth.
float openness(float depth) {
    vec2 at = gl_FragCoord.xy * u_openness_scale + u_openness_offset - 0.5;
    ivec2 corner = ivec2(floor(at)), last = textureSize(u_openness, 0) - 1;
    vec2 share = at - vec2(corner), sum = vec2(0.0);
    float tolerance = 2.0 * fwidth(depth) + 0.002 * abs(depth);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec2 texel = texelFetch(u_openness, clamp(corner + offset, ivec2(0), last), 0).xy;
        vec2 near = mix(1.0 - share, share, vec2(offset));
        float weight = (near.x * near.y + 1e-3) * exp(-abs(texel.y - depth) / tolerance) + 1e-9;
        sum += weight * vec2(texel.x, 1.0);
    }
    return sum.x / sum.y;
}
float soft_cosine(vec3 normal, vec3 direction, float wrap) {
    float cosine = (dot(normal, direction) + wrap) / (1.0 + wrap);
    return cosine > 0.0 ? cosine * cosine * (1.5 - 0.5 * cosine) * 0.35 + 0.65 * cosine : 0.0;
}
float edge_cover() {
    vec3 slope = vec3(length(vec2(dFdx(v_corner.x), dFdy(v_corner.x))), length(vec2(dFdx(v_corner.y), dFdy(v_corner.y))),
                      length(vec2(dFdx(v_corner.z), dFdy(v_corner.z))));
    float fade = clamp(1.0 / (max(slope.x, max(slope.y, slope.z)) * 5.0 * u_wire), 0.25, 1.0), cover = 0.0;
    for (int i = 0; i < 3; ++i) {
        if ((v_flags & (1 << i)) == 0) continue;
        cover = max(cover, clamp(0.5 * u_wire + 0.5 - v_corner[i] / slope[i], 0.0, 1.0));
    }
    return fade * cover;
}
void main() {
    vec3 flat_normal = cross(dFdx(v_position), dFdy(v_position));
    vec3 normal = u_flat || dot(v_normal, v_normal) < 1e-12 ? flat_normal : v_normal;
    normal = normalize(gl_FrontFacing || u_flat ? normal : -normal);
    vec3 to_viewer = normalize(-v_position);
    bool has_value = (v_flags & 8) != 0;
    vec3 color = has_value ? to_linear(texture(u_colormap, vec2((v_value * 255.0 + 0.5) / 256.0, 0.5)).rgb) : v_color;
    if (!gl_FrontFacing) color *= vec3(0.50, 0.36, 0.30);
    float open = openness(-v_position.z), plain = has_value ? 0.5 : 0.0;
    vec3 hair = hair_light(v_world + mat3(transpose(u_view)) * normal * u_hair_grid.w);
    vec3 in_grid = (v_world - u_hair_grid.xyz) / max(u_hair_grid.w, 1e-30) / u_hair_size;
    bool is_inside = u_hair_grid.w > 0.0 && all(greaterThan(in_grid, vec3(0.0))) && all(lessThan(in_grid, vec3(1.0)));
    float grows = is_inside ? texture(u_tint, in_grid).r : 0.0;
    color = mix(color, u_hair_color, grows);
    float grazing = pow(1.0 - max(dot(normal, to_viewer), 0.0), 3.0);
    vec3 loss = loss_of(u_hair_color);
    loss = mix(vec3(dot(loss, vec3(1.0 / 3.0))), loss, 0.35);
    vec3 arriving = open * through_hair(loss, hair.z);
    vec3 sum = mix(kGroundLight, kSkyLight, 0.5 + 0.5 * normal.y) * arriving
             + kKeyLight * through_hair(loss, hair.x) * soft_cosine(normal, kKeyDirection, 0.15) * mix(0.45, 1.0, open)
             + kFillLight * soft_cosine(normal, kFillDirection, 0.3) * arriving
             + kRimLight * max(dot(normal, kRimDirection), 0.0) * arriving;
    vec3 half_way = normalize(kKeyDirection + to_viewer);
    float shine = max(dot(normal, kKeyDirection), 0.0) * 1.28 * pow(max(dot(normal, half_way), 0.0), 24.0);
    vec3 lit = color * mix(sum * (1.0 - 0.30 * grazing), vec3(0.92), plain) + kKeyLight * hair.x * shine * 0.045 * open * (1.0 - grows) * (1.0 - plain);
    if (u_wire > 0.0) lit = mix(lit, vec3(0.013, 0.016, 0.023), 0.8 * edge_cover());
    o_color = vec4(shown(lit), 1.0);
}`;

// Ambient occlusion as in viewer/render/gl/shaders.cpp (McGuire, Mara and Luebke 2012), from depths and normals.
export const geometryVertex = `#version 300 es
precision highp float;
in vec3 a_position;
in vec3 a_normal;
uniform mat4 u_view, u_projection, u_place;
out vec3 v_position, v_normal;
void main() {
    vec4 position = u_view * u_place * vec4(a_position, 1.0);
    v_position = position.xyz;
    v_normal = mat3(u_view) * (mat3(u_place) * a_normal);
    gl_Position = u_projection * position;
}`;

export const geometryFragment = `#version 300 es
precision highp float;
in vec3 v_position, v_normal;
out vec4 o_normal_depth;
void main() {
    vec3 normal = dot(v_normal, v_normal) > 0.0 ? v_normal : cross(dFdx(v_position), dFdy(v_position));
    o_normal_depth = vec4(normalize(gl_FrontFacing ? normal : -normal), -v_position.z);
}`;

export const coverVertex = `#version 300 es
void main() { gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0); }`;

export const occlusionFragment = `#version 300 es
precision highp float;
uniform highp sampler2D u_normal_depth;
uniform vec2 u_extent;  // half the width and height of the view at depth 1
uniform float u_radius;
out vec4 o_openness_depth;
const int kSamples = 20;
vec3 position_at(ivec2 pixel, float depth) {
    vec2 place = 2.0 * (vec2(pixel) + 0.5) / vec2(textureSize(u_normal_depth, 0)) - 1.0;
    return vec3(place * u_extent * depth, -depth);
}
float start_angle(ivec2 pixel) {
    int order = (pixel.x & 3) ^ (pixel.y & 3);
    order = ((order & 1) << 3) | (order & 2) | ((pixel.y & 1) << 2) | ((pixel.y & 2) >> 1);
    return 6.2831853 * float(order) / 16.0;
}
float obscurance(vec3 position, vec3 normal, ivec2 pixel, float radius) {
    vec2 size = vec2(textureSize(u_normal_depth, 0));
    float pixels = radius * 0.5 * size.y / (u_extent.y * -position.z), bias = 0.02 * radius, angle = start_angle(pixel), sum = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        float share = (float(i) + 0.5) / float(kSamples), turn = angle + share * 7.0 * 6.2831853;
        ivec2 at = pixel + ivec2(round(share * max(pixels, 3.0) * vec2(cos(turn), sin(turn))));
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(size)))) continue;
        float other = texelFetch(u_normal_depth, at, 0).w;
        if (other == 0.0) continue;
        vec3 to_other = position_at(at, other) - position;
        float square = dot(to_other, to_other), rise = dot(to_other, normal) - bias;
        float falloff = max(1.0 - square / (radius * radius), 0.0);
        sum += falloff * falloff * falloff * max(rise, 0.0) / (square / radius + 0.01 * radius);
    }
    return sum / float(kSamples);
}
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 here = texelFetch(u_normal_depth, pixel, 0);
    o_openness_depth = vec4(1.0, 0.0, 0.0, 0.0);
    if (here.w == 0.0) return;
    vec3 position = position_at(pixel, here.w);
    float narrow = obscurance(position, here.xyz, pixel, 0.25 * u_radius), wide = obscurance(position, here.xyz, pixel, u_radius);
    o_openness_depth.xy = vec2(max(1.0 - 2.0 * narrow, 0.0) * max(1.0 - 2.6 * wide, 0.0), here.w);
}`;

export const blurFragment = `#version 300 es
precision highp float;
uniform highp sampler2D u_openness_depth, u_normal_depth;
uniform ivec2 u_step;
uniform float u_radius;
out vec4 o_openness_depth;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(u_openness_depth, 0) - 1;
    vec2 here = texelFetch(u_openness_depth, pixel, 0).xy, sum = vec2(here.x, 1.0);
    vec3 normal = texelFetch(u_normal_depth, pixel, 0).xyz;
    for (int i = -3; i <= 3; ++i) {
        if (i == 0) continue;
        ivec2 at = clamp(pixel + i * u_step, ivec2(0), last);
        vec2 other = texelFetch(u_openness_depth, at, 0).xy;
        float apart = abs(other.y - here.y) / (0.1 * u_radius);
        float weight = exp(-float(i * i) / 8.0) * max(1.0 - apart, 0.0) * pow(max(dot(normal, texelFetch(u_normal_depth, at, 0).xyz), 0.0), 4.0);
        sum += weight * vec2(other.x, 1.0);
    }
    o_openness_depth = vec4(here.y == 0.0 ? 1.0 : sum.x / sum.y, here.y, 0.0, 0.0);
}`;

// Ribbons that face the viewer, two vertices a point. Points hold half a width, below zero at the end of a strand.
export const hairVertex = `#version 300 es
precision highp float;
in vec4 a_before, a_here, a_after;
in vec4 a_color;  // squares are linear; a random lean
uniform mat4 u_projection;
uniform float u_wide, u_thinnest, u_unit;
uniform vec4 u_lobes;  // strengths and exponents of the white and the coloured reflection
out vec3 v_color;
out float v_cover, v_seed;  // part of its width that a strand has
${light}
const float kDiffuse = 0.62, kScattered = 0.06;
const vec3 kAround = 0.62 * kSkyLight + 0.38 * kGroundLight;
float cosine_of(float sine) { return sqrt(max(1.0 - sine * sine, 0.0)); }
// Square of the cosine of half the angle around the strand between light and viewer.
float facing(vec3 tangent, vec3 to_light, vec3 to_viewer) {
    vec3 l = to_light - dot(tangent, to_light) * tangent, v = to_viewer - dot(tangent, to_viewer) * tangent;
    float lengths = sqrt(dot(l, l) * dot(v, v));
    return lengths > 1e-6 ? 0.5 + 0.5 * clamp(dot(l, v) / lengths, -1.0, 1.0) : 0.0;
}
float lobe(vec2 mirror, float shift, float exponent) {
    return pow(max(mirror.x * cos(shift) + mirror.y * sin(shift), 1e-6), exponent);
}
// A strand that light meets, and the loss of light in it.
struct Strand { vec3 color, tangent, to_viewer; float lean; vec3 loss; };
// By the rest of the light; through: the part that goes through strands, of a light behind them.
vec3 lit(Strand s, vec3 to_light, float left, float through) {
    float ls = dot(s.tangent, to_light), vs = dot(s.tangent, s.to_viewer), lc = cosine_of(ls), vc = cosine_of(vs);
    vec2 mirror = vec2(lc * vc - ls * vs, ls * vc + lc * vs);
    float front = facing(s.tangent, to_light, s.to_viewer);
    float primary = u_lobes.x * sqrt(front) * lobe(mirror, 0.10 + s.lean, u_lobes.z);
    float secondary = u_lobes.y * lobe(mirror, -0.15 + s.lean, u_lobes.w);
    vec3 arriving = through_hair(s.loss, left);
    through *= exp(-7.3 * front) * lobe(mirror, -0.05 + s.lean, 20.0);
    return arriving * (s.color * (kDiffuse * lc + secondary) + through * exp(-3.0 * s.loss)) + left * primary;
}
void main() {
    bool first = a_before.w < 0.0, last = a_here.w < 0.0;
    vec3 along = (last ? a_here.xyz : a_after.xyz) - (first ? a_here.xyz : a_before.xyz);
    vec3 world = a_here.xyz;
    vec3 position = (u_view * vec4(world, 1.0)).xyz;
    vec3 tangent = normalize(mat3(u_view) * along + vec3(0.0, 1e-9, 0.0));
    vec3 to_viewer = normalize(-position);
    vec3 color = a_color.rgb * a_color.rgb;
    vec3 arriving = strand_light(world);
    float lean = 0.05 * (2.0 * a_color.a - 1.0);
    Strand strand = Strand(color, tangent, to_viewer, lean, loss_of(color));
    vec3 around = kScattered + (1.0 - kScattered) * through_hair(strand.loss, arriving.z);
    v_color = around * kAround * color + kKeyLight * lit(strand, kKeyDirection, arriving.x, 0.0)
            + kFillLight * lit(strand, kFillDirection, arriving.z, 0.0)
            + kRimLight * lit(strand, kRimDirection, arriving.y, 1.0);
    v_color = shown(v_color);
    vec3 across = cross(tangent, to_viewer);
    across = length(across) > 1e-3 ? normalize(across) : normalize(vec3(to_viewer.z, 0.0, -to_viewer.x));
    float half_width = abs(a_here.w) * u_wide, reach = max(half_width, -position.z * u_thinnest);
    v_cover = half_width / max(reach, 1e-12);
    v_seed = fract(91.7 * a_color.a + 0.37 * float(gl_VertexID >> 1 & 1));
    position += ((gl_VertexID & 1) == 0 ? reach : -reach) * across;
    // Ends reach out by the area of round ones: seen end-on, a strand is a disc.
    float end = last ? 1.0 : first ? -1.0 : 0.0;
    position += end * 0.7854 * reach * cross(to_viewer, across);
    gl_Position = u_projection * vec4(position, 1.0);
}`;

// Strands that are thinner than they are drawn cover so many of their fragments.
export const hairFragment = `#version 300 es
precision highp float;
in vec3 v_color;
in float v_cover, v_seed;
out vec4 o_color;
void main() {
    float random = fract(52.98 * fract(dot(vec3(gl_FragCoord.xy, 97.0 * v_seed), vec3(0.0671, 0.00584, 0.137))));
    if (v_cover < random) discard;
    o_color = vec4(v_color, 1.0);
}`;

export const lineFragment = `#version 300 es
precision highp float;
in vec3 v_color;
out vec4 o_color;
void main() { o_color = vec4(v_color, 1.0); }`;

// Lines of a width in pixels, an instance a segment; they are drawn a little nearer than the surface below them.
export const lineVertex = `#version 300 es
precision highp float;
in vec3 a_from, a_to;
in vec4 a_color;
uniform mat4 u_view, u_projection;
uniform vec2 u_pixel;  // of clip space
uniform float u_width;
out vec3 v_color;
void main() {
    vec4 a = u_projection * u_view * vec4(a_from, 1.0), b = u_projection * u_view * vec4(a_to, 1.0);
    vec2 along = (b.xy / b.w - a.xy / a.w) / u_pixel;
    vec2 across = normalize(vec2(-along.y, along.x) + vec2(1e-9));
    vec4 at = gl_VertexID > 1 ? b : a;
    at.xy += ((gl_VertexID & 1) == 0 ? 0.5 : -0.5) * u_width * across * u_pixel * at.w;
    at.z -= 0.0015 * at.w;
    v_color = a_color.rgb;
    gl_Position = at;
}`;

// Balls of a radius in pixels, an instance a ball, a radius nearer than their place.
export const ballVertex = `#version 300 es
precision highp float;
in vec3 a_place;
in vec4 a_color;
uniform mat4 u_view, u_projection, u_place;
uniform vec2 u_pixel;  // of clip space
uniform float u_radius, u_depth;  // pixels; the height of one at depth 1
out vec3 v_color;
out vec2 v_from;
void main() {
    vec3 position = (u_view * u_place * vec4(a_place, 1.0)).xyz;
    vec4 at = u_projection * vec4(position, 1.0), nearer = u_projection * vec4(position.xy, position.z * (1.0 - u_radius * u_depth), 1.0);
    v_from = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
    v_color = a_color.rgb;
    gl_Position = vec4((at.xy / at.w + v_from * u_radius * u_pixel) * nearer.w, nearer.zw);
}`;

export const ballFragment = `#version 300 es
precision highp float;
in vec3 v_color;
in vec2 v_from;
out vec4 o_color;
${toLinear}
${light}
void main() {
    float square = dot(v_from, v_from);
    if (square > 1.0) discard;
    vec3 normal = vec3(v_from, sqrt(1.0 - square));
    o_color = vec4(shown(to_linear(v_color) * (0.40 + 0.65 * max(dot(normal, kKeyDirection), 0.0))), 1.0);
}`;
