// What the fragment shaders of the face share.

in vec3 surface_normal;

layout(location = 0) out vec4 colour;

#ifdef HEM
#include "lib/backdrop.glsl"
in float surface_kept;                 // 0 at a bust's cut edge, 1 away from it
#endif

#ifdef STENCILLED
uniform sampler2D stencil_texture;
in vec2 surface_uv;
#endif

// The cut lower end of a bust fades into the backdrop. Mixing here, not by blending, keeps the
// result independent of the order in which triangles come.
void show(vec3 srgb, float opacity) {
#ifdef STENCILLED
    // Strips of hair keep their outline where their colours are not shown.
    if (texture(stencil_texture, surface_uv).a < 0.5) {
        discard;
    }
#endif
    colour = vec4(srgb * opacity, opacity);
#ifdef HEM
    colour = mix(backdrop(gl_FragCoord.xy), colour, smoothstep(0.0, 1.0, surface_kept));
#endif
}
