// What is behind the face: the look's colour, lighter behind the head, darker towards the corners, and
// the soft shadow that the bust stands in.

uniform vec4 background;               // sRGB, straight alpha
uniform vec2 picture_size;
uniform float backdrop_depth;          // 0 for a plain colour, to 1
uniform vec2 shadow_centre;            // pixels
uniform vec3 shadow_shape;             // xx, xy and yy of the quadratic form that is 1 at the shadow's edge
uniform float shadow_strength;         // what it takes of the light in its middle

float in_shadow(vec2 pixel) {
    vec2 off = pixel - shadow_centre;
    float out_of_it = min(dot(shadow_shape, vec3(off.x * off.x, 2.0 * off.x * off.y, off.y * off.y)), 1.0);
    return (1.0 - out_of_it) * (1.0 - out_of_it);
}

vec4 backdrop(vec2 pixel) {
    vec2 place = pixel / picture_size;
    vec2 from_centre = (place - vec2(0.5, 0.58)) * vec2(1.0, 0.85);
    float glow = max(1.0 - dot(from_centre, from_centre) * 2.6, 0.0);
    float shade = 0.62 + 0.62 * glow * glow + 0.10 * (place.y - 0.5);
    // Light paper stays paper; only dark colours get depth.
    float depth = backdrop_depth * clamp(1.2 * (1.0 - dot(background.rgb, vec3(0.3, 0.6, 0.1))), 0.0, 1.0);
    float shadow = backdrop_depth * shadow_strength * (0.28 + 0.72 * depth) * in_shadow(pixel);
    // Half a step of noise, or the slow gradient shows bands.
    float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
    vec3 shown = background.rgb * mix(1.0, shade, depth) * (1.0 - shadow);
    return vec4((shown + noise * max(depth, shadow) / 255.0) * background.a, background.a);
}
