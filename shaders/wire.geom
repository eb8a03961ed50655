#version 330 core
// Distances to the polygon's edges in pixels, so that the fragment shader draws thin smooth lines
// (after Bærentzen et al. 2006, "Single-pass wireframe rendering"); a quad's diagonal is left out.
#include "lib/grid.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

uniform usampler2D polygon_edges;      // for each triangle, which of its edges are the polygon's
uniform vec2 picture_size;
uniform float finer;                   // how many times as wide the file's polygons are

in float surface_kept[];

noperspective out vec3 edge_distance;
noperspective out float coarseness;
out float line_kept;

const float FAR_AWAY = 1e4;

vec2 pixel_of(vec4 clip) {
    return clip.xy / clip.w * 0.5 * picture_size;
}

void main() {
    if (min(gl_in[0].gl_Position.w, min(gl_in[1].gl_Position.w, gl_in[2].gl_Position.w)) <= 0.0) {
        return;
    }
    int width = textureSize(polygon_edges, 0).x;
    uint edges = texelFetch(polygon_edges, texel_of(gl_PrimitiveIDIn, width), 0).r;
    vec2 a = pixel_of(gl_in[0].gl_Position);
    vec2 b = pixel_of(gl_in[1].gl_Position);
    vec2 c = pixel_of(gl_in[2].gl_Position);
    float area = abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    // Edge i runs from corner i to the next; the corner across from it is i + 2.
    vec3 reach = area / max(vec3(distance(a, b), distance(b, c), distance(c, a)), 1e-6);
    vec3 absent = FAR_AWAY * vec3((edges & 1u) == 0u, (edges & 2u) == 0u, (edges & 4u) == 0u);
    mat3 to_edges = mat3(0.0, reach.y, 0.0, 0.0, 0.0, reach.z, reach.x, 0.0, 0.0);
    for (int i = 0; i < 3; ++i) {
        edge_distance = to_edges[i] + absent;
        coarseness = finer * min(reach.x, min(reach.y, reach.z));
        line_kept = surface_kept[i];
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
