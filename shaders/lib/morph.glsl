// The formulas of morphing; src/facemorph/core/morph.py carries the same names and is the reference.
#include "lib/grid.glsl"

const int LINEAR = 0;
const int COSINE = 1;
const float PI = 3.14159265358979;

uniform sampler2D base_positions;      // where the sum starts: the neutral, or an earlier pass's result
uniform sampler2DArray deltas;         // a layer a shape, a texel a vertex
uniform sampler2D active_shapes;       // for each active shape: source, target and added weight, layer
uniform int active_count;
uniform sampler2D rules;                // correctives that may be on, a row each; see gl/rule_rows.py
uniform int rule_count;
uniform float t;
uniform int curve;

// Position on the way from source to target; outside 0..1 the cosine goes on as t does.
float eased(float t, int curve) {
    if (curve == LINEAR || t < 0.0 || t > 1.0) {
        return t;
    }
    return 0.5 - 0.5 * cos(PI * t);
}

// c = (1 - e) source + e target + added
float mixed_coefficient(float source, float target, float added, float e) {
    return (1.0 - e) * source + e * target + added;
}

// A parabola from 0 at start to 1 at peak and back to 0 at end; 0 outside (core/correctives.py).
float hat(float c, float start, float peak, float end) {
    if (c <= start || c >= end) {
        return 0.0;
    }
    float u = c <= peak ? (c - start) / (peak - start) : (end - c) / (end - peak);
    return u * (2.0 - u);
}

// What a corrective is switched on by: the product of weights kept to 0..1, and of hats.
float activation(int rule, int factors, float e) {
    float weight = 1.0;
    for (int i = 0; i < factors; ++i) {
        vec4 driver = texelFetch(rules, ivec2(1 + 2 * i, rule), 0);
        float c = mixed_coefficient(driver.x, driver.y, driver.z, e);
        if (driver.w > 0.5) {
            vec4 feet = texelFetch(rules, ivec2(2 + 2 * i, rule), 0);
            weight *= hat(c, feet.x, feet.y, feet.z);
        } else {
            weight *= clamp(c, 0.0, 1.0);
        }
    }
    return weight;
}

// base + sum of c_k delta_k over the active shapes, and over the correctives that they switch on
vec3 morphed_position(int vertex) {
    ivec2 texel = texel_of(vertex, textureSize(base_positions, 0).x);
    vec3 position = texelFetch(base_positions, texel, 0).xyz;
    float e = eased(t, curve);
    for (int i = 0; i < active_count; ++i) {
        vec4 shape = texelFetch(active_shapes, ivec2(i, 0), 0);
        float coefficient = mixed_coefficient(shape.x, shape.y, shape.z, e);
        position += coefficient * texelFetch(deltas, ivec3(texel, int(shape.w)), 0).xyz;
    }
    for (int i = 0; i < rule_count; ++i) {
        vec4 rule = texelFetch(rules, ivec2(0, i), 0);
        position += activation(i, int(rule.x), e) * texelFetch(deltas, ivec3(texel, int(rule.y)), 0).xyz;
    }
    return position;
}
