// A surface's own colour: a linear factor times a colour stored as sRGB, a texture's or a vertex's; and
// other people's colours mixed into it.
#include "lib/colour.glsl"

uniform vec3 albedo;                   // the factor
uniform float opacity;

#ifdef TEXTURED
uniform sampler2D albedo_texture;
in vec2 surface_uv;
#ifndef PAINT_UV
#define PAINT_UV surface_uv            // where the texture is looked up; a shader may say otherwise
#endif
#endif

#ifdef COLOURED
in vec3 surface_colour;
#endif

#ifdef PARTNERS
uniform vec3 stored_colour;            // where there is neither texture nor vertex colour
uniform float own_share;               // of the mixture; all shares together are 1
#endif

#repeat PARTNERS
uniform vec3 partner@_stored_colour;
uniform vec3 partner@_albedo;
uniform float partner@_opacity;
uniform float partner@_share;
#ifdef PARTNER@_TEXTURED
uniform sampler2D partner@_texture;
#ifdef PARTNER@_UV
in vec2 surface_partner@_uv;
#endif
#endif
#ifdef PARTNER@_COLOURED
in vec3 surface_partner@_colour;
#endif
#end

vec4 own_stored() {
#if defined(TEXTURED)
    return texture(albedo_texture, PAINT_UV);
#elif defined(COLOURED)
    return vec4(surface_colour, 1.0);
#elif defined(PARTNERS)
    return vec4(stored_colour, 1.0);
#else
    return vec4(1.0);
#endif
}

#repeat PARTNERS
vec4 partner@_stored() {
#if defined(PARTNER@_UV)
    return texture(partner@_texture, surface_partner@_uv);
#elif defined(PARTNER@_TEXTURED)
    return texture(partner@_texture, PAINT_UV);
#elif defined(PARTNER@_COLOURED)
    return vec4(surface_partner@_colour, 1.0);
#else
    return vec4(partner@_stored_colour, 1.0);
#endif
}
#end

#ifdef PARTNERS
// colour = sum of share * colour, of the stored values (thesis, 2.1.2).
struct Mixture {
    vec3 stored;
    vec3 factor;
    float weight;
    float covered;
};

void add(inout Mixture sum, float share, vec4 stored, vec3 factor, float opaque) {
    float cover = share * opaque * stored.a;
#ifdef CUTOUT
    // What covers less counts less.
    float weight = cover;
#else
    float weight = share;
#endif
    sum.stored += weight * stored.rgb;
    sum.factor += weight * factor;
    sum.weight += weight;
    sum.covered += cover;
}
#endif

// Linear colour, and how much it covers.
vec4 painted() {
    vec4 own = own_stored();
#ifdef PARTNERS
    Mixture sum = Mixture(vec3(0.0), vec3(0.0), 0.0, 0.0);
    add(sum, own_share, own, albedo, opacity);
#repeat PARTNERS
    add(sum, partner@_share, partner@_stored(), partner@_albedo, partner@_opacity);
#end
#ifdef CUTOUT
    float per_weight = 1.0 / max(sum.weight, 1e-6);
    sum.stored *= per_weight;
    sum.factor *= per_weight;
#endif
    return vec4(sum.factor * linear_from_srgb(sum.stored), sum.covered);
#elif defined(TEXTURED) || defined(COLOURED)
    return vec4(albedo * linear_from_srgb(own.rgb), opacity * own.a);
#else
    return vec4(albedo, opacity);
#endif
}
