#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <brume/brume.h>
#include <glm/glm.hpp>

namespace brume::media {

// How the scene projects into a picture; pixels from its top left corner.
struct Lens {
    glm::dvec2 center{0.0};         // principal point [px]
    glm::dvec2 tangent_scale{0.0};  // tangent per pixel; y points down the picture
    std::array<glm::dvec3, 3> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};  // right, up, back
    glm::dvec3 eye{0.0};

    struct Place {
        glm::dvec2 pixel;
        double depth;  // along the optical axis
    };
    // Of a point before the camera.
    std::optional<Place> project(const glm::dvec3 &point) const;
    // Of the pixel's ray at depth 1, from the eye; in the scene's axes.
    glm::dvec3 direction(const glm::dvec2 &pixel) const;
};

// Distances along the optical axis [scene unit] to what a picture shows; infinite where that is far.
struct DepthMap {
    uint32_t width = 0, height = 0;
    std::vector<float> depth;

    bool operator==(const DepthMap &) const = default;
};

// Camera and format must be checked already and complete. Throws Error(BRUME_ERROR_ARGUMENT) where the image does not fit.
Lens make_lens(const brume_camera &camera, const brume_format &format);
std::shared_ptr<const DepthMap> make_depth_map(const brume_format &format, const brume_camera &camera,
                                               const brume_image &image);

}  // namespace brume::media
