// What this effect's passes are calibrated with: each kind of density by nodes, so many Gaussians, and so large, that they
// are gathered from maps, and all orders of scattering.
#pragma once
#include <string>
#include <vector>

namespace airlight {

inline const std::vector<std::string> &calibration_scenes()
{
    static const std::vector<std::string> scenes = [] {
        const std::string begin =
            R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
                "lights":[{"type":"point","position":[2,1,-12],"intensity":40,"radius":0.1})";
        const std::string one = begin + R"(],"medium":{)",
                          two = begin + R"(,{"type":"point","position":[-4,2,-20],"intensity":40,"radius":0.1}],"medium":{)";
        std::string many = one + R"("scattering":0.05,"density":[)";
        for (int i = 0; i < 60; ++i)
            many += std::string(i ? "," : "") + R"({"type":"gaussian","center":[)" + std::to_string(i * 7 % 13 - 6) + "," +
                    std::to_string(i * 5 % 7 - 3) + "," + std::to_string(-4 - i * 3 % 17) + R"(],"scale":)" +
                    (i % 2 ? "0.5" : "0.3") + R"(,"amplitude":0.5})";
        const std::string coloured = R"("scattering":[0.03,0.035,0.04],"absorption":0.002,"g":0.8})";
        return std::vector<std::string>{
            two + coloured + "}", one + R"("scattering":0.03,"density":[{"type":"exponential","value":1,"falloff":0.2}]}})",
            one + R"("scattering":0.05,"g":0.3,"density":[{"type":"constant","value":0.2},
                {"type":"gaussian","center":[0,0,-10],"scale":0.3,"amplitude":2},
                {"type":"gaussian","center":[5,1,-15],"scale":0.2,"amplitude":2},
                {"type":"gaussian","center":[-6,0,-18],"scale":0.25,"amplitude":2},
                {"type":"gaussian","center":[2,-2,-8],"scale":0.5,"amplitude":2}]}})",
            many + "]}}", two + coloured + R"(,"effects":{"airlight":{"orders":"all"}}})"};
    }();
    return scenes;
}

}  // namespace airlight
