#include "run/vary.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/text.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

/// SplitMix64's, of Steele, Lea and Flood 2014.
std::uint64_t mixed(std::uint64_t h)
{
    h += 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
}

}  // namespace

bool scale_numbers(ordered_json &node, double factor)
{
    if (node.is_number()) {
        node = node.get<double>() * factor;
        return true;
    }
    if (node.is_array())
        return std::all_of(node.begin(), node.end(), [&](ordered_json &element) { return scale_numbers(element, factor); });
    if (!node.is_object() || !node.contains("keys") || !node["keys"].is_array())
        return false;
    return std::all_of(node["keys"].begin(), node["keys"].end(), [&](ordered_json &key) {
        return key.is_array() && key.size() == 2 && scale_numbers(key[1], factor);
    });
}

Variation Variation::parse(const std::string &text)
{
    Variation variation;
    const auto equals = text.find('=');
    std::vector<std::string> range;
    if (equals != std::string::npos) {
        variation.path_ = text.substr(0, equals);
        variation.keys_ = split(variation.path_, '.');
        range = split(text.substr(equals + 1), ':');
        variation.factor_ = range[0].starts_with('x');
        if (variation.factor_)
            range[0].erase(0, 1);
        variation.logarithmic_ = range.size() == 3 && range[2] == "log";
    }
    const auto is_empty = [](const std::string &key) { return key.empty(); };
    if (equals == std::string::npos || range.size() != (variation.logarithmic_ ? 3u : 2u) ||
        std::any_of(variation.keys_.begin(), variation.keys_.end(), is_empty) || !parse_number(range[0], variation.low_) ||
        !parse_number(range[1], variation.high_) || variation.low_ > variation.high_ ||
        (variation.logarithmic_ && !(variation.low_ > 0)))
        throw RequestError(fmt::format("--vary '{}': expected PATH=LOW:HIGH with numbers LOW <= HIGH, PATH=xLOW:HIGH for a "
                                       "factor, and :log at the end only where LOW > 0",
                                       text));
    return variation;
}

double Variation::value(std::uint64_t seed, std::uint64_t sample) const
{
    std::uint64_t h = mixed(mixed(seed) + sample);
    for (const char c : path_)
        h = mixed(h + (unsigned char)c);
    const double share = double(h >> 11) * 0x1p-53;
    return logarithmic_ ? low_ * std::exp(share * std::log(high_ / low_)) : low_ + share * (high_ - low_);
}

void Variation::apply(ordered_json &scene, double value) const
{
    std::vector<ordered_json *> places{&scene};
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const bool last = i + 1 == keys_.size();
        std::vector<ordered_json *> next;
        for (ordered_json *place : places) {
            std::vector<ordered_json *> holders;
            std::size_t index = 0;
            const std::string &key = keys_[i];
            const bool numbered = std::from_chars(key.data(), key.data() + key.size(), index).ptr == key.data() + key.size();
            if (place->is_array() && !numbered)
                for (ordered_json &element : *place)
                    holders.push_back(&element);
            else
                holders.push_back(place);
            for (ordered_json *holder : holders)
                if (holder->is_array() && numbered && index < holder->size())
                    next.push_back(&(*holder)[index]);
                else if (holder->is_object() && (holder->contains(key) || (last && !factor_)))
                    next.push_back(&(*holder)[key]);
        }
        if (next.empty())
            throw RequestError(fmt::format("--vary {}: the scene has no '{}'", path_,
                                           fmt::join(keys_.begin(), keys_.begin() + std::ptrdiff_t(i) + 1, ".")));
        places = std::move(next);
    }
    for (ordered_json *place : places)
        if (!factor_)
            *place = value;
        else if (!scale_numbers(*place, value))
            throw RequestError(fmt::format("--vary {}: the scene has {} there (expected a number or a list of them)", path_,
                                           place->dump()));
}

}  // namespace brume::tool
