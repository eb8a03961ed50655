#version 330 core
// The normal's axes as colours: x red, y green, z blue, -1..1 on 0..1.
#include "lib/surface.glsl"

void main() {
    show(normalize(surface_normal) * 0.5 + 0.5, 1.0);
}
