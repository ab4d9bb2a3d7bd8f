#include <algorithm>
#include <cmath>

#include "media/operations.h"
#include "media/random.h"

namespace brume::media {

void Emit::apply(State &state) const
{
    const double newest = std::min(time, duration) * rate, oldest = std::max(0.0, (time - lifetime) * rate - 1);
    if (newest < oldest)
        return;
    expect_room(state, std::floor(newest - oldest), name);

    const std::array<double, 2> size{1 / scale[0], 1 / scale[1]};
    for (auto i = uint64_t(oldest); double(i) < newest; ++i) {
        Random random(seed, i);
        const double birth = (double(i) + random.next()) / rate, age = time - birth;
        if (birth >= duration || age < 0 || age >= lifetime)
            continue;
        const dvec3 from = position + radius * random.in_ball();
        const dvec3 speed = velocity + spread * random.in_ball();
        const dvec3 center = from + age * (speed + (0.5 * age) * acceleration);
        const double aged = age / lifetime;
        add(state,
            {{center.x, center.y, center.z},
             1 / (size[0] + aged * (size[1] - size[0])),
             amplitude[0] + aged * (amplitude[1] - amplitude[0]),
             {float(color.x), float(color.y), float(color.z)}},
            name);
    }
}

}  // namespace brume::media
