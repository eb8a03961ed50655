// What the fragment shaders of the face share.

in vec3 surface_normal;

layout(location = 0) out vec4 colour;

#ifdef HEM
#include "lib/backdrop.glsl"
in float surface_kept;                 // 0 at a bust's cut edge, 1 away from it
#endif

// The cut lower end of a bust fades into the backdrop. Mixing here, not by blending, keeps the
// result independent of the order in which triangles come.
void show(vec3 srgb, float opacity) {
    colour = vec4(srgb * opacity, opacity);
#ifdef HEM
    colour = mix(backdrop(gl_FragCoord.xy), colour, smoothstep(0.0, 1.0, surface_kept));
#endif
}
