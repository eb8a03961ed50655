#version 330 core
// First stage of the shader path: a point a vertex, drawn into the texture of morphed positions.
#include "lib/morph.glsl"

uniform ivec2 grid_size;

flat out vec3 morphed;

void main() {
    morphed = morphed_position(gl_VertexID);
    vec2 centre = (vec2(texel_of(gl_VertexID, grid_size.x)) + 0.5) / vec2(grid_size);
    gl_Position = vec4(centre * 2.0 - 1.0, 0.0, 1.0);
}
