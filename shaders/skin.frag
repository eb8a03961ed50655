#version 330 core
// Textured skin, eyes, teeth and the rest; clay is the same light on one grey.
#include "lib/surface.glsl"
#include "lib/colour.glsl"
#include "lib/light.glsl"

uniform vec3 albedo;
uniform float opacity;

#ifdef LIT_BY_VERTEX
in vec3 surface_light;
in vec3 surface_half;
#else
in vec3 surface_view;
#endif

#ifdef TEXTURED
uniform sampler2D albedo_texture;
in vec2 surface_uv;
#endif

#ifdef COLOURED
in vec3 surface_colour;
#endif

void main() {
    vec3 surface = albedo;
    float cover = opacity;
#ifdef TEXTURED
    vec4 texel = texture(albedo_texture, surface_uv);
    surface *= linear_from_srgb(texel.rgb);
#ifdef CUTOUT
    cover *= texel.a;
    if (cover < 0.03) {
        discard;
    }
#endif
#endif
#ifdef COLOURED
    surface *= surface_colour;
#endif
    vec3 n = normalize(surface_normal);
#ifdef LIT_BY_VERTEX
    vec3 light = surface_light;
    vec3 half_way = surface_half;
#else
    vec3 view = normalize(surface_view);
    vec3 light = diffuse_light(n, view);
    vec3 half_way = normalize(shine_direction + view);
#endif
    show(displayed(surface * light + highlight(surface, n, half_way)), cover);
}
