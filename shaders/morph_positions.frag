#version 330 core

flat in vec3 morphed;

layout(location = 0) out vec4 texel;

void main() {
    texel = vec4(morphed, 1.0);
}
