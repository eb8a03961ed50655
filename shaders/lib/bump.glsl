// Relief without relief: the normal is turned as a surface with these heights would turn it.
//
// Blinn 1978 moves the normal by N x dP/dv dF/du and its like. Mikkelsen 2010 shows that any two
// directions on the surface do, those of the screen too, so no tangents are needed: what is subtracted
// from the normal is the heights' gradient along the surface.

// `across` and `down` are the position's derivatives along the screen's x and y, `rises` the heights'.
vec3 surface_gradient(vec3 n, vec3 across, vec3 down, vec2 rises) {
    vec3 along_x = cross(down, n);
    vec3 along_y = cross(n, across);
    float area = dot(across, along_x);
    vec3 gradient = (rises.x * along_x + rises.y * along_y) * sign(area) / max(abs(area), 1e-12);
    // At grazing angles a pixel spans much, and its derivatives say little.
    float steep = dot(gradient, gradient);
    return steep > 1.0 ? gradient * inversesqrt(steep) : gradient;
}
