// A surface's own colour: a linear factor times a colour stored as sRGB, a texture's or a vertex's.
#include "lib/colour.glsl"

uniform vec3 albedo;                   // the factor
uniform float opacity;

#ifdef TEXTURED
uniform sampler2D albedo_texture;
in vec2 surface_uv;
#endif

#ifdef COLOURED
in vec3 surface_colour;
#endif

#ifdef PARTNER
uniform vec3 stored_colour;            // where there is neither texture nor vertex colour
uniform vec3 partner_stored_colour;
uniform vec3 partner_albedo;
uniform float partner_opacity;
uniform float partner_share;           // 0 is the face's own colour, 1 the partner's
#ifdef PARTNER_TEXTURED
uniform sampler2D partner_texture;
#ifdef PARTNER_UV
in vec2 surface_partner_uv;
#endif
#endif
#ifdef PARTNER_COLOURED
in vec3 surface_partner_colour;
#endif
#endif

vec4 own_stored() {
#if defined(TEXTURED)
    return texture(albedo_texture, surface_uv);
#elif defined(COLOURED)
    return vec4(surface_colour, 1.0);
#elif defined(PARTNER)
    return vec4(stored_colour, 1.0);
#else
    return vec4(1.0);
#endif
}

#ifdef PARTNER
vec4 partner_stored() {
#if defined(PARTNER_TEXTURED) && defined(PARTNER_UV)
    return texture(partner_texture, surface_partner_uv);
#elif defined(PARTNER_TEXTURED)
    return texture(partner_texture, surface_uv);
#elif defined(PARTNER_COLOURED)
    return vec4(surface_partner_colour, 1.0);
#else
    return vec4(partner_stored_colour, 1.0);
#endif
}
#endif

// Linear colour, and how much it covers.
vec4 painted() {
    vec4 own = own_stored();
#ifdef PARTNER
    // colour = (1 - s) own + s partner, of the stored values (thesis, 2.1.2); what covers less counts less.
    vec4 theirs = partner_stored();
    vec2 weight = vec2(1.0 - partner_share, partner_share);
    vec2 cover = weight * vec2(opacity * own.a, partner_opacity * theirs.a);
    float covered = cover.x + cover.y;
#ifdef CUTOUT
    weight = covered > 0.0 ? cover / covered : weight;
#endif
    vec3 factor = weight.x * albedo + weight.y * partner_albedo;
    return vec4(factor * linear_from_srgb(weight.x * own.rgb + weight.y * theirs.rgb), covered);
#elif defined(TEXTURED) || defined(COLOURED)
    return vec4(albedo * linear_from_srgb(own.rgb), opacity * own.a);
#else
    return vec4(albedo, opacity);
#endif
}
