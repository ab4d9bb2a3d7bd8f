#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gaussians/gaussian.h"

namespace brume {

// Which columns of a file make a Gaussian, and what their values may be; the same for every format.
class GaussianColumns {
public:
    // The columns' names in the file's order; those that say nothing of Gaussians are passed over. `place` ("puffs.csv:1")
    // stands before messages.
    GaussianColumns(std::vector<std::string> names, const std::string &place);

    size_t count() const { return names_.size(); }
    const std::string &name(size_t column) const { return names_[column]; }
    bool means_something(size_t column) const { return fields_[column].has_value(); }
    bool is_colour(size_t column) const;

    // From a value for every column; `place` is called where one is refused.
    template <class Place> Gaussian read(std::span<const double> values, Place place) const
    {
        Gaussian gaussian;
        for (size_t column = 0; column < names_.size(); ++column)
            if (!take(gaussian, column, values[column]))
                refuse(column, values[column], place());
        return gaussian;
    }

private:
    bool take(Gaussian &gaussian, size_t column, double value) const;
    [[noreturn]] void refuse(size_t column, double value, const std::string &place) const;

    std::vector<std::string> names_;
    std::vector<std::optional<size_t>> fields_;  // of each column
};

}  // namespace brume
