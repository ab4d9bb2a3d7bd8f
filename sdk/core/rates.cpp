#include "core/rates.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/backend.h"
#include "core/error.h"

namespace brume {
namespace {

using Json = nlohmann::ordered_json;

struct Nominal {
    double bytes_per_ms;
    double operations_per_ms;
};

// Threads of a server CPU, Mesa's software GL on two of them, a mid-range GPU.
Nominal nominal(const Backend &backend)
{
    if (backend.kind() == BRUME_BACKEND_CPU)
        return {4e6 * std::min(backend.threads(), 4u), 1e6 * backend.threads()};
    return backend.device().find("llvmpipe") != std::string::npos ? Nominal{2e6, 1.5e6} : Nominal{3e8, 1e9};
}

Json identity(const Backend &backend)
{
    return {{"brume_calibration", 1},
            {"library", fmt::format("{}.{}.{}", BRUME_VERSION_MAJOR, BRUME_VERSION_MINOR, BRUME_VERSION_PATCH)},
            {"device", backend.device()},
            {"threads", backend.threads()}};
}

}  // namespace

double Rates::milliseconds(const Backend &backend, const std::string &effect, const std::string &pass, uint64_t operations,
                           uint64_t bytes) const
{
    if (const auto at = factors_.find(effect + "/" + pass); at != factors_.end())
        return double(operations) * at->second;
    const Nominal rates = nominal(backend);
    return std::max(double(bytes) / rates.bytes_per_ms, double(operations) / rates.operations_per_ms);
}

std::string Rates::write(const Backend &backend) const
{
    if (!measured())
        return "";
    Json text = identity(backend);
    text["ms_per_operation"] = factors_;
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
    const Json &rates = given.contains("ms_per_operation") ? given["ms_per_operation"] : Json();
    if (!rates.is_object() || rates.empty())
        throw Error(BRUME_ERROR_ARGUMENT, "calibration.ms_per_operation: expected an object with a number for each pass");
    std::map<std::string, double> factors;
    for (const auto &[pass, rate] : rates.items()) {
        if (!rate.is_number() || !(rate.get<double>() > 0) || !std::isfinite(rate.get<double>()))
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("calibration.ms_per_operation.{}: {}; expected a positive number",
                                                          pass, rate.dump(-1, ' ', false, Json::error_handler_t::replace)));
        factors[pass] = rate;
    }
    factors_ = std::move(factors);
}

}  // namespace brume
