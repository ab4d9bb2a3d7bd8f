#include "bench/settings.hpp"

namespace brume::tool {
namespace {

void add_multiscatter(std::vector<Setting> &all)
{
    const std::string effect = "multiscatter";
    for (const std::string lobes : {"second", "every", "third"})
        for (const std::string resolution : {"full", "half", "quarter"}) {
            Setting setting{effect, "calibrated", Kind::kSetting, {{"kernel", "calibrated"}}};
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
                           {{"kernel", "paper"}, {"kernel_size", size}, {"fetch", fetch}}});
    // The paper's default is 4x4 linear_bicubic.
    all.push_back({effect, "paper, no masking", Kind::kPublished, {{"kernel", "paper"}, {"masking", "false"}}});
    all.push_back({effect, "paper, separation", Kind::kPublished, {{"kernel", "paper"}, {"separation", "true"}}});
    all.push_back({effect,
                   "paper, separation, no masking",
                   Kind::kPublished,
                   {{"kernel", "paper"}, {"separation", "true"}, {"masking", "false"}}});
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
                               {{"tier", "nodes"}, {"max_error", error}, {"resolution", resolution}}});
    for (const std::string tier : {"sun", "fogshop"})
        for (const std::string resolution : {"full", "quarter"})
            all.push_back(
                {effect, tier + ", " + resolution, Kind::kPublished, {{"tier", tier}, {"resolution", resolution}}});
}

}  // namespace

const char *name_of(Kind kind)
{
    return kind == Kind::kSetting ? "setting" : kind == Kind::kPublished ? "published" : "baseline";
}

const std::vector<Setting> &settings()
{
    static const std::vector<Setting> all = [] {
        std::vector<Setting> list;
        add_multiscatter(list);
        add_airlight(list);
        return list;
    }();
    return all;
}

Setting reference_of(const std::string &effect)
{
    return {effect, "reference", Kind::kSetting, {{effect == "airlight" ? "tier" : "kernel", "reference"}}};
}

}  // namespace brume::tool
