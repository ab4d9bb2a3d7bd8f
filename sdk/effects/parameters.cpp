#include "effects/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "base/names.h"
#include "base/text.h"

namespace brume {
namespace {

[[noreturn]] void reject(const Effect &effect, const Parameter &parameter, const std::string &value)
{
    throw Error(BRUME_ERROR_ARGUMENT,
                fmt::format("{}.{}: {}; expected {}", effect.name, parameter.name, value, parameter_expectation(parameter)));
}

}  // namespace

std::string parameter_expectation(const Parameter &parameter)
{
    switch (parameter.type) {
    case BRUME_PARAMETER_INTEGER:
        return fmt::format("an integer from {} to {}", parameter.minimum, parameter.maximum);
    case BRUME_PARAMETER_BOOLEAN:
        return "true or false";
    case BRUME_PARAMETER_CHOICE:
        return fmt::format("one of {}", fmt::join(parameter.choices, ", "));
    default:
        return fmt::format("a number from {} to {}", parameter.minimum, parameter.maximum);
    }
}

size_t find_parameter(const Effect &effect, const std::string &name)
{
    std::vector<std::string> names;
    for (const Parameter &parameter : effect.parameters) {
        if (parameter.name == name || (!name.empty() && parameter.alias == name))
            return names.size();
        names.push_back(parameter.name);
    }
    throw Error(BRUME_ERROR_NOT_FOUND, fmt::format("effect {} has no parameter {}{}", in_quotes(effect.name),
                                                   in_quotes(name), did_you_mean(name, names)));
}

double parameter_from_text(const Effect &effect, const Parameter &parameter, const std::string &text)
{
    if (parameter.type == BRUME_PARAMETER_BOOLEAN) {
        if (text == "true" || text == "false")
            return text == "true";
        reject(effect, parameter, in_quotes(text));
    }
    if (parameter.type == BRUME_PARAMETER_CHOICE) {
        const auto choice = std::find(parameter.choices.begin(), parameter.choices.end(), text);
        if (choice == parameter.choices.end())
            reject(effect, parameter, in_quotes(text));
        return double(choice - parameter.choices.begin());
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        reject(effect, parameter, in_quotes(text));
    return parameter_from_number(effect, parameter, value);
}

double parameter_from_number(const Effect &effect, const Parameter &parameter, double value)
{
    const bool integral = parameter.type == BRUME_PARAMETER_NUMBER || value == std::floor(value);
    if (!integral || !(value >= parameter.minimum && value <= parameter.maximum))
        reject(effect, parameter, fmt::format("{}", value));
    return value;
}

}  // namespace brume
