#version 330 core
// Second stage of the shader path: position and exact normal of each drawn vertex, fed back into the
// buffer that every pass draws from. Copies of one vertex at a seam get the same normal.
#include "lib/normals.glsl"

in int position_of;

out vec3 position;
out vec3 normal;

void main() {
    position = position_of_vertex(position_of);
    normal = vertex_normal(position_of);
}
