#include "picture_metrics.h"

#include <algorithm>
#include <cmath>

namespace fog {

Picture smoothed(const Picture &p)
{
    Picture half(p.width / 2, p.height / 2, 3), out = half;
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            for (int c = 0; c < 3; ++c)
                half.at(x, y)[c] = 0.25f * (p.at(2 * x, 2 * y)[c] + p.at(2 * x + 1, 2 * y)[c] + p.at(2 * x, 2 * y + 1)[c] +
                                            p.at(2 * x + 1, 2 * y + 1)[c]);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            for (int c = 0; c < 3; ++c) {
                float sum = 0;
                int n = 0;
                for (int j = std::max(0, y - 1); j <= std::min(half.height - 1, y + 1); ++j)
                    for (int i = std::max(0, x - 1); i <= std::min(half.width - 1, x + 1); ++i, ++n)
                        sum += half.at(i, j)[c];
                out.at(x, y)[c] = sum / float(n);
            }
    return out;
}

double rel_mse(const Picture &a, const Picture &b)
{
    const Picture sa = smoothed(a), sb = smoothed(b);
    double mean = 0, error = 0;
    for (float v : sb.data)
        mean += v / double(sb.data.size());
    for (size_t i = 0; i < sa.data.size(); ++i) {
        double d = double(sa.data[i]) - sb.data[i];
        error += d * d / (double(sb.data[i]) * sb.data[i] + 0.0025 * mean * mean) / double(sa.data.size());
    }
    return error;
}

double error_of(const Picture &a, const Picture &reference)
{
    return std::sqrt(rel_mse(a, reference));
}

double detail_of(const Picture &p)
{
    Picture blurred = p;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            for (int c = 0; c < p.channels; ++c) {
                float sum = 0;
                int n = 0;
                for (int j = std::max(0, y - 4); j <= std::min(p.height - 1, y + 4); ++j)
                    for (int i = std::max(0, x - 4); i <= std::min(p.width - 1, x + 4); ++i, ++n)
                        sum += p.at(i, j)[c];
                blurred.at(x, y)[c] = sum / float(n);
            }
    return error_of(blurred, p);
}

}  // namespace fog
