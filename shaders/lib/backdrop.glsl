// What is behind the face: the look's colour, lighter behind the head, darker towards the corners.

uniform vec4 background;               // sRGB, straight alpha
uniform vec2 picture_size;

vec4 backdrop(vec2 pixel) {
    vec2 place = pixel / picture_size;
    vec2 from_centre = (place - vec2(0.5, 0.58)) * vec2(1.0, 0.85);
    float glow = max(1.0 - dot(from_centre, from_centre) * 2.6, 0.0);
    float shade = 0.62 + 0.62 * glow * glow + 0.10 * (place.y - 0.5);
    // Light paper stays paper; only dark colours get depth.
    float depth = clamp(1.2 * (1.0 - dot(background.rgb, vec3(0.3, 0.6, 0.1))), 0.0, 1.0);
    // Half a step of noise, or the slow gradient shows bands.
    float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
    return vec4((background.rgb * mix(1.0, shade, depth) + noise * depth / 255.0) * background.a, background.a);
}
