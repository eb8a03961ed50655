#version 330 core
// The film of tears along a lower lid: clear but for what it mirrors.
#include "lib/surface.glsl"
#include "lib/albedo.glsl"
#include "lib/light.glsl"
#include "lib/mirror.glsl"

in vec3 surface_view;

void main() {
    vec4 paint = painted();
    vec3 n = normalize(surface_normal);
    vec3 view = normalize(surface_view);
    float mirrors = 0.03 + 0.97 * pow(1.0 - max(dot(n, view), 0.0), 5.0);
    vec3 mirrored = mirrored_room(reflect(-view, n), 0.5) * mirrors;
    float cover = clamp(paint.a + dot(mirrored, vec3(0.3, 0.6, 0.1)), 0.0, 1.0);
    show(displayed(paint.rgb * open_light(n) * paint.a + mirrored), cover);
}
