// Normals of the morphed surface, as src/facemorph/core/normals.py defines them.
#include "lib/grid.glsl"

uniform sampler2D positions;           // (V) morphed positions
uniform isampler2D rings;              // for each vertex: where its triangles begin, and how many
uniform isampler2D ring_corners;       // for each of them: its other two vertices, in turning order
uniform float per_length;              // 1 / size of the model, so that areas stay in float's range

vec3 position_of_vertex(int vertex) {
    return texelFetch(positions, texel_of(vertex, textureSize(positions, 0).x), 0).xyz;
}

// Unit sum of the cross products of the vertex's triangles: large triangles count more.
vec3 vertex_normal(int vertex) {
    ivec2 ring = texelFetch(rings, texel_of(vertex, textureSize(rings, 0).x), 0).xy;
    int width = textureSize(ring_corners, 0).x;
    vec3 here = position_of_vertex(vertex);
    vec3 sum = vec3(0.0);
    for (int i = ring.x; i < ring.x + ring.y; ++i) {
        ivec2 other = texelFetch(ring_corners, texel_of(i, width), 0).xy;
        vec3 along = (position_of_vertex(other.x) - here) * per_length;
        sum += cross(along, (position_of_vertex(other.y) - here) * per_length);
    }
    float size = length(sum);
    return size > 1e-18 ? sum / size : vec3(0.0, 0.0, 1.0);
}
