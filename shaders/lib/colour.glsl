// Linear light and the screen's sRGB.

// Decoding by a cubic, at most 0.002 from the standard's formula, without a power a fragment.
vec3 linear_from_srgb(vec3 c) {
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

// Tone mapping and sRGB encoding in one: x (1 + 0.08 x) / (1 + 0.55 x), by which highlights roll off
// towards white at 1.7 instead of clipping at 1, followed by the standard's encoding. A fit in the
// square root of x, at most 0.0045 from both done in full, for a third of their cost.
vec3 displayed(vec3 light) {
    vec3 s = sqrt(light);
    vec3 shown = s * (2.265095 * s - 0.033714) / (s * (s + 1.592663) + 0.026987);
    return clamp(shown, 0.0, 1.0);
}
