// A portrait's light: a soft key, a fill, a rim from behind, and the sky above and the floor below.
// All directions are unit vectors in the model's space, towards the light.

uniform vec3 key_direction;
uniform vec3 key_light;
uniform vec3 fill_direction;
uniform vec3 fill_light;
uniform vec3 rim_direction;
uniform vec3 rim_light;
uniform vec3 sky_light;
uniform vec3 floor_light;

// How the material answers.
uniform vec3 wrap;                     // how far the key reaches past the terminator; red most on skin
uniform float gloss;                   // strength of the highlight
uniform float sharpness;               // its exponent
uniform float sheen;                   // light at grazing angles, from the rim
uniform float recess;                  // how much of the light its surroundings keep away

vec3 lit(vec3 albedo, vec3 n, vec3 v) {
    vec3 light = mix(floor_light, sky_light, 0.5 + 0.5 * n.y);
    light += key_light * max((dot(n, key_direction) + wrap) / (1.0 + wrap), 0.0);
    float fill = 0.5 + 0.5 * dot(n, fill_direction);
    light += fill_light * (fill * fill);

    // Lids keep light from the rim of an eyeball, most from its top.
    light *= 1.0 - recess * (1.0 - smoothstep(0.45, 1.0, n.z - 0.35 * n.y));

    float edge = 1.0 - max(dot(n, v), 0.0);
    edge *= edge;
    float rim = max(dot(n, rim_direction) * 0.75 + 0.25, 0.0) * edge * edge * sheen;
    float shine = pow(max(dot(n, normalize(key_direction + v)), 0.0), sharpness) * gloss;
    // Dark hair and skin would look dusty if the rim were white on them.
    return albedo * light + key_light * shine + rim_light * (albedo * 0.8 + 0.05) * rim;
}
