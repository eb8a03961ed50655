#version 330 core
// Hair as strips of strands: two highlights across the strands, light that gets through at the edges.
//
// Kajiya and Kay 1989, eq. 14: a strand along t reflects into a cone around itself, so the highlight
// depends on the angle between t and the half-way vector. Marschner et al. 2003, 3.1: there are two of
// them, shifted towards tip and root by the cuticle's scales; the second has been inside the strand and
// carries its colour.
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
in vec3 surface_position;

uniform float side;                    // 1 for the outside, -1 for the inside

const float FIRST_SHIFT = -0.10;
const float SECOND_SHIFT = 0.14;
const float INSIDE = 0.60;             // of the light is left underneath
// Alpha is kept a little above what is thrown away, so that thin ends fade and hide nothing after them.
const float THINNEST = 0.10;

#ifdef TEXTURED
// Along the strands towards their roots, across the surface's smooth normal: away from where v stays the same. Where u stays
// the same would be a strand too, but one that breaks at every edge where strands spread.
vec3 strand(vec3 n) {
    vec3 level = dFdx(surface_position) * dFdy(surface_uv.y) - dFdy(surface_position) * dFdx(surface_uv.y);
    vec3 along = cross(n, level);
    return along * inversesqrt(max(dot(along, along), 1e-20));
}

// How far off the cones the light is, as the squared sine of its angle to the strand; t + shift n is
// nearly of length one.
float off_cone(float along, float across, float shift) {
    float towards = along + shift * across;
    return max(1.0 - towards * towards, 0.0);
}

vec3 shine(vec3 paint, vec3 n, vec3 half_way) {
    float along = dot(strand(n), half_way);
    float across = dot(n, half_way);
    // Strands differ, and so do their shifts. Their tones are relative to the material's colour, which is
    // the lightest one's, so this holds for black hair too.
    float tone = sqrt(clamp(paint.g / max(albedo.g, 1e-4), 0.0, 1.0));
    float own = 0.3 * tone - 0.15;
    // Powers 20 and 4 of the sine's square, by products: a power costs as much as all the rest.
    float first = off_cone(along, across, FIRST_SHIFT + own);
    float second = off_cone(along, across, SECOND_SHIFT + own);
    first *= first;
    second *= second;
    float first4 = first * first;
    float first16 = first4 * first4;
    first16 *= first16;
    float reached = gloss * tone * smoothstep(-0.3, 0.7, dot(n, key_direction));
    // Black hair swallows most of what has been inside it: else whole panels of it would turn grey.
    vec3 dyed = sqrt(albedo) * (0.4 + 0.6 * tone) * min(0.45 + 4.0 * albedo.g, 1.0);
    return key_light * reached * (first16 * first4 * 0.10 + second * second * 0.16 * dyed);
}
#endif

void main() {
    vec4 paint = painted();
#ifdef CUTOUT
    if (paint.a < THINNEST) {
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
    vec3 half_way = normalize(key_direction + view);
#endif
    vec3 seen = paint.rgb * light;
#ifdef TEXTURED
    if (side > 0.0) {
        seen += shine(paint.rgb, n, half_way);
    } else {
        seen *= INSIDE;
    }
#endif
#ifdef GLOW
    seen = lit_up(seen);
#endif
    show(displayed(seen), paint.a);
}
