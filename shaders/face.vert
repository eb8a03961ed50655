#version 330 core
// Every pass draws the same morphed buffer: a frame costs what a static mesh costs.

uniform mat4 clip_from_model;

in vec3 position;
in vec3 normal;
out vec3 surface_position;
out vec3 surface_normal;

#ifdef TEXTURED
in vec2 uv;
out vec2 surface_uv;
#endif

#ifdef COLOURED
#include "lib/colour.glsl"
in vec3 colour;
out vec3 surface_colour;
#endif

#ifdef HEAT
in vec3 neutral;
out float displacement;
#endif

#ifdef HEM
in float kept;
out float surface_kept;
#endif

invariant gl_Position;

void main() {
    surface_position = position;
    surface_normal = normal;
#ifdef TEXTURED
    surface_uv = uv;
#endif
#ifdef COLOURED
    surface_colour = linear_from_srgb(colour);
#endif
#ifdef HEAT
    displacement = distance(position, neutral);
#endif
#ifdef HEM
    surface_kept = kept;
#endif
    gl_Position = clip_from_model * vec4(position, 1.0);
}
