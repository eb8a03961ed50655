#version 330 core
// Textured skin, eyes, teeth and the rest; clay is the same light on one grey.
#include "lib/surface.glsl"

uniform vec3 albedo;
uniform float opacity;

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
    show(displayed(lit(surface, facing_normal(), towards_camera())), cover);
}
