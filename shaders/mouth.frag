#version 330 core
// Teeth, gums, tongue and the mouth's lining: wet, and lit by what comes in between the lips.
#include "lib/surface.glsl"
#include "lib/albedo.glsl"
#include "lib/light.glsl"
#include "lib/mouth_light.glsl"
#ifdef GLOW
#include "lib/glow.glsl"
#endif

in vec3 surface_view;
in vec3 surface_position;

uniform float spill;                   // how far light from the lips' edge spills onto it, in the mouth's size

const vec3 FLESH = vec3(1.0, 0.60, 0.50);      // what bounces in a mouth has met flesh
const float PASSED_ON = 0.7;
const float AT_LIPS = 0.50;                    // of the light is left where lips end and their lining begins
const float GLARE = 0.0128;                    // lights made strong for dark skin would let teeth glare
const float UNDER_LIP = 0.72;                  // of the light is left right under the upper lip
const float CORNER = 0.35;                     // of the light is kept away at the corners
const float FALL_OFF = 0.62;                   // with depth, per half width of the mouth

// How near the lips' edge a place is: 1 on it, 0 from `spill` on.
float beside_lips(vec3 position) {
    float nearest = 1e9;
    vec3 from = aperture[APERTURE - 1];
    for (int i = 0; i < APERTURE; ++i) {
        vec3 along = aperture[i] - from;
        vec3 way = position - from;
        vec3 off = way - along * clamp(dot(way, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
        nearest = min(nearest, dot(off, off));
        from = aperture[i];
    }
    return 1.0 - smoothstep(0.3 * spill, spill, sqrt(nearest) / aperture_size);
}

// What lips and cheeks keep away: most right under the upper lip and at the corners, and the deeper the more.
float unshaded(vec3 position) {
    vec3 way = position - aperture_centre;
    float depth = -dot(way, aperture_normal) / aperture_size;
    float nearest = 1e9;
    for (int i = 0; i < APERTURE / 2; ++i) {
        vec3 along = aperture[i + 1] - aperture[i];
        vec3 off = position - aperture[i];
        off -= along * clamp(dot(off, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
        nearest = min(nearest, dot(off, off));
    }
    float under_lip = mix(UNDER_LIP, 1.0, smoothstep(0.05, 0.45, sqrt(nearest) / aperture_size));
    vec3 across = (aperture[APERTURE / 2] - aperture[0]) / (2.0 * aperture_size);
    float corner = 1.0 - CORNER * smoothstep(0.3, 1.0, abs(dot(way, across)) / aperture_size);
    float inside = smoothstep(-0.1, 0.15, depth);
    return mix(1.0, under_lip * corner * exp(-FALL_OFF * max(depth - 0.35, 0.0)), inside);
}

vec3 lit_inside(vec3 paint, vec3 n, vec3 view) {
    vec2 reached = mouth_light(surface_position, n, key_direction);
    if (spill > 0.0) {
        reached = mix(reached, vec2(AT_LIPS), beside_lips(surface_position));
    }
    vec3 around = mix(floor_light, sky_light, 0.5 + 0.5 * n.y);
    float fill = 0.5 + 0.5 * dot(n, fill_direction);
    around += fill_light * (fill * fill);
    vec3 key = key_light * key_on(n);
    // The key is a wide lamp: half of it comes in wherever the surface sees the opening.
    float keyed = mix(reached.x, reached.y, 0.5) * min(2.0 * reached.x, 1.0);
    vec3 light = around * reached.x + key * keyed;
    // What does not see the opening is lit by what does: the palate by the tongue.
    light += (0.3 * key_light + sky_light) * (PASSED_ON * reached.x * (1.0 - reached.x));
    light *= mix(FLESH, vec3(1.0), smoothstep(0.0, 0.9, reached.x));
    float left = spill > 0.0 ? mix(unshaded(surface_position), 1.0, beside_lips(surface_position))
                             : unshaded(surface_position);
    float lamps = key_light.g + fill_light.g + sky_light.g + floor_light.g;
    lamps *= lamps;
    light *= left * mix(FLESH, vec3(1.0), smoothstep(0.0, 0.8, left)) / (1.0 + GLARE * lamps * lamps);
    vec3 shine = left * highlight(paint, n, normalize(shine_direction + view)) * smoothstep(0.15, 0.7, reached.x);
    // Wet: what comes in at the opening mirrors at grazing angles.
    float edge = 1.0 - max(dot(n, view), 0.0);
    float mirrored = edge * edge * edge * edge * gloss * reached.x;
    return paint * light + shine + sky_light * (mirrored * left * left);
}

void main() {
    vec4 paint = painted();
    vec3 n = normalize(surface_normal);
    vec3 view = normalize(surface_view);
    vec3 seen = aperture_size > 0.0
        ? lit_inside(paint.rgb, n, view)
        : paint.rgb * diffuse_light(n, view) + highlight(paint.rgb, n, normalize(shine_direction + view));
#ifdef GLOW
    seen = lit_up(seen);
#endif
    show(displayed(seen), paint.a);
}
