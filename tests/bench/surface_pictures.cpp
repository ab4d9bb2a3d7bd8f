// The picture of plugins/surface/README.md that shows what fog does to surfaces: spheres and a floor that two lamps light,
// rendered in clear air, and what the methods of effect surface make of them.
//
//   surface_pictures FOLDER
//
// Writes FOLDER/surface_methods.png. Above: clear air, sun, psf, calibrated, without the fog between them and the camera;
// below: with it, the first as if surfaces had their light as in clear air.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <optional>

#include <png.h>

#include "relit.h"

using namespace fog;

namespace {

using brume::maths_double::vec3;
constexpr double pi = 3.14159265358979323846;
constexpr int width = 250, height = 170, finer = 2, gap = 4;

struct Ball {
    vec3 at;
    double radius;
    vec3 albedo, specular;
    double roughness;
};

const Ball balls[] = {{{-1.75, -0.2, -5.6}, 0.8, {0.7, 0.25, 0.15}, {0, 0, 0}, 1},
                      {{0.05, -0.3, -4.9}, 0.7, {0.03, 0.03, 0.04}, {0.5, 0.5, 0.5}, 0.35},
                      {{1.75, -0.1, -5.9}, 0.9, {0.25, 0.4, 0.65}, {0, 0, 0}, 1}};
constexpr double ground = -1, wall = -9, vertical_fov = 34;

struct Lamp {
    vec3 at;
    double intensity;
};
const Lamp lamps[] = {{{-0.9, 1.9, -7.2}, 20}, {{2.2, 2.4, -2.0}, 14}};

struct Hit {
    double distance;
    vec3 point, normal, albedo, specular;
    double roughness;
};

std::optional<Hit> traced(vec3 from, vec3 direction)
{
    std::optional<Hit> nearest;
    auto meets = [&](double t, vec3 normal, vec3 albedo, vec3 specular, double roughness) {
        if (t > 1e-6 && (!nearest || t < nearest->distance))
            nearest = Hit{t, from + t * direction, normal, albedo, specular, roughness};
    };
    meets((ground - from.y) / direction.y, vec3(0, 1, 0), vec3(0.5, 0.48, 0.45), vec3(0), 1);
    meets((wall - from.z) / direction.z, vec3(0, 0, 1), vec3(0.5, 0.5, 0.5), vec3(0), 1);
    for (const Ball &b : balls) {
        const double middle = glm::dot(b.at - from, direction), aside = glm::length(b.at - from - middle * direction);
        if (aside < b.radius) {
            const double t = middle - std::sqrt(b.radius * b.radius - aside * aside);
            meets(t, (from + t * direction - b.at) / b.radius, b.albedo, b.specular, b.roughness);
        }
    }
    return nearest;
}

struct Clear {
    Picture color{width * finer, height *finer, 3}, depth{width * finer, height *finer, 1};
    std::map<std::string, Picture> layers;
    std::vector<Picture> groups{2, Picture(width *finer, height *finer, 3)};
};

// In the maths' own BRDF: Lambert's, and Phong's lobe that stands for a roughness.
Clear rendered()
{
    Clear all;
    for (const char *name : {"normal", "albedo", "specular"})
        all.layers[name] = all.color;
    all.layers["roughness"] = all.depth;
    for (int y = 0; y < height * finer; ++y)
        for (int x = 0; x < width * finer; ++x) {
            const double scale = 2 * std::tan(0.5 * vertical_fov * pi / 180) / (height * finer);
            const vec3 through((x + 0.5 - 0.5 * width * finer) * scale, (0.5 * height * finer - y - 0.5) * scale, -1),
                view = glm::normalize(through);
            const auto hit = traced(vec3(0), view);
            if (!hit)
                continue;
            auto put = [&](Picture &p, vec3 v) {
                for (int c = 0; c < 3; ++c)
                    p.at(x, y)[c] += float(v[c]);
            };
            all.depth.at(x, y)[0] = float(-hit->point.z);
            put(all.layers["normal"], hit->normal);
            put(all.layers["albedo"], hit->albedo);
            put(all.layers["specular"], hit->specular);
            all.layers["roughness"].at(x, y)[0] = float(hit->roughness);
            for (size_t l = 0; l < 2; ++l) {
                const vec3 way = lamps[l].at - hit->point, d = glm::normalize(way);
                const double cosine = glm::dot(hit->normal, d);
                const auto before = traced(hit->point + 1e-4 * hit->normal, d);
                if (cosine <= 0 || (before && before->distance < glm::length(way)))
                    continue;
                const double n = brume::maths_double::phong_exponent(hit->roughness);
                const vec3 mirrored = view - 2 * glm::dot(view, hit->normal) * hit->normal;
                const vec3 reflects = cosine / pi * hit->albedo +
                                      (n + 1) / (2 * pi) * std::pow(std::max(glm::dot(mirrored, d), 0.0), n) * hit->specular;
                const vec3 own = lamps[l].intensity / glm::dot(way, way) * reflects;
                put(all.groups[l], own);
                put(all.color, own);
            }
        }
    return all;
}

class Canvas {
public:
    void draw(const Picture &p, int column, int row)
    {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) {
                    double sum = 0;
                    for (int i = 0; i < finer * finer; ++i)
                        sum += 1 - std::exp(-2.2 * double(p.at(finer * x + i % finer, finer * y + i / finer)[c]));
                    const double v = sum / finer / finer,
                                 encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
                    const int at = (row * (height + gap) + y) * whole + column * (width + gap) + x;
                    rgb_[size_t(at * 3 + c)] = uint8_t(std::lround(255 * encoded));
                }
    }
    void write(const std::string &file) const
    {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        image.width = whole;
        image.height = 2 * height + gap;
        image.format = PNG_FORMAT_RGB;
        if (!png_image_write_to_file(&image, file.c_str(), 0, rgb_.data(), 0, nullptr))
            throw std::runtime_error(file + ": " + image.message);
    }

private:
    static constexpr int whole = 4 * width + 3 * gap;
    std::vector<uint8_t> rgb_ = std::vector<uint8_t>(size_t(whole) * (2 * height + gap) * 3, 255);
};

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 2) {
        std::cerr << "usage: surface_pictures FOLDER\n";
        return 2;
    }
    const Clear clear = rendered();
    Json lights = Json::array();
    for (const Lamp &lamp : lamps)
        lights.push_back(point_light({lamp.at.x, lamp.at.y, lamp.at.z}, lamp.intensity, 0.05));
    Canvas canvas;
    int column = 0;
    for (const char *method : {"", "sun", "psf", "calibrated"}) {
        Json scene = lit_scene({{"scattering", 0.16}}, lights);
        scene["camera"]["vertical_fov"] = vertical_fov;
        const Json airlight = scene["effects"];
        Picture surfaces = clear.color;
        if (*method) {
            scene["effects"] = {{"surface", {{"method", method}}}};
            surfaces = relit(cpu(), scene, clear.color, clear.depth, clear.layers, clear.groups);
        }
        canvas.draw(surfaces, column, 0);
        scene["effects"] = airlight;
        canvas.draw(relit(cpu(), scene, surfaces, clear.depth), column++, 1);
    }
    const std::string file = std::string(argv[1]) + "/surface_methods.png";
    canvas.write(file);
    std::cout << "wrote " << file << "\n";
}
