#include "fit_client/render/shaders.h"

// Lights stand still beside the camera, as in a studio: a soft key from above left, a fill from the right, a rim from
// behind, and the sky, which is cut off where `sky` (SkyVisibility) says so. All in the eye's frame.
#define FITROOM_LIGHTS                                              \
  "const vec3 kKey = vec3(-0.430, 0.602, 0.673);\n"                 \
  "const vec3 kFill = vec3(0.730, 0.183, 0.658);\n"                 \
  "const vec3 kRim = vec3(0.33, 0.42, -0.845);\n"                   \
  "float Wrapped(vec3 n, vec3 light, float wrap) {\n"               \
  "  return max(0.0, (dot(n, light) + wrap) / (1.0 + wrap));\n"     \
  "}\n"                                                             \
  "float Sky(vec3 n) { return 0.5 + 0.5 * n.y; }\n"                 \
  "float Soften(float light) {\n"                                   \
  "  float over = max(0.0, light - 0.80);\n"                        \
  "  return min(light, 0.80) + 0.22 * (1.0 - exp(-over / 0.22));\n" \
  "}\n"

namespace fitroom::render::shaders {

const char kBackdropVertex[] = R"(#version 330 core
out vec2 place;
void main() {
  place = vec2(float((gl_VertexID & 1) * 4 - 1), float((gl_VertexID & 2) * 2 - 1));
  gl_Position = vec4(place, 0.9999, 1.0);
}
)";

const char kBackdropFragment[] = R"(#version 330 core
in vec2 place;
out vec4 colour;
void main() {
  vec3 centre = vec3(0.925, 0.925, 0.930);
  vec3 edge = vec3(0.800, 0.805, 0.815);
  float distance_to_centre = length(place * vec2(0.75, 0.62) - vec2(0.0, 0.05));
  colour = vec4(mix(centre, edge, smoothstep(0.1, 1.15, distance_to_centre)), 1.0);
}
)";

const char kGroundVertex[] = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texture_place;
uniform mat4 clip_from_world;
out vec2 place;
void main() {
  place = texture_place;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

const char kGroundFragment[] = R"(#version 330 core
in vec2 place;
uniform sampler2D darkness;
out vec4 colour;
void main() { colour = vec4(0.16, 0.155, 0.16, texture(darkness, place).r); }
)";

const char kBodyVertex[] = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float sky_part;
uniform mat4 clip_from_eye;
uniform mat4 eye_from_world;
uniform float depth_bias;
out vec3 eye_normal;
out float sky;
void main() {
  eye_normal = mat3(eye_from_world) * normal;
  sky = sky_part;
  vec3 eye_position = (eye_from_world * vec4(position, 1.0)).xyz;
  // Further away along the line of sight: the same pixel, a little deeper.
  gl_Position = clip_from_eye * vec4(eye_position * (1.0 + depth_bias / length(eye_position)), 1.0);
}
)";

const char kBodyFragment[] = "#version 330 core\n" FITROOM_LIGHTS R"(
in vec3 eye_normal;
in float sky;
out vec4 colour;
void main() {
  vec3 n = normalize(eye_normal);
  // Inside or outside is asked of the smooth normal: simplification and scans leave single triangles turned over.
  bool inside = n.z < -0.25;
  if (inside) n = -n;
  vec3 albedo = vec3(0.800, 0.705, 0.640);
  albedo *= albedo;
  float shade = mix(0.25, 1.0, sky);
  float light = 0.46 * Sky(n) * sky + 0.62 * Wrapped(n, kKey, 0.15) * shade + 0.16 * Wrapped(n, kFill, 0.3) * shade;
  float rim = 0.30 * max(0.0, dot(n, kRim)) * shade;
  // Light that came through the skin's hollows is warm.
  vec3 warm = mix(vec3(1.06, 0.97, 0.92), vec3(1.0), clamp(light, 0.0, 1.0));
  vec3 lit = albedo * (light * warm + 0.06) + rim * vec3(0.5, 0.5, 0.52);
  if (inside) lit *= 0.35;
  colour = vec4(sqrt(lit), 1.0);
}
)";

const char kClothVertex[] = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 sky_parts;
layout(location = 3) in vec2 texture_place;
uniform mat4 clip_from_world;
uniform mat4 eye_from_world;
out vec3 eye_normal;
out vec2 skies;
out vec2 place;
void main() {
  eye_normal = mat3(eye_from_world) * normal;
  skies = sky_parts;
  place = texture_place;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

// A surface that faces the camera in the open is lit by nearly 1, and nothing by much more (Soften): the photograph
// keeps its colours. It already holds the
// light of the shop's own studio, so ours only bends it: folds, shoulders and sides.
const char kClothFragment[] = "#version 330 core\n" FITROOM_LIGHTS R"(
in vec3 eye_normal;
in vec2 skies;
in vec2 place;
uniform sampler2D photograph;
uniform vec3 inside_colour;
uniform vec3 plain_colour;
uniform float textured;
uniform float opacity;
out vec4 colour;
void main() {
  vec3 n = normalize(eye_normal);
  vec3 outside = mix(plain_colour, texture(photograph, place).rgb, textured);
  vec3 albedo = gl_FrontFacing ? outside : inside_colour;
  if (!gl_FrontFacing) n = -n;
  albedo *= albedo;
  vec3 lit;
  if (gl_FrontFacing) {
    float shade = mix(0.30, 1.0, skies.x);
    float light = 0.42 * Sky(n) * mix(0.35, 1.0, skies.x) + 0.60 * Wrapped(n, kKey, 0.25) * shade +
                  0.24 * Wrapped(n, kFill, 0.35) * shade + 0.05;
    float rim = 0.10 * max(0.0, dot(n, kRim)) * shade;
    // Dark cloth swallows diffuse light, and with it every fold: what shows them there is the light that glances off
    // its fibres. The lighter the cloth, the less of it.
    float lightness = dot(albedo, vec3(0.299, 0.587, 0.114));
    float darkness = 1.0 - min(1.0, 3.0 * lightness);
    vec3 fibre = min(vec3(2.0), (albedo + 0.004) / (lightness + 0.004));  // The cloth's own tint.
    float facing = clamp(n.z, 0.0, 1.0);
    float sheen = 0.034 * pow(max(0.0, dot(n, normalize(kKey + vec3(0.0, 0.0, 1.0)))), 16.0) +
                  0.022 * pow(max(0.0, dot(n, normalize(kFill + vec3(0.0, 0.0, 1.0)))), 16.0) +
                  0.040 * pow(1.0 - facing, 2.5);
    lit = albedo * Soften(light) + rim * (0.25 + 0.75 * albedo) + darkness * sheen * shade * mix(vec3(1.0), fibre, 0.6);
  } else {
    // The inside is lit by what comes through the cloth and back from skin and cloth, from everywhere.
    // Never black: a dark inside would look like a hole.
    albedo = 0.022 + 0.978 * albedo;
    lit = albedo * (0.40 + 0.25 * max(0.0, n.z)) * mix(0.7, 1.0, skies.y);
  }
  colour = vec4(sqrt(lit), opacity);
}
)";

const char kLineVertex[] = R"(#version 330 core
layout(location = 0) in vec4 clip_position;
layout(location = 1) in vec3 line_colour;
out vec3 line_colour_between;
void main() {
  line_colour_between = line_colour;
  gl_Position = clip_position;
}
)";

const char kLineFragment[] = R"(#version 330 core
in vec3 line_colour_between;
uniform float opacity;
out vec4 colour;
void main() { colour = vec4(line_colour_between, opacity); }
)";

}  // namespace fitroom::render::shaders
