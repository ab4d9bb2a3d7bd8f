#include <brume/brume_media.h>
#include <fmt/format.h>

#include "base/error.h"
#include "media/operations.h"

namespace brume::media {
namespace {

struct Check {
    const char *operation;

    [[noreturn]] void refuse(const std::string &field, const std::string &was, const std::string &expected) const
    {
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}.{}: {}; expected {}", operation, field, was, expected));
    }

    void operator()(const std::string &field, double value, const Range &range) const
    {
        if (!range.contains(value))
            refuse(field, fmt::format("{}", value), range.describe());
    }
    void operator()(const std::string &field, const dvec3 &value, const Range &range) const
    {
        for (int i = 0; i < 3; ++i)
            (*this)(fmt::format("{}[{}]", field, i), value[i], range);
    }
    template <size_t n>
    void operator()(const std::string &field, const std::array<double, n> &value, const Range &range) const
    {
        for (size_t i = 0; i < n; ++i)
            (*this)(fmt::format("{}[{}]", field, i), value[i], range);
    }
    void operator()(const std::string &field, const std::vector<dvec3> &value, const Range &range) const
    {
        if (value.empty() || value.size() > BRUME_MEDIA_MAX_STROKE_POINTS)
            refuse(field, fmt::format("{} of them", value.size()), fmt::format("1 to {}", BRUME_MEDIA_MAX_STROKE_POINTS));
        for (size_t i = 0; i < value.size(); ++i)
            (*this)(fmt::format("{}[{}]", field, i), value[i], range);
    }
    void operator()(const char *field, uint32_t value) const
    {
        if (std::string_view(field) == "mode" && value > BRUME_MEDIA_SELECT_REMOVE)
            refuse(field, fmt::format("{}", value), "a BRUME_MEDIA_SELECT_...");
    }
    // Those below are checked where they are made.
    void operator()(const char *, const std::vector<Gaussian> &) const {}
    void operator()(const char *, const Lens &) const {}
    void operator()(const char *, const std::shared_ptr<const DepthMap> &) const {}
};

}  // namespace

void check(const Operation &operation)
{
    std::visit(
        [](const auto &known) {
            Check check{known.name};
            known.fields(known, check);
        },
        operation);
}

}  // namespace brume::media
