// One-dimensional lists kept in two-dimensional textures, `width` texels a row.

ivec2 texel_of(int index, int width) {
    return ivec2(index % width, index / width);
}
