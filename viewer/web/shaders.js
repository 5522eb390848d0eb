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
// Loss of light at a strand, and light that goes through hair by its colour: dual scattering, as in strand_shading.h.
vec3 loss_of(vec3 color) {
    vec3 logs = log(clamp(color, 1e-3, 1.0));
    return 0.0462 * logs * logs - log(0.80);
}
vec3 through_hair(vec3 loss, float left) { return exp(loss * log(max(left, 1e-6)) / 0.378); }
vec3 shown(vec3 linear) { return pow(min(linear, vec3(1.0)), vec3(1.0 / 2.2)); }
`;

export const meshVertex = `#version 300 es
precision highp float;
in vec3 a_position;
in vec3 a_normal;
in vec4 a_color;
in float a_flags;
uniform mat4 u_view, u_projection, u_place;
out vec3 v_position, v_world, v_normal, v_color, v_corner;
flat out int v_flags;
void main() {
    int corner = gl_VertexID % 3;
    v_corner = vec3(corner == 0, corner == 1, corner == 2);
    vec4 world = u_place * vec4(a_position, 1.0);
    v_world = world.xyz;
    v_position = (u_view * world).xyz;
    v_normal = mat3(u_view) * (mat3(u_place) * a_normal);
    v_color = pow(a_color.rgb, vec3(2.2));
    v_flags = int(a_flags + 0.5);
    gl_Position = u_projection * vec4(v_position, 1.0);
}`;

export const meshFragment = `#version 300 es
precision highp float;
in vec3 v_position, v_world, v_normal, v_color, v_corner;
flat in int v_flags;
uniform float u_wire;  // pixels
uniform bool u_flat;
out vec4 o_color;
${light}
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
    vec3 color = gl_FrontFacing ? v_color : v_color * vec3(0.50, 0.36, 0.30);
    vec3 hair = hair_light(v_world + mat3(transpose(u_view)) * normal * u_hair_grid.w);
    float grazing = pow(1.0 - max(dot(normal, to_viewer), 0.0), 3.0);
    vec3 loss = loss_of(u_hair_color);
    loss = mix(vec3(dot(loss, vec3(1.0 / 3.0))), loss, 0.35);
    vec3 arriving = through_hair(loss, hair.z);
    vec3 sum = mix(kGroundLight, kSkyLight, 0.5 + 0.5 * normal.y) * arriving
             + kKeyLight * through_hair(loss, hair.x) * soft_cosine(normal, kKeyDirection, 0.15)
             + kFillLight * soft_cosine(normal, kFillDirection, 0.3) * arriving
             + kRimLight * max(dot(normal, kRimDirection), 0.0) * arriving;
    vec3 half_way = normalize(kKeyDirection + to_viewer);
    float shine = max(dot(normal, kKeyDirection), 0.0) * 1.28 * pow(max(dot(normal, half_way), 0.0), 24.0);
    vec3 lit = color * sum * (1.0 - 0.30 * grazing) + kKeyLight * hair.x * shine * 0.045;
    if (u_wire > 0.0) lit = mix(lit, vec3(0.013, 0.016, 0.023), 0.8 * edge_cover());
    o_color = vec4(shown(lit), 1.0);
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
    vec3 arriving = hair_light(world);
    float lean = 0.05 * (2.0 * a_color.a - 1.0);
    Strand strand = Strand(color, tangent, to_viewer, lean, loss_of(color));
    vec3 around = kScattered + (1.0 - kScattered) * through_hair(strand.loss, arriving.z);
    v_color = around * kAround * color + kKeyLight * lit(strand, kKeyDirection, arriving.x, 0.0)
            + kFillLight * lit(strand, kFillDirection, arriving.z, 0.0)
            + kRimLight * lit(strand, kRimDirection, arriving.y, 1.0);
    v_color = shown(v_color);
    vec3 across = cross(tangent, to_viewer);
    across = length(across) > 1e-3 ? normalize(across) : normalize(vec3(to_viewer.z, 0.0, -to_viewer.x));
    float reach = max(abs(a_here.w) * u_wide, -position.z * u_thinnest);
    position += ((gl_VertexID & 1) == 0 ? reach : -reach) * across;
    // Ends reach out by the area of round ones: seen end-on, a strand is a disc.
    float end = last ? 1.0 : first ? -1.0 : 0.0;
    position += end * 0.7854 * reach * cross(to_viewer, across);
    gl_Position = u_projection * vec4(position, 1.0);
}`;

export const hairFragment = `#version 300 es
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
