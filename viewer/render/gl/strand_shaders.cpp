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
const float kDiffuse = 0.62, kScattered = 0.06, kColoring = 0.5;

float cosine_of(float sine) {
    return sqrt(max(1.0 - sine * sine, 0.0));
}

float facing(vec3 tangent, vec3 to_light, vec3 to_viewer) {
    vec3 light = to_light - dot(tangent, to_light) * tangent;
    vec3 viewer = to_viewer - dot(tangent, to_viewer) * tangent;
    float lengths = sqrt(dot(light, light) * dot(viewer, viewer));
    return lengths > 1e-6 ? sqrt(0.5 + 0.5 * clamp(dot(light, viewer) / lengths, -1.0, 1.0)) : 0.0;
}

vec3 lit(vec3 color, vec3 tangent, vec3 to_viewer, vec3 to_light, vec3 light, vec2 lean) {
    float light_sine = dot(tangent, to_light), viewer_sine = dot(tangent, to_viewer);
    float light_cosine = cosine_of(light_sine), viewer_cosine = cosine_of(viewer_sine);
    // Sum of both angles from the plane across the strand, turned by the strand's lean.
    vec2 mirror = vec2(light_cosine * viewer_cosine - light_sine * viewer_sine,
                       light_sine * viewer_cosine + light_cosine * viewer_sine);
    mirror = vec2(dot(mirror, lean), mirror.y * lean.x - mirror.x * lean.y);
    float primary = max(dot(mirror, u_primary_turn), 1e-6);
    float secondary = max(dot(mirror, u_secondary_turn), 1e-6);
    primary = u_lobes.x * facing(tangent, to_light, to_viewer) * pow(primary, u_lobes.z);
    secondary = u_lobes.y * pow(secondary, u_lobes.w);
    return light * (color * (kDiffuse * light_cosine + secondary) + primary);
}

// Light that passed through strands has their colour: the most absorbed parts are lost first.
vec3 passed(float light, vec3 color) {
    float mean = max((color.r + color.g + color.b) / 3.0, 1e-4);
    return pow(vec3(max(light, 1e-6)), max(1.0 + kColoring * (mean - color) / mean, 0.3));
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
    return vec3(textureLod(u_light, at + u_key_grid, 0.0).r,
                textureLod(u_light, at + u_rim_grid, 0.0).g, ambient);
}

vec3 shade(vec3 position, vec3 tangent, vec3 to_viewer, vec3 color, vec2 lean) {
    vec3 light = light_at(position);
    vec3 around = kScattered + (1.0 - kScattered) * passed(light.z, color);
    return around * kAround * color +
           passed(light.x, color) * lit(color, tangent, to_viewer, kKeyDirection, kKeyLight, lean) +
           light.z * lit(color, tangent, to_viewer, kFillDirection, kFillLight, lean) +
           passed(light.y, color) * lit(color, tangent, to_viewer, kRimDirection, kRimLight, lean);
}

vec3 point(int number) {
    return uintBitsToFloat(texelFetch(u_points, number).xyz);
}

void main() {
    int number = gl_VertexID >> 1;
    uvec4 entry = texelFetch(u_points, number);
    vec4 look = vec4(entry.w & 255u, entry.w >> 8 & 255u, entry.w >> 16 & 255u, entry.w >> 24) / 255.0;
    vec3 position = (u_to_view * vec4(uintBitsToFloat(entry.xyz), 1.0)).xyz;
    vec3 along = mat3(u_to_view) * (point(number + 1) - point(max(number - 1, 0)));
    float length_along = length(along);
    vec3 tangent = length_along > 0.0 ? along / length_along : vec3(0.0);
    vec3 to_viewer = u_perspective > 0.5 ? normalize(-position) : vec3(0.0, 0.0, 1.0);
    float shift = u_jitter * (2.0 * texelFetch(u_shifts, number).r - 1.0);
    vec3 color = u_brightest * look.rgb * look.rgb;
    v_color = length_along > 0.0
                  ? shade(position, tangent, to_viewer, color, vec2(cos(shift), sin(shift)))
                  : vec3(0.0);

    // A ribbon that faces the viewer.
    vec3 across = cross(tangent, to_viewer);
    float length_across = length(across);
    float thinnest = u_thinnest * mix(1.0, -position.z, u_perspective);
    float width = look.a > 0.0 ? max(u_width * look.a * look.a, thinnest) : 0.0;
    float reach = 0.5 * width / max(length_across, 1e-6);
    position += ((gl_VertexID & 1) == 0 ? reach : -reach) * across;
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
