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

in vec3 surface_view;
in vec3 surface_position;

uniform float side;                    // 1 for the outside, -1 for the inside

const float FIRST_SHIFT = -0.10;
const float SECOND_SHIFT = 0.14;
const float INSIDE = 0.60;             // of the light is left underneath

#ifdef TEXTURED
vec3 unit(vec3 v) {
    float length2 = dot(v, v);
    return length2 > 1e-20 ? v * inversesqrt(length2) : vec3(0.0, 1.0, 0.0);
}

// Along the strands, across the surface's smooth normal. Where u stays the same is a strand, but one that
// breaks at every edge where strands spread; across where v stays the same hardly breaks. Half of each.
vec3 strand(vec3 n) {
    vec3 right = dFdx(surface_position);
    vec3 up = dFdy(surface_position);
    vec2 uv_right = dFdx(surface_uv);
    vec2 uv_up = dFdy(surface_uv);
    float turn = uv_right.y * uv_up.x - uv_up.y * uv_right.x;
    vec3 along = right * uv_up.x - up * uv_right.x;
    along = unit((turn < 0.0 ? -along : along) - n * dot(turn < 0.0 ? -along : along, n));
    vec3 across = unit(cross(right * uv_up.y - up * uv_right.y, n));
    return unit(along + (dot(along, across) < 0.0 ? -across : across));
}

float cone(vec3 along, vec3 n, vec3 half_way, float shift, float exponent) {
    float towards = dot(normalize(along + shift * n), half_way);
    return pow(max(1.0 - towards * towards, 0.0), 0.5 * exponent);
}

vec3 shine(vec3 paint, vec3 n, vec3 view) {
    vec3 along = strand(n);
    // Strands differ, and so do their shifts. Their tones are relative to the material's colour, which is
    // the lightest one's, so this holds for black hair too.
    float tone = sqrt(clamp(paint.g / max(albedo.g, 1e-4), 0.0, 1.0));
    float own = 0.3 * (tone - 0.5);
    vec3 key_half = normalize(key_direction + view);
    float reached = smoothstep(-0.3, 0.7, dot(n, key_direction));
    float first = cone(along, n, key_half, FIRST_SHIFT + own, sharpness);
    float second = cone(along, n, key_half, SECOND_SHIFT + own, sharpness * 0.25);
    vec3 dyed = sqrt(albedo) * (0.4 + 0.6 * tone);
    vec3 light = key_light * reached * (first * 0.10 * tone + second * 0.16 * dyed * tone);
    vec3 rim_half = normalize(rim_direction + view);
    float behind = smoothstep(0.0, 0.6, dot(n, rim_direction)) * cone(along, n, rim_half, 0.0, sharpness * 0.5);
    return gloss * (light + rim_light * behind * 0.10 * dyed * tone);
}
#endif

void main() {
    vec4 paint = painted();
#ifdef CUTOUT
    // Thin ends fade; what hardly covers must not hide what comes after it.
    if (paint.a < 0.18) {
        discard;
    }
#endif
    vec3 n = normalize(surface_normal);
    vec3 view = normalize(surface_view);
    // A strand seen from its dark side still shows light: surfaces of hair never end sharply.
    vec3 light = diffuse_light(n, view);
    vec3 seen = paint.rgb * light;
#ifdef TEXTURED
    if (side > 0.0) {
        seen += shine(paint.rgb, n, view);
    } else {
        seen *= INSIDE;
    }
#endif
#ifdef GLOW
    seen = lit_up(seen);
#endif
    show(displayed(seen), paint.a);
}
