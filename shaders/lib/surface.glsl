// What the fragment shaders of the face share.
#include "lib/colour.glsl"
#include "lib/light.glsl"

uniform vec3 camera_position;

in vec3 surface_position;
in vec3 surface_normal;

layout(location = 0) out vec4 colour;

#ifdef HEM
#include "lib/backdrop.glsl"
in float surface_kept;                 // 0 at a bust's cut edge, 1 away from it
#endif

// The normal on the side that is seen: open surfaces have two.
vec3 facing_normal() {
    vec3 n = normalize(surface_normal);
    return gl_FrontFacing ? n : -n;
}

vec3 towards_camera() {
    return normalize(camera_position - surface_position);
}

// The cut lower end of a bust fades into the backdrop. Mixing here, not by blending, keeps the
// result independent of the order in which triangles come.
void show(vec3 srgb, float opacity) {
    colour = vec4(srgb * opacity, opacity);
#ifdef HEM
    colour = mix(backdrop(gl_FragCoord.xy), colour, smoothstep(0.0, 1.0, surface_kept));
#endif
}
