// A part of the face lit up, as by a coloured lamp behind thin skin: it shows on pale and dark skin alike.

uniform vec3 glow_colour;              // linear

in float surface_glow;                 // 0 for no light to 1

vec3 lit_up(vec3 seen, vec3 light) {
    float amount = smoothstep(0.0, 1.0, surface_glow);
    // Half the light of the scene keeps the form, the rest is the lamp's own.
    vec3 lamp = glow_colour * (0.35 + 0.45 * dot(light, vec3(0.2126, 0.7152, 0.0722)));
    return mix(seen, lamp, 0.62 * amount);
}
