#include "viewer/render/gl/shaders.h"

namespace lissom::shaders {

const char* const kCommon = R"(#version 330 core
const vec3 kKeyDirection = normalize(vec3(-0.62, 0.62, 0.48));  // towards the main light, in view space

vec3 to_linear(vec3 srgb) {
    return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), step(0.04045, srgb));
}

vec3 to_srgb(vec3 linear) {
    vec3 high = 1.055 * pow(max(linear, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055;
    return mix(12.92 * linear, high, step(0.0031308, linear));
}
)";

const char* const kCoverVertex = R"(
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
}
)";

const char* const kGeometryVertex = R"(
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
uniform mat4 u_view;
uniform mat4 u_projection;
out vec3 v_position;
out vec3 v_normal;

void main() {
    vec4 position = u_view * vec4(a_position, 1.0);
    v_position = position.xyz;
    v_normal = mat3(u_view) * a_normal;
    gl_Position = u_projection * position;
}
)";

const char* const kGeometryFragment = R"(
in vec3 v_position;
in vec3 v_normal;
out vec4 o_normal_depth;

void main() {
    vec3 flat_normal = cross(dFdx(v_position), dFdy(v_position));
    vec3 normal = dot(v_normal, v_normal) > 0.0 ? v_normal : flat_normal;
    normal = normalize(gl_FrontFacing ? normal : -normal);
    o_normal_depth = vec4(normal, -v_position.z);
}
)";

// Scalable ambient obscurance (McGuire, Mara and Luebke 2012): samples on a spiral around the
// pixel, each counted by how far it rises over the tangent plane and how near it is.
const char* const kOcclusionFragment = R"(
const int kSamples = 20;
const float kTurns = 7.0;

uniform sampler2D u_normal_depth;
uniform vec2 u_extent;       // half the width and height of the view, at depth 1 with perspective
uniform float u_perspective; // 1 or 0
uniform float u_radius;      // in world units
uniform float u_strength;
out vec2 o_openness_depth;

vec3 position_at(ivec2 pixel, float depth) {
    vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(textureSize(u_normal_depth, 0)) - 1.0;
    return vec3(ndc * u_extent * mix(1.0, depth, u_perspective), -depth);
}

// A start angle for each pixel of a block of 4 x 4, far from its neighbours'.
float start_angle(ivec2 pixel) {
    int order = (pixel.x & 3) ^ (pixel.y & 3);
    order = ((order & 1) << 3) | ((order & 2)) | ((pixel.y & 1) << 2) | ((pixel.y & 2) >> 1);
    return 6.2831853 * float(order) / 16.0;
}

float obscurance(vec3 position, vec3 normal, ivec2 pixel, float radius) {
    vec2 size = vec2(textureSize(u_normal_depth, 0));
    float depth = -position.z;
    float pixels = radius * 0.5 * size.y / (u_extent.y * mix(1.0, depth, u_perspective));
    float bias = 0.02 * radius;
    float angle = start_angle(pixel);
    float sum = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        float share = (float(i) + 0.5) / float(kSamples);
        float turn = angle + share * kTurns * 6.2831853;
        ivec2 at = pixel + ivec2(round(share * max(pixels, 3.0) * vec2(cos(turn), sin(turn))));
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(size)))) continue;
        float other = texelFetch(u_normal_depth, at, 0).w;
        if (other == 0.0) continue;
        vec3 to_other = position_at(at, other) - position;
        float square = dot(to_other, to_other);
        float rise = dot(to_other, normal) - bias;
        float falloff = max(1.0 - square / (radius * radius), 0.0);
        sum += falloff * falloff * falloff * max(rise, 0.0) / (square / radius + 0.01 * radius);
    }
    return sum / float(kSamples);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 here = texelFetch(u_normal_depth, pixel, 0);
    if (here.w == 0.0) {
        o_openness_depth = vec2(1.0, 0.0);
        return;
    }
    vec3 position = position_at(pixel, here.w);
    float narrow = obscurance(position, here.xyz, pixel, 0.25 * u_radius);
    float wide = obscurance(position, here.xyz, pixel, u_radius);
    float open = max(1.0 - 2.0 * narrow, 0.0) * max(1.0 - 2.6 * wide, 0.0);
    o_openness_depth = vec2(mix(1.0, open, u_strength), here.w);
}
)";

const char* const kOcclusionBlurFragment = R"(
const int kRadius = 3;

uniform sampler2D u_openness_depth;
uniform sampler2D u_normal_depth;
uniform int u_along_y;
uniform float u_radius;
out vec2 o_openness_depth;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 step = u_along_y == 1 ? ivec2(0, 1) : ivec2(1, 0);
    ivec2 last = textureSize(u_openness_depth, 0) - 1;
    vec2 here = texelFetch(u_openness_depth, pixel, 0).xy;
    vec3 normal = texelFetch(u_normal_depth, pixel, 0).xyz;
    vec2 sum = vec2(here.x, 1.0);
    for (int i = -kRadius; i <= kRadius; ++i) {
        if (i == 0) continue;
        ivec2 at = clamp(pixel + i * step, ivec2(0), last);
        vec2 other = texelFetch(u_openness_depth, at, 0).xy;
        vec3 other_normal = texelFetch(u_normal_depth, at, 0).xyz;
        float apart = abs(other.y - here.y) / (0.1 * u_radius);
        float weight = exp(-float(i * i) / 8.0) * max(1.0 - apart, 0.0) *
                       pow(max(dot(normal, other_normal), 0.0), 4.0);
        sum += weight * vec2(other.x, 1.0);
    }
    o_openness_depth = vec2(here.y == 0.0 ? 1.0 : sum.x / sum.y, here.y);
}
)";

const char* const kSurfaceVertex = R"(
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec4 a_color;
layout(location = 3) in float a_value;
layout(location = 4) in uint a_flags;
uniform mat4 u_view;
uniform mat4 u_projection;
out vec3 v_position;
out vec3 v_normal;
out vec3 v_color;
out float v_value;
out vec3 v_height;
flat out uint v_flags;

void main() {
    vec4 position = u_view * vec4(a_position, 1.0);
    v_position = position.xyz;
    v_normal = mat3(u_view) * a_normal;
    v_color = to_linear(a_color.rgb);
    v_value = a_value;
    v_flags = a_flags;
    int corner = gl_VertexID % 3;
    v_height = vec3(corner == 0, corner == 1, corner == 2);
    gl_Position = u_projection * position;
}
)";

// Software drivers run both sides of a condition for every pixel: features absent from a picture
// are left out of its program.
const char* const kHasOcclusion = "#define HAS_OCCLUSION\n";
const char* const kHasHair = "#define HAS_HAIR\n";
const char* const kHasWire = "#define HAS_WIRE\n";
const char* const kHasValues = "#define HAS_VALUES\n";

const char* const kSurfaceFragment = R"(
in vec3 v_position;
in vec3 v_normal;
in vec3 v_color;
in float v_value;
in vec3 v_height;  // over each side of the triangle, as a share of the triangle's own
flat in uint v_flags;

uniform float u_perspective;
uniform sampler2D u_colormap;          // linear
uniform sampler2D u_openness_depth;
uniform vec2 u_openness_scale;         // from pixels of the target to texels
uniform vec2 u_openness_offset;
uniform float u_wire_width;            // pixels of the target; 0 is none
uniform vec3 u_wire_color;
uniform sampler3D u_hair;              // light that strands leave: key, around; hair that grows
uniform sampler3D u_hair_moments;
uniform int u_hair_kind;               // 0: that; of HairLight 1: its moments, 2: with directed light
uniform mat4 u_hair_turn;              // from view space to its axes
uniform vec3 u_hair_scale;             // from there to its coordinates
uniform vec3 u_hair_offset;
uniform float u_hair_step;             // view units between its texels
uniform vec3 u_hair_key;               // along its axes: towards the main light, and up
uniform vec3 u_hair_up;
uniform float u_hair_slope;            // of light from all around
uniform vec3 u_scalp_color;
uniform vec3 u_hair_loss;              // of light, by that in the usual brown
uniform float u_opacity;               // with several samples: the share of them that is covered
uniform int u_dithered;                // with one sample, of the pixels
out vec4 o_color;

const vec3 kFillDirection = normalize(vec3(0.80, 0.05, 0.55));
const vec3 kRimDirection = normalize(vec3(0.45, 0.45, -0.55));
const vec3 kKeyLight = vec3(1.10, 1.08, 1.04);
const vec3 kFillLight = vec3(0.13, 0.14, 0.16);
const vec3 kRimLight = vec3(0.22, 0.235, 0.25);
const vec3 kSkyLight = vec3(0.32, 0.33, 0.35);
const vec3 kGroundLight = vec3(0.105, 0.095, 0.09);
const vec3 kBackTint = vec3(0.50, 0.36, 0.30);

// Openness around this fragment, from the four nearest texels at its depth.
float openness(float depth) {
#ifndef HAS_OCCLUSION
    return 1.0;
#endif
    vec2 at = gl_FragCoord.xy * u_openness_scale + u_openness_offset - 0.5;
    ivec2 corner = ivec2(floor(at));
    ivec2 last = textureSize(u_openness_depth, 0) - 1;
    vec2 share = at - vec2(corner);
    float tolerance = 2.0 * fwidth(depth) + 0.002 * abs(depth);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec2 texel = texelFetch(u_openness_depth, clamp(corner + offset, ivec2(0), last), 0).xy;
        vec2 near = mix(1.0 - share, share, vec2(offset));
        float weight = (near.x * near.y + 1e-3) * exp(-abs(texel.y - depth) / tolerance) + 1e-9;
        sum += weight * vec2(texel.x, 1.0);
    }
    return sum.x / sum.y;
}

// Cosine law that reaches a little beyond the terminator, as light from a large source does.
float soft_cosine(vec3 normal, vec3 direction, float wrap) {
    float cosine = (dot(normal, direction) + wrap) / (1.0 + wrap);
    return cosine > 0.0 ? cosine * cosine * (1.5 - 0.5 * cosine) * 0.35 + 0.65 * cosine : 0.0;
}

float highlight(vec3 normal, vec3 to_viewer, vec3 direction, float exponent) {
    vec3 half_way = normalize(direction + to_viewer);
    float cosine = max(dot(normal, half_way), 0.0);
    return max(dot(normal, direction), 0.0) * (exponent + 8.0) / 25.0 * pow(cosine, exponent);
}

vec3 in_hair(vec3 position) {
    return (mat3(u_hair_turn) * position) * u_hair_scale + u_hair_offset;
}

// Key light and light from all around that strands leave.
vec2 hair_light(vec3 at) {
    if (u_hair_kind == 0) return texture(u_hair, at).rg;
    vec4 moments = texture(u_hair_moments, at);
    vec3 slope = 2.0 * moments.gba - 1.0;
    float key = u_hair_kind == 2 ? texture(u_hair, at).b
                                 : clamp(moments.r + dot(slope, u_hair_key), 0.0, 1.0);
    return vec2(key, moments.r + u_hair_slope * dot(slope, u_hair_up));
}

// The same, and how much hair grows. Far outside the volume there is no hair.
vec3 hair_at(vec3 position, vec3 normal) {
#ifndef HAS_HAIR
    return vec3(1.0, 1.0, 0.0);
#endif
    vec3 above = in_hair(position + 0.75 * u_hair_step * normal);
    vec3 outside = max(max(-above, above - 1.0), vec3(0.0)) / (u_hair_scale * u_hair_step);
    float fade = clamp(1.0 - length(outside) / 12.0, 0.0, 1.0);
    vec4 here = texture(u_hair, in_hair(position));
    float grows = u_hair_kind == 0 ? here.b : here.a;
    return mix(vec3(1.0, 1.0, 0.0), vec3(hair_light(above), grows), fade);
}

// Light that strands leave goes through them by their colour; see strand_shading.h.
vec3 through_hair(float light) {
#ifndef HAS_HAIR
    return vec3(1.0);
#endif
    return pow(vec3(max(light, 1e-6)), u_hair_loss);
}

// `plain`: how far the light is evened out, so that colours that stand for numbers can be read.
vec3 lit(vec3 color, vec3 normal, vec3 to_viewer, float open, float plain, vec3 hair) {
    float facing = max(dot(normal, to_viewer), 0.0);
    float grazing = pow(1.0 - facing, 3.0);
    vec3 key = kKeyLight * through_hair(hair.x), arriving = open * through_hair(hair.y);
    float key_open = mix(0.45, 1.0, open);
    vec3 around = mix(kGroundLight, kSkyLight, 0.5 + 0.5 * normal.y) * arriving;
    vec3 direct = key * soft_cosine(normal, kKeyDirection, 0.15) * key_open +
                  kFillLight * soft_cosine(normal, kFillDirection, 0.3) * arriving;
    vec3 rim = kRimLight * max(dot(normal, kRimDirection), 0.0) * arriving;
    vec3 shine = kKeyLight * hair.x * highlight(normal, to_viewer, kKeyDirection, 24.0) * 0.045 *
                 open * hair.y * (1.0 - hair.z);
    vec3 light = (around + direct + rim) * (1.0 - 0.30 * grazing);
    return color * mix(light, vec3(0.92), plain) + shine * (1.0 - plain);
}

// Fraction of the fragment that the polygon's edges cover. If a triangle is hardly wider than lines,
// all its edges fade, so that a fine mesh, or one that is seen from the side, becomes darker but not black.
float edge_cover() {
    vec3 slope = vec3(length(vec2(dFdx(v_height.x), dFdy(v_height.x))),
                      length(vec2(dFdx(v_height.y), dFdy(v_height.y))),
                      length(vec2(dFdx(v_height.z), dFdy(v_height.z))));
    float steepest = max(slope.x, max(slope.y, slope.z));
    float fade = clamp(1.0 / (steepest * 5.0 * u_wire_width), 0.25, 1.0);
    float cover = 0.0;
    for (int i = 0; i < 3; ++i) {
        if ((v_flags & (1u << i)) == 0u) continue;
        float distance = v_height[i] / slope[i];
        cover = max(cover, clamp(0.5 * u_wire_width + 0.5 - distance, 0.0, 1.0));
    }
    return fade * cover;
}

// The place of a pixel in a block of 4 x 4, 0 to 1, in an order that is even at each share.
float order_of(ivec2 pixel) {
    int order = 0;
    for (int bit = 0; bit < 2; ++bit) {
        int x = (pixel.x >> bit) & 1, y = (pixel.y >> bit) & 1;
        order = order * 4 + 2 * (x ^ y) + y;
    }
    return (float(order) + 0.5) / 16.0;
}

void main() {
    vec3 flat_normal = cross(dFdx(v_position), dFdy(v_position));
    vec3 normal = dot(v_normal, v_normal) > 0.0 ? v_normal : flat_normal;
    normal = normalize(gl_FrontFacing ? normal : -normal);
    vec3 to_viewer = u_perspective > 0.5 ? normalize(-v_position) : vec3(0.0, 0.0, 1.0);
    bool has_value = false;
    vec3 color = v_color;
#ifdef HAS_VALUES
    has_value = (v_flags & 8u) != 0u;
    if (has_value) color = texture(u_colormap, vec2(v_value, 0.5)).rgb;
#endif
    if (!gl_FrontFacing) color *= kBackTint;
    vec3 hair = hair_at(v_position, normal);
    color = mix(color, u_scalp_color, hair.z);
    color = lit(color, normal, to_viewer, openness(-v_position.z), has_value ? 0.5 : 0.0, hair);
#ifdef HAS_WIRE
    if (u_wire_width > 0.0) color = mix(color, u_wire_color, 0.8 * edge_cover());
#endif
    if (u_dithered == 1 && u_opacity <= order_of(ivec2(gl_FragCoord.xy))) discard;
    o_color = vec4(min(color, vec3(1.0)), u_dithered == 1 ? 1.0 : u_opacity);
}
)";

const char* const kLineVertex = R"(
layout(location = 0) in vec3 a_begin;
layout(location = 1) in vec3 a_end;
layout(location = 2) in vec4 a_color;
layout(location = 3) in float a_width;
uniform mat4 u_view;
uniform mat4 u_projection;
uniform vec2 u_size;         // of the target in pixels
uniform float u_pixel;       // half height of the view in world units over half that of the target
uniform float u_perspective;
uniform float u_near;
uniform float u_scale;       // pixels of the target in a pixel of the picture
flat out vec2 v_begin;
flat out vec2 v_end;
flat out float v_half_width;
flat out vec4 v_color;

// Clip position; the depth is that of a point a line's width nearer, so that lines on a surface show.
vec4 lifted(vec3 position, float width) {
    vec4 clip = u_projection * vec4(position, 1.0);
    float lift = width * u_pixel * mix(1.0, -position.z, u_perspective);
    vec3 nearer = position * mix(vec3(1.0), vec3(1.0 + lift / position.z), u_perspective) +
                  vec3(0.0, 0.0, lift * (1.0 - u_perspective));
    nearer.z = min(nearer.z, -u_near);
    vec4 near_clip = u_projection * vec4(nearer, 1.0);
    return vec4(clip.xy / clip.w, near_clip.z / near_clip.w, 1.0);
}

vec3 before_near_plane(vec3 position, vec3 other) {
    float beyond = position.z + u_near;
    return beyond > 0.0 && other.z < -u_near
               ? mix(position, other, beyond / (position.z - other.z)) : position;
}

void main() {
    vec3 begin = (u_view * vec4(a_begin, 1.0)).xyz;
    vec3 end = (u_view * vec4(a_end, 1.0)).xyz;
    float width = a_width * u_scale;
    vec4 begin_clip = lifted(before_near_plane(begin, end), width);
    vec4 end_clip = lifted(before_near_plane(end, begin), width);
    v_begin = (0.5 * begin_clip.xy + 0.5) * u_size;
    v_end = (0.5 * end_clip.xy + 0.5) * u_size;
    v_half_width = 0.5 * width;
    v_color = a_color;

    float reach = v_half_width + 1.0;
    vec2 along = v_end - v_begin;
    along = dot(along, along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    bool at_end = gl_VertexID >= 2;
    float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
    vec2 pixel = (at_end ? v_end + reach * along : v_begin - reach * along) + side * reach * across;
    gl_Position = vec4(2.0 * pixel / u_size - 1.0, at_end ? end_clip.z : begin_clip.z, 1.0);
    if (begin.z > -u_near && end.z > -u_near) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
)";

const char* const kLineFragment = R"(
flat in vec2 v_begin;
flat in vec2 v_end;
flat in float v_half_width;
flat in vec4 v_color;
out vec4 o_color;

void main() {
    vec2 along = v_end - v_begin;
    vec2 from = gl_FragCoord.xy - v_begin;
    float share = clamp(dot(from, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
    float distance = length(from - share * along);
    float cover = clamp(v_half_width + 0.5 - distance, 0.0, 1.0);
    if (cover == 0.0) discard;
    o_color = vec4(to_linear(v_color.rgb), 1.0) * cover;
}
)";

const char* const kPointVertex = R"(
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec4 a_color;
layout(location = 2) in float a_radius;
uniform mat4 u_view;
uniform mat4 u_projection;
uniform vec2 u_size;
uniform float u_pixel;
uniform float u_perspective;
uniform float u_near;
uniform float u_scale;
flat out vec2 v_center;
flat out float v_radius;
flat out vec4 v_color;

void main() {
    vec3 position = (u_view * vec4(a_position, 1.0)).xyz;
    float radius = a_radius * u_scale;
    float lift = radius * u_pixel * mix(1.0, -position.z, u_perspective);
    vec4 clip = u_projection * vec4(position, 1.0);
    vec3 nearer = vec3(position.xy, min(position.z + lift, -u_near));
    vec4 near_clip = u_projection * vec4(nearer, 1.0);
    v_center = (0.5 * clip.xy / clip.w + 0.5) * u_size;
    v_radius = radius;
    v_color = a_color;
    vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
    vec2 pixel = v_center + (radius + 1.0) * corner;
    gl_Position = vec4(2.0 * pixel / u_size - 1.0, near_clip.z / near_clip.w, 1.0);
    if (position.z > -u_near) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
)";

const char* const kPointFragment = R"(
flat in vec2 v_center;
flat in float v_radius;
flat in vec4 v_color;
out vec4 o_color;

void main() {
    vec2 from = (gl_FragCoord.xy - v_center) / v_radius;
    float distance = length(from);
    float cover = clamp((1.0 - distance) * v_radius + 0.5, 0.0, 1.0);
    if (cover == 0.0) discard;
    vec3 normal = vec3(from, sqrt(max(1.0 - distance * distance, 0.0)));
    float light = 0.40 + 0.65 * max(dot(normal, kKeyDirection), 0.0);
    o_color = vec4(min(to_linear(v_color.rgb) * light, vec3(1.0)), 1.0) * cover;
}
)";

const char* const kOutputFragment = R"(
uniform sampler2D u_picture;      // linear, multiplied by alpha
uniform int u_block;              // its pixels along a side of one here
uniform int u_height;
uniform vec3 u_background;        // linear
uniform float u_background_alpha;
out vec4 o_color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    pixel.y = u_height - 1 - pixel.y;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < u_block; ++y) {
        for (int x = 0; x < u_block; ++x) {
            sum += texelFetch(u_picture, pixel * u_block + ivec2(x, y), 0);
        }
    }
    sum /= float(u_block * u_block);
    sum += (1.0 - sum.a) * vec4(u_background * u_background_alpha, u_background_alpha);
    vec3 color = sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
    o_color = vec4(to_srgb(clamp(color, 0.0, 1.0)), sum.a);
}
)";

}  // namespace lissom::shaders
