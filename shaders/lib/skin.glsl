// Light in skin and on it. What comes out red has travelled further than what comes out blue, so that
// the edge of shade is soft and reddish, the more so the more the surface bends within that distance
// (Penner, pre-integrated skin shading, SIGGRAPH 2011). What is thrown back from its oily top keeps the
// light's own colour.
#include "lib/light.glsl"

// How far light scatters, in centimetres of a head of 30, by colour.
const vec3 SCATTER = vec3(0.50, 0.24, 0.15);
// What fine relief is worth to light that comes from below the surface.
const vec3 FIRMNESS = vec3(0.42, 0.72, 0.85);
const float SPECULAR = 0.028;              // reflected head on, of an index of refraction of 1.40

// Half the angle over which the terminator is blurred, as a cosine.
vec3 softness(float bend) {
    return clamp(bend * SCATTER, 0.06, 0.80);
}

// A clamped cosine, blurred: exact light from x = soft on, none up to -soft, a parabola between.
vec3 blurred(vec3 x, vec3 soft) {
    vec3 t = clamp(x + soft, vec3(0.0), 2.0 * soft);
    return t * t / (4.0 * soft) + max(x - soft, 0.0);
}

// Everything that the skin's colour is multiplied with. `slope` is what fine relief turns the normal n
// by, towards -slope.
vec3 light_in_skin(vec3 n, vec3 v, vec3 slope, float bend) {
    vec3 soft = softness(bend);
    float up = n.y - slope.y * FIRMNESS.g;
    vec3 light = mix(floor_light, sky_light, 0.5 + 0.5 * up);
    vec3 shade = soft + key_softness;
    light += key_light * blurred(dot(n, key_direction) - dot(slope, key_direction) * FIRMNESS, shade);
    vec3 fill = clamp(0.5 + 0.5 * (dot(n, fill_direction) - dot(slope, fill_direction) * FIRMNESS), 0.0, 1.0);
    light += fill_light * (fill * fill);
    // Light from behind comes round the edge, and through what is thin.
    float edge = 1.0 - max(dot(n, v), 0.0);
    edge *= edge;
    float behind = dot(n, rim_direction);
    light += rim_light * (max(behind * 0.75 + 0.25, 0.0) * edge * edge * sheen);
    vec3 thin = max(soft - 0.38, 0.0);
    return light + rim_light * thin * thin * (0.9 * max(-behind, 0.0));
}

// GGX's distribution times pi, and what is left of it after masking: two lobes, one wide, and one of the
// film of oil that only the smoothest places have, at this cosine between normal and half-way vector. Each
// throws back as much as the other: a wide one is dim.
float lobes(float cosine, float rough) {
    float film = clamp(1.5 * (0.56 - rough), 0.04, 0.24);
    // A wide lamp is mirrored wide and dim.
    rough = min(rough + 0.25 * key_softness, 1.0);
    vec2 a = min(vec2(1.25, 0.80) * rough, 1.0);
    a *= a;
    a *= a;
    vec2 d = cosine * cosine * (a - 1.0) + 1.0;
    d *= d;
    vec2 both = a * d.yx * vec2(1.0 - film, film);
    return (both.x + both.y) / (d.x * d.y);
}

// What a light towards `towards` loses before and after the lobes: its angle, Fresnel's rise (Schlick
// 1994), and masking (Kelemen and Szirmay-Kalos 2001). h is halfway between it and the eye v.
float mirrored(vec3 n, vec3 v, vec3 h, vec3 towards) {
    float facing = max(dot(v, h), 0.0);
    float away = 1.0 - facing;
    float away2 = away * away;
    float fresnel = SPECULAR + (1.0 - SPECULAR) * away2 * away2 * away;
    return max(dot(n, towards), 0.0) * fresnel * 0.25 / max(facing * facing, 0.06);
}

float shine(vec3 n, vec3 v, vec3 towards, float rough) {
    vec3 h = normalize(towards + v);
    return mirrored(n, v, h, towards) * lobes(max(dot(n, h), 0.0), rough);
}
