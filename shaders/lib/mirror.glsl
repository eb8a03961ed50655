// What a wet surface mirrors of a photographer's room: a soft box at the key light, the bright ceiling,
// the dim floor. Include after lib/light.glsl.

// `blur` 0 for a clear mirror to 1.
vec3 mirrored_room(vec3 direction, float blur) {
    vec3 aside = normalize(cross(vec3(0.0, 1.0, 0.0), shine_direction));
    vec3 upright = cross(shine_direction, aside);
    vec2 off = abs(vec2(dot(direction, aside), dot(direction, upright)));
    vec2 size = vec2(0.15, 0.19), soft = vec2(0.06 + 0.45 * blur);
    vec2 inside = 1.0 - smoothstep(size - soft, size + soft, off);
    float box = inside.x * inside.y * step(0.0, dot(direction, shine_direction));
    // Brows and lashes stand before most of it.
    float ceiling = smoothstep(-0.05, 0.90, direction.y);
    // A wall of light is crossed by filters that keep its mirror images away: they would veil dark irises.
    vec3 room = mix(floor_light, sky_light * 1.8, ceiling) * (1.0 - key_softness * key_softness);
    return key_light * (6.0 * gloss * box) + room;
}
