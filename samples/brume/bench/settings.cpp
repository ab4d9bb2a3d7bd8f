#include "bench/settings.hpp"

#include <sstream>

#include "support/error.hpp"

namespace brume::tool {
namespace {

// The study of error against time has these two by hand: products of parameters, and what papers have.
void add_multiscatter(std::vector<Setting> &all)
{
    const std::string effect = "multiscatter";
    for (const std::string lobes : {"second", "every", "third"})
        for (const std::string resolution : {"full", "half", "quarter"}) {
            Setting setting{effect, "calibrated", Kind::kSetting, {{"method", "calibrated"}}};
            if (lobes != "second") {
                setting.name += ", " + lobes + " level";
                setting.parameters.emplace_back("lobes", lobes);
            }
            if (resolution != "full") {
                setting.name += ", " + resolution;
                setting.parameters.emplace_back("resolution", resolution);
            }
            all.push_back(setting);
        }
    for (const std::string size : {"2x2", "4x4", "6x6"})
        for (const std::string fetch : {"linear_bilinear", "linear_bicubic", "cubic_bicubic"})
            all.push_back({effect,
                           "paper " + size + " " + fetch,
                           Kind::kPublished,
                           {{"method", "paper"}, {"kernel_size", size}, {"fetch", fetch}}});
    // The paper's default is 4x4 linear_bicubic.
    all.push_back({effect, "paper, no masking", Kind::kPublished, {{"method", "paper"}, {"masking", "false"}}});
    all.push_back({effect, "paper, separation", Kind::kPublished, {{"method", "paper"}, {"separation", "true"}}});
    all.push_back({effect,
                   "paper, separation, no masking",
                   Kind::kPublished,
                   {{"method", "paper"}, {"separation", "true"}, {"masking", "false"}}});
}

void add_airlight(std::vector<Setting> &all)
{
    const std::string effect = "airlight";
    all.push_back({effect, "nodes 0.01, full", Kind::kSetting, {}});
    for (const std::string resolution : {"full", "half", "quarter"})
        for (const std::string error : {"0.5", "0.1", "0.02", "0.005", "0.001"})
            // What the nodes leave is small beside what is interpolated.
            if (resolution == "full" || error == "0.5" || error == "0.02")
                all.push_back({effect,
                               "nodes " + error + ", " + resolution,
                               Kind::kSetting,
                               {{"method", "nodes"}, {"max_error", error}, {"resolution", resolution}}});
    for (const std::string method : {"sun", "fogshop"})
        for (const std::string resolution : {"full", "quarter"})
            all.push_back(
                {effect, method + ", " + resolution, Kind::kPublished, {{"method", method}, {"resolution", resolution}}});
}

template <class Visit> void for_choices(const Context &context, const std::string &effect, const Visit &visit)
{
    for (const brume_parameter_info &parameter : context.parameters(effect)) {
        std::istringstream choices(parameter.type == BRUME_PARAMETER_CHOICE    ? parameter.choices
                                   : parameter.type == BRUME_PARAMETER_BOOLEAN ? "false|true"
                                                                               : "");
        std::string choice;
        for (int index = 0; std::getline(choices, choice, '|'); ++index)
            visit(std::string(parameter.name), choice, index == int(parameter.default_number));
    }
}

// Effects call so what others are measured against; it takes minutes.
bool is_reference(const std::string &choice)
{
    return choice.find("reference") != std::string::npos;
}

}  // namespace

const char *name_of(Kind kind)
{
    return kind == Kind::kSetting ? "setting" : kind == Kind::kPublished ? "published" : "baseline";
}

std::vector<Setting> settings_of(const Context &context, const std::string &effect)
{
    std::vector<Setting> list;
    if (effect == "multiscatter")
        add_multiscatter(list);
    else if (effect == "airlight")
        add_airlight(list);
    if (!list.empty())
        return list;
    list.push_back({effect, "defaults", Kind::kSetting, {}});
    for_choices(context, effect, [&](const std::string &parameter, const std::string &choice, bool is_default) {
        if (!is_default && !is_reference(choice))
            list.push_back({effect, parameter + " " + choice, Kind::kSetting, {{parameter, choice}}});
    });
    return list;
}

Setting reference_of(const Context &context, const std::string &effect)
{
    Setting setting{effect, "reference", Kind::kSetting, {}};
    for_choices(context, effect, [&](const std::string &parameter, const std::string &choice, bool) {
        if (choice == "reference")
            setting.parameters = {{parameter, choice}};
    });
    return setting;
}

}  // namespace brume::tool
