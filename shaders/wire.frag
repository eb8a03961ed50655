#version 330 core
// Lines along the polygons' edges, about a pixel wide, fainter where the mesh is too fine to show them.

uniform vec4 line_colour;              // sRGB, straight alpha

noperspective in vec3 edge_distance;
noperspective in float coarseness;
in float line_kept;

layout(location = 0) out vec4 colour;

void main() {
    float nearest = min(edge_distance.x, min(edge_distance.y, edge_distance.z));
    float line = 1.0 - smoothstep(0.25, 1.15, nearest);
    // As many lines as the pixels can show: the face under a fine mesh keeps its brightness.
    float visible = clamp(coarseness / 9.0, 0.06, 1.0);
    float alpha = line_colour.a * line * visible * smoothstep(0.0, 1.0, line_kept);
    colour = vec4(line_colour.rgb * alpha, alpha);
}
