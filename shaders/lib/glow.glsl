// A part of the face lit up, as by a coloured lamp behind thin skin: it shows on pale and dark skin alike.

uniform vec3 glow_colour;              // linear

in float surface_glow;                 // 0 for no light to 1

vec3 lit_up(vec3 seen) {
    // What moves a little belongs to the region too, and a plateau looks calmer than a peak.
    float amount = smoothstep(0.03, 0.65, surface_glow);
    // The skin's own luminance keeps form and brows; what is added to it shows on dark skin.
    float luminance = dot(seen, vec3(0.2126, 0.7152, 0.0722));
    return mix(seen, glow_colour * (0.16 + 1.25 * luminance), 0.70 * amount);
}
