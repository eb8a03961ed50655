// A portrait's light: a soft key, a fill, a rim from behind, and the sky above and the floor below.
// All directions are unit vectors in the model's space, towards the light.

uniform vec3 key_direction;
uniform vec3 key_light;
uniform float key_softness;             // 0 for a small lamp, to 1 for a wall of light
uniform vec3 fill_direction;
uniform vec3 fill_light;
uniform vec3 rim_direction;
uniform vec3 rim_light;
uniform vec3 sky_light;
uniform vec3 floor_light;
uniform vec3 camera_position;

// How the material answers.
uniform vec3 shine_direction;          // where its highlight comes from
uniform vec3 wrap;                     // how far the key reaches past the terminator; red most on skin
uniform float gloss;                   // strength of the highlight
uniform float sharpness;               // its exponent
uniform float matte;                   // luminance of a colour below which it does not shine
uniform float sheen;                   // light at grazing angles, from the rim
uniform float recess;                  // how much of the light its surroundings keep away

vec3 towards_camera(vec3 position) {
    return normalize(camera_position - position);
}

// How much of the key arrives: a wide lamp reaches past the terminator, and so does light within skin.
vec3 key_on(vec3 n) {
    vec3 past = wrap + key_softness;
    vec3 reached = max((dot(n, key_direction) + past) / (1.0 + past), 0.0);
    return mix(reached, reached * reached, 0.5 * key_softness);
}

// What arrives at a surface in the open.
vec3 open_light(vec3 n) {
    vec3 light = mix(floor_light, sky_light, 0.5 + 0.5 * n.y);
    light += key_light * key_on(n);
    float fill = 0.5 + 0.5 * dot(n, fill_direction);
    return light + fill_light * (fill * fill);
}

// Everything that the surface's colour is multiplied with.
vec3 diffuse_light(vec3 n, vec3 v) {
    vec3 light = open_light(n);
    // Lids keep light from the rim of an eyeball, most from its top.
    light *= 1.0 - recess * (1.0 - smoothstep(0.30, 0.95, n.z - 0.55 * n.y));
    // A rim that took the light's own colour would lie like dust on dark hair and skin.
    float edge = 1.0 - max(dot(n, v), 0.0);
    edge *= edge;
    float rim = max(dot(n, rim_direction) * 0.75 + 0.25, 0.0) * edge * edge;
    return light + rim_light * (rim * sheen);
}

vec3 highlight(vec3 surface, vec3 n, vec3 half_way) {
    float shine = gloss * pow(max(dot(n, half_way), 0.0), sharpness);
    float luminance = dot(surface, vec3(0.2126, 0.7152, 0.0722));
    return key_light * (shine * smoothstep(0.25 * matte, matte + 1e-6, luminance));
}
