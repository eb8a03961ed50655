// Linear light and the screen's sRGB.

// Decoding by a cubic, at most 0.002 from the standard's formula, without a power a fragment.
vec3 linear_from_srgb(vec3 c) {
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

// Encoding by square roots (after Chilliant's fit), at most 0.004 from the standard's formula.
vec3 srgb_from_linear(vec3 c) {
    vec3 root = sqrt(c);
    vec3 fourth = sqrt(root);
    return 0.585122381 * root + 0.783140355 * fourth - 0.368262736 * sqrt(fourth);
}

// Highlights roll off towards white instead of clipping.
vec3 tone_mapped(vec3 c) {
    return c * (1.0 + c * 0.08) / (1.0 + c * 0.55);
}

vec3 displayed(vec3 light) {
    return srgb_from_linear(clamp(tone_mapped(light), 0.0, 1.0));
}
