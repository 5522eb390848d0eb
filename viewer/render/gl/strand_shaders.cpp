// The shaders of hair, of shaders.h.
#include "viewer/render/gl/shaders.h"

namespace lissom::shaders {

// The light and the terms of strand_shading.cpp, at the points of strands.
const char* const kStrandVertex = R"(
uniform usamplerBuffer u_points;   // PackedPoint
uniform samplerBuffer u_shifts;
uniform mat4 u_to_view;            // from the strands' metres
uniform mat4 u_projection;
uniform float u_perspective;
uniform float u_width;             // of the widest point, in view units
uniform float u_thinnest;          // nothing is thinner, in view units; at depth 1 with perspective
uniform float u_brightest;
uniform vec2 u_primary_turn;       // cosine and sine of the lobe's shift
uniform vec2 u_secondary_turn;
uniform vec4 u_lobes;              // strengths, exponents
uniform float u_jitter;
uniform int u_directed;            // light by direction, else by moments
uniform sampler3D u_light;
uniform sampler3D u_moments;
uniform mat4 u_to_grid;            // from view space to coordinates of both
uniform vec3 u_key_grid;           // in these: how much nearer to the light it is looked up
uniform vec3 u_rim_grid;
uniform vec3 u_key_world;          // along the axes of the grid
uniform vec3 u_rim_world;
uniform vec3 u_up_world;
uniform float u_slope;
centroid out vec3 v_color;

const vec3 kFillDirection = normalize(vec3(0.80, 0.05, 0.55));
const vec3 kRimDirection = normalize(vec3(0.45, 0.45, -0.55));
const vec3 kKeyLight = vec3(1.10, 1.08, 1.04);
const vec3 kFillLight = vec3(0.13, 0.14, 0.16);
const vec3 kRimLight = vec3(0.22, 0.235, 0.25);
const vec3 kAround = 0.62 * vec3(0.32, 0.33, 0.35) + 0.38 * vec3(0.105, 0.095, 0.09);
const float kDiffuse = 0.62, kScattered = 0.06;
const float kForward = 0.80, kAbsorbed = 0.0462, kUsualLoss = 0.378, kHairs = 3.0;
const float kThroughExponent = 20.0, kFading = 7.3;
const vec2 kThroughTurn = vec2(cos(-0.05), sin(-0.05));
const float kRoundEnd = 0.3927;    // pi / 8

float cosine_of(float sine) {
    return sqrt(max(1.0 - sine * sine, 0.0));
}

// Square of the cosine of half the angle around the strand between light and viewer.
float facing(vec3 tangent, vec3 to_light, vec3 to_viewer) {
    vec3 light = to_light - dot(tangent, to_light) * tangent;
    vec3 viewer = to_viewer - dot(tangent, to_viewer) * tangent;
    float lengths = sqrt(dot(light, light) * dot(viewer, viewer));
    return lengths > 1e-6 ? 0.5 + 0.5 * clamp(dot(light, viewer) / lengths, -1.0, 1.0) : 0.0;
}

// A strand at the point, and light on it.
struct Strand {
    vec3 color, tangent, to_viewer;
    vec2 lean;
    vec3 loss;                     // of light: -ln a_f
    vec4 lobes;                    // strengths, exponents
};

vec3 loss_of(vec3 color) {
    vec3 logs = log(clamp(color, 1e-3, 1.0));
    return kAbsorbed * logs * logs - log(kForward);
}

// Colours are interpolated between points: where a strand bends by much from point to point, a
// sharp reflection would be seen at some points and not between others, as blocks. As wide as the
// bend it is seen evenly, and as much of it. A cosine to the power n is a Gaussian of variance 1 / n.
vec4 lobes_of(vec3 before, vec3 after) {
    float lengths = sqrt(dot(before, before) * dot(after, after));
    float bend = lengths > 0.0 ? 2.0 - 2.0 * dot(before, after) / lengths : 0.0;
    vec2 wider = 1.0 + 0.25 * max(bend, 0.0) * u_lobes.zw;
    return vec4(u_lobes.xy * inversesqrt(wider), u_lobes.zw / wider);
}

// Sum of both angles from the plane across the strand, turned by the strand's lean.
vec2 mirror_of(Strand strand, vec3 to_light) {
    float light_sine = dot(strand.tangent, to_light);
    float viewer_sine = dot(strand.tangent, strand.to_viewer);
    float light_cosine = cosine_of(light_sine), viewer_cosine = cosine_of(viewer_sine);
    vec2 mirror = vec2(light_cosine * viewer_cosine - light_sine * viewer_sine,
                       light_sine * viewer_cosine + light_cosine * viewer_sine);
    return vec2(dot(mirror, strand.lean), mirror.y * strand.lean.x - mirror.x * strand.lean.y);
}

float lobe(vec2 mirror, vec2 turn, float exponent) {
    return pow(max(dot(mirror, turn), 1e-6), exponent);
}

// By `left` of the light, and `arriving`, all that arrives with what is scattered.
vec3 lit(Strand strand, vec3 to_light, float left, vec3 arriving, float front, vec2 mirror) {
    float primary = strand.lobes.x * sqrt(front) * lobe(mirror, u_primary_turn, strand.lobes.z);
    float secondary = strand.lobes.y * lobe(mirror, u_secondary_turn, strand.lobes.w);
    float cosine = cosine_of(dot(strand.tangent, to_light));
    return arriving * strand.color * (kDiffuse * cosine + secondary) + left * primary;
}

vec3 lit(Strand strand, vec3 to_light, float left, vec3 arriving) {
    float front = facing(strand.tangent, to_light, strand.to_viewer);
    return lit(strand, to_light, left, arriving, front, mirror_of(strand, to_light));
}

// The same of a light behind the hair, which goes through strands too.
vec3 lit_through(Strand strand, vec3 to_light, float left, vec3 arriving) {
    float front = facing(strand.tangent, to_light, strand.to_viewer);
    vec2 mirror = mirror_of(strand, to_light);
    vec3 through = arriving * exp(-kFading * front - kHairs * strand.loss);
    return lit(strand, to_light, left, arriving, front, mirror) +
           through * lobe(mirror, kThroughTurn, kThroughExponent);
}

float by_moments(vec3 at, vec3 direction) {
    vec4 moments = textureLod(u_moments, at, 0.0);
    return clamp(moments.r + dot(2.0 * moments.gba - 1.0, direction), 0.0, 1.0);
}

// Key, rim and ambient light.
vec3 light_at(vec3 position) {
    vec3 at = (u_to_grid * vec4(position, 1.0)).xyz;
    vec4 moments = textureLod(u_moments, at, 0.0);
    float ambient = moments.r + u_slope * dot(2.0 * moments.gba - 1.0, u_up_world);
    if (u_directed == 0) {
        return vec3(by_moments(at + u_key_grid, u_key_world),
                    by_moments(at + u_rim_grid, u_rim_world), ambient);
    }
    vec2 roots = vec2(textureLod(u_light, at + u_key_grid, 0.0).r,
                      textureLod(u_light, at + u_rim_grid, 0.0).g);
    return vec3(roots * roots, ambient);
}

vec3 through_hair(Strand strand, float log_light) {
    return exp(log_light / kUsualLoss * strand.loss);
}

vec3 shade(vec3 position, Strand strand) {
    vec3 light = light_at(position), logs = log(max(light, 1e-6));
    vec3 arriving = through_hair(strand, logs.z);
    return (kScattered + (1.0 - kScattered) * arriving) * kAround * strand.color +
           kKeyLight * lit(strand, kKeyDirection, light.x, through_hair(strand, logs.x)) +
           kFillLight * lit(strand, kFillDirection, light.z, arriving) +
           kRimLight * lit_through(strand, kRimDirection, light.y, through_hair(strand, logs.y));
}

// 1 at a point of no width, which lies beyond an end of a strand.
float is_beyond(uvec4 entry) {
    return (entry.w >> 24) == 0u ? 1.0 : 0.0;
}

void main() {
    int number = gl_VertexID >> 1;
    uvec4 entry = texelFetch(u_points, number);
    uvec4 before = texelFetch(u_points, max(number - 1, 0)), after = texelFetch(u_points, number + 1);
    vec4 look = vec4(entry.w & 255u, entry.w >> 8 & 255u, entry.w >> 16 & 255u, entry.w >> 24) / 255.0;
    vec3 here = uintBitsToFloat(entry.xyz), position = (u_to_view * vec4(here, 1.0)).xyz;
    vec3 to_here = here - uintBitsToFloat(before.xyz), from_here = uintBitsToFloat(after.xyz) - here;
    vec3 along = mat3(u_to_view) * (to_here + from_here);
    float length_along = length(along);
    vec3 tangent = length_along > 0.0 ? along / length_along : vec3(0.0);
    vec3 to_viewer = u_perspective > 0.5 ? normalize(-position) : vec3(0.0, 0.0, 1.0);
    float shift = u_jitter * (2.0 * texelFetch(u_shifts, number).r - 1.0);
    vec3 color = u_brightest * look.rgb * look.rgb;
    Strand strand = Strand(color, tangent, to_viewer, vec2(cos(shift), sin(shift)), loss_of(color),
                           lobes_of(to_here, from_here));
    v_color = length_along > 0.0 ? shade(position, strand) : vec3(0.0);

    // A ribbon that faces the viewer; one that points there is as wide as others.
    vec3 across = cross(tangent, to_viewer);
    float length_across = length(across);
    across = length_across > 1e-3 ? across / length_across
                                  : normalize(vec3(to_viewer.z, 0.0, -to_viewer.x));
    float thinnest = u_thinnest * mix(1.0, -position.z, u_perspective);
    float width = look.a > 0.0 ? max(u_width * look.a * look.a, thinnest) : 0.0;
    position += ((gl_VertexID & 1) == 0 ? 0.5 : -0.5) * width * across;
    // The ends of a ribbon reach out by the area of round ones: seen end-on, a strand is a disc.
    float end = is_beyond(after) - is_beyond(before);
    position += end * kRoundEnd * width * cross(to_viewer, across);
    gl_Position = u_projection * vec4(position, 1.0);
}
)";

// A little more than 1 in alpha marks strands in the output. Ribbons are much thinner than
// pixels: beside them, in the middle of a pixel that they hardly touch, a colour would be anything.
const char* const kStrandFragment = R"(
centroid in vec3 v_color;
out vec4 o_color;

void main() {
    o_color = vec4(clamp(v_color, 0.0, 4.0), 1.0 + 1.0 / 64.0);
}
)";

// Strands are much thinner than pixels. Seen through a filter a little wider than a pixel, as of a
// lens, they are less grainy; surfaces away from them stay sharp.
const char* const kStrandOutputFragment = R"(
uniform sampler2D u_picture;      // linear, multiplied by alpha
uniform int u_height;
uniform vec3 u_background;        // linear
uniform float u_background_alpha;
uniform float u_samples;          // averaged in each pixel
out vec4 o_color;

vec4 on_background(vec4 light) {
    light.a = min(light.a, 1.0);
    return light + (1.0 - light.a) * vec4(u_background * u_background_alpha, u_background_alpha);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    pixel.y = u_height - 1 - pixel.y;
    ivec2 last = textureSize(u_picture, 0) - 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    bool strands = false;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = pixel + ivec2(x, y);
            if (any(lessThan(at, ivec2(0))) || any(greaterThan(at, last))) continue;
            vec4 light = texelFetch(u_picture, at, 0);
            // Samples of other things have an alpha of 0 or 1.
            strands = strands || fract(light.a * u_samples + 0.002) > 0.01;
            float weight = (x == 0 ? 5.0 : 1.0) * (y == 0 ? 5.0 : 1.0);
            sum += weight * on_background(light);
            weights += weight;
        }
    }
    vec4 light = strands ? sum / weights : on_background(texelFetch(u_picture, pixel, 0));
    vec3 color = light.a > 0.0 ? light.rgb / light.a : vec3(0.0);
    o_color = vec4(to_srgb(clamp(color, 0.0, 1.0)), light.a);
}
)";

}  // namespace lissom::shaders
