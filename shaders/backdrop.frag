#version 330 core
#include "lib/backdrop.glsl"

layout(location = 0) out vec4 colour;

void main() {
    colour = backdrop(gl_FragCoord.xy);
}
