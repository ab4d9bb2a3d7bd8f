// Exposure and saturation of a pixel, as GLSL and as C++. Needs scene.glsl.

// Half of it, so that the difference of two large radiances does not become infinite; what is not finite gives nothing to others.
PURE float finite_half(float x)
{
    return choose(is_finite(x), R(0.5) * x, R(0.0));
}

PURE float graded(float x, float grey, float gain, float saturation, float limit)
{
    return choose(is_finite(x), clamp(R(2.0) * gain * (grey + saturation * (R(0.5) * x - grey)), -limit, limit), x);
}

PURE vec4 graded(IN(Medium) medium, vec4 color, float gain, float saturation, float limit)
{
    float grey = dot(vec3(finite_half(color.x), finite_half(color.y), finite_half(color.z)), medium.luminance);
    return vec4(graded(color.x, grey, gain, saturation, limit), graded(color.y, grey, gain, saturation, limit),
                graded(color.z, grey, gain, saturation, limit), color.w);
}
