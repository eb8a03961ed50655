#version 330 core
// Textured skin, eyes, teeth and the rest; clay is the same light on one grey.
#include "lib/surface.glsl"
#include "lib/albedo.glsl"
#include "lib/light.glsl"
#ifdef GLOW
#include "lib/glow.glsl"
#endif

#ifdef LIT_BY_VERTEX
in vec3 surface_light;
in vec3 surface_half;
#else
in vec3 surface_view;
#endif

void main() {
    vec4 paint = painted();
#ifdef CUTOUT
    if (paint.a < 0.03) {
        discard;
    }
#endif
    vec3 n = normalize(surface_normal);
#ifdef LIT_BY_VERTEX
    vec3 light = surface_light;
    vec3 half_way = surface_half;
#else
    vec3 view = normalize(surface_view);
    vec3 light = diffuse_light(n, view);
    vec3 half_way = normalize(shine_direction + view);
#endif
    vec3 seen = paint.rgb * light + highlight(paint.rgb, n, half_way);
#ifdef GLOW
    seen = lit_up(seen);
#endif
    show(displayed(seen), paint.a);
}
