#version 330 core
// For what is only counted.

void main() {}
