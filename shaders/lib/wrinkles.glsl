// How much each set of painted wrinkles counts at a texture coordinate.
// src/facemorph/core/wrinkles.py carries the same names and is the reference.

const int MOST_WRINKLES = 32;

uniform int wrinkle_count;
uniform vec4 wrinkle_areas[MOST_WRINKLES];     // u0, v0, u1, v1
uniform vec4 wrinkle_weights[MOST_WRINKLES];   // the weight, in the channel of its set; a: the soft border

vec2 rise(vec2 place, vec2 edge, float soft) {
    vec2 t = clamp((place - edge) / soft + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

vec3 set_weights(vec2 place) {
    vec3 total = vec3(0.0);
    for (int i = 0; i < wrinkle_count; ++i) {
        vec4 area = wrinkle_areas[i];
        vec4 weight = wrinkle_weights[i];
        vec2 inside = rise(place, area.xy, weight.a) * (1.0 - rise(place, area.zw, weight.a));
        total += weight.rgb * (inside.x * inside.y);
    }
    return total;
}
