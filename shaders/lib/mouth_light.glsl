// Light inside the mouth; src/facemorph/core/mouth_light.py carries the same names and is the reference.

const int APERTURE = 8;

uniform vec3 aperture[APERTURE];       // the edge of the lips, once around, leftwards along the upper lip
uniform vec3 aperture_centre;
uniform vec3 aperture_normal;          // unit, out of the mouth
uniform float aperture_size;           // half the distance between the corners; 0 where the lips are not known

const float PI = 3.14159265358979;
const float DIM = 0.07;                // what bounces about in a mouth that no light enters
const float BOUNCE = 0.42;             // of what an opening lets in, how much reaches what does not see it
const float INTERREFLECTION = 0.56;    // teeth and flesh pass light on: shade is never as deep as the form factor
const float PENUMBRA = 0.40;           // half of it, as a sine, of the key's shadow
const float FRONT = 0.12;              // of the size: so far before the edge of the lips nothing is kept away

// The field of a uniformly bright aperture (Lambert's formula for a polygon): its length is the share
// of light that a surface turned towards the aperture gets; x to z the vector, w how well the key's
// direction is inside the aperture, as a sine.
vec4 light_through(vec3 position, vec3 towards_key) {
    vec3 field = vec3(0.0);
    float inside = 1.0;
    vec3 previous = normalize(aperture[APERTURE - 1] - position);
    for (int i = 0; i < APERTURE; ++i) {
        vec3 next = normalize(aperture[i] - position);
        vec3 edge = cross(next, previous);
        float sine = max(length(edge), 1e-6);
        field += edge * (atan(sine, dot(previous, next)) / sine);
        inside = min(inside, dot(edge, towards_key) / sine);
        previous = next;
    }
    return vec4(field / (2.0 * PI), inside);
}

// 0 behind the lips to 1 before them.
float before_lips(vec3 position) {
    float ahead = dot(position - aperture_centre, aperture_normal) / aperture_size;
    return smoothstep(-FRONT, FRONT, ahead);
}

// Shares of the light from all round (x) and of the key (y) that reach a place inside the mouth.
vec2 mouth_light(vec3 position, vec3 n, vec3 towards_key) {
    vec4 through = light_through(position, towards_key);
    float open = length(through.xyz);
    float facing = max(dot(through.xyz, n), 0.0);
    float direct = min(BOUNCE * open + (1.0 - BOUNCE) * facing, 1.0);
    float around = DIM + (1.0 - DIM) * pow(direct, INTERREFLECTION);
    float key = smoothstep(-PENUMBRA, PENUMBRA, through.w);
    return mix(vec2(around, key), vec2(1.0), before_lips(position));
}
