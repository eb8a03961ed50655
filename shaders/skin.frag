#version 330 core
// Skin: relief and the wrinkles of the pose as bumps, light that goes through it, two lobes of highlight.
#include "lib/surface.glsl"
#include "lib/albedo.glsl"
#include "lib/skin.glsl"
#include "lib/bump.glsl"
#ifdef GLOW
#include "lib/glow.glsl"
#endif

#ifdef LIT_BY_VERTEX
in vec3 surface_light;
in vec3 surface_half;
in float surface_shine;
#else
in float surface_bend;
in vec3 surface_view;
#endif
#if !defined(LIT_BY_VERTEX) || defined(WRINKLES)
in vec3 surface_position;
#endif

uniform float roughness;

// How much of the highlight relief takes, by the square of its slope.
const float STEEPNESS = 6.0;

#ifdef RELIEF
uniform sampler2D relief_texture;
uniform float relief_height;           // model units
uniform bool relief_is_normals;
#endif
#ifdef ROUGHNESS
uniform sampler2D roughness_texture;
#endif
#ifdef WRINKLES
uniform sampler2D wrinkle_texture;
uniform float wrinkle_height;          // model units
in vec3 surface_wrinkles;
#endif

#ifdef WRINKLES
// Heights of the wrinkles that show, -0.5..0.5 for each set at its deepest.
float wrinkled(vec2 place) {
    return dot(texture(wrinkle_texture, place).rgb - 128.0 / 255.0, surface_wrinkles);
}

// Furrows keep light out, but for what skin of this colour throws back and forth within them: most of
// the red, and more on fair skin than on dark.
vec3 occluded(float height, vec3 colour) {
    return 1.0 - clamp(-height, 0.0, 0.5) * vec3(1.05, 1.25, 1.30) * (1.0 - 0.6 * min(colour, 1.0));
}
#endif

#if defined(RELIEF) && !defined(LIT_BY_VERTEX)
// The part of a direction that lies in the surface, of length 1.
vec3 tangent(vec3 n, vec3 direction) {
    direction -= n * dot(n, direction);
    return direction * inversesqrt(max(dot(direction, direction), 1e-20));
}

vec3 slope_of_normals(vec3 n, vec3 across, vec3 down, vec2 uv_across, vec2 uv_down) {
    vec3 told = 2.0 * texture(relief_texture, surface_uv).xyz - 256.0 / 255.0;
    float turn = uv_across.x * uv_down.y - uv_across.y * uv_down.x < 0.0 ? -1.0 : 1.0;
    vec3 along_u = tangent(n, (across * uv_down.y - down * uv_across.y) * turn);
    vec3 along_v = tangent(n, (down * uv_across.x - across * uv_down.x) * turn);
    return -(told.x * along_u + told.y * along_v) / max(told.z, 0.2);
}

// How heights rise to the next pixels. Pores are as small as these and need looking up there.
vec2 rises_of_relief(vec2 uv_across, vec2 uv_down) {
    float here = texture(relief_texture, surface_uv).r;
    vec2 there = vec2(texture(relief_texture, surface_uv + uv_across).r,
                      texture(relief_texture, surface_uv + uv_down).r);
    return relief_height * (there - here);
}
#endif

#if (defined(RELIEF) || defined(WRINKLES)) && !defined(LIT_BY_VERTEX)
// `furrow` is the height of the wrinkles, wide enough for the screen's own differences.
vec3 slope_of_relief(vec3 n, float furrow) {
    vec3 across = dFdx(surface_position), down = dFdy(surface_position);
    vec2 rises = vec2(0.0);
#ifdef WRINKLES
    rises = wrinkle_height * vec2(dFdx(furrow), dFdy(furrow));
#endif
#ifdef RELIEF
    vec2 uv_across = dFdx(surface_uv), uv_down = dFdy(surface_uv);
    if (relief_is_normals) {
        return slope_of_normals(n, across, down, uv_across, uv_down) + surface_gradient(n, across, down, rises);
    }
    rises += rises_of_relief(uv_across, uv_down);
#endif
    return surface_gradient(n, across, down, rises);
}
#endif

void main() {
    vec4 paint = painted();
#ifdef CUTOUT
    if (paint.a < 0.03) {
        discard;
    }
#endif
    vec3 n = normalize(surface_normal);
    float rough = roughness;
    float shines = smoothstep(0.25 * matte, matte + 1e-6, dot(paint.rgb, vec3(0.2126, 0.7152, 0.0722)));
#ifdef ROUGHNESS
    // What is as rough as can be is hair or hidden, and shines not at all.
    float told = texture(roughness_texture, surface_uv).r;
    rough = clamp(told, 0.2, 1.0);
    shines = 1.0 - smoothstep(0.75, 1.0, told);
#endif
#ifdef LIT_BY_VERTEX
    vec3 light = surface_light;
    // While something moves: the wrinkles alone, by the screen's own differences, and the key light's highlight.
#ifdef WRINKLES
    float height = wrinkled(surface_uv);
    vec2 rises = wrinkle_height * vec2(dFdx(height), dFdy(height));
    vec3 slope = surface_gradient(n, dFdx(surface_position), dFdy(surface_position), rises);
    light -= key_light * (dot(slope, key_direction) * FIRMNESS);
    light = max(light, 0.0);
    n -= slope;
    light *= occluded(height, paint.rgb);
#endif
    vec3 seen = paint.rgb * light;
    float cosine = dot(n, surface_half) * inversesqrt(dot(surface_half, surface_half) * dot(n, n));
    seen += key_light * (gloss * shines * surface_shine * lobes(max(cosine, 0.0), rough));
#else
#if defined(RELIEF) || defined(WRINKLES)
    float furrow = 0.0;
#ifdef WRINKLES
    furrow = wrinkled(surface_uv);
#endif
    vec3 slope = slope_of_relief(n, furrow);
#else
    const vec3 slope = vec3(0.0);
#endif
    vec3 view = normalize(surface_view);
    vec3 light = light_in_skin(n, view, slope, surface_bend);
#ifdef WRINKLES
    light *= occluded(furrow, paint.rgb);
#endif
    // What is steep within a pixel throws light every way.
    shines /= 1.0 + STEEPNESS * dot(slope, slope);
    vec3 bumped = normalize(n - slope);
    vec3 seen = paint.rgb * light;
    seen += key_light * (gloss * shines * shine(bumped, view, key_direction, rough));
    seen += rim_light * (0.25 * gloss * shines * shine(bumped, view, rim_direction, rough));
#endif
#ifdef GLOW
    seen = lit_up(seen);
#endif
    show(displayed(seen), paint.a);
}
