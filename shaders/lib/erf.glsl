// 2e-9 relative, 4e-7 in 32 bits; no jump where it ends (the cut of the paper's shows once thousands of blobs add up).
PURE float erf(float x)
{
    float y = clamp(x, -R(3.9), R(3.9));
    float z = y * y;
    float p = R(1.12837916876) +
              z * (R(0.185140268601) +
                   z * (R(0.054222657088) +
                        z * (R(0.00383605837353) +
                             z * (R(0.000375806001619) + z * (R(4.58301496177e-6) - z * R(1.26610758936e-8))))));
    float q = R(1.0) + z * (R(0.497409688375) +
                            z * (R(0.113856368502) +
                                 z * (R(0.0154214626185) + z * (R(0.00129974040197) + z * R(6.21535934068e-5)))));
    return y * p / q;
}

// What a Gaussian adds to int rho dt up to a distance. before: erf(-scale middle).
PURE float column_part(float depth, float scale, float middle, float before, float distance)
{
    return depth * (erf(scale * (distance - middle)) - before);
}
