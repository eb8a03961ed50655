#version 330 core
// Lines along the polygons' edges, about a pixel wide, fainter where the mesh is too fine to show them.

uniform vec4 line_colour;              // sRGB, straight alpha
uniform vec2 fade_heights;             // as the hem's; equal heights fade nothing

noperspective in vec3 edge_distance;
noperspective in float coarseness;
in float height;

layout(location = 0) out vec4 colour;

void main() {
    float nearest = min(edge_distance.x, min(edge_distance.y, edge_distance.z));
    float line = 1.0 - smoothstep(0.25, 1.15, nearest);
    float visible = mix(0.25, 1.0, smoothstep(2.0, 9.0, coarseness));
    float shown = fade_heights.x == fade_heights.y ? 1.0 : smoothstep(fade_heights.x, fade_heights.y, height);
    float alpha = line_colour.a * line * visible * shown;
    colour = vec4(line_colour.rgb * alpha, alpha);
}
