#include "columns.h"

namespace extremes {

fog::Names Column::outputs() const
{
    fog::Names names{"transmittance", "optical_depth"};
    if (filters())
        names = fog::joined(names, {"scattered", "blur_radius"});
    return lit() ? fog::joined(names, {"airlight", "airlight_error"}) : names;
}

bool Column::takes(const Condition &c) const
{
    if (tier() == "sun")
        return c.isotropic() && c.homogeneous();
    if (tier() == "fogshop")
        return c.isotropic();
    return lit() || !c.about_lights();
}

std::string Column::scene(const Condition &c) const
{
    Json scene = fog::lit_scene(c.medium, lit() ? c.lights : Json::array());
    scene["effects"] = effects;
    return scene.dump();
}

std::vector<Column> columns()
{
    auto filter = [](const char *kernel) { return Json{{"multiscatter", {{"kernel", kernel}}}}; };
    auto airlight = [](const char *tier) { return Json{{"airlight", {{"tier", tier}}}}; };
    std::vector<Column> all{{"calibrated", filter("calibrated")},
                            {"paper", filter("paper")},
                            {"paper, separated", filter("paper")},
                            {"reference kernel", filter("reference"), true},
                            {"paper's reference", filter("paper_reference"), true},
                            {"calibrated, quarter", filter("calibrated")},
                            {"nodes", airlight("nodes")},
                            {"nodes, quarter", airlight("nodes")},
                            {"fogshop", airlight("fogshop")},
                            {"sun", airlight("sun")},
                            {"reference tier", airlight("reference"), true},
                            {"calibrated and nodes", filter("calibrated")},
                            {"maps", airlight("maps")}};
    all[2].effects["multiscatter"].update(
        {{"separation", true}, {"kernel_size", "6x6"}, {"fetch", "cubic_bicubic"}, {"placement", true}});
    all[5].effects["multiscatter"].update({{"resolution", "quarter"}, {"lobes", "third"}});
    all[7].effects["airlight"]["resolution"] = "quarter";
    all[11].effects.update(airlight("nodes"));
    all[11].effects["airlight"]["orders"] = "all";
    return all;
}

const Column &column(const std::string &name)
{
    static const std::vector<Column> all = columns();
    for (const Column &c : all)
        if (c.name == name)
            return c;
    throw std::runtime_error("no column " + name);
}

fog::Options options_of(const Column &column)
{
    return {[](brume_format &f) {
                f.depth_kind = BRUME_DEPTH_RAY;
                f.nonpositive = BRUME_NONPOSITIVE_NEAR;
            },
            column.outputs()};
}

fog::Frame frame_of(const Column &column, const Condition &c)
{
    const int width = column.filters() ? 9 : 5, height = column.filters() ? 5 : 3;
    fog::Frame frame{fog::Picture(width, height, 4, 1), fog::Picture(width, height, 1, 8)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 2 + 1; ++x) {
            frame.depth.at(x, y)[0] = c.depth;
            std::fill_n(frame.color.at(x, y), 3, c.radiance);
        }
    return frame;
}

}  // namespace extremes
