#pragma once
#include <string>

#include <fmt/format.h>

namespace brume {

namespace ranges {
inline constexpr double huge = 1e30;
}

// What a value of a scene may be. Finite bounds keep every later product finite.
struct Range {
    double minimum = -ranges::huge;
    double maximum = ranges::huge;
    bool open = false;  // the bounds themselves are excluded

    bool operator==(const Range &) const = default;
    bool contains(double value) const
    {
        return open ? value > minimum && value < maximum : value >= minimum && value <= maximum;
    }
    std::string describe() const
    {
        return open ? fmt::format("a number above {} and below {}", minimum, maximum)
                    : fmt::format("a number from {} to {}", minimum, maximum);
    }
};

namespace ranges {

inline constexpr Range any;
inline constexpr Range not_negative{0.0, huge};
inline constexpr Range positive{1e-30, huge};
inline constexpr Range fraction{0.0, 1.0};
inline constexpr Range asymmetry{-1.0, 1.0};
inline constexpr Range droplet_diameter{5.0, 50.0};         // [um]; the domain of the fit
inline constexpr Range shadow_angle{1e-6, 3.141592};        // [rad]
inline constexpr Range field_of_view{0.0, 180.0, true};     // [degrees]
inline constexpr Range spot_angle{0.0, 3.141592653589793};  // [rad]; of the whole cone
inline constexpr Range spot_degrees{0.0, 180.0};
inline constexpr Range pixel_aspect{1e-3, 1e3};
inline constexpr Range noise_strength{0.0, 10.0};
inline constexpr Range noise_scale{1e-6, 1e9};
inline constexpr Range max_error{1e-6, 10.0};
inline constexpr Range budget_ms{1e-6, 1e9};
inline constexpr Range detail{0.0, 1e6};
inline constexpr Range noise_seed{0.0, 65535.0};
inline constexpr Range center{-1e6, 1e6};
inline constexpr Range frame{-1e9, 1e9};

}  // namespace ranges
}  // namespace brume
