#include "plan/rates.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "plan/backend.h"
#include "base/error.h"

namespace brume {
namespace {

using Json = nlohmann::ordered_json;

struct Nominal {
    double bytes_per_ms;
    double operations_per_ms;
    double alike, turn;  // in operations
};

// Threads of a server CPU, Mesa's software GL on two of them, a mid-range GPU. The CPU has texels, or a texel's turns, side
// by side; turns are what software GL is slow at, and nobody has measured them on a GPU.
Nominal nominal(const Backend &backend)
{
    if (backend.kind() == BRUME_BACKEND_CPU)
        return {4e6 * std::min(backend.threads(), 4u), 1e6 * backend.threads(), 0.25, 1.5};
    return backend.device().find("llvmpipe") != std::string::npos ? Nominal{2e6, 1.5e6, 1, 20} : Nominal{3e8, 1e9, 1, 20};
}

Json identity(const Backend &backend)
{
    return {{"brume_calibration", 2},
            {"library", fmt::format("{}.{}.{}", BRUME_VERSION_MAJOR, BRUME_VERSION_MINOR, BRUME_VERSION_PATCH)},
            {"device", backend.device()},
            {"threads", backend.threads()}};
}

}  // namespace

double nanoseconds(const Backend &backend, const Work &work)
{
    const Nominal rates = nominal(backend);
    return double(work.operations) + rates.alike * double(work.alike) + rates.turn * double(work.turns);
}

double Rates::milliseconds(const Backend &backend, const std::string &effect, const std::string &pass, uint64_t operations,
                           uint64_t bytes) const
{
    if (const auto at = rates_.find(effect + "/" + pass); at != rates_.end())
        return at->second.start_ms + double(operations) * at->second.ms_per_operation;
    const Nominal rates = nominal(backend);
    return std::max(double(bytes) / rates.bytes_per_ms, double(operations) / rates.operations_per_ms);
}

std::string Rates::write(const Backend &backend) const
{
    if (!measured())
        return "";
    Json text = identity(backend);
    for (const auto &[pass, rate] : rates_)
        text["passes"][pass] = {{"start_ms", rate.start_ms}, {"ms_per_operation", rate.ms_per_operation}};
    return text.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Rates::read(const Backend &backend, const std::string &text)
{
    const Json given = Json::parse(text, nullptr, false);
    if (!given.is_object())
        throw Error(BRUME_ERROR_ARGUMENT, "calibration: not a JSON object; expected what brume_context_calibration gave");
    const Json own = identity(backend);
    for (const auto &[key, value] : own.items())
        if (!given.contains(key) || given[key] != value)
            throw Error(BRUME_ERROR_ARGUMENT,
                        fmt::format("calibration.{}: {}; expected {}", key,
                                    given.contains(key) ? given[key].dump(-1, ' ', false, Json::error_handler_t::replace)
                                                        : "missing",
                                    value.dump(-1, ' ', false, Json::error_handler_t::replace)));
    const Json &passes = given.contains("passes") ? given["passes"] : Json();
    if (!passes.is_object() || passes.empty())
        throw Error(BRUME_ERROR_ARGUMENT, "calibration.passes: expected an object with the times of each pass");
    auto number = [](const std::string &pass, const Json &times, const char *key) {
        const Json value = times.is_object() && times.contains(key) ? times[key] : Json();
        if (!value.is_number() || !(value.get<double>() >= 0) || !std::isfinite(value.get<double>()))
            throw Error(BRUME_ERROR_ARGUMENT,
                        fmt::format("calibration.passes.{}.{}: {}; expected a number of at least 0", pass, key,
                                    value.dump(-1, ' ', false, Json::error_handler_t::replace)));
        return value.get<double>();
    };
    std::map<std::string, Rate> rates;
    for (const auto &[pass, times] : passes.items())
        rates[pass] = {number(pass, times, "start_ms"), number(pass, times, "ms_per_operation")};
    rates_ = std::move(rates);
}

}  // namespace brume
