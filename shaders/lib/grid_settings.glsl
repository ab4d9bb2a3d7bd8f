// The grid along the view's rays that the method `maps` keeps its density in. Needs ray.glsl.
//
// Its points lie on the corners of squares of `cell` pixels, at distances from the camera that all rays share ("slices"):
//   slices         data, one channel: the distances, the first is 0
//   grid_density   of the Gaussians from the camera to there: x int rho dt, yzw that of what scatters red, green and blue
//   grid_lights    of up to four lights, attenuation_density() there, or of any number (`summed`): xyz the logarithm of what those of
//                  them send along the step that begins there (light_of_step()) whose logarithm is straight enough between the
//                  corners, w which are not: the sum of 2^i, or `all_apart`; as far as pixels around the corner see, and a step more
// Slice k has its columns x rows texels from (k % across, k / across) times that on.

struct GridSettings {
    ivec2 size;      // of the pixels' image
    int columns;
    int rows;
    int cell;
    int slices;      // steps; there is one distance more
    int across;
    int side;        // of the attenuation maps, their directions each way
    int nodes;       // and their distances
    int mapped;      // the light whose map is the first
    int gaussians;
    int summed;
    int grey;        // scattering and absorption have no colour
    float angle;     // [rad] and optical depth that a step may have, each way
    float depth;
    float bend;      // of a light's logarithm across a cell or along a step, second derivative times width^2, that is straight enough
    float doubt;     // share of the airlight that the estimate of its error adds for what halving the grid does not show
};

PURE ivec2 grid_corner(IN(GridSettings) s, int slice)
{
    int down = slice / s.across;
    return ivec2((slice - down * s.across) * s.columns, down * s.rows);
}

// The ray through a corner of the grid's cells.
PURE vec3 grid_direction(IN(Camera) camera, IN(GridSettings) s, vec2 corner)
{
    vec3 through = ray_through(camera, corner * float(s.cell));
    return through / length(through);
}
