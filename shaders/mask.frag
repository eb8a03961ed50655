#version 330 core
// White for what counts, black for what hides it.
#include "lib/surface.glsl"

uniform float counted;

void main() {
    show(vec3(counted), 1.0);
}
