#version 330 core
// Distance from neutral, or from another surface, as colour; a little shading stays, so that the form can be read.
#include "lib/surface.glsl"

uniform sampler2D ramp;                // the colours from 0 to the map's end
uniform float per_heat_max;            // 1 / distance at the end
uniform vec3 key_direction;

in vec3 surface_view;
in float displacement;

void main() {
    vec3 hot = texture(ramp, vec2(clamp(displacement * per_heat_max, 0.0, 1.0), 0.5)).rgb;
    vec3 n = normalize(surface_normal);
    float form = dot(n, key_direction) * 0.12 + dot(n, normalize(surface_view)) * 0.24 + 0.68;
    show(hot * min(form, 1.0), 1.0);
}
