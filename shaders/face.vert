#version 330 core
// Every pass draws the same morphed buffer: a frame costs what a static mesh costs.

#ifdef LIT
#include "lib/light.glsl"
#ifdef SKIN
#include "lib/skin.glsl"
in float bend;                         // how much the surface bends, for a head of 30
#endif
#ifdef WRINKLES
#include "lib/wrinkles.glsl"
out vec3 surface_wrinkles;
#endif
#endif

uniform mat4 clip_from_model;
uniform float side;                    // 1 for the outside, -1 where a surface is seen from within

in vec3 position;
in vec3 normal;
out vec3 surface_normal;

#ifdef LIT
// Fine meshes are lit a vertex, which nobody can tell from a pixel; coarse ones a pixel.
#ifdef LIT_BY_VERTEX
out vec3 surface_light;
out vec3 surface_half;                 // halfway between the eye and the highlight's light
#ifdef SKIN
out float surface_shine;               // what the highlight's lobes are multiplied with
#endif
#else
out vec3 surface_view;
#ifdef SKIN
out float surface_bend;
#endif
#endif
out vec3 surface_position;             // the model's space
#endif

#if defined(TEXTURED) || defined(STENCILLED)
in vec2 uv;
out vec2 surface_uv;
#endif

#ifdef COLOURED
in vec3 colour;                        // sRGB, as a texture's
out vec3 surface_colour;
#endif

#repeat PARTNERS
#ifdef PARTNER@_UV
in vec2 partner@_uv;
out vec2 surface_partner@_uv;
#endif

#ifdef PARTNER@_COLOURED
in vec3 partner@_colour;
out vec3 surface_partner@_colour;
#endif
#end

#ifdef HEAT
in vec3 reference;                     // where displacements are measured from
out float displacement;
#endif

#ifdef GLOW
in float glow;
out float surface_glow;
#endif

#ifdef HEM
in float kept;
out float surface_kept;
#endif

invariant gl_Position;

void main() {
    surface_normal = normal * side;
#ifdef LIT
    surface_position = position;
    vec3 view = towards_camera(position);
#ifdef LIT_BY_VERTEX
#ifdef SKIN
    surface_light = light_in_skin(surface_normal, view, vec3(0.0), bend);
    surface_half = normalize(key_direction + view);
    surface_shine = mirrored(surface_normal, view, surface_half, key_direction);
#else
    surface_light = diffuse_light(surface_normal, view);
    surface_half = normalize(shine_direction + view);
#endif
#else
    surface_view = view;
#ifdef SKIN
    surface_bend = bend;
#endif
#endif
#ifdef WRINKLES
    surface_wrinkles = set_weights(uv);
#endif
#endif
#if defined(TEXTURED) || defined(STENCILLED)
    surface_uv = uv;
#endif
#ifdef COLOURED
    surface_colour = colour;
#endif
#repeat PARTNERS
#ifdef PARTNER@_UV
    surface_partner@_uv = partner@_uv;
#endif
#ifdef PARTNER@_COLOURED
    surface_partner@_colour = partner@_colour;
#endif
#end
#ifdef HEAT
    displacement = distance(position, reference);
#endif
#ifdef GLOW
    surface_glow = glow;
#endif
#ifdef HEM
    surface_kept = kept;
#endif
    gl_Position = clip_from_model * vec4(position, 1.0);
}
