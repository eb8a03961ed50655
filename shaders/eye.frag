#version 330 core
// An eyeball: an iris seen through its cornea, a soft shadow of the lids, and what a wet ball mirrors.
// Where the face's eyes are not laid out as `gl/eyes.py` knows them, a plain shiny surface.
#include "lib/surface.glsl"
#ifdef TEXTURED
vec2 seen_uv;
#define PAINT_UV seen_uv
#endif
#include "lib/albedo.glsl"
#include "lib/light.glsl"
#include "lib/mirror.glsl"
#ifdef GLOW
#include "lib/glow.glsl"
#endif

in vec3 surface_view;
in vec3 surface_position;

const float LIMBUS_IN_PICTURE = 0.27;
const float CORNEA = 1.33;             // its radius, the limbus's being 1
const float DEPTH = 0.46;              // of the iris's middle below it
const float SOCKET = 0.72;              // light that brow, nose and cheek leave the white
const float GLARE = 0.0105;             // lights made strong for dark skin would let the white glare
const vec3 CARUNCLE = vec3(0.46, 0.16, 0.13);
const float INTO_EYE = 1.0 / 1.336;    // refractive index of air over that of the aqueous humour

uniform bool eyes_known;
uniform vec3 eye_centre[2];            // the person's left and right eye, in the model's space
uniform vec3 eye_right[2];             // unit axes: the picture's, and where the eye looks
uniform vec3 eye_up[2];
uniform vec3 eye_forward[2];
uniform float eye_radius[2];
uniform vec4 upper_lid[2];             // height of the lid's edge, a cubic of x; in radii from the centre
uniform vec4 lower_lid[2];
uniform vec2 lid_span[2];              // the x between which the cubics hold

float cubic(vec4 c, float x) {
    return c.x + x * (c.y + x * (c.z + x * c.w));
}

// How far a point of the ball is below the upper lid's edge and above the lower one's, in radii.
vec2 from_lids(int eye, vec3 place) {
    float x = clamp(place.x, lid_span[eye].x, lid_span[eye].y);
    // Straight on where the cubics end, towards the corner.
    float beyond = abs(place.x - x) * 0.7;
    float upper = cubic(upper_lid[eye], x) - beyond, lower = cubic(lower_lid[eye], x) + beyond;
    return vec2(upper - place.y, place.y - lower);
}

// What the lids let through: softly dark below the upper one and its lashes, a little above the lower one.
float beside_lids(float below, float above) {
    float lashes = 1.0 - 0.66 * exp2(-max(below - 0.04, 0.0) * 7.5);
    float margin = 1.0 - 0.55 / (1.0 + exp2(above * 18.0));
    // Towards the corners the lids close in.
    float corner = smoothstep(-0.05, 0.42, below + above);
    return lashes * margin * (0.55 + 0.45 * corner);
}

// The caruncle: a pink mound that fills the corner next to the nose, 0..1; `above` the middle between the
// lids it narrows.
float caruncle(int eye, vec3 place, float opening, float above) {
    float nasal = eye == 0 ? place.x - lid_span[0].x : lid_span[1].y - place.x;
    float away = nasal + 0.3 * max(above, -0.02);
    return (1.0 - smoothstep(-0.05, 0.06, away)) * smoothstep(-0.04, 0.06, opening);
}

#ifdef TEXTURED
vec3 eyeball(int eye, vec3 n, vec3 view, inout vec4 paint) {
    vec2 q = (surface_uv - 0.5) / LIMBUS_IN_PICTURE;
    float out_of_axis = length(q);
    float clear = 1.0 - smoothstep(0.90, 1.05, out_of_axis);
    vec3 right = eye_right[eye], up = eye_up[eye], forward = eye_forward[eye];
    // The cornea's own normal, smoother than the mesh's.
    vec2 lean = q / CORNEA;
    vec3 bulge = vec3(lean, sqrt(max(1.0 - dot(lean, lean), 0.05)));
    vec3 local_view = vec3(dot(view, right), dot(view, up), dot(view, forward));
    vec3 bent = refract(-local_view, normalize(bulge), INTO_EYE);
    float depth = DEPTH * max(1.0 - out_of_axis * out_of_axis, 0.0);
    vec2 on_iris = q + bent.xy * (depth / max(-bent.z, 0.35));
    on_iris *= min(1.0, 1.0 / max(length(on_iris), 1e-4)) * clear + (1.0 - clear);
    seen_uv = mix(surface_uv, 0.5 + on_iris * LIMBUS_IN_PICTURE, clear);
    paint = painted();

    vec3 cornea_normal = normalize(bulge.x * right + bulge.y * up + bulge.z * forward);
    vec3 wet = normalize(mix(n, cornea_normal, clear));
    // The iris lies flat behind the cornea, which gathers light on the side away from the lamp.
    vec3 lit_normal = normalize(mix(n, forward, 0.75 * clear));
    vec3 light = open_light(lit_normal);
    float lamps = key_light.g + fill_light.g + sky_light.g + floor_light.g;
    lamps *= lamps;
    light *= mix(SOCKET / (1.0 + GLARE * lamps * lamps), 0.85, clear);
    vec2 lamp = vec2(dot(key_direction, right), dot(key_direction, up));
    light *= 1.0 + clear * (0.15 - 0.75 * dot(on_iris, lamp));
    vec3 place = (surface_position - eye_centre[eye]) / eye_radius[eye];
    vec2 lids = from_lids(eye, place);
    float open = beside_lids(lids.x, lids.y);
    float mound = caruncle(eye, place, lids.x + lids.y, 0.5 * (lids.y - lids.x)) * (1.0 - clear);
    paint.rgb = mix(paint.rgb, CARUNCLE * (0.7 + 0.3 * paint.rgb), mound);
    // Blood in the lids reddens what shade they leave.
    vec3 seen = paint.rgb * light * pow(vec3(open), vec3(0.90, 1.04, 1.08));

    float facing = max(dot(wet, view), 0.0);
    float mirrors = 0.025 + 0.975 * pow(1.0 - facing, 5.0);
    float shine = smoothstep(0.30, 0.75, open);
    vec3 mirrored = mirrored_room(reflect(-view, wet), mix(0.55, 0.0, clear));
    return seen + mirrored * (mirrors * mix(0.30, 1.0, clear) * shine);
}
#endif

vec3 plain(vec3 n, vec3 view, vec3 paint) {
    return paint * diffuse_light(n, view) + highlight(paint, n, normalize(shine_direction + view));
}

void main() {
    vec3 n = normalize(surface_normal);
    vec3 view = normalize(surface_view);
    vec4 paint;
    vec3 seen;
#ifdef TEXTURED
    if (eyes_known) {
        vec3 left = surface_position - eye_centre[0], other = surface_position - eye_centre[1];
        seen = eyeball(dot(left, left) < dot(other, other) ? 0 : 1, n, view, paint);
    } else {
        seen_uv = surface_uv;
        paint = painted();
        seen = plain(n, view, paint.rgb);
    }
#else
    paint = painted();
    seen = plain(n, view, paint.rgb);
#endif
#ifdef CUTOUT
    if (paint.a < 0.03) {
        discard;
    }
#endif
#ifdef GLOW
    seen = lit_up(seen);
#endif
    show(displayed(seen), paint.a);
}
