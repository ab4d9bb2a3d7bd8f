// What the plan rules out, as programs' compilers see it: software OpenGL runs both sides of branches, and would pay for what no pixel
// needs. METHOD, MATERIAL, SHADOWED, ENVIRONMENT, TRANSFER, WITHOUT, TERMS, GAUSSIANS and ABSORBS are set by the plan.

SurfaceSettings planned(SurfaceSettings settings)
{
    SurfaceSettings s = settings;
    s.method = METHOD;
    s.material = MATERIAL;
    s.without = WITHOUT;
    s.transfer = TRANSFER;
    if (ENVIRONMENT == 0)
        s.environment_order = 0;
    if (SHADOWED == 0)
        s.shadowed = 0;
    if (GAUSSIANS == 0)
        s.gaussian_count = 0;
    return s;
}

Medium planned(Medium medium)
{
    Medium m = medium;
    if (ABSORBS == 0)
        m.absorption = vec3(0.0);
    if (TERMS == 0)
        m.term_count = 0;
    // The same terms are worked out once.
    if ((WITHOUT & without_green) != 0) {
        m.scattering.y = m.scattering.x;
        m.absorption.y = m.absorption.x;
    }
    if ((WITHOUT & without_blue) != 0) {
        m.scattering.z = m.scattering.y;
        m.absorption.z = m.absorption.y;
    }
    return m;
}
